#include <svt/readers/ifc/styles.hpp>

#include <svt/readers/textures/ifc_textures.hpp>

#include <algorithm>
#include <map>
#include <utility>

namespace svt::readers::ifc {
namespace {

class StyleReader {
public:
    explicit StyleReader(const IfcFile& file) : file_(file) {}

    Styles run([[maybe_unused]] std::string_view fileName, [[maybe_unused]] const ReadOptions& options,
               [[maybe_unused]] Diagnostics& diagnostics) {
        for (RecordIndex i = 0; i < file_.step().records().size(); ++i) switch (file_.entityOf(i)) {
                case Entity::StyledItem: readStyledItem(i); break;
                case Entity::IndexedColourMap: readColorMap(file_.fieldsOf(i)); break;
                case Entity::MaterialDefinitionRepresentation: readMaterial(i); break;
                case Entity::ShapeAspect: readAspect(i); break;
                default: break;
            }
        if constexpr (textures::kReadsTextures)
            textures::colorTexturedStyles(file_, textured_, styles_.materials, fileName, options, diagnostics);
        for (const auto& [item, part] : partOfItem_) namePart(item, part);
        return std::move(styles_);
    }

private:
    static constexpr std::uint64_t kElementsPerMaterial = 4;  // in points of the same memory

    void readStyledItem(RecordIndex styled) {
        const RecordIndex item = file_.follow(styled, at::StyledItem::Item);
        if (item == kNoRecord) return;
        if (const std::int32_t material = surfaceMaterial(styled); material >= 0) styles_.ofItem[item] = material;
    }

    void readMaterial(RecordIndex definition) {
        const RecordIndex owner = file_.follow(definition, at::MaterialDefinitionRepresentation::RepresentedMaterial);
        for (const RecordIndex representation : file_.representations(definition))
            for (const RecordIndex styled : file_.items(representation))
                if (const std::int32_t material = surfaceMaterial(styled); material >= 0)
                    styles_.ofMaterial.emplace(owner, material);
    }

    void readAspect(RecordIndex aspect) {
        const std::string part = file_.fieldsOf(aspect)[at::ShapeAspect::Name].string().value_or("");
        if (part.empty() || !file_.guard().takeElements(kElementsPerMaterial)) return;
        for (const RecordIndex representation : file_.followAll(aspect, at::ShapeAspect::ShapeRepresentations))
            for (const RecordIndex item : file_.items(representation)) partOfItem_.emplace(item, part);
    }

    // Gives an item a material with the name of its part, and the colour that the item has.
    void namePart(RecordIndex item, const std::string& part) {
        const auto [style, isNew] = styles_.ofItem.try_emplace(item, -1);
        const auto [number, isFirst] = numbersOfParts_.try_emplace({style->second, part}, -1);
        if (isFirst) {
            model::Material material;
            material.hasColor = style->second >= 0;
            if (material.hasColor) material = styles_.materials[static_cast<std::size_t>(style->second)];
            material.part = part;
            number->second = static_cast<std::int32_t>(styles_.materials.size());
            styles_.materials.push_back(std::move(material));
        }
        style->second = number->second;
    }

    // Colours of the faces of a face set: numbers of colours, beginning with 1.
    void readColorMap(const Fields& fields) {
        const RecordIndex item = file_.follow(fields[at::IndexedColourMap::MappedTo]);
        if (item == kNoRecord) return;
        const auto first = static_cast<std::int32_t>(styles_.materials.size());
        const double opacity = fields[at::IndexedColourMap::Opacity].number().value_or(1);
        step::ValueCursor colors(
            file_.fieldsOf(file_.follow(fields[at::IndexedColourMap::Colours]))[at::ColourRgbList::ColourList]);
        for (Value color; colors.next(color) && file_.guard().takeElements(kElementsPerMaterial);) {
            const std::vector<Value> parts = step::itemsOf(color);
            model::Material material;
            const auto channel = [&](std::size_t i) { return share(i < parts.size() ? parts[i] : Value(), 0.8); };
            material.diffuse = {channel(0), channel(1), channel(2)};
            material.transparency = static_cast<float>(std::clamp(1 - opacity, 0.0, 1.0));
            styles_.materials.push_back(std::move(material));
        }
        const auto count = static_cast<std::int64_t>(styles_.materials.size()) - first;
        std::vector<std::int32_t>& faces = styles_.ofFaces[item];
        step::ValueCursor numbers(fields[at::IndexedColourMap::ColourIndex]);
        for (Value number; numbers.next(number);) {
            const std::int64_t index = number.integer().value_or(0);
            faces.push_back(index >= 1 && index <= count ? first + static_cast<std::int32_t>(index - 1) : -1);
        }
    }

