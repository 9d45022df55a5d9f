#include <svt/quantities/touching_faces.hpp>

#include <svt/analyze/outside_faces.hpp>
#include <svt/core/parallel.hpp>
#include <svt/model/classes.hpp>
#include <svt/quantities/touch/face_parts.hpp>
#include <svt/quantities/touch/flat_faces.hpp>
#include <svt/quantities/touch/mesh_sections.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <span>
#include <string_view>
#include <tuple>
#include <utility>

namespace svt::quantities {
namespace {

constexpr int kMostSteps = 3, kMostStepsThroughSheets = 5;  // of half a voxel
constexpr std::int32_t kAround = 2;                         // voxels around a point that has no air in front
constexpr std::size_t kMostAsked = 12;                      // of them
constexpr double kMostPoints = 20000, kLeastPoints = 8;
constexpr std::size_t kMostBodies = 1000;       // around a face that is divided exactly
constexpr std::size_t kMostSegments = 2000000;  // of sections in front of the faces of one object
constexpr double kTouching = 1e-4;              // metres: bodies this near in front of a face touch it
constexpr double kGap = 0.01;                   // metres: bodies across a gap of this size touch a face, too
constexpr double kClear = 0.9;                  // share of points from which all of a part has the same air
// Steps of the evenly spread sequence R2: powers of the inverse of the plastic number (Roberts 2018).
constexpr double kStepA = 0.7548776662466927, kStepB = 0.5698402909980532;

// The body or air in front of a point.
struct Seen {
    std::uint32_t label = volume::kNoLabel;
    bool isOutside = false, isKnown = false;
    bool isFar = false;  // a body at the other side of a gap
};

// The points of one part of a face, by the body or air in front of them.
struct Votes {
    double outside = 0, inside = 0;
    std::map<std::uint32_t, double> touched, across;  // by label; across a gap

    void add(const Seen& seen, double weight) {
        if (!seen.isKnown) return;
        if (seen.label == volume::kNoLabel)
            (seen.isOutside ? outside : inside) += weight;
        else
            (seen.isFar ? across : touched)[seen.label] += weight;
    }
};

class Toucher {
public:
    explicit Toucher(const volume::SemanticVolume& volume)
        : volume_(volume),
          labelOf_(volume.labels.labelOfScalar()),
          air_(volume.columns, labelOf_),
          sections_(volume),
          touching_(std::max(kTouching, 16 * volume.vectors.unit)) {
        const Vec3d s = volume.grid.spacing();
        step_ = std::max({s.x, s.y, s.z}) / 2;
        for (int a = 0; a < 3; ++a) {
            Vec3i next{};
            next[a] = 1;
            axes_[std::size_t(a)] = placeOf(next) - placeOf({});
        }
    }

    [[nodiscard]] std::vector<TouchingArea> areasOf(const ObjectQuantities& object) const {
        Areas areas;
        std::size_t work = kMostSegments;
        for (const std::uint32_t part : object.parts)
            for (const FlatFace& face : flatFaces(volume_.vectors, part)) divide(face, part, object.parts, areas, work);
        std::vector<TouchingArea> result;
        for (const auto& [key, area] : areas)
            result.push_back(
                {std::get<0>(key), std::get<1>(key), std::get<2>(key), area.first, std::min(area.first, area.second)});
        return result;
    }

private:
    using Key = std::tuple<std::uint32_t, bool, Facing>;
    using Areas = std::map<Key, std::pair<double, double>>;  // m2, and m2 that points divide
    using Parts = std::span<const std::uint32_t>;

    // The objects around a face: its own parts, and other closed meshes whose boxes are within a gap.
    struct Around {
        Parts own;
        std::vector<std::uint32_t> near;  // bodies
        bool isNarrow = false;            // less than two voxels wide
    };

    static bool isOneOf(std::uint32_t label, Parts own) {
        return std::find(own.begin(), own.end(), label) != own.end();
    }
    static void add(const Key& key, double area, double counted, Areas& areas) {
        auto& [sum, ofPoints] = areas[key];
        sum += area;
        ofPoints += counted;
    }

