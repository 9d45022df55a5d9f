#include <svt/frontend/take_off.hpp>

#include <svt/core/attribute.hpp>
#include <svt/core/names.hpp>
#include <svt/core/text.hpp>
#include <svt/model/classes.hpp>

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <map>
#include <numeric>
#include <string_view>

namespace svt::frontend {
namespace {

using quantities::ObjectQuantities;
using Known = std::optional<double>;

// The figures of a row, in the order of the columns.
enum Figure : std::size_t {
    kNet,
    kGross,
    kSide,
    kTop,
    kBottom,
    kOuter,
    kExterior,
    kExteriorCounted,
    kOpening,
    kFormwork,
    kFormworkTop,
    kThickness,
    kLength,
    kWidth,
    kHeight,
    kPerimeter,
    kFigures
};
struct FigureText {
    const char *name, *title;
    bool isSummed;
    Known ObjectQuantities::*quantity = nullptr;  // none: a figure of the take-off
};
constexpr std::array<FigureText, kFigures> kTexts{{{"netVolume", "net m3", true, &ObjectQuantities::netVolume},
                                                   {"grossVolume", "gross m3", true, &ObjectQuantities::grossVolume},
                                                   {"sideArea", "side m2", true, &ObjectQuantities::sideArea},
                                                   {"topArea", "top m2", true, &ObjectQuantities::topArea},
                                                   {"bottomArea", "bottom m2", true, &ObjectQuantities::bottomArea},
                                                   {"outerArea", "", true, &ObjectQuantities::outerArea},
                                                   {"exteriorArea", "exterior m2", true},
                                                   {"exteriorCountedArea", "", true},
                                                   {"openingArea", "openings m2", true, &ObjectQuantities::openingArea},
                                                   {"formworkArea", "formwork m2", true},
                                                   {"formworkTopArea", "", true},
                                                   {"thickness", "thick m", false, &ObjectQuantities::thickness},
                                                   {"length", "long m", false, &ObjectQuantities::length},
                                                   {"width", "", false, &ObjectQuantities::width},
                                                   {"height", "high m", false, &ObjectQuantities::height},
                                                   {"perimeter", "", false, &ObjectQuantities::perimeter}}};
using Figures = std::array<Known, kFigures>;

// The figures that are asked for beside the quantities.
struct Asked {
    bool exterior = false, formwork = false;
    [[nodiscard]] bool has(std::size_t figure) const {
        if (figure == kExterior || figure == kExteriorCounted) return exterior;
        return (figure != kFormwork && figure != kFormworkTop) || formwork;
    }
};
Asked askedOf(const TakeOff& takeOff) { return {takeOff.hasExterior, takeOff.hasFormwork}; }

Figures figuresOf(const TakeOff& takeOff, std::size_t n) {
    const ObjectQuantities& object = takeOff.objects[n];
    Figures figures;
    for (std::size_t f = 0; f < kFigures; ++f)
        if (kTexts[f].quantity != nullptr) figures[f] = object.*kTexts[f].quantity;
    if (!takeOff.exterior.empty() && takeOff.exterior[n])
        figures[kExterior] = std::accumulate(takeOff.exterior[n]->begin(), takeOff.exterior[n]->end(), 0.0);
    if (!takeOff.exteriorCounted.empty()) figures[kExteriorCounted] = takeOff.exteriorCounted[n];
    if (!takeOff.formwork.empty()) {
        figures[kFormwork] = takeOff.formwork[n];
        figures[kFormworkTop] = takeOff.formworkTop[n];
    }
    return figures;
}

// The figures of an object as they count in sums: space that it shares with another counts with one of them.
Figures countedFigures(const TakeOff& takeOff, std::size_t n) {
    Figures figures = figuresOf(takeOff, n);
    const ObjectQuantities& object = takeOff.objects[n];
    figures[kNet] = takeOff.counted[n].volume;
    if (figures[kGross])
        figures[kGross] = figures[kNet] ? Known(*figures[kNet] + *object.grossVolume - *object.netVolume) : Known();
    return figures;
}

struct Sums {
    std::size_t objects = 0;
    Figures figures{};
    std::array<std::size_t, kFigures> unknown{};
    std::array<Known, 10> exterior{};
    Known bound = 0.0;

