#include <svt/illustrate/inset/inset_frame.hpp>

#include <svt/image/text.hpp>
#include <svt/plane/hull.hpp>
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

// The box around points in a picture, cut to it.
class SeenBox {
public:
    SeenBox(const render::FrameSpec& spec, const volume::Grid& grid) : spec_(spec), rays_(spec, grid) {}
    void add(Vec3d point) {
        const Vec3d seen = rays_.seenAt(point - spec_.camera.eye);
        if (rays_.isPerspective() && !(seen.z > 0)) return;
        const double x = (seen.x + 1) / 2 * spec_.width, y = (1 - seen.y) / 2 * spec_.height;
        box_ = {std::min(box_.left, x), std::min(box_.top, y), std::max(box_.right, x), std::max(box_.bottom, y)};
    }
    [[nodiscard]] std::optional<PictureBox> box(double air) const {
        const PictureBox box{std::max(box_.left - air, 0.0), std::max(box_.top - air, 0.0),
                             std::min(box_.right + air, double(spec_.width)),
                             std::min(box_.bottom + air, double(spec_.height))};
        if (!(box.left < box.right && box.top < box.bottom)) return {};
        return box;
    }

private:
    const render::FrameSpec& spec_;
    render::CameraRays rays_;
    PictureBox box_{1e30, 1e30, -1e30, -1e30};
};

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
    const render::CameraRays from(spec, grid);
    SeenBox box(other, grid);
    for (std::int32_t y = 0; y < frame.depth.height(); ++y)
        for (std::int32_t x = 0; x < frame.depth.width(); ++x) {
            const double depth = double(frame.depth.at(x, y));
            if (std::isfinite(depth))
                box.add(from.worldAt(2 * (x + 0.5) / spec.width - 1, 1 - 2 * (y + 0.5) / spec.height, depth));
        }
    return box.box(0);
}

std::optional<PictureBox> boxOfSamples(const analyze::SampleBox& samples, const volume::Grid& grid,
                                       const render::FrameSpec& other) {
    SeenBox box(other, grid);
    for (int c = 0; c < 8; ++c)
        box.add(grid.worldFromIndex({(c & 1) != 0 ? samples.max.x + 0.5 : samples.min.x - 0.5,
                                     (c & 2) != 0 ? samples.max.y + 0.5 : samples.min.y - 0.5,
                                     (c & 4) != 0 ? samples.max.z + 0.5 : samples.min.z - 0.5}));
    return box.box(0.01 * other.height);
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
    std::vector<std::pair<Vec3d, Vec3d>> leaders;
    for (const double turns : {1.0, -1.0}) {
        const auto hull = plane::hullChain(corners, turns, [](const Corner& corner) { return corner.at; });
        for (std::size_t n = 1; n < hull.size(); ++n)
            if (hull[n - 1].ofA != hull[n].ofA) {
                const bool isForward = hull[n - 1].ofA;
                leaders.emplace_back(hull[isForward ? n - 1 : n].at, hull[isForward ? n : n - 1].at);
            }
    }
    return leaders;
}

InsetMarks findMarks(const render::Frame& inset, const render::FrameSpec& insetSpec, const render::Frame& picture,
                     const render::FrameSpec& spec, const volume::Grid& grid) {
    constexpr double kMost = 0.7, kSame = 0.95;
    const auto shown = boxOfSeen(inset, insetSpec, grid, spec), seen = boxOfSeen(picture, spec, grid, spec);
    const auto back = boxOfSeen(picture, spec, grid, insetSpec), all = boxOfSeen(inset, insetSpec, grid, insetSpec);
    const auto covers = [](const PictureBox& box, double share, const PictureBox& other) {
        return box.width() >= share * other.width() && box.height() >= share * other.height();
    };
    if (!shown || !seen || !back || !all || !covers(*shown, kMost, *seen)) return {shown, {}};
    // Where both show the same there is nothing to mark.
    if (covers(*back, kSame, *all)) return {};
    return {{}, back};
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
