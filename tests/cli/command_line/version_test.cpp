// The facts that svt prints without a command.
#include <tests/cli/run_command.hpp>

#include <algorithm>

namespace svt::test {
namespace {

using nlohmann::json;

TEST(Facts, VersionAsJsonIsThatOfTheText) {
    const TemporaryFolder folder;
    const std::string text = runSvtWell(folder.path(), {"--version"});
    const json version = runSvtForJson(folder.path(), {"--version", "--json"});
    EXPECT_EQ(version, runSvtForJson(folder.path(), {"--json", "--version"}));
    EXPECT_EQ(keysOf(version),
              (std::vector<std::string>{"buildType", "commit", "compiler", "dependencies", "fileFormats", "loadedOnUse",
                                        "optimized", "parts", "simd", "version"}));
    for (const char* key : {"version", "commit", "compiler", "buildType", "simd"})
        EXPECT_NE(text.find(version.at(key).get<std::string>()), std::string::npos) << key << "\n" << text;
    EXPECT_EQ(version.at("fileFormats").at("svt"), "1.0");
    for (const char* format : {"city", "scene", "sheets"})
        EXPECT_GE(version.at("fileFormats").at(format).get<int>(), 1) << format;
    EXPECT_TRUE(version.at("parts").at("openGl").get<bool>());
}

TEST(Facts, LibrariesHaveVersions) {
    const TemporaryFolder folder;
    const json libraries = runSvtForJson(folder.path(), {"--version", "--json"}).at("dependencies");
    for (const char* name : {"CLI11", "fmt", "FreeType", "Highway", "libpng", "nlohmann_json", "oneTBB", "pugixml",
                             "simdjson", "zlib", "zstd"}) {
        const auto found = std::find_if(libraries.begin(), libraries.end(),
                                        [&](const json& library) { return library.at("name") == name; });
        ASSERT_NE(found, libraries.end()) << name;
        EXPECT_TRUE(found->at("version").is_string() &&
                    found->at("version").get<std::string>().find('.') != std::string::npos)
            << *found;
    }
}

TEST(Facts, FormatsAsJson) {
    const TemporaryFolder folder;
    const json formats = runSvtForJson(folder.path(), {"--formats", "--json"});
    EXPECT_EQ(formats, runSvtForJson(folder.path(), {"--formats", "json"}));
    EXPECT_GT(formats.size(), 20u);
}

TEST(Facts, JsonOfNothingIsAWrongUsage) {
    const TemporaryFolder folder;
    const CommandResult result = runSvt(folder.path(), {"--json"});
    EXPECT_EQ(result.exitCode, kUsage) << result.toString();
    EXPECT_NE(result.err.find("--json needs --version or --formats"), std::string::npos) << result.err;
}

}  // namespace
}  // namespace svt::test
