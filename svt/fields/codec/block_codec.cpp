#include <svt/fields/codec/block_codec.hpp>

#include <svt/core/bytes.hpp>
#include <svt/core/parallel.hpp>
#include <svt/fields/svt_fields.hpp>
#include <svt/volume/zip_entries.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>

namespace svt::fields {
namespace {

constexpr float kNoValue = std::numeric_limits<float>::quiet_NaN();
constexpr double kMostCode = 65534;
constexpr std::int32_t kMaxLevels = 32;

Vec3i halved(Vec3i size) noexcept { return {(size.x + 1) / 2, (size.y + 1) / 2, (size.z + 1) / 2}; }

std::size_t nodesIn(Vec3i size) noexcept { return std::size_t(size.x) * std::size_t(size.y) * std::size_t(size.z); }

// The next level of one component: the mean of the values of 2 x 2 x 2 nodes; missing if all are.
std::vector<float> nextLevel(std::span<const float> nodes, Vec3i size) {
    const Vec3i next = halved(size);
    std::vector<float> level(nodesIn(next));
    std::size_t to = 0;
    for (std::int32_t k = 0; k < next.z; ++k)
        for (std::int32_t j = 0; j < next.y; ++j)
            for (std::int32_t i = 0; i < next.x; ++i) {
                double sum = 0;
                int count = 0;
                for (std::int32_t z = 2 * k; z < std::min(2 * k + 2, size.z); ++z)
                    for (std::int32_t y = 2 * j; y < std::min(2 * j + 2, size.y); ++y)
                        for (std::int32_t x = 2 * i; x < std::min(2 * i + 2, size.x); ++x) {
                            const float value =
                                nodes[std::size_t(x) +
                                      std::size_t(size.x) * (std::size_t(y) + std::size_t(size.y) * std::size_t(z))];
                            if (std::isnan(value)) continue;
                            sum += double{value};
                            ++count;
                        }
                level[to++] = count == 0 ? kNoValue : static_cast<float>(sum / count);
            }
    return level;
}

// One block while it is made.
struct MadeBlock {
    std::vector<std::byte> frame;
    std::vector<std::byte> record;
};

// Nodes of one component at a level.
struct LevelNodes {
    Vec3i size;
    std::vector<std::span<const float>> components;
};

// Puts a number in little-endian order; returns the place behind it.
template <class Number>
std::uint8_t* putNumber(std::uint8_t* to, Number number) noexcept {
    for (std::size_t b = 0; b < sizeof(Number); ++b) to[b] = static_cast<std::uint8_t>(number >> (8 * b));
    return to + sizeof(Number);
}

Result<MadeBlock> makeBlock(const LevelNodes& level, Vec3i block, const FieldCode& code) {
    const Vec3i first = block * kBlockNodes;
    Vec3i end;
    for (int axis = 0; axis < 3; ++axis) end[axis] = std::min(first[axis] + kBlockNodes, level.size[axis]);
    std::vector<std::uint8_t> bytes;
    bytes.resize(nodesIn(end - first) * level.components.size() * code.bytes());
    std::uint8_t* to = bytes.data();
    std::vector<std::byte> ranges;
    bool isOneValue = true;
    for (const std::span<const float> nodes : level.components) {
        std::pair<float, float> range{kNoValue, kNoValue};
        bool hasMissing = false;
        for (std::int32_t z = first.z; z < end.z; ++z)
            for (std::int32_t y = first.y; y < end.y; ++y) {
                const float* row = nodes.data() + std::size_t(level.size.x) *
                                                      (std::size_t(y) + std::size_t(level.size.y) * std::size_t(z));
                for (std::int32_t x = first.x; x < end.x; ++x) {
                    float value = row[x];
                    if (code.isFloat) {
                        to = putNumber(to, std::isnan(value) ? 0x7FC00000u : std::bit_cast<std::uint32_t>(value));
                    } else {
                        const std::uint16_t number = codeOf(value, code);
                        to = putNumber(to, number);
                        value = valueOf(number, code);
                    }
                    if (std::isnan(value)) {
                        hasMissing = true;
                        continue;
                    }
                    if (std::isnan(range.first)) range = {value, value};
                    range.first = std::min(range.first, value);
                    range.second = std::max(range.second, value);
                }
            }
        appendRange(ranges, range, code);
        const bool isMissing = std::isnan(range.first);
        isOneValue = isOneValue && (isMissing || (!hasMissing && std::bit_cast<std::uint32_t>(range.first) ==
                                                                     std::bit_cast<std::uint32_t>(range.second)));
    }
    MadeBlock made;
    if (!isOneValue) {
        SVT_TRY(frame, volume::packFrame(bytes, "a block of a field"));
        made.frame = std::move(*frame);
    }
    appendBytes(made.record, static_cast<std::uint32_t>(made.frame.size()),
                made.frame.empty() ? std::uint32_t{0} : volume::checksumOf(made.frame));
    made.record.insert(made.record.end(), ranges.begin(), ranges.end());
    return made;
}

// All levels of one time, and their blocks in order.
class TimeEncoder {
public:
    TimeEncoder(const Field& field, const FieldCode& code) : field_(field), code_(code) {}

