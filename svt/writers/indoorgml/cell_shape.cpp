#include <svt/writers/indoorgml/cell_shape.hpp>

#include <svt/core/triangle_distance.hpp>
#include <svt/writers/gltf/label_surface.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <unordered_map>

namespace svt::writers::indoor {
namespace {

constexpr double kSamePlane = 2e-5;  // metres; points are rounded to micrometres

using Edge = std::uint64_t;  // from, to
Edge edgeOf(std::uint32_t from, std::uint32_t to) { return (Edge{from} << 32) | to; }

Vec3d normalOf(const CellShape& shape, std::size_t t) {
    return cross(shape.corner(t, 1) - shape.corner(t, 0), shape.corner(t, 2) - shape.corner(t, 0));
}

// Counts of edges in their direction.
std::unordered_map<Edge, std::uint32_t> countEdges(const CellShape& shape) {
    std::unordered_map<Edge, std::uint32_t> counts;
    counts.reserve(shape.triangles.size() * 3);
    for (const auto& t : shape.triangles)
        for (int i = 0; i < 3; ++i) ++counts[edgeOf(t[std::size_t(i)], t[std::size_t(i + 1) % 3])];
    return counts;
}

// A part of a shape, with the points that it uses.
CellShape partOf(const CellShape& shape, const std::vector<std::uint32_t>& triangles) {
    CellShape part;
    std::unordered_map<std::uint32_t, std::uint32_t> numbers;
    for (const std::uint32_t t : triangles) {
        auto& triangle = part.triangles.emplace_back();
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t point = shape.triangles[t][i];
            const auto [at, isNew] = numbers.try_emplace(point, static_cast<std::uint32_t>(part.points.size()));
            if (isNew) part.points.push_back(shape.points[point]);
            triangle[i] = at->second;
        }
    }
    return part;
}

// Triangles that hang together by points, in the order of their first ones.
std::vector<std::vector<std::uint32_t>> components(const CellShape& shape) {
    std::vector<std::uint32_t> leader(shape.points.size());
    std::iota(leader.begin(), leader.end(), 0u);
    const auto leaderOf = [&](std::uint32_t p) {
        while (leader[p] != p) p = leader[p] = leader[leader[p]];
        return p;
    };
    for (const auto& t : shape.triangles)
        for (std::size_t i = 1; i < 3; ++i) {
            const std::uint32_t a = leaderOf(t[0]), b = leaderOf(t[i]);
            leader[std::max(a, b)] = std::min(a, b);
        }
    std::map<std::uint32_t, std::size_t> numbers;
    std::vector<std::vector<std::uint32_t>> parts;
    for (std::uint32_t t = 0; t < shape.triangles.size(); ++t) {
        const auto [at, isNew] = numbers.try_emplace(leaderOf(shape.triangles[t][0]), parts.size());
        if (isNew) parts.emplace_back();
        parts[at->second].push_back(t);
    }
    return parts;
}

// Grows faces over the triangles of a shape.
class FaceGrower {
public:
    explicit FaceGrower(const CellShape& shape) : shape_(shape), faceOf_(shape.triangles.size(), kNone) {
        for (std::uint32_t t = 0; t < shape.triangles.size(); ++t)
            for (int i = 0; i < 3; ++i) {
                const auto& corners = shape.triangles[t];
                const auto [at, isNew] =
                    triangleOf_.try_emplace(edgeOf(corners[std::size_t(i)], corners[std::size_t(i + 1) % 3]), t);
                if (!isNew) at->second = kNone;  // used twice: a border of faces in any case
            }
    }

