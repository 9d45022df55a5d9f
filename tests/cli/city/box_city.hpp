#pragma once
/// \file
/// Cities of boxes as text of CityJSONSeq, with known answers.

#include <fmt/format.h>

#include <string>
#include <utility>
#include <vector>

namespace svt::test {

/// A building of 20 x 20 m.
struct BoxBuilding {
    std::string id;
    int east = 0, north = 0;  ///< of its south-western corner, metres
    int height = 10;          ///< metres above 0
    std::string attributes{};
};

/// The buildings as features. \param crs  address of the reference system; empty: none
inline std::string boxCity(const std::string& crs, const std::vector<BoxBuilding>& buildings) {
    std::string text = R"({"type":"CityJSON","version":"2.0","transform":{"scale":[1,1,1],"translate":[0,0,0]},)" +
                       (crs.empty() ? std::string() : R"("metadata":{"referenceSystem":")" + crs + R"("},)") +
                       R"("CityObjects":{},"vertices":[]})" + "\n";
    for (const BoxBuilding& building : buildings) {
        std::string corners;
        for (const int z : {0, building.height})
            for (const auto& [i, j] : {std::pair{0, 0}, {20, 0}, {20, 20}, {0, 20}})
                corners +=
                    fmt::format("{}[{},{},{}]", corners.empty() ? "" : ",", building.east + i, building.north + j, z);
        text +=
            fmt::format(R"({{"type":"CityJSONFeature","id":"{0}","CityObjects":{{"{0}":{{"type":"Building",{1})"
                        R"("geometry":[{{"type":"Solid","lod":"1","boundaries":[[[[0,3,2,1]],[[4,5,6,7]],[[0,1,5,4]],)"
                        R"([[1,2,6,5]],[[2,3,7,6]],[[3,0,4,7]]]]}}]}}}},"vertices":[{2}]}})",
                        building.id, building.attributes, corners);
        text += "\n";
    }
    return text;
}

}  // namespace svt::test
