#include <svt/writers/indoorgml/cell_plan.hpp>
#include <svt/writers/labels/label_looks.hpp>

#include <svt/analyze/space_boundaries.hpp>
#include <svt/core/text.hpp>
#include <svt/model/classes.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <unordered_set>

namespace svt::writers::indoor {
namespace {

using volume::kNoLabel;
using volume::Label;

constexpr double kLeastOpening = 0.01;  // m2

std::string textOf(const Label& label, std::string_view name) {
    for (const Attribute& attribute : label.attributes)
        if (attribute.name == name) return toText(attribute.value);
    return {};
}

// Classes of cell spaces that volumes of IndoorGML files know of their labels.
std::string_view knownKind(const Label& label) {
    constexpr std::string_view kKinds[] = {"CellSpace",       "NavigableSpace",  "GeneralSpace", "TransferSpace",
                                           "ConnectionSpace", "TransitionSpace", "AnchorSpace"};
    const std::string kind = textOf(label, "cellSpaceClass");
    const auto* found = std::find(std::begin(kKinds), std::end(kKinds), kind);
    if (found != std::end(kKinds)) return *found;
    return kind.empty() ? "GeneralSpace" : "CellSpace";
}

// A letter or underscore, then letters, digits, points, hyphens; in ASCII, beyond which any character will do.
std::string xmlName(std::string_view text) {
    std::string name;
    for (const char c : text) {
        const bool isFirst = isLetter(c) || c == '_' || (c & 0x80) != 0;
        const bool isName = isFirst || isDigit(c) || c == '-' || c == '.';
        if (name.empty() && !isFirst) name = "_";
        name += isName ? c : '_';
    }
    return name.empty() ? "_" : name;
}

class Planner {
public:
    Planner(const volume::SemanticVolume& volume, const VolumeWriteOptions& options)
        : volume_(volume), options_(options), labelOfScalar_(volume.labels.labelOfScalar()) {
        // Surfaces of doors are the doors only where no doors are (CityGML 1 and 2).
        hasDoors_ = std::any_of(volume.labels.labels.begin(), volume.labels.labels.end(),
                                [](const Label& label) { return label.className == "Door" && label.count > 0; });
    }

    Result<CellPlan> run() {
        SVT_DO(findShapes());
        const auto& labels = volume_.labels.labels;
        for (std::uint32_t l = 0; l < labels.size(); ++l)
            if (isRoom(l)) addCells(l, knownKind(labels[l]), shapes_[l]);
        if (plan_.cells.empty())
            return Error(Code::NothingSelected, "the volume has no rooms (BuildingRoom), so there are no cell spaces");
        const std::size_t rooms = plan_.cells.size();
        joinRooms(rooms);
        addDoors(rooms);
        for (Cell& cell : plan_.cells) cell.inner = innerPoint(cell.body);
        for (Transition& transition : plan_.transitions) drawLine(transition);
        return std::move(plan_);
    }

private:
    [[nodiscard]] bool isRoom(std::uint32_t label) const {
        const std::string& className = volume_.labels.labels[label].className;
        return model::isSpace(className) && model::classRank(className) == model::ClassRank::Room;
    }
    [[nodiscard]] bool isDoor(std::uint32_t label) const {
        const std::string& className = volume_.labels.labels[label].className;
        return className == "Door" || (className == "DoorSurface" && !hasDoors_);
    }

    // Kept meshes where they are closed, or a door's; else voxels, a room's with all that stands in it.
    Result<void> findShapes() {
        const auto& labels = volume_.labels.labels;
        shapes_.resize(labels.size());
        isOfVoxels_.assign(labels.size(), false);
        std::vector<std::uint32_t> ownerOf = analyze::spacesOfLabels(volume_.labels);
        bool isAnyMissing = false;
        for (std::uint32_t l = 0; l < labels.size(); ++l) {
            if (isRoom(l)) {
                shapes_[l] = keptMesh(volume_, l);
                if (!isClosed(shapes_[l]) || volumeOf(shapes_[l]) <= 0) shapes_[l] = {};
            } else if (isDoor(l)) {
                shapes_[l] = keptMesh(volume_, l);
                ownerOf[l] = l;
            }
            isAnyMissing = isAnyMissing || ((isRoom(l) || isDoor(l)) && shapes_[l].triangles.empty());
        }
        if (!isAnyMissing) return {};
        for (std::uint32_t& owner : ownerOf)
            if (owner != kNoLabel && (!(isRoom(owner) || isDoor(owner)) || !shapes_[owner].triangles.empty()))
                owner = kNoLabel;
        SVT_TRY(voxels, voxelShapes(volume_, ownerOf, options_.threads, options_.progress));
        for (std::uint32_t l = 0; l < labels.size(); ++l)
            if (!(*voxels)[l].triangles.empty()) {
                shapes_[l] = std::move((*voxels)[l]);
                isOfVoxels_[l] = true;
            }
        return {};
    }

