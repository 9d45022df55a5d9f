// `svt quantities`: workbooks, settings of tables, and quantity sets in copies of IFC files.
#include "../run_command.hpp"
#include "../small_model.hpp"

#include <cmath>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace svt::test {
namespace {

using nlohmann::json;

class QuantityFiles : public ::testing::Test {
protected:
    json bookOf(const std::string& file) {
        runShellWell(folder.path(), pythonOf("read_xlsx.py") + " " + file + " book.json");
        return json::parse(readText(folder / "book.json"));
    }
    CommandResult quantities(std::vector<std::string> more) {
        more.insert(more.begin(), "quantities");
        more.insert(more.end(), {"--spacing", "0.2"});
        return runSvt(folder.path(), more);
    }
    TemporaryFolder folder;
};

std::size_t columnOf(const json& sheet, const std::string& heading) {
    const json& headings = sheet["rows"][0];
    for (std::size_t c = 0; c < headings.size(); ++c)
        if (headings[c] == heading) return c;
    ADD_FAILURE() << "no heading " << heading << " in " << headings;
    return 0;
}

TEST_F(QuantityFiles, AWorkbookHasTheFiguresOfJson) {
    runSvtWell(folder.path(), {"sample", "house", "-o", "house.ifc"});
    const std::vector<std::string> options{"house.ifc", "--exterior", "--formwork", "class=BuildingConstructiveElement",
                                           "--stated",  "-q"};
    auto withFile = [&](const std::string& file) {
        std::vector<std::string> words = options;
        words.insert(words.end(), {"-o", file});
        return words;
    };
    ASSERT_EQ(quantities(withFile("q.xlsx")).exitCode, 0);
    ASSERT_EQ(quantities(withFile("again.xlsx")).exitCode, 0);
    ASSERT_EQ(quantities(withFile("q.json")).exitCode, 0);
    EXPECT_EQ(readText(folder / "q.xlsx"), readText(folder / "again.xlsx"));
    const json book = bookOf("q.xlsx"), report = json::parse(readText(folder / "q.json"));
    for (const char* name : {"Quantities", "Sums", "Exterior", "Formwork", "Stated", "About"})
        EXPECT_TRUE(book.contains(name)) << name;
    const json& sheet = book["Quantities"];
    ASSERT_EQ(sheet["rows"].size(), report["rows"].size() + 1);
    EXPECT_TRUE(sheet["frozen"].get<bool>());
    EXPECT_FALSE(sheet["filter"].is_null());
    const std::map<std::string, std::string> headings{{"id", "ID"},
                                                      {"netVolume", "Net volume (m3)"},
                                                      {"grossVolume", "Gross volume (m3)"},
                                                      {"openingArea", "Opening area (m2)"},
                                                      {"exteriorArea", "Exterior area (m2)"},
                                                      {"formworkArea", "Formwork area (m2)"}};
    std::size_t unknown = 0;
    for (const auto& [key, heading] : headings) {
        const std::size_t column = columnOf(sheet, heading);
        for (std::size_t r = 0; r < report["rows"].size(); ++r) {
            const json &expected = report["rows"][r][key], &found = sheet["rows"][r + 1][column];
            unknown += expected.is_null();
            if (expected.is_number())
                EXPECT_NEAR(found.get<double>(), expected.get<double>(), 1e-9) << key << " " << r;
            else
                EXPECT_EQ(found, expected) << key << " " << r;
        }
    }
    EXPECT_GT(unknown, 5u) << "unknown figures are empty cells";
    const json& sums = book["Sums"];
    const json& last = sums["rows"].back();
    EXPECT_EQ(last[0], "(sum)");
    EXPECT_NEAR(last[columnOf(sums, "Net volume (m3)")].get<double>(), report["total"]["netVolume"].get<double>(),
                1e-6);
    EXPECT_EQ(book["Stated"]["rows"].size(), report["stated"].size() + 1);
    EXPECT_EQ(book["Exterior"]["rows"].size(), report["exterior"].size() + 1);
    std::set<std::string> about;
    for (const json& row : book["About"]["rows"]) about.insert(row[0].get<std::string>());
    for (const char* name : {"Input", "Spacing", "Version", "Assumption", "Note"})
        EXPECT_TRUE(about.count(name)) << name;
}

TEST_F(QuantityFiles, AWorkbookHasContacts) {
    writeText(folder / "two.gml", twoBoxes());
    const CommandResult result = quantities({"two.gml", "--between", "all", "--between", "all", "-o", "b.xlsx"});
    ASSERT_EQ(result.exitCode, 0) << result.err;
    const json book = bookOf("b.xlsx");
    EXPECT_EQ(book["Between"]["rows"][0][4], "Contact area by faces of A (m2)");
    EXPECT_TRUE(book.contains("About"));
}

// Rows, sums and contacts, with the names of the columns whatever the settings are.
TEST_F(QuantityFiles, ParquetHasTheRowsOfCsv) {
    writeText(folder / "two.gml", twoBoxes());
    writeText(folder / "s.json", R"({"format": "svt-quantities", "version": 1, "language": "de"})");
    const std::vector<std::pair<std::string, std::vector<std::string>>> tables{
        {"rows", {}}, {"sums", {"--by", "class"}}, {"between", {"--between", "all", "--between", "all"}}};
    for (const auto& [name, options] : tables) {
        std::vector<std::string> words{"two.gml", "-o", name + ".parquet"};
        words.insert(words.end(), options.begin(), options.end());
        ASSERT_EQ(quantities(words).exitCode, 0) << name;
        words[2] = name + ".csv";
        ASSERT_EQ(quantities(words).exitCode, 0) << name;
        words[2] = "again.parquet";
        words.insert(words.end(), {"--settings", "s.json"});
        ASSERT_EQ(quantities(words).exitCode, 0) << name;
        const std::string bytes = readText(folder / (name + ".parquet"));
        EXPECT_EQ(bytes.substr(0, 4), "PAR1");
        EXPECT_EQ(bytes.substr(bytes.size() - 4), "PAR1");
        EXPECT_EQ(readText(folder / "again.parquet"), bytes);
    }
    std::string said;
    for (const auto& [name, options] : tables)
        for (const char* reader : {"parquet ", "arrow "})
            if (!isRun(folder.path(), nodeOf("read_formats.mjs") + reader + name + ".parquet " + name + ".csv", said))
                GTEST_SKIP() << said;
}

TEST_F(QuantityFiles, SettingsChooseColumnsUnitsAndLanguage) {
    writeText(folder / "two.gml", twoBoxes());
    writeText(folder / "s.quantities.json",
              R"({"format": "svt-quantities", "version": 1, "columns": ["name", "netVolume", "height", "topArea"],
                  "units": {"length": "mm", "volume": "l"}, "language": "de"})");
    const CommandResult text = quantities({"two.gml", "--settings", "s.quantities.json"});
    ASSERT_EQ(text.exitCode, 0) << text.err;
    EXPECT_EQ(text.out.find("Name"), 0u) << text.out;
    for (const char* part :
         {"Nettovolumen (l)", "Höhe (mm)", "Fläche oben (m2)", "72000.00", "3000.0", "24.000", "(sum)"})
        EXPECT_NE(text.out.find(part), std::string::npos) << part << "\n" << text.out;
    ASSERT_EQ(quantities({"two.gml", "--settings", "s.quantities.json", "-o", "q.csv"}).exitCode, 0);
    EXPECT_EQ(readText(folder / "q.csv").find("Name,Nettovolumen (l),Höhe (mm),Fläche oben (m2)\r\n"), 0u);
    ASSERT_EQ(quantities({"two.gml", "--settings", "s.quantities.json", "-o", "q.xlsx"}).exitCode, 0);
    const json sheet = bookOf("q.xlsx")["Quantities"];
    EXPECT_EQ(sheet["rows"][0], json({"Name", "Nettovolumen (l)", "Höhe (mm)", "Fläche oben (m2)"}));
    EXPECT_NEAR(sheet["rows"][1][1].get<double>(), 72000, 1);
    const CommandResult sums = quantities({"two.gml", "--settings", "s.quantities.json", "--by", "class"});
    EXPECT_NE(sums.out.find("144000.00"), std::string::npos) << sums.out;
}

