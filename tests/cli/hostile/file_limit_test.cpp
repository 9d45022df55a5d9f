// Writes beyond the file size limit (signal XFSZ): an error of every output in every format, which leaves no half of it.
#include <tests/cli/hostile/running_svt.hpp>
#include <tests/cli/small_model.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace svt::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using Arguments = std::vector<std::string>;

// An output of a command: an option, and a call that writes `o` with an ending, or the folder `o`.
struct LimitedOutput {
    std::string option;
    Arguments arguments;
    bool isFilm = false;
};

// Every option of every command that names an output stands here.
const LimitedOutput kLimitedOutputs[] = {
    {"--output", {"sample", "house", "-o", "o.gml"}},
    {"--output", {"sample", "house", "-o", "o.json"}},
    {"--output", {"sample", "house", "-o", "o.jsonl"}},
    {"--output", {"sample", "house", "-o", "o.ifc"}},
    {"--change-list",
     {"sample", "house", "--format", "citygml3", "-o", "/dev/null", "--change", "1", "--change-list", "o.json"}},
    {"--output", {"sample-city", "--buildings", "1", "-o", "o"}},
    {"--output", {"build", "two.gml", "-o", "o.svt", "--spacing", "1"}},
    {"--report", {"check", "two.gml", "--report", "o.html"}},
    {"--output", {"render", "two.svt", "--size", "32x32", "-o", "o.png"}},
    {"--output", {"render", "two.svt", "--size", "32x32", "-o", "o.svg"}},
    {"--output", {"render", "two.svt", "--size", "32x32", "-o", "o.pdf"}},
    {"--output", {"render", "two.svt", "--size", "32x32", "--turn", "90", "--seconds", "0.1", "-o", "o.webm"}, true},
    {"--output", {"render", "two.svt", "--size", "32x32", "--turn", "90", "--seconds", "0.1", "-o", "o.mp4"}, true},
    {"--output", {"render", "two.svt", "--size", "32x32", "--turn", "90", "--seconds", "0.1", "-o", "o.gif"}, true},
    {"--output", {"render", "two.svt", "--size", "32x32", "--turn", "90", "--seconds", "0.1", "-o", "o.webp"}, true},
    {"--output", {"thumbnail", "two.svt", "--size", "32", "-o", "o.png"}},
    {"--labels", {"render", "two.svt", "--size", "32x32", "-o", "/dev/null", "--labels", "o.png"}},
    {"--depth", {"render", "two.svt", "--size", "32x32", "-o", "/dev/null", "--depth", "o.png"}},
    {"--write-scene", {"render", "two.svt", "--size", "32x32", "-o", "/dev/null", "--write-scene", "o.scene.json"}},
    {"--output", {"section", "two.svt", "--plane", "z=1", "-o", "o.svg"}},
    {"--output", {"section", "two.svt", "--plane", "z=1", "-o", "o.pdf"}},
    {"--output", {"section", "two.svt", "--plane", "z=1", "-o", "o.dxf"}},
    {"--output", {"section", "two.svt", "--plane", "z=1", "-o", "o.geojson"}},
    {"--table", {"section", "two.svt", "--plane", "z=1", "--table", "o.csv"}},
    {"--table", {"section", "two.svt", "--plane", "z=1", "--table", "o.json"}},
    {"--output", {"sheets", "two.svt", "-o", "o.pdf"}},
    {"--output", {"sheets", "two.svt", "-o", "o.gpkg"}},
    {"--svg", {"sheets", "two.svt", "--svg", "o"}},
    {"--dxf", {"sheets", "two.svt", "--dxf", "o"}},
    {"--schedule", {"sheets", "tower.svt", "-o", "o.pdf", "--schedule", "o.csv"}},
    {"--write-sheets", {"sheets", "two.svt", "--write-sheets", "o.sheets.json"}},
    {"--output", {"cadastre", "tower.svt", "-o", "o.gpkg"}},
    {"--output", {"cadastre", "tower.svt", "-o", "o.gml"}},
    {"--output", {"cadastre", "tower.svt", "-o", "o.pdf"}},
    {"--output", {"cadastre", "tower.svt", "-o", "o.city.json"}},
    {"--output", {"cadastre", "tower.svt", "-o", "o.ifc"}},
    {"--output", {"query", "two.svt", "all", "-o", "o.geojson"}},
    {"--output", {"query", "two.svt", "all", "-o", "o.csv"}},
    {"--output", {"query", "two.svt", "all", "-o", "o.gpkg"}},
    {"--output", {"query", "two.svt", "all", "-o", "o.parquet"}},
    {"--output", {"quantities", "two.svt", "-o", "o.csv"}},
    {"--output", {"quantities", "two.svt", "-o", "o.json"}},
    {"--output", {"quantities", "two.svt", "-o", "o.parquet"}},
    {"--output", {"quantities", "two.svt", "-o", "o.xlsx"}},
    {"--output", {"quantities", "small.ifc", "--spacing", "1", "-o", "o.ifc"}},
    {"--output", {"field-add", "two.svt", "co2.csv", "--places", "places.csv", "--unit", "[ppm]", "-o", "o.svt"}},
    {"--output", {"field-remove", "field.svt", "co2", "-o", "o.svt"}},
    {"--output", {"simulate-heat", "tower.svt", "--leaky", "-o", "o.svt"}},
    {"--output", {"simulate-spread", "air.svt", "co2", "-o", "o.svt"}},
    {"--output", {"field-export", "field.svt", "co2", "-o", "o.csv"}},
    {"--output", {"field-export", "field.svt", "co2", "-o", "o.json"}},
    {"--output", {"field-export", "field.svt", "co2", "-o", "o.parquet"}},
    {"--output", {"field-export", "warm.svt", "temperature", "-o", "o.vti"}},
    {"--output", {"field-export", "warm.svt", "temperature", "-o", "o.vtr"}},
    {"--output", {"field-export", "warm.svt", "temperature", "-o", "o.nrrd"}},
    {"--output", {"field-stats", "field.svt", "co2", "-o", "o.csv"}},
    {"--output", {"field-stats", "field.svt", "co2", "-o", "o.json"}},
    {"--output", {"field-stats", "field.svt", "co2", "-o", "o.parquet"}},
    {"--output", {"field-probe", "field.svt", "co2", "--at", "500002,5400003,101", "-o", "o.csv"}},
    {"--output", {"field-probe", "field.svt", "co2", "--at", "500002,5400003,101", "-o", "o.json"}},
    {"--output", {"field-probe", "field.svt", "co2", "--at", "500002,5400003,101", "-o", "o.parquet"}},
    {"--output", {"diff", "two.svt", "two.gml", "-o", "o.csv"}},
    {"--output", {"diff", "two.svt", "two.gml", "-o", "o.json"}},
    {"--output", {"diff", "two.svt", "two.gml", "-o", "o.svt"}},
    {"--output", {"diff", "two.svt", "two.gml", "-o", "o.html"}},
    {"--output", {"diff", "two.svt", "two.gml", "-o", "o.bcf"}},
    {"--output", {"shell", "two.svt", "-o", "o.svt"}},
    {"--output", {"shell", "two.svt", "-o", "o.glb"}},
    {"output", {"convert", "two.svt", "o.nrrd"}},
    {"--output", {"publish", "two.svt", "-o", "o", "--viewer", "page"}},
    {"--output", {"city-plan", "two.gml", "-o", "o"}},
    {"--output", {"city-extract", "city", "-o", "o.svt", "--box=-1e7,-1e7,-1e7,1e7,1e7,1e7"}},
};

