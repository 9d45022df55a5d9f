#include <svt/writers/tiles3d/meshopt.hpp>

#include <svt/core/check.hpp>

#include <algorithm>
#include <array>
#include <vector>

namespace svt::writers {
namespace {

constexpr std::size_t kGroup = 16, kMostInBlock = 256, kBytesOfBlock = 8192, kLeastTail = 32;

// Bytes of a group with values of `bits` bits. Larger values follow as whole bytes.
std::size_t sizeOfGroup(std::span<const std::uint8_t> group, unsigned bits) {
    if (bits == 0) return std::all_of(group.begin(), group.end(), [](auto v) { return v == 0; }) ? 0 : ~std::size_t{0};
    if (bits == 8) return kGroup;
    const unsigned escape = (1u << bits) - 1;
    const auto escapes = std::count_if(group.begin(), group.end(), [&](auto value) { return value >= escape; });
    return kGroup * bits / 8 + static_cast<std::size_t>(escapes);
}

void appendGroup(std::span<const std::uint8_t> group, unsigned bits, std::string& out) {
    if (bits == 0) return;
    if (bits == 8) {
        out.append(reinterpret_cast<const char*>(group.data()), group.size());
        return;
    }
    const unsigned escape = (1u << bits) - 1, each = 8 / bits;
    for (std::size_t i = 0; i < kGroup; i += each) {
        unsigned byte = 0;
        for (std::size_t k = 0; k < each; ++k) byte = byte << bits | std::min<unsigned>(group[i + k], escape);
        out += static_cast<char>(byte);
    }
    for (const std::uint8_t value : group)
        if (value >= escape) out += static_cast<char>(value);
}

// One byte of each vertex of a block.
void appendSeries(std::span<const std::uint8_t> values, std::string& out) {
    static constexpr unsigned kBits[] = {0, 2, 4, 8};
    const std::size_t groups = values.size() / kGroup, header = out.size();
    out.append((groups + 3) / 4, '\0');
    for (std::size_t g = 0; g < groups; ++g) {
        const auto group = values.subspan(g * kGroup, kGroup);
        unsigned best = 3;
        for (const unsigned mode : {2u, 1u, 0u})
            if (sizeOfGroup(group, kBits[mode]) < sizeOfGroup(group, kBits[best])) best = mode;
        out[header + g / 4] = static_cast<char>(static_cast<unsigned char>(out[header + g / 4]) | best << g % 4 * 2);
        appendGroup(group, kBits[best], out);
    }
}

}  // namespace

std::string compressVertices(std::span<const std::byte> bytes, std::size_t stride) {
    SVT_CHECK(!bytes.empty() && stride > 0 && stride <= 256 && stride % 4 == 0 && bytes.size() % stride == 0);
    const auto* data = reinterpret_cast<const std::uint8_t*>(bytes.data());
    const std::size_t count = bytes.size() / stride;
    const std::size_t block = std::min(kBytesOfBlock / stride / kGroup * kGroup, kMostInBlock);
    std::string out(1, static_cast<char>(0xA0));
    std::vector<std::uint8_t> last(data, data + stride);
    for (std::size_t first = 0; first < count; first += block) {
        const std::size_t size = std::min(block, count - first);
        for (std::size_t k = 0; k < stride; ++k) {
            std::array<std::uint8_t, kMostInBlock> steps{};
            for (std::size_t v = 0; v < size; ++v) {
                const std::uint8_t value = data[(first + v) * stride + k];
                const auto step = static_cast<std::uint8_t>(value - last[k]);
                // 0, -1, 1, -2, ... become 0, 1, 2, 3, ...
                steps[v] = static_cast<std::uint8_t>(step << 1 ^ (step >= 128 ? 255 : 0));
                last[k] = value;
            }
            appendSeries({steps.data(), (size + kGroup - 1) / kGroup * kGroup}, out);
        }
    }
    if (stride < kLeastTail) out.append(kLeastTail - stride, '\0');
    out.append(reinterpret_cast<const char*>(data), stride);
    return out;
}

std::string compressIndices(std::span<const std::uint32_t> indices) {
    constexpr std::uint32_t kFar = 30;  // a step that long changes to the other run
    std::string out(1, static_cast<char>(0xD1));
    std::array<std::uint32_t, 2> last{};
    std::uint32_t run = 0;
    for (const std::uint32_t index : indices) {
        const std::uint32_t away = index > last[run] ? index - last[run] : last[run] - index;
        if (away >= kFar) run ^= 1;
        const std::uint32_t step = index - last[run];
        const std::uint32_t folded = step << 1 ^ (step >> 31 != 0 ? ~0u : 0u);
        std::uint64_t rest = std::uint64_t{folded} << 1 | run;
        // The reference has 32 bits here; indices stay below 2^30.
        for (; rest > 127; rest >>= 7) out += static_cast<char>((rest & 127) | 128);
        out += static_cast<char>(rest);
        last[run] = index;
    }
    return out.append(4, '\0');
}

}  // namespace svt::writers
