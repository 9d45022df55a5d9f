// CityGML 2.0, LoD4. It has no constructive elements, storeys or units:
//   full      walls, slabs, beams and roof members are (Int)BuildingInstallation with a solid and the attribute
//             svtClass; doors and windows are openings whose surfaces enclose their solids
//   thematic  the classical model: boundary surfaces, an outer hull made of them, rooms
//   both      storeys are CityObjectGroups, units BuildingParts that contain their rooms
//             and inner walls
// A face shared by a room and an adjacent part is written once; the room uses it reversed (gml:OrientableSurface).
#include <svt/samples/formats/writers.hpp>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <variant>

namespace svt::samples {
namespace {

class CityGml2Writer {
public:
    CityGml2Writer(SampleSource& source, bool isThematic, TextSink& out)
        : source_(source), isThematic_(isThematic), out_(out), gml_(out) {}

    void write() {
        out_ << "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
                "<core:CityModel xmlns:core=\"http://www.opengis.net/citygml/2.0\""
                " xmlns:app=\"http://www.opengis.net/citygml/appearance/2.0\""
                " xmlns:bldg=\"http://www.opengis.net/citygml/building/2.0\""
                " xmlns:gen=\"http://www.opengis.net/citygml/generics/2.0\""
                " xmlns:grp=\"http://www.opengis.net/citygml/cityobjectgroup/2.0\""
                " xmlns:luse=\"http://www.opengis.net/citygml/landuse/2.0\""
                " xmlns:gml=\"http://www.opengis.net/gml\" xmlns:xlink=\"http://www.w3.org/1999/xlink\">\n<gml:name>"
             << source_.title() << "</gml:name>\n";
        gml_.envelope(source_);
        gml_.ground(source_, "luse");
        for (std::int64_t i = 0; i < source_.buildingCount() && !out_.hasFailed(); ++i) {
            document_ = source_.building(i);
            templateId_.clear();
            building();
            for (const PlacedPlan& placed : document_.plans)
                for (std::size_t c = 0; c < placed.plan->components.size(); ++c)
                    if (placed.plan->components[c].kind == Kind::Storey) storeyGroup(placed, int(c));
        }
        out_ << "</core:CityModel>\n";
    }

private:
    void building() {
        out_ << "<core:cityObjectMember>\n<bldg:Building gml:id=\"" << document_.id << "\"><gml:name>" << document_.name
             << "</gml:name>\n";
        gml_.appearance(document_, isThematic_, "app:appearance", "app:surfaceDataMember");
        out_ << "<bldg:function>" << document_.function << "</bldg:function><bldg:roofType>" << document_.roofType
             << "</bldg:roofType><bldg:storeysAboveGround>" << document_.storeys << "</bldg:storeysAboveGround>\n";
        for (const bool isOutside : {true, false})
            for (const PlacedPlan& placed : document_.plans)
                for (std::size_t c = 0; c < placed.plan->components.size(); ++c)
                    installationOfBuilding(placed, int(c), -1, isOutside);
        if (isThematic_) hull();
        for (const PlacedPlan& placed : document_.plans) rooms(placed, -1);
        for (const PlacedPlan& placed : document_.plans)
            for (std::size_t c = 0; c < placed.plan->components.size(); ++c)
                if (placed.plan->components[c].kind == Kind::Unit) unit(placed, int(c));
        out_ << "</bldg:Building>\n</core:cityObjectMember>\n";
    }

    void open(const PlacedPlan& placed, int component, std::string_view tag) {
        out_ << "<" << tag << " gml:id=\"" << document_.idOf(placed, component) << "\"><gml:name>"
             << document_.nameOf(placed, component) << "</gml:name>";
        for (const Attribute& attribute : document_.attributesOf(placed, component)) genericAttribute(attribute);
        const Kind kind = placed.plan->components[std::size_t(component)].kind;
        if (kind == Kind::Element || kind == Kind::Unit)
            genericAttribute({"svtClass", std::string(className(kind)), ""});
        out_ << "\n";
    }

