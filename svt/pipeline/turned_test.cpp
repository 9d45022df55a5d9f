/// A model that is moved, or turned by 90 or 180 degrees, gets the same labels: the grid by spacing is laid evenly around
/// the model, so its samples are moved and turned alike. Ties aside: where a face passes through samples, it falls to one
/// of its sides; and parts thinner than a voxel aside, which get the nearest sample along lines that hang on how their
/// faces were triangulated.

#include <svt/mesh/mesh_set.hpp>
#include <svt/pipeline/build_volume.hpp>
#include <svt/pipeline/split_faces_test.hpp>
#include <svt/readers/read_model.hpp>
#include <svt/samples/sample.hpp>
#include <svt/volume/dense.hpp>
#include <svt/voxelize/solids_test.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <span>

namespace svt::pipeline {
namespace {

// Counter-clockwise by `quarters` times 90 degrees, without rounding; then moved.
void turnAndMove(model::BuildingModel& model, int quarters, Vec3d shift) {
    for (model::Polygon& polygon : model.polygons)
        for (Vec3d& p : polygon.points) {
            for (int q = 0; q < quarters; ++q) p = {-p.y, p.x, p.z};
            p = p + shift;
        }
}

// Where a sample of a grid with `n` samples is after the turn.
Vec3i turnedSample(Vec3i v, Vec3i n, int quarters) {
    for (int q = 0; q < quarters; ++q) {
        v = {n.y - 1 - v.y, v.x, v.z};
        n = {n.y, n.x, n.z};
    }
    return v;
}

// Faces of a model by place.
class Faces {
public:
    explicit Faces(const model::BuildingModel& model) : meshes_(*mesh::buildMeshes(model)) {
        for (const mesh::ObjectMesh& object : meshes_.objects) oracles_.emplace_back(object);
    }

    // Whether a face passes so close to the sample, or to one beside it, that the side it is on is open.
    [[nodiscard]] bool isTie(Vec3i v, const volume::Grid& grid) const {
        for (const Vec3i& step : {Vec3i{0, 0, 0}, {1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}})
            if (isOnFace(v + step, grid)) return true;
        return false;
    }

private:
    [[nodiscard]] bool isOnFace(Vec3i v, const volume::Grid& grid) const {
        constexpr double kNear = 1.0 / 128;  // voxels
        const Vec3d local = grid.worldFromIndex({double(v.x), double(v.y), double(v.z)}) - meshes_.origin;
        const Vec3d margin = grid.spacing() * kNear;
        for (std::size_t o = 0; o < oracles_.size(); ++o) {
            const Box3d& bounds = meshes_.objects[o].bounds;
            if (!Box3d{bounds.min - margin, bounds.max + margin}.contains(local)) continue;
            if (oracles_[o].distance(local, grid.spacing()) < kNear) return true;
        }
        return false;
    }

