#include <svt/field_readers/read_fields.hpp>

#include <svt/core/bytes.hpp>
#include <svt/core/deflate.hpp>
#include <svt/core/temporary_folder_test.hpp>
#include <svt/field_readers/lattices/vtk_file.hpp>
#include <svt/volume/sample_volume_test.hpp>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

namespace svt::field_readers {
namespace {

using svt::test::TemporaryFolder;
using svt::test::writeText;

std::string base64(std::string_view bytes) {
    constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t at = 0; at < bytes.size(); at += 3) {
        std::uint32_t bits = 0;
        const std::size_t count = std::min<std::size_t>(3, bytes.size() - at);
        for (std::size_t n = 0; n < 3; ++n)
            bits = bits << 8 | (n < count ? static_cast<std::uint8_t>(bytes[at + n]) : 0u);
        for (std::size_t n = 0; n < 4; ++n) text += n <= count ? kDigits[bits >> (18 - 6 * n) & 63] : '=';
    }
    return text;
}

// Values of 3 x 2 x 2 nodes: x + 10 y + 100 z of the node's number.
std::vector<float> nodeValues() {
    std::vector<float> values;
    for (int k = 0; k < 2; ++k)
        for (int j = 0; j < 2; ++j)
            for (int i = 0; i < 3; ++i) values.push_back(static_cast<float>(i + 10 * j + 100 * k));
    return values;
}

std::string bytesOf(const std::vector<float>& values) {
    std::string bytes;
    for (const float value : values) appendBytes(bytes, value);
    return bytes;
}

std::string imageText(std::string_view attributes, std::string_view array, std::string_view tail = {}) {
    return fmt::format(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"ImageData\" version=\"1.0\" byte_order=\"LittleEndian\" {}>\n"
        "<ImageData WholeExtent=\"0 2 0 1 0 1\" Origin=\"1 2 0.5\" Spacing=\"0.5 1 1\">\n"
        "<Piece Extent=\"0 2 0 1 0 1\"><PointData>{}</PointData></Piece></ImageData>{}</VTKFile>",
        attributes, array, tail);
}

class Lattices : public testing::Test {
protected:
    // The only field of a file, or none with `error`.
    std::optional<fields::Field> read(std::string_view name, std::string_view text) {
        writeText(folder / name, text);
        const auto volume = volume::test::emptyVolume({10, 10, 10}, {0.5, 0.5, 0.5}, {0.25, 0.25, 0.25});
        auto fields = readFields(folder / name, volume, options, diagnostics);
        error = fields ? "" : fields.error().toString();
        if (!fields || fields->size() != 1) return std::nullopt;
        return std::move((*fields)[0]);
    }

    void SetUp() override { options.unit = "Cel"; }

