#include <svt/render/light/fragments.hpp>
#include <svt/render/light/surface_light.hpp>
#include <svt/render/picture_constants.hpp>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace svt::render {
namespace {

using Kind = LinearStyle::Kind;

bool isBefore(const Fragment& a, const Fragment& b) noexcept { return a.depth < b.depth; }

bool isDrawn(std::span<const DrawnInterval> drawn, double depth) noexcept {
    return std::any_of(drawn.begin(), drawn.end(),
                       [&](const DrawnInterval& interval) { return interval.from <= depth && depth < interval.to; });
}

}  // namespace

FragmentFinder::FragmentFinder(const PreparedFrame& frame) : frame_(frame) {}

LineView FragmentFinder::viewOf(std::size_t pass) const noexcept {
    const CameraRays& rays = frame_.rays();
    return {rays.isPerspective(), frame_.lineSamples, rays.pixelSize(1),
            kVoxelsBefore * frame_.volumeOf(pass).voxelSize};
}

std::span<LineHit> FragmentFinder::findLines(std::size_t pass, const double* u, const double* v,
                                             std::array<std::size_t, kLineRays + 1>& starts) {
    const PassShapes& shapes = frame_.passes[pass].shapes;
    starts.fill(0);
    double x[kLineRays], y[kLineRays];
    for (std::size_t n = 0; n < kLineRays; ++n) {
        x[n] = (u[n] + 1) / 2 * shapes.width();
        y[n] = (1 - v[n]) / 2 * shapes.height();
    }
    const std::span<const std::uint32_t> near = shapes.linesNear(x, y, near_);
    if (near.empty()) return {};
    if (lineHits_.size() < kLineRays * near.size()) lineHits_.resize(2 * kLineRays * near.size());
    const std::size_t count = render::findLines(viewOf(pass), shapes.lines().data(), shapes.lineStyles().data(), near,
                                                x, y, lineHits_.data());
    for (std::size_t h = 0; h < count; ++h) ++starts[lineHits_[h].ray + 1];
    for (std::size_t n = 0; n < kLineRays; ++n) starts[n + 1] += starts[n];
    if (sortedHits_.size() < count) sortedHits_.resize(2 * count);
    std::array<std::size_t, kLineRays + 1> at = starts;
    for (std::size_t h = 0; h < count; ++h) sortedHits_[at[lineHits_[h].ray]++] = lineHits_[h];
    return std::span(sortedHits_).first(count);
}

std::span<LineHit> FragmentFinder::findLines(std::size_t pass, double u, double v) {
    const PassShapes& shapes = frame_.passes[pass].shapes;
    const double x = (u + 1) / 2 * shapes.width(), y = (1 - v) / 2 * shapes.height();
    lineHits_.clear();
    LineHit hit{};
    const LineView view = viewOf(pass);
    for (const std::uint32_t shape : shapes.near(u, v)) {
        if (shape >= PassShapes::kTriangle) break;
        const PictureLine& line = shapes.lines()[shape];
        if (findLine(view, line, shapes.lineStyles()[line.style], shape, x, y, hit)) lineHits_.push_back(hit);
    }
    return lineHits_;
}

// Lines near in depth count as one, as strong as the strongest.
void FragmentFinder::addLines(std::size_t pass, std::span<LineHit> hits, Fragments& fragments) const {
    if (hits.empty()) return;
    const PassShapes& shapes = frame_.passes[pass].shapes;
    const double voxelSize = frame_.volumeOf(pass).voxelSize;
    // Insertion sort: there are few.
    for (std::size_t n = 1; n < hits.size(); ++n) {
        const auto isNearer = [](const LineHit& a, const LineHit& b) {
            return a.depth < b.depth || (a.depth == b.depth && a.line < b.line);
        };
        if (!isNearer(hits[n], hits[n - 1])) continue;
        const LineHit hit = hits[n];
        std::size_t at = n;
        for (; at > 0 && isNearer(hit, hits[at - 1]); --at) hits[at] = hits[at - 1];
        hits[at] = hit;
    }
    for (std::size_t begin = 0; begin < hits.size();) {
        LineHit joined = hits[begin];
        std::size_t end = begin + 1;
        for (; end < hits.size() && hits[end].depth - joined.depth <= kVoxelsTogether * voxelSize; ++end) {
            if (hits[end].opacity > joined.opacity) {
                joined.opacity = hits[end].opacity;
                joined.line = hits[end].line;
            }
            joined.hidden = std::max(joined.hidden, hits[end].hidden);
        }
        begin = end;
        const LineStyle& style = shapes.lineStyles()[shapes.lines()[joined.line].style];
        fragments.items.push_back({joined.depth, joined.opacity, joined.hidden, style.color});
    }
}

// Watertight: for the neighbouring triangle, the side test of a shared edge is the same expression with the opposite
// sign, so no ray passes between them.
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

// Sorts by depth; hits of two triangles on their shared edge become one.
void FragmentFinder::sortHits(const PassShapes& shapes) {
    std::sort(hits_.begin(), hits_.end(),
              [](const Hit& a, const Hit& b) { return std::tie(a.depth, a.triangle) < std::tie(b.depth, b.triangle); });
    const auto isSame = [&](const Hit& a, const Hit& b) {
        return a.isEntering == b.isEntering && b.depth - a.depth <= 1e-9 * b.depth &&
               shapes.triangle(a.triangle).style.object == shapes.triangle(b.triangle).style.object;
    };
    hits_.erase(std::unique(hits_.begin(), hits_.end(), isSame), hits_.end());
}

