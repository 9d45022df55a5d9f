#include <svt/readers/ifc_shape/curved_face.hpp>

#include <svt/readers/ifc_shape/body.hpp>
#include <svt/readers/ifc_shape/bspline.hpp>
#include <svt/readers/ifc_shape/curves.hpp>
#include <svt/readers/ifc_shape/overlay.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

namespace svt::readers::ifc {
namespace {

// A B-spline surface with parameters in approximate metres, and a grid of its points to begin searches from.
struct Spline {
    BSplineSurface surface;
    double scaleU = 1, scaleV = 1;  // metres per unit of the parameter
    static constexpr int kGrid = 24;
    std::vector<Vec3d> grid;  // (kGrid + 1) x (kGrid + 1) points, v fastest

    [[nodiscard]] Vec3d at(Vec3d uv) const {
        return surface.at(surface.u.begin() + uv.x / scaleU, surface.v.begin() + uv.y / scaleV);
    }
    [[nodiscard]] double sizeU() const { return (surface.u.end() - surface.u.begin()) * scaleU; }
    [[nodiscard]] double sizeV() const { return (surface.v.end() - surface.v.begin()) * scaleV; }
    [[nodiscard]] Vec3d gridParameter(int i, int j) const { return {sizeU() * i / kGrid, sizeV() * j / kGrid, 0}; }

    // The foot of a point on the surface, by Gauss-Newton from the nearest point of the grid; nothing if it is farther
    // than a centimetre.
    [[nodiscard]] std::optional<Vec3d> parameters(Vec3d p) const {
        std::size_t nearest = 0;
        for (std::size_t n = 1; n < grid.size(); ++n)
            if (length(grid[n] - p) < length(grid[nearest] - p)) nearest = n;
        Vec3d uv = gridParameter(int(nearest) / (kGrid + 1), int(nearest) % (kGrid + 1));
        Vec3d foot = grid[nearest];
        const double h = 1e-6 * (sizeU() + sizeV());
        for (int step = 0; step < 40; ++step) {
            // Differences towards the inside of the parameter range.
            const double hu = uv.x + h > sizeU() ? -h : h, hv = uv.y + h > sizeV() ? -h : h;
            const Vec3d du = (at(uv + Vec3d{hu, 0, 0}) - foot) / hu, dv = (at(uv + Vec3d{0, hv, 0}) - foot) / hv;
            const Vec3d rest = p - foot;
            const double a = dot(du, du), b = dot(du, dv), c = dot(dv, dv), e = dot(du, rest), f = dot(dv, rest);
            const double det = a * c - b * b;
            if (!(det > 1e-12 * (a * c + 1e-30))) break;
            Vec3d next{std::clamp(uv.x + (e * c - f * b) / det, 0.0, sizeU()),
                       std::clamp(uv.y + (f * a - e * b) / det, 0.0, sizeV()), 0};
            Vec3d nextFoot = at(next);
            for (int halving = 0; halving < 20 && length(p - nextFoot) > length(rest); ++halving) {
                next = (next + uv) / 2;
                nextFoot = at(next);
            }
            const double moved = length(next - uv);
            uv = next;
            foot = nextFoot;
            if (moved < 1e-9) break;
        }
        return length(p - foot) < 0.01 ? std::optional(uv) : std::nullopt;
    }
};

// A surface by its parameters, both in approximate metres. A period of 0: not periodic.
struct Surface {
    Entity kind = Entity::Other;
    Transform axes;
    double radius = 0, second = 0;  // second: of the tube of a torus; tangent of the angle of a cone
    Vec3d sweep{};                  // unit vector of a linear extrusion
    std::vector<Vec3d> curve;  // of a linear extrusion, in space; of a revolution: distance from the axis, 0, height
    std::optional<Spline> spline;
    double periodU = 0, periodV = 0, stepU = 0, stepV = 0;  // steps: between lines of equal parameter; 0: none

