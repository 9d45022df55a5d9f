#include <svt/drawing/stair_flights.hpp>

#include <svt/core/text.hpp>
#include <svt/drawing/levels/level_parts.hpp>
#include <svt/drawing/section_drawing.hpp>
#include <svt/model/classes.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <utility>

namespace svt::drawing {
namespace {

constexpr double kUpward = 0.98;                        // cosine
constexpr double kSameTread = 0.02;                     // metres
constexpr double kLeastRiser = 0.08, kMostRiser = 0.3;  // metres
constexpr double kLeastArea = 0.4;                      // of the median tread: handrails and posts have less
constexpr double kSamePlane = 0.001;                    // metres
constexpr double kLeastRest = 1e-3;                     // of a face: smaller parts are rounding
constexpr std::size_t kMostPairs = 1'000'000;           // of faces in one plane; hostile models
constexpr double kBetweenTreads = 0.6;                  // of a riser: nearer faces are not two treads

bool isStairLabel(const volume::Label& label) {
    const auto rank = model::classRank(label.className);
    if (rank != model::ClassRank::Installation && rank != model::ClassRank::Element) return false;
    const std::string words =
        lowerAscii(label.className + " " + label.name) + lowerTexts(label, {"ifcType", "function"});
    return words.find("stair") != std::string::npos || words.find("treppe") != std::string::npos;
}

// The upper one of the two in the middle; there must be values.
double medianOf(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

void sortByHeight(std::vector<StairTread>& treads) {
    std::sort(treads.begin(), treads.end(), [](const auto& a, const auto& b) { return a.height < b.height; });
}

// A horizontal triangle, along the grid's axes.
struct FlatTriangle {
    std::array<PlanePoint, 3> corners;  // anticlockwise
    double height = 0;                  // metres above the grid's lower corner
    bool isUp = false;
};

struct PlaneMoment {
    double area = 0;
    PlanePoint sum;  // of area times centre
};

void addMoment(PlaneMoment& moment, std::span<const PlanePoint> convex) {
    for (std::size_t n = 2; n < convex.size(); ++n) {
        const PlanePoint a = convex[0], b = convex[n - 1], c = convex[n];
        const double area = 0.5 * ((b.u - a.u) * (c.v - a.v) - (b.v - a.v) * (c.u - a.u));
        moment.area += area;
        moment.sum = {moment.sum.u + area * (a.u + b.u + c.u) / 3, moment.sum.v + area * (a.v + b.v + c.v) / 3};
    }
}

// The part that two triangles have in common (Sutherland and Hodgman).
std::vector<PlanePoint> commonPart(const FlatTriangle& a, const FlatTriangle& b) {
    std::vector<PlanePoint> part(a.corners.begin(), a.corners.end());
    for (std::size_t side = 0; side < 3 && !part.empty(); ++side) {
        const PlanePoint p = b.corners[side], q = b.corners[(side + 1) % 3];
        const auto insideOf = [&](PlanePoint x) { return (q.u - p.u) * (x.v - p.v) - (q.v - p.v) * (x.u - p.u); };
        std::vector<PlanePoint> kept;
        for (std::size_t n = 0; n < part.size(); ++n) {
            const PlanePoint from = part[n], to = part[(n + 1) % part.size()];
            const double before = insideOf(from), after = insideOf(to);
            if (before >= 0) kept.push_back(from);
            if ((before >= 0) == (after >= 0)) continue;
            const double t = before / (before - after);
            kept.push_back({from.u + t * (to.u - from.u), from.v + t * (to.v - from.v)});
        }
        part = std::move(kept);
    }
    return part;
}

// The parts of faces that look up, without those on which another part of the stair stands. So the top of a riser below
// its tread does not count, nor that of a block below the next block.
std::vector<StairTread> uncoveredFaces(std::vector<FlatTriangle> faces, const volume::Grid& grid) {
    const auto axes = grid.axes();
    std::sort(faces.begin(), faces.end(), [](const auto& a, const auto& b) { return a.height < b.height; });
    std::vector<StairTread> uncovered;
    for (std::size_t n = 0, end = 0; n < faces.size(); n = end) {
        while (end < faces.size() && faces[end].height - faces[n].height <= kSamePlane) ++end;
        const bool isSearched = (end - n) * (end - n) <= kMostPairs;
        for (std::size_t m = n; m < end; ++m) {
            if (!faces[m].isUp) continue;
            PlaneMoment whole, covered;
            addMoment(whole, faces[m].corners);
            for (std::size_t other = n; other < end && isSearched; ++other)
                if (!faces[other].isUp) addMoment(covered, commonPart(faces[m], faces[other]));
            const double rest = whole.area - covered.area;
            if (rest <= kLeastRest * whole.area) continue;
            const double u = (whole.sum.u - covered.sum.u) / rest, v = (whole.sum.v - covered.sum.v) / rest;
            uncovered.push_back(
                {grid.origin() + axes[0] * u + axes[1] * v + axes[2] * faces[m].height, faces[m].height, rest});
        }
    }
    return uncovered;
}

// The largest treads that are not nearer to each other than `least`, from below.
std::vector<StairTread> farTreads(std::vector<StairTread> treads, double least) {
    std::stable_sort(treads.begin(), treads.end(), [](const auto& a, const auto& b) { return a.area > b.area; });
    std::vector<StairTread> far;
    for (const StairTread& tread : treads)
        if (std::all_of(far.begin(), far.end(),
                        [&](const StairTread& other) { return std::abs(other.height - tread.height) >= least; }))
            far.push_back(tread);
    sortByHeight(far);
    return far;
}

// Without faces between two treads: an edge of the floor below the last tread, the foot of a handrail.
std::vector<StairTread> treadsOf(std::vector<StairTread> faces) {
    std::vector<StairTread> treads = farTreads(std::move(faces), kLeastRiser);
    if (treads.size() < 3) return treads;
    std::vector<double> rises;
    for (std::size_t n = 0; n + 1 < treads.size(); ++n) rises.push_back(treads[n + 1].height - treads[n].height);
    return farTreads(std::move(treads), kBetweenTreads * medianOf(std::move(rises)));
}

// Horizontal faces of one height, as one tread; from below.
std::vector<StairTread> joinFaces(std::vector<StairTread> faces) {
    sortByHeight(faces);
    std::vector<StairTread> treads;
    for (const StairTread& face : faces) {
        if (treads.empty() || face.height - treads.back().height > kSameTread) {
            treads.push_back(face);
            continue;
        }
        StairTread& tread = treads.back();
        const double area = tread.area + face.area;
        tread.center = (tread.center * tread.area + face.center * face.area) / area;
        tread.area = area;
    }
    if (treads.empty()) return treads;
    std::vector<double> areas;
    for (const StairTread& tread : treads) areas.push_back(tread.area);
    const double least = kLeastArea * medianOf(std::move(areas));
    std::erase_if(treads, [&](const StairTread& tread) { return tread.area < least; });
    return treadsOf(std::move(treads));
}

double acrossOf(const StairTread& a, const StairTread& b, Vec3d up) noexcept {
    const Vec3d step = b.center - a.center;
    return length(step - up * dot(step, up));
}

}  // namespace

std::vector<std::uint32_t> stairOfLabels(const volume::LabelTable& table) {
    std::vector<std::uint32_t> stairs(table.labels.size(), volume::kNoLabel);
    for (std::uint32_t l = 0; l < stairs.size(); ++l) {
        const std::uint32_t parent = table.labels[l].parent;
        if (parent != volume::kNoLabel && parent < l && stairs[parent] != volume::kNoLabel)
            stairs[l] = stairs[parent];
        else if (isStairLabel(table.labels[l]))
            stairs[l] = l;
    }
    return stairs;
}

int StairFlight::risersTo(double upperFloor) const noexcept {
    const double rest = upperFloor - treads.back().height;
    return static_cast<int>(treads.size()) + (rest > 0.5 * riser && rest < 1.5 * riser ? 1 : 0);
}

std::vector<StairFlight> findStairFlights(const volume::SemanticVolume& volume) {
    const std::vector<std::uint32_t> stairs = stairOfLabels(volume.labels);
    const auto axes = volume.grid.axes();
    const Vec3d up = axes[2];
    std::map<std::uint32_t, std::vector<FlatTriangle>> faces;  // by stair
    for (const auto& triangle : volume.vectors.triangles) {
        const std::uint32_t stair = stairs[triangle.label];
        if (stair == volume::kNoLabel) continue;
        Vec3d corners[3];
        for (std::size_t n = 0; n < 3; ++n)
            corners[n] = volume.vectors.position(triangle.corners[n], volume.grid.origin()) - volume.grid.origin();
        const Vec3d twice = cross(corners[1] - corners[0], corners[2] - corners[0]);
        const double size = length(twice), upward = dot(twice, up);
        if (!(size > 0) || std::abs(upward) < kUpward * size) continue;
        FlatTriangle flat;
        flat.isUp = upward > 0;
        flat.height = dot((corners[0] + corners[1] + corners[2]) / 3.0, up);
        for (std::size_t n = 0; n < 3; ++n) {
            const Vec3d p = corners[flat.isUp ? n : 2 - n];
            flat.corners[n] = {dot(p, axes[0]), dot(p, axes[1])};
        }
        faces[stair].push_back(flat);
    }
    std::vector<StairFlight> flights;
    for (auto& [stair, all] : faces) {
        StairFlight flight{stair, joinFaces(uncoveredFaces(std::move(all), volume.grid)), 0, 0};
        if (flight.treads.size() < 3) continue;
        bool isStair = true;
        std::vector<double> goings;
        for (std::size_t n = 0; n + 1 < flight.treads.size(); ++n) {
            const double rise = flight.treads[n + 1].height - flight.treads[n].height;
            isStair = isStair && rise >= kLeastRiser && rise <= kMostRiser;
            goings.push_back(acrossOf(flight.treads[n], flight.treads[n + 1], up));
        }
        if (!isStair) continue;
        const double steps = static_cast<double>(flight.treads.size() - 1);
        flight.riser = (flight.treads.back().height - flight.treads.front().height) / steps;
        flight.going = medianOf(std::move(goings));
        flights.push_back(std::move(flight));
    }
    return flights;
}

}  // namespace svt::drawing
