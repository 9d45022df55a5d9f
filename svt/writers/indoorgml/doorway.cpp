#include <svt/writers/indoorgml/doorway.hpp>

#include <svt/model/classes.hpp>

#include <algorithm>
#include <cmath>

namespace svt::writers::indoor {
namespace {

using volume::kNoLabel;

constexpr double kOnFace = 1e-5;  // metres
constexpr double kBite = 0.0005;  // metres; half the depth that counts as an overlap
constexpr double kPi = 3.14159265358979323846;

// The part of a convex polygon where dot(p, normal) <= limit.
FacePiece clipped(const FacePiece& polygon, Vec3d normal, double limit) {
    FacePiece result;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec3d a = polygon[i], b = polygon[(i + 1) % polygon.size()];
        const double da = dot(a, normal) - limit, db = dot(b, normal) - limit;
        if (da <= 0) result.push_back(a);
        if ((da < 0 && db > 0) || (da > 0 && db < 0)) result.push_back(a + (b - a) * (da / (da - db)));
    }
    return result;
}

Vec3d areaVector(const FacePiece& polygon) {
    Vec3d sum{};
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
        sum = sum + cross(polygon[i] - polygon[0], polygon[i + 1] - polygon[0]);
    return sum * 0.5;
}

// Axes of a door: through it, along it, and up, with its extent along each.
struct DoorFrame {
    std::array<Vec3d, 3> axes{};
    Vec3d low{kInfinity, kInfinity, kInfinity}, high{-kInfinity, -kInfinity, -kInfinity};
    [[nodiscard]] Vec3d place(Vec3d p) const { return axes[0] * p.x + axes[1] * p.y + axes[2] * p.z; }
};

// Direction of the long side in the plan, by second moments of the surface; faces that are upright decide within ten
// degrees of it.
double directionAlong(const CellShape& door) {
    double area = 0, cosines = 0, sines = 0;
    Vec3d sum{};
    double xx = 0, xy = 0, yy = 0;
    for (std::size_t t = 0; t < door.triangles.size(); ++t) {
        const Vec3d a = door.corner(t, 0), b = door.corner(t, 1), c = door.corner(t, 2);
        const Vec3d normal = cross(b - a, c - a);
        const double weight = length(normal);
        for (const Vec3d m : {(a + b) * 0.5, (b + c) * 0.5, (c + a) * 0.5}) {
            sum = sum + m * weight;
            xx += weight * m.x * m.x;
            xy += weight * m.x * m.y;
            yy += weight * m.y * m.y;
            area += weight;
        }
        const double angle = 4 * std::atan2(normal.y, normal.x);
        const double across = std::hypot(normal.x, normal.y);
        cosines += across * std::cos(angle);
        sines += across * std::sin(angle);
    }
    const Vec3d mean = sum / area;
    const double moments = 0.5 * std::atan2(2 * (xy / area - mean.x * mean.y),
                                            (xx / area - mean.x * mean.x) - (yy / area - mean.y * mean.y));
    const double faces = std::atan2(sines, cosines) / 4;
    const double quarter = std::round((moments - faces) / (kPi / 2)) * (kPi / 2);
    return std::abs(faces + quarter - moments) < 10 * kPi / 180 ? faces + quarter : moments;
}

DoorFrame frameOf(const CellShape& door) {
    const double angle = directionAlong(door);
    // Exact for doors along the axes.
    const auto snapped = [](double v) {
        return std::abs(v) < 1e-9 ? 0.0 : std::abs(v) > 1 - 1e-12 ? std::copysign(1.0, v) : v;
    };
    const Vec3d along{snapped(std::cos(angle)), snapped(std::sin(angle)), 0};
    DoorFrame frame;
    frame.axes = {Vec3d{-along.y, along.x, 0}, along, Vec3d{0, 0, 1}};
    for (const Vec3d& p : door.points)
        for (int axis = 0; axis < 3; ++axis) {
            const double at = dot(p, frame.axes[std::size_t(axis)]);
            frame.low[axis] = std::min(frame.low[axis], at);
            frame.high[axis] = std::max(frame.high[axis], at);
        }
    return frame;
}

// The part of a triangle in front of the rectangle of the door, reduced by `margin`. Empty unless the triangle faces
// the door from this side.
FacePiece beforeDoor(const DoorFrame& frame, const CellShape& shape, std::size_t t, int side, double margin) {
    FacePiece piece{shape.corner(t, 0), shape.corner(t, 1), shape.corner(t, 2)};
    const Vec3d through = side == 0 ? frame.axes[0] : -frame.axes[0];
    if (!(dot(normalized(areaVector(piece)), through) > 0.1)) return {};
    for (int axis = 1; axis < 3 && piece.size() > 2; ++axis) {
        const Vec3d direction = frame.axes[std::size_t(axis)];
        piece = clipped(piece, direction, frame.high[axis] - margin);
        piece = clipped(piece, -direction, -(frame.low[axis] + margin));
    }
    // Not farther than the other side of the door: there, a room looks this way from its far end.
    if (piece.size() > 2) piece = clipped(piece, through, side == 0 ? frame.high.x : -frame.low.x);
    return piece;
}

class DoorwayFinder {
public:
    DoorwayFinder(const volume::SemanticVolume& volume, const std::vector<std::uint32_t>& labelOfScalar,
                  const CellShape& door, std::uint32_t label, const std::vector<const CellBody*>& rooms,
                  const std::vector<Box3d>& roomBounds)
        : volume_(volume), labelOfScalar_(labelOfScalar), label_(label), rooms_(rooms), frame_(frameOf(door)) {
        Box3d reach;
        for (const double n : {frame_.low.x - kReveal, frame_.high.x + kReveal})
            for (const double t : {frame_.low.y, frame_.high.y})
                for (const double z : {frame_.low.z, frame_.high.z}) reach.add(frame_.place({n, t, z}));
        for (std::size_t r = 0; r < rooms.size(); ++r)
            if (roomBounds[r].overlaps(reach)) near_.push_back(r);
    }

