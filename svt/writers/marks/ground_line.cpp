#include <svt/writers/marks/ground_line.hpp>

#include <svt/drawing/building_crop.hpp>
#include <svt/drawing/clip_segment.hpp>
#include <svt/model/classes.hpp>
#include <svt/writers/drawing/drawing_style.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

namespace svt::writers {
namespace {

using drawing::PlanePoint;

bool isTerrain(const volume::Label& label) {
    return model::classRank(label.className) == model::ClassRank::Other && label.className != "Annotation" &&
           label.className != "Grid" && label.className != "CityObjectGroup";
}

// A bold line with groups of strokes below it.
void addGround(MarkPath path, MarkShapes& shapes) {
    constexpr double kPitch = 6, kStrokes = 3, kApart = 1, kLong = 1.6;  // millimetres; strokes in a group
    double left = 0.5 * kPitch;                                          // to the next group
    for (std::size_t n = 0; n + 1 < path.size(); ++n) {
        const PlanePoint a = path[n], b = path[n + 1];
        const double size = std::hypot(b.u - a.u, b.v - a.v);
        while (left < size) {
            for (int stroke = 0; stroke < kStrokes; ++stroke) {
                const double t = left / size, shift = stroke * kApart;
                const PlanePoint at{a.u + (b.u - a.u) * t + shift, a.v + (b.v - a.v) * t};
                shapes.thin.push_back({at, {at.u - kLong, at.v - kLong}});
            }
            left += kPitch;
        }
        left -= size;
    }
    shapes.bold.push_back(std::move(path));
}

// Coordinates of an elevation: u, v, and the depth behind its plane.
class ElevationSpace {
public:
    ElevationSpace(const drawing::SectionDrawing& drawing, const volume::SemanticVolume& volume)
        : axes_(drawing.axes), volume_(volume) {}

