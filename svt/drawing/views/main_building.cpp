#include <svt/drawing/views/main_building.hpp>

#include <svt/core/text.hpp>
#include <svt/drawing/dimension/part_roles.hpp>
#include <svt/drawing/levels/level_parts.hpp>
#include <svt/model/classes.hpp>

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace svt::drawing {
namespace {

constexpr double kLeastGap = 0.25;  // metres
constexpr int kMostCells = 512;     // per axis
constexpr double kSameRidge = 0.1;  // metres below the highest point
constexpr double kLeastRidge = 1;   // metres

// A map of cells that boxes cover, divided into parts that touch.
class CoverMap {
public:
    explicit CoverMap(const Box3d& all) : low_(all.min) {
        const Vec3d size = all.size();
        cell_ = std::max(kLeastGap, std::max(size.x, size.y) / kMostCells);
        width_ = cellOf(size.x) + 2;
        height_ = cellOf(size.y) + 2;
        covers_.assign(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), 0);
    }

    // Differences; divide() sums them.
    void add(const Box3d& box) {
        const int left = cellOf(box.min.x - low_.x), right = cellOf(box.max.x - low_.x) + 1,
                  bottom = cellOf(box.min.y - low_.y), top = cellOf(box.max.y - low_.y) + 1;
        at(left, bottom) += 1;
        at(right, bottom) -= 1;
        at(left, top) -= 1;
        at(right, top) += 1;
    }

    // From here on partOf() answers.
    void divide() {
        for (int y = 0; y < height_; ++y)
            for (int x = 1; x < width_; ++x) at(x, y) += at(x - 1, y);
        for (int y = 1; y < height_; ++y)
            for (int x = 0; x < width_; ++x) at(x, y) += at(x, y - 1);
        for (int& cover : covers_) cover = cover > 0 ? -1 : 0;
        for (int y = 0; y < height_; ++y)
            for (int x = 0; x < width_; ++x)
                if (at(x, y) < 0) fill(x, y, ++parts_);
    }
    [[nodiscard]] std::size_t parts() const noexcept { return static_cast<std::size_t>(parts_); }
    // From 0.
    [[nodiscard]] std::size_t partOf(const Box3d& box) {
        return static_cast<std::size_t>(std::max(1, at(cellOf(box.min.x - low_.x), cellOf(box.min.y - low_.y))) - 1);
    }

private:
    [[nodiscard]] int cellOf(double metres) const noexcept { return static_cast<int>(metres / cell_); }
    [[nodiscard]] int& at(int x, int y) {
        return covers_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x)];
    }
    void fill(int x, int y, int part) {
        std::vector<std::pair<int, int>> open{{x, y}};
        at(x, y) = part;
        while (!open.empty()) {
            const auto [u, v] = open.back();
            open.pop_back();
            for (const auto& [du, dv] : {std::pair(1, 0), std::pair(-1, 0), std::pair(0, 1), std::pair(0, -1)}) {
                const int nextU = u + du, nextV = v + dv;
                if (nextU < 0 || nextV < 0 || nextU >= width_ || nextV >= height_ || at(nextU, nextV) >= 0) continue;
                at(nextU, nextV) = part;
                open.emplace_back(nextU, nextV);
            }
        }
    }

    Vec3d low_;
    double cell_ = 1;
    int width_ = 0, height_ = 0, parts_ = 0;
    std::vector<int> covers_;  // row by row: number of boxes, then -1 if covered, then the number of the part
};

// Whether a component is a stair by its class, type or name; the door of a stairwell is not a stair.
bool isStair(const volume::Label& label) {
    const auto rank = model::classRank(label.className);
    if (rank != model::ClassRank::Installation && rank != model::ClassRank::Element) return false;
    if (model::isBoundarySurface(label.className)) return false;
    const std::string words =
        lowerAscii(label.className + " " + label.name) + lowerTexts(label, {"ifcType", "function"});
    return words.find("stair") != std::string::npos || words.find("treppe") != std::string::npos;
}

