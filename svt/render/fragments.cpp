#include <svt/render/fragments.hpp>
#include <svt/render/surface_light.hpp>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace svt::render {
namespace {

using Kind = LinearStyle::Kind;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Lines lie before what is so near behind them: voxels, and half widths of the line.
constexpr double kVoxelsBefore = 1.5, kWidthsBefore = 4;

bool isBefore(const Fragment& a, const Fragment& b) noexcept { return a.depth < b.depth; }

bool isDrawn(std::span<const DrawnInterval> drawn, double depth) noexcept {
    return std::any_of(drawn.begin(), drawn.end(),
                       [&](const DrawnInterval& interval) { return interval.from <= depth && depth < interval.to; });
}

}  // namespace

FragmentFinder::FragmentFinder(const Scene& scene)
    : scene_(scene),
      perPixel_(std::round(std::sqrt(scene.spec.samplesPerPixel))),
      voxelSize_(std::max({scene.grid.spacing().x, scene.grid.spacing().y, scene.grid.spacing().z})) {}

double FragmentFinder::find(std::size_t pass, double u, double v, const CameraRay& ray,
                            std::span<const DrawnInterval> drawn, bool withLines, std::vector<Fragment>& fragments) {
    const PassShapes& shapes = scene_.passes[pass].shapes;
    const std::size_t first = fragments.size();
    const double x = (u + 1) / 2 * shapes.width(), y = (1 - v) / 2 * shapes.height();
    Vec3d origin{};
    if (!scene_.rays.isPerspective()) {
        const CameraRays::Basis basis = scene_.rays.basis();
        origin = basis.right * (u * basis.halfWidth) + basis.up * (v * basis.halfHeight);
    }
    hits_.clear();
    for (const std::uint32_t shape : shapes.near(u, v)) {
        if (shape >= PassShapes::kTriangle)
            addHit(shapes.triangle(shape - PassShapes::kTriangle), shape - PassShapes::kTriangle, origin,
                   ray.direction);
        else if (withLines)
            addLine(shapes, shapes.line(shape), x, y, fragments);
    }
    joinLines(first, fragments);
    if (hits_.empty()) return kInfinity;
    const double end = addSurfaces(pass, ray, drawn, fragments);
    std::stable_sort(fragments.begin() + static_cast<std::ptrdiff_t>(first), fragments.end(), isBefore);
    return end;
}

void FragmentFinder::addLine(const PassShapes& shapes, const PictureLine& line, double x, double y,
                             std::vector<Fragment>& fragments) const {
    const LineLook& look = shapes.look(line.look);
    const double asideX = x - line.x, asideY = y - line.y;
    const double along = std::clamp((asideX * line.dx + asideY * line.dy) * line.perSquaredLength, 0.0, 1.0);
    const double offX = asideX - along * line.dx, offY = asideY - along * line.dy;
    const double distance = std::sqrt(offX * offX + offY * offY);
    const double coverage = std::min((look.halfWidth - distance) * perPixel_ + 0.5, look.darkest);
    if (!(coverage > 0)) return;
    const double place = line.depth + line.depthChange * along;
    const double depth = scene_.rays.isPerspective() ? 1 / place : place;
    const double before = kVoxelsBefore * voxelSize_ + kWidthsBefore * look.halfWidth * scene_.rays.pixelSize(depth);
    double hidden = look.hidden == HiddenLines::None ? 0 : coverage * look.hiddenOpacity;
    if (look.hidden == HiddenLines::Dashed) {
        const double pixels = along * std::sqrt(line.dx * line.dx + line.dy * line.dy);
        if (pixels - std::floor(pixels / look.period) * look.period > look.dash) hidden = 0;
    }
    fragments.push_back({std::max(depth - before, 0.0), look.color, coverage, hidden, true});
}

// Lines at one depth are one line, as strong as the strongest.
void FragmentFinder::joinLines(std::size_t first, std::vector<Fragment>& fragments) const {
    if (fragments.size() < first + 2) return;
    std::stable_sort(fragments.begin() + static_cast<std::ptrdiff_t>(first), fragments.end(), isBefore);
    std::size_t last = first;
    for (std::size_t n = first + 1; n < fragments.size(); ++n) {
        Fragment& joined = fragments[last];
        const Fragment& next = fragments[n];
        if (next.depth - joined.depth > 2 * voxelSize_) {
            fragments[++last] = next;
            continue;
        }
        if (next.opacity > joined.opacity) {
            joined.opacity = next.opacity;
            joined.color = next.color;
        }
        joined.hidden = std::max(joined.hidden, next.hidden);
    }
    fragments.resize(last + 1);
}

