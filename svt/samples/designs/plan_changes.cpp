#include <svt/samples/designs/plan_changes.hpp>

#include <svt/samples/parts/furniture.hpp>
#include <svt/samples/parts/random.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace svt::samples {
namespace {

constexpr std::size_t kEditCount = kNames<SampleEdit>.size();
constexpr int kMostTries = 200;
constexpr Length kHole = 100, kRim = 20;  // millimetres: side of a hole, and material that is left around it

struct BoxPiece {
    std::array<Length, 3> low{}, high{};
    bool adds = true;
};

bool isBoxPiece(const Piece& piece) {
    constexpr std::array<std::array<Length, 2>, 4> kSides{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};
    if (piece.sides.size() != kSides.size()) return false;
    for (std::size_t s = 0; s < kSides.size(); ++s)
        if (piece.sides[s].across != kSides[s][0] || piece.sides[s].up != kSides[s][1]) return false;
    return true;
}

bool isOfBoxes(const Component& component) {
    return component.solids.size() == 1 && component.solids[0].axis == Axis::X &&
           std::all_of(component.solids[0].pieces.begin(), component.solids[0].pieces.end(), isBoxPiece);
}

BoxPiece toBox(const Piece& piece) {
    return {{piece.from, -piece.sides[1].limit, -piece.sides[3].limit},
            {piece.to, piece.sides[0].limit, piece.sides[2].limit},
            piece.adds};
}

Piece toPiece(const BoxPiece& from) {
    Piece piece = box(from.low[0], from.high[0], from.low[1], from.high[1], from.low[2], from.high[2]);
    piece.adds = from.adds;
    return piece;
}

std::vector<BoxPiece> toBoxes(const Solid& solid) {
    std::vector<BoxPiece> boxes;
    for (const Piece& piece : solid.pieces) boxes.push_back(toBox(piece));
    return boxes;
}

// Whether the cell with this centre, in half millimetres, lies in the solid.
bool isInside(const std::vector<BoxPiece>& solid, const std::array<Length, 3>& center) {
    bool inside = false;
    for (const BoxPiece& piece : solid) {
        bool isIn = true;
        for (std::size_t axis = 0; axis < 3; ++axis)
            isIn = isIn && 2 * piece.low[axis] < center[axis] && center[axis] < 2 * piece.high[axis];
        if (isIn) inside = piece.adds;
    }
    return inside;
}

struct Volumes {
    Length added = 0, removed = 0;  // cubic millimetres
};

// Exact: the planes of all boxes divide space into cells that lie inside or outside.
Volumes differenceOf(const Solid& was, const Solid& is) {
    const std::vector<BoxPiece> before = toBoxes(was), after = toBoxes(is);
    std::array<std::vector<Length>, 3> planes;
    for (const auto* boxes : {&before, &after})
        for (const BoxPiece& piece : *boxes)
            for (std::size_t axis = 0; axis < 3; ++axis) {
                planes[axis].push_back(piece.low[axis]);
                planes[axis].push_back(piece.high[axis]);
            }
    for (std::vector<Length>& along : planes) {
        std::sort(along.begin(), along.end());
        along.erase(std::unique(along.begin(), along.end()), along.end());
    }
    Volumes volumes;
    for (std::size_t x = 0; x + 1 < planes[0].size(); ++x)
        for (std::size_t y = 0; y + 1 < planes[1].size(); ++y)
            for (std::size_t z = 0; z + 1 < planes[2].size(); ++z) {
                const std::array<Length, 3> low{planes[0][x], planes[1][y], planes[2][z]},
                    high{planes[0][x + 1], planes[1][y + 1], planes[2][z + 1]};
                const std::array<Length, 3> center{low[0] + high[0], low[1] + high[1], low[2] + high[2]};
                const bool wasIn = isInside(before, center), isIn = isInside(after, center);
                const Length volume = (high[0] - low[0]) * (high[1] - low[1]) * (high[2] - low[2]);
                if (isIn && !wasIn) volumes.added += volume;
                if (wasIn && !isIn) volumes.removed += volume;
            }
    return volumes;
}

class Changer {
public:
    Changer(Plan& plan, std::uint64_t seed)
        : plan_(plan), seed_(seed), random_(mixBits(seed + 1)), isEdited_(plan.components.size(), 0) {
        for (Component& component : plan.components)
            if (component.kind == Kind::Element) component.isExternal = hasOuterFace(component);
    }

    PlanChanges run() {
        const std::int64_t count = 1 + random_.below(4);
        for (std::int64_t e = 0; e < count; ++e)
            edit(static_cast<SampleEdit>((seed_ + std::uint64_t(e) * 3) % kEditCount));
        removeDeleted();
        changes_.hasNewIds = random_.below(4) == 0;
        changes_.hasNewTriangles = random_.below(3) == 0;
        changes_.isReordered = random_.below(3) == 0;
        if (changes_.hasNewIds) renewIds();
        if (changes_.isReordered) reorder();
        resolveAgain();
        if (changes_.hasNewTriangles) splitFaces();
        return std::move(changes_);
    }

private:
    [[nodiscard]] Length signedLength(Length least, Length most) {
        const Length size = least + random_.below(most - least + 1);
        return random_.below(2) == 0 ? size : -size;
    }

