#include <svt/core/bytes.hpp>

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace svt {
namespace {

using namespace std::string_view_literals;

TEST(Bytes, AppendsLittleEndian) {
    std::string text;
    appendBytes(text, std::uint16_t{0x0201}, std::uint32_t{0x06050403});
    appendAs<std::uint16_t>(text, 0x10807u, std::uint8_t{9});
    EXPECT_EQ(text, "\1\2\3\4\5\6\7\10\11\0"sv);
    std::vector<std::byte> bytes;
    appendBytes(bytes, 1.0f);
    EXPECT_EQ(bytes, (std::vector<std::byte>{std::byte{0}, std::byte{0}, std::byte{0x80}, std::byte{0x3F}}));
}

TEST(Bytes, LoadsBothOrders) {
    const std::vector<std::byte> bytes{std::byte{0xFF}, std::byte{1}, std::byte{2}, std::byte{3}};
    EXPECT_EQ(loadBytes<std::uint16_t>(bytes, 1), 0x0201u);
    EXPECT_EQ(loadBytes<std::uint16_t>(bytes.data() + 1, std::endian::big), 0x0102u);
    EXPECT_EQ(loadNumber(bytes, 1, 3), 0x030201u);
    EXPECT_EQ(loadNumber(bytes, 1, 3, std::endian::big), 0x010203u);
}

TEST(Bytes, VarintsComeBack) {
    for (const std::uint64_t value : {0ull, 127ull, 128ull, 300ull, 0xFFFFFFFFull, ~0ull}) {
        std::string text;
        appendVarint(text, value);
        ByteReader from(text);
        EXPECT_EQ(from.takeVarint(), value);
        EXPECT_TRUE(from.isGood() && from.left() == 0);
    }
    for (const std::int64_t value : {0ll, -1ll, 1ll, -64ll, 1234567890123ll, -1234567890123ll})
        EXPECT_EQ(fromZigzag(zigzag(value)), value);
    EXPECT_EQ(zigzag(-1), 1u);
}

TEST(Bytes, BitsFillBytesFromTheLowest) {
    const std::vector<bool> bits{true, false, false, false, false, false, false, true, false, true};
    EXPECT_EQ(packedBits(bits.size(), [&](std::size_t n) { return bits[n]; }), "\x81\2"sv);
    EXPECT_EQ(packedBits(0, [](std::size_t) { return true; }), "");
}

TEST(Bytes, VarintsOfMoreThanTenBytesAreMissing) {
    const std::string text(12, '\xFF');
    ByteReader from(text);
    EXPECT_EQ(from.takeVarint(), 0u);
    EXPECT_FALSE(from.isGood());
    EXPECT_EQ(from.left(), 0u);
}

TEST(Bytes, ReaderStopsAtTheEnd) {
    ByteReader from("\1\2\3abc\4"sv);
    std::uint8_t first = 0;
    std::uint16_t second = 0;
    from.take(first, second);
    EXPECT_EQ(first, 1u);
    EXPECT_EQ(second, 0x0302u);
    EXPECT_EQ(from.text(3), "abc");
    EXPECT_TRUE(from.isGood());
    EXPECT_EQ(from.take<std::uint16_t>(), 0u);
    EXPECT_FALSE(from.isGood());
    EXPECT_EQ(from.left(), 0u);
    ByteReader text("ab"sv);
    EXPECT_EQ(text.text(3), "ab");
    EXPECT_FALSE(text.isGood());
}

}  // namespace
}  // namespace svt
