#include <svt/voxelize/patterns.hpp>

#include <svt/voxelize/rewrite/rewrite.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace svt::voxelize {
namespace {

// x modulo period, 0 <= result < period.
double within(double x, double period) noexcept { return x - std::floor(x / period) * period; }

// cos(2 pi x) by a Taylor polynomial of degree 9: the last bit of libm's cosine may differ between machines.
double cosineOfTurn(double x) noexcept {
    double t = std::abs(within(x, 1.0) - 0.5) - 0.25;  // -1/4 .. 1/4; cos(2 pi x) = sin(2 pi t)
    t *= 6.283185307179586;
    const double s = t * t;
    return t * (1 - s / 6 * (1 - s / 20 * (1 - s / 42 * (1 - s / 72))));
}

// Hash of a cell, with the finalizer of SplitMix64 (Steele, Lea & Flood 2014).
std::uint32_t hashCell(std::int64_t x, std::int64_t y, std::int64_t z, std::uint32_t seed) noexcept {
    std::uint64_t h = std::uint64_t(x) * 0x9E3779B97F4A7C15ull ^ std::uint64_t(y) * 0xC2B2AE3D27D4EB4Full ^
                      std::uint64_t(z) * 0x165667B19E3779F9ull ^ (std::uint64_t(seed) << 32);
    h = (h ^ (h >> 30)) * 0xBF58476D1CE4E5B9ull;
    h = (h ^ (h >> 27)) * 0x94D049BB133111EBull;
    return static_cast<std::uint32_t>(h >> 32);
}

double unit(std::uint32_t bits) noexcept { return bits * (1.0 / 4294967296.0); }

// Running bond: every second course is shifted by half a brick, also in depth, so that no cut along a wall shows only a
// joint. Returns 1 in a joint, 0 in a brick. Each brick begins at its lower corner, with the joints behind it, so that
// a face at 0 shows bricks.
//
//     w   [ ][      ][      ]
//         [      ][      ][ ]   course 0
//         0  u
std::uint32_t bond(Vec3d p, Vec3d size, double joint) noexcept {
    const double course = std::floor(p.z / size.z);
    const bool isShifted = within(course, 2.0) >= 1;
    const double u = within(p.x + (isShifted ? size.x / 2 : 0), size.x);
    const double v = within(p.y + (isShifted ? size.y / 2 : 0), size.y);
    const double w = within(p.z, size.z);
    return u >= size.x - joint || v >= size.y - joint || w >= size.z - joint ? 1 : 0;
}

// `unit`, scaled so that whole units fill `extent`, the last one without its joint. It stays for objects smaller than
// half a unit.
double fitted(double unit, double joint, double extent) noexcept {
    const double count = std::floor((extent + joint) / unit + 0.5);
    return count >= 1 ? (extent + joint) / count : unit;
}

std::uint32_t hatch(Vec3d p, double period, double line, double angleDegrees) noexcept {
    // Cosine and sine of the angle by the polynomial above, whose argument is a number of turns.
    const double c = cosineOfTurn(angleDegrees / 360), s = cosineOfTurn(angleDegrees / 360 - 0.25);
    // Lines run along (cos, sin) in (u, w) and also slope along v, so that every section shows them.
    return within(p.z * c - p.x * s + p.y * s, period) < line ? 1 : 0;
}

std::uint32_t woodGrain(Vec3d p, double ring, double line, std::uint32_t seed) noexcept {
    // Rings around a pith that lies outside the piece and shifts along its length.
    const double wander = 0.15 * ring * cosineOfTurn(p.x / (40 * ring));
    const double y = p.y + ring * (6 + 4 * unit(hashCell(1, 2, 3, seed))) + wander;
    const double z = p.z + ring * (9 + 4 * unit(hashCell(4, 5, 6, seed)));
    const double radius = std::sqrt(y * y + z * z);
    const double wobble = ring * 0.2 * (cosineOfTurn(y / (11 * ring)) + cosineOfTurn(z / (13 * ring)));
    return within(radius + wobble, ring) < line ? 1 : 0;
}

std::uint32_t concrete(Vec3d p, double coarse, std::uint32_t seed) noexcept {
    // One spherical grain per cell, with random centre and radius; coarse grains take precedence over fine ones.
    for (int pass = 0; pass < 2; ++pass) {
        const double cell = pass == 0 ? coarse : coarse * 0.4;
        const double largest = pass == 0 ? 0.42 : 0.30;
        const auto ci = static_cast<std::int64_t>(std::floor(p.x / cell)),
                   cj = static_cast<std::int64_t>(std::floor(p.y / cell)),
                   ck = static_cast<std::int64_t>(std::floor(p.z / cell));
        const std::uint32_t h = hashCell(ci, cj, ck, seed + std::uint32_t(pass));
        const double radius = cell * largest * (0.35 + 0.65 * unit(h));
        const auto middle = [&](std::int64_t c, std::uint32_t n) {
            const double slack = cell - 2 * radius;
            return double(c) * cell + radius + slack * unit(hashCell(ci + 7 * std::int64_t(n), cj, ck, seed + n));
        };
        const Vec3d d{p.x - middle(ci, 11), p.y - middle(cj, 13), p.z - middle(ck, 17)};
        if (dot(d, d) < radius * radius) return pass == 0 ? 2 : 1;
    }
    return 0;
}

std::uint32_t insulation(Vec3d p, Vec3d size, double line) noexcept {
    // The loops that section drawings use for insulation: waves along u and v, stacked along w.
    const double wave = size.z / 2 * (cosineOfTurn(p.x / size.x) + cosineOfTurn(p.y / size.y)) / 2;
    return within(p.z + wave, size.z / 2) < line ? 1 : 0;
}

std::uint32_t texelPhase(const PatternTexels& texels, Vec3d p, Vec3d size) noexcept {
    const auto index = [](double x, double period, std::int32_t count) {
        return std::min(count - 1, static_cast<std::int32_t>(within(x, period) / period * count));
    };
    const std::int32_t i = index(p.x, size.x, texels.dimension.x);
    const bool isImage = texels.dimension.z == 1;
    const std::int32_t j = isImage ? index(p.z, size.z, texels.dimension.y) : index(p.y, size.y, texels.dimension.y);
    const std::int32_t k = isImage ? 0 : index(p.z, size.z, texels.dimension.z);
    return texels.phases[std::size_t(i) + std::size_t(texels.dimension.x) *
                                              (std::size_t(j) + std::size_t(texels.dimension.y) * std::size_t(k))];
}

struct Defaults {
    Vec3d size;
    double line;
};

Defaults defaultsOf(PatternKind kind) noexcept {
    switch (kind) {
        case PatternKind::Brick: return {{0.25, 0.125, 0.0833}, 0.012};  // 24 x 11.5 x 7.1 cm with 1.2 cm joints
        case PatternKind::Block: return {{0.50, 0.25, 0.25}, 0.010};
        case PatternKind::Hatch: return {{0.12, 0.12, 0.12}, 0.02};
        case PatternKind::Stripes: return {{0.20, 0.20, 0.20}, 0.10};
        case PatternKind::Checker: return {{0.20, 0.20, 0.20}, 0.10};
        case PatternKind::Grid: return {{0.25, 0.25, 0.25}, 0.02};
        case PatternKind::WoodGrain: return {{0.03, 0.03, 0.03}, 0.01};
        case PatternKind::Concrete: return {{0.08, 0.08, 0.08}, 0.02};
        case PatternKind::Insulation: return {{0.16, 0.16, 0.16}, 0.02};
        case PatternKind::Image:
        case PatternKind::Raw: return {{1, 1, 1}, 0.01};
        case PatternKind::None: break;
    }
    return {{1, 1, 1}, 0.01};
}

// Appends the samples [begin, end) of column (i, j), each with the phase of the object's pattern at it.
void appendPhases(const PatternedObject& object, const volume::Grid& grid, Vec3d localOrigin, std::int32_t i,
                  std::int32_t j, std::uint32_t begin, std::uint32_t end, std::vector<volume::Run>& out) {
    for (std::uint32_t k = begin; k < end; ++k) {
        const Vec3d local = grid.worldFromIndex({double(i), double(j), double(k)}) - localOrigin - object.axes.origin;
        const Vec3d uvw{dot(local, object.axes.directions[0]), dot(local, object.axes.directions[1]),
                        dot(local, object.axes.directions[2])};
        const volume::Scalar scalar = object.first + object.pattern.phaseAt(uvw);
        if (!out.empty() && out.back().scalar == scalar && out.back().end == k)
            out.back().end = k + 1;
        else
            out.push_back({k + 1, scalar});
    }
}

}  // namespace