    // Boxes that no neighbour shares faces with; a hole may be in elements too, since it does not change their neighbours.
    [[nodiscard]] bool isEditable(const Component& component, SampleEdit edit) const {
        if (!isOfBoxes(component) || component.isStandIn) return false;
        if (component.kind == Kind::Furniture) return true;
        return edit == SampleEdit::Hole ? component.kind == Kind::Element || component.kind == Kind::Installation
                                        : component.kind == Kind::Installation && edit != SampleEdit::Reclass;
    }

    void edit(SampleEdit edit) {
        for (int tries = 0; tries < kMostTries; ++tries) {
            const auto c = std::size_t(random_.below(std::int64_t(isEdited_.size())));
            if (isEdited_[c] != 0 || !isEditable(plan_.components[c], edit) || !tryEdit(edit, c)) continue;
            isEdited_[c] = 1;
            return;
        }
    }

    // False if this component does not allow the edit.
    bool tryEdit(SampleEdit edit, std::size_t c) {
        Component changed = plan_.components[c];
        changed.instance.reset();
        PlanChange change;
        change.edit = edit;
        change.was = change.is = changed.id;
        const std::string before(className(changed.kind)), name = changed.name;
        switch (edit) {
            case SampleEdit::Move: change.vector = move(changed); break;
            case SampleEdit::Rotate: change.quarterTurns = rotate(changed); break;
            case SampleEdit::Resize: resize(changed); break;
            case SampleEdit::Hole:
                if (!cutHole(changed)) return false;
                break;
            case SampleEdit::Delete: change.is.reset(); break;
            case SampleEdit::Duplicate:
                change.vector = {};
                change.was.reset();
                move(changed, 300);
                changed.id += "_copy";
                changed.name += " copy";
                change.is = changed.id;
                break;
            case SampleEdit::Reclass: changed.kind = Kind::Installation; break;
            case SampleEdit::Rename: changed.name += " renamed"; break;
        }
        const Solid none{Axis::X, Material::Air, {}};
        const Solid &was = change.was ? plan_.components[c].solids[0] : none,
                    &is = change.is ? changed.solids[0] : none;
        const Volumes volumes = differenceOf(was, is);
        const bool isOfSpace = edit != SampleEdit::Reclass && edit != SampleEdit::Rename;
        if (isOfSpace && volumes.added + volumes.removed == 0) return false;  // such as half a turn
        change.added = volumes.added;
        change.removed = volumes.removed;
        change.className = {before, std::string(className(changed.kind))};
        change.name = {name, changed.name};
        if (edit == SampleEdit::Duplicate)
            plan_.components.push_back(std::move(changed));
        else if (edit == SampleEdit::Delete)
            deleted_.push_back(c);
        else
            plan_.components[c] = std::move(changed);
        changes_.edits.push_back(std::move(change));
        return true;
    }

    // One to three axes, at least 5 mm along one.
    Point move(Component& component, Length least = 5) {
        Point vector{};
        const std::int64_t axes = 1 + random_.below(7);
        for (int axis = 0; axis < 3; ++axis)
            if ((axes >> axis & 1) != 0) vector[axis] = signedLength(least, least + 145);
        component.solids[0] = placed(component.solids[0], 0, vector);
        return vector;
    }

    // A quarter turn about the centre of the plan of the component. Returns its sense.
    int rotate(Component& component) {
        const Box3d before = boundsOf(component.solids[0]);
        const int quarterTurns = random_.below(2) == 0 ? 1 : 3;
        const Solid turned = placed(component.solids[0], quarterTurns, {});
        const Box3d after = boundsOf(turned);
        const Vec3d shift = (before.min + before.max - after.min - after.max) / 2.0;
        component.solids[0] = placed(turned, 0, {Length(shift.x), Length(shift.y), 0});
        return quarterTurns == 1 ? 1 : -1;
    }

    // Moves the outermost planes at one side, and cuts that end there.
    void resize(Component& component) {
        const auto axis = std::size_t(random_.below(3));
        const Length by = signedLength(5, 24);
        std::vector<BoxPiece> boxes = toBoxes(component.solids[0]);
        Length outermost = boxes[0].high[axis];
        for (const BoxPiece& piece : boxes)
            if (piece.adds) outermost = std::max(outermost, piece.high[axis]);
        for (std::size_t p = 0; p < boxes.size(); ++p) {
            if (boxes[p].high[axis] != outermost || boxes[p].low[axis] >= outermost + by) continue;
            boxes[p].high[axis] += by;
            component.solids[0].pieces[p] = toPiece(boxes[p]);
        }
    }

