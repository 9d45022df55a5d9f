#include <svt/drawing/stair_flights.hpp>

#include <svt/core/text.hpp>
#include <svt/drawing/levels/level_parts.hpp>
#include <svt/model/classes.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

namespace svt::drawing {
namespace {

constexpr double kUpward = 0.98;                        // cosine
constexpr double kSameTread = 0.02;                     // metres
constexpr double kLeastRiser = 0.08, kMostRiser = 0.3;  // metres
constexpr double kLeastArea = 0.4;                      // of the median tread: handrails and posts have less

bool isStairLabel(const volume::Label& label) {
    const auto rank = model::classRank(label.className);
    if (rank != model::ClassRank::Installation && rank != model::ClassRank::Element) return false;
    const std::string words =
        lowerAscii(label.className + " " + label.name) + lowerTexts(label, {"ifcType", "function"});
    return words.find("stair") != std::string::npos || words.find("treppe") != std::string::npos;
}

// The stair that each label is part of, or kNoLabel.
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

// Horizontal faces of one height, as one tread; from below.
std::vector<StairTread> joinFaces(std::vector<StairTread> faces) {
    std::sort(faces.begin(), faces.end(), [](const auto& a, const auto& b) { return a.height < b.height; });
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
    std::nth_element(areas.begin(), areas.begin() + static_cast<std::ptrdiff_t>(areas.size() / 2), areas.end());
    const double least = kLeastArea * areas[areas.size() / 2];
    std::erase_if(treads, [&](const StairTread& tread) { return tread.area < least; });
    return treads;
}

double acrossOf(const StairTread& a, const StairTread& b, Vec3d up) noexcept {
    const Vec3d step = b.center - a.center;
    return length(step - up * dot(step, up));
}

}  // namespace

int StairFlight::risersTo(double upperFloor) const noexcept {
    const double rest = upperFloor - treads.back().height;
    return static_cast<int>(treads.size()) + (rest > 0.5 * riser && rest < 1.5 * riser ? 1 : 0);
}

std::vector<StairFlight> findStairFlights(const volume::SemanticVolume& volume) {
    const std::vector<std::uint32_t> stairs = stairOfLabels(volume.labels);
    const Vec3d up = volume.grid.axes()[2], origin = volume.grid.origin();
    std::map<std::uint32_t, std::vector<StairTread>> faces;  // by stair
    for (const auto& triangle : volume.vectors.triangles) {
        const std::uint32_t stair = stairs[triangle.label];
        if (stair == volume::kNoLabel) continue;
        const Vec3d a = volume.vectors.position(triangle.corners[0], origin),
                    b = volume.vectors.position(triangle.corners[1], origin),
                    c = volume.vectors.position(triangle.corners[2], origin);
        const Vec3d twice = cross(b - a, c - a);
        const double size = length(twice);
        if (!(size > 0) || dot(twice, up) < kUpward * size) continue;
        const Vec3d center = (a + b + c) / 3.0;
        faces[stair].push_back({center, dot(center - origin, up), 0.5 * size});
    }
    std::vector<StairFlight> flights;
    for (auto& [stair, all] : faces) {
        StairFlight flight{stair, joinFaces(std::move(all)), 0, 0};
        if (flight.treads.size() < 3) continue;
        bool isStair = true;
        for (std::size_t n = 0; n + 1 < flight.treads.size(); ++n) {
            const double rise = flight.treads[n + 1].height - flight.treads[n].height;
            isStair = isStair && rise >= kLeastRiser && rise <= kMostRiser;
            flight.going += acrossOf(flight.treads[n], flight.treads[n + 1], up);
        }
        if (!isStair) continue;
        const double steps = static_cast<double>(flight.treads.size() - 1);
        flight.riser = (flight.treads.back().height - flight.treads.front().height) / steps;
        flight.going /= steps;
        flights.push_back(std::move(flight));
    }
    return flights;
}

}  // namespace svt::drawing