    [[nodiscard]] std::optional<Vec3d> parameters(Vec3d p) const {
        if (spline) return spline->parameters(p);
        const Vec3d local = p - axes.origin;
        const double x = dot(local, axes.x), y = dot(local, axes.y), z = dot(local, axes.z), reach = std::hypot(x, y);
        if (kind == Entity::SurfaceOfLinearExtrusion) return onCurve(p);
        if (reach < 1e-6) return std::nullopt;
        if (kind == Entity::SurfaceOfRevolution) {
            const auto along = onCurve({reach, 0, z});
            return along ? std::optional(Vec3d{std::atan2(y, x) * radius, along->x, 0}) : std::nullopt;
        }
        const double u = std::atan2(y, x) * radius;
        switch (kind) {
            case Entity::SphericalSurface: return Vec3d{u, std::atan2(z, reach) * radius, 0};
            case Entity::ToroidalSurface: return Vec3d{u, std::atan2(z, reach - radius) * second, 0};
            default: return Vec3d{u, z, 0};
        }
    }

    [[nodiscard]] Vec3d at(Vec3d uv) const {
        if (spline) return spline->at(uv);
        if (kind == Entity::SurfaceOfLinearExtrusion) return pointOfCurve(uv.x) + sweep * uv.y;
        const SineCosine turn = sineCosine(uv.x / radius);
        const auto turned = [&](double reach, double z) {
            return axes.point({reach * turn.cosine, reach * turn.sine, z});
        };
        switch (kind) {
            case Entity::SurfaceOfRevolution: {
                const Vec3d across = pointOfCurve(uv.y);
                return turned(across.x, across.z);
            }
            case Entity::SphericalSurface: {
                const auto [sineV, cosineV] = sineCosine(uv.y / radius);
                return turned(radius * cosineV, radius * sineV);
            }
            case Entity::ToroidalSurface: {
                const auto [sineV, cosineV] = sineCosine(uv.y / second);
                return turned(radius + second * cosineV, second * sineV);
            }
            case Entity::ConicalSurface: return turned(base + uv.y * second, uv.y);
            default: return turned(radius, uv.y);
        }
    }

    // Approximate cost of parameters().
    [[nodiscard]] std::uint64_t stepsPerPoint() const noexcept {
        return spline ? 40 * (spline->surface.u.degree + 1) * (spline->surface.v.degree + 1) : 1 + curve.size();
    }

    double base = 0;  // radius of a cone at v = 0

private:
    // Length along the curve and along the sweep, seen along the sweep.
    [[nodiscard]] std::optional<Vec3d> onCurve(Vec3d p) const {
        double best = kInfinity, length0 = 0;
        Vec3d result{};
        for (std::size_t i = 0; i + 1 < curve.size(); ++i) {
            const Vec3d a = curve[i], d = curve[i + 1] - a, across = d - sweep * dot(d, sweep);
            const Vec3d toP = p - a, toPAcross = toP - sweep * dot(toP, sweep);
            const double size = dot(across, across), whole = length(d);
            const double share = size > 0 ? std::clamp(dot(toPAcross, across) / size, 0.0, 1.0) : 0;
            if (const double distance = length(toPAcross - across * share); distance < best) {
                best = distance;
                result = {length0 + whole * share, dot(toP - d * share, sweep), 0};
            }
            length0 += whole;
        }
        return best < 0.01 ? std::optional(result) : std::nullopt;
    }