// On which side of each edge the ray passes is the same expression, with the other sign, for the triangle beyond: no
// ray slips through between them.
void FragmentFinder::addHit(const PictureTriangle& triangle, std::uint32_t number, Vec3d origin, Vec3d direction) {
    const Vec3d a = triangle.corners[0] - origin, b = triangle.corners[1] - origin, c = triangle.corners[2] - origin;
    const double sideA = dot(direction, cross(b, c)), sideB = dot(direction, cross(c, a)),
                 sideC = dot(direction, cross(a, b));
    const bool isInside = (sideA >= 0 && sideB >= 0 && sideC >= 0) || (sideA <= 0 && sideB <= 0 && sideC <= 0);
    const double facing = dot(triangle.normal, direction);
    if (!isInside || facing == 0) return;
    const double depth = dot(triangle.normal, a) / facing;
    if (depth > 0 && depth < kInfinity) hits_.push_back({depth, number, facing < 0});
}

// By depth; a ray that meets the edge between two triangles meets one surface.
void FragmentFinder::sortHits(const PassShapes& shapes) {
    std::sort(hits_.begin(), hits_.end(),
              [](const Hit& a, const Hit& b) { return std::tie(a.depth, a.triangle) < std::tie(b.depth, b.triangle); });
    const auto isSame = [&](const Hit& a, const Hit& b) {
        return a.isEntering == b.isEntering && b.depth - a.depth <= 1e-9 * b.depth &&
               shapes.triangle(a.triangle).style.object == shapes.triangle(b.triangle).style.object;
    };
    hits_.erase(std::unique(hits_.begin(), hits_.end(), isSame), hits_.end());
}

double FragmentFinder::addSurfaces(std::size_t pass, const CameraRay& ray, std::span<const DrawnInterval> drawn,
                                   std::vector<Fragment>& fragments) {
    const PassShapes& shapes = scene_.passes[pass].shapes;
    sortHits(shapes);
    double end = kInfinity;
    for (const DrawnInterval& interval : drawn) {
        if (interval.capPlane == nullptr) continue;
        const PictureTriangle* body = cutOpen(shapes, interval.from);
        if (body == nullptr || body->style.kind != Kind::Opaque) continue;
        const Vec3d up = normalized(interval.capPlane->normal);
        Fragment cap = surface(pass, ray, *body, interval.from, dot(up, ray.direction) > 0 ? -up : up);
        cap.isCap = true;
        fragments.push_back(cap);
        end = interval.from;
        break;
    }
    for (const Hit& hit : hits_) {
        if (hit.depth >= end) break;
        if (!isDrawn(drawn, hit.depth)) continue;
        const PictureTriangle& triangle = shapes.triangle(hit.triangle);
        fragments.push_back(
            surface(pass, ray, triangle, hit.depth, hit.isEntering ? triangle.normal : -triangle.normal));
        if (triangle.style.kind == Kind::Opaque) end = hit.depth;
    }
    return end;
}

// The body that the ray is in at a depth, by which it has entered and left before; null if in none.
const PictureTriangle* FragmentFinder::cutOpen(const PassShapes& shapes, double depth) {
    inside_.clear();
    const PictureTriangle* body = nullptr;
    for (const Hit& hit : hits_) {
        if (hit.depth > depth) break;
        const PictureTriangle& triangle = shapes.triangle(hit.triangle);
        auto known = std::find_if(inside_.begin(), inside_.end(),
                                  [&](const auto& entry) { return entry.first == triangle.style.object; });
        if (known == inside_.end()) known = inside_.insert(known, {triangle.style.object, 0});
        known->second += hit.isEntering ? 1 : -1;
        if (hit.isEntering)
            body = &triangle;
        else if (body != nullptr && body->style.object == triangle.style.object && known->second <= 0)
            body = nullptr;
    }
    return body;
}

Fragment FragmentFinder::surface(std::size_t pass, const CameraRay& ray, const PictureTriangle& triangle, double depth,
                                 Vec3d normal) {
    const LinearStyle& style = triangle.style;
    const SurfaceLight lights(scene_, pass, cache_);
    const double lit =
        lights.on(style, normal, normalized(-ray.direction), ray.index.origin + ray.index.direction * depth);
    const double light = 1 + (lit - 1) * double(style.surface);
    return {depth,
            Vec3d{style.color.x, style.color.y, style.color.z} * light,
            triangle.opacity,
            0,
            false,
            false,
            style.label,
            style.object,
            normal};
}

}  // namespace svt::render
