#include <svt/field_writers/write_lattice.hpp>

#include <svt/core/temporary_folder_test.hpp>
#include <svt/field_readers/read_fields.hpp>
#include <svt/fields/lattice_nodes.hpp>
#include <svt/volume/sample_volume_test.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace svt::field_writers {
namespace {

using fields::Field;
using svt::test::TemporaryFolder;
using volume::SemanticVolume;
using volume::test::kWorldAxes;

constexpr float kMissing = std::numeric_limits<float>::quiet_NaN();
constexpr std::array<Vec3d, 3> kTurned{Vec3d{0.8, 0.6, 0}, Vec3d{-0.6, 0.8, 0}, Vec3d{0, 0, 1}};

SemanticVolume volumeAlong(const std::array<Vec3d, 3>& axes) {
    return volume::test::emptyVolume({12, 10, 8}, {0.5, 0.25, 1}, {3500000.5, 5400000.25, 110}, axes);
}

// 4 x 3 x 2 nodes at two times; the value of the last node is missing.
Field fieldOf(std::int32_t components, bool isRegular) {
    Field field;
    field.head.name = "warm";
    field.head.unit = "Cel";
    field.head.components = components;
    field.head.times = {0, 60};
    field.head.lattice.size = {4, 3, 2};
    field.head.lattice.first = {1, 0.5, 2};
    field.head.lattice.step = {2, 3, 1};
    if (!isRegular) field.head.lattice.positions = {{{1, 2, 4.5, 6}, {0.5, 3, 7}, {2, 3}}};
    for (int n = 0; n < 2 * components * 24; ++n)
        field.values.push_back(n % 24 == 23 ? kMissing : static_cast<float>(n) / 4);
    return field;
}

class WriteLattice : public testing::Test {
protected:
    // Writes the second time, and reads the file again.
    Field again(const Field& field, const SemanticVolume& volume, const char* name) {
        const auto written = writeLattice(field, volume.grid, 1, folder / name);
        EXPECT_TRUE(written) << (written ? "" : written.error().toString());
        field_readers::FieldReadOptions options;
        options.unit = "Cel";
        options.precision = 0;
        Diagnostics diagnostics;
        auto fields = field_readers::readFields(folder / name, volume, options, diagnostics);
        EXPECT_TRUE(fields) << (fields ? "" : fields.error().toString());
        return fields && fields->size() == 1 ? std::move((*fields)[0]) : Field{};
    }

    static void expectSame(const Field& field, const Field& found) {
        ASSERT_EQ(found.head.lattice.size, field.head.lattice.size);
        EXPECT_EQ(found.head.name, field.head.name);
        for (std::size_t n = 0; n < 24; ++n)
            EXPECT_LT(length(fields::nodeAt(found.head.lattice, n) - fields::nodeAt(field.head.lattice, n)), 1e-6) << n;
        const std::size_t half = field.values.size() / 2;
        ASSERT_EQ(found.values.size(), half);
        for (std::size_t n = 0; n < half; ++n)
            if (n % 24 == 23)
                EXPECT_TRUE(std::isnan(found.values[n])) << n;
            else
                EXPECT_EQ(found.values[n], field.values[half + n]) << n;
    }

    std::string refused(const Field& field, const SemanticVolume& volume, const char* name) {
        const auto written = writeLattice(field, volume.grid, 0, folder / name);
        EXPECT_FALSE(written);
        EXPECT_FALSE(std::filesystem::exists(folder / name));
        return written ? "" : written.error().message();
    }

    TemporaryFolder folder;
};

TEST_F(WriteLattice, RegularLatticesComeBackFromEachFormat) {
    for (const char* name : {"a.vti", "a.vtr", "a.nrrd"}) {
        SCOPED_TRACE(name);
        const Field field = fieldOf(1, true);
        expectSame(field, again(field, volumeAlong(kWorldAxes), name));
    }
}

TEST_F(WriteLattice, RotatedGridsComeBackFromImages) {
    for (const char* name : {"a.vti", "a.nrrd"}) {
        SCOPED_TRACE(name);
        const Field field = fieldOf(1, true);
        expectSame(field, again(field, volumeAlong(kTurned), name));
    }
}

TEST_F(WriteLattice, UnevenStepsComeBackFromRectilinearGrids) {
    const Field field = fieldOf(1, false);
    expectSame(field, again(field, volumeAlong(kWorldAxes), "a.vtr"));
}

TEST_F(WriteLattice, VectorsComeBackAlongTheAxesOfTheWorld) {
    const Field field = fieldOf(3, true);
    expectSame(field, again(field, volumeAlong(kWorldAxes), "a.vti"));
}

TEST_F(WriteLattice, AFormatThatCannotHoldTheFieldIsRefusedWithOneThatCan) {
    EXPECT_EQ(refused(fieldOf(1, false), volumeAlong(kWorldAxes), "a.vti"),
              ".vti cannot hold the field 'warm': the steps of the lattice are uneven; write a .vtr or a .csv");
    EXPECT_EQ(refused(fieldOf(1, true), volumeAlong(kTurned), "a.vtr"),
              ".vtr cannot hold the field 'warm': the grid is rotated; write a .vti");
    EXPECT_EQ(refused(fieldOf(3, true), volumeAlong(kWorldAxes), "a.nrrd"),
              ".nrrd cannot hold the field 'warm': the field is a vector; write a .vti");
    EXPECT_EQ(refused(fieldOf(1, true), volumeAlong(kWorldAxes), "a.png"),
              "'.png' is not a format of fields; write .vti, .vtr or .nrrd");
}

}  // namespace
}  // namespace svt::field_writers
