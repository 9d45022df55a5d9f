/// Line drawings against elevations, and against rays to points of the edges.

#include <svt/drawing/exact/boxes_test.hpp>
#include <svt/drawing/line_view.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace svt::drawing {
namespace {

render::FrameSpec frameOf(const Boxes& boxes, Vec3d eye, Vec3d target, bool isParallel = false) {
    render::FrameSpec frame;
    frame.width = 800;
    frame.height = 600;
    frame.camera.eye = boxes.volume.grid.origin() + eye;
    frame.camera.target = boxes.volume.grid.origin() + target;
    if (isParallel) frame.camera.projection = render::Camera::Projection::Orthographic;
    render::Pass pass;
    pass.styles.resize(boxes.volume.labels.scalarCount());
    frame.passes.push_back(pass);
    return frame;
}

TEST(LineView, AParallelViewAlongAnAxisIsTheElevation) {
    Boxes boxes;
    boxes.addBox("A", "BuildingInstallation", {2, 1, 0}, {4, 2, 2});
    boxes.addBox("B", "BuildingInstallation", {0, 3, 0}, {6, 4, 1});
    const auto view = drawLineView(boxes.volume, frameOf(boxes, {4, -5, 1}, {4, 0, 1}, true), {.hidden = true});
    ASSERT_TRUE(view);
    SectionOptions options;
    options.beyond = {.visible = true, .hidden = true};
    const auto elevation =
        drawSection(boxes.volume, {{0, -1, 0}, boxes.volume.grid.origin() + Vec3d{0, 0.5, 0}}, options);
    ASSERT_EQ(view->drawing.beyond.size(), elevation->beyond.size());
    for (std::size_t n = 0; n < elevation->beyond.size(); ++n) {
        EXPECT_EQ(view->drawing.beyond[n].kind, elevation->beyond[n].kind);
        // Zero is the target in one, the grid's lower corner in the other.
        EXPECT_NEAR(view->drawing.beyond[n].from.u + 4, elevation->beyond[n].from.u, 1e-9);
        EXPECT_NEAR(view->drawing.beyond[n].to.v + 1, elevation->beyond[n].to.v, 1e-9);
    }
}

TEST(LineView, WhatIsFartherIsSmallerInPerspective) {
    Boxes boxes;
    boxes.addBox("A", "BuildingInstallation", {4, 2, 4}, {6, 4, 6});
    const auto view = drawLineView(boxes.volume, frameOf(boxes, {5, -2, 5}, {5, 2, 5}));
    ASSERT_TRUE(view);
    // The eye is 4 m before the front face, which lies in the target's plane; the back face is hidden by it.
    ASSERT_EQ(view->drawing.beyond.size(), 4u);
    for (const BeyondLine& line : view->drawing.beyond) EXPECT_NEAR(std::abs(line.from.u), 1, 1e-9);
    EXPECT_NEAR(view->height, 2 * 4 * std::tan(35 * 3.14159265358979 / 360), 1e-9);
    EXPECT_NEAR(view->width, view->height * 800 / 600, 1e-9);
    const auto hidden = drawLineView(boxes.volume, frameOf(boxes, {5, -2, 5}, {5, 2, 5}), {.hidden = true});
    double least = 1;
    for (const BeyondLine& line : hidden->drawing.beyond) least = std::min(least, std::abs(line.to.u));
    EXPECT_NEAR(least, 4.0 / 6, 1e-6);
}

TEST(LineView, ACutIsFilledWhereTheCameraLooksAtIt) {
    Boxes boxes;
    boxes.addBox("A", "BuildingInstallation", {2, 2, 2}, {6, 6, 6});
    render::FrameSpec frame = frameOf(boxes, {4, -6, 10}, {4, 4, 4});
    frame.passes.front().clips.push_back(
        render::ClipRegion::plane({0, 0, 1}, boxes.volume.grid.origin() + Vec3d{0, 0, 4}));
    const auto above = drawLineView(boxes.volume, frame);
    ASSERT_TRUE(above);
    ASSERT_EQ(above->drawing.components.size(), 1u);
    // The plane passes the target: the polygon's corners are where the camera sees those of the square.
    const double distance = std::hypot(10.0, 6.0);
    for (const PlanePoint p : above->drawing.components[0].polygons[0].outer) {
        bool isCorner = false;
        for (const double y : {2.0, 6.0}) {
            const double depth = (y - 4) * 10 / distance, v = (y - 4) * 6 / distance;
            const double scale = distance / (distance + depth);
            isCorner = isCorner || (std::abs(std::abs(p.u) - 2 * scale) < 1e-4 && std::abs(p.v - v * scale) < 1e-4);
        }
        EXPECT_TRUE(isCorner) << p.u << " " << p.v;
    }
    frame.camera.eye.z = boxes.volume.grid.origin().z + 1;
    EXPECT_TRUE(drawLineView(boxes.volume, frame)->drawing.components.empty());
}

TEST(LineView, WhatItCannotDrawIsTold) {
    Boxes boxes;
    boxes.addBox("A", "BuildingInstallation", {2, 2, 2}, {6, 6, 6});
    render::FrameSpec frame = frameOf(boxes, {4, -6, 10}, {4, 4, 4});
    frame.passes.push_back(frame.passes.front());
    EXPECT_EQ(drawLineView(boxes.volume, frame).error().code(), Code::BadFrame);
    frame.passes.pop_back();
    frame.passes[0].clips.push_back(render::ClipRegion::box({{0, 0, 0}, {1, 1, 1}}, render::ClipRegion::Mode::CutAway));
    EXPECT_EQ(drawLineView(boxes.volume, frame).error().code(), Code::BadFrame);
    boxes.volume.vectors = {};
    EXPECT_EQ(drawLineView(boxes.volume, frameOf(boxes, {4, -6, 10}, {4, 4, 4})).error().code(), Code::BadArgument);
}

struct TestBox {
    Vec3d low, high;
};

/// Whether the way from `eye` to `p` meets the inside of a box, before `p` by more than a hair.
bool isHidden(const std::vector<TestBox>& boxes, Vec3d eye, Vec3d p) {
    for (const TestBox& box : boxes) {
        double from = 0, to = 1 - 1e-6;
        for (int axis = 0; axis < 3; ++axis) {
            const double d = p[axis] - eye[axis];
            const double a = (box.low[axis] - eye[axis]) / d, b = (box.high[axis] - eye[axis]) / d;
            from = std::max(from, std::min(a, b));
            to = std::min(to, std::max(a, b));
        }
        if (to - from > 1e-9) return true;
    }
    return false;
}

// Points of the edges of random boxes: those that a ray reaches lie on a line, the others do not.
TEST(LineView, PerspectiveLinesAgreeWithRays) {
    std::mt19937 random(5);
    const auto number = [&](double low, double high) {
        return low + (high - low) * static_cast<double>(random() % 4096) / 4096;
    };
    for (int round = 0; round < 10; ++round) {
        Boxes model;
        std::vector<TestBox> boxes;
        for (int n = 0; n < 9; ++n) {
            // Apart from each other: each in a cell of its own.
            const Vec3d cell{3.0 * (n % 3), 3.0 * (n / 3), 0};
            const Vec3d low = cell + Vec3d{number(0.2, 1), number(0.2, 1), number(0, 4)};
            boxes.push_back({low, low + Vec3d{number(0.5, 1.7), number(0.5, 1.7), number(0.5, 5)}});
            model.addBox("box" + std::to_string(n), "BuildingInstallation", boxes.back().low, boxes.back().high);
        }
        const Vec3d eye{number(-6, 12), number(-9, -4), number(1, 9)}, target{4, 4, 3};
        const auto view = drawLineView(model.volume, frameOf(model, eye, target));
        ASSERT_TRUE(view);
        const PlaneAxes& axes = view->drawing.axes;
        const double distance = length(target - eye);
        const auto isOnLine = [&](Vec3d p) {
            const Vec3d q = p - target;
            const double scale = distance / (distance + dot(q, -axes.normal));
            const double u = dot(q, axes.u) * scale, v = dot(q, axes.v) * scale;
            for (const BeyondLine& line : view->drawing.beyond) {
                const double du = line.to.u - line.from.u, dv = line.to.v - line.from.v;
                const double t =
                    std::clamp(((u - line.from.u) * du + (v - line.from.v) * dv) / (du * du + dv * dv), 0.0, 1.0);
                if (std::hypot(u - line.from.u - t * du, v - line.from.v - t * dv) < 3e-4) return true;
            }
            return false;
        };
        int seen = 0, hidden = 0, missing = 0, needless = 0;
        for (const TestBox& box : boxes)
            for (int n = 0; n < 200; ++n) {
                const int along = n % 3;
                Vec3d p;
                for (int axis = 0; axis < 3; ++axis)
                    p[axis] = axis == along ? number(box.low[axis], box.high[axis])
                                            : (random() % 2 == 0 ? box.low[axis] : box.high[axis]);
                const bool isBehind = isHidden(boxes, eye, p);
                ++(isBehind ? hidden : seen);
                if (!isBehind && !isOnLine(p)) ++missing;
                if (isBehind && isOnLine(p)) ++needless;
            }
        EXPECT_EQ(missing, 0) << round;
        // In the picture some points that are hidden lie on lines of what is before them.
        EXPECT_LT(needless, hidden / 10) << round;
        EXPECT_GT(seen, 300);
        EXPECT_GT(hidden, 300);
    }
}

}  // namespace
}  // namespace svt::drawing
