#include <svt/writers/drawing/dxf_parts.hpp>

#include <svt/core/text.hpp>
#include <svt/model/classes.hpp>
#include <svt/writers/drawing/drawing_text.hpp>

#include <algorithm>
#include <cstdint>
#include <variant>

namespace svt::writers {
namespace {

using render::Hatch;

constexpr DxfHatchLine kMasonry[] = {{45, 0, 0, 0.14, 0, 0}};
constexpr DxfHatchLine kConcrete[] = {{45, 0, 0, 0.3, 0.02, 0.31}, {-35, 0.11, 0.07, 0.42, 0.08, 0.45}};
constexpr DxfHatchLine kReinforced[] = {{45, 0, 0, 0.24, 0, 0}, {45, 0.085, -0.085, 0.24, 0.17, 0.09}};
constexpr DxfHatchLine kTimber[] = {{20, 0, 0, 0.09, 0.4, 0.1}};
constexpr DxfHatchLine kInsulation[] = {{65, 0, 0, 0.22, 0, 0}, {115, 0, 0, 0.22, 0, 0}};
constexpr DxfHatchLine kEarth[] = {
    {45, 0, 0, 0.35, 0.27, 0.08}, {45, 0.05, -0.05, 0.35, 0.27, 0.08}, {135, 0, 0, 0.35, 0.2, 0.15}};
constexpr DxfHatchLine kSteel[] = {{45, 0, 0, 0.18, 0, 0}, {45, 0.032, -0.032, 0.18, 0, 0}};
constexpr DxfHatchLine kGlass[] = {{45, 0, 0, 0.28, 0.1, 0.3}};
constexpr DxfHatchLine kGeneral[] = {{135, 0, 0, 0.28, 0, 0}};

constexpr DxfHatch kDxfHatches[] = {{Hatch::Masonry, "SVT_MASONRY", kMasonry},
                                    {Hatch::Concrete, "SVT_CONCRETE", kConcrete},
                                    {Hatch::ReinforcedConcrete, "SVT_REINFORCED", kReinforced},
                                    {Hatch::Timber, "SVT_TIMBER", kTimber},
                                    {Hatch::Insulation, "SVT_INSULATION", kInsulation},
                                    {Hatch::Earth, "SVT_EARTH", kEarth},
                                    {Hatch::Steel, "SVT_STEEL", kSteel},
                                    {Hatch::Glass, "SVT_GLASS", kGlass},
                                    {Hatch::General, "SVT_GENERAL", kGeneral}};

std::string attributeOf(const volume::Label& label, std::string_view name) {
    for (const Attribute& attribute : label.attributes)
        if (attribute.name == name)
            if (const std::string* text = std::get_if<std::string>(&attribute.value)) return *text;
    return {};
}

// Element groups of CI/SfB table 1; the first row whose word the layer's name contains counts.
struct Element {
    const char *word, *code;
};
constexpr Element kElements[] = {
    {"Curtain", "21"},      {"Wall", "22"},     {"Door", "32"},     {"Window", "31"},    {"Roof", "27"},
    {"Slab", "23"},         {"Floor", "43"},    {"Ceiling", "35"},  {"Stair", "24"},     {"Ramp", "24"},
    {"Railing", "34"},      {"Column", "28"},   {"Beam", "28"},     {"Member", "28"},    {"Footing", "16"},
    {"Pile", "17"},         {"Ground", "13"},   {"Covering", "42"}, {"Chimney", "28"},   {"Furni", "82"},
    {"Furnishing", "82"},   {"Sanitary", "74"}, {"Pipe", "52"},     {"Duct", "57"},      {"Flow", "59"},
    {"Installation", "59"}, {"wall", "22"},     {"slab", "23"},     {"roof", "27"},      {"beam", "28"},
    {"rafter", "28"},       {"stair", "24"},    {"Room", "90SPAC"}, {"Space", "90SPAC"}, {"Unit", "90SPAC"},
    {"Storey", "90SPAC"},   {"Zone", "90SPAC"}, {"Relief", "10"},   {"Terrain", "10"},   {"Site", "10"},
    {"LandUse", "10"}};

std::string padded(std::string text, std::size_t size) {
    text.resize(size, '-');
    return text;
}

}  // namespace

const DxfHatch* dxfHatchOf(Hatch hatch) noexcept {
    for (const DxfHatch& known : kDxfHatches)
        if (known.hatch == hatch) return &known;
    return nullptr;
}

std::string dxfLayerOf(const volume::Label& label) {
    if (const std::string type = attributeOf(label, "ifcType"); !type.empty()) return plainName(type);
    const std::string name = plainName(label.className), function = attributeOf(label, "function");
    const bool isWord = !function.empty() && function.size() <= 40 &&
                        std::all_of(function.begin(), function.end(),
                                    [](char c) { return isLetter(c) || c == ' ' || c == '_' || c == '-'; });
    return isWord ? name + "_" + plainName(function) : name;
}

std::string isoLayerOf(const volume::Label& label, bool isExternal, DxfContent content, std::string_view field) {
    const std::string name = dxfLayerOf(label);
    std::string code = "--";
    for (const Element& element : kElements)
        if (name.find(element.word) != std::string::npos) {
            code = element.code;
            break;
        }
    if (code == "22" && (isExternal || label.className == "WallSurface")) code = "21";
    if (code == "32" && isExternal) code = "31";
    const std::string optional = field.empty() ? std::string() : std::string(10, '-').append(field);
    return padded("A-", 2) + padded(code, 6) + static_cast<char>(content) + "-" + optional;
}

DxfOutlines::DxfOutlines(const drawing::SectionDrawing& drawing) {
    for (const drawing::SectionBorder& border : drawing.borders)
        for (std::size_t n = 0; n + 1 < border.points.size(); ++n) {
            const drawing::PlanePoint a = border.points[n], b = border.points[n + 1];
            borders_.insert({a.u, a.v, b.u, b.v});
            borders_.insert({b.u, b.v, a.u, a.v});
        }
    const auto addRing = [&](const drawing::Ring& ring) {
        for (std::size_t n = 0; n < ring.size(); ++n) {
            const drawing::PlanePoint a = ring[n], b = ring[(n + 1) % ring.size()];
            rings_.insert({a.u, a.v, b.u, b.v});
        }
    };
    for (const drawing::SectionComponent& component : drawing.components)
        for (const drawing::SectionPolygon& polygon : component.polygons) {
            addRing(polygon.outer);
            for (const drawing::Ring& hole : polygon.holes) addRing(hole);
        }
}

// A joint is an edge of two components without a border.
bool DxfOutlines::isJoint(drawing::PlanePoint from, drawing::PlanePoint to) const {
    return rings_.contains({to.u, to.v, from.u, from.v}) && !borders_.contains({from.u, from.v, to.u, to.v});
}

std::vector<std::vector<drawing::PlanePoint>> DxfOutlines::partsOf(const drawing::Ring& ring, bool& isClosed) const {
    const std::size_t count = ring.size();
    std::vector<std::uint8_t> isJointEdge(count, 0);
    std::size_t first = count;  // an edge behind a joint
    for (std::size_t n = 0; n < count; ++n) isJointEdge[n] = isJoint(ring[n], ring[(n + 1) % count]) ? 1 : 0;
    for (std::size_t n = 0; n < count; ++n)
        if (isJointEdge[n] != 0 && isJointEdge[(n + 1) % count] == 0) first = (n + 1) % count;
    isClosed = std::find(isJointEdge.begin(), isJointEdge.end(), 1) == isJointEdge.end();
    if (isClosed) return {ring};
    std::vector<std::vector<drawing::PlanePoint>> parts;
    for (std::size_t n = 0; first < count && n < count; ++n) {
        const std::size_t edge = (first + n) % count;
        if (isJointEdge[edge] != 0) continue;
        if (n == 0 || isJointEdge[(edge + count - 1) % count] != 0) parts.push_back({ring[edge]});
        parts.back().push_back(ring[(edge + 1) % count]);
    }
    return parts;
}

std::string isoLayerOf(DxfContent content) { return std::string("A-------") + static_cast<char>(content) + "-"; }

}  // namespace svt::writers
