#include <svt/volume/zip_file.hpp>

#include <svt/volume/file/zip_container.hpp>

#include <gtest/gtest.h>

#include <string_view>

namespace svt::volume {
namespace {

std::vector<std::byte> ownedBytes(std::string_view text) {
    const auto bytes = std::as_bytes(std::span(text.data(), text.size()));
    return {bytes.begin(), bytes.end()};
}

TEST(ZipFile, HoldsItsFilesInOrder) {
    const std::vector<ZippedFile> files{
        {"bcf.version", ownedBytes("<Version/>")}, {"a/empty", {}}, {"a/b.png", ownedBytes("PNG")}};
    const auto zip = makeZip(files);
    ASSERT_TRUE(zip) << zip.error().toString();
    const auto entries = readZip(*zip);
    ASSERT_TRUE(entries) << entries.error().toString();
    ASSERT_EQ(entries->size(), 3u);
    for (std::size_t n = 0; n < 3; ++n) {
        EXPECT_EQ((*entries)[n].name, files[n].name);
        EXPECT_FALSE((*entries)[n].isDeflated);
        std::vector<std::byte> buffer;
        const auto data = unpack((*entries)[n], 100, buffer);
        ASSERT_TRUE(data);
        EXPECT_EQ(std::vector<std::byte>(data->begin(), data->end()), files[n].bytes);
    }
    EXPECT_EQ(*makeZip(files), *zip);
    EXPECT_TRUE(makeZip({}));
}

}  // namespace
}  // namespace svt::volume
