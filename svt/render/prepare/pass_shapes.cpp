#include <svt/render/pass_shapes.hpp>

#include <svt/core/parallel.hpp>
#include <svt/image/color.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <unordered_set>

namespace svt::render {
namespace {

/// Width of the border around the picture for which shapes are binned, pixels; TileRenderer casts rays there for border
/// lines.
constexpr double kPictureMargin = 2;
/// Shorter lines are left out, pixels: those of distant round profiles would merge into blots.
constexpr double kShortest = 0.5;
/// Maximum entries in the lists of all tiles, and in those of all squares.
constexpr std::size_t kMaxEntries = std::size_t{1} << 26;

bool isOutside(double x, double y, double dx, double dy, double middleX, double middleY, double halfX, double halfY) {
    return std::abs(dx * (middleY - y) - dy * (middleX - x)) > std::abs(dx) * halfY + std::abs(dy) * halfX;
}

// Totals of the triangles of an object.
struct MeshTotals {
    double area = 0, volume = 0;  // m2, m3
    Vec3d turn;                   // sum of area vectors: zero for a closed mesh

    // The length of the way through matter that one face stands for, metres. A ray meets a body twice. Bodies thinner
    // than a sample have the opacity of one that is as thick as a sample.
    [[nodiscard]] double depthOfFace(double spacing) const noexcept {
        constexpr double kClosed = 1e-4;
        const bool isClosed = length(turn) < kClosed * area && volume > 0;
        return isClosed ? 0.5 * std::max(2 * volume / area, spacing) : spacing;
    }
};

// The share of light that a face of each translucent object stops: opacities are per metre.
class FaceOpacities {
public:
    FaceOpacities(const Pass& pass, std::span<const std::uint32_t> objectOfScalar, double spacing)
        : pass_(pass), objectOfScalar_(objectOfScalar), spacing_(spacing) {
        const Vec3d base = pass.triangles.front().corners[0];
        for (const MeshTriangle& triangle : pass.triangles) {
            if (!isTranslucent(triangle.scalar)) continue;
            const Vec3d a = triangle.corners[0] - base, b = triangle.corners[1] - base, c = triangle.corners[2] - base;
            const Vec3d across = cross(b - a, c - a) * 0.5;
            MeshTotals& totals = totals_[objectOf(triangle.scalar)];
            totals.area += length(across);
            totals.volume += dot(a, across) / 3;
            totals.turn = totals.turn + across;
        }
    }

    [[nodiscard]] double of(volume::Scalar scalar) const {
        const double perMetre = scalar < pass_.styles.size() ? double(pass_.styles[scalar].opacity) : 0;
        if (!isTranslucent(scalar)) return perMetre;
        const double depth = totals_.at(objectOf(scalar)).depthOfFace(spacing_);
        return -std::expm1(depth * std::log1p(-perMetre));
    }

private:
    [[nodiscard]] bool isTranslucent(volume::Scalar scalar) const noexcept {
        return scalar < pass_.styles.size() && pass_.styles[scalar].opacity > 0 && pass_.styles[scalar].opacity < 1;
    }
    [[nodiscard]] std::uint32_t objectOf(volume::Scalar scalar) const noexcept {
        return scalar < objectOfScalar_.size() ? objectOfScalar_[scalar] : scalar;
    }

