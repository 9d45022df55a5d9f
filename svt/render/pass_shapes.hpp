#pragma once
/// \file
/// The lines and triangles of a pass in picture space, sorted into squares of the picture, so that a ray finds those
/// near it. For renderers: used by render and render_gl.

#include <svt/core/result.hpp>
#include <svt/render/camera_rays.hpp>
#include <svt/render/clip_intervals.hpp>
#include <svt/render/frame_spec.hpp>
#include <svt/render/pass_table.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace svt::render {

/// A line projected into the picture, after clipping by the clips and the eye plane.
struct PictureLine {
    double x, y, dx, dy;        ///< pixels from the picture's upper left corner: start point, and vector to the end
    double perSquaredLength;    ///< 1 / (dx^2 + dy^2)
    double depth, depthChange;  ///< at the start, and end minus start; of 1 / depth, or of depth if orthographic
    double length;              ///< pixels
    std::uint32_t style;        ///< index into PassShapes::lineStyles()
};

/// Style of a set of lines.
struct LineStyle {
    Vec3d color;                ///< linear light
    double halfWidth, darkest;  ///< pixels; largest coverage
    double hiddenOpacity, dash, period;
    HiddenLines hidden;
};

/// A triangle, prepared for intersection. World space relative to the eye, metres.
struct PictureTriangle {
    std::array<Vec3d, 3> corners;
    Vec3d normal;                     ///< unit length, outwards
    double left, top, right, bottom;  ///< its bounds in the picture, pixels
    LinearStyle style;
    double opacity;  ///< share of light that this face stops
};

/// Shapes of one pass, binned into small squares of the picture.
class PassShapes {
public:
    PassShapes() = default;

    /// \param clipper          of the pass
    /// \param samplesPerPixel  along a side, see PreparedFrame::lineSamples
    /// \param margin           pixels outside the picture's left and upper edge at which blocks of rays start; squares
    ///                         start there too, so that no block of rays straddles two squares
    /// \return the shapes, or BadFrame if they cover the picture too often
    /// Cost: O(shapes + squares that they touch), mostly parallel. Memory: at most about 1 GB, for a picture full of
    /// shapes.
    [[nodiscard]] static Result<PassShapes> make(const Pass& pass, const FrameSpec& spec, const CameraRays& rays,
                                                 const volume::Grid& grid, const Clipper& clipper,
                                                 double samplesPerPixel, double margin, int threads);

    [[nodiscard]] bool isEmpty() const noexcept { return tiles_.empty(); }
    /// Largest distance from a line's axis that the line covers, pixels.
    [[nodiscard]] double reach() const noexcept { return reach_; }

    /// Shapes that a ray through (u, v), see CameraRays::at(), may meet, ascending: lines, then triangles, whose
    /// numbers have kTriangle added. (u, v) may be up to 2 pixels outside the picture.
    [[nodiscard]] std::span<const std::uint32_t> near(double u, double v) const noexcept {
        return inSquare(squareX((u + 1) / 2 * width_), squareY((1 - v) / 2 * height_));
    }
    static constexpr std::uint32_t kTriangle = 0x80000000u;
    /// Lines that any of the rays through (x[n], y[n]), pixels, may meet; each once, in any order.
    /// \param buffer  storage that the result may point into
    template <std::size_t kCount>
    [[nodiscard]] std::span<const std::uint32_t> linesNear(const double (&x)[kCount], const double (&y)[kCount],
                                                           std::vector<std::uint32_t>& buffer) const {
        const auto [left, right] = rangeOf(x, kCount);
        const auto [top, bottom] = rangeOf(y, kCount);
        return linesIn(squareX(left), squareY(top), squareX(right), squareY(bottom), buffer);
    }
    /// Whether any of the rays through (u[n], v[n]), n < count, may meet a shape. False is certain.
    [[nodiscard]] bool hasAnyNear(const double* u, const double* v, std::size_t count) const noexcept {
        const auto [left, right] = rangeOf(u, count);
        const auto [bottom, top] = rangeOf(v, count);
        return hasAnyIn(squareX((left + 1) / 2 * width_), squareY((1 - top) / 2 * height_),
                        squareX((right + 1) / 2 * width_), squareY((1 - bottom) / 2 * height_));
    }
    [[nodiscard]] bool hasTriangles() const noexcept { return !triangles_.empty(); }
    [[nodiscard]] bool hasTriangles(double u, double v) const noexcept {
        const auto shapes = near(u, v);
        return !shapes.empty() && shapes.back() >= kTriangle;
    }

