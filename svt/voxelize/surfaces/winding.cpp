#include <svt/voxelize/surfaces/winding.hpp>

#include <svt/core/parallel.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <tuple>

namespace svt::voxelize {
namespace {

constexpr double kPi = std::numbers::pi;

// Signed solid angle of the spherical triangle of three unit vectors (Van Oosterom & Strackee 1983).
double solidAngle(Vec3d a, Vec3d b, Vec3d c) noexcept {
    return 2 * std::atan2(dot(a, cross(b, c)), 1 + dot(a, b) + dot(b, c) + dot(c, a));
}

double distanceToSegment(Vec3d p, Vec3d a, Vec3d b) noexcept {
    const Vec3d ab = b - a;
    const double squared = dot(ab, ab);
    const double t = squared > 0 ? std::clamp(dot(p - a, ab) / squared, 0.0, 1.0) : 0.0;
    return length(p - (a + ab * t));
}

// The open edges of the shell.
struct OpenEdges {
    std::vector<std::pair<Vec3d, Vec3d>> edges;  // directed as in the mesh, local space
    double totalLength = 0;

    // Winding number of the curtains (see winding.hpp) at p, and the distance of the nearest edge.
    [[nodiscard]] double windingBelow(Vec3d p, double& nearest) const noexcept {
        const Vec3d down{0, 0, -1};
        double sum = 0;
        nearest = 1e300;
        for (const auto& [from, to] : edges) {
            sum += solidAngle(normalized(to - p), normalized(from - p), down);
            nearest = std::min(nearest, distanceToSegment(p, from, to));
        }
        return sum / (4 * kPi);
    }
};

struct Crossing {
    std::int32_t i, k, winding;
};

// Samples [begin, end) along each axis.
struct SampleRange {
    Vec3i begin, end;
    [[nodiscard]] bool isEmpty() const noexcept { return begin.x >= end.x || begin.y >= end.y || begin.z >= end.z; }
};

// The samples inside the bounding box of a mesh. From outside it the shell is seen within a half-space, so the winding
// number stays below 1/2 there.
SampleRange samplesAround(const IndexMesh& mesh, Vec3i dimension) {
    QuantaPoint low{INT32_MAX, INT32_MAX, INT32_MAX}, high{INT32_MIN, INT32_MIN, INT32_MIN};
    for (const QuantaPoint& point : mesh.points)
        for (std::size_t axis = 0; axis < 3; ++axis) {
            low[axis] = std::min(low[axis], point[axis]);
            high[axis] = std::max(high[axis], point[axis]);
        }
    SampleRange range;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto sample = [&](std::int32_t quanta) {
            return std::clamp<std::int32_t>(static_cast<std::int32_t>(firstSampleAbove(quanta)), 0,
                                            dimension[int(axis)]);
        };
        range.begin[int(axis)] = sample(low[axis]);
        range.end[int(axis)] = sample(high[axis]);
    }
    return range;
}

// What all rows of samples share.
struct FillInput {
    const volume::Grid& grid;
    Vec3d origin;  // of local space
    SampleRange range;
    std::uint32_t claim;
    OpenEdges openEdges;
    std::vector<ScanTriangle> triangles;
    double step;  // metres between samples of a column

    FillInput(const IndexMesh& mesh, const mesh::MeshSet& meshes, const volume::Grid& sampleGrid, SampleRange samples,
              std::uint32_t claimNumber)
        : grid(sampleGrid),
          origin(meshes.origin),
          range(samples),
          claim(claimNumber),
          step(std::max(1e-12, length(sampleGrid.worldFromIndexDirection({0, 0, 1})))) {
        for (const mesh::OpenEdge& edge : mesh.mesh->openEdges) {
            openEdges.edges.emplace_back(mesh.mesh->vertices[edge.from], mesh.mesh->vertices[edge.to]);
            openEdges.totalLength += length(openEdges.edges.back().second - openEdges.edges.back().first);
        }
        for (const mesh::Triangle& triangle : mesh.mesh->triangles) {
            ScanTriangle scan;
            if (setUpScan(mesh.points[triangle.corners[0]], mesh.points[triangle.corners[1]],
                          mesh.points[triangle.corners[2]], kScanAxes[2], scan))
                triangles.push_back(scan);
        }
    }
};

// Fills the columns of one row of samples, j. Belongs to one thread.
class RowFill {
public:
    explicit RowFill(const FillInput& input) : in_(input) {}

