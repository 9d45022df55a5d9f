#include <svt/render/face_model.hpp>
#include <svt/render/faces/face_data.hpp>

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

namespace svt::render {
namespace {

using Triangles = std::span<const volume::VectorParts::Triangle>;

// Whether each edge is used as often in one direction as in the other.
bool isClosed(Triangles triangles) {
    struct Edge {
        std::uint32_t low, high;
        int use;
    };
    std::vector<Edge> edges;
    edges.reserve(3 * triangles.size());
    for (const auto& triangle : triangles)
        for (std::size_t c = 0; c < 3; ++c) {
            const std::uint32_t from = triangle.corners[c], to = triangle.corners[(c + 1) % 3];
            if (from == to) continue;
            edges.push_back({std::min(from, to), std::max(from, to), from < to ? 1 : -1});
        }
    std::sort(edges.begin(), edges.end(),
              [](const Edge& a, const Edge& b) { return a.low != b.low ? a.low < b.low : a.high < b.high; });
    for (std::size_t n = 0; n < edges.size();) {
        int sum = 0;
        const Edge& first = edges[n];
        for (; n < edges.size() && edges[n].low == first.low && edges[n].high == first.high; ++n) sum += edges[n].use;
        if (sum != 0) return false;
    }
    return !triangles.empty();
}

// How many times as thick as a body must be to be as thick as a voxel; 1 for thicker ones. Its mean thickness is twice its
// volume over its area.
double thickeningOf(const volume::VectorParts& parts, Triangles triangles, double voxel) {
    double area = 0, volume = 0;
    for (const auto& triangle : triangles) {
        const Vec3d base = toDouble(parts.points[triangles.front().corners[0]]);
        const auto corner = [&](std::size_t c) { return toDouble(parts.points[triangle.corners[c]]) - base; };
        const Vec3d across = cross(corner(1) - corner(0), corner(2) - corner(0)) * 0.5;
        area += length(across);
        volume += dot(corner(0), across) / 3;
    }
    const double thickness = area > 0 ? 2 * std::abs(volume) / area * parts.unit : 0;
    return thickness > 0 ? std::max(1.0, voxel / thickness) : 1;
}

enum class Source : std::uint8_t { None, Voxels, Solid, Sheet, Skin, Material };

// The solids whose material is that of thematic bodies: of the solids above such a surface (its room, its building),
// the one of the lowest priority. If a surface has no triangles, or a pattern, voxels divide the material.
void findMaterials(const std::vector<volume::Label>& labels, std::span<const std::uint32_t> order,
                   std::vector<Source>& sources) {
    std::vector<std::size_t> placeOf(labels.size(), 0);
    for (std::size_t place = 0; place < order.size(); ++place) placeOf[order[place]] = place;
    const auto materialOf = [&](std::uint32_t l) {
        std::uint32_t found = volume::kNoLabel;
        for (std::uint32_t up = labels[l].parent; up != volume::kNoLabel; up = labels[up].parent)
            if ((sources[up] == Source::Solid || sources[up] == Source::Material) &&
                (found == volume::kNoLabel || placeOf[up] > placeOf[found]))
                found = up;
        return found;
    };
    std::vector<std::uint32_t> materials(labels.size(), volume::kNoLabel);
    std::vector<char> isByVoxels(labels.size(), 0);
    for (std::uint32_t l = 0; l < labels.size(); ++l) {
        if (labels[l].filling != volume::Filling::Body || labels[l].count == 0) continue;
        materials[l] = materialOf(l);
        if (materials[l] == volume::kNoLabel) {
            sources[l] = Source::Voxels;
            continue;
        }
        sources[materials[l]] = Source::Material;
        if (sources[l] != Source::Skin) isByVoxels[materials[l]] = 1;
    }
    for (std::uint32_t l = 0; l < labels.size(); ++l) {
        if (materials[l] == volume::kNoLabel || isByVoxels[materials[l]] == 0) continue;
        sources[l] = Source::Voxels;
        sources[materials[l]] = Source::Voxels;
    }
}

// From what each label gets its points.
std::vector<Source> sourcesOf(const volume::SemanticVolume& volume, std::span<const std::uint32_t> order) {
    const std::vector<volume::Label>& labels = volume.labels.labels;
    std::vector<Source> sources(labels.size(), Source::None);
    for (std::uint32_t l = 0; l < labels.size(); ++l) {
        const volume::Label& label = labels[l];
        if (label.count == 0 || label.filling == volume::Filling::None) continue;
        sources[l] = Source::Voxels;
        if (label.count != 1) continue;
        const Triangles triangles = volume::trianglesOf(volume.vectors, l);
        if (volume::hasClosedMesh(label.filling) && isClosed(triangles)) sources[l] = Source::Solid;
        if (label.filling == volume::Filling::Surface && !triangles.empty()) sources[l] = Source::Sheet;
        if (label.filling == volume::Filling::Body && !triangles.empty()) sources[l] = Source::Skin;
    }
    findMaterials(labels, order, sources);
    // Surfaces on a body of voxels would lie up to half a voxel inside of it.
    for (std::uint32_t l = 0; l < labels.size(); ++l) {
        if (sources[l] != Source::Sheet) continue;
        std::uint32_t up = labels[l].parent;
        while (up != volume::kNoLabel && (sources[up] == Source::None || sources[up] == Source::Sheet))
            up = labels[up].parent;
        if (up != volume::kNoLabel && sources[up] == Source::Voxels) sources[l] = Source::Voxels;
    }
    return sources;
}

}  // namespace

Vec3d FaceModel::Data::worldNormal(std::uint32_t triangle) const noexcept {
    const Vec3d index = tree.normal(triangle);
    Vec3d normal{};
    for (int axis = 0; axis < 3; ++axis)
        normal = normal + grid.axes()[static_cast<std::size_t>(axis)] * (index[axis] / grid.spacing()[axis]);
    return normalized(normal);
}

FaceModel::FaceModel(std::unique_ptr<Data> data) : data_(std::move(data)) {}
FaceModel::~FaceModel() = default;

std::size_t FaceModel::sizeBytes() const noexcept {
    return data_->tree.sizeBytes() + data_->objects.size() * sizeof(Data::Object) +
           data_->objectOfVoxels.size() * (sizeof(std::uint32_t) + 1);
}

std::uint64_t FaceModel::scalarCount() const noexcept { return data_->objectOfVoxels.size(); }

Result<std::unique_ptr<FaceModel>> FaceModel::make(const volume::SemanticVolume& volume,
                                                   std::span<const std::uint32_t> order) {
    const volume::VectorParts& parts = volume.vectors;
    if (parts.triangles.empty())
        return Error(Code::BadArgument,
                     "the volume was built without meshes; build it with 'svt build --vectors meshes', or give the "
                     "model itself");
    auto data = std::make_unique<Data>();
    data->grid = volume.grid;
    const std::vector<Source> sources = sourcesOf(volume, order);
    data->objectOfVoxels.assign(volume.labels.scalarCount(), Data::kNobody);
    data->isSkinScalar.assign(volume.labels.scalarCount(), 0);
    Counts counts;
    const Vec3d spacing = volume.grid.spacing();
    const double voxel = std::max({spacing.x, spacing.y, spacing.z});
    std::vector<FaceTriangle> triangles;
    for (const std::uint32_t l : order) {
        if (l >= sources.size() || sources[l] == Source::None) continue;
        const volume::Label& label = volume.labels.labels[l];
        const auto object = static_cast<std::uint32_t>(data->objects.size());
        const bool isSolid = sources[l] == Source::Solid || sources[l] == Source::Material;
        data->objects.push_back({label.first, isSolid, sources[l] == Source::Material, sources[l] == Source::Skin});
        if (sources[l] == Source::Voxels) {
            ++counts.byVoxels;
            data->hasVoxels = true;
            std::fill_n(data->objectOfVoxels.begin() + label.first, label.count, object);
            continue;
        }
        ++(isSolid ? counts.solids : counts.sheets);
        if (sources[l] == Source::Solid)
            data->objects.back().thickening = thickeningOf(parts, volume::trianglesOf(parts, l), voxel);
        if (sources[l] == Source::Skin) data->isSkinScalar[label.first] = 1;
        for (const auto& triangle : volume::trianglesOf(parts, l)) triangles.push_back({triangle.corners, object});
    }
    counts.triangles = triangles.size();
    std::vector<Vec3d> points;
    points.reserve(parts.points.size());
    for (std::uint32_t p = 0; p < parts.points.size(); ++p)
        points.push_back(volume.grid.indexFromWorld(parts.position(p, volume.grid.origin())) + Vec3d{0.5, 0.5, 0.5});
    data->tree = FaceTree(std::move(points), std::move(triangles));
    std::unique_ptr<FaceModel> model(new FaceModel(std::move(data)));
    model->counts_ = counts;
    return model;
}

}  // namespace svt::render
