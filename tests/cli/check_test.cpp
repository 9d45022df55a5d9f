// svt check: findings by ISO 19107, as text, JSON, val3dity's report and a page. The models are made here.
#include "run_command.hpp"

#include <fmt/format.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

namespace svt::test {
namespace {

using nlohmann::json;

// Eight corners of a box, and its faces as CityJSON has them; `first` is the number of its first corner.
json corners(double x, double y, double z, double size) {
    json vertices = json::array();
    for (const double dz : {0.0, size})
        for (const auto& [dx, dy] : {std::pair{0.0, 0.0}, {size, 0.0}, {size, size}, {0.0, size}})
            vertices.push_back({x + dx, y + dy, z + dz});
    return vertices;
}
json boxShell(int first, bool isTurned = false) {
    json shell = json::array();
    for (std::vector<int> ring :
         {std::vector{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}) {
        if (isTurned) std::reverse(ring.begin(), ring.end());
        for (int& corner : ring) corner += first;
        shell.push_back(json::array({ring}));
    }
    return shell;
}

json cityJson(const std::string& type, const json& boundaries, const std::vector<json>& vertices) {
    json all = json::array();
    for (const json& some : vertices) all.insert(all.end(), some.begin(), some.end());
    return {
        {"type", "CityJSON"},
        {"version", "2.0"},
        {"transform", {{"scale", {1, 1, 1}}, {"translate", {0, 0, 0}}}},
        {"CityObjects",
         {{"b", {{"type", "Building"}, {"geometry", {{{"type", type}, {"lod", "2"}, {"boundaries", boundaries}}}}}}}},
        {"vertices", all}};
}

class Check : public ::testing::Test {
protected:
    CommandResult check(const json& model, std::vector<std::string> more = {}) {
        writeText(folder / "m.json", model.dump());
        more.insert(more.begin(), {"check", "m.json"});
        return runSvt(folder.path(), more);
    }
    TemporaryFolder folder;
};

// A box whose void sticks out of its top.
json voidSticksOut() {
    return cityJson("Solid", {boxShell(0), boxShell(8, true)}, {corners(0, 0, 0, 9), corners(2, 2, 6, 5)});
}

TEST_F(Check, AValidSolidIsDoneWithItsVolume) {
    const json model = cityJson("Solid", {boxShell(0), boxShell(8, true)}, {corners(0, 0, 0, 9), corners(2, 2, 2, 3)});
    const CommandResult result = check(model, {"--json"});
    EXPECT_EQ(result.exitCode, 0) << result.toString();
    const json report = result.json();
    EXPECT_EQ(report["valid"], true);
    EXPECT_EQ(report["findings"], json::array());
    EXPECT_EQ(report["primitives"], json::parse(R"([{"type":"Solid","total":1,"valid":1}])"));
    EXPECT_NEAR(report["objects"][0]["volume"].get<double>(), 729 - 27, 1e-6);
}

TEST_F(Check, DegreesThatCannotBeNeedAUnit) {
    json model = cityJson("Solid", json::array({boxShell(0)}), {corners(0, 0, 0, 9)});
    model["metadata"]["referenceSystem"] = "https://www.opengis.net/def/crs/EPSG/0/4326";
    const CommandResult refused = check(model);
    EXPECT_EQ(refused.exitCode, 3) << refused.toString();
    EXPECT_NE(refused.err.find("E127 UnitInDoubt"), std::string::npos) << refused.err;
    const CommandResult result = check(model, {"--unit", "dm", "--json"});
    EXPECT_EQ(result.exitCode, 0) << result.toString();
    EXPECT_NEAR(result.json()["objects"][0]["volume"].get<double>(), 0.729, 1e-9);
}

TEST_F(Check, AFindingNamesCodePlaceAndTermAndTheVolumeIsNone) {
    const CommandResult result = check(voidSticksOut(), {"--json"});
    EXPECT_EQ(result.exitCode, 4) << result.toString();
    const json report = result.json();
    EXPECT_EQ(report["valid"], false);
    ASSERT_EQ(report["findings"].size(), 1u);
    const json& finding = report["findings"][0];
    EXPECT_EQ(finding["code"], "E234");
    EXPECT_EQ(finding["name"], "ShellsIntersect");
    EXPECT_EQ(finding["val3dity"], 401);
    EXPECT_EQ(finding["val3dityName"], "INTERSECTION_SHELLS");
    EXPECT_EQ(finding["feature"], "b");
    EXPECT_EQ(finding["type"], "Solid");
    EXPECT_EQ(finding["shell"], 1);
    EXPECT_NEAR(finding["at"][2].get<double>(), 9, 1e-5);
    EXPECT_FALSE(finding["iso"].get<std::string>().empty());
    EXPECT_EQ(report["counts"], json::parse(R"({"E234":1})"));
    EXPECT_EQ(report["objects"][0]["volume"], nullptr);
    EXPECT_EQ(report["objects"][0]["volumeReason"], "E234");
}

TEST_F(Check, ReportsAsVal3dityDoes) {
    const CommandResult result = check(voidSticksOut(), {"--format", "val3dity", "--planarity", "0.02"});
    EXPECT_EQ(result.exitCode, 4) << result.toString();
    const json report = result.json();
    EXPECT_EQ(keysOf(report),
              (std::vector<std::string>{"all_errors", "dataset_errors", "features", "features_overview", "input_file",
                                        "input_file_type", "other_counts", "other_findings", "parameters",
                                        "primitives_overview", "time", "type", "val3dity_version", "validity"}));
    EXPECT_EQ(report["type"], "val3dity_report");
    EXPECT_EQ(report["input_file_type"], "CityJSON");
    EXPECT_EQ(report["validity"], false);
    EXPECT_EQ(report["all_errors"], json::parse("[401]"));
    EXPECT_EQ(report["dataset_errors"], json::array());
    EXPECT_EQ(report["parameters"]["planarity_d2p_tol"], 0.02);
    EXPECT_EQ(report["parameters"]["overlap_tol"], -1);
    EXPECT_EQ(report["features_overview"], json::parse(R"([{"type":"Building","total":1,"valid":0}])"));
    ASSERT_EQ(report["features"].size(), 1u);
    EXPECT_EQ(report["features"][0]["id"], "b");
    EXPECT_EQ(report["features"][0]["validity"], false);
    EXPECT_EQ(report["features"][0]["errors"][0]["code"], 401);
    EXPECT_EQ(report["features"][0]["errors"][0]["description"], "INTERSECTION_SHELLS");
}

TEST_F(Check, TheOverlapOfACompositeMayBeAllowed) {
    json model =
        cityJson("CompositeSolid", {{boxShell(0)}, {boxShell(8)}}, {corners(0, 0, 0, 9), corners(8.99, 0, 0, 9)});
    EXPECT_EQ(check(model).exitCode, 4);
    const CommandResult allowed = check(model, {"--overlap", "0.01"});
    EXPECT_EQ(allowed.exitCode, 0) << allowed.toString();
}

TEST_F(Check, AMaterialThatIsMissingIsNoDefect) {
    json model = cityJson("Solid", json::array({boxShell(0)}), {corners(0, 0, 0, 9)});
    model["CityObjects"]["b"]["geometry"][0]["material"] = {{"theme", {{"value", 3}}}};
    const CommandResult result = check(model, {"--verbose"});
    EXPECT_EQ(result.exitCode, 0) << result.toString();
    EXPECT_NE(result.err.find("note E119"), std::string::npos) << result.err;
}

TEST_F(Check, ThePageShowsEachDefectAndLoadsNothing) {
    json model = voidSticksOut();
    model["CityObjects"]["<b>"] = model["CityObjects"]["b"];
    EXPECT_EQ(check(model, {"--report", "r.html"}).exitCode, 4);
    const std::string page = readText(folder / "r.html");
    EXPECT_NE(page.find("ShellsIntersect"), std::string::npos);
    EXPECT_NE(page.find("&lt;b&gt;"), std::string::npos) << "ids are escaped";
    EXPECT_EQ(page.find("<b>\""), std::string::npos);
    std::size_t pictures = 0;
    for (std::size_t at = page.find("<svg"); at != std::string::npos; at = page.find("<svg", at + 1)) ++pictures;
    EXPECT_EQ(pictures, 4u) << "two of each defect: the whole, and from near";
    for (const char* foreign : {"http:", "https:", "src=", "<script", "@import", "url("})
        EXPECT_EQ(page.find(foreign), std::string::npos) << foreign;
}

// A box without its top, twice with one id, and a child that is not there.
json openAndDangling() {
    json shell = boxShell(0);
    shell.erase(shell.begin() + 1);
    json model = cityJson("Solid", json::array({shell}), {corners(0, 0, 0, 9)});
    model["CityObjects"]["b"]["children"] = {"missing"};
    return model;
}

TEST_F(Check, ThePageHasWhatReadingAndClosingFoundByKindAndPlace) {
    const CommandResult result = check(openAndDangling(), {"--report", "r.html"});
    EXPECT_EQ(result.exitCode, 4) << result.toString();
    const std::string page = readText(folder / "r.html");
    for (const char* expected :
         {"<td><a href=\"#E110\">E110</a></td><td>DanglingReference</td>", "<h2 id=\"E110\">",
          "<td><a href=\"#E209\">E209</a></td><td>ShellCapped</td>", "<h2 id=\"E209\">", "<h2 id=\"E207\">",
          "closed with 1 planar caps", "<td>Building</td><td><code>b</code></td>", "Reading or closing found defects"})
        EXPECT_NE(page.find(expected), std::string::npos) << expected;
    // The page has the findings that stderr lists.
    for (const char* code : {"E110", "E207", "E209"})
        EXPECT_NE(result.err.find(code), std::string::npos) << code << "\n" << result.err;
    std::size_t pictures = 0;
    for (std::size_t at = page.find("<svg"); at != std::string::npos; at = page.find("<svg", at + 1)) ++pictures;
    EXPECT_EQ(pictures, 4u) << "of the shell that is open, and of the cap that closes it";
}

TEST_F(Check, Val3ditysReportHasWhatReadingAndClosingFoundBesideIt) {
    const json report = check(openAndDangling(), {"--format", "val3dity"}).json();
    EXPECT_EQ(report["all_errors"], json::parse("[302]"));
    EXPECT_EQ(report["other_counts"], json::parse(R"({"E110":1,"E209":1})"));
    ASSERT_EQ(report["other_findings"].size(), 2u);
    EXPECT_EQ(report["other_findings"][0]["name"], "DanglingReference");
    EXPECT_EQ(report["other_findings"][1]["code"], "E209");
    EXPECT_EQ(report["other_findings"][1]["feature"], "b");
    EXPECT_EQ(report["other_findings"][1]["severity"], "warning");
}

// The lines of a text in order of the alphabet, each cut behind its last word: ids, without measures.
std::vector<std::string> sortedLines(const std::string& text, bool isLastWord) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);)
        lines.push_back(isLastWord ? line.substr(line.rfind(' ') + 1) : line);
    std::ranges::sort(lines);
    return lines;
}