    [[nodiscard]] std::array<Vec3d, 3> cornersOf(const volume::VectorParts::Triangle& triangle) const {
        std::array<Vec3d, 3> corners;
        for (std::size_t n = 0; n < 3; ++n) {
            const Vec3d p = volume_.vectors.position(triangle.corners[n], volume_.grid.origin());
            const PlanePoint at = axes_.planeFromWorld(p);
            corners[n] = {at.u, at.v, dot(axes_.origin - p, axes_.normal)};
        }
        return corners;
    }

private:
    const drawing::PlaneAxes& axes_;
    const volume::SemanticVolume& volume_;
};

using GroundSegment = std::pair<PlanePoint, PlanePoint>;  // from left to right

// Where a triangle crosses a depth.
std::optional<GroundSegment> crossingOf(const std::array<Vec3d, 3>& corners, double depth) {
    PlanePoint ends[2];
    int count = 0;
    for (std::size_t n = 0; n < 3 && count < 2; ++n) {
        const Vec3d a = corners[n], b = corners[(n + 1) % 3];
        if ((a.z < depth) == (b.z < depth)) continue;
        // From the lower to the higher depth, so that neighbours find the same point.
        const Vec3d from = a.z < b.z ? a : b, to = a.z < b.z ? b : a;
        const double t = (depth - from.z) / (to.z - from.z);
        ends[count++] = {from.x + (to.x - from.x) * t, from.y + (to.y - from.y) * t};
    }
    if (count < 2 || ends[0].u == ends[1].u) return std::nullopt;
    return ends[0].u < ends[1].u ? GroundSegment(ends[0], ends[1]) : GroundSegment(ends[1], ends[0]);
}

// Segments that continue each other as polylines.
std::vector<std::vector<PlanePoint>> chained(std::vector<GroundSegment> segments) {
    constexpr double kSame = 1e-5;  // metres
    std::sort(segments.begin(), segments.end(), [](const GroundSegment& a, const GroundSegment& b) {
        return std::tie(a.first.u, a.first.v, a.second.u) < std::tie(b.first.u, b.first.v, b.second.u);
    });
    std::vector<std::vector<PlanePoint>> chains;
    for (const GroundSegment& segment : segments) {
        const bool isNext = !chains.empty() && std::abs(chains.back().back().u - segment.first.u) < kSame &&
                            std::abs(chains.back().back().v - segment.first.v) < kSame;
        if (!isNext) chains.push_back({segment.first});
        chains.back().push_back(segment.second);
    }
    return chains;
}

// The upper faces of terrain at the front of the building, within the drawing and `below` metres under it.
std::vector<GroundSegment> terrainBefore(const drawing::SectionDrawing& drawing, const volume::SemanticVolume& volume,
                                         std::span<const std::uint8_t> isAround, double below) {
    constexpr double kBefore = 0.02, kLeastRise = 0.05;  // metres; of the normal: steeper faces are sides
    const ElevationSpace space(drawing, volume);
    const std::vector<volume::Label>& labels = volume.labels.labels;
    double front = std::numeric_limits<double>::infinity();
    std::vector<std::uint8_t> isGround;
    for (std::size_t l = 0; l < labels.size(); ++l)
        isGround.push_back(isAround[l] != 0 && isTerrain(labels[l]) && !model::isSpace(labels[l].className) ? 1 : 0);
    if (std::find(isGround.begin(), isGround.end(), 1) == isGround.end()) return {};
    for (const auto& triangle : volume.vectors.triangles)
        if (isAround[triangle.label] == 0)
            for (const Vec3d& corner : space.cornersOf(triangle)) front = std::min(front, corner.z);
    auto [low, high] = drawnBox(drawing);
    low.v -= below;
    std::vector<GroundSegment> segments;
    for (const auto& triangle : volume.vectors.triangles) {
        if (isGround[triangle.label] == 0) continue;
        const std::array<Vec3d, 3> corners = space.cornersOf(triangle);
        // u, v and the depth are left-handed: the sign of the rise is turned.
        const Vec3d normal = normalized(cross(corners[1] - corners[0], corners[2] - corners[0]));
        const bool isSheet = labels[triangle.label].filling == volume::Filling::Surface;
        if (isSheet ? std::abs(normal.y) < kLeastRise : -normal.y < kLeastRise) continue;
        const auto crossing = crossingOf(corners, front - kBefore);
        if (!crossing) continue;
        if (const auto part = drawing::clipSegment(crossing->first, crossing->second, low, high))
            segments.push_back(*part);
    }
    return segments;
}

// The height of the ground without terrain, metres above the grid's lower corner, and whether it is assumed.
std::pair<double, bool> groundHeight(const volume::SemanticVolume& volume,
                                     std::span<const drawing::BuildingLevel> levels) {
    constexpr double kBasement = 1.2;  // metres below the ground floor
    const double zero = drawing::zeroLevel(levels);
    const bool hasBasement = std::any_of(levels.begin(), levels.end(), [&](const drawing::BuildingLevel& level) {
        return level.floor < zero - kBasement;
    });
    double lowest = std::numeric_limits<double>::infinity();
    const Vec3d up = volume.grid.axes()[2];
    for (const auto& triangle : volume.vectors.triangles)
        if (volume.labels.labels[triangle.label].className == "GroundSurface")
            for (const auto corner : triangle.corners)
                lowest = std::min(lowest, dot(volume.vectors.position(corner, {}), up));
    if (hasBasement || !std::isfinite(lowest)) return {zero, true};
    return {lowest, false};
}

// The ground line of an elevation: the highest of its parts at a place, or one height everywhere.
class GroundProfile {
public:
    GroundProfile(std::vector<GroundSegment> segments, double height)
        : segments_(std::move(segments)), height_(height) {}

    [[nodiscard]] bool isTerrain() const noexcept { return !segments_.empty(); }
    [[nodiscard]] std::optional<double> heightAt(double u) const noexcept {
        if (segments_.empty()) return height_;
        std::optional<double> highest;
        for (const auto& [a, b] : segments_) {
            if (u < a.u || u > b.u) continue;
            const double v = a.v + (b.v - a.v) * (u - a.u) / (b.u - a.u);
            if (!highest || v > *highest) highest = v;
        }
        return highest;
    }

