// CityJSON 2.0. The vertices of a document follow its objects, so the buildings are generated twice: once for the
// objects, once for the vertices; nothing is kept in between. Doors and windows are objects of the extension "SVT".
#include <svt/samples/formats/writers.hpp>

#include <string>
#include <variant>
#include <vector>

namespace svt::samples {
namespace {

std::string_view typeOf(Kind kind) {
    switch (kind) {
        case Kind::Storey: return "BuildingStorey";
        case Kind::Window: return "+Window";
        case Kind::Door: return "+Door";
        default: return className(kind);
    }
}

// Semantic surfaces of rooms are named "Door" and "Window", without the suffix "Surface".
std::string_view surfaceTypeOf(std::string_view type) {
    if (type == "DoorSurface") return "Door";
    if (type == "WindowSurface") return "Window";
    return type;
}

class CityJsonWriter {
public:
    CityJsonWriter(SampleSource& source, TextSink& out) : source_(source), out_(out) {}

    void writeDocument() {
        head();
        out_ << ",\n";
        appearance();
        out_ << ",\n\"CityObjects\":{\n";
        isFirst_ = true;
        std::int64_t base = groundObject(0);
        for (std::int64_t i = 0; i < source_.buildingCount() && !out_.hasFailed(); ++i) base = building(i, base);
        out_ << "\n},\n\"vertices\":[\n";
        isFirst_ = true;
        groundVertices();
        for (std::int64_t i = 0; i < source_.buildingCount() && !out_.hasFailed(); ++i) vertices(i);
        out_ << "\n]}\n";
    }

    void writeSequence() {
        isSequence_ = true;
        head();
        out_ << ",\"CityObjects\":{},\"vertices\":[]}\n";
        if (!source_.ground().empty()) {
            beginFeature("ground");
            groundObject(0);
            out_ << "},\"vertices\":[";
            isFirst_ = true;
            groundVertices();
            out_ << "]}\n";
        }
        for (std::int64_t i = 0; i < source_.buildingCount() && !out_.hasFailed(); ++i) {
            beginFeature(source_.building(i).id);
            building(i, 0);
            out_ << "},";
            appearance();
            out_ << ",\"vertices\":[";
            isFirst_ = true;
            vertices(i);
            out_ << "]}\n";
        }
    }

private:
    void beginFeature(std::string_view id) {
        out_ << "{\"type\":\"CityJSONFeature\",\"id\":\"" << id << "\",\"CityObjects\":{";
        isFirst_ = true;
    }

    // Separator between members of the open object or array; a sequence has one line per feature.
    void separate() {
        if (!isFirst_) out_ << (isSequence_ ? "," : ",\n");
        isFirst_ = false;
    }

    // "[a,b]": writes the items by writeItem().
    template <class Items, class WriteItem>
    void list(const Items& items, const WriteItem& writeItem) {
        std::string_view before = "[";
        for (const auto& item : items) {
            out_ << before;
            writeItem(item);
            before = ",";
        }
        out_ << (before == "[" ? "[]" : "]");
    }

    void fixedPoint(const WorldPoint& p, int decimals) {
        out_.fixed(p.x, decimals) << ",";
        out_.fixed(p.y, decimals) << ",";
        out_.fixed(p.z, decimals);
    }

    void head() {
        const std::string_view scale = source_.decimals() == 3 ? "0.001" : "0.000001";
        out_ << "{\"type\":\"CityJSON\",\"version\":\"2.0\",\"extensions\":{\"SVT\":{\"url\":"
                "\"https://svt.example.org/cityjson/svt.ext.json\",\"version\":\"0.1\"}},\"metadata\":{\"title\":\""
             << source_.title()
             << "\",\"referenceSystem\":\"https://www.opengis.net/def/crs/EPSG/0/25832\",\"geographicalExtent\":";
        list(source_.envelope(), [&](const WorldPoint& corner) { fixedPoint(corner, source_.decimals()); });
        out_ << "},\"transform\":{\"scale\":[" << scale << "," << scale << "," << scale << "],\"translate\":[";
        fixedPoint(source_.origin(), 3);
        out_ << "]}";
        templates();
    }

    void appearance() {
        out_ << "\"appearance\":{\"default-theme-material\":\"sample\",\"materials\":";
        list(materials(), [&](const MaterialInfo& material) {
            out_ << "{\"name\":\"" << material.name << "\",\"diffuseColor\":";
            list(material.color, [&](double channel) { out_ << decimalText(channel); });
            out_ << ",\"transparency\":" << decimalText(material.transparency) << "}";
        });
        out_ << "}";
    }

