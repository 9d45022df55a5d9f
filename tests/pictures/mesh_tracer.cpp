#include "mesh_tracer.hpp"

#include "nearest_face.hpp"

#include <svt/model/classes.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace svt::test {
namespace {

/// Crossings at most this far apart, metres, are in one place.
constexpr double kTie = 1e-4;

struct Crossing {
    double depth = 0;
    std::uint32_t object = 0;
    Vec3d normal{};  ///< outwards
    bool isEntry = false;
};

struct Context {
    RTCIntersectContext embree;  // the first member: Embree passes a pointer to it
    std::vector<std::pair<std::uint32_t, std::uint32_t>> met;
};

// Notes each triangle, and rejects it, so that Embree goes on.
void noteTriangle(const RTCFilterFunctionNArguments* arguments) {
    auto& context = *reinterpret_cast<Context*>(arguments->context);
    context.met.emplace_back(RTCHitN_geomID(arguments->hit, arguments->N, 0),
                             RTCHitN_primID(arguments->hit, arguments->N, 0));
    arguments->valid[0] = 0;
}

/// A part of the ray between two crossings: the objects that it is inside of.
class InsideSet {
public:
    void cross(const Crossing& crossing) {
        int& winding = windings_[crossing.object];
        winding += crossing.isEntry ? 1 : -1;
        if (winding == 0) windings_.erase(crossing.object);
    }
    [[nodiscard]] bool isEmpty() const { return windings_.empty(); }
    template <class Key>
    [[nodiscard]] std::optional<std::uint32_t> top(const Key& key) const {
        std::optional<std::uint32_t> best;
        for (const auto& [object, winding] : windings_)
            if (winding > 0 && (!best || key(object) < key(*best))) best = object;
        return best;
    }

private:
    std::map<std::uint32_t, int> windings_;
};

}  // namespace

struct MeshTracer::State {
    const mesh::MeshSet& meshes;
    const pipeline::LabelledObjects& labelled;
    std::vector<char> isHidden;
    RTCDevice device = rtcNewDevice("threads=1");
    RTCScene scene = rtcNewScene(device);
    /// By object: its surfaces, if these own its material (thematic bodies) or its outside.
    std::map<std::uint32_t, NearestFace> surfacesOf{};
    std::vector<char> isMaterialOfSurfaces{};
    std::vector<Box3d> openShells{};

    using Key = std::tuple<std::uint8_t, bool, double, std::string_view, std::uint32_t>;
    /// Order of priority, the first wins: as the voxelizer documents it (voxelize.hpp).
    [[nodiscard]] Key key(std::uint32_t object) const {
        const mesh::ObjectMesh& mesh = meshes.objects[object];
        const voxelize::ObjectClaim& claim = labelled.claims[object];
        return {claim.rank, !mesh.isSolid(), mesh.volume, claim.id, object};
    }
    [[nodiscard]] auto keys() const {
        return [this](std::uint32_t object) { return key(object); };
    }
    [[nodiscard]] bool isDrawn(std::uint32_t object) const { return isHidden[labelled.claims[object].scalar] == 0; }

    void findSurfaces(const volume::LabelTable& table);
    [[nodiscard]] std::vector<Crossing> crossings(Vec3d origin, Vec3d direction) const;
    /// The first of `crossings` and those that tie with it; `inside` then has crossed their solids.
    std::span<const Crossing> crossTies(std::span<const Crossing> crossings, double tie, InsideSet& inside) const;
    [[nodiscard]] std::vector<volume::Scalar> scalarsOf(std::uint32_t owner, Vec3d point, bool isOutside) const;
    /// Surfaces without inside own the side behind their face: those of higher priority than the object there.
    [[nodiscard]] std::vector<const Crossing*> sheetsAmong(std::span<const Crossing> crossings,
                                                           std::optional<std::uint32_t> topBefore,
                                                           std::optional<std::uint32_t> topAfter) const;
};

std::span<const Crossing> MeshTracer::State::crossTies(std::span<const Crossing> crossings, double tie,
                                                       InsideSet& inside) const {
    std::size_t count = 0;
    for (; count < crossings.size() && crossings[count].depth - crossings.front().depth <= tie; ++count)
        if (meshes.objects[crossings[count].object].isSolid()) inside.cross(crossings[count]);
    return crossings.first(count);
}

