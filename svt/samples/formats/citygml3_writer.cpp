// CityGML 3.0. One lod3Solid per component; a room's solid references the polygons of its boundary
// surfaces by XLink. Properties are in schema order.
#include <svt/samples/formats/writers.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <variant>

namespace svt::samples {
namespace {

class CityGml3Writer {
public:
    CityGml3Writer(SampleSource& source, TextSink& out) : source_(source), out_(out), gml_(out) {}

    void write() {
        out_
            << "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
               "<core:CityModel xmlns:core=\"http://www.opengis.net/citygml/3.0\""
               " xmlns:app=\"http://www.opengis.net/citygml/appearance/3.0\""
               " xmlns:bldg=\"http://www.opengis.net/citygml/building/3.0\""
               " xmlns:con=\"http://www.opengis.net/citygml/construction/3.0\""
               " xmlns:gen=\"http://www.opengis.net/citygml/generics/3.0\""
               " xmlns:luse=\"http://www.opengis.net/citygml/landuse/3.0\""
               " xmlns:gml=\"http://www.opengis.net/gml/3.2\" xmlns:xlink=\"http://www.w3.org/1999/xlink\">\n<gml:name>"
            << source_.title() << "</gml:name>\n";
        gml_.envelope(source_);
        gml_.ground(source_, "core");
        for (std::int64_t i = 0; i < source_.buildingCount() && !out_.hasFailed(); ++i) {
            document_ = source_.building(i);
            building();
        }
        out_ << "</core:CityModel>\n";
    }

private:
    void building() {
        out_ << "<core:cityObjectMember>\n<bldg:Building gml:id=\"" << document_.id << "\"><gml:name>" << document_.name
             << "</gml:name>\n";
        gml_.appearance(document_, false, "core:appearance", "app:surfaceData");
        out_ << "<bldg:function>" << document_.function << "</bldg:function><bldg:roofType>" << document_.roofType
             << "</bldg:roofType><bldg:storeysAboveGround>" << document_.storeys << "</bldg:storeysAboveGround>\n";
        eachTop(Kind::Element, "buildingConstructiveElement", &CityGml3Writer::element);
        eachTop(Kind::Installation, "buildingInstallation", &CityGml3Writer::installation);
        eachTop(Kind::Room, "buildingRoom", &CityGml3Writer::room);
        eachTop(Kind::Storey, "buildingSubdivision", &CityGml3Writer::storey);
        out_ << "</bldg:Building>\n</core:cityObjectMember>\n";
    }

    // Writes every component of the kind that belongs directly to the building, inside the property.
    void eachTop(Kind kind, std::string_view property, void (CityGml3Writer::*writeOne)(const PlacedPlan&, int)) {
        for (const PlacedPlan& placed : document_.plans)
            for (std::size_t c = 0; c < placed.plan->components.size() && !out_.hasFailed(); ++c) {
                const Component& component = placed.plan->components[c];
                if (component.kind != kind || component.parent >= 0 || component.isStandIn) continue;
                out_ << "<bldg:" << property << ">";
                (this->*writeOne)(placed, int(c));
                out_ << "</bldg:" << property << ">\n";
            }
    }

    void eachChild(const PlacedPlan& placed, int parent, Kind kind, std::string_view property,
                   void (CityGml3Writer::*writeOne)(const PlacedPlan&, int)) {
        for (const int child : placed.plan->children[std::size_t(parent)]) {
            if (placed.plan->components[std::size_t(child)].kind != kind) continue;
            out_ << "<" << property << ">";
            (this->*writeOne)(placed, child);
            out_ << "</" << property << ">\n";
        }
    }

    // Opening tag, name and attributes.
    void open(const PlacedPlan& placed, int component, std::string_view tag) {
        out_ << "<" << tag << " gml:id=\"" << document_.idOf(placed, component) << "\"><gml:name>"
             << document_.nameOf(placed, component) << "</gml:name>";
        for (const Attribute& attribute : document_.attributesOf(placed, component)) genericAttribute(attribute);
        out_ << "\n";
    }