    // The shape used by GeometryInstances: all instances of a sample share one.
    void templates() {
        const Document document = source_.building(0);
        for (const PlacedPlan& placed : document.plans)
            for (const Component& component : placed.plan->components) {
                if (!component.instance) continue;
                const Instance& instance = *component.instance;
                out_ << ",\"geometry-templates\":{\"templates\":[{\"type\":\"Solid\",\"lod\":\"3\",\"boundaries\":[";
                shell(instance.shell, 0);
                out_ << "]}],\"vertices-templates\":";
                list(instance.vertices, [&](const Point& p) {
                    out_ << "[";
                    fixedPoint(p, 3);
                    out_ << "]";
                });
                out_ << "}";
                return;
            }
    }

    void shell(const Shell& shell, std::int64_t base) {
        list(shell.faces, [&](const Face& face) {
            list(face.rings, [&](const auto& ring) {
                list(ring, [&](std::uint32_t vertex) { out_ << base + std::int64_t(vertex); });
            });
        });
    }

    std::int64_t groundObject(std::int64_t base) {
        const std::size_t count = source_.ground().size();
        if (count == 0) return base;
        separate();
        out_ << "\"ground\":{\"type\":\"LandUse\",\"attributes\":{\"name\":\"Ground\"},\"geometry\":[{\"type\":"
                "\"MultiSurface\",\"lod\":\"1\",\"boundaries\":[[[0,1,2,3]]]}]}";
        return base + std::int64_t(count);
    }

    void groundVertices() {
        for (const WorldPoint& corner : source_.ground()) vertex(corner, source_.decimals());
    }

    void vertex(const WorldPoint& p, int decimals) {
        const std::int64_t factor = decimals < source_.decimals() ? 1000 : 1;
        const std::int64_t perMillimetre = source_.decimals() == 3 ? 1 : 1000;
        const Point local = p * factor - source_.origin() * perMillimetre;
        separate();
        out_ << "[" << local.x << "," << local.y << "," << local.z << "]";
    }

    void vertices(std::int64_t index) {
        const Document document = source_.building(index);
        for (const PlacedPlan& placed : document.plans) {
            const int decimals = placed.placement.decimals();
            for (const Point& p : placed.plan->vertices) vertex(placed.placement.at(p), decimals);
            for (const Component& component : placed.plan->components)
                if (component.instance) vertex(placed.placement.at(component.instance->shift), decimals);
        }
    }

    void ids(const std::vector<std::string>& ids) {
        list(ids, [&](const std::string& id) { out_ << "\"" << id << "\""; });
    }

    // Writes the objects of a building; returns the index of the vertex after its last.
    std::int64_t building(std::int64_t index, std::int64_t base) {
        document_ = source_.building(index);
        separate();
        out_ << "\"" << document_.id << "\":{\"type\":\"Building\",\"attributes\":{\"name\":\"" << document_.name
             << "\",\"function\":\"" << document_.function << "\",\"roofType\":\"" << document_.roofType
             << "\",\"storeysAboveGround\":" << document_.storeys << "},\"children\":";
        std::vector<std::string> children;
        document_.forEach([&](const PlacedPlan& placed, int c, const Component& component) {
            if (!component.isStandIn && document_.parentIdOf(placed, c) == document_.id)
                children.push_back(document_.idOf(placed, c));
        });
        ids(children);
        out_ << "}";
        for (const PlacedPlan& placed : document_.plans) {
            std::int64_t anchor = base + std::int64_t(placed.plan->vertices.size());
            for (int c = 0; c < int(placed.plan->components.size()); ++c) {
                const Component& component = placed.component(c);
                if (!component.isStandIn) object(placed, c, base, anchor);
                if (component.instance) ++anchor;
            }
            base = anchor;
        }
        return base;
    }

    void object(const PlacedPlan& placed, int component, std::int64_t base, std::int64_t anchor) {
        const Component& c = placed.component(component);
        separate();
        out_ << "\"" << document_.idOf(placed, component) << "\":{\"type\":\"" << typeOf(c.kind)
             << "\",\"attributes\":{\"name\":\"" << document_.nameOf(placed, component) << "\"";
        if (!c.function.empty()) out_ << ",\"function\":\"" << c.function << "\"";
        for (const Attribute& attribute : document_.attributesOf(placed, component)) {
            out_ << ",\"" << attribute.name << "\":";
            if (const double* number = std::get_if<double>(&attribute.value))
                out_ << decimalText(*number);
            else if (std::holds_alternative<std::string>(attribute.value))
                out_ << "\"" << toText(attribute.value) << "\"";
            else
                out_ << toText(attribute.value);
        }
        out_ << "},";
        parents(placed, component);
        children(placed, component);
        geometry(placed, component, base, anchor);
        out_ << "}";
    }

