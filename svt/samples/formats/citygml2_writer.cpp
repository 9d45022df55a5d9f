// CityGML 2.0, LoD4. It has no constructive elements, storeys or units:
//   full      walls, slabs, beams and roof members are (Int)BuildingInstallation with a solid and the attribute
//             svtClass; doors and windows are openings whose surfaces enclose their solids.
//   thematic  the classical model: boundary surfaces, an outer hull made of them, rooms.
//   both      storeys are CityObjectGroups, units BuildingParts that contain their rooms
//             and inner walls.
// A face shared by a room and an adjacent part is written once; the room uses it reversed (gml:OrientableSurface).
#include <svt/samples/formats/gml_text.hpp>
#include <svt/samples/formats/writers.hpp>

#include <algorithm>
#include <set>
#include <string>
#include <utility>

namespace svt::samples {
namespace {

class CityGml2Writer : CityGmlWriter {
public:
    CityGml2Writer(SampleSource& source, bool isThematic, TextSink& out)
        : CityGmlWriter(source, out, "2.0"), isThematic_(isThematic) {}

    void write() {
        writeModel(
            {"app", "bldg", "gen", "grp", "luse"}, isThematic_, [&] { building(); }, [&] { storeyGroups(); });
    }

private:
    void building() {
        templateId_.clear();
        for (const bool isOutside : {true, false})
            document_.forEach([&](const PlacedPlan& placed, int c, const Component&) {
                installationOfBuilding(placed, c, -1, isOutside);
            });
        if (isThematic_) hull();
        for (const PlacedPlan& placed : document_.plans) rooms(placed, -1);
        document_.forEach([&](const PlacedPlan& placed, int c, const Component& component) {
            if (component.kind == Kind::Unit) unit(placed, c);
        });
    }

    // gml:surfaceMember with a face that is written elsewhere, turned.
    void reversedMember(const PlacedPlan& placed, const Face& face, std::string_view id) {
        out_ << "<gml:surfaceMember><gml:OrientableSurface gml:id=\"" << id
             << "\" orientation=\"-\"><gml:baseSurface xlink:href=\"#"
             << polygonId(document_.idOf(placed, face.neighbor), std::size_t(face.neighborFace))
             << "\"/></gml:OrientableSurface></gml:surfaceMember>\n";
    }

    static bool isAtHull(const Component& component) {
        return std::ranges::any_of(component.shells, [](const Shell& shell) {
            return std::ranges::any_of(shell.faces, [](const Face& face) { return face.neighbor < 0; });
        });
    }

    // Writes an installation of the building itself (unit -1) or of one unit.
    void installationOfBuilding(const PlacedPlan& placed, int component, int unit, bool isOutside) {
        const Component& c = placed.component(component);
        const bool isElement = c.kind == Kind::Element && !isThematic_;
        if ((c.kind != Kind::Installation && !isElement) || c.parent >= 0 || c.isStandIn || c.unit != unit) return;
        if ((isElement ? isAtHull(c) : c.isOutside) != isOutside) return;
        const GmlElement property(
            out_, isOutside ? "bldg:outerBuildingInstallation" : "bldg:interiorBuildingInstallation", {}, "\n");
        installation(placed, component, isOutside ? "bldg:BuildingInstallation" : "bldg:IntBuildingInstallation");
    }

    void lod4Geometry(const PlacedPlan& placed, int component) {
        const GmlElement property(out_, "bldg:lod4Geometry");
        solid(placed, component);
    }

    void installation(const PlacedPlan& placed, int component, std::string_view name) {
        const GmlElement element = feature(placed, component, name);
        function(placed.component(component));
        lod4Geometry(placed, component);
    }

    // The outer faces of all elements and fillings enclose the building: together they form its solid.
    void hull() {
        std::vector<std::string> members;
        document_.forEach([&](const PlacedPlan& placed, int c, const Component& component) {
            if (component.kind != Kind::Element || component.isStandIn) return;
            if (component.hullPart == HullPart::Ground) hullSurface(placed, c, "GroundSurface", members);
            hullSurface(placed, c, component.hullPart == HullPart::Roof ? "RoofSurface" : "WallSurface", members);
        });
        const GmlElement property(out_, "bldg:lod4Solid", {}, "\n");
        gml_.solid(document_.id + "_solid", [&] {
            for (const std::string& id : members) gml_.memberLink(id);
        });
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
        gml_.multiSurface("bldg:lod4MultiSurface", "", [&] {
            for (const auto& [number, face] : outerFaces(*placed.plan, placed.component(component), type)) {
                members.push_back(polygonId(document_.idOf(placed, component), number));
                member(placed, *face, members.back());
            }
        });
    }