    [[nodiscard]] Vec3d pointOfCurve(double along) const {
        for (std::size_t i = 0; i + 1 < curve.size(); ++i) {
            const double whole = length(curve[i + 1] - curve[i]);
            if (along <= whole || i + 2 == curve.size()) return curve[i] + (curve[i + 1] - curve[i]) * (along / whole);
            along -= whole;
        }
        return curve.front();
    }
};

double chordStep(double radius) { return 2 * kPi * radius / arcSegments(radius, 2 * kPi); }

std::optional<Surface> readSurface(const IfcFile& file, RecordIndex record) {
    const Fields fields = file.fieldsOf(record);
    Surface surface;
    surface.kind = file.entityOf(record);
    surface.axes = file.axes(fields[at::ElementarySurface::Position]);
    surface.radius = file.metres(fields[at::CylindricalSurface::Radius]);
    switch (surface.kind) {
        case Entity::CylindricalSurface: break;
        case Entity::SphericalSurface: surface.stepV = chordStep(surface.radius); break;
        case Entity::ConicalSurface:
            surface.base = surface.radius;
            surface.second = std::tan(file.radians(fields[at::ConicalSurface::SemiAngle]));
            if (!(surface.radius > 0)) surface.radius = 1;  // the apex; the angle needs some scale
            break;
        case Entity::ToroidalSurface:
            surface.second = file.metres(fields[at::ToroidalSurface::MinorRadius]);
            if (!(surface.second > 0)) return std::nullopt;
            surface.stepV = chordStep(surface.second);
            surface.periodV = 2 * kPi * surface.second;
            break;
        default: return std::nullopt;
    }
    if (!(surface.radius > 0)) return std::nullopt;
    surface.stepU = chordStep(surface.radius);
    surface.periodU = 2 * kPi * surface.radius;
    return surface;
}

// The curve of a swept surface, which is a profile of the type CURVE.
bool readSweptCurve(const IfcFile& file, Value profile, std::vector<Vec3d>& points) {
    std::string why;
    return readCurve(file, file.follow(file.follow(profile), at::ArbitraryOpenProfileDef::Curve), points, why) &&
           points.size() >= 2;
}

// A surface of linear extrusion is cut only at the corners of its curve.
std::optional<Surface> readExtrusion(const IfcFile& file, RecordIndex record) {
    namespace extrusion = at::SurfaceOfLinearExtrusion;
    const Fields fields = file.fieldsOf(record);
    Surface surface;
    surface.kind = Entity::SurfaceOfLinearExtrusion;
    surface.axes = file.axes(fields[extrusion::Position]);
    if (!readSweptCurve(file, fields[extrusion::SweptCurve], surface.curve)) return std::nullopt;
    for (Vec3d& p : surface.curve) p = surface.axes.point(p);
    surface.sweep = normalized(
        surface.axes.direction(file.direction(fields[extrusion::ExtrudedDirection]).value_or(Vec3d{0, 0, 1})));
    return surface;
}

constexpr int kMaxSplineStrips = 32, kMaxTwistStrips = 64;

// Whether the triangles of a cell, on either diagonal, leave the surface by more than kChordError. Straight lines of equal parameter may
// still be twisted against each other, as on a hyperbolic paraboloid.
bool isTwisted(const Spline& spline, int countU, int countV) {
    const auto point = [&](double u, double v) {
        return spline.at({spline.sizeU() * u / countU, spline.sizeV() * v / countV, 0});
    };
    for (int i = 0; i < countU; ++i)
        for (int j = 0; j < countV; ++j) {
            const Vec3d twist = (point(i, j) - point(i + 1, j) + point(i + 1, j + 1) - point(i, j + 1)) / 4;
            if (length(twist) > kChordError) return true;
        }
    return false;
}

// The number of equal strips along one parameter whose chords stay within kChordError of the surface.
int splineStrips(const Spline& spline, bool isAlongU) {
    constexpr int kLines = 9;
    for (int count = 1; count < kMaxSplineStrips; count *= 2) {
        double worst = 0;
        for (int line = 0; line < kLines; ++line)
            for (int i = 0; i < count; ++i) {
                const auto point = [&](double share) {
                    const double other = double(line) / (kLines - 1);
                    return spline.at(
                        {spline.sizeU() * (isAlongU ? share : other), spline.sizeV() * (isAlongU ? other : share), 0});
                };
                const Vec3d a = point(double(i) / count), b = point(double(i + 1) / count);
                for (const double share : {0.25, 0.5, 0.75})
                    worst = std::max(worst, length(point((i + share) / count) - (a + (b - a) * share)));
            }
        // Comparing points at equal shares overestimates the error, since a shift along the chord is not an error of
        // shape.
        if (worst <= kChordError) return count;
    }
    return kMaxSplineStrips;
}

std::optional<Surface> readSpline(const IfcFile& file, RecordIndex record) {
    auto read = readBSplineSurface(file, record);
    if (!read) return std::nullopt;
    Surface surface;
    surface.kind = file.entityOf(record);
    Spline& spline = surface.spline.emplace();
    spline.surface = std::move(*read);
    constexpr int n = Spline::kGrid;
    for (int i = 0; i <= n; ++i)
        for (int j = 0; j <= n; ++j) spline.grid.push_back(spline.at(spline.gridParameter(i, j)));
    const auto at = [&](int i, int j) { return spline.grid[std::size_t(i * (n + 1) + j)]; };
    double lengthU = 0, lengthV = 0;
    bool isClosedU = true, isClosedV = true;
    for (int line = 0; line <= n; ++line) {
        double alongU = 0, alongV = 0;
        for (int i = 0; i < n; ++i) {
            alongU += length(at(i + 1, line) - at(i, line));
            alongV += length(at(line, i + 1) - at(line, i));
        }
        lengthU = std::max(lengthU, alongU);
        lengthV = std::max(lengthV, alongV);
        isClosedU = isClosedU && length(at(n, line) - at(0, line)) < 1e-6;
        isClosedV = isClosedV && length(at(line, n) - at(line, 0)) < 1e-6;
    }
    if (!(lengthU > 1e-6 && lengthV > 1e-6) || !std::isfinite(lengthU + lengthV)) return std::nullopt;
    spline.scaleU = lengthU / (spline.surface.u.end() - spline.surface.u.begin());
    spline.scaleV = lengthV / (spline.surface.v.end() - spline.surface.v.begin());
    if (isClosedU) surface.periodU = spline.sizeU();
    if (isClosedV) surface.periodV = spline.sizeV();
    int stripsU = splineStrips(spline, true), stripsV = splineStrips(spline, false);
    while (std::min(stripsU, stripsV) < kMaxTwistStrips && isTwisted(spline, stripsU, stripsV)) {
        stripsU = std::min(2 * stripsU, kMaxTwistStrips);
        stripsV = std::min(2 * stripsV, kMaxTwistStrips);
    }
    surface.stepU = spline.sizeU() / stripsU;
    surface.stepV = spline.sizeV() / stripsV;
    return surface;
}

// Turns the curve into the plane of the axis first, so that it may lie anywhere around the axis.
std::optional<Surface> readRevolution(const IfcFile& file, RecordIndex record) {
    const Fields fields = file.fieldsOf(record);
    const Transform position = file.axes(fields[at::SurfaceOfRevolution::Position]),
                    own = file.axes(fields[at::SurfaceOfRevolution::AxisPosition]);
    Surface surface;
    surface.kind = Entity::SurfaceOfRevolution;
    surface.axes = axesFrom(position.point(own.origin), position.direction(own.z), position.x);
    if (!readSweptCurve(file, fields[at::SurfaceOfRevolution::SweptCurve], surface.curve)) return std::nullopt;
    for (Vec3d& p : surface.curve) {
        const Vec3d local = position.point(p) - surface.axes.origin;
        const double height = dot(local, surface.axes.z);
        p = {length(local - surface.axes.z * height), 0, height};
        surface.radius = std::max(surface.radius, p.x);
    }
    if (!(surface.radius > 1e-6)) return std::nullopt;
    surface.stepU = chordStep(surface.radius);
    surface.periodU = 2 * kPi * surface.radius;
    return surface;
}

struct Layout {
    std::vector<std::vector<Vec3d>> rings;   // in parameters
    std::vector<std::vector<Vec3d>> places;  // the same corners in space
    double lowU = kInfinity, highU = -kInfinity, lowV = kInfinity, highV = -kInfinity;
};

// Converts rings to parameters without jumps; false if one of them goes around the surface.
bool layOut(const Surface& surface, const std::vector<std::vector<Vec3d>>& rings, Layout& layout) {
    const auto near = [](double value, double other, double period) {
        return period > 0 ? value - period * std::round((value - other) / period) : value;
    };
    for (const auto& ring : rings) {
        std::vector<Vec3d> flat;
        for (const Vec3d p : ring) {
            auto uv = surface.parameters(p);
            if (!uv) return false;
            const Vec3d before = !flat.empty() ? flat.back() : !layout.rings.empty() ? layout.rings[0][0] : *uv;
            uv->x = near(uv->x, before.x, surface.periodU);
            uv->y = near(uv->y, before.y, surface.periodV);
            flat.push_back(*uv);
            layout.lowU = std::min(layout.lowU, uv->x);
            layout.highU = std::max(layout.highU, uv->x);
            layout.lowV = std::min(layout.lowV, uv->y);
            layout.highV = std::max(layout.highV, uv->y);
        }
        if (flat.size() < 3) return false;
        // A ring with a seam runs through it twice and comes back; a ring without one goes around.
        if (surface.periodU > 0 && std::abs(flat.back().x - flat.front().x) > surface.periodU / 2) return false;
        if (surface.periodV > 0 && std::abs(flat.back().y - flat.front().y) > surface.periodV / 2) return false;
        layout.rings.push_back(std::move(flat));
        layout.places.push_back(ring);
    }
    return layout.highU - layout.lowU <= 1.01 * surface.periodU || surface.periodU == 0;
}

void addRectangle(double lowU, double highU, double lowV, double highV, std::uint32_t channel,
                  std::vector<OverlaySegment>& segments) {
    const Vec3d a{lowU, lowV, 0}, b{highU, lowV, 0}, c{highU, highV, 0}, d{lowU, highV, 0};
    segments.push_back({a, b, channel, 1});
    segments.push_back({b, c, channel, 1});
    segments.push_back({c, d, channel, 1});
    segments.push_back({d, a, channel, 1});
}

constexpr int kMaxStrips = 512;
constexpr std::uint64_t kMaxFaceSteps = 500'000'000, kSplineSteps = 2'000'000;

// Marks every second strip between lines of equal parameter as the inside of a channel.
void addStrips(const Surface& surface, const Layout& layout, std::vector<OverlaySegment>& segments) {
    const double lowU = layout.lowU - 1, highU = layout.highU + 1, lowV = layout.lowV - 1, highV = layout.highV + 1;
    if (surface.kind == Entity::SurfaceOfLinearExtrusion) {
        double along = 0;
        for (std::size_t i = 0; i + 1 < surface.curve.size() && i < std::size_t(kMaxStrips); ++i) {
            const double next = along + length(surface.curve[i + 1] - surface.curve[i]);
            if (i % 2 == 1) addRectangle(along, next, lowV, highV, 1, segments);
            along = next;
        }
        return;
    }
    const auto first = [](double low, double step) { return std::floor(low / step / 2) * 2 * step; };
    int count = 0;
    if (surface.kind == Entity::SurfaceOfRevolution) {
        double along = 0;
        for (std::size_t i = 0; i + 1 < surface.curve.size() && i < std::size_t(kMaxStrips); ++i) {
            const double next = along + length(surface.curve[i + 1] - surface.curve[i]);
            if (i % 2 == 1) addRectangle(lowU, highU, along, next, 2, segments);
            along = next;
        }
    }
    for (double u = first(layout.lowU, surface.stepU); u < layout.highU && ++count < kMaxStrips; u += 2 * surface.stepU)
        addRectangle(u, u + surface.stepU, lowV, highV, 1, segments);
    if (surface.stepV == 0) return;
    for (double v = first(layout.lowV, surface.stepV); v < layout.highV && ++count < kMaxStrips; v += 2 * surface.stepV)
        addRectangle(lowU, highU, v, v + surface.stepV, 2, segments);
}

// A corner of a cell in space: on an edge of the face, on its chord; within the face, on the surface.
Vec3d placeOf(const Surface& surface, const Layout& layout, Vec3d uv) {
    for (std::size_t r = 0; r < layout.rings.size(); ++r) {
        const auto& ring = layout.rings[r];
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const std::size_t j = (i + 1) % ring.size();
            const Vec3d d = ring[j] - ring[i];
            const double size = dot(d, d), share = size > 0 ? dot(uv - ring[i], d) / size : 0;
            if (share < -1e-9 || share > 1 + 1e-9 || length(uv - ring[i] - d * share) > 2 * kSnap) continue;
            return layout.places[r][i] + (layout.places[r][j] - layout.places[r][i]) * share;
        }
    }
    return surface.at(uv);
}

void addCell(std::vector<std::vector<Vec3d>> rings, bool isTurned, std::vector<model::Polygon>& faces) {
    if (isTurned)
        for (auto& ring : rings) std::reverse(ring.begin(), ring.end());
    if (rings.size() == 1 && rings[0].size() == 4)
        addQuad(faces, rings[0][0], rings[0][1], rings[0][2], rings[0][3]);
    else
        addFace(faces, rings);
}

}  // namespace

