#include <svt/core/text.hpp>
#include <svt/crs/crs_facts.hpp>
#include <svt/crs/crs_name.hpp>
#include <svt/writers/ade/model_document.hpp>
#include <svt/writers/ladm/ladm_owner.hpp>
#include <svt/writers/ladm_writer.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

namespace svt::writers {
namespace {

using analyze::LandAdministration;
using analyze::LegalSpace;
using volume::kNoLabel;

constexpr std::string_view kLadmHead =
    "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
    "<core:CityModel xmlns:core=\"http://www.opengis.net/citygml/3.0\" "
    "xmlns:bldg=\"http://www.opengis.net/citygml/building/3.0\" "
    "xmlns:gen=\"http://www.opengis.net/citygml/generics/3.0\" xmlns:gml=\"http://www.opengis.net/gml/3.2\">\n";

std::string stringAttribute(std::string_view name, std::string_view value) {
    return fmt::format("<gen:StringAttribute><gen:name>{}</gen:name><gen:value>{}</gen:value></gen:StringAttribute>",
                       xmlContent(name), xmlContent(value));
}
std::string measureAttribute(std::string_view name, double value, std::string_view unit) {
    return fmt::format(
        "<gen:MeasureAttribute><gen:name>{}</gen:name><gen:value uom=\"{}\">{:.6g}</gen:value></gen:MeasureAttribute>",
        name, unit, value);
}
// An attribute of the model with its type.
std::string typedAttribute(const Attribute& attribute) {
    const auto typed = [&](std::string_view type, std::string_view unit) {
        return fmt::format("<gen:{0}Attribute><gen:name>{1}</gen:name><gen:value{2}>{3}</gen:value></gen:{0}Attribute>",
                           type, xmlContent(attribute.name), unit, xmlContent(toText(attribute.value)));
    };
    if (std::holds_alternative<std::int64_t>(attribute.value)) return typed("Int", "");
    if (!std::holds_alternative<double>(attribute.value)) return typed("String", "");
    if (attribute.unit.empty()) return typed("Double", "");
    return typed("Measure", fmt::format(" uom=\"{}\"", xmlAttribute(attribute.unit)));
}
std::string inFeature(std::string_view attribute) {
    return fmt::format("<core:genericAttribute>{}</core:genericAttribute>\n", attribute);
}
std::string attributeSet(std::string_view name, const std::vector<std::string>& attributes) {
    std::string text = fmt::format("<gen:GenericAttributeSet><gen:name>{}</gen:name>", name);
    for (const std::string& attribute : attributes)
        text += fmt::format("<gen:genericAttribute>{}</gen:genericAttribute>", attribute);
    return inFeature(text + "</gen:GenericAttributeSet>");
}

// A name of an official system with north first: its coordinates have this order, too.
bool isNorthFirst(std::string_view crsName) {
    const bool isOfficial = crsName.starts_with("urn:") || crsName.starts_with("http");
    const auto code = static_cast<int>(crs::epsgCodeOf(crsName));
    return isOfficial && code != 0 && crs::factsOf(code).order == crs::AxisOrder::NorthEast;
}

class LadmDocument {
public:
    LadmDocument(const LandAdministration& administration, const volume::SemanticVolume& volume)
        : all_(administration),
          volume_(volume),
          crsName_(volume.crsName.substr(0, volume.crsName.find(" ("))),
          isNorthFirst_(isNorthFirst(crsName_)) {}

    std::string make() {
        std::map<std::uint32_t, std::vector<std::uint32_t>> spacesOf;  // by building; kNoLabel: in none
        Box3d box;
        for (std::uint32_t s = 0; s < all_.spaces.spaces.size(); ++s) {
            const LegalSpace& space = all_.spaces.spaces[s];
            box.add(space.box);
            spacesOf[buildingOf(space.label)].push_back(s);
        }
        text_ = kLadmHead;
        if (!volume_.modelName.empty())
            text_ += fmt::format("<gml:name>{}</gml:name>\n", xmlContent(volume_.modelName));
        addEnvelope(box);
        for (const auto& [building, spaces] : spacesOf) addBuilding(building, spaces);
        return std::move(text_) + "</core:CityModel>\n";
    }

private:
    [[nodiscard]] const volume::Label& labelOf(std::uint32_t label) const { return volume_.labels.labels[label]; }

