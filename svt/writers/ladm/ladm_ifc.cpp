// IFC4: a legal space is an IfcSpatialZone for occupancy with a closed B-rep, its rooms are IfcSpace, and an IfcZone groups
// both. Parties are IfcActor, assigned to zones by their rights.
#include <svt/analyze/extents.hpp>
#include <svt/core/text.hpp>
#include <svt/crs/crs_name.hpp>
#include <svt/writers/ladm/ladm_owner.hpp>
#include <svt/writers/ladm/step_records.hpp>
#include <svt/writers/ladm_writer.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <vector>

namespace svt::writers {
namespace {

using analyze::LandAdministration;
using analyze::LegalSpace;
using volume::kNoLabel;

using SpaceRings = std::vector<std::vector<Vec3d>>;

class LadmIfc {
public:
    LadmIfc(const LandAdministration& administration, const volume::SemanticVolume& volume)
        : all_(administration), volume_(volume), extents_(volume.labels) {
        Box3d box;
        for (const LegalSpace& space : all_.spaces.spaces) box.add(space.box);
        if (!box.isEmpty()) origin_ = {std::floor(box.min.x), std::floor(box.min.y), std::floor(box.min.z)};
        firstTriangle_.assign(volume.labels.labels.size() + 1, 0);
        for (const auto& triangle : volume.vectors.triangles) ++firstTriangle_[triangle.label + 1];
        for (std::size_t l = 0; l + 1 < firstTriangle_.size(); ++l) firstTriangle_[l + 1] += firstTriangle_[l];
    }

    std::string make() {
        project();
        std::map<std::uint32_t, std::vector<std::uint32_t>> spacesOf;  // by building; kNoLabel: in none
        for (std::uint32_t s = 0; s < all_.spaces.spaces.size(); ++s)
            spacesOf[buildingOf(all_.spaces.spaces[s].label)].push_back(s);
        std::vector<int> buildings;
        for (const auto& [building, spaces] : spacesOf) buildings.push_back(addBuilding(building, spaces));
        if (!buildings.empty()) aggregate("site", site_, buildings);
        addParties();
        return fmt::format(
                   "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION(('ViewDefinition [ReferenceView]'),'2;1');\n"
                   "FILE_NAME({},'2000-01-01T00:00:00',(''),(''),'svt','svt cadastre','');\nFILE_SCHEMA(('IFC4'));\n"
                   "ENDSEC;\nDATA;\n",
                   stepString(volume_.modelName.empty() ? volume_.source : volume_.modelName)) +
               records_.take() + "ENDSEC;\nEND-ISO-10303-21;\n";
    }

private:
    [[nodiscard]] const volume::Label& labelOf(std::uint32_t label) const { return volume_.labels.labels[label]; }

    // The building that contains a label, or is it.
    [[nodiscard]] std::uint32_t buildingOf(std::uint32_t label) const {
        while (label != kNoLabel && labelOf(label).className != "Building") label = labelOf(label).parent;
        return label;
    }

    void project() {
        const int length = records_.add("IFCSIUNIT", "*,.LENGTHUNIT.,$,.METRE.");
        const int area = records_.add("IFCSIUNIT", "*,.AREAUNIT.,$,.SQUARE_METRE.");
        const int volume = records_.add("IFCSIUNIT", "*,.VOLUMEUNIT.,$,.CUBIC_METRE.");
        const int angle = records_.add("IFCSIUNIT", "*,.PLANEANGLEUNIT.,$,.RADIAN.");
        const int units = records_.add("IFCUNITASSIGNMENT", stepList({length, area, volume, angle}));
        const int world = axes({});
        const int model =
            records_.add("IFCGEOMETRICREPRESENTATIONCONTEXT", fmt::format("$,'Model',3,1.E-06,#{},$", world));
        body_ = records_.add("IFCGEOMETRICREPRESENTATIONSUBCONTEXT",
                             fmt::format("'Body','Model',*,*,*,*,#{},$,.MODEL_VIEW.,$", model));
        const auto code = static_cast<int>(crs::epsgCodeOf(volume_.crsName));
        if (code != 0) {
            const int crs = records_.add("IFCPROJECTEDCRS", fmt::format("'EPSG:{}',$,$,$,$,$,#{}", code, length));
            records_.add("IFCMAPCONVERSION", fmt::format("#{},#{},{},{},{},1.,0.,1.", model, crs, stepReal(origin_.x),
                                                         stepReal(origin_.y), stepReal(origin_.z)));
        }
        const int project = records_.rooted(
            "IFCPROJECT", "project of the register",
            fmt::format("{},$,$,$,$,({}),#{}", stepString(volume_.modelName.empty() ? "Register" : volume_.modelName),
                        fmt::format("#{}", model), units));
        place_ = records_.add("IFCLOCALPLACEMENT", fmt::format("$,#{}", code != 0 ? world : axes(origin_)));
        site_ = records_.rooted("IFCSITE", "site of the register",
                                fmt::format("'Site',$,$,#{},$,$,.ELEMENT.,$,$,$,$,$", place_));
        aggregate("project", project, {site_});
    }