bool addCurvedFace(const IfcFile& file, RecordIndex record, const std::vector<std::vector<Vec3d>>& rings,
                   std::vector<model::Polygon>& faces) {
    ReadGuard& guard = file.guard();
    const Entity kind = file.entityOf(record);
    const bool isSpline = kind == Entity::BSplineSurfaceWithKnots || kind == Entity::RationalBSplineSurfaceWithKnots;
    // Approximate cost of measuring a spline; a high degree costs more.
    if (isSpline && !guard.takeSteps(kSplineSteps)) return false;
    const auto surface = isSpline                                   ? readSpline(file, record)
                         : kind == Entity::SurfaceOfRevolution      ? readRevolution(file, record)
                         : kind == Entity::SurfaceOfLinearExtrusion ? readExtrusion(file, record)
                                                                    : readSurface(file, record);
    Layout layout;
    std::uint64_t points = 0;
    for (const auto& ring : rings) points += ring.size();
    if (!surface || !guard.takeSteps(points * surface->stepsPerPoint()) || !layOut(*surface, rings, layout))
        return false;
    const bool isTurned = twiceArea(layout.rings[0]) < 0;
    for (std::size_t r = 1; r < layout.rings.size(); ++r)
        if ((twiceArea(layout.rings[r]) < 0) == isTurned) {
            std::reverse(layout.rings[r].begin(), layout.rings[r].end());
            std::reverse(layout.places[r].begin(), layout.places[r].end());
        }
    std::vector<OverlaySegment> segments;
    for (const auto& ring : layout.rings)
        for (std::size_t i = 0; i < ring.size(); ++i) segments.push_back({ring[i], ring[(i + 1) % ring.size()], 0, 1});
    addStrips(*surface, layout, segments);
    const auto stateOf = [](std::span<const std::int32_t> windings) {
        if (windings[0] == 0) return std::uint8_t{0};
        return static_cast<std::uint8_t>(1 + (windings[1] > 0 ? 1 : 0) + (windings[2] > 0 ? 2 : 0));
    };
    const std::size_t before = faces.size();
    const std::uint64_t granted = std::min(kMaxFaceSteps, guard.stepsLeft());
    std::uint64_t left = granted;
    std::vector<OverlayFace> cells = overlay(segments, 3, stateOf, left);
    guard.takeSteps(granted - std::min(left, granted));
    for (OverlayFace& cell : cells) {
        std::uint64_t corners = 0;
        for (const auto& ring : cell.rings) corners += ring.size();
        if (!guard.takeSteps(corners * (points + surface->curve.size()))) break;
        for (auto& ring : cell.rings)
            for (Vec3d& p : ring) p = placeOf(*surface, layout, p);
        addCell(std::move(cell.rings), isTurned, faces);
    }
    return faces.size() > before;
}

}  // namespace svt::readers::ifc
