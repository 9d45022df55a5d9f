#include <svt/drawing/field/region_grid.hpp>

#include <svt/core/parallel.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace svt::drawing {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kFewNodes = 16;  // regions with fewer get a finer grid
constexpr double kRefinements[] = {1, 2, 4, 8};
constexpr int kContinuedNodes = 3;      // by which values are continued, at least
constexpr double kContinuedVoxels = 2;  // the same inside of the outline
constexpr int kMostContinued = 64;      // nodes

// Cuts an edge at u or v; the same point for both directions of the edge.
PlanePoint cutAt(PlanePoint a, PlanePoint b, double sideA, double sideB) noexcept {
    if (b.u < a.u || (b.u == a.u && b.v < a.v)) {
        std::swap(a, b);
        std::swap(sideA, sideB);
    }
    const double t = sideA / (sideA - sideB);
    return {a.u + (b.u - a.u) * t, a.v + (b.v - a.v) * t};
}

template <class SideOf, class Fix>
Ring clipBy(const Ring& ring, const SideOf& sideOf, const Fix& fix) {
    Ring kept;
    for (std::size_t n = 0; n < ring.size(); ++n) {
        const PlanePoint a = ring[n], b = ring[(n + 1) % ring.size()];
        const double sideA = sideOf(a), sideB = sideOf(b);
        if (sideA >= 0) kept.push_back(a);
        if ((sideA > 0 && sideB < 0) || (sideA < 0 && sideB > 0)) kept.push_back(fix(cutAt(a, b, sideA, sideB)));
    }
    if (kept.size() < 3) kept.clear();
    return kept;
}

constexpr auto kAsItIs = [](PlanePoint p) { return p; };

}  // namespace

Ring clipRing(const Ring& ring, PlanePoint a, PlanePoint b) {
    // The same numbers for both directions of the line.
    const bool isSwapped = b.u < a.u || (b.u == a.u && b.v < a.v);
    const PlanePoint from = isSwapped ? b : a, to = isSwapped ? a : b;
    const double sign = isSwapped ? -1 : 1;
    return clipBy(
        ring,
        [&](PlanePoint p) { return sign * ((to.u - from.u) * (p.v - from.v) - (to.v - from.v) * (p.u - from.u)); },
        kAsItIs);
}

RegionGrid::RegionGrid(const FieldRegion& region, const FieldSource& source) : region_(region), source_(source) {
    for (const Ring& ring : region.rings)
        for (std::size_t n = 0; n < ring.size(); ++n) edges_.emplace_back(ring[n], ring[(n + 1) % ring.size()]);
    // Narrow regions may have few nodes: between the lattice's nodes, the sampler knows values as well.
    // Between both sides of a wall there must be two nodes, so that neither side takes values of the other.
    for (const double refine : kRefinements)
        if (fill(refine) >= kFewNodes && !hasThinWall()) break;
    extend();
    findPlaces();
    hasEmptySpace_ = meetsEmptySpace();
}

bool RegionGrid::meetsEmptySpace() const noexcept {
    for (std::size_t j = 0; j < vs_.size(); ++j)
        for (std::size_t i = 0; i < us_.size(); ++i)
            if (inside_[node(i, j)] != 0 && scalarAt({us_[i], vs_[j]}) == 0) return true;
    return false;
}

// Makes the nodes and samples them.
// \return how many lie in the region's own voxels
std::size_t RegionGrid::fill(double refine) {
    PlanePoint low{kInfinity, kInfinity}, high{-kInfinity, -kInfinity};
    for (const auto& [p, next] : edges_) {
        low = {std::min(low.u, p.u), std::min(low.v, p.v)};
        high = {std::max(high.u, p.u), std::max(high.v, p.v)};
    }
    NodeLines lines = nodeLines(source_, low, high, refine);
    us_ = std::move(lines.us);
    vs_ = std::move(lines.vs);
    findNodes();
    findWalls();
    parallelFor(vs_.size(), 8, source_.threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t j = begin; j < end; ++j) sampleRow(j);
    });
    return static_cast<std::size_t>(
        std::count_if(nodes_.begin(), nodes_.end(), [](Node node) { return node != Node::Beyond; }));
}

