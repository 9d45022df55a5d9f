#include <svt/core/temporary_folder_test.hpp>
#include <svt/image/color.hpp>
#include <svt/image/png.hpp>
#include <svt/image/tiny_jpeg_test.hpp>
#include <svt/readers/citygml/citygml_documents_test.hpp>
#include <svt/readers/ifc/ifc_documents_test.hpp>
#include <svt/readers/read_model.hpp>
#include <svt/readers/textures/covered_mean.hpp>
#include <svt/readers/textures/texture_colors.hpp>

#include <gtest/gtest.h>

#include <fstream>
#include <limits>
#include <set>

namespace svt::readers::textures {
namespace {

using image::Image;
using image::Rgba8;

constexpr Rgba8 kRed{255, 0, 0, 255}, kBlue{0, 0, 255, 255};

// The left half is red, the right half blue.
Image<Rgba8> twoHalves(std::int32_t size) {
    Image<Rgba8> image(size, size, kRed);
    for (std::int32_t y = 0; y < size; ++y)
        for (std::int32_t x = size / 2; x < size; ++x) image.at(x, y) = kBlue;
    return image;
}

void writeText(const std::filesystem::path& path, std::string_view text) {
    std::ofstream(path, std::ios::binary).write(text.data(), static_cast<std::streamsize>(text.size()));
}

struct ModelFile {
    Diagnostics log;
    Result<model::BuildingModel> result;

    explicit ModelFile(const std::filesystem::path& path, const ReadOptions& options = {})
        : result(readModel(path, options, &log)) {}

