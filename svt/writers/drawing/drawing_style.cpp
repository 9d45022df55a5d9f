#include <svt/writers/drawing/drawing_style.hpp>

#include <svt/model/classes.hpp>
#include <svt/model/phases.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <variant>

namespace svt::writers {
namespace {

using drawing::PlanePoint;
using drawing::SectionComponent;
using render::Hatch;
using volume::kNoLabel;

constexpr double kSlim = 0.7;  // millimetres on paper

constexpr HatchTile kHatches[] = {
    {Hatch::Masonry, 1.4, 1.4, -45, "#f6e8e1", "M0 .7H1.4", ""},
    {Hatch::Concrete, 6, 6, 0, "#eeeeec", "M.8 1.6l.9-.9.3 1.1zM3.6 4.9l1-.5-.1 1.1zM4.3 1.7l.5-.7.5.8z",
     "M2.9 .6h.22v.22h-.22zM1.2 3.3h.22v.22h-.22zM5.4 3.2h.22v.22h-.22zM3.1 2.7h.22v.22h-.22zM.6 5.3h.22v.22h-.22z"
     "M2.3 4.4h.22v.22h-.22zM5.6 .5h.22v.22h-.22zM4.2 3.7h.22v.22h-.22z"},
    {Hatch::ReinforcedConcrete, 2.6, 2.4, -45, "#e9edeb", "M0 .6H2.6M0 1.8H1.7", ""},
    {Hatch::Timber, 5, 1.8, -20, "#f8eed7",
     "M0 .45C1.2 .1 1.6 .9 2.5 .5S4.2 .3 5 .45M0 1.35C.9 1.6 1.8 1 2.7 1.3S4.2 1.5 5 1.35", ""},
    {Hatch::Insulation, 2.4, 3, 0, "#fbf6d5", "M0 .2H2.4M0 2.8H2.4M0 2.8L1.2 .2L2.4 2.8", ""},
    {Hatch::Earth, 7, 7, 0, "#efe6d8",
     "M.3 2.2L2.2 .3M1 2.9L2.9 1M1.7 3.6L3.6 1.7M4.2 .9L6.1 2.8M3.9 1.6L5.4 3.1M3.6 5.7L5.5 3.8M4.3 6.4L6.2 4.5"
     "M5 6.9L6.7 5.2M.4 4.4L2.3 6.3M1.1 4.2L3 6.1M.2 5.2L1.6 6.6",
     ""},
    {Hatch::Steel, 2, 1.8, -45, "#e3e8ee", "M0 .5H2M0 .95H2", ""},
    {Hatch::Glass, 4, 4, 0, "#e6f2f7", "M.6 1.6L1.4 .8M1.1 1.9L1.9 1.1M2.8 3.5L3.6 2.7", ""},
    {Hatch::General, 2.8, 2.8, 45, "#f2f2f2", "M0 1.4H2.8", ""},
};

bool isWindowElement(const volume::Label& label) {
    return std::any_of(label.attributes.begin(), label.attributes.end(), [](const Attribute& attribute) {
        const std::string* text = std::get_if<std::string>(&attribute.value);
        return text != nullptr && attribute.name == "ifcType" && text->find("Window") != std::string::npos;
    });
}

// Frames of windows that are elements: they have no hatch of glass, but narrow lines like all windows.
bool isWindowFrame(const volume::LabelTable& table, std::uint32_t label) {
    const volume::Label& of = table.labels[label];
    const bool isPart = std::any_of(of.attributes.begin(), of.attributes.end(), [](const Attribute& attribute) {
        return attribute.name == model::kPhaseAttribute;
    });
    return isPart &&
           (isWindowElement(of) || (of.parent < table.labels.size() && isWindowElement(table.labels[of.parent])));
}

}  // namespace

std::span<const HatchTile> hatchTiles() noexcept { return kHatches; }

std::pair<PlanePoint, PlanePoint> drawnBox(const drawing::SectionDrawing& drawing) {
    PlanePoint low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
    PlanePoint high{-low.u, -low.v};
    const auto add = [&](PlanePoint p) {
        low = {std::min(low.u, p.u), std::min(low.v, p.v)};
        high = {std::max(high.u, p.u), std::max(high.v, p.v)};
    };
    for (const SectionComponent& component : drawing.components)
        for (const auto& polygon : component.polygons)
            for (const PlanePoint p : polygon.outer) add(p);
    for (const drawing::SectionLine& line : drawing.lines)
        for (const PlanePoint p : line.points) add(p);
    for (const drawing::BeyondLine& line : drawing.beyond) {
        add(line.from);
        add(line.to);
    }
    for (const drawing::DoorSwing& door : drawing.doors) {
        for (const auto& line : door.lines)
            for (const PlanePoint p : line) add(p);
        for (const auto& arc : door.arcs)
            for (const PlanePoint p : {arc.from, arc.to}) add(p);
    }
    for (const drawing::RevisionLines& revision : drawing.revisions)
        for (const drawing::RevisionLines::Line& line : revision.removed) {
            add(line.from);
            add(line.to);
        }
    if (!(low.u <= high.u)) return {};
    return {low, high};
}

DrawingStyle::DrawingStyle(const drawing::SectionDrawing& drawing, const volume::SemanticVolume& volume,
                           double millimetres)
    : volume_(volume),
      hatches_(drawing.hatches != nullptr
                   ? drawing.hatches
                   : std::make_shared<const std::vector<Hatch>>(drawing::labelHatches(volume.labels))),
      isSlim_(volume.labels.labels.size(), 0) {
    for (const SectionComponent& component : drawing.components)
        isSlim_[component.label] = isSlim(component, millimetres) ? 1 : 0;
}

bool DrawingStyle::isSpace(std::uint32_t label) const noexcept {
    return label == kNoLabel || model::isSpace(volume_.labels.labels[label].className);
}

bool DrawingStyle::isBold(std::uint32_t label) const noexcept {
    if (isSpace(label) || (*hatches_)[label] == Hatch::Glass || isSlim_[label] != 0) return false;
    return model::classRank(volume_.labels.labels[label].className) >= model::ClassRank::Installation &&
           !isWindowFrame(volume_.labels, label);
}

// Sheets are one voxel thick whatever they represent: towards rooms they take the line of the part behind them.
bool DrawingStyle::isSheet(std::uint32_t label) const noexcept {
    return label != kNoLabel && volume_.labels.labels[label].filling == volume::Filling::Surface;
}

bool DrawingStyle::isBoldBetween(std::uint32_t left, std::uint32_t right) const noexcept {
    if ((isSheet(left) && !isSpace(right)) || (isSheet(right) && !isSpace(left))) return false;
    if (isBold(left) && isBold(right)) return isGround(left) != isGround(right);
    return isBold(left) != isBold(right);
}

// A wall keeps its outline against the earth around it.
bool DrawingStyle::isGround(std::uint32_t label) const noexcept {
    return (*hatches_)[label] == Hatch::Earth ||
           model::classRank(volume_.labels.labels[label].className) == model::ClassRank::Other;
}

bool DrawingStyle::isSlim(const SectionComponent& component, double millimetres) const noexcept {
    if (isSheet(component.label) || component.polygons.empty()) return false;
    double length = 0;
    const auto add = [&](const drawing::Ring& ring) {
        for (std::size_t n = 0; n < ring.size(); ++n) {
            const PlanePoint a = ring[n], b = ring[(n + 1) % ring.size()];
            length += std::hypot(b.u - a.u, b.v - a.v);
        }
    };
    for (const auto& polygon : component.polygons) {
        add(polygon.outer);
        for (const auto& hole : polygon.holes) add(hole);
    }
    return 2 * component.area / length * millimetres < kSlim;
}

}  // namespace svt::writers
