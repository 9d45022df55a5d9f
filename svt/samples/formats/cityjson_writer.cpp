// CityJSON 2.0. The vertices of a document follow its objects, so the buildings are generated twice: once for the
// objects, once for the vertices; nothing is kept in between. Doors and windows are objects of the extension "SVT".
#include <svt/samples/formats/writers.hpp>

#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <variant>

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

std::size_t instanceCount(const Plan& plan) {
    std::size_t count = 0;
    for (const Component& component : plan.components) count += component.instance ? 1 : 0;
    return count;
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

    void fixedList(const std::array<WorldPoint, 2>& corners) {
        out_ << "[";
        for (std::size_t i = 0; i < 2; ++i) {
            if (i != 0) out_ << ",";
            out_.fixed(corners[i].x, source_.decimals()) << ",";
            out_.fixed(corners[i].y, source_.decimals()) << ",";
            out_.fixed(corners[i].z, source_.decimals());
        }
        out_ << "]";
    }

    void head() {
        const std::string_view scale = source_.decimals() == 3 ? "0.001" : "0.000001";
        const Point origin = source_.origin();
        out_ << "{\"type\":\"CityJSON\",\"version\":\"2.0\",\"extensions\":{\"SVT\":{\"url\":"
                "\"https://svt.example.org/cityjson/svt.ext.json\",\"version\":\"0.1\"}},\"metadata\":{\"title\":\""
             << source_.title()
             << "\",\"referenceSystem\":\"https://www.opengis.net/def/crs/EPSG/0/25832\",\"geographicalExtent\":";
        fixedList(source_.envelope());
        out_ << "},\"transform\":{\"scale\":[" << scale << "," << scale << "," << scale << "],\"translate\":[";
        out_.fixed(origin.x, 3) << ",";
        out_.fixed(origin.y, 3) << ",";
        out_.fixed(origin.z, 3) << "]}";
        templates();
    }

    void appearance() {
        out_ << "\"appearance\":{\"default-theme-material\":\"sample\",\"materials\":[";
        for (std::size_t i = 0; i < kMaterialCount; ++i) {
            const MaterialInfo& material = info(Material(i));
            if (i != 0) out_ << ",";
            out_ << "{\"name\":\"" << material.name << "\",\"diffuseColor\":[" << decimalText(material.color[0]) << ","
                 << decimalText(material.color[1]) << "," << decimalText(material.color[2])
                 << "],\"transparency\":" << decimalText(material.transparency) << "}";
        }
        out_ << "]}";
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
                out_ << "]}],\"vertices-templates\":[";
                for (std::size_t i = 0; i < instance.vertices.size(); ++i) {
                    const Point& p = instance.vertices[i];
                    out_ << (i == 0 ? "[" : ",[");
                    out_.fixed(p.x, 3) << ",";
                    out_.fixed(p.y, 3) << ",";
                    out_.fixed(p.z, 3) << "]";
                }
                out_ << "]}";
                return;
            }
    }

    void shell(const Shell& faces, std::int64_t base) {
        out_ << "[";
        for (std::size_t f = 0; f < faces.faces.size(); ++f) {
            out_ << (f == 0 ? "[" : ",[");
            for (std::size_t r = 0; r < faces.faces[f].rings.size(); ++r) {
                const auto& ring = faces.faces[f].rings[r];
                out_ << (r == 0 ? "[" : ",[");
                for (std::size_t i = 0; i < ring.size(); ++i) {
                    if (i != 0) out_ << ",";
                    out_ << base + std::int64_t(ring[i]);
                }
                out_ << "]";
            }
            out_ << "]";
        }
        out_ << "]";
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
        const Point origin = source_.origin();
        separate();
        out_ << "[" << p.x * factor - origin.x * perMillimetre << "," << p.y * factor - origin.y * perMillimetre << ","
             << p.z * factor - origin.z * perMillimetre << "]";
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

    // Writes the objects of a building; returns the index of the vertex after its last.
    std::int64_t building(std::int64_t index, std::int64_t base) {
        document_ = source_.building(index);
        separate();
        out_ << "\"" << document_.id << "\":{\"type\":\"Building\",\"attributes\":{\"name\":\"" << document_.name
             << "\",\"function\":\"" << document_.function << "\",\"roofType\":\"" << document_.roofType
             << "\",\"storeysAboveGround\":" << document_.storeys << "},\"children\":[";
        bool isFirstChild = true;
        for (const PlacedPlan& placed : document_.plans)
            for (std::size_t c = 0; c < placed.plan->components.size(); ++c) {
                const Component& component = placed.plan->components[c];
                if (component.isStandIn || document_.parentIdOf(placed, int(c)) != document_.id) continue;
                out_ << (isFirstChild ? "\"" : ",\"") << document_.idOf(placed, int(c)) << "\"";
                isFirstChild = false;
            }
        out_ << "]}";
        for (const PlacedPlan& placed : document_.plans) {
            std::int64_t anchor = base + std::int64_t(placed.plan->vertices.size());
            for (std::size_t c = 0; c < placed.plan->components.size(); ++c) {
                if (placed.plan->components[c].isStandIn) continue;
                object(placed, int(c), base, anchor);
                if (placed.plan->components[c].instance) ++anchor;
            }
            base += std::int64_t(placed.plan->vertices.size() + instanceCount(*placed.plan));
        }
        return base;
    }

    void object(const PlacedPlan& placed, int component, std::int64_t base, std::int64_t anchor) {
        const Component& c = placed.plan->components[std::size_t(component)];
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
        const Component& c = placed.plan->components[std::size_t(component)];
        out_ << "\"parents\":[\"" << document_.parentIdOf(placed, component) << "\"";
        if (isGrouped(c) && c.kind != Kind::Unit) {
            if (c.storey >= 0) out_ << ",\"" << document_.idOf(placed, c.storey) << "\"";
            if (c.unit >= 0) out_ << ",\"" << document_.idOf(placed, c.unit) << "\"";
        }
        out_ << "]";
    }

    void children(const PlacedPlan& placed, int component) {
        const std::vector<Component>& all = placed.plan->components;
        const Kind kind = all[std::size_t(component)].kind;
        bool isFirstChild = true;
        for (std::size_t c = 0; c < all.size(); ++c) {
            if (all[c].isStandIn) continue;
            const bool isOwned = all[c].parent == component;
            const bool isMember = isGrouped(all[c]) && ((kind == Kind::Storey && all[c].storey == component) ||
                                                        (kind == Kind::Unit && all[c].unit == component));
            if (!isOwned && !isMember) continue;
            out_ << (isFirstChild ? ",\"children\":[\"" : ",\"") << document_.idOf(placed, int(c)) << "\"";
            isFirstChild = false;
        }
        if (!isFirstChild) out_ << "]";
    }

    void geometry(const PlacedPlan& placed, int component, std::int64_t base, std::int64_t anchor) {
        const Component& c = placed.plan->components[std::size_t(component)];
        if (c.shells.empty()) return;
        out_ << ",\"geometry\":[{";
        if (c.instance) {
            instance(placed, *c.instance, anchor);
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
        out_ << "\"type\":\"CompositeSolid\",\"lod\":\"3\",\"boundaries\":[";
        for (std::size_t s = 0; s < component.shells.size(); ++s) {
            out_ << (s == 0 ? "[" : ",[");
            shell(component.shells[s], base);
            out_ << "]";
        }
        out_ << "],\"material\":{\"sample\":{\"values\":[";
        for (std::size_t s = 0; s < component.shells.size(); ++s) {
            out_ << (s == 0 ? "[[" : ",[[");
            for (std::size_t f = 0; f < component.shells[s].faces.size(); ++f)
                out_ << (f == 0 ? "" : ",") << int(document_.shown(component.shells[s].material));
            out_ << "]]";
        }
        out_ << "]}}";
    }

    void semantics(const PlacedPlan& placed, int room) {
        const std::size_t faceCount = placed.plan->components[std::size_t(room)].shells.front().faces.size();
        std::vector<int> values(faceCount, 0);
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
        out_ << "],\"values\":[[";
        for (std::size_t f = 0; f < values.size(); ++f) out_ << (f == 0 ? "" : ",") << values[f];
        out_ << "]]}";
    }

    void instance(const PlacedPlan& placed, const Instance& shape, std::int64_t anchor) {
        const std::array<Vec3d, 4> quarters{{{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}}};
        const Vec3d east = placed.placement.worldDirection(quarters[std::size_t(shape.quarterTurns)]);
        const auto text = [](double value) { return fixedText(std::llround(value * 1e12), 12); };
        out_ << "\"type\":\"GeometryInstance\",\"template\":0,\"boundaries\":[" << anchor
             << "],\"transformationMatrix\":[" << text(east.x) << "," << text(-east.y) << ",0,0," << text(east.y) << ","
             << text(east.x) << ",0,0,0,0,1,0,0,0,0,1]";
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
