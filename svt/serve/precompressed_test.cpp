#include <svt/core/deflate.hpp>
#include <svt/core/machine.hpp>
#include <svt/serve/precompressed.hpp>

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

namespace svt::serve {
namespace {

// Text of 100 kB that a compressor does not make vanish.
std::string moduleText() {
    std::string text;
    for (std::uint32_t i = 0; text.size() < 100'000; ++i) text += "(func $" + std::to_string(i * i) + ")\n";
    return text;
}

using BrotliDecompress = int(std::size_t size, const std::uint8_t* bytes, std::size_t* unpackedSize,
                             std::uint8_t* unpacked);

TEST(Precompressed, CopiesOfModulesAndScriptsUnpackToThem) {
    Site site;
    const std::string text = moduleText();
    site.add("/assets/svt-12345678.wasm", Bytes::of(text));
    site.add("/assets/index-12345678.js", Bytes::of(text));
    site.add("/assets/index-12345678.css", Bytes::of(text));
    site.add("/models/house.svt", Bytes::of(text));
    site.add("/assets/tiny-12345678.wasm", Bytes::of("tiny"));
    const bool hasBrotli = addCompressedCopies(site);

    const Resource* gzip = site.find("/assets/svt-12345678.wasm.gz");
    ASSERT_NE(gzip, nullptr);
    EXPECT_LT(gzip->bytes.size(), text.size() / 2);
    std::vector<std::byte> unpacked(text.size());
    ASSERT_TRUE(inflateInto(gzip->bytes.data, DeflateFormat::Gzip, unpacked));
    EXPECT_TRUE(std::string(reinterpret_cast<const char*>(unpacked.data()), unpacked.size()) == text);

    for (const char* same : {"/assets/index-12345678.js.gz", "/assets/index-12345678.css.gz"}) {
        ASSERT_NE(site.find(same), nullptr) << same;
        EXPECT_TRUE(site.find(same)->bytes.text() == gzip->bytes.text()) << same;
    }
    for (const char* other : {"/models/house.svt.gz", "/models/house.svt.br", "/assets/tiny-12345678.wasm.gz",
                              "/assets/tiny-12345678.wasm.br"})
        EXPECT_EQ(site.find(other), nullptr) << other;

    const Resource* brotli = site.find("/assets/svt-12345678.wasm.br");
    EXPECT_EQ(brotli != nullptr, hasBrotli);
    const auto library = SharedLibrary::load("libbrotlidec.so.1");
    BrotliDecompress* decompress = nullptr;
    if (!brotli || !library || !library->find("BrotliDecoderDecompress", decompress))
        GTEST_SKIP() << "the machine has no Brotli (Debian: libbrotli1)";
    EXPECT_LT(brotli->bytes.size(), gzip->bytes.size());
    std::string again(text.size(), '\0');
    std::size_t size = again.size();
    EXPECT_EQ(decompress(brotli->bytes.size(), reinterpret_cast<const std::uint8_t*>(brotli->bytes.data.data()), &size,
                         reinterpret_cast<std::uint8_t*>(again.data())),
              1);
    EXPECT_TRUE(size == text.size() && again == text);
}

}  // namespace
}  // namespace svt::serve