// Finds the nodes inside, by the edges to their left.
void RegionGrid::findNodes() {
    inside_.assign(us_.size() * vs_.size(), 0);
    nodes_.assign(inside_.size(), Node::Beyond);
    values_.assign(inside_.size(), kNone);
    std::vector<std::vector<double>> crossings(vs_.size());
    for (const auto& [a, b] : edges_) {
        const double low = std::min(a.v, b.v), high = std::max(a.v, b.v);
        auto j = static_cast<std::size_t>(std::lower_bound(vs_.begin(), vs_.end(), low) - vs_.begin());
        for (; j < vs_.size() && vs_[j] <= high; ++j)
            if ((a.v > vs_[j]) != (b.v > vs_[j]))
                crossings[j].push_back(a.u + (vs_[j] - a.v) / (b.v - a.v) * (b.u - a.u));
    }
    for (std::size_t j = 0; j < vs_.size(); ++j) {
        std::sort(crossings[j].begin(), crossings[j].end());
        std::size_t passed = 0;
        for (std::size_t i = 0; i < us_.size(); ++i) {
            while (passed < crossings[j].size() && crossings[j][passed] < us_[i]) ++passed;
            inside_[node(i, j)] = passed % 2;
        }
    }
}

volume::Scalar RegionGrid::scalarAt(PlanePoint p) const noexcept {
    const Vec3d index = source_.volume.grid.indexFromWorld(source_.axes.worldFromPlane(p));
    const Vec3i n = source_.volume.grid.dimension();
    Vec3i voxel;
    for (int axis = 0; axis < 3; ++axis) {
        if (!(index[axis] >= -0.5 && index[axis] < n[axis] - 0.5)) return 0;
        voxel[axis] = static_cast<std::int32_t>(std::floor(index[axis] + 0.5));
    }
    return source_.volume.columns.scalarAt(voxel.x, voxel.y, voxel.z);
}

void RegionGrid::sampleRow(std::size_t j) {
    for (std::size_t i = 0; i < us_.size(); ++i) {
        const std::size_t n = node(i, j);
        if (inside_[n] == 0) continue;
        const PlanePoint p{us_[i], vs_[j]};
        // Near the outline, the voxel may be one of the wall: the value continues from the region.
        const volume::Scalar scalar = scalarAt(p);
        if (source_.isMedium[scalar] == 0 || (source_.isAir[scalar] != 0) != region_.isAir) continue;
        const float value = source_.sampler.atSeconds(
            source_.volume.grid.indexFromWorld(source_.axes.worldFromPlane(p)), source_.seconds);
        nodes_[n] = std::isnan(value) ? Node::Missing : Node::Known;
        values_[n] = double{value};
    }
}

// Finds the steps between nodes that cross the outline.
void RegionGrid::findWalls() {
    walls_.assign(inside_.size(), 0);
    // Marks the crossings of an edge with the lines of nodes at `lines`; `across` are the nodes along these lines.
    const auto mark = [this](const std::vector<double>& lines, const std::vector<double>& across, double lineA,
                             double lineB, double acrossA, double acrossB, std::size_t lineStep, std::size_t acrossStep,
                             std::uint8_t bit) {
        const double low = std::min(lineA, lineB), high = std::max(lineA, lineB);
        auto l = static_cast<std::size_t>(std::lower_bound(lines.begin(), lines.end(), low) - lines.begin());
        for (; l < lines.size() && lines[l] <= high; ++l) {
            if ((lineA > lines[l]) == (lineB > lines[l])) continue;
            const double at = acrossA + (lines[l] - lineA) / (lineB - lineA) * (acrossB - acrossA);
            const auto above = std::upper_bound(across.begin(), across.end(), at);
            if (above == across.begin() || above == across.end()) continue;
            const auto before = static_cast<std::size_t>(above - across.begin()) - 1;
            walls_[l * lineStep + before * acrossStep] |= bit;
        }
    };
    for (const auto& [a, b] : edges_) {
        mark(vs_, us_, a.v, b.v, a.u, b.u, us_.size(), 1, 1);
        mark(us_, vs_, a.u, b.u, a.v, b.v, 1, us_.size(), 2);
    }
}

// Whether a wall between a node with a value and another node inside has less than two nodes of its own.
bool RegionGrid::hasThinWall() const noexcept {
    const std::size_t width = us_.size();
    const auto isKnown = [&](std::size_t n) { return nodes_[n] == Node::Known; };
    const auto isInWall = [&](std::size_t n) { return inside_[n] != 0 && nodes_[n] == Node::Beyond; };
    for (std::size_t j = 1; j + 1 < vs_.size(); ++j)
        for (std::size_t i = 1; i + 1 < width; ++i) {
            const std::size_t n = node(i, j);
            for (const auto& [step, bit] : {std::pair(std::size_t{1}, 1), std::pair(width, 2)}) {
                const std::size_t before = n - step, after = n + step;
                const bool isBetween = inside_[n] == 0 && inside_[before] != 0 && inside_[after] != 0;
                if (isBetween && (isKnown(before) || isKnown(after))) return true;
                const bool isCrossed = (walls_[n] & bit) != 0;
                if (isCrossed && ((isKnown(n) && isInWall(after)) || (isInWall(n) && isKnown(after)))) return true;
            }
        }
    return false;
}

