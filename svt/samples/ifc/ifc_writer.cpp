// IFC4. Bodies are parametric: walls, slabs and rooms are extrusions; doors and windows fill openings that void their
// wall. Passages of one component through another are boolean differences. Placements in millimetres position the plan
// in the project; IfcMapConversion positions it on the map.
#include <svt/samples/formats/writers.hpp>

#include <svt/samples/ifc/ifc_bodies.hpp>
#include <svt/samples/ifc/ifc_layers.hpp>

#include <algorithm>
#include <optional>
#include <variant>

namespace svt::samples {
namespace {

// Type, and its PredefinedType.
struct IfcType {
    std::string_view type, predefined, propertySet;
};

IfcType typeOf(const Component& component) {
    struct Row {
        std::string_view function;
        IfcType type;
    };
    static constexpr Row kElements[] = {{"wall", {"IFCWALL", ".SOLIDWALL.", "Pset_WallCommon"}},
                                        {"slab", {"IFCSLAB", ".FLOOR.", "Pset_SlabCommon"}},
                                        {"roof", {"IFCSLAB", ".ROOF.", "Pset_SlabCommon"}},
                                        {"beam", {"IFCBEAM", ".BEAM.", "Pset_BeamCommon"}},
                                        {"rafter", {"IFCMEMBER", ".RAFTER.", "Pset_MemberCommon"}},
                                        {"covering", {"IFCCOVERING", ".CEILING.", "Pset_CoveringCommon"}},
                                        {"chimney", {"IFCCHIMNEY", ".NOTDEFINED.", "Pset_ChimneyCommon"}}};
    switch (component.kind) {
        case Kind::Window: return {"IFCWINDOW", "", "Pset_WindowCommon"};
        case Kind::Door: return {"IFCDOOR", "", "Pset_DoorCommon"};
        case Kind::Furniture: return {"IFCFURNITURE", ".NOTDEFINED.", "Pset_FurnitureTypeCommon"};
        case Kind::Installation:
            if (component.function == "stair") return {"IFCSTAIR", ".STRAIGHT_RUN_STAIR.", "Pset_StairCommon"};
            if (component.function == "railing") return {"IFCRAILING", ".GUARDRAIL.", "Pset_RailingCommon"};
            return {"IFCBUILDINGELEMENTPROXY", ".NOTDEFINED.", "Pset_BuildingElementProxyCommon"};
        default:
            for (const Row& row : kElements)
                if (row.function == component.function) return row.type;
            return {"IFCBUILDINGELEMENTPROXY", ".NOTDEFINED.", "Pset_BuildingElementProxyCommon"};
    }
}

// Whether they share more than a face.
bool overlaps(const Box3d& a, const Box3d& b) {
    return a.min.x < b.max.x && b.min.x < a.max.x && a.min.y < b.max.y && b.min.y < a.max.y && a.min.z < b.max.z &&
           b.min.z < a.max.z;
}

bool isSwingDoor(const Component& component) {
    return component.kind == Kind::Door && component.function == "door" && component.solids.size() == 2;
}

// Axes of a door: x along it, y to the side with which its leaf is flush, where it opens to. The hinges are on the left
// as one looks that way, at the origin.
Frame doorFrame(const Component& component) {
    const Box3d all = samples::boundsOf(component.solids[0]), leaf = samples::boundsOf(component.solids[1]);
    const bool isAlongX = all.size().x > all.size().y;
    const auto low = isAlongX ? leaf.min.y - all.min.y : leaf.min.x - all.min.x;
    const auto high = isAlongX ? all.max.y - leaf.max.y : all.max.x - leaf.max.x;
    const double way = high < low ? 1 : -1;
    Frame frame;
    frame.y = isAlongX ? Vec3d{0, way, 0} : Vec3d{way, 0, 0};
    frame.x = cross(frame.y, frame.z);
    frame.origin = {frame.x.x + frame.y.x > 0 ? all.min.x : all.max.x,
                    frame.x.y + frame.y.y > 0 ? all.min.y : all.max.y, all.min.z};
    return frame;
}

bool isSameShape(const Piece& a, const Piece& b) { return a.from == b.from && a.to == b.to && a.sides == b.sides; }

Box3d boundsOf(const Solid& solid, const Piece& piece) {
    Piece added = piece;
    added.adds = true;
    return boundsOf(Solid{solid.axis, solid.material, {added}});
}

class IfcWriter {
public:
    IfcWriter(SampleSource& source, bool hasBakedOpenings, TextSink& out)
        : source_(source), hasBakedOpenings_(hasBakedOpenings), out_(out), records_(out) {}

