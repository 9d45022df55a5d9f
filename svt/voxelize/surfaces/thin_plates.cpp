#include <svt/voxelize/surfaces/thin_plates.hpp>

#include <svt/plane/box_tree.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace svt::voxelize {
namespace {

constexpr double kOpposite = -0.99;  // cosine between the two sides of a plate: 8 degrees; a wedge is not a plate
constexpr double kAlmost = 0.99;     // share of the longest component of a normal: equal up to rounding
constexpr std::int32_t kStrip = 32;  // rows at a time
constexpr std::uint64_t kLooks = 34'000'000, kLooksPerFace = 256;
constexpr std::int32_t kSnap = 4;  // quanta by which the snap of corners may bring two sides past each other
constexpr std::int64_t kNoExit = std::numeric_limits<std::int64_t>::max(), kAtEntry = kNoExit - 1;

// Whether two boxes have a part in common; borders do not count.
bool meets(const Box3d& a, const Box3d& b) noexcept {
    return a.min.x < b.max.x && b.min.x < a.max.x && a.min.y < b.max.y && b.min.y < a.max.y && a.min.z < b.max.z &&
           b.min.z < a.max.z;
}

// A face that sample lines along an axis cross.
struct PlateFace {
    ScanTriangle scan;
    Vec3d normal, corner;  // local space; the normal has length 1
    Box3d box;             // rows, columns and heights, in samples
};

// The faces through which lines along an axis enter a solid, if this is their dominant axis, and those through which
// they leave it.
struct Sides {
    std::vector<PlateFace> entries, exits;
};

Sides sidesAcross(const IndexMesh& mesh, const IndexFromLocal& indexFromLocal, int axis) {
    const ScanAxes& axes = kScanAxes[axis];
    const auto& vertices = mesh.mesh->vertices;
    Sides sides;
    for (const mesh::Triangle& triangle : mesh.mesh->triangles) {
        const QuantaPoint &p = mesh.points[triangle.corners[0]], &q = mesh.points[triangle.corners[1]],
                          &r = mesh.points[triangle.corners[2]];
        PlateFace face;
        if (!setUpScan(p, q, r, axes, face.scan)) continue;
        const Vec3d a = vertices[triangle.corners[0]];
        const Vec3d ab = vertices[triangle.corners[1]] - a, ac = vertices[triangle.corners[2]] - a;
        const Vec3d across = cross(ab, ac);
        if (!(length(across) > 0)) continue;
        face.normal = normalized(across);
        face.corner = a;
        const auto [low, high] = std::minmax({p[axes.z], q[axes.z], r[axes.z]});
        face.box = {{double(face.scan.firstRow), double(face.scan.firstColumn), double(low) / kQuanta},
                    {double(face.scan.endRow), double(face.scan.endColumn), double(high + 1) / kQuanta}};
        if (face.scan.sign < 0) {
            sides.exits.push_back(face);
            continue;
        }
        const Vec3d n = cross(indexFromLocal.direction(ab), indexFromLocal.direction(ac));
        const double most = std::max({std::abs(n.x), std::abs(n.y), std::abs(n.z)});
        if (std::abs(n[axis]) >= kAlmost * most) sides.entries.push_back(face);
    }
    return sides;
}

// The first sample strictly above a height, wherever the corners of its triangle lie.
std::int64_t firstSampleOver(std::int64_t height) {
    constexpr std::int64_t kOne = std::int64_t{1} << Height::kBits;
    return ((height - kOne) >> (Height::kBits + kQuantaBits)) + 1;
}

std::int64_t heightAt(const Height& height, std::int32_t row, std::int32_t x) {
    return height.base + height.slopeY * row + height.slopeX * x;
}

struct Missed {
    std::int32_t sample = -1;
    bool isTied = false;  // it lies on a side of the material
};

// The sample nearest to the middle of material without a sample; -1 if it has a sample, or no end.
Missed missedSample(std::int64_t entry, std::int64_t exit, std::int32_t count) {
    constexpr std::int64_t kHalf = std::int64_t{1} << (Height::kBits + kQuantaBits - 1);
    if (exit == kAtEntry) exit = entry;
    if (exit == kNoExit || firstSampleOver(entry) != firstSampleOver(exit)) return {};
    const std::int64_t sample = firstSampleOver(entry + (exit - entry) / 2 - kHalf);
    if (sample < 0 || sample >= count) return {};
    const std::int64_t at = (sample * kQuanta + 1) << Height::kBits, reach = std::int64_t{kSnap} << Height::kBits;
    return {static_cast<std::int32_t>(sample), at >= entry - reach && at <= exit + reach};
}

// The sample lines of one face, and where they leave the solid.
class PlateLines {
public:
    PlateLines(const ScanAxes& axes, Vec3i dimension)
        : axes_(axes),
          rows_(dimension[static_cast<int>(axes.y)]),
          columns_(dimension[static_cast<int>(axes.x)]),
          count_(dimension[static_cast<int>(axes.z)]) {}

