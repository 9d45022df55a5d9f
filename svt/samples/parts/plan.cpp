#include <svt/samples/parts/plan.hpp>

#include <svt/core/check.hpp>

#include <algorithm>
#include <map>
#include <utility>

namespace svt::samples {
namespace {

// Name, color, transparency, colored in GML.
constexpr MaterialInfo kMaterials[] = {
    {"brick", {0.76, 0.46, 0.36}, 0.0, true},        {"concrete", {0.66, 0.66, 0.64}, 0.0, false},
    {"timber", {0.72, 0.53, 0.33}, 0.0, false},      {"roof tiles", {0.70, 0.22, 0.16}, 0.0, true},
    {"glass", {0.55, 0.76, 0.92}, 0.6, true},        {"gypsum", {0.92, 0.91, 0.88}, 0.0, false},
    {"fabric", {0.33, 0.45, 0.60}, 0.0, false},      {"ceramic", {0.95, 0.96, 0.97}, 0.0, false},
    {"steel", {0.45, 0.48, 0.52}, 0.0, false},       {"painted timber", {0.88, 0.86, 0.80}, 0.0, true},
    {"air", {0.93, 0.95, 0.98}, 0.9, false},         {"white plaster", {0.93, 0.92, 0.89}, 0.0, true},
    {"sand plaster", {0.87, 0.79, 0.65}, 0.0, true}, {"ochre plaster", {0.84, 0.66, 0.38}, 0.0, true},
    {"sage plaster", {0.68, 0.74, 0.62}, 0.0, true}, {"brown roof tiles", {0.45, 0.28, 0.20}, 0.0, true},
    {"slate", {0.30, 0.33, 0.37}, 0.0, true},
};

using Key = std::vector<Point>;

// The same key for equal rings, whatever vertex they start at; holes in order.
Key canonicalKey(const std::vector<Point>& vertices, const Face& face, bool isReversed) {
    std::vector<Key> rings;
    for (const auto& ring : face.rings) {
        Key points;
        for (const std::uint32_t i : ring) points.push_back(vertices[i]);
        if (isReversed) std::reverse(points.begin(), points.end());
        std::rotate(points.begin(), std::min_element(points.begin(), points.end()), points.end());
        rings.push_back(std::move(points));
    }
    std::sort(rings.begin() + 1, rings.end());
    Key key;
    for (const Key& ring : rings) key.insert(key.end(), ring.begin(), ring.end());
    return key;
}

Point toMillimetres(Point p) {
    // Every vertex of a design is on whole millimetres.
    SVT_CHECK(p.x % kUnitsPerMillimetre == 0 && p.y % kUnitsPerMillimetre == 0 && p.z % kUnitsPerMillimetre == 0);
    return p / kUnitsPerMillimetre;
}

class VertexTable {
public:
    explicit VertexTable(std::vector<Point>& vertices) : vertices_(vertices) {}
    std::uint32_t indexOf(Point p) {
        const auto [it, isNew] = indices_.try_emplace(p, std::uint32_t(vertices_.size()));
        if (isNew) vertices_.push_back(p);
        return it->second;
    }

private:
    std::vector<Point>& vertices_;
    std::map<Point, std::uint32_t> indices_;
};

Shell toShell(std::vector<RawFace>& faces, Material material, std::span<const Point> corners, VertexTable& table) {
    Shell shell;
    shell.material = material;
    for (RawFace& raw : faces) {
        simplify(raw, corners);
        Face face;
        face.neighbor = raw.neighbor;
        for (const auto& ring : raw.rings) {
            auto& indices = face.rings.emplace_back();
            for (const Point p : ring) indices.push_back(table.indexOf(toMillimetres(p)));
        }
        shell.faces.push_back(std::move(face));
    }
    return shell;
}

void sortUnique(std::vector<Point>& points) {
    std::sort(points.begin(), points.end());
    points.erase(std::unique(points.begin(), points.end()), points.end());
}

void resolveInstance(Instance& instance) {
    Boundary shape = boundary(instance.solid, {});
    std::vector<Point> corners;
    for (const RawFace& face : shape.faces) collectCorners(face, corners);
    sortUnique(corners);
    VertexTable table(instance.vertices);
    instance.shell = toShell(shape.faces, instance.solid.material, corners, table);
}

// Pairs every face with the identical, reversed face of its neighbour.
void pairFaces(Plan& plan) {
    std::map<Key, std::pair<int, int>> owners;
    const auto forEach = [&](const auto& visit) {
        for (std::size_t c = 0; c < plan.components.size(); ++c) {
            if (!fillsSpace(plan.components[c])) continue;
            int index = 0;
            for (Shell& shell : plan.components[c].shells)
                for (Face& face : shell.faces) visit(int(c), index++, face);
        }
    };
    forEach([&](int component, int index, Face& face) {
        if (face.neighbor >= 0) owners[canonicalKey(plan.vertices, face, false)] = {component, index};
    });
    forEach([&](int, int, Face& face) {
        if (face.neighbor < 0) return;
        const auto twin = owners.find(canonicalKey(plan.vertices, face, true));
        if (twin != owners.end() && twin->second.first == face.neighbor) face.neighborFace = twin->second.second;
    });
}

std::string_view surfaceType(const Plan& plan, const Face& face) {
    if (face.neighbor < 0) return "ClosureSurface";
    const Component& neighbor = plan.components[std::size_t(face.neighbor)];
    const Kind kind = neighbor.kind;
    if (kind == Kind::Room) return "ClosureSurface";
    if (kind == Kind::Door) return "DoorSurface";
    if (kind == Kind::Window) return "WindowSurface";
    if (neighbor.hullPart == HullPart::Wall) return "InteriorWallSurface";
    const Vec3d normal = normalOf(plan, face);
    const double up = normal.z / length(normal);
    return up < -0.5 ? "FloorSurface" : up > 0.5 ? "CeilingSurface" : "InteriorWallSurface";
}

}  // namespace

std::span<const MaterialInfo> materials() { return kMaterials; }

bool hasOuterFace(const Component& component) {
    return !component.shells.empty() &&
           std::any_of(component.shells.front().faces.begin(), component.shells.front().faces.end(),
                       [](const Face& face) { return face.neighbor < 0; });
}

std::string_view className(Kind kind) {
    switch (kind) {
        case Kind::Element: return "BuildingConstructiveElement";
        case Kind::Room: return "BuildingRoom";
        case Kind::Furniture: return "BuildingFurniture";
        case Kind::Installation: return "BuildingInstallation";
        case Kind::Window: return "Window";
        case Kind::Door: return "Door";
        case Kind::Storey: return "Storey";
        case Kind::Unit: return "BuildingUnit";
    }
    return {};
}

bool fillsSpace(const Component& component) {
    return component.kind == Kind::Element || component.kind == Kind::Room || component.kind == Kind::Window ||
           component.kind == Kind::Door;
}

bool isGrouped(const Component& component) {
    return !component.isStandIn && (component.parent < 0 || component.kind == Kind::Installation);
}

int addComponent(Plan& plan, Kind kind, std::string id, std::string name, int parent) {
    Component component;
    component.kind = kind;
    component.id = std::move(id);
    component.name = std::move(name);
    component.parent = parent;
    plan.components.push_back(std::move(component));
    return int(plan.components.size()) - 1;
}

int addElement(Plan& plan, int storey, std::string id, std::string name, std::string function, Material material,
               Piece piece, HullPart part, bool isLoadBearing) {
    const int index = addComponent(plan, Kind::Element, std::move(id), std::move(name));
    Component& component = plan.components.back();
    component.function = std::move(function);
    component.storey = storey;
    component.hullPart = part;
    component.attributes = {{"loadBearing", isLoadBearing, ""}};
    component.solids = {{Axis::X, material, {std::move(piece)}}};
    return index;
}

int addRoom(Plan& plan, int storey, std::string id, std::string name, std::string function, Piece piece) {
    const int index = addComponent(plan, Kind::Room, std::move(id), std::move(name));
    Component& component = plan.components.back();
    component.function = std::move(function);
    component.storey = storey;
    component.solids = {{Axis::X, Material::Air, {std::move(piece)}}};
    return index;
}

int addInstallation(Plan& plan, int storey, int parent, std::string id, std::string name, std::string function,
                    Solid solid) {
    const int index = addComponent(plan, Kind::Installation, std::move(id), std::move(name), parent);
    Component& component = plan.components.back();
    component.function = std::move(function);
    component.storey = storey;
    component.solids.push_back(std::move(solid));
    if (parent >= 0) component.unit = plan.components[std::size_t(parent)].unit;
    return index;
}

void resolve(Plan& plan) {
    // Each solid is a separate neighbour, so that a frame and its leaf or pane get separate faces.
    std::vector<Neighbor> fillers;
    std::vector<int> owners;
    for (std::size_t c = 0; c < plan.components.size(); ++c) {
        if (!fillsSpace(plan.components[c])) continue;
        for (const Solid& solid : plan.components[c].solids) {
            fillers.emplace_back(solid, int(fillers.size()));
            owners.push_back(int(c));
        }
    }
    std::vector<std::vector<Boundary>> boundaries(plan.components.size());
    std::vector<Point> sharedCorners;
    for (std::size_t c = 0; c < plan.components.size(); ++c) {
        Component& component = plan.components[c];
        if (component.isStandIn) continue;
        const std::span<const Neighbor> neighbors = fillsSpace(component) ? fillers : std::span<const Neighbor>{};
        for (const Solid& solid : component.solids) {
            const Boundary& shape = boundaries[c].emplace_back(boundary(solid, neighbors));
            component.volume += shape.volume;
            if (!fillsSpace(component)) continue;
            for (const RawFace& face : shape.faces) collectCorners(face, sharedCorners);
        }
    }
    sortUnique(sharedCorners);
    VertexTable table(plan.vertices);
    plan.children.resize(plan.components.size());
    for (std::size_t c = 0; c < plan.components.size(); ++c) {
        Component& component = plan.components[c];
        if (component.parent >= 0) plan.children[std::size_t(component.parent)].push_back(int(c));
        for (std::size_t b = 0; b < boundaries[c].size(); ++b) {
            std::vector<RawFace>& faces = boundaries[c][b].faces;
            std::vector<Point> ownCorners;
            for (RawFace& face : faces) {
                if (face.neighbor >= 0) face.neighbor = owners[std::size_t(face.neighbor)];
                if (!fillsSpace(component)) collectCorners(face, ownCorners);
            }
            sortUnique(ownCorners);
            component.shells.push_back(toShell(faces, component.solids[b].material,
                                               fillsSpace(component) ? sharedCorners : ownCorners, table));
        }
        if (component.instance) resolveInstance(*component.instance);
    }
    pairFaces(plan);
}

Vec3d normalOf(const Plan& plan, const Face& face) {
    Vec3d sum;
    for (const auto& ring : face.rings) {
        const auto from = [&](std::uint32_t i) { return toDouble(plan.vertices[i] - plan.vertices[ring[0]]); };
        for (std::size_t i = 1; i + 1 < ring.size(); ++i) sum = sum + cross(from(ring[i]), from(ring[i + 1]));
    }
    return sum;
}

std::vector<BoundaryGroup> boundaryGroups(const Plan& plan, int room) {
    std::map<std::pair<std::string_view, int>, BoundaryGroup> byType;
    const auto groupOf = [&](std::string_view type, int neighbor) -> BoundaryGroup& {
        BoundaryGroup& group = byType[{type, neighbor}];
        group.type = type;
        group.neighbor = neighbor;
        return group;
    };
    const std::vector<Face>& faces = plan.components[std::size_t(room)].shells.front().faces;
    for (std::size_t f = 0; f < faces.size(); ++f)
        groupOf(surfaceType(plan, faces[f]), faces[f].neighbor).faces.push_back(int(f));
    std::vector<BoundaryGroup> openings;
    for (auto it = byType.begin(); it != byType.end();) {
        const bool isOpening = it->first.first == "DoorSurface" || it->first.first == "WindowSurface";
        if (isOpening) openings.push_back(std::move(it->second));
        it = isOpening ? byType.erase(it) : std::next(it);
    }
    for (BoundaryGroup& opening : openings) {
        const int wall = plan.components[std::size_t(opening.neighbor)].parent;
        BoundaryGroup* host = nullptr;
        for (const std::string_view type : {"CeilingSurface", "FloorSurface", "InteriorWallSurface"})
            if (host == nullptr && byType.count({type, wall}) != 0) host = &byType[{type, wall}];
        if (host == nullptr) host = &groupOf("InteriorWallSurface", wall);
        host->openings.push_back(std::move(opening));
    }
    std::vector<BoundaryGroup> groups;
    for (auto& [key, group] : byType) groups.push_back(std::move(group));
    return groups;
}

}  // namespace svt::samples