    [[nodiscard]] std::span<const PictureLine> lines() const noexcept { return lines_; }
    [[nodiscard]] std::span<const LineStyle> lineStyles() const noexcept { return lineStyles_; }
    [[nodiscard]] const PictureTriangle& triangle(std::uint32_t number) const noexcept { return triangles_[number]; }
    [[nodiscard]] double width() const noexcept { return width_; }
    [[nodiscard]] double height() const noexcept { return height_; }

private:
    // Squares of 4 x 4 pixels, 8 x 8 of them in a tile.
    static constexpr std::int32_t kSquarePixels = 4, kTileSquares = 8, kTilePixels = kSquarePixels * kTileSquares;
    struct Tile {
        std::vector<std::uint32_t> starts;  // by square, x fastest, and the end; empty: each square has all shapes
        std::vector<std::uint32_t> shapes;
    };
    struct Square {
        double left, top, right, bottom;
    };
    [[nodiscard]] std::int32_t squareOf(double pixel, std::int32_t count) const noexcept {
        return std::clamp(static_cast<std::int32_t>((pixel + margin_) * (1.0 / kSquarePixels)), 0, count - 1);
    }
    [[nodiscard]] std::int32_t squareX(double pixel) const noexcept { return squareOf(pixel, squaresX_); }
    [[nodiscard]] std::int32_t squareY(double pixel) const noexcept { return squareOf(pixel, squaresY_); }
    /// First pixel of square or tile `number`, each `pixels` wide.
    [[nodiscard]] double beginOf(std::int32_t number, std::int32_t pixels) const noexcept {
        return double(number) * pixels - margin_;
    }
    [[nodiscard]] std::span<const std::uint32_t> inSquare(std::int32_t x, std::int32_t y) const noexcept {
        const Tile& tile = tiles_[static_cast<std::size_t>(x / kTileSquares + tilesX_ * (y / kTileSquares))];
        if (tile.starts.empty()) return tile.shapes;
        const auto square = static_cast<std::size_t>(x % kTileSquares + kTileSquares * (y % kTileSquares));
        return std::span(tile.shapes).subspan(tile.starts[square], tile.starts[square + 1] - tile.starts[square]);
    }
    [[nodiscard]] static std::pair<double, double> rangeOf(const double* values, std::size_t count) noexcept {
        double least = values[0], most = values[0];
        for (std::size_t n = 1; n < count; ++n) {
            least = values[n] < least ? values[n] : least;
            most = values[n] > most ? values[n] : most;
        }
        return {least, most};
    }
    // Squares from (x0, y0) to (x1, y1).
    [[nodiscard]] std::span<const std::uint32_t> linesIn(std::int32_t x0, std::int32_t y0, std::int32_t x1,
                                                         std::int32_t y1, std::vector<std::uint32_t>& buffer) const;
    [[nodiscard]] bool hasAnyIn(std::int32_t x0, std::int32_t y0, std::int32_t x1, std::int32_t y1) const noexcept;

    void addLines(const Pass& pass, const FrameSpec& spec, const CameraRays& rays, const volume::Grid& grid,
                  const Clipper& clipper);
    void addLine(Vec3d from, Vec3d to, const CameraRays& rays, double nearest);
    void addTriangles(const Pass& pass, const FrameSpec& spec, const CameraRays& rays, double nearest, double spacing);
    [[nodiscard]] Result<void> sortIntoTiles(int threads);
    void sortIntoSquares(Tile& tile, std::int32_t tileX, std::int32_t tileY, std::size_t most) const;
    [[nodiscard]] std::pair<double, double> spanOf(const PictureLine& line, double top, double bottom) const noexcept;
    [[nodiscard]] Square boundsOf(std::uint32_t shape) const noexcept;
    [[nodiscard]] static Square boundsOf(const std::array<double, 6>& outline) noexcept;
    [[nodiscard]] bool touches(std::uint32_t shape, const Square& square) const noexcept;

    double width_ = 0, height_ = 0, reach_ = 0, margin_ = 0;  // pixels
    std::int32_t squaresX_ = 0, squaresY_ = 0, tilesX_ = 0, tilesY_ = 0;
    std::vector<LineStyle> lineStyles_;
    std::vector<PictureLine> lines_;
    std::vector<PictureTriangle> triangles_;
    // Projected corners, x and y each; all zero if a corner is behind the eye plane: the triangle may be anywhere.
    std::vector<std::array<double, 6>> outlines_;
    std::vector<Tile> tiles_;
};

/// The pass with styles for its voxels: objects that are drawn as triangles are hidden.
[[nodiscard]] Pass makeVoxelPass(const Pass& pass, std::span<const std::uint32_t> objectOfScalar);

}  // namespace svt::render
