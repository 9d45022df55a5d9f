/// Drawings of the generated models against approved ones in tests/golden/drawing.

#include <svt/drawing/approved/drawing_record_test.hpp>
#include <svt/drawing/building_crop.hpp>
#include <svt/drawing/line_view.hpp>
#include <svt/drawing/section_plane.hpp>
#include <svt/drawing/sheet_set.hpp>
#include <svt/drawing/sheet_views.hpp>
#include <svt/pipeline/sample_models_test.hpp>
#include <svt/samples/approved_test.hpp>

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

namespace svt::drawing {
namespace {

using samples::SampleFormat, samples::SampleKind;
using volume::SemanticVolume;

std::string recordOf(const SemanticVolume& volume, const SectionPlane& plane, const SectionOptions& options) {
    const auto drawn = drawSection(volume, plane, options);
    EXPECT_TRUE(drawn) << drawn.error().toString();
    return drawn ? approved::DrawingRecord(*drawn, volume).text() : std::string();
}

std::string recordOf(const SemanticVolume& volume, const std::vector<std::string>& planes,
                     const SectionOptions& options) {
    std::string text;
    for (const std::string& each : planes) {
        const auto plane = parseSectionPlane(each, volume);
        EXPECT_TRUE(plane) << each;
        if (plane) text += "== " + each + '\n' + recordOf(volume, *plane, options);
    }
    return text;
}

SectionOptions allOfIt() {
    SectionOptions options;
    options.beyond = {.visible = true, .hidden = true, .above = true};
    options.dimensions = true;
    return options;
}

const SemanticVolume& houseOfIfc() {
    static const SemanticVolume house = test::volumeOfSample(SampleKind::House, SampleFormat::Ifc4, 0.15);
    return house;
}
const SemanticVolume& houseOfSurfaces() {
    samples::SampleOptions options;
    options.thematic = true;
    options.turnDegrees = 30;
    static const SemanticVolume house = test::volumeOfSample(SampleKind::House, SampleFormat::CityGml2, 0.15, options);
    return house;
}
const SemanticVolume& houseOfVoxels() {
    static const SemanticVolume house =
        test::volumeOfSample(SampleKind::House, SampleFormat::CityGml3, 0.15, {}, false);
    return house;
}
const SemanticVolume& smallTower() {
    samples::SampleOptions options;
    options.storeys = 2;
    static const SemanticVolume tower = test::volumeOfSample(SampleKind::Tower, SampleFormat::CityGml3, 0.25, options);
    return tower;
}

TEST(ApprovedDrawings, PlansAndSectionsOfAHouseOfSolids) {
    test::expectApproved(
        "drawing/house_of_solids",
        recordOf(houseOfIfc(), {"z=1.4", "z=4.1", "z<4.1", "x=4.03", "y=3.01", "1,2,0.5,-15"}, allOfIt()));
}

TEST(ApprovedDrawings, PlansAndSectionsOfAHouseOfSurfaces) {
    test::expectApproved("drawing/house_of_surfaces",
                         recordOf(houseOfSurfaces(), {"z=1.4", "x=6", "3,-1,2,-12"}, allOfIt()));
}

TEST(ApprovedDrawings, PlansAndSectionsOfAHouseOfVoxels) {
    SectionOptions options = allOfIt();
    test::expectApproved("drawing/house_of_voxels",
                         recordOf(houseOfVoxels(), {"z=1.4", "y=3.01", "1,2,0.5,-15"}, options));
    options.useMeshes = false;
    options.smallestArea = 0.05;
    test::expectApproved("drawing/house_of_solids_by_voxels",
                         recordOf(houseOfIfc(), {"z=1.4", "x=4.03", "1,2,0.5,-15"}, options));
}

TEST(ApprovedDrawings, ViewsOfTheSheets) {
    for (const auto& [name, volume] : {std::pair("house_of_solids", &houseOfIfc()),
                                       {"house_of_voxels", &houseOfVoxels()},
                                       {"tower", &smallTower()}}) {
        const auto views = chooseSheetViews(*volume);
        ASSERT_TRUE(views) << views.error().toString();
        std::string text = writeSheetSet(sheetSetOf(*views, *volume)) + '\n';
        SectionOptions options;
        options.dimensions = true;
        for (const SheetView& view : views->views) {
            text += fmt::format("== {} {} floor {}\n", int(view.kind), view.name, approved::number(view.floor));
            options.beyond = view.beyond;
            const auto drawn = drawSection(*volume, view.plane, options);
            ASSERT_TRUE(drawn);
            const approved::DrawingRecord cropped(croppedToBuilding(*drawn, *volume), *volume);
            text += volume == &houseOfIfc() ? cropped.text() : approved::brief(cropped.text());
        }
        test::expectApproved(std::string("drawing/views_of_") + name, text);
    }
}

TEST(ApprovedDrawings, ViewsOfACamera) {
    const SemanticVolume& house = houseOfIfc();
    std::string text;
    for (const Vec3d eye : {Vec3d{-9, -12, 9}, Vec3d{6, 4, 1.6}})
        for (const bool isParallel : {false, true}) {
            render::FrameSpec frame;
            frame.width = 640;
            frame.height = 480;
            frame.camera.eye = house.grid.origin() + eye;
            frame.camera.target = house.grid.origin() + Vec3d{5, 4.5, 1.5};
            if (isParallel) frame.camera.projection = render::Camera::Projection::Orthographic;
            render::Pass pass;
            pass.styles.resize(house.labels.scalarCount());
            frame.passes.push_back(pass);
            const auto view = drawLineView(house, frame, {.hidden = true});
            text += "== " + approved::point(eye) + '\n';
            if (!view) {
                text += std::string(view.error().message()) + '\n';
                continue;
            }
            text += fmt::format("{} x {}\n", approved::number(view->width), approved::number(view->height)) +
                    approved::DrawingRecord(view->drawing, house).text();
        }
    test::expectApproved("drawing/views_of_a_camera", text);
}

}  // namespace
}  // namespace svt::drawing