    void add(const PlateFace& entry, std::span<const PlateFace* const> exits, const ThinClaims& claims,
             std::vector<ClaimedBox>& boxes) {
        const std::int32_t first = std::max(0, entry.scan.firstRow), end = std::min(rows_, entry.scan.endRow);
        const std::int32_t left = std::max(0, entry.scan.firstColumn), right = std::min(columns_, entry.scan.endColumn);
        if (left >= right) return;
        const auto width = static_cast<std::size_t>(right - left);
        for (std::int32_t strip = first; strip < end; strip += kStrip) {
            const std::int32_t stripEnd = std::min(end, strip + kStrip);
            leaves_.assign(width * static_cast<std::size_t>(stripEnd - strip), kNoExit);
            const auto leave = [&](std::int32_t row, std::int32_t x) -> std::int64_t& {
                return leaves_[width * static_cast<std::size_t>(row - strip) + static_cast<std::size_t>(x - left)];
            };
            for (const PlateFace* exit : exits) markExits(entry, *exit, strip, stripEnd, left, right, leave);
            scanRows(entry.scan, strip, stripEnd, left, right,
                     [&](std::int32_t row, std::int32_t begin, std::int32_t stop) {
                         addRow(entry, row, begin, stop, &leave(row, begin), claims, boxes);
                     });
        }
    }

private:
    // \param exits  of the lines from `begin` on
    void addRow(const PlateFace& entry, std::int32_t row, std::int32_t begin, std::int32_t end,
                const std::int64_t* exits, const ThinClaims& claims, std::vector<ClaimedBox>& boxes) const {
        bool hasTies = false;
        const auto add = [&](bool ties, std::uint32_t claim) {
            addRowOfSamples(axes_, row, begin, end, claim, boxes, [&](std::int32_t x) {
                const Missed missed = missedSample(heightAt(entry.scan.height, row, x), exits[x - begin], count_);
                hasTies = hasTies || missed.isTied;
                return missed.isTied == ties ? missed.sample : -1;
            });
        };
        add(false, claims.thin);
        if (hasTies) add(true, claims.tied);
    }

    // Finds the first exit of each line above the entry; if there is none, an exit that snapping moved to the entry.
    template <class Leave>
    static void markExits(const PlateFace& entry, const PlateFace& exit, std::int32_t firstRow, std::int32_t endRow,
                          std::int32_t left, std::int32_t right, const Leave& leave) {
        constexpr double kThinnest = 1e-7;  // metres
        const std::int64_t reach = std::int64_t{kSnap} << Height::kBits;
        const bool isBehind = dot(entry.normal, entry.corner - exit.corner) > kThinnest;
        scanRows(exit.scan, firstRow, endRow, left, right, [&](std::int32_t row, std::int32_t begin, std::int32_t end) {
            for (std::int32_t x = begin; x < end; ++x) {
                const std::int64_t height = heightAt(exit.scan.height, row, x);
                const std::int64_t chord = height - heightAt(entry.scan.height, row, x);
                if (chord > 0 || (isBehind && chord >= -reach))
                    leave(row, x) = std::min(leave(row, x), chord > 0 ? height : kAtEntry);
            }
        });
    }

    ScanAxes axes_;
    std::int32_t rows_, columns_, count_;
    std::vector<std::int64_t> leaves_;  // height by row and column of a strip
};

}  // namespace

void addInterval(const ScanAxes& axes, std::int32_t row, std::int32_t begin, std::int32_t end, std::int32_t at,
                 std::uint32_t claim, std::vector<ClaimedBox>& boxes) {
    if (axes.z == 2)
        boxes.push_back({row, row + 1, begin, end, at, at + 1, claim});
    else if (axes.z == 0)
        boxes.push_back({row, row + 1, at, at + 1, begin, end, claim});
    else
        boxes.push_back({at, at + 1, row, row + 1, begin, end, claim});
}

void addThinPlates(const IndexMesh& mesh, const IndexFromLocal& indexFromLocal, Vec3i dimension,
                   const ThinClaims& claims, std::vector<ClaimedBox>& boxes) {
    std::uint64_t looks = std::max<std::uint64_t>(kLooks, kLooksPerFace * mesh.mesh->triangles.size());
    std::vector<const PlateFace*> exits;
    for (int axis = 0; axis < 3; ++axis) {
        const Sides sides = sidesAcross(mesh, indexFromLocal, axis);
        std::vector<Box3d> boxesOfExits;
        for (const PlateFace& exit : sides.exits) boxesOfExits.push_back(exit.box);
        const plane::BoxTree places(std::move(boxesOfExits), {.leafSize = 4, .usesCenters = false});
        PlateLines lines(kScanAxes[axis], dimension);
        for (const PlateFace& entry : sides.entries) {
            Box3d behind = entry.box;
            behind.min.z -= double(kSnap) / kQuanta;
            behind.max.z += 1;  // one voxel further
            exits.clear();
            std::uint64_t looked = 0;
            const auto isBehind = [&](const Box3d& box) {
                ++looked;
                return meets(box, behind);
            };
            places.forEach(isBehind, [&](std::uint32_t e) {
                if (dot(sides.exits[e].normal, entry.normal) < kOpposite) exits.push_back(&sides.exits[e]);
            });
            if (!exits.empty()) lines.add(entry, exits, claims, boxes);
            if (looked >= looks) return;
            looks -= looked;
        }
    }
}

}  // namespace svt::voxelize