    void write() {
        out_ << "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION(('ViewDefinition [DesignTransferView]'),'2;1');\nFILE_NAME('"
             << source_.title()
             << ".ifc','2026-01-01T00:00:00',(''),(''),'svt','svt sample','');\nFILE_SCHEMA(('IFC4'));\nENDSEC;\n"
                "DATA;\n";
        project();
        std::vector<int> buildings;
        for (std::int64_t i = 0; i < source_.buildingCount() && !out_.hasFailed(); ++i)
            buildings.push_back(building(i));
        aggregate("site", site_, buildings);
        out_ << "ENDSEC;\nEND-ISO-10303-21;\n";
    }

private:
    void project() {
        const int length = records_.add("IFCSIUNIT", "*,.LENGTHUNIT.,.MILLI.,.METRE.");
        const int area = records_.add("IFCSIUNIT", "*,.AREAUNIT.,$,.SQUARE_METRE.");
        const int volume = records_.add("IFCSIUNIT", "*,.VOLUMEUNIT.,$,.CUBIC_METRE.");
        const int angle = records_.add("IFCSIUNIT", "*,.PLANEANGLEUNIT.,$,.RADIAN.");
        const int units = records_.add("IFCUNITASSIGNMENT", std::array{length, area, volume, angle});
        const int world = records_.axes({});
        const int model = records_.add("IFCGEOMETRICREPRESENTATIONCONTEXT", "$,'Model',3,1.E-05", world, "$");
        constexpr std::string_view kSubcontext = "IFCGEOMETRICREPRESENTATIONSUBCONTEXT";
        body_ = records_.add(kSubcontext, "'Body','Model',*,*,*,*", model, "$,.MODEL_VIEW.,$");
        axis_ = records_.add(kSubcontext, "'Axis','Model',*,*,*,*", model, "$,.GRAPH_VIEW.,$");
        bodies_.emplace(records_, body_);
        const int metre = records_.add("IFCSIUNIT", "*,.LENGTHUNIT.,$,.METRE.");
        const int crs = records_.add("IFCPROJECTEDCRS", "'EPSG:25832',$,$,$,$,$", metre);
        const Point origin = source_.origin();
        records_.add("IFCMAPCONVERSION", model, crs, stepRatio(origin.x, 1000), stepRatio(origin.y, 1000),
                     stepRatio(origin.z, 1000), "1.,0.,0.001");
        const int project =
            records_.rooted("IFCPROJECT", "project", stepText(source_.title()), "$,$,$,$", std::array{model}, units);
        sitePlace_ = records_.placement(0, {});
        site_ = records_.rooted("IFCSITE", "site", "'Site',$,$", sitePlace_, "$,$,.ELEMENT.,$,$,$,$,$");
        aggregate("project", project, {site_});
    }

    void aggregate(const std::string& key, int whole, const std::vector<int>& parts) {
        if (!parts.empty()) records_.rooted("IFCRELAGGREGATES", "parts of " + key, "$,$", whole, parts);
    }

    void contain(const std::string& key, int space, const std::vector<int>& elements) {
        if (!elements.empty())
            records_.rooted("IFCRELCONTAINEDINSPATIALSTRUCTURE", "elements of " + key, "$,$", elements, space);
    }