// Features of three batches of 16 MiB; with blanks the file has more than 64 MiB, from which on it is read in batches.
std::string largeFile(const TemporaryFolder& folder, const std::string& profile, const std::string& buildings) {
    runSvtWell(folder.path(),
               {"sample", "city", "--profile", profile, "--buildings", buildings, "--files", "1", "-o", profile});
    std::string text = readText(folder / profile / "00000.gml");
    EXPECT_GT(text.size(), std::size_t{34} << 20);
    EXPECT_LT(text.size(), std::size_t{64} << 20);
    std::string blanks((std::size_t{66} << 20) - text.size(), ' ');
    for (std::size_t at = 100; at < blanks.size(); at += 100) blanks[at] = '\n';
    return text.insert(text.rfind("</core:CityModel>"), blanks);
}

TEST_F(Check, ALargeFileIsCheckedFeatureByFeatureWithTheSameFindings) {
    Limits limits;
    limits.seconds = 120;
    std::string text = largeFile(folder, "berlin", "3200");
    writeText(folder / "large.gml", text);
    const CommandResult batches = runSvt(folder.path(), {"check", "large.gml", "--verbose"}, limits);
    const CommandResult whole =
        runSvt(folder.path(), {"check", "large.gml", "--verbose", "--report", "r.html"}, limits);
    EXPECT_EQ(batches.exitCode, 4) << batches.err.substr(0, 2000);
    EXPECT_EQ(whole.exitCode, 4);
    EXPECT_EQ(sortedLines(batches.err, false), sortedLines(whole.err, false));
    EXPECT_GT(sortedLines(batches.err, false).size(), 5u);
    EXPECT_EQ(sortedLines(batches.out, true), sortedLines(whole.out, true));
    EXPECT_EQ(batches.out.substr(batches.out.size() - 100), whole.out.substr(whole.out.size() - 100)) << "the counts";

    // Degrees: one projection for all batches, told once.
    writeText(folder / "degrees.gml", largeFile(folder, "plateau", "2600"));
    const CommandResult degrees = runSvt(folder.path(), {"check", "degrees.gml", "--verbose"}, limits);
    const std::size_t told = degrees.err.find("E118");
    ASSERT_NE(told, std::string::npos);
    EXPECT_EQ(degrees.err.find("E118", told + 1), std::string::npos);

    // A surface of another building: the file is read whole, and the link is followed.
    const std::size_t polygon = text.find("<gml:Polygon gml:id=\"") + 21;
    const std::string id = text.substr(polygon, text.find('"', polygon) - polygon);
    text.insert(text.rfind("</core:CityModel>"),
                "<core:cityObjectMember><bldg:Building gml:id=\"linked\"><bldg:lod2MultiSurface><gml:MultiSurface>"
                "<gml:surfaceMember xlink:href=\"#" +
                    id + "\"/></gml:MultiSurface></bldg:lod2MultiSurface></bldg:Building></core:cityObjectMember>");
    writeText(folder / "linked.gml", text);
    const CommandResult linked = runSvt(folder.path(), {"check", "linked.gml", "--verbose"}, limits);
    EXPECT_EQ(linked.err.find("E110"), std::string::npos) << linked.err.substr(0, 2000);
    EXPECT_NE(linked.out.find("  linked\n"), std::string::npos);
}

