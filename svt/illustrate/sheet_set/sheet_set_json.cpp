#include <svt/illustrate/sheet_set.hpp>

#include <svt/core/text.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <iterator>
#include <utility>

namespace svt::illustrate {
namespace {

using SheetJson = nlohmann::ordered_json;

constexpr int kSheetsVersion = 1;

constexpr Option kSheetMembers[] = {
    {.name = "/format", .choices = "svt-sheets", .help = "says that this is a set of sheets"},
    {.name = "/version", .kind = OptionKind::Whole, .least = 1, .most = 1, .help = "version of the format"},
    {.name = "/title", .otherwise = "the name of the model", .help = "name of the building, in the title block"},
    {.name = "/paper", .choices = "A4|A3|A2|A1|A0", .byDefault = "A3", .help = "size of the sheets, landscape"},
    {.name = "/language", .choices = "en|de", .byDefault = "en", .help = "of the words on sheets"},
    {.name = "/scale",
     .kind = OptionKind::Number,
     .least = 0.01,
     .most = 1e7,
     .otherwise = "100, or the next of 200, 500, ... at which all views fit",
     .help = "scale of all views: 50 draws 1 m as 20 mm"},
    {.name = "/dimensions", .kind = OptionKind::Flag, .byDefault = "true", .help = "chains of dimensions around plans"},
    {.name = "/above", .kind = OptionKind::Flag, .byDefault = "true", .help = "plans show what is above the cut"},
    {.name = "/tables",
     .kind = OptionKind::Flag,
     .byDefault = "true",
     .help = "tables of rooms, floor areas and components, after the views"},
    {.name = "/hide", .value = "QUERY", .help = "leave out what the query selects", .mayRepeat = true},
    {.name = "/sheets",
     .kind = OptionKind::List,
     .least = 1,
     .most = 1000,
     .help = "each with its views; where they do not fit, they go on to another sheet"},
    {.name = "/sheets/*/title", .otherwise = "by its views", .help = "in the title block"},
    {.name = "/sheets/*/scale",
     .kind = OptionKind::Number,
     .least = 0.01,
     .most = 1e7,
     .otherwise = "that of all",
     .help = "scale of the views of this sheet"},
    {.name = "/sheets/*/views",
     .kind = OptionKind::List,
     .least = 1,
     .most = 1000,
     .help = "each is a plan, a section or an elevation"},
    {.name = "/sheets/*/views/*/plan",
     .value = "PLANE",
     .help = "horizontal plane, such as storey=EG+1.1 or z=1.2; metres from the lower corner of the grid"},
    {.name = "/sheets/*/views/*/section",
     .value = "PLANE",
     .help = "upright plane, such as x>4 (looks to smaller x), y<3 (to larger y) or A,B,C,D"},
    {.name = "/sheets/*/views/*/elevation", .choices = "north|east|south|west", .help = "the outside from that side"},
    {.name = "/sheets/*/views/*/name",
     .help = "of a plan that of its storey, of a section its letter, which plans have at their marks"},
    {.name = "/sheets/*/views/*/hidden",
     .kind = OptionKind::Flag,
     .byDefault = "false",
     .help = "also edges that are hidden, dashed"},
};

// Reads members one by one. The first error is kept, and nothing is read after it.
class SheetReader {
public:
    explicit SheetReader(std::string name) : name_(std::move(name)) {}

    [[nodiscard]] bool isFine() const noexcept { return error_.empty(); }
    [[nodiscard]] Error error() const { return Error(Code::BadSheets, fmt::format("{}: {}", name_, error_)); }
    void fail(const std::string& path, const std::string& what) {
        if (error_.empty()) error_ = fmt::format("{}: {}", path.empty() ? "/" : path, what);
    }

    // `pattern` is the path with * for indices. Unknown members are errors, so that typing errors are told.
    bool object(const SheetJson& json, const std::string& path, const std::string& pattern) {
        if (!json.is_object()) {
            fail(path, fmt::format("expected an object, found {}", json.type_name()));
            return false;
        }
        for (const auto& [key, value] : json.items())
            if (member(pattern + "/" + key) == nullptr) fail(path, fmt::format("unknown member '{}'", key));
        return isFine();
    }
    const SheetJson* array(const SheetJson& json, const std::string& path, const Option& option) {
        if (json.is_array() && static_cast<double>(json.size()) >= option.least &&
            static_cast<double>(json.size()) <= option.most)
            return &json;
        fail(path, fmt::format("expected an array of {} to {}, found {}", option.least, option.most, shorten(json)));
        return nullptr;
    }
    void text(const SheetJson& json, const std::string& path, const Option& option, std::string& to) {
        if (!json.is_string()) return fail(path, fmt::format("expected a text, found {}", shorten(json)));
        to = json.get<std::string>();
        const auto choices = splitChoices(option.choices);
        if (!choices.empty() && std::find(choices.begin(), choices.end(), to) == choices.end())
            fail(path, fmt::format("unknown '{}'; possible are {}", to, fmt::join(choices, ", ")));
    }
    void number(const SheetJson& json, const std::string& path, const Option& option, double& to) {
        if (!json.is_number() || !(json.get<double>() >= option.least && json.get<double>() <= option.most))
            return fail(path, fmt::format("expected a number from {} to {}, found {}", option.least, option.most,
                                          shorten(json)));
        to = json.get<double>();
    }
    void flag(const SheetJson& json, const std::string& path, bool& to) {
        if (!json.is_boolean()) return fail(path, fmt::format("expected true or false, found {}", shorten(json)));
        to = json.get<bool>();
    }