// Whether the outline passes between a node and its neighbour; diagonally, if it passes on both ways around.
bool RegionGrid::isWallAhead(std::ptrdiff_t i, std::ptrdiff_t j, int du, int dv) const noexcept {
    const auto width = static_cast<std::ptrdiff_t>(us_.size());
    const auto alongU = [&](std::ptrdiff_t row) {
        return du != 0 && (walls_[static_cast<std::size_t>(std::min(i, i + du) + row * width)] & 1) != 0;
    };
    const auto alongV = [&](std::ptrdiff_t column) {
        return dv != 0 && (walls_[static_cast<std::size_t>(column + std::min(j, j + dv) * width)] & 2) != 0;
    };
    return (alongU(j) || alongV(i + du)) && (alongV(i) || alongU(j + dv));
}

// The value of a node from its neighbours along the eight directions: linear where a direction has two known nodes, else their
// mean; kNone without known neighbours. No value crosses a wall to a node inside.
double RegionGrid::continuedValue(std::ptrdiff_t i, std::ptrdiff_t j, bool isInside) const noexcept {
    const auto width = static_cast<std::ptrdiff_t>(us_.size()), height = static_cast<std::ptrdiff_t>(vs_.size());
    // The value of a neighbour, if the step to it crosses no wall.
    const auto at = [&](std::ptrdiff_t x, std::ptrdiff_t y, int du, int dv, bool isSameSide) -> double {
        const std::ptrdiff_t toX = x + du, toY = y + dv;
        if (toX < 0 || toY < 0 || toX >= width || toY >= height) return kNone;
        if (isSameSide && isWallAhead(x, y, du, dv)) return kNone;
        return values_[static_cast<std::size_t>(toX + toY * width)];
    };
    // Distance to the next node, divided by the distance between the next two.
    const auto gap = [](const std::vector<double>& lines, std::ptrdiff_t k, int sign) {
        const auto coordinate = [&](std::ptrdiff_t m) { return lines[static_cast<std::size_t>(m)]; };
        return (coordinate(k + sign) - coordinate(k)) / (coordinate(k + 2 * sign) - coordinate(k + sign));
    };
    double linear = 0, constant = 0;
    int linears = 0, constants = 0;
    for (int d = 0; d < 9; ++d) {
        const int du = d % 3 - 1, dv = d / 3 - 1;
        if (du == 0 && dv == 0) continue;
        const double near = at(i, j, du, dv, isInside);
        if (std::isnan(near)) continue;
        constant += near;
        ++constants;
        const bool isNearInside =
            inside_[node(static_cast<std::size_t>(i + du), static_cast<std::size_t>(j + dv))] != 0;
        const double far = at(i + du, j + dv, du, dv, isNearInside);
        if (std::isnan(far)) continue;
        // The steps along u and v may differ on a rectilinear lattice; then only the axes are linear.
        const double ratioU = du != 0 ? gap(us_, i, du) : gap(vs_, j, dv);
        const double ratioV = dv != 0 ? gap(vs_, j, dv) : ratioU;
        if (std::abs(ratioU - ratioV) > 1e-9) continue;
        linear += near + (near - far) * ratioU;
        ++linears;
    }
    if (linears > 0) return linear / linears;
    return constants > 0 ? constant / constants : kNone;
}

// Continues values to the nodes beyond the region's own voxels that lie inside or outside of its outline.
void RegionGrid::extendNodes(bool areInside, int steps) {
    const auto width = static_cast<std::ptrdiff_t>(us_.size()), height = static_cast<std::ptrdiff_t>(vs_.size());
    for (int step = 0; step < steps; ++step) {
        std::vector<std::pair<std::size_t, double>> found;
        for (std::ptrdiff_t j = 0; j < height; ++j)
            for (std::ptrdiff_t i = 0; i < width; ++i) {
                const auto own = static_cast<std::size_t>(i + j * width);
                const bool isWanted = (inside_[own] != 0) == areInside;
                if (!isWanted || nodes_[own] != Node::Beyond || !std::isnan(values_[own])) continue;
                const double value = continuedValue(i, j, areInside);
                if (!std::isnan(value)) found.emplace_back(own, std::max(value, source_.least));
            }
        if (found.empty()) return;
        for (const auto& [n, value] : found) values_[n] = value;
    }
}

