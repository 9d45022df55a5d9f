#include <svt/core/deflate.hpp>
#include <svt/core/temporary_folder_test.hpp>
#include <svt/field_readers/read_fields.hpp>
#include <svt/volume/sample_volume_test.hpp>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace svt::field_readers {
namespace {

namespace fs = std::filesystem;
using fields::Field;
using svt::test::readText;
using svt::test::writeText;

std::string header(std::string_view className, bool isBinary = false, std::string_view more = {}) {
    return "/* a comment */\nFoamFile\n{\n version 2.0; format " + std::string(isBinary ? "binary" : "ascii") +
           ";\n arch \"LSB;label=32;scalar=64\"; class " + std::string(className) + ";" + std::string(more) +
           "\n}\n// *\n";
}

template <class Number>
std::string bytesOf(const std::vector<Number>& numbers) {
    std::string bytes(numbers.size() * sizeof(Number), '\0');
    std::memcpy(bytes.data(), numbers.data(), bytes.size());
    return std::to_string(numbers.size()) + "\n(" + bytes + ")";
}

// Boxes of 0.5 x 1 x 2 m on a lattice of 3 x 2 x 1, of which the cell (1, 0, 0) is missing: five cells in the order
// (0,0), (2,0), (0,1), (1,1), (2,1). Each has its own points and six faces, which is enough for a reader.
class FoamFolder {
public:
    explicit FoamFolder(const fs::path& place, std::string_view note = {}, bool isBinary = false) : folder(place) {
        fs::create_directories(folder / "system");
        fs::create_directories(folder / "constant" / "polyMesh");
        writeText(folder / "system" / "controlDict", header("dictionary"));
        std::vector<double> points;
        std::vector<std::int32_t> starts{0}, labels, owner;
        for (const auto& [i, j] : {std::pair(0, 0), {2, 0}, {0, 1}, {1, 1}, {2, 1}}) {
            const auto first = static_cast<std::int32_t>(points.size() / 3);
            for (int corner = 0; corner < 8; ++corner)
                points.insert(points.end(),
                              {0.5 * (i + (corner & 1)), 1.0 * (j + (corner >> 1 & 1)), 2.0 * (corner >> 2)});
            for (const auto& face :
                 {std::array{0, 2, 6, 4}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 1, 3, 2}, {4, 5, 7, 6}}) {
                for (const int corner : face) labels.push_back(first + corner);
                starts.push_back(static_cast<std::int32_t>(labels.size()));
                owner.push_back(first / 8);
            }
        }
        write("points", "vectorField", note.empty() ? "" : " note \"" + std::string(note) + "\";",
              isBinary ? std::to_string(points.size() / 3) + bytesOf(points).substr(bytesOf(points).find('('))
                       : textOf(points, 3),
              isBinary);
        std::string faces = std::to_string(owner.size()) + "\n(\n";
        for (std::size_t f = 0; f < owner.size(); ++f) {
            faces += "4(";
            for (std::size_t n = 0; n < 4; ++n) faces += std::to_string(labels[4 * f + n]) + (n < 3 ? " " : ")\n");
        }
        if (isBinary)
            write("faces", "faceCompactList", {}, bytesOf(starts) + "\n" + bytesOf(labels), true);
        else
            write("faces", "faceList", {}, faces + ")\n", false);
        write("owner", "labelList", {}, isBinary ? bytesOf(owner) : textOf({owner.begin(), owner.end()}, 1), isBinary);
        write("neighbour", "labelList", {}, "0()", isBinary);
    }

    static std::string textOf(const std::vector<double>& numbers, std::size_t components) {
        std::string text = std::to_string(numbers.size() / components) + "\n(\n";
        for (std::size_t n = 0; n < numbers.size(); ++n) {
            if (components > 1 && n % components == 0) text += '(';
            text += fmt::format("{}", numbers[n]);
            text += components > 1 && n % components == components - 1 ? ")\n" : components > 1 ? " " : "\n";
        }
        return text + ")\n";
    }

    void write(const std::string& name, std::string_view className, std::string_view more, std::string_view content,
               bool isBinary) const {
        writeText(folder / "constant" / "polyMesh" / name, header(className, isBinary, more) + std::string(content));
    }

    void field(const std::string& time, const std::string& name, std::string_view className,
               std::string_view dimensions, std::string_view internal, bool isBinary = false) const {
        fs::create_directories(folder / time);
        writeText(folder / time / name, header(className, isBinary) + "dimensions [" + std::string(dimensions) +
                                            "];\n\ninternalField " + std::string(internal) +
                                            ";\n\nboundaryField\n{\n w { type zeroGradient; }\n}\n");
    }

    fs::path folder;
};

constexpr std::string_view kKelvin = "0 0 0 1 0 0 0";

class ReadFoam : public ::testing::Test {
protected:
    ReadFoam() {
        options.precision = 0;
        options.at = volume.grid.worldFromIndex({-0.5, -0.5, -0.5});
    }

