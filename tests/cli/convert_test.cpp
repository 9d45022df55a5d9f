// `svt convert`: what other programs read of it, parts of volumes, wrong names.
#include "run_command.hpp"
#include "small_model.hpp"

#include <svt/core/test_data_test.hpp>
#include <svt/writers/volume_formats.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <map>
#include <set>
#include <sstream>

namespace svt::test {
namespace {

namespace fs = std::filesystem;

/// Three boxes of which no turn or mirror image looks like the whole, with names that are hard to write:
///
///     z |   c           a  along x, 7 x 2 x 1 m
///       |   c           b  along y at its far end, 2 x 3 x 1 m
///       | a a a a b     c  upwards at its near end, 1 x 2 x 4 m
///       +-----------
std::string unlikeBoxes() {
    const auto box = [](double x0, double y0, double z0, double x1, double y1, double z1) {
        return solid(boxFaces(500000 + x0, 5400000 + y0, 100 + z0, 500000 + x1, 5400000 + y1, 100 + z1));
    };
    return cityModel(building("a", box(0, 0, 0, 7, 2, 1), "<gml:name>K\u00fcche &amp; \"Bad\"</gml:name>") +
                     building("b", box(5, 2, 0, 7, 5, 1)) + building("c", box(0, 0, 1, 1, 2, 5)));
}

class Convert : public ::testing::Test {
protected:
    void SetUp() override {
        writeText(folder / "boxes.gml", unlikeBoxes());
        prepare(folder.path(), {"build", "boxes.gml", "-o", "boxes.svt", "--spacing", "0.11,0.13,0.17"});
        prepare(folder.path(), {"convert", "boxes.svt", "reference.nrrd", "--encoding", "raw"});
    }

    /// Runs tests/scripts/read_volume.py; false where the reader is not installed.
    bool isSameFor(const std::string& reader, const std::string& file, const std::string& reference = "reference.nrrd",
                   const std::string& scale = "1") {
        return isRun(folder.path(), pythonOf("read_volume.py") + reader + " " + file + " " + reference + " " + scale,
                     said);
    }

    /// Runs tests/formats/read_formats.mjs with what is installed in build/oracles; false where the reader is not.
    bool isReadByNode(const std::string& arguments) {
        return isRun(folder.path(), nodeOf("read_formats.mjs") + arguments, said);
    }

    /// Writes `file` compressed and raw, each read by `reader` with equal samples at equal places.
    void expectRead(const std::string& reader, const std::string& file, const std::string& scale = "1") {
        for (const char* encoding : {"gzip", "raw"}) {
            runSvtWell(folder.path(), {"convert", "boxes.svt", file, "--encoding", encoding});
            if (!isSameFor(reader, file, "reference.nrrd", scale)) GTEST_SKIP() << said;
        }
    }