    void genericAttribute(const Attribute& attribute) {
        std::string_view type = "stringAttribute";
        if (std::holds_alternative<std::int64_t>(attribute.value)) type = "intAttribute";
        if (std::holds_alternative<double>(attribute.value))
            type = attribute.unit.empty() ? "doubleAttribute" : "measureAttribute";
        out_ << "<gen:" << type << " name=\"" << attribute.name << "\"><gen:value";
        if (!attribute.unit.empty()) out_ << " uom=\"" << attribute.unit << "\"";
        out_ << ">";
        if (const double* number = std::get_if<double>(&attribute.value))
            out_ << decimalText(*number);
        else
            out_ << toText(attribute.value);
        out_ << "</gen:value></gen:" << type << ">";
    }

    void function(const Component& component) {
        if (!component.function.empty()) out_ << "<bldg:function>" << component.function << "</bldg:function>";
    }

    // gml:Solid, or gml:CompositeSolid for touching solids; every polygon has an id.
    void solid(const PlacedPlan& placed, int component) {
        const Component& c = placed.plan->components[std::size_t(component)];
        const std::string id = document_.idOf(placed, component);
        const bool isComposite = c.shells.size() > 1;
        if (isComposite) out_ << "<gml:CompositeSolid gml:id=\"" << id << "_solid\">";
        std::size_t number = 0;
        for (std::size_t s = 0; s < c.shells.size(); ++s) {
            if (isComposite) out_ << "<gml:solidMember>";
            out_ << "<gml:Solid gml:id=\"" << id << "_solid";
            if (isComposite) out_ << std::int64_t(s);
            out_ << "\"><gml:exterior><gml:CompositeSurface>\n";
            for (const Face& face : c.shells[s].faces) inlineMember(placed, face, polygonId(id, number++));
            out_ << "</gml:CompositeSurface></gml:exterior></gml:Solid>";
            if (isComposite) out_ << "</gml:solidMember>";
        }
        if (isComposite) out_ << "</gml:CompositeSolid>";
    }

    void inlineMember(const PlacedPlan& placed, const Face& face, std::string_view id) {
        out_ << "<gml:surfaceMember>";
        gml_.polygon(placed, face, id);
        out_ << "</gml:surfaceMember>\n";
    }

    void reversedMember(std::string_view id, std::string_view base) {
        out_ << "<gml:surfaceMember><gml:OrientableSurface gml:id=\"" << id
             << "\" orientation=\"-\"><gml:baseSurface xlink:href=\"#" << base
             << "\"/></gml:OrientableSurface></gml:surfaceMember>\n";
    }

    static bool isAtHull(const Component& component) {
        for (const Shell& shell : component.shells)
            for (const Face& face : shell.faces)
                if (face.neighbor < 0) return true;
        return false;
    }

    // Of the building itself (unit -1) or of one unit.
    void installationOfBuilding(const PlacedPlan& placed, int component, int unit, bool isOutside) {
        const Component& c = placed.plan->components[std::size_t(component)];
        const bool isElement = c.kind == Kind::Element && !isThematic_;
        if ((c.kind != Kind::Installation && !isElement) || c.parent >= 0 || c.isStandIn || c.unit != unit) return;
        if ((isElement ? isAtHull(c) : c.isOutside) != isOutside) return;
        const std::string_view property =
            isOutside ? "bldg:outerBuildingInstallation" : "bldg:interiorBuildingInstallation";
        out_ << "<" << property << ">";
        installation(placed, component, isOutside ? "bldg:BuildingInstallation" : "bldg:IntBuildingInstallation");
        out_ << "</" << property << ">\n";
    }

    void installation(const PlacedPlan& placed, int component, std::string_view tag) {
        open(placed, component, tag);
        function(placed.plan->components[std::size_t(component)]);
        out_ << "<bldg:lod4Geometry>";
        solid(placed, component);
        out_ << "</bldg:lod4Geometry></" << tag << ">";
    }

    // The outer faces of all elements and fillings enclose the building: together they form its solid.
    void hull() {
        std::vector<std::string> members;
        for (const PlacedPlan& placed : document_.plans)
            for (std::size_t c = 0; c < placed.plan->components.size(); ++c) {
                const Component& component = placed.plan->components[c];
                if (component.kind != Kind::Element || component.isStandIn) continue;
                if (component.hullPart == HullPart::Ground) hullSurface(placed, int(c), "GroundSurface", members);
                hullSurface(placed, int(c), component.hullPart == HullPart::Roof ? "RoofSurface" : "WallSurface",
                            members);
            }
        out_ << "<bldg:lod4Solid><gml:Solid gml:id=\"" << document_.id
             << "_solid\"><gml:exterior><gml:CompositeSurface>\n";
        for (const std::string& id : members) out_ << "<gml:surfaceMember xlink:href=\"#" << id << "\"/>\n";
        out_ << "</gml:CompositeSurface></gml:exterior></gml:Solid></bldg:lod4Solid>\n";
    }