    Field only(const fs::path& path) {
        auto read = readFields(path, volume, options, diagnostics);
        EXPECT_TRUE(read) << (read ? "" : read.error().toString());
        if (!read || read->size() != 1) {
            EXPECT_TRUE(!read || read->size() == 1);
            return {};
        }
        return std::move(read->front());
    }

    std::string messageOf(const fs::path& path, Code code = Code::BadField) {
        const auto read = readFields(path, volume, options, diagnostics);
        EXPECT_FALSE(read);
        if (read) return {};
        EXPECT_EQ(read.error().code(), code) << read.error().toString();
        return read.error().toString();
    }

    // Values in the order of the lattice; NaN as -1.
    static std::vector<float> shown(const Field& field) {
        std::vector<float> values = field.values;
        for (float& value : values)
            if (std::isnan(value)) value = -1;
        return values;
    }

    svt::test::TemporaryFolder folder;
    volume::SemanticVolume volume = volume::test::emptyVolume({3, 2, 2}, {0.5, 1, 2}, {100, 200, 10});
    FieldReadOptions options;
    Diagnostics diagnostics;
};

TEST_F(ReadFoam, CellsAreNodesAndGapsHaveNoValue) {
    const FoamFolder foam(folder / "room");
    foam.field("0", "T", "volScalarField", kKelvin, "uniform 290");
    foam.field("100", "T", "volScalarField", kKelvin,
               "nonuniform List<scalar> \n5\n(\n293.15\n294.123456789\n295\nnan\n297\n)\n");
    for (const char* name : {"", "case.foam"}) {
        if (name[0] != 0) writeText(folder / "room" / name, "");
        const Field field = only(foam.folder / name);
        EXPECT_EQ(field.head.name, "temperature");
        EXPECT_EQ(field.head.unit, "K");
        EXPECT_EQ(field.head.medium, "air");
        EXPECT_EQ(field.head.by, "OpenFOAM");
        EXPECT_EQ(field.head.times, std::vector<double>{100}) << "the time 0 has initial values";
        EXPECT_EQ(field.head.lattice.size, (Vec3i{3, 2, 1}));
        EXPECT_NEAR(length(field.head.lattice.first), 0, 1e-9);
        EXPECT_EQ(shown(field), (std::vector<float>{293.15f, -1, 294.123456789f, 295, -1, 297}));
    }
}

TEST_F(ReadFoam, BinaryFilesHaveTheSameValues) {
    const FoamFolder foam(folder / "room", {}, true);
    const std::vector<double> values{293.15, 294.123456789, 295, -1, 297};
    foam.field("0.5", "T", "volScalarField", kKelvin, "nonuniform List<scalar> " + bytesOf(values), true);
    EXPECT_EQ(shown(only(foam.folder)), (std::vector<float>{293.15f, -1, 294.123456789f, 295, -1, 297}));
}

TEST_F(ReadFoam, VectorsAndTimes) {
    const FoamFolder foam(folder / "room");
    for (const char* time : {"10", "2", "1e+02"})
        foam.field(time, "U", "volVectorField", "0 1 -1 0 0 0 0", "uniform (1 2 " + std::string(time) + ")");
    foam.field("10", "phi", "surfaceScalarField", "0 3 -1 0 0 0 0", "uniform 0");
    options.firstTime = 5;
    const Field field = only(foam.folder);
    EXPECT_EQ(field.head.name, "velocity");
    EXPECT_EQ(field.head.unit, "m/s");
    EXPECT_EQ(field.head.components, 3);
    EXPECT_EQ(field.head.times, (std::vector<double>{10, 100}));
    EXPECT_EQ(shown(field), (std::vector<float>{1, -1, 1, 1, 1, 1, 2, -1, 2, 2, 2, 2, 10,  -1, 10,  10,  10,  10,
                                                1, -1, 1, 1, 1, 1, 2, -1, 2, 2, 2, 2, 100, -1, 100, 100, 100, 100}));
    bool hasNote = false;
    for (const Diagnostic& item : diagnostics.items())
        hasNote |= item.message.find("left out: phi") != std::string::npos;
    EXPECT_TRUE(hasNote);
}