    // The building that contains a label, or is it.
    [[nodiscard]] std::uint32_t buildingOf(std::uint32_t label) const {
        while (label != kNoLabel && labelOf(label).className != "Building") label = labelOf(label).parent;
        return label;
    }

    [[nodiscard]] std::string point(Vec3d p) const {
        return fmt::format("{:.6f} {:.6f} {:.6f}", isNorthFirst_ ? p.y : p.x, isNorthFirst_ ? p.x : p.y, p.z);
    }

    void addEnvelope(const Box3d& box) {
        if (box.isEmpty()) return;
        const std::string crs = crsName_.empty() ? "" : fmt::format(" srsName=\"{}\"", xmlAttribute(crsName_));
        text_ += fmt::format(
            "<gml:boundedBy><gml:Envelope{} srsDimension=\"3\"><gml:lowerCorner>{}</gml:lowerCorner>"
            "<gml:upperCorner>{}</gml:upperCorner></gml:Envelope></gml:boundedBy>\n",
            crs, point(box.min), point(box.max));
    }

    void addBuilding(std::uint32_t building, const std::vector<std::uint32_t>& spaces) {
        const std::string id = building == kNoLabel ? "legal_spaces" : gmlId(labelOf(building).id, building);
        text_ += fmt::format("<core:cityObjectMember>\n<bldg:Building gml:id=\"{}\">", id);
        if (building != kNoLabel) text_ += fmt::format("<gml:name>{}</gml:name>", xmlContent(labelOf(building).name));
        text_ += '\n';
        for (const std::uint32_t space : spaces)
            if (all_.spaces.spaces[space].label == building) {
                addAttributes(space);
                addBody(space, id);
            }
        for (const std::uint32_t space : spaces)
            if (all_.spaces.spaces[space].label != building) addUnit(space);
        text_ += "</bldg:Building>\n</core:cityObjectMember>\n";
    }

    void addUnit(std::uint32_t space) {
        const std::uint32_t label = all_.spaces.spaces[space].label;
        const std::string id = gmlId(labelOf(label).id, label);
        // Without a name, an id that XML does not allow is the name.
        const bool isNamed = !labelOf(label).name.empty() || id == labelOf(label).id;
        text_ += fmt::format("<bldg:buildingSubdivision><bldg:BuildingUnit gml:id=\"{}\"><gml:name>{}</gml:name>\n", id,
                             xmlContent(isNamed ? labelOf(label).name : labelOf(label).id));
        addAttributes(space);
        addBody(space, id);
        text_ += "</bldg:BuildingUnit></bldg:buildingSubdivision>\n";
    }

    void addAttributes(std::uint32_t index) {
        const LegalSpace& space = all_.spaces.spaces[index];
        const volume::Label& label = labelOf(space.label);
        for (const Attribute& attribute : label.attributes)
            if (!isReplacedOwner(all_, attribute.name)) text_ += inFeature(typedAttribute(attribute));
        if (const std::string owner = soleOwner(all_, index); !owner.empty())
            text_ += inFeature(stringAttribute("owner", owner));
        std::vector<std::string> spatial{stringAttribute("suID", label.id), stringAttribute("class", label.className),
                                         stringAttribute("body", analyze::spaceBodyName(space.body)),
                                         stringAttribute("common", space.isCommon ? "true" : "false")};
        if (space.totalVolume) spatial.push_back(measureAttribute("volume", *space.totalVolume, "m3"));
        if (space.bodyVolume) spatial.push_back(measureAttribute("bodyVolume", *space.bodyVolume, "m3"));
        text_ += attributeSet("LA_LegalSpaceBuildingUnit", spatial);
        for (const analyze::PartyRight& right : all_.rights) {
            if (all_.units[right.unit].space != index) continue;
            std::vector<std::string> set{stringAttribute("type", right.rightType().name),
                                         stringAttribute("party", all_.parties[right.party])};
            if (right.fraction) set.push_back(stringAttribute("share", analyze::shareText(right)));
            set.push_back(stringAttribute("LA_AdministrativeSource", all_.sources[right.source]));
            text_ += attributeSet(analyze::ladmClassName(right.rightType().of), set);
        }
        text_ += attributeSet("LA_SpatialSource", {stringAttribute("name", all_.spatialFile)});
    }

