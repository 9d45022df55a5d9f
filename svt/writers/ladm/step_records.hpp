#pragma once
/// \file
/// Records of a STEP file (ISO 10303-21) as text: numbering, texts and numbers.

#include <fmt/format.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace svt::writers {

/// 'text', with the escapes of ISO 10303-21. Bytes that are not UTF-8 become U+FFFD.
[[nodiscard]] std::string stepString(std::string_view text);
/// 'text', or $ for an empty one.
[[nodiscard]] std::string stepOptional(std::string_view text);
/// A number with the point that STEP requires.
[[nodiscard]] std::string stepReal(double value);
/// (#1,#2)
[[nodiscard]] std::string stepList(const std::vector<int>& records);
/// The label's own id if it is a GlobalId of IFC, else one that depends only on `key`.
[[nodiscard]] std::string ifcGlobalId(std::string_view key);

class StepRecords {
public:
    /// Adds #n=TYPE(values). \return n, from 1
    int add(std::string_view type, std::string_view values) {
        text_ += fmt::format("#{}={}({});\n", ++last_, type, values);
        return last_;
    }
    /// A record with a GlobalId by `key` and no owner history.
    int rooted(std::string_view type, std::string_view key, std::string_view values) {
        return add(type, fmt::format("'{}',$,{}", ifcGlobalId(key), values));
    }
    [[nodiscard]] std::string take() { return std::move(text_); }

private:
    std::string text_;
    int last_ = 0;
};

}  // namespace svt::writers