    // Outer faces of the component with that type, as (polygon number, face).
    static std::vector<std::pair<std::size_t, const Face*>> outerFaces(const Plan& plan, const Component& component,
                                                                       std::string_view type) {
        std::vector<std::pair<std::size_t, const Face*>> faces;
        std::size_t number = 0;
        for (const Shell& shell : component.shells)
            for (const Face& face : shell.faces) {
                const bool isGround = component.hullPart == HullPart::Ground && normalOf(plan, face).z < 0;
                if (face.neighbor < 0 && (type.empty() || isGround == (type == "GroundSurface")))
                    faces.push_back({number, &face});
                ++number;
            }
        return faces;
    }

    void outerMultiSurface(const PlacedPlan& placed, int component, std::string_view type,
                           std::vector<std::string>& members) {
        const std::string id = document_.idOf(placed, component);
        const Component& c = placed.plan->components[std::size_t(component)];
        out_ << "<bldg:lod4MultiSurface><gml:MultiSurface>\n";
        for (const auto& [number, face] : outerFaces(*placed.plan, c, type)) {
            members.push_back(polygonId(id, number));
            inlineMember(placed, *face, members.back());
        }
        out_ << "</gml:MultiSurface></bldg:lod4MultiSurface>";
    }

    void hullSurface(const PlacedPlan& placed, int component, std::string_view type,
                     std::vector<std::string>& members) {
        const Component& c = placed.plan->components[std::size_t(component)];
        if (outerFaces(*placed.plan, c, type).empty()) return;
        out_ << "<bldg:boundedBy><bldg:" << type << " gml:id=\"" << document_.idOf(placed, component)
             << (type == "GroundSurface" ? "_ground" : "_outer") << "\"><gml:name>"
             << document_.nameOf(placed, component) << "</gml:name>\n";
        outerMultiSurface(placed, component, type, members);
        for (const int child : placed.plan->children[std::size_t(component)]) {
            const Component& filling = placed.plan->components[std::size_t(child)];
            if (outerFaces(*placed.plan, filling, "").empty()) continue;
            const std::string_view tag = filling.kind == Kind::Door ? "bldg:Door" : "bldg:Window";
            out_ << "<bldg:opening>";
            open(placed, child, tag);
            outerMultiSurface(placed, child, "", members);
            out_ << "</" << tag << "></bldg:opening>\n";
        }
        out_ << "</bldg:" << type << "></bldg:boundedBy>\n";
    }

    void rooms(const PlacedPlan& placed, int unit) {
        for (std::size_t c = 0; c < placed.plan->components.size() && !out_.hasFailed(); ++c) {
            const Component& component = placed.plan->components[c];
            if (component.kind != Kind::Room || component.isStandIn || component.unit != unit) continue;
            out_ << "<bldg:interiorRoom>";
            room(placed, int(c));
            out_ << "</bldg:interiorRoom>\n";
        }
    }

    void room(const PlacedPlan& placed, int component) {
        const Component& c = placed.plan->components[std::size_t(component)];
        const std::string id = document_.idOf(placed, component);
        const std::vector<BoundaryGroup> groups = boundaryGroups(*placed.plan, component);
        std::set<int> openingFaces;
        for (const BoundaryGroup& group : groups)
            for (const BoundaryGroup& opening : group.openings)
                openingFaces.insert(opening.faces.begin(), opening.faces.end());
        open(placed, component, "bldg:Room");
        function(c);
        out_ << "<bldg:lod4Solid><gml:Solid gml:id=\"" << id << "_solid\"><gml:exterior><gml:CompositeSurface>\n";
        for (std::size_t f = 0; f < c.shells.front().faces.size(); ++f) {
            const Face& face = c.shells.front().faces[f];
            if (!isThematic_ && openingFaces.count(int(f)) != 0)
                reversedMember(polygonId(id, f),
                               polygonId(document_.idOf(placed, face.neighbor), std::size_t(face.neighborFace)));
            else
                out_ << "<gml:surfaceMember xlink:href=\"#" << polygonId(id, f) << "\"/>\n";
        }
        out_ << "</gml:CompositeSurface></gml:exterior></gml:Solid></bldg:lod4Solid>\n";
        int number = 0;
        for (const BoundaryGroup& group : groups) {
            out_ << "<bldg:boundedBy><bldg:" << group.type << " gml:id=\"" << id << "_b" << std::int64_t(number++)
                 << "\">";
            if (!group.faces.empty()) roomSurfaces(placed, component, group);
            for (const BoundaryGroup& opening : group.openings) openingOfRoom(placed, component, opening, number++);
            out_ << "</bldg:" << group.type << "></bldg:boundedBy>\n";
        }
        furnish(placed, component);
        out_ << "</bldg:Room>";
    }