double FragmentFinder::addSurfaces(std::size_t pass, double u, double v, const CameraRay& ray,
                                   std::span<const DrawnInterval> drawn, std::size_t first, Fragments& fragments) {
    const PassShapes& shapes = frame_.passes[pass].shapes;
    const auto near = shapes.near(u, v);
    if (near.empty() || near.back() < PassShapes::kTriangle) return kInfinity;
    Vec3d origin{};
    if (!frame_.rays().isPerspective()) {
        const CameraRays::Basis basis = frame_.rays().basis();
        origin = basis.right * (u * basis.halfWidth) + basis.up * (v * basis.halfHeight);
    }
    hits_.clear();
    const double x = (u + 1) / 2 * shapes.width(), y = (1 - v) / 2 * shapes.height();
    for (const std::uint32_t shape : near) {
        if (shape < PassShapes::kTriangle) continue;
        const PictureTriangle& triangle = shapes.triangle(shape - PassShapes::kTriangle);
        if (x < triangle.left || x > triangle.right || y < triangle.top || y > triangle.bottom) continue;
        addHit(triangle, shape - PassShapes::kTriangle, origin, ray.direction);
    }
    if (hits_.empty()) return kInfinity;
    sortHits(shapes);
    double end = kInfinity;
    for (const DrawnInterval& interval : drawn) {
        if (!interval.cap) continue;
        const PictureTriangle* body = findCutBody(shapes, interval.from);
        if (body == nullptr || body->style.kind != Kind::Opaque) continue;
        const Vec3d up = interval.cap.normalAt(frame_.volumeOf(pass).grid.worldFromIndex(
            ray.voxelRay.origin + ray.voxelRay.direction * interval.from - Vec3d{0.5, 0.5, 0.5}));
        addSurface(pass, ray, *body, interval.from, dot(up, ray.direction) > 0 ? -up : up, true, fragments);
        end = interval.from;
        break;
    }
    for (const Hit& hit : hits_) {
        if (hit.depth >= end) break;
        if (!isDrawn(drawn, hit.depth)) continue;
        const PictureTriangle& triangle = shapes.triangle(hit.triangle);
        addSurface(pass, ray, triangle, hit.depth, hit.isEntering ? triangle.normal : -triangle.normal, false,
                   fragments);
        if (triangle.style.kind == Kind::Opaque) end = hit.depth;
    }
    std::stable_sort(fragments.items.begin() + static_cast<std::ptrdiff_t>(first), fragments.items.end(), isBefore);
    return end;
}

// Finds the body that the ray is inside at a depth: the one entered last; null if there is no such body. An object that
// the ray does not enter as often as it leaves it is an open sheet, not a body.
const PictureTriangle* FragmentFinder::findCutBody(const PassShapes& shapes, double depth) {
    bodies_.clear();
    for (const Hit& hit : hits_) {
        const std::uint32_t object = shapes.triangle(hit.triangle).style.object;
        auto known = std::find_if(bodies_.begin(), bodies_.end(), [&](const Body& b) { return b.object == object; });
        if (known == bodies_.end()) known = bodies_.insert(known, Body{object});
        const int step = hit.isEntering ? 1 : -1;
        known->balance += step;
        if (hit.depth > depth) continue;
        known->inside += step;
        if (hit.isEntering) known->entered = &shapes.triangle(hit.triangle);
        known->order = &hit - hits_.data();
    }
    const Body* last = nullptr;
    for (const Body& body : bodies_)
        if (body.balance == 0 && body.inside > 0 && (last == nullptr || body.order > last->order)) last = &body;
    return last == nullptr ? nullptr : last->entered;
}

void FragmentFinder::addSurface(std::size_t pass, const CameraRay& ray, const PictureTriangle& triangle, double depth,
                                Vec3d normal, bool isCap, Fragments& fragments) {
    const LinearStyle& style = triangle.style;
    const SurfaceLight lights(frame_, pass, cache_);
    const double lit = lights.lightSurface(style, normal, normalized(-ray.direction),
                                           ray.voxelRay.origin + ray.voxelRay.direction * depth);
    const double light = 1 + (lit - 1) * double(style.surface);
    const auto number = static_cast<std::int32_t>(fragments.surfaces.size());
    fragments.surfaces.push_back({style.label, style.object, normal, isCap});
    const PreparedVolume& volume = frame_.volumeOf(pass);
    Vec3f color = style.color;
    if (volume.paint != nullptr && style.kind == Kind::Opaque) {
        const Vec3d index = ray.voxelRay.origin + ray.voxelRay.direction * depth - Vec3d{0.5, 0.5, 0.5};
        color = volume.paint->colorAt({static_cast<std::uint32_t>(pass), style.label, depth,
                                       volume.grid.worldFromIndex(index), normal, isCap, color});
    }
    fragments.items.push_back({depth, triangle.opacity, 0, toDouble(color) * light, number});
}

}  // namespace svt::render