    static const Option* member(std::string_view pattern) noexcept {
        const auto* found = std::find_if(std::begin(kSheetMembers), std::end(kSheetMembers),
                                         [&](const Option& option) { return option.name == pattern; });
        return found == std::end(kSheetMembers) ? nullptr : found;
    }

private:
    static std::string shorten(const SheetJson& json) {
        return json.dump(-1, ' ', false, SheetJson::error_handler_t::replace).substr(0, 40);
    }

    std::string name_, error_;
};

void readView(SheetReader& read, const SheetJson& json, const std::string& path, SetView& view) {
    const std::string pattern = "/sheets/*/views/*";
    if (!read.object(json, path, pattern)) return;
    for (const auto& [key, value] : json.items()) {
        const std::string at = path + "/" + key;
        const Option& option = *SheetReader::member(pattern + "/" + key);
        if (key == "plan") read.text(value, at, option, view.plan);
        if (key == "section") read.text(value, at, option, view.section);
        if (key == "elevation") read.text(value, at, option, view.elevation);
        if (key == "name") read.text(value, at, option, view.name);
        if (key == "hidden") read.flag(value, at, view.hidden);
    }
    if ((view.plan.empty() ? 0 : 1) + (view.section.empty() ? 0 : 1) + (view.elevation.empty() ? 0 : 1) != 1)
        read.fail(path, "needs one of plan, section and elevation");
}

void readSheet(SheetReader& read, const SheetJson& json, const std::string& path, SetSheet& sheet) {
    const std::string pattern = "/sheets/*";
    if (!read.object(json, path, pattern)) return;
    for (const auto& [key, value] : json.items()) {
        const std::string at = path + "/" + key;
        const Option& option = *SheetReader::member(pattern + "/" + key);
        if (key == "title") read.text(value, at, option, sheet.title);
        if (key == "scale") read.number(value, at, option, sheet.scale);
        if (key != "views") continue;
        const SheetJson* views = read.array(value, at, option);
        for (std::size_t n = 0; views != nullptr && n < views->size(); ++n)
            readView(read, (*views)[n], fmt::format("{}/{}", at, n), sheet.views.emplace_back());
    }
    if (sheet.views.empty()) read.fail(path, "needs \"views\"");
}

void readSet(SheetReader& read, const SheetJson& json, SheetSet& set) {
    if (!read.object(json, "", "")) return;
    double version = 0;
    std::string format;
    for (const auto& [key, value] : json.items()) {
        const std::string at = "/" + key;
        const Option& option = *SheetReader::member(at);
        if (key == "format") read.text(value, at, option, format);
        if (key == "version") read.number(value, at, option, version);
        if (key == "title") read.text(value, at, option, set.title);
        if (key == "paper") read.text(value, at, option, set.paper);
        if (key == "language") read.text(value, at, option, set.language);
        if (key == "scale") read.number(value, at, option, set.scale);
        if (key == "dimensions") read.flag(value, at, set.dimensions);
        if (key == "above") read.flag(value, at, set.above);
        if (key == "tables") read.flag(value, at, set.tables);
        if (key == "hide") {
            if (!value.is_array()) return read.fail(at, "expected an array of queries");
            for (std::size_t n = 0; n < value.size(); ++n)
                read.text(value[n], fmt::format("{}/{}", at, n), option, set.hide.emplace_back());
        }
        if (key != "sheets") continue;
        const SheetJson* sheets = read.array(value, at, option);
        for (std::size_t n = 0; sheets != nullptr && n < sheets->size(); ++n)
            readSheet(read, (*sheets)[n], fmt::format("{}/{}", at, n), set.sheets.emplace_back());
    }
    if (format.empty()) read.fail("", "needs \"format\": \"svt-sheets\"");
    if (set.sheets.empty()) read.fail("", "needs \"sheets\"");
}

}  // namespace

std::span<const Option> sheetMembers() noexcept { return kSheetMembers; }

Result<SheetSet> parseSheetSet(std::string_view text, const std::string& name) {
    const SheetJson json = SheetJson::parse(text, nullptr, false);
    if (json.is_discarded()) return Error(Code::BadJson, fmt::format("{}: is no JSON", name));
    SheetReader read(name);
    SheetSet set;
    readSet(read, json, set);
    if (!read.isFine()) return read.error();
    return set;
}

std::string writeSheetSet(const SheetSet& set) {
    SheetJson json{{"format", "svt-sheets"}, {"version", kSheetsVersion}};
    const SheetSet plain;
    if (!set.title.empty()) json["title"] = set.title;
    if (set.paper != plain.paper) json["paper"] = set.paper;
    if (set.language != plain.language) json["language"] = set.language;
    if (set.scale > 0) json["scale"] = set.scale;
    if (!set.dimensions) json["dimensions"] = false;
    if (!set.above) json["above"] = false;
    if (!set.tables) json["tables"] = false;
    if (!set.hide.empty()) json["hide"] = set.hide;
    json["sheets"] = SheetJson::array();
    for (const SetSheet& sheet : set.sheets) {
        SheetJson written = SheetJson::object();
        if (!sheet.title.empty()) written["title"] = sheet.title;
        if (sheet.scale > 0) written["scale"] = sheet.scale;
        written["views"] = SheetJson::array();
        for (const SetView& view : sheet.views) {
            SheetJson one = SheetJson::object();
            if (!view.plan.empty()) one["plan"] = view.plan;
            if (!view.section.empty()) one["section"] = view.section;
            if (!view.elevation.empty()) one["elevation"] = view.elevation;
            if (!view.name.empty()) one["name"] = view.name;
            if (view.hidden) one["hidden"] = true;
            written["views"].push_back(std::move(one));
        }
        json["sheets"].push_back(std::move(written));
    }
    return json.dump(2, ' ', false, SheetJson::error_handler_t::replace) + "\n";
}

}  // namespace svt::illustrate