    // A face already written by an element or an earlier room is referenced and reversed.
    [[nodiscard]] bool isWrittenElsewhere(const PlacedPlan& placed, int room, const Face& face) const {
        if (face.neighbor < 0 || face.neighborFace < 0) return false;
        const Component& neighbor = placed.plan->components[std::size_t(face.neighbor)];
        if (neighbor.isStandIn) return false;
        return neighbor.kind == Kind::Room ? face.neighbor < room : neighbor.kind == Kind::Element && !isThematic_;
    }

    void roomSurfaces(const PlacedPlan& placed, int room, const BoundaryGroup& group) {
        const std::string id = document_.idOf(placed, room);
        const Shell& shell = placed.plan->components[std::size_t(room)].shells.front();
        out_ << "<bldg:lod4MultiSurface><gml:MultiSurface>\n";
        for (const int f : group.faces) {
            const Face& face = shell.faces[std::size_t(f)];
            const std::string polygon = polygonId(id, std::size_t(f));
            if (isWrittenElsewhere(placed, room, face))
                reversedMember(polygon,
                               polygonId(document_.idOf(placed, face.neighbor), std::size_t(face.neighborFace)));
            else
                inlineMember(placed, face, polygon);
        }
        out_ << "</gml:MultiSurface></bldg:lod4MultiSurface>";
    }

    // Full: the closed solid of the filling, in the first room that touches it. Thematic: only the side facing this
    // room.
    void openingOfRoom(const PlacedPlan& placed, int room, const BoundaryGroup& opening, int number) {
        const int filling = opening.neighbor;
        const std::string_view tag = opening.type == "DoorSurface" ? "bldg:Door" : "bldg:Window";
        const std::string id = document_.idOf(placed, filling);
        if (isThematic_) {
            out_ << "<bldg:opening><" << tag << " gml:id=\"" << document_.idOf(placed, room) << "_b"
                 << std::int64_t(number) << "\"><gml:name>" << document_.nameOf(placed, filling) << "</gml:name>\n";
            roomSurfaces(placed, room, opening);
        } else if (firstRoom(*placed.plan, filling) != room) {
            out_ << "<bldg:opening xlink:href=\"#" << id << "\"/>\n";
            return;
        } else {
            out_ << "<bldg:opening>";
            open(placed, filling, tag);
            out_ << "<bldg:lod4MultiSurface><gml:MultiSurface>\n";
            std::size_t polygon = 0;
            for (const Shell& shell : placed.plan->components[std::size_t(filling)].shells)
                for (const Face& face : shell.faces) inlineMember(placed, face, polygonId(id, polygon++));
            out_ << "</gml:MultiSurface></bldg:lod4MultiSurface>";
        }
        out_ << "</" << tag << "></bldg:opening>\n";
    }

    static int firstRoom(const Plan& plan, int filling) {
        int first = -1;
        for (const Shell& shell : plan.components[std::size_t(filling)].shells)
            for (const Face& face : shell.faces) {
                if (face.neighbor < 0 || plan.components[std::size_t(face.neighbor)].kind != Kind::Room) continue;
                if (first < 0 || face.neighbor < first) first = face.neighbor;
            }
        return first;
    }