    std::optional<Doorway> run() {
        Doorway doorway;
        const DoorFrame leaf = frame_;
        for (const int side : {0, 1}) reachSide(side, leaf, doorway);
        if (doorway.contacts.empty() || frame_.high.x - frame_.low.x < 0.001) return std::nullopt;
        for (int i = 0; i < 8; ++i)
            doorway.shape.points.push_back(
                frame_.place({(i & 1) != 0 ? frame_.high.x : frame_.low.x, (i & 2) != 0 ? frame_.high.y : frame_.low.y,
                              (i & 4) != 0 ? frame_.high.z : frame_.low.z}));
        doorway.shape.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                                   {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
        if (volumeOf(doorway.shape) < 0)
            for (auto& triangle : doorway.shape.triangles) std::swap(triangle[1], triangle[2]);
        return doorway;
    }

private:
    // Stretches or shortens the box to the nearest face of a room at one of its ends.
    void reachSide(int side, const DoorFrame& leaf, Doorway& doorway) {
        const double sign = side == 0 ? 1 : -1;  // towards the door
        std::vector<std::pair<std::size_t, double>> found;
        double nearest = -kInfinity;
        for (const std::size_t r : near_) {
            double best = -kInfinity;
            for (std::size_t t = 0; t < rooms_[r]->shell.triangles.size(); ++t) {
                const FacePiece piece = beforeDoor(leaf, rooms_[r]->shell, t, side, 0.001);
                for (const Vec3d& p : piece) best = std::max(best, sign * dot(p, frame_.axes[0]));
            }
            if (best == -kInfinity) continue;
            found.emplace_back(r, best);
            nearest = std::max(nearest, best);
        }
        double& end = side == 0 ? frame_.low.x : frame_.high.x;
        if (found.empty() || sign * end - nearest > kReveal || !isFree(end, sign * nearest)) return;
        end = sign * nearest;
        doorway.hasRoom[std::size_t(side)] = true;
        bool hasFace = false;
        for (const auto& [room, at] : found)
            if (at > nearest - kOnFace) hasFace = addContact(room, side, end, leaf, doorway) || hasFace;
        // Stairs of voxels, or a wall that bends: the box goes on until it touches for certain.
        if (!hasFace) end -= sign * kBite;
    }

    // True if they have a part of a face in common.
    bool addContact(std::size_t room, int side, double end, const DoorFrame& leaf, Doorway& doorway) const {
        Doorway::Contact contact{room, {}};
        const CellShape& shell = rooms_[room]->shell;
        const Vec3d outwards = side == 0 ? frame_.axes[0] : -frame_.axes[0];  // of the room
        for (std::size_t t = 0; t < shell.triangles.size(); ++t) {
            FacePiece piece = beforeDoor(leaf, shell, t, side, 0);
            if (piece.size() < 3 || !(dot(areaVector(piece), outwards) > 1e-9)) continue;
            const bool isOnFace = std::all_of(
                piece.begin(), piece.end(), [&](Vec3d p) { return std::abs(dot(p, frame_.axes[0]) - end) <= kOnFace; });
            if (!isOnFace) continue;
            contact.pieces.push_back(std::move(piece));
        }
        const double whole = (frame_.high.y - frame_.low.y) * (frame_.high.z - frame_.low.z);
        if (areaOf(contact.pieces) > whole * (1 - 1e-6)) {
            FacePiece face;
            for (const auto& [t, z] : {std::pair(frame_.low.y, frame_.low.z), std::pair(frame_.high.y, frame_.low.z),
                                       std::pair(frame_.high.y, frame_.high.z), std::pair(frame_.low.y, frame_.high.z)})
                face.push_back(frame_.place({end, t, z}));
            if (dot(areaVector(face), outwards) < 0) std::reverse(face.begin(), face.end());
            contact.pieces = {std::move(face)};
        }
        doorway.contacts.push_back(std::move(contact));
        return !doorway.contacts.back().pieces.empty();
    }

    // Whether at least a third of the lines from the door to the room lead through no other component.
    [[nodiscard]] bool isFree(double from, double to) const {
        constexpr int kLines = 5;
        const Vec3d spacing = volume_.grid.spacing();
        const double step = std::min({spacing.x, spacing.y, spacing.z}) / 2;
        const int steps = static_cast<int>(std::ceil(std::abs(to - from) / step));
        int free = 0;
        for (int line = 0; line < kLines * kLines; ++line) {
            const double t = frame_.low.y + (frame_.high.y - frame_.low.y) * (line % kLines + 0.5) / kLines;
            const int row = line / kLines;
            const double z = frame_.low.z + (frame_.high.z - frame_.low.z) * (row + 0.5) / kLines;
            bool isLineFree = true;
            for (int s = 0; s < steps && isLineFree; ++s)
                isLineFree = !isBlocked(frame_.place({from + (to - from) * (s + 0.5) / steps, t, z}));
            free += isLineFree;
        }
        return free * 3 >= kLines * kLines;
    }

    [[nodiscard]] bool isBlocked(Vec3d local) const {
        const Vec3d index = volume_.grid.indexFromWorld(volume_.grid.origin() + local);
        const Vec3i n = volume_.columns.dimension();
        Vec3i sample;
        for (int axis = 0; axis < 3; ++axis) {
            sample[axis] = static_cast<std::int32_t>(std::lround(index[axis]));
            if (sample[axis] < 0 || sample[axis] >= n[axis]) return false;
        }
        const std::uint32_t label = labelOfScalar_[volume_.columns.scalarAt(sample.x, sample.y, sample.z)];
        if (label == kNoLabel || label == label_) return false;
        const std::string& className = volume_.labels.labels[label].className;
        return !model::isSpace(className) && model::classRank(className) > model::ClassRank::Filling;
    }

    const volume::SemanticVolume& volume_;
    const std::vector<std::uint32_t>& labelOfScalar_;
    std::uint32_t label_;
    const std::vector<const CellBody*>& rooms_;
    DoorFrame frame_;
    std::vector<std::size_t> near_;
};

// The common part of two triangles in one plane that look at each other; seen from the first.
FacePiece commonPart(const CellShape& a, std::size_t s, const CellShape& b, std::size_t t) {
    FacePiece piece{a.corner(s, 0), a.corner(s, 1), a.corner(s, 2)};
    const Vec3d normal = areaVector(piece);
    const Vec3d other = cross(b.corner(t, 1) - b.corner(t, 0), b.corner(t, 2) - b.corner(t, 0));
    if (!(dot(normalized(normal), normalized(other)) < -0.999999)) return {};
    const Vec3d unit = normalized(normal);
    for (int i = 0; i < 3; ++i)
        if (std::abs(dot(b.corner(t, i) - piece[0], unit)) > kOnFace) return {};
    for (int i = 0; i < 3 && piece.size() > 2; ++i) {
        const Vec3d from = b.corner(t, i), to = b.corner(t, (i + 1) % 3);
        // Inside is on the left, seen from the other side: on the right of the edge here.
        const Vec3d outwards = normalized(cross(to - from, other));
        piece = clipped(piece, outwards, dot(from, outwards));
    }
    return piece;
}

}  // namespace

double areaOf(const std::vector<FacePiece>& pieces) {
    double sum = 0;
    for (const FacePiece& piece : pieces) sum += length(areaVector(piece));
    return sum;
}

std::optional<Doorway> findDoorway(const volume::SemanticVolume& volume,
                                   const std::vector<std::uint32_t>& labelOfScalar, const CellShape& door,
                                   std::uint32_t label, const std::vector<const CellBody*>& rooms,
                                   const std::vector<Box3d>& roomBounds) {
    if (door.triangles.empty()) return std::nullopt;
    return DoorwayFinder(volume, labelOfScalar, door, label, rooms, roomBounds).run();
}

std::vector<std::vector<FacePiece>> commonFaces(const CellBody& a, const CellBody& b) {
    const auto boxesOf = [](const CellShape& shape) {
        std::vector<Box3d> boxes(shape.triangles.size());
        for (std::size_t t = 0; t < boxes.size(); ++t)
            for (int i = 0; i < 3; ++i)
                for (const double by : {-kOnFace, kOnFace}) boxes[t].add(shape.corner(t, i) + Vec3d{by, by, by});
        return boxes;
    };
    const std::vector<Box3d> boxesA = boxesOf(a.shell), boxesB = boxesOf(b.shell);
    const Box3d all = b.shell.bounds();
    std::vector<std::vector<FacePiece>> planes;
    for (std::size_t s = 0; s < boxesA.size(); ++s) {
        if (!boxesA[s].overlaps(all)) continue;
        for (std::size_t t = 0; t < boxesB.size(); ++t) {
            if (!boxesA[s].overlaps(boxesB[t])) continue;
            FacePiece piece = commonPart(a.shell, s, b.shell, t);
            const Vec3d area = areaVector(piece);
            if (piece.size() < 3 || length(area) < 1e-6) continue;
            const Vec3d unit = normalized(area);
            const auto plane = std::find_if(planes.begin(), planes.end(), [&](const std::vector<FacePiece>& others) {
                return dot(normalized(areaVector(others[0])), unit) > 0.999999 &&
                       std::abs(dot(others[0][0] - piece[0], unit)) <= kOnFace;
            });
            if (plane == planes.end())
                planes.push_back({std::move(piece)});
            else
                plane->push_back(std::move(piece));
        }
    }
    return planes;
}

}  // namespace svt::writers::indoor
