#include <svt/core/machine.hpp>
#include <svt/volume_readers/label_array.hpp>
#include <svt/volume_readers/samples/label_image.hpp>
#include <svt/volume_readers/table/label_tables.hpp>

#include <fmt/format.h>

#include <cstring>
#include <optional>

namespace svt::volume_readers {

Result<volume::SemanticVolume> volumeFromArray(const LabelArray& array, std::string_view labelsJson,
                                               std::uint64_t maxBytes, const Progress* progress) {
    if (array.bits != 8 && array.bits != 16 && array.bits != 32)
        return Error(Code::BadArgument, fmt::format("samples of {} bits; 8, 16 and 32 are possible", array.bits));
    const std::uint64_t bytes = array.grid.sampleCount() * static_cast<std::uint64_t>(array.bits / 8);
    if (array.samples.size() != bytes)
        return Error(Code::BadArgument,
                     fmt::format("an array of {} bytes, and the grid has samples for {}", array.samples.size(), bytes));
    if (maxBytes == 0) {
        const auto grant = memoryGrant();
        maxBytes = grant ? grant->bytes / 2 : std::uint64_t{1} << 30;
    }
    std::optional<UserTable> table;
    if (!labelsJson.empty()) {
        SVT_TRY(parsed, parseUserTable(labelsJson));
        table = std::move(*parsed);
    }
    LabelImage image;
    image.dimension = array.grid.dimension();
    image.grid = array.grid;
    image.bits = array.bits;
    image.isSigned = array.isSigned;
    image.crsName = array.crsName;
    std::size_t at = 0;
    image.read = [&](std::span<std::byte> out) -> Result<void> {
        if (out.empty()) return {};
        std::memcpy(out.data(), array.samples.data() + at, out.size());
        at += out.size();
        return {};
    };
    SVT_TRY(columns, readColumns(image, maxBytes, Code::BadArgument, progress));
    SVT_TRY(made, makeVolume(image, std::move(*columns), table ? &*table : nullptr, array.source));
    return std::move(made->volume);
}

}  // namespace svt::volume_readers