class FileLimit : public ::testing::Test {
protected:
    FileLimit() {
        writeText(folder / "two.gml", twoBoxes());
        runSvtWell(folder.path(), {"build", "two.gml", "-o", "two.svt", "--spacing", "0.5"});
        runSvtWell(folder.path(), {"sample", "tower", "--storeys", "1", "-o", "tower.gml"});
        runSvtWell(folder.path(), {"build", "tower.gml", "-o", "tower.svt", "--spacing", "1"});
        runSvtWell(folder.path(), {"simulate-heat", "tower.svt", "--leaky", "-q", "-o", "warm.svt"});
        runSvtWell(folder.path(), {"sample", "house", "-o", "small.ifc"});
        writeText(folder / "co2.csv", "time,sensor,value\n0,s1,400\n900,s1,500\n");
        writeText(folder / "places.csv", "name,x,y,z\ns1,500002,5400003,101\n");
        runSvtWell(folder.path(), {"field-add", "two.svt", "co2.csv", "--places", "places.csv", "--unit", "[ppm]",
                                   "--medium", "all", "--name", "co2", "-o", "field.svt"});
        writeText(folder / "rooms.csv", "name,room\ns1,tower_S00_common\n");
        runSvtWell(folder.path(), {"field-add", "tower.svt", "co2.csv", "--places", "rooms.csv", "--unit", "[ppm]",
                                   "--name", "co2", "-o", "air.svt"});
    }

