#include <svt/writers/gltf/model_faces.hpp>

#include <svt/model/classes.hpp>
#include <svt/writers/labels/label_looks.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <tuple>
#include <utility>

namespace svt::writers {
namespace {

using volume::Filling;

bool isBuildingClass(const volume::Label& label) {
    return model::classRank(label.className) == model::ClassRank::Building;
}

bool isChosenFilling(Filling filling, MeshChoice choice) noexcept {
    if (filling == Filling::Surface) return choice >= MeshChoice::Sheets;
    if (volume::hasClosedMesh(filling)) return choice >= MeshChoice::Closed;
    return filling == Filling::Winding ? choice >= MeshChoice::Open : choice == MeshChoice::All;
}

// Labels around rooms or bodies: their mesh is only the outside of their surface.
std::vector<char> labelsWithInside(const std::vector<volume::Label>& labels) {
    std::vector<char> hasInside(labels.size(), 0);
    for (std::size_t l = labels.size(); l-- > 0;) {
        const volume::Label& label = labels[l];
        const bool isInside = label.voxels > 0 && (label.filling == Filling::Body || model::isSpace(label.className));
        if ((isInside || hasInside[l] != 0) && label.parent < l) hasInside[label.parent] = 1;
    }
    return hasInside;
}

using Corners = std::array<std::uint32_t, 3>;

bool isBefore(Vec3i a, Vec3i b) noexcept { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); }

/// A triangle with its points in ascending order.
struct Face {
    std::uint64_t hash = 0;
    std::uint32_t triangle = 0;
    bool isReversed = false;
};

std::array<Vec3i, 3> sortedPoints(const volume::VectorParts& vectors, const Corners& corners, bool& isReversed) {
    std::array<Vec3i, 3> p{vectors.points[corners[0]], vectors.points[corners[1]], vectors.points[corners[2]]};
    isReversed = false;
    for (const auto& [a, b] : {std::pair<std::size_t, std::size_t>{0, 1}, {1, 2}, {0, 1}})
        if (isBefore(p[b], p[a])) {
            std::swap(p[a], p[b]);
            isReversed = !isReversed;
        }
    return p;
}

std::uint64_t hashOf(const std::array<Vec3i, 3>& points) noexcept {
    std::uint64_t hash = 0;
    for (const Vec3i& p : points)
        for (int axis = 0; axis < 3; ++axis) {
            hash = (hash ^ static_cast<std::uint32_t>(p[axis])) * 0x9E3779B97F4A7C15u;
            hash ^= hash >> 29;
        }
    return hash;
}

/// Finds covered triangles among those that are drawn.
class CoveredFaces {
public:
    CoveredFaces(const volume::SemanticVolume& volume, std::vector<TriangleUse>& uses)
        : vectors_(volume.vectors), labels_(volume.labels.labels), uses_(uses) {}

    void mark() {
        const std::vector<std::uint32_t> roots = rootsOf(labels_);
        std::vector<Face> faces;
        for (std::uint32_t t = 0; t < uses_.size(); ++t) {
            if (uses_[t] != TriangleUse::Drawn) continue;
            Face face;
            face.hash = hashOf(sortedPoints(vectors_, vectors_.triangles[t].corners, face.isReversed));
            face.triangle = t;
            faces.push_back(face);
        }
        // Labels ascend with triangles.
        std::sort(faces.begin(), faces.end(), [](const Face& a, const Face& b) {
            return std::tie(a.hash, a.triangle) < std::tie(b.hash, b.triangle);
        });
        for (std::size_t begin = 0, end = 0; begin < faces.size(); begin = end) {
            while (end < faces.size() && faces[end].hash == faces[begin].hash) ++end;
            if (end - begin == 1) continue;
            const std::span<const Face> group(faces.data() + begin, end - begin);
            markBelow(group);
            if (group.size() == 2) markBetween(group[0], group[1], roots);
        }
    }

private:
    static std::vector<std::uint32_t> rootsOf(const std::vector<volume::Label>& labels) {
        std::vector<std::uint32_t> roots(labels.size());
        for (std::uint32_t l = 0; l < roots.size(); ++l) roots[l] = labels[l].parent < l ? roots[labels[l].parent] : l;
        return roots;
    }

