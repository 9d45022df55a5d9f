#include <apps/cli/city/city_input.hpp>
#include <apps/cli/options/catalog.hpp>
#include <apps/cli/options/load_volume.hpp>
#include <apps/cli/options/shared_options.hpp>
#include <apps/cli/output/messages.hpp>
#include <apps/cli/output/output_files.hpp>
#include <apps/cli/output/terminal_progress.hpp>
#include <apps/cli/quantities/city_take_off.hpp>
#include <apps/cli/quantities/quantity_book.hpp>
#include <apps/cli/quantities/quantity_settings.hpp>
#include <apps/cli/quantities/take_off.hpp>

#include <svt/core/file.hpp>
#include <svt/quantities/touching_faces.hpp>
#include <svt/readers/ifc_quantities.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

namespace svt::cli {
namespace {

using quantities::TouchingArea;

struct QuantitiesArguments {
    std::filesystem::path input;
    std::string where, by, formwork;
    std::vector<std::string> between;
    std::filesystem::path output, settingsFile;
    QuantitySettings settings;  // of settingsFile
    bool exterior = false, stated = false;
    pipeline::BuildOptions build;
    bool json = false, csv = false;

    [[nodiscard]] TakeOffQuestion question() const { return {where, by, formwork, exterior, build.threads, false}; }
};

BookAbout bookAbout(const volume::SemanticVolume& volume, const QuantitiesArguments& arguments) {
    BookAbout about{arguments.input.string(), volume.grid.spacing(), {}, {}};
    if (volume.vectors.triangles.empty()) about.notes.emplace_back(frontend::kNoMeshes);
    return about;
}

// The input with the measured quantities of its elements.
Result<std::string> copyOfIfc(const QuantitiesArguments& arguments, const TakeOff& takeOff) {
    SVT_TRY(bytes, FileBytes::read(arguments.input));
    std::vector<readers::IfcElementQuantities> elements;
    std::size_t uncertain = 0;
    for (const quantities::ObjectQuantities& object : takeOff.objects) {
        auto& element = elements.emplace_back();
        element.globalId = takeOff.volume.labels.labels[object.label].id;
        // A quantity in IFC states no bound.
        const bool isCertain = object.trust == quantities::Trust::Exact || object.trust == quantities::Trust::Tight;
        uncertain += object.netVolume && !isCertain;
        for (const StatedFigure& figure : statedFigures(object))
            if (isCertain || !figure.name.ends_with("Volume"))
                element.quantities.push_back({figure.name, figure.value});
    }
    SVT_TRY(copy, readers::addIfcQuantities(bytes->text(), arguments.input.string(), elements));
    if (copy->elements == 0)
        return Error(Code::BadArgument,
                     "no object gets quantities: none is a wall, slab, beam or the like that the file has under this "
                     "GlobalId and without the set; --where selects objects");
    if (uncertain > 0)
        note(fmt::format("the volumes of {} objects are not in the file: their meshes are not closed", uncertain));
    if (copy->keptSets > 0)
        note(fmt::format("{} objects keep the quantities of the file, which has their set", copy->keptSets));
    if (copy->otherTypes > 0)
        note(fmt::format("{} objects get no quantities: IFC has no set for their class, or all are unknown",
                         copy->otherTypes));
    if (copy->missing > 0)
        note(fmt::format("{} objects get no quantities: their id is not the GlobalId of one element", copy->missing));
    return std::move(copy->text);
}

Result<void> writeTakeOff(const QuantitiesArguments& arguments, const TakeOff& takeOff, const Table& table) {
    if (arguments.output.empty()) return {};
    const std::string ending = endingOf(arguments.output);
    std::string text;
    if (ending == ".xlsx") {
        BookAbout about = bookAbout(takeOff.volume, arguments);
        about.assumptions = takeOffAssumptions(takeOff);
        for (const std::string& one : takeOffNotes(takeOff)) about.notes.push_back(one);
        SVT_TRY(book, takeOffBook(takeOff, arguments.stated, about, arguments.settings));
        text = std::move(*book);
    } else if (ending == ".ifc") {
        SVT_TRY(copy, copyOfIfc(arguments, takeOff));
        text = std::move(*copy);
    } else if (ending == ".parquet") {
        SVT_TRY(bytes, writers::makeParquet(chosenTable(takeOff, arguments.stated, false)));
        text = std::move(*bytes);
    } else if (ending == ".json") {
        text = takeOffFile(takeOff, arguments.stated);
    } else {
        text = writers::makeCsv(table);
    }
    SVT_DO(writeFileAtomically(arguments.output, text));
    return {};
}

// The rows, sums or stated quantities, with the columns, units and headings of the settings.
Result<Table> shownTable(const QuantitiesArguments& arguments, const TakeOff& takeOff, bool hasSum) {
    Table table = chosenTable(takeOff, arguments.stated, hasSum);
    if (arguments.settingsFile.empty()) return table;
    if (arguments.stated) return withHeadings(std::move(table), arguments.settings);
    const std::size_t keys = takeOff.keys.size();
    SVT_TRY(changed, withQuantitySettings(std::move(table), arguments.settings, keys == 0 ? 0 : keys + 1));
    return withHeadings(std::move(*changed), arguments.settings);
}

Result<int> printTakeOff(const volume::SemanticVolume& volume, const QuantitiesArguments& arguments) {
    std::vector<std::string> notes;
    SVT_TRY(takeOff, measureTakeOff(volume, arguments.question(), notes));
    SVT_TRY(rows, shownTable(arguments, *takeOff, false));
    SVT_DO(writeTakeOff(arguments, *takeOff, *rows));
    TerminalProgress::hide();
    for (const std::string& text : notes) note(text);
    if (arguments.json)
        print(takeOffJson(*takeOff, arguments.stated));
    else if (!arguments.output.empty() && !arguments.csv)
        summarize(fmt::format("{}: {} objects", arguments.output.string(), takeOff->objects.size()));
    else if (arguments.csv)
        print(*rows, TableFormat::Csv);
    else {
        SVT_TRY(withSum, shownTable(arguments, *takeOff, true));
        print(*withSum, TableFormat::Text);
    }
    return kDone;
}

// Writes and prints the rows of --between.
Result<int> printContactTable(const volume::SemanticVolume& volume, const QuantitiesArguments& arguments,
                              const Table& table, std::size_t withoutMesh, double sum, double sumOfB) {
    std::vector<std::string> notes;
    if (withoutMesh > 0)
        notes.push_back(fmt::format("{} objects have no mesh; their contacts are unknown", withoutMesh));
    if (table.rows.empty()) notes.emplace_back("no two objects of the selections touch");
    const bool hasSettings = !arguments.settingsFile.empty();
    const Table headed = hasSettings ? withHeadings(table, arguments.settings) : table;
    if (!arguments.output.empty()) {
        const std::string ending = endingOf(arguments.output);
        std::string text;
        if (ending == ".xlsx") {
            BookAbout about = bookAbout(volume, arguments);
            about.notes.insert(about.notes.end(), notes.begin(), notes.end());
            SVT_TRY(book, contactBook(table, about, arguments.settings));
            text = std::move(*book);
        } else if (ending == ".parquet") {
            SVT_TRY(bytes, writers::makeParquet(table));
            text = std::move(*bytes);
        } else {
            text = ending == ".json" ? writers::makeJson(table) : writers::makeCsv(headed);
        }
        SVT_DO(writeFileAtomically(arguments.output, text));
    }
    TerminalProgress::hide();
    for (const std::string& text : notes) note(text);
    if (arguments.json || arguments.csv) {
        print(arguments.json ? table : headed, arguments.json ? TableFormat::JsonRows : TableFormat::Csv);
    } else if (!arguments.output.empty()) {
        summarize(fmt::format("{}: {} pairs", arguments.output.string(), table.rows.size()));
    } else {
        Table shown = headed;
        if (!shown.rows.empty()) shown.rows.push_back({"(sum)", Cell(), Cell(), Cell(), sum, sumOfB});
        print(shown, TableFormat::Text);
    }
    return kDone;
}

// The areas with which objects of two selections touch, from the faces of both.
Result<int> printContacts(const volume::SemanticVolume& volume, const QuantitiesArguments& arguments) {
    std::array<std::vector<quantities::ObjectQuantities>, 2> sides;
    std::array<std::vector<std::uint32_t>, 2> objectOf;  // by label
    std::array<std::map<std::pair<std::uint32_t, std::uint32_t>, double>, 2> areas;
    std::size_t withoutMesh = 0;
    std::vector<std::string> notes;
    for (std::size_t s = 0; s < 2; ++s) {
        SVT_TRY(objects, frontend::findObjects(volume, arguments.between[s], notes));
        sides[s] = quantities::measureObjects(volume, *objects, arguments.build.threads);
        objectOf[s].assign(volume.labels.labels.size(), volume::kNoLabel);
        for (const auto& object : sides[s]) {
            withoutMesh += !object.outerArea;
            for (const std::uint32_t part : object.parts) objectOf[s][part] = object.label;
        }
    }
    for (std::size_t s = 0; s < 2; ++s) {
        const auto touching = quantities::findTouchingAreas(volume, sides[s], arguments.build.threads);
        for (std::size_t n = 0; n < touching.size(); ++n)
            for (const TouchingArea& area : touching[n]) {
                if (area.label == volume::kNoLabel || objectOf[1 - s][area.label] == volume::kNoLabel) continue;
                std::pair pair(sides[s][n].label, objectOf[1 - s][area.label]);
                if (s == 1) std::swap(pair.first, pair.second);
                // Two objects of both selections are one pair.
                const bool isMirrored = objectOf[0][pair.second] != volume::kNoLabel &&
                                        objectOf[1][pair.first] != volume::kNoLabel && pair.first > pair.second;
                if (isMirrored) continue;
                areas[s][pair] += area.area;
                areas[1 - s].try_emplace(pair, 0.0);
            }
    }
    for (const std::string& text : notes) note(text);
    Table table;
    table.columns = {{"a", "a"},        {"aName", "name"}, {"b", "b"},
                     {"bName", "name"}, {"area", "m2"},    {"areaOfB", "m2 by faces of b"}};
    double sum = 0, sumOfB = 0;
    for (const auto& [pair, area] : areas[0]) {
        const volume::Label &a = volume.labels.labels[pair.first], &b = volume.labels.labels[pair.second];
        const double ofB = areas[1].at(pair);
        table.rows.push_back({a.id, a.name, b.id, b.name, area, ofB});
        sum += area;
        sumOfB += ofB;
    }
    return printContactTable(volume, arguments, table, withoutMesh, sum, sumOfB);
}

// Rows and sums of a city, tile by tile.
Result<int> measureCity(const QuantitiesArguments& arguments) {
    const std::string ending = endingOf(arguments.output);
    if (ending == ".xlsx" || ending == ".ifc")
        return Error(Code::BadArgument, "rows of a city go to .csv, .json or .parquet");
    if (!arguments.between.empty() || arguments.stated || !arguments.settingsFile.empty())
        return Error(Code::BadArgument,
                     "--between, --stated and --settings need one model; take a part of the city (svt city extract)");
    for (const std::string& query : {arguments.where, arguments.formwork})
        if (!query.empty()) SVT_DO(model::Query::parse(query));
    CityTakeOff take{arguments.input, arguments.output, arguments.question()};
    take.question.isPart = true;
    take.form = arguments.json              ? CityTakeOff::Form::JsonText
                : arguments.csv             ? CityTakeOff::Form::Csv
                : !arguments.output.empty() ? CityTakeOff::Form::None
                                            : CityTakeOff::Form::Text;
    return runCityTakeOff(take);
}

Result<int> runQuantities(const QuantitiesArguments& given) {
    QuantitiesArguments arguments = given;
    if (!arguments.settingsFile.empty()) {
        SVT_TRY(settings, readQuantitySettings(arguments.settingsFile));
        arguments.settings = std::move(*settings);
    }
    if (isCity(arguments.input)) return measureCity(arguments);
    if (endingOf(arguments.output) == ".ifc" && contentOf(arguments.input) != FileContent::Ifc)
        return Error(Code::BadArgument,
                     "'" + arguments.input.string() +
                         "' is not an IFC file; a copy with quantities (-o F.ifc) needs one as input");
    const std::string ending = endingOf(arguments.output);
    if (arguments.stated && !arguments.by.empty() && !arguments.json && ending != ".json" && ending != ".xlsx")
        return Error(Code::BadArgument, "a table has either --stated or --by; take --json, or -o with .json or .xlsx");
    if (ending == ".ifc" && !arguments.between.empty())
        return Error(Code::BadArgument, "IFC files have no contacts; write them as .csv, .json, .parquet or .xlsx");
    if (!arguments.between.empty() && arguments.between.size() != 2)
        return Error(Code::BadArgument, "--between needs two queries; give it twice");
    for (const std::string& query : {arguments.where, arguments.formwork})
        if (!query.empty()) SVT_DO(model::Query::parse(query));
    for (const std::string& query : arguments.between) SVT_DO(model::Query::parse(query));
    pipeline::BuildOptions build = arguments.build;
    build.vectors.meshes = true;
    SVT_TRY(volume, loadVolume(arguments.input, build, TerminalProgress().get(), false));
    if (arguments.between.empty()) return printTakeOff(*volume, arguments);
    if (volume->vectors.triangles.empty()) note(frontend::kNoMeshes);
    return printContacts(*volume, arguments);
}

Members<QuantitiesArguments> membersOf(const QuantitiesArguments*) noexcept {
    using All = QuantitiesArguments;
    static constexpr Member<All> kMembers[] = {
        modelInput<&All::input>(),
        member<&All::where>("--where", "only the objects that a query selects, such as 'class=IfcWall and storey=EG'",
                            {.value = "QUERY", .otherwise = "all components"}),
        member<&All::by>("--by", "sums by class, material, storey or other attributes, such as material,storey",
                         {.value = "KEYS"}),
        member<&All::output>("-o,--output",
                             "write the rows to a file: .csv, .json, .parquet, .xlsx, or .ifc for a copy of an IFC "
                             "input with quantities",
                             {.value = "FILE", .file = FileUse::Output, .formats = "csv|json|objectparquet|xlsx|ifc"}),
        member<&All::settingsFile>("--settings", "columns, units and language of tables (JSON)",
                                   {.value = "FILE", .group = "Output", .file = FileUse::OtherInput}),
        member<&All::exterior>("--exterior", "areas that outside air touches, by orientation", {.group = "Areas"}),
        member<&All::formwork>("--formwork",
                               "areas of the objects of this query that touch neither each other nor soil",
                               {.value = "QUERY", .group = "Areas"}),
        member<&All::between>(
            "--between", "areas with which objects of two queries touch, instead of the quantities; give it twice",
            {.value = "QUERY", .group = "Areas", .excludes = "--by|--where|--exterior|--formwork|--stated"}),
        member<&All::stated>("--stated",
                             "compare the quantities that the file states (Qto sets, BaseQuantities) with the measured "
                             "ones",
                             {.group = "Areas"}),
        member<&All::json>("--json", "print rows, sums and assumptions as JSON on stdout",
                           {.group = "Output", .excludes = "--csv"}),
        member<&All::csv>("--csv", "print the rows as CSV on stdout", {.group = "Output"}),
        quietOption<All>(),
        part<&All::build>("build"),
    };
    return kMembers;
}

}  // namespace

extern const CommandText kQuantitiesCommand = commandOf<QuantitiesArguments, runQuantities>(
    "quantities", "Measure objects: volumes, areas and lengths, with and without openings");

}  // namespace svt::cli