    const Pass& pass_;
    std::span<const std::uint32_t> objectOfScalar_;
    double spacing_;
    std::unordered_map<std::uint32_t, MeshTotals> totals_;
};

}  // namespace

Pass makeVoxelPass(const Pass& pass, std::span<const std::uint32_t> objectOfScalar) {
    const auto objectOf = [&](std::size_t scalar) {
        return scalar < objectOfScalar.size() ? objectOfScalar[scalar] : static_cast<std::uint32_t>(scalar);
    };
    std::unordered_set<std::uint32_t> objects;
    for (const MeshTriangle& triangle : pass.triangles) objects.insert(objectOf(triangle.scalar));
    Pass voxels;
    voxels.styles = pass.styles;
    for (std::size_t scalar = 0; scalar < voxels.styles.size(); ++scalar)
        if (objects.count(objectOf(scalar)) != 0) voxels.styles[scalar].opacity = 0;
    return voxels;
}

Result<PassShapes> PassShapes::make(const Pass& pass, const FrameSpec& spec, const CameraRays& rays,
                                    const volume::Grid& grid, const Clipper& clipper, double samplesPerPixel,
                                    double margin, int threads) {
    PassShapes shapes;
    if (pass.lines.empty() && pass.triangles.empty()) return shapes;
    shapes.width_ = spec.width;
    shapes.height_ = spec.height;
    shapes.margin_ = std::fmod(margin, kSquarePixels);
    // Near clipping distance: a millionth of the distance to the camera's target.
    const double nearest = 1e-6 * length(spec.camera.target - spec.camera.eye);
    for (const LineSet& set : pass.lines) {
        const double half = double(set.width) / 2;
        shapes.lineStyles_.push_back({toDouble(image::linearFromSrgb(set.color)), half,
                                      std::min(1.0, 2 * half * samplesPerPixel), double(set.hiddenOpacity),
                                      double(set.dash), double(set.dash) + double(set.gap), set.hidden});
        shapes.reach_ = std::max(shapes.reach_, half + 0.5);
    }
    shapes.addLines(pass, spec, rays, grid, clipper);
    const Vec3d spacing = grid.spacing();
    shapes.addTriangles(pass, spec, rays, nearest, std::max({spacing.x, spacing.y, spacing.z}));
    if (shapes.lines_.empty() && shapes.triangles_.empty()) return PassShapes();
    SVT_DO(shapes.sortIntoTiles(threads));
    return shapes;
}

void PassShapes::addLines(const Pass& pass, const FrameSpec& spec, const CameraRays& rays, const volume::Grid& grid,
                          const Clipper& clipper) {
    const double nearest = 1e-6 * length(spec.camera.target - spec.camera.eye);
    for (std::uint32_t style = 0; style < pass.lines.size(); ++style) {
        const LineSet& set = pass.lines[style];
        const std::size_t first = lines_.size();
        for (const Line& line : set.lines) {
            const bool isShown = line.scalar < pass.styles.size() && pass.styles[line.scalar].opacity > 0;
            if (!isShown && !set.withHiddenLabels) continue;
            const Vec3d along = line.to - line.from, fromEye = line.from - spec.camera.eye;
            if (!(length(along) > 0)) continue;
            if (clipper.isEmpty()) {
                addLine(fromEye, fromEye + along, rays, nearest);
                continue;
            }
            // Clip the line as a ray with t in [0, 1).
            const Vec3d half{0.5, 0.5, 0.5};
            const VoxelRay ray(grid.indexFromWorld(line.from) + half, grid.indexFromWorldDirection(along));
            for (const DrawnInterval& part : clipper.cut(ray, {0, 1}))
                addLine(fromEye + along * part.from, fromEye + along * part.to, rays, nearest);
        }
        for (std::size_t l = first; l < lines_.size(); ++l) lines_[l].style = style;
    }
}

// Adds a line; `from` and `to` are relative to the eye.
void PassShapes::addLine(Vec3d from, Vec3d to, const CameraRays& rays, double nearest) {
    double depth = dot(from, rays.forward()), farDepth = dot(to, rays.forward());
    if (depth < nearest && farDepth < nearest) return;
    const Vec3d along = to - from;
    const double rise = farDepth - depth;
    if (depth < nearest) {
        from = from + along * ((nearest - depth) / rise);
        depth = nearest;
    } else if (farDepth < nearest) {
        to = from + along * ((nearest - depth) / rise);
        farDepth = nearest;
    }
    const Vec3d a = rays.seenAt(from), b = rays.seenAt(to);
    PictureLine line{};
    line.x = (a.x + 1) / 2 * width_;
    line.y = (1 - a.y) / 2 * height_;
    line.dx = (b.x - a.x) / 2 * width_;
    line.dy = (a.y - b.y) / 2 * height_;
    const double squared = line.dx * line.dx + line.dy * line.dy;
    if (!(squared >= kShortest * kShortest)) return;
    line.perSquaredLength = 1 / squared;
    line.length = std::sqrt(squared);
    line.depth = rays.isPerspective() ? 1 / depth : depth;
    line.depthChange = (rays.isPerspective() ? 1 / farDepth : farDepth) - line.depth;
    if (std::isfinite(line.x) && std::isfinite(line.y) && std::isfinite(squared)) lines_.push_back(line);
}

void PassShapes::addTriangles(const Pass& pass, const FrameSpec& spec, const CameraRays& rays, double nearest,
                              double spacing) {
    if (pass.triangles.empty()) return;
    const FaceOpacities opacities(pass, spec.objectOfScalar, spacing);
    const PassTable styles(pass, spec.objectOfScalar, pass.styles.size());
    for (const MeshTriangle& source : pass.triangles) {
        const LinearStyle& style = styles[source.scalar];
        if (style.kind == LinearStyle::Kind::Hidden) continue;
        PictureTriangle triangle{};
        for (std::size_t c = 0; c < 3; ++c) triangle.corners[c] = source.corners[c] - spec.camera.eye;
        const Vec3d across = cross(source.corners[1] - source.corners[0], source.corners[2] - source.corners[0]);
        if (!(length(across) > 0)) continue;
        triangle.normal = normalized(across);
        triangle.style = style;
        triangle.opacity = opacities.of(source.scalar);
        std::array<double, 6> outline{};
        int behind = 0;
        for (std::size_t c = 0; c < 3; ++c) {
            if (dot(triangle.corners[c], rays.forward()) < nearest) {
                ++behind;
                continue;
            }
            const Vec3d seen = rays.seenAt(triangle.corners[c]);
            outline[2 * c] = (seen.x + 1) / 2 * width_;
            outline[2 * c + 1] = (1 - seen.y) / 2 * height_;
        }
        if (behind == 3) continue;
        if (behind > 0) outline.fill(0);
        const Square bounds = boundsOf(outline);
        triangle.left = bounds.left;
        triangle.top = bounds.top;
        triangle.right = bounds.right;
        triangle.bottom = bounds.bottom;
        triangles_.push_back(triangle);
        outlines_.push_back(outline);
    }
}

bool PassShapes::hasAnyIn(std::int32_t x0, std::int32_t y0, std::int32_t x1, std::int32_t y1) const noexcept {
    constexpr std::int32_t kMany = 16;
    if (x1 - x0 > kMany || y1 - y0 > kMany) return true;
    for (std::int32_t y = y0; y <= y1; ++y)
        for (std::int32_t x = x0; x <= x1; ++x)
            if (!inSquare(x, y).empty()) return true;
    return false;
}

std::span<const std::uint32_t> PassShapes::linesIn(std::int32_t x0, std::int32_t y0, std::int32_t x1, std::int32_t y1,
                                                   std::vector<std::uint32_t>& buffer) const {
    const auto linesOf = [&](std::int32_t x, std::int32_t y) {
        auto shapes = inSquare(x, y);
        while (!shapes.empty() && shapes.back() >= kTriangle) shapes = shapes.first(shapes.size() - 1);
        return shapes;
    };
    if (x0 == x1 && y0 == y1) return linesOf(x0, y0);
    buffer.clear();
    for (std::int32_t y = y0; y <= y1; ++y)
        for (std::int32_t x = x0; x <= x1; ++x) {
            const auto lines = linesOf(x, y);
            buffer.insert(buffer.end(), lines.begin(), lines.end());
        }
    std::sort(buffer.begin(), buffer.end());
    buffer.erase(std::unique(buffer.begin(), buffer.end()), buffer.end());
    return buffer;
}

PassShapes::Square PassShapes::boundsOf(std::uint32_t shape) const noexcept {
    if (shape < kTriangle) {
        const PictureLine& line = lines_[shape];
        const double reach = lineStyles_[line.style].halfWidth + 0.5;
        return {std::min(line.x, line.x + line.dx) - reach, std::min(line.y, line.y + line.dy) - reach,
                std::max(line.x, line.x + line.dx) + reach, std::max(line.y, line.y + line.dy) + reach};
    }
    const PictureTriangle& triangle = triangles_[shape - kTriangle];
    return {triangle.left, triangle.top, triangle.right, triangle.bottom};
}

PassShapes::Square PassShapes::boundsOf(const std::array<double, 6>& o) noexcept {
    if (o == std::array<double, 6>{}) return {-kInfinity, -kInfinity, kInfinity, kInfinity};
    constexpr double kRounding = 0.01;
    return {std::min({o[0], o[2], o[4]}) - kRounding, std::min({o[1], o[3], o[5]}) - kRounding,
            std::max({o[0], o[2], o[4]}) + kRounding, std::max({o[1], o[3], o[5]}) + kRounding};
}

// Separating axis test; the bounds are known to overlap.
bool PassShapes::touches(std::uint32_t shape, const Square& square) const noexcept {
    const double middleX = (square.left + square.right) / 2, middleY = (square.top + square.bottom) / 2;
    const double halfX = (square.right - square.left) / 2, halfY = (square.bottom - square.top) / 2;
    if (shape < kTriangle) {
        const PictureLine& line = lines_[shape];
        const double reach = lineStyles_[line.style].halfWidth + 0.5;
        return !isOutside(line.x, line.y, line.dx, line.dy, middleX, middleY, halfX + reach, halfY + reach);
    }
    const std::array<double, 6>& o = outlines_[shape - kTriangle];
    const double area = (o[2] - o[0]) * (o[5] - o[1]) - (o[3] - o[1]) * (o[4] - o[0]);
    if (area == 0) return true;
    constexpr double kRounding = 0.01;
    for (std::size_t c = 0; c < 3; ++c) {
        const double x = o[2 * c], y = o[2 * c + 1], dx = o[(2 * c + 2) % 6] - x, dy = o[(2 * c + 3) % 6] - y;
        const double side = dx * (middleY - y) - dy * (middleX - x);
        const double reach = std::abs(dx) * (halfY + kRounding) + std::abs(dy) * (halfX + kRounding);
        if ((area > 0 ? side : -side) < -reach) return false;
    }
    return true;
}

Result<void> PassShapes::sortIntoTiles(int threads) {
    const auto up = [](double pixels, std::int32_t step) {
        return (static_cast<std::int32_t>(pixels) + step - 1) / step;
    };
    squaresX_ = up(std::ceil(width_ + margin_), kSquarePixels);
    squaresY_ = up(std::ceil(height_ + margin_), kSquarePixels);
    tilesX_ = up(squaresX_, kTileSquares);
    tilesY_ = up(squaresY_, kTileSquares);
    tiles_.resize(static_cast<std::size_t>(tilesX_) * static_cast<std::size_t>(tilesY_));
    std::size_t entries = 0;
    const auto add = [&](std::uint32_t shape) {
        const Square bounds = boundsOf(shape);
        if (!(bounds.right >= -kPictureMargin && bounds.bottom >= -kPictureMargin &&
              bounds.left <= width_ + kPictureMargin && bounds.top <= height_ + kPictureMargin))
            return;
        const auto tileAt = [this](double pixel, std::int32_t count) {
            return static_cast<std::int32_t>(std::clamp((pixel + margin_) / kTilePixels, 0.0, count - 1.0));
        };
        const std::int32_t endX = tileAt(bounds.right, tilesX_), endY = tileAt(bounds.bottom, tilesY_);
        for (std::int32_t y = tileAt(bounds.top, tilesY_); y <= endY; ++y)
            for (std::int32_t x = tileAt(bounds.left, tilesX_); x <= endX; ++x) {
                const Square square{beginOf(x, kTilePixels) - kPictureMargin, beginOf(y, kTilePixels) - kPictureMargin,
                                    beginOf(x + 1, kTilePixels) + kPictureMargin,
                                    beginOf(y + 1, kTilePixels) + kPictureMargin};
                if (!touches(shape, square)) continue;
                tiles_[static_cast<std::size_t>(x + tilesX_ * y)].shapes.push_back(shape);
                ++entries;
            }
    };
    const auto addAll = [&](std::size_t count, std::uint32_t first) {
        for (std::size_t n = 0; n < count && entries <= kMaxEntries; ++n) add(first + static_cast<std::uint32_t>(n));
    };
    addAll(lines_.size(), 0);
    addAll(triangles_.size(), kTriangle);
    if (entries > kMaxEntries)
        return Error(Code::BadFrame, fmt::format("{} lines and {} triangles cover the picture too often; draw fewer of "
                                                 "them, or a smaller picture",
                                                 lines_.size(), triangles_.size()));
    const std::size_t most = kMaxEntries / tiles_.size();
    parallelFor(tiles_.size(), 16, threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t t = begin; t < end; ++t)
            sortIntoSquares(tiles_[t], static_cast<std::int32_t>(t) % tilesX_, static_cast<std::int32_t>(t) / tilesX_,
                            most);
    });
    return {};
}