    // At a limit of a few bytes and at one that the largest file reaches at its half, the command fails and leaves no output; of
    // files beside it and of a folder that it fills, whole ones and not all.
    void expectError(const Arguments& arguments) const {
        const std::string what = fmt::format("{}", fmt::join(arguments, " "));
        const auto isOutput = [](const std::string& text) { return text == "o" || text.starts_with("o."); };
        const std::string output = *std::ranges::find_if(arguments, isOutput);
        const auto before = contentBelow(folder.path());
        const CommandResult result = runSvt(folder.path(), arguments);
        ASSERT_EQ(result.exitCode, 0) << what << ": " << result.toString();
        const auto whole = contentBelow(folder.path());
        constexpr std::size_t kFewBytes = 64;
        std::size_t largest = 0;
        for (const auto& [name, content] : whole)
            if (!before.contains(name)) largest = std::max(largest, content.size());
        ASSERT_GT(largest, kFewBytes) << what;
        for (const std::size_t limit : {kFewBytes, largest / 2}) {
            removeOutputs();
            Limits limits;
            limits.fileBytes = limit;
            const CommandResult limited = runSvt(folder.path(), arguments, limits);
            EXPECT_EQ(limited.exitCode, kOutput) << what << ", " << limit << " bytes: " << limited.toString();
            std::size_t missing = whole.size();
            for (const auto& [name, content] : contentBelow(folder.path())) {
                const auto found = whole.find(name);
                EXPECT_TRUE(found != whole.end() && found->second == content)
                    << what << ", " << limit << " bytes: " << name;
                // A file that the output names may be there before it.
                EXPECT_TRUE(output == "o" || (name != output && !name.starts_with(output + "/")))
                    << what << ", " << limit << " bytes: " << name;
                --missing;
            }
            EXPECT_GT(missing, 0u) << what << ", " << limit << " bytes";
        }
        removeOutputs();
    }

    TemporaryFolder folder;

private:
    void removeOutputs() const {
        std::vector<fs::path> outputs;
        for (const auto& entry : fs::directory_iterator(folder.path()))
            if (entry.path().filename().string().starts_with("o")) outputs.push_back(entry.path());
        for (const fs::path& output : outputs) fs::remove_all(output);
    }
};

TEST_F(FileLimit, IsAnErrorOfEveryFormatOfConvert) {
    prepareHouse(folder.path(), "0.5");
    std::set<std::string> tried;
    const json described = runSvtForJson(folder.path(), {"describe", "json"});
    for (const json& format : described.at("volumeFormats")) {
        // The boxes have no rooms, of which IndoorGML and cases of OpenFOAM are made.
        const std::string name = format.at("name");
        const bool isOfRooms = name == "indoorgml" || name == "foam";
        for (const std::string ending : format.at("endings")) {
            Arguments arguments{"convert", isOfRooms ? "house.svt" : "two.svt", "o" + ending};
            if (name == "foam") arguments.insert(arguments.end(), {"--air", "name=Kitchen"});
            expectError(arguments);
        }
        tried.insert(name);
    }
    // Tables of features, which cities have too.
    for (const json& format : runSvtForJson(folder.path(), {"--formats", "json"})) {
        const json& by = format.at("writtenBy");
        if (std::ranges::find(by, json("convert")) == by.end() || tried.contains(format.at("name"))) continue;
        for (const std::string ending : format.at("endings")) expectError({"convert", "two.svt", "o" + ending});
    }
}