bool isRoof(const volume::Label& label) {
    const std::string words = lowerAscii(label.className + " " + label.name) +
                              lowerTexts(label, {"ifcType", "predefinedType", "PredefinedType", "function"});
    return words.find("roof") != std::string::npos || words.find("dach") != std::string::npos;
}

bool isWithin(const Box3d& box, const Box3d& all) {
    const Vec3d middle = (box.min + box.max) * 0.5;
    return middle.x >= all.min.x && middle.x <= all.max.x && middle.y >= all.min.y && middle.y <= all.max.y;
}

// The points of roofs near the highest one, if they form a line along x or y.
std::optional<Box3d> ridgeOf(const volume::SemanticVolume& volume, std::span<const LabelExtent> extents,
                             const std::vector<PartRole>& roles, const Box3d& building) {
    std::vector<std::uint8_t> isPart(roles.size(), 0);
    double top = -kInfinity;
    for (std::size_t l = 0; l < roles.size(); ++l) {
        const Box3d& box = extents[l].box;
        if (roles[l] != PartRole::Hull || box.isEmpty() || !isWithin(box, building)) continue;
        if (!isRoof(volume.labels.labels[l])) continue;
        isPart[l] = 1;
        top = std::max(top, box.max.z);
    }
    Box3d ridge;
    const auto& axes = volume.grid.axes();
    for (const auto& triangle : volume.vectors.triangles) {
        if (isPart[triangle.label] == 0) continue;
        for (const std::uint32_t corner : triangle.corners) {
            const Vec3d p = volume.vectors.position(corner, {});
            if (dot(p, axes[2]) >= top - kSameRidge)
                ridge.add(Vec3d{dot(p, axes[0]), dot(p, axes[1]), dot(p, axes[2])});
        }
    }
    if (ridge.isEmpty()) return std::nullopt;
    const Vec3d size = ridge.size();
    const double longer = std::max(size.x, size.y), shorter = std::min(size.x, size.y);
    return longer >= kLeastRidge && longer > 3 * shorter ? std::optional(ridge) : std::nullopt;
}

}  // namespace

MainBuilding findMainBuilding(const volume::SemanticVolume& volume, std::span<const LabelExtent> extents) {
    const std::vector<PartRole> roles = partRoles(volume.labels);
    const auto counts = [&](std::size_t l) {
        return (roles[l] == PartRole::Hull || roles[l] == PartRole::Space) && !extents[l].box.isEmpty();
    };
    Box3d all;
    for (std::size_t l = 0; l < extents.size(); ++l)
        if (counts(l)) all.add(extents[l].box);
    MainBuilding main;
    if (all.isEmpty()) return main;
    CoverMap map(all);
    for (std::size_t l = 0; l < extents.size(); ++l)
        if (counts(l)) map.add(extents[l].box);
    map.divide();
    std::vector<Box3d> boxes(map.parts());
    for (std::size_t l = 0; l < extents.size(); ++l)
        if (counts(l)) boxes[map.partOf(extents[l].box)].add(extents[l].box);
    const auto volumeOf = [](const Box3d& box) {
        const Vec3d size = box.size();
        return box.isEmpty() ? 0.0 : size.x * size.y * size.z;
    };
    main.box = *std::max_element(boxes.begin(), boxes.end(),
                                 [&](const Box3d& a, const Box3d& b) { return volumeOf(a) < volumeOf(b); });
    for (std::size_t l = 0; l < extents.size(); ++l) {
        const Box3d& box = extents[l].box;
        if (box.isEmpty() || !isStair(volume.labels.labels[l]) || box.size().z <= kLowestRoom) continue;
        if (isWithin(box, main.box) && (!main.stair || volumeOf(box) > volumeOf(*main.stair))) main.stair = box;
    }
    main.ridge = ridgeOf(volume, extents, roles, main.box);
    return main;
}

}  // namespace svt::drawing