std::uint32_t Pattern::phaseCount() const noexcept {
    switch (kind) {
        case PatternKind::None: return 1;
        case PatternKind::Concrete: return 3;
        case PatternKind::Image:
        case PatternKind::Raw: return texels == nullptr ? 1 : texels->phaseCount;
        default: return 2;
    }
}

std::uint32_t Pattern::phaseAt(Vec3d p) const noexcept {
    switch (kind) {
        case PatternKind::None: return 0;
        case PatternKind::Brick:
        case PatternKind::Block: return bond(p, size, line);
        case PatternKind::Hatch: return hatch(p, size.z, line, angleDegrees);
        case PatternKind::Stripes: return within(p.z, size.z) < line ? 1 : 0;
        case PatternKind::Checker: {
            const double sum = std::floor(p.x / size.x) + std::floor(p.y / size.y) + std::floor(p.z / size.z);
            return within(sum, 2.0) >= 1 ? 1 : 0;
        }
        case PatternKind::Grid:
            return within(p.x, size.x) < line || within(p.y, size.y) < line || within(p.z, size.z) < line ? 1 : 0;
        case PatternKind::WoodGrain: return woodGrain(p, size.z, line, seed);
        case PatternKind::Concrete: return concrete(p, size.z, seed);
        case PatternKind::Insulation: return insulation(p, size, line);
        case PatternKind::Image:
        case PatternKind::Raw: return texels == nullptr || texels->phases.empty() ? 0 : texelPhase(*texels, p, size);
    }
    return 0;
}