    // Blocks of each level.
    [[nodiscard]] Result<std::vector<std::vector<MadeBlock>>> encode(std::size_t time, int threads) const {
        const FieldHead& head = field_.head;
        const std::size_t places = placeCount(head, 0);
        const auto components = std::size_t(head.components);
        std::vector<std::vector<std::vector<float>>> made;  // by level above the lowest, component
        LevelNodes nodes{head.lattice.size, {}};
        for (std::size_t c = 0; c < components; ++c)
            nodes.components.push_back(std::span(field_.values).subspan((time * components + c) * places, places));
        std::vector<std::vector<MadeBlock>> levels;
        for (std::int32_t level = 0; level < code_.levels; ++level) {
            if (level > 0) {
                auto& next = made.emplace_back();
                for (const auto component : nodes.components) next.push_back(nextLevel(component, nodes.size));
                nodes = {halved(nodes.size), {next.begin(), next.end()}};
            }
            SVT_TRY(blocks, blocksOfLevel(nodes, level, threads));
            levels.push_back(std::move(*blocks));
        }
        return levels;
    }

private:
    [[nodiscard]] Result<std::vector<MadeBlock>> blocksOfLevel(const LevelNodes& nodes, std::int32_t level,
                                                               int threads) const {
        const Vec3i count = blockCount(field_.head.lattice, level);
        std::vector<MadeBlock> blocks(nodesIn(count));
        std::vector<std::optional<Error>> errors(blocks.size());
        parallelFor(blocks.size(), 1, threads, [&](std::size_t begin, std::size_t end) {
            for (std::size_t b = begin; b < end; ++b) {
                const auto n = static_cast<std::int32_t>(b);
                auto one = makeBlock(nodes, {n % count.x, n / count.x % count.y, n / count.x / count.y}, code_);
                if (one)
                    blocks[b] = std::move(*one);
                else
                    errors[b] = one.error();
            }
        });
        for (const auto& error : errors)
            if (error) return *error;
        return blocks;
    }

