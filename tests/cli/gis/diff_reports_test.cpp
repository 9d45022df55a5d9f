// `svt diff -o report.html` and `-o changes.bcf`: pages and issues with known answers, on models of boxes.
#include "../run_command.hpp"
#include "../small_model.hpp"

#include <svt/image/png.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

namespace svt::test {
namespace {

std::size_t occurrencesOf(std::string_view text, std::string_view word) {
    std::size_t count = 0;
    for (std::size_t at = 0; (at = text.find(word, at)) != std::string_view::npos; at += word.size()) ++count;
    return count;
}

// The pictures of a page, decoded from its data addresses.
std::vector<image::Image<image::Rgba8>> picturesIn(const std::string& page) {
    constexpr std::string_view kStart = "src=\"data:image/png;base64,";
    constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::vector<image::Image<image::Rgba8>> pictures;
    for (std::size_t at = 0; (at = page.find(kStart, at)) != std::string::npos;) {
        at += kStart.size();
        std::vector<std::byte> bytes;
        unsigned group = 0, bits = 0;
        for (; page[at] != '"'; ++at) {
            const std::size_t digit = kDigits.find(page[at]);
            if (digit == std::string_view::npos) continue;
            group = group << 6 | unsigned(digit);
            if ((bits += 6) < 8) continue;
            bits -= 8;
            bytes.push_back(static_cast<std::byte>(group >> bits & 255));
        }
        auto picture = image::decodePng(bytes);
        EXPECT_TRUE(picture);
        if (picture) pictures.push_back(std::move(*picture));
    }
    return pictures;
}

// Pixels with the hue of added (blue) and of removed space (vermilion).
std::array<std::size_t, 2> changedPixels(const image::Image<image::Rgba8>& picture) {
    std::array<std::size_t, 2> counts{};
    for (const image::Rgba8& pixel : picture.pixels()) {
        if (pixel.b > pixel.r + 80) ++counts[0];
        if (pixel.r > pixel.b + 80 && pixel.r > pixel.g + 60) ++counts[1];
    }
    return counts;
}

// The three coordinates of an element, the first one after `from`.
std::array<double, 3> pointIn(const std::string& text, const std::string& name, std::size_t from = 0) {
    std::array<double, 3> point{};
    std::size_t at = text.find("<" + name + ">", from);
    EXPECT_NE(at, std::string::npos) << name;
    if (at == std::string::npos) return point;
    for (std::size_t i = 0; i < 3; ++i) {
        at = text.find(std::string("<") + "XYZ"[i] + ">", at) + 3;
        point[i] = std::stod(text.substr(at, 30));
    }
    return point;
}

// The distance of a point from the line of sight of the first camera after `from`.
double distanceFromSight(const std::string& bcf, std::array<double, 3> point, std::size_t from = 0) {
    const auto eye = pointIn(bcf, "CameraViewPoint", from), along = pointIn(bcf, "CameraDirection", from);
    std::array<double, 3> to{};
    double ahead = 0, squares = 0, unit = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        to[i] = point[i] - eye[i];
        ahead += to[i] * along[i];
        squares += to[i] * to[i];
        unit += along[i] * along[i];
    }
    EXPECT_NEAR(unit, 1, 1e-8);
    EXPECT_GT(ahead, 0);
    return std::sqrt(std::max(0.0, squares - ahead * ahead / unit));
}

class DiffReports : public ::testing::Test {
protected:
    CommandResult diff(const std::string& was, const std::string& is, std::vector<std::string> more = {}) {
        more.insert(more.begin(), {"diff", was, is, "-q"});
        return runSvt(folder.path(), more);
    }
    // A box that stays, and one from x = 10 whose length is given; 4 m wide, 3 m high. Its name has markup.
    std::string boxes(double length, double x = 0) {
        std::string other = building("other", solid(boxFaces(x + 10, 0, 0, x + 10 + length, 4, 3)));
        other.insert(other.find("\">") + 2, "<gml:name>&lt;script&gt;alert(1)&lt;/script&gt;</gml:name>");
        return cityModel(building("stays", solid(boxFaces(x, 0, 0, x + 4, 4, 3))) + other);
    }
    TemporaryFolder folder;
};

TEST_F(DiffReports, PageHasVolumesAndPictures) {
    writeText(folder / "a.gml", boxes(4));
    writeText(folder / "b.gml", boxes(5.5));
    const CommandResult result = diff("a.gml", "b.gml", {"--spacing", "0.25", "-o", "r.html"});
    ASSERT_EQ(result.exitCode, 7) << result.toString();
    const std::string page = readText(folder / "r.html");
    EXPECT_NE(page.find("<td class=\"n\">18.0000</td>"), std::string::npos);  // 1.5 x 4 x 3
    EXPECT_NE(page.find("a.gml"), std::string::npos);
    EXPECT_NE(page.find("0.25 x 0.25 x 0.25 m apart"), std::string::npos);
    EXPECT_EQ(page.find("<script"), std::string::npos);
    EXPECT_NE(page.find("&lt;script&gt;"), std::string::npos);
    EXPECT_EQ(page.find("http"), std::string::npos);
    const auto pictures = picturesIn(page);
    ASSERT_EQ(pictures.size(), 2u);
    EXPECT_EQ(occurrencesOf(page, "src="), 2u);
    for (const auto& picture : pictures) {
        const auto [added, removed] = changedPixels(picture);
        EXPECT_GT(added, 500u);
        EXPECT_EQ(removed, 0u);
    }
    const nlohmann::json sums = diff("a.gml", "b.gml", {"--spacing", "0.25", "--json"}).json()["summary"]["classes"];
    ASSERT_EQ(sums.size(), 1u);
    EXPECT_NEAR(sums[0]["added"].get<double>(), 18, 1e-6 + sums[0]["bound"].get<double>());
    EXPECT_LT(sums[0]["bound"].get<double>(), 1e-3);
    // The reverse comparison removes the same space.
    diff("b.gml", "a.gml", {"--spacing", "0.25", "-o", "reverse.html"});
    for (const auto& picture : picturesIn(readText(folder / "reverse.html"))) {
        const auto [added, removed] = changedPixels(picture);
        EXPECT_EQ(added, 0u);
        EXPECT_GT(removed, 500u);
    }
}

TEST_F(DiffReports, OfEqualStatesHaveNoChanges) {
    writeText(folder / "a.gml", boxes(4));
    const CommandResult result = diff("a.gml", "a.gml", {"--spacing", "0.5", "-o", "r.html", "-o", "c.bcf"});
    ASSERT_EQ(result.exitCode, 0) << result.toString();
    const std::string page = readText(folder / "r.html"), bcf = readText(folder / "c.bcf");
    EXPECT_NE(page.find("do not differ"), std::string::npos);
    EXPECT_TRUE(picturesIn(page).empty());
    EXPECT_NE(bcf.find("<Version VersionId=\"3.0\"/>"), std::string::npos);
    EXPECT_EQ(bcf.find("markup.bcf"), std::string::npos);
}

TEST_F(DiffReports, PageHasEachStoreyThatChanged) {
    runSvtWell(folder.path(), {"sample", "tower", "-o", "a.gml", "--storeys", "1"});
    runSvtWell(folder.path(), {"sample", "tower", "-o", "b.gml", "--storeys", "2"});
    const CommandResult result = diff("a.gml", "b.gml", {"--spacing", "0.4", "-o", "r.html"});
    ASSERT_EQ(result.exitCode, 7) << result.toString();
    const std::string page = readText(folder / "r.html");
    EXPECT_EQ(picturesIn(page).size(), 2 * occurrencesOf(page, "<h3>"));
    EXPECT_GE(occurrencesOf(page, "<h3>"), 1u);
    EXPECT_LT(page.find("<h2>Summary"), page.find("<h2>Changes by storey"));
}

TEST_F(DiffReports, ComeFromVoxelsWithoutMeshes) {
    writeText(folder / "a.gml", boxes(4));
    writeText(folder / "b.gml", boxes(5.5));
    for (const char* name : {"b", "a"})
        runSvtWell(folder.path(), {"build", std::string(name) + ".gml", "-o", std::string(name) + ".svt", "--spacing",
                                   "0.25", "--vectors", "none", "-q"});
    const CommandResult result = diff("a.svt", "b.svt", {"-o", "r.html", "-o", "c.bcf"});
    ASSERT_EQ(result.exitCode, 7) << result.toString();
    const std::string page = readText(folder / "r.html");
    EXPECT_EQ(picturesIn(page).size(), 2u);
    EXPECT_NE(page.find("<td class=\"n\">18.0000</td><td class=\"n\">0.0000</td><td class=\"n\">unknown</td>"),
              std::string::npos);
    EXPECT_NE(readText(folder / "c.bcf").find("counted in voxels"), std::string::npos);
}

TEST_F(DiffReports, SayWhyTheyHaveNoPictures) {
    writeText(folder / "a.gml", boxes(4));
    writeText(folder / "b.gml", boxes(5.5));
    for (const auto& [name, spacing] : {std::pair("a", "0.3"), std::pair("b", "0.25")})
        runSvtWell(folder.path(),
                   {"build", std::string(name) + ".gml", "-o", std::string(name) + ".svt", "--spacing", spacing, "-q"});
    const CommandResult result = runSvt(folder.path(), {"diff", "a.svt", "b.svt", "-o", "r.html", "-o", "c.bcf"});
    ASSERT_EQ(result.exitCode, 7) << result.toString();
    EXPECT_NE(result.err.find("c.bcf has no pictures"), std::string::npos) << result.err;
    const std::string page = readText(folder / "r.html");
    EXPECT_TRUE(picturesIn(page).empty());
    EXPECT_NE(page.find("This page has no pictures"), std::string::npos);
    EXPECT_NE(page.find("18.0000"), std::string::npos);  // meshes need no common samples
    EXPECT_EQ(readText(folder / "c.bcf").find("snapshot"), std::string::npos);
}

TEST_F(DiffReports, IssuesLookAtTheirObjects) {
    writeText(folder / "a.gml", boxes(4));
    writeText(folder / "b.gml", boxes(5.5));
    ASSERT_EQ(diff("a.gml", "b.gml", {"--spacing", "0.25", "-o", "c.bcf"}).exitCode, 7);
    const std::string bcf = readText(folder / "c.bcf");
    EXPECT_EQ(occurrencesOf(bcf, "<Markup>"), 1u);
    EXPECT_NE(bcf.find("<Title>changed: &lt;script&gt;alert(1)&lt;/script&gt; (18.000 m3)</Title>"), std::string::npos);
    EXPECT_NE(bcf.find("<AuthoringToolId>other</AuthoringToolId>"), std::string::npos);
    EXPECT_NE(bcf.find("<Filename>b.gml</Filename>"), std::string::npos);
    EXPECT_NE(bcf.find("18.0000 m3 added, 0.0000 m3 removed"), std::string::npos);
    EXPECT_LT(distanceFromSight(bcf, {12.75, 2, 1.5}), 1e-4);  // the centre of the new box
    EXPECT_EQ(occurrencesOf(bcf, "/snapshot.png"), 2u);        // the entry and the directory
}

// The coordinates of an issue are those of the model that its components are in.
TEST_F(DiffReports, IssuesOfAlignedModelsAreInTheirOwnCoordinates) {
    const auto modelAt = [](double x, bool hasLast) {
        std::string members;
        for (int n = 0; n < (hasLast ? 5 : 4); ++n)
            members += building("b" + std::to_string(n), solid(boxFaces(x + 10 * n, 0, 0, x + 10 * n + 4 + n, 6, 3)));
        return cityModel(members);
    };
    writeText(folder / "less.gml", modelAt(0, false));
    writeText(folder / "more.gml", modelAt(100, true));
    ASSERT_EQ(diff("less.gml", "more.gml", {"--spacing", "0.5", "--align", "translation", "-o", "added.bcf"}).exitCode,
              7);
    const std::string added = readText(folder / "added.bcf");
    EXPECT_EQ(occurrencesOf(added, "<Markup>"), 1u);
    EXPECT_NE(added.find("<Title>added: b4 (144.000 m3)</Title>"), std::string::npos);
    EXPECT_LT(distanceFromSight(added, {144, 3, 1.5}), 1e-4);
    ASSERT_EQ(diff("more.gml", "less.gml", {"--spacing", "0.5", "--align", "translation", "-o", "gone.bcf"}).exitCode,
              7);
    const std::string gone = readText(folder / "gone.bcf");
    EXPECT_NE(gone.find("<Filename>more.gml</Filename>"), std::string::npos);
    EXPECT_LT(distanceFromSight(gone, {144, 3, 1.5}), 1e-4);
}

TEST_F(DiffReports, IssuesNameGlobalIds) {
    runSvtWell(folder.path(), {"sample", "house", "-o", "a.ifc", "--format", "ifc"});
    runSvtWell(folder.path(), {"sample", "house", "-o", "b.ifc", "--format", "ifc", "--change", "5"});
    const CommandResult result =
        diff("a.ifc", "b.ifc", {"--spacing", "0.2", "--properties", "none", "-o", "c.bcf", "--json"});
    ASSERT_EQ(result.exitCode, 7) << result.toString();
    std::size_t changes = 0;
    const std::string bcf = readText(folder / "c.bcf");
    const nlohmann::json compared = result.json();
    for (const nlohmann::json& row : compared["rows"]) {
        if (row["change"] == "same") continue;
        ++changes;
        const std::string id = row["new"].empty() ? row["old"][0] : row["new"][0];
        EXPECT_EQ(occurrencesOf(bcf, "<Component IfcGuid=\"" + id + "\"/>"), 2u) << id;  // selected and coloured
    }
    EXPECT_GT(changes, 0u);
    EXPECT_EQ(occurrencesOf(bcf, "<Markup>"), changes);
}

// Volumes with different samples have no pictures, so this list is quick.
TEST_F(DiffReports, IssuesSayWhatIsLeftOut) {
    const auto modelOf = [](double extraHeight) {
        std::string members;
        for (int n = 0; n < 103; ++n)
            members += building("b" + std::to_string(n),
                                solid(boxFaces(10 * n, 0, 0, 10 * n + 4, 6, 3 + extraHeight * (1 + n))));
        return cityModel(members);
    };
    writeText(folder / "a.gml", modelOf(0));
    writeText(folder / "b.gml", modelOf(0.05));
    runSvtWell(folder.path(), {"build", "a.gml", "-o", "a.svt", "--spacing", "0.5", "-q"});
    runSvtWell(folder.path(), {"build", "b.gml", "-o", "b.svt", "--spacing", "0.6", "-q"});
    const CommandResult result = runSvt(folder.path(), {"diff", "a.svt", "b.svt", "-o", "c.bcf", "-o", "c.csv"});
    ASSERT_EQ(result.exitCode, 7) << result.toString();
    EXPECT_NE(result.err.find("c.bcf has the 100 largest of 103 changes"), std::string::npos) << result.err;
    const std::string bcf = readText(folder / "c.bcf");
    EXPECT_EQ(occurrencesOf(bcf, "<Markup>"), 100u);
    EXPECT_NE(bcf.find("<AuthoringToolId>b102</AuthoringToolId>"), std::string::npos);
    EXPECT_EQ(bcf.find("<AuthoringToolId>b2</AuthoringToolId>"), std::string::npos);  // the smaller changes
    EXPECT_LT(bcf.find("<Title>changed: b102 "), bcf.find("<Title>changed: b101 "));
}

TEST_F(DiffReports, CannotBeWrittenAnywhere) {
    writeText(folder / "a.gml", boxes(4));
    for (const char* output : {"missing/r.html", "missing/c.bcf"}) {
        const CommandResult result = diff("a.gml", "a.gml", {"-o", output});
        EXPECT_EQ(result.exitCode, kOutput) << result.toString();
        EXPECT_NE(result.err.find("missing"), std::string::npos) << result.err;
    }
    writeText(folder / "letter.html", "Dear reader");
    EXPECT_EQ(diff("a.gml", "a.gml", {"-o", "letter.html"}).exitCode, kOutput);
    EXPECT_EQ(readText(folder / "letter.html"), "Dear reader");
}

}  // namespace
}  // namespace svt::test