// A box with `count` faces that repeat a point, each with two findings: the body is whole.
json repeatsPoints(int count) {
    json shell = boxShell(0);
    for (int f = 0; f < count; ++f) {
        json& ring = shell[static_cast<std::size_t>(f)][0];
        ring.insert(ring.begin(), ring[0]);
    }
    return cityJson("Solid", json::array({shell}), {corners(0, 0, 0, 9)});
}

TEST_F(Check, FindingsThatDoNotPreventUseChangeTheExitCodeOnlyIfStrict) {
    const CommandResult result = check(repeatsPoints(3));
    EXPECT_EQ(result.exitCode, 0) << result.toString();
    EXPECT_NE(result.err.find("svt: 6 findings do not prevent use:\n"), std::string::npos) << result.err;
    EXPECT_EQ(check(repeatsPoints(3), {"--strict"}).exitCode, 4);
    EXPECT_EQ(check(repeatsPoints(3), {"--format", "val3dity"}).exitCode, 4) << "as val3dity counts";
    EXPECT_EQ(check(repeatsPoints(0), {"--strict"}).exitCode, 0);
    const CommandResult quiet = check(openAndDangling(), {"--quiet"});
    EXPECT_EQ(quiet.exitCode, 4);
    EXPECT_EQ(quiet.err, "");
}