    int building(std::int64_t index) {
        document_ = source_.building(index);
        const int place = records_.placement(sitePlace_, {});
        const int building = records_.rooted("IFCBUILDING", document_.id, stepText(document_.name), "$",
                                             stepText(document_.function), place, "$,$,.ELEMENT.,$,$,$");
        std::vector<int> storeys, outside;
        for (const PlacedPlan& placed : document_.plans) {
            placed_ = &placed;
            std::vector<int> made = plan(place, outside);
            storeys.insert(storeys.end(), made.begin(), made.end());
        }
        aggregate(document_.id, building, storeys);
        contain(document_.id, building, outside);
        return building;
    }

    // Axes of a placed plan in the project.
    [[nodiscard]] Frame planFrame(double lift) const {
        const Placement& placement = placed_->placement;
        Frame frame{placement.worldDirection({1, 0, 0}), placement.worldDirection({0, 1, 0}), {0, 0, 1}, {}};
        frame.origin = placement.worldPosition({0, 0, lift}) * 1000 - toDouble(source_.origin());
        return frame;
    }

    // The storeys of a plan with all that they hold.
    std::vector<int> plan(int buildingPlace, std::vector<int>& outside) {
        const std::vector<Component>& all = placed_->plan->components;
        ifc_.assign(all.size(), 0);
        storeyPlace_.assign(all.size(), 0);
        storeyLift_.assign(all.size(), 0);
        instanceMap_ = 0;
        std::vector<int> storeys;
        for (std::size_t c = 0; c < all.size(); ++c) {
            if (all[c].kind != Kind::Storey) continue;
            for (const Attribute& a : all[c].attributes)
                if (a.name == "elevation") storeyLift_[c] = std::get<double>(a.value) * 1000;
            const Frame frame = planFrame(storeyLift_[c]);
            storeyPlace_[c] = records_.placement(buildingPlace, frame);
            ifc_[c] = records_.rooted("IFCBUILDINGSTOREY", idOf(c), stepText(nameOf(c)), "$,$", storeyPlace_[c],
                                      "$,$,.ELEMENT.", frame.origin.z);
            storeys.push_back(ifc_[c]);
        }
        planPlace_ = records_.placement(buildingPlace, planFrame(0));
        for (std::size_t c = 0; c < all.size(); ++c)
            if (all[c].kind != Kind::Storey && !all[c].isStandIn) component(c);
        for (std::size_t c = 0; c < all.size(); ++c) relate(c, outside);
        return storeys;
    }

    // The components in a storey or room.
    void relate(std::size_t space, std::vector<int>& outside) {
        const std::vector<Component>& all = placed_->plan->components;
        std::vector<int> spaces, elements;
        for (std::size_t c = 0; c < all.size(); ++c) {
            if (ifc_[c] == 0 || all[c].kind == Kind::Storey) continue;
            const bool isInRoom = all[c].parent >= 0 && all[std::size_t(all[c].parent)].kind == Kind::Room;
            const int holder = isInRoom ? all[c].parent : all[c].storey;
            if (holder < 0 && space == 0) outside.push_back(ifc_[c]);
            if (holder != int(space)) continue;
            (all[c].kind == Kind::Room || all[c].kind == Kind::Unit ? spaces : elements).push_back(ifc_[c]);
        }
        if (ifc_[space] == 0) return;
        aggregate(idOf(space), ifc_[space], spaces);
        contain(idOf(space), ifc_[space], elements);
    }

    [[nodiscard]] std::string idOf(std::size_t c) const { return document_.idOf(*placed_, int(c)); }
    [[nodiscard]] std::string nameOf(std::size_t c) const { return document_.nameOf(*placed_, int(c)); }

    void component(std::size_t c) {
        const Component& component = placed_->plan->components[c];
        LayeredBody layers = layersOf(*placed_->plan, component);
        Frame frame = layers.frame;
        if (layers.layers.empty()) frame = isSwingDoor(component) ? doorFrame(component) : Frame{};
        const auto storey = std::size_t(std::max(component.storey, 0));
        Frame inStorey = frame;
        if (component.storey >= 0) inStorey.origin = inStorey.origin - Vec3d{0, 0, storeyLift_[storey]};
        const int place = records_.placement(component.storey >= 0 ? storeyPlace_[storey] : planPlace_, inStorey);
        std::vector<bool> isOpening = openingsOf(c);
        const int shape = shapeOf(component, frame, layers, isOpening);
        ifc_[c] = product(c, place, shape);
        if (component.kind == Kind::Window || component.kind == Kind::Door) fill(c);
        openings(c, frame, place, isOpening);
        describe(c);
        if (!layers.layers.empty()) layerUsage(c, layers);
    }

