/// Sections of volumes that keep their meshes against a second implementation: the triangles as read, cut on scan lines
/// of the plane. It shares neither the arrangement nor the coordinates of the volume: intervals of each object on a line
/// come from its own triangles in double precision, and the priority decides between them.

#include <svt/core/test_data_test.hpp>
#include <svt/drawing/section_drawing.hpp>
#include <svt/model/classes.hpp>
#include <svt/model/phases.hpp>
#include <svt/pipeline/build_volume.hpp>
#include <svt/pipeline/drawing/section_planes_test.hpp>
#include <svt/readers/model_joiner.hpp>
#include <svt/readers/read_model.hpp>
#include <svt/samples/sample.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <tuple>

namespace svt::pipeline {
namespace {

using volume::kNoLabel;

struct LineEnd {
    double u = 0;
    int winding = 0;
    double sine = 1;  ///< of the angle between border and line
};
/// Crossings of a line v = const by label.
using LineEnds = std::map<std::uint32_t, std::vector<LineEnd>>;

/// What is on a line, from left to right: from `u` on, up to the next.
struct LinePart {
    double u = 0;
    std::uint32_t label = kNoLabel;
    double sine = 1;
};

/// A model, its meshes as read, and its volume.
struct Workpiece {
    model::BuildingModel model;
    mesh::MeshSet meshes;
    volume::SemanticVolume volume;
    std::vector<std::uint32_t> labelOfObject,
        buildingOf;                       ///< buildingOf: for bodies the building, else the label itself
    std::vector<std::uint32_t> priority;  ///< by label
};

Workpiece prepareWork(model::BuildingModel model) {
    Workpiece work;
    work.model = model;
    BuildOptions options;
    options.vectors.meshes = true;
    model::splitPhases(work.model);
    work.meshes = *mesh::buildMeshes(work.model);
    work.volume = std::move(buildVolume(model, options)->volume);
    const auto& labels = work.volume.labels.labels;
    std::map<std::string, std::uint32_t> labelOfId;
    for (std::uint32_t l = 0; l < labels.size(); ++l) labelOfId[labels[l].id] = l;
    std::vector<std::uint32_t> order;
    for (const mesh::ObjectMesh& object : work.meshes.objects)
        work.labelOfObject.push_back(labelOfId.at(work.model.features[object.feature].id));
    std::vector<double> volumes(labels.size(), 0);
    for (std::size_t o = 0; o < work.meshes.objects.size(); ++o)
        volumes[work.labelOfObject[o]] = work.meshes.objects[o].volume;
    for (std::uint32_t l = 0; l < labels.size(); ++l) order.push_back(l);
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        const auto key = [&](std::uint32_t l) {
            return std::tuple(model::classRank(labels[l].className), volumes[l], labels[l].id);
        };
        return key(a) < key(b);
    });
    work.priority.resize(labels.size());
    for (std::uint32_t n = 0; n < order.size(); ++n) work.priority[order[n]] = n;
    for (std::uint32_t l = 0; l < labels.size(); ++l) {
        std::uint32_t building = l;
        if (labels[l].filling == volume::Filling::Body)
            while (building != kNoLabel && model::classRank(labels[building].className) != model::ClassRank::Building)
                building = labels[building].parent;
        work.buildingOf.push_back(building);
    }
    return work;
}

/// Segments of the closed meshes in the plane, by label, in its coordinates; the inside is to the left.
using Segments = std::map<std::uint32_t, std::vector<std::array<drawing::PlanePoint, 2>>>;