    void divide(const FlatFace& face, std::uint32_t part, Parts own, Areas& areas, std::size_t& work) const {
        const Facing facing = facingOf(face.normal);
        Box3d box;
        for (const auto& triangle : face.triangles)
            for (const Vec3d& corner : triangle) box.add(corner);
        const SectionPlane plane =
            SectionPlane::across(face.normal, face.triangles.front()[0] + face.normal * touching_);
        std::vector<FlatSegment> segments;
        std::vector<std::uint32_t> labels{part};  // by claim
        Around around{own, {}};
        const auto bodies = sections_.bodiesNear(plane::grown(box, kGap), kMostBodies);
        if (!bodies) return addTriangles(face, around, areas, true);
        for (const std::uint32_t body : *bodies) {
            const std::uint32_t label = sections_.labelOf(body);
            if (label == part) continue;
            if (!isOneOf(label, own)) around.near.push_back(body);
            const std::size_t before = segments.size();
            const bool isKnown = labels.back() == label;
            sections_.addSection(body, plane, std::uint32_t(labels.size()) - (isKnown ? 1 : 0), segments);
            if (segments.size() > before && !isKnown) labels.push_back(label);
        }
        around.isNarrow = (!around.near.empty() || own.size() > 1) && isNarrow(face);
        if (segments.empty()) return addTriangles(face, around, areas);
        if (const auto all = claimsOfAll(face, plane, segments)) {
            const std::uint32_t owner = ownerOf(*all, labels, own);
            if (owner == volume::kNoLabel) return addTriangles(face, around, areas);
            if (!isOneOf(owner, own)) add({owner, false, facing}, areaOf(face), 0, areas);
            return;
        }
        if (segments.size() > work) return addTriangles(face, around, areas, true);
        work -= segments.size();
        for (const auto& triangle : face.triangles)
            for (std::size_t n = 0; n < 3; ++n)
                segments.push_back({plane.flat(triangle[n]), plane.flat(triangle[(n + 1) % 3]), 0});
        const std::optional<FaceParts> parts = divideFace(segments);
        if (!parts) return addTriangles(face, around, areas, true);
        std::vector<std::uint32_t> owners;
        for (const auto& claims : parts->claims) owners.push_back(ownerOf(claims, labels, own));
        std::vector<Votes> votes(parts->regions);
        std::vector<double> freeArea(parts->regions, 0);
        for (const FacePart& one : parts->parts) {
            if (const std::uint32_t owner = owners[one.claims]; owner != volume::kNoLabel) {
                if (!isOneOf(owner, own)) add({owner, false, facing}, one.area, 0, areas);
                continue;
            }
            freeArea[one.region] += one.area;
            askPart(one, plane, around, votes[one.region]);
        }
        for (std::size_t n = 0; n < votes.size(); ++n) share(votes[n], freeArea[n], facing, false, areas);
    }

    static double areaOf(const FlatFace& face) {
        double area = 0;
        for (const auto& [a, b, c] : face.triangles) area += 0.5 * length(cross(b - a, c - a));
        return area;
    }
    static std::optional<std::vector<std::uint32_t>> claimsOfAll(const FlatFace& face, const SectionPlane& plane,
                                                                 std::span<const FlatSegment> sections) {
        FlatPoint low{kInfinity, kInfinity}, high{-kInfinity, -kInfinity};
        for (const auto& triangle : face.triangles)
            for (const Vec3d& corner : triangle) {
                const FlatPoint p = plane.flat(corner);
                for (std::size_t a = 0; a < 2; ++a) {
                    low[a] = std::min(low[a], p[a]);
                    high[a] = std::max(high[a], p[a]);
                }
            }
        return quantities::claimsOfAll(sections, low, high);
    }

    [[nodiscard]] bool isNarrow(const FlatFace& face) const {
        double longest = 0;
        for (const auto& [a, b, c] : face.triangles)
            longest = std::max({longest, length(b - a), length(c - b), length(a - c)});
        return areaOf(face) < 4 * step_ * longest;
    }

    // The label that has a place: an own part first, then as in the voxels.
    [[nodiscard]] std::uint32_t ownerOf(const std::vector<std::uint32_t>& claims,
                                        const std::vector<std::uint32_t>& labels, Parts own) const {
        std::uint32_t owner = volume::kNoLabel;
        const auto key = [&](std::uint32_t l) {
            const volume::Label& label = volume_.labels.labels[l];
            return std::tuple(!isOneOf(l, own), model::classRank(label.className), label.volume,
                              std::string_view(label.id), l);
        };
        for (const std::uint32_t claim : claims)
            if (owner == volume::kNoLabel || key(labels[claim]) < key(owner)) owner = labels[claim];
        return owner;
    }

    // A face without bodies in front of it, or one that could not be divided.
    void addTriangles(const FlatFace& face, const Around& around, Areas& areas, bool isUndivided = false) const {
        const Facing facing = facingOf(face.normal);
        for (const auto& [a, b, c] : face.triangles) {
            const Vec3d ab = b - a, ac = c - a;
            const double area = 0.5 * length(cross(ab, ac));
            const std::size_t count = pointsOf(area);
            Votes votes;
            for (std::size_t n = 0; n < count; ++n) {
                auto [u, v] = spread(n);
                if (u + v > 1) std::tie(u, v) = std::pair(1 - u, 1 - v);
                votes.add(look(a + ab * u + ac * v, face.normal, around, isUndivided), 1);
            }
            share(votes, area, facing, isUndivided, areas);
        }
    }

