#include <apps/cli/city/city_input.hpp>
#include <apps/cli/options/catalog.hpp>
#include <apps/cli/options/shared_options.hpp>
#include <apps/cli/output/json_output.hpp>
#include <apps/cli/output/messages.hpp>
#include <apps/cli/output/table.hpp>

#include <svt/city/city_folder.hpp>
#include <svt/city/city_levels.hpp>
#include <svt/core/text.hpp>
#include <svt/volume/svt_file.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace svt::cli {
namespace {

struct CityInfoArguments {
    std::filesystem::path folder;
    bool json = false;
};

struct CityFindArguments {
    std::filesystem::path folder;
    std::vector<std::string> words;
    std::size_t most = 100;
    bool json = false, csv = false;
};

// One argument is one word: the shell has removed the quotes around the blanks of street="Main Road".
std::string searchText(const std::vector<std::string>& words) {
    std::string text;
    for (const std::string& word : words) {
        const bool isQuoted = word.find_first_of(" \t") != std::string::npos && word.find('=') != std::string::npos &&
                              word.find('"') == std::string::npos;
        text += (text.empty() ? "" : " ") + (isQuoted ? "\"" + word + "\"" : word);
    }
    return text;
}

Result<int> runCityFind(const CityFindArguments& arguments) {
    SVT_TRY(city, city::City::open(arguments.folder));
    SVT_TRY(found, city->search(searchText(arguments.words), arguments.most));
    const auto textOrNone = [](const std::string& text) { return text.empty() ? Cell() : Cell(text); };
    Table table{{{"id", "id"}, {"name", "name"}, {"class", "class"}, {"address", "address"}}, {}};
    for (const auto& building : found->buildings)
        table.rows.push_back(
            {building.id, textOrNone(building.name), building.className, textOrNone(building.address)});
    if (arguments.json) {
        print({{"count", found->count}, {"buildings", Json::parse(writers::makeJson(table))}});
        return kDone;
    }
    print(table, arguments.csv ? TableFormat::Csv : TableFormat::Text);
    if (found->count > found->buildings.size())
        note(fmt::format("{} buildings have these words; the first {} are listed (--most)", found->count,
                         found->buildings.size()));
    else if (!arguments.csv)
        summarize(fmt::format("{} building{}", found->count, found->count == 1 ? "" : "s"));
    return kDone;
}

struct CityExtractArguments {
    std::filesystem::path folder, output;
    std::vector<std::string> tiles, ids;
    std::vector<double> box;
    int detail = 0;
};

Result<int> runCityExtract(const CityExtractArguments& arguments) {
    city::Extract extract;
    extract.ids = arguments.ids;
    extract.detail = arguments.detail;
    for (const std::string& text : arguments.tiles) {
        SVT_TRY(tile, city::TileKey::fromString(
                          text, arguments.detail < city::kFirstClassDetail ? city::Plan::kTopLevel : city::kMaxLevel));
        extract.tiles.push_back(*tile);
    }
    extract.hasBox = !arguments.box.empty();
    std::copy(arguments.box.begin(), arguments.box.end(), extract.box.begin());
    for (std::size_t axis = 0; extract.hasBox && axis < 3; ++axis)
        if (!(extract.box[axis] <= extract.box[axis + 3]))
            return Error(Code::BadArgument,
                         "--box: the first three numbers are the lower corner, the last three the "
                         "upper one");
    if (extract.tiles.empty() && extract.ids.empty() && !extract.hasBox)
        return Error(Code::BadArgument, "nothing to extract; give --tile, --box or --id");
    SVT_TRY(city, city::City::open(arguments.folder));
    SVT_TRY(volume, city::extractVolume(*city, extract));
    SVT_TRY(bytes, volume::writeSvt(*volume, arguments.output));
    const Vec3i n = volume->grid.dimension();
    summarize(fmt::format("{}: {} labels, {} x {} x {} samples of {:g} m, {:.1f} kB", arguments.output.string(),
                          volume->labels.labels.size(), n.x, n.y, n.z, volume->grid.spacing().x,
                          double(*bytes) / 1000));
    return kDone;
}

Members<CityInfoArguments> membersOf(const CityInfoArguments*) noexcept {
    using All = CityInfoArguments;
    static constexpr Member<All> kMembers[] = {cityFolder<&All::folder>(), jsonOption<&All::json>(),
                                               quietOption<All>()};
    return kMembers;
}

Members<CityExtractArguments> membersOf(const CityExtractArguments*) noexcept {
    using All = CityExtractArguments;
    static constexpr Member<All> kMembers[] = {
        cityFolder<&All::folder>(),
        member<&All::output>("-o,--output", "the volume to write",
                             {.value = "F.svt", .isRequired = true, .file = FileUse::Output, .formats = "svt"}),
        member<&All::tiles>("--tile", "a whole tile, such as 9/754/11352", {.value = "L/X/Y", .group = "Part"}),
        member<&All::ids>("--id", "a building by its id", {.value = "ID", .group = "Part"}),
        worldBox<&All::box>("lower and upper corner in the CRS of the city", "Part", "X,Y,Z,X,Y,Z"),
        member<&All::detail>(
            "--detail",
            "0: all labels; 1: one label per building, at twice the spacing; 2: one label per class, at four times; 3 "
            "and up: mixtures of classes, each at twice the spacing of the previous detail",
            {.least = 0, .most = 26, .group = "Part"}),
        quietOption<All>(),
    };
    return kMembers;
}

Members<CityFindArguments> membersOf(const CityFindArguments*) noexcept {
    using All = CityFindArguments;
    static constexpr Member<All> kMembers[] = {
        cityFolder<&All::folder>(),
        member<&All::words>(
            "words",
            "words of the name, of attributes or of an address; attribute=value, such as "
            "yearOfConstruction=1965, or class=Bridge. All must fit. The last word may be the beginning "
            "of one",
            {.value = "WORD", .isRequired = true}),
        member<&All::most>("--most", "maximum number of listed buildings",
                           {.least = 1, .most = 1000000, .group = "Output"}),
        member<&All::json>("--json", "print the count and the buildings as JSON on stdout",
                           {.group = "Output", .excludes = "--csv"}),
        member<&All::csv>("--csv", "print the buildings as CSV on stdout", {.group = "Output"}),
        quietOption<All>(),
    };
    return kMembers;
}

Result<int> runCityInfo(const CityInfoArguments& arguments) { return printCity(arguments.folder, arguments.json); }

}  // namespace

extern const CommandText kCityInfoCommand =
    commandOf<CityInfoArguments, runCityInfo>("city-info", "Show the contents of a city");
extern const CommandText kCityFindCommand =
    commandOf<CityFindArguments, runCityFind>("city-find", "Find buildings of a city by words of names and attributes");
extern const CommandText kCityExtractCommand =
    commandOf<CityExtractArguments, runCityExtract>("city-extract", "Write a part of a city as a volume (.svt)");

}  // namespace svt::cli
