#pragma once
/// \file
/// A named value of a feature: yearOfConstruction = 1985, measuredHeight = 9.5 m. A name with several values is a list.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace svt {

using AttributeValue = std::variant<std::string, std::int64_t, double, bool>;

/// Names keep the source's local name ("roofType", "ifcType"); a member of a generic
/// attribute set is named "set/name".
struct Attribute {
    std::string name;
    AttributeValue value;
    std::string unit{};  ///< unit of measure (uom), else empty
    /// Number of the record, from 0, if a property has several: members of one record ("flood/depth", "flood/rank") have
    /// the same number. Values with equal name and record are a list, in this order.
    std::uint32_t record = 0;

    friend bool operator==(const Attribute&, const Attribute&) = default;
};

/// The value as text: numbers in shortest round-trip form, true and false.
[[nodiscard]] std::string toText(const AttributeValue& value);

/// All values of one name. Views into the attributes that they were made of.
struct AttributeList {
    struct Item {
        const Attribute* attribute = nullptr;  ///< null: the record has no such member
        std::uint32_t record = 0;
    };
    std::string_view name;
    std::vector<Item> items;  ///< ascending by record; never empty

    /// Exactly one value, which writers store as it is. All others are arrays.
    [[nodiscard]] bool isSingle() const noexcept { return items.size() == 1 && items.front().attribute != nullptr; }
};

/// The attributes by name, in the order of first occurrence: the one rule by which all writers handle repeated names.
/// If a property has several records, each of its members has an item for each record, so that the items of
/// "flood/depth" and "flood/rank" belong together. At most kMostGaps items without a value are added in total; a
/// list that needs more gets no such items.
/// Cost: O(n log n) for n attributes.
[[nodiscard]] std::vector<AttributeList> attributeLists(std::span<const Attribute> attributes);
inline constexpr std::size_t kMostGaps = 65536;

/// A JSON array: one value per item, or one per record if there are several, null for records without a value, and an
/// array for records with several values. Invalid UTF-8 is replaced; infinite and undefined numbers are null.
[[nodiscard]] std::string toJsonText(const AttributeList& list);
/// A single value as toText() gives it, else toJsonText().
[[nodiscard]] std::string toText(const AttributeList& list);

}  // namespace svt