    [[nodiscard]] std::size_t pointsOf(double area) const {
        return std::size_t(std::clamp(std::ceil(area / (step_ * step_)), kLeastPoints, kMostPoints));
    }
    static std::pair<double, double> spread(std::size_t n) {
        const double u = 0.5 + kStepA * double(n), v = 0.5 + kStepB * double(n);
        return {u - std::floor(u), v - std::floor(v)};
    }

    void askPart(const FacePart& part, const SectionPlane& plane, const Around& around, Votes& votes) const {
        const std::size_t count = pointsOf(part.area);
        const double ends = part.high[0] - part.low[0] + part.high[1] - part.low[1];
        if (!(ends > 0)) return;
        for (std::size_t n = 0; n < count; ++n) {
            const auto [s, t] = spread(n);
            const double low = part.low[0] + s * (part.low[1] - part.low[0]);
            const double high = part.high[0] + s * (part.high[1] - part.high[0]);
            const Vec3d point = plane.inSpace({part.u[0] + s * (part.u[1] - part.u[0]), low + t * (high - low)}) -
                                plane.normal * touching_;
            votes.add(look(point, plane.normal, around, false), 2 * (high - low) / ends * part.area / double(count));
        }
    }

    // Divides a part of a face by its votes.
    static void share(const Votes& votes, double area, Facing facing, bool isUndivided, Areas& areas) {
        double air = votes.outside + votes.inside, touched = 0;
        for (const auto& [label, weight] : votes.touched) touched += weight;
        // A body across a wider gap counts only if no point of the part sees air.
        const bool isGap = air == 0;
        if (isGap)
            for (const auto& [label, weight] : votes.across) touched += weight;
        const double all = air + touched;
        if (!(all > 0)) return;
        for (const auto& [label, weight] : votes.touched)
            add({label, false, facing}, area * weight / all, area * weight / all, areas);
        if (isGap)
            for (const auto& [label, weight] : votes.across)
                add({label, false, facing}, area * weight / all, area * weight / all, areas);
        if (air == 0) return;
        const double free = area * air / all, ofTouched = touched > 0 ? area - free : 0;
        double outside = votes.outside / air;
        const bool isClear = !isUndivided && std::max(outside, 1 - outside) >= kClear;
        if (isClear) outside = std::round(outside);
        const double mixed = isUndivided ? free : free * std::min(outside, 1 - outside);
        for (const bool isOutside : {false, true})
            if (const double part = free * (isOutside ? outside : 1 - outside); part > 0)
                add({volume::kNoLabel, isOutside, facing}, part, std::min(part, mixed + ofTouched), areas);
    }

    [[nodiscard]] Vec3i voxelAt(Vec3d point) const {
        const Vec3d place = volume_.grid.indexFromWorld(volume_.grid.origin() + point);
        return {static_cast<std::int32_t>(std::floor(place.x + 0.5)),
                static_cast<std::int32_t>(std::floor(place.y + 0.5)),
                static_cast<std::int32_t>(std::floor(place.z + 0.5))};
    }
    [[nodiscard]] bool isInGrid(Vec3i at) const {
        const Vec3i n = volume_.grid.dimension();
        return at.x >= 0 && at.y >= 0 && at.z >= 0 && at.x < n.x && at.y < n.y && at.z < n.z;
    }

    // The body or air in front of a point of a free part, or of a face that is not divided.
    [[nodiscard]] Seen look(Vec3d point, Vec3d normal, const Around& around, bool isUndivided) const {
        if (const Seen seen = acrossGap(point, normal, around.near); seen.isKnown) return seen;
        Seen sheet, body;
        // A sheet of a slanted face is up to two voxels thick along the normal. The space behind it counts.
        for (int step = 1; step <= (sheet.isKnown ? kMostStepsThroughSheets : kMostSteps); ++step) {
            const Vec3i at = voxelAt(point + normal * (step_ * step));
            if (!isInGrid(at)) return {volume::kNoLabel, true, true};
            const std::uint32_t label = labelOf_[volume_.columns.scalarAt(at.x, at.y, at.z)];
            if (label == volume::kNoLabel) {
                if (isHidden(point, normal, at, around, isUndivided)) break;
                return {label, air_.contains(at.x, at.y, at.z), true};
            }
            if (isOneOf(label, around.own)) continue;
            if (volume_.labels.labels[label].filling == volume::Filling::Surface) {
                sheet = {label, false, true};
                continue;
            }
            if (isUndivided || !sections_.isClosed(label)) return {label, false, true};
            // The voxel belongs to a mesh that does not touch here: it is beside the point, or across a gap.
            body = {label, false, true, true};
            if (isHit(label, point, normal * (step_ * (step + 1)))) return body;
        }
        if (body.isKnown || (around.isNarrow && !isUndivided))
            if (const Seen air = nearestAir(point, normal, around.isNarrow); air.isKnown) return air;
        return body.isKnown ? body : sheet;
    }

