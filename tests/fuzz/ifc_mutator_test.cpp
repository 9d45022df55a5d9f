// The mutator of the IFC fuzz target makes circles, and shapes that cannot be read, of files that have neither.
#include "ifc_mutator.hpp"

#include <svt/core/temporary_folder_test.hpp>
#include <svt/core/test_data_test.hpp>
#include <svt/readers/ifc/ifc_reader.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace svt::fuzz {
namespace {

struct Found {
    bool isModel = false;
    std::size_t circles = 0, unread = 0;  // products without a shape
};

Found foundIn(const std::string& text) {
    readers::ReadOptions options;
    options.threads = 1;
    options.splitLayers = true;
    Diagnostics log;
    const auto model = readers::readIfc(std::as_bytes(std::span(text)), "fuzz", options, &log);
    return {bool(model), log.count(Code::ReferenceCycle), log.count(Code::ShapeNotRead)};
}

// The files of the corpus that are read without either finding.
std::vector<std::string> soundSeeds() {
    std::vector<std::filesystem::path> files;
    const std::filesystem::path root = test::kSourceRoot;
    for (const auto& entry : std::filesystem::directory_iterator(root / "tests/fuzz/corpus/ifc_fuzz"))
        files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    std::vector<std::string> seeds;
    for (const std::filesystem::path& file : files) {
        std::string text = test::readText(file);
        const Found found = foundIn(text);
        if (found.isModel && found.circles == 0 && found.unread == 0) seeds.push_back(std::move(text));
    }
    return seeds;
}

TEST(IfcMutator, MakesCirclesAndUnreadableShapesOfSoundFiles) {
    const std::vector<std::string> seeds = soundSeeds();
    ASSERT_GT(seeds.size(), 10U);
    std::minstd_rand random(1);  // NOLINT: the same changes in every run
    std::size_t circles = 0, unread = 0;
    for (std::size_t n = 0; n < 300; ++n) {
        const Found found = foundIn(mutatedIfc(seeds[n % seeds.size()], random));
        circles += found.circles > 0 ? 1 : 0;
        unread += found.unread > 0 ? 1 : 0;
    }
    EXPECT_GT(circles, 12U);
    EXPECT_GT(unread, 40U);
}

}  // namespace
}  // namespace svt::fuzz