TEST_F(QuantityFiles, SettingsWithErrorsNameThePlace) {
    writeText(folder / "two.gml", twoBoxes());
    const std::string head = R"({"format": "svt-quantities", "version": 1)";
    const std::vector<std::pair<std::string, std::string>> cases{
        {R"(, "colums": ["id"]})", "/: unknown member 'colums'"},
        {R"(, "columns": ["id", "volume"]})", "/columns/1: unknown column 'volume'"},
        {R"(, "columns": ["id", "id"]})", "/columns/1: the column 'id' is listed twice"},
        {R"(, "units": {"length": "ft"}})", "/units/length"},
        {R"(, "units": {"mass": "kg"}})", "/units: unknown member 'mass'"},
        {R"(, "language": "fr"})", "/language"},
        {R"(, "columns": ["exteriorArea"]})", "needs --exterior"},
    };
    for (const auto& [rest, expected] : cases) {
        writeText(folder / "s.json", head + rest);
        const CommandResult result = quantities({"two.gml", "--settings", "s.json"});
        EXPECT_EQ(result.exitCode, 2) << rest;
        EXPECT_NE(result.err.find(expected), std::string::npos) << result.err;
    }
    writeText(folder / "s.json", "{");
    EXPECT_NE(quantities({"two.gml", "--settings", "s.json"}).exitCode, 0);
}