    mesh::MeshSet meshes_;
    std::vector<test::SolidOracle> oracles_;
};

// Read once for all tests of a process.
const model::BuildingModel& sampleModel(samples::SampleKind kind) {
    static std::map<samples::SampleKind, model::BuildingModel> read;
    const auto [place, isNew] = read.try_emplace(kind);
    if (!isNew) return place->second;
    samples::SampleOptions options;
    options.storeys = 2;
    const auto text = samples::writeSample(kind, samples::SampleFormat::CityGml3, options);
    EXPECT_TRUE(text);
    auto model = readers::readModel(std::as_bytes(std::span(*text)), "sample.gml");
    EXPECT_TRUE(model);
    if (model) place->second = std::move(*model);
    return place->second;
}

struct Difference {
    std::uint64_t voxels = 0, ties = 0, wrong = 0;
    std::map<std::pair<std::string, std::string>, std::uint64_t> pairs;  // of the wrong ones
};

Difference differenceOf(const BuildOutput& straight, const BuildOutput& turned, int quarters, const Faces& faces) {
    Difference difference;
    const volume::Grid& grid = straight.volume.grid;
    const Vec3i n = grid.dimension();
    const std::vector<std::uint32_t> labelOf = straight.volume.labels.labelOfScalar();
    const auto name = [&](volume::Scalar s) {
        return s == 0 ? std::string("air") : straight.volume.labels.labels[labelOf[s]].id;
    };
    const auto before = *volume::toDense<std::uint16_t>(straight.volume.columns),
               after = *volume::toDense<std::uint16_t>(turned.volume.columns);
    const std::int32_t nx = turned.volume.grid.dimension().x, ny = turned.volume.grid.dimension().y;
    std::size_t at = 0;
    for (std::int32_t k = 0; k < n.z; ++k)
        for (std::int32_t j = 0; j < n.y; ++j)
            for (std::int32_t i = 0; i < n.x; ++i) {
                const Vec3i v = turnedSample({i, j, k}, n, quarters);
                const volume::Scalar
                    a = before[at++],
                    b = after[std::size_t(v.x) +
                              std::size_t(nx) * (std::size_t(v.y) + std::size_t(ny) * std::size_t(v.z))];
                difference.voxels += a != 0;
                if (a == b) continue;
                if (faces.isTie({i, j, k}, grid)) {
                    ++difference.ties;
                    continue;
                }
                ++difference.wrong;
                ++difference.pairs[{name(a), name(b)}];
            }
    return difference;
}

// The largest share of voxels that are ties and changed, over all ways to move and turn the model.
double compare(samples::SampleKind kind, BuildOptions options) {
    model::BuildingModel model = sampleModel(kind);
    const Faces faces(model);
    const auto straight = buildVolume(model, options);
    EXPECT_TRUE(straight);
    if (!straight) return 1;
    double ties = 0;
    for (const auto& [quarters, shift] :
         {std::pair{0, Vec3d{458877.3, 5438353.7, 120.1}}, {1, Vec3d{}}, {2, Vec3d{}}, {3, Vec3d{-7.2, 3.1, -0.4}}}) {
        model::BuildingModel moved = sampleModel(kind);
        turnAndMove(moved, quarters, shift);
        const auto turned = buildVolume(moved, options);
        EXPECT_TRUE(turned);
        if (!turned) return 1;
        Vec3i n = straight->volume.grid.dimension();
        if (quarters % 2 == 1) std::swap(n.x, n.y);
        EXPECT_EQ(turned->volume.grid.dimension(), n);
        if (turned->volume.grid.dimension() != n) return 1;
        const Difference d = differenceOf(*straight, *turned, quarters, faces);
        if (options.keepThinParts) {
            EXPECT_LT(double(d.wrong), 0.0002 * double(d.voxels)) << "turned " << quarters << " times";
        } else {
            EXPECT_EQ(d.wrong, 0u) << "of " << d.voxels << ", turned " << quarters << " times, moved by " << shift.x
                                   << ", the first of " << (d.wrong == 0 ? "" : d.pairs.begin()->first.first);
        }
        ties = std::max(ties, double(d.ties) / double(d.voxels));
    }
    return ties;
}

BuildOptions withSpacing(double spacing, bool keepThinParts) {
    BuildOptions options;
    options.spacing = Vec3d{spacing, spacing, spacing};
    options.keepThinParts = keepThinParts;
    return options;
}

TEST(TurnedModels, HouseKeepsItsLabels) {
    for (const bool thin : {false, true}) {
        EXPECT_LT(compare(samples::SampleKind::House, withSpacing(0.05, thin)), 0.002) << thin;
        EXPECT_LT(compare(samples::SampleKind::House, withSpacing(0.0731, thin)), 0.0001) << thin;
    }
}

TEST(TurnedModels, TowerKeepsItsLabels) {
    for (const bool thin : {false, true})
        EXPECT_LT(compare(samples::SampleKind::Tower, withSpacing(0.0731, thin)), 0.0001) << thin;
}

// Voxels that are another component's, at least: half the sum of how much the counts of all components differ.
double shareOfCounts(const volume::LabelTable& straight, const volume::LabelTable& other) {
    EXPECT_EQ(straight.labels.size(), other.labels.size());
    if (straight.labels.size() != other.labels.size()) return 1;
    double all = 0, differing = 0;
    for (std::size_t l = 0; l < straight.labels.size(); ++l) {
        const auto before = double(straight.labels[l].voxels), after = double(other.labels[l].voxels);
        all += before;
        differing += std::abs(before - after);
    }
    return 0.5 * differing / all;
}

// What docs/user/build.md promises of ties, at spacings of which many have faces of the house on their samples.
TEST(TurnedModels, CountsStayWithinTheBoundThatIsPromised) {
    for (const double spacing : {0.05, 0.0731, 0.1, 0.15, 0.2, 0.25}) {
        model::BuildingModel model = sampleModel(samples::SampleKind::House);
        const auto straight = buildVolume(model, withSpacing(spacing, true));
        ASSERT_TRUE(straight);
        for (int quarters = 1; quarters < 4; ++quarters) {
            model::BuildingModel moved = sampleModel(samples::SampleKind::House);
            turnAndMove(moved, quarters, {});
            const auto turned = buildVolume(moved, withSpacing(spacing, true));
            ASSERT_TRUE(turned);
            EXPECT_LT(shareOfCounts(straight->volume.labels, turned->volume.labels), 0.01)
                << "spacing " << spacing << ", turned " << quarters << " times";
        }
        model::BuildingModel split = sampleModel(samples::SampleKind::House);
        test::splitFaces(split);
        const auto other = buildVolume(split, withSpacing(spacing, true));
        ASSERT_TRUE(other);
        EXPECT_LT(shareOfCounts(straight->volume.labels, other->volume.labels), 0.01)
            << "spacing " << spacing << ", faces split";
    }
}

}  // namespace
}  // namespace svt::pipeline
