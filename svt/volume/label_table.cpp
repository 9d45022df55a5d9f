#include <svt/volume/label_table.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace svt::volume {
namespace {
constexpr std::array<std::pair<Filling, std::string_view>, 8> kFillingNames{{
    {Filling::None, "none"},
    {Filling::Solid, "solid"},
    {Filling::TJunctions, "t-junctions"},
    {Filling::Complemented, "complemented"},
    {Filling::Capped, "capped"},
    {Filling::Winding, "winding"},
    {Filling::Surface, "surface"},
    {Filling::Body, "body"},
}};
}  // namespace

std::string_view fillingName(Filling filling) noexcept {
    for (const auto& [value, name] : kFillingNames)
        if (value == filling) return name;
    return "none";
}

bool fillingFromName(std::string_view name, Filling& filling) noexcept {
    for (const auto& [value, known] : kFillingNames)
        if (known == name) {
            filling = value;
            return true;
        }
    return false;
}

bool enclosesStatedVolume(const Label& label, double enclosed, double area, double unit) noexcept {
    return hasClosedMesh(label.filling) &&
           std::abs(enclosed - label.volume) <= area * unit + 1e-6 * std::abs(label.volume);
}

Scalar LabelTable::scalarCount() const noexcept {
    Scalar count = 1;
    for (const Label& label : labels) count = std::max(count, label.first + label.count);
    return count;
}

int LabelTable::scalarBits() const noexcept {
    const Scalar largest = scalarCount() - 1;
    return largest <= 0xFF ? 8 : largest <= 0xFFFF ? 16 : 32;
}

std::vector<std::uint32_t> LabelTable::labelOfScalar() const {
    std::vector<std::uint32_t> owner(scalarCount(), kNoLabel);
    for (std::size_t i = 0; i < labels.size(); ++i)
        for (Scalar s = 0; s < labels[i].count; ++s) owner[labels[i].first + s] = static_cast<std::uint32_t>(i);
    return owner;
}

}  // namespace svt::volume
