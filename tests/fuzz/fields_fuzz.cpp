// For any bytes the reader of fields returns fields, or an error. The input is a `.svt` in a file.
#include <svt/fields/svt_fields.hpp>

#include <cstdint>
#include <string>

namespace {

constexpr std::uint64_t kMostBytes = std::uint64_t{64} << 20;

// All blocks of a grid field.
void readBlocks(const svt::fields::FieldBlocks& blocks) {
    using namespace svt;
    std::size_t left = 1000;
    for (std::int32_t level = 0; level < blocks.stored().code.levels; ++level) {
        const Vec3i count = fields::blockCount(blocks.head().lattice, level);
        for (std::size_t time = 0; time < blocks.head().times.size(); ++time)
            for (std::int32_t z = 0; z < count.z; ++z)
                for (std::int32_t y = 0; y < count.y; ++y)
                    for (std::int32_t x = 0; x < count.x && left > 0; ++x, --left) {
                        (void)blocks.range(level, time, {x, y, z});
                        (void)blocks.read(level, time, {x, y, z});
                    }
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace svt;
    const auto read = [&](std::uint64_t offset, std::size_t count) -> Result<std::string> {
        if (offset > size || count > size - offset) return Error(Code::CannotOpen, "beyond the end");
        return std::string(reinterpret_cast<const char*>(data) + offset, count);
    };
    const auto listed = fields::listFields(read, size);
    if (!listed) return 0;
    for (const fields::ListedField& field : *listed) {
        const std::string& name = field.stored.head.name;
        (void)fields::readField(read, size, name, kMostBytes, 1);
        if (field.stored.head.kind != fields::FieldKind::Grid) continue;
        if (const auto blocks = fields::FieldBlocks::open(read, size, name)) readBlocks(*blocks);
    }
    return 0;
}