// Nodes inside come first, so that each side of a wall has its own values when both meet in the wall.
void RegionGrid::extend() {
    double gap = kInfinity;
    for (const std::vector<double>* lines : {&us_, &vs_})
        for (std::size_t n = 0; n + 1 < lines->size(); ++n) gap = std::min(gap, (*lines)[n + 1] - (*lines)[n]);
    const Vec3d spacing = source_.volume.grid.spacing();
    const double voxels = std::ceil(kContinuedVoxels * std::max({spacing.x, spacing.y, spacing.z}) / gap);
    extendNodes(true, std::clamp(static_cast<int>(std::min(voxels, 1e3)), kContinuedNodes, kMostContinued));
    extendNodes(false, kContinuedNodes);
}

void RegionGrid::findPlaces() {
    places_.assign(columns() * rows(), Place::Outside);
    std::vector<std::pair<std::size_t, std::uint32_t>> pairs;
    const auto rowOf = [&](double v) {
        const auto above = static_cast<std::size_t>(std::upper_bound(vs_.begin(), vs_.end(), v) - vs_.begin());
        return std::clamp<std::size_t>(above == 0 ? 0 : above - 1, 0, rows() - 1);
    };
    const auto columnOf = [&](double u) {
        const auto above = static_cast<std::size_t>(std::upper_bound(us_.begin(), us_.end(), u) - us_.begin());
        return std::clamp<std::size_t>(above == 0 ? 0 : above - 1, 0, columns() - 1);
    };
    constexpr double kEdgeHair = 1e-9;
    for (std::uint32_t e = 0; e < edges_.size(); ++e) {
        const PlanePoint a = edges_[e].first, b = edges_[e].second;  // captured below
        const double low = std::min(a.v, b.v) - kEdgeHair, high = std::max(a.v, b.v) + kEdgeHair;
        for (std::size_t row = rowOf(low); row <= rowOf(high); ++row) {
            pairs.emplace_back(row, e);
            double from = std::min(a.u, b.u), to = std::max(a.u, b.u);
            if (a.v != b.v) {
                const auto uAt = [&](double v) {
                    return a.u +
                           (std::clamp(v, std::min(a.v, b.v), std::max(a.v, b.v)) - a.v) / (b.v - a.v) * (b.u - a.u);
                };
                const double u0 = uAt(vs_[row]), u1 = uAt(vs_[row + 1]);
                from = std::min(u0, u1);
                to = std::max(u0, u1);
            }
            for (std::size_t column = columnOf(from - kEdgeHair); column <= columnOf(to + kEdgeHair); ++column)
                places_[column + row * columns()] = Place::Border;
        }
    }
    std::sort(pairs.begin(), pairs.end());
    rowStarts_.assign(rows() + 1, 0);
    rowEdges_.clear();
    for (const auto& [row, edge] : pairs) {
        rowEdges_.push_back(edge);
        ++rowStarts_[row + 1];
    }
    for (std::size_t row = 0; row < rows(); ++row) rowStarts_[row + 1] += rowStarts_[row];
    for (std::size_t row = 0; row < rows(); ++row)
        for (std::size_t column = 0; column < columns(); ++column) {
            Place& place = places_[column + row * columns()];
            if (place == Place::Outside && inside_[node(column, row)] != 0) place = Place::Inside;
            bool isKnown = true;
            for (int corner = 0; corner < 4; ++corner) isKnown = isKnown && !std::isnan(value(column, row, corner));
            if (place != Place::Outside && !isKnown) place = Place::Missing;
        }
}

bool RegionGrid::isInside(std::size_t row, PlanePoint p) const noexcept {
    bool inside = false;
    for (const std::uint32_t e : edgesOf(row)) {
        const auto& [a, b] = edges_[e];
        if ((a.v > p.v) != (b.v > p.v) && a.u + (p.v - a.v) / (b.v - a.v) * (b.u - a.u) < p.u) inside = !inside;
    }
    return inside;
}