    TemporaryFolder folder;
    std::string said;
};

TEST_F(Convert, SegmentationHasTheSamplesInMillimetres) { expectRead("nrrd", "boxes.seg.nrrd", "1000"); }

TEST_F(Convert, SegmentationHasTheKeysOfSlicer) {
    runSvtWell(folder.path(), {"convert", "boxes.svt", "boxes.seg.nrrd"});
    const std::string text = readText(folder / "boxes.seg.nrrd");
    const std::string header = text.substr(0, text.find("\n\n"));
    for (const char* line :
         {"\nspace: right-anterior-superior\n", "\nSegment0_ID:=a\n", "\nSegment0_Name:=K\u00fcche & \"Bad\"\n",
          "\nSegment0_LabelValue:=1\n", "\nSegment1_ID:=b\n", "\nSegment2_LabelValue:=3\n", "\nSegment0_Layer:=0\n",
          "\nSegment0_SVT_Class:=Building\n", "\nSegmentation_SourceRepresentation:=Binary labelmap\n"})
        EXPECT_NE(header.find(line), std::string::npos) << line << header.substr(0, 2000);
    EXPECT_EQ(header.find("\nSegment3_"), std::string::npos);
    // Terminology as Slicer parses it: seven parts by ~, of which all but the names of lists are triples by ^.
    const std::size_t entry = header.find("TerminologyEntry:", header.find("\nSegment0_Tags:="));
    ASSERT_NE(entry, std::string::npos);
    std::istringstream parts(header.substr(entry + 17, header.find('|', entry) - entry - 17));
    int part = 0;
    for (std::string term; std::getline(parts, term, '~'); ++part)
        EXPECT_EQ(std::count(term.begin(), term.end(), '^'), part == 0 || part == 4 ? 0 : 2) << part << ": " << term;
    EXPECT_EQ(part, 7);
    // Box c: i from 0 to 9 or so (1 m by 0.11), above a.
    const std::size_t extent = header.find("\nSegment2_Extent:=");
    ASSERT_NE(extent, std::string::npos);
    int box[6] = {};
    ASSERT_EQ(std::sscanf(header.c_str() + extent + 18, "%d %d %d %d %d %d", box, box + 1, box + 2, box + 3, box + 4,
                          box + 5),
              6);
    EXPECT_NEAR(box[1] - box[0], 1 / 0.11, 1.5);
    EXPECT_NEAR(box[3] - box[2], 2 / 0.13, 1.5);
    EXPECT_NEAR(box[5] - box[4], 4 / 0.17, 2.5);
}

TEST_F(Convert, VtkReadsImageData) {
    expectRead("vti", "boxes.vti");
    if (IsSkipped()) return;
    EXPECT_NE(said.find("label_id ['a', 'b', 'c']"), std::string::npos) << said;
    EXPECT_NE(said.find("label_name ['K\u00fcche & \"Bad\"', '', '']"), std::string::npos) << said;
    EXPECT_NE(said.find("label_first [1, 2, 3]"), std::string::npos) << said;
}

TEST_F(Convert, ParaViewOpensImageDataAndAllLevels) {
    const char* told = std::getenv("SVT_PVPYTHON");
    const std::string pvpython = told != nullptr ? told : "pvpython";
    if (!hasProgram("'" + pvpython + "' --version")) GTEST_SKIP() << "no pvpython; SVT_PVPYTHON names one";
    runSvtWell(folder.path(), {"build", "boxes.gml", "-o", "fine.svt", "--spacing", "0.05,0.06,0.07"});
    runSvtWell(folder.path(), {"convert", "fine.svt", "fine.nrrd", "--encoding", "raw"});
    for (const std::string file : {"fine.vti", "raw.vti", "fine.vtm"}) {
        runSvtWell(folder.path(), {"convert", "fine.svt", file, "--encoding", file == "raw.vti" ? "raw" : "gzip"});
        said = runShellWell(folder.path(), "'" + pvpython + "' --force-offscreen-rendering " + sourceRoot() +
                                               "/tests/formats/read_paraview.py " + file + " fine.nrrd");
        EXPECT_NE(said.find(" same; 3 names"), std::string::npos) << said;
    }
}

TEST_F(Convert, VtkReadsNrrd) {
    if (!isSameFor("vtknrrd", "reference.nrrd")) GTEST_SKIP() << said;
}

TEST_F(Convert, NibabelReadsNifti) {
    expectRead("nifti", "boxes.nii");
    if (IsSkipped()) return;
    EXPECT_NE(said.find("Nifti2Image"), std::string::npos) << "coordinates of millions of metres: " << said;
    expectRead("nifti", "boxes.nii.gz");
}

TEST_F(Convert, NearTheOriginNiftiIsVersion1) {
    std::string model = unlikeBoxes();
    for (const auto& [far, near] :
         {std::pair<std::string, std::string>{"50000", "0"}, {"540000", "1"}, {"10000", "10"}})
        for (std::size_t at = 0; (at = model.find(far, at)) != std::string::npos;) model.replace(at, far.size(), near);
    writeText(folder / "near.gml", model);
    runSvtWell(folder.path(), {"build", "near.gml", "-o", "near.svt", "--spacing", "0.11,0.13,0.17"});
    runSvtWell(folder.path(), {"convert", "near.svt", "near.nrrd", "--encoding", "raw"});
    runSvtWell(folder.path(), {"convert", "near.svt", "near.nii"});
    EXPECT_EQ(readText(folder / "near.nii").substr(344, 4), std::string("n+1\0", 4));
    if (!isSameFor("nifti", "near.nii", "near.nrrd")) GTEST_SKIP() << said;
    EXPECT_NE(said.find("Nifti1Image"), std::string::npos) << said;
}

TEST_F(Convert, TifffileReadsStacks) {
    expectRead("tiff", "boxes.tif");
    expectRead("tiff", "boxes.ome.tif");
}

TEST_F(Convert, ZarrPythonReadsVersion2) {
    runSvtWell(folder.path(), {"convert", "boxes.svt", "boxes.zarr"});
    if (!isSameFor("zarr", "boxes.zarr")) GTEST_SKIP() << said;
    EXPECT_NE(said.find("['a', 'b', 'c']"), std::string::npos) << said;
}

TEST_F(Convert, VtkReadsTriangles) {
    for (const char* file : {"boxes.ply", "boxes.stl", "boxes.obj"}) {
        runSvtWell(folder.path(), {"convert", "boxes.svt", file, "--faces", "voxels"});
        if (!isSameFor("mesh", file)) GTEST_SKIP() << said;
    }
    const std::string obj = readText(folder / "boxes.obj");
    EXPECT_NE(obj.find("\nmtllib boxes.mtl\no a\ng Building\nusemtl label_0\nv "), std::string::npos);
    EXPECT_NE(readText(folder / "boxes.mtl").find("newmtl label_2\n"), std::string::npos);
    // One of them alone.
    runSvtWell(folder.path(), {"convert", "boxes.svt", "c.obj", "--select", "id=c"});
    EXPECT_EQ(readText(folder / "c.obj").find("\no a\n"), std::string::npos);
    writeText(folder / "d.mtl", "a letter");
    EXPECT_EQ(runSvt(folder.path(), {"convert", "boxes.svt", "d.obj"}).exitCode, 5);
    EXPECT_EQ(readText(folder / "d.mtl"), "a letter");
}

TEST_F(Convert, ZarrOfOthersIsRead) {
    // By zarr-python with each of its compressors, and what must be refused.
    if (!isRun(folder.path(), pythonOf("zarr_of_others.py") + "'" + commandPath() + "' .", said)) GTEST_SKIP() << said;
}

TEST_F(Convert, ZarrVersion3OfOthersIsRead) {
    if (!isRun(folder.path(), nodeOf("write_zarr.mjs") + ".", said)) GTEST_SKIP() << said;
    std::istringstream names(readText(folder / "written.txt"));
    int count = 0;
    for (std::string name; names >> name; ++count) {
        runSvtWell(folder.path(), {"build", name + ".zarr", "-o", name + ".svt"});
        runSvtWell(folder.path(), {"convert", name + ".svt", name + ".nrrd", "--encoding", "raw"});
        const std::string nrrd = readText(folder / (name + ".nrrd")), expected = readText(folder / "expected.raw");
        const std::string_view samples = std::string_view(nrrd).substr(nrrd.find("\n\n") + 2);
        // Values become the numbers of their places among all values.
        ASSERT_EQ(samples.size(), expected.size() / 2) << name;
        std::map<int, std::set<int>> scalarsOf;
        for (std::size_t s = 0; s < samples.size(); ++s)
            scalarsOf[static_cast<unsigned char>(expected[2 * s]) | static_cast<unsigned char>(expected[2 * s + 1])
                                                                        << 8]
                .insert(static_cast<unsigned char>(samples[s]));
        int scalar = 0;
        for (const auto& [value, scalars] : scalarsOf) EXPECT_EQ(scalars, std::set<int>{scalar++}) << name << value;
    }
    EXPECT_GE(count, 5) << readText(folder / "output.txt");
}

TEST_F(Convert, VtkReadsAllLevels) {
    runSvtWell(folder.path(), {"build", "boxes.gml", "-o", "boxes.svt", "--spacing", "0.06,0.07,0.05"});
    runSvtWell(folder.path(), {"convert", "boxes.svt", "reference.nrrd", "--encoding", "raw"});
    expectRead("vtm", "boxes.vtm");
    if (IsSkipped()) return;
    EXPECT_NE(said.find("levels 2"), std::string::npos) << said;
    writeText(folder / "other.level0.vti", "a letter");
    EXPECT_EQ(runSvt(folder.path(), {"convert", "boxes.svt", "other.vtm"}).exitCode, 5);
    EXPECT_EQ(readText(folder / "other.level0.vti"), "a letter");
    EXPECT_FALSE(fs::exists(folder / "other.vtm"));
}

TEST_F(Convert, TheOpenVdbLibraryReadsLabelsMasksAndPlace) {
    runSvtWell(folder.path(), {"convert", "boxes.svt", "boxes.vdb"});
    if (!isSameFor("vdb", "boxes.vdb")) GTEST_SKIP() << said;
    // Fine enough for tiles of 8 samples, several nodes, and a turned grid with several classes.
    runSvtWell(folder.path(), {"build", "boxes.gml", "-o", "fine.svt", "--spacing", "0.03,0.031,0.033"});
    runSvtWell(folder.path(), {"convert", "fine.svt", "fine.nrrd", "--encoding", "raw"});
    runSvtWell(folder.path(), {"convert", "fine.svt", "fine.vdb"});
    isSameFor("vdb", "fine.vdb", "fine.nrrd");
    prepare(folder.path(), {"sample", "house", "-o", "house.gml", "--turn", "30"});
    prepare(folder.path(), {"build", "house.gml", "-o", "turned.svt", "--spacing", "0.31,0.26,0.2", "--axes",
                            "building", "--patterns"});
    runSvtWell(folder.path(), {"convert", "turned.svt", "turned.nrrd", "--encoding", "raw"});
    runSvtWell(folder.path(), {"convert", "turned.svt", "turned.vdb"});
    isSameFor("vdb", "turned.vdb", "turned.nrrd");
    EXPECT_EQ(runSvt(folder.path(), {"convert", "boxes.svt", "n.vdb", "--box", "500003,5400003,102,500007,5400005,105"})
                  .exitCode,
              2)
        << "nothing there";
}

TEST_F(Convert, TheOpenVdbLibraryReadsLevelSets) {
    runSvtWell(folder.path(), {"build", "boxes.gml", "-o", "cubes.svt", "--spacing", "0.06"});
    prepare(folder.path(), {"sample", "house", "-o", "house.gml", "--turn", "30"});
    prepare(folder.path(), {"build", "house.gml", "-o", "turned.svt", "--spacing", "0.3", "--axes", "building"});
    for (const std::string name : {"cubes", "turned"}) {
        runSvtWell(folder.path(), {"convert", name + ".svt", name + ".nrrd", "--encoding", "raw"});
        runSvtWell(folder.path(), {"convert", name + ".svt", name + ".vdb", "--level-sets"});
        if (!isSameFor("levelset", name + ".vdb", name + ".nrrd")) GTEST_SKIP() << said;
        EXPECT_NE(said.find(name == "cubes" ? "level sets 1" : "level sets "), std::string::npos) << said;
    }
    const ShellResult printed = runShell(folder.path(), "vdb_print cubes.vdb");
    if (printed.exitCode == 0) {
        EXPECT_NE(printed.text.find("Building"), std::string::npos);
    }
    const auto refused = runSvt(folder.path(), {"convert", "boxes.svt", "no.vdb", "--level-sets"});
    EXPECT_EQ(refused.exitCode, 2);
    EXPECT_NE(refused.err.find("cubes"), std::string::npos) << refused.err;
}

TEST_F(Convert, MagicaVoxelsFormatHasAllVoxelsWithTheirNames) {
    runSvtWell(folder.path(), {"convert", "boxes.svt", "boxes.vox"});
    ASSERT_TRUE(isSameFor("vox", "boxes.vox")) << said;
    // Models of more than 256 voxels are divided.
    runSvtWell(folder.path(), {"build", "boxes.gml", "-o", "fine.svt", "--spacing", "0.025,0.3,0.37"});
    runSvtWell(folder.path(), {"convert", "fine.svt", "fine.nrrd", "--encoding", "raw"});
    runSvtWell(folder.path(), {"convert", "fine.svt", "fine.vox"});
    EXPECT_TRUE(isSameFor("vox", "fine.vox", "fine.nrrd")) << said;
    const CommandResult few = runSvt(folder.path(), {"convert", "boxes.svt", "few.vox", "--max-voxels", "100"});
    EXPECT_EQ(few.exitCode, 2);
    EXPECT_NE(few.err.find("--level or --select"), std::string::npos) << few.err;
    EXPECT_FALSE(fs::exists(folder / "few.vox"));
    if (!isReadByNode("vox boxes.vox reference.nrrd")) GTEST_SKIP() << said;
    EXPECT_NE(said.find(" & \"Bad\", b, c"), std::string::npos) << said;  // it takes UTF-8 for Latin letters
}

TEST_F(Convert, UsdHasTheHullsWithNamesAndPlace) {
    runSvtWell(folder.path(), {"convert", "boxes.svt", "boxes.usda", "--faces", "voxels"});
    ASSERT_TRUE(isSameFor("mesh", "boxes.usda")) << said;
    EXPECT_NE(said.find("['a', 'b', 'c']"), std::string::npos) << said;
    const std::string text = readText(folder / "boxes.usda");
    EXPECT_NE(text.find("def Xform \"a\" (\n    displayName = \"K\u00fcche & \\\"Bad\\\"\"\n)"), std::string::npos);
    if (!isReadByNode("usda boxes.usda reference.nrrd")) GTEST_SKIP() << said;
    EXPECT_NE(said.find("; a, b, c"), std::string::npos) << said;
}

TEST_F(Convert, NeuroglancerMeshesAreTheHulls) {
    runSvtWell(folder.path(), {"convert", "boxes.svt", "boxes.precomputed", "--meshes", "--faces", "voxels"});
    EXPECT_TRUE(isSameFor("mesh", "boxes.precomputed")) << said;
}

TEST_F(Convert, TilesHaveFeaturesAndAPlaceOnTheGlobe) {
    runSvtWell(folder.path(), {"convert", "boxes.svt", "at.3dtiles", "--faces", "voxels", "--place", "49.1,8.44,110",
                               "--lift", "0.5"});
    ASSERT_TRUE(isSameFor("mesh", "at.3dtiles")) << said;
    EXPECT_NE(said.find("['a', 'b', 'c'] ['K\u00fcche & \"Bad\"', '', ''] [14.0"), std::string::npos) << said;
    const auto tiles = nlohmann::json::parse(readText(folder / "at.3dtiles/tileset.json"));
    const auto& matrix = tiles["root"]["transform"];
    // By cs2cs: echo 49.1 8.44 110.5 | cs2cs EPSG:4979 EPSG:4978
    EXPECT_NEAR(matrix[12].get<double>(), 4138794.3055, 2e-3);
    EXPECT_NEAR(matrix[13].get<double>(), 614116.7043, 2e-3);
    EXPECT_NEAR(matrix[14].get<double>(), 4797931.0199, 2e-3);
    // By a CRS: the axes of UTM are 0.9996 of metres on the ground at its meridian, and less by the height.
    prepareHouse(folder.path(), "0.25");
    runSvtWell(folder.path(), {"convert", "house.svt", "house.3dtiles"});
    const auto house = nlohmann::json::parse(readText(folder / "house.3dtiles/tileset.json"));
    const auto& axes = house["root"]["transform"];
    EXPECT_NEAR(std::hypot(axes[0].get<double>(), axes[1].get<double>(), axes[2].get<double>()), 1 / 0.9996, 1e-4);
    EXPECT_NEAR(std::hypot(axes[8].get<double>(), axes[9].get<double>(), axes[10].get<double>()), 1, 1e-12);
    // Without either there is no place; a place that is none is refused.
    std::string plain = unlikeBoxes();
    const std::string srs = "srsName=\"urn:ogc:def:crs:EPSG::25832\" ";
    plain.erase(plain.find(srs), srs.size());
    writeText(folder / "plain.gml", plain);
    const CommandResult none = runSvt(folder.path(), {"convert", "plain.gml", "none.3dtiles"});
    EXPECT_NE(none.exitCode, 0);
    EXPECT_NE(none.err.find("--place"), std::string::npos) << none.err;
    EXPECT_EQ(runSvt(folder.path(), {"convert", "boxes.svt", "none.3dtiles", "--place", "99,8,110"}).exitCode, 2);
    EXPECT_FALSE(fs::exists(folder / "none.3dtiles"));
    if (!isReadByNode("tileset house.3dtiles")) GTEST_SKIP() << said;
}

// The JSON of a .glb.
nlohmann::json jsonOfGlb(const fs::path& file) {
    const std::string text = readText(file);
    std::uint32_t size = 0;
    std::memcpy(&size, text.data() + 12, sizeof size);
    return nlohmann::json::parse(text.substr(20, size));
}

TEST_F(Convert, TilesHaveAFeaturePerBuildingAndCompressedViewsOnRequest) {
    prepareHouse(folder.path(), "0.25");
    runSvtWell(folder.path(), {"convert", "house.svt", "house.3dtiles"});
    runSvtWell(folder.path(), {"convert", "house.svt", "small.3dtiles", "--meshopt"});
    runSvtWell(folder.path(), {"convert", "house.svt", "one.3dtiles", "--per-building"});
    const auto tableOf = [&](const char* tiles) {
        return jsonOfGlb(folder / tiles / "0.glb")["extensions"]["EXT_structural_metadata"]["propertyTables"][0];
    };
    const auto keysOf = [](const nlohmann::json& object) {
        std::vector<std::string> keys;
        for (const auto& [key, value] : object.items()) keys.push_back(key);
        return keys;
    };
    using Keys = std::vector<std::string>;
    EXPECT_GT(tableOf("house.3dtiles")["count"].get<int>(), 100);
    EXPECT_EQ(keysOf(tableOf("house.3dtiles")["properties"]),
              (Keys{"attributes", "class", "id", "name", "parent", "storey", "volume"}));
    EXPECT_EQ(tableOf("one.3dtiles")["count"], 1);
    EXPECT_EQ(keysOf(tableOf("one.3dtiles")["properties"]),
              (Keys{"attributes", "class", "height", "id", "lowest", "name", "volume"}));
    EXPECT_LT(fs::file_size(folder / "small.3dtiles/0.glb"), fs::file_size(folder / "house.3dtiles/0.glb"));
    EXPECT_LT(fs::file_size(folder / "one.3dtiles/0.glb"), fs::file_size(folder / "house.3dtiles/0.glb"));
    if (!isRun(folder.path(), nodeOf("meshopt_tiles.mjs") + "house.3dtiles small.3dtiles", said)) GTEST_SKIP() << said;
    ASSERT_TRUE(isReadByNode("tileset one.3dtiles")) << said;
}

TEST_F(Convert, CesiumShowsTilesAtTheirPlaceAndTellsComponents) {
    prepareHouse(folder.path(), "0.2");
    runSvtWell(folder.path(), {"convert", "house.svt", "house.3dtiles"});
    // The middle is at 500005.5, 5400003.85 and 104.2 m in zone 32 of UTM; by cs2cs:
    const std::string place = "9.0000748 48.7530476 104.2";
    if (!isRun(folder.path(), nodeOf("cesium.mjs") + "house.3dtiles " + place + " BuildingConstructiveElement", said))
        GTEST_SKIP() << said;
    EXPECT_NE(said.find("\"Upper floor\""), std::string::npos) << said;
}

TEST_F(Convert, CesiumShowsVoxelsAndTellsTheirLabels) {
    prepareHouse(folder.path(), "0.1");
    runSvtWell(folder.path(), {"convert", "house.svt", "house.nrrd", "--encoding", "raw"});
    for (const char* option : {"--per-building", "--meshopt"}) {
        const CommandResult refused = runSvt(folder.path(), {"convert", "house.svt", "no.3dtiles", "--voxels", option});
        EXPECT_EQ(refused.exitCode, 2) << option;
        EXPECT_NE(refused.err.find("--voxels"), std::string::npos) << refused.err;
        EXPECT_FALSE(fs::exists(folder / "no.3dtiles")) << option;
    }
    runSvtWell(folder.path(), {"convert", "house.svt", "house.3dtiles", "--voxels"});
    if (!isRun(folder.path(), nodeOf("cesium_voxels.mjs") + "house.3dtiles house.nrrd voxels.png", said))
        GTEST_SKIP() << said;
}

TEST_F(Convert, ParquetHasTheRowsOfCsv) {
    prepareHouse(folder.path(), "0.25");
    for (const std::string name : {"house", "house.contacts"}) {
        runSvtWell(folder.path(), {"convert", "house.svt", name + ".csv"});
        runSvtWell(folder.path(), {"convert", "house.svt", name + ".parquet"});
        const std::string bytes = readText(folder / (name + ".parquet"));
        EXPECT_TRUE(bytes.starts_with("PAR1") && bytes.ends_with("PAR1"));
        for (const char* reader : {"parquet ", "arrow "})
            if (!isReadByNode(reader + name + ".parquet " + name + ".csv")) GTEST_SKIP() << said;
    }
}

TEST_F(Convert, NetworkxReadsGraphMl) {
    runSvtWell(folder.path(), {"convert", "boxes.svt", "boxes.graphml"});
    runSvtWell(folder.path(), {"convert", "boxes.svt", "boxes.adjacency.json"});
    writeText(folder / "read.py",
              "import json, sys\n"
              "try: import networkx\n"
              "except ImportError: sys.exit(77)\n"
              "graph = networkx.read_graphml('boxes.graphml')\n"
              "told = json.load(open('boxes.adjacency.json'))\n"
              "assert [graph.nodes[n]['id'] for n in graph] == [node['id'] for node in told['nodes']]\n"
              "edges = [e for e in graph.edges(data=True) if e[2]['kind'] == 'contact']\n"
              "assert len(edges) == len(told['contacts']) > 0\n"
              "assert abs(sum(e[2]['area'] for e in edges) - sum(c['area'] for c in told['contacts'])) < 1e-6\n");
    if (!isRun(folder.path(), pythonOf((folder / "read.py").string()), said))
        GTEST_SKIP() << "networkx is not installed";
}

TEST_F(Convert, GdalReadsStacks) { expectRead("gdal", "boxes.tif"); }

TEST_F(Convert, TurnedGridsKeepTheirPlace) {
    // The sample model turned by 30 degrees, on axes along its walls.
    prepare(folder.path(), {"sample", "house", "-o", "house.gml", "--turn", "30"});
    runSvtWell(folder.path(), {"build", "house.gml", "-o", "boxes.svt", "--spacing", "0.31,0.26,0.2", "--axes",
                               "building", "--patterns"});
    runSvtWell(folder.path(), {"convert", "boxes.svt", "reference.nrrd", "--encoding", "raw"});
    for (const auto& [reader, file] : {std::pair{"vti", "boxes.vti"}, {"nifti", "boxes.nii"}, {"tiff", "boxes.tif"}}) {
        runSvtWell(folder.path(), {"convert", "boxes.svt", file});
        isSameFor(reader, file);
    }
}

TEST_F(Convert, PartsOfAVolumeAreWrittenAlone) {
    // Box c alone, by query and by its place.
    runSvtWell(folder.path(), {"convert", "boxes.svt", "c.nrrd", "--encoding", "raw", "--select", "id=c"});
    runSvtWell(folder.path(), {"convert", "boxes.svt", "top.nrrd", "--encoding", "raw", "--box",
                               "499999,5399999,101.2,500009,5400009,110"});
    const std::string all = readText(folder / "reference.nrrd"), c = readText(folder / "c.nrrd"),
                      top = readText(folder / "top.nrrd");
    const auto countOf = [](const std::string& text, char scalar) {
        return std::count(text.begin() + static_cast<std::ptrdiff_t>(text.find("\n\n") + 2), text.end(), scalar);
    };
    EXPECT_GT(countOf(all, 1), 0);
    EXPECT_EQ(countOf(c, 1), 0);
    EXPECT_EQ(countOf(c, 3), countOf(all, 3));
    EXPECT_EQ(countOf(top, 1) + countOf(top, 2), 0);
    EXPECT_GT(countOf(top, 3), countOf(all, 3) / 2);
    EXPECT_LT(top.size(), all.size());
    runSvtWell(folder.path(), {"convert", "boxes.svt", "coarse.nrrd", "--encoding", "raw", "--level", "1"});
    EXPECT_NEAR(double(countOf(readText(folder / "coarse.nrrd"), 1)) * 8, double(countOf(all, 1)),
                0.5 * double(countOf(all, 1)));
    EXPECT_EQ(runSvt(folder.path(), {"convert", "boxes.svt", "x.nrrd", "--box", "0,0,0,1,1,1"}).exitCode, 2)
        << "no sample lies there";
    EXPECT_EQ(runSvt(folder.path(), {"convert", "boxes.svt", "x.nrrd", "--level", "9"}).exitCode, 2);
    EXPECT_FALSE(fs::exists(folder / "x.nrrd"));
}

TEST(Formats, AreListedWithEndingsAndCommands) {
    const TemporaryFolder folder;
    using nlohmann::json;
    const json rows = json::parse(runSvtWell(folder.path(), {"--formats=json"}));
    std::map<std::string, json> byName;
    for (const json& row : rows) {
        EXPECT_TRUE(byName.emplace(row["name"], row).second) << row;
        EXPECT_FALSE(row["endings"].empty() || row["content"].get<std::string>().empty()) << row;
        EXPECT_FALSE(row["readAs"].is_null() && row["writtenBy"].is_null()) << row;
    }
    for (const writers::VolumeFormat& format : writers::volumeFormats()) {
        const json& commands = byName.at(std::string(format.name))["writtenBy"];
        EXPECT_NE(std::ranges::find(commands, "convert"), commands.end()) << format.name;
    }
    for (const char* name : {"citygml", "cityjson", "ifc", "indoorgml"}) EXPECT_EQ(byName.at(name)["readAs"], "model");
    for (const char* name : {"svt", "nrrd", "vti", "nifti", "tiff", "zarr", "ade"})
        EXPECT_EQ(byName.at(name)["readAs"], "volume") << name;
    EXPECT_EQ(byName.at("ifc")["endings"], json({".ifc", ".ifczip"}));
    EXPECT_EQ(byName.at("svt")["writtenBy"], json({"build", "field-add", "field-remove", "simulate-heat",
                                                   "simulate-spread", "diff", "shell", "city-extract"}));
    const std::string text = runSvtWell(folder.path(), {"--formats"});
    for (const auto& [name, row] : byName) EXPECT_NE(text.find(row["content"]), std::string::npos) << name;
    EXPECT_EQ(runSvt(folder.path(), {"--formats=xml"}).exitCode, 2);
}

TEST_F(Convert, OptionsOfOtherFormatsAreRefused) {
    for (const auto& [option, output] :
         std::vector<std::pair<std::vector<std::string>, std::string>>{{{"--meshopt"}, "o.nrrd"},
                                                                       {{"--level-sets"}, "o.glb"},
                                                                       {{"--zarr", "3"}, "o.vti"},
                                                                       {{"--max-boxes", "7"}, "o.geojson"},
                                                                       {{"--texture", "image"}, "o.csv"}}) {
        std::vector<std::string> arguments{"convert", "boxes.svt", output};
        arguments.insert(arguments.end(), option.begin(), option.end());
        const CommandResult result = runSvt(folder.path(), arguments);
        EXPECT_EQ(result.exitCode, kUsage) << result.toString();
        EXPECT_NE(result.err.find("and the output has another format"), std::string::npos) << result.toString();
        EXPECT_NE(result.err.find(option.front()), std::string::npos) << result.toString();
        EXPECT_FALSE(std::filesystem::exists(folder / output));
    }
}

TEST_F(Convert, AVolumeIsNoModel) {
    const CommandResult built = runSvt(folder.path(), {"build", "boxes.svt", "-o", "o.svt"});
    EXPECT_NE(built.exitCode, 0);
    EXPECT_NE(built.err.find("this is a volume (.svt), and a model is expected"), std::string::npos)
        << built.toString();
}

TEST_F(Convert, TheModelOfAVolumeHasItsFeatures) {
    const CommandResult other = runSvt(folder.path(), {"convert", "boxes.svt", "o.ade.gml", "--model", "boxes.gml"});
    EXPECT_EQ(other.exitCode, 0) << other.toString();
    EXPECT_EQ(other.err.find("gml:id"), std::string::npos) << other.toString();
    runSvtWell(folder.path(), {"sample", "house", "-o", "house.gml"});
    const CommandResult none = runSvt(folder.path(), {"convert", "boxes.svt", "p.ade.gml", "--model", "house.gml"});
    EXPECT_EQ(none.exitCode, kUsage) << none.toString();
    EXPECT_NE(none.err.find("the model lacks all 3 features of the volume, such as 'a'"), std::string::npos)
        << none.toString();
    EXPECT_FALSE(fs::exists(folder / "p.ade.gml"));
    std::string text = readText(folder / "boxes.gml");
    text.replace(text.find("id=\"b\""), 6, "id=\"x\"");
    writeText(folder / "part.gml", text);
    const CommandResult part = runSvt(folder.path(), {"convert", "boxes.svt", "q.ade.gml", "--model", "part.gml"});
    EXPECT_EQ(part.exitCode, 0) << part.toString();
    EXPECT_NE(part.err.find("the model has no gml:id for 1 of the 3 features of the volume, such as 'b'"),
              std::string::npos)
        << part.toString();
}

TEST(Sample, OptionsOfOtherSamplesAreRefused) {
    const TemporaryFolder folder;
    for (const std::vector<std::string>& options :
         std::vector<std::vector<std::string>>{{"house", "-o", "o.gml", "--storeys", "3"},
                                               {"district", "-o", "o.gml", "--flats", "3"},
                                               {"tower", "-o", "o.gml", "--rows", "2"},
                                               {"house", "-o", "o.gml", "--thematic"},
                                               {"house", "-o", "o.city.json", "--bake-openings"}}) {
        std::vector<std::string> arguments{"sample"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        const CommandResult result = runSvt(folder.path(), arguments);
        EXPECT_EQ(result.exitCode, kUsage) << result.toString();
        EXPECT_NE(result.err.find(options[3]), std::string::npos) << result.toString();
    }
}

TEST_F(Convert, EveryFormatIsWrittenAndTheSameForAnyThreads) {
    // Boxes have no rooms, of which IndoorGML and cases of OpenFOAM are made.
    prepareHouse(folder.path(), "0.4");
    for (const writers::VolumeFormat& format : writers::volumeFormats()) {
        const bool isOfRooms = format.name == "indoorgml" || format.name == "foam";
        const std::string input = isOfRooms ? "house.svt" : "boxes.svt";
        const std::string ending(format.endings.substr(0, format.endings.find('|')));
        for (const auto& [name, threads] : {std::pair("one", "1"), std::pair("two", "3")}) {
            std::vector<std::string> arguments{"convert", input, name + ending, "--threads", threads};
            if (format.name == "foam") arguments.insert(arguments.end(), {"--air", "name=Kitchen"});
            runSvtWell(folder.path(), arguments);
        }
        if (fs::is_directory(folder / ("one" + ending))) {
            for (const auto& file : fs::recursive_directory_iterator(folder / ("one" + ending))) {
                if (!file.is_regular_file()) continue;
                const fs::path other = folder / ("two" + ending) / fs::relative(file.path(), folder / ("one" + ending));
                EXPECT_TRUE(readText(file.path()) == readText(other)) << other;
            }
            EXPECT_EQ(runSvt(folder.path(), {"convert", input, "one" + ending}).exitCode, 5) << "never replaced";
            continue;
        }
        std::string two = readText(folder / ("two" + ending));
        // An OBJ names the file of its colours, a VTM its levels, an FDS document is named as its file.
        for (const char* own : {"two.mtl", "two.level", "two', TITLE", "two' /"})
            for (std::size_t name = 0; (name = two.find(own, name)) != std::string::npos;) two.replace(name, 3, "one");
        EXPECT_TRUE(readText(folder / ("one" + ending)) == two) << format.name;
        EXPECT_FALSE(readText(folder / ("one" + ending)).empty()) << format.name;
        // What is there is replaced by its like alone.
        runSvtWell(folder.path(), {"convert", input, "one" + ending});
        writeText(folder / ("other" + ending), "\x89PNG\r\n\x1a\n");
        EXPECT_EQ(runSvt(folder.path(), {"convert", input, "other" + ending}).exitCode, 5) << format.name;
    }
}

/// The schemas of the extension with the imports that they need in `data`, and a driver of all modules of CityGML.
bool writeSchemas(const fs::path& folder, const fs::path& data, const std::string& version) {
    const fs::path schemas = data / "schemas";
    if (!fs::exists(schemas / "all_citygml.xsd")) return false;
    std::string ade = readText(fs::path(sourceRoot()) / ("docs/formats/citygml/svt-ade-" + version + ".xsd"));
    std::string all = readText(schemas / "all_citygml.xsd");
    const auto replace = [](std::string& text, const std::string& from, const std::string& to) {
        for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
            text.replace(at, from.size(), to);
    };
    const std::string ogc = "http://schemas.opengis.net/", here = schemas.string() + "/";
    replace(ade, ogc + "gml/3.1.1/base/", here + "gml/3.1/base/");
    replace(ade, ogc + "gml/3.2.1/", here + "gml/3.2/");
    replace(ade, ogc + "citygml/appearance/2.0/", here + "citygml/2.0/");
    replace(ade, ogc + "citygml/", here + "citygml/");
    replace(all, "schemaLocation=\"", "schemaLocation=\"" + here);
    replace(all, "</xs:schema>",
            "<xs:import namespace=\"urn:svt:citygml:ade:" + version + "\" schemaLocation=\"ade.xsd\"/></xs:schema>");
    writeText(folder / "ade.xsd", ade);
    writeText(folder / "all.xsd", all);
    return true;
}

TEST_F(Convert, OtherKindsOfAFormatAreTheSameForAnyThreads) {
    prepareHouse(folder.path(), "0.2");
    int kind = 0;
    for (const auto& [ending, option] :
         std::initializer_list<std::pair<std::string, std::vector<std::string>>>{{".precomputed", {"--sharded"}},
                                                                                 {".3dtiles", {"--voxels"}},
                                                                                 {".zarr", {"--zarr", "3"}},
                                                                                 {".vdb", {"--level-sets"}}}) {
        const std::string one = "one" + std::to_string(++kind) + ending, two = "two" + std::to_string(kind) + ending;
        std::vector<std::string> arguments{"convert", "house.svt", one, "--threads", "1"};
        arguments.insert(arguments.end(), option.begin(), option.end());
        runSvtWell(folder.path(), arguments);
        arguments[2] = two;
        arguments[4] = "3";
        runSvtWell(folder.path(), arguments);
        if (!fs::is_directory(folder / one)) {
            EXPECT_TRUE(readText(folder / one) == readText(folder / two)) << one;
            continue;
        }
        int files = 0;
        for (const auto& file : fs::recursive_directory_iterator(folder / one)) {
            if (!file.is_regular_file()) continue;
            ++files;
            EXPECT_TRUE(readText(file.path()) == readText(folder / two / fs::relative(file.path(), folder / one)))
                << file.path();
        }
        EXPECT_GT(files, 3) << one;
    }
}

TEST_F(Convert, CityGmlIsValidAndComesBackBitForBit) {
    prepare(folder.path(), {"sample", "house", "-o", "house3.gml"});
    prepare(folder.path(), {"sample", "house", "-o", "house2.gml", "--format", "citygml2"});
    const bool hasSchemas = hasProgram("xmllint --version");
    for (const std::string version : {"2.0", "3.0"}) {
        const std::string model = "house" + version.substr(0, 1) + ".gml", volume = "v" + version + ".svt";
        runSvtWell(folder.path(), {"build", model, "-o", volume, "--spacing", "0.5"});
        runSvtWell(folder.path(), {"convert", volume, "expected" + version + ".nrrd", "--encoding", "raw"});
        std::string written;
        for (const std::string texture : {"pixel", "image", "composed"})
            for (const bool hasModel : {true, false}) {
                if (!hasModel && texture != "pixel") continue;
                const std::string name = texture + version + (hasModel ? "m" : "p"), gml = name + ".ade.gml";
                std::vector<std::string> arguments{"convert", volume, gml, "--texture", texture, "--citygml", version};
                if (hasModel) arguments.insert(arguments.end(), {"--model", model});
                runSvtWell(folder.path(), arguments);
                written += " " + gml;
                runSvtWell(folder.path(), {"build", gml, "-o", name + ".svt"});
                runSvtWell(folder.path(), {"convert", name + ".svt", name + ".nrrd", "--encoding", "raw"});
                EXPECT_TRUE(readText(folder / (name + ".nrrd")) == readText(folder / ("expected" + version + ".nrrd")))
                    << name;
            }
        // All at once: reading the schemas takes longer than the files.
        if (hasSchemas && writeSchemas(folder.path(), dataDir(), version))
            runShellWell(folder.path(), "xmllint --nonet --noout --schema all.xsd" + written);
    }
    // The model is kept: a reader of CityGML sees it, with all its features.
    const std::string kept = readText(folder / "pixel3.0m.ade.gml"), whole = readText(folder / "house3.gml");
    const std::size_t end = whole.rfind("</");
    EXPECT_TRUE(kept.compare(0, end, whole, 0, end) == 0);
    EXPECT_TRUE(kept.ends_with(whole.substr(end)));
    EXPECT_EQ(runSvt(folder.path(), {"convert", "v3.0.svt", "x.ade.gml", "--model", "house3.gml", "--citygml", "2.0"})
                  .exitCode,
              2);
    EXPECT_EQ(runSvt(folder.path(), {"convert", "v3.0.svt", "x.ade.gml", "--max-voxels", "100"}).exitCode, 2);
    EXPECT_EQ(runSvt(folder.path(), {"build", "house3.gml", "-o", "x.svt", "--labels", "house2.gml"}).exitCode, 2);
    EXPECT_EQ(runSvt(folder.path(), {"build", "pixel3.0m.ade.gml", "-o", "x.svt", "--spacing", "1"}).exitCode, 2);
    EXPECT_FALSE(fs::exists(folder / "x.ade.gml") || fs::exists(folder / "x.svt"));
}

TEST_F(Convert, X3dIsWellFormedInAllThreeKinds) {
    for (const std::string texture : {"pixel", "image", "composed"}) {
        runSvtWell(folder.path(), {"convert", "boxes.svt", texture + ".x3d", "--texture", texture});
        if (hasProgram("xmllint --version")) runShellWell(folder.path(), "xmllint --nonet --noout " + texture + ".x3d");
    }
    const std::string pixel = readText(folder / "pixel.x3d");
    const std::size_t sizes = pixel.find("<PixelTexture3D containerField='voxels' image='3 ");
    ASSERT_NE(sizes, std::string::npos);
    // The numbers are the samples of the NRRD, in its order.
    const std::string nrrd = readText(folder / "reference.nrrd");
    const std::size_t data = nrrd.find("\n\n") + 2;
    const char* at = pixel.c_str() + sizes + std::string_view("<PixelTexture3D containerField='voxels' image='").size();
    char* after = nullptr;
    std::size_t count = 1;
    for (int n = 0; n < 4; ++n, at = after)
        count *= n == 0 ? (std::strtoul(at, &after, 10), 1) : std::strtoul(at, &after, 10);
    ASSERT_EQ(count, nrrd.size() - data);
    for (std::size_t s = 0; s < count; ++s, at = after) {
        const long code = std::strtol(at, &after, 10);
        ASSERT_EQ(code >> 8 & 255, nrrd[data + s]) << s;
        ASSERT_EQ(code >> 16 == 0, nrrd[data + s] == 0) << s;
    }
    EXPECT_TRUE(fs::exists(folder / "image.labels.nrrd"));
    EXPECT_TRUE(fs::exists(folder / "composed_slices/0000.png"));
    // What is beside a document is not destroyed, either.
    writeText(folder / "other.labels.nrrd", "a letter");
    EXPECT_EQ(runSvt(folder.path(), {"convert", "boxes.svt", "other.x3d", "--texture", "image"}).exitCode, 5);
    EXPECT_EQ(readText(folder / "other.labels.nrrd"), "a letter");
    EXPECT_FALSE(fs::exists(folder / "other.x3d"));
}

/// Where the viewer of an X3D scene stands, or looks at, as `svt render` takes it: from the lower corner, z up.
std::string placeIn(const std::string& scene, const char* attribute) {
    const std::size_t at = scene.find(std::string(attribute) + "='");
    double x = 0, y = 0, z = 0;
    if (at == std::string::npos ||
        std::sscanf(scene.c_str() + scene.find('\'', at) + 1, "%lf %lf %lf", &x, &y, &z) != 3)
        return {};
    std::ostringstream text;
    text.precision(12);
    text << x << ',' << -z << ',' << y;
    return text.str();
}

TEST_F(Convert, BrowsersShowX3dAsWeDrawIt) {
    prepare(folder.path(), {"sample", "house", "-o", "house.gml"});
    std::map<std::string, std::string> models{{"house", "house.gml"}};
    if (const fs::path ifc = dataDir() / "fzk_haus.ifc"; fs::exists(ifc)) models["fzk"] = ifc.string();
    for (const auto& [name, model] : models) {
        const std::string volume = name + ".svt";
        prepare(folder.path(), {"build", model, "-o", volume, "--spacing", "0.1"});
        for (const std::string texture : {"pixel", "image", "composed", "atlas"}) {
            if (name == "fzk" && texture == "composed") continue;
            const std::string scene = name + "_" + texture + ".x3d", ours = name + ".png";
            runSvtWell(folder.path(), {"convert", volume, scene, "--texture", texture});
            if (texture == "pixel") {
                const std::string text = readText(folder / scene);
                runSvtWell(folder.path(), {"render", volume, "-o", ours, "--size", "960x640", "--fov", "45", "--eye",
                                           placeIn(text, "position"), "--target", placeIn(text, "centerOfRotation"),
                                           "--background", "#dbe3eb"});
            }
            const std::string viewer = texture == "atlas" ? "x3dom " : "x_ite ";
            if (!isRun(folder.path(), nodeOf("x3d.mjs") + viewer + scene + " " + scene + ".png " + ours, said))
                GTEST_SKIP() << said;
            // The samples are the same, wherever they stand.
            if (texture == "image" || texture == "composed") {
                EXPECT_EQ(readText(folder / (scene + ".png")), readText(folder / (name + "_pixel.x3d.png"))) << scene;
            }
        }
    }
    EXPECT_EQ(runSvt(folder.path(), {"convert", "house.svt", "x.ade.gml", "--texture", "atlas"}).exitCode, 2);
}

TEST_F(Convert, TablesHaveALineForEachObjectAndContact) {
    runSvtWell(folder.path(), {"convert", "boxes.svt", "o.csv"});
    runSvtWell(folder.path(), {"convert", "boxes.svt", "o.contacts.csv"});
    const std::string objects = readText(folder / "o.csv"), contacts = readText(folder / "o.contacts.csv");
    EXPECT_EQ(objects.find("label,id,class,name,parent,first,count,ownVoxels,totalVoxels,ownVolume,totalVolume,"), 0u);
    EXPECT_NE(objects.find("\r\n0,a,Building,\"K\u00fcche & \"\"Bad\"\"\",,1,1,"), std::string::npos) << objects;
    EXPECT_NE(contacts.find("\r\na,Building,\"K\u00fcche & \"\"Bad\"\"\",b,Building,,"), std::string::npos) << contacts;
    EXPECT_NE(contacts.find("\r\nc,Building,,,,,"), std::string::npos) << "background: " << contacts;
    EXPECT_EQ(contacts.find(",b,Building,,c,"), std::string::npos) << "b and c do not touch";
}

}  // namespace
}  // namespace svt::test