    void hullSurface(const PlacedPlan& placed, int component, std::string_view type,
                     std::vector<std::string>& members) {
        if (outerFaces(*placed.plan, placed.component(component), type).empty()) return;
        const GmlElement property(out_, "bldg:boundedBy", {}, "\n");
        const GmlElement surface(out_, "bldg:" + std::string(type),
                                 document_.idOf(placed, component) + (type == "GroundSurface" ? "_ground" : "_outer"));
        gml_.text("gml:name", document_.nameOf(placed, component));
        out_ << "\n";
        outerMultiSurface(placed, component, type, members);
        for (const int child : placed.plan->children[std::size_t(component)]) {
            const Component& filling = placed.component(child);
            if (outerFaces(*placed.plan, filling, "").empty()) continue;
            const GmlElement opening(out_, "bldg:opening", {}, "\n");
            const GmlElement element = feature(placed, child, filling.kind == Kind::Door ? "bldg:Door" : "bldg:Window");
            outerMultiSurface(placed, child, "", members);
        }
    }

    void rooms(const PlacedPlan& placed, int unit) {
        for (std::size_t c = 0; c < placed.plan->components.size() && !out_.hasFailed(); ++c) {
            const Component& component = placed.plan->components[c];
            if (component.kind != Kind::Room || component.isStandIn || component.unit != unit) continue;
            const GmlElement property(out_, "bldg:interiorRoom", {}, "\n");
            room(placed, int(c));
        }
    }

    void room(const PlacedPlan& placed, int component) {
        const std::string id = document_.idOf(placed, component);
        const std::vector<BoundaryGroup> groups = boundaryGroups(*placed.plan, component);
        const GmlElement element = feature(placed, component, "bldg:Room");
        function(placed.component(component));
        roomSolid(placed, component, groups);
        int number = 0;
        for (const BoundaryGroup& group : groups) {
            const GmlElement property(out_, "bldg:boundedBy", {}, "\n");
            const GmlElement surface(out_, "bldg:" + std::string(group.type), id + "_b" + std::to_string(number++));
            if (!group.faces.empty()) roomSurfaces(placed, component, group);
            for (const BoundaryGroup& opening : group.openings) openingOfRoom(placed, component, opening, number++);
        }
        furnish(placed, component);
    }

    void roomSolid(const PlacedPlan& placed, int room, const std::vector<BoundaryGroup>& groups) {
        const std::string id = document_.idOf(placed, room);
        std::set<int> openingFaces;
        for (const BoundaryGroup& group : groups)
            for (const BoundaryGroup& opening : group.openings)
                openingFaces.insert(opening.faces.begin(), opening.faces.end());
        const GmlElement property(out_, "bldg:lod4Solid", {}, "\n");
        gml_.solid(id + "_solid", [&] {
            const std::vector<Face>& faces = placed.component(room).shells.front().faces;
            for (std::size_t f = 0; f < faces.size(); ++f)
                if (!isThematic_ && openingFaces.count(int(f)) != 0)
                    reversedMember(placed, faces[f], polygonId(id, f));
                else
                    gml_.memberLink(polygonId(id, f));
        });
    }

    // A face already written by an element or an earlier room is referenced and reversed.
    [[nodiscard]] bool isWrittenElsewhere(const PlacedPlan& placed, int room, const Face& face) const {
        if (face.neighbor < 0 || face.neighborFace < 0) return false;
        const Component& neighbor = placed.component(face.neighbor);
        if (neighbor.isStandIn) return false;
        return neighbor.kind == Kind::Room ? face.neighbor < room : neighbor.kind == Kind::Element && !isThematic_;
    }

    void roomSurfaces(const PlacedPlan& placed, int room, const BoundaryGroup& group) {
        gml_.multiSurface("bldg:lod4MultiSurface", "", [&] {
            for (const int f : group.faces) {
                const Face& face = placed.component(room).shells.front().faces[std::size_t(f)];
                const std::string polygon = polygonId(document_.idOf(placed, room), std::size_t(f));
                if (isWrittenElsewhere(placed, room, face))
                    reversedMember(placed, face, polygon);
                else
                    member(placed, face, polygon);
            }
        });
    }

