// Damaged volumes, and outputs that cannot be written.
#include "run_command.hpp"
#include "small_model.hpp"

#include <regex>
#include <string_view>

namespace svt::test {
namespace {

class GoodVolume : public ::testing::Test {
protected:
    GoodVolume() {
        writeText(folder / "two.gml", twoBoxes());
        prepare(folder.path(), {"build", "two.gml", "-o", "good.svt", "--spacing", "0.25"});
        bytes = readText(folder / "good.svt");
    }
    // Output of `svt info` for a damaged volume.
    CommandResult infoOf(const std::string& damaged) {
        writeText(folder / "bad.svt", damaged);
        return runSvt(folder.path(), {"info", "bad.svt", "--json"});
    }
    TemporaryFolder folder;
    std::string bytes;
};

TEST_F(GoodVolume, CutAnywhereIsRefused) {
    for (std::size_t part = 1; part < 16; ++part) {
        const CommandResult result = infoOf(bytes.substr(0, bytes.size() * part / 16));
        EXPECT_EQ(result.exitCode, 3) << part << ": " << result.toString();
        EXPECT_TRUE(std::regex_search(result.err, std::regex("E401 BadVolume: bad\\.svt"))) << result.toString();
    }
}

TEST_F(GoodVolume, AChangedByteIsNoticedOrDoesNoHarm) {
    const nlohmann::json good = runSvtForJson(folder.path(), {"info", "good.svt", "--json"});
    int refused = 0, tried = 0;
    for (std::size_t at = 100; at < bytes.size(); at += bytes.size() / 60) {
        std::string damaged = bytes;
        damaged[at] = static_cast<char>(damaged[at] ^ 0x55);
        const CommandResult result = infoOf(damaged);
        ++tried;
        if (result.exitCode == 0) {
            EXPECT_EQ(result.json(), good) << "byte " << at;
        } else {
            ++refused;
            EXPECT_EQ(result.exitCode, 3) << "byte " << at << ": " << result.toString();
            EXPECT_TRUE(std::regex_search(result.err, std::regex("E40[123]"))) << result.toString();
        }
    }
    // Only damage to padding may go undetected.
    EXPECT_GT(refused * 2, tried);
}

TEST_F(GoodVolume, AChangedSampleBreaksTheChecksum) {
    std::string damaged = bytes;
    // Name and extra field stand between the local header and the data.
    const std::size_t name = damaged.find("columns/blocks");
    ASSERT_NE(name, std::string::npos);
    const auto extraBytes = static_cast<std::size_t>(static_cast<unsigned char>(damaged[name - 2])) +
                            256u * static_cast<unsigned char>(damaged[name - 1]);
    char& sample = damaged[name + std::string_view("columns/blocks").size() + extraBytes];
    sample = static_cast<char>(sample ^ 1);
    const CommandResult result = infoOf(damaged);
    EXPECT_EQ(result.exitCode, 3);
    EXPECT_NE(result.err.find("E402 BadChecksum"), std::string::npos) << result.toString();
}

TEST_F(GoodVolume, AVolumeIsNoModelToCheck) {
    const CommandResult result = runSvt(folder.path(), {"check", "good.svt"});
    EXPECT_EQ(result.exitCode, 3) << result.toString();
    EXPECT_NE(result.err.find("E103 UnknownFormat"), std::string::npos) << result.toString();
}

TEST_F(GoodVolume, AVolumeIsNoModelToBuild) {
    const CommandResult result = runSvt(folder.path(), {"build", "good.svt", "-o", "o.svt"});
    EXPECT_EQ(result.exitCode, 3) << result.toString();
    EXPECT_NE(result.err.find("E103 UnknownFormat"), std::string::npos) << result.toString();
}

TEST_F(GoodVolume, StdoutThatCannotBeWrittenIsTold) {
    if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
    Limits limits;
    limits.stdoutFile = "/dev/full";
    const CommandResult result = runSvt(folder.path(), {"info", "good.svt", "--json"}, limits);
    EXPECT_EQ(result.exitCode, 5) << result.toString();
    EXPECT_NE(result.err.find("stdout cannot be written"), std::string::npos) << result.err;
}

struct Output {
    const char* name;
    std::vector<std::string> arguments;
};

void PrintTo(const Output& output, std::ostream* stream) { *stream << output.name; }

class OutputTest : public ::testing::TestWithParam<Output> {
protected:
    OutputTest() {
        writeText(folder / "two.gml", twoBoxes());
        // Grains that do not compress well.
        writeText(folder / "grains.json",
                  R"({"rules": [{"select": "all", "pattern": {"type": "concrete", "size": 0.08}}]})");
        std::filesystem::create_directory(folder / "sub");
    }
    CommandResult runWith(const std::string& output, const Limits& limits = {}) {
        std::vector<std::string> arguments = GetParam().arguments;
        for (std::string& argument : arguments)
            if (argument.rfind("OUT", 0) == 0) argument = output + argument.substr(3);
        return runSvt(folder.path(), arguments, limits);
    }
    void expect(const CommandResult& result, const char* message) {
        EXPECT_EQ(result.exitCode, 5) << result.toString();
        EXPECT_TRUE(std::regex_search(result.err, std::regex(message))) << message << result.toString();
    }
    TemporaryFolder folder;
};

TEST_P(OutputTest, MissingFolderIsNamed) {
    expect(runWith("nowhere/o"), "E404 CannotWrite: nowhere/o.*folder nowhere does not exist");
}

TEST_P(OutputTest, PathUnderAFileIsRefused) {
    expect(runWith("two.gml/o"), "E404 CannotWrite: two\\.gml/o.*is a file, not a folder");
}

TEST_P(OutputTest, FolderIsRefused) {
    const std::string extension = GetParam().arguments.back().substr(3);
    std::filesystem::create_directory(folder / ("o" + extension));
    expect(runWith("o"), "E404 CannotWrite: o.*folder");
}

TEST_P(OutputTest, FullDiskIsTold) {
    Limits limits;
    limits.tinyDisk = folder / "sub";
    const CommandResult result = runWith("sub/o", limits);
    if (result.cannotMount) GTEST_SKIP() << "no small file system can be mounted here (needs root or user namespaces)";
    expect(result, "E405 DiskFull: sub/o.*no space");
}

TEST_P(OutputTest, SizeLimitIsToldAndLeavesTheOldFile) {
    const std::string name = "o" + GetParam().arguments.back().substr(3);
    // An older file of this kind, which the command may replace.
    ASSERT_EQ(runWith("o").exitCode, 0);
    const std::string old = readText(folder / name) + "old";
    writeText(folder / name, old);
    Limits limits;
    limits.fileBytes = 1024;
    const CommandResult result = runWith("o", limits);
    expect(result, "E404 CannotWrite: o.*limit");
    EXPECT_TRUE(readText(folder / name) == old);
    EXPECT_EQ(folder.count(), 4) << "a temporary file is left";
}

TEST_P(OutputTest, FullDeviceIsTold) {
    if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
    std::filesystem::create_symlink("/dev/full", folder / ("o" + GetParam().arguments.back().substr(3)));
    expect(runWith("o"), "E405 DiskFull");
}

// OUT in the last argument is replaced by the path without its extension.
const std::vector<Output> kOutputs{
    {"Build", {"build", "two.gml", "--dimension", "300,200,100", "--style", "grains.json", "--output", "OUT.svt"}},
    {"Sample", {"sample", "house", "--output", "OUT.gml"}},
    {"Convert", {"convert", "two.gml", "--dimension", "100", "--encoding", "raw", "OUT.nrrd"}},
    {"Render",
     {"render", "two.gml", "--size", "1200x800", "--edges", "1", "--spacing", "0.3", "--patterns", "--output",
      "OUT.png"}},
};
INSTANTIATE_TEST_SUITE_P(Commands, OutputTest, ::testing::ValuesIn(kOutputs),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace svt::test