void fitPattern(PatternedObject& object, Vec3d spacing) noexcept {
    Pattern& pattern = object.pattern;
    if (pattern.kind != PatternKind::Brick && pattern.kind != PatternKind::Block) return;
    const double step = std::max({spacing.x, spacing.y, spacing.z});
    if (3 * step <= std::min({pattern.size.x, pattern.size.y, pattern.size.z}))
        pattern.line = std::max(pattern.line, step);
    const Vec3d extent = object.axes.extent;
    pattern.size.x = 2 * fitted(pattern.size.x / 2, pattern.line, extent.x);
    pattern.size.y = 2 * fitted(pattern.size.y / 2, pattern.line, extent.y);
    pattern.size.z = fitted(pattern.size.z, pattern.line, extent.z);
    // A sheet goes through the middle of bricks, because its material may lie on either side.
    if (extent.y < pattern.line)
        object.axes.origin = object.axes.origin - object.axes.directions[1] * ((pattern.size.y / 2 - pattern.line) / 2);
}

Result<Pattern> makePattern(Pattern pattern) {
    const Defaults defaults = defaultsOf(pattern.kind);
    constexpr double kSmallest = 1e-4, kLargest = 1e3;
    for (int axis = 0; axis < 3; ++axis) {
        if (pattern.size[axis] == 0) pattern.size[axis] = defaults.size[axis];
        if (!(pattern.size[axis] >= kSmallest && pattern.size[axis] <= kLargest))
            return Error(Code::BadPattern,
                         fmt::format("pattern {}: size {} m along {} is out of range; {} to {} m are possible",
                                     nameOf(pattern.kind), pattern.size[axis], "uvw"[axis], kSmallest, kLargest));
    }
    if (pattern.line == 0) pattern.line = defaults.line;
    if (!(pattern.line >= kSmallest && pattern.line <= kLargest))
        return Error(Code::BadPattern, fmt::format("pattern {}: line {} m is out of range; {} to {} m are possible",
                                                   nameOf(pattern.kind), pattern.line, kSmallest, kLargest));
    if (!(std::abs(pattern.angleDegrees) <= 360))
        return Error(Code::BadPattern,
                     fmt::format("pattern {}: angle {} is out of range; -360 to 360 degrees are possible",
                                 nameOf(pattern.kind), pattern.angleDegrees));
    const bool needsTexels = pattern.kind == PatternKind::Image || pattern.kind == PatternKind::Raw;
    if (needsTexels && pattern.texels == nullptr)
        return Error(Code::BadPattern, fmt::format("pattern {}: needs a file", nameOf(pattern.kind)));
    return pattern;
}

