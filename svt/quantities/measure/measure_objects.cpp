#include <svt/quantities/quantities.hpp>

#include <svt/analyze/extents.hpp>
#include <svt/analyze/label_measures.hpp>
#include <svt/core/parallel.hpp>
#include <svt/model/building_model.hpp>
#include <svt/model/classes.hpp>
#include <svt/quantities/measure/plate.hpp>
#include <svt/quantities/measure/ring.hpp>
#include <svt/quantities/measure/silhouette.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace svt::quantities {
namespace {

using volume::Filling, volume::Label;

// The sums of one pass over the triangles.
struct FaceSums {
    double volume = 0, top = 0, bottom = 0, side = 0;
    double lowest = 1e300, highest = -1e300;
    [[nodiscard]] double all() const noexcept { return top + bottom + side; }
};

FaceSums sumsOf(std::span<const Corners> triangles) {
    FaceSums sums;
    for (const Corners& t : triangles) {
        const Vec3d normal = cross(t[1] - t[0], t[2] - t[0]);
        const double area = 0.5 * length(normal);
        sums.volume += dot(t[0], cross(t[1], t[2])) / 6;
        (normal.z > 2 * area * kLeastRise    ? sums.top
         : normal.z < -2 * area * kLeastRise ? sums.bottom
                                             : sums.side) += area;
        for (const Vec3d& p : t) {
            sums.lowest = std::min(sums.lowest, p.z);
            sums.highest = std::max(sums.highest, p.z);
        }
    }
    return sums;
}

Trust trustOf(Filling filling) noexcept {
    switch (filling) {
        case Filling::Solid: return Trust::Exact;
        case Filling::TJunctions:
        case Filling::Complemented: return Trust::Tight;
        case Filling::Capped: return Trust::Caps;
        case Filling::Winding: return Trust::Voxels;
        case Filling::Body: return Trust::Assumed;
        case Filling::None:
        case Filling::Surface: break;
    }
    return Trust::Unknown;
}

// Openings are those of walls, slabs, roofs, beams and columns; not those of a railing or a shelf.
bool mayHaveOpenings(const Label& label) { return model::classRank(label.className) == model::ClassRank::Element; }

class Measurer {
public:
    explicit Measurer(const volume::SemanticVolume& volume)
        : volume_(volume), labels_(volume.labels.labels), lost_(labels_.size(), 0) {
        for (const volume::Overlap& overlap : volume.labels.overlaps) lost_[overlap.b] += overlap.voxels;
        const Vec3d s = volume.grid.spacing();
        halfVoxel_ = std::max({s.x, s.y, s.z}) / 2;
    }

    [[nodiscard]] ObjectQuantities measure(std::uint32_t label) const {
        ObjectQuantities result;
        result.label = label;
        result.parts = {label};
        for (std::uint32_t child = label + 1; child < labels_[label].subtreeEnd && child < labels_.size(); ++child)
            if (labels_[child].parent == label && model::isPhase(labels_[child].className))
                result.parts.push_back(child);
        // Whatever its shape lacks, no figure is known.
        if (model::isReadInPart(labels_[label].attributes)) return result;
        std::vector<Corners> all;
        const std::uint32_t* solid = nullptr;
        std::size_t withFaces = 0;
        for (const std::uint32_t& part : result.parts) {
            const std::vector<Corners> own = trianglesOf(part);
            addVolume(part, own, result);
            if (own.empty()) continue;
            ++withFaces;
            solid = enclosesItsVolume(part, own) ? &part : nullptr;
            all.insert(all.end(), own.begin(), own.end());
        }
        if (all.empty()) return result;
        const FaceSums sums = sumsOf(all);
        result.topArea = sums.top;
        result.bottomArea = sums.bottom;
        result.sideArea = sums.side;
        result.outerArea = sums.all();
        result.height = sums.highest - sums.lowest;
        if (withFaces == 1 && solid != nullptr && isComponent(labels_[label])) measureThinBody(all, result);
        return result;
    }

private:
    // Relative to the first corner, so that sums keep their digits.
    [[nodiscard]] std::vector<Corners> trianglesOf(std::uint32_t label) const {
        std::vector<Corners> triangles;
        const volume::VectorParts& parts = volume_.vectors;
        const auto stored = volume::trianglesOf(parts, label);
        if (stored.empty()) return triangles;
        const Vec3d origin = parts.position(stored.front().corners[0], {});
        for (const auto& [own, c] : stored)
            triangles.push_back(
                {parts.position(c[0], -origin), parts.position(c[1], -origin), parts.position(c[2], -origin)});
        return triangles;
    }

    [[nodiscard]] bool enclosesItsVolume(std::uint32_t label, std::span<const Corners> triangles) const {
        const FaceSums sums = sumsOf(triangles);
        return sums.all() > 0 &&
               volume::enclosesStatedVolume(labels_[label], sums.volume, sums.all(), volume_.vectors.unit);
    }