    void genericAttribute(const Attribute& attribute) {
        std::string_view type = "StringAttribute";
        if (std::holds_alternative<std::int64_t>(attribute.value)) type = "IntAttribute";
        if (std::holds_alternative<double>(attribute.value))
            type = attribute.unit.empty() ? "DoubleAttribute" : "MeasureAttribute";
        out_ << "<core:genericAttribute><gen:" << type << "><gen:name>" << attribute.name << "</gen:name><gen:value";
        if (!attribute.unit.empty()) out_ << " uom=\"" << attribute.unit << "\"";
        out_ << ">";
        if (const double* number = std::get_if<double>(&attribute.value))
            out_ << decimalText(*number);
        else
            out_ << toText(attribute.value);
        out_ << "</gen:value></gen:" << type << "></core:genericAttribute>";
    }

    void function(const PlacedPlan& placed, int component) {
        const std::string& text = placed.plan->components[std::size_t(component)].function;
        if (!text.empty()) out_ << "<bldg:function>" << text << "</bldg:function>";
    }

    // One gml:Solid, or a gml:CompositeSolid for touching solids.
    void solid(const PlacedPlan& placed, int component) {
        const Component& c = placed.plan->components[std::size_t(component)];
        const std::string id = document_.idOf(placed, component);
        const bool isComposite = c.shells.size() > 1;
        out_ << "<core:lod3Solid>";
        if (isComposite) out_ << "<gml:CompositeSolid gml:id=\"" << id << "_solid\">";
        std::size_t number = 0;
        for (std::size_t s = 0; s < c.shells.size(); ++s) {
            const bool isColored = info(document_.shown(c.shells[s].material)).isColoredInGml;
            if (isComposite) out_ << "<gml:solidMember>";
            out_ << "<gml:Solid gml:id=\"" << id << "_solid";
            if (isComposite) out_ << std::int64_t(s);
            out_ << "\"><gml:exterior><gml:Shell>\n";
            for (const Face& face : c.shells[s].faces) {
                out_ << "<gml:surfaceMember>";
                gml_.polygon(placed, face, isColored ? polygonId(id, number) : std::string());
                out_ << "</gml:surfaceMember>\n";
                ++number;
            }
            out_ << "</gml:Shell></gml:exterior></gml:Solid>";
            if (isComposite) out_ << "</gml:solidMember>";
        }
        if (isComposite) out_ << "</gml:CompositeSolid>";
        out_ << "</core:lod3Solid>\n";
    }

    void element(const PlacedPlan& placed, int component) {
        open(placed, component, "bldg:BuildingConstructiveElement");
        solid(placed, component);
        const Component& c = placed.plan->components[std::size_t(component)];
        for (const Attribute& attribute : c.attributes)
            if (attribute.name == "loadBearing")
                out_ << "<con:isStructuralElement>" << toText(attribute.value) << "</con:isStructuralElement>";
        eachChild(placed, component, Kind::Window, "con:filling", &CityGml3Writer::filling);
        eachChild(placed, component, Kind::Door, "con:filling", &CityGml3Writer::filling);
        function(placed, component);
        out_ << "</bldg:BuildingConstructiveElement>";
    }

    void filling(const PlacedPlan& placed, int component) {
        const bool isDoor = placed.plan->components[std::size_t(component)].kind == Kind::Door;
        const std::string_view tag = isDoor ? "con:Door" : "con:Window";
        open(placed, component, tag);
        solid(placed, component);
        out_ << "</" << tag << ">";
    }

    void installation(const PlacedPlan& placed, int component) {
        open(placed, component, "bldg:BuildingInstallation");
        solid(placed, component);
        const bool isOutside = placed.plan->components[std::size_t(component)].isOutside;
        out_ << "<con:relationToConstruction>" << (isOutside ? "outside" : "inside") << "</con:relationToConstruction>";
        function(placed, component);
        out_ << "</bldg:BuildingInstallation>";
    }

    void furniture(const PlacedPlan& placed, int component) {
        open(placed, component, "bldg:BuildingFurniture");
        solid(placed, component);
        function(placed, component);
        out_ << "</bldg:BuildingFurniture>";
    }

    void surfaces(const PlacedPlan& placed, int room, const BoundaryGroup& group, const std::string& id) {
        if (!group.faces.empty()) {
            out_ << "<core:lod3MultiSurface><gml:MultiSurface gml:id=\"" << id << "_surface\">\n";
            const Shell& shell = placed.plan->components[std::size_t(room)].shells.front();
            for (const int f : group.faces) {
                out_ << "<gml:surfaceMember>";
                gml_.polygon(placed, shell.faces[std::size_t(f)],
                             polygonId(document_.idOf(placed, room), std::size_t(f)));
                out_ << "</gml:surfaceMember>\n";
            }
            out_ << "</gml:MultiSurface></core:lod3MultiSurface>";
        }
    }

