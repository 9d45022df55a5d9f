#include <svt/samples/city/city_text.hpp>

#include <svt/samples/city/city_building.hpp>
#include <svt/samples/city_sample.hpp>

#include <fmt/format.h>

namespace svt::samples {
namespace {

using city::Building;
using city::Layout;

Result<void> check(const CitySampleOptions& options, int file) {
    constexpr std::uint64_t kMost = 100'000'000;
    if (options.buildings < 1 || options.buildings > kMost)
        return Error(Code::BadArgument,
                     fmt::format("buildings: {} is out of range; 1 to {} are possible", options.buildings, kMost));
    if (options.files < 1 || options.files > 100'000 ||
        static_cast<std::uint64_t>(options.files - 1) * Layout::kLots >= options.buildings)
        return Error(Code::BadArgument,
                     fmt::format("files: {} is out of range; at most 100000 and one for {} buildings are possible",
                                 options.files, Layout::kLots));
    if (file < 0 || file >= options.files)
        return Error(Code::BadArgument, fmt::format("file: {} is not one of {}", file, options.files));
    return {};
}

// Writes the buildings of one block.
struct BlockWriter {
    const CitySampleOptions& options;
    const Layout& layout;
    city::CityText& text;
    CitySampleCount& count;

    void write(std::int64_t column, std::int64_t row, bool isReplica) {
        for (std::int64_t lot = 0; lot < Layout::kLots; ++lot) {
            const auto number = static_cast<std::uint64_t>((row * layout.columns + column) * Layout::kLots + lot);
            if (number >= options.buildings) return;
            // Every eighth at a border is in the file of the neighbour, too.
            if (isReplica && city::Draw(number ^ options.seed << 40).next() % 8 != 0) continue;
            const Building building = city::makeBuilding(options, layout, column, row, lot);
            text.write(building);
            ++count.buildings;
            if (isReplica) {
                ++count.replicas;
                continue;
            }
            count.broken += building.isBroken ? 1 : 0;
            count.vertices += city::vertexCount(building);
        }
    }
};

}  // namespace

std::string citySampleFileName(const CitySampleOptions& options, int file) {
    return fmt::format("{:05}{}", file, options.profile == CityProfile::Dutch ? ".city.jsonl" : ".gml");
}

Result<CitySampleCount> writeCitySample(const CitySampleOptions& options, int file, const SampleSink& sink) {
    SVT_DO(check(options, file));
    const Layout layout = Layout::of(options);
    const std::int64_t fileColumn = file % layout.fileColumns, fileRow = file / layout.fileColumns;
    const std::int64_t west = layout.firstColumn(fileColumn), east = layout.firstColumn(fileColumn + 1);
    const std::int64_t south = layout.firstRow(fileRow), north = layout.firstRow(fileRow + 1);
    CitySampleCount count;
    city::CityText text(options, file, sink);
    BlockWriter blocks{options, layout, text, count};
    for (std::int64_t row = south; row < north && !text.hasFailed(); ++row)
        for (std::int64_t column = west; column < east; ++column) blocks.write(column, row, false);
    if (west > 0 && west < east)
        for (std::int64_t row = south; row < north; ++row) blocks.write(west - 1, row, true);
    if (south > 0 && south < north)
        for (std::int64_t column = west; column < east; ++column) blocks.write(column, south - 1, true);
    text.finish();
    if (text.hasFailed()) return Error(Code::CannotWrite, "the output refused to take more");
    return count;
}

}  // namespace svt::samples