Segments cutTriangles(const Workpiece& work, const drawing::SectionDrawing& drawing) {
    Segments segments;
    const drawing::PlaneAxes& axes = drawing.axes;
    // A hair to the kept side: faces in the plane are not cut.
    const double raise = dot(drawing.plane.normal, axes.normal) > 0 ? -1e-7 : 1e-7;
    for (std::size_t o = 0; o < work.meshes.objects.size(); ++o) {
        const mesh::ObjectMesh& object = work.meshes.objects[o];
        if (!object.isSolid()) continue;
        auto& list = segments[work.labelOfObject[o]];
        const auto place = [&](std::uint32_t v) { return object.vertices[v] + (work.meshes.origin - axes.origin); };
        for (const mesh::Triangle& triangle : object.triangles) {
            std::array<drawing::PlanePoint, 2> ends{};
            int count = 0;
            for (std::size_t n = 0; n < 3; ++n) {
                const Vec3d a = place(triangle.corners[n]), b = place(triangle.corners[(n + 1) % 3]);
                const double ha = dot(a, axes.normal) - raise, hb = dot(b, axes.normal) - raise;
                if ((ha > 0) == (hb > 0)) continue;
                const Vec3d p = a + (b - a) * (ha / (ha - hb));
                ends[ha > 0 ? 0 : 1] = {dot(p, axes.u), dot(p, axes.v)};
                ++count;
            }
            if (count == 2) list.push_back(ends);
        }
    }
    return segments;
}

void addCrossing(drawing::PlanePoint a, drawing::PlanePoint b, double v, std::vector<LineEnd>& ends) {
    if ((a.v > v) == (b.v > v)) return;
    // The inside is to the left: going up it lies towards smaller u.
    ends.push_back({a.u + (v - a.v) / (b.v - a.v) * (b.u - a.u), b.v > a.v ? -1 : 1,
                    std::abs(b.v - a.v) / std::hypot(b.u - a.u, b.v - a.v)});
}

/// Parts of a line where several labels have intervals: the one of highest priority.
std::vector<LinePart> resolve(LineEnds ends, const std::vector<std::uint32_t>& priority) {
    std::vector<std::tuple<double, std::uint32_t, int, double>> events;
    for (const auto& [label, list] : ends)
        for (const LineEnd& end : list) events.emplace_back(end.u, label, end.winding, end.sine);
    std::sort(events.begin(), events.end());
    std::map<std::uint32_t, std::pair<std::uint32_t, int>> active;  // by priority: label and winding
    std::vector<LinePart> parts;
    for (const auto& [u, label, winding, sine] : events) {
        auto& entry = active[priority[label]];
        entry.first = label;
        entry.second += winding;
        std::uint32_t top = kNoLabel;
        for (const auto& [rank, claim] : active)
            if (claim.second > 0) {
                top = claim.first;
                break;
            }
        if (parts.empty() ? top == kNoLabel : top == parts.back().label) continue;
        parts.push_back({u, top, sine});
    }
    return parts;
}

/// Leaves out parts shorter than `least`; what is left of them belongs to the part before.
std::vector<LinePart> withoutShort(const std::vector<LinePart>& parts, double least) {
    std::vector<LinePart> kept;
    for (std::size_t n = 0; n < parts.size(); ++n) {
        if (n + 1 < parts.size() && parts[n + 1].u - parts[n].u < least) continue;
        const std::uint32_t before = kept.empty() ? kNoLabel : kept.back().label;
        if (parts[n].label == before) continue;
        kept.push_back(parts[n]);
    }
    return kept;
}

struct Tally {
    std::size_t components = 0, planes = 0, lines = 0, wrongLines = 0, byVoxels = 0, inFaces = 0;
    std::vector<double> areaErrors;  ///< relative, per component and plane, over all lines
    double worstEdge = 0;            ///< metres, across the border
    double worstArea = 0;
};

drawing::PlanePoint turned(drawing::PlanePoint p, bool isTurned) {
    return isTurned ? drawing::PlanePoint{p.v, -p.u} : p;
}