    // Adds the runs inside the shell to `boxes`.
    // \return samples whose winding number is between 1/4 and 3/4
    std::uint64_t fill(std::int32_t j, std::vector<ClaimedBox>& boxes) {
        findCrossings(j);
        std::uint64_t uncertain = 0;
        std::size_t begin = 0;
        for (std::int32_t i = in_.range.begin.x; i < in_.range.end.x; ++i) {
            while (begin < crossings_.size() && crossings_[begin].i < i) ++begin;
            std::size_t end = begin;
            while (end < crossings_.size() && crossings_[end].i == i) ++end;
            uncertain += fillColumn({i, j, 0}, std::span(crossings_).subspan(begin, end - begin), boxes);
            begin = end;
        }
        return uncertain;
    }

private:
    void findCrossings(std::int32_t j) {
        crossings_.clear();
        for (const ScanTriangle& t : in_.triangles)
            scanRows(
                t, j, j + 1, in_.range.begin.x, in_.range.end.x, [&](std::int32_t, std::int32_t from, std::int32_t to) {
                    for (std::int32_t i = from; i < to; ++i)
                        crossings_.push_back(
                            {i, sampleAbove(t, t.height.base + t.height.slopeX * i + t.height.slopeY * j), -t.sign});
                });
        std::sort(crossings_.begin(), crossings_.end(),
                  [](const Crossing& p, const Crossing& q) { return std::tie(p.i, p.k) < std::tie(q.i, q.k); });
    }

    // One column, whose crossings are `crossings`, from below.
    std::uint64_t fillColumn(Vec3i at, std::span<const Crossing> crossings, std::vector<ClaimedBox>& boxes) const {
        std::uint64_t uncertain = 0;
        std::size_t c = 0;
        int above = 0;  // signed crossings of the upward ray from the current sample
        for (const Crossing& crossing : crossings) above += crossing.winding;
        std::int32_t begin = -1;
        const auto close = [&](std::int32_t end) {
            if (begin >= 0) boxes.push_back({at.y, at.y + 1, at.x, at.x + 1, begin, end, in_.claim});
            begin = -1;
        };
        for (std::int32_t k = in_.range.begin.z; k < in_.range.end.z;) {
            for (; c < crossings.size() && crossings[c].k <= k; ++c) above -= crossings[c].winding;
            const std::int32_t limit = c < crossings.size() ? std::max(crossings[c].k, k + 1) : in_.range.end.z;
            const auto [winding, next] = windingAt({at.x, at.y, k}, above, std::min(limit, in_.range.end.z));
            if (winding > 0.25 && winding < 0.75) uncertain += std::uint64_t(next - k);
            if (winding >= 0.5 && begin < 0) begin = k;
            if (!(winding >= 0.5)) close(k);
            k = next;
        }
        close(in_.range.end.z);
        return uncertain;
    }

    // The winding number at a sample, and the next sample of the column, at most `limit`, where it may be on the other
    // side of 1/2: it cannot change faster than the open edges are long and near.
    struct WindingStep {
        double winding;
        std::int32_t next;
    };
    [[nodiscard]] WindingStep windingAt(Vec3i sample, int above, std::int32_t limit) const {
        constexpr double kShift = 1.0 / double(kQuanta);
        const Vec3d index{sample.x + kShift, sample.y + kShift, sample.z + kShift};
        double nearest = 0;
        const double winding = above - in_.openEdges.windingBelow(in_.grid.worldFromIndex(index) - in_.origin, nearest);
        const double reach = std::min(nearest / 2, std::abs(winding - 0.5) * kPi * nearest * nearest /
                                                       std::max(in_.openEdges.totalLength, 1e-300));
        const std::int32_t next = sample.z + 1 + static_cast<std::int32_t>(std::min(reach / in_.step, 1e6));
        return {winding, std::min(next, limit)};
    }

    const FillInput& in_;
    std::vector<Crossing> crossings_;  // of the row, by column and height
};

}  // namespace

double windingNumber(const mesh::ObjectMesh& mesh, Vec3d point) noexcept {
    double sum = 0;
    for (const mesh::Triangle& triangle : mesh.triangles)
        sum += solidAngle(normalized(mesh.vertices[triangle.corners[0]] - point),
                          normalized(mesh.vertices[triangle.corners[1]] - point),
                          normalized(mesh.vertices[triangle.corners[2]] - point));
    return sum / (4 * kPi);
}

std::uint64_t addWindingFill(const IndexMesh& mesh, const mesh::MeshSet& meshes, const volume::Grid& grid,
                             std::uint32_t claim, int threads, std::vector<ClaimedBox>& boxes) {
    const SampleRange range = samplesAround(mesh, grid.dimension());
    if (range.isEmpty()) return 0;
    const FillInput input(mesh, meshes, grid, range, claim);
    const std::size_t rows = std::size_t(range.end.y - range.begin.y);
    std::vector<std::vector<ClaimedBox>> rowBoxes(rows);
    std::vector<std::uint64_t> rowUncertain(rows, 0);
    parallelFor(rows, 1, threads, [&](std::size_t beginRow, std::size_t endRow) {
        RowFill fill(input);
        for (std::size_t row = beginRow; row < endRow; ++row)
            rowUncertain[row] = fill.fill(range.begin.y + static_cast<std::int32_t>(row), rowBoxes[row]);
    });
    std::uint64_t uncertain = 0;
    for (std::size_t row = 0; row < rows; ++row) {
        uncertain += rowUncertain[row];
        boxes.insert(boxes.end(), rowBoxes[row].begin(), rowBoxes[row].end());
    }
    return uncertain;
}

}  // namespace svt::voxelize