    // Through the component along its shortest axis. False if the place has not enough material around the hole.
    bool cutHole(Component& component) {
        const Box3d bounds = boundsOf(component.solids[0]);
        std::size_t through = 0;
        BoxPiece hole{};
        for (int axis = 0; axis < 3; ++axis) {
            const auto low = Length(bounds.min[axis]), high = Length(bounds.max[axis]);
            hole.low[std::size_t(axis)] = low;
            hole.high[std::size_t(axis)] = high;
            if (high - low < hole.high[through] - hole.low[through]) through = std::size_t(axis);
        }
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if (axis == through) continue;
            const Length room = hole.high[axis] - hole.low[axis] - kHole - 2 * kRim;
            if (room < 0) return false;
            hole.low[axis] += kRim + random_.below(room + 1);
            hole.high[axis] = hole.low[axis] + kHole;
        }
        BoxPiece around = hole;
        Length volume = 1;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            around.low[axis] -= axis == through ? 0 : kRim;
            around.high[axis] += axis == through ? 0 : kRim;
            volume *= around.high[axis] - around.low[axis];
        }
        Solid cut = component.solids[0];
        cut.cut(toPiece(around));
        if (differenceOf(component.solids[0], cut).removed != volume) return false;
        component.solids[0].cut(toPiece(hole));
        return true;
    }

    // `order` has the old index of each new component.
    void arrange(const std::vector<std::size_t>& order) {
        std::vector<int> next(plan_.components.size(), -1);
        for (std::size_t n = 0; n < order.size(); ++n) next[order[n]] = int(n);
        std::vector<Component> components;
        for (const std::size_t old : order) {
            Component component = std::move(plan_.components[old]);
            for (int* index : {&component.parent, &component.storey, &component.unit})
                if (*index >= 0) *index = next[std::size_t(*index)];
            components.push_back(std::move(component));
        }
        plan_.components = std::move(components);
    }

    void removeDeleted() {
        std::vector<std::size_t> order;
        for (std::size_t c = 0; c < plan_.components.size(); ++c)
            if (std::find(deleted_.begin(), deleted_.end(), c) == deleted_.end()) order.push_back(c);
        arrange(order);
    }

    // A random order in which parents precede their children.
    void reorder() {
        std::vector<std::size_t> order, open;
        std::vector<char> isPlaced(plan_.components.size(), 0);
        for (std::size_t c = 0; c < plan_.components.size(); ++c) open.push_back(c);
        while (!open.empty()) {
            const auto at = std::size_t(random_.below(std::int64_t(open.size())));
            const std::size_t c = open[at];
            const int parent = plan_.components[c].parent;
            if (parent >= 0 && isPlaced[std::size_t(parent)] == 0) continue;
            isPlaced[c] = 1;
            order.push_back(c);
            open.erase(open.begin() + std::ptrdiff_t(at));
        }
        arrange(order);
    }

    void renewIds() {
        const auto renewed = [&](const std::string& id) {
            return fmt::format("n{:016x}", fnvHash(id, mixBits(seed_)));
        };
        for (Component& component : plan_.components) {
            component.mark = component.id;
            component.id = renewed(component.id);
        }
        for (PlanChange& change : changes_.edits)
            if (change.is) change.is = renewed(*change.is);
    }

    void resolveAgain() {
        plan_.vertices.clear();
        plan_.children.clear();
        for (Component& component : plan_.components) {
            component.shells.clear();
            component.volume = 0;
            if (!component.instance) continue;
            component.instance->shell = {};
            component.instance->vertices.clear();
        }
        resolve(plan_);
    }

    // Divides each rectangle of components without neighbours into four triangles about a point inside.
    void splitFaces() {
        for (Component& component : plan_.components) {
            if (fillsSpace(component) || component.kind == Kind::Unit || !isOfBoxes(component)) continue;
            for (Shell& shell : component.shells) {
                std::vector<Face> faces;
                for (Face& face : shell.faces) splitFace(face, faces);
                shell.faces = std::move(faces);
            }
        }
    }

    void splitFace(Face& face, std::vector<Face>& faces) {
        if (face.rings.size() != 1 || face.rings[0].size() != 4) {
            faces.push_back(std::move(face));
            return;
        }
        const std::vector<std::uint32_t>& ring = face.rings[0];
        const Point sum = plan_.vertices[ring[0]] + plan_.vertices[ring[2]];
        const auto center = std::uint32_t(plan_.vertices.size());
        plan_.vertices.push_back(sum / 2);
        for (std::size_t i = 0; i < 4; ++i) {
            Face triangle = face;
            triangle.rings = {{ring[i], ring[(i + 1) % 4], center}};
            faces.push_back(std::move(triangle));
        }
    }

    Plan& plan_;
    std::uint64_t seed_;
    Random random_;
    std::vector<char> isEdited_;  // by component before the edits
    std::vector<std::size_t> deleted_;
    PlanChanges changes_;
};

}  // namespace

PlanChanges changePlan(Plan& plan, std::uint64_t seed) { return Changer(plan, seed).run(); }

}  // namespace svt::samples