    int axes(Vec3d origin) { return records_.add("IFCAXIS2PLACEMENT3D", fmt::format("#{},$,$", point(origin))); }
    int point(Vec3d p) {
        return records_.add("IFCCARTESIANPOINT",
                            fmt::format("({},{},{})", stepReal(p.x), stepReal(p.y), stepReal(p.z)));
    }

    void aggregate(const std::string& key, int whole, const std::vector<int>& parts) {
        records_.rooted("IFCRELAGGREGATES", "parts of " + key, fmt::format("$,$,#{},{}", whole, stepList(parts)));
    }

    int addBuilding(std::uint32_t label, const std::vector<std::uint32_t>& spaces) {
        const std::string id = label == kNoLabel ? "legal_spaces" : labelOf(label).id;
        const std::string name = label == kNoLabel ? "" : labelOf(label).name;
        const int place = records_.add("IFCLOCALPLACEMENT", fmt::format("#{},#{}", place_, axes({})));
        std::string body = "$";
        for (const std::uint32_t space : spaces)
            if (all_.spaces.spaces[space].label == label) body = shapeOf(bodyOf(space));
        const int building = records_.rooted(
            "IFCBUILDING", id,
            fmt::format("{},$,$,#{},{},$,.ELEMENT.,$,$,$", stepString(name.empty() ? id : name), place, body));
        std::vector<int> zones, rooms;
        std::map<std::uint32_t, int> roomOf;  // by label
        for (const std::uint32_t space : spaces) {
            if (all_.spaces.spaces[space].label == label) {
                productOf_[space] = building;
                describe(space, building);
                continue;
            }
            zones.push_back(addZone(space, place, roomOf));
        }
        for (const auto& [room, record] : roomOf) rooms.push_back(record);
        if (!rooms.empty()) aggregate(id, building, rooms);
        if (!zones.empty())
            records_.rooted("IFCRELCONTAINEDINSPATIALSTRUCTURE", "legal spaces of " + id,
                            fmt::format("$,$,{},#{}", stepList(zones), building));
        return building;
    }

    // \return the IfcSpatialZone of a legal space; its rooms are added to `roomOf`
    int addZone(std::uint32_t index, int place, std::map<std::uint32_t, int>& roomOf) {
        const LegalSpace& space = all_.spaces.spaces[index];
        const volume::Label& label = labelOf(space.label);
        const std::string body = shapeOf(bodyOf(index));
        const int zone = records_.rooted("IFCSPATIALZONE", label.id,
                                         fmt::format("{},$,'LA_LegalSpaceBuildingUnit',#{},{},{},.OCCUPANCY.",
                                                     stepString(label.id), place, body, stepOptional(label.name)));
        std::vector<int> members{zone};
        for (const std::uint32_t part : extents_.of(space.label)) {
            if (part == space.label || labelOf(part).className != "BuildingRoom") continue;
            const auto [at, isNew] = roomOf.try_emplace(part, 0);
            if (isNew) at->second = addRoom(part, place);
            members.push_back(at->second);
        }
        productOf_[index] = zone;
        describe(index, zone);
        const int group =
            records_.rooted("IFCZONE", "zone of " + label.id,
                            fmt::format("{},$,'LA_BAUnit',{}", stepString(label.id), stepOptional(label.name)));
        records_.rooted("IFCRELASSIGNSTOGROUP", "members of " + label.id,
                        fmt::format("$,$,{},$,#{}", stepList(members), group));
        zoneOf_[index] = group;
        return zone;
    }

