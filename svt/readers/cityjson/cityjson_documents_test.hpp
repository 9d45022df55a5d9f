#pragma once
/// \file
/// Small CityJSON documents for tests, and functions to read them.

#include <svt/readers/cityjson/cityjson_reader.hpp>

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace svt::readers::test {

using model::BuildingModel;
using model::Feature;
using model::GeometryKind;

inline std::span<const std::byte> bytesOf(std::string_view text) {
    return {reinterpret_cast<const std::byte*>(text.data()), text.size()};
}

struct Reading {
    Result<BuildingModel> result;
    Diagnostics diagnostics;

    const BuildingModel& model() const { return *result; }
};

inline Reading read(std::string_view text, const ReadOptions& options = {}) {
    Reading reading{Error(), {}};
    reading.result = readCityJson(bytesOf(text), "test.city.json", options, &reading.diagnostics);
    return reading;
}

/// The eight corners of a unit cube as integers; corner i has the bits (z y x) of i.
constexpr std::string_view kCubeVertices = "[[0,0,0],[1,0,0],[0,1,0],[1,1,0],[0,0,1],[1,0,1],[0,1,1],[1,1,1]]";
constexpr std::string_view kCubeShell = "[[[0,2,3,1]],[[4,5,7,6]],[[0,1,5,4]],[[2,6,7,3]],[[0,4,6,2]],[[1,3,7,5]]]";

/// A document with the given CityObjects, followed by further root members.
inline std::string document(std::string_view objects, std::string_view more = "", std::string_view version = "2.0") {
    std::string text = R"({"type":"CityJSON","version":")";
    text.append(version).append(R"(","transform":{"scale":[0.5,0.5,0.5],"translate":[1000,2000,3000]},"CityObjects":)");
    text.append(objects).append(R"(,"vertices":)").append(kCubeVertices).append(more).append("}");
    return text;
}

/// A document with one Building "b" that has these geometries.
inline std::string withGeometry(std::string_view geometries, std::string_view more = "") {
    return document(R"({"b":{"type":"Building","geometry":[)" + std::string(geometries) + "]}}", more);
}

inline std::string cube(std::string_view more = "") {
    return R"({"type":"Solid","lod":"2.2","boundaries":[)" + std::string(kCubeShell) + "]" + std::string(more) + "}";
}

inline const Feature* find(const BuildingModel& model, std::string_view id) {
    for (const Feature& feature : model.features)
        if (feature.id == id) return &feature;
    return nullptr;
}

inline std::string attribute(const Feature& feature, std::string_view name) {
    for (const Attribute& candidate : feature.attributes)
        if (candidate.name == name) return toText(candidate.value) + candidate.unit;
    return "(absent)";
}

inline std::string readFile(const std::filesystem::path& path) {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

/// A header line with a material and a template, and two features on lines 2 and 4.
inline std::string sequence() {
    return R"({"type":"CityJSON","version":"2.0","transform":{"scale":[0.5,0.5,0.5],"translate":[1000,2000,3000]},"CityObjects":{},"vertices":[],)"
           R"("appearance":{"materials":[{"name":"stone"}]},)"
           R"("geometry-templates":{"templates":[{"type":"MultiSurface","lod":"1","boundaries":[[[0,1,2]]],"material":{"t":{"value":0}}}],"vertices-templates":[[0,0,0],[1,0,0],[0,0.25,3]]}})"
           "\n"
           R"({"type":"CityJSONFeature","id":"a","CityObjects":{"a":{"type":"Building","children":["a1"],"geometry":[{"type":"MultiSurface","lod":"2","boundaries":[[[0,1,2]]],"material":{"t":{"value":0}}}]},)"
           R"("a1":{"type":"BuildingPart","parents":["a"]}},"vertices":[[0,0,0],[2,0,0],[0,2,0]]})"
           "\r\n\n"
           R"({"type":"CityJSONFeature","id":"b","CityObjects":{"b":{"type":"Building","geometry":[{"type":"MultiSurface","lod":"2","boundaries":[[[0,1,2]]],"material":{"t":{"value":1}}},)"
           R"({"type":"GeometryInstance","template":0,"boundaries":[2]}]}},"vertices":[[4,0,0],[6,0,0],[4,2,0]],)"
           R"("appearance":{"materials":[{"name":"wood"},{"name":"glass"}]}})"
           "\n";
}

}  // namespace svt::readers::test
