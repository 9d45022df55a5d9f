// Every kind of bad input, one defect per file: the command ends within its time and memory limits, with the
// documented exit code, and reports what was found.
#include "run_command.hpp"
#include "small_model.hpp"

#include <svt/core/deflate.hpp>
#include <svt/core/machine.hpp>

#include <fmt/format.h>

#include <functional>
#include <regex>
#include <span>

namespace svt::test {
namespace {

using Arguments = std::vector<std::string>;

struct BadInput {
    const char* name;                    ///< of the test
    const char* what;                    ///< the defect, in words
    const char* file;                    ///< written before the command runs; empty: none
    std::function<std::string()> bytes;  ///< its content
    Arguments arguments;
    int exitCode;
    const char* message;  ///< regular expression, found in stderr
};

void PrintTo(const BadInput& input, std::ostream* stream) { *stream << input.what; }

class BadInputTest : public ::testing::TestWithParam<BadInput> {};

TEST_P(BadInputTest, EndsInTimeWithCodeAndMessage) {
    const BadInput& input = GetParam();
    const TemporaryFolder folder;
    if (*input.file != '\0') writeText(folder / input.file, input.bytes());
    const CommandResult result = runSvt(folder.path(), input.arguments);
    EXPECT_FALSE(result.isTimeout) << input.what;
    EXPECT_EQ(result.exitCode, input.exitCode) << input.what << ": " << result.toString();
    EXPECT_TRUE(std::regex_search(result.err, std::regex(input.message)))
        << input.what << "\nexpected: " << input.message << "\nfound: " << result.toString();
    // A failure must leave no output files.
    if (result.exitCode != 0) {
        EXPECT_FALSE(std::filesystem::exists(folder / "o.svt")) << input.what;
    }
}

std::string nameOf(const ::testing::TestParamInfo<BadInput>& info) { return info.param.name; }

const Arguments kBuild{"build", "bad.gml", "-o", "o.svt", "--spacing", "0.5"};
const Arguments kBuildJson{"build", "bad.json", "-o", "o.svt", "--spacing", "0.5"};
const Arguments kCheck{"check", "bad.gml", "--verbose", "--strict"};
const Arguments kCheckJson{"check", "bad.json", "--verbose", "--strict"};

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    if (at == std::string::npos) {
        ADD_FAILURE() << "the document has no '" << from << "'";
        return text;
    }
    return text.replace(at, from.size(), to);
}

std::string repeated(std::string_view text, std::size_t count) {
    std::string all;
    all.reserve(text.size() * count);
    for (std::size_t i = 0; i < count; ++i) all += text;
    return all;
}

// UTF-16 with byte order mark, little-endian, of ASCII.
std::string utf16(std::string_view text) {
    std::string wide = "\xFF\xFE";
    for (const char c : text) {
        wide += c;
        wide += '\0';
    }
    return wide;
}

std::vector<Face> box() { return boxFaces(500000, 5400000, 100, 500004, 5400006, 103); }

// A building `b` whose solid has `face` in place of its roof.
std::string withRoof(const Face& face) {
    auto faces = box();
    faces[1] = face;
    return cityModel(building("b", solid(faces)));
}

std::string withExtraFace(const Face& face) {
    auto faces = box();
    faces.push_back(face);
    return cityModel(building("b", solid(faces)));
}

std::string oneBox(std::string_view inside = {}) { return cityModel(building("b", solid(box()), inside)); }

std::string nested(std::string_view open, std::string_view close, std::size_t depth) {
    return repeated(open, depth) + repeated(close, depth);
}

// A box, and then no more.
const std::string kCutIfc =
    "ISO-10303-21;\nHEADER;\nFILE_SCHEMA(('IFC4'));\nENDSEC;\nDATA;\n"
    "#3=IFCPROJECT('p',$,'P',$,$,$,$,(),#2);#2=IFCUNITASSIGNMENT((#1));#1=IFCSIUNIT(*,.LENGTHUNIT.,$,.METRE.);"
    "#5=IFCWALL('w',$,'Wall',$,$,$,#6,$,$);#6=IFCPRODUCTDEFINITIONSHAPE($,$,(#7));\n"
    "#7=IFCSHAPEREPRESENTATION($,'Body','CSG',(#8));#8=IFCBLOCK($,1.,2.,3.);\n";

const std::vector<BadInput> kXml{
    {"NotXml", "a text that is no model", "bad.gml", [] { return "hello, world\n"; }, kBuild, kInput,
     "E103 UnknownFormat.*bad\\.gml"},
    {"Empty", "a file of no bytes", "bad.gml", [] { return ""; }, kBuild, kInput, "E103 UnknownFormat.*empty"},
    {"IfcWithoutRecords", "an IFC file that was cut off behind its header", "bad.gml",
     [] { return "ISO-10303-21;\nHEADER;\nENDSEC;\n"; }, kBuild, kInput, "E130 BadStep: bad\\.gml:1: .*cut off"},
    {"StepOfAnotherSchema", "a STEP file of a machine", "bad.gml",
     [] {
         return "ISO-10303-21;\nHEADER;\nFILE_SCHEMA(('AUTOMOTIVE_DESIGN'));\nENDSEC;\nDATA;\n#1=PRODUCT('a');\nENDSEC;"
                "\n";
     },
     kBuild, kInput, "E106 UnknownVersion.*AUTOMOTIVE_DESIGN"},
    {"IfcZipWithoutIfc", "a zip archive that is cut off", "bad.gml", [] { return "PK\x03\x04 and no more"; }, kBuild,
     kInput, "E101 CannotOpen: bad\\.gml: .*zip"},
    {"CutIfc", "an IFC file that was cut off behind a record", "bad.gml", [] { return kCutIfc; }, kBuild, kInput,
     "E137 Truncated: bad\\.gml:7: .*behind the record #8.*--allow-truncated"},
    {"CutIfcChecked", "the same, checked", "bad.gml", [] { return kCutIfc; }, kCheck, kInput, "error E137 Truncated"},
    {"CutIfcPlanned",
     "the same, in a city",
     "bad.ifc",
     [] { return kCutIfc; },
     {"city", "plan", "bad.ifc", "-o", "c"},
     kInput,
     "error E137 Truncated"},
    {"CutIfcAllowed",
     "the same, where that is allowed",
     "bad.gml",
     [] { return kCutIfc; },
     {"check", "bad.gml", "--allow-truncated"},
     kInvalid,
     "warning E137 Truncated: bad\\.gml:7(.|\n)*1 of 1 products"},
    {"CutIfcBuilt",
     "the same, built",
     "bad.gml",
     [] { return kCutIfc; },
     {"build", "bad.gml", "-o", "good.svt", "--spacing", "0.5", "--allow-truncated"},
     kDone,
     "warning E137 Truncated"},
    {"CutIfcPlannedAllowed",
     "the same, in a city that allows it",
     "bad.ifc",
     [] { return kCutIfc; },
     {"city", "plan", "bad.ifc", "-o", "c", "--allow-truncated"},
     kDone,
     "warning E137 Truncated"},
    {"OtherXml", "well-formed XML that is no CityGML", "bad.gml", [] { return "<?xml version='1.0'?><kml/>"; }, kBuild,
     kInput, "E103 UnknownFormat"},
    {"Missing",
     "a file that does not exist",
     "",
     {},
     kBuild,
     kInput,
     "E101 CannotOpen: bad\\.gml: .*(does not exist|No such file)"},
    {"Folder",
     "a folder in place of a file",
     "",
     {},
     {"build", "/tmp", "-o", "o.svt"},
     kInput,
     "E101 CannotOpen: /tmp: .*(folder|regular file)"},
    {"Device",
     "a device in place of a file",
     "",
     {},
     {"build", "/dev/zero", "-o", "o.svt"},
     kInput,
     "E101 CannotOpen: /dev/zero: .*(device|regular file)"},
    {"Truncated", "a file cut in its middle", "bad.gml", [] { return oneBox().substr(0, 1500); }, kBuild, kInput,
     "E102 BadXml: bad\\.gml:[0-9]+:[0-9]+"},
    {"TruncatedInATag", "a file cut inside of a tag", "bad.gml",
     [] {
         const auto t = oneBox();
         return t.substr(0, t.rfind("</bldg:lod2Solid>") + 8);
     },
     kBuild, kInput, "E102 BadXml: bad\\.gml:[0-9]+:[0-9]+"},
    {"WrongEndTag", "an end tag that closes another element", "bad.gml",
     [] { return replaced(oneBox(), "</gml:Solid>", "</gml:Slid>"); }, kBuild, kInput, "E102 BadXml: bad\\.gml:[0-9]+"},
    {"Latin1Undeclared", "Latin-1 bytes without a declaration", "bad.gml",
     [] { return oneBox("<gml:name>Geb\xE4ude</gml:name>"); }, kBuild, kInput, "E108 BadEncoding: bad\\.gml:[0-9]+"},
    {"Utf16CutInHalf", "UTF-16 of an odd number of bytes", "bad.gml", [] { return utf16(oneBox()) + "<"; }, kBuild,
     kInput, "E10[28]"},
    {"Utf16Declared", "UTF-8 bytes declared as UTF-16", "bad.gml", [] { return replaced(oneBox(), "UTF-8", "UTF-16"); },
     kBuild, kInput, "E108 BadEncoding"},
    {"UnknownEncoding", "an encoding that is not read", "bad.gml",
     [] { return replaced(oneBox(), "UTF-8", "EBCDIC-US"); }, kBuild, kInput, "E108 BadEncoding.*ebcdic-us.*UTF-8"},
    {"ZeroBytes", "zero bytes in the middle", "bad.gml",
     [] { return replaced(oneBox(), "<gml:Solid>", std::string("<gml:Solid>\0\0", 13)); }, kBuild, kInput, "E10[28]"},
    {"Doctype", "a document type declaration", "bad.gml",
     [] { return replaced(oneBox(), "<CityModel", "<!DOCTYPE CityModel SYSTEM \"file:///etc/passwd\">\n<CityModel"); },
     kBuild, kInput, "E107 DtdRefused: bad\\.gml:2"},
    {"BillionLaughs", "entities that grow", "bad.gml",
     [] {
         std::string dtd = "<!DOCTYPE CityModel [<!ENTITY a0 \"ha\">";
         for (int i = 1; i < 30; ++i) dtd += fmt::format("<!ENTITY a{} \"&a{};&a{};\">", i, i - 1, i - 1);
         return replaced(oneBox("<gml:name>&a29;</gml:name>"), "<CityModel", dtd + "]>\n<CityModel");
     },
     kBuild, kInput, "E107 DtdRefused"},
    {"DeepNesting", "elements nested 10,000 deep", "bad.gml", [] { return cityModel(nested("<a>", "</a>", 10000)); },
     kBuild, kLimit, "E104 InputTooBig.*depth|E104 InputTooBig.*deep"},
    {"DeepNestingUnclosed", "a million start tags", "bad.gml", [] { return cityModel(repeated("<a>", 1000000)); },
     kBuild, kLimit, "E104 InputTooBig"},
    {"ManyAttributes", "an element with 100,000 attributes", "bad.gml",
     [] {
         std::string all;
         for (int i = 0; i < 100000; ++i) all += fmt::format(" a{}=\"1\"", i);
         return replaced(oneBox(), "<gml:Solid>", "<gml:Solid" + all + ">");
     },
     kBuild, 0, "^$"},
    {"UnknownVersion", "a version of CityGML that is not known", "bad.gml",
     [] { return std::regex_replace(oneBox(), std::regex("/2\\.0\""), "/9.0\""); }, kBuild, kInput,
     "E106 UnknownVersion.*9\\.0"},
    {"NoFeatures", "a model without members", "bad.gml", [] { return cityModel(""); }, kBuild, kInput,
     "E109 EmptyModel"},
    {"FeatureWithoutGeometry", "a building that has no geometry", "bad.gml",
     [] { return cityModel("<cityObjectMember><bldg:Building gml:id=\"b\"/></cityObjectMember>"); }, kBuild, kInput,
     "E109 EmptyModel"},
};
std::string gzipped(const std::string& text) {
    const std::vector<std::byte> packed = gzipBytes(std::as_bytes(std::span(text)));
    return {reinterpret_cast<const char*>(packed.data()), packed.size()};
}

// What would take for ever, or all memory.
const std::vector<BadInput> kEndless{
    {"GzipBomb", "gzip data that unpack to a thousand times their size", "bad.gml",
     [] { return gzipped(std::string(std::size_t{80} << 20, ' ')); }, kBuild, kLimit,
     "E104 InputTooBig: bad\\.gml: .*unpack to more than 67 MB, [0-9]+ times as much.*gunzip"},
    {"GzipOverTheMemory",
     "gzip data that unpack to more than a third of the memory",
     "bad.gml",
     [] { return gzipped(std::string(std::size_t{30} << 20, ' ')); },
     {"build", "bad.gml", "-o", "o.svt", "--memory", "64"},
     kLimit,
     "E104 InputTooBig: bad\\.gml: .*a third of the 64 MB that --memory grants.*gunzip"},
    {"RingOutOfOrder", "a roof of 3,000 points in no order", "bad.gml",
     [] {
         Face roof;
         std::uint32_t state = 1;
         const auto next = [&] { return double((state = state * 1664525u + 1013904223u) >> 8) / double(1 << 24); };
         for (int i = 0; i < 3000; ++i) {
             const double x = 500000 + 4 * next(), y = 5400000 + 6 * next();
             roof += fmt::format("{:.4f} {:.4f} 103 ", x, y);
         }
         return withRoof(roof + roof.substr(0, roof.find(" 103") + 4));
     },
     kCheck, kInvalid,
     "E212 TriangulationFailed: bad\\.gml.*3000 points cross .*more than 6000 places.*near \\(50000[0-9.]+, 540"},
};
INSTANTIATE_TEST_SUITE_P(Endless, BadInputTest, ::testing::ValuesIn(kEndless), nameOf);

TEST(BadInput, ModelOverTheMemoryIsToldWithTheFileAndTheLimit) {
    if (kIsSanitized) GTEST_SKIP() << "no limit is set for a sanitizer";
    const TemporaryFolder folder;
    std::string names;
    for (int i = 0; i < 400'000; ++i)
        names += fmt::format("<cityObjectMember><bldg:Building gml:id=\"b{}\"/></cityObjectMember>", i);
    writeText(folder / "big.gml", cityModel(names));
    const CommandResult given = runSvt(folder.path(), {"build", "big.gml", "-o", "o.svt", "--memory", "64"});
    EXPECT_EQ(given.exitCode, kLimit) << given.toString();
    EXPECT_TRUE(std::regex_search(
        given.err, std::regex("E104 InputTooBig: big\\.gml: .*more memory than the 64 MB that --memory grants; split")))
        << given.err;
    Limits limits;
    limits.memoryBytes = 100'000'000;
    const CommandResult bySystem = runSvt(folder.path(), {"build", "big.gml", "-o", "o.svt"}, limits);
    EXPECT_EQ(bySystem.exitCode, kLimit) << bySystem.toString();
    EXPECT_NE(bySystem.err.find("the 100 MB that ulimit -v grants"), std::string::npos) << bySystem.err;
}

INSTANTIATE_TEST_SUITE_P(Xml, BadInputTest, ::testing::ValuesIn(kXml), nameOf);

constexpr const char* kNear = "500000 5400000 103 500004 5400000 103 500004 5400006 103";

const std::vector<BadInput> kGeometry{
    {"CountOfABillion", "a count of 1e9 that nothing stands behind", "bad.gml",
     [] { return replaced(oneBox(), "<gml:posList>", "<gml:posList count=\"1000000000\">"); }, kBuild, 0, ""},
    {"DimensionOfABillion", "points of 1e9 coordinates", "bad.gml",
     [] { return replaced(oneBox(), "<gml:posList>", "<gml:posList srsDimension=\"1000000000\">"); }, kBuild, 0, ""},
    {"NotANumberCoordinate", "NaN among the coordinates", "bad.gml",
     [] {
         return withRoof(
             "500000 5400000 NaN 500004 5400000 103 500004 5400006 103 500000 5400006 103 500000 5400000 NaN");
     },
     kCheck, kInvalid, "E202 BadCoordinate: bad\\.gml:[0-9]+"},
    {"HugeCoordinate", "a coordinate of 1e308", "bad.gml",
     [] {
         return withRoof(
             "500000 5400000 1e308 500004 5400000 103 500004 5400006 103 500000 5400006 103 500000 5400000 1e308");
     },
     kCheck, kInvalid, "E202 BadCoordinate: bad\\.gml:[0-9]+"},
    {"OverflowingCoordinate", "a coordinate of 1e999", "bad.gml",
     [] { return withRoof("500000 5400000 1e999 500004 5400000 103 500004 5400006 103 500000 5400006 103"); }, kCheck,
     kInvalid, "E202 BadCoordinate: bad\\.gml:[0-9]+"},
    {"TextAsCoordinate", "letters among the coordinates", "bad.gml",
     [] { return withRoof("500000 5400000 abc 500004 5400000 103"); }, kCheck, kInvalid,
     "E(114|202).*bad\\.gml:[0-9]+"},
    {"DecimalComma", "coordinates with decimal commas", "bad.gml",
     [] { return withRoof("500000,5 5400000,5 103,0 500004,5 5400000,5 103,0"); }, kCheck, kInvalid,
     "E(114|202).*bad\\.gml:[0-9]+"},
    {"AllCoordinatesHuge", "a model of nothing but absurd coordinates", "bad.gml",
     [] { return cityModel(building("b", solid(boxFaces(1e307, 1e307, 1e307, 1e308, 1e308, 1e308)))); }, kBuild, kInput,
     "E(202|109)"},
    {"RingOfNoPoint", "a ring without points", "bad.gml", [] { return withRoof(""); }, kCheck, kInvalid,
     "E201 TooFewPoints: bad\\.gml:[0-9]+"},
    {"RingOfOnePoint", "a ring of one point", "bad.gml", [] { return withRoof("500000 5400000 103"); }, kCheck,
     kInvalid, "E201 TooFewPoints: bad\\.gml:[0-9]+"},
    {"RingOfTwoPoints", "a ring of two points", "bad.gml",
     [] { return withRoof("500000 5400000 103 500004 5400000 103 500000 5400000 103"); }, kCheck, kInvalid,
     "E201 TooFewPoints: bad\\.gml:[0-9]+"},
    {"RingOfThreePoints", "a triangle where the roof needs four corners", "bad.gml", [] { return withRoof(kNear); },
     kCheck, kInvalid, "E209 ShellCapped.*leak"},
    {"RingOfEqualPoints", "a ring of one point four times", "bad.gml",
     [] { return withRoof(repeated("500000 5400000 103 ", 4)); }, kCheck, kInvalid, "E20[13].*bad\\.gml"},
    {"HalfAPoint", "coordinates whose number is no multiple of three", "bad.gml",
     [] { return withRoof(std::string(kNear) + " 500000 5400006"); }, kCheck, kInvalid,
     "E(114|20[12]).*bad\\.gml:[0-9]+"},
    {"BowTie", "a ring that crosses itself", "bad.gml",
     [] {
         return withRoof(
             "500000 5400000 103 500004 5400006 103 500004 5400000 103 500000 5400002 103 500000 5400000 103");
     },
     kCheck, kInvalid, "E205 SelfTouchingRing"},
    {"SelfTouching", "a ring that touches itself in a point", "bad.gml",
     [] {
         return withRoof(
             "500000 5400000 103 500004 5400000 103 500002 5400003 103 500004 5400006 103 500000 5400006 103 500002 "
             "5400003 103 500000 5400000 103");
     },
     kCheck, kInvalid, "E205 SelfTouchingRing"},
    {"ZeroArea", "a face without area", "bad.gml",
     [] { return withExtraFace("500000 5400000 100 500004 5400000 100 500002 5400000 100 500000 5400000 100"); },
     kCheck, kInvalid, "E203 ZeroArea"},
    {"DuplicateFace", "the same face twice", "bad.gml", [] { return withExtraFace(box()[1]); }, kCheck, kInvalid,
     "E204 DuplicateFace: bad\\.gml:[0-9]+ \\(id 'b'\\)"},
    {"NonPlanar", "a face that is bent by a metre", "bad.gml",
     [] {
         return withRoof(
             "500000 5400000 103 500004 5400000 104 500004 5400006 103 500000 5400006 104 500000 5400000 103");
     },
     kCheck, kInvalid, "E206 NonPlanar.*1\\.|E206 NonPlanar.*0\\."},
    {"TurnedFace", "a face that looks inward", "bad.gml",
     [] {
         return withRoof(
             "500000 5400000 103 500000 5400006 103 500004 5400006 103 500004 5400000 103 500000 5400000 103");
     },
     kCheck, kInvalid, "E211 FaceFlipped"},
    {"OpenShell", "a box without roof", "bad.gml",
     [] {
         auto f = box();
         f.erase(f.begin() + 1);
         return cityModel(building("b", solid(f)));
     },
     kCheck, kInvalid, "E209 ShellCapped: bad\\.gml:[0-9]+ \\(id 'b'\\): 4 edges"},
    {"MovedCorner", "a corner of the roof that is 4 cm away from that of the walls", "bad.gml",
     [] {
         return withRoof(
             "500000 5400000 103 500004 5400000 103 500004 5400006.04 103 500000 5400006 103 500000 5400000 103");
     },
     kCheck, kInvalid, "E209 ShellCapped: bad\\.gml:[0-9]+ \\(id 'b'\\): .*leak"},
    {"EmptySolid", "a solid without faces", "bad.gml", [] { return cityModel(building("b", solid({}))); }, kBuild,
     kInput, "E(109|213)"},
    {"MixedDimensions", "a ring of two coordinates per point among others of three", "bad.gml",
     [] {
         return replaced(withRoof("500000 5400000 500004 5400000 500004 5400006 500000 5400006 500000 5400000"),
                         "<gml:posList>500000 5400000 500004", "<gml:posList srsDimension=\"2\">500000 5400000 500004");
     },
     kCheck, kInvalid, "E2[0-9]+.*bad\\.gml"},
    {"WrongDimension", "points of three coordinates that are said to have two", "bad.gml",
     [] { return replaced(oneBox(), "<gml:posList>", "<gml:posList srsDimension=\"2\">"); }, kCheck, 0, ""},
    {"BuildsInSpiteOfABadFace", "one bad face does not stop the others", "bad.gml",
     [] { return withExtraFace("500000 5400000 NaN"); }, kBuild, 0, "E202 BadCoordinate|E201 TooFewPoints"},
};
INSTANTIATE_TEST_SUITE_P(Geometry, BadInputTest, ::testing::ValuesIn(kGeometry), nameOf);

const std::string kTwoIds =
    cityModel(building("b", solid(box())) + building("b", solid(boxFaces(500005, 5400000, 100, 500009, 5400006, 103))));

// A composite surface that contains itself through another composite surface.
std::string cycle() {
    return oneBox(
        R"(<bldg:lod1MultiSurface><gml:MultiSurface gml:id="x"><gml:surfaceMember><gml:CompositeSurface gml:id="y">
<gml:surfaceMember xlink:href="#z"/></gml:CompositeSurface></gml:surfaceMember><gml:surfaceMember><gml:CompositeSurface gml:id="z">
<gml:surfaceMember xlink:href="#y"/></gml:CompositeSurface></gml:surfaceMember></gml:MultiSurface></bldg:lod1MultiSurface>)");
}

std::string groupOfGroups() {
    const auto group = [](char id, char member) {
        return fmt::format(
            "<cityObjectMember><grp:CityObjectGroup gml:id=\"{0}\"><grp:groupMember "
            "xlink:href=\"#{1}\"/></grp:CityObjectGroup></cityObjectMember>",
            id, member);
    };
    return cityModel(building("b", solid(box())) + group('g', 'h') + group('h', 'g'));
}

// Each surface contains the next one twice: 2^40 polygons in 40 lines.
std::string doubling() {
    std::string all = "<bldg:lod1MultiSurface><gml:MultiSurface>";
    for (int i = 0; i < 40; ++i)
        all += fmt::format(
            "<gml:surfaceMember><gml:CompositeSurface gml:id=\"s{0}\"><gml:surfaceMember "
            "xlink:href=\"#s{1}\"/><gml:surfaceMember "
            "xlink:href=\"#s{1}\"/></gml:CompositeSurface></gml:surfaceMember>",
            i, i + 1);
    all += fmt::format(
        "<gml:surfaceMember><gml:CompositeSurface "
        "gml:id=\"s40\"><gml:surfaceMember><gml:Polygon><gml:exterior><gml:LinearRing><gml:posList>{}</gml:posList></"
        "gml:LinearRing></gml:exterior></gml:Polygon></gml:surfaceMember></gml:CompositeSurface></gml:surfaceMember>",
        kNear);
    return oneBox(all + "</gml:MultiSurface></bldg:lod1MultiSurface>");
}

const std::vector<BadInput> kReferences{
    {"MissingId", "a building without gml:id", "bad.gml", [] { return cityModel(building("", solid(box()))); }, kCheck,
     0, "E113 MissingId.*Building\\[1\\]"},
    {"DuplicateId", "two buildings of one id", "bad.gml", [] { return kTwoIds; }, kCheck, kInvalid,
     "E112 DuplicateId: bad\\.gml:[0-9]+ \\(id 'b'\\)"},
    {"XlinkCycle", "surfaces that hold each other", "bad.gml", cycle, kCheck, kInvalid, "E111 ReferenceCycle"},
    {"GroupCycle", "groups that hold each other", "bad.gml", groupOfGroups, kBuild, 0, ""},
    {"DanglingXlink", "a reference to nothing", "bad.gml",
     [] {
         return oneBox(
             "<bldg:lod1MultiSurface><gml:MultiSurface><gml:surfaceMember "
             "xlink:href=\"#nowhere\"/></gml:MultiSurface></bldg:lod1MultiSurface>");
     },
     kCheck, kInvalid, "E110 DanglingReference: bad\\.gml:[0-9]+.*nowhere"},
    {"ExternalReference", "a reference to another host", "bad.gml",
     [] {
         return oneBox(
             "<bldg:lod1MultiSurface><gml:MultiSurface><gml:surfaceMember "
             "xlink:href=\"http://example.org/a.gml#p\"/></gml:MultiSurface></bldg:lod1MultiSurface>");
     },
     kCheck, kInvalid, "E115 ExternalReference.*example\\.org"},
    {"Doubling", "references that multiply to 2^40 polygons", "bad.gml", doubling, kBuild, kLimit, "E104 InputTooBig"},
    {"MixedCrs", "a building in another CRS than the model", "bad.gml",
     [] { return replaced(oneBox(), "<gml:Solid>", "<gml:Solid srsName=\"urn:ogc:def:crs:EPSG::31467\">"); }, kCheck,
     kInvalid, "E117 MixedCrs.*31467"},
    {"Degrees", "coordinates in degrees of no known system", "bad.gml",
     [] { return cityModel(building("b", solid(boxFaces(8.0, 49.0, 100, 8.0001, 49.0001, 103))), "local"); }, kBuild,
     kInput, "E118 GeographicCrs: bad\\.gml:[0-9]+: .*'local'"},
    {"DegreesOfWgs84",
     "coordinates in degrees that can be projected",
     "bad.gml",
     [] {
         return cityModel(building("b", solid(boxFaces(8.0, 49.0, 100, 8.0001, 49.0001, 103))),
                          "urn:ogc:def:crs:OGC:1.3:CRS84");
     },
     {"build", "bad.gml", "-o", "o.svt", "-v"},
     0,
     "note E118 GeographicCrs.*EPSG:32632"},
    {"Feet",
     "coordinates in feet",
     "bad.gml",
     [] { return cityModel(building("b", solid(boxFaces(981100, 195500, 0, 981140, 195540, 30))), "EPSG:2263"); },
     {"build", "bad.gml", "-o", "o.svt", "-v"},
     0,
     "note E120 ForeignUnit.*EPSG:32118"},
    {"NoCrsToProject",
     "another projection for a file that names none",
     "bad.gml",
     [] { return cityModel(building("b", solid(box())), ""); },
     {"build", "bad.gml", "-o", "o.svt", "--crs", "EPSG:25833"},
     kInput,
     "E121 CannotProject: bad\\.gml"},
    {"FarFeature", "a building at the origin, far from the others", "bad.gml",
     [] {
         std::string members = building("far", solid(boxFaces(0, 0, 0, 4, 6, 3)));
         for (int i = 0; i < 5; ++i)
             members += building("b" + std::to_string(i),
                                 solid(boxFaces(500000 + 10 * i, 5400000, 100, 500004 + 10 * i, 5400006, 103)));
         return cityModel(members);
     },
     kCheck, kInvalid, "E122 FarFeature: bad\\.gml:[0-9]+ \\(id 'far'\\): .*5423 km"},
    {"NoHeights", "coordinates of two numbers", "bad.gml",
     [] {
         return cityModel(building("b", "",
                                   "<bldg:lod0FootPrint><gml:MultiSurface><gml:surfaceMember><gml:Polygon>"
                                   "<gml:exterior><gml:LinearRing><gml:posList srsDimension=\"2\">500000 5400000 "
                                   "500004 5400000 500004 5400006 500000 5400000</gml:posList></gml:LinearRing>"
                                   "</gml:exterior></gml:Polygon></gml:surfaceMember></gml:MultiSurface>"
                                   "</bldg:lod0FootPrint>"));
     },
     kBuild, kInput, "E123 NoHeights: bad\\.gml:[0-9]+: all 1 rings"},
    {"UnknownCrs", "a CRS that no table has", "bad.gml",
     [] { return cityModel(building("b", solid(box())), "urn:example:my-grid"); }, kBuild, 0, ""},
};
INSTANTIATE_TEST_SUITE_P(References, BadInputTest, ::testing::ValuesIn(kReferences), nameOf);

std::string cutSequence() {
    const std::string head =
        R"({"type":"CityJSON","version":"2.0","transform":{"scale":[1,1,1],"translate":[0,0,0]},"CityObjects":{},"vertices":[]})";
    const auto feature = [](std::string_view id) {
        return fmt::format(
            R"({{"type":"CityJSONFeature","id":"{0}","CityObjects":{{"{0}":{{"type":"Building","geometry":[{{"type":"MultiSurface","lod":"2","boundaries":[[[0,3,2,1]],[[0,1,4]],[[1,2,4]],[[2,3,4]],[[3,0,4]]]}}]}}}},"vertices":[[0,0,0],[9,0,0],[9,9,0],[0,9,0],[5,5,9]]}})",
            id);
    };
    return head + "\n" + feature("a") + "\n" + feature("b").substr(0, 200);
}

const std::vector<BadInput> kJson{
    {"DeepNesting", "arrays nested 10,000 deep", "bad.json", [] { return cityJson(nested("[", "]", 10000)); },
     kBuildJson, kLimit, "E104 InputTooBig|E105 BadJson.*deep"},
    {"DeepUnclosed", "a million opening brackets", "bad.json",
     [] { return "{\"type\":\"CityJSON\",\"version\":" + repeated("[", 1000000); }, kBuildJson, kLimit,
     "E104 InputTooBig.*512 levels"},
    {"Truncated", "a file cut in its middle", "bad.json", [] { return cityJson().substr(0, 300); }, kBuildJson, kInput,
     "E105 BadJson: bad\\.json"},
    {"CutSequence", "a CityJSONSeq whose last line is cut", "bad.json", cutSequence, kBuildJson, kInput,
     "E137 Truncated: bad\\.json:3: "},
    {"CutSequenceChecked", "the same, checked", "bad.json", cutSequence, kCheckJson, kInput, "error E137 Truncated"},
    {"CutSequencePlanned",
     "the same, in a city",
     "bad.json",
     cutSequence,
     {"city", "plan", "bad.json", "-o", "c"},
     kInput,
     "error E137 Truncated: bad\\.json:3: "},
    {"CutSequenceAllowed",
     "the same, where that is allowed",
     "bad.json",
     cutSequence,
     {"check", "bad.json", "--allow-truncated"},
     kInvalid,
     "warning E137 Truncated: bad\\.json:3(.|\n)*error E105 BadJson: bad\\.json:3.*the line is left out"},
    {"CutSequencePlannedAllowed",
     "the same, in a city that allows it",
     "bad.json",
     cutSequence,
     {"city", "plan", "bad.json", "-o", "c", "--allow-truncated"},
     kDone,
     "warning E137 Truncated: bad\\.json: (.|\\n)*warning E606 FeatureSkipped: bad\\.json: "},
    {"NotCityJson", "JSON that is no CityJSON", "bad.json", [] { return "{\"a\": 1}"; }, kBuildJson, kInput,
     "E103 UnknownFormat"},
    {"UnknownVersion", "a version of CityJSON that is not known", "bad.json", [] { return cityJson({}, {}, "9.0"); },
     kBuildJson, kInput, "E106 UnknownVersion.*9\\.0"},
    {"IndexOfABillion", "a vertex index of 1e9", "bad.json",
     [] { return replaced(cityJson(), "[0,3,2,1]", "[0,3,2,1000000000]"); }, kCheckJson, kInvalid,
     "E119 BadIndex.*1000000000"},
    {"NegativeIndex", "a negative vertex index", "bad.json",
     [] { return replaced(cityJson(), "[0,3,2,1]", "[0,3,2,-1]"); }, kCheckJson, kInvalid, "E1(19|05|14).*-1"},
    {"HugeIndex", "a vertex index beyond 64 bits", "bad.json",
     [] { return replaced(cityJson(), "[0,3,2,1]", "[0,3,2,99999999999999999999999]"); }, kCheckJson, kInvalid,
     "E119 BadIndex.*'b'"},
    {"FractionAsIndex", "a vertex index that is no whole number", "bad.json",
     [] { return replaced(cityJson(), "[0,3,2,1]", "[0,3,2,1.5]"); }, kCheckJson, kInvalid, "E1(19|05|14)"},
    {"VertexOfTwoNumbers", "a vertex without height", "bad.json",
     [] { return replaced(cityJson(), "[0,0,0]", "[0,0]"); }, kCheckJson, kInvalid, "E202 BadCoordinate.*vertex 0"},
    {"VertexOfText", "a vertex of words", "bad.json",
     [] { return replaced(cityJson(), "[0,0,0]", "[\"a\",\"b\",\"c\"]"); }, kCheckJson, kInvalid,
     "E202 BadCoordinate.*vertex 0"},
    {"HugeTransform", "a transform that overflows", "bad.json",
     [] { return cityJson({}, {}, "2.0", R"({"scale":[1e308,1e308,1e308],"translate":[1e308,0,0]})"); }, kBuildJson,
     kInput, "E(202|114|109)"},
    {"ZeroTransform", "a transform that makes all points one", "bad.json",
     [] { return cityJson({}, {}, "2.0", R"({"scale":[0,0,0],"translate":[0,0,0]})"); }, kBuildJson, kInput,
     "E(203|114|109|20.)"},
    {"TransformOfTwo", "a transform of two numbers", "bad.json",
     [] { return cityJson({}, {}, "2.0", R"({"scale":[1,1],"translate":[0,0,0]})"); }, kBuildJson, kInput,
     "E114 BadValue.*scale|E105 BadJson.*scale"},
    {"NoVertices", "faces without any vertex", "bad.json", [] { return cityJson({}, "[]"); }, kBuildJson, kInput,
     "E119 BadIndex|E109 EmptyModel"},
    {"ObjectsAreAList", "CityObjects that are a list", "bad.json",
     [] {
         return "{\"type\":\"CityJSON\",\"version\":\"2.0\",\"transform\":{\"scale\":[1,1,1],\"translate\":[0,0,0]},"
                "\"CityObjects\":[],\"vertices\":[]}";
     },
     kBuildJson, kInput, "E105 BadJson.*CityObjects"},
    {"Empty", "a model without objects", "bad.json",
     [] {
         return "{\"type\":\"CityJSON\",\"version\":\"2.0\",\"transform\":{\"scale\":[1,1,1],\"translate\":[0,0,0]},"
                "\"CityObjects\":{},\"vertices\":[]}";
     },
     kBuildJson, kInput, "E109 EmptyModel"},
    {"UnknownGeometry", "a geometry of an unknown type", "bad.json",
     [] { return replaced(cityJson(), "\"Solid\"", "\"Blob\""); }, kBuildJson, kInput, "E1(16|14|05|09).*"},
    {"ParentCycle", "objects that are each other's parent", "bad.json",
     [] {
         return replaced(cityJson(), "\"CityObjects\":{",
                         "\"CityObjects\":{\"p\":{\"type\":\"BuildingPart\",\"parents\":[\"q\"],\"children\":[\"q\"]},"
                         "\"q\":{\"type\":\"BuildingPart\",\"parents\":[\"p\"],\"children\":[\"p\"]},");
     },
     kCheckJson, kInvalid, "E111 ReferenceCycle"},
    {"DanglingParent", "a parent that does not exist", "bad.json",
     [] { return replaced(cityJson(), "\"type\":\"Building\"", "\"type\":\"BuildingPart\",\"parents\":[\"nobody\"]"); },
     kCheckJson, kInvalid, "E110 DanglingReference.*nobody"},
    {"DuplicateId", "the same object twice", "bad.json",
     [] { return replaced(cityJson(), "]}},\n\"vertices\"", "]},\"b\":{\"type\":\"Building\"}},\n\"vertices\""); },
     kCheckJson, kInvalid, "E112 DuplicateId.*'b'"},
    {"BadUtf8", "bytes that are no UTF-8", "bad.json",
     [] { return replaced(cityJson(), "Building", "Build\xFF\xFEing"); }, kBuildJson, kInput, "E108 BadEncoding"},
    {"Degrees", "coordinates in degrees of no known system", "bad.json",
     [] {
         return replaced(cityJson({}, {}, "2.0", R"({"scale":[1e-8,1e-8,0.001],"translate":[8,49,100]})"),
                         "EPSG/0/25832", "local");
     },
     kBuildJson, kInput, "E118 GeographicCrs"},
};
INSTANTIATE_TEST_SUITE_P(CityJson, BadInputTest, ::testing::ValuesIn(kJson), nameOf);

const std::function<std::string()> kGood = [] { return oneBox(); };

Arguments buildWith(Arguments more) {
    Arguments all{"build", "good.gml", "-o", "o.svt"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
}

const std::vector<BadInput> kOptions{
    {"CrsIsNoNumber", "a code that is none", "good.gml", kGood, buildWith({"--crs", "Gauss"}), kUsage,
     "E904 BadArgument.*--crs 'Gauss'"},
    {"CrsInDegrees", "a code of degrees", "good.gml", kGood, buildWith({"--crs", "EPSG:4326"}), kUsage,
     "E904 BadArgument.*4326.*UTM zone"},
    {"CrsUnknown", "a code that there is not", "good.gml", kGood, buildWith({"--crs", "999999"}), kUsage,
     "E904 BadArgument.*999999"},
    {"DimensionZero", "no samples", "good.gml", kGood, buildWith({"--dimension", "0"}), kUsage,
     "E301 BadDimension.*--dimension 0.*2 to 65535"},
    {"DimensionOne", "one sample", "good.gml", kGood, buildWith({"--dimension", "1,1,1"}), kUsage,
     "E301 BadDimension.*2 to 65535"},
    {"DimensionOfAMillion", "a million samples along each side", "good.gml", kGood,
     buildWith({"--dimension", "1000000"}), kUsage, "E301 BadDimension.*2 to 65535"},
    {"DimensionOfABillion", "1e9 samples along a side", "good.gml", kGood, buildWith({"--dimension", "1e9,2,2"}),
     kUsage, "E301 BadDimension.*2 to 65535"},
    {"DimensionAtItsLimit", "the largest grid that can be asked for is refused or built, not died of", "good.gml",
     kGood, buildWith({"--dimension", "65535"}), kLimit, "E302 GridTooLarge|out of memory"},
    {"DimensionNegative", "a negative number of samples", "good.gml", kGood, buildWith({"--dimension=-5"}), kUsage,
     "E301 BadDimension"},
    {"DimensionFraction", "half a sample", "good.gml", kGood, buildWith({"--dimension", "10.5"}), kUsage,
     "E301 BadDimension.*whole"},
    {"DimensionOfTwo", "two numbers in place of three", "good.gml", kGood, buildWith({"--dimension", "10,10"}), kUsage,
     "E904 BadArgument.*--dimension '10,10'"},
    {"DimensionNan", "NaN samples", "good.gml", kGood, buildWith({"--dimension", "nan"}), kUsage,
     "E904 BadArgument.*--dimension 'nan'"},
    {"SpacingZero", "no distance", "good.gml", kGood, buildWith({"--spacing", "0"}), kUsage,
     "E(301|904).*spacing.*greater than 0|E(301|904).*spacing.*0"},
    {"SpacingNegative", "a negative distance", "good.gml", kGood, buildWith({"--spacing=-1"}), kUsage,
     "E(301|904).*spacing.*-1"},
    {"SpacingNan", "NaN metres", "good.gml", kGood, buildWith({"--spacing", "nan"}), kUsage,
     "E(301|904).*spacing.*nan"},
    {"SpacingInfinite", "an infinite distance", "good.gml", kGood, buildWith({"--spacing", "inf"}), kUsage,
     "E(301|904).*spacing.*inf"},
    {"SpacingTiny", "more samples than a grid may have", "good.gml", kGood, buildWith({"--spacing", "1e-9"}), kUsage,
     "E301 BadDimension.*4000000002.*2 to 65535.*spacing"},
    {"SpacingText", "a word", "good.gml", kGood, buildWith({"--spacing", "fine"}), kUsage,
     "E904 BadArgument.*--spacing 'fine'.*metres"},
    {"SpacingAndDimension", "two options that exclude each other", "good.gml", kGood,
     buildWith({"--spacing", "1", "--dimension", "10"}), kUsage, "--dimension and --spacing exclude each other"},
    {"ThreadsNegative", "a negative number of threads", "good.gml", kGood, buildWith({"--threads", "-1"}), kUsage,
     "--threads"},
    {"UnknownOption", "a typing error in an option", "good.gml", kGood, buildWith({"--spcing", "1"}), kUsage,
     "--spcing.*did you mean --spacing\\?"},
    {"UnknownOptionWithEquals", "a typing error in an option with =", "good.gml", kGood, buildWith({"--dimensions=3"}),
     kUsage, "did you mean --dimension\\?"},
    {"UnknownCommand",
     "a typing error in the command",
     "",
     {},
     {"biuld", "x.gml"},
     kUsage,
     "biuld.*did you mean build\\?"},
    {"NoCommand", "no command at all", "", {}, {}, kUsage, ""},
    {"NoInput", "a command without its input", "", {}, {"info"}, kUsage, "input"},
    {"NoOutput", "build without output", "good.gml", kGood, {"build", "good.gml"}, kUsage, "--output"},
    {"BadChoice", "a value that is none of the choices", "good.gml", kGood, buildWith({"--axes", "moon"}), kUsage,
     "--axes.*moon.*world|--axes.*world.*moon"},
    {"DoctorWithInput", "a file where none is asked for", "", {}, {"doctor", "house.gml"}, kUsage, "house\\.gml"},
    {"UnknownSample", "a sample that does not exist", "", {}, {"sample", "castle", "-o", "o.gml"}, kUsage, "castle"},
    {"SampleWithoutExtension",
     "an output that tells no format",
     "",
     {},
     {"sample", "house", "-o", "house"},
     kUsage,
     "E904 BadArgument.*\\.gml"},
    {"SampleOutOfRange",
     "a tower of 1e9 storeys",
     "",
     {},
     {"sample", "tower", "-o", "o.gml", "--storeys", "1000000000"},
     kUsage,
     "--storeys: 1000000000 is out of range.*1 to 200"},
    {"ConvertUnknown",
     "an output format that is not written",
     "good.gml",
     kGood,
     {"convert", "good.gml", "o.bmp"},
     kUsage,
     "E904 BadArgument.*\\.bmp.*\\.nrrd"},
    {"RenderSizeZero",
     "a picture without pixels",
     "good.gml",
     kGood,
     {"render", "good.gml", "-o", "o.png", "--size", "0x10", "--spacing", "0.5"},
     kUsage,
     "E502 BadFrame.*--size '0x10'"},
    {"RenderSizeHuge",
     "a picture of 1e9 pixels along a side",
     "good.gml",
     kGood,
     {"render", "good.gml", "-o", "o.png", "--size", "1000000000x1", "--spacing", "0.5"},
     kUsage,
     "E502 BadFrame.*16384"},
    {"OptionTwice",
     "an option that may be given once, twice",
     "good.gml",
     kGood,
     {"render", "good.gml", "-o", "o.png", "--size", "64x64", "--size", "32x32", "--spacing", "0.5"},
     kUsage,
     "--size"},
    {"SeedTooLarge",
     "a seed that would be rounded",
     "",
     {},
     {"sample", "house", "-o", "o.gml", "--seed", "18446744073709551615"},
     kUsage,
     "--seed: 18446744073709551615 is out of range"},
    {"RenderCamera",
     "a camera that does not exist",
     "good.gml",
     kGood,
     {"render", "good.gml", "-o", "o.png", "--camera", "izo", "--spacing", "0.5"},
     kUsage,
     "--camera.*izo.*iso"},
    {"RenderFov",
     "a field of view of 180 degrees",
     "good.gml",
     kGood,
     {"render", "good.gml", "-o", "o.png", "--fov", "180", "--spacing", "0.5"},
     kUsage,
     "--fov: 180 is out of range.*179.999"},
    {"RenderFovNan",
     "a field of view that is no number",
     "good.gml",
     kGood,
     {"render", "good.gml", "-o", "o.png", "--fov", "nan", "--spacing", "0.5"},
     kUsage,
     "--fov.*nan"},
    {"RenderEyeOnTarget",
     "an eye in its own target",
     "good.gml",
     kGood,
     {"render", "good.gml", "-o", "o.png", "--eye", "1,1,1", "--target", "1,1,1", "--spacing", "0.5"},
     kUsage,
     "E501 BadCamera"},
    {"RenderColor",
     "a colour that does not exist",
     "good.gml",
     kGood,
     {"render", "good.gml", "-o", "o.png", "--color", "all:redd", "--spacing", "0.5"},
     kUsage,
     "E904 BadArgument.*--color.*redd"},
    {"RenderOpacity",
     "an opacity of 2",
     "good.gml",
     kGood,
     {"render", "good.gml", "-o", "o.png", "--opacity", "all:2", "--spacing", "0.5"},
     kUsage,
     "E904 BadArgument.*--opacity.*2 is out of range"},
    {"RenderSection",
     "a plane along no axis",
     "good.gml",
     kGood,
     {"render", "good.gml", "-o", "o.png", "--section", "w=1", "--spacing", "0.5"},
     kUsage,
     "E503 BadSection.*'w=1'"},
    {"RenderSectionZero",
     "a plane without direction",
     "good.gml",
     kGood,
     {"render", "good.gml", "-o", "o.png", "--section", "0,0,0,1", "--spacing", "0.5"},
     kUsage,
     "E503 BadSection.*normal is zero"},
    {"RenderSectionBeside",
     "a plane beside the model",
     "good.gml",
     kGood,
     {"render", "good.gml", "-o", "o.png", "--section", "z=99", "--spacing", "0.5"},
     kUsage,
     "E503 BadSection.*'z=99'.*does not meet the volume"},
    {"RenderSectionMoves",
     "a plane that moves in one picture",
     "good.gml",
     kGood,
     {"render", "good.gml", "-o", "o.png", "--section", "z=0..1", "--spacing", "0.5"},
     kUsage,
     "E904 BadArgument.*--frames"},
    {"RenderCut",
     "a region without end",
     "good.gml",
     kGood,
     {"render", "good.gml", "-o", "o.png", "--cut", "box(0,0,0,1,1,1", "--spacing", "0.5"},
     kUsage,
     "E503 BadSection.*expected '\\)'"},
    {"RenderKeepRound",
     "a region of no size",
     "good.gml",
     kGood,
     {"render", "good.gml", "-o", "o.png", "--keep", "ball(1,1,1,-1)", "--spacing", "0.5"},
     kUsage,
     "E503 BadSection.*radius of -1 m"},
    {"RenderLensStorey",
     "a lens of a storey that is not there",
     "good.gml",
     kGood,
     {"render", "good.gml", "-o", "o.png", "--lens", "storey(Attic)", "--spacing", "0.5"},
     kUsage,
     "E902 NothingSelected.*Attic"},
    {"RenderHighlight",
     "a highlight of nothing",
     "good.gml",
     kGood,
     {"render", "good.gml", "-o", "o.png", "--highlight", "class=Bulding", "--spacing", "0.5"},
     kDone,
     "svt: the query .* selects nothing.*did you mean 'Building'"},
    {"RenderCutaway",
     "a cutaway to nothing",
     "good.gml",
     kGood,
     {"render", "good.gml", "-o", "o.png", "--cutaway", "id=x", "--spacing", "0.5"},
     kDone,
     "svt: the query .* selects nothing"},
    {"RenderLensAndCutaway",
     "a lens and a cutaway",
     "good.gml",
     kGood,
     {"render", "good.gml", "-o", "o.png", "--lens", "z>1", "--cutaway", "all", "--spacing", "0.5"},
     kUsage,
     "--lens and --cutaway exclude each other"},
    {"RenderHatchOf",
     "a hatch of no such name",
     "good.gml",
     kGood,
     {"render", "good.gml", "-o", "o.png", "--hatch-of", "all:bricks", "--spacing", "0.5"},
     kUsage,
     "E904 BadArgument.*unknown hatch 'bricks'; possible are .*masonry"},
    {"RenderNames",
     "names of nothing",
     "good.gml",
     kGood,
     {"render", "good.gml", "-o", "o.png", "--names", "id=x", "--spacing", "0.5"},
     kDone,
     "svt: the query .* selects nothing"},
    {"RenderSizeMm",
     "a picture of no size in print",
     "good.gml",
     kGood,
     {"render", "good.gml", "-o", "o.png", "--size", "0x10mm", "--spacing", "0.5"},
     kUsage,
     "E502 BadFrame"},
    {"RenderSizeHundredThousand",
     "100,000 pixels",
     "good.gml",
     kGood,
     {"render", "good.gml", "-o", "o.png", "--size", "100000x100000", "--spacing", "0.5"},
     kUsage,
     "E502 BadFrame.*16384"},
    {"RenderAround",
     "a view of nothing",
     "good.gml",
     kGood,
     {"render", "good.gml", "-o", "o.png", "--around", "none", "--spacing", "0.5"},
     kDone,
     "svt: the query .* selects nothing"},
    {"RenderScene",
     "a scene with a member of no such name",
     "s.scene.json",
     [] { return std::string(R"({"passes": [{"cuts": "z>1"}]})"); },
     {"render", "good.gml", "-o", "o.png", "--scene", "s.scene.json"},
     kInput,
     "E504 BadScene: s.scene.json: /passes/0: unknown member 'cuts'"},
    {"RenderSceneNoJson",
     "a scene that is no JSON",
     "s.scene.json",
     [] { return std::string("{"); },
     {"render", "good.gml", "-o", "o.png", "--scene", "s.scene.json"},
     kInput,
     "E105 BadJson"},
    {"RenderSceneMissing",
     "a scene that is not there",
     "good.gml",
     kGood,
     {"render", "good.gml", "-o", "o.png", "--scene", "no.scene.json"},
     kInput,
     "E101 CannotOpen"},
    {"RenderSectionNan",
     "a plane at no place",
     "good.gml",
     kGood,
     {"render", "good.gml", "-o", "o.png", "--section", "z=nan", "--spacing", "0.5"},
     kUsage,
     "'z=nan'"},
    {"RenderSectionTail",
     "a plane with something behind it",
     "good.gml",
     kGood,
     {"render", "good.gml", "-o", "o.png", "--section", "0,0,1,-1,5", "--spacing", "0.5"},
     kUsage,
     "'0,0,1,-1,5'"},
    {"RenderSectionThree",
     "three numbers for one axis",
     "good.gml",
     kGood,
     {"render", "good.gml", "-o", "o.png", "--section", "z=1,2,3", "--spacing", "0.5"},
     kUsage,
     "'z=1,2,3'"},
};
INSTANTIATE_TEST_SUITE_P(Options, BadInputTest, ::testing::ValuesIn(kOptions), nameOf);

const std::vector<BadInput> kQueries{
    {"Unfinished",
     "a query that ends too early",
     "good.gml",
     kGood,
     {"query", "good.gml", "class=Building and", "--spacing", "0.5"},
     kUsage,
     "E901 BadQuery.*19"},
    {"NoOperator",
     "a word without comparison",
     "good.gml",
     kGood,
     {"query", "good.gml", "Building", "--spacing", "0.5"},
     kUsage,
     "E901 BadQuery.*column 9|E901 BadQuery.*9"},
    {"OpenBracket",
     "a bracket without end",
     "good.gml",
     kGood,
     {"query", "good.gml", "(class=Building", "--spacing", "0.5"},
     kUsage,
     "E901 BadQuery.*16"},
    {"BadPattern",
     "a regular expression that is none",
     "good.gml",
     kGood,
     {"query", "good.gml", "name~'('", "--spacing", "0.5"},
     kUsage,
     "E901 BadQuery"},
    {"DeepBrackets",
     "10,000 brackets",
     "good.gml",
     kGood,
     {"query", "good.gml", repeated("(", 10000) + "all" + repeated(")", 10000), "--spacing", "0.5"},
     kUsage,
     "E901 BadQuery.*64"},
    {"ExplodingPattern",
     "a regular expression that explodes in others",
     "good.gml",
     [] { return oneBox("<gml:name>aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa</gml:name>"); },
     {"query", "good.gml", "name~'^(a+)+(a+)+(a+)+b$'", "--spacing", "0.5"},
     kDone,
     "svt: the query .* selects nothing"},
    {"NearestClass",
     "a class with a typing error",
     "good.gml",
     kGood,
     {"query", "good.gml", "class=Bilding", "--spacing", "0.5"},
     kDone,
     "svt: the query .* selects nothing.*Bilding.*did you mean 'Building'"},
    {"NearestClassInRender",
     "a class with a typing error in --hide",
     "good.gml",
     kGood,
     {"render", "good.gml", "-o", "o.png", "--hide", "class=Bilding", "--spacing", "0.5"},
     kDone,
     "svt: the query .* selects nothing.*did you mean 'Building'"},
    {"NothingThatLarge",
     "a true query that nothing answers",
     "good.gml",
     kGood,
     {"query", "good.gml", "volume>1e9", "--spacing", "0.5"},
     kDone,
     "svt: the query 'volume>1e9' selects nothing"},
};
INSTANTIATE_TEST_SUITE_P(Queries, BadInputTest, ::testing::ValuesIn(kQueries), nameOf);

struct BadStyle {
    const char* name;
    const char* what;
    std::string text;
    const char* message;
};

void PrintTo(const BadStyle& style, std::ostream* stream) { *stream << style.what; }

class BadStyleTest : public ::testing::TestWithParam<BadStyle> {};

TEST_P(BadStyleTest, IsRefusedWithItsPath) {
    const TemporaryFolder folder;
    writeText(folder / "good.gml", oneBox());
    writeText(folder / "bad.style.json", GetParam().text);
    const CommandResult result =
        runSvt(folder.path(), {"build", "good.gml", "-o", "o.svt", "--spacing", "0.5", "--style", "bad.style.json"});
    EXPECT_EQ(result.exitCode, kInput) << result.toString();
    EXPECT_TRUE(std::regex_search(result.err, std::regex(GetParam().message)))
        << "expected: " << GetParam().message << "\nfound: " << result.toString();
    EXPECT_FALSE(std::filesystem::exists(folder / "o.svt"));
}

std::string patternRule(std::string_view pattern) {
    return fmt::format(R"({{"rules":[{{"select":"all","pattern":{}}}]}})", pattern);
}

const std::vector<BadStyle> kStyles{
    {"NotJson", "no JSON", "rules: []", "E305 BadStyle: bad\\.style\\.json: .*not well-formed"},
    {"Empty", "an empty file", "", "E305 BadStyle"},
    {"NoRules", "no rules", "{}", "E305 BadStyle.*rules"},
    {"UnknownMember", "a typing error in a member", R"({"rules":[{"select":"all","colour":"red"}]})",
     "E305 BadStyle.*rules\\[0\\].*'colour'.*color"},
    {"NoSelect", "a rule without query", R"({"rules":[{"color":"red"}]})", "E305 BadStyle.*rules\\[0\\].*select"},
    {"BadQuery", "a rule with a bad query", R"({"rules":[{"select":"class="}]})",
     "E305 BadStyle.*rules\\[0\\]\\.select"},
    {"BadColor", "a colour that does not exist", R"({"rules":[{"select":"all","color":"redd"}]})",
     "E305 BadStyle.*rules\\[0\\]\\.color.*redd"},
    {"BadOpacity", "an opacity over 1", R"({"rules":[{"select":"all","opacity":1.5}]})",
     "E305 BadStyle.*rules\\[0\\]\\.opacity.*0 to 1.*1\\.5"},
    {"UnknownPattern", "a pattern that does not exist", patternRule(R"({"type":"bricks"})"),
     "E305 BadStyle.*rules\\[0\\]\\.pattern\\.type.*brick"},
    {"NegativeSize", "a pattern of negative size", patternRule(R"({"type":"brick","size":-1})"), "E304 BadPattern"},
    {"TinySize", "a pattern of a nanometre", patternRule(R"({"type":"brick","size":1e-9})"), "E304 BadPattern"},
    {"HugeNumber", "a number that overflows", patternRule(R"({"type":"brick","size":1e999})"), "E30[45]"},
    {"MissingImage", "a picture that does not exist", patternRule(R"({"type":"image","file":"no.png"})"), "E(101|406)"},
    {"RawTooLarge", "a raw file of 1e9 cells along a side",
     patternRule(R"({"type":"raw","file":"bad.style.json","dimension":[1000000000,1,1]})"), "E(406|305|304)"},
    {"RawOfOtherSize", "a raw file that is too short",
     patternRule(R"({"type":"raw","file":"bad.style.json","dimension":[100,100,100]})"), "E406 BadImage"},
    {"DeepNesting", "arrays nested 10,000 deep", nested("[", "]", 10000), "E305 BadStyle.*10000"},
};
INSTANTIATE_TEST_SUITE_P(Styles, BadStyleTest, ::testing::ValuesIn(kStyles),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(BadStyle, MissingFileIsNamed) {
    const TemporaryFolder folder;
    writeText(folder / "good.gml", oneBox());
    const CommandResult result = runSvt(folder.path(), {"build", "good.gml", "-o", "o.svt", "--style", "no.json"});
    EXPECT_EQ(result.exitCode, kInput) << result.toString();
    EXPECT_NE(result.err.find("E101 CannotOpen: no.json"), std::string::npos) << result.err;
}

// Shapes on which careless algorithms take for ever, of a size at which n^2 would take longer than the limit; see
// docs/dev/limits.md for figures.
class WorstInput : public ::testing::TestWithParam<const char*> {};

// Writes the model as worst.json.
void writeWorst(const TemporaryFolder& folder, const char* kind) {
    const std::string count = kIsSanitized ? "2000" : "20000";
    const std::string write = std::string("python3 " + sourceRoot() + "/scripts/worst_inputs.py ") + kind + " " +
                              count + " '" + (folder / "worst.json").string() + "'";
    ASSERT_EQ(std::system(write.c_str()), 0);
}

TEST_P(WorstInput, IsCheckedInBoundedWork) {
    const TemporaryFolder folder;
    ASSERT_NO_FATAL_FAILURE(writeWorst(folder, GetParam()));
    const CommandResult result = runSvt(folder.path(), {"check", "worst.json"}, {.seconds = 100});
    EXPECT_FALSE(result.isTimeout) << result.toString();
    EXPECT_TRUE(result.exitCode == 0 || result.exitCode == kInvalid) << result.toString();
}

TEST_P(WorstInput, IsBuiltInBoundedWorkAndMemory) {
    const TemporaryFolder folder;
    ASSERT_NO_FATAL_FAILURE(writeWorst(folder, GetParam()));
    const CommandResult result = runSvt(folder.path(), {"build", "worst.json", "-o", "worst.svt", "--memory", "2048"},
                                        {.seconds = std::string(GetParam()) == "fan" ? 360.0 : 160.0});
    EXPECT_FALSE(result.isTimeout) << result.toString();
    EXPECT_EQ(result.exitCode, 0) << result.toString();
}

TEST(RunCommand, EndsWhatNeedsMoreProcessorTimeThanItMay) {
    const TemporaryFolder folder;
    ASSERT_NO_FATAL_FAILURE(writeWorst(folder, "fan"));
    const CommandResult result =
        runSvt(folder.path(), {"build", "worst.json", "-o", "worst.svt"}, {.seconds = 0.05});  // a second is the least
    EXPECT_TRUE(result.isTimeout) << result.toString();
}

INSTANTIATE_TEST_SUITE_P(Checks, WorstInput,
                         ::testing::Values("star", "ring", "holes", "coincident", "coincident_in_one", "book", "wall",
                                           "tjunction", "fan", "loop", "shells", "voids", "surface", "nest",
                                           "features"),
                         [](const auto& tested) { return std::string(tested.param); });

}  // namespace
}  // namespace svt::test
