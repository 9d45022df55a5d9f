#include <svt/samples/formats/gml_text.hpp>

#include <svt/core/text.hpp>

#include <array>
#include <map>
#include <utility>
#include <variant>

namespace svt::samples {
namespace {

// Coloured materials of a building with the ids of the polygons that have them.
std::map<Material, std::vector<std::string>> coloredPolygons(const Document& document, bool isThematic) {
    std::map<Material, std::vector<std::string>> polygons;
    document.forEach([&](const PlacedPlan& placed, int c, const Component& component) {
        if (!fillsSpace(component) || component.kind == Kind::Room || component.isStandIn) return;
        std::size_t number = 0;
        for (const Shell& shell : component.shells) {
            const Material material = document.shown(shell.material);
            for (const Face& face : shell.faces) {
                const bool isWritten = !isThematic || face.neighbor < 0;
                if (info(material).isColoredInGml && isWritten)
                    polygons[material].push_back(polygonId(document.idOf(placed, c), number));
                ++number;
            }
        }
    });
    return polygons;
}

}  // namespace

GmlElement::GmlElement(TextSink& out, std::string_view name, std::string_view id, std::string_view after)
    : out_(&out), name_(name), after_(after) {
    out << "<" << name;
    if (!id.empty()) out << " gml:id=\"" << id << "\"";
    out << ">";
}

void GmlText::head(std::initializer_list<std::string_view> prefixes) {
    constexpr std::array<std::pair<std::string_view, std::string_view>, 6> kModules{{{"app", "appearance"},
                                                                                     {"bldg", "building"},
                                                                                     {"con", "construction"},
                                                                                     {"gen", "generics"},
                                                                                     {"grp", "cityobjectgroup"},
                                                                                     {"luse", "landuse"}}};
    constexpr std::string_view kNamespace = "http://www.opengis.net/citygml/";
    out_ << "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<core:CityModel xmlns:core=\"" << kNamespace << version_;
    for (const auto& [prefix, module] : kModules)
        for (const std::string_view wanted : prefixes)
            if (wanted == prefix) out_ << "\" xmlns:" << prefix << "=\"" << kNamespace << module << "/" << version_;
    out_ << "\" xmlns:gml=\"http://www.opengis.net/gml" << (isThird() ? "/3.2" : "")
         << "\" xmlns:xlink=\"http://www.w3.org/1999/xlink\">\n";
}

GmlText& GmlText::text(std::string_view name, std::string_view value) {
    out_ << "<" << name << ">" << value << "</" << name << ">";
    return *this;
}

void GmlText::genericAttribute(const Attribute& attribute) {
    const double* number = std::get_if<double>(&attribute.value);
    const bool isWhole = std::holds_alternative<std::int64_t>(attribute.value);
    std::string type = number != nullptr ? attribute.unit.empty() ? "Double" : "Measure" : isWhole ? "Int" : "String";
    if (isThird()) {
        out_ << "<core:genericAttribute><gen:" << type << "Attribute>";
        text("gen:name", attribute.name);
    } else {
        type[0] = lowerAscii(type[0]);
        out_ << "<gen:" << type << "Attribute name=\"" << attribute.name << "\">";
    }
    out_ << "<gen:value";
    if (!attribute.unit.empty()) out_ << " uom=\"" << attribute.unit << "\"";
    out_ << ">" << (number != nullptr ? decimalText(*number) : toText(attribute.value)) << "</gen:value></gen:" << type
         << (isThird() ? "Attribute></core:genericAttribute>" : "Attribute>");
}

void CityGmlWriter::beginModel(std::initializer_list<std::string_view> prefixes) {
    gml_.head(prefixes);
    gml_.text("gml:name", source_.title());
    out_ << "\n";
    gml_.envelope("urn:ogc:def:crs,crs:EPSG::25832,crs:EPSG::7837", [&, corners = source_.envelope()](bool isUpper) {
        position(corners[isUpper ? 1 : 0], source_.decimals());
    });
    const std::vector<WorldPoint> ground = source_.ground();
    if (ground.empty()) return;
    out_ << "<core:cityObjectMember>\n<luse:LandUse gml:id=\"ground\">";
    gml_.text("gml:name", "Ground");
    const std::string_view property = gml_.isThird() ? "core:lod1MultiSurface" : "luse:lod1MultiSurface";
    out_ << "<" << property << "><gml:MultiSurface gml:id=\"ground_surface\"><gml:surfaceMember>";
    gml_.polygon("", std::array{ground}, [&](const WorldPoint& corner) { position(corner, source_.decimals()); });
    out_ << "</gml:surfaceMember></gml:MultiSurface></" << property << "></luse:LandUse>\n</core:cityObjectMember>\n";
}

void CityGmlWriter::beginBuilding(bool isThematic) {
    out_ << "<core:cityObjectMember>\n<bldg:Building gml:id=\"" << document_.id << "\">";
    gml_.text("gml:name", document_.name);
    out_ << "\n";
    appearance(isThematic);
    gml_.text("bldg:function", document_.function).text("bldg:roofType", document_.roofType);
    gml_.text("bldg:storeysAboveGround", std::to_string(document_.storeys));
    out_ << "\n";
}

void CityGmlWriter::appearance(bool isThematic) {
    const auto colored = coloredPolygons(document_, isThematic);
    if (colored.empty()) return;
    const GmlElement property(out_, gml_.isThird() ? "core:appearance" : "app:appearance", {}, "\n");
    const GmlElement appearance(out_, "app:Appearance", document_.id + "_appearance");
    gml_.text("app:theme", "sample");
    out_ << "\n";
    for (const auto& [material, polygons] : colored) {
        const MaterialInfo& shown = info(material);
        const GmlElement member(out_, gml_.isThird() ? "app:surfaceData" : "app:surfaceDataMember", {}, "\n");
        const GmlElement element(out_, "app:X3DMaterial", document_.id + "_material" + std::to_string(int(material)));
        gml_.text("gml:name", shown.name);
        gml_.text("app:diffuseColor",
                  decimalText(shown.color[0]) + " " + decimalText(shown.color[1]) + " " + decimalText(shown.color[2]));
        gml_.text("app:transparency", decimalText(shown.transparency));
        for (const std::string& polygon : polygons) gml_.text("app:target", "#" + polygon);
    }
}

void CityGmlWriter::position(const WorldPoint& point, int decimals) {
    out_.fixed(point.x, decimals) << " ";
    out_.fixed(point.y, decimals) << " ";
    out_.fixed(point.z, decimals);
}

void CityGmlWriter::member(const PlacedPlan& placed, const Face& face, std::string_view id) {
    gml_.member(id, face.rings, [&](std::uint32_t i) {
        position(placed.placement.at(placed.plan->vertices[i]), placed.placement.decimals());
    });
}

GmlElement CityGmlWriter::feature(const PlacedPlan& placed, int component, std::string_view name) {
    GmlElement element(out_, name, document_.idOf(placed, component));
    gml_.text("gml:name", document_.nameOf(placed, component));
    for (const Attribute& attribute : document_.attributesOf(placed, component)) gml_.genericAttribute(attribute);
    // CityGML 2.0 has no class for these.
    const Kind kind = placed.component(component).kind;
    if (!gml_.isThird() && (kind == Kind::Element || kind == Kind::Unit))
        gml_.genericAttribute({"svtClass", std::string(className(kind)), ""});
    out_ << "\n";
    return element;
}

void CityGmlWriter::function(const Component& component) {
    if (!component.function.empty()) gml_.text("bldg:function", component.function);
}

void CityGmlWriter::solid(const PlacedPlan& placed, int component) {
    const std::vector<Shell>& shells = placed.component(component).shells;
    const std::string id = document_.idOf(placed, component);
    std::size_t number = 0;
    const auto shell = [&](const std::string& solidId, const Shell& own) {
        const bool hasIds = !gml_.isThird() || info(document_.shown(own.material)).isColoredInGml;
        gml_.solid(solidId, [&] {
            for (const Face& face : own.faces) {
                member(placed, face, hasIds ? polygonId(id, number) : "");
                ++number;
            }
        });
    };
    if (shells.size() == 1) return shell(id + "_solid", shells.front());
    const GmlElement composite(out_, "gml:CompositeSolid", id + "_solid");
    for (std::size_t s = 0; s < shells.size(); ++s) {
        const GmlElement solidMember(out_, "gml:solidMember");
        shell(id + "_solid" + std::to_string(s), shells[s]);
    }
}

std::string polygonId(const std::string& componentId, std::size_t number) {
    return componentId + "_p" + std::to_string(number);
}

}  // namespace svt::samples