    // A cell for each piece of a shape; of voxels, no crumbs.
    void addCells(std::uint32_t label, std::string_view kind, const CellShape& shape) {
        const double least = 8 * volume_.grid.voxelVolume();
        std::vector<CellBody> pieces = piecesOf(shape);
        const bool hasLarge = std::any_of(pieces.begin(), pieces.end(),
                                          [&](const CellBody& piece) { return volumeOf(piece.shell) > least; });
        for (CellBody& piece : pieces)
            if (!hasLarge || volumeOf(piece.shell) > least) addCell(label, kind, std::move(piece));
    }

    std::size_t addCell(std::uint32_t label, std::string_view kind, CellBody body) {
        Cell cell;
        cell.label = label;
        const std::string name = xmlName(volume_.labels.labels[label].id);
        cell.id = name;
        for (int i = 2; !ids_.insert(cell.id).second; ++i) cell.id = fmt::format("{}_{}", name, i);
        cell.kind = kind;
        cell.storey = storeyOf(label);
        cell.body = std::move(body);
        plan_.cells.push_back(std::move(cell));
        return plan_.cells.size() - 1;
    }

    [[nodiscard]] std::string storeyOf(std::uint32_t label) const {
        const auto& labels = volume_.labels.labels;
        for (std::uint32_t l = label; l != kNoLabel; l = labels[l].parent) {
            if (labels[l].className == "Storey") return shownName(labels[l]);
            for (const std::uint32_t group : labels[l].groups)
                if (labels[group].className == "Storey") return shownName(labels[group]);
        }
        return textOf(labels[label], "storey");
    }

    std::size_t addBoundary(std::size_t a, std::size_t b, std::vector<FacePiece> pieces) {
        const std::size_t number = plan_.boundaries.size();
        plan_.boundaries.push_back({a, b, std::move(pieces), Boundary::kNone});
        plan_.cells[a].boundaries.push_back(number);
        plan_.cells[b].boundaries.push_back(number);
        return number;
    }

    void addTransition(std::size_t boundary) {
        Boundary& face = plan_.boundaries[boundary];
        face.transition = plan_.transitions.size();
        for (const std::size_t cell : {face.a, face.b}) plan_.cells[cell].transitions.push_back(face.transition);
        plan_.transitions.push_back({face.a, face.b, boundary, {}});
    }

    // Faces that rooms have in common; one leads through the largest that is upright.
    void joinRooms(std::size_t rooms) {
        std::vector<Box3d> bounds;
        for (std::size_t r = 0; r < rooms; ++r) bounds.push_back(plan_.cells[r].body.shell.bounds());
        for (std::size_t a = 0; a < rooms; ++a)
            for (std::size_t b = a + 1; b < rooms; ++b) {
                Box3d grown = bounds[a];
                for (const double by : {-1e-4, 1e-4})
                    for (const Vec3d corner : {bounds[a].min, bounds[a].max}) grown.add(corner + Vec3d{by, by, by});
                if (!grown.overlaps(bounds[b])) continue;
                std::size_t widest = Boundary::kNone;
                double widestArea = kLeastOpening;
                for (auto& pieces : commonFaces(plan_.cells[a].body, plan_.cells[b].body)) {
                    const Vec3d normal = cross(pieces[0][1] - pieces[0][0], pieces[0][2] - pieces[0][0]);
                    const bool isUpright = std::abs(normal.z) < 0.5 * length(normal);
                    const double area = areaOf(pieces);
                    const std::size_t number = addBoundary(a, b, std::move(pieces));
                    if (!isUpright || area <= widestArea) continue;
                    widest = number;
                    widestArea = area;
                }
                if (widest != Boundary::kNone) addTransition(widest);
            }
    }

