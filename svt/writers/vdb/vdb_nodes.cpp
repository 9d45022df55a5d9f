#include <svt/writers/vdb/vdb_nodes.hpp>

namespace svt::writers {
namespace {

constexpr int kVdbLevel = 1;
constexpr std::int8_t kOthersAreBackground = 0, kAllValues = 6;

// A window as small as the leaves are.
constexpr int kWindowBits = 12, kMemoryLevel = 4;

}  // namespace

NodeValues::NodeValues() : packer_(kVdbLevel, kWindowBits, kMemoryLevel) {}

void NodeValues::putPacked(VdbBytes& to, std::int8_t kind, std::span<const std::byte> plain) {
    const auto packed = packer_.pack(plain);
    const bool isSmaller = packed.size() < plain.size();
    appendBytes(to, kind,
                isSmaller ? static_cast<std::int64_t>(packed.size()) : -static_cast<std::int64_t>(plain.size()));
    const auto bytes = isSmaller ? packed : plain;
    to.insert(to.end(), bytes.begin(), bytes.end());
}

void NodeValues::put(VdbBytes& to, std::span<const std::uint32_t> active) {
    putPacked(to, kOthersAreBackground, std::as_bytes(active));
}

void NodeValues::putAll(VdbBytes& to, std::span<const float> values) {
    putPacked(to, kAllValues, std::as_bytes(values));
}

}  // namespace svt::writers