    TemporaryFolder folder;
    FieldReadOptions options;
    Diagnostics diagnostics;
    std::string error;
};

TEST(Base64, DecodesJoinedTexts) {
    std::string bytes;
    EXPECT_TRUE(decodeBase64(base64("a") + base64("bcde") + "\n" + base64("fgh"), bytes));
    EXPECT_EQ(bytes, "abcdefgh");
    EXPECT_FALSE(decodeBase64("a*bc", bytes));
    EXPECT_FALSE(decodeBase64("abc", bytes));
}

TEST_F(Lattices, ImageDataInEveryFormat) {
    const std::string plain = bytesOf(nodeValues());
    std::string header, packedHeader;
    appendAs<std::uint32_t>(header, plain.size());
    std::vector<std::string> texts;
    texts.push_back(
        imageText("",
                  "<DataArray type=\"Float32\" Name=\"T\" format=\"ascii\">0 1 2 10 11 12\n100 101 102 110 111 "
                  "112</DataArray>"));
    texts.push_back(imageText("", "<DataArray type=\"Float32\" Name=\"T\" format=\"binary\">\n  " +
                                      base64(header + plain) + "\n</DataArray>"));
    texts.push_back(imageText("", "<DataArray type=\"Float32\" Name=\"T\" format=\"appended\" offset=\"0\"/>",
                              "<AppendedData encoding=\"raw\">\n _" + header + plain + "\n</AppendedData>"));
    texts.push_back(imageText("", "<DataArray type=\"Float32\" Name=\"T\" format=\"appended\" offset=\"0\"/>",
                              "<AppendedData encoding=\"base64\">_" + base64(header + plain) + "</AppendedData>"));
    // Two blocks of zlib.
    const auto pack = [](std::string_view part) {
        ZlibPacker packer(6);
        const auto bytes = packer.pack(std::as_bytes(std::span(part.data(), part.size())));
        return std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    };
    const std::string one = pack(std::string_view(plain).substr(0, 32)), two = pack(std::string_view(plain).substr(32));
    appendAs<std::uint64_t>(packedHeader, 2, 32, 16, one.size(), two.size());
    const std::string attributes = "header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\"";
    texts.push_back(imageText(attributes, "<DataArray type=\"Float32\" Name=\"T\" format=\"binary\">" +
                                              base64(packedHeader) + base64(one + two) + "</DataArray>"));
    texts.push_back(imageText(attributes, "<DataArray type=\"Float32\" Name=\"T\" format=\"appended\" offset=\"0\"/>",
                              "<AppendedData encoding=\"raw\">_" + packedHeader + one + two + "</AppendedData>"));
    for (const std::string& text : texts) {
        const auto field = read("image.vti", text);
        ASSERT_TRUE(field) << error << text.substr(0, 300);
        EXPECT_EQ(field->values, nodeValues());
        EXPECT_EQ(field->head.name, "t");
        EXPECT_EQ(field->head.medium, "all");
        EXPECT_EQ(field->head.lattice.size, (Vec3i{3, 2, 2}));
        EXPECT_EQ(field->head.lattice.first, (Vec3d{1.5, 3.5, 0.5}));
        EXPECT_EQ(field->head.lattice.step, (Vec3d{1, 2, 2}));
        // Every cut of the file is an error and no other value.
        for (std::size_t size = 0; size + 60 < text.size(); size += 7) {
            const auto cut = read("cut.vti", text.substr(0, size));
            EXPECT_TRUE(!cut || cut->values == nodeValues()) << size;
        }
    }
}

TEST_F(Lattices, CellsVectorsAndWholeNumbers) {
    std::string text = imageText(
        "", "<DataArray type=\"Int16\" Name=\"count\" format=\"ascii\">0 1 2 3 4 5 6 7 8 9 10 11</DataArray>");
    EXPECT_FALSE(read("whole.vti", text));
    EXPECT_NE(error.find("'count' (whole numbers)"), std::string::npos) << error;
    options.quantity = "count";
    EXPECT_TRUE(read("whole.vti", text)) << error;
    options.quantity.clear();
    options.unit = "m/s";
    std::string numbers;
    for (int n = 0; n < 36; ++n) numbers += fmt::format("{} ", n);
    const auto vectors =
        read("vectors.vti", imageText("",
                                      "<DataArray type=\"Float64\" Name=\"U\" NumberOfComponents=\"3\" "
                                      "format=\"ascii\">" +
                                          numbers + "</DataArray>"));
    ASSERT_TRUE(vectors) << error;
    EXPECT_EQ(vectors->head.components, 3);
    EXPECT_EQ(vectors->values[1], 3);
    EXPECT_EQ(vectors->values[12], 1);
    text = imageText("", "");
    text.replace(text.find("<PointData></PointData>"), 23,
                 "<CellData><DataArray type=\"Float32\" Name=\"p\" format=\"ascii\">5 nan</DataArray></CellData>");
    const auto cells = read("cells.vti", text);
    ASSERT_TRUE(cells) << error;
    EXPECT_EQ(cells->head.lattice.size, (Vec3i{2, 1, 1}));
    EXPECT_EQ(cells->head.lattice.first, (Vec3d{2, 4.5, 1.5}));
    EXPECT_TRUE(std::isnan(cells->values[1]));
}

TEST_F(Lattices, RectilinearGridAndSeries) {
    const auto grid = [](std::string_view values) {
        return fmt::format(
            "<VTKFile type=\"RectilinearGrid\" byte_order=\"LittleEndian\"><RectilinearGrid WholeExtent=\"0 2 0 1 0 "
            "1\"><Piece "
            "Extent=\"0 2 0 1 0 1\"><PointData><DataArray type=\"Float32\" Name=\"T\" "
            "format=\"ascii\">{}</DataArray></PointData>"
            "<Coordinates><DataArray type=\"Float32\" format=\"ascii\">0 1 4</DataArray><DataArray type=\"Float32\" "
            "format=\"ascii\">0 1</DataArray><DataArray type=\"Float32\" format=\"ascii\">1 "
            "2</DataArray></Coordinates></Piece>"
            "</RectilinearGrid></VTKFile>",
            values);
    };
    const auto one = read("one.vtr", grid("0 1 2 10 11 12 100 101 102 110 111 112"));
    ASSERT_TRUE(one) << error;
    EXPECT_EQ(one->head.lattice.positions[0], (std::vector<double>{-0.5, 1.5, 7.5}));
    EXPECT_EQ(one->values, nodeValues());
    writeText(folder / "two.vtr", grid("1 1 1 1 1 1 1 1 1 1 1 1"));
    const auto list = [](std::string_view second) {
        return fmt::format(
            "<VTKFile type=\"Collection\"><Collection><DataSet timestep=\"0\" file=\"one.vtr\"/><DataSet "
            "timestep=\"2.5\" "
            "file=\"{}\"/></Collection></VTKFile>",
            second);
    };
    const auto series = read("all.pvd", list("two.vtr"));
    ASSERT_TRUE(series) << error;
    EXPECT_EQ(series->head.times, (std::vector<double>{0, 2.5}));
    EXPECT_EQ(series->values.size(), 24u);
    EXPECT_EQ(series->values[12], 1);
    EXPECT_FALSE(read("all.pvd", list("../two.vtr")));
    EXPECT_NE(error.find("outside of the folder"), std::string::npos) << error;
    EXPECT_FALSE(read("bad.vtr", grid("0 1 2")));
    EXPECT_NE(error.find("other values than the lattice has places"), std::string::npos) << error;
}

TEST_F(Lattices, Nrrd) {
    const std::string head =
        "NRRD0005\ncontent: T\ntype: float\ndimension: 3\nsizes: 3 2 2\nspace directions: (0.5,0,0) (0,1,0) (0,0,1)\n"
        "space origin: (1,2,0.5)\nendian: little\nsample units: K\n";
    const std::string plain = bytesOf(nodeValues());
    options.unit = "Cel";
    const auto raw = read("raw.nrrd", head + "encoding: raw\n\n" + plain);
    ASSERT_TRUE(raw) << error;
    EXPECT_EQ(raw->head.lattice.first, (Vec3d{1.5, 3.5, 0.5}));
    EXPECT_FLOAT_EQ(raw->values[11], 112 - 273.15f);
    options.unit.clear();
    const auto bytes = gzipBytes(std::as_bytes(std::span(plain.data(), plain.size())));
    const std::string packed(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const auto gzip = read("gzip.nrrd", head + "encoding: gzip\n\n" + packed);
    ASSERT_TRUE(gzip) << error;
    EXPECT_EQ(gzip->values, nodeValues());
    EXPECT_EQ(gzip->head.unit, "K");
    EXPECT_FALSE(read("cut.nrrd", head + "encoding: raw\n\n" + plain.substr(1)));
    EXPECT_NE(error.find("47 bytes, and the sizes say 48"), std::string::npos) << error;
    EXPECT_FALSE(read("cut.nrrd", head + "encoding: gzip\n\n" + packed.substr(0, 20)));
    EXPECT_FALSE(read("none.xyz", "hello"));
    EXPECT_NE(error.find("the format is not known"), std::string::npos) << error;
    options.places = folder / "none.xyz";
    EXPECT_FALSE(read("raw.nrrd", head + "encoding: raw\n\n" + plain));
    EXPECT_NE(error.find("--places"), std::string::npos) << error;
}

}  // namespace
}  // namespace svt::field_readers
