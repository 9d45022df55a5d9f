// CityGML 3.0. One lod3Solid per component; a room's solid references the polygons of its boundary
// surfaces by XLink. Properties are in schema order.
#include <svt/samples/formats/gml_text.hpp>
#include <svt/samples/formats/writers.hpp>

#include <string>
#include <utility>

namespace svt::samples {
namespace {

class CityGml3Writer : CityGmlWriter {
public:
    CityGml3Writer(SampleSource& source, TextSink& out) : CityGmlWriter(source, out, "3.0") {}

    void write() {
        writeModel(
            {"app", "bldg", "con", "gen", "luse"}, false, [&] { building(); }, [] {});
    }

private:
    using WriteOne = void (CityGml3Writer::*)(const PlacedPlan&, int);

    void building() {
        eachTop(Kind::Element, "bldg:buildingConstructiveElement", &CityGml3Writer::element);
        eachTop(Kind::Installation, "bldg:buildingInstallation", &CityGml3Writer::installation);
        eachTop(Kind::Room, "bldg:buildingRoom", &CityGml3Writer::room);
        eachTop(Kind::Storey, "bldg:buildingSubdivision", &CityGml3Writer::storey);
    }

    // Writes every component of the kind that belongs directly to the building, inside the property.
    void eachTop(Kind kind, std::string_view property, WriteOne writeOne) {
        document_.forEach([&](const PlacedPlan& placed, int c, const Component& component) {
            if (component.kind != kind || component.parent >= 0 || component.isStandIn || out_.hasFailed()) return;
            const GmlElement element(out_, property, {}, "\n");
            (this->*writeOne)(placed, c);
        });
    }

    void eachChild(const PlacedPlan& placed, int parent, Kind kind, std::string_view property, WriteOne writeOne) {
        for (const int child : placed.plan->children[std::size_t(parent)]) {
            if (placed.component(child).kind != kind) continue;
            const GmlElement element(out_, property, {}, "\n");
            (this->*writeOne)(placed, child);
        }
    }

    void lod3Solid(const PlacedPlan& placed, int component) {
        const GmlElement property(out_, "core:lod3Solid", {}, "\n");
        solid(placed, component);
    }

    void element(const PlacedPlan& placed, int component) {
        const GmlElement element = feature(placed, component, "bldg:BuildingConstructiveElement");
        lod3Solid(placed, component);
        const Component& c = placed.component(component);
        for (const Attribute& attribute : c.attributes)
            if (attribute.name == "loadBearing") gml_.text("con:isStructuralElement", toText(attribute.value));
        eachChild(placed, component, Kind::Window, "con:filling", &CityGml3Writer::filling);
        eachChild(placed, component, Kind::Door, "con:filling", &CityGml3Writer::filling);
        function(c);
    }

    void filling(const PlacedPlan& placed, int component) {
        const bool isDoor = placed.component(component).kind == Kind::Door;
        const GmlElement element = feature(placed, component, isDoor ? "con:Door" : "con:Window");
        lod3Solid(placed, component);
    }

    void installation(const PlacedPlan& placed, int component) {
        const GmlElement element = feature(placed, component, "bldg:BuildingInstallation");
        lod3Solid(placed, component);
        const Component& c = placed.component(component);
        gml_.text("con:relationToConstruction", c.isOutside ? "outside" : "inside");
        function(c);
    }

    void furniture(const PlacedPlan& placed, int component) {
        const GmlElement element = feature(placed, component, "bldg:BuildingFurniture");
        lod3Solid(placed, component);
        function(placed.component(component));
    }

    void surfaces(const PlacedPlan& placed, int room, const BoundaryGroup& group, const std::string& id) {
        if (group.faces.empty()) return;
        gml_.multiSurface("core:lod3MultiSurface", id + "_surface", [&] {
            const Shell& shell = placed.component(room).shells.front();
            for (const int f : group.faces)
                member(placed, shell.faces[std::size_t(f)], polygonId(document_.idOf(placed, room), std::size_t(f)));
        });
    }

    void room(const PlacedPlan& placed, int component) {
        const Component& c = placed.component(component);
        const std::string id = document_.idOf(placed, component);
        const GmlElement element = feature(placed, component, "bldg:BuildingRoom");
        int number = 0;
        const auto surface = [&](const BoundaryGroup& group, std::string_view module, const auto& writeRest) {
            const std::string surfaceId = id + "_b" + std::to_string(number++);
            const GmlElement boundarySurface(out_, std::string(module) + std::string(group.type), surfaceId);
            surfaces(placed, component, group, surfaceId);
            writeRest();
        };
        for (const BoundaryGroup& group : boundaryGroups(*placed.plan, component)) {
            const GmlElement boundary(out_, "core:boundary", {}, "\n");
            surface(group, group.type == "ClosureSurface" ? "core:" : "con:", [&] {
                for (const BoundaryGroup& opening : group.openings) {
                    const GmlElement property(out_, "con:fillingSurface");
                    surface(opening, "con:", [] {});
                }
            });
        }
        {
            const GmlElement property(out_, "core:lod3Solid", {}, "\n");
            gml_.solid(id + "_solid", [&] {
                for (std::size_t f = 0; f < c.shells.front().faces.size(); ++f) gml_.memberLink(polygonId(id, f));
            });
        }
        function(c);
        eachChild(placed, component, Kind::Furniture, "bldg:buildingFurniture", &CityGml3Writer::furniture);
        eachChild(placed, component, Kind::Installation, "bldg:buildingInstallation", &CityGml3Writer::installation);
    }

    // Links to the elements, installations and rooms for which `isMember` holds.
    template <class Predicate>
    void links(const PlacedPlan& placed, const Predicate& isMember) {
        for (const auto& [kind, property] :
             {std::pair{Kind::Element, "buildingConstructiveElement"},
              std::pair{Kind::Installation, "buildingInstallation"}, std::pair{Kind::Room, "buildingRoom"}})
            for (std::size_t c = 0; c < placed.plan->components.size(); ++c) {
                const Component& component = placed.plan->components[c];
                if (component.kind != kind || !isGrouped(component) || !isMember(component)) continue;
                out_ << "<bldg:" << property << " xlink:href=\"#" << document_.idOf(placed, int(c)) << "\"/>\n";
            }
    }

    void storey(const PlacedPlan& placed, int storey) {
        const GmlElement element = feature(placed, storey, "bldg:Storey");
        function(placed.component(storey));
        links(placed, [storey](const Component& c) { return c.storey == storey; });
        for (std::size_t c = 0; c < placed.plan->components.size(); ++c) {
            const Component& component = placed.plan->components[c];
            if (component.kind != Kind::Unit || component.storey != storey) continue;
            const GmlElement property(out_, "bldg:buildingUnit", {}, "\n");
            unit(placed, int(c));
        }
    }

    void unit(const PlacedPlan& placed, int unit) {
        const GmlElement element = feature(placed, unit, "bldg:BuildingUnit");
        lod3Solid(placed, unit);
        function(placed.component(unit));
        links(placed, [unit](const Component& c) { return c.unit == unit; });
    }
};

}  // namespace

void writeCityGml3(SampleSource& source, TextSink& out) { CityGml3Writer(source, out).write(); }

}  // namespace svt::samples
