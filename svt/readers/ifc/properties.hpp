#pragma once
/// \file
/// Property sets, quantities, types, materials and classifications of products as attributes.

#include <svt/core/attribute.hpp>
#include <svt/readers/ifc/units.hpp>
#include <svt/readers/ifc_shape/ifc_file.hpp>

#include <optional>
#include <unordered_map>
#include <vector>

namespace svt::readers::ifc {

/// Elements of an attribute in the budget of a file: the number of points that take the same memory.
[[nodiscard]] std::uint64_t elementsOf(const Attribute& attribute) noexcept;

/// Sets, types, materials and classifications of each object. Made once from the relations of a file.
class Properties {
public:
    Properties(const IfcFile& file, const Units& units);

    /// Attributes of an object in addition to its own: `Pset_WallCommon.IsExternal`, `BaseQuantities.NetVolume`,
    /// `type`, `material`, `materialLayers`, `classification`, and `liningThickness` of doors (metres). A property of
    /// the object replaces one of its type.
    void append(RecordIndex object, std::vector<Attribute>& attributes) const;

    /// Types that define an object.
    [[nodiscard]] const std::vector<RecordIndex>& typesOf(RecordIndex object) const { return of(types_, object); }

    /// Materials, layer sets and usages of an object, else of its type.
    [[nodiscard]] const std::vector<RecordIndex>& materialsOf(RecordIndex object) const;

    /// The material for the colour of an object, that of its thickest layer or its first one; kNoRecord: none.
    [[nodiscard]] RecordIndex mainMaterial(RecordIndex object) const;

    /// The material of the constituent with this name, in the constituent set of an object or of its type; kNoRecord:
    /// none.
    [[nodiscard]] RecordIndex constituent(RecordIndex object, const std::string& name) const;

private:
    using Records = std::vector<RecordIndex>;
    using Related = std::unordered_map<RecordIndex, Records>;
    struct MaterialPart {
        RecordIndex material = kNoRecord;
        std::optional<double> thickness;  // of a layer, metres
    };

    void appendSet(RecordIndex set, std::vector<Attribute>& attributes) const;
    void appendProperty(const std::string& prefix, RecordIndex property, std::vector<Attribute>& attributes) const;
    void replaceOrAdd(std::vector<Attribute>& attributes, Attribute attribute) const;
    void appendMaterial(RecordIndex definition, std::vector<Attribute>& attributes) const;
    [[nodiscard]] std::vector<MaterialPart> parts(RecordIndex definition) const;
    [[nodiscard]] MaterialPart part(RecordIndex record) const;
    [[nodiscard]] static const Records& of(const Related& map, RecordIndex key);

    const IfcFile& file_;
    Units units_;
    Related sets_, types_, materials_, classifications_;
};

}  // namespace svt::readers::ifc
