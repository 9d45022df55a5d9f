#pragma once
/// \file
/// The text of a DXF: groups of a code and a value, on separate lines.

#include <svt/drawing/section_drawing.hpp>
#include <svt/writers/drawing/drawing_text.hpp>

#include <fmt/format.h>

#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>

namespace svt::writers {

struct DxfGroup {
    int code;
    std::string value;

    DxfGroup(int groupCode, std::string_view text) : code(groupCode), value(text) {}
    DxfGroup(int groupCode, int number) : code(groupCode), value(fmt::format("{}", number)) {}
    DxfGroup(int groupCode, double number) : code(groupCode), value(shortNumber(number, 6)) {}
};

class DxfText {
public:
    void add(std::initializer_list<DxfGroup> groups) {
        for (const DxfGroup& group : groups) text_ += fmt::format("{:>3}\n{}\n", group.code, group.value);
    }
    void point(int code, drawing::PlanePoint p) { add({{code, p.u}, {code + 10, p.v}}); }
    void point(int code, Vec3d p) { add({{code, p.x}, {code + 10, p.y}, {code + 20, p.z}}); }
    void append(std::string_view text) { text_ += text; }
    [[nodiscard]] std::string take() { return std::exchange(text_, {}); }

private:
    std::string text_;
};

/// Windows code page 1252 for its Latin-1 part; other characters as \U+XXXX, those beyond 16 bits as a question mark.
/// Line breaks would end the value and become blanks.
[[nodiscard]] std::string dxfText(std::string_view text);

}  // namespace svt::writers