    // The nearest body that is in front of a point across a small gap.
    [[nodiscard]] Seen acrossGap(Vec3d point, Vec3d normal, const std::vector<std::uint32_t>& near) const {
        Seen seen;
        double least = 1;
        for (const std::uint32_t body : near)
            if (const double hit = sections_.hitAt(body, point + normal * touching_, normal * kGap); hit <= least) {
                least = hit;
                seen = {sections_.labelOf(body), false, true};
            }
        return seen;
    }

    // In front of a narrow face, such as that of a frame, the next voxel may be at the other side of a pane.
    [[nodiscard]] bool isHidden(Vec3d point, Vec3d normal, Vec3i voxel, const Around& around, bool isUndivided) const {
        if (!around.isNarrow || isUndivided) return false;
        const Vec3d from = point + normal * touching_;
        return !isVisible(from, placeOf(voxel) - from);
    }

    [[nodiscard]] bool isVisible(Vec3d from, Vec3d way) const {
        Box3d box;
        box.add(from);
        box.add(from + way);
        const std::vector<std::uint32_t> bodies = sections_.bodiesNear(box);
        return std::none_of(bodies.begin(), bodies.end(),
                            [&](std::uint32_t body) { return sections_.hitAt(body, from, way) <= 1; });
    }

    [[nodiscard]] bool isHit(std::uint32_t label, Vec3d from, Vec3d way) const {
        Box3d box;
        box.add(from);
        box.add(from + way);
        const std::vector<std::uint32_t> bodies = sections_.bodiesNear(box);
        return std::any_of(bodies.begin(), bodies.end(), [&](std::uint32_t body) {
            return sections_.labelOf(body) == label && sections_.hitAt(body, from, way) <= 1;
        });
    }

    // The nearest air in front of a point. \param isSeen  without a closed mesh between
    [[nodiscard]] Seen nearestAir(Vec3d point, Vec3d normal, bool isSeen) const {
        const Vec3i middle = voxelAt(point + normal * step_);
        const Vec3d from = point + normal * touching_;
        const Vec3d first = placeOf(middle) - from;
        std::vector<std::pair<double, Vec3i>> places;
        for (std::int32_t k = middle.z - kAround; k <= middle.z + kAround; ++k)
            for (std::int32_t j = middle.y - kAround; j <= middle.y + kAround; ++j)
                for (std::int32_t i = middle.x - kAround; i <= middle.x + kAround; ++i) {
                    const Vec3d way = first + axes_[0] * double(i - middle.x) + axes_[1] * double(j - middle.y) +
                                      axes_[2] * double(k - middle.z);
                    if (!(dot(way, normal) > 0)) continue;
                    if (isInGrid({i, j, k}) && labelOf_[volume_.columns.scalarAt(i, j, k)] != volume::kNoLabel)
                        continue;
                    places.emplace_back(dot(way, way), Vec3i{i, j, k});
                }
        std::sort(places.begin(), places.end());
        for (std::size_t n = 0; n < std::min(places.size(), kMostAsked); ++n) {
            const Vec3i at = places[n].second;
            if (isSeen && !isVisible(from, placeOf(at) - from)) continue;
            return {volume::kNoLabel, !isInGrid(at) || air_.contains(at.x, at.y, at.z), true};
        }
        return {};
    }

    [[nodiscard]] Vec3d placeOf(Vec3i voxel) const {
        return volume_.grid.worldFromIndex(toDouble(voxel)) - volume_.grid.origin();
    }

    const volume::SemanticVolume& volume_;
    std::vector<std::uint32_t> labelOf_;
    analyze::OutsideAir air_;
    MeshSections sections_;
    double touching_ = 0;          // metres
    double step_ = 0;              // metres
    std::array<Vec3d, 3> axes_{};  // from a voxel to the next ones, metres
};

}  // namespace

Facing facingOf(Vec3d normal) noexcept {
    if (normal.z > kLeastRise) return Facing::Top;
    if (normal.z < -kLeastRise) return Facing::Bottom;
    const double turns = std::atan2(normal.x, normal.y) / (2 * std::numbers::pi);  // clockwise from north
    const auto octant = static_cast<int>(std::floor(8 * turns + 0.5));
    return static_cast<Facing>((octant + 8) % 8);
}

std::vector<std::vector<TouchingArea>> findTouchingAreas(const volume::SemanticVolume& volume,
                                                         std::span<const ObjectQuantities> objects, int threads) {
    const Toucher toucher(volume);
    std::vector<std::vector<TouchingArea>> areas(objects.size());
    parallelFor(objects.size(), 1, threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t n = begin; n < end; ++n) areas[n] = toucher.areasOf(objects[n]);
    });
    return areas;
}

}  // namespace svt::quantities