// The copy differs only by its new records, whose quantities are read as the measured ones, in metres.
TEST_F(QuantityFiles, ACopyOfIfcHasTheQuantities) {
    runSvtWell(folder.path(), {"sample", "house", "-o", "house.ifc"});
    const CommandResult made = quantities({"house.ifc", "-o", "copy.ifc"});
    ASSERT_EQ(made.exitCode, 0) << made.err;
    const std::string before = readText(folder / "house.ifc"), after = readText(folder / "copy.ifc");
    const std::size_t end = before.rfind("ENDSEC;");
    ASSERT_GT(after.size(), before.size());
    EXPECT_EQ(after.substr(0, end), before.substr(0, end));
    EXPECT_TRUE(after.ends_with(before.substr(end)));
    CommandResult read = quantities({"copy.ifc", "--stated", "--json", "-q"});
    ASSERT_EQ(read.exitCode, 0) << read.err;
    std::map<std::string, std::size_t> compared;
    const json report = read.json();
    for (const json& row : report["stated"]) {
        const std::string name = row["quantity"];
        if (!name.starts_with("Qto_")) continue;
        ++compared[name];
        EXPECT_NEAR(row["stated"].get<double>(), row["measured"].get<double>(), 2e-6) << row;
    }
    for (const char* name : {"Qto_WallBaseQuantities.NetVolume", "Qto_WallBaseQuantities.Length",
                             "Qto_WallBaseQuantities.GrossSideArea", "Qto_SlabBaseQuantities.GrossVolume"})
        EXPECT_GT(compared[name], 2u) << name;
    // A second run keeps the sets of the first one.
    const CommandResult again = quantities({"copy.ifc", "-o", "again.ifc"});
    EXPECT_EQ(again.exitCode, 2);
    EXPECT_NE(again.err.find("no object gets quantities"), std::string::npos) << again.err;
}

TEST_F(QuantityFiles, ACopyNeedsAnotherFileThatIsIfc) {
    runSvtWell(folder.path(), {"sample", "house", "-o", "house.ifc"});
    writeText(folder / "two.gml", twoBoxes());
    const CommandResult gml = quantities({"two.gml", "-o", "copy.ifc"});
    EXPECT_EQ(gml.exitCode, 2);
    EXPECT_NE(gml.err.find("is not an IFC file"), std::string::npos) << gml.err;
    const std::string before = readText(folder / "house.ifc");
    EXPECT_NE(quantities({"house.ifc", "-o", "house.ifc"}).exitCode, 0);
    EXPECT_EQ(readText(folder / "house.ifc"), before);
    EXPECT_EQ(quantities({"house.ifc", "--between", "all", "--between", "all", "-o", "copy.ifc"}).exitCode, 2);
}

