// Small models that refer to themselves or to nothing, stand for a model without end, or were cut off: each command that reads
// them ends within limits of processor time and memory, and names what it left out.
#include <tests/cli/run_command.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <regex>

namespace svt::test {
namespace {

namespace fs = std::filesystem;
using Arguments = std::vector<std::string>;

// The shared items take 0.6 s and 380 MB, all others 0.3 s and 100 MB.
constexpr double kHostileSeconds = 4;
// A plan reads seven of them, in 4 s while other programs use the cores. Without limits, one of them takes 17 minutes.
constexpr double kSecondsOfAll = 8;
constexpr std::uint64_t kHostileBytes = std::uint64_t{1} << 29, kSharedBytes = std::uint64_t{1} << 30;

CommandResult runBounded(const TemporaryFolder& folder, const Arguments& arguments,
                         std::uint64_t memoryBytes = kHostileBytes, double seconds = kHostileSeconds) {
    CommandResult result = runSvt(folder.path(), arguments, {.seconds = seconds, .memoryBytes = memoryBytes});
    EXPECT_FALSE(result.isTimeout) << arguments.front() << ": " << result.toString();
    EXPECT_EQ(result.signal, 0) << arguments.front() << ": " << result.toString();
    return result;
}

void expectFound(const CommandResult& result, const std::string& pattern) {
    EXPECT_TRUE(std::regex_search(result.err, std::regex(pattern))) << "expected: " << pattern << "\n"
                                                                    << result.toString();
}

std::string hostileIfc(std::string_view records) {
    return fmt::format(
        "ISO-10303-21;\nHEADER;\nFILE_SCHEMA(('IFC4'));\nENDSEC;\nDATA;\n"
        "#1=IFCPROJECT('p',$,'P',$,$,$,$,(),#2);\n#2=IFCUNITASSIGNMENT((#3));\n"
        "#3=IFCSIUNIT(*,.LENGTHUNIT.,$,.METRE.);\n#10=IFCCARTESIANPOINT((0.,0.,0.));\n"
        "#11=IFCAXIS2PLACEMENT3D(#10,$,$);\n#12=IFCLOCALPLACEMENT($,#11);\n#13=IFCDIRECTION((0.,0.,1.));\n"
        "#14=IFCCARTESIANPOINT((0.,0.));\n#15=IFCCARTESIANPOINT((1.,0.));\n#16=IFCCARTESIANPOINT((1.,1.));\n"
        "#17=IFCCARTESIANTRANSFORMATIONOPERATOR3D($,$,#10,1.,$);\n#18=IFCBLOCK(#11,1.,1.,1.);\n{}\n"
        "ENDSEC;\nEND-ISO-10303-21;\n",
        records);
}

// A wall of a block, and 3 m beside it the wall 'bad' with the item #200.
std::string withBadItem(std::string_view records) {
    return hostileIfc(
        "#20=IFCWALL('sound',$,'Sound',$,$,#12,#21,$,$);\n#21=IFCPRODUCTDEFINITIONSHAPE($,$,(#22));\n"
        "#22=IFCSHAPEREPRESENTATION($,'Body','CSG',(#18));\n"
        "#23=IFCLOCALPLACEMENT(#12,#24);\n#24=IFCAXIS2PLACEMENT3D(#25,$,$);\n#25=IFCCARTESIANPOINT((0.,3.,0.));\n"
        "#100=IFCWALL('bad',$,'Bad',$,$,#23,#101,$,$);\n#101=IFCPRODUCTDEFINITIONSHAPE($,$,(#102));\n"
        "#102=IFCSHAPEREPRESENTATION($,'Body','SweptSolid',(#200));\n" +
        std::string(records));
}

// The same, where the item is extruded from the curve #300.
std::string withBadCurve(std::string_view records) {
    return withBadItem(
        "#200=IFCEXTRUDEDAREASOLID(#201,#11,#13,1.);\n#201=IFCARBITRARYCLOSEDPROFILEDEF(.AREA.,$,#300);\n" +
        std::string(records));
}

std::string manyTimes(const std::string& id, int count) {
    std::string list = id;
    for (int n = 1; n < count; ++n) list += "," + id;
    return list;
}

std::string trimmedChain() {
    std::string text = "#299=IFCPOLYLINE((#14,#15,#16,#14));\n";
    for (int n = 30; n > 0; --n)
        text += fmt::format("#{}=IFCTRIMMEDCURVE(#{},(#14),(#16),.T.,.CARTESIAN.);\n", n == 30 ? 300 : 300 + n,
                            n == 1 ? 299 : 299 + n);
    return withBadCurve(text);
}

std::string mappedItems() {
    std::string text = "#200=IFCMAPPEDITEM(#308,#17);\n";
    for (int n = 0; n < 9; ++n)
        text += fmt::format(
            "#{0}=IFCREPRESENTATIONMAP(#11,#{1});\n#{2}=IFCMAPPEDITEM(#{0},#17);\n"
            "#{1}=IFCSHAPEREPRESENTATION($,'Body','MappedRepresentation',({3}));\n",
            300 + n, 400 + n, 500 + n, manyTimes(n == 0 ? "#18" : fmt::format("#{}", 499 + n), 10));
    return withBadItem(text);
}

std::string compositeProfiles() {
    std::string text = "#200=IFCEXTRUDEDAREASOLID(#308,#11,#13,1.);\n#299=IFCRECTANGLEPROFILEDEF(.AREA.,$,$,1.,1.);\n";
    for (int n = 0; n < 9; ++n)
        text += fmt::format("#{}=IFCCOMPOSITEPROFILEDEF(.AREA.,$,({}),$);\n", 300 + n,
                            manyTimes(fmt::format("#{}", 299 + n), 10));
    return withBadItem(text);
}

// 200 walls share 3,000 mapped items.
std::string sharedItems() {
    std::string text =
                    "#30=IFCREPRESENTATIONMAP(#11,#31);\n#31=IFCSHAPEREPRESENTATION($,'Body','CSG',(#18));\n"
                    "#32=IFCPRODUCTDEFINITIONSHAPE($,$,(#33));\n",
                items;
    for (int n = 0; n < 3000; ++n) {
        text += fmt::format("#{}=IFCMAPPEDITEM(#30,#17);\n", 1000 + n);
        items += fmt::format("{}#{}", n == 0 ? "" : ",", 1000 + n);
    }
    text += "#33=IFCSHAPEREPRESENTATION($,'Body','MappedRepresentation',(" + items + "));\n";
    for (int n = 0; n < 200; ++n) text += fmt::format("#{}=IFCWALL('w{}',$,$,$,$,#12,#32,$,$);\n", 5000 + n, n);
    return hostileIfc(text);
}

std::string cutIfc() {
    std::string text = withBadItem("#200=IFCBLOCK(#11,1.,1.,1.);");
    return text.erase(text.rfind("ENDSEC"));
}

std::string cutSequenceOfTwo() {
    const auto line = [](std::string_view id) {
        return fmt::format(
            R"({{"type":"CityJSONFeature","id":"{0}","CityObjects":{{"{0}":{{"type":"Building","geometry":[{{"type":"MultiSurface","lod":"2","boundaries":[[[0,2,1]],[[0,1,3]],[[0,3,2]],[[1,2,3]]]}}]}}}},"vertices":[[0,0,0],[9,0,0],[0,9,0],[0,0,9]]}})",
            id);
    };
    const std::string head =
        R"({"type":"CityJSON","version":"2.0","transform":{"scale":[1,1,1],"translate":[0,0,0]},"CityObjects":{},"vertices":[]})";
    return head + "\n" + line("sound") + "\n" + line("bad").substr(0, 120);
}

struct HostileModel {
    const char* name;  // of the test
    const char* file;
    std::function<std::string()> text;
    int checked, built;   // exit codes
    const char* finding;  // regular expression, in what check and build say
    std::uint64_t memoryBytes = kHostileBytes;
};

void PrintTo(const HostileModel& model, std::ostream* stream) { *stream << model.file; }

const char* const kPointsOfProduct = "E133 ShapeNotRead: .*'bad'.* points and values, the limit for one product";

const std::vector<HostileModel> kHostileModels{
    {"TrimmedCurveOfItself", "trimmed.ifc",
     [] { return withBadCurve("#300=IFCTRIMMEDCURVE(#300,(#14),(#16),.T.,.CARTESIAN.);"); }, kInvalid, kDone,
     "E133 ShapeNotRead: .*'bad'(.|\n)*E111 ReferenceCycle: .*#300 IFCTRIMMEDCURVE -> #300"},
    {"SurfaceCurveOfItself", "surface.ifc", [] { return withBadCurve("#300=IFCSURFACECURVE(#300,(),.CURVE3D.);"); },
     kInvalid, kDone, "E133 ShapeNotRead: .*'bad'(.|\n)*E111 ReferenceCycle: .*#300 IFCSURFACECURVE -> #300"},
    {"LayerSetUsageOfItself", "usage.ifc",
     [] {
         return withBadItem(
             "#200=IFCBLOCK(#11,1.,1.,1.);\n#300=IFCMATERIALLAYERSETUSAGE(#300,.AXIS2.,.POSITIVE.,0.,$);\n"
             "#301=IFCRELASSOCIATESMATERIAL('m',$,$,$,(#100),#300);");
     },
     kInvalid, kDone, "E111 ReferenceCycle: .*#300 IFCMATERIALLAYERSETUSAGE -> #300"},
    {"TrimmedChain", "chain.ifc", trimmedChain, kDone, kDone,
     "2 of 2 products with a shape were read, 0 of them in part"},
    {"MappedItems", "mapped.ifc", mappedItems, kInvalid, kDone, kPointsOfProduct},
    {"CompositeProfiles", "profiles.ifc", compositeProfiles, kInvalid, kDone, kPointsOfProduct},
    {"SharedItems", "shared.ifc", sharedItems, kLimit, kLimit,
     "error E104 InputTooBig: shared\\.ifc.*points and values, the limit for a file of this size", kSharedBytes},
    {"CutIfc", "cut.ifc", cutIfc, kInput, kInput, "error E137 Truncated: cut\\.ifc:[0-9]+: .*behind the record #200"},
    {"CutSequence", "cut.city.jsonl", cutSequenceOfTwo, kInput, kInput, "error E137 Truncated: cut\\.city\\.jsonl:3: "},
};

class HostileModelTest : public ::testing::TestWithParam<HostileModel> {};

TEST_P(HostileModelTest, IsCheckedAndBuiltWithinLimits) {
    const HostileModel& model = GetParam();
    const TemporaryFolder folder;
    writeText(folder / model.file, model.text());
    const CommandResult checked = runBounded(folder, {"check", model.file, "--verbose"}, model.memoryBytes);
    EXPECT_EQ(checked.exitCode, model.checked) << checked.toString();
    expectFound(checked, model.finding);
    const CommandResult built = runBounded(
        folder, {"build", model.file, "-o", "o.svt", "--spacing", "0.5", "--layers", "--verbose"}, model.memoryBytes);
    EXPECT_EQ(built.exitCode, model.built) << built.toString();
    expectFound(built, model.finding);
    EXPECT_EQ(fs::exists(folder / "o.svt"), model.built == kDone);
}

INSTANTIATE_TEST_SUITE_P(Models, HostileModelTest, ::testing::ValuesIn(kHostileModels),
                         [](const auto& tested) { return std::string(tested.param.name); });

// Plans and runs a city of what stands in 'files'. \return how many walls and buildings called 'sound' it has
std::size_t soundInCity(const TemporaryFolder& folder, const Arguments& more, std::string& said) {
    Arguments plan{"city", "plan", "files", "-o", "city", "--spacing", "0.5"};
    plan.insert(plan.end(), more.begin(), more.end());
    const CommandResult planned = runBounded(folder, plan, kSharedBytes, kSecondsOfAll);
    said = planned.err;
    EXPECT_EQ(planned.exitCode, kDone) << planned.toString();
    const CommandResult built = runBounded(folder, {"city", "run", "city", "--jobs", "2"});
    EXPECT_EQ(built.exitCode, kDone) << built.toString();
    return runSvtForJson(folder.path(), {"query", "city", "id~'^sound'", "--json"}).size();
}

TEST(HostileCity, HasAllThatCanBeReadOfBadFiles) {
    const TemporaryFolder folder;
    fs::create_directory(folder / "files");
    std::size_t readable = 0;
    for (const HostileModel& model : kHostileModels) {
        if (model.checked == kInput) continue;
        writeText(folder / ("files/" + std::string(model.file)), model.text());
        if (model.checked != kLimit) ++readable;
    }
    std::string said;
    EXPECT_EQ(soundInCity(folder, {}, said), readable);
    EXPECT_TRUE(std::regex_search(said, std::regex("E606 FeatureSkipped: files/shared\\.ifc: .*points and values")))
        << said;
}

TEST(HostileCity, NamesACutFileAndTakesItWhereThatIsAllowed) {
    for (const auto& [cut, text] : {std::pair{"cut.ifc", cutIfc()}, {"cut.city.jsonl", cutSequenceOfTwo()}}) {
        const TemporaryFolder folder;
        fs::create_directory(folder / "files");
        writeText(folder / "files/a.ifc", withBadItem("#200=IFCBLOCK(#11,1.,1.,1.);"));
        writeText(folder / ("files/" + std::string(cut)), text);
        const CommandResult refused = runBounded(folder, {"city", "plan", "files", "-o", "city", "--spacing", "0.5"});
        EXPECT_EQ(refused.exitCode, kInput) << refused.toString();
        expectFound(refused, "error E137 Truncated: files/" + std::string(cut));
        EXPECT_FALSE(fs::exists(folder / "city/plan/plan.json"));
        std::string said;
        EXPECT_EQ(soundInCity(folder, {"--allow-truncated"}, said), 2U) << said;
        EXPECT_NE(said.find("warning E137 Truncated: files/" + std::string(cut)), std::string::npos) << said;
    }
}

// The wall 'bad' is clipped by a bounded half space, and has an opening.
std::string withReferences() {
    return withBadItem(
        "#200=IFCBOOLEANCLIPPINGRESULT(.DIFFERENCE.,#201,#202);\n#201=IFCBLOCK(#11,4.,2.,3.);\n"
        "#202=IFCPOLYGONALBOUNDEDHALFSPACE(#203,.F.,#11,#205);\n#203=IFCPLANE(#204);\n"
        "#204=IFCAXIS2PLACEMENT3D(#206,$,$);\n#205=IFCPOLYLINE((#14,#15,#16,#14));\n"
        "#206=IFCCARTESIANPOINT((0.,0.,2.));\n"
        "#300=IFCOPENINGELEMENT('o',$,$,$,$,#23,#301,$,$);\n#301=IFCPRODUCTDEFINITIONSHAPE($,$,(#302));\n"
        "#302=IFCSHAPEREPRESENTATION($,'Body','CSG',(#18));\n#303=IFCRELVOIDSELEMENT('v',$,$,$,#100,#300);");
}

struct DanglingReference {
    const char* name;  // of the test
    const char *from, *to;
    const char* where;  // the record that has it, and the number of the attribute
};

void PrintTo(const DanglingReference& reference, std::ostream* stream) { *stream << reference.to; }

class DanglingReferenceTest : public ::testing::TestWithParam<DanglingReference> {};

TEST(DanglingReferences, AreNotInTheWholeModel) {
    const TemporaryFolder folder;
    writeText(folder / "good.ifc", withReferences());
    const CommandResult result = runBounded(folder, {"check", "good.ifc", "--verbose"});
    EXPECT_EQ(result.exitCode, kDone) << result.toString();
    expectFound(result, "2 of 2 products with a shape were read, 0 of them in part");
}

TEST_P(DanglingReferenceTest, IsNamedWithItsPlaceAndTheProductIsReadInPart) {
    const auto& [name, from, to, where] = GetParam();
    const TemporaryFolder folder;
    std::string text = withReferences();
    const std::size_t at = text.find(from);
    ASSERT_NE(at, std::string::npos);
    text.replace(at, std::string_view(from).size(), to);
    writeText(folder / "bad.ifc", text);
    const auto lineOf = [&](std::size_t offset) {
        return 1 + std::count(text.begin(), text.begin() + std::ptrdiff_t(offset), '\n');
    };
    for (const Arguments& arguments : {Arguments{"check", "bad.ifc", "--verbose"},
                                       Arguments{"build", "bad.ifc", "-o", "o.svt", "--spacing", "0.5", "--verbose"}}) {
        const CommandResult result = runBounded(folder, arguments);
        EXPECT_EQ(result.exitCode, arguments.front() == "check" ? kInvalid : kDone) << result.toString();
        expectFound(result, fmt::format("warning E110 DanglingReference: bad\\.ifc:{}: {} refers to #9999, which the "
                                        "file lacks",
                                        lineOf(at), where));
        expectFound(result, fmt::format("warning E132 ReadInPart: bad\\.ifc:{} \\(id 'bad'\\): .*#9999",
                                        lineOf(text.find("#100="))));
        expectFound(result, "2 of 2 products with a shape were read, 1 of them in part");
    }
}

const std::vector<DanglingReference> kDanglingReferences{
    {"Placement", "#23,#101", "#9999,#101", "attribute 6 of #100 IFCWALL"},
    {"Location", "IFCAXIS2PLACEMENT3D(#25", "IFCAXIS2PLACEMENT3D(#9999", "attribute 1 of #24 IFCAXIS2PLACEMENT3D"},
    {"OpeningShape", "#23,#301", "#23,#9999", "attribute 7 of #300 IFCOPENINGELEMENT"},
    {"PlanePosition", "IFCPLANE(#204)", "IFCPLANE(#9999)", "attribute 1 of #203 IFCPLANE"},
    {"PolylinePoint", "(#14,#15,#16,#14)", "(#14,#9999,#16,#14)", "attribute 1 of #205 IFCPOLYLINE"},
};
INSTANTIATE_TEST_SUITE_P(References, DanglingReferenceTest, ::testing::ValuesIn(kDanglingReferences),
                         [](const auto& tested) { return std::string(tested.param.name); });

}  // namespace
}  // namespace svt::test
