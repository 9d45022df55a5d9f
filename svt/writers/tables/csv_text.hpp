#pragma once
/// \file
/// Text of comma-separated values (RFC 4180).

#include <fmt/format.h>

#include <string>
#include <string_view>
#include <utility>

namespace svt::writers {

/// Lines of fields, quoted where the format wants it.
class CsvText {
public:
    void field(std::string_view text) {
        separate();
        if (text.find_first_of(",\"\r\n") == std::string_view::npos) {
            text_ += text;
            return;
        }
        text_ += '"';
        for (const char c : text) {
            if (c == '"') text_ += '"';
            text_ += c;
        }
        text_ += '"';
    }
    template <class T>
    void number(T value) {
        separate();
        text_ += fmt::format("{}", value);
    }
    void nothing() { separate(); }
    void endLine() {
        text_ += "\r\n";
        isFirst_ = true;
    }
    [[nodiscard]] std::string take() { return std::move(text_); }

private:
    void separate() {
        if (!isFirst_) text_ += ',';
        isFirst_ = false;
    }
    std::string text_;
    bool isFirst_ = true;
};

}  // namespace svt::writers
