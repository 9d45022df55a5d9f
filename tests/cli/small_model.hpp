#pragma once
/// \file
/// Small CityGML and CityJSON documents for tests: boxes, and faces that a test can break one at a time.

#include <string>
#include <string_view>
#include <vector>

namespace svt::test {

/// The corners of a face as text of a gml:posList, closed or not as required by the test.
using Face = std::string;

/// The six faces of a box, outward, each closed: bottom, top, south, east, north, west.
[[nodiscard]] std::vector<Face> boxFaces(double x0, double y0, double z0, double x1, double y1, double z1);

/// A gml:Solid with the given faces.
[[nodiscard]] std::string solid(const std::vector<Face>& faces);

/// `<bldg:Building gml:id=id>` with a lod2Solid; `id` empty: without gml:id.
[[nodiscard]] std::string building(std::string_view id, std::string_view solidText, std::string_view inside = {});

/// A CityGML 2.0 document with the given members and EPSG:25832 in its envelope.
[[nodiscard]] std::string cityModel(std::string_view members, std::string_view srsName = "urn:ogc:def:crs:EPSG::25832");

/// Two buildings `left` and `right` of 4 x 6 x 3 m (72 m3 each), side by side.
[[nodiscard]] std::string twoBoxes();

/// A CityJSON 2.0 document with one building `b` of 4 x 6 x 3 m. `geometry` and `vertices`, if not empty, replace those
/// of the box.
[[nodiscard]] std::string cityJson(
    std::string_view geometry = {}, std::string_view vertices = {}, std::string_view version = "2.0",
    std::string_view transform = R"({"scale":[0.001,0.001,0.001],"translate":[500000,5400000,100]})");

}  // namespace svt::test