TEST_F(FileLimit, IsAnErrorOfEveryOutputOfEveryCommand) {
    fs::create_directory(folder / "page");
    writeText(folder / "page/index.html", "<!doctype html><head></head>");
    runSvtWell(folder.path(), {"city-plan", "two.gml", "-o", "city", "--spacing", "1"});
    runSvtWell(folder.path(), {"city-run", "city"});
    for (const LimitedOutput& output : kLimitedOutputs)
        if (!output.isFilm) expectError(output.arguments);
}

TEST_F(FileLimit, IsAnErrorOfEveryFilm) {
    if (!hasProgram("ffmpeg -version")) GTEST_SKIP() << "ffmpeg is missing";
    for (const LimitedOutput& output : kLimitedOutputs)
        if (output.isFilm) expectError(output.arguments);
}

TEST_F(FileLimit, IsTriedForAllOutputsThatAreDeclared) {
    std::set<std::string> tried;
    for (const auto& [option, arguments, isFilm] : kLimitedOutputs) tried.insert(arguments[0] + " " + option);
    const json described = runSvtForJson(folder.path(), {"describe", "json"});
    for (const json& command : described.at("commands"))
        for (const json& option : command.at("options")) {
            if (!option.value("file", "").starts_with("output")) continue;
            const std::string name = option.at("name");
            EXPECT_TRUE(tried.contains(std::string(command.at("name")) + " " + name.substr(name.find(',') + 1)))
                << command.at("name") << " " << name;
        }
    const auto isTried = [](const std::string& command, const json& endings) {
        return std::ranges::any_of(kLimitedOutputs, [&](const LimitedOutput& output) {
            return output.arguments[0] == command &&
                   std::ranges::any_of(output.arguments, [&](const std::string& file) {
                       return file.starts_with("o.") && std::ranges::any_of(endings, [&](const std::string ending) {
                                  return file.ends_with(ending);
                              });
                   });
        });
    };
    for (const json& format : runSvtForJson(folder.path(), {"--formats", "json"}))
        for (const std::string command : format.at("writtenBy")) {
            if (command == "convert") continue;
            EXPECT_TRUE(isTried(command, format.at("endings"))) << command << ": " << format.at("name");
        }
}

TEST_F(FileLimit, IsAnErrorOfTheTasksAndOfTheMergeOfACity) {
    runSvtWell(folder.path(), {"city-plan", "two.gml", "-o", "plan", "--spacing", "1"});
    const auto begin = [&](const Arguments& done) {
        fs::remove_all(folder / "city");
        fs::copy(folder / "plan", folder / "city", fs::copy_options::recursive);
        if (!done.empty()) runSvtWell(folder.path(), done);
    };
    const Arguments task{"city-task", "city", "0"};
    Limits limits;
    limits.fileBytes = 64;
    for (const Arguments& arguments : {task, Arguments{"city-run", "city"}, Arguments{"city-merge", "city"}}) {
        begin(arguments[0] == "city-merge" ? task : Arguments());
        const auto before = contentBelow(folder / "city");
        const CommandResult result = runSvt(folder.path(), arguments, limits);
        // A city whose packs are not done cannot be read.
        EXPECT_EQ(result.exitCode, arguments[0] == "city-run" ? kInput : kOutput) << result.toString();
        for (const auto& [name, content] : contentBelow(folder / "city")) {
            if (fs::is_directory(folder / "city" / name)) continue;
            EXPECT_TRUE(before.contains(name) && before.at(name) == content) << arguments[0] << " leaves " << name;
        }
    }
}

}  // namespace
}  // namespace svt::test
