#pragma once
/// \file
/// Drawings as text that a person can read, for comparison with an approved one.

#include <svt/drawing/section_drawing.hpp>
#include <svt/samples/approved_test.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

namespace svt::drawing::approved {

/// Without a sign for zero; 1/10 mm for metres.
inline std::string number(double value, int decimals = 4) {
    const std::string text = fmt::format("{:.{}f}", value, decimals);
    return text.find_first_not_of("-0.") == std::string::npos ? fmt::format("{:.{}f}", 0.0, decimals) : text;
}

inline std::string point(PlanePoint p) { return number(p.u) + ',' + number(p.v); }
inline std::string point(Vec3d p) { return number(p.x) + ',' + number(p.y) + ',' + number(p.z); }

template <class Points>
std::string points(const Points& all) {
    std::string text;
    for (const auto& p : all) text += ' ' + point(p);
    return text;
}

inline std::string idOf(const volume::SemanticVolume& volume, std::uint32_t label) {
    return label == volume::kNoLabel ? "-" : volume.labels.labels[label].id;
}

/// A long text as its number of lines and its digest.
inline std::string brief(std::string_view text) {
    return fmt::format("{} lines {:016x}\n", std::count(text.begin(), text.end(), '\n'), test::digestOf(text));
}

/// Each part of a drawing on a line; of long lists only number, length and digest.
class DrawingRecord {
public:
    DrawingRecord(const SectionDrawing& drawing, const volume::SemanticVolume& volume)
        : drawing_(drawing), volume_(volume) {
        addFrame();
        addComponents();
        addLines();
        addDimensions();
        addDoors();
    }
    [[nodiscard]] const std::string& text() const noexcept { return text_; }

private:
    void line(const std::string& text) { text_ += text + '\n'; }

    void addFrame() {
        const PlaneAxes& axes = drawing_.axes;
        line(fmt::format("plane {} through {}, bound {}, u {}, v {}, origin {}", point(drawing_.plane.normal),
                         point(drawing_.plane.point), number(drawing_.plane.bound), point(axes.u), point(axes.v),
                         point(axes.origin)));
        line(fmt::format("unit {} tolerance {} edges in plane {} shift {} meshes {} unsettled {} lacks {}",
                         drawing_.drawingUnit, drawing_.tolerance, drawing_.edgesInPlane,
                         number(drawing_.planeShift, 6), drawing_.isFromMeshes, drawing_.isUnsettled,
                         drawing_.lacksMeshes));
    }

    void addComponents() {
        for (const SectionComponent& component : drawing_.components) {
            std::string rings;
            std::size_t corners = 0;
            const auto add = [&](const Ring& ring, char kind) {
                rings += kind + points(ring);
                corners += ring.size();
            };
            for (const SectionPolygon& polygon : component.polygons) {
                add(polygon.outer, 'o');
                for (const Ring& hole : polygon.holes) add(hole, 'h');
                const TextPlace place = findTextPlace(polygon);
                rings += fmt::format(" {} text {} {} {}", number(polygon.area), point(place.center),
                                     number(place.width), number(place.height));
            }
            line(fmt::format("  {} area {} bound {} exact {} lines {} floor {}: {} corners {:016x}",
                             idOf(volume_, component.label), number(component.area),
                             fmt::format("{:.6g}", component.areaBound), component.isExact,
                             number(component.lineLength), component.floorArea ? number(*component.floorArea) : "-",
                             corners, test::digestOf(rings)));
        }
        for (const ClassArea& all : drawing_.classes)
            line(fmt::format("  {}: {} components, {}", all.className, all.components, number(all.area)));
    }

    void addLines() {
        std::string borders, lines;
        for (const SectionBorder& border : drawing_.borders)
            borders += fmt::format("{} {}{}\n", idOf(volume_, border.left), idOf(volume_, border.right),
                                   points(border.points));
        for (const SectionLine& each : drawing_.lines)
            lines += fmt::format("{}{}\n", idOf(volume_, each.label), points(each.points));
        line(fmt::format("{} borders {:016x}, {} lines {:016x}", drawing_.borders.size(), test::digestOf(borders),
                         drawing_.lines.size(), test::digestOf(lines)));
        for (const BeyondKind kind : {BeyondKind::Visible, BeyondKind::Hidden, BeyondKind::Above}) {
            std::size_t count = 0;
            double length = 0;
            std::string all;
            for (const BeyondLine& each : drawing_.beyond) {
                if (each.kind != kind) continue;
                ++count;
                length += std::hypot(each.to.u - each.from.u, each.to.v - each.from.v);
                all += fmt::format("{} {} {}\n", idOf(volume_, each.label), point(each.from), point(each.to));
            }
            line(fmt::format("beyond {}: {}, {} m, {:016x}", int(kind), count, number(length), test::digestOf(all)));
        }
    }

    void addDimensions() {
        for (const DimensionChain& chain : drawing_.dimensions) {
            std::string stops;
            for (const double stop : chain.stops) stops += ' ' + number(stop);
            line(fmt::format("chain {} {}{}", int(chain.side), chain.row, stops));
        }
        for (const RoomDimension& room : drawing_.roomDimensions)
            line(fmt::format("room {} {} to {}", idOf(volume_, room.label), point(room.from), point(room.to)));
        for (const OpeningHeights& opening : drawing_.openings)
            line(fmt::format("opening {} at {} away {} sill {} head {} exact {}", idOf(volume_, opening.label),
                             point(opening.at), point(opening.away), number(opening.sill), number(opening.head),
                             opening.isExact));
    }

    void addDoors() {
        for (const DoorSwing& door : drawing_.doors) {
            std::string text = "door " + idOf(volume_, door.label);
            for (const auto& leaf : door.lines) text += " line" + points(leaf);
            for (const DoorSwing::Arc& arc : door.arcs)
                text += fmt::format(" arc {} {} {}", point(arc.center), point(arc.from), point(arc.to));
            line(text);
        }
    }

    const SectionDrawing& drawing_;
    const volume::SemanticVolume& volume_;
    std::string text_;
};

}  // namespace svt::drawing::approved
