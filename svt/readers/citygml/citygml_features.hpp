#pragma once
/// \file
/// Reads the parsed children of a CityModel into a part: features, attributes, appearances.
/// Follows the rules of GML instead of a list of classes. Properties are lowerCamel, objects are UpperCamel. An object
/// within a property of a feature is itself a feature unless it is geometry or a known data type. Modules and ADEs
/// therefore need no special code.

#include <svt/readers/citygml/citygml_part.hpp>
#include <svt/readers/citygml/gml_geometry.hpp>
#include <svt/readers/xml/xml_names.hpp>

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <utility>

namespace svt::readers::citygml {

class FeatureReader {
public:
    /// \param offsetOf  byte offset in the document of a node of the traversed tree
    FeatureReader(xml::NameScope& scope, Part& part, std::function<std::uint64_t(pugi::xml_node)> offsetOf);

    /// Reads a child of the root: cityObjectMember, featureMembers, appearanceMember, gml:name, ...
    /// \param continues  its first object continues the last one of the previous part
    void readMember(const xml::Element& member, bool continues);

private:
    void readTopLevel(const xml::Element& object, bool continues);
    model::FeatureIndex readFeature(const xml::Element& element, model::FeatureIndex parent, bool continues);
    void readProperty(model::FeatureIndex feature, const xml::Element& property);
    void readGmlProperty(model::FeatureIndex feature, const xml::Element& property);
    void readGenericAttribute(model::FeatureIndex feature, const xml::Element& element);
    void numberRecord(model::FeatureIndex feature, std::string_view property, std::size_t first);
    void readPlainProperty(model::FeatureIndex feature, const xml::Element& property);
    void readObject(model::FeatureIndex feature, const xml::Element& property, const xml::Element& object);
    void readGroupRole(model::FeatureIndex feature, const xml::Element& role);
    void readEnvelope(const xml::Element& boundedBy);
    void readAppearance(const xml::Element& element, bool continues);
    void readMaterial(const xml::Element& element, MaterialRecord record);
    void readId(const xml::Element& element, model::Feature& feature);
    void addLink(model::FeatureIndex feature, const xml::Element& property, std::string_view href, std::string role);
    void addMembership(model::FeatureIndex group, model::FeatureIndex member, std::string role);
    void reportValue(model::FeatureIndex feature, const xml::Element& property);
    [[nodiscard]] bool isFeature(const xml::Element& element);

    xml::NameScope& scope_;
    Part& part_;
    std::function<std::uint64_t(pugi::xml_node)> offsetOf_;
    gml::GeometryReader geometryReader_;
    std::string scratch_;
    /// The number of the next record of a property with parts, such as an address.
    std::map<std::pair<model::FeatureIndex, std::string>, std::uint32_t> nextRecords_;
};

/// 2 for "lod2MultiSurface"; -1 if the name states no level.
[[nodiscard]] double lodOfProperty(std::string_view name) noexcept;

}  // namespace svt::readers::citygml
