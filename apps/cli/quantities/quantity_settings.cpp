#include <apps/cli/quantities/quantity_settings.hpp>

#include <svt/core/file.hpp>
#include <svt/record/record.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace svt::cli {
namespace {

enum class Measure : std::uint8_t { None, Length, Area, Volume };

struct ColumnText {
    std::string_view name, english, german;
    Measure measure = Measure::None;
};
constexpr ColumnText kColumnTexts[] = {
    {"id", "ID", "ID"},
    {"class", "Class", "Klasse"},
    {"name", "Name", "Name"},
    {"storey", "Storey", "Geschoss"},
    {"material", "Material", "Material"},
    {"netVolume", "Net volume", "Nettovolumen", Measure::Volume},
    {"grossVolume", "Gross volume", "Bruttovolumen", Measure::Volume},
    {"sideArea", "Side area", "Seitenfläche", Measure::Area},
    {"topArea", "Top area", "Fläche oben", Measure::Area},
    {"bottomArea", "Bottom area", "Fläche unten", Measure::Area},
    {"outerArea", "Outer area", "Oberfläche", Measure::Area},
    {"exteriorArea", "Exterior area", "Außenfläche", Measure::Area},
    {"openingArea", "Opening area", "Öffnungsfläche", Measure::Area},
    {"formworkArea", "Formwork area", "Schalfläche", Measure::Area},
    {"formworkTopArea", "Formwork area on top", "Schalfläche oben", Measure::Area},
    {"thickness", "Thickness", "Dicke", Measure::Length},
    {"length", "Length", "Länge", Measure::Length},
    {"width", "Width", "Breite", Measure::Length},
    {"height", "Height", "Höhe", Measure::Length},
    {"perimeter", "Perimeter", "Umfang", Measure::Length},
    {"exteriorCountedArea", "Exterior area, divided by points", "Außenfläche, durch Punkte geteilt", Measure::Area},
    {"exterior_n", "Exterior, north", "Außen, Nord", Measure::Area},
    {"exterior_ne", "Exterior, north-east", "Außen, Nordost", Measure::Area},
    {"exterior_e", "Exterior, east", "Außen, Ost", Measure::Area},
    {"exterior_se", "Exterior, south-east", "Außen, Südost", Measure::Area},
    {"exterior_s", "Exterior, south", "Außen, Süd", Measure::Area},
    {"exterior_sw", "Exterior, south-west", "Außen, Südwest", Measure::Area},
    {"exterior_w", "Exterior, west", "Außen, West", Measure::Area},
    {"exterior_nw", "Exterior, north-west", "Außen, Nordwest", Measure::Area},
    {"exterior_top", "Exterior, top", "Außen, oben", Measure::Area},
    {"exterior_bottom", "Exterior, bottom", "Außen, unten", Measure::Area},
    {"openings", "Openings", "Öffnungen"},
    {"trust", "Source", "Quelle"},
    {"bound", "Net volume, bound", "Nettovolumen, Abweichung bis", Measure::Volume},
    {"grossBound", "Gross volume, further bound", "Bruttovolumen, weitere Abweichung bis", Measure::Volume},
};
// Columns of the other tables, which settings do not select.
constexpr ColumnText kOtherTexts[] = {
    {"objects", "Objects", "Objekte"},
    {"quantity", "Quantity", "Größe"},
    {"stated", "Stated", "Angegeben"},
    {"measured", "Measured", "Gemessen"},
    {"difference", "Difference", "Differenz"},
    {"a", "ID of A", "ID von A"},
    {"aName", "Name of A", "Name von A"},
    {"b", "ID of B", "ID von B"},
    {"bName", "Name of B", "Name von B"},
    {"area", "Contact area by faces of A", "Kontaktfläche nach Flächen von A", Measure::Area},
    {"areaOfB", "Contact area by faces of B", "Kontaktfläche nach Flächen von B", Measure::Area},
    {"about", "About", "Angabe"},
    {"value", "Value", "Wert"},
};

const ColumnText* columnTextOf(std::string_view name) {
    for (const ColumnText& text : kColumnTexts)
        if (text.name == name) return &text;
    for (const ColumnText& text : kOtherTexts)
        if (text.name == name) return &text;
    return nullptr;
}

std::string unitOf(Measure measure, const QuantityUnits& units) {
    switch (measure) {
        case Measure::Length: return units.length;
        case Measure::Area: return units.area;
        case Measure::Volume: return units.volume;
        case Measure::None: break;
    }
    return {};
}

}  // namespace

record::Members<QuantityUnits> membersOf(const QuantityUnits*) noexcept {
    using record::Choice, record::Member, record::memberAs;
    static constexpr Member<QuantityUnits> kMembers[] = {
        memberAs<Choice, &QuantityUnits::length>("length", "unit of lengths", {.choices = "m|mm"}),
        memberAs<Choice, &QuantityUnits::area>("area", "unit of areas", {.choices = "m2"}),
        memberAs<Choice, &QuantityUnits::volume>("volume", "unit of volumes", {.choices = "m3|l"}),
    };
    return kMembers;
}