    // The parent comes first; storey and unit are additional groups.
    void parents(const PlacedPlan& placed, int component) {
        const Component& c = placed.component(component);
        std::vector<std::string> parents{document_.parentIdOf(placed, component)};
        if (isGrouped(c) && c.kind != Kind::Unit)
            for (const int group : {c.storey, c.unit})
                if (group >= 0) parents.push_back(document_.idOf(placed, group));
        out_ << "\"parents\":";
        ids(parents);
    }

    void children(const PlacedPlan& placed, int component) {
        const std::vector<Component>& all = placed.plan->components;
        const Kind kind = all[std::size_t(component)].kind;
        std::vector<std::string> children;
        for (std::size_t c = 0; c < all.size(); ++c) {
            if (all[c].isStandIn) continue;
            const bool isOwned = all[c].parent == component;
            const bool isMember = isGrouped(all[c]) && ((kind == Kind::Storey && all[c].storey == component) ||
                                                        (kind == Kind::Unit && all[c].unit == component));
            if (isOwned || isMember) children.push_back(document_.idOf(placed, int(c)));
        }
        if (children.empty()) return;
        out_ << ",\"children\":";
        ids(children);
    }

    void geometry(const PlacedPlan& placed, int component, std::int64_t base, std::int64_t anchor) {
        const Component& c = placed.component(component);
        if (c.shells.empty()) return;
        out_ << ",\"geometry\":[{";
        if (c.instance) {
            out_ << "\"type\":\"GeometryInstance\",\"template\":0,\"boundaries\":[" << anchor
                 << "],\"transformationMatrix\":[" << matrixText(placed, *c.instance, ",") << "]";
        } else if (c.shells.size() == 1) {
            out_ << "\"type\":\"Solid\",\"lod\":\"3\",\"boundaries\":[";
            shell(c.shells.front(), base);
            out_ << "]";
            if (c.kind == Kind::Room) semantics(placed, component);
            out_ << ",\"material\":{\"sample\":{\"value\":" << int(document_.shown(c.shells.front().material)) << "}}";
        } else {
            composite(c, base);
        }
        out_ << "}]";
    }

    void composite(const Component& component, std::int64_t base) {
        out_ << "\"type\":\"CompositeSolid\",\"lod\":\"3\",\"boundaries\":";
        list(component.shells, [&](const Shell& own) {
            out_ << "[";
            shell(own, base);
            out_ << "]";
        });
        out_ << ",\"material\":{\"sample\":{\"values\":";
        list(component.shells, [&](const Shell& own) {
            out_ << "[";
            list(own.faces, [&](const Face&) { out_ << int(document_.shown(own.material)); });
            out_ << "]";
        });
        out_ << "}}";
    }

    void semantics(const PlacedPlan& placed, int room) {
        std::vector<int> values(placed.component(room).shells.front().faces.size(), 0);
        int surface = 0;
        out_ << ",\"semantics\":{\"surfaces\":[";
        for (const BoundaryGroup& group : boundaryGroups(*placed.plan, room)) {
            const int parent = surface++;
            for (const int f : group.faces) values[std::size_t(f)] = parent;
            out_ << (parent == 0 ? "" : ",") << "{\"type\":\"" << group.type << "\"";
            for (std::size_t o = 0; o < group.openings.size(); ++o)
                out_ << (o == 0 ? ",\"children\":[" : ",") << std::int64_t(surface) + std::int64_t(o);
            out_ << (group.openings.empty() ? "}" : "]}");
            for (const BoundaryGroup& opening : group.openings) {
                for (const int f : opening.faces) values[std::size_t(f)] = surface;
                out_ << ",{\"type\":\"" << surfaceTypeOf(opening.type) << "\",\"parent\":" << parent << "}";
                ++surface;
            }
        }
        out_ << "],\"values\":[";
        list(values, [&](int value) { out_ << value; });
        out_ << "]}";
    }

    SampleSource& source_;
    TextSink& out_;
    Document document_;
    bool isFirst_ = true;
    bool isSequence_ = false;
};

}  // namespace

void writeCityJson(SampleSource& source, TextSink& out) { CityJsonWriter(source, out).writeDocument(); }

void writeCityJsonSeq(SampleSource& source, TextSink& out) { CityJsonWriter(source, out).writeSequence(); }

}  // namespace svt::samples
