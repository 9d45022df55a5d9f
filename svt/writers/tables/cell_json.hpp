#pragma once
/// \file
/// A cell as JSON.

#include <svt/writers/table.hpp>

#include <nlohmann/json.hpp>

namespace svt::writers {

/// The value with its own type; null for empty cells and blobs.
[[nodiscard]] inline nlohmann::ordered_json cellJson(const Cell& cell) {
    return std::visit(
        [](const auto& value) -> nlohmann::ordered_json {
            if constexpr (std::is_same_v<std::decay_t<decltype(value)>, JsonArray>)
                return nlohmann::ordered_json::parse(value.text, nullptr, false);
            else if constexpr (std::is_constructible_v<nlohmann::ordered_json, decltype(value)>)
                return value;
            else
                return nullptr;
        },
        cell.value);
}

}  // namespace svt::writers