    // The shares of a line at which its side of the ground may change, ascending, with 0 and 1.
    [[nodiscard]] std::vector<double> sharesOf(const drawing::BeyondLine& line) const {
        std::vector<double> shares{0, 1};
        const double du = line.to.u - line.from.u, dv = line.to.v - line.from.v;
        const auto add = [&](double share) {
            if (share > 0 && share < 1) shares.push_back(share);
        };
        if (segments_.empty() && dv != 0) add((height_ - line.from.v) / dv);
        for (const auto& [a, b] : segments_) {
            for (const PlanePoint end : {a, b})
                if (du != 0) add((end.u - line.from.u) / du);
            const double slope = (b.v - a.v) / (b.u - a.u), rise = dv - slope * du;
            if (rise != 0) add((a.v + slope * (line.from.u - a.u) - line.from.v) / rise);
        }
        std::sort(shares.begin(), shares.end());
        return shares;
    }

private:
    std::vector<GroundSegment> segments_;  // metres
    double height_;
};

// Adds the pieces of a line above and below the ground.
void addPieces(const drawing::BeyondLine& line, const GroundProfile& ground, bool isAround,
               std::vector<drawing::BeyondLine>& lines) {
    constexpr double kTouch = 0.005;  // metres below the ground line
    const auto at = [&](double share) {
        return PlanePoint{line.from.u + (line.to.u - line.from.u) * share,
                          line.from.v + (line.to.v - line.from.v) * share};
    };
    const std::vector<double> shares = ground.sharesOf(line);
    const auto isBelow = [&](std::size_t n) {
        const PlanePoint middle = at(0.5 * (shares[n] + shares[n + 1]));
        const auto height = ground.heightAt(middle.u);
        return height && middle.v < *height - kTouch;
    };
    for (std::size_t first = 0, end = 0; first + 1 < shares.size(); first = end) {
        const bool below = isBelow(first);
        for (end = first + 1; end + 1 < shares.size() && isBelow(end) == below;) ++end;
        if (below && (isAround || ground.isTerrain())) continue;
        drawing::BeyondLine piece = line;
        if (shares[first] > 0) piece.from = at(shares[first]);
        if (shares[end] < 1) piece.to = at(shares[end]);
        if (below) piece.kind = drawing::BeyondKind::Hidden;
        lines.push_back(piece);
    }
}

}  // namespace

MarkShapes drawGround(const drawing::SectionDrawing& drawing, const volume::SemanticVolume& volume,
                      double millimetres) {
    MarkShapes shapes;
    shapes.layer = "Ground";
    for (const drawing::SectionLine& line : drawing.lines) {
        if (!isTerrain(volume.labels.labels[line.label])) continue;
        MarkPath path;
        for (const PlanePoint p : line.points) path.push_back({p.u * millimetres, p.v * millimetres});
        addGround(std::move(path), shapes);
    }
    return shapes;
}

GroundBefore drawGroundBefore(const drawing::SectionDrawing& drawing, const volume::SemanticVolume& volume,
                              std::span<const drawing::BuildingLevel> levels, double millimetres) {
    constexpr double kBelow = 5;  // millimetres beyond the drawing
    GroundBefore ground;
    ground.shapes.layer = "Ground";
    if (drawing.beyond.empty()) return ground;
    const auto segments = terrainBefore(drawing, volume, drawing::labelsAroundBuilding(volume), kBelow / millimetres);
    for (const std::vector<PlanePoint>& chain : chained(segments)) {
        MarkPath path;
        for (const PlanePoint p : chain) path.push_back({p.u * millimetres, p.v * millimetres});
        addGround(std::move(path), ground.shapes);
    }
    if (!segments.empty()) return ground;
    const auto [height, isAssumed] = groundHeight(volume, levels);
    const auto [low, high] = drawnBox(drawing);
    const Vec3d world = volume.grid.origin() + volume.grid.axes()[2] * height;
    const double v = drawing.axes.planeFromWorld(world).v * millimetres;
    addGround({{low.u * millimetres - kGroundOver, v}, {high.u * millimetres + kGroundOver, v}}, ground.shapes);
    ground.isAssumed = isAssumed;
    return ground;
}

void hideBelowGround(drawing::SectionDrawing& elevation, const volume::SemanticVolume& volume,
                     std::span<const drawing::BuildingLevel> levels, std::span<const std::uint8_t> isAround) {
    if (elevation.beyond.empty()) return;
    const Vec3d world = volume.grid.origin() + volume.grid.axes()[2] * groundHeight(volume, levels).first;
    const GroundProfile ground(terrainBefore(elevation, volume, isAround, 0), elevation.axes.planeFromWorld(world).v);
    std::vector<drawing::BeyondLine> lines;
    for (const drawing::BeyondLine& line : elevation.beyond) {
        if (line.kind == drawing::BeyondKind::Visible)
            addPieces(line, ground, isAround[line.label] != 0, lines);
        else
            lines.push_back(line);
    }
    std::stable_sort(lines.begin(), lines.end(), [](const auto& a, const auto& b) {
        return std::tie(a.kind, a.label) < std::tie(b.kind, b.label);
    });
    elevation.beyond = std::move(lines);
}

}  // namespace svt::writers
