#include <svt/mesh/closing/orient_faces.hpp>

#include <svt/mesh/polygons/edge_uses.hpp>
#include <svt/mesh/polygons/face_tree.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <tuple>

namespace svt::mesh {
namespace {

constexpr int kPointsPerPatch = 8, kRayPairs = 16;
constexpr double kMeaningWeight = 0.5, kParityWeight = 0.25, kMajority = 0.02;
// Fraction of the area of the shell. A smaller patch is a sliver where faces overlap: it encloses no volume, and fits
// its neighbours as it is.
constexpr double kSmallestPatch = 0.001;

// Directions all around: points of the R3 sequence (Roberts 2018) within the unit ball, at most sums and products, so
// that they are the same on every machine.
std::array<Vec3d, kRayPairs> makeRayDirections() {
    std::array<Vec3d, kRayPairs> directions;
    const Vec3d step{0.8191725133961645, 0.6710436067037893, 0.5497004779019703};
    Vec3d at{0.5, 0.5, 0.5};
    for (std::size_t i = 0; i < directions.size();) {
        at = at + step;
        for (int axis = 0; axis < 3; ++axis) at[axis] -= std::floor(at[axis]);
        const Vec3d d = at * 2.0 - Vec3d{1, 1, 1};
        const double l = length(d);
        if (l > 0.2 && l < 1) directions[i++] = d / l;
    }
    return directions;
}

// The patch of each triangle, numbered by first triangle, and their count.
struct Patches {
    std::vector<std::uint32_t> of;
    std::uint32_t count = 0;
};

Patches findPatches(const std::vector<Triangle>& triangles) {
    std::vector<std::uint32_t> parent(triangles.size());
    std::iota(parent.begin(), parent.end(), 0u);
    const auto find = [&](std::uint32_t t) {
        while (parent[t] != t) t = parent[t] = parent[parent[t]];
        return t;
    };
    const std::vector<EdgeUse> uses = collectEdgeUses(triangles);
    forEachEdge(uses, [&](std::size_t begin, std::size_t end) {
        if (end - begin != 2 || uses[begin].isForward == uses[begin + 1].isForward) return;
        const std::uint32_t a = find(uses[begin].triangle), b = find(uses[begin + 1].triangle);
        parent[std::max(a, b)] = std::min(a, b);
    });
    Patches patches;
    patches.of.resize(triangles.size());
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
        const std::uint32_t root = find(t);
        patches.of[t] = root == t ? patches.count++ : patches.of[root];
    }
    return patches;
}

// Results of the rays of a patch: sums over pairs of rays, weighted by the cosine to the normal.
struct RayVotes {
    double weight = 0, escape = 0, parity = 0;
};

int countHits(FaceTree& tree, std::uint32_t self, Vec3d origin, Vec3d direction) {
    constexpr double kNearest = 1e-6;  // metres; a nearer hit counts as the same place
    int hits = 0;
    double nearest = kInfinity;
    tree.forEachNear(origin, direction, nearest, [&](const RayFace& face) {
        if (face.triangle == self) return;
        const double t = hitFace(face, origin, direction);
        hits += t > kNearest && t < kInfinity;
    });
    return hits;
}

void castRays(FaceTree& tree, const RayFace& face, Vec3d origin, RayVotes& votes) {
    static const std::array<Vec3d, kRayPairs> kDirections = makeRayDirections();
    for (const Vec3d& direction : kDirections) {
        const double cosine = dot(direction, face.unitNormal);
        const Vec3d forward = cosine < 0 ? -direction : direction;
        const double weight = std::abs(cosine);
        const int front = countHits(tree, face.triangle, origin, forward);
        const int back = countHits(tree, face.triangle, origin, -forward);
        votes.weight += weight;
        votes.escape += weight * (int(front == 0) - int(back == 0));
        votes.parity += weight * (int(front % 2 == 0) - int(back % 2 == 0));
    }
}

// Faces of one patch, ascending by triangle.
RayVotes votesOfPatch(FaceTree& tree, std::span<const RayFace* const> faces) {
    double area = 0;
    for (const RayFace* face : faces) area += length(cross(face->ab, face->ac));
    RayVotes votes;
    double passed = 0;
    std::size_t f = 0;
    for (int point = 0; point < kPointsPerPatch; ++point) {
        // Points spread by area; within a triangle by the R2 sequence.
        const double wanted = area * (point + 0.5) / kPointsPerPatch;
        while (f + 1 < faces.size() && passed + length(cross(faces[f]->ab, faces[f]->ac)) < wanted) {
            passed += length(cross(faces[f]->ab, faces[f]->ac));
            ++f;
        }
        double u = 0.5 + 0.7548776662466927 * (point + 1), v = 0.5 + 0.5698402909980532 * (point + 1);
        u -= std::floor(u);
        v -= std::floor(v);
        if (u + v > 1) {
            u = 1 - u;
            v = 1 - v;
        }
        castRays(tree, *faces[f], faces[f]->a + faces[f]->ab * u + faces[f]->ac * v, votes);
    }
    return votes;
}

// Between -1 (all of the patch should be turned) and 1, by the meaning of its faces; 0: nothing is known.
double meaningOfPatch(std::span<const RayFace* const> faces, std::span<const model::Orientation> orientations) {
    double sum = 0, total = 0;
    for (const RayFace* face : faces) {
        const model::Orientation orientation =
            orientations.empty() ? model::Orientation::Any : orientations[face->triangle];
        if (orientation == model::Orientation::Any) continue;
        const double up = face->unitNormal.z * length(cross(face->ab, face->ac));
        sum += orientation == model::Orientation::Up ? up : -up;
        total += std::abs(up);
    }
    return total > 0 ? sum / total : 0;
}

// Takes turns back where the patch agreed better with its neighbours before: less length of open edges.
void takeBackTurns(const ObjectMesh& mesh, const Patches& patches, std::vector<std::uint8_t>& isTurned) {
    struct Use {
        std::uint32_t low, high, patch;
        int direction;  // of the patch along the edge
    };
    std::vector<Use> uses;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
        for (std::size_t c = 0; c < 3; ++c) {
            const std::uint32_t a = mesh.triangles[t].corners[c], b = mesh.triangles[t].corners[(c + 1) % 3];
            const bool isForward = (a < b) != (isTurned[patches.of[t]] != 0);
            uses.push_back({std::min(a, b), std::max(a, b), patches.of[t], isForward ? 1 : -1});
        }
    std::sort(uses.begin(), uses.end(), [](const Use& p, const Use& q) {
        return std::tie(p.low, p.high, p.patch, p.direction) < std::tie(q.low, q.high, q.patch, q.direction);
    });
    std::vector<std::vector<std::size_t>> usesOf(patches.count);  // first uses of edges, per patch
    std::vector<std::size_t> firstUse(uses.size());
    std::vector<int> net(uses.size(), 0);  // at the first use of an edge: forward minus backward uses
    for (std::size_t u = 0; u < uses.size(); ++u) {
        const bool isSame = u > 0 && uses[u].low == uses[u - 1].low && uses[u].high == uses[u - 1].high;
        firstUse[u] = isSame ? firstUse[u - 1] : u;
        net[firstUse[u]] += uses[u].direction;
        if (isTurned[uses[u].patch] != 0) usesOf[uses[u].patch].push_back(u);
    }
    for (std::uint32_t patch = 0; patch < patches.count; ++patch) {
        double change = 0;
        const auto& own = usesOf[patch];
        const auto forEachOwnEdge = [&](const auto& body) {
            for (std::size_t i = 0, end = 0; i < own.size(); i = end) {
                int direction = 0;
                for (end = i; end < own.size() && firstUse[own[end]] == firstUse[own[i]]; ++end)
                    direction += uses[own[end]].direction;
                body(firstUse[own[i]], direction);
            }
        };
        forEachOwnEdge([&](std::size_t edge, int direction) {
            const double edgeLength = length(mesh.vertices[uses[edge].high] - mesh.vertices[uses[edge].low]);
            change += edgeLength * (std::abs(net[edge] - 2 * direction) - std::abs(net[edge]));
        });
        if (!(change < -1e-9)) continue;
        forEachOwnEdge([&](std::size_t edge, int direction) { net[edge] -= 2 * direction; });
        isTurned[patch] = 0;
    }
}

double windingAt(const ObjectMesh& mesh, Vec3d point) {
    double sum = 0;
    for (const Triangle& triangle : mesh.triangles) {
        const Vec3d a = normalized(mesh.vertices[triangle.corners[0]] - point),
                    b = normalized(mesh.vertices[triangle.corners[1]] - point),
                    c = normalized(mesh.vertices[triangle.corners[2]] - point);
        // Van Oosterom & Strackee 1983.
        sum += 2 * std::atan2(dot(a, cross(b, c)), 1 + dot(a, b) + dot(b, c) + dot(c, a));
    }
    return sum / (4 * std::numbers::pi);
}

}  // namespace