TEST_F(ReadFoam, PartsOfADecomposedCaseAreJoined) {
    const FoamFolder foam(folder / "room");
    foam.field("0", "T", "volScalarField", kKelvin, "uniform 290");
    const std::map<int, std::string> cells{{0, "2\n(\n3\n0\n)\n"}, {1, "3\n(\n1\n2\n4\n)\n"}};
    for (const auto& [n, list] : cells) {
        const fs::path part = foam.folder / ("processor" + std::to_string(n));
        fs::create_directories(part / "constant" / "polyMesh");
        writeText(part / "constant" / "polyMesh" / "cellProcAddressing", header("labelList") + list);
    }
    foam.field("processor0/7", "T", "volScalarField", kKelvin, "nonuniform List<scalar> 2(303 300)");
    foam.field("processor1/7", "T", "volScalarField", kKelvin, "nonuniform List<scalar> 3(301 302 304)");
    foam.field("processor1/8", "T", "volScalarField", kKelvin, "uniform 1");
    const Field field = only(foam.folder);
    EXPECT_EQ(field.head.times, std::vector<double>{7});
    EXPECT_EQ(shown(field), (std::vector<float>{300, -1, 301, 302, 303, 304}));
    EXPECT_EQ(diagnostics.count(Code::FieldInPart), 1u) << "processor0 lacks the time 8";
    // A processor without cells changes nothing, also where its field is uniform.
    const fs::path idle = foam.folder / "processor2";
    fs::create_directories(idle / "constant" / "polyMesh");
    writeText(idle / "constant" / "polyMesh" / "cellProcAddressing", header("labelList") + "0()\n");
    foam.field("processor2/7", "T", "volScalarField", kKelvin, "uniform 1");
    EXPECT_EQ(shown(only(foam.folder)), (std::vector<float>{300, -1, 301, 302, 303, 304}));
    fs::remove_all(idle);
    // Without processor1, its cells have no value, and a warning says so.
    fs::rename(foam.folder / "processor1", folder / "away");
    diagnostics = {};
    EXPECT_EQ(shown(only(foam.folder)), (std::vector<float>{300, -1, -1, -1, 303, -1}));
    EXPECT_EQ(diagnostics.count(Code::FieldInPart), 1u);
    fs::rename(folder / "away", foam.folder / "processor1");
    writeText(foam.folder / "processor1" / "constant" / "polyMesh" / "cellProcAddressing",
              header("labelList") + "3\n(\n1\n2\n5\n)\n");
    EXPECT_NE(messageOf(foam.folder).find("cell 5 is not one of the 5 cells"), std::string::npos);
}

TEST_F(ReadFoam, TheNoteOfTheMeshGivesThePlace) {
    options.at.reset();
    const FoamFolder foam(folder / "room", "Metres from (99.75, 199.5, 9) along (1, 0, 0) and (0, 1, 0)");
    foam.field("1", "T", "volScalarField", kKelvin, "uniform 290");
    const Field field = only(foam.folder);
    EXPECT_NEAR(length(field.head.lattice.first), 0, 1e-9);
    EXPECT_NE(field.head.parameters.find("by the note of the mesh"), std::string::npos);
    // Without it, the coordinates are those of the world, where the volume is not.
    const FoamFolder other(folder / "other");
    other.field("1", "T", "volScalarField", kKelvin, "uniform 290");
    EXPECT_NE(messageOf(other.folder, Code::FieldOutside).find("--at"), std::string::npos);
}

TEST_F(ReadFoam, PackedFiles) {
    const FoamFolder foam(folder / "room");
    foam.field("1", "T", "volScalarField", kKelvin, "nonuniform List<scalar> 5(1 2 3 4 5)");
    const fs::path file = foam.folder / "1" / "T";
    const std::string text = readText(file);
    const auto bytes = gzipBytes(std::as_bytes(std::span(text)));
    const std::string packed(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    writeText(file.string() + ".gz", packed);
    fs::remove(file);
    EXPECT_EQ(shown(only(foam.folder)), (std::vector<float>{1, -1, 2, 3, 4, 5}));
    writeText(file.string() + ".gz", packed.substr(0, packed.size() / 2));
    EXPECT_NE(messageOf(foam.folder).find("compression is damaged"), std::string::npos);
}

TEST_F(ReadFoam, NamesWhatIsWrong) {
    const FoamFolder foam(folder / "room");
    const auto field = [&](std::string_view internal) { foam.field("1", "T", "volScalarField", kKelvin, internal); };
    field("nonuniform List<scalar> 4(1 2 3 4)");
    EXPECT_NE(messageOf(foam.folder).find("4 values stand where 5 cells need 5"), std::string::npos);
    field("nonuniform List<scalar> 5(1 2 3 4");
    EXPECT_NE(messageOf(foam.folder).find("where a number should be"), std::string::npos);
    field("nonuniform List<scalar> 99999999999(1 2");
    EXPECT_NE(messageOf(foam.folder).find("too short for a list of 99999999999"), std::string::npos);
    field("nonuniform List<vector> 5(1 2 3 4 5)");
    EXPECT_NE(messageOf(foam.folder).find("List<scalar>"), std::string::npos);
    field("uniform 1");
    options.quantity = "smoke";
    EXPECT_NE(messageOf(foam.folder, Code::BadArgument).find("it has: T"), std::string::npos);
    options.quantity.clear();
    foam.write("owner", "labelList", {}, "2(0 1)", false);
    EXPECT_NE(messageOf(foam.folder).find("30 faces have 2 owners"), std::string::npos);
    const FoamFolder turned(folder / "turned");
    turned.field("1", "T", "volScalarField", kKelvin, "uniform 1");
    std::string points = readText(turned.folder / "constant" / "polyMesh" / "points");
    points.replace(points.find("(0 0 0)"), 7, "(0 0.1 0.1)");
    writeText(turned.folder / "constant" / "polyMesh" / "points", points);
    EXPECT_NE(messageOf(turned.folder).find("does not lie across an axis"), std::string::npos);
    fs::create_directories(folder / "plain");
    EXPECT_NE(messageOf(folder / "plain").find("has no case of OpenFOAM"), std::string::npos);
}

}  // namespace
}  // namespace svt::field_readers
