#include <svt/drawing/levels/ground_floor.hpp>

#include <svt/core/text.hpp>
#include <svt/drawing/levels/level_parts.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

namespace svt::drawing {
namespace {

constexpr double kNearZero = 1;  // metres: a declared elevation further from 0 does not mark the ground floor

// Parts of names in lower case; only letters of ASCII change their case.
constexpr std::string_view kGround[] = {"erdgescho",     "ground floor", "ground level", "groundfloor", "rez-de-chauss",
                                        "rez de chauss", "begane grond", "planta baja",  "piano terra", "parterre"};
constexpr std::string_view kGroundWords[] = {"eg", "gf", "rdc"};
constexpr std::string_view kBelow[] = {
    "keller",    "untergescho", "basement", "cellar",     "sous-sol",   "kelder", "interrato",   "foundation",
    "fundament", "fundering",   "footing",  "tiefgarage", "semisotano", "sotano", "underground", "lower ground"};
constexpr std::string_view kBelowWords[] = {"ug", "kg", "fdn", "fnd", "tg", "b1", "b2", "b3", "u1", "u2", "u3"};

bool isWordCharacter(char c) { return isLetter(c) || isDigit(c) || (static_cast<unsigned char>(c) & 0x80) != 0; }

template <std::size_t P, std::size_t W>
bool namesOne(std::string_view name, const std::string_view (&parts)[P], const std::string_view (&words)[W]) {
    const std::string text = lowerAscii(name);
    for (const std::string_view part : parts)
        if (text.find(part) != std::string::npos) return true;
    for (const std::string_view word : words)
        for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
            const std::size_t end = at + word.size();
            if ((at == 0 || !isWordCharacter(text[at - 1])) && (end == text.size() || !isWordCharacter(text[end])))
                return true;
        }
    return false;
}

// How far the elevation that the level declares is from 0; infinite if it declares none.
double awayFromZero(const BuildingLevel& level, const volume::SemanticVolume& volume) {
    if (level.storeys.empty()) return kInfinity;
    const volume::Label& storey = volume.labels.labels[level.storeys.front()];
    const auto elevation = numberOf(storey, "elevation");
    return elevation && numberOf(storey, "modelElevation") ? std::abs(*elevation) : kInfinity;
}

// The number of storeys below ground, of the building that states the most.
std::size_t storeysBelowGround(const volume::SemanticVolume& volume) {
    double most = 0;
    for (const volume::Label& label : volume.labels.labels)
        if (const auto count = numberOf(label, "storeysBelowGround")) most = std::max(most, *count);
    return most >= 1 && most < 100 ? static_cast<std::size_t>(most) : 0;
}

}  // namespace

bool isNamedBelowGround(std::string_view name) { return namesOne(name, kBelow, kBelowWords); }

std::size_t groundFloorOf(const std::vector<BuildingLevel>& levels, const volume::SemanticVolume& volume) {
    const auto isBelow = [](const BuildingLevel& level) { return isNamedBelowGround(level.name); };
    for (std::size_t n = 0; n < levels.size(); ++n)
        if (namesOne(levels[n].name, kGround, kGroundWords) && !isBelow(levels[n])) return n;
    std::size_t nearest = levels.size();
    double least = kNearZero;
    for (std::size_t n = 0; n < levels.size(); ++n) {
        const double away = awayFromZero(levels[n], volume);
        if (isBelow(levels[n]) || away > least) continue;
        if (nearest < levels.size() && away == least) continue;
        nearest = n;
        least = away;
    }
    if (nearest < levels.size()) return nearest;
    if (const std::size_t below = storeysBelowGround(volume); below > 0 && below < levels.size()) return below;
    for (const bool needsRooms : {true, false})
        for (std::size_t n = 0; n < levels.size(); ++n)
            if (!isBelow(levels[n]) && (levels[n].hasRooms || !needsRooms)) return n;
    return 0;
}

}  // namespace svt::drawing
