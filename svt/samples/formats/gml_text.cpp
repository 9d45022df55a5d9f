#include <svt/samples/formats/writers.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace svt::samples {

template <class Coordinates>
void GmlText::rings(const Face& face, const Coordinates& write) {
    for (std::size_t r = 0; r < face.rings.size(); ++r) {
        const std::string_view tag = r == 0 ? "exterior" : "interior";
        out_ << "<gml:" << tag << "><gml:LinearRing><gml:posList>";
        for (const std::uint32_t i : face.rings[r]) {
            write(i);
            out_ << " ";
        }
        write(face.rings[r].front());
        out_ << "</gml:posList></gml:LinearRing></gml:" << tag << ">";
    }
    out_ << "</gml:Polygon>";
}

void GmlText::position(const WorldPoint& point, int decimals) {
    out_.fixed(point.x, decimals) << " ";
    out_.fixed(point.y, decimals) << " ";
    out_.fixed(point.z, decimals);
}

void GmlText::polygon(const PlacedPlan& placed, const Face& face, std::string_view id) {
    out_ << "<gml:Polygon";
    if (!id.empty()) out_ << " gml:id=\"" << id << "\"";
    out_ << ">";
    const int decimals = placed.placement.decimals();
    rings(face, [&](std::uint32_t i) { position(placed.placement.at(placed.plan->vertices[i]), decimals); });
}

void GmlText::localPolygon(const Instance& instance, const Face& face) {
    out_ << "<gml:Polygon>";
    rings(face, [&](std::uint32_t i) {
        const Point& p = instance.vertices[i];
        position({p.x, p.y, p.z}, 3);
    });
}

void GmlText::envelope(SampleSource& source) {
    const std::array<WorldPoint, 2> corners = source.envelope();
    out_ << "<gml:boundedBy><gml:Envelope srsName=\"urn:ogc:def:crs,crs:EPSG::25832,crs:EPSG::7837\" "
            "srsDimension=\"3\"><gml:lowerCorner>";
    position(corners[0], source.decimals());
    out_ << "</gml:lowerCorner><gml:upperCorner>";
    position(corners[1], source.decimals());
    out_ << "</gml:upperCorner></gml:Envelope></gml:boundedBy>\n";
}

void GmlText::matrix(const PlacedPlan& placed, const Instance& instance) {
    const std::array<Vec3d, 4> quarters{{{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}}};
    const Vec3d east = placed.placement.worldDirection(quarters[std::size_t(instance.quarterTurns)]);
    const auto text = [](double value) { return fixedText(std::llround(value * 1e12), 12); };
    out_ << text(east.x) << " " << text(-east.y) << " 0 0 " << text(east.y) << " " << text(east.x)
         << " 0 0 0 0 1 0 0 0 0 1";
}

void GmlText::material(Material material, std::string_view id) {
    const MaterialInfo& shown = info(material);
    out_ << "<app:X3DMaterial gml:id=\"" << id << "\"><gml:name>" << shown.name << "</gml:name><app:diffuseColor>"
         << decimalText(shown.color[0]) << " " << decimalText(shown.color[1]) << " " << decimalText(shown.color[2])
         << "</app:diffuseColor><app:transparency>" << decimalText(shown.transparency) << "</app:transparency>";
}

void GmlText::ground(SampleSource& source, std::string_view module) {
    const std::vector<WorldPoint> corners = source.ground();
    if (corners.empty()) return;
    out_ << "<core:cityObjectMember>\n<luse:LandUse gml:id=\"ground\"><gml:name>Ground</gml:name><" << module
         << ":lod1MultiSurface><gml:MultiSurface gml:id=\"ground_surface\"><gml:surfaceMember>"
            "<gml:Polygon><gml:exterior><gml:LinearRing><gml:posList>";
    for (const WorldPoint& corner : corners) {
        position(corner, source.decimals());
        out_ << " ";
    }
    position(corners.front(), source.decimals());
    out_ << "</gml:posList></gml:LinearRing></gml:exterior></gml:Polygon></gml:surfaceMember></gml:MultiSurface></"
         << module << ":lod1MultiSurface></luse:LandUse>\n</core:cityObjectMember>\n";
}

void GmlText::appearance(const Document& document, bool isThematic, std::string_view property,
                         std::string_view member) {
    const std::vector<MaterialTargets> materials = materialTargets(document, isThematic);
    if (materials.empty()) return;
    out_ << "<" << property << "><app:Appearance gml:id=\"" << document.id
         << "_appearance\"><app:theme>sample</app:theme>\n";
    for (const MaterialTargets& of : materials) {
        out_ << "<" << member << ">";
        material(of.material, document.id + "_material" + std::to_string(int(of.material)));
        for (const std::string& polygon : of.polygons) out_ << "<app:target>#" << polygon << "</app:target>";
        out_ << "</app:X3DMaterial></" << member << ">\n";
    }
    out_ << "</app:Appearance></" << property << ">\n";
}

std::string polygonId(const std::string& componentId, std::size_t number) {
    return componentId + "_p" + std::to_string(number);
}

std::vector<MaterialTargets> materialTargets(const Document& document, bool isThematic) {
    std::map<Material, std::vector<std::string>> targets;
    for (const PlacedPlan& placed : document.plans)
        for (std::size_t c = 0; c < placed.plan->components.size(); ++c) {
            const Component& component = placed.plan->components[c];
            if (!fillsSpace(component) || component.kind == Kind::Room || component.isStandIn) continue;
            const std::string id = document.idOf(placed, int(c));
            std::size_t number = 0;
            for (const Shell& shell : component.shells) {
                const Material material = document.shown(shell.material);
                for (const Face& face : shell.faces) {
                    const bool isWritten = !isThematic || face.neighbor < 0;
                    if (info(material).isColoredInGml && isWritten) targets[material].push_back(polygonId(id, number));
                    ++number;
                }
            }
        }
    std::vector<MaterialTargets> result;
    for (auto& [material, polygons] : targets) result.push_back({material, std::move(polygons)});
    return result;
}

std::string decimalText(double value) {
    std::string text = fixedText(std::llround(value * 1e6), 6);
    while (text.back() == '0') text.pop_back();
    if (text.back() == '.') text.pop_back();
    return text;
}

}  // namespace svt::samples