    void room(const PlacedPlan& placed, int component) {
        const Component& c = placed.plan->components[std::size_t(component)];
        const std::string id = document_.idOf(placed, component);
        open(placed, component, "bldg:BuildingRoom");
        int number = 0;
        for (const BoundaryGroup& group : boundaryGroups(*placed.plan, component)) {
            const std::string tag = (group.type == "ClosureSurface" ? "core:" : "con:") + std::string(group.type);
            const std::string surfaceId = id + "_b" + std::to_string(number++);
            out_ << "<core:boundary><" << tag << " gml:id=\"" << surfaceId << "\">";
            surfaces(placed, component, group, surfaceId);
            for (const BoundaryGroup& opening : group.openings) {
                const std::string openingTag = "con:" + std::string(opening.type);
                const std::string openingId = id + "_b" + std::to_string(number++);
                out_ << "<con:fillingSurface><" << openingTag << " gml:id=\"" << openingId << "\">";
                surfaces(placed, component, opening, openingId);
                out_ << "</" << openingTag << "></con:fillingSurface>";
            }
            out_ << "</" << tag << "></core:boundary>\n";
        }
        out_ << "<core:lod3Solid><gml:Solid gml:id=\"" << id << "_solid\"><gml:exterior><gml:Shell>\n";
        for (std::size_t f = 0; f < c.shells.front().faces.size(); ++f)
            out_ << "<gml:surfaceMember xlink:href=\"#" << polygonId(id, f) << "\"/>\n";
        out_ << "</gml:Shell></gml:exterior></gml:Solid></core:lod3Solid>\n";
        function(placed, component);
        eachChild(placed, component, Kind::Furniture, "bldg:buildingFurniture", &CityGml3Writer::furniture);
        eachChild(placed, component, Kind::Installation, "bldg:buildingInstallation", &CityGml3Writer::installation);
        out_ << "</bldg:BuildingRoom>";
    }

    // Links to the components for which `isMember` holds.
    template <class Predicate>
    void links(const PlacedPlan& placed, Kind kind, std::string_view property, const Predicate& isMember) {
        for (std::size_t c = 0; c < placed.plan->components.size(); ++c) {
            const Component& component = placed.plan->components[c];
            if (component.kind != kind || !isGrouped(component) || !isMember(component)) continue;
            out_ << "<bldg:" << property << " xlink:href=\"#" << document_.idOf(placed, int(c)) << "\"/>\n";
        }
    }

    void storey(const PlacedPlan& placed, int storey) {
        open(placed, storey, "bldg:Storey");
        const auto isMember = [storey](const Component& c) { return c.storey == storey; };
        function(placed, storey);
        links(placed, Kind::Element, "buildingConstructiveElement", isMember);
        links(placed, Kind::Installation, "buildingInstallation", isMember);
        links(placed, Kind::Room, "buildingRoom", isMember);
        for (std::size_t c = 0; c < placed.plan->components.size(); ++c) {
            const Component& component = placed.plan->components[c];
            if (component.kind != Kind::Unit || component.storey != storey) continue;
            out_ << "<bldg:buildingUnit>";
            unit(placed, int(c));
            out_ << "</bldg:buildingUnit>\n";
        }
        out_ << "</bldg:Storey>";
    }

    void unit(const PlacedPlan& placed, int unit) {
        open(placed, unit, "bldg:BuildingUnit");
        const auto isMember = [unit](const Component& c) { return c.unit == unit; };
        solid(placed, unit);
        function(placed, unit);
        links(placed, Kind::Element, "buildingConstructiveElement", isMember);
        links(placed, Kind::Installation, "buildingInstallation", isMember);
        links(placed, Kind::Room, "buildingRoom", isMember);
        out_ << "</bldg:BuildingUnit>";
    }

    SampleSource& source_;
    TextSink& out_;
    GmlText gml_;
    Document document_;
};

}  // namespace

void writeCityGml3(SampleSource& source, TextSink& out) { CityGml3Writer(source, out).write(); }

}  // namespace svt::samples