    void add(const TakeOff& takeOff, std::size_t n) {
        ++objects;
        const Figures own = countedFigures(takeOff, n);
        for (std::size_t f = 0; f < kFigures; ++f) {
            if (own[f])
                figures[f] = figures[f].value_or(0) + *own[f];
            else
                ++unknown[f];
        }
        if (!takeOff.exterior.empty() && takeOff.exterior[n])
            for (std::size_t way = 0; way < exterior.size(); ++way)
                exterior[way] = exterior[way].value_or(0) + (*takeOff.exterior[n])[way];
        if (!own[kNet]) return;
        // A mesh whose shared space is counted in voxels has no bound in the sum.
        const bool isUnbounded = !takeOff.counted[n].isExact && takeOff.objects[n].trust != quantities::Trust::Voxels;
        const Known ownBound = isUnbounded ? Known() : takeOff.objects[n].bound;
        bound = bound && ownBound ? Known(*bound + *ownBound) : Known();
    }
};

// A tenth of a cubic centimetre or the like, so that no report has digits from rounding errors.
double withoutNoise(double value) { return std::round(value * 1e7) / 1e7; }
Cell cellOf(const Known& value) { return value ? Cell(withoutNoise(*value)) : Cell(); }
Json jsonOf(const Known& value) { return value ? Json(withoutNoise(*value)) : Json(); }
Cell cellOf(const std::string& text) { return text.empty() ? Cell() : Cell(text); }
Json jsonOf(const std::string& text) { return text.empty() ? Json() : Json(text); }
// Bounds of closed meshes are far below the digits of a volume; they keep their own.
Cell boundCell(const Known& bound) { return bound ? Cell(*bound) : Cell(); }

std::string exteriorName(std::size_t way) { return "exterior_" + std::string(quantities::kFacingNames[way]); }

void addFigureColumns(const Asked& asked, bool isSum, std::vector<Column>& columns) {
    for (std::size_t f = 0; f < kFigures; ++f)
        if (asked.has(f) && (!isSum || kTexts[f].isSummed)) columns.push_back({kTexts[f].name, kTexts[f].title});
    if (asked.exterior)
        for (std::size_t way = 0; way < quantities::kFacingNames.size(); ++way)
            columns.push_back({exteriorName(way), std::string(quantities::kFacingNames[way]) + " m2"});
}

void addFigures(const Asked& asked, const Figures& figures, bool isSum, bool hasOnlySums, Row& row) {
    for (std::size_t f = 0; f < kFigures; ++f) {
        if (!asked.has(f) || (hasOnlySums && !kTexts[f].isSummed)) continue;
        row.push_back(isSum && !kTexts[f].isSummed ? Cell() : cellOf(figures[f]));
    }
}

void addExterior(const Asked& asked, const std::array<Known, 10>& exterior, Row& row) {
    if (!asked.exterior) return;
    for (const Known& way : exterior) row.push_back(cellOf(way));
}

std::array<Known, 10> exteriorOf(const TakeOff& takeOff, std::size_t n) {
    std::array<Known, 10> exterior{};
    if (!takeOff.exterior.empty() && takeOff.exterior[n])
        for (std::size_t way = 0; way < exterior.size(); ++way) exterior[way] = (*takeOff.exterior[n])[way];
    return exterior;
}

Json jsonOf(const Asked& asked, const Sums& sums) {
    Json json;
    json["objects"] = sums.objects;
    for (std::size_t f = 0; f < kFigures; ++f) {
        if (!kTexts[f].isSummed || !asked.has(f)) continue;
        json[kTexts[f].name] = jsonOf(sums.figures[f]);
        if (sums.unknown[f] > 0) json["unknown"][kTexts[f].name] = sums.unknown[f];
    }
    json["bound"] = sums.figures[kNet] && sums.bound ? Json(*sums.bound) : Json();
    if (asked.exterior)
        for (std::size_t way = 0; way < sums.exterior.size(); ++way)
            json["exterior"][std::string(quantities::kFacingNames[way])] = jsonOf(sums.exterior[way]);
    return json;
}

// A quantity of the file and the measured one that it stands for.
struct StatedName {
    std::string_view name;
    bool isOfUpright, isOfFlat;  // bodies for which it has this meaning
    Known (*measured)(const ObjectQuantities&);
};
Known plus(const Known& a, const Known& b) { return a && b ? Known(*a + *b) : Known(); }
constexpr StatedName kStated[] = {
    {"NetVolume", true, true, [](const ObjectQuantities& q) { return q.netVolume; }},
    {"GrossVolume", true, true, [](const ObjectQuantities& q) { return q.grossVolume; }},
    {"Length", true, false, [](const ObjectQuantities& q) { return q.length; }},
    {"Height", true, false, [](const ObjectQuantities& q) { return q.height; }},
    {"Width", true, true, [](const ObjectQuantities& q) { return q.thickness; }},
    {"NetSideArea", true, false, [](const ObjectQuantities& q) { return q.sideArea; }},
    {"GrossSideArea", true, false, [](const ObjectQuantities& q) { return plus(q.sideArea, q.openingArea); }},
    {"NetArea", false, true, [](const ObjectQuantities& q) { return q.topArea; }},
    {"GrossArea", false, true, [](const ObjectQuantities& q) { return plus(q.topArea, q.openingArea); }},
    {"Perimeter", false, true, [](const ObjectQuantities& q) { return q.perimeter; }},
};

// The measured quantity of a name, if it has a meaning for the object.
Known measuredOf(const StatedName& name, const ObjectQuantities& object) {
    // An upright body has a length and no width, see ObjectQuantities.
    const bool isUpright = object.length && !object.width, isFlat = object.width.has_value();
    const bool isDefined =
        (isUpright && name.isOfUpright) || (isFlat && name.isOfFlat) || (name.isOfUpright && name.isOfFlat);
    return isDefined ? name.measured(object) : Known();
}

const StatedName* statedNameOf(std::string_view attribute) {
    const std::size_t dot = attribute.find('.');
    if (dot == std::string_view::npos) return nullptr;
    const std::string_view set = attribute.substr(0, dot);
    if (!set.starts_with("Qto_") && set != "BaseQuantities") return nullptr;
    for (const StatedName& stated : kStated)
        if (stated.name == attribute.substr(dot + 1)) return &stated;
    return nullptr;
}

Known numberOf(const AttributeValue& value) {
    if (const auto* number = std::get_if<double>(&value)) return *number;
    if (const auto* whole = std::get_if<std::int64_t>(&value)) return double(*whole);
    return {};
}

Json tableRows(const Table& table) {
    Json rows = Json::array();
    for (const Row& row : table.rows) {
        Json& json = rows.emplace_back();
        for (std::size_t c = 0; c < row.size(); ++c) {
            Json& value = json[table.columns[c].name];
            if (const auto* text = std::get_if<std::string>(&row[c].value)) value = *text;
            if (const auto* number = std::get_if<double>(&row[c].value)) value = *number;
        }
    }
    return rows;
}

}  // namespace

std::vector<std::string> takeOffAssumptions(const TakeOff& takeOff) {
    std::vector<std::string> list{
        "openings are voids between the two faces of a body, enclosed or reaching its lower edge",
        "a void is as deep as the body is thick; niches and recesses do not count",
        "the volume of a mesh that was closed by caps refers to the closed mesh; its bound is unknown",
        "space that several objects share counts once in sums"};
    if (takeOff.hasExterior) {
        list.emplace_back("north is +y of the coordinate reference system");
        list.emplace_back(
            "outside air is air that is connected to the border of the model, through gaps of a voxel or more");
        list.emplace_back(
            "closed meshes divide the faces of their neighbours exactly; elsewhere, points do, and "
            "exteriorCountedArea has the area that they divide");
    }
    if (takeOff.hasFormwork)
        list.emplace_back(
            "soil is only where terrain is a body: below a terrain surface, faces count as free; faces that look up "
            "need formwork");
    return list;
}

struct TakeOffTotals::All {
    Asked asked;
    std::vector<std::string> keys;
    Sums total;
    std::map<std::vector<std::string>, Sums> groups;  // by the values of the keys
    std::size_t inVoxels = 0;                         // objects whose volume is counted
    std::size_t assumed = 0;                          // of them, those whose material is assumed
};

TakeOffTotals::TakeOffTotals() : all_(std::make_unique<All>()) {}
TakeOffTotals::TakeOffTotals(TakeOffTotals&&) noexcept = default;
TakeOffTotals& TakeOffTotals::operator=(TakeOffTotals&&) noexcept = default;
TakeOffTotals::~TakeOffTotals() = default;

void TakeOffTotals::add(const TakeOff& takeOff) {
    all_->asked = askedOf(takeOff);
    all_->keys = takeOff.keys;
    for (std::size_t n = 0; n < takeOff.objects.size(); ++n) {
        all_->total.add(takeOff, n);
        if (!takeOff.keys.empty()) all_->groups[takeOff.values[n]].add(takeOff, n);
    }
    for (const quantities::CountedVolume& one : takeOff.counted) all_->inVoxels += one.volume && !one.isExact;
    for (const ObjectQuantities& object : takeOff.objects) all_->assumed += object.trust == quantities::Trust::Assumed;
}

std::size_t TakeOffTotals::objects() const noexcept { return all_->total.objects; }

Row TakeOffTotals::totalRow() const {
    const Sums& sums = all_->total;
    Row row{"(sum)", Cell(), fmt::format("{} objects", sums.objects), Cell(), Cell()};
    addFigures(all_->asked, sums.figures, true, false, row);
    addExterior(all_->asked, sums.exterior, row);
    row.insert(row.end(), {Cell(), Cell(), boundCell(sums.figures[kNet] ? sums.bound : Known()), Cell()});
    return row;
}

Table TakeOffTotals::sums(bool hasSum) const {
    Table table;
    for (const std::string& key : all_->keys) table.columns.push_back({key, key, 0});
    table.columns.push_back({"objects", "objects", 0});
    addFigureColumns(all_->asked, true, table.columns);
    table.columns.push_back({"bound", "+- m3"});
    const auto addRow = [&](Row row, const Sums& sums) {
        row.emplace_back(sums.objects);
        addFigures(all_->asked, sums.figures, true, true, row);
        addExterior(all_->asked, sums.exterior, row);
        row.push_back(boundCell(sums.figures[kNet] ? sums.bound : Known()));
        table.rows.push_back(std::move(row));
    };
    for (const auto& [values, sums] : all_->groups) {
        Row row;
        for (const std::string& value : values) row.push_back(cellOf(value));
        addRow(std::move(row), sums);
    }
    if (hasSum && all_->total.objects > 0) {
        Row row(all_->keys.size());
        row.front() = "(sum)";
        addRow(std::move(row), all_->total);
    }
    return table;
}

Json TakeOffTotals::sumsJson() const {
    Json sums = Json::array();
    for (const auto& [values, sum] : all_->groups) {
        Json row = jsonOf(all_->asked, sum);
        for (std::size_t k = 0; k < values.size(); ++k) row["by"][all_->keys[k]] = jsonOf(values[k]);
        sums.push_back(std::move(row));
    }
    return sums;
}

Json TakeOffTotals::totalJson() const { return jsonOf(all_->asked, all_->total); }

std::vector<std::string> TakeOffTotals::notes(bool hasGross) const {
    std::vector<std::string> notes;
    const Sums& sums = all_->total;
    if (sums.unknown[kNet] > 0)
        notes.push_back(
            fmt::format("the net volume of {} of {} objects is unknown: they are surfaces, were read in part, "
                        "or are too small for the voxels; sums exclude them",
                        sums.unknown[kNet], sums.objects));
    if (const std::size_t unknown = sums.unknown[kGross] - std::min(sums.unknown[kGross], sums.unknown[kNet]);
        unknown > 0 && hasGross)
        notes.push_back(
            fmt::format("the gross volume of {} objects with a net volume is unknown: they lack two parallel "
                        "faces or a closed mesh, or are not walls or slabs; sums of gross volumes exclude them",
                        unknown));
    if (all_->inVoxels > 0)
        notes.push_back(fmt::format("the volumes of {} objects in sums are counted in voxels", all_->inVoxels));
    if (all_->assumed > 0)
        notes.push_back(
            fmt::format("the volumes of {} boundary surfaces are assumed: the space of a building that belongs to no "
                        "room, such as an attic, counts as the material behind the nearest surface",
                        all_->assumed));
    return notes;
}

Table takeOffTable(const TakeOff& takeOff, bool hasSum) {
    Table table;
    const Asked asked = askedOf(takeOff);
    table.columns = {{"id", "id"}, {"class", "class"}, {"name", "name"}, {"storey", "storey"}, {"material"}};
    addFigureColumns(asked, false, table.columns);
    table.columns.insert(table.columns.end(),
                         {{"openings", "", 0}, {"trust", "trust"}, {"bound", "+- m3"}, {"grossBound"}});
    for (std::size_t n = 0; n < takeOff.objects.size(); ++n) {
        const ObjectQuantities& object = takeOff.objects[n];
        const volume::Label& label = takeOff.volume.labels.labels[object.label];
        Row& row = table.rows.emplace_back();
        row = {label.id, label.className, label.name, cellOf(takeOff.storeys[n]), cellOf(takeOff.materials[n])};
        addFigures(asked, figuresOf(takeOff, n), false, false, row);
        addExterior(asked, exteriorOf(takeOff, n), row);
        row.push_back(object.openings ? Cell(*object.openings) : Cell());
        row.push_back(cellOf(std::string(nameOf(object.trust))));
        row.push_back(boundCell(object.netVolume ? object.bound : Known()));
        row.push_back(boundCell(object.grossVolume ? object.grossBound : Known()));
    }
    if (hasSum && !takeOff.objects.empty()) {
        TakeOffTotals totals;
        totals.add(takeOff);
        table.rows.push_back(totals.totalRow());
    }
    return table;
}

Table takeOffSums(const TakeOff& takeOff, bool hasSum) {
    TakeOffTotals totals;
    totals.add(takeOff);
    return totals.sums(hasSum);
}

std::vector<StatedFigure> statedFigures(const ObjectQuantities& object) {
    std::vector<StatedFigure> figures;
    for (const StatedName& name : kStated)
        if (const Known measured = measuredOf(name, object)) figures.push_back({name.name, withoutNoise(*measured)});
    return figures;
}

Table statedTable(const TakeOff& takeOff) {
    Table table;
    table.columns = {{"id", "id"},
                     {"class", "class"},
                     {"name", "name"},
                     {"quantity", "quantity"},
                     {"stated", "stated"},
                     {"measured", "measured"},
                     {"difference", "difference"}};
    for (const ObjectQuantities& object : takeOff.objects) {
        const volume::Label& label = takeOff.volume.labels.labels[object.label];
        if (model::classRank(label.className) != model::ClassRank::Element) continue;
        for (const Attribute& attribute : label.attributes) {
            const StatedName* name = statedNameOf(attribute.name);
            const Known stated = name != nullptr ? numberOf(attribute.value) : Known();
            if (!stated) continue;
            const Known measured = measuredOf(*name, object);
            table.rows.push_back({label.id, label.className, label.name, attribute.name, cellOf(stated),
                                  cellOf(measured), measured ? cellOf(Known(*measured - *stated)) : Cell()});
        }
    }
    return table;
}

Json takeOffRowJson(const TakeOff& takeOff, std::size_t n) {
    const ObjectQuantities& object = takeOff.objects[n];
    const volume::Label& label = takeOff.volume.labels.labels[object.label];
    const Figures figures = figuresOf(takeOff, n);
    Json row;
    row["id"] = label.id;
    row["class"] = label.className;
    row["name"] = label.name;
    row["storey"] = jsonOf(takeOff.storeys[n]);
    row["material"] = jsonOf(takeOff.materials[n]);
    for (const Figure f : {kNet, kGross, kSide, kTop, kBottom, kExterior, kExteriorCounted, kOpening, kFormwork})
        row[kTexts[f].name] = jsonOf(figures[f]);
    row["trust"] = jsonOf(std::string(nameOf(object.trust)));
    row["bound"] = object.netVolume && object.bound ? Json(*object.bound) : Json();
    return row;
}

Json takeOffExteriorJson(const TakeOff& takeOff, std::size_t n) {
    Json row;
    row["id"] = takeOff.volume.labels.labels[takeOff.objects[n].label].id;
    const std::array<Known, 10> areas = exteriorOf(takeOff, n);
    for (std::size_t way = 0; way < areas.size(); ++way)
        row[std::string(quantities::kFacingNames[way])] = jsonOf(areas[way]);
    return row;
}

Json takeOffJson(const TakeOff& takeOff, bool hasStated) {
    Json json;
    TakeOffTotals totals;
    totals.add(takeOff);
    Json& rows = json["rows"] = Json::array();
    for (std::size_t n = 0; n < takeOff.objects.size(); ++n) rows.push_back(takeOffRowJson(takeOff, n));
    if (!takeOff.keys.empty()) json["sums"] = totals.sumsJson();
    if (takeOff.hasExterior) {
        Json& exterior = json["exterior"] = Json::array();
        for (std::size_t n = 0; n < takeOff.objects.size(); ++n) exterior.push_back(takeOffExteriorJson(takeOff, n));
    }
    if (hasStated) json["stated"] = tableRows(statedTable(takeOff));
    json["total"] = totals.totalJson();
    json["assumptions"] = takeOffAssumptions(takeOff);
    return json;
}

Table chosenTable(const TakeOff& takeOff, bool hasStated, bool hasSum) {
    if (hasStated) return statedTable(takeOff);
    return takeOff.keys.empty() ? takeOffTable(takeOff, hasSum) : takeOffSums(takeOff, hasSum);
}

std::string takeOffFile(const TakeOff& takeOff, bool hasStated) {
    return takeOffJson(takeOff, hasStated).dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::vector<std::string> takeOffNotes(const TakeOff& takeOff) {
    TakeOffTotals totals;
    totals.add(takeOff);
    return totals.notes();
}

}  // namespace svt::frontend