void checkMembers(record::Faults& faults, const std::string& path, const QuantitySettings& settings) {
    for (std::size_t c = 0; c < settings.columns.size(); ++c) {
        const auto isThis = [&](const ColumnText& text) { return text.name == settings.columns[c]; };
        const std::string place = fmt::format("{}/columns/{}", path, c);
        if (std::none_of(std::begin(kColumnTexts), std::end(kColumnTexts), isThis)) {
            std::string known;
            for (const ColumnText& text : kColumnTexts) known.append(known.empty() ? "" : ", ").append(text.name);
            return faults.add(place, "unknown column '" + settings.columns[c] + "'; possible are " + known);
        }
        const auto before = settings.columns.begin() + std::ptrdiff_t(c);
        if (std::find(settings.columns.begin(), before, settings.columns[c]) != before)
            return faults.add(place, "the column '" + settings.columns[c] + "' is listed twice");
    }
}

record::Members<QuantitySettings> membersOf(const QuantitySettings*) noexcept {
    using record::Choice, record::FormatName, record::FormatVersion, record::Member, record::member, record::memberAs,
        record::memberOf;
    using All = QuantitySettings;
    static constexpr Member<All> kMembers[] = {
        memberOf<All, FormatName<All>>("format", "says that these are settings of quantities",
                                       {.choices = "svt-quantities", .isRequired = true}),
        memberOf<All, FormatVersion<All>>("version", "version of the format", {.least = 1, .most = 1}),
        member<&All::columns>("columns", "names of columns", {.least = 1, .most = 100, .otherwise = "all"}),
        member<&All::units>("units", "units of lengths, areas and volumes"),
        memberAs<Choice, &All::language>("language", "of headings", {.choices = "en|de"}),
    };
    return kMembers;
}

Result<QuantitySettings> readQuantitySettings(const std::filesystem::path& file) {
    SVT_TRY(bytes, FileBytes::read(file));
    return record::parseRecord<QuantitySettings>(bytes->text(), file.string(), Code::BadArgument);
}

std::vector<std::string> quantityHeadings(const Table& table, const QuantitySettings& settings) {
    std::vector<std::string> headings;
    for (const Column& column : table.columns) {
        const ColumnText* text = columnTextOf(column.name);
        if (text == nullptr) {
            headings.push_back(column.name);
            continue;
        }
        const std::string unit = unitOf(text->measure, settings.units);
        headings.emplace_back(settings.language == "de" ? text->german : text->english);
        if (!unit.empty()) headings.back() += " (" + unit + ")";
    }
    return headings;
}

Result<Table> withQuantitySettings(Table table, const QuantitySettings& settings, std::size_t kept) {
    for (std::size_t c = 0; c < table.columns.size(); ++c) {
        const ColumnText* text = columnTextOf(table.columns[c].name);
        const std::string unit = text == nullptr ? std::string() : unitOf(text->measure, settings.units);
        if (unit != "mm" && unit != "l") continue;
        // Bounds have more digits than figures.
        const double scale = table.columns[c].name.ends_with("ound") ? 1e9 : 1e4;
        table.columns[c].decimals = unit == "mm" ? 1 : 2;
        for (Row& row : table.rows)
            if (auto* number = std::get_if<double>(&row[c].value)) *number = std::round(*number * 1000 * scale) / scale;
    }
    if (settings.columns.empty()) return table;
    std::vector<std::size_t> chosen;
    for (std::size_t c = 0; c < kept; ++c) chosen.push_back(c);
    for (const std::string& name : settings.columns) {
        const auto isThis = [&](const Column& column) { return column.name == name; };
        const auto found = std::find_if(table.columns.begin() + std::ptrdiff_t(kept), table.columns.end(), isThis);
        if (found == table.columns.end() && table.rows.empty()) {
            chosen.push_back(table.columns.size());  // the command measured nothing, so any figure is empty
            table.columns.push_back({name, name});
        } else if (found != table.columns.end())
            chosen.push_back(std::size_t(found - table.columns.begin()));
        else if (kept == 0)  // sums have no lengths and names
            return Error(Code::BadArgument, fmt::format("the settings have the column '{}', which needs {}", name,
                                                        name.starts_with("form") ? "--formwork" : "--exterior"));
    }
    Table result;
    for (const std::size_t c : chosen) result.columns.push_back(table.columns[c]);
    for (const Row& row : table.rows) {
        Row& made = result.rows.emplace_back();
        for (const std::size_t c : chosen) made.push_back(row[c]);
    }
    const auto isSum = [](const Row& row) {
        const auto* text = row.empty() ? nullptr : std::get_if<std::string>(&row.front().value);
        return text != nullptr && *text == "(sum)";
    };
    if (table.rows.empty() || !isSum(table.rows.back()) || isSum(result.rows.back())) return result;
    const ColumnText* first = columnTextOf(result.columns.front().name);
    const bool isFigure = first != nullptr && (first->measure != Measure::None || first->name == "openings");
    if (isFigure)
        result.rows.pop_back();
    else
        result.rows.back().front() = "(sum)";
    return result;
}

Table withHeadings(Table table, const QuantitySettings& settings) {
    const std::vector<std::string> headings = quantityHeadings(table, settings);
    for (std::size_t c = 0; c < headings.size(); ++c) {
        Column& column = table.columns[c];
        column.name = headings[c];
        if (!column.title.empty() || !settings.columns.empty()) column.title = headings[c];
    }
    return table;
}

}  // namespace svt::cli
