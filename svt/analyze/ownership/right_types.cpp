#include <svt/analyze/right_types.hpp>

#include <svt/core/text.hpp>

#include <array>

namespace svt::analyze {
namespace {

constexpr std::array<RightType, 11> kRightTypes{{{"ownership", RightClass::Right},
                                                 {"lease", RightClass::Right},
                                                 {"usufruct", RightClass::Right},
                                                 {"superficies", RightClass::Right},
                                                 {"easement", RightClass::Right},
                                                 {"occupation", RightClass::Right},
                                                 {"mortgage", RightClass::Restriction},
                                                 {"servitude", RightClass::Restriction},
                                                 {"monument", RightClass::Restriction},
                                                 {"maintenance", RightClass::Responsibility},
                                                 {"monument maintenance", RightClass::Responsibility}}};

}  // namespace

std::string_view ladmClassName(RightClass of) noexcept {
    constexpr std::array<std::string_view, 3> kNames{"LA_Right", "LA_Restriction", "LA_Responsibility"};
    return kNames[static_cast<std::size_t>(of)];
}

std::span<const RightType> rightTypes() noexcept { return kRightTypes; }

std::optional<std::uint8_t> rightTypeOf(std::string_view name) noexcept {
    for (std::size_t n = 0; n < kRightTypes.size(); ++n)
        if (equalsIgnoringCase(kRightTypes[n].name, name)) return static_cast<std::uint8_t>(n);
    return std::nullopt;
}

std::string rightTypeNames() {
    std::string names;
    for (const RightType& type : kRightTypes) names += (names.empty() ? "" : ", ") + std::string(type.name);
    return names;
}

}  // namespace svt::analyze
