#include <svt/samples/city/city_text.hpp>

#include <fmt/format.h>

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
    : options_(options), sink_(sink) {
    // New York's twenty files are of two versions.
    isVersion1_ = options.profile == CityProfile::Berlin || (options.profile == CityProfile::NewYork && file % 2 == 0);
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
    const std::string_view version = isVersion1_ ? "1.0" : "2.0";
    const std::string_view crs = options_.profile == CityProfile::Berlin ? "EPSG:25833"
                                 : options_.profile == CityProfile::NewYork
                                     ? "urn:ogc:def:crs,crs:EPSG::2263,crs:EPSG::6360"
                                     : "http://www.opengis.net/def/crs/EPSG/0/6697";
    const Layout layout = Layout::of(options_);
    const Point low = mapPoint(options_.profile, {0, 0, 0});
    sink_ << "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<core:CityModel xmlns:core=\"http://www.opengis.net/citygml/"
          << version << "\" xmlns:bldg=\"http://www.opengis.net/citygml/building/" << version
          << "\" xmlns:gen=\"http://www.opengis.net/citygml/generics/" << version
          << "\" xmlns:gml=\"http://www.opengis.net/gml\" xmlns:xlink=\"http://www.w3.org/1999/xlink\">\n"
          << "<gml:boundedBy><gml:Envelope srsName=\"" << crs << "\" srsDimension=\"3\"><gml:lowerCorner>";
    coordinates(low);
    sink_ << "</gml:lowerCorner><gml:upperCorner>";
    coordinates(mapPoint(options_.profile, {layout.columns * 105'000, layout.rows * 63'000, 400'000}));
    sink_ << "</gml:upperCorner></gml:Envelope></gml:boundedBy>\n";
}

void CityText::coordinates(Point map) {
    if (options_.profile == CityProfile::Plateau)
        sink_.fixed(map.y, 9) << " ", sink_.fixed(map.x, 9) << " ", sink_.fixed(map.z, 3);
    else
        sink_.fixed(map.x, 3) << " ", sink_.fixed(map.y, 3) << " ", sink_.fixed(map.z, 3);
}

void CityText::gmlRing(const Ring& ring) {
    sink_ << "<gml:LinearRing><gml:posList srsDimension=\"3\">";
    for (std::size_t i = 0; i <= ring.size(); ++i) {
        if (i != 0) sink_ << " ";
        coordinates(mapPoint(options_.profile, ring[i % ring.size()]));
    }
    sink_ << "</gml:posList></gml:LinearRing>";
}

void CityText::gmlPolygon(const Face& face, const std::string& id) {
    sink_ << "<gml:surfaceMember><gml:Polygon gml:id=\"" << id << "\"><gml:exterior>";
    gmlRing(face.exterior);
    sink_ << "</gml:exterior>";
    for (const Ring& hole : face.holes) {
        sink_ << "<gml:interior>";
        gmlRing(hole);
        sink_ << "</gml:interior>";
    }
    sink_ << "</gml:Polygon></gml:surfaceMember>";
}

void CityText::gmlSurface(const Face& face, const std::string& id, int lod) {
    const std::string_view element = elementOf(face.kind);
    sink_ << "<bldg:boundedBy><bldg:" << element << " gml:id=\"" << id << "\"><bldg:lod" << lod
          << "MultiSurface><gml:MultiSurface>";
    gmlPolygon(face, id + "_P");
    sink_ << "</gml:MultiSurface></bldg:lod" << lod << "MultiSurface></bldg:" << element << "></bldg:boundedBy>\n";
}

// A window is an opening of the wall before it; here each wall with its windows is one surface.
void CityText::gmlBody(const Body& body, const std::string& id, const Building& building) {
    const bool hasSolid = options_.profile != CityProfile::NewYork && building.lod != 1;
    if (hasSolid || building.lod == 1) {
        sink_ << "<bldg:lod" << building.lod << "Solid><gml:Solid gml:id=\"" << id
              << "_S\"><gml:exterior><gml:CompositeSurface>";
        for (std::size_t f = 0; f < body.faces.size(); ++f) {
            const std::string face = fmt::format("{}_{}", id, f);
            if (hasSolid)
                sink_ << "<gml:surfaceMember xlink:href=\"#" << face << "_P\"/>";
            else
                gmlPolygon(body.faces[f], face);
        }
        sink_ << "</gml:CompositeSurface></gml:exterior></gml:Solid></bldg:lod" << building.lod << "Solid>\n";
    }
    if (building.lod == 1) return;
    std::vector<std::size_t> windows;
    for (std::size_t f = 0; f < body.faces.size(); ++f) {
        if (body.faces[f].kind == FaceKind::Window)
            windows.push_back(f);
        else
            gmlSurface(body.faces[f], fmt::format("{}_{}", id, f), building.lod);
    }
    if (windows.empty()) return;
    // They hang on one wall surface without geometry of its own, which both versions allow.
    sink_ << "<bldg:boundedBy><bldg:WallSurface gml:id=\"" << id << "_W\">";
    for (const std::size_t f : windows) {
        const std::string face = fmt::format("{}_{}", id, f);
        sink_ << "<bldg:opening><bldg:Window gml:id=\"" << face << "\"><bldg:lod" << building.lod
              << "MultiSurface><gml:MultiSurface>";
        gmlPolygon(body.faces[f], face + "_P");
        sink_ << "</gml:MultiSurface></bldg:lod" << building.lod << "MultiSurface></bldg:Window></bldg:opening>\n";
    }
    sink_ << "</bldg:WallSurface></bldg:boundedBy>\n";
}

void CityText::gmlRoom(const Body& room, const std::string& id) {
    sink_ << "<bldg:interiorRoom><bldg:Room gml:id=\"" << id << "\"><bldg:lod4Solid><gml:Solid gml:id=\"" << id
          << "_S\"><gml:exterior><gml:CompositeSurface>";
    for (std::size_t f = 0; f < room.faces.size(); ++f)
        sink_ << "<gml:surfaceMember xlink:href=\"#" << id << "_" << int(f) << "_P\"/>";
    sink_ << "</gml:CompositeSurface></gml:exterior></gml:Solid></bldg:lod4Solid>\n";
    for (std::size_t f = 0; f < room.faces.size(); ++f) gmlSurface(room.faces[f], fmt::format("{}_{}", id, f), 4);
    sink_ << "</bldg:Room></bldg:interiorRoom>\n";
}

void CityText::gmlBuilding(const Building& building) {
    const std::string id = fmt::format("BLDG_{:08x}{:08x}", static_cast<std::uint32_t>(options_.seed), building.number);
    sink_ << "<core:cityObjectMember><bldg:Building gml:id=\"" << id << "\">";
    // In version 1 and 2 what comes first differs: attributes of generics before those of buildings.
    sink_ << "<gen:stringAttribute name=\"Gemeindeschluessel\"><gen:value>11000001</gen:value></gen:stringAttribute>"
          << "<bldg:function>31001_1000</bldg:function><bldg:roofType>" << building.roof
          << "</bldg:roofType><bldg:measuredHeight uom=\"m\">" << heightText(building)
          << "</bldg:measuredHeight><bldg:storeysAboveGround>" << building.storeys << "</bldg:storeysAboveGround>\n";
    gmlBody(building.bodies.front(), id + "_0", building);
    std::string parts;
    for (std::size_t b = 1; b < building.bodies.size(); ++b)
        if (building.bodies[b].isRoom) gmlRoom(building.bodies[b], fmt::format("{}_{}", id, b));
    for (std::size_t b = 1; b < building.bodies.size(); ++b) {
        if (building.bodies[b].isRoom) continue;
        const std::string part = fmt::format("{}_{}", id, b);
        sink_ << "<bldg:consistsOfBuildingPart><bldg:BuildingPart gml:id=\"" << part << "\">";
        gmlBody(building.bodies[b], part, building);
        sink_ << "</bldg:BuildingPart></bldg:consistsOfBuildingPart>\n";
    }
    sink_ << "</bldg:Building></core:cityObjectMember>\n";
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

std::string ringJson(const Ring& ring, Vertices& vertices) {
    std::string text = "[";
    for (std::size_t i = 0; i < ring.size(); ++i) {
        if (i != 0) text += ',';
        text += std::to_string(vertices.of(mapPoint(CityProfile::Dutch, ring[i])));
    }
    return text + "]";
}

std::string solidJson(const Body& body, std::string_view lod, Vertices& vertices, bool hasSemantics) {
    std::string shell, values;
    for (const Face& face : body.faces) {
        shell += shell.empty() ? "[" : ",[";
        shell += ringJson(face.exterior, vertices);
        for (const Ring& hole : face.holes) shell += "," + ringJson(hole, vertices);
        shell += "]";
        values += values.empty() ? "" : ",";
        values += face.kind == FaceKind::Ground || face.kind == FaceKind::Floor   ? "0"
                  : face.kind == FaceKind::Roof || face.kind == FaceKind::Ceiling ? "1"
                  : face.kind == FaceKind::Window                                 ? "3"
                                                                                  : "2";
    }
    std::string text = fmt::format(R"({{"type":"Solid","lod":"{}","boundaries":[[{}]])", lod, shell);
    if (hasSemantics)
        text += fmt::format(
            R"(,"semantics":{{"surfaces":[{{"type":"GroundSurface"}},{{"type":"RoofSurface"}},{{"type":"WallSurface"}},{{"type":"Window"}}],"values":[[{}]]}})",
            values);
    return text + "}";
}

// The hull as level 1.2 has it: the box around the plan, up to the height.
Body blockOf(const Body& body) {
    Point low = body.faces.front().exterior.front(), high = low;
    for (const Face& face : body.faces)
        for (const Point& p : face.exterior) {
            low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
            high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
        }
    const Point a{low.x, low.y, low.z}, b{high.x, low.y, low.z}, c{high.x, high.y, low.z}, d{low.x, high.y, low.z};
    const auto up = [&](Point p) { return Point{p.x, p.y, high.z}; };
    Body block;
    block.faces = {{FaceKind::Ground, {d, c, b, a}, {}},       {FaceKind::Roof, {up(a), up(b), up(c), up(d)}, {}},
                   {FaceKind::Wall, {a, b, up(b), up(a)}, {}}, {FaceKind::Wall, {b, c, up(c), up(b)}, {}},
                   {FaceKind::Wall, {c, d, up(d), up(c)}, {}}, {FaceKind::Wall, {d, a, up(a), up(d)}, {}}};
    return block;
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
        R"("identificatie":"{0}","b3_h_dak_max":{1},"b3_bouwlagen":{2},"b3_dak_type":"{3}"}},"children":[{4}]}}{5}}},"vertices":[)",
        id, heightText(building), building.storeys, building.roof == "1030" ? "slanted" : "horizontal", children,
        objects);
    bool isFirst = true;
    for (const Point& p : vertices.all()) {
        sink_ << fmt::format("{}[{},{},{}]", isFirst ? "" : ",", p.x, p.y, p.z);
        isFirst = false;
    }
    sink_ << "]}\n";
}

}  // namespace svt::samples::city
