#include <svt/field_readers/read_fields.hpp>

#include <svt/field_readers/fds/case_frame.hpp>
#include <svt/field_readers/fds/fds_case_test.hpp>
#include <svt/volume/sample_volume_test.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace svt::field_readers {
namespace {

using svt::test::TemporaryFolder;
using test::evenNodes;
using test::FdsCase;

double ramp(Vec3d at, double time) { return at.x + 10 * at.y + 100 * at.z + 1000 * time; }

// Voxels of 0.5 m; world space from (0, 0, 0) to (10, 10, 5).
volume::SemanticVolume house() { return volume::test::emptyVolume({20, 20, 10}, {0.5, 0.5, 0.5}, {0.25, 0.25, 0.25}); }

struct Read {
    std::vector<fields::Field> fields;
    Diagnostics diagnostics;
    std::optional<Error> error;

    [[nodiscard]] const fields::Field* find(std::string_view name) const {
        for (const fields::Field& field : fields)
            if (field.head.name == name) return &field;
        return nullptr;
    }
    [[nodiscard]] bool says(std::string_view text) const {
        for (const Diagnostic& item : diagnostics.items())
            if (item.message.find(text) != std::string::npos) return true;
        return false;
    }
};

Read read(const std::filesystem::path& path, const FieldReadOptions& options = {},
          const volume::SemanticVolume& volume = house()) {
    Read result;
    auto fields = readFields(path, volume, options, result.diagnostics);
    if (fields)
        result.fields = std::move(*fields);
    else
        result.error = fields.error();
    return result;
}

// The node's place in world space, of a volume along the axes of the world.
Vec3d placeOf(const fields::Lattice& lattice, const volume::Grid& grid, Vec3i node) {
    Vec3d index;
    for (int axis = 0; axis < 3; ++axis) {
        const auto& positions = lattice.positions[static_cast<std::size_t>(axis)];
        index[axis] = positions.empty() ? lattice.first[axis] + lattice.step[axis] * node[axis]
                                        : positions[static_cast<std::size_t>(node[axis])];
    }
    return grid.worldFromIndex(index);
}

// Whether each node has the value of `ramp` at its place, given by `local` of world space.
template <class Local>
void expectRamp(const fields::Field& field, const volume::Grid& grid, const Local& local) {
    const Vec3i size = field.head.lattice.size;
    std::size_t at = 0;
    for (const double time : field.head.times)
        for (std::int32_t k = 0; k < size.z; ++k)
            for (std::int32_t j = 0; j < size.y; ++j)
                for (std::int32_t i = 0; i < size.x; ++i, ++at)
                    ASSERT_NEAR(field.values[at], ramp(local(placeOf(field.head.lattice, grid, {i, j, k})), time), 2e-3)
                        << i << " " << j << " " << k << " " << time;
    EXPECT_EQ(at, field.values.size());
}

void expectRamp(const fields::Field& field, const volume::Grid& grid) {
    expectRamp(field, grid, [](Vec3d world) { return world; });
}

TEST(Fds, JoinsMeshesToOneLattice) {
    const TemporaryFolder folder;
    FdsCase fds(folder.path());
    for (int m = 0; m < 4; ++m) {
        const double x = m % 2 * 5, y = m / 2 * 5;
        fds.addMesh({"Mesh", {evenNodes(x, x + 5, 10), evenNodes(y, y + 5, 5), evenNodes(0, 5, 5)}});
    }
    for (std::size_t m = 0; m < 4; ++m)
        fds.addSlice(m, "SLCF", "TEMPERATURE", "C", {0, 10, 0, 5, 0, 5}, {0, 1, 2}, ramp);
    const Read result = read(fds.save());
    ASSERT_FALSE(result.error) << result.error->toString();
    ASSERT_EQ(result.fields.size(), 1u);
    const fields::FieldHead& head = result.fields[0].head;
    EXPECT_EQ(head.name, "temperature");
    EXPECT_EQ(head.unit, "Cel");
    EXPECT_EQ(head.medium, "air");
    EXPECT_EQ(head.by, "FDS-6.9.1-test");
    EXPECT_EQ(head.times, (std::vector<double>{0, 1, 2}));
    EXPECT_EQ(head.lattice.size, (Vec3i{21, 11, 6}));
    EXPECT_EQ(head.lattice.first, (Vec3d{-0.5, -0.5, -0.5}));
    EXPECT_EQ(head.lattice.step, (Vec3d{1, 2, 2}));
    EXPECT_TRUE(head.lattice.positions[0].empty());
    EXPECT_GT(head.precision, 0);
    EXPECT_TRUE(result.says("count as world coordinates"));
    EXPECT_NE(head.parameters.find("world coordinates"), std::string::npos);
    expectRamp(result.fields[0], house().grid);
}

TEST(Fds, KeepsStretchedNodes) {
    const TemporaryFolder folder;
    FdsCase fds(folder.path());
    const std::vector<double> z{0, 0.25, 0.75, 1.75, 3.75};
    fds.addMesh({"A", {evenNodes(0, 5, 4), evenNodes(0, 4, 4), z}});
    fds.addMesh({"B", {evenNodes(5, 10, 8), evenNodes(0, 4, 4), z}});
    fds.addSlice(0, "SLCF", "TEMPERATURE", "C", {0, 4, 0, 4, 0, 4}, {0}, ramp);
    fds.addSlice(1, "SLCF", "TEMPERATURE", "C", {0, 8, 0, 4, 0, 4}, {0}, ramp);
    const Read result = read(fds.save());
    ASSERT_FALSE(result.error) << result.error->toString();
    ASSERT_EQ(result.fields.size(), 1u);
    const fields::Lattice& lattice = result.fields[0].head.lattice;
    EXPECT_EQ(lattice.size, (Vec3i{13, 5, 5}));
    ASSERT_EQ(lattice.positions[2].size(), 5u);
    EXPECT_NEAR(lattice.positions[2][3], 3.0, 1e-9);  // 1.75 m
    expectRamp(result.fields[0], house().grid);
}

TEST(Fds, MeshesThatDoNotAgreeBecomeFields) {
    const TemporaryFolder folder;
    FdsCase fds(folder.path());
    // Different cells along y, where both lie.
    fds.addMesh({"Coarse", {evenNodes(0, 5, 5), evenNodes(0, 5, 5), evenNodes(0, 5, 5)}});
    fds.addMesh({"Fine", {evenNodes(5, 10, 5), evenNodes(0, 5, 7), evenNodes(0, 5, 5)}});
    fds.addSlice(0, "SLCF", "TEMPERATURE", "C", {0, 5, 0, 5, 0, 5}, {0}, ramp);
    fds.addSlice(1, "SLCF", "TEMPERATURE", "C", {0, 5, 0, 7, 0, 5}, {0}, ramp);
    // A box and a plane of one number.
    fds.addSlice(0, "SLCF", "DENSITY", "kg/m3", {0, 3, 0, 5, 0, 5}, {0}, ramp, 2);
    fds.addSlice(1, "SLCF", "DENSITY", "kg/m3", {0, 5, 0, 0, 0, 5}, {0}, ramp, 2);
    const Read result = read(fds.save());
    ASSERT_FALSE(result.error) << result.error->toString();
    ASSERT_NE(result.find("temperature.coarse"), nullptr);
    ASSERT_NE(result.find("temperature.fine"), nullptr);
    EXPECT_TRUE(result.says("have no common lattice"));
    EXPECT_EQ(result.fields.size(), 4u);
    for (const fields::Field& field : result.fields) expectRamp(field, house().grid);
}

TEST(Fds, SpaceBetweenMeshesIsNotInterpolated) {
    const TemporaryFolder folder;
    FdsCase fds(folder.path());
    fds.addMesh({"A", {evenNodes(0, 2, 2), evenNodes(0, 5, 5), evenNodes(0, 5, 5)}});
    fds.addMesh({"B", {evenNodes(6, 8, 2), evenNodes(0, 5, 5), evenNodes(0, 5, 5)}});
    fds.addSlice(0, "SLCF", "TEMPERATURE", "C", {0, 2, 0, 5, 0, 5}, {0}, ramp);
    fds.addSlice(1, "SLCF", "TEMPERATURE", "C", {0, 2, 0, 5, 0, 5}, {0}, ramp);
    const Read result = read(fds.save());
    ASSERT_FALSE(result.error) << result.error->toString();
    EXPECT_EQ(result.fields.size(), 2u);
}

TEST(Fds, PlanesHaveOneNodeAcross) {
    const TemporaryFolder folder;
    FdsCase fds(folder.path());
    fds.addMesh({"A", {evenNodes(0, 5, 10), evenNodes(0, 5, 5), evenNodes(0, 5, 5)}});
    fds.addMesh({"B", {evenNodes(5, 10, 10), evenNodes(0, 5, 5), evenNodes(0, 5, 5)}});
    for (const std::size_t m : {std::size_t{0}, std::size_t{1}})
        fds.addSlice(m, "SLCF", "TEMPERATURE", "C", {0, 10, 2, 2, 0, 5}, {0, 1}, ramp);
    fds.addSlice(0, "SLCF", "TEMPERATURE", "C", {0, 10, 0, 5, 1, 1}, {0, 1}, ramp, 2);
    const Read result = read(fds.save());
    ASSERT_FALSE(result.error) << result.error->toString();
    ASSERT_EQ(result.fields.size(), 2u);
    const fields::Field* across = result.find("temperature_y2");
    ASSERT_NE(across, nullptr);
    EXPECT_EQ(across->head.lattice.size, (Vec3i{21, 1, 6}));
    expectRamp(*across, house().grid);
    const fields::Field* level = result.find("temperature_z1");
    ASSERT_NE(level, nullptr);
    EXPECT_EQ(level->head.lattice.size, (Vec3i{11, 6, 1}));
    expectRamp(*level, house().grid);
}

TEST(Fds, CellsAreAtTheirCentresWithoutGhosts) {
    const TemporaryFolder folder;
    FdsCase fds(folder.path());
    fds.addMesh({"A", {evenNodes(0, 5, 10), evenNodes(0, 5, 5), evenNodes(0, 5, 5)}});
    fds.addMesh({"B", {evenNodes(5, 10, 10), evenNodes(0, 5, 5), evenNodes(0, 5, 5)}});
    for (const std::size_t m : {std::size_t{0}, std::size_t{1}})
        fds.addSlice(m, "SLCC", "TEMPERATURE", "C", {0, 10, 0, 5, 0, 5}, {0}, ramp);
    const Read result = read(fds.save());
    ASSERT_FALSE(result.error) << result.error->toString();
    ASSERT_EQ(result.fields.size(), 1u);
    EXPECT_EQ(result.fields[0].head.lattice.size, (Vec3i{20, 5, 5}));
    EXPECT_EQ(result.fields[0].head.lattice.first, (Vec3d{0, 0.5, 0.5}));
    expectRamp(result.fields[0], house().grid);
}

TEST(Fds, CutFilesAreReadInPart) {
    const TemporaryFolder folder;
    FdsCase fds(folder.path());
    fds.addMesh({"A", {evenNodes(0, 5, 5), evenNodes(0, 5, 5), evenNodes(0, 5, 5)}});
    fds.addMesh({"B", {evenNodes(5, 10, 5), evenNodes(0, 5, 5), evenNodes(0, 5, 5)}});
    fds.addSlice(0, "SLCF", "TEMPERATURE", "C", {0, 5, 0, 5, 0, 5}, {0, 1, 2}, ramp);
    const auto cut = fds.addSlice(1, "SLCF", "TEMPERATURE", "C", {0, 5, 0, 5, 0, 5}, {0, 1, 2}, ramp);
    const std::string all = svt::test::readText(cut);
    svt::test::writeText(cut, all.substr(0, all.size() - 7));
    const Read result = read(fds.save());
    ASSERT_FALSE(result.error) << result.error->toString();
    ASSERT_EQ(result.fields.size(), 1u);
    EXPECT_EQ(result.fields[0].head.times.size(), 2u);
    EXPECT_EQ(result.diagnostics.count(Code::FieldInPart), 2u);
    EXPECT_TRUE(result.says("ends within the frame at byte"));
    EXPECT_TRUE(result.says("2 whole frames are read, the last at 1 s"));
    EXPECT_TRUE(result.says("the first 2 are read"));
    expectRamp(result.fields[0], house().grid);
}

TEST(Fds, MissingFilesAndEmptyFilesAreNamed) {
    const TemporaryFolder folder;
    FdsCase fds(folder.path());
    fds.addMesh({"A", {evenNodes(0, 5, 5), evenNodes(0, 5, 5), evenNodes(0, 5, 5)}});
    const auto gone = fds.addSlice(0, "SLCF", "TEMPERATURE", "C", {0, 5, 0, 5, 0, 5}, {0}, ramp);
    fds.addSlice(0, "SLCF", "VELOCITY", "m/s", {0, 5, 0, 5, 0, 5}, {}, ramp, 2);
    std::filesystem::remove(gone);
    const Read result = read(fds.save());
    ASSERT_TRUE(result.error);
    EXPECT_EQ(result.error->code(), Code::BadField);
    EXPECT_TRUE(result.says("the file of 'TEMPERATURE' is missing"));
    EXPECT_TRUE(result.says("has no frames yet"));
}

TEST(Fds, ReadsSmokeAndPrefersTheSlice) {
    const TemporaryFolder folder;
    FdsCase fds(folder.path());
    fds.addMesh({"A", {evenNodes(0, 5, 10), evenNodes(0, 5, 5), evenNodes(0, 5, 5)}});
    const auto level = [](Vec3d at, double) { return std::floor(at.x * 2) * 25; };
    fds.addSmoke(0, "SOOT DENSITY", "kg/m3", 8700, {0, 1}, level);
    fds.addSmoke(0, "TEMPERATURE", "C", 0, {0, 1}, level);
    fds.addSmoke(0, "HRRPUV", "kW/m3", 0, {0, 1}, [](Vec3d, double) { return 254; });
    fds.addSlice(0, "SLCF", "TEMPERATURE", "C", {0, 10, 0, 5, 0, 5}, {0, 1}, ramp);
    fds.addText("PRT5     1\n house_1.prt5\n");
    const Read result = read(fds.save());
    ASSERT_FALSE(result.error) << result.error->toString();
    ASSERT_EQ(result.fields.size(), 3u);
    const fields::Field* soot = result.find("soot_density");
    ASSERT_NE(soot, nullptr);
    EXPECT_EQ(soot->head.unit, "kg/m3");
    for (std::size_t i = 0; i < 11; ++i)
        EXPECT_NEAR(std::exp(-8700 * 0.5 * double{soot->values[i]}), 1 - 25.0 * double(i) / 254, 1e-6);
    expectRamp(*result.find("temperature"), house().grid);
    EXPECT_TRUE(result.says("8-bit values of 'TEMPERATURE' (SMOKF3D) are left out"));
    EXPECT_TRUE(result.says("'hrrpuv': 792 values are at the upper end"));
    EXPECT_TRUE(result.says("left out: 1 PRT5"));
}

TEST(Fds, TakesThePlaceFromTheCommentOfTheWriter) {
    const TemporaryFolder folder;
    FdsCase fds(folder.path());
    fds.addMesh({"A", {evenNodes(0, 4, 4), evenNodes(0, 3, 3), evenNodes(0, 5, 5)}});
    fds.addSlice(0, "SLCF", "TEMPERATURE", "C", {0, 4, 0, 3, 0, 5}, {0}, ramp);
    svt::test::writeText(
        folder / "house.fds",
        "&HEAD CHID='house' /\n\nGeometry by SVT. Metres from (458877.0550, 5438353.6500, -0.2667) along "
        "(0.6, 0.8, 0) and (-0.8, 0.6, 0); CRS: unknown\n");
    const auto volume = volume::test::emptyVolume({20, 20, 10}, {0.5, 0.5, 0.5}, {458877.005, 5438354.0, -0.0167},
                                                  {Vec3d{0.6, 0.8, 0}, Vec3d{-0.8, 0.6, 0}, Vec3d{0, 0, 1}});
    const Vec3d corner{458877.055, 5438353.65, -0.2667};
    const Read result = read(fds.save(), {}, volume);
    ASSERT_FALSE(result.error) << result.error->toString();
    ASSERT_EQ(result.fields.size(), 1u);
    EXPECT_FALSE(result.says("world coordinates"));
    EXPECT_NE(result.fields[0].head.parameters.find("comment in house.fds"), std::string::npos);
    expectRamp(result.fields[0], volume.grid, [&](Vec3d world) {
        const Vec3d apart = world - corner;
        return Vec3d{dot(apart, Vec3d{0.6, 0.8, 0}), dot(apart, Vec3d{-0.8, 0.6, 0}), apart.z};
    });
    // Without the comment, the axes of the world are those of the case, and the grid is turned.
    std::filesystem::remove(folder / "house.fds");
    FieldReadOptions options;
    options.at = corner;
    const Read turned = read(folder / "house.smv", options, volume);
    ASSERT_TRUE(turned.error);
    EXPECT_EQ(turned.error->code(), Code::BadArgument);
    EXPECT_NE(turned.error->message().find("turned by 36.9 degrees"), std::string::npos) << turned.error->message();
}

TEST(Fds, AxesThatAreSwappedAndMirroredKeepTheirValues) {
    const TemporaryFolder folder;
    FdsCase fds(folder.path());
    fds.addMesh({"A", {std::vector<double>{0, 1, 3, 4}, evenNodes(0, 3, 6), evenNodes(0, 5, 5)}});
    fds.addSlice(0, "SLCF", "TEMPERATURE", "C", {0, 3, 0, 6, 0, 5}, {0, 1}, ramp);
    // x of the case points along -y of the world, and y along x.
    svt::test::writeText(folder / "house.fds", "Metres from (2, 8, 0) along (0, -1, 0) and (1, 0, 0); CRS: unknown\n");
    const Read result = read(fds.save());
    ASSERT_FALSE(result.error) << result.error->toString();
    EXPECT_EQ(result.fields[0].head.lattice.size, (Vec3i{7, 4, 6}));
    expectRamp(result.fields[0], house().grid, [](Vec3d world) { return Vec3d{8 - world.y, world.x - 2, world.z}; });
}

TEST(Fds, ReadsOnlyWholeComments) {
    EXPECT_FALSE(frameOfComment("Metres from (1, 2) along (1, 0, 0) and (0, 1, 0)"));
    EXPECT_FALSE(frameOfComment("Metres from (1, 2, 3) along (1, 1, 0) and (0, 1, 0)"));
    EXPECT_FALSE(frameOfComment("Metres from (1, 2, 3) along (1, 0, 0) and (1, 0, 0)"));
    EXPECT_FALSE(frameOfComment("Metres from (1, 2, 3)"));
    const auto frame = frameOfComment("x Metres from (1, -2e1, 3.5) along (1, 0, 0) and (0, 1, 0); CRS");
    ASSERT_TRUE(frame);
    EXPECT_EQ(frame->origin, (Vec3d{1, -20, 3.5}));
}

TEST(Fds, FieldsOutsideNameBothBoxes) {
    const TemporaryFolder folder;
    FdsCase fds(folder.path());
    fds.addMesh({"A", {evenNodes(100, 104, 4), evenNodes(0, 3, 3), evenNodes(0, 5, 5)}});
    fds.addSlice(0, "SLCF", "TEMPERATURE", "C", {0, 4, 0, 3, 0, 5}, {0}, ramp);
    const Read result = read(fds.save());
    ASSERT_TRUE(result.error);
    EXPECT_EQ(result.error->code(), Code::FieldOutside);
    EXPECT_NE(result.error->message().find("(100.000, 0.000, 0.000) to (104.000, 3.000, 5.000)"), std::string::npos);
    EXPECT_NE(result.error->message().find("(0.000, 0.000, 0.000) to (10.000, 10.000, 5.000)"), std::string::npos);
    FieldReadOptions options;
    options.at = Vec3d{-99, 1, 0};
    const Read moved = read(folder / "house.smv", options);
    ASSERT_FALSE(moved.error);
    expectRamp(moved.fields[0], house().grid, [](Vec3d world) { return world + Vec3d{99, -1, 0}; });
}

TEST(Fds, ChoosesTimesAndQuantities) {
    const TemporaryFolder folder;
    FdsCase fds(folder.path());
    fds.addMesh({"A", {evenNodes(0, 4, 4), evenNodes(0, 3, 3), evenNodes(0, 5, 5)}});
    fds.addSlice(0, "SLCF", "TEMPERATURE", "C", {0, 4, 0, 3, 0, 5}, {0, 0.5, 1, 1.5, 2, 2.5, 3}, ramp);
    fds.addSlice(0, "SLCF", "VELOCITY", "m/s", {0, 4, 0, 3, 0, 5}, {0, 1, 2}, ramp, 2);
    const auto path = fds.save();
    FieldReadOptions options;
    options.quantity = "Temperature";
    options.firstTime = 0.5;
    options.lastTime = 2.5;
    options.timeStep = 1;
    const Read result = read(path, options);
    ASSERT_FALSE(result.error) << result.error->toString();
    ASSERT_EQ(result.fields.size(), 1u);
    EXPECT_EQ(result.fields[0].head.times, (std::vector<double>{0.5, 1.5, 2.5}));
    expectRamp(result.fields[0], house().grid);
    options.quantity = "SMOKE";
    const Read unknown = read(path, options);
    ASSERT_TRUE(unknown.error);
    EXPECT_NE(unknown.error->message().find("it has: TEMPERATURE, VELOCITY"), std::string::npos);
    options.quantity.clear();
    options.firstTime = 10;
    options.lastTime = 20;
    const Read late = read(path, options);
    ASSERT_TRUE(late.error);
    EXPECT_EQ(late.error->code(), Code::BadArgument);
    EXPECT_NE(late.error->message().find("7 times from 0 s to 3 s"), std::string::npos) << late.error->message();
}

TEST(Fds, BoundsTheMemory) {
    const TemporaryFolder folder;
    FdsCase fds(folder.path());
    fds.addMesh({"A", {evenNodes(0, 4, 4), evenNodes(0, 3, 3), evenNodes(0, 5, 5)}});
    fds.addSlice(0, "SLCF", "TEMPERATURE", "C", {0, 4, 0, 3, 0, 5}, {0, 1, 2, 3}, ramp);
    FieldReadOptions options;
    options.maxBytes = 5 * 4 * 6 * 3 * 4;
    const Read result = read(fds.save(), options);
    ASSERT_TRUE(result.error);
    EXPECT_EQ(result.error->code(), Code::InputTooBig);
    EXPECT_NE(result.error->message().find("--every"), std::string::npos);
    options.lastTime = 2;
    EXPECT_FALSE(read(folder / "house.smv", options).error);
}

TEST(Fds, ConvertsOnlyTemperatures) {
    const TemporaryFolder folder;
    FdsCase fds(folder.path());
    fds.addMesh({"A", {evenNodes(0, 4, 4), evenNodes(0, 3, 3), evenNodes(0, 5, 5)}});
    fds.addSlice(0, "SLCF", "TEMPERATURE", "C", {0, 4, 0, 3, 0, 5}, {0}, ramp);
    const auto path = fds.save();
    FieldReadOptions options;
    options.unit = "K";
    const Read kelvin = read(path, options);
    ASSERT_FALSE(kelvin.error);
    EXPECT_EQ(kelvin.fields[0].head.unit, "K");
    EXPECT_FLOAT_EQ(kelvin.fields[0].values[1], 274.15f);
    EXPECT_NE(kelvin.fields[0].head.parameters.find("converted from Cel to K"), std::string::npos);
    options.unit = "m/s";
    const Read other = read(path, options);
    ASSERT_TRUE(other.error);
    EXPECT_EQ(other.error->code(), Code::BadArgument);
}

TEST(Fds, ReadsDevicesAsPoints) {
    const TemporaryFolder folder;
    FdsCase fds(folder.path());
    fds.addMesh({"A", {evenNodes(0, 4, 4), evenNodes(0, 3, 3), evenNodes(0, 5, 5)}});
    fds.addText(
        "CSVF\n devc\n house_devc.csv\n\nDEVICE\n T, kitchen % TEMPERATURE\n 1.0 2.0 3.0 0 0 -1  0  0 % null\n\n"
        "DEVICE\n far % TEMPERATURE\n 100.0 2.0 3.0 0 0 -1  0  0 % null\n");
    svt::test::writeText(folder / "house_devc.csv",
                         "s,C,C,kW\nTime,\"T, kitchen\",\"far\",\"total\"\n 0.0E+000, 2.0E+001, 20, 1\n"
                         " 1.0E+000, 2.5E+001, 21, 2\n 2.0E+000, 3.0E+001, 22, 3");
    const Read result = read(fds.save());
    ASSERT_FALSE(result.error) << result.error->toString();
    ASSERT_EQ(result.fields.size(), 1u);
    const fields::Field& field = result.fields[0];
    EXPECT_EQ(field.head.name, "devices_temperature");
    EXPECT_EQ(field.head.kind, fields::FieldKind::Points);
    ASSERT_EQ(field.head.points.size(), 2u);
    EXPECT_EQ(field.head.points[0].id, "T, kitchen");
    EXPECT_EQ(field.head.points[0].at, (Vec3d{1, 2, 3}));
    EXPECT_EQ(field.head.times, (std::vector<double>{0, 1}));
    EXPECT_EQ(field.values, (std::vector<float>{20, 20, 25, 21}));
    EXPECT_TRUE(result.says("the table ends within line 5: 2 whole rows"));
    EXPECT_TRUE(result.says("1 devices have no place"));
    EXPECT_TRUE(result.says("1 of 2 points lie outside of the volume: 'far'"));
}

TEST(Fds, DamagedListsNameTheLine) {
    const TemporaryFolder folder;
    const auto error = [&](std::string_view text) {
        svt::test::writeText(folder / "x.smv", text);
        const Read result = read(folder / "x.smv");
        return result.error ? result.error->toString() : std::string("none");
    };
    EXPECT_NE(error("GRID A\n 0 1 1\n").find("x.smv:2: GRID"), std::string::npos) << error("GRID A\n 0 1 1\n");
    EXPECT_NE(error("GRID A\n 1 1 1\nTRNX\n 0\n 0 1.0\n 1 0.5\n").find("x.smv:6: TRN"), std::string::npos);
    EXPECT_NE(error("PDIM\n 0 1 0 1 0 1\n").find("PDIM"), std::string::npos);
    EXPECT_NE(error("GRID A\n 1 1 1\nPDIM\n 0 1 0 1 0 1\nSLCF 2 # & 0 1 0 1 0 1\n a\n b\n c\n d\n").find("mesh 2"),
              std::string::npos);
    EXPECT_NE(error("GRID A\n 1 1 1\n").find("neither bounds"), std::string::npos);
    EXPECT_NE(error("").find("no slices"), std::string::npos);
}

}  // namespace
}  // namespace svt::field_readers