ObjectAxes dominantAxes(const mesh::ObjectMesh& mesh) noexcept {
    // Directions modulo 180 degrees, weighted by length.
    constexpr int kBins = 180;
    std::array<double, kBins> weight{};
    std::array<Vec3d, kBins> sum{};
    for (const mesh::Triangle& triangle : mesh.triangles) {
        for (std::size_t c = 0; c < 3; ++c) {
            Vec3d edge = mesh.vertices[triangle.corners[(c + 1) % 3]] - mesh.vertices[triangle.corners[c]];
            const double plan = std::sqrt(edge.x * edge.x + edge.y * edge.y);
            if (!(plan > 1e-6) || std::abs(edge.z) > 1e-3 * plan) continue;
            if (edge.y < -1e-9 * plan || (std::abs(edge.y) <= 1e-9 * plan && edge.x < 0)) edge = -edge;
            const int bin =
                std::clamp(static_cast<int>(std::lround(std::atan2(edge.y, edge.x) / 3.14159265358979 * kBins)), 0,
                           kBins) %
                kBins;
            weight[std::size_t(bin)] += plan;
            // Directions just below 180 degrees fall into bin 0 and are reversed to just below 0.
            sum[std::size_t(bin)] = sum[std::size_t(bin)] + (bin == 0 && edge.x < 0 ? -edge : edge);
        }
    }
    ObjectAxes axes;
    const auto best = std::max_element(weight.begin(), weight.end()) - weight.begin();
    if (weight[std::size_t(best)] > 0) {
        Vec3d u = sum[std::size_t(best)];
        u.z = 0;
        u = normalized(u);
        if (std::abs(u.y) < 1e-7) u = {1, 0, 0};
        if (std::abs(u.x) < 1e-7) u = {0, 1, 0};
        axes.directions = {u, {-u.y, u.x, 0}, {0, 0, 1}};
    }
    if (mesh.vertices.empty()) return axes;
    Box3d box;
    for (const Vec3d& vertex : mesh.vertices)
        box.add(
            Vec3d{dot(vertex, axes.directions[0]), dot(vertex, axes.directions[1]), dot(vertex, axes.directions[2])});
    axes.origin = axes.directions[0] * box.min.x + axes.directions[1] * box.min.y + axes.directions[2] * box.min.z;
    axes.extent = box.size();
    return axes;
}

volume::ColumnVolume layPatterns(const volume::ColumnVolume& columns, const volume::Grid& grid, Vec3d localOrigin,
                                 const std::vector<PatternedObject>& objects, int threads) {
    std::unordered_map<volume::Scalar, const PatternedObject*> byScalar;
    for (const PatternedObject& object : objects)
        if (object.pattern.phaseCount() > 1) byScalar.emplace(object.first, &object);
    if (byScalar.empty()) return columns;
    return rewriteColumns(
        columns,
        [&](std::int32_t, std::int32_t, const volume::ColumnTile& tile) -> ColumnRewriter {
            const bool hasPattern = std::any_of(tile.runs.begin(), tile.runs.end(), [&](const volume::Run& run) {
                return byScalar.count(run.scalar) != 0;
            });
            if (!hasPattern) return {};
            return
                [&](std::int32_t i, std::int32_t j, std::span<const volume::Run> runs, std::vector<volume::Run>& out) {
                    std::uint32_t begin = 0;
                    for (const volume::Run& run : runs) {
                        const auto found = byScalar.find(run.scalar);
                        if (found == byScalar.end())
                            out.push_back(run);
                        else
                            appendPhases(*found->second, grid, localOrigin, i, j, begin, run.end, out);
                        begin = run.end;
                    }
                };
        },
        threads);
}

}  // namespace svt::voxelize