/// Compares drawing and triangles on `count` lines along u, or, if `isTurned`, along v.
void compareLines(const Workpiece& work, const drawing::SectionDrawing& drawing, const Segments& segments, int count,
                  bool isTurned, std::map<std::uint32_t, std::pair<double, double>>& lengths, Tally& tally) {
    double low = 1e300, high = -1e300;
    for (const auto& [label, list] : segments)
        for (const auto& ends : list)
            for (const drawing::PlanePoint p : ends) {
                low = std::min(low, turned(p, isTurned).v);
                high = std::max(high, turned(p, isTurned).v);
            }
    if (!(high > low)) return;
    for (int n = 0; n < count; ++n) {
        const double v = low + (high - low) * (n + 0.381966) / count;
        LineEnds fromMesh, fromDrawing;
        for (const auto& [label, list] : segments)
            for (const auto& ends : list)
                addCrossing(turned(ends[0], isTurned), turned(ends[1], isTurned), v, fromMesh[label]);
        for (const drawing::SectionComponent& component : drawing.components)
            for (const drawing::SectionPolygon& polygon : component.polygons) {
                auto& ends = fromDrawing[component.label];
                const auto add = [&](const drawing::Ring& ring) {
                    for (std::size_t i = 0; i < ring.size(); ++i)
                        addCrossing(turned(ring[i], isTurned), turned(ring[(i + 1) % ring.size()], isTurned), v, ends);
                };
                add(polygon.outer);
                for (const drawing::Ring& hole : polygon.holes) add(hole);
                // What is drawn by voxels takes its place from the others in both.
                if (!component.isExact) fromMesh[component.label] = ends;
            }
        auto expected = resolve(fromMesh, work.priority), drawn = resolve(fromDrawing, work.priority);
        for (LinePart& part : drawn)
            if (part.label != kNoLabel) part.label = work.buildingOf[part.label];
        for (auto* parts : {&expected, &drawn}) {
            // Where borders of one object meet, rounding may leave a gap without width.
            *parts = withoutShort(withoutShort(*parts, 1e-5), 2e-3);
            for (std::size_t i = 0; i + 1 < parts->size(); ++i) {
                if ((*parts)[i].label == kNoLabel) continue;
                auto& sums = lengths[(*parts)[i].label];
                (parts == &expected ? sums.first : sums.second) += (*parts)[i + 1].u - (*parts)[i].u;
            }
        }
        ++tally.lines;
        bool isSame = expected.size() == drawn.size();
        for (std::size_t i = 0; isSame && i < expected.size(); ++i) isSame = expected[i].label == drawn[i].label;
        if (!isSame) {
            ++tally.wrongLines;
            continue;
        }
        for (std::size_t i = 0; i < expected.size(); ++i)
            tally.worstEdge = std::max(tally.worstEdge, std::abs(expected[i].u - drawn[i].u) * expected[i].sine);
    }
}

/// Nine planes parallel to the axes and four oblique ones through the middle.
std::vector<drawing::SectionPlane> planesThrough(const volume::Grid& grid) {
    const Vec3d size = scaled(toDouble(grid.dimension() - Vec3i{1, 1, 1}), grid.spacing());
    std::vector<drawing::SectionPlane> planes = test::axisPlanesThrough(grid);
    for (const Vec3d normal : {Vec3d{0.6, 0.8, 0}, Vec3d{0.5, 0.6, 0.4}, Vec3d{-0.2, 0.5, 0.9}, Vec3d{0.7, -0.1, -0.3}})
        planes.push_back({normalized(normal), grid.origin() + size * 0.4637});
    return planes;
}

Tally compareModel(model::BuildingModel model) {
    const Workpiece work = prepareWork(std::move(model));
    Tally tally;
    for (const drawing::SectionPlane& plane : planesThrough(work.volume.grid)) {
        const auto drawing = drawing::drawSection(work.volume, plane);
        EXPECT_TRUE(drawing);
        if (!drawing || drawing->components.empty()) continue;
        ++tally.planes;
        if (drawing->edgesInPlane != 0) ++tally.inFaces;
        const Segments segments = cutTriangles(work, *drawing);
        std::map<std::uint32_t, std::pair<double, double>> lengths;
        for (const bool isTurned : {false, true}) compareLines(work, *drawing, segments, 200, isTurned, lengths, tally);
        // A component as a whole: the panes of a window are too small for the part of 2 mm, see below.
        const auto wholeOf = [&](std::uint32_t label) {
            if (label == kNoLabel) return label;
            const volume::Label& part = work.volume.labels.labels[label];
            return model::isPhase(part.className) ? part.parent : label;
        };
        std::map<std::uint32_t, std::pair<double, double>> wholes;
        for (const auto& [label, sums] : lengths) {
            wholes[wholeOf(label)].first += sums.first;
            wholes[wholeOf(label)].second += sums.second;
        }
        std::set<std::uint32_t> exact;
        for (const drawing::SectionComponent& component : drawing->components) {
            if (component.area > 0) ++(component.isExact ? tally.components : tally.byVoxels);
            if (component.isExact) exact.insert(work.buildingOf[wholeOf(component.label)]);
        }
        for (const auto& [label, sums] : wholes) {
            if (!exact.contains(label) && sums.second > 0) continue;
            tally.areaErrors.push_back(std::abs(sums.second - sums.first) / std::max(sums.first, 1e-3));
        }
    }
    std::sort(tally.areaErrors.begin(), tally.areaErrors.end());
    if (!tally.areaErrors.empty()) tally.worstArea = tally.areaErrors.back();
    return tally;
}