std::vector<const Crossing*> MeshTracer::State::sheetsAmong(std::span<const Crossing> crossings,
                                                            std::optional<std::uint32_t> topBefore,
                                                            std::optional<std::uint32_t> topAfter) const {
    std::vector<const Crossing*> sheets;
    for (const Crossing& crossing : crossings) {
        if (meshes.objects[crossing.object].isSolid() || !isDrawn(crossing.object)) continue;
        const auto behind = crossing.isEntry ? topAfter : topBefore;
        if (!behind || key(crossing.object) < key(*behind)) sheets.push_back(&crossing);
    }
    return sheets;
}

void MeshTracer::State::findSurfaces(const volume::LabelTable& table) {
    std::map<std::uint32_t, std::vector<std::uint32_t>> of;
    std::map<std::uint32_t, std::uint32_t> objectOf;
    for (std::uint32_t o = 0; o < meshes.objects.size(); ++o) objectOf[labelled.labelOfObject[o]] = o;
    for (std::uint32_t o = 0; o < meshes.objects.size(); ++o) {
        const volume::Label& label = table.labels[labelled.labelOfObject[o]];
        if (label.filling == volume::Filling::Body) {
            for (std::uint32_t up = label.parent; up != volume::kNoLabel; up = table.labels[up].parent) {
                if (model::classRank(table.labels[up].className) != model::ClassRank::Building) continue;
                if (!objectOf.contains(up)) continue;
                of[objectOf[up]].push_back(o);
                isMaterialOfSurfaces[objectOf[up]] = 1;
                break;
            }
        } else if (labelled.claims[o].body != voxelize::kNoBody) {
            of[labelled.claims[o].body].push_back(o);
        }
    }
    for (auto& [body, surfaces] : of) surfacesOf.try_emplace(body, device, meshes, std::move(surfaces));
}

std::vector<Crossing> MeshTracer::State::crossings(Vec3d origin, Vec3d direction) const {
    Context context;
    rtcInitIntersectContext(&context.embree);
    context.embree.filter = noteTriangle;
    RTCRayHit hit{};
    hit.ray.org_x = static_cast<float>(origin.x);
    hit.ray.org_y = static_cast<float>(origin.y);
    hit.ray.org_z = static_cast<float>(origin.z);
    hit.ray.dir_x = static_cast<float>(direction.x);
    hit.ray.dir_y = static_cast<float>(direction.y);
    hit.ray.dir_z = static_cast<float>(direction.z);
    hit.ray.tfar = std::numeric_limits<float>::infinity();
    hit.ray.mask = ~0u;
    hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene, &context.embree, &hit);
    std::ranges::sort(context.met);
    context.met.erase(std::unique(context.met.begin(), context.met.end()), context.met.end());
    std::vector<Crossing> found;
    for (const auto& [object, triangle] : context.met) {
        const mesh::ObjectMesh& mesh = meshes.objects[object];
        if (mesh.triangles.empty()) continue;
        const auto& corners = mesh.triangles[triangle].corners;
        const Vec3d a = mesh.vertices[corners[0]];
        const Vec3d normal = normalized(cross(mesh.vertices[corners[1]] - a, mesh.vertices[corners[2]] - a));
        const double slope = dot(normal, direction);
        // The triangle found by Embree, at its depth in double precision.
        if (std::abs(slope) > 1e-9) found.push_back({dot(a - origin, normal) / slope, object, normal, slope < 0});
    }
    std::ranges::sort(found, {}, &Crossing::depth);
    return found;
}

// The labels that a ray may show where `owner` has the highest priority.
std::vector<volume::Scalar> MeshTracer::State::scalarsOf(std::uint32_t owner, Vec3d point, bool isOutside) const {
    const auto surfaces = surfacesOf.find(owner);
    if (surfaces == surfacesOf.end() || !(isOutside || isMaterialOfSurfaces[owner] != 0))
        return {labelled.claims[owner].scalar};
    std::vector<volume::Scalar> scalars;
    for (const std::uint32_t nearest : surfaces->second.at(point, kTie))
        scalars.push_back(labelled.claims[nearest].scalar);
    return scalars;
}

MeshTracer::MeshTracer(const mesh::MeshSet& meshes, const pipeline::LabelledObjects& labelled,
                       const volume::LabelTable& table, std::vector<char> isHidden)
    : state_(new State{meshes, labelled, std::move(isHidden)}) {
    State& state = *state_;
    state.isMaterialOfSurfaces.resize(meshes.objects.size());
    rtcSetSceneFlags(state.scene, RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION);
    for (const mesh::ObjectMesh& object : meshes.objects) {
        addTriangles(state.device, state.scene, object);
        if (object.closingMethod == mesh::ClosingMethod::Open) state.openShells.push_back(object.bounds);
    }
    rtcCommitScene(state.scene);
    state.findSurfaces(table);
}

