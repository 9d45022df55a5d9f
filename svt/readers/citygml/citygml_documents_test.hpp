#pragma once
/// \file
/// Small CityGML documents for tests, and functions to read them.

#include <svt/readers/citygml/citygml_reader.hpp>
#include <svt/readers/read_model.hpp>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <string_view>

namespace svt::readers::gmltest {

using model::BuildingModel;
using model::Feature;
using model::Geometry;
using model::GeometryKind;

inline std::span<const std::byte> bytesOf(std::string_view text) {
    return {reinterpret_cast<const std::byte*>(text.data()), text.size()};
}

struct Reading {
    Result<BuildingModel> result{Error()};
    Diagnostics diagnostics;

    const BuildingModel& model() const { return *result; }
    Code code() const { return result ? Code::Internal : result.error().code(); }
    std::size_t count(Code code) const { return diagnostics.count(code); }
    /// The feature with that id, or an empty one.
    const Feature& feature(std::string_view id) const {
        static const Feature kNothing;
        for (const Feature& feature : model().features)
            if (feature.id == id) return feature;
        ADD_FAILURE() << "no feature '" << id << "'";
        return kNothing;
    }
    model::FeatureIndex index(std::string_view id) const {
        return static_cast<model::FeatureIndex>(&feature(id) - model().features.data());
    }
    /// All findings as text, for test messages.
    std::string findings() const {
        std::string text;
        for (const Diagnostic& item : diagnostics.items()) text += item.toString() + "\n";
        return text;
    }
    const Diagnostic* first(Code code) const {
        for (const Diagnostic& item : diagnostics.items())
            if (item.code == code) return &item;
        return nullptr;
    }
};

inline Reading read(std::string_view text, const ReadOptions& options = {}) {
    Reading reading;
    reading.result = readCityGml(bytesOf(text), "test.gml", options, &reading.diagnostics);
    return reading;
}

/// A CityModel of version 1, 2 or 3 around `members`; its tags are on lines 1 and 2, the members start on line 3.
inline std::string cityModel(int version, std::string_view members) {
    const std::string gml = version == 3 ? "http://www.opengis.net/gml/3.2" : "http://www.opengis.net/gml";
    std::string text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<core:CityModel xmlns:gml=\"" + gml +
                       "\" xmlns:xlink=\"http://www.w3.org/1999/xlink\" xmlns:ce=\"http://www.opengis.net/gml/3.3/ce\"";
    text += fmt::format(" xmlns:core=\"http://www.opengis.net/citygml/{}.0\"", version);
    const std::pair<std::string_view, std::string_view> modules[] = {
        {"bldg", "building"},       {"con", "construction"},  {"app", "appearance"}, {"gen", "generics"},
        {"grp", "cityobjectgroup"}, {"frn", "cityfurniture"}, {"dem", "relief"},     {"brid", "bridge"},
        {"tun", "tunnel"},          {"veg", "vegetation"},    {"luse", "landuse"},   {"tran", "transportation"},
        {"wtr", "waterbody"}};
    for (const auto& [prefix, module] : modules)
        text += fmt::format(" xmlns:{}=\"http://www.opengis.net/citygml/{}/{}.0\"", prefix, module, version);
    text += fmt::format(" xmlns:ade=\"http://example.org/ade\">\n{}\n</core:CityModel>\n", members);
    return text;
}

inline Reading readMembers(int version, std::string_view members) { return read(cityModel(version, members)); }

inline std::string member(std::string_view object) {
    return fmt::format("<core:cityObjectMember>{}</core:cityObjectMember>", object);
}

/// A cityObjectMember with building `id` and `properties`.
inline std::string building(std::string_view id, std::string_view properties) {
    return member(fmt::format("<bldg:Building gml:id=\"{}\">{}</bldg:Building>", id, properties));
}

inline std::string ring(std::string_view positions) {
    return fmt::format("<gml:LinearRing><gml:posList>{}</gml:posList></gml:LinearRing>", positions);
}

/// A unit square at height z, optionally with an id.
inline std::string square(std::string_view id, double z = 0) {
    const std::string attribute = id.empty() ? "" : fmt::format(" gml:id=\"{}\"", id);
    return fmt::format("<gml:Polygon{}><gml:exterior>{}</gml:exterior></gml:Polygon>", attribute,
                       ring(fmt::format("0 0 {0} 1 0 {0} 1 1 {0} 0 1 {0} 0 0 {0}", z)));
}

inline std::string surfaceMember(std::string_view surface) {
    return fmt::format("<gml:surfaceMember>{}</gml:surfaceMember>", surface);
}
inline std::string surfaceReference(std::string_view href) {
    return fmt::format("<gml:surfaceMember xlink:href=\"{}\"/>", href);
}
inline std::string multiSurface(std::string_view members) {
    return fmt::format("<gml:MultiSurface>{}</gml:MultiSurface>", members);
}
/// A GML 3.1 solid whose exterior holds `members`.
inline std::string solid(std::string_view id, std::string_view members) {
    const std::string attribute = id.empty() ? "" : fmt::format(" gml:id=\"{}\"", id);
    return fmt::format(
        "<gml:Solid{}><gml:exterior><gml:CompositeSurface>{}</gml:CompositeSurface></gml:exterior></gml:Solid>",
        attribute, members);
}

/// The lod2MultiSurface property of the version: in the core namespace for 3.0.
inline std::string lod2Surfaces(int version, std::string_view geometry) {
    const std::string_view prefix = version == 3 ? "core" : "bldg";
    return fmt::format("<{0}:lod2MultiSurface>{1}</{0}:lod2MultiSurface>", prefix, geometry);
}

}  // namespace svt::readers::gmltest
