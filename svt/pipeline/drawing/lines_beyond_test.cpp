/// Lines beyond the cut against a second implementation: rays through the triangles as read. Beside every edge of the
/// model two rays are cast. Where they hit things that clearly differ there must be a line; and beside every line that is
/// drawn they must differ.

#include <svt/core/test_data_test.hpp>
#include <svt/drawing/section_drawing.hpp>
#include <svt/drawing/stair_flights.hpp>
#include <svt/model/classes.hpp>
#include <svt/pipeline/build_volume.hpp>
#include <svt/readers/model_joiner.hpp>
#include <svt/readers/read_model.hpp>
#include <svt/samples/sample.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <random>
#include <string>

namespace svt::pipeline {
namespace {

using drawing::PlanePoint;

constexpr double kBeside = 1.5e-3;  // metres: rays to the left and right of an edge

struct SeenTriangle {
    Vec3d a, b, c;  // u, v and depth
    Vec3d normal;
    std::uint32_t label = 0;
};

/// What a ray from the plane hits first.
struct Hit {
    double depth = kInfinity;
    Vec3d normal{};
    std::uint32_t label = volume::kNoLabel;
    bool isCut = false;                 ///< it begins within something
    std::vector<std::uint32_t> labels;  ///< of all faces within 0.5 mm of it, ascending
};

/// All triangles of a model that hide what is behind them, in rows of the drawing.
class Rays {
public:
    Rays(const mesh::MeshSet& meshes, const std::vector<std::uint32_t>& labelOfObject, const volume::LabelTable& table,
         const drawing::SectionDrawing& drawing) {
        const drawing::PlaneAxes& axes = drawing.axes;
        isSolid_.resize(table.labels.size());
        for (std::size_t o = 0; o < meshes.objects.size(); ++o) {
            const mesh::ObjectMesh& object = meshes.objects[o];
            const std::uint32_t label = labelOfObject[o];
            const std::string& className = table.labels[label].className;
            if (model::isSpace(className) || className == "ClosureSurface") continue;
            isSolid_[label] = object.isSolid();
            const auto place = [&](std::uint32_t v) {
                const Vec3d p = object.vertices[v] + (meshes.origin - axes.origin);
                return Vec3d{dot(p, axes.u), dot(p, axes.v), -dot(p, drawing.plane.normal)};
            };
            for (const mesh::Triangle& triangle : object.triangles) {
                SeenTriangle seen{
                    place(triangle.corners[0]), place(triangle.corners[1]), place(triangle.corners[2]), {}, label};
                seen.normal = normalized(cross(seen.b - seen.a, seen.c - seen.a));
                triangles_.push_back(seen);
            }
        }
        for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
            const SeenTriangle& s = triangles_[t];
            const long first = rowOf(std::min({s.a.y, s.b.y, s.c.y})), last = rowOf(std::max({s.a.y, s.b.y, s.c.y}));
            for (long row = first; row <= last; ++row) rows_[row].push_back(t);
        }
    }

    [[nodiscard]] const std::vector<SeenTriangle>& triangles() const { return triangles_; }

