#include <svt/writers/sheets/stamp_texts.hpp>

#include <svt/core/text.hpp>
#include <svt/model/classes.hpp>
#include <svt/writers/drawing/drawing_text.hpp>
#include <svt/writers/sheets/sheet_texts.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <variant>

namespace svt::writers {
namespace {

constexpr double kStampText = 2.5, kWidestStamp = 40;  // millimetres
constexpr double kEvenHeight = 0.005;                  // of the volume: below it the ceiling is level

const std::string* textValue(const volume::Label& label, std::string_view name) noexcept {
    for (const Attribute& attribute : label.attributes)
        if (attribute.name == name) return std::get_if<std::string>(&attribute.value);
    return nullptr;
}

const drawing::RoomArea* measuredRoom(const SheetContent& content, std::uint32_t label) noexcept {
    if (!content.areas) return nullptr;
    const auto& rooms = content.areas->rooms;
    const auto found = std::find_if(rooms.begin(), rooms.end(), [&](const auto& room) { return room.label == label; });
    return found == rooms.end() ? nullptr : &*found;
}

std::string heightLine(const drawing::RoomArea& room, SheetLanguage language) {
    const double even = room.area * room.height;
    const bool isLevel = std::abs(room.volume - even) <= kEvenHeight * even;
    return fmt::format("h {}{} m", isLevel ? "" : "\u2264 ", numberText(room.height, 2, language));
}

// Texts of files in place of a missing value.
bool isNoValue(const std::string& text) {
    constexpr std::string_view kTexts[] = {"n/a",   "na",   "n.a.", "none",      "tbd",    "tbc",
                                           "-",     "--",   "?",    "undefined", "<none>", "nicht definiert",
                                           "keine", "k.a.", "k. a."};
    return text.empty() || std::find(std::begin(kTexts), std::end(kTexts), lowerAscii(text)) != std::end(kTexts);
}

}  // namespace

std::string floorFinish(const volume::LabelTable& table, std::uint32_t room) {
    constexpr std::string_view kNames[] = {"floorcovering", "floor covering", "floorfinish",  "floor finish",
                                           "bodenbelag",    "fussbodenbelag", "fußbodenbelag"};
    const volume::Label& label = table.labels[room];
    for (const Attribute& attribute : label.attributes) {
        const std::string name = lowerAscii(attribute.name.substr(attribute.name.rfind('.') + 1));
        const std::string* text = std::get_if<std::string>(&attribute.value);
        // Templates repeat the name of the property as its value.
        if (text != nullptr && !isNoValue(*text) && lowerAscii(*text) != name &&
            std::find(std::begin(kNames), std::end(kNames), name) != std::end(kNames))
            return *text;
    }
    for (std::uint32_t l = room + 1; l < label.subtreeEnd && l < table.labels.size(); ++l) {
        const std::string* kind = textValue(table.labels[l], "predefinedType");
        if (kind == nullptr || *kind != "FLOORING") continue;
        const std::string* material = textValue(table.labels[l], "material");
        return material != nullptr && !material->empty() ? *material : table.labels[l].name;
    }
    return {};
}

std::vector<RoomStamp> roomStamps(const ViewContext& context) {
    std::vector<RoomStamp> stamps;
    const SheetLanguage language = context.options.language;
    const bool isFloorPlan = isPlan(context.view.drawing, context.volume.grid);
    for (const drawing::SectionComponent& component : context.view.drawing.components) {
        const volume::Label& label = context.volume.labels.labels[component.label];
        if (!model::isSpace(label.className) || component.isZone || component.polygons.empty()) continue;
        const std::string* number = textValue(label, "number");
        // The id of a room without a name says nothing to a reader.
        const std::string name = label.name.empty() ? std::string(sheetWord(SheetWord::Room, language)) : label.name;
        const bool isNumbered = number != nullptr && !number->empty() && *number != name;
        // Some programs write the name into the number: "2 - Bedroom".
        const bool isInNumber = isNumbered && number->find(name) != std::string::npos;
        const std::string first = !isNumbered ? name : isInNumber ? *number : *number + " " + name;
        RoomStamp stamp{component.label, {shortened(first, kStampText, kWidestStamp)}};
        if (isFloorPlan) {
            const drawing::RoomArea* measured = measuredRoom(context.content, component.label);
            const double area = measured != nullptr ? measured->area : component.stampArea();
            stamp.lines.push_back(fmt::format("{} m\u00B2", numberText(area, 2, language)));
            if (measured != nullptr && measured->height > 0) stamp.lines.push_back(heightLine(*measured, language));
            if (const std::string finish = floorFinish(context.volume.labels, component.label); !finish.empty())
                stamp.lines.push_back(shortened(finish, kStampText, kWidestStamp));
            if (const auto floor = context.floors.find(component.label); floor != context.floors.end())
                stamp.lines.push_back(floor->second);
        }
        stamps.push_back(std::move(stamp));
    }
    return stamps;
}

}  // namespace svt::writers