bool RegionGrid::holds(PlanePoint from, PlanePoint to) const noexcept {
    const auto cellOf = [](const std::vector<double>& lines, double at) {
        const auto above = static_cast<std::size_t>(std::upper_bound(lines.begin(), lines.end(), at) - lines.begin());
        return above == 0 || above == lines.size() ? lines.size() : above - 1;
    };
    const std::size_t column = cellOf(us_, from.u), row = cellOf(vs_, from.v), lastRow = cellOf(vs_, to.v);
    if (column >= columns() || row >= rows() || lastRow >= rows()) return false;
    const Place place = placeOf(column, row);
    if (place == Place::Outside || place == Place::Missing || !isInside(row, from)) return false;
    // Whether the points of an edge lie on different sides of a line.
    const auto divides = [](PlanePoint a, PlanePoint b, PlanePoint p, PlanePoint q) {
        const auto sideOf = [&](PlanePoint r) { return (b.u - a.u) * (r.v - a.v) - (b.v - a.v) * (r.u - a.u); };
        return (sideOf(p) > 0) != (sideOf(q) > 0);
    };
    for (std::size_t r = std::min(row, lastRow); r <= std::max(row, lastRow); ++r)
        for (const std::uint32_t e : edgesOf(r)) {
            const auto& [a, b] = edges_[e];
            if (divides(from, to, a, b) && divides(a, b, from, to)) return false;
        }
    return true;
}

std::vector<std::pair<PlanePoint, PlanePoint>> RegionGrid::clip(std::size_t column, std::size_t row, PlanePoint from,
                                                                PlanePoint to) const {
    std::vector<double> cuts{0, 1};
    const double u = to.u - from.u, v = to.v - from.v;
    const double left = us_[column], right = us_[column + 1];
    for (const std::uint32_t e : edgesOf(row)) {
        const auto& [a, b] = edges_[e];
        if (std::max(a.u, b.u) < left || std::min(a.u, b.u) > right) continue;
        const double eu = b.u - a.u, ev = b.v - a.v, area = u * ev - v * eu;
        if (area == 0) continue;
        const double t = ((a.u - from.u) * ev - (a.v - from.v) * eu) / area;
        const double s = ((a.u - from.u) * v - (a.v - from.v) * u) / area;
        if (t > 0 && t < 1 && s >= -1e-9 && s <= 1 + 1e-9) cuts.push_back(t);
    }
    std::sort(cuts.begin(), cuts.end());
    std::vector<std::pair<PlanePoint, PlanePoint>> parts;
    const auto at = [&](double t) { return t == 0 ? from : t == 1 ? to : PlanePoint{from.u + u * t, from.v + v * t}; };
    for (std::size_t n = 0; n + 1 < cuts.size(); ++n) {
        if (!(cuts[n + 1] - cuts[n] > 1e-12) || !isInside(row, at((cuts[n] + cuts[n + 1]) / 2))) continue;
        // Adjacent parts become one again.
        if (!parts.empty() && parts.back().second == at(cuts[n]))
            parts.back().second = at(cuts[n + 1]);
        else
            parts.emplace_back(at(cuts[n]), at(cuts[n + 1]));
    }
    return parts;
}

std::vector<Ring> RegionGrid::ringsIn(std::size_t column, std::size_t row) const {
    const auto above = [](double v) { return [v](PlanePoint p) { return p.v - v; }; };
    const auto below = [](double v) { return [v](PlanePoint p) { return v - p.v; }; };
    const auto after = [](double u) { return [u](PlanePoint p) { return p.u - u; }; };
    const auto before = [](double u) { return [u](PlanePoint p) { return u - p.u; }; };
    const auto atV = [](double v) { return [v](PlanePoint p) { return PlanePoint{p.u, v}; }; };
    const auto atU = [](double u) { return [u](PlanePoint p) { return PlanePoint{u, p.v}; }; };
    if (clippedRow_ != row) {
        clippedRow_ = row;
        rowRings_.clear();
        const double low = vs_[row], high = vs_[row + 1];
        for (const Ring& ring : region_.rings) {
            Ring part = clipBy(clipBy(ring, above(low), atV(low)), below(high), atV(high));
            if (!part.empty()) rowRings_.push_back(std::move(part));
        }
    }
    std::vector<Ring> rings;
    const double left = us_[column], right = us_[column + 1];
    for (const Ring& ring : rowRings_) {
        Ring part = clipBy(clipBy(ring, after(left), atU(left)), before(right), atU(right));
        if (!part.empty()) rings.push_back(std::move(part));
    }
    return rings;
}

bool RegionGrid::isInComponent(std::size_t column, std::size_t row) const noexcept {
    // The outline of a room may reach into voxels of its walls.
    if (!hasEmptySpace_) return true;
    for (int n = 0; n < 4; ++n) {
        const volume::Scalar scalar = scalarAt(corner(column, row, n));
        if (inside_[node(column + (n == 1 || n == 2 ? 1 : 0), row + (n >= 2 ? 1 : 0))] != 0 && scalar != 0 &&
            source_.isMedium[scalar] != 0 && (source_.isAir[scalar] != 0) == region_.isAir)
            return true;
    }
    return false;
}

}  // namespace svt::drawing