TEST_F(Check, JsonStatesWhatPreventsUse) {
    const json report = check(repeatsPoints(1), {"--json"}).json();
    EXPECT_EQ(report["valid"], false);
    EXPECT_EQ(report["usable"], true);
    EXPECT_EQ(report["findings"][0]["preventsUse"], false);
    const json open = check(openAndDangling(), {"--json"}).json();
    EXPECT_EQ(open["usable"], false);
    for (const json& finding : open["diagnostics"]) EXPECT_EQ(finding["preventsUse"], true) << finding;
}

TEST_F(Check, FindingsOfOneCauseAreOneWithTheirNumber) {
    const CommandResult result = check(repeatsPoints(3));
    const std::size_t first = result.err.find("warning E220 RepeatedPoint");
    ASSERT_NE(first, std::string::npos) << result.err;
    EXPECT_EQ(result.err.find("warning E220", first + 1), std::string::npos) << result.err;
    EXPECT_NE(result.err.find("svt:   3 findings of this kind: 'b'\n"), std::string::npos) << result.err;
    EXPECT_NE(result.err.find("svt: 6 warnings of 2 kinds; --verbose shows each\n"), std::string::npos) << result.err;
    const CommandResult all = check(repeatsPoints(3), {"--verbose"});
    std::size_t count = 0;
    for (std::size_t at = 0; (at = all.err.find("warning E220", at)) != std::string::npos; ++at) ++count;
    EXPECT_EQ(count, 3u) << all.err;
    EXPECT_EQ(check(repeatsPoints(3), {"--json"}).json()["findings"].size(), 3u);
}

TEST_F(Check, BodiesThatTouchAlongAnEdgeHaveTheirVolume) {
    json shell = boxShell(0);
    for (const json& face : boxShell(8)) shell.push_back(face);
    const CommandResult result =
        check(cityJson("Solid", json::array({shell}), {corners(0, 0, 0, 2), corners(2, 2, 0, 2)}), {"--json"});
    EXPECT_EQ(result.exitCode, 0) << result.toString();
    EXPECT_EQ(result.json()["counts"], json::parse(R"({"E230":1})"));
    EXPECT_NEAR(result.json()["objects"][0]["volume"].get<double>(), 16, 1e-6);
}

TEST_F(Check, APageThatCannotBeWrittenIsAnError) {
    const CommandResult result = check(voidSticksOut(), {"--report", "missing/r.html"});
    EXPECT_EQ(result.exitCode, 5) << result.toString();
}

}  // namespace
}  // namespace svt::test