    int addRoom(std::uint32_t label, int place) {
        std::vector<std::vector<SpaceRings>> solids;
        if (volume::hasClosedMesh(labelOf(label).filling)) {
            std::vector<SpaceRings> faces;
            for (std::size_t n = firstTriangle_[label]; n < firstTriangle_[label + 1]; ++n) {
                std::vector<Vec3d> ring;
                for (const std::uint32_t corner : volume_.vectors.triangles[n].corners)
                    ring.push_back(volume_.vectors.position(corner, volume_.grid.origin()));
                faces.push_back({std::move(ring)});
            }
            if (!faces.empty()) solids.push_back(std::move(faces));
        }
        const volume::Label& room = labelOf(label);
        return records_.rooted("IFCSPACE", room.id,
                               fmt::format("{},$,$,#{},{},{},.ELEMENT.,.INTERNAL.,$", stepString(room.id), place,
                                           shapeOf(solids), stepOptional(room.name)));
    }

    // The faces of each solid of a legal space, seen from outside.
    [[nodiscard]] std::vector<std::vector<SpaceRings>> bodyOf(std::uint32_t index) const {
        const LegalSpace& space = all_.spaces.spaces[index];
        std::vector<std::vector<SpaceRings>> solids;
        if (space.body == analyze::SpaceBody::Voxels) {
            std::vector<SpaceRings> faces;
            for (const analyze::BoundaryFace& face : all_.spaces.faces) {
                if (face.minus != index && face.plus != index) continue;
                SpaceRings rings = face.rings;
                if (face.plus == index)
                    for (auto& ring : rings) std::reverse(ring.begin(), ring.end());
                faces.push_back(std::move(rings));
            }
            if (!faces.empty()) solids.push_back(std::move(faces));
            return solids;
        }
        for (const auto& solid : space.solids) {
            std::vector<SpaceRings> faces;
            for (const analyze::SpaceTriangle& t : solid) faces.push_back({{t[0], t[1], t[2]}});
            if (!faces.empty()) solids.push_back(std::move(faces));
        }
        return solids;
    }

    // "#n" of an IfcProductDefinitionShape with a B-rep per solid; "$" without solids.
    std::string shapeOf(const std::vector<std::vector<SpaceRings>>& solids) {
        if (solids.empty()) return "$";
        std::vector<int> items;
        for (const std::vector<SpaceRings>& faces : solids) {
            std::map<std::array<double, 3>, int> points;
            std::vector<int> shell;
            for (const SpaceRings& rings : faces) shell.push_back(addFace(rings, points));
            const int closed = records_.add("IFCCLOSEDSHELL", stepList(shell));
            items.push_back(records_.add("IFCFACETEDBREP", fmt::format("#{}", closed)));
        }
        const int body =
            records_.add("IFCSHAPEREPRESENTATION", fmt::format("#{},'Body','Brep',{}", body_, stepList(items)));
        return fmt::format("#{}", records_.add("IFCPRODUCTDEFINITIONSHAPE", fmt::format("$,$,(#{})", body)));
    }

    int addFace(const SpaceRings& rings, std::map<std::array<double, 3>, int>& points) {
        std::vector<int> bounds;
        for (std::size_t r = 0; r < rings.size(); ++r) {
            std::vector<int> corners;
            for (const Vec3d& corner : rings[r]) {
                const auto [at, isNew] = points.try_emplace({corner.x, corner.y, corner.z}, 0);
                if (isNew) at->second = point(corner - origin_);
                corners.push_back(at->second);
            }
            const int loop = records_.add("IFCPOLYLOOP", stepList(corners));
            bounds.push_back(records_.add(r == 0 ? "IFCFACEOUTERBOUND" : "IFCFACEBOUND", fmt::format("#{},.T.", loop)));
        }
        return records_.add("IFCFACE", stepList(bounds));
    }

    using Property = std::pair<std::string_view, std::string>;  // name, and value with its type

    static std::string textValue(std::string_view text) { return fmt::format("IFCLABEL({})", stepString(text)); }
    static void addVolume(std::string_view name, const std::optional<double>& value, std::vector<Property>& to) {
        if (value) to.emplace_back(name, fmt::format("IFCVOLUMEMEASURE({})", stepReal(*value)));
    }

