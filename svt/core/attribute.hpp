#pragma once
/// \file
/// A named value of a feature: yearOfConstruction = 1985, measuredHeight = 9.5 m.

#include <cstdint>
#include <string>
#include <variant>

namespace svt {

using AttributeValue = std::variant<std::string, std::int64_t, double, bool>;

/// Names keep the source's local name ("roofType", "ifcType"); a member of a generic
/// attribute set is named "set/name".
struct Attribute {
    std::string name;
    AttributeValue value;
    std::string unit{};  ///< unit of measure (uom), else empty

    friend bool operator==(const Attribute&, const Attribute&) = default;
};

/// The value as text: numbers in shortest round-trip form, true and false.
[[nodiscard]] std::string toText(const AttributeValue& value);

}  // namespace svt