    // Pieces that are cut out of an element, except where another element passes through.
    [[nodiscard]] std::vector<bool> openingsOf(std::size_t c) const {
        const std::vector<Component>& all = placed_->plan->components;
        const Component& component = all[c];
        std::vector<bool> isOpening;
        if (component.kind != Kind::Element || component.solids.size() != 1) return isOpening;
        for (const Piece& piece : component.solids.front().pieces) {
            const bool isThrough = std::any_of(all.begin(), all.end(), [&](const Component& other) {
                return other.kind == Kind::Element && !other.solids.empty() &&
                       isSameShape(other.solids.front().pieces.front(), piece);
            });
            isOpening.push_back(!piece.adds && !isThrough);
        }
        return isOpening;
    }

    int shapeOf(const Component& component, const Frame& frame, const LayeredBody& layers,
                const std::vector<bool>& isOpening) {
        std::vector<int> representations;
        if (layers.isWall) {
            const int from = records_.point2("0.", "0."), to = records_.point2(stepNumber(layers.length), "0.");
            const int line = records_.add("IFCPOLYLINE", std::array{from, to});
            representations.push_back(
                records_.add("IFCSHAPEREPRESENTATION", axis_, "'Axis','Curve2D'", std::array{line}));
        }
        const bool isBaked =
            hasBakedOpenings_ && std::find(isOpening.begin(), isOpening.end(), true) != isOpening.end();
        if (isBaked) {
            const Shell& shell = component.shells.front();
            const Material material = document_.shown(component.solids.front().material);
            const int body = bodies_->brep(frame, placed_->plan->vertices, shell, material);
            representations.push_back(bodies_->representation({body}, "Brep"));
        } else if (component.instance) {
            representations.push_back(mapped(*component.instance));
        } else {
            std::vector<int> items;
            bool isBoolean = false;
            for (const Solid& solid : component.solids)
                items.push_back(bodies_->solid(frame, shownSolid(solid), isOpening, isBoolean));
            if (items.empty()) return 0;
            representations.push_back(bodies_->representation(items, isBoolean ? "CSG" : "SweptSolid"));
        }
        return bodies_->shape(representations);
    }

    [[nodiscard]] Solid shownSolid(const Solid& solid) const {
        Solid shown = solid;
        shown.material = document_.shown(solid.material);
        return shown;
    }

    // All instances of a sample share one shape.
    int mapped(const Instance& instance) {
        if (instanceMap_ == 0) {
            bool isBoolean = false;
            const int item = bodies_->solid({}, shownSolid(instance.solid), {}, isBoolean);
            const int representation = bodies_->representation({item}, isBoolean ? "CSG" : "SweptSolid");
            const int origin = records_.axes({});
            instanceMap_ = records_.add("IFCREPRESENTATIONMAP", origin, representation);
        }
        const Vec3d x = instance.xAxis();
        const int axis1 = records_.direction(x), axis2 = records_.direction(cross({0, 0, 1}, x));
        const int axis3 = records_.direction({0, 0, 1});
        const int origin = records_.point(toDouble(instance.shift));
        const int target = records_.add("IFCCARTESIANTRANSFORMATIONOPERATOR3D", axis1, axis2, origin, "$", axis3);
        const int item = records_.add("IFCMAPPEDITEM", instanceMap_, target);
        return bodies_->representation({item}, "MappedRepresentation");
    }

