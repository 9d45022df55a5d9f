#include <svt/validate/solids/interior.hpp>

#include <svt/validate/polygons/groups.hpp>

#include <algorithm>
#include <cmath>

namespace svt::validate {
namespace {

struct SurfacePiece {
    Piece piece;
    Vec3d inwards{};  // into the material, unit length
    std::size_t shell = 0;
    std::uint32_t triangle = 0;
};

// A part of an edge that two segments on one line have in common; empty if it is shorter than `least`.
std::optional<Segment> commonPart(const Segment& a, const Segment& b, double noise, double least) {
    const Vec3d along = normalized(a[1] - a[0]);
    const double size = length(a[1] - a[0]);
    double at[2];
    for (std::size_t i = 0; i < 2; ++i) {
        const Vec3d d = b[i] - a[0];
        at[i] = dot(d, along);
        if (length(d - along * at[i]) > noise) return std::nullopt;
    }
    const double from = std::max(0.0, std::min(at[0], at[1])), to = std::min(size, std::max(at[0], at[1]));
    if (to - from <= least) return std::nullopt;
    return Segment{a[0] + along * from, a[0] + along * to};
}

std::vector<Box3d> boundsOf(const std::vector<const Body*>& shells) {
    std::vector<Box3d> bounds;
    for (const Body* shell : shells) bounds.push_back(shell->tree().bounds());
    return bounds;
}

class InteriorParts {
public:
    InteriorParts(const std::vector<const Body*>& shells, double noise) : shells_(shells), noise_(noise) {}

    std::optional<Vec3d> run() {
        if (!cut()) return std::nullopt;
        groups_ = Groups(pieces_.size());
        joinAlongSurfaces();
        if (groupCount() <= shells_.size()) return std::nullopt;  // no shell is cut in two
        joinBySight();
        if (groupCount() < 2) return std::nullopt;
        return smallestPart();
    }

private:
    // Pieces of all shells; false if nothing touches along a line.
    bool cut() {
        bool haveContact = false;
        const plane::BoxTree bounds = treeOf(boundsOf(shells_));
        for (std::size_t s = 0; s < shells_.size(); ++s)
            for (std::uint32_t t = 0; t < shells_[s]->triangles().size(); ++t) {
                const Triangle triangle = shells_[s]->triangle(t);
                std::vector<Segment> lines;
                for (const std::uint32_t other :
                     bounds.findAll(plane::grown(shells_[s]->tree().boxes()[t], std::ceil(noise_) + 1))) {
                    if (other == s) continue;
                    for (const Segment& line : linesOn(triangle, *shells_[other], noise_))
                        if (length(line[1] - line[0]) > 4 * noise_) lines.push_back(line);
                }
                haveContact = haveContact || !lines.empty();
                const Vec3d a = Lattice::local(triangle[0]);
                const Vec3d normal =
                    normalized(cross(Lattice::local(triangle[1]) - a, Lattice::local(triangle[2]) - a));
                for (Piece& piece : cutTriangle(triangle, lines, 4 * noise_))
                    pieces_.push_back({std::move(piece), normal * -1.0, s, t});
                contacts_.insert(contacts_.end(), lines.begin(), lines.end());
            }
        return haveContact;
    }

    std::size_t groupCount() {
        std::size_t count = 0;
        for (std::size_t i = 0; i < pieces_.size(); ++i) count += groups_.leaderOf(i) == i;
        return count;
    }

    [[nodiscard]] bool isContact(Vec3d p) const {
        return std::any_of(contacts_.begin(), contacts_.end(), [&](const Segment& line) {
            const Vec3d along = line[1] - line[0];
            const double at = std::clamp(dot(p - line[0], along) / dot(along, along), 0.0, 1.0);
            return length(p - (line[0] + along * at)) <= 2 * noise_;
        });
    }

    void joinAlongSurfaces() {
        for (std::size_t i = 0; i < pieces_.size(); ++i)
            for (std::size_t j = i + 1; j < pieces_.size(); ++j)
                if (pieces_[i].shell == pieces_[j].shell && groups_.leaderOf(i) != groups_.leaderOf(j) &&
                    areNeighbours(i, j))
                    groups_.join(i, j);
    }

    [[nodiscard]] bool areNeighbours(std::size_t i, std::size_t j) const {
        const auto &one = pieces_[i].piece.corners, &other = pieces_[j].piece.corners;
        for (std::size_t a = 0; a < one.size(); ++a)
            for (std::size_t b = 0; b < other.size(); ++b) {
                const auto part = commonPart({one[a], one[(a + 1) % one.size()]},
                                             {other[b], other[(b + 1) % other.size()]}, 2 * noise_, 4 * noise_);
                if (part && !isContact(((*part)[0] + (*part)[1]) * 0.5)) return true;
            }
        return false;
    }

    void joinBySight() {
        for (std::size_t i = 0; i < pieces_.size(); ++i)
            for (int x = -1; x <= 1; ++x)
                for (int y = -1; y <= 1; ++y)
                    for (int z = -1; z <= 1; ++z) {
                        // Slightly askew, so that rays meet no edges of models with right angles.
                        const Vec3d direction = normalized(Vec3d{x + 0.0137, y + 0.0071, z - 0.0093});
                        if (dot(direction, pieces_[i].inwards) > 0.05) look(i, direction);
                    }
    }

    // Joins piece i with the piece that is visible from it.
    void look(std::size_t i, Vec3d direction) {
        const Vec3d from = pieces_[i].piece.center;
        double nearest = kInfinity;
        std::size_t seen = i;
        for (std::size_t j = 0; j < pieces_.size(); ++j) {
            if (j == i) continue;
            const double facing = dot(direction, pieces_[j].inwards);
            if (facing == 0) continue;
            const double at = dot(pieces_[j].piece.center - from, pieces_[j].inwards) / facing;
            if (at <= 2 * noise_ || at >= nearest || !holdsPoint(pieces_[j], from + direction * at)) continue;
            nearest = at;
            seen = j;
        }
        // Seen from behind: the ray left the material elsewhere, between pieces.
        if (seen != i && dot(direction, pieces_[seen].inwards) < 0) groups_.join(i, seen);
    }

    [[nodiscard]] bool holdsPoint(const SurfacePiece& piece, Vec3d p) const {
        const auto& corners = piece.piece.corners;
        for (std::size_t a = 0; a < corners.size(); ++a) {
            const Vec3d edge = corners[(a + 1) % corners.size()] - corners[a];
            if (dot(cross(edge, p - corners[a]), piece.inwards * -1.0) < -noise_ * length(edge)) return false;
        }
        return true;
    }

    std::optional<Vec3d> smallestPart() {
        std::vector<double> area(pieces_.size());
        for (std::size_t i = 0; i < pieces_.size(); ++i) area[groups_.leaderOf(i)] += pieces_[i].piece.area;
        std::size_t best = pieces_.size();
        for (std::size_t i = 0; i < pieces_.size(); ++i)
            if (groups_.leaderOf(i) == i && (best == pieces_.size() || area[i] < area[best])) best = i;
        return pieces_[best].piece.center;
    }

    const std::vector<const Body*>& shells_;
    double noise_;
    std::vector<SurfacePiece> pieces_;
    std::vector<Segment> contacts_;
    Groups groups_;  // of pieces_
};

}  // namespace

std::optional<Vec3d> findCutOffPart(const std::vector<const Body*>& shells, double noise) {
    return InteriorParts(shells, noise).run();
}

}  // namespace svt::validate