    const Field& field_;
    const FieldCode& code_;
};

}  // namespace

Vec3i levelSize(const Lattice& lattice, std::int32_t level) noexcept {
    Vec3i size = lattice.size;
    for (std::int32_t l = 0; l < level && l < kMaxLevels; ++l) size = halved(size);
    return size;
}

Vec3i blockCount(const Lattice& lattice, std::int32_t level) noexcept {
    const Vec3i size = levelSize(lattice, level);
    return {(size.x + kBlockNodes - 1) / kBlockNodes, (size.y + kBlockNodes - 1) / kBlockNodes,
            (size.z + kBlockNodes - 1) / kBlockNodes};
}

std::uint64_t blocksOf(const Lattice& lattice, std::int32_t level) noexcept {
    const Vec3i count = blockCount(lattice, level);
    return std::uint64_t(count.x) * std::uint64_t(count.y) * std::uint64_t(count.z);
}

std::uint64_t blocksOf(const FieldHead& head, const FieldCode& code) noexcept {
    std::uint64_t sum = 0;
    for (std::int32_t level = 0; level < code.levels; ++level) sum += blocksOf(head.lattice, level);
    return sum * head.times.size();
}

double precisionFor(double low, double high) noexcept {
    const double step = (high - low) / kMostCode;
    if (!std::isfinite(step)) return 0;
    if (!(step > 0)) return std::abs(low) > 0 ? precisionFor(0, std::abs(low)) : 1;
    const double power = std::pow(10.0, std::floor(std::log10(step)));
    // Values are rounded to multiples, so the first and the last need half a step more.
    for (const double factor : {1.0, 2.0, 5.0, 10.0, 20.0})
        if (std::round(high / (power * factor)) - std::round(low / (power * factor)) <= kMostCode)
            return power * factor;
    return power * 50;
}

Result<FieldCode> codeFor(const Field& field) {
    const FieldHead& head = field.head;
    FieldCode code;
    code.isFloat = head.precision == 0;
    if (head.kind == FieldKind::Grid)
        while (blocksOf(head.lattice, code.levels - 1) > 1) ++code.levels;
    if (code.isFloat) return code;
    const auto range = rangeOf(field).value_or(std::pair(0.0F, 0.0F));
    const double low{range.first}, high{range.second};
    code.scale = head.precision;
    code.offset = std::round(low / code.scale) * code.scale;
    if (!(std::round((high - code.offset) / code.scale) <= kMostCode))
        return Error(
            Code::BadField,
            fmt::format("field '{}': 16 bits do not hold the values from {} to {} with a precision of {}; use a "
                        "precision of {} or more, or 0 for floats",
                        head.name, low, high, head.precision, precisionFor(low, high)));
    return code;
}

std::uint16_t codeOf(float value, const FieldCode& code) noexcept {
    if (std::isnan(value)) return kMissingCode;
    // Rounds half up, as all codes are at least 0.
    const double number = std::clamp((double{value} - code.offset) / code.scale, 0.0, kMostCode);
    return static_cast<std::uint16_t>(static_cast<std::int32_t>(number + 0.5));
}

float valueOf(std::uint16_t code, const FieldCode& how) noexcept {
    return code == kMissingCode ? kNoValue : static_cast<float>(how.offset + how.scale * code);
}

std::size_t indexRecordBytes(const FieldCode& code, std::int32_t components) noexcept {
    return 8 + std::size_t(components) * 2 * code.bytes();
}

void appendRange(std::vector<std::byte>& to, std::pair<float, float> range, const FieldCode& code) {
    for (const float value : {range.first, range.second}) {
        if (code.isFloat)
            appendBytes(to, std::isnan(value) ? 0x7FC00000u : std::bit_cast<std::uint32_t>(value));
        else
            appendBytes(to, codeOf(value, code));
    }
}

std::pair<float, float> loadRange(std::span<const std::byte> bytes, std::size_t at, const FieldCode& code) {
    const auto load = [&](std::size_t from) {
        return code.isFloat ? std::bit_cast<float>(loadBytes<std::uint32_t>(bytes, from))
                            : valueOf(loadBytes<std::uint16_t>(bytes, from), code);
    };
    return {load(at), load(at + code.bytes())};
}

Result<EncodedBlocks> encodeBlocks(const Field& field, const FieldCode& code, int threads) {
    const std::size_t times = field.head.times.size();
    // Many times of few blocks are encoded side by side, few times of many blocks block by block.
    constexpr std::size_t kManyTimes = 8;
    const bool byTime = times >= kManyTimes;
    std::vector<std::vector<std::vector<MadeBlock>>> made(times);
    std::vector<std::optional<Error>> errors(times);
    const TimeEncoder encoder(field, code);
    parallelFor(times, 1, byTime ? threads : 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t t = begin; t < end; ++t) {
            auto levels = encoder.encode(t, byTime ? 1 : threads);
            if (levels)
                made[t] = std::move(*levels);
            else
                errors[t] = levels.error();
        }
    });
    for (const auto& error : errors)
        if (error) return *error;
    EncodedBlocks encoded;
    for (std::size_t level = 0; level < std::size_t(code.levels); ++level)
        for (std::size_t t = 0; t < times; ++t)
            for (MadeBlock& block : made[t][level]) {
                encoded.index.insert(encoded.index.end(), block.record.begin(), block.record.end());
                encoded.frames.push_back(std::move(block.frame));
            }
    return encoded;
}

std::vector<std::byte> encodeValues(std::span<const float> values, const FieldCode& code) {
    std::vector<std::byte> bytes;
    bytes.reserve(values.size() * code.bytes());
    for (const float value : values) {
        if (code.isFloat)
            appendBytes(bytes, std::isnan(value) ? 0x7FC00000u : std::bit_cast<std::uint32_t>(value));
        else
            appendBytes(bytes, codeOf(value, code));
    }
    return bytes;
}

Result<std::vector<float>> decodeValues(std::span<const std::byte> bytes, const FieldCode& code) {
    std::vector<float> values(bytes.size() / code.bytes());
    for (std::size_t v = 0; v < values.size(); ++v) {
        values[v] = code.isFloat ? std::bit_cast<float>(loadBytes<std::uint32_t>(bytes, 4 * v))
                                 : valueOf(loadBytes<std::uint16_t>(bytes, 2 * v), code);
        if (std::isinf(values[v])) return Error(Code::BadField, fmt::format("value {} is infinite", v));
    }
    return values;
}

}  // namespace svt::fields