    int product(std::size_t c, int place, int shape) {
        const Component& component = placed_->plan->components[c];
        const std::string id = idOf(c), mark = document_.markOf(*placed_, int(c)), name = nameOf(c);
        const std::string head =
            stepValues("$", component.function.empty() ? "$" : stepText(component.function), place, shape);
        if (component.kind == Kind::Room)
            return records_.rooted("IFCSPACE", id, stepText(mark), head, stepText(name), ".ELEMENT.,.INTERNAL.,$");
        if (component.kind == Kind::Unit)
            return records_.rooted("IFCSPATIALZONE", id, stepText(mark), head, stepText(name), ".OCCUPANCY.");
        const IfcType type = typeOf(component);
        std::string tail(type.predefined);
        if (component.kind == Kind::Window || component.kind == Kind::Door) {
            const Vec3d size = samples::boundsOf(component.solids.front()).size();
            const double wide = std::max(size.x, size.y);
            tail = stepValues(size.z, wide,
                              !isSwingDoor(component) ? ".NOTDEFINED.,$,$"
                              : wide > 1300           ? ".DOOR.,.DOUBLE_DOOR_SINGLE_SWING.,$"
                                                      : ".DOOR.,.SINGLE_SWING_LEFT.,$");
        }
        return records_.rooted(type.type, id, stepText(name), head, stepText(mark), tail);
    }

    // The opening that a door or window fills: the cut of its wall that it stands in. The wall comes before it.
    void fill(std::size_t c) {
        const Component& component = placed_->plan->components[c];
        const auto host = openingRecords_.find(component.parent);
        if (host == openingRecords_.end()) return;
        const Box3d own = samples::boundsOf(component.solids.front());
        for (const auto& [bounds, opening] : host->second) {
            if (!overlaps(bounds, own)) continue;
            records_.rooted("IFCRELFILLSELEMENT", "filling " + idOf(c), "$,$", opening, ifc_[c]);
            return;
        }
    }

    void openings(std::size_t c, const Frame& frame, int place, const std::vector<bool>& isOpening) {
        openingRecords_.erase(int(c));
        if (hasBakedOpenings_) return;
        for (std::size_t p = 0; p < isOpening.size(); ++p) {
            if (!isOpening[p]) continue;
            const Solid& solid = placed_->plan->components[c].solids.front();
            const Piece& piece = solid.pieces[p];
            const int item = bodies_->extrusion(frame, solid.axis, piece);
            const int shape = bodies_->shape({bodies_->representation({item}, "SweptSolid")});
            const int where = records_.placement(place, {});
            const std::string key = idOf(c) + " opening " + std::to_string(p);
            const int opening =
                records_.rooted("IFCOPENINGELEMENT", key, stepText(key), "$,$", where, shape, "$,.OPENING.");
            records_.rooted("IFCRELVOIDSELEMENT", "void " + key, "$,$", ifc_[c], opening);
            openingRecords_[int(c)].emplace_back(boundsOf(solid, piece), opening);
        }
    }

    int property(std::string_view name, const AttributeValue& value) {
        std::string text;
        if (const bool* truth = std::get_if<bool>(&value))
            text = *truth ? "IFCBOOLEAN(.T.)" : "IFCBOOLEAN(.F.)";
        else if (const auto* whole = std::get_if<std::int64_t>(&value))
            text = "IFCINTEGER(" + std::to_string(*whole) + ")";
        else if (const double* number = std::get_if<double>(&value))
            text = "IFCREAL(" + stepNumber(*number) + ")";
        else
            text = "IFCLABEL(" + stepText(toText(value)) + ")";
        return records_.shared("IFCPROPERTYSINGLEVALUE", stepText(name), "$", text, "$");
    }

    void defineBy(const std::string& key, int set, std::size_t c) {
        records_.rooted("IFCRELDEFINESBYPROPERTIES", key + " of " + idOf(c), "$,$", std::array{ifc_[c]}, set);
    }

    void propertySet(std::size_t c, const std::string& key, const std::string& name,
                     const std::vector<int>& properties) {
        if (properties.empty()) return;
        defineBy(key, records_.rooted("IFCPROPERTYSET", name + " of " + idOf(c), stepText(name), "$", properties), c);
    }

