#include <svt/core/file.hpp>
#include <svt/core/machine.hpp>
#include <svt/core/temporary_folder_test.hpp>

#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <vector>

namespace svt {
namespace {

std::size_t residentFileKilobytes() {
    std::ifstream status("/proc/self/status");
    for (std::string word; status >> word;)
        if (word == "RssFile:") {
            std::size_t size = 0;
            status >> size;
            return size;
        }
    return 0;
}

TEST(MemoryPages, MappedBytesLeaveTheMemoryAndAreReadAgain) {
    const test::TemporaryFolder folder;
    const std::filesystem::path path = folder / "large";
    std::string text(16 << 20, 'x');
    for (std::size_t n = 0; n < text.size(); n += 997) text[n] = static_cast<char>('a' + n % 26);
    ASSERT_TRUE(writeFileAtomically(path, text));
    const auto file = MappedFile::open(path);
    ASSERT_TRUE(file);
    EXPECT_EQ(file->text(), text);
    const std::size_t before = residentFileKilobytes();
    forgetMappedBytes(file->bytes().subspan(5, file->bytes().size() - 100));
    if (before != 0) {
        EXPECT_LT(residentFileKilobytes() + 15'000, before);
    }
    EXPECT_EQ(file->text(), text);
}

TEST(MemoryPages, OtherMemoryKeepsItsBytes) {
    std::vector<std::byte> bytes(8 << 20, std::byte{7});
    forgetMappedBytes(bytes);
    forgetMappedBytes({});
    returnFreeMemory();
    EXPECT_EQ(bytes, std::vector<std::byte>(8 << 20, std::byte{7}));
}

}  // namespace
}  // namespace svt
