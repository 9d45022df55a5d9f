#include <svt/simulate/conduction/opening_areas.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace svt::simulate {
namespace {

using Areas = std::map<std::pair<std::uint32_t, std::uint32_t>, std::array<double, 3>>;  // per axis

void growBoxes(const AirMap& map, std::vector<OpeningPlace>& places) {
    for (std::int32_t j = 0; j < map.size.y; ++j)
        for (std::int32_t i = 0; i < map.size.x; ++i) {
            std::size_t r = map.columnStart[map.columnNumber(i, j)];
            std::int32_t begin = 0;
            for (const volume::Run& run : map.columns->column(i, j)) {
                const RunPlace& place = map.runs[r++];
                const auto end = static_cast<std::int32_t>(run.end);
                if (place.kind == RunKind::Opening) {
                    OpeningPlace& box = places[place.number];
                    const bool isFirst = box.max.z == 0;
                    box.min = isFirst
                                  ? Vec3i{i, j, begin}
                                  : Vec3i{std::min(box.min.x, i), std::min(box.min.y, j), std::min(box.min.z, begin)};
                    box.max = {std::max(box.max.x, i + 1), std::max(box.max.y, j + 1), std::max(box.max.z, end)};
                }
                begin = end;
            }
        }
}

// Follows one row of voxels through an opening.
class RowWalk {
public:
    RowWalk(std::uint32_t opening, const std::vector<char>& hasBody, int axis, double area, Areas& areas)
        : opening_(opening), hasBody_(hasBody), axis_(static_cast<std::size_t>(axis)), area_(area), areas_(areas) {}
    void step(const RunPlace& place) {
        if (place.kind == RunKind::Cavity) return;  // air between panes
        if (place.kind == RunKind::Opening) {
            if (place.number == opening_)
                isInside_ = before_ != kNoZone;
            else
                isOther_ = isOther_ || precedes(place.number);
            return;
        }
        if (place.kind == RunKind::Air && isInside_ && !isOther_ && place.number != before_)
            areas_[{std::min(before_, place.number), std::max(before_, place.number)}][axis_] += area_;
        before_ = place.kind == RunKind::Air ? place.number : kNoZone;
        isInside_ = isOther_ = false;
    }

private:
    static constexpr std::uint32_t kNoZone = std::numeric_limits<std::uint32_t>::max();
    [[nodiscard]] bool precedes(std::uint32_t other) const {
        return hasBody_[other] != hasBody_[opening_] ? hasBody_[other] != 0 : other < opening_;
    }

    std::uint32_t opening_;
    const std::vector<char>& hasBody_;
    std::size_t axis_;
    double area_;
    Areas& areas_;
    std::uint32_t before_ = kNoZone;
    bool isInside_ = false, isOther_ = false;
};

void walkRows(const AirMap& map, Vec3d spacing, const std::vector<char>& hasBody, std::uint32_t opening,
              const OpeningPlace& box, Areas& areas) {
    constexpr std::int32_t kBeyond = 3;  // voxels beyond the box: surfaces and air between panes
    for (int axis = 0; axis < 3; ++axis) {
        const int b = (axis + 1) % 3, c = (axis + 2) % 3;
        Vec3i voxel{};
        for (voxel[b] = box.min[b]; voxel[b] < box.max[b]; ++voxel[b])
            for (voxel[c] = box.min[c]; voxel[c] < box.max[c]; ++voxel[c]) {
                RowWalk row(opening, hasBody, axis, spacing[b] * spacing[c], areas);
                const std::int32_t last = std::min(box.max[axis] + kBeyond, map.size[axis]);
                for (voxel[axis] = std::max(box.min[axis] - kBeyond, 0); voxel[axis] < last; ++voxel[axis])
                    row.step(map.at(voxel));
            }
    }
}

}  // namespace

std::vector<OpeningPlace> findOpeningPlaces(const AirMap& map, Vec3d spacing, const std::vector<char>& hasBody) {
    std::vector<OpeningPlace> places(hasBody.size());
    if (places.empty()) return places;
    growBoxes(map, places);
    for (std::size_t n = 0; n < places.size(); ++n) {
        if (places[n].max.z == 0) continue;
        Areas areas;
        walkRows(map, spacing, hasBody, static_cast<std::uint32_t>(n), places[n], areas);
        for (const auto& [zones, ofAxes] : areas)
            places[n].areas[zones] = std::sqrt(ofAxes[0] * ofAxes[0] + ofAxes[1] * ofAxes[1] + ofAxes[2] * ofAxes[2]);
    }
    return places;
}

}  // namespace svt::simulate
