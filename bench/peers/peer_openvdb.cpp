#include <bench/peers.hpp>

#include <openvdb/openvdb.h>
#include <openvdb/tools/LevelSetUtil.h>
#include <openvdb/tools/MeshToVolume.h>

#include <algorithm>

namespace svt::bench {
namespace {

// Our mesh in the form required by OpenVDB's meshToVolume; points are already in index space.
struct IndexMesh {
    std::vector<openvdb::Vec3d> points;
    const std::vector<mesh::Triangle>* triangles = nullptr;

    size_t polygonCount() const { return triangles->size(); }
    size_t pointCount() const { return points.size(); }
    size_t vertexCount(size_t) const { return 3; }
    void getIndexSpacePoint(size_t n, size_t v, openvdb::Vec3d& point) const {
        point = points[(*triangles)[n].corners[v]];
    }
};

// meshToVolume with the narrowest band that gives correct signs, one voxel to each side; all cores (TBB). Distances are
// in voxels, since a level set requires cubes. The sign gives the inside.
class OpenVdb final : public SolidPeer {
public:
    OpenVdb() { openvdb::initialize(); }
    std::string name() const override { return "OpenVDB meshToVolume"; }

    void load(const mesh::MeshSet& meshes, const volume::Grid& grid) override {
        grid_ = grid;
        objects_.clear();
        for (const mesh::ObjectMesh& object : meshes.objects) {
            IndexMesh mesh;
            mesh.triangles = &object.triangles;
            for (const Vec3d& vertex : object.vertices) {
                const Vec3d p = grid.indexFromWorld(vertex + meshes.origin);
                mesh.points.emplace_back(p.x, p.y, p.z);
            }
            objects_.push_back(std::move(mesh));
        }
    }

    void run(SolidStep step, std::span<const std::uint32_t> order, std::span<const std::uint16_t> scalars,
             DenseLabels* labels) override {
        if (step == SolidStep::Labels) {
            labels->dimension = grid_.dimension();
            labels->scalars.assign(static_cast<std::size_t>(grid_.sampleCount()), 0);
        }
        const auto identity = openvdb::math::Transform::createLinearTransform(1.0);
        for (const std::uint32_t o : order) {
            const auto distances = openvdb::tools::meshToVolume<openvdb::FloatGrid>(objects_[o], *identity, 1.0f, 1.0f);
            if (step == SolidStep::Inside) continue;
            const auto mask = openvdb::tools::sdfInteriorMask(*distances);
            if (step == SolidStep::Labels) paint(*mask, scalars[o], *labels);
        }
    }

private:
    static void paint(const openvdb::BoolGrid& mask, std::uint16_t scalar, DenseLabels& labels) {
        const Vec3i n = labels.dimension;
        const std::size_t nx = static_cast<std::size_t>(n.x), ny = static_cast<std::size_t>(n.y);
        for (auto inside = mask.cbeginValueOn(); inside; ++inside) {
            openvdb::CoordBBox box;
            inside.getBoundingBox(box);
            box.intersect({{0, 0, 0}, {n.x - 1, n.y - 1, n.z - 1}});
            if (box.empty()) continue;
            for (int k = box.min().z(); k <= box.max().z(); ++k)
                for (int j = box.min().y(); j <= box.max().y(); ++j) {
                    std::uint16_t* row =
                        labels.scalars.data() + nx * (static_cast<std::size_t>(j) + ny * static_cast<std::size_t>(k));
                    std::fill(row + box.min().x(), row + box.max().x() + 1, scalar);
                }
        }
    }

    volume::Grid grid_;
    std::vector<IndexMesh> objects_;
};

}  // namespace

Peer<SolidPeer> makeOpenVdb() { return {std::make_unique<OpenVdb>(), {}}; }

}  // namespace svt::bench