    // Adds the volume of a part, its bound and its source; the least exact source is that of the sum.
    void addVolume(std::uint32_t part, std::span<const Corners> triangles, ObjectQuantities& result) const {
        const Label& label = labels_[part];
        Trust trust = trustOf(label.filling);
        if (trust == Trust::Unknown) return;
        // A closed mesh without a known volume, such as one of solids that overlap each other.
        const bool isCounted = volume::hasClosedMesh(label.filling) && !(label.volume > 0);
        if (isCounted) trust = Trust::Voxels;
        double volume = 0;
        std::optional<double> bound;
        if (const auto solid = analyze::solidVolumeOf(label)) {
            volume = *solid;
            if (trust != Trust::Caps)
                bound = (triangles.empty() ? label.area : sumsOf(triangles).all()) * volume::VectorParts::kFinestUnit;
        } else {
            const std::uint64_t inside =
                label.voxels - (label.filling == Filling::Winding ? std::min(label.voxels, label.thinVoxels) : 0);
            if (inside + lost_[part] == 0) return;
            const double voxel = volume_.grid.voxelVolume();
            volume = double(inside + lost_[part]) * voxel;
            if (trust == Trust::Voxels && label.area > 0)
                bound = label.area * halfVoxel_ + double(label.uncertainVoxels + lost_[part]) * voxel;
        }
        const bool isFirst = !result.netVolume;
        result.netVolume = result.netVolume.value_or(0) + volume;
        if (isFirst)
            result.bound = bound;
        else
            result.bound = result.bound && bound ? std::optional(*result.bound + *bound) : std::nullopt;
        result.trust = std::max(result.trust, trust);
    }

    // A thin body, seen across its thickness.
    struct Seen {
        Silhouette silhouette;
        double thickness = 0, deepest = 0;   // deepest: with all pilasters
        double leastFill = 1, mostFill = 1;  // volume of a void by its area times the thickness
        bool isUpright = false, isClosed = false;
    };

    static std::optional<Seen> seenPlate(std::span<const Corners> triangles) {
        const auto plate = findPlate(triangles);
        if (!plate) return std::nullopt;
        const Vec3d up = cross(plate->normal, plate->along);
        const auto isOn = [&](const Corners& t, double place) {
            return std::all_of(t.begin(), t.end(),
                               [&](const Vec3d& p) { return std::abs(dot(p, plate->normal) - place) <= kFlatness; });
        };
        std::vector<FlatTriangle> flat;
        double high = -1e300, low = 1e300, across = 0;
        for (const Corners& t : triangles) {
            for (const Vec3d& p : t) {
                high = std::max(high, dot(p, plate->normal));
                low = std::min(low, dot(p, plate->normal));
            }
            const Vec3d normal = cross(t[1] - t[0], t[2] - t[0]);
            const double facing = dot(normal, plate->normal);
            if (std::abs(facing) < 0.5 * length(normal)) across += length(normal) / 2;
            if (std::abs(facing) <= 1e-6 * length(normal)) continue;
            const bool isBack = facing < 0;
            if (isBack && !isOn(t, plate->back)) continue;
            FlatTriangle& f = flat.emplace_back();
            for (std::size_t c = 0; c < 3; ++c) f.corners[c] = {dot(t[c], plate->along), dot(t[c], up)};
            f.claim = isBack ? kBack : isOn(t, plate->front) ? kFront : kSeen;
        }
        auto silhouette = silhouetteOf(flat, plate->isUpright());
        if (!silhouette) return std::nullopt;
        // Walls around a courtyard are not a slab with a hole: most of their faces stand upright.
        const double least = silhouette->voids.empty() ? 0.45 : 0.9;
        if (!plate->isUpright() && 2 * silhouette->area < least * across) return std::nullopt;
        return Seen{std::move(*silhouette), plate->thickness(), high - low, 1, 1, plate->isUpright(), false};
    }

    // A closed ring has several cuts; most voids are whole at the best one.
    static std::optional<Seen> seenRing(std::span<const Corners> triangles) {
        std::optional<Seen> best;
        double most = -1;
        for (const UnrolledRing& ring : unrollRing(triangles)) {
            auto silhouette = silhouetteOf(ring.triangles, true);
            if (!silhouette) continue;
            double area = 0;
            for (const Void& one : silhouette->voids) area += one.area;
            if (area <= most) continue;
            most = area;
            best = Seen{std::move(*silhouette), ring.thickness(), ring.highest - ring.lowest,
                        ring.leastFill,         ring.mostFill,    true,
                        ring.isClosed};
        }
        return best;
    }

    void measureThinBody(std::span<const Corners> triangles, ObjectQuantities& result) const {
        auto seen = seenPlate(triangles);
        // The flat ends of a curved wall are a plate as well.
        if (!seen || !seen->isUpright)
            if (auto ring = seenRing(triangles); ring && (!seen || ring->thickness < seen->thickness))
                seen = std::move(ring);
        if (!seen) return;
        const Silhouette& silhouette = seen->silhouette;
        const double u = silhouette.high[0] - silhouette.low[0], v = silhouette.high[1] - silhouette.low[1];
        if (seen->thickness > std::min(u, v) + kFlatness) return;  // the ends of a round column
        result.thickness = seen->thickness;
        result.length = seen->isUpright ? u : std::max(u, v);
        if (!seen->isUpright) result.width = std::min(u, v);
        if (seen->isUpright) result.sideArea = silhouette.area;
        if (!seen->isClosed) result.perimeter = silhouette.perimeter;
        if (mayHaveOpenings(labels_[result.label])) addVoids(*seen, result);
    }