// A quantity in IFC states no bound, so a volume that was counted is not written.
TEST_F(QuantityFiles, ACopyHasNoUncertainVolumes) {
    runSvtWell(folder.path(), {"sample", "house", "-o", "house.ifc"});
    const json rows = quantities({"house.ifc", "--json", "-q"}).json()["rows"];
    for (const json& row : rows) EXPECT_TRUE(row["trust"] == "exact" || row["trust"] == "tight") << row;
    // The baked house without a face of its first faceted body.
    runSvtWell(folder.path(), {"sample", "house", "-o", "baked.ifc", "--bake-openings"});
    std::string text = readText(folder / "baked.ifc");
    const std::size_t shell = text.find("=IFCCLOSEDSHELL((");
    ASSERT_NE(shell, std::string::npos);
    const std::size_t first = shell + std::string("=IFCCLOSEDSHELL((").size();
    text.erase(first, text.find(',', first) + 1 - first);
    writeText(folder / "open.ifc", text);
    const json open = quantities({"open.ifc", "--json", "-q"}).json();
    std::string id;
    for (const json& row : open["rows"])
        if (row["trust"] == "caps" || row["trust"] == "voxels") id = row["id"];
    ASSERT_FALSE(id.empty());
    const CommandResult made = quantities({"open.ifc", "-o", "copy.ifc"});
    ASSERT_EQ(made.exitCode, 0) << made.err;
    EXPECT_NE(made.err.find("the volumes of 1 objects are not in the file"), std::string::npos) << made.err;
    const json stated = quantities({"copy.ifc", "--stated", "--json", "-q"}).json();
    for (const json& row : stated["stated"]) {
        const std::string name = row["quantity"];
        EXPECT_FALSE(row["id"] == id && name.starts_with("Qto_") && name.ends_with("Volume")) << row;
    }
}

// Areas in square centimetres, volumes in litres.
TEST_F(QuantityFiles, ACopyHasTheUnitsOfTheFile) {
    runSvtWell(folder.path(), {"sample", "house", "-o", "house.ifc"});
    std::string text = readText(folder / "house.ifc");
    const auto replace = [&](const std::string& from, const std::string& to) {
        const std::size_t at = text.find(from);
        ASSERT_NE(at, std::string::npos) << from;
        text.replace(at, from.size(), to);
    };
    replace("=IFCSIUNIT(*,.AREAUNIT.,$,.SQUARE_METRE.)", "=IFCSIUNIT(*,.AREAUNIT.,.CENTI.,.SQUARE_METRE.)");
    replace("=IFCSIUNIT(*,.VOLUMEUNIT.,$,.CUBIC_METRE.)", "=IFCSIUNIT(*,.VOLUMEUNIT.,.DECI.,.CUBIC_METRE.)");
    writeText(folder / "units.ifc", text);
    ASSERT_EQ(quantities({"house.ifc", "-o", "plain.ifc"}).exitCode, 0);
    ASSERT_EQ(quantities({"units.ifc", "-o", "copy.ifc"}).exitCode, 0);
    const auto stated = [&](const char* file) {
        std::map<std::string, double> all;
        const json report = quantities({file, "--stated", "--json", "-q"}).json();
        for (const json& row : report["stated"])
            if (row["quantity"].get<std::string>().starts_with("Qto_"))
                all[row["id"].get<std::string>() + row["quantity"].get<std::string>()] = row["stated"];
        return all;
    };
    const auto plain = stated("plain.ifc"), other = stated("copy.ifc");
    EXPECT_GT(plain.size(), 50u);
    ASSERT_EQ(plain.size(), other.size());
    for (const auto& [key, value] : plain) EXPECT_NEAR(other.at(key), value, 2e-6) << key;
    EXPECT_NE(readText(folder / "copy.ifc").find("=IFCQUANTITYLENGTH('Length',$,$,"), std::string::npos);
}

}  // namespace
}  // namespace svt::test
