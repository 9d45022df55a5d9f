#include <svt/render_gl/painter/shape_textures.hpp>

#include <svt/render/pass_shapes.hpp>
#include <svt/render/picture_constants.hpp>
#include <svt/render_gl/painter/shared_constants.hpp>
#include <svt/render_gl/painter/view_depth.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>
#include <vector>

namespace svt::render_gl {
namespace {

using render::PassShapes;

/// Lines, then styles of lines, then triangles; see shapes.glsl.
class ShapeTable {
public:
    [[nodiscard]] const std::vector<std::uint32_t>& words() const noexcept { return words_; }
    [[nodiscard]] std::uint32_t texels() const noexcept { return static_cast<std::uint32_t>(words_.size() / 4); }

    void add(const render::PictureLine& line) {
        append<kLineTexels>({texel(line.x, line.y, line.dx, line.dy),
                             texel(line.perSquaredLength, line.depth, line.depthChange, line.length),
                             Texel{line.style}});
    }
    void add(const render::LineStyle& style) {
        append<kLineStyleTexels>({texel(style.color, style.halfWidth),
                                  texel(style.darkest, style.hiddenOpacity, style.dash, style.period),
                                  Texel{static_cast<std::uint32_t>(style.hidden)}});
    }
    /// \param from  origin of the corners, relative to the eye, metres
    void add(const render::PictureTriangle& triangle, Vec3d from, render::Hatch hatch) {
        const auto& [a, b, c] = triangle.corners;
        const render::LinearStyle& style = triangle.style;
        append<kTriangleTexels>({texel(a - from, 0), texel(b - from, 0), texel(c - from, 0), texel(triangle.normal, 0),
                                 texel({style.color.x, style.color.y, style.color.z}, triangle.opacity),
                                 Texel{flagsOf(style, hatch), style.object, bitsOf(style.surface), style.label}});
    }

private:
    using Texel = std::array<std::uint32_t, 4>;
    static Texel texel(double x, double y, double z, double w) {
        return {bitsOf(static_cast<float>(x)), bitsOf(static_cast<float>(y)), bitsOf(static_cast<float>(z)),
                bitsOf(static_cast<float>(w))};
    }
    static Texel texel(Vec3d v, double w) { return texel(v.x, v.y, v.z, w); }
    template <std::size_t kTexels>
    void append(const std::array<Texel, kTexels>& texels) {
        for (const Texel& words : texels) words_.insert(words_.end(), words.begin(), words.end());
    }

    std::vector<std::uint32_t> words_;
};

/// The shapes near each square of the picture.
struct SortedShapes {
    std::uint32_t countX, countY;
    std::vector<std::uint32_t> squares;  ///< by square: first in the list, lines, triangles, 0
    std::vector<std::uint32_t> list;
    std::uint32_t triangleCount = 0;

    SortedShapes(const PassShapes& shapes, const render::FrameSpec& spec)
        : countX(squaresIn(spec.width)), countY(squaresIn(spec.height)) {
        std::unordered_map<const std::uint32_t*, std::uint32_t> known;  // squares may share a list
        for (std::uint32_t y = 0; y < countY; ++y)
            for (std::uint32_t x = 0; x < countX; ++x)
                add(shapes.near(2 * middleOf(x) / spec.width - 1, 1 - 2 * middleOf(y) / spec.height), known);
    }

private:
    static std::uint32_t squaresIn(std::int32_t pixels) {
        return static_cast<std::uint32_t>(pixels + kSquarePixels - 1) / kSquarePixels;
    }
    static double middleOf(std::uint32_t square) { return kSquarePixels * (square + 0.5); }
    void add(std::span<const std::uint32_t> near, std::unordered_map<const std::uint32_t*, std::uint32_t>& known) {
        if (near.empty()) {
            squares.insert(squares.end(), {0u, 0u, 0u, 0u});
            return;
        }
        const auto firstTriangle = std::lower_bound(near.begin(), near.end(), PassShapes::kTriangle);
        const auto lines = static_cast<std::uint32_t>(firstTriangle - near.begin());
        const auto [place, isNew] = known.try_emplace(near.data(), static_cast<std::uint32_t>(list.size()));
        if (isNew) list.insert(list.end(), near.begin(), near.end());
        squares.insert(squares.end(), {place->second, lines, static_cast<std::uint32_t>(near.size()) - lines, 0u});
        if (firstTriangle != near.end())
            triangleCount = std::max(triangleCount, (near.back() & ~PassShapes::kTriangle) + 1);
    }
};

}  // namespace

Result<void> ShapeTextures::update(const render::Pass& pass, const render::FrameSpec& spec, const volume::Grid& grid,
                                   Vec3i middle, const GlLimits& limits, int threads) {
    isEmpty_ = true;
    if (pass.lines.empty() && pass.triangles.empty()) return {};
    const render::CameraRays rays(spec, grid);
    lineSamples_ = std::round(std::sqrt(spec.samplesPerPixel));
    SVT_TRY(shapes,
            PassShapes::make(pass, spec, rays, grid, render::Clipper(pass.clips, grid), lineSamples_, 0, threads));
    if (shapes->isEmpty()) return {};
    const Vec3d spacing = grid.spacing();
    voxelSize_ = std::max({spacing.x, spacing.y, spacing.z});
    pixelSize_ = rays.pixelSize(1);
    isPerspective_ = rays.isPerspective();

    const SortedShapes sorted(*shapes, spec);
    squaresX_ = sorted.countX;
    squaresY_ = sorted.countY;
    ShapeTable table;
    for (const render::PictureLine& line : shapes->lines()) table.add(line);
    lineStylesFirst_ = table.texels();
    for (const render::LineStyle& style : shapes->lineStyles()) table.add(style);
    trianglesFirst_ = table.texels();
    const Vec3d from = rays.forward() * middleDepthOf(spec.camera, rays, grid, middle);
    for (std::uint32_t n = 0; n < sorted.triangleCount; ++n) {
        const render::PictureTriangle& triangle = shapes->triangle(n);
        table.add(triangle, from, pass.styles[triangle.style.label].hatch);
    }
    isEmpty_ = false;
    hasTriangles_ = sorted.triangleCount > 0;
    SVT_DO(squares_.setArray(GL_RGBA32UI, sorted.squares.data(), sorted.squares.size() / 4, limits));
    SVT_DO(list_.setArray(GL_R32UI, sorted.list.data(), sorted.list.size(), limits));
    return table_.setArray(GL_RGBA32UI, table.words().data(), table.texels(), limits);
}

void ShapeTextures::setUniforms(Program& program) const {
    program.bind("shapeSquares", squares_);
    program.bind("shapeList", list_);
    program.bind("shapeTable", table_);
    program.setPair("shapeSquareCount", static_cast<GLint>(squaresX_), static_cast<GLint>(squaresY_));
    program.set("lineStylesFirst", GLuint{lineStylesFirst_});
    program.set("trianglesFirst", GLuint{trianglesFirst_});
    program.set("lineSamples", lineSamples_);
    program.set("linePixelPerDepth", isPerspective_ ? pixelSize_ : 0.0);
    program.set("linePixelSize", isPerspective_ ? 0.0 : pixelSize_);
    program.set("depthBias", render::kVoxelsBefore * voxelSize_);
    program.set("lineTogether", render::kVoxelsTogether * voxelSize_);
}

}  // namespace svt::render_gl