    // A void is as deep as the wall is thick. Thinner material around it is a part of it to an unknown degree: half of it
    // is taken, and the other half is the bound.
    static void addVoids(const Seen& seen, ObjectQuantities& result) {
        double area = 0, closed = 0, bound = 0;
        bool isBounded = true;
        for (const Void& one : seen.silhouette.voids) {
            area += one.area;
            closed += seen.thickness * one.area * (seen.leastFill + seen.mostFill) / 2;
            bound += seen.thickness * one.area * (seen.mostFill - seen.leastFill) / 2;
            if (!one.rebate) {
                isBounded = false;
            } else if (*one.rebate > 0) {
                const bool isReveal = *one.rebate <= one.area;
                closed += isReveal ? seen.thickness * *one.rebate / 2 : 0;
                bound += seen.thickness * *one.rebate / (isReveal ? 2 : 1);
                bound += (seen.deepest - seen.thickness) * (one.area + *one.rebate);
            }
        }
        result.openingArea = area;
        result.openings = seen.silhouette.voids.size();
        if (!result.netVolume) return;
        result.grossVolume = *result.netVolume + closed;
        if (isBounded) result.grossBound = bound;
    }

    const volume::SemanticVolume& volume_;
    const std::vector<Label>& labels_;
    std::vector<std::uint64_t> lost_;  // by label: voxels that others took
    double halfVoxel_ = 0;
};

}  // namespace

bool isComponent(const Label& label) {
    const model::ClassRank rank = model::classRank(label.className);
    return !model::isSpace(label.className) && rank != model::ClassRank::Building && rank != model::ClassRank::Other &&
           !isBoundarySheet(label);
}

bool isBoundarySheet(const Label& label) {
    const bool isSurface = model::isBoundarySurface(label.className) || label.className == "DoorSurface" ||
                           label.className == "WindowSurface";
    return isSurface && label.filling == Filling::Surface;
}

std::vector<std::uint32_t> objectsOf(const volume::SemanticVolume& volume, std::span<const std::uint32_t> selected) {
    const auto& labels = volume.labels.labels;
    std::vector<char> hasFaces(labels.size(), 0), isTaken(labels.size(), 0);
    for (const auto& triangle : volume.vectors.triangles) hasFaces[triangle.label] = 1;
    for (std::uint32_t l = 0; l < labels.size(); ++l)
        if (labels[l].voxels > 0 || analyze::solidVolumeOf(labels[l])) hasFaces[l] = 1;
    std::vector<char> hasGeometry = hasFaces;
    for (std::uint32_t l = 0; l < labels.size(); ++l)
        if (hasFaces[l] != 0 && model::isPhase(labels[l].className) && labels[l].parent < l)
            hasGeometry[labels[l].parent] = 1;
    const analyze::Extents extents(volume.labels);
    for (const std::uint32_t label : selected) {
        if (hasGeometry[label] != 0) {
            isTaken[label] = 1;
            continue;
        }
        for (const std::uint32_t part : extents.of(label))
            if (hasGeometry[part] != 0 && isComponent(labels[part])) isTaken[part] = 1;
    }
    std::vector<std::uint32_t> objects;
    for (std::uint32_t l = 0; l < labels.size(); ++l) {
        const bool isOfOther =
            model::isPhase(labels[l].className) && labels[l].parent < l && isTaken[labels[l].parent] != 0;
        if (isTaken[l] != 0 && !isOfOther) objects.push_back(l);
    }
    return objects;
}

std::vector<std::uint32_t> defaultObjects(const volume::SemanticVolume& volume) {
    std::vector<std::uint32_t> all(volume.labels.labels.size());
    std::iota(all.begin(), all.end(), 0U);
    const std::vector<std::uint32_t> objects = objectsOf(volume, all);
    std::vector<std::uint32_t> components, bodies;
    for (const std::uint32_t object : objects) {
        const volume::Label& label = volume.labels.labels[object];
        if (isComponent(label)) components.push_back(object);
        if (!isBoundarySheet(label)) bodies.push_back(object);
    }
    if (!components.empty()) return components;
    return bodies.empty() ? objects : bodies;
}

std::vector<ObjectQuantities> measureObjects(const volume::SemanticVolume& volume,
                                             std::span<const std::uint32_t> objects, int threads) {
    const Measurer measurer(volume);
    std::vector<ObjectQuantities> results(objects.size());
    parallelFor(objects.size(), 1, threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t n = begin; n < end; ++n) results[n] = measurer.measure(objects[n]);
    });
    return results;
}

}  // namespace svt::quantities
