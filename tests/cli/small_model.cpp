#include "small_model.hpp"

#include <fmt/format.h>

namespace svt::test {

std::vector<Face> boxFaces(double x0, double y0, double z0, double x1, double y1, double z1) {
    const double xs[] = {x0, x1}, ys[] = {y0, y1}, zs[] = {z0, z1};
    // Bits 0, 1, 2 of a corner select x, y, z.
    constexpr int kCorners[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {1, 3, 7, 5}, {3, 2, 6, 7}, {2, 0, 4, 6}};
    std::vector<Face> faces;
    for (const auto& corners : kCorners) {
        Face face;
        for (int c = 0; c < 5; ++c) {
            const int corner = corners[c % 4];
            face +=
                fmt::format("{}{} {} {}", c == 0 ? "" : " ", xs[corner & 1], ys[(corner >> 1) & 1], zs[corner >> 2]);
        }
        faces.push_back(face);
    }
    return faces;
}

std::string solid(const std::vector<Face>& faces) {
    std::string text = "<gml:Solid><gml:exterior><gml:CompositeSurface>";
    for (const Face& face : faces)
        text += fmt::format(
            "\n<gml:surfaceMember><gml:Polygon><gml:exterior><gml:LinearRing><gml:posList>{}</gml:posList>"
            "</gml:LinearRing></gml:exterior></gml:Polygon></gml:surfaceMember>",
            face);
    return text + "\n</gml:CompositeSurface></gml:exterior></gml:Solid>";
}

std::string building(std::string_view id, std::string_view solidText, std::string_view inside) {
    const std::string name = id.empty() ? "" : fmt::format(" gml:id=\"{}\"", id);
    return fmt::format(
        "<cityObjectMember>\n<bldg:Building{}>{}\n<bldg:lod2Solid>{}</bldg:lod2Solid>\n</bldg:Building>\n</"
        "cityObjectMember>\n",
        name, inside, solidText);
}

std::string cityModel(std::string_view members, std::string_view srsName) {
    return fmt::format(R"(<?xml version="1.0" encoding="UTF-8"?>
<CityModel xmlns="http://www.opengis.net/citygml/2.0" xmlns:bldg="http://www.opengis.net/citygml/building/2.0"
 xmlns:grp="http://www.opengis.net/citygml/cityobjectgroup/2.0" xmlns:gml="http://www.opengis.net/gml" xmlns:xlink="http://www.w3.org/1999/xlink">
<gml:boundedBy><gml:Envelope srsName="{}" srsDimension="3"><gml:lowerCorner>500000 5400000 100</gml:lowerCorner><gml:upperCorner>500020 5400020 110</gml:upperCorner></gml:Envelope></gml:boundedBy>
{}</CityModel>
)",
                       srsName, members);
}

std::string twoBoxes() {
    return cityModel(building("left", solid(boxFaces(500000, 5400000, 100, 500004, 5400006, 103))) +
                     building("right", solid(boxFaces(500004, 5400000, 100, 500008, 5400006, 103))));
}

std::string cityJson(std::string_view geometry, std::string_view vertices, std::string_view version,
                     std::string_view transform) {
    if (geometry.empty())
        geometry =
            R"([{"type":"Solid","lod":"2","boundaries":[[[[0,3,2,1]],[[4,5,6,7]],[[0,1,5,4]],[[1,2,6,5]],[[2,3,7,6]],[[3,0,4,7]]]]}])";
    if (vertices.empty())
        vertices =
            "[[0,0,0],[4000,0,0],[4000,6000,0],[0,6000,0],[0,0,3000],[4000,0,3000],[4000,6000,3000],[0,6000,3000]]";
    return fmt::format(
        "{{\"type\":\"CityJSON\",\"version\":\"{}\",\"transform\":{},\n\"metadata\":{{\"referenceSystem\":"
        "\"https://www.opengis.net/def/crs/EPSG/0/"
        "25832\"}},\n\"CityObjects\":{{\"b\":{{\"type\":\"Building\",\"geometry\":{}}}}},\n\"vertices\":{}}}\n",
        version, transform, geometry, vertices);
}

}  // namespace svt::test