    // "255 0 0"; "none" without material, "unknown" without colour. All polygons of the feature must agree.
    std::string colorOf(std::string_view id) const {
        std::set<std::int32_t> materials;
        for (const model::Feature& feature : result->features)
            if (feature.id == id)
                for (const model::Geometry& geometry : feature.geometries) {
                    for (const model::SurfaceUse& use : geometry.surfaces)
                        materials.insert(result->polygons[use.polygon].material);
                    for (const model::Solid& solid : geometry.solids)
                        for (const model::SurfaceUse& use : solid.exterior)
                            materials.insert(result->polygons[use.polygon].material);
                }
        if (materials.size() != 1) return "several";
        if (*materials.begin() < 0) return "none";
        const model::Material& material = result->materials[static_cast<std::size_t>(*materials.begin())];
        if (!material.hasColor) return "unknown";
        const auto byte = [](float channel) { return std::lround(channel * 255); };
        return fmt::format("{} {} {}", byte(material.diffuse.x), byte(material.diffuse.y), byte(material.diffuse.z));
    }
    std::string note(Code code = Code::BadImage) const {
        for (const Diagnostic& item : log.items())
            if (item.code == code) return item.message;
        return {};
    }
};

std::string square(std::string_view id, double z) {
    return fmt::format(
        "<gml:surfaceMember><gml:Polygon gml:id=\"{0}\"><gml:exterior><gml:LinearRing gml:id=\"{0}_r\">"
        "<gml:posList srsDimension=\"3\">0 0 {1} 4 0 {1} 4 4 {1} 0 4 {1} 0 0 {1}</gml:posList>"
        "</gml:LinearRing></gml:exterior></gml:Polygon></gml:surfaceMember>",
        id, z);
}

std::string surface(std::string_view className, std::string_view id, std::string_view polygons) {
    return fmt::format(
        "<bldg:boundedBy><bldg:{0} gml:id=\"{1}\"><bldg:lod2MultiSurface><gml:MultiSurface>{2}"
        "</gml:MultiSurface></bldg:lod2MultiSurface></bldg:{0}></bldg:boundedBy>",
        className, id, polygons);
}

// Texture coordinates of a square from `u0` to `u1`.
std::string target(std::string_view polygon, double u0, double u1) {
    return fmt::format(
        "<app:target uri=\"#{0}\"><app:TexCoordList><app:textureCoordinates ring=\"#{0}_r\">"
        "{1} 0 {2} 0 {2} 1 {1} 1 {1} 0</app:textureCoordinates></app:TexCoordList></app:target>",
        polygon, u0, u1);
}

std::string texture(std::string_view file, std::string_view targets) {
    return fmt::format(
        "<app:surfaceDataMember><app:ParameterizedTexture><app:imageURI>{}</app:imageURI>{}"
        "</app:ParameterizedTexture></app:surfaceDataMember>",
        file, targets);
}

std::string appearance(std::string_view theme, std::string_view data) {
    return fmt::format(
        "<app:appearanceMember><app:Appearance><app:theme>{}</app:theme>{}</app:Appearance>"
        "</app:appearanceMember>",
        theme, data);
}

std::string building(std::string_view surfaces) {
    return fmt::format("<core:cityObjectMember><bldg:Building gml:id=\"b\">{}</bldg:Building></core:cityObjectMember>",
                       surfaces);
}

// A house with two walls and a roof, and one photograph for all of them.
class TextureFiles : public ::testing::Test {
protected:
    void SetUp() override {
        std::filesystem::create_directory(folder / "appearance");
        ASSERT_TRUE(image::writePng(folder / "appearance" / "atlas.png", twoHalves(64)).hasValue());
    }
    ModelFile readHouse(std::string_view appearances, const ReadOptions& options = {}) {
        const std::string walls = surface("WallSurface", "w1", square("p1", 0)) +
                                  surface("WallSurface", "w2", square("p2", 1)) +
                                  surface("RoofSurface", "roof", square("p3", 2));
        writeText(folder / "house.gml", gmltest::cityModel(2, building(walls) + std::string(appearances)));
        return ModelFile(folder / "house.gml", options);
    }
    svt::test::TemporaryFolder folder;
};

TEST_F(TextureFiles, SurfacesGetTheMeanOfTheirPartOfTheImage) {
    const ModelFile house = readHouse(appearance(
        "photo", texture("appearance/atlas.png", target("p1", 0, 0.5) + target("p2", 0, 0.5) + target("p3", 0.5, 1))));
    ASSERT_TRUE(house.result.hasValue()) << house.result.error().message();
    EXPECT_EQ(house.colorOf("w1"), "255 0 0");
    EXPECT_EQ(house.colorOf("w2"), "255 0 0");
    EXPECT_EQ(house.colorOf("roof"), "0 0 255");
    EXPECT_EQ(house.note(), "");
    for (const model::Feature& feature : house.result->features)
        EXPECT_EQ(feature.className.find("Phase"), std::string::npos);
}

// Half red and half blue light; the mean of the bytes would be 128.
TEST_F(TextureFiles, WallsOfAHouseShareOneMeanInLinearLight) {
    const ModelFile house =
        readHouse(appearance("photo", texture("appearance/atlas.png", target("p1", 0, 0.5) + target("p2", 0.5, 1))));
    EXPECT_EQ(house.colorOf("w1"), "189 0 189");
    EXPECT_EQ(house.colorOf("w2"), "189 0 189");
    EXPECT_EQ(house.colorOf("roof"), "none");
    EXPECT_EQ(house.result->materials.size(), 1U);
}

TEST_F(TextureFiles, MaterialsTakePrecedenceAndOneThemeIsUsed) {
    const std::string material =
        "<app:surfaceDataMember><app:X3DMaterial><app:diffuseColor>0 1 0</app:diffuseColor><app:target>#p1</app:target>"
        "</app:X3DMaterial></app:surfaceDataMember>";
    const ModelFile house =
        readHouse(appearance("a", material) +
                  appearance("b", texture("appearance/atlas.png", target("p1", 0, 0.5) + target("p2", 0, 0.5))) +
                  appearance("c", texture("appearance/atlas.png", target("p2", 0.5, 1) + target("p3", 0.5, 1))));
    EXPECT_EQ(house.colorOf("w1"), "0 255 0");
    EXPECT_EQ(house.colorOf("w2"), "255 0 0");
    EXPECT_EQ(house.colorOf("roof"), "none");
}

// Exporters write a grey or white material below each texture.
TEST_F(TextureFiles, AGreyMaterialGivesWayToATextureThatCanBeUsed) {
    const std::string grey =
        "<app:surfaceDataMember><app:X3DMaterial><app:diffuseColor>0.6 0.6 0.6</app:diffuseColor>"
        "<app:target>#p1</app:target><app:target>#p2</app:target></app:X3DMaterial></app:surfaceDataMember>";
    const std::string glass =
        "<app:surfaceDataMember><app:X3DMaterial><app:diffuseColor>1 1 1</app:diffuseColor>"
        "<app:transparency>0.5</app:transparency><app:target>#p3</app:target></app:X3DMaterial></"
        "app:surfaceDataMember>";
    const std::string red = texture("appearance/atlas.png", target("p1", 0, 0.5) + target("p3", 0, 0.5));
    const ModelFile house = readHouse(appearance("a", grey + glass + red + texture("no.png", target("p2", 0, 1))));
    EXPECT_EQ(house.colorOf("w1"), "255 0 0");
    EXPECT_EQ(house.colorOf("w2"), "153 153 153");
    EXPECT_EQ(house.colorOf("roof"), "255 255 255");
}

TEST_F(TextureFiles, ReadsJpegsAndNamesWithBlanksAndBackslashes) {
    std::filesystem::create_directory(folder / "my images");
    const std::vector<std::byte> jpeg = image::test::tinyJpeg();
    writeText(folder / "my images" / "red.jpg", {reinterpret_cast<const char*>(jpeg.data()), jpeg.size()});
    const ModelFile house =
        readHouse(appearance("photo", texture("my%20images\\red.jpg", target("p1", 0, 0.5) + target("p3", 0, 1))));
    EXPECT_EQ(house.colorOf("w1"), "197 41 33");
    EXPECT_EQ(house.colorOf("roof"), "197 41 33");
}

TEST_F(TextureFiles, AnImageWithoutCoordinatesGivesItsMean) {
    const ModelFile house =
        readHouse(appearance("photo", texture("appearance/atlas.png", "<app:target uri=\"#p3\"/>")));
    EXPECT_EQ(house.colorOf("roof"), "189 0 189");
}

TEST_F(TextureFiles, UnusableImagesGiveOneNote) {
    writeText(folder / "broken.png", "\x89PNG\r\n\x1A\nbroken");
    const ModelFile house = readHouse(appearance("photo", texture("missing.png", target("p1", 0, 1)) +
                                                              texture("broken.png", target("p2", 0, 1)) +
                                                              texture("appearance/atlas.png", target("p3", 0, 0.5))));
    ASSERT_TRUE(house.result.hasValue());
    EXPECT_EQ(house.colorOf("w1"), "none");
    EXPECT_EQ(house.colorOf("w2"), "none");
    EXPECT_EQ(house.colorOf("roof"), "255 0 0");
    EXPECT_EQ(house.log.count(Code::BadImage), 1U);
    EXPECT_EQ(house.note(),
              "2 of 3 images of textures cannot be used, and their surfaces keep their other colours; the first is "
              "'missing.png': the file is missing");
}

TEST_F(TextureFiles, OnlyFilesInTheFolderOfTheModelAreRead) {
    const svt::test::TemporaryFolder other;
    ASSERT_TRUE(image::writePng(other / "red.png", twoHalves(4)).hasValue());
    std::filesystem::create_symlink(other / "red.png", folder / "link.png");
    for (const std::string& name : {(other / "red.png").string(), "../" + other.path().filename().string() + "/red.png",
                                    std::string("http://example.org/red.png"), std::string("link.png"),
                                    std::string("appearance"), std::string("C:\\red.png")}) {
        const ModelFile house = readHouse(appearance("photo", texture(name, target("p1", 0, 1))));
        EXPECT_EQ(house.colorOf("w1"), "none") << name;
        EXPECT_EQ(house.log.count(Code::BadImage), 1U) << name;
    }
}

TEST_F(TextureFiles, ModelsInMemoryHaveNoImages) {
    const std::string text =
        gmltest::cityModel(2, building(surface("WallSurface", "w1", square("p1", 0))) +
                                  appearance("photo", texture("appearance/atlas.png", target("p1", 0, 0.5))));
    Diagnostics log;
    const auto model = readModel(gmltest::bytesOf(text), (folder / "house.gml").string(), {}, &log);
    ASSERT_TRUE(model.hasValue());
    EXPECT_EQ(model->polygons.front().material, -1);
    EXPECT_EQ(log.count(Code::BadImage), 0U);
    ReadOptions options;
    options.imageFolder = folder.path().string();
    const auto withImages = readModel(gmltest::bytesOf(text), "house.gml", options, &log);
    EXPECT_EQ(withImages->polygons.front().material, 0);
}

TEST_F(TextureFiles, ThreadsDoNotChangeTheColors) {
    std::string data;
    for (int i = 0; i < 12; ++i) {
        Image<Rgba8> noise(31, 17);
        for (std::size_t n = 0; n < noise.pixels().size(); ++n)
            noise.pixels()[n] = {static_cast<std::uint8_t>(n * 7 + static_cast<std::size_t>(i)),
                                 static_cast<std::uint8_t>(n * 13), 90, 255};
        const std::string name = fmt::format("appearance/{}.png", i);
        ASSERT_TRUE(image::writePng(folder / name, noise).hasValue());
        data += texture(name, target(fmt::format("p{}", i % 3 + 1), 0.1 * i, 0.7));
    }
    ReadOptions one, four;
    one.threads = 1;
    four.threads = 4;
    const ModelFile a = readHouse(appearance("photo", data), one), b = readHouse(appearance("photo", data), four);
    for (const std::string_view id : {"w1", "w2", "roof"}) EXPECT_EQ(a.colorOf(id), b.colorOf(id));
    EXPECT_NE(a.colorOf("roof"), "none");
}

// In CityGML 3 the target is an element of an association; a reference repeats a texture in another appearance.
TEST_F(TextureFiles, ReadsTheFormOfCityGml3) {
    const std::string list =
        "<app:TexCoordList><app:textureCoordinates>0.5 0 1 0 1 1 0.5 1 0.5 0</app:textureCoordinates>"
        "<app:ring>#p1_r</app:ring></app:TexCoordList>";
    const std::string association =
        "<app:TextureAssociation><app:target>#p1</app:target><app:textureParameterization>" + list +
        "</app:textureParameterization></app:TextureAssociation>";
    const std::string data =
        "<app:surfaceData><app:ParameterizedTexture gml:id=\"t\"><app:imageURI>appearance/atlas.png</app:imageURI>"
        "<app:textureParameterization>" +
        association + "</app:textureParameterization></app:ParameterizedTexture></app:surfaceData>";
    writeText(
        folder / "house.gml",
        gmltest::cityModel(
            3, fmt::format(
                   "<core:cityObjectMember><bldg:Building gml:id=\"b\"><core:boundary><con:RoofSurface gml:id=\"roof\">"
                   "<core:lod2MultiSurface><gml:MultiSurface>{}</gml:MultiSurface></core:lod2MultiSurface></"
                   "con:RoofSurface>"
                   "</core:boundary></bldg:Building></core:cityObjectMember>{}",
                   square("p1", 1), appearance("x", data))));
    const ModelFile house(folder / "house.gml");
    ASSERT_TRUE(house.result.hasValue()) << house.result.error().message();
    EXPECT_EQ(house.colorOf("roof"), "0 0 255");
}

// u = x / 8, so the square of 4 m covers the left half.
TEST_F(TextureFiles, ATexCoordGenComputesTheCoordinates) {
    const ModelFile house = readHouse(appearance(
        "photo", texture("appearance/atlas.png",
                         "<app:target uri=\"#p1\"><app:TexCoordGen><app:worldToTexture>0.125 0 0 0 0 0.25 0 0 0 0 0 1"
                         "</app:worldToTexture></app:TexCoordGen></app:target>")));
    EXPECT_EQ(house.colorOf("w1"), "255 0 0");
}

// Pixels of 0.25 m: the image of 64 pixels reaches from x = -12 to 4, so the square lies in its right half.
TEST_F(TextureFiles, AGeoreferencedTextureLiesOnTheMap) {
    const std::string data =
        "<app:surfaceDataMember><app:GeoreferencedTexture><app:imageURI>appearance/atlas.png</app:imageURI>"
        "<app:target>#p3</app:target></app:GeoreferencedTexture></app:surfaceDataMember>";
    EXPECT_EQ(readHouse(appearance("map", data)).colorOf("roof"), "189 0 189");
    writeText(folder / "appearance" / "atlas.pgw", "0.25\n0\n0\n-0.25\n-11.875\n11.875\n");
    EXPECT_EQ(readHouse(appearance("map", data)).colorOf("roof"), "0 0 255");
}

constexpr std::string_view kCityJson =
    R"({"type":"CityJSON","version":"2.0","transform":{"scale":[1,1,1],"translate":[0,0,0]},"appearance":{)"
    R"("default-theme-texture":"b","textures":[{"type":"PNG","image":"appearance/atlas.png"}],)"
    R"("vertices-texture":[[0,0],[0.5,0],[0.5,1],[0,1],[1,0],[1,1]]},"CityObjects":)";
constexpr std::string_view kJsonVertices = R"("vertices":[[0,0,0],[4,0,0],[4,4,0],[0,4,0]])";

std::string jsonObject(std::string_view id, std::string_view texture) {
    return fmt::format(R"({{"{}":{{"type":"Building","geometry":[{{"type":"MultiSurface","lod":"2",)"
                       R"("boundaries":[[[0,1,2,3]]],"texture":{}}}]}}}})",
                       id, texture);
}

TEST_F(TextureFiles, ReadsTexturesOfCityJson) {
    writeText(folder / "a.city.json",
              fmt::format("{}{},{}}}", kCityJson,
                          jsonObject("b", R"({"a":{"values":[[[0,0,1,2,3]]]},"b":{"values":[[[0,1,4,5,2]]]}})"),
                          kJsonVertices));
    const ModelFile model(folder / "a.city.json");
    ASSERT_TRUE(model.result.hasValue()) << model.result.error().message();
    EXPECT_EQ(model.colorOf("b"), "0 0 255");
}

TEST_F(TextureFiles, TexturesOfCityJsonThatDoNotExistAreLeftOut) {
    for (const std::string_view values :
         {"[[[7,0,1,2,3]]]", "[[[null]]]", "[[[]]]", "[[]]", "[7]", "null", "[[[-1]]]"}) {
        writeText(folder / "a.city.json",
                  fmt::format("{}{},{}}}", kCityJson,
                              jsonObject("b", fmt::format(R"({{"b":{{"values":{}}}}})", values)), kJsonVertices));
        const ModelFile model(folder / "a.city.json");
        ASSERT_TRUE(model.result.hasValue()) << values;
        EXPECT_EQ(model.colorOf("b"), "none") << values;
    }
    writeText(
        folder / "a.city.json",
        fmt::format("{}{},{}}}", kCityJson, jsonObject("b", R"({"b":{"values":[[[0,1,99,5,2]]]}})"), kJsonVertices));
    EXPECT_EQ(ModelFile(folder / "a.city.json").colorOf("b"), "189 0 189");  // the whole image
}

TEST_F(TextureFiles, MaterialsOfCityJsonTakePrecedenceUnlessTheyAreGrey) {
    for (const auto& [diffuse, image, expected] : {std::tuple("[0,1,0]", "appearance/atlas.png", "0 255 0"),
                                                   {"[1,1,1]", "appearance/atlas.png", "255 0 0"},
                                                   {"[1,1,1]", "missing.png", "255 255 255"}}) {
        writeText(folder / "a.city.json",
                  fmt::format(
                      R"({{"type":"CityJSON","version":"2.0","transform":{{"scale":[1,1,1],"translate":[0,0,0]}},)"
                      R"("appearance":{{"materials":[{{"name":"m","diffuseColor":{}}}],"textures":[{{"image":"{}"}}],)"
                      R"("vertices-texture":[[0,0],[0.5,0],[0.5,1],[0,1]]}},"CityObjects":{{"b":{{)"
                      R"("type":"Building","geometry":[{{"type":"MultiSurface","lod":"2","boundaries":[[[0,1,2,3]]],)"
                      R"("material":{{"b":{{"value":0}}}},"texture":{{"b":{{"values":[[[0,0,1,2,3]]]}}}}}}]}}}},{}}})",
                      diffuse, image, kJsonVertices));
        EXPECT_EQ(ModelFile(folder / "a.city.json").colorOf("b"), expected);
    }
}

TEST_F(TextureFiles, LinesOfASequenceHaveTexturesOfTheirOwn) {
    ASSERT_TRUE(image::writePng(folder / "blue.png", Image<Rgba8>(2, 2, kBlue)).hasValue());
    const std::string own = R"(,"appearance":{"textures":[{"type":"PNG","image":"blue.png"}],)"
                            R"("vertices-texture":[[0,0],[1,0],[1,1],[0,1]]})";
    writeText(
        folder / "a.city.jsonl",
        fmt::format("{}{{}},\"vertices\":[]}}\n{{\"type\":\"CityJSONFeature\",\"id\":\"x\",\"CityObjects\":{},{}}}\n"
                    "{{\"type\":\"CityJSONFeature\",\"id\":\"y\",\"CityObjects\":{},{}{}}}\n",
                    kCityJson, jsonObject("x", R"({"b":{"values":[[[0,0,1,2,3]]]}})"), kJsonVertices,
                    jsonObject("y", R"({"b":{"values":[[[0,0,1,2,3]]]}})"), kJsonVertices, own));
    const ModelFile model(folder / "a.city.jsonl");
    ASSERT_TRUE(model.result.hasValue()) << model.result.error().message();
    EXPECT_EQ(model.colorOf("x"), "255 0 0");
    EXPECT_EQ(model.colorOf("y"), "0 0 255");
}

// A triangle with the style of `textures`; #210 is its face set.
std::string texturedIfc(std::string_view textures, std::string_view schema = "IFC4") {
    return test::ifcWithItem(
        fmt::format("#200=IFCTRIANGULATEDFACESET(#201,$,$,((1,2,3)),$);\n"
                    "#201=IFCCARTESIANPOINTLIST3D(((0.,0.,0.),(1000.,0.,0.),(0.,1000.,0.)));\n"
                    "#202=IFCSTYLEDITEM(#200,(#203),$);\n#203=IFCSURFACESTYLE('Brick',.BOTH.,(#204));\n"
                    "#204=IFCSURFACESTYLEWITHTEXTURES((#205));\n{}",
                    textures),
        schema);
}

TEST_F(TextureFiles, ReadsImagesOfIfc) {
    const std::string image = "#205=IFCIMAGETEXTURE(.T.,.T.,$,$,$,'appearance/atlas.png');\n";
    writeText(folder / "a.ifc", texturedIfc(image));
    EXPECT_EQ(ModelFile(folder / "a.ifc").colorOf("wall"), "189 0 189");
    writeText(folder / "a.ifc", texturedIfc(image + "#206=IFCINDEXEDTRIANGLETEXTUREMAP((#205),#200,#207,((1,2,3)));\n"
                                                    "#207=IFCTEXTUREVERTEXLIST(((0.,0.),(0.4,0.),(0.,1.)));\n"));
    EXPECT_EQ(ModelFile(folder / "a.ifc").colorOf("wall"), "255 0 0");
    writeText(folder / "a.ifc", texturedIfc("#205=IFCIMAGETEXTURE(.T.,.T.,$,$,$,'missing.png');\n"));
    const ModelFile missing(folder / "a.ifc");
    EXPECT_EQ(missing.colorOf("wall"), "unknown");
    EXPECT_NE(missing.note().find("1 of 1 images of textures"), std::string::npos) << missing.note();
}

TEST_F(TextureFiles, AGreyShadingOfIfcGivesWayToATexture) {
    const std::string shaded =
        "#205=IFCIMAGETEXTURE(.T.,.T.,$,$,$,'{}');\n#206=IFCSURFACESTYLESHADING(#207,0.);\n"
        "#207=IFCCOLOURRGB($,{},1.,1.);\n";
    const auto colorWith = [&](std::string_view image, std::string_view red) {
        std::string text = texturedIfc(fmt::format(fmt::runtime(shaded), image, red));
        text.replace(text.find("(#204)"), 6, "(#206,#204)");
        writeText(folder / "a.ifc", text);
        return ModelFile(folder / "a.ifc").colorOf("wall");
    };
    EXPECT_EQ(colorWith("appearance/atlas.png", "1."), "189 0 189");
    EXPECT_EQ(colorWith("appearance/atlas.png", "0."), "0 255 255");
    EXPECT_EQ(colorWith("missing.png", "1."), "255 255 255");
}

TEST_F(TextureFiles, ReadsPixelsAndFilesWithinIfc) {
    writeText(folder / "a.ifc", texturedIfc("#205=IFCPIXELTEXTURE(.T.,.T.,$,$,$,2,1,3,(\"0FF0000\",\"0FF0000\"));\n"));
    EXPECT_EQ(ModelFile(folder / "a.ifc").colorOf("wall"), "255 0 0");
    writeText(folder / "a.ifc", texturedIfc("#205=IFCPIXELTEXTURE(.T.,.T.,.TEXTURE.,$,1,1,1,(\"0FF\"));\n", "IFC2X3"));
    EXPECT_EQ(ModelFile(folder / "a.ifc").colorOf("wall"), "255 255 255");
    std::string hex;
    const std::vector<std::byte> png = *image::encodePng(Image<Rgba8>(3, 3, kBlue));
    for (const std::byte byte : png) hex += fmt::format("{:02X}", std::to_integer<int>(byte));
    writeText(folder / "a.ifc", texturedIfc("#205=IFCBLOBTEXTURE(.T.,.T.,$,$,$,'PNG',\"0" + hex + "\");\n"));
    EXPECT_EQ(ModelFile(folder / "a.ifc").colorOf("wall"), "0 0 255");
    writeText(folder / "a.ifc", texturedIfc("#205=IFCBLOBTEXTURE(.T.,.T.,$,$,$,'PNG',\"0FFXX\");\n"));
    EXPECT_EQ(ModelFile(folder / "a.ifc").colorOf("wall"), "unknown");
}

image::LinearImage halves() { return *image::decodeLinear(*image::encodePng(twoHalves(8))); }

std::optional<Vec3d> meanOf(const std::vector<TexturePoint>& points, std::vector<std::uint32_t> ends = {},
                            Wrap wrap = Wrap::Repeat, bool areSeparate = false) {
    if (ends.empty()) ends = {static_cast<std::uint32_t>(points.size())};
    return coveredMean(halves(), {points, ends, wrap, areSeparate});
}

std::vector<TexturePoint> box(double u0, double u1, double v0 = 0, double v1 = 8) {
    return {{u0, v0}, {u1, v0}, {u1, v1}, {u0, v1}};
}

TEST(CoveredMean, CountsTexelsWithinTheRing) {
    EXPECT_EQ(meanOf(box(0, 4)), (Vec3d{1, 0, 0}));
    EXPECT_EQ(meanOf(box(4, 8)), (Vec3d{0, 0, 1}));
    const std::optional<Vec3d> quarter = meanOf(box(2, 6));
    ASSERT_TRUE(quarter);
    EXPECT_NEAR(quarter->x, 0.5, 1e-12);
    EXPECT_NEAR(meanOf({{0, 0}, {8, 0}, {0, 8}})->x, 0.75, 0.02);  // a triangle: three quarters are red
    EXPECT_EQ(meanOf(box(1.2, 1.3, 2, 2.1)), (Vec3d{1, 0, 0}));    // within one texel
}

TEST(CoveredMean, HolesDoNotCount) {
    std::vector<TexturePoint> rings = box(0, 8);
    const std::vector<TexturePoint> hole = box(0, 4);
    rings.insert(rings.end(), hole.begin(), hole.end());
    EXPECT_EQ(meanOf(rings, {4, 8}), (Vec3d{0, 0, 1}));
    EXPECT_NEAR(meanOf(rings, {4, 8}, Wrap::Repeat, true)->x, 0.75, 0.26);  // two polygons: 0.5 and 1
    EXPECT_GT(meanOf(rings, {4, 8}, Wrap::Repeat, true)->x, 0.5);
}

TEST(CoveredMean, WrapsCoordinates) {
    EXPECT_EQ(meanOf(box(8, 12)), (Vec3d{1, 0, 0}));
    EXPECT_EQ(meanOf(box(-4, 0)), (Vec3d{0, 0, 1}));
    EXPECT_EQ(meanOf(box(8, 12), {}, Wrap::Mirror), (Vec3d{0, 0, 1}));
    EXPECT_EQ(meanOf(box(8, 12), {}, Wrap::Clamp), (Vec3d{0, 0, 1}));
    EXPECT_EQ(meanOf(box(9, 12), {}, Wrap::None), std::nullopt);
    EXPECT_EQ(meanOf(box(0, 1e9)), std::nullopt);
}

TEST(CoveredMean, RingsWithoutAreaAndBadNumbers) {
    EXPECT_EQ(meanOf({{1, 1}, {2, 1}, {3, 1}}), (Vec3d{1, 0, 0}));
    EXPECT_EQ(meanOf({{1, 1}, {1, 5}}), (Vec3d{1, 0, 0}));
    EXPECT_EQ(meanOf({{1, 1}, {std::numeric_limits<double>::quiet_NaN(), 1}, {2, 2}}), std::nullopt);
    EXPECT_EQ(meanOf({{0, 0}, {std::numeric_limits<double>::infinity(), 1}, {2, 2}}), std::nullopt);
}

}  // namespace
}  // namespace svt::readers::textures
