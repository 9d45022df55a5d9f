#pragma once
/// \file
/// Types of rights, restrictions and responsibilities of ISO 19152 that a table of owners may name.

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace svt::analyze {

/// The class of ISO 19152 to which a type belongs.
enum class RightClass : std::uint8_t { Right, Restriction, Responsibility };
/// "LA_Right", "LA_Restriction", "LA_Responsibility".
[[nodiscard]] std::string_view ladmClassName(RightClass of) noexcept;

struct RightType {
    std::string_view name;  ///< lower case
    RightClass of = RightClass::Right;
};

inline constexpr std::uint8_t kOwnership = 0;  ///< index of ownership in rightTypes()

/// All types: ownership first, then by class.
[[nodiscard]] std::span<const RightType> rightTypes() noexcept;

/// The index of a type by its name, ignoring case; nothing for an unknown name.
[[nodiscard]] std::optional<std::uint8_t> rightTypeOf(std::string_view name) noexcept;

/// "ownership, lease, ...": the names of all types.
[[nodiscard]] std::string rightTypeNames();

}  // namespace svt::analyze
