#include <svt/illustrate/inset/inset_frame.hpp>

#include <svt/image/text.hpp>
#include <svt/render/camera_rays.hpp>

#include <algorithm>
#include <cmath>

namespace svt::illustrate {
namespace {

constexpr double kRim = 0.02;  // between an inset and the rim of the picture, in heights of the picture

double lineWidth(double height) { return std::max(1.0, height / 500); }

void stroke(image::Image<image::Rgba8>& image, Vec3d from, Vec3d to, Vec3f color, Vec3f halo) {
    const double width = lineWidth(image.height());
    image::drawLine(image, from.x, from.y, to.x, to.y, {2.6 * width, halo});
    image::drawLine(image, from.x, from.y, to.x, to.y, {width, color});
}

std::array<Vec3d, 4> cornersOf(const PictureBox& box) {
    return {Vec3d{box.left, box.top, 0}, Vec3d{box.right, box.top, 0}, Vec3d{box.right, box.bottom, 0},
            Vec3d{box.left, box.bottom, 0}};
}

void strokeBox(image::Image<image::Rgba8>& image, const PictureBox& box, Vec3f color, Vec3f halo) {
    const auto corners = cornersOf(box);
    // Halos first, so that none lies over a line.
    for (const bool isHalo : {true, false})
        for (std::size_t n = 0; n < 4; ++n) {
            const Vec3d a = corners[n], b = corners[(n + 1) % 4];
            const double width = lineWidth(image.height()) * (isHalo ? 2.6 : 1);
            image::drawLine(image, a.x, a.y, b.x, b.y, {width, isHalo ? halo : color});
        }
}

double turn(Vec3d a, Vec3d b, Vec3d c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); }

}  // namespace

PictureBox insetPlace(const Scene& scene, const Inset& inset) {
    const auto pixels = [&](std::int32_t of) {
        return static_cast<double>(std::max(16L, std::lround(inset.size * of)));
    };
    const double width = pixels(scene.width), height = pixels(scene.height), rim = std::round(kRim * scene.height);
    const bool isRight = inset.corner == Inset::Corner::TopRight || inset.corner == Inset::Corner::BottomRight;
    const bool isTop = inset.corner == Inset::Corner::TopRight || inset.corner == Inset::Corner::TopLeft;
    const double left = isRight ? std::max(0.0, scene.width - rim - width) : rim;
    const double top = isTop ? rim : std::max(0.0, scene.height - rim - height);
    return {left, top, left + width, top + height};
}

InsetMargins insetMargins(const Scene& scene) noexcept {
    InsetMargins margins;
    for (const Inset& inset : scene.insets) {
        const bool isRight = inset.corner == Inset::Corner::TopRight || inset.corner == Inset::Corner::BottomRight;
        double& margin = isRight ? margins.right : margins.left;
        margin = std::min(0.4, std::max(margin, inset.size + 2 * kRim * scene.height / scene.width));
    }
    return margins;
}

std::optional<PictureBox> boxOfSeen(const render::Frame& frame, const render::FrameSpec& spec, const volume::Grid& grid,
                                    const render::FrameSpec& other) {
    const render::CameraRays from(spec, grid), to(other, grid);
    PictureBox box{1e30, 1e30, -1e30, -1e30};
    for (std::int32_t y = 0; y < frame.depth.height(); ++y)
        for (std::int32_t x = 0; x < frame.depth.width(); ++x) {
            const double depth = double(frame.depth.at(x, y));
            if (!std::isfinite(depth)) continue;
            const double u = 2 * (x + 0.5) / spec.width - 1, v = 1 - 2 * (y + 0.5) / spec.height;
            const Vec3d seen = to.seenAt(from.worldAt(u, v, depth) - other.camera.eye);
            if (to.isPerspective() && !(seen.z > 0)) continue;
            const double px = (seen.x + 1) / 2 * other.width, py = (1 - seen.y) / 2 * other.height;
            box = {std::min(box.left, px), std::min(box.top, py), std::max(box.right, px), std::max(box.bottom, py)};
        }
    box = {std::max(box.left, 0.0), std::max(box.top, 0.0), std::min(box.right, double(other.width)),
           std::min(box.bottom, double(other.height))};
    if (!(box.left < box.right && box.top < box.bottom)) return {};
    return box;
}

std::vector<std::pair<Vec3d, Vec3d>> leadersBetween(const PictureBox& a, const PictureBox& b) {
    struct Corner {
        Vec3d at;
        bool ofA;
    };
    std::vector<Corner> corners;
    for (const Vec3d& corner : cornersOf(a)) corners.push_back({corner, true});
    for (const Vec3d& corner : cornersOf(b)) corners.push_back({corner, false});
    std::stable_sort(corners.begin(), corners.end(), [](const Corner& p, const Corner& q) {
        return p.at.x < q.at.x || (p.at.x == q.at.x && p.at.y < q.at.y);
    });
    // Lower and upper chain of the convex hull (Andrew 1979).
    std::vector<std::pair<Vec3d, Vec3d>> leaders;
    for (const double side : {1.0, -1.0}) {
        std::vector<Corner> hull;
        for (const Corner& corner : corners) {
            while (hull.size() >= 2 && side * turn(hull[hull.size() - 2].at, hull.back().at, corner.at) <= 0)
                hull.pop_back();
            hull.push_back(corner);
        }
        for (std::size_t n = 1; n < hull.size(); ++n)
            if (hull[n - 1].ofA != hull[n].ofA) {
                const bool isForward = hull[n - 1].ofA;
                leaders.emplace_back(hull[isForward ? n - 1 : n].at, hull[isForward ? n : n - 1].at);
            }
    }
    return leaders;
}

void drawInset(const render::Frame& inset, const PictureBox& place, const std::optional<PictureBox>& shown, Vec3f color,
               Vec3f halo, render::Frame& picture) {
    if (shown) {
        for (const auto& [from, to] : leadersBetween(*shown, place)) stroke(picture.color, from, to, color, halo);
        strokeBox(picture.color, *shown, color, halo);
    }
    const auto left = static_cast<std::int32_t>(place.left), top = static_cast<std::int32_t>(place.top);
    const std::int32_t width = std::min(inset.color.width(), picture.color.width() - left);
    const std::int32_t height = std::min(inset.color.height(), picture.color.height() - top);
    for (std::int32_t y = 0; y < height; ++y)
        for (std::int32_t x = 0; x < width; ++x) {
            picture.color.at(left + x, top + y) = inset.color.at(x, y);
            picture.label.at(left + x, top + y) = inset.label.at(x, y);
            picture.depth.at(left + x, top + y) = inset.depth.at(x, y);
        }
    strokeBox(picture.color, place, color, halo);
}

void drawMark(const PictureBox& shown, Vec3f color, Vec3f halo, image::Image<image::Rgba8>& image) {
    strokeBox(image, shown, color, halo);
}

}  // namespace svt::illustrate
