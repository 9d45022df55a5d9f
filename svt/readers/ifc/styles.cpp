#include <svt/readers/ifc/styles.hpp>

#include <algorithm>

namespace svt::readers::ifc {
namespace {

class StyleReader {
public:
    explicit StyleReader(const IfcFile& file) : file_(file) {}

    Styles run() {
        for (RecordIndex i = 0; i < file_.step().records().size(); ++i) {
            if (file_.entityOf(i) == Entity::StyledItem) {
                const Fields fields = file_.fieldsOf(i);
                const RecordIndex item = file_.follow(fields[0]);
                if (item == kNoRecord) continue;
                if (const std::int32_t material = materialOf(fields[1]); material >= 0) styles_.ofItem[item] = material;
            } else if (file_.entityOf(i) == Entity::IndexedColourMap) {
                readColorMap(file_.fieldsOf(i));
            } else if (file_.entityOf(i) == Entity::MaterialDefinitionRepresentation) {
                readMaterial(file_.fieldsOf(i));
            }
        }
        return std::move(styles_);
    }

private:
    static constexpr std::uint64_t kElementsPerMaterial = 4;  // as much memory as so many points

    void readMaterial(const Fields& fields) {
        const RecordIndex owner = file_.follow(fields[3]);
        for (const RecordIndex representation : file_.followAll(fields[2]))
            for (const RecordIndex item : file_.followAll(file_.fieldsOf(representation)[3]))
                if (const std::int32_t material = materialOf(file_.fieldsOf(item)[1]); material >= 0)
                    styles_.ofMaterial.emplace(owner, material);
    }

    // Colours of the faces of a face set, by their numbers in a list that begins with 1.
    void readColorMap(const Fields& fields) {
        const RecordIndex item = file_.follow(fields[0]);
        if (item == kNoRecord) return;
        const auto first = static_cast<std::int32_t>(styles_.materials.size());
        const double opacity = fields[1].number().value_or(1);
        step::ValueCursor colors(file_.fieldsOf(file_.follow(fields[2]))[0]);
        for (Value color; colors.next(color) && file_.guard().takeElements(kElementsPerMaterial);) {
            const std::vector<Value> parts = step::itemsOf(color);
            model::Material material;
            const auto part = [&](std::size_t i) {
                const double value = i < parts.size() ? parts[i].number().value_or(0.8) : 0.8;
                return static_cast<float>(std::clamp(value, 0.0, 1.0));
            };
            material.diffuse = {part(0), part(1), part(2)};
            material.transparency = static_cast<float>(std::clamp(1 - opacity, 0.0, 1.0));
            styles_.materials.push_back(std::move(material));
        }
        const auto count = static_cast<std::int64_t>(styles_.materials.size()) - first;
        std::vector<std::int32_t>& faces = styles_.ofFaces[item];
        step::ValueCursor numbers(fields[3]);
        for (Value number; numbers.next(number);) {
            const std::int64_t index = number.integer().value_or(0);
            faces.push_back(index >= 1 && index <= count ? first + static_cast<std::int32_t>(index - 1) : -1);
        }
    }

    // The first surface style among the styles of an item.
    std::int32_t materialOf(Value list) {
        for (const RecordIndex style : file_.followAll(list)) {
            if (file_.entityOf(style) == Entity::SurfaceStyle) return numberOf(style);
            if (file_.entityOf(style) != Entity::PresentationStyleAssignment) continue;
            for (const RecordIndex inner : file_.followAll(file_.fieldsOf(style)[0]))
                if (file_.entityOf(inner) == Entity::SurfaceStyle) return numberOf(inner);
        }
        return -1;
    }

    std::int32_t numberOf(RecordIndex style) {
        const auto known = numbers_.find(style);
        if (known != numbers_.end()) return known->second;
        std::int32_t number = -1;
        const Fields fields = file_.fieldsOf(style);
        for (const RecordIndex shading : file_.followAll(fields[2])) {
            const Entity entity = file_.entityOf(shading);
            if (entity != Entity::SurfaceStyleRendering && entity != Entity::SurfaceStyleShading) continue;
            const Fields values = file_.fieldsOf(shading);
            const Fields color = file_.fieldsOf(file_.follow(values[0]));
            model::Material material;
            material.name = fields[0].string().value_or("");
            const auto part = [&](std::size_t i) {
                return static_cast<float>(std::clamp(color[i].number().value_or(0.8), 0.0, 1.0));
            };
            material.diffuse = {part(1), part(2), part(3)};
            material.transparency = static_cast<float>(std::clamp(values[1].number().value_or(0), 0.0, 1.0));
            number = static_cast<std::int32_t>(styles_.materials.size());
            styles_.materials.push_back(std::move(material));
            break;
        }
        return numbers_[style] = number;
    }

    const IfcFile& file_;
    Styles styles_;
    std::unordered_map<RecordIndex, std::int32_t> numbers_;
};

}  // namespace

std::unordered_map<RecordIndex, std::string> readPresentationLayers(const IfcFile& file) {
    std::unordered_map<RecordIndex, std::string> layers;
    for (RecordIndex i = 0; i < file.step().records().size(); ++i) {
        const Entity entity = file.entityOf(i);
        if (entity != Entity::PresentationLayerAssignment && entity != Entity::PresentationLayerWithStyle) continue;
        const Fields fields = file.fieldsOf(i);
        const std::string name = fields[0].string().value_or("");
        if (name.empty()) continue;
        for (const RecordIndex item : file.followAll(fields[2])) layers.emplace(item, name);
    }
    return layers;
}

Styles readStyles(const IfcFile& file) { return StyleReader(file).run(); }

}  // namespace svt::readers::ifc