std::uint32_t orientFaces(ObjectMesh& mesh, std::span<const model::Orientation> orientations) {
    FaceTree tree(mesh.vertices, mesh.triangles);
    const Patches patches = findPatches(mesh.triangles);
    std::vector<const RayFace*> faces;
    for (const RayFace& face : tree.faces()) faces.push_back(&face);
    std::sort(faces.begin(), faces.end(), [&](const RayFace* p, const RayFace* q) {
        return std::tuple(patches.of[p->triangle], p->triangle) < std::tuple(patches.of[q->triangle], q->triangle);
    });
    const auto areaOf = [](double sum, const RayFace* face) { return sum + length(cross(face->ab, face->ac)); };
    const double area = std::accumulate(faces.begin(), faces.end(), 0.0, areaOf);
    std::vector<std::uint8_t> isTurned(patches.count, 0);
    for (std::size_t begin = 0, end = 0; begin < faces.size(); begin = end) {
        const std::uint32_t patch = patches.of[faces[begin]->triangle];
        for (end = begin; end < faces.size() && patches.of[faces[end]->triangle] == patch;) ++end;
        const auto members = std::span<const RayFace* const>(faces).subspan(begin, end - begin);
        if (std::accumulate(members.begin(), members.end(), 0.0, areaOf) < kSmallestPatch * area) continue;
        const RayVotes votes = votesOfPatch(tree, members);
        if (tree.isExhausted()) break;
        const double escape = votes.weight > 0 ? votes.escape / votes.weight : 0;
        double score = kMeaningWeight * meaningOfPatch(members, orientations) + escape;
        if (std::abs(escape) < kMajority && votes.weight > 0) score += kParityWeight * votes.parity / votes.weight;
        isTurned[patch] = score < -kMajority;
    }
    takeBackTurns(mesh, patches, isTurned);
    std::uint32_t turned = 0;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        if (isTurned[patches.of[t]] == 0) continue;
        std::swap(mesh.triangles[t].corners[1], mesh.triangles[t].corners[2]);
        ++turned;
    }
    return turned;
}

