#pragma once
/// \file
/// The table of attributes with several values, one row per value.

#include <svt/core/attribute.hpp>
#include <svt/writers/table.hpp>

#include <cstdint>
#include <string_view>

namespace svt::writers {

/// Calls add(row) for each value of a list: id of the feature, name, record and position from 1, value, unit.
template <class Add>
void forEachValue(std::string_view feature, const AttributeList& list, const Add& add) {
    std::int64_t position = 0;
    for (const AttributeList::Item& item : list.items) {
        ++position;
        if (item.attribute == nullptr) continue;
        const Attribute& attribute = *item.attribute;
        add(Row{feature, list.name, std::int64_t{item.record} + 1, position, toText(attribute.value),
                attribute.unit.empty() ? Cell() : Cell(attribute.unit)});
    }
}

}  // namespace svt::writers
