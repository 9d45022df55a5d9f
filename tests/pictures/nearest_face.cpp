#include "nearest_face.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace svt::test {
namespace {

// Distance of a point from a segment, and from a triangle: inside its prism from its plane, else from its edges.
double distanceFromEdge(Vec3d p, Vec3d a, Vec3d b) {
    const Vec3d along = b - a;
    const double square = dot(along, along);
    const double share = square > 0 ? std::clamp(dot(p - a, along) / square, 0.0, 1.0) : 0;
    return length(p - a - along * share);
}

double distanceFromTriangle(Vec3d p, Vec3d a, Vec3d b, Vec3d c) {
    const Vec3d normal = normalized(cross(b - a, c - a));
    const bool isAbove = dot(cross(b - a, p - a), normal) >= 0 && dot(cross(c - b, p - b), normal) >= 0 &&
                         dot(cross(a - c, p - c), normal) >= 0;
    if (isAbove && length(normal) > 0) return std::abs(dot(p - a, normal));
    return std::min({distanceFromEdge(p, a, b), distanceFromEdge(p, b, c), distanceFromEdge(p, c, a)});
}

struct Query {
    const mesh::MeshSet& meshes;
    const std::vector<std::uint32_t>& surfaces;
    Vec3d point;
    double tie;
    double nearest = kInfinity;
    std::map<std::uint32_t, double> distances;
};

bool visit(RTCPointQueryFunctionArguments* arguments) {
    auto& query = *static_cast<Query*>(arguments->userPtr);
    const std::uint32_t number = query.surfaces[arguments->geomID];
    const mesh::ObjectMesh& object = query.meshes.objects[number];
    const auto& corners = object.triangles[arguments->primID].corners;
    const double distance = distanceFromTriangle(query.point, object.vertices[corners[0]], object.vertices[corners[1]],
                                                 object.vertices[corners[2]]);
    const auto known = query.distances.try_emplace(number, distance).first;
    known->second = std::min(known->second, distance);
    if (distance >= query.nearest) return false;
    query.nearest = distance;
    // Single precision of Embree: keep a margin.
    arguments->query->radius = static_cast<float>((distance + query.tie) * 1.0001 + 1e-5);
    return true;
}

}  // namespace

void addTriangles(RTCDevice device, RTCScene scene, const mesh::ObjectMesh& object) {
    const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    // Embree refuses buffers without elements.
    auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                                 12, std::max<std::size_t>(1, object.vertices.size())));
    for (const Vec3d& vertex : object.vertices)
        for (int axis = 0; axis < 3; ++axis) *vertices++ = static_cast<float>(vertex[axis]);
    auto* corners = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, std::max<std::size_t>(1, object.triangles.size())));
    if (object.triangles.empty()) std::fill_n(corners, 3, 0u);
    for (const mesh::Triangle& triangle : object.triangles)
        for (const std::uint32_t corner : triangle.corners) *corners++ = corner;
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
}

NearestFace::NearestFace(RTCDevice device, const mesh::MeshSet& meshes, std::vector<std::uint32_t> surfaces)
    : meshes_(meshes), surfaces_(std::move(surfaces)), scene_(rtcNewScene(device)) {
    for (const std::uint32_t number : surfaces_) addTriangles(device, scene_, meshes.objects[number]);
    rtcCommitScene(scene_);
}

NearestFace::~NearestFace() { rtcReleaseScene(scene_); }

std::vector<std::uint32_t> NearestFace::at(Vec3d point, double tie) const {
    Query query{meshes_, surfaces_, point, tie, kInfinity, {}};
    RTCPointQuery start{static_cast<float>(point.x), static_cast<float>(point.y), static_cast<float>(point.z), 0,
                        std::numeric_limits<float>::infinity()};
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    rtcPointQuery(scene_, &start, &context, visit, &query);
    std::vector<std::uint32_t> nearest;
    for (const auto& [number, distance] : query.distances)
        if (distance <= query.nearest + tie) nearest.push_back(number);
    std::ranges::sort(nearest, {}, [&](std::uint32_t number) { return query.distances[number]; });
    return nearest;
}

}  // namespace svt::test
