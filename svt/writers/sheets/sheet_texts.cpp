#include <svt/writers/sheets/sheet_texts.hpp>

#include <svt/drawing/north.hpp>
#include <svt/writers/sheets/class_words.hpp>
#include <svt/writers/sheets/term.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace svt::writers {
namespace {

using W = SheetWord;
using render::Hatch;

constexpr Term<SheetWord> kWords[] = {
    {W::Drawing, "Drawing", "Zeichnung"},
    {W::Model, "Model", "Modell"},
    {W::Scale, "Scale", "Maßstab"},
    {W::Sheet, "Sheet", "Blatt"},
    {W::Paper, "Paper", "Papier"},
    {W::SheetOf, "of", "von"},
    {W::Plan, "Plan", "Grundriss"},
    {W::Level, "level", "Ebene"},
    {W::Plans, "Plans", "Grundrisse"},
    {W::Section, "Section", "Schnitt"},
    {W::Sections, "Sections", "Schnitte"},
    {W::Elevations, "Elevations", "Ansichten"},
    {W::North, "north", "Norden"},
    {W::East, "east", "Osten"},
    {W::South, "south", "Süden"},
    {W::West, "west", "Westen"},
    {W::NorthEast, "north-east", "Nordosten"},
    {W::SouthEast, "south-east", "Südosten"},
    {W::SouthWest, "south-west", "Südwesten"},
    {W::NorthWest, "north-west", "Nordwesten"},
    {W::GroundFloor, "the ground floor", "dem Fußboden des Erdgeschosses"},
    {W::HeightsAbove, "Heights above", "Höhen über"},
    {W::InModelHeights, " in the heights of the model", " in den Höhen des Modells"},
    {W::NorthLetter, "N", "N"},
    {W::NorthAssumed, "assumed: +y", "angenommen: +y"},
    {W::GridNorth, "grid north", "Gitternord"},
    {W::GridNorthLetters, "GN", "GiN"},
    {W::EastLetter, "E", "O"},
    {W::WestLetter, "W", "W"},
    {W::Rooms, "Rooms", "Räume"},
    {W::FloorAreas, "Floor areas after DIN 277-1, m\u00B2", "Grundflächen nach DIN 277-1, m\u00B2"},
    {W::Components, "Components", "Bauteile"},
    {W::Number, "No.", "Nr."},
    {W::Room, "Room", "Raum"},
    {W::Storey, "Storey", "Geschoss"},
    {W::Use, "Use", "Nutzung"},
    {W::Zone, "zone", "Zone"},
    {W::Area, "Area m\u00B2", "Fläche m\u00B2"},
    {W::Height, "Height m", "Höhe m"},
    {W::Volume, "Volume m\u00B3", "Volumen m\u00B3"},
    {W::Component, "Component", "Bauteil"},
    {W::Type, "Type", "Typ"},
    {W::Count, "Count", "Anzahl"},
    {W::Total, "Total", "Summe"},
    {W::NoScale, "\u2013", "\u2013"},
    {W::Tables, "Tables", "Tabellen"},
    {W::Project, "Project", "Projekt"},
    {W::BuildingAddress, "Building, address", "Bauwerk, Adresse"},
    {W::DocumentType, "Document type", "Dokumentart"},
    {W::DrawingNumber, "Drawing number", "Zeichnungsnummer"},
    {W::Owner, "Legal owner", "Eigentümer"},
    {W::Creator, "Created by", "Erstellt von"},
    {W::Approver, "Approved by", "Genehmigt von"},
    {W::Revision, "Revision", "Änderung"},
    {W::Date, "Date of issue", "Ausgabedatum"},
    {W::FloorPlan, "Floor plan", "Grundriss"},
    {W::ElevationType, "Elevation", "Ansicht"},
    {W::ScheduleType, "Schedule", "Liste"},
    {W::WithoutStamp, "Rooms without a stamp: ", "Räume ohne Stempel: "},
    {W::SeeTable, "see the table", "siehe Tabelle"},
    {W::Stamp, "Stamp", "Stempel"},
    {W::Risers, "R", "Stg"},
    {W::Legend, "Materials", "Baustoffe"},
    {W::GroundAssumed, "Ground line assumed at the ground floor", "Geländelinie in Höhe des Erdgeschosses angenommen"},
    {W::Doors, "Doors", "Türen"},
    {W::Windows, "Windows", "Fenster"},
    {W::Mark, "Mark", "Pos."},
    {W::Width, "Width m", "Breite m"},
    {W::WidthMeasured, "measured", "gemessen"},
    {W::WidthClear, "clear", "licht"},
    {W::HeightMeasured, "measured", "gemessen"},
    {W::Sill, "Sill m", "Brüstung m"},
    {W::Revisions, "Revisions", "Änderungen"},
    {W::RevisionChange, "Change", "Art"},
    {W::RevisionObject, "Object", "Bauteil"},
    {W::RevisionAdded, "+ m\u00B3", "+ m\u00B3"},
    {W::RevisionRemoved, "\u2212 m\u00B3", "\u2212 m\u00B3"},
    {W::FurtherRevisions, "{} further, see the table", "{} weitere, siehe Tabelle"},
    {W::Moved, "moved", "verschoben"},
    {W::Changed, "changed", "geändert"},
    {W::Split, "split", "geteilt"},
    {W::Merged, "merged", "vereinigt"},
    {W::Added, "added", "neu"},
    {W::Removed, "removed", "entfällt"},
};

constexpr Term<Hatch> kHatchWords[] = {
    {Hatch::Masonry, "Masonry", "Mauerwerk"},
    {Hatch::Concrete, "Concrete", "Beton"},
    {Hatch::ReinforcedConcrete, "Reinforced concrete", "Stahlbeton"},
    {Hatch::Timber, "Timber", "Holz"},
    {Hatch::Insulation, "Insulation", "Dämmung"},
    {Hatch::Earth, "Earth", "Erdreich"},
    {Hatch::Steel, "Steel", "Stahl"},
    {Hatch::Glass, "Glass", "Glas"},
    {Hatch::General, "Without stated material", "Ohne Angabe des Baustoffs"},
};

std::string levelName(const drawing::BuildingLevel& level, double datum, SheetLanguage language) {
    if (!level.name.empty()) return level.name;
    const double height = level.floor - datum;
    return fmt::format("{} {}", sheetWord(W::Level, language), numberText(height, 2, language));
}

// A room without a name has the word for a room: its id says nothing to a reader.
std::string roomName(const drawing::RoomArea& room, const volume::LabelTable* labels, SheetLanguage language) {
    const bool isUnnamed = labels != nullptr && room.label < labels->labels.size() &&
                           labels->labels[room.label].name.empty() && room.name == labels->labels[room.label].id;
    return isUnnamed ? std::string(sheetWord(W::Room, language)) : room.name;
}

// Some programs write the name into the number: "2 - Bedroom".
std::string roomNumber(const drawing::RoomArea& room) {
    const std::size_t name = room.name.empty() ? std::string::npos : room.number.rfind(room.name);
    if (name == std::string::npos || name == 0 || name + room.name.size() != room.number.size()) return room.number;
    const std::size_t last = room.number.find_last_not_of(" -:_", name - 1);
    return last == std::string::npos ? room.number : room.number.substr(0, last + 1);
}

// Whether a number of a room comes first: by its leading words and numbers, so that 2 comes before 10.
bool isNumberBefore(std::string_view a, std::string_view b) {
    const auto isDigit = [](char c) { return c >= '0' && c <= '9'; };
    const auto numberAt = [&](std::string_view text, std::size_t at) {
        std::size_t first = at, end = at;
        while (end < text.size() && isDigit(text[end])) ++end;
        while (first + 1 < end && text[first] == '0') ++first;
        return std::pair(text.substr(first, end - first), end);
    };
    std::size_t i = 0, j = 0;
    while (i < a.size() && j < b.size()) {
        if (!isDigit(a[i]) || !isDigit(b[j])) {
            if (a[i] != b[j]) return a[i] < b[j];
            ++i;
            ++j;
            continue;
        }
        const auto [x, endOfX] = numberAt(a, i);
        const auto [y, endOfY] = numberAt(b, j);
        if (x != y) return x.size() != y.size() ? x.size() < y.size() : x < y;
        i = endOfX;
        j = endOfY;
    }
    return a.size() - i < b.size() - j;
}

// The rooms by level and number.
std::vector<drawing::RoomArea> roomsInOrder(const drawing::FloorAreas& areas) {
    std::vector<drawing::RoomArea> rooms = areas.rooms;
    std::stable_sort(rooms.begin(), rooms.end(), [](const drawing::RoomArea& a, const drawing::RoomArea& b) {
        return a.level != b.level ? a.level < b.level : isNumberBefore(a.number, b.number);
    });
    return rooms;
}

// Types with one word share a row, unless only one of them has a known area or volume.
SheetTable componentTable(const drawing::FloorAreas& areas, SheetLanguage language) {
    std::vector<std::pair<std::string, drawing::ComponentSum>> sums;
    for (const drawing::ComponentSum& sum : areas.components) {
        std::string word = classWord(sum.type.empty() ? sum.className : sum.type, language);
        const auto found = std::find_if(sums.begin(), sums.end(), [&](const auto& other) {
            return other.first == word && (other.second.area > 0) == (sum.area > 0) &&
                   (other.second.volume > 0) == (sum.volume > 0);
        });
        if (found == sums.end()) {
            sums.emplace_back(std::move(word), sum);
            continue;
        }
        found->second.count += sum.count;
        found->second.area += sum.area;
        found->second.volume += sum.volume;
    }
    std::stable_sort(sums.begin(), sums.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    const auto word = [&](SheetWord w) { return std::string(sheetWord(w, language)); };
    SheetTable table{word(W::Components),
                     {{word(W::Component)}, {word(W::Count), true}, {word(W::Area), true}, {word(W::Volume), true}},
                     {},
                     0};
    const auto number = [&](double value) {
        return value > 0 ? numberText(value, 2, language) : std::string("\u2013");
    };
    for (const auto& [name, sum] : sums)
        table.rows.push_back({name, fmt::format("{}", sum.count), number(sum.area), number(sum.volume)});
    return table;
}

}  // namespace

std::string_view sheetWord(SheetWord word, SheetLanguage language) noexcept { return termOf(kWords, word, language); }

std::string_view hatchWord(render::Hatch hatch, SheetLanguage language) noexcept {
    return termOf(kHatchWords, hatch, language);
}

std::string elevationText(std::string_view side, SheetLanguage language) {
    constexpr SheetWord kSides[] = {W::North, W::NorthEast, W::East, W::SouthEast,
                                    W::South, W::SouthWest, W::West, W::NorthWest};
    const auto names = drawing::compassNames();
    const auto found = std::find(names.begin(), names.end(), side);
    const SheetWord word = kSides[found == names.end() ? 0 : found - names.begin()];
    return fmt::format("{} {}", language == SheetLanguage::German ? "Ansicht von" : "Elevation from the",
                       sheetWord(word, language));
}

std::string numberText(double value, int decimals, SheetLanguage language) {
    std::string text = fmt::format("{:.{}f}", value, decimals);
    if (text.find_first_of("123456789") == std::string::npos && text.front() == '-') text.erase(0, 1);
    if (language == SheetLanguage::German) std::replace(text.begin(), text.end(), '.', ',');
    return text;
}

std::vector<SheetTable> makeAreaTables(const drawing::FloorAreas& areas,
                                       const std::vector<drawing::BuildingLevel>& levels, SheetLanguage language,
                                       const volume::LabelTable* labels) {
    const auto word = [&](SheetWord w) { return std::string(sheetWord(w, language)); };
    const auto number = [&](double value, int decimals = 2) { return numberText(value, decimals, language); };
    const double datum = drawing::zeroLevel(levels);
    std::vector<SheetTable> tables;
    if (!areas.rooms.empty()) {
        SheetTable rooms{word(W::Rooms),
                         {{word(W::Number)},
                          {word(W::Room)},
                          {word(W::Storey)},
                          {word(W::Use)},
                          {word(W::Area), true},
                          {word(W::Height), true},
                          {word(W::Volume), true}},
                         {},
                         1};
        double area = 0, volume = 0;
        const auto measured = [&](double value) { return value > 0 ? number(value) : std::string("\u2013"); };
        for (const drawing::RoomArea& room : roomsInOrder(areas)) {
            rooms.rows.push_back({roomNumber(room), roomName(room, labels, language),
                                  levelName(levels[room.level], datum, language),
                                  room.isZone ? word(W::Zone) : std::string(drawing::roomUseName(room.use)),
                                  measured(room.area), number(room.height), measured(room.volume)});
            area += room.countedArea;
            volume += room.countedVolume;
        }
        rooms.rows.push_back({"", word(W::Total), "", "", number(area), "", number(volume)});
        tables.push_back(std::move(rooms));
        SheetTable floors{word(W::FloorAreas),
                          {{word(W::Storey)},
                           {"NUF", true},
                           {"TF", true},
                           {"VF", true},
                           {"?", true},
                           {"NRF", true},
                           {"KGF", true},
                           {"BGF", true}},
                          {},
                          1};
        const auto add = [&](const std::string& name, const drawing::LevelArea& level) {
            const auto known = [&](bool isKnown, double value) {
                return isKnown ? number(value) : std::string("\u2013");
            };
            const bool hasGross = level.isFloor && level.isGrossKnown;
            floors.rows.push_back({name, known(level.isFloor, level.use), known(level.isFloor, level.technical),
                                   known(level.isFloor, level.traffic), known(level.isFloor, level.unknown),
                                   known(level.isFloor, level.net),
                                   known(hasGross && !level.netExceedsGross(), level.construction),
                                   known(hasGross, level.gross)});
        };
        for (std::size_t n = 0; n < levels.size(); ++n) add(levelName(levels[n], datum, language), areas.levels[n]);
        add(word(W::Total), areas.total());
        tables.push_back(std::move(floors));
    }
    if (!areas.components.empty()) tables.push_back(componentTable(areas, language));
    return tables;
}

}  // namespace svt::writers