    void furnish(const PlacedPlan& placed, int room) {
        for (const Kind kind : {Kind::Furniture, Kind::Installation})
            for (const int child : placed.plan->children[std::size_t(room)]) {
                if (placed.plan->components[std::size_t(child)].kind != kind) continue;
                const bool isFurniture = kind == Kind::Furniture;
                out_ << (isFurniture ? "<bldg:interiorFurniture>" : "<bldg:roomInstallation>");
                if (isFurniture)
                    furniture(placed, child);
                else
                    installation(placed, child, "bldg:IntBuildingInstallation");
                out_ << (isFurniture ? "</bldg:interiorFurniture>\n" : "</bldg:roomInstallation>\n");
            }
    }

    void furniture(const PlacedPlan& placed, int component) {
        const Component& c = placed.plan->components[std::size_t(component)];
        open(placed, component, "bldg:BuildingFurniture");
        function(c);
        if (c.instance) {
            implicitGeometry(placed, component, *c.instance);
        } else {
            out_ << "<bldg:lod4Geometry>";
            solid(placed, component);
            out_ << "</bldg:lod4Geometry>";
        }
        out_ << "</bldg:BuildingFurniture>";
    }

    // The first instance contains the shape, the others reference it.
    void implicitGeometry(const PlacedPlan& placed, int component, const Instance& instance) {
        out_ << "<bldg:lod4ImplicitRepresentation><core:ImplicitGeometry><core:transformationMatrix>";
        gml_.matrix(placed, instance);
        out_ << "</core:transformationMatrix>";
        if (!templateId_.empty()) {
            out_ << "<core:relativeGMLGeometry xlink:href=\"#" << templateId_ << "\"/>";
        } else {
            templateId_ = document_.idOf(placed, component) + "_template";
            out_ << "<core:relativeGMLGeometry><gml:Solid gml:id=\"" << templateId_
                 << "\"><gml:exterior><gml:CompositeSurface>\n";
            for (const Face& face : instance.shell.faces) {
                out_ << "<gml:surfaceMember>";
                gml_.localPolygon(instance, face);
                out_ << "</gml:surfaceMember>\n";
            }
            out_ << "</gml:CompositeSurface></gml:exterior></gml:Solid></core:relativeGMLGeometry>";
        }
        out_ << "<core:referencePoint><gml:Point><gml:pos>";
        gml_.position(placed.placement.at(instance.shift), placed.placement.decimals());
        out_
            << "</gml:pos></gml:Point></core:referencePoint></core:ImplicitGeometry></bldg:lod4ImplicitRepresentation>";
    }

    void unit(const PlacedPlan& placed, int component) {
        out_ << "<bldg:consistsOfBuildingPart>";
        open(placed, component, "bldg:BuildingPart");
        function(placed.plan->components[std::size_t(component)]);
        for (const bool isOutside : {true, false})
            for (std::size_t c = 0; c < placed.plan->components.size(); ++c)
                installationOfBuilding(placed, int(c), component, isOutside);
        out_ << "<bldg:lod4Solid>";
        solid(placed, component);
        out_ << "</bldg:lod4Solid>\n";
        rooms(placed, component);
        out_ << "</bldg:BuildingPart></bldg:consistsOfBuildingPart>\n";
    }

    void storeyGroup(const PlacedPlan& placed, int storey) {
        out_ << "<core:cityObjectMember>\n";
        open(placed, storey, "grp:CityObjectGroup");
        out_ << "<grp:class>buildingSeparation</grp:class><grp:function>storey</grp:function>\n";
        for (std::size_t c = 0; c < placed.plan->components.size(); ++c) {
            const Component& component = placed.plan->components[c];
            if (component.storey != storey || !isGrouped(component)) continue;
            if (isThematic_ && component.kind == Kind::Element) continue;
            out_ << "<grp:groupMember role=\"" << className(component.kind) << "\" xlink:href=\"#"
                 << document_.idOf(placed, int(c)) << "\"/>\n";
        }
        out_ << "<grp:parent xlink:href=\"#" << document_.id
             << "\"/></grp:CityObjectGroup>\n</core:cityObjectMember>\n";
    }

    SampleSource& source_;
    bool isThematic_;
    TextSink& out_;
    GmlText gml_;
    Document document_;
    std::string templateId_;  ///< of the building's first implicit geometry
};

}  // namespace

void writeCityGml2(SampleSource& source, bool isThematic, TextSink& out) {
    CityGml2Writer(source, isThematic, out).write();
}

}  // namespace svt::samples
