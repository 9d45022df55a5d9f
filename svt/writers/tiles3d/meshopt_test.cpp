#include <svt/writers/tiles3d/meshopt.hpp>

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace svt::writers {
namespace {

/// An own decoder, after the text of EXT_meshopt_compression.
std::vector<std::uint8_t> decodedVertices(const std::string& file, std::size_t count, std::size_t stride) {
    std::size_t at = 0;
    const auto next = [&] { return static_cast<std::uint8_t>(file.at(at++)); };
    EXPECT_EQ(next(), 0xA0);
    std::vector<std::uint8_t> last(file.end() - std::ptrdiff_t(stride), file.end()), values(count * stride);
    const std::size_t block = std::min<std::size_t>(8192 / stride / 16 * 16, 256);
    for (std::size_t first = 0; first < count; first += block) {
        const std::size_t size = std::min(block, count - first), groups = (size + 15) / 16;
        for (std::size_t k = 0; k < stride; ++k) {
            std::vector<std::uint8_t> header;
            for (std::size_t n = 0; n < (groups + 3) / 4; ++n) header.push_back(next());
            for (std::size_t g = 0; g < groups; ++g) {
                const unsigned bits = 1u << (header[g / 4] >> g % 4 * 2 & 3);  // 1 stands for none
                std::vector<unsigned> deltas;
                for (std::size_t n = 0; bits > 1 && n < 16 * bits / 8; ++n) {
                    const unsigned byte = next();
                    for (unsigned shift = 8; shift > 0; shift -= bits)
                        deltas.push_back(byte >> (shift - bits) & ((1u << bits) - 1));
                }
                deltas.resize(16);
                for (std::size_t n = 0; n < 16; ++n) {
                    if (bits > 1 && bits < 8 && deltas[n] == (1u << bits) - 1) deltas[n] = next();
                    if (g * 16 + n >= size) continue;
                    last[k] = std::uint8_t(last[k] + (deltas[n] >> 1 ^ (deltas[n] & 1 ? 255u : 0u)));
                    values[(first + g * 16 + n) * stride + k] = last[k];
                }
            }
        }
    }
    EXPECT_EQ(at + std::max<std::size_t>(32, stride), file.size());
    return values;
}

std::vector<std::uint32_t> decodedIndices(const std::string& file, std::size_t count) {
    std::vector<std::uint32_t> indices;
    std::uint32_t last[2] = {0, 0};
    std::size_t at = 1;
    EXPECT_EQ(static_cast<std::uint8_t>(file[0]), 0xD1);
    while (indices.size() < count) {
        std::uint32_t value = 0;
        for (unsigned shift = 0;; shift += 7) {
            const auto byte = static_cast<std::uint8_t>(file.at(at++));
            value |= std::uint32_t(byte & 127) << shift;
            if (byte < 128) break;
        }
        std::uint32_t& run = last[value & 1];
        value >>= 1;
        run += value >> 1 ^ (value & 1 ? ~0u : 0u);
        indices.push_back(run);
    }
    EXPECT_EQ(at + 4, file.size());
    return indices;
}

TEST(Meshopt, VerticesComeBack) {
    std::mt19937 random(7);
    for (const std::size_t stride : {4u, 8u, 12u, 64u})
        for (const std::size_t count : {1u, 15u, 16u, 17u, 255u, 256u, 257u, 1000u}) {
            std::vector<std::uint8_t> values(count * stride);
            for (std::size_t n = 0; n < values.size(); ++n)  // steps of each size, and noise
                values[n] = std::uint8_t(n % 3 == 0 ? random() : n % 3 == 1 ? n / stride * (n % 5) : 9);
            const std::string file = compressVertices(std::as_bytes(std::span(values)), stride);
            EXPECT_EQ(decodedVertices(file, count, stride), values) << stride << " " << count;
        }
    const std::vector<std::uint8_t> same(8000, 5);
    EXPECT_LT(compressVertices(std::as_bytes(std::span(same)), 8).size(), 200u);
}

TEST(Meshopt, IndicesComeBack) {
    std::mt19937 random(7);
    std::vector<std::uint32_t> indices;
    for (std::uint32_t quad = 0; quad < 1000; ++quad)
        for (const std::uint32_t corner : {0, 1, 2, 0, 2, 3}) indices.push_back(4 * quad + corner);
    const std::string quads = compressIndices(indices);
    EXPECT_EQ(decodedIndices(quads, indices.size()), indices);
    EXPECT_LE(quads.size(), indices.size() + 5) << "a byte each";
    for (std::uint32_t n = 0; n < 1000; ++n) indices.push_back(std::uint32_t(random() & 0x3FFFFFFF));
    EXPECT_EQ(decodedIndices(compressIndices(indices), indices.size()), indices);
}

}  // namespace
}  // namespace svt::writers
