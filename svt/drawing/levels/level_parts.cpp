#include <svt/drawing/levels/level_parts.hpp>

#include <svt/core/text.hpp>
#include <svt/model/classes.hpp>

#include <algorithm>
#include <variant>

namespace svt::drawing {
namespace {

bool hasPart(std::string_view text, std::string_view part) { return text.find(part) != std::string_view::npos; }

}  // namespace

bool isRoomSpace(const volume::Label& label) {
    return model::isSpace(label.className) && model::classRank(label.className) == model::ClassRank::Room;
}

bool isRoomOfSize(const volume::Label& label, const LabelExtent& extent) {
    const Vec3d size = extent.box.size();
    return isRoomSpace(label) && size.z >= kLowestRoom && size.x * size.y >= kSmallestFloor;
}

bool isFloorSlab(const volume::Label& label) {
    if (label.className == "FloorSurface") return true;
    const std::string words = lowerAscii(label.name) + lowerTexts(label, {"predefinedType", "PredefinedType"});
    if (hasPart(words, "roof") || hasPart(words, "dach")) return false;
    const std::string type = lowerTexts(label, {"ifcType", "function"});
    return hasPart(type, "slab") || hasPart(type, "floor");
}

bool isWallPart(const volume::Label& label) {
    if (label.className == "WallSurface") return true;
    return hasPart(lowerTexts(label, {"ifcType", "function"}), "wall");
}

std::string lowerTexts(const volume::Label& label, std::initializer_list<std::string_view> names) {
    std::string texts;
    for (const Attribute& attribute : label.attributes) {
        const auto* text = std::get_if<std::string>(&attribute.value);
        if (text != nullptr && std::find(names.begin(), names.end(), attribute.name) != names.end())
            texts += " " + *text;
    }
    return lowerAscii(texts);
}

std::optional<double> numberOf(const volume::Label& label, std::string_view name) {
    for (const Attribute& attribute : label.attributes) {
        if (attribute.name != name) continue;
        if (const auto* number = std::get_if<double>(&attribute.value)) return *number;
        if (const auto* whole = std::get_if<std::int64_t>(&attribute.value)) return static_cast<double>(*whole);
    }
    return std::nullopt;
}

}  // namespace svt::drawing