    // The number of a material for the first surface style of an IfcStyledItem; -1: none.
    std::int32_t surfaceMaterial(RecordIndex styled) {
        for (const RecordIndex style : file_.followAll(styled, at::StyledItem::Styles)) {
            if (file_.entityOf(style) == Entity::SurfaceStyle) return materialNumber(style);
            if (file_.entityOf(style) != Entity::PresentationStyleAssignment) continue;
            for (const RecordIndex inner : file_.followAll(style, at::PresentationStyleAssignment::Styles))
                if (file_.entityOf(inner) == Entity::SurfaceStyle) return materialNumber(inner);
        }
        return -1;
    }

    // The number of a value, clamped to 0 to 1; `otherwise` if there is none.
    static float share(Value value, double otherwise) {
        return static_cast<float>(std::clamp(value.number().value_or(otherwise), 0.0, 1.0));
    }

    std::int32_t materialNumber(RecordIndex style) {
        const auto known = numbers_.find(style);
        if (known != numbers_.end()) return known->second;
        std::int32_t number = -1;
        const Fields fields = file_.fieldsOf(style);
        for (const RecordIndex shading : file_.followAll(fields[at::SurfaceStyle::Styles])) {
            const Entity entity = file_.entityOf(shading);
            if (entity != Entity::SurfaceStyleRendering && entity != Entity::SurfaceStyleShading) continue;
            const Fields values = file_.fieldsOf(shading);
            const Fields color = file_.fieldsOf(file_.follow(values[at::SurfaceStyleShading::SurfaceColour]));
            model::Material material;
            material.name = fields[at::SurfaceStyle::Name].string().value_or("");
            material.diffuse = {share(color[at::ColourRgb::Red], 0.8), share(color[at::ColourRgb::Green], 0.8),
                                share(color[at::ColourRgb::Blue], 0.8)};
            material.transparency = share(values[at::SurfaceStyleShading::Transparency], 0);
            number = static_cast<std::int32_t>(styles_.materials.size());
            styles_.materials.push_back(std::move(material));
            break;
        }
        if constexpr (textures::kReadsTextures)
            if (number < 0 || textures::isPlainGrey(styles_.materials[static_cast<std::size_t>(number)]))
                number = texturedMaterial(fields, number);
        return numbers_[style] = number;
    }

    // The number of a material whose colour comes from textures; `grey` if there are none.
    // \param grey  the number of the material that the style has otherwise, or -1
    std::int32_t texturedMaterial(const Fields& fields, std::int32_t grey) {
        for (const RecordIndex texture : file_.followAll(fields[at::SurfaceStyle::Styles])) {
            if (!textures::isTexturedStyle(file_, texture)) continue;
            const auto number = grey >= 0 ? grey : static_cast<std::int32_t>(styles_.materials.size());
            textured_.push_back({texture, static_cast<std::size_t>(number), grey >= 0});
            if (grey >= 0) return grey;
            model::Material material;
            material.name = fields[at::SurfaceStyle::Name].string().value_or("");
            styles_.materials.push_back(std::move(material));
            return number;
        }
        return grey;
    }

    const IfcFile& file_;
    Styles styles_;
    std::unordered_map<RecordIndex, std::int32_t> numbers_;
    std::vector<textures::TexturedStyle> textured_;
    std::map<RecordIndex, std::string> partOfItem_;  // ordered, so that materials have the same numbers each time
    std::map<std::pair<std::int32_t, std::string>, std::int32_t> numbersOfParts_;  // by material without part
};

}  // namespace

std::unordered_map<RecordIndex, std::string> readPresentationLayers(const IfcFile& file) {
    std::unordered_map<RecordIndex, std::string> layers;
    for (RecordIndex i = 0; i < file.step().records().size(); ++i) {
        const Entity entity = file.entityOf(i);
        if (entity != Entity::PresentationLayerAssignment && entity != Entity::PresentationLayerWithStyle) continue;
        const Fields fields = file.fieldsOf(i);
        const std::string name = fields[at::PresentationLayerAssignment::Name].string().value_or("");
        if (name.empty()) continue;
        for (const RecordIndex item : file.followAll(fields[at::PresentationLayerAssignment::AssignedItems]))
            layers.emplace(item, name);
    }
    return layers;
}

Styles readStyles(const IfcFile& file, std::string_view fileName, const ReadOptions& options,
                  Diagnostics& diagnostics) {
    return StyleReader(file).run(fileName, options, diagnostics);
}

}  // namespace svt::readers::ifc