// Range of x that a line covers between two rows of pixels; empty if first > second.
std::pair<double, double> PassShapes::spanOf(const PictureLine& line, double top, double bottom) const noexcept {
    constexpr double kRounding = 0.01;
    const double reach = lineStyles_[line.style].halfWidth + 0.5 + kRounding;
    double begin = 0, end = 1;
    if (std::abs(line.dy) > 1e-9) {
        const double a = (top - reach - line.y) / line.dy, b = (bottom + reach - line.y) / line.dy;
        begin = std::max(begin, std::min(a, b));
        end = std::min(end, std::max(a, b));
    }
    if (begin > end) return {kInfinity, -kInfinity};
    const double a = line.x + line.dx * begin, b = line.x + line.dx * end;
    return {std::min(a, b) - reach, std::max(a, b) + reach};
}

// Bins the shapes of a tile into its squares. Squares at the border of the picture also serve rays outside of it.
void PassShapes::sortIntoSquares(Tile& tile, std::int32_t tileX, std::int32_t tileY, std::size_t most) const {
    constexpr std::size_t kSquares = std::size_t{kTileSquares} * kTileSquares;
    if (tile.shapes.empty() || tile.shapes.size() * kSquares > std::max<std::size_t>(most, kSquares)) return;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> found;  // square, shape
    for (const std::uint32_t shape : tile.shapes) {
        const Square bounds = boundsOf(shape);
        const auto squareAt = [this](double pixel, std::int32_t tileAt) {
            return static_cast<std::int32_t>(std::clamp(
                std::floor((pixel - beginOf(tileAt, kTilePixels)) / kSquarePixels), 0.0, kTileSquares - 1.0));
        };
        const std::int32_t endX = squareAt(bounds.right + kPictureMargin, tileX),
                           endY = squareAt(bounds.bottom + kPictureMargin, tileY);
        if (shape < kTriangle) {
            // Row by row of squares.
            const double left = beginOf(tileX, kTilePixels), right = left + kTilePixels;
            for (std::int32_t y = squareAt(bounds.top - kPictureMargin, tileY); y <= endY; ++y) {
                const std::int32_t row = tileY * kTileSquares + y;
                const double squareTop = beginOf(row, kSquarePixels) - (row == 0 ? kPictureMargin : 0);
                const double squareBottom =
                    beginOf(row + 1, kSquarePixels) + (row >= squaresY_ - 1 ? kPictureMargin : 0);
                const auto [first, last] = spanOf(lines_[shape], squareTop, squareBottom);
                if (!(last >= left - kPictureMargin && first <= right + kPictureMargin)) continue;
                const std::int32_t end = squareAt(last, tileX);
                for (std::int32_t x = squareAt(first, tileX); x <= end; ++x)
                    found.emplace_back(static_cast<std::uint32_t>(x + kTileSquares * y), shape);
            }
            continue;
        }
        for (std::int32_t y = squareAt(bounds.top - kPictureMargin, tileY); y <= endY; ++y)
            for (std::int32_t x = squareAt(bounds.left - kPictureMargin, tileX); x <= endX; ++x) {
                Square square{beginOf(tileX * kTileSquares + x, kSquarePixels),
                              beginOf(tileY * kTileSquares + y, kSquarePixels), 0, 0};
                square.right = square.left + kSquarePixels;
                square.bottom = square.top + kSquarePixels;
                const std::int32_t squareX = tileX * kTileSquares + x, squareY = tileY * kTileSquares + y;
                if (squareX == 0) square.left -= kPictureMargin;
                if (squareY == 0) square.top -= kPictureMargin;
                if (squareX >= squaresX_ - 1) square.right += kPictureMargin;
                if (squareY >= squaresY_ - 1) square.bottom += kPictureMargin;
                const bool isApart = bounds.right < square.left || bounds.left > square.right ||
                                     bounds.bottom < square.top || bounds.top > square.bottom;
                if (!isApart && touches(shape, square))
                    found.emplace_back(static_cast<std::uint32_t>(x + kTileSquares * y), shape);
            }
    }
    tile.starts.assign(kSquares + 1, 0);
    for (const auto& [square, shape] : found) ++tile.starts[square + 1];
    for (std::size_t square = 0; square < kSquares; ++square) tile.starts[square + 1] += tile.starts[square];
    std::vector<std::uint32_t> at(tile.starts.begin(), tile.starts.end() - 1), sorted(found.size());
    for (const auto& [square, shape] : found) sorted[at[square]++] = shape;
    tile.shapes = std::move(sorted);
}

}  // namespace svt::render