    void describe(std::size_t c) {
        const Component& component = placed_->plan->components[c];
        std::vector<int> common, others;
        for (const Attribute& attribute : document_.attributesOf(*placed_, int(c))) {
            if (attribute.name == "material") material(c, toText(attribute.value));
            const bool isCommon = attribute.name == "loadBearing";
            (isCommon ? common : others)
                .push_back(property(isCommon ? "LoadBearing" : attribute.name, attribute.value));
        }
        if (component.kind == Kind::Element)
            common.push_back(property("IsExternal", component.isExternal.value_or(hasOuterFace(component))));
        propertySet(c, "common", std::string(typeOf(component).propertySet), common);
        propertySet(c, "sample", "Sample", others);
        if (component.solids.empty()) return;
        const int volume = records_.add("IFCQUANTITYVOLUME", "'NetVolume',$,$", stepNumber(component.volume, 9), "$");
        const int quantities = records_.rooted("IFCELEMENTQUANTITY", "BaseQuantities of " + idOf(c),
                                               "'BaseQuantities',$,$", std::array{volume});
        defineBy("quantities", quantities, c);
    }

    // A component with layers has them as its material instead.
    void material(std::size_t c, const std::string& name) {
        if (!layersOf(*placed_->plan, placed_->plan->components[c]).layers.empty()) return;
        associate(c, records_.shared("IFCMATERIAL", stepText(name), "$,$"));
    }

    void associate(std::size_t c, int material) {
        records_.rooted("IFCRELASSOCIATESMATERIAL", "material of " + idOf(c), "$,$", std::array{ifc_[c]}, material);
    }

    void layerUsage(std::size_t c, const LayeredBody& body) {
        std::vector<int> layers;
        std::string setName;
        for (const LayerSpec& layer : body.layers) {
            layers.push_back(records_.shared("IFCMATERIALLAYER", layerMaterial(layer), layer.thickness, "$",
                                             stepText(layer.material), "$", stepText(layer.function), "$"));
            setName += (setName.empty() ? "" : ", ") + std::string(layer.material);
        }
        const int set = records_.shared("IFCMATERIALLAYERSET", layers, stepText(setName), "$");
        associate(c, records_.shared("IFCMATERIALLAYERSETUSAGE", set, body.isWall ? ".AXIS2." : ".AXIS3.",
                                     body.isPositive ? ".POSITIVE." : ".NEGATIVE.", body.offset, "$"));
    }

    // A material with its colour.
    int layerMaterial(const LayerSpec& layer) {
        const auto known = layerMaterials_.find(layer.material);
        if (known != layerMaterials_.end()) return known->second;
        const int material = records_.shared("IFCMATERIAL", stepText(layer.material), "$", stepText(layer.function));
        const int style = bodies_->surfaceStyle(layer.material, layer.color, 0);
        const int item = records_.add("IFCSTYLEDITEM", "$", std::array{style}, "$");
        const int styled = records_.add("IFCSTYLEDREPRESENTATION", body_, "'Style','Material'", std::array{item});
        records_.add("IFCMATERIALDEFINITIONREPRESENTATION", "$,$", std::array{styled}, material);
        return layerMaterials_[layer.material] = material;
    }

    SampleSource& source_;
    bool hasBakedOpenings_;
    TextSink& out_;
    IfcRecords records_;
    std::optional<IfcBodies> bodies_;
    int body_ = 0, axis_ = 0, site_ = 0, sitePlace_ = 0;
    std::map<std::string_view, int> layerMaterials_;

    // Data of the current building and plan.
    Document document_;
    const PlacedPlan* placed_ = nullptr;
    std::vector<int> ifc_, storeyPlace_;  // by component
    std::vector<double> storeyLift_;      // by component, millimetres
    int planPlace_ = 0, instanceMap_ = 0;
    std::map<int, std::vector<std::pair<Box3d, int>>> openingRecords_;  // by component
};

}  // namespace

void writeIfc(SampleSource& source, bool hasBakedOpenings, TextSink& out) {
    IfcWriter(source, hasBakedOpenings, out).write();
}

}  // namespace svt::samples