    void addDoors(std::size_t roomCount) {
        std::vector<const CellBody*> rooms;
        std::vector<CellBody> bodies;  // cells move when doors are added
        std::vector<Box3d> bounds;
        for (std::size_t r = 0; r < roomCount; ++r) bodies.push_back(plan_.cells[r].body);
        for (const CellBody& body : bodies) {
            rooms.push_back(&body);
            bounds.push_back(body.shell.bounds());
        }
        for (std::uint32_t l = 0; l < volume_.labels.labels.size(); ++l) {
            if (!isDoor(l)) continue;
            auto doorway = findDoorway(volume_, labelOfScalar_, shapes_[l], l, rooms, bounds);
            const std::size_t reached = doorway ? doorway->contacts.size() : 0;
            if ((isOfVoxels_[l] && addVoxelDoor(l, bounds, reached)) || !doorway) continue;
            const bool isInner = doorway->hasRoom[0] && doorway->hasRoom[1];
            const std::size_t door =
                addCell(l, isInner ? "ConnectionSpace" : "AnchorSpace", {std::move(doorway->shape), {}});
            for (auto& contact : doorway->contacts) {
                if (!contact.pieces.empty()) {
                    addTransition(addBoundary(contact.room, door, std::move(contact.pieces)));
                    continue;
                }
                for (const std::size_t cell : {contact.room, door})
                    plan_.cells[cell].transitions.push_back(plan_.transitions.size());
                plan_.transitions.push_back({contact.room, door, Boundary::kNone, {}});
            }
        }
    }

    // In walls across the grid, boxes do not fit between the stairs of rooms: the voxels of a door are its cell, if
    // more rooms touch them than a box has reached.
    bool addVoxelDoor(std::uint32_t label, const std::vector<Box3d>& rooms, std::size_t reached) {
        std::vector<CellBody> pieces = piecesOf(shapes_[label]);
        if (pieces.empty()) return false;
        const Box3d bounds = pieces.front().shell.bounds();
        std::vector<std::pair<std::size_t, std::vector<FacePiece>>> faces;
        for (std::size_t room = 0; room < rooms.size(); ++room) {
            if (!rooms[room].overlaps(bounds)) continue;
            std::vector<FacePiece> widest;
            for (auto& plane : commonFaces(plan_.cells[room].body, pieces.front()))
                if (areaOf(plane) > std::max(areaOf(widest), kLeastOpening)) widest = std::move(plane);
            if (!widest.empty()) faces.emplace_back(room, std::move(widest));
        }
        if (faces.size() <= reached) return false;
        const std::size_t door =
            addCell(label, faces.size() > 1 ? "ConnectionSpace" : "AnchorSpace", std::move(pieces.front()));
        for (auto& [room, face] : faces) addTransition(addBoundary(room, door, std::move(face)));
        return true;
    }

    void drawLine(Transition& transition) const {
        if (transition.boundary == Boundary::kNone) {
            transition.line = {plan_.cells[transition.a].inner, plan_.cells[transition.b].inner};
            return;
        }
        Vec3d middle{};
        double total = 0;
        for (const FacePiece& piece : plan_.boundaries[transition.boundary].pieces) {
            Vec3d sum{};
            for (const Vec3d& p : piece) sum = sum + p;
            const double area = areaOf({piece});
            middle = middle + sum / double(piece.size()) * area;
            total += area;
        }
        transition.line = {plan_.cells[transition.a].inner, middle / total, plan_.cells[transition.b].inner};
    }

    const volume::SemanticVolume& volume_;
    const VolumeWriteOptions& options_;
    std::vector<std::uint32_t> labelOfScalar_;
    bool hasDoors_ = false;
    std::vector<CellShape> shapes_;  // per label
    std::vector<bool> isOfVoxels_;   // per label
    std::unordered_set<std::string> ids_;
    CellPlan plan_;
};

}  // namespace

Result<CellPlan> planCells(const volume::SemanticVolume& volume, const VolumeWriteOptions& options) {
    return Planner(volume, options).run();
}

}  // namespace svt::writers::indoor