MeshTracer::~MeshTracer() {
    state_->surfacesOf.clear();
    rtcReleaseScene(state_->scene);
    rtcReleaseDevice(state_->device);
}

namespace {

/// The drawn part of a ray, depths.
struct DrawnPart {
    double from = 0, to = kInfinity;
    bool startsAtCut = false;
};

DrawnPart drawnPart(const render::ViewRay& ray, const std::optional<render::HalfSpace>& cut) {
    DrawnPart part;
    if (!cut) return part;
    const double height = dot(cut->normal, ray.origin) + cut->offset, rise = dot(cut->normal, ray.direction);
    if (rise == 0) {
        if (height > 0) part.to = -1;
    } else if (rise > 0) {
        part.to = -height / rise;
    } else if (-height / rise > 0) {
        part.from = -height / rise;
        part.startsAtCut = true;
    }
    return part;
}

// Before all objects, so that winding numbers start at 0.
double depthBefore(const Box3d& bounds, Vec3d origin, Vec3d direction) {
    double depth = 0;
    for (int corner = 0; corner < 8; ++corner) {
        const Vec3d p{(corner & 1 ? bounds.max : bounds.min).x, (corner & 2 ? bounds.max : bounds.min).y,
                      (corner & 4 ? bounds.max : bounds.min).z};
        depth = std::min(depth, dot(p - origin, direction) / dot(direction, direction));
    }
    return depth - 1;
}

}  // namespace

SeenSurface MeshTracer::trace(const render::ViewRay& ray, const std::optional<render::HalfSpace>& cut) const {
    const State& state = *state_;
    const Vec3d origin = ray.origin - state.meshes.origin;
    const double before = depthBefore(state.meshes.bounds, origin, ray.direction);
    std::vector<Crossing> all = state.crossings(origin + ray.direction * before, ray.direction);
    for (Crossing& crossing : all) crossing.depth += before;
    const DrawnPart part = drawnPart(ray, cut);
    const double tie = kTie / length(ray.direction);

    SeenSurface seen;
    InsideSet inside;
    bool isFound = false;
    const auto show = [&](double depth, std::vector<volume::Scalar> scalars, Vec3d normal, bool isCap) {
        if (isFound) return;
        isFound = true;
        seen.depth = depth;
        seen.scalars = std::move(scalars);
        seen.normal = dot(normal, ray.direction) > 0 ? -normal : normal;
        seen.isCap = isCap;
    };
    const auto showStart = [&] {
        const Vec3d start = origin + ray.direction * part.from;
        for (const Box3d& shell : state.openShells)
            if (part.startsAtCut && shell.contains(start)) seen.isDecided = false;
        const auto top = inside.top(state.keys());
        if (top && state.isDrawn(*top))
            show(part.from, state.scalarsOf(*top, start, false),
                 part.startsAtCut ? normalized(cut->normal) : -normalized(ray.direction), part.startsAtCut);
    };

    bool hasStarted = false;
    for (std::size_t first = 0; first < all.size();) {
        const double depth = all[first].depth;
        if (!hasStarted && depth > part.from) {
            hasStarted = true;
            showStart();
        }
        const auto topBefore = inside.top(state.keys());
        const std::span<const Crossing> here = state.crossTies(std::span(all).subspan(first), tie, inside);
        first += here.size();
        const auto topAfter = inside.top(state.keys());
        if (isFound || depth <= part.from || depth >= part.to) continue;
        const std::vector<const Crossing*> sheets = state.sheetsAmong(here, topBefore, topAfter);
        if (!sheets.empty()) {
            std::vector<volume::Scalar> scalars;
            for (const Crossing* sheet : sheets) scalars.push_back(state.labelled.claims[sheet->object].scalar);
            show(depth, std::move(scalars), sheets.front()->normal, false);
        } else if (topAfter && topAfter != topBefore && state.isDrawn(*topAfter)) {
            const auto own = std::ranges::find(here, *topAfter, &Crossing::object);
            const Vec3d normal = own != here.end() ? own->normal : here.front().normal;
            show(depth, state.scalarsOf(*topAfter, origin + ray.direction * depth, !topBefore), normal, false);
        }
    }
    if (!hasStarted) showStart();
    if (!inside.isEmpty()) seen.isDecided = false;
    return seen;
}

}  // namespace svt::test