    [[nodiscard]] std::uint32_t labelOf(const Face& face) const { return vectors_.triangles[face.triangle].label; }
    [[nodiscard]] bool isSame(const Face& a, const Face& b) const {
        bool isReversed = false;
        return sortedPoints(vectors_, vectors_.triangles[a.triangle].corners, isReversed) ==
               sortedPoints(vectors_, vectors_.triangles[b.triangle].corners, isReversed);
    }

    // The next label of the group is the nearest one that may be below.
    void markBelow(std::span<const Face> group) {
        for (std::size_t n = 0; n + 1 < group.size(); ++n) {
            const std::uint32_t own = labelOf(group[n]);
            if (model::isSpace(labels_[own].className)) continue;
            std::size_t next = n + 1;
            while (next < group.size() && labelOf(group[next]) == own && next < n + kMostRepeats) ++next;
            if (next == group.size()) continue;
            const std::uint32_t other = labelOf(group[next]);
            if (other > own && other < labels_[own].subtreeEnd && isSame(group[n], group[next]))
                uses_[group[n].triangle] = TriangleUse::Covered;
        }
    }

    // A wall between two closed parts of a building.
    void markBetween(const Face& a, const Face& b, const std::vector<std::uint32_t>& roots) {
        const std::uint32_t first = labelOf(a), second = labelOf(b);
        const auto isPart = [&](const volume::Label& label) {
            return volume::hasClosedMesh(label.filling) && isBuildingClass(label) && surfaceOpacity(label) >= 1;
        };
        if (first == second || second < labels_[first].subtreeEnd || roots[first] != roots[second] ||
            a.isReversed == b.isReversed || !isPart(labels_[first]) || !isPart(labels_[second]) || !isSame(a, b))
            return;
        uses_[a.triangle] = uses_[b.triangle] = TriangleUse::Covered;
    }

    static constexpr std::size_t kMostRepeats = 16;  // of a triangle in a label, so that the cost is bounded

    const volume::VectorParts& vectors_;
    const std::vector<volume::Label>& labels_;
    std::vector<TriangleUse>& uses_;
};

}  // namespace

std::vector<char> chosenLabels(const volume::LabelTable& table, MeshChoice choice) {
    const std::vector<volume::Label>& labels = table.labels;
    std::vector<char> isChosen(labels.size(), 0);
    for (std::size_t l = 0; l < labels.size(); ++l)
        isChosen[l] = labels[l].voxels > 0 && isChosenFilling(labels[l].filling, choice) ? 1 : 0;
    if (choice != MeshChoice::Closed && choice != MeshChoice::Open) return isChosen;
    const std::vector<char> hasInside = labelsWithInside(labels);
    std::vector<std::uint64_t> lost(labels.size(), 0);
    for (const volume::Overlap& overlap : table.overlaps)
        if (!isBuildingClass(labels[overlap.a]) && labels[overlap.a].filling != Filling::Surface)
            lost[overlap.b] += overlap.voxels;
    for (std::size_t l = 0; l < labels.size(); ++l)
        if (labels[l].filling != Filling::Surface && (hasInside[l] != 0 || lost[l] > (labels[l].voxels + lost[l]) / 64))
            isChosen[l] = 0;
    return isChosen;
}

std::vector<TriangleUse> drawnTriangles(const volume::SemanticVolume& volume, MeshChoice choice) {
    std::vector<TriangleUse> uses(volume.vectors.triangles.size(), TriangleUse::None);
    if (uses.empty() || choice == MeshChoice::None) return uses;
    const std::vector<char> isChosen = chosenLabels(volume.labels, choice);
    for (std::size_t t = 0; t < uses.size(); ++t)
        if (isChosen[volume.vectors.triangles[t].label] != 0) uses[t] = TriangleUse::Drawn;
    if (choice == MeshChoice::Closed || choice == MeshChoice::Open) CoveredFaces(volume, uses).mark();
    return uses;
}

SurfaceCounts countSurfaces(const volume::SemanticVolume& volume, MeshChoice choice) {
    const std::vector<char> isMesh = chosenLabels(volume.labels, choice);
    std::vector<char> hasTriangles(isMesh.size(), 0);
    for (const auto& triangle : volume.vectors.triangles) hasTriangles[triangle.label] = 1;
    SurfaceCounts counts;
    for (std::size_t l = 0; l < isMesh.size(); ++l)
        if (volume.labels.labels[l].voxels > 0)
            ++(isMesh[l] != 0 && hasTriangles[l] != 0 ? counts.meshes : counts.voxels);
    return counts;
}

}  // namespace svt::writers
