/// A model that is moved, or turned by 90 or 180 degrees, gets the same labels: the grid by spacing is laid evenly around
/// the model, so its samples are moved and turned alike. Ties aside: where a face passes through samples, it falls to one
/// of its sides; and parts thinner than a voxel aside, which get the nearest sample along lines that hang on how their
/// faces were triangulated.

#include <svt/mesh/mesh_set.hpp>
#include <svt/model/classes.hpp>
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
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

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
const model::BuildingModel& sampleModel(samples::SampleKind kind,
                                        samples::SampleFormat format = samples::SampleFormat::CityGml3) {
    static std::map<std::pair<samples::SampleKind, samples::SampleFormat>, model::BuildingModel> read;
    const auto [place, isNew] = read.try_emplace({kind, format});
    if (!isNew) return place->second;
    samples::SampleOptions options;
    options.storeys = 2;
    const auto text = samples::writeSample(kind, format, options);
    EXPECT_TRUE(text);
    auto model = readers::readModel(std::as_bytes(std::span(*text)),
                                    format == samples::SampleFormat::Ifc4 ? "sample.ifc" : "sample.gml");
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

// A way to give the same model again.
struct Way {
    const char* name = "";
    int quarters = 0;
    Vec3d shift{};
    bool splitsFaces = false;
    Vec3i moreSamples{};  // before the first of the grid; its samples stay where they are
};
constexpr Way kWays[] = {
    {.name = "turned once", .quarters = 1},
    {.name = "turned twice", .quarters = 2},
    {.name = "turned three times", .quarters = 3},
    {.name = "moved", .shift = {458877.3, 5438353.7, 120.1}},
    {.name = "split", .splitsFaces = true},
    {.name = "turned, moved and split", .quarters = 3, .shift = {-7.2, 3.1, -0.4}, .splitsFaces = true},
    {.name = "in a larger grid", .moreSamples = {3, 5, 2}}};

// The component of a label: a frame, leaf or pane is a phase of its door or window.
std::uint32_t componentOf(const volume::LabelTable& table, std::uint32_t label) {
    return model::isPhase(table.labels[label].className) ? table.labels[label].parent : label;
}

// The components of all scalars; that of the background is kNoLabel.
std::vector<std::uint32_t> componentsOf(const volume::LabelTable& table) {
    std::vector<std::uint32_t> components = table.labelOfScalar();
    for (std::uint32_t& label : components)
        if (label != volume::kNoLabel) label = componentOf(table, label);
    return components;
}

// Samples that have another component than before: by label, how many lost it and how many gained it.
struct Changes {
    std::uint64_t voxels = 0, changed = 0;
    std::vector<std::uint64_t> lost, gained;
    [[nodiscard]] double share() const { return double(changed) / double(voxels); }
};

Changes changesBetween(const volume::SemanticVolume& straight, const volume::SemanticVolume& other, const Way& way) {
    Changes changes;
    changes.lost.resize(straight.labels.labels.size());
    changes.gained.resize(straight.labels.labels.size());
    const std::vector<std::uint32_t> labelOf = componentsOf(straight.labels);
    const auto before = *volume::toDense<std::uint16_t>(straight.columns),
               after = *volume::toDense<std::uint16_t>(other.columns);
    const Vec3i n = straight.grid.dimension(), m = other.grid.dimension();
    std::size_t at = 0;
    for (std::int32_t k = 0; k < n.z; ++k)
        for (std::int32_t j = 0; j < n.y; ++j)
            for (std::int32_t i = 0; i < n.x; ++i) {
                const Vec3i v = turnedSample({i, j, k}, n, way.quarters) + way.moreSamples;
                const volume::Scalar
                    a = before[at++],
                    b = after[std::size_t(v.x) +
                              std::size_t(m.x) * (std::size_t(v.y) + std::size_t(m.y) * std::size_t(v.z))];
                changes.voxels += a != 0;
                if (labelOf[a] == labelOf[b]) continue;
                ++changes.changed;
                if (a != 0) ++changes.lost[labelOf[a]];
                if (b != 0) ++changes.gained[labelOf[b]];
            }
    return changes;
}

std::optional<volume::SemanticVolume> rebuilt(const model::BuildingModel& model, const volume::SemanticVolume& straight,
                                              const Way& way, BuildOptions options) {
    model::BuildingModel changed = model;
    turnAndMove(changed, way.quarters, way.shift);
    if (way.splitsFaces) test::splitFaces(changed);
    Vec3i n = straight.grid.dimension();
    if (way.moreSamples != Vec3i{}) {
        const volume::Grid& grid = straight.grid;
        n = n + way.moreSamples * 2;
        const auto larger = volume::Grid::fromParts(
            n, grid.spacing(), grid.origin() - scaled(toDouble(way.moreSamples), grid.spacing()), grid.axes());
        EXPECT_TRUE(larger);
        options.grid = *larger;
    }
    if (way.quarters % 2 == 1) std::swap(n.x, n.y);
    auto built = buildVolume(changed, options);
    EXPECT_TRUE(built) << way.name;
    if (!built) return std::nullopt;
    EXPECT_EQ(built->volume.grid.dimension(), n) << way.name;
    if (built->volume.grid.dimension() != n) return std::nullopt;
    return std::move(built->volume);
}

// Of each label the area of its mesh, m2.
std::vector<double> surfacesOf(const model::BuildingModel& model) {
    model::BuildingModel built = model;
    BuildOptions options = withSpacing(0.5, true);
    options.vectors.meshes = true;
    const auto output = buildVolume(built, options);
    EXPECT_TRUE(output);
    if (!output) return {};
    const volume::VectorParts& parts = output->volume.vectors;
    std::vector<double> surfaces(output->volume.labels.labels.size(), 0);
    for (const volume::VectorParts::Triangle& triangle : parts.triangles) {
        const Vec3d a = parts.position(triangle.corners[0], {}), b = parts.position(triangle.corners[1], {}),
                    c = parts.position(triangle.corners[2], {});
        surfaces[componentOf(output->volume.labels, triangle.label)] += 0.5 * length(cross(b - a, c - a));
    }
    return surfaces;
}

// Limits of the changes.
struct Limits {
    double moved = 0;   // share of all voxels that change if the model is turned or moved
    double split = 0;   // the same if its faces are also split
    double counts = 0;  // share by which the counts of all components differ
    // Of a body, in layers. A layer has one voxel for each square of the spacing on the surface of the body.
    double count = 0;   // by which its count differs
    double layers = 0;  // that it loses and gains
};
// A sheet is one voxel thick. It loses and gains all of its voxels if it moves to the next samples.
constexpr double kLayersOfSheet = 2;

void expectWithin(const Limits& limits, const Changes& changes, const volume::LabelTable& straight,
                  const std::vector<double>& surfaces, double spacing, const std::string& how) {
    ASSERT_EQ(surfaces.size(), straight.labels.size());
    for (std::size_t l = 0; l < surfaces.size(); ++l) {
        const volume::Label& label = straight.labels[l];
        const auto lost = double(changes.lost[l]), gained = double(changes.gained[l]);
        const double layer = surfaces[l] / (spacing * spacing);
        const std::string what = how + ": " + label.id + " has " + std::to_string(label.voxels) + " voxels, loses " +
                                 std::to_string(changes.lost[l]) + ", gains " + std::to_string(changes.gained[l]);
        if (label.filling == volume::Filling::Surface) {
            EXPECT_LE(lost + gained, kLayersOfSheet * layer) << what;
            continue;
        }
        EXPECT_LE(std::abs(lost - gained), limits.count * layer) << what;
        EXPECT_LE(lost + gained, limits.layers * layer) << what;
    }
}

void expectWithin(const Limits& limits, samples::SampleKind kind, samples::SampleFormat format, double spacing) {
    const model::BuildingModel& model = sampleModel(kind, format);
    const std::vector<double> surfaces = surfacesOf(model);
    model::BuildingModel first = model;
    const auto straight = buildVolume(first, withSpacing(spacing, true));
    ASSERT_TRUE(straight);
    for (const Way& way : kWays) {
        const std::string how = "spacing " + std::to_string(spacing) + ", " + way.name;
        const auto other = rebuilt(model, straight->volume, way, withSpacing(spacing, true));
        ASSERT_TRUE(other) << how;
        const Changes changes = changesBetween(straight->volume, *other, way);
        EXPECT_LT(changes.share(), way.splitsFaces ? limits.split : limits.moved) << how;
        EXPECT_LT(shareOfCounts(straight->volume.labels, other->labels), limits.counts) << how;
        expectWithin(limits, changes, straight->volume.labels, surfaces, spacing, how);
    }
}

// docs/user/build.md has these limits. At most of these spacings, faces of the house lie on samples.
constexpr double kSpacings[] = {0.05, 0.1, 0.15, 0.2, 0.25};
constexpr Limits kOfHouse{.moved = 0.01, .split = 0.0125, .counts = 0.01, .count = 0.3, .layers = 0.7};
// The faces of the tower lie on whole decimetres.
constexpr Limits kOfTower{.moved = 0.045, .split = 0.045, .counts = 0.015, .count = 0.5, .layers = 1};
// At a spacing that divides few measures.
constexpr double kOddSpacing = 0.073;
constexpr Limits kOdd{.moved = 0.00015, .split = 0.0006, .counts = 0.0001, .count = 0.1, .layers = 0.2};

TEST(TurnedModels, ComponentsOfTheHouseStayWithinTheBoundsThatArePromised) {
    for (const double spacing : kSpacings)
        expectWithin(kOfHouse, samples::SampleKind::House, samples::SampleFormat::CityGml3, spacing);
    expectWithin(kOdd, samples::SampleKind::House, samples::SampleFormat::CityGml3, kOddSpacing);
}

TEST(TurnedModels, ComponentsOfTheHouseAsIfcStayWithinTheBoundsThatArePromised) {
    for (const double spacing : kSpacings)
        expectWithin(kOfHouse, samples::SampleKind::House, samples::SampleFormat::Ifc4, spacing);
    expectWithin(kOdd, samples::SampleKind::House, samples::SampleFormat::Ifc4, kOddSpacing);
}

TEST(TurnedModels, ComponentsOfTheTowerStayWithinTheBoundsThatArePromised) {
    for (const double spacing : kSpacings)
        expectWithin(kOfTower, samples::SampleKind::Tower, samples::SampleFormat::CityGml3, spacing);
    expectWithin(kOdd, samples::SampleKind::Tower, samples::SampleFormat::CityGml3, kOddSpacing);
}

TEST(TurnedModels, ComponentsOfTheTowerAsIfcStayWithinTheBoundsThatArePromised) {
    for (const double spacing : kSpacings)
        expectWithin(kOfTower, samples::SampleKind::Tower, samples::SampleFormat::Ifc4, spacing);
    expectWithin(kOdd, samples::SampleKind::Tower, samples::SampleFormat::Ifc4, kOddSpacing);
}

}  // namespace
}  // namespace svt::pipeline