    std::vector<FaceRings> run() {
        std::vector<std::uint32_t> order(shape_.triangles.size());
        std::iota(order.begin(), order.end(), 0u);
        std::vector<double> areas;
        for (const std::uint32_t t : order) areas.push_back(length(normalOf(shape_, t)));
        std::stable_sort(order.begin(), order.end(),
                         [&](std::uint32_t a, std::uint32_t b) { return areas[a] > areas[b]; });
        std::vector<std::uint32_t> seeds;
        for (const std::uint32_t seed : order)
            if (faceOf_[seed] == kNone && !isSliver(seed)) {
                grow(seed);
                seeds.push_back(seed);
            }
        placeSlivers(order, seeds);
        std::map<std::uint32_t, std::vector<std::uint32_t>> regions;
        for (std::uint32_t t = 0; t < faceOf_.size(); ++t) regions[faceOf_[t]].push_back(t);
        std::vector<FaceRings> faces;
        for (const std::uint32_t seed : seeds) {
            const std::vector<std::uint32_t>& region = regions[seed];
            if (FaceRings rings = ringsOf(region, seed); !rings.empty())
                faces.push_back(std::move(rings));
            else
                for (const std::uint32_t t : region)
                    faces.push_back({{shape_.triangles[t].begin(), shape_.triangles[t].end()}});
        }
        return faces;
    }

private:
    static constexpr std::uint32_t kNone = 0xFFFFFFFFu;

    void grow(std::uint32_t seed) {
        const Vec3d normal = normalized(normalOf(shape_, seed)), at = shape_.corner(seed, 0);
        std::vector<std::uint32_t> region{seed};
        faceOf_[seed] = seed;
        for (std::size_t next = 0; next < region.size(); ++next)
            for (std::size_t i = 0; i < 3; ++i) {
                const std::uint32_t t = beside(region[next], i);
                if (t == kNone || faceOf_[t] != kNone || isSliver(t)) continue;
                bool isFlat = dot(normalOf(shape_, t), normal) > 0;
                for (int c = 0; c < 3; ++c)
                    isFlat = isFlat && std::abs(dot(shape_.corner(t, c) - at, normal)) <= kSamePlane;
                if (!isFlat) continue;
                faceOf_[t] = seed;
                region.push_back(t);
            }
    }

    // The triangle across the edge from corner i; kNone: none, or several.
    [[nodiscard]] std::uint32_t beside(std::uint32_t triangle, std::size_t i) const {
        const auto& corners = shape_.triangles[triangle];
        const auto found = triangleOf_.find(edgeOf(corners[(i + 1) % 3], corners[i]));
        return found == triangleOf_.end() ? kNone : found->second;
    }

    // A sliver closes the gap between a long edge and points on it: it belongs to the face that has the long edge,
    // which so gets these points.
    void placeSlivers(const std::vector<std::uint32_t>& order, std::vector<std::uint32_t>& seeds) {
        for (bool isChanged = true; isChanged;) {
            isChanged = false;
            for (const std::uint32_t t : order) {
                if (faceOf_[t] != kNone) continue;
                const std::uint32_t other = beside(t, longestSide(t));
                if (other == kNone || faceOf_[other] == kNone) continue;
                faceOf_[t] = faceOf_[other];
                isChanged = true;
            }
        }
        for (const std::uint32_t t : order)
            if (faceOf_[t] == kNone) {
                faceOf_[t] = t;
                seeds.push_back(t);
            }
    }

    [[nodiscard]] double side(std::uint32_t t, std::size_t i) const {
        return length(shape_.corner(t, int((i + 1) % 3)) - shape_.corner(t, int(i)));
    }
    [[nodiscard]] std::size_t longestSide(std::uint32_t t) const {
        std::size_t longest = 0;
        for (std::size_t i = 1; i < 3; ++i)
            if (side(t, i) > side(t, longest)) longest = i;
        return longest;
    }

    // So thin that its direction says nothing.
    [[nodiscard]] bool isSliver(std::uint32_t t) const {
        return length(normalOf(shape_, t)) <= kSamePlane * side(t, longestSide(t));
    }

