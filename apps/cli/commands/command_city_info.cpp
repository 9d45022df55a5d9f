#include <apps/cli/city/city_input.hpp>
#include <apps/cli/options/build_options.hpp>
#include <apps/cli/options/command_line.hpp>
#include <apps/cli/options/shared_options.hpp>
#include <apps/cli/output/messages.hpp>

#include <svt/city/city_folder.hpp>
#include <svt/city/city_levels.hpp>
#include <svt/core/text.hpp>
#include <svt/volume/svt_file.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace svt::cli {
namespace {

struct CityInfoArguments {
    std::filesystem::path folder, output;
    bool json = false;
    std::vector<std::string> tiles, ids;
    std::vector<double> box;
    int detail = 0;
};

int runCityExtract(const CityInfoArguments& arguments) {
    city::Extract extract;
    extract.ids = arguments.ids;
    extract.detail = arguments.detail;
    for (const std::string& text : arguments.tiles) {
        const auto tile = city::TileKey::fromString(
            text, arguments.detail < city::kFirstClassDetail ? city::Plan::kTopLevel : city::kMaxLevel);
        if (!tile) return fail(tile.error());
        extract.tiles.push_back(*tile);
    }
    extract.hasBox = !arguments.box.empty();
    std::copy(arguments.box.begin(), arguments.box.end(), extract.box.begin());
    for (std::size_t axis = 0; extract.hasBox && axis < 3; ++axis)
        if (!(extract.box[axis] <= extract.box[axis + 3]))
            return fail(Error(Code::BadArgument,
                              "--box: the first three numbers are the lower corner, the last three the "
                              "upper one"));
    if (extract.tiles.empty() && extract.ids.empty() && !extract.hasBox)
        return fail(Error(Code::BadArgument, "say what to extract: --tile, --box or --id"));
    const auto city = city::City::open(arguments.folder);
    if (!city) return fail(city.error());
    const auto volume = city::extractVolume(*city, extract);
    if (!volume) return fail(volume.error());
    const auto bytes = volume::writeSvt(*volume, arguments.output);
    if (!bytes) return fail(bytes.error());
    const Vec3i n = volume->grid.dimension();
    if (!isQuiet())
        fmt::print("{}: {} labels, {} x {} x {} samples of {:g} m, {:.1f} kB\n", arguments.output.string(),
                   volume->labels.labels.size(), n.x, n.y, n.z, volume->grid.spacing().x, double(*bytes) / 1000);
    return kDone;
}

constexpr Option kCityInfo[] = {kInfoOutput[0]};
constexpr Option kCityExtract[] = {
    {.name = "-o,--output",
     .value = "F.svt",
     .help = "the volume to write",
     .isRequired = true,
     .file = FileUse::Output,
     .formats = "svt"},
    {.name = "--tile",
     .value = "L/X/Y",
     .help = "a whole tile, such as 9/754/11352",
     .group = "Part",
     .mayRepeat = true},
    {.name = "--id", .value = "ID", .help = "a building by its id", .group = "Part", .mayRepeat = true},
    {.name = "--box",
     .kind = Number,
     .value = "X,Y,Z,X,Y,Z",
     .unit = "metres",
     .help = "lower and upper corner in the CRS of the city",
     .group = "Part",
     .count = 6,
     .leastCount = 6},
    {.name = "--detail",
     .kind = Whole,
     .least = 0,
     .most = 26,
     .byDefault = "0",
     .help = "0: all labels; 1: one label a building, at twice the spacing; 2: one label a class, at four times; 3 and "
             "up: mixtures of classes, each at twice the spacing of the one before",
     .group = "Part"},
};

Action connectCityInfo(Command& command) {
    auto arguments = std::make_shared<CityInfoArguments>();
    command.set("folder", arguments->folder);
    command.set("--json", arguments->json);
    return [arguments] { return printCity(arguments->folder, arguments->json); };
}

Action connectCityExtract(Command& command) {
    auto arguments = std::make_shared<CityInfoArguments>();
    command.set("folder", arguments->folder);
    command.set("--output", arguments->output);
    command.set("--tile", arguments->tiles);
    command.set("--id", arguments->ids);
    command.set("--box", arguments->box);
    command.set("--detail", arguments->detail);
    return [arguments] { return runCityExtract(*arguments); };
}

}  // namespace

extern const CommandText kCityInfoCommand{.name = "city-info",
                                          .help = "Show what is inside a city",
                                          .sets = {kCityFolder, kCityInfo, kQuiet},
                                          .connect = connectCityInfo};

extern const CommandText kCityExtractCommand{.name = "city-extract",
                                             .help = "Write a part of a city as a volume (.svt)",
                                             .sets = {kCityFolder, kCityExtract, kQuiet},
                                             .connect = connectCityExtract};

}  // namespace svt::cli