    [[nodiscard]] Hit cast(PlanePoint p) const {
        Hit hit;
        std::vector<std::pair<double, std::uint32_t>> faces;
        std::map<std::uint32_t, int> around;  // how often a solid begins behind the plane, less how often it ends
        const auto row = rows_.find(rowOf(p.v));
        if (row == rows_.end()) return hit;
        for (const std::uint32_t t : row->second) {
            const SeenTriangle& s = triangles_[t];
            const double x = side(s.a, s.b, p), y = side(s.b, s.c, p), z = side(s.c, s.a, p), sum = x + y + z;
            if (!((x > 0 && y > 0 && z > 0) || (x < 0 && y < 0 && z < 0))) continue;
            const double depth = (s.a.z * y + s.b.z * z + s.c.z * x) / sum;
            if (depth <= 1e-5) continue;
            around[s.label] += x > 0 ? 1 : -1;
            faces.emplace_back(depth, s.label);
            if (depth < hit.depth) hit = {depth, s.normal, s.label, false, {}};
        }
        for (const auto& [label, count] : around)
            if (isSolid_[label] && count != 0) return {0, {0, 0, 1}, volume::kNoLabel, true, {}};
        for (const auto& [depth, label] : faces)
            if (depth < hit.depth + 5e-4) hit.labels.push_back(label);
        std::sort(hit.labels.begin(), hit.labels.end());
        hit.labels.erase(std::unique(hit.labels.begin(), hit.labels.end()), hit.labels.end());
        return hit;
    }

private:
    static long rowOf(double v) { return static_cast<long>(std::floor(v / 0.05)); }
    static double side(Vec3d a, Vec3d b, PlanePoint p) { return (b.x - a.x) * (p.v - a.y) - (b.y - a.y) * (p.u - a.x); }
    std::vector<SeenTriangle> triangles_;
    std::vector<bool> isSolid_;
    std::map<long, std::vector<std::uint32_t>> rows_;
};

/// Whether a line must be drawn between two hits, and whether it may be.
bool differClearly(const Hit& a, const Hit& b) {
    if (a.isCut || b.isCut) return false;
    if (std::isinf(a.depth) != std::isinf(b.depth)) return true;
    if (std::isinf(a.depth)) return false;
    // Steps count across the face that is seen: a slope has a step from ray to ray.
    const double step = std::abs(a.depth - b.depth), across = std::min(std::abs(a.normal.z), std::abs(b.normal.z));
    return std::abs(dot(a.normal, b.normal)) < 0.86 || step * across > 0.02;
}
/// Whether two hits lie on facets of the curved soffit of one stair. No line is drawn between these.
class StairSoffits {
public:
    StairSoffits(const volume::LabelTable& table, const drawing::SectionDrawing& drawing)
        : stairs_(drawing::stairOfLabels(table)), up_{drawing.axes.u.z, drawing.axes.v.z, -drawing.plane.normal.z} {}
    [[nodiscard]] bool haveBoth(const Hit& a, const Hit& b) const {
        if (a.label == volume::kNoLabel || b.label == volume::kNoLabel) return false;
        return stairs_[a.label] != volume::kNoLabel && stairs_[a.label] == stairs_[b.label] && isSloped(a) &&
               isSloped(b) && dot(a.normal, b.normal) > 0.5 && std::abs(a.depth - b.depth) < 0.02;
    }

private:
    [[nodiscard]] bool isSloped(const Hit& hit) const {
        const double rise = std::abs(dot(hit.normal, up_));
        return rise > 0.05 && rise < 0.98;
    }
    std::vector<std::uint32_t> stairs_;
    Vec3d up_;
};

bool differAtAll(const Hit& a, const Hit& b) {
    if (a.isCut || b.isCut || a.labels != b.labels) return true;
    if (std::isinf(a.depth) != std::isinf(b.depth)) return true;
    if (std::isinf(a.depth)) return false;
    const double slope = std::max(std::hypot(a.normal.x, a.normal.y) / std::abs(a.normal.z),
                                  std::hypot(b.normal.x, b.normal.y) / std::abs(b.normal.z));
    return std::abs(dot(a.normal, b.normal)) < 0.97 || std::abs(a.depth - b.depth) > 1e-4 + 2.1 * kBeside * slope;
}

/// Distances from points to what is drawn, found by cells of 50 mm.
class Drawn {
public:
    explicit Drawn(const drawing::SectionDrawing& drawing) {
        for (const drawing::BeyondLine& line : drawing.beyond) add(line.from, line.to);
        for (const drawing::SectionBorder& border : drawing.borders)
            for (std::size_t n = 0; n + 1 < border.points.size(); ++n) add(border.points[n], border.points[n + 1]);
        for (const drawing::SectionLine& line : drawing.lines)
            for (std::size_t n = 0; n + 1 < line.points.size(); ++n) add(line.points[n], line.points[n + 1]);
    }
    [[nodiscard]] double distance(PlanePoint p) const {
        double least = kInfinity;
        for (long row = cellOf(p.v) - 1; row <= cellOf(p.v) + 1; ++row)
            if (const auto found = rows_.find(row); found != rows_.end())
                for (const auto& [a, b] : found->second) {
                    const double du = b.u - a.u, dv = b.v - a.v, size = du * du + dv * dv;
                    const double t =
                        size > 0 ? std::clamp(((p.u - a.u) * du + (p.v - a.v) * dv) / size, 0.0, 1.0) : 0.0;
                    least = std::min(least, std::hypot(a.u + t * du - p.u, a.v + t * dv - p.v));
                }
        return least;
    }

private:
    static long cellOf(double v) { return static_cast<long>(std::floor(v / 0.05)); }
    void add(PlanePoint a, PlanePoint b) {
        for (long row = cellOf(std::min(a.v, b.v)); row <= cellOf(std::max(a.v, b.v)); ++row)
            rows_[row].emplace_back(a, b);
    }
    std::map<long, std::vector<std::pair<PlanePoint, PlanePoint>>> rows_;
};

std::pair<PlanePoint, PlanePoint> boxOf(const drawing::SectionDrawing& drawing) {
    PlanePoint low = drawing.beyond.front().from, high = low;
    for (const drawing::BeyondLine& line : drawing.beyond)
        for (const PlanePoint p : {line.from, line.to}) {
            low = {std::min(low.u, p.u), std::min(low.v, p.v)};
            high = {std::max(high.u, p.u), std::max(high.v, p.v)};
        }
    return {low, high};
}

struct LinesSeen {
    std::size_t views = 0, needed = 0, missing = 0, drawn = 0, needless = 0;
};

void compareView(const mesh::MeshSet& meshes, const std::vector<std::uint32_t>& labelOfObject,
                 const volume::SemanticVolume& volume, const drawing::SectionPlane& plane, LinesSeen& tally) {
    drawing::SectionOptions options;
    options.beyond.visible = true;
    const auto drawing = drawing::drawSection(volume, plane, options);
    ASSERT_TRUE(drawing);
    if (drawing->beyond.empty()) return;
    ++tally.views;
    const Rays rays(meshes, labelOfObject, volume.labels, *drawing);
    const Drawn drawn(*drawing);
    const StairSoffits soffits(volume.labels, *drawing);
    std::mt19937 random(7);
    const auto fraction = [&] { return (static_cast<double>(random() % 100000) + 0.5) / 100000; };
    const auto cast = [&](PlanePoint a, PlanePoint b, double t, PlanePoint& p) {
        const double du = b.u - a.u, dv = b.v - a.v, length = std::hypot(du, dv);
        p = {a.u + t * du, a.v + t * dv};
        const double u = -dv / length * kBeside, v = du / length * kBeside;
        return std::pair(rays.cast({p.u + u, p.v + v}), rays.cast({p.u - u, p.v - v}));
    };
    // Edges of triangles, whether they are seen or not.
    for (int n = 0; n < 4000; ++n) {
        const SeenTriangle& s = rays.triangles()[random() % rays.triangles().size()];
        PlanePoint p;
        if (std::hypot(s.b.x - s.a.x, s.b.y - s.a.y) < 0.01) continue;
        const auto [left, right] = cast({s.a.x, s.a.y}, {s.b.x, s.b.y}, fraction(), p);
        if (!differClearly(left, right) || soffits.haveBoth(left, right)) continue;
        ++tally.needed;
        if (!(drawn.distance(p) <= 1.5 * kBeside)) ++tally.missing;
    }
    // Places where what is seen changes, between two places of the drawing: also where no mesh has an edge.
    const auto [low, high] = boxOf(*drawing);
    for (int n = 0; n < 300; ++n) {
        PlanePoint a{low.u + fraction() * (high.u - low.u), low.v + fraction() * (high.v - low.v)};
        PlanePoint b{low.u + fraction() * (high.u - low.u), low.v + fraction() * (high.v - low.v)};
        Hit from = rays.cast(a), to = rays.cast(b);
        while (std::hypot(b.u - a.u, b.v - a.v) > 2 * kBeside && differClearly(from, to)) {
            const PlanePoint middle{0.5 * (a.u + b.u), 0.5 * (a.v + b.v)};
            const Hit hit = rays.cast(middle);
            if (differClearly(from, hit)) {
                b = middle;
                to = hit;
            } else {
                a = middle;
                from = hit;
            }
        }
        if (!differClearly(from, to) || soffits.haveBoth(from, to)) continue;
        ++tally.needed;
        if (!(drawn.distance(a) <= 2.5 * kBeside)) ++tally.missing;
    }
    for (const drawing::BeyondLine& line : drawing->beyond) {
        if (std::hypot(line.to.u - line.from.u, line.to.v - line.from.v) < 0.02) continue;
        PlanePoint p;
        const auto [left, right] = cast(line.from, line.to, 0.1 + 0.8 * fraction(), p);
        ++tally.drawn;
        if (!differAtAll(left, right)) ++tally.needless;
    }
}

LinesSeen castBeside(model::BuildingModel model) {
    LinesSeen tally;
    BuildOptions options;
    options.vectors.meshes = true;
    const mesh::MeshSet meshes = *mesh::buildMeshes(model);
    std::vector<std::string> ids;
    for (const mesh::ObjectMesh& object : meshes.objects) ids.push_back(model.features[object.feature].id);
    const volume::SemanticVolume volume = std::move(buildVolume(model, options)->volume);
    std::map<std::string, std::uint32_t> labelOfId;
    for (std::uint32_t l = 0; l < volume.labels.labels.size(); ++l) labelOfId[volume.labels.labels[l].id] = l;
    std::vector<std::uint32_t> labelOfObject;
    for (const std::string& id : ids) labelOfObject.push_back(labelOfId.at(id));
    const Vec3d middle = volume.grid.worldFromIndex(toDouble(volume.grid.dimension()) * 0.4637);
    std::vector<drawing::SectionPlane> planes;
    for (const char* side : {"north", "east", "south", "west"})
        planes.push_back(*drawing::elevationPlane(side, volume));
    for (const Vec3d normal :
         {Vec3d{0, 0, 1}, Vec3d{0, -1, 0}, Vec3d{1, 0, 0}, Vec3d{0.6, 0.8, 0}, Vec3d{0.5, -0.6, 0.4}})
        planes.push_back({normalized(normal), middle});
    for (const drawing::SectionPlane& plane : planes) compareView(meshes, labelOfObject, volume, plane, tally);
    return tally;
}

void expectSeen(const std::string& name, const LinesSeen& tally) {
    // The row of docs/dev/drawings.md.
    std::printf("| %s | %zu | %zu | %zu | %zu | %zu |\n", name.c_str(), tally.views, tally.needed, tally.missing,
                tally.drawn, tally.needless);
    EXPECT_GT(tally.needed, 100u) << name;
    // Parts below 2 mm are seen by rays.
    EXPECT_LE(tally.missing, tally.needed / 300) << name;
    // Parts of one door that lie in one plane are told apart by their edges, and rays may pass thin parts.
    EXPECT_LE(tally.needless, tally.drawn / 20) << name;
}

class LinesBeyondOfFile : public testing::TestWithParam<const char*> {};

TEST_P(LinesBeyondOfFile, AreWhatRaysSee) {
    SVT_NEEDS_DATA(file, GetParam());
    auto model = readers::readModels(std::span(&file, 1), {}, nullptr);
    ASSERT_TRUE(model);
    expectSeen(GetParam(), castBeside(std::move(*model)));
}

INSTANTIATE_TEST_SUITE_P(Shared, LinesBeyondOfFile,
                         testing::Values("fzk_haus_citygml3.gml", "sig3d_lod4_citygml2.gml",
                                         "berlin_lod2_citygml1.gml"));

TEST(LinesBeyondOfSample, HouseAndTowerAreWhatRaysSee) {
    for (const auto kind : {samples::SampleKind::House, samples::SampleKind::Tower}) {
        const auto text = samples::writeSample(kind, samples::SampleFormat::CityGml3, {});
        ASSERT_TRUE(text);
        auto model = readers::readModel(std::as_bytes(std::span(*text)), "sample.gml");
        ASSERT_TRUE(model);
        expectSeen(kind == samples::SampleKind::House ? "house (generated)" : "tower (generated)",
                   castBeside(std::move(*model)));
    }
}

}  // namespace
}  // namespace svt::pipeline