bool enclosesVolume(const ObjectMesh& mesh) {
    constexpr std::size_t kMaxTriedFaces = 64;
    FaceTree tree(mesh.vertices, mesh.triangles);
    std::vector<const RayFace*> faces;
    for (const RayFace& face : tree.faces()) faces.push_back(&face);
    const auto areaOf = [](const RayFace* face) { return length(cross(face->ab, face->ac)); };
    std::sort(faces.begin(), faces.end(), [&](const RayFace* p, const RayFace* q) {
        return std::tuple(-areaOf(p), p->triangle) < std::tuple(-areaOf(q), q->triangle);
    });
    if (faces.size() > kMaxTriedFaces) faces.resize(kMaxTriedFaces);  // the largest
    double enclosing = 0, total = 0;
    for (const RayFace* face : faces) {
        const Vec3d inwards = -face->unitNormal;
        double nearest = kInfinity;
        tree.forEachNear(face->center, inwards, nearest, [&](const RayFace& other) {
            if (other.triangle == face->triangle || dot(other.unitNormal, inwards) <= 0) return;
            const double t = hitFace(other, face->center, inwards);
            if (t > 1e-6 && t < nearest) nearest = t;
        });
        total += areaOf(face);
        if (nearest < kInfinity && windingAt(mesh, face->center + inwards * (nearest / 2)) >= 0.5)
            enclosing += areaOf(face);
    }
    return enclosing * 2 >= total && total > 0;
}

}  // namespace svt::mesh