    void addSet(const std::string& name, const std::string& id, int product, const std::vector<Property>& properties) {
        std::vector<int> values;
        for (const auto& [property, value] : properties)
            values.push_back(records_.add("IFCPROPERTYSINGLEVALUE", fmt::format("'{}',$,{},$", property, value)));
        const int set = records_.rooted("IFCPROPERTYSET", name + " of " + id,
                                        fmt::format("{},$,{}", stepString(name), stepList(values)));
        records_.rooted("IFCRELDEFINESBYPROPERTIES", name + " is of " + id, fmt::format("$,$,(#{}),#{}", product, set));
    }

    void describe(std::uint32_t index, int product) {
        const LegalSpace& space = all_.spaces.spaces[index];
        const volume::Label& label = labelOf(space.label);
        std::vector<Property> properties{{"suID", textValue(label.id)},
                                         {"class", textValue(label.className)},
                                         {"body", textValue(analyze::spaceBodyName(space.body))},
                                         {"common", space.isCommon ? "IFCBOOLEAN(.T.)" : "IFCBOOLEAN(.F.)"},
                                         {"spatialSource", textValue(all_.spatialFile)}};
        addVolume("volume", space.totalVolume, properties);
        addVolume("bodyVolume", space.bodyVolume, properties);
        if (const std::string owner = soleOwner(all_, index); !owner.empty())
            properties.emplace_back("owner", textValue(owner));
        addSet("LA_LegalSpaceBuildingUnit", label.id, product, properties);
        std::array<int, 3> count{};
        for (const analyze::PartyRight& right : all_.rights) {
            if (all_.units[right.unit].space != index) continue;
            const auto of = right.rightType().of;
            const int number = ++count[static_cast<std::size_t>(of)];
            std::vector<Property> values{{"type", textValue(right.rightType().name)},
                                         {"party", textValue(all_.parties[right.party])},
                                         {"administrativeSource", textValue(all_.sources[right.source])}};
            if (right.fraction) values.emplace_back("share", textValue(analyze::shareText(right)));
            addSet(fmt::format("{}{}", analyze::ladmClassName(of), number == 1 ? "" : fmt::format(" {}", number)),
                   label.id, product, values);
        }
    }

    void addParties() {
        for (std::uint32_t party = 0; party < all_.parties.size(); ++party) {
            const std::string& name = all_.parties[party];
            const int organization = records_.add("IFCORGANIZATION", fmt::format("$,{},$,$,$", stepString(name)));
            const int actor = records_.rooted("IFCACTOR", "party " + name,
                                              fmt::format("{},$,'LA_Party',#{}", stepString(name), organization));
            std::map<std::uint8_t, std::vector<int>> byType;
            for (const analyze::PartyRight& right : all_.rights) {
                const std::uint32_t space = all_.units[right.unit].space;
                const auto zone = zoneOf_.find(space);
                const int object = zone != zoneOf_.end() ? zone->second : productOf_.at(space);
                std::vector<int>& objects = byType[right.type];
                if (right.party == party && std::find(objects.begin(), objects.end(), object) == objects.end())
                    objects.push_back(object);
            }
            for (const auto& [type, objects] : byType) {
                if (objects.empty()) continue;
                const std::string_view typeName = analyze::rightTypes()[type].name;
                const int role = records_.add("IFCACTORROLE", type == analyze::kOwnership
                                                                  ? std::string(".OWNER.,$,$")
                                                                  : fmt::format(".USERDEFINED.,'{}',$", typeName));
                records_.rooted("IFCRELASSIGNSTOACTOR", fmt::format("{} of {}", typeName, name),
                                fmt::format("'{}',$,{},$,#{},#{}", typeName, stepList(objects), actor, role));
            }
        }
    }

    const LandAdministration& all_;
    const volume::SemanticVolume& volume_;
    const analyze::Extents extents_;
    StepRecords records_;
    Vec3d origin_;
    std::vector<std::size_t> firstTriangle_;  // of label l: [l], end: [l + 1]
    std::map<std::uint32_t, int> productOf_;  // by space: its zone or building
    std::map<std::uint32_t, int> zoneOf_;     // by space
    int body_ = 0, place_ = 0, site_ = 0;
};

}  // namespace

std::string makeLadmIfc(const LandAdministration& administration, const volume::SemanticVolume& volume) {
    return LadmIfc(administration, volume).make();
}

}  // namespace svt::writers