    // The rings around a region; empty where one of them touches itself or another.
    [[nodiscard]] FaceRings ringsOf(const std::vector<std::uint32_t>& region, std::uint32_t seed) const {
        std::map<std::uint32_t, std::uint32_t> next;
        for (const std::uint32_t t : region)
            for (std::size_t i = 0; i < 3; ++i) {
                const std::uint32_t from = shape_.triangles[t][i], to = shape_.triangles[t][(i + 1) % 3];
                const auto beside = triangleOf_.find(edgeOf(to, from));
                const bool isInner =
                    beside != triangleOf_.end() && beside->second != kNone && faceOf_[beside->second] == seed;
                if (!isInner && !next.emplace(from, to).second) return {};
            }
        const Vec3d normal = normalOf(shape_, seed);
        FaceRings rings;
        std::size_t exteriors = 0;
        while (!next.empty()) {
            std::vector<std::uint32_t> ring;
            for (auto at = next.begin(); at != next.end(); at = next.find(ring.back())) {
                if (ring.empty()) ring.push_back(at->first);
                ring.push_back(at->second);
                next.erase(at);
                if (ring.back() == ring.front()) break;
            }
            if (ring.size() < 4 || ring.back() != ring.front()) return {};
            ring.pop_back();
            Vec3d area{};
            const Vec3d origin = shape_.points[ring.front()];
            for (std::size_t i = 1; i + 1 < ring.size(); ++i)
                area = area + cross(shape_.points[ring[i]] - origin, shape_.points[ring[i + 1]] - origin);
            const bool isExterior = dot(area, normal) > 0;
            exteriors += isExterior;
            rings.insert(isExterior ? rings.begin() : rings.end(), std::move(ring));
        }
        return exteriors == 1 ? rings : FaceRings();
    }

    const CellShape& shape_;
    std::unordered_map<Edge, std::uint32_t> triangleOf_;
    std::vector<std::uint32_t> faceOf_;
};

double distanceTo(const CellShape& shape, Vec3d p) {
    double nearest = kInfinity;
    for (std::size_t t = 0; t < shape.triangles.size(); ++t)
        nearest = std::min(nearest, distanceToTriangle(p, shape.corner(t, 0), shape.corner(t, 1), shape.corner(t, 2)));
    return nearest;
}

bool isInside(const CellBody& body, Vec3d p) {
    return encloses(body.shell, p) && std::none_of(body.cavities.begin(), body.cavities.end(),
                                                   [&](const CellShape& cavity) { return encloses(cavity, p); });
}

}  // namespace

Box3d CellShape::bounds() const {
    Box3d box;
    for (const Vec3d& p : points) box.add(p);
    return box;
}

bool isClosed(const CellShape& shape) {
    const auto counts = countEdges(shape);
    return !shape.triangles.empty() && std::all_of(counts.begin(), counts.end(), [&](const auto& entry) {
        const auto other = counts.find(edgeOf(std::uint32_t(entry.first), std::uint32_t(entry.first >> 32)));
        return other != counts.end() && other->second == entry.second;
    });
}

double volumeOf(const CellShape& shape) {
    double volume = 0;
    const Vec3d origin = shape.points.empty() ? Vec3d{} : shape.points.front();
    for (std::size_t t = 0; t < shape.triangles.size(); ++t)
        volume += dot(shape.corner(t, 0) - origin, cross(shape.corner(t, 1) - origin, shape.corner(t, 2) - origin));
    return volume / 6;
}

bool encloses(const CellShape& shape, Vec3d p) {
    // Slightly oblique, so that it meets no edge of vertical parts.
    const Vec3d along{0.0123571, 0.0456127, 1};
    bool isInside = false;
    for (std::size_t t = 0; t < shape.triangles.size(); ++t) {
        const Vec3d a = shape.corner(t, 0) - p, b = shape.corner(t, 1) - p, c = shape.corner(t, 2) - p;
        const double u = dot(along, cross(b, c)), v = dot(along, cross(c, a)), w = dot(along, cross(a, b));
        if ((u < 0 || v < 0 || w < 0) && (u > 0 || v > 0 || w > 0)) continue;
        const double sum = u + v + w;
        if (sum != 0 && dot(a, cross(b, c)) / sum > 0) isInside = !isInside;
    }
    return isInside;
}

CellShape keptMesh(const volume::SemanticVolume& volume, std::uint32_t label) {
    CellShape shape;
    const auto& triangles = volume.vectors.triangles;
    std::map<Vec3i, std::uint32_t> numbers;
    auto at = std::lower_bound(triangles.begin(), triangles.end(), label,
                               [](const auto& triangle, std::uint32_t l) { return triangle.label < l; });
    for (; at != triangles.end() && at->label == label; ++at) {
        std::array<std::uint32_t, 3> corners{};
        for (std::size_t i = 0; i < 3; ++i) {
            const Vec3i place = volume.vectors.points[at->corners[i]];
            const auto [known, isNew] = numbers.try_emplace(place, static_cast<std::uint32_t>(shape.points.size()));
            if (isNew) shape.points.push_back(toDouble(place) * volume.vectors.unit);
            corners[i] = known->second;
        }
        if (corners[0] != corners[1] && corners[1] != corners[2] && corners[2] != corners[0])
            shape.triangles.push_back(corners);
    }
    return shape;
}