    void addBody(std::uint32_t index, const std::string& id) {
        const LegalSpace& space = all_.spaces.spaces[index];
        std::vector<std::string> shells;
        if (space.body == analyze::SpaceBody::Voxels) {
            shells.push_back(shellOfFaces(index));
        } else {
            for (const auto& solid : space.solids) {
                std::string shell;
                for (const analyze::SpaceTriangle& triangle : solid)
                    shell += polygon({{triangle.begin(), triangle.end()}});
                shells.push_back(std::move(shell));
            }
        }
        std::erase(shells, std::string());
        if (shells.empty()) return;
        const auto solidOf = [](const std::string& shell, const std::string& name) {
            return fmt::format(
                "<gml:Solid gml:id=\"{}\"><gml:exterior><gml:Shell>\n{}</gml:Shell></gml:exterior></gml:Solid>", name,
                shell);
        };
        text_ += "<core:lod3Solid>";
        if (shells.size() == 1) {
            text_ += solidOf(shells[0], id + "_solid");
        } else {
            text_ += fmt::format("<gml:CompositeSolid gml:id=\"{}_solid\">", id);
            for (std::size_t n = 0; n < shells.size(); ++n)
                text_ += fmt::format("<gml:solidMember>{}</gml:solidMember>\n",
                                     solidOf(shells[n], fmt::format("{}_solid_{}", id, n + 1)));
            text_ += "</gml:CompositeSolid>";
        }
        text_ += "</core:lod3Solid>\n";
    }

    // The faces of a space, counter-clockwise from outside.
    [[nodiscard]] std::string shellOfFaces(std::uint32_t space) const {
        std::string shell;
        for (const analyze::BoundaryFace& face : all_.spaces.faces) {
            if (face.minus != space && face.plus != space) continue;
            auto rings = face.rings;
            if (face.plus == space)
                for (auto& ring : rings) std::reverse(ring.begin(), ring.end());
            shell += polygon(rings);
        }
        return shell;
    }

    [[nodiscard]] std::string polygon(const std::vector<std::vector<Vec3d>>& rings) const {
        std::string text = "<gml:surfaceMember><gml:Polygon>";
        for (std::size_t r = 0; r < rings.size(); ++r) {
            std::string points;
            for (std::size_t n = 0; n <= rings[r].size(); ++n)
                points += (n == 0 ? "" : " ") + point(rings[r][n % rings[r].size()]);
            const char* const role = r == 0 ? "exterior" : "interior";
            text += fmt::format("<gml:{0}><gml:LinearRing><gml:posList>{1}</gml:posList></gml:LinearRing></gml:{0}>",
                                role, points);
        }
        return text + "</gml:Polygon></gml:surfaceMember>\n";
    }

    const LandAdministration& all_;
    const volume::SemanticVolume& volume_;
    const std::string crsName_;
    const bool isNorthFirst_;
    std::string text_;
};

}  // namespace

std::string makeLadmCityGml(const LandAdministration& administration, const volume::SemanticVolume& volume) {
    return LadmDocument(administration, volume).make();
}

}  // namespace svt::writers
