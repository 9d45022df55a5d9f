#include <svt/pipeline/vector_parts.hpp>

#include <svt/core/parallel.hpp>
#include <svt/mesh/feature_edges.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace svt::pipeline {
namespace {

constexpr double kReach = 200'000;  // metres

// The unit in which all points fit 31 bits.
double unitFor(const mesh::MeshSet& meshes, std::span<const model::Polyline> lines, Vec3d fromGrid) {
    double reach = 0;
    for (const model::Polyline& line : lines)
        for (const Vec3d& point : line.points) {
            const Vec3d place = point - meshes.origin + fromGrid;
            reach = std::max({reach, std::abs(place.x), std::abs(place.y), std::abs(place.z)});
        }
    for (const mesh::ObjectMesh& mesh : meshes.objects)
        for (const Vec3d& vertex : mesh.vertices) {
            const Vec3d place = vertex + fromGrid;
            reach = std::max({reach, std::abs(place.x), std::abs(place.y), std::abs(place.z)});
        }
    double unit = volume::VectorParts::kFinestUnit;
    while (unit < volume::VectorParts::kCoarsestUnit && reach > unit * double(1 << 30)) unit *= 2;
    return unit;
}

// Parts of one object; its points are numbered in order of first use.
class ObjectParts {
public:
    ObjectParts(const mesh::ObjectMesh& mesh, Vec3d fromGrid, double unit)
        : mesh_(mesh), fromGrid_(fromGrid), unit_(unit) {}

    void addEdges() {
        for (const mesh::FeatureEdge& edge : mesh::findFeatureEdges(mesh_))
            parts_.segments.push_back({0, {pointOf(edge.from), pointOf(edge.to)}});
    }
    void addTriangles() {
        for (const mesh::Triangle& triangle : mesh_.triangles)
            parts_.triangles.push_back(
                {0, {pointOf(triangle.corners[0]), pointOf(triangle.corners[1]), pointOf(triangle.corners[2])}});
    }
    [[nodiscard]] bool isInReach() const noexcept { return isInReach_; }
    [[nodiscard]] const volume::VectorParts& parts() const noexcept { return parts_; }

private:
    static constexpr std::uint32_t kUnused = 0xFFFFFFFFu;

    std::uint32_t pointOf(std::uint32_t vertex) {
        if (numbers_.empty()) numbers_.assign(mesh_.vertices.size(), kUnused);
        std::uint32_t& number = numbers_[vertex];
        if (number != kUnused) return number;
        number = static_cast<std::uint32_t>(parts_.points.size());
        Vec3i& point = parts_.points.emplace_back();
        for (int axis = 0; axis < 3; ++axis) {
            const double place = mesh_.vertices[vertex][axis] + fromGrid_[axis];
            isInReach_ = isInReach_ && std::abs(place) <= kReach;
            if (isInReach_) point[axis] = static_cast<std::int32_t>(std::lround(place / unit_));
        }
        return number;
    }

    const mesh::ObjectMesh& mesh_;
    Vec3d fromGrid_;
    double unit_;
    std::vector<std::uint32_t> numbers_;
    volume::VectorParts parts_;
    bool isInReach_ = true;
};

void append(const volume::VectorParts& from, std::uint32_t label, volume::VectorParts& to) {
    const auto first = static_cast<std::uint32_t>(to.points.size());
    to.points.insert(to.points.end(), from.points.begin(), from.points.end());
    for (const auto& segment : from.segments)
        to.segments.push_back({label, {segment.ends[0] + first, segment.ends[1] + first}});
    for (const auto& triangle : from.triangles)
        to.triangles.push_back(
            {label, {triangle.corners[0] + first, triangle.corners[1] + first, triangle.corners[2] + first}});
}

// Reserves space for all triangles, because growing would temporarily hold two copies.
void reserve(const mesh::MeshSet& meshes, volume::VectorParts& parts) {
    std::size_t points = 0;
    for (const mesh::ObjectMesh& mesh : meshes.objects) points += mesh.vertices.size();
    parts.points.reserve(points);
    parts.triangles.reserve(meshes.triangleCount());
}

// The same for lines; false if a point is out of reach.
bool appendLines(const LabelledLines& lines, Vec3d gridOrigin, volume::VectorParts& to) {
    for (std::size_t l = 0; l < lines.lines.size(); ++l) {
        const std::vector<Vec3d>& points = lines.lines[l].points;
        if (points.size() < 2) continue;
        for (std::size_t i = 0; i < points.size(); ++i) {
            Vec3i& point = to.points.emplace_back();
            for (int axis = 0; axis < 3; ++axis) {
                const double place = points[i][axis] - gridOrigin[axis];
                if (!(std::abs(place) <= kReach)) return false;
                point[axis] = static_cast<std::int32_t>(std::lround(place / to.unit));
            }
            const auto last = static_cast<std::uint32_t>(to.points.size() - 1);
            if (i > 0 && to.points[last] != to.points[last - 1])
                to.segments.push_back({lines.labels[l], {last - 1, last}});
        }
    }
    return true;
}

}  // namespace

Result<volume::VectorParts> makeVectorParts(const mesh::MeshSet& meshes, std::span<const std::uint32_t> labelOfObject,
                                            const volume::Grid& grid, VectorChoice choice, LabelledLines lines,
                                            int threads) {
    volume::VectorParts all;
    if (choice.isNone()) return all;
    const Vec3d fromGrid = meshes.origin - grid.origin();
    if (!choice.edges) lines = {};
    all.unit = unitFor(meshes, lines.lines, fromGrid);
    std::vector<std::uint32_t> order(meshes.objects.size());
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return labelOfObject[a] < labelOfObject[b]; });
    if (choice.meshes) reserve(meshes, all);
    // In groups, so that parts are not in memory twice.
    constexpr std::size_t kBatch = 4096;
    bool areInReach = true;
    for (std::size_t first = 0; first < order.size() && areInReach; first += kBatch) {
        std::vector<ObjectParts> objects;
        for (std::size_t n = first; n < std::min(order.size(), first + kBatch); ++n)
            objects.emplace_back(meshes.objects[order[n]], fromGrid, all.unit);
        parallelFor(objects.size(), 8, threads, [&](std::size_t begin, std::size_t end) {
            for (std::size_t o = begin; o < end; ++o) {
                // Triangles first: points numbered in their order take the least space in a file.
                if (choice.meshes) objects[o].addTriangles();
                if (choice.edges) objects[o].addEdges();
            }
        });
        areInReach =
            std::all_of(objects.begin(), objects.end(), [](const ObjectParts& object) { return object.isInReach(); });
        for (std::size_t o = 0; o < objects.size() && areInReach; ++o)
            append(objects[o].parts(), labelOfObject[order[first + o]], all);
    }
    if (areInReach) {
        const std::size_t edges = all.segments.size();
        if (appendLines(lines, grid.origin(), all)) {
            if (all.segments.size() > edges)
                std::stable_sort(all.segments.begin(), all.segments.end(),
                                 [](const auto& a, const auto& b) { return a.label < b.label; });
            return all;
        }
    }
    if (!choice.isRequired) return volume::VectorParts{};
    return Error(Code::GridTooLarge,
                 fmt::format("a part lies over {} km from the grid's lower corner, too far for edges and meshes; "
                             "build without them, or split the model",
                             kReach / 1000));
}

}  // namespace svt::pipeline