Result<std::vector<CellShape>> voxelShapes(const volume::SemanticVolume& volume,
                                           const std::vector<std::uint32_t>& ownerOf, int threads,
                                           const Progress* progress) {
    std::vector<CellShape> shapes(ownerOf.size());
    std::vector<std::uint32_t> ownerOfScalar = volume.labels.labelOfScalar();
    for (std::uint32_t& label : ownerOfScalar)
        if (label != volume::kNoLabel) label = ownerOf[label];
    SVT_TRY(surfaces, labelSurfaces(volume.columns, ownerOfScalar, {std::uint64_t{1} << 27, threads, progress}));
    for (const LabelSurface& surface : *surfaces) {
        CellShape& shape = shapes[surface.label];
        for (const Vec3i& vertex : surface.vertices)
            shape.points.push_back(volume.grid.worldFromIndexDirection(toDouble(vertex) * 0.5 - Vec3d{0.5, 0.5, 0.5}));
        shape.triangles = surface.triangles;
    }
    return shapes;
}

std::vector<CellBody> piecesOf(const CellShape& shape) {
    std::vector<CellBody> bodies;
    std::vector<CellShape> cavities;
    for (const auto& triangles : components(shape)) {
        CellShape part = partOf(shape, triangles);
        if (volumeOf(part) > 0)
            bodies.push_back({std::move(part), {}});
        else
            cavities.push_back(std::move(part));
    }
    std::stable_sort(bodies.begin(), bodies.end(),
                     [](const CellBody& a, const CellBody& b) { return volumeOf(a.shell) > volumeOf(b.shell); });
    for (CellShape& cavity : cavities) {
        CellBody* around = nullptr;
        double least = kInfinity;
        for (CellBody& body : bodies)
            if (const double volume = volumeOf(body.shell); volume < least && encloses(body.shell, cavity.points[0])) {
                least = volume;
                around = &body;
            }
        if (around != nullptr) around->cavities.push_back(std::move(cavity));
    }
    return bodies;
}

std::vector<FaceRings> facesOf(const CellShape& shape) { return FaceGrower(shape).run(); }

Vec3d innerPoint(const CellBody& body) {
    constexpr int kAcross = 12;
    const Box3d box = body.shell.bounds();
    Vec3d best = box.center();
    double farthest = -1;
    const auto tryPoint = [&](Vec3d p) {
        if (!isInside(body, p)) return;
        double distance = distanceTo(body.shell, p);
        for (const CellShape& cavity : body.cavities) distance = std::min(distance, distanceTo(cavity, p));
        // The first of equally good points wins.
        if (distance <= farthest + 1e-9) return;
        farthest = distance;
        best = p;
    };
    for (const double height : {0.5, 0.25, 0.75, 0.1, 0.9}) {
        const Vec3d size = box.size();
        tryPoint({box.center().x, box.center().y, box.min.z + size.z * height});
        for (int j = 0; j < kAcross; ++j)
            for (int i = 0; i < kAcross; ++i)
                tryPoint({box.min.x + size.x * (i + 0.5) / kAcross, box.min.y + size.y * (j + 0.5) / kAcross,
                          box.min.z + size.z * height});
        if (farthest > 0) return best;
    }
    // Thin and bent bodies: points behind the centre of a triangle, at decreasing depths.
    for (std::size_t t = 0; t < body.shell.triangles.size(); ++t) {
        const Vec3d normal = normalized(normalOf(body.shell, t));
        const Vec3d middle = (body.shell.corner(t, 0) + body.shell.corner(t, 1) + body.shell.corner(t, 2)) / 3;
        for (const double depth : {0.1, 0.01, 0.001}) tryPoint(middle - normal * depth);
    }
    return best;
}

}  // namespace svt::writers::indoor