    // Full: the closed solid of the filling, in the first room that touches it. Thematic: only the side facing this
    // room.
    void openingOfRoom(const PlacedPlan& placed, int room, const BoundaryGroup& opening, int number) {
        const int filling = opening.neighbor;
        const std::string_view name = opening.type == "DoorSurface" ? "bldg:Door" : "bldg:Window";
        const std::string id = document_.idOf(placed, filling);
        if (!isThematic_ && firstRoom(*placed.plan, filling) != room) {
            out_ << "<bldg:opening xlink:href=\"#" << id << "\"/>\n";
            return;
        }
        const GmlElement property(out_, "bldg:opening", {}, "\n");
        if (isThematic_) {
            const GmlElement element(out_, name, document_.idOf(placed, room) + "_b" + std::to_string(number));
            gml_.text("gml:name", document_.nameOf(placed, filling));
            out_ << "\n";
            roomSurfaces(placed, room, opening);
            return;
        }
        const GmlElement element = feature(placed, filling, name);
        gml_.multiSurface("bldg:lod4MultiSurface", "", [&] {
            std::size_t polygon = 0;
            for (const Shell& shell : placed.component(filling).shells)
                for (const Face& face : shell.faces) member(placed, face, polygonId(id, polygon++));
        });
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
                if (placed.component(child).kind != kind) continue;
                const bool isFurniture = kind == Kind::Furniture;
                const GmlElement property(out_, isFurniture ? "bldg:interiorFurniture" : "bldg:roomInstallation", {},
                                          "\n");
                if (isFurniture)
                    furniture(placed, child);
                else
                    installation(placed, child, "bldg:IntBuildingInstallation");
            }
    }

    void furniture(const PlacedPlan& placed, int component) {
        const Component& c = placed.component(component);
        const GmlElement element = feature(placed, component, "bldg:BuildingFurniture");
        function(c);
        if (c.instance)
            implicitGeometry(placed, component, *c.instance);
        else
            lod4Geometry(placed, component);
    }

    // The first instance contains the shape, the others reference it.
    void implicitGeometry(const PlacedPlan& placed, int component, const Instance& instance) {
        const GmlElement property(out_, "bldg:lod4ImplicitRepresentation"), element(out_, "core:ImplicitGeometry");
        gml_.text("core:transformationMatrix", matrixText(placed, instance, " "));
        if (!templateId_.empty()) {
            out_ << "<core:relativeGMLGeometry xlink:href=\"#" << templateId_ << "\"/>";
        } else {
            templateId_ = document_.idOf(placed, component) + "_template";
            const GmlElement geometry(out_, "core:relativeGMLGeometry");
            gml_.solid(templateId_, [&] {
                for (const Face& face : instance.shell.faces)
                    gml_.member("", face.rings, [&](std::uint32_t i) { position(instance.vertices[i], 3); });
            });
        }
        const GmlElement reference(out_, "core:referencePoint"), point(out_, "gml:Point"), pos(out_, "gml:pos");
        position(placed.placement.at(instance.shift), placed.placement.decimals());
    }

    void unit(const PlacedPlan& placed, int component) {
        const GmlElement property(out_, "bldg:consistsOfBuildingPart", {}, "\n");
        const GmlElement element = feature(placed, component, "bldg:BuildingPart");
        function(placed.component(component));
        for (const bool isOutside : {true, false})
            for (std::size_t c = 0; c < placed.plan->components.size(); ++c)
                installationOfBuilding(placed, int(c), component, isOutside);
        {
            const GmlElement geometry(out_, "bldg:lod4Solid", {}, "\n");
            solid(placed, component);
        }
        rooms(placed, component);
    }

    void storeyGroups() {
        document_.forEach([&](const PlacedPlan& placed, int c, const Component& component) {
            if (component.kind != Kind::Storey) return;
            out_ << "<core:cityObjectMember>\n";
            storeyGroup(placed, c);
            out_ << "\n</core:cityObjectMember>\n";
        });
    }

    void storeyGroup(const PlacedPlan& placed, int storey) {
        const GmlElement element = feature(placed, storey, "grp:CityObjectGroup");
        gml_.text("grp:class", "buildingSeparation").text("grp:function", "storey");
        out_ << "\n";
        for (std::size_t c = 0; c < placed.plan->components.size(); ++c) {
            const Component& component = placed.plan->components[c];
            if (component.storey != storey || !isGrouped(component)) continue;
            if (isThematic_ && component.kind == Kind::Element) continue;
            out_ << "<grp:groupMember role=\"" << className(component.kind) << "\" xlink:href=\"#"
                 << document_.idOf(placed, int(c)) << "\"/>\n";
        }
        out_ << "<grp:parent xlink:href=\"#" << document_.id << "\"/>";
    }

    bool isThematic_;
    std::string templateId_;  ///< of the building's first implicit geometry
};

}  // namespace

void writeCityGml2(SampleSource& source, bool isThematic, TextSink& out) {
    CityGml2Writer(source, isThematic, out).write();
}

}  // namespace svt::samples