void expectExact(const std::string& name, const Tally& tally) {
    ASSERT_GT(tally.lines + tally.planes, 0u) << name;
    EXPECT_EQ(tally.areaErrors.empty(), tally.components == 0) << name;
    const double median = tally.areaErrors.empty() ? 0 : tally.areaErrors[tally.areaErrors.size() / 2];
    // The row of docs/dev/drawings.md.
    std::printf("| %s | %zu | %zu | %zu | %zu | %.4f | %.4f | %.3f | %zu of %zu |\n", name.c_str(), tally.planes,
                tally.inFaces, tally.components, tally.byVoxels, 100 * median, 100 * tally.worstArea,
                1000 * tally.worstEdge, tally.wrongLines, tally.lines);
    EXPECT_LE(median, 1e-5) << name;
    // The area of a small component may differ by the part of 2 mm of one line, see below.
    EXPECT_LE(tally.worstArea, 5e-3) << name;
    EXPECT_LE(tally.worstEdge, 1e-4) << name;
    // A line may pass a corner, where one of both sees a part of 2 mm and the other does not.
    EXPECT_LE(tally.wrongLines, tally.lines / 1000) << name;
}

class ExactSectionOfFile : public testing::TestWithParam<const char*> {};

TEST_P(ExactSectionOfFile, AgreesWithTheTriangles) {
    SVT_NEEDS_DATA(file, GetParam());
    auto model = readers::readModels(std::span(&file, 1), {}, nullptr);
    ASSERT_TRUE(model);
    expectExact(GetParam(), compareModel(std::move(*model)));
}

INSTANTIATE_TEST_SUITE_P(Shared, ExactSectionOfFile,
                         testing::Values("fzk_haus_citygml3.gml", "fzk_haus.city.json", "sig3d_lod4_citygml2.gml",
                                         "berlin_lod2_citygml1.gml", "100_buildings_lod2_citygml3.gml",
                                         "cityjson_fake_complete.city.json"));

// Any further files, separated by colons: see scripts/check_sections.sh.
TEST(ExactSectionOfFiles, AgreeWithTheirTriangles) {
    const char* files = std::getenv("SVT_SECTION_FILES");
    if (files == nullptr) GTEST_SKIP() << "SVT_SECTION_FILES names no files";
    std::stringstream list(files);
    for (std::string name; std::getline(list, name, ':');) {
        const std::filesystem::path file = name;
        auto model = readers::readModels(std::span(&file, 1), {}, nullptr);
        ASSERT_TRUE(model) << name;
        expectExact(file.filename().string(), compareModel(std::move(*model)));
    }
}

TEST(ExactSectionOfSample, HouseAndTowerAgreeWithTheirTriangles) {
    for (const auto kind : {samples::SampleKind::House, samples::SampleKind::Tower}) {
        const auto text = samples::writeSample(kind, samples::SampleFormat::CityGml3, {});
        ASSERT_TRUE(text);
        auto model = readers::readModel(std::as_bytes(std::span(*text)), "sample.gml");
        ASSERT_TRUE(model);
        expectExact(kind == samples::SampleKind::House ? "house (generated)" : "tower (generated)",
                    compareModel(std::move(*model)));
    }
}

}  // namespace
}  // namespace svt::pipeline
