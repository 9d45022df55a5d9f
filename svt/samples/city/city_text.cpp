#include <svt/samples/city/city_text.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace svt::samples::city {
namespace {

constexpr double kSurveyFoot = 1200.0 / 3937.0;

std::string_view elementOf(FaceKind kind) {
    switch (kind) {
        case FaceKind::Ground: return "GroundSurface";
        case FaceKind::Roof: return "RoofSurface";
        case FaceKind::Window: return "Window";
        case FaceKind::Ceiling: return "CeilingSurface";
        case FaceKind::Floor: return "FloorSurface";
        case FaceKind::InteriorWall: return "InteriorWallSurface";
        case FaceKind::Wall: break;
    }
    return "WallSurface";
}

// The version of CityGML. New York's twenty files are of two versions.
std::string_view versionOf(CityProfile profile, int file) {
    return profile == CityProfile::Berlin || (profile == CityProfile::NewYork && file % 2 == 0) ? "1.0" : "2.0";
}

std::string heightText(const Building& building) {
    return building.heightText.empty() ? fixedText(building.heightMillimetres, 3) : std::string(building.heightText);
}

}  // namespace

Point mapPoint(CityProfile profile, Point point) {
    // 17 degrees.
    constexpr double kCosine = 0.956304756, kSine = 0.292371705;
    const double x = kCosine * double(point.x) - kSine * double(point.y),
                 y = kSine * double(point.x) + kCosine * double(point.y);
    switch (profile) {
        case CityProfile::Dutch: return {std::llround(x) + 85'000'000, std::llround(y) + 446'000'000, point.z};
        case CityProfile::Berlin: return {std::llround(x) + 385'000'000, std::llround(y) + 5'812'000'000, point.z};
        case CityProfile::NewYork:
            return {std::llround(x / kSurveyFoot) + 980'000'000, std::llround(y / kSurveyFoot) + 195'000'000,
                    std::llround(double(point.z) / kSurveyFoot)};
        case CityProfile::Plateau: break;
    }
    constexpr double kMillimetresPerDegreeNorth = 110'950'000, kMillimetresPerDegreeEast = 90'600'000;
    return {139'500'000'000 + std::llround(x / kMillimetresPerDegreeEast * 1e9),
            35'500'000'000 + std::llround(y / kMillimetresPerDegreeNorth * 1e9), point.z};
}

CityText::CityText(const CitySampleOptions& options, int file, const SampleSink& sink)
    : options_(options), sink_(sink), gml_(sink_, versionOf(options.profile, file), true) {
    if (options.profile == CityProfile::Dutch)
        jsonHead();
    else
        gmlHead();
}

void CityText::write(const Building& building) {
    if (options_.profile == CityProfile::Dutch)
        jsonBuilding(building);
    else
        gmlBuilding(building);
}

void CityText::finish() {
    if (options_.profile != CityProfile::Dutch) sink_ << "</core:CityModel>\n";
    sink_.flush();
}

void CityText::gmlHead() {
    const std::string_view crs = options_.profile == CityProfile::Berlin ? "EPSG:25833"
                                 : options_.profile == CityProfile::NewYork
                                     ? "urn:ogc:def:crs,crs:EPSG::2263,crs:EPSG::6360"
                                     : "http://www.opengis.net/def/crs/EPSG/0/6697";
    const Layout layout = Layout::of(options_);
    gml_.head({"bldg", "gen"});
    gml_.envelope(crs, [&](bool isUpper) {
        coordinates(isUpper ? Point{layout.columns * 105'000, layout.rows * 63'000, 400'000} : Point{});
    });
}

void CityText::coordinates(const Point& point) {
    const Point map = mapPoint(options_.profile, point);
    if (options_.profile == CityProfile::Plateau)
        sink_.fixed(map.y, 9) << " ", sink_.fixed(map.x, 9) << " ", sink_.fixed(map.z, 3);
    else
        sink_.fixed(map.x, 3) << " ", sink_.fixed(map.y, 3) << " ", sink_.fixed(map.z, 3);
}

void CityText::gmlMember(const Face& face, const std::string& id) {
    gml_.member(id, face.rings, [&](const Point& point) { coordinates(point); });
}

void CityText::gmlSurface(const Face& face, const std::string& id, int lod) {
    const bool isWindow = face.kind == FaceKind::Window;
    const GmlElement property(sink_, isWindow ? "bldg:opening" : "bldg:boundedBy", {}, "\n");
    const GmlElement surface(sink_, fmt::format("bldg:{}", elementOf(face.kind)), id);
    gml_.multiSurface(fmt::format("bldg:lod{}MultiSurface", lod), "", [&] { gmlMember(face, id + "_P"); });
}

// A solid that refers to the polygons of its faces.
void CityText::gmlLinkedSolid(const std::string& property, const Body& body, const std::string& id) {
    const GmlElement element(sink_, property, {}, "\n");
    gml_.solid(id + "_S", [&] {
        for (std::size_t f = 0; f < body.faces.size(); ++f) gml_.memberLink(fmt::format("{}_{}_P", id, f));
    });
}

// A window is an opening of the wall before it; here each wall with its windows is one surface.
void CityText::gmlBody(const Body& body, const std::string& id, const Building& building) {
    const auto faceId = [&](std::size_t f) { return fmt::format("{}_{}", id, f); };
    if (building.lod == 1) {
        const GmlElement element(sink_, "bldg:lod1Solid", {}, "\n");
        gml_.solid(id + "_S", [&] {
            for (std::size_t f = 0; f < body.faces.size(); ++f) gmlMember(body.faces[f], faceId(f));
        });
        return;
    }
    if (options_.profile != CityProfile::NewYork)
        gmlLinkedSolid(fmt::format("bldg:lod{}Solid", building.lod), body, id);
    std::vector<std::size_t> windows;
    for (std::size_t f = 0; f < body.faces.size(); ++f) {
        if (body.faces[f].kind == FaceKind::Window)
            windows.push_back(f);
        else
            gmlSurface(body.faces[f], faceId(f), building.lod);
    }
    if (windows.empty()) return;
    // They belong to one wall surface without geometry of its own, which both versions allow.
    const GmlElement property(sink_, "bldg:boundedBy", {}, "\n"), wall(sink_, "bldg:WallSurface", id + "_W");
    for (const std::size_t f : windows) gmlSurface(body.faces[f], faceId(f), building.lod);
}

void CityText::gmlRoom(const Body& room, const std::string& id) {
    const GmlElement property(sink_, "bldg:interiorRoom", {}, "\n"), element(sink_, "bldg:Room", id);
    gmlLinkedSolid("bldg:lod4Solid", room, id);
    for (std::size_t f = 0; f < room.faces.size(); ++f) gmlSurface(room.faces[f], fmt::format("{}_{}", id, f), 4);
}

void CityText::gmlBuilding(const Building& building) {
    const std::string id = fmt::format("BLDG_{:08x}{:08x}", static_cast<std::uint32_t>(options_.seed), building.number);
    const GmlElement member(sink_, "core:cityObjectMember", {}, "\n"), element(sink_, "bldg:Building", id);
    // In version 1 and 2 what comes first differs: attributes of generics before those of buildings.
    gml_.genericAttribute({"Gemeindeschluessel", std::string("11000001"), ""});
    gml_.text("bldg:function", "31001_1000").text("bldg:roofType", building.roof);
    sink_ << "<bldg:measuredHeight uom=\"m\">" << heightText(building) << "</bldg:measuredHeight>";
    gml_.text("bldg:storeysAboveGround", std::to_string(building.storeys));
    sink_ << "\n";
    gmlBody(building.bodies.front(), id + "_0", building);
    for (std::size_t b = 1; b < building.bodies.size(); ++b)
        if (building.bodies[b].isRoom) gmlRoom(building.bodies[b], fmt::format("{}_{}", id, b));
    for (std::size_t b = 1; b < building.bodies.size(); ++b) {
        if (building.bodies[b].isRoom) continue;
        const std::string partId = fmt::format("{}_{}", id, b);
        const GmlElement property(sink_, "bldg:consistsOfBuildingPart", {}, "\n");
        const GmlElement part(sink_, "bldg:BuildingPart", partId);
        gmlBody(building.bodies[b], partId, building);
    }
}

// ---------------------------------------------------------------------------------------------------------------------

void CityText::jsonHead() {
    sink_
        << R"({"type":"CityJSON","version":"2.0","transform":{"scale":[0.001,0.001,0.001],"translate":[85000.0,446000.0,0.0]},)"
        << R"("metadata":{"referenceSystem":"https://www.opengis.net/def/crs/EPSG/0/7415"},"CityObjects":{},"vertices":[]})"
        << "\n";
}

namespace {

// Vertices of a feature, each once.
class Vertices {
public:
    int of(Point map) {
        const Point local{map.x - 85'000'000, map.y - 446'000'000, map.z};
        const auto [entry, isNew] = numbers_.emplace(local, static_cast<int>(all_.size()));
        if (isNew) all_.push_back(local);
        return entry->second;
    }
    [[nodiscard]] const std::vector<Point>& all() const { return all_; }

private:
    std::map<Point, int> numbers_;
    std::vector<Point> all_;
};

// "[a,b]" of the texts of all items.
template <class Items, class Text>
std::string listJson(const Items& items, const Text& text) {
    std::string list;
    for (const auto& item : items) list += (list.empty() ? "[" : ",") + text(item);
    return list + "]";
}

std::string solidJson(const Body& body, std::string_view lod, Vertices& vertices, bool hasSemantics) {
    const std::string shell = listJson(body.faces, [&](const Face& face) {
        return listJson(face.rings, [&](const Ring& ring) {
            return listJson(ring,
                            [&](Point p) { return std::to_string(vertices.of(mapPoint(CityProfile::Dutch, p))); });
        });
    });
    std::string text = fmt::format(R"({{"type":"Solid","lod":"{}","boundaries":[{}])", lod, shell);
    if (hasSemantics)
        text += fmt::format(
            R"(,"semantics":{{"surfaces":[{{"type":"GroundSurface"}},{{"type":"RoofSurface"}},{{"type":"WallSurface"}},{{"type":"Window"}}],"values":[{}]}})",
            listJson(body.faces, [](const Face& face) -> std::string {
                return face.kind == FaceKind::Ground || face.kind == FaceKind::Floor   ? "0"
                       : face.kind == FaceKind::Roof || face.kind == FaceKind::Ceiling ? "1"
                       : face.kind == FaceKind::Window                                 ? "3"
                                                                                       : "2";
            }));
    return text + "}";
}

// The hull as level 1.2 has it: the box around the plan, up to the height.
Body blockOf(const Body& body) {
    Point low = body.faces.front().rings.front().front(), high = low;
    for (const Face& face : body.faces)
        for (const Point& p : face.rings.front()) {
            low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
            high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
        }
    return box(low, high);
}

}  // namespace

void CityText::jsonBuilding(const Building& building) {
    const std::string id = fmt::format("NL.IMBAG.Pand.{:06}{:010}", options_.seed % 1'000'000, building.number);
    Vertices vertices;
    std::string objects, children;
    for (std::size_t b = 0; b < building.bodies.size(); ++b) {
        const Body& body = building.bodies[b];
        const std::string part = fmt::format("{}-{}", id, b);
        children += fmt::format("{}\"{}\"", children.empty() ? "" : ",", part);
        std::string geometry;
        if (!body.isRoom) geometry = solidJson(blockOf(body), "1.2", vertices, false);
        if (building.lod != 1)
            geometry +=
                (geometry.empty() ? "" : ",") + solidJson(body, building.lod == 2 ? "2.2" : "3.0", vertices, true);
        objects += fmt::format(R"(,"{}":{{"type":"{}","parents":["{}"],"geometry":[{}]}})", part,
                               body.isRoom ? "BuildingRoom" : "BuildingPart", id, geometry);
    }
    sink_ << fmt::format(
        R"({{"type":"CityJSONFeature","id":"{0}","CityObjects":{{"{0}":{{"type":"Building","attributes":{{)"
        R"("identificatie":"{0}","b3_h_dak_max":{1},"b3_bouwlagen":{2},"b3_dak_type":"{3}"}},"children":[{4}]}}{5}}},"vertices":{6}}})"
        "\n",
        id, heightText(building), building.storeys, building.roof == "1030" ? "slanted" : "horizontal", children,
        objects, listJson(vertices.all(), [](Point p) { return fmt::format("[{},{},{}]", p.x, p.y, p.z); }));
}

}  // namespace svt::samples::city
