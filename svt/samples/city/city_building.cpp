#include <svt/samples/city/city_building.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

namespace svt::samples::city {
namespace {

constexpr std::int64_t kBlockWidth = 92'000, kBlockDepth = 50'000, kStreet = 13'000;
constexpr std::int64_t kLotsOfRow = Layout::kLots / 2;

std::uint64_t mixed(std::uint64_t a, std::uint64_t b) { return Random(a * kHashFactor + b).next(); }

// A rectangle of the plan.
struct Lot {
    std::int64_t west = 0, east = 0, south = 0, north = 0, ground = 0;
    bool isTerraced = false;
};

// Height of the ground: slopes of a few percent, whole millimetres.
std::int64_t groundAt(std::int64_t x, std::int64_t y) {
    const auto wave = [](std::int64_t at, std::int64_t length, std::int64_t height) {
        const std::int64_t phase = ((at % length) + length) % length;
        return std::min(phase, length - phase) * 2 * height / length;
    };
    return 34'000 + wave(x + y / 3, 1'900'000, 9'000) + wave(y - x / 2, 2'700'000, 14'000);
}

// Widths of the lots of a row are drawn together, so that neighbours share their border.
Lot lotOf(const CitySampleOptions& options, std::int64_t column, std::int64_t row, std::int64_t lot) {
    const bool isNorth = lot >= kLotsOfRow;
    Draw draw(mixed(mixed(options.seed, static_cast<std::uint64_t>(column) << 32 ^ static_cast<std::uint64_t>(row)),
                    isNorth ? 2 : 1));
    Lot result;
    result.isTerraced = draw.below(3) != 0;
    std::array<std::int64_t, kLotsOfRow> width{};
    std::int64_t sum = 0;
    for (std::int64_t& w : width) sum += w = draw.between(7'000, 14'000);
    std::int64_t west = column * (kBlockWidth + kStreet);
    for (std::int64_t n = 0; n < kLotsOfRow; ++n) {
        const std::int64_t w =
            width[static_cast<std::size_t>(n)] * kBlockWidth / std::max<std::int64_t>(sum, 1) / 10 * 10;
        if (n == lot % kLotsOfRow) {
            result.west = west;
            result.east = west + w;
        }
        west += w;
    }
    const std::int64_t south = row * (kBlockDepth + kStreet);
    const std::int64_t depth = draw.between(10'000, 14'000) / 100 * 100;
    result.south = isNorth ? south + kBlockDepth - depth : south;
    result.north = result.south + depth;
    const std::int64_t middle = column * (kBlockWidth + kStreet) + kBlockWidth / 2;
    result.ground = groundAt(middle, south + kBlockDepth / 2);
    return result;
}

Face face(FaceKind kind, Ring ring) { return {kind, {std::move(ring)}}; }

// A prism over a counter-clockwise footprint.
Body prism(const std::vector<std::array<std::int64_t, 2>>& plan, std::int64_t bottom, std::int64_t top) {
    Body body;
    Ring floor, roof;
    for (const auto& p : plan) {
        floor.insert(floor.begin(), {p[0], p[1], bottom});
        roof.push_back({p[0], p[1], top});
    }
    body.faces.push_back(face(FaceKind::Ground, std::move(floor)));
    body.faces.push_back(face(FaceKind::Roof, std::move(roof)));
    for (std::size_t i = 0; i < plan.size(); ++i) {
        const auto& a = plan[i];
        const auto& b = plan[(i + 1) % plan.size()];
        body.faces.push_back(
            face(FaceKind::Wall, {{a[0], a[1], bottom}, {b[0], b[1], bottom}, {b[0], b[1], top}, {a[0], a[1], top}}));
    }
    return body;
}

// A house whose ridge runs along the street.
Body gabled(const Lot& lot, std::int64_t eaves, std::int64_t ridge) {
    const std::int64_t middle = (lot.south + lot.north) / 2, ground = lot.ground;
    const Point a{lot.west, lot.south, ground}, b{lot.east, lot.south, ground}, c{lot.east, lot.north, ground},
        d{lot.west, lot.north, ground};
    const auto up = [](Point p, std::int64_t z) { return Point{p.x, p.y, z}; };
    const Point west{lot.west, middle, ridge}, east{lot.east, middle, ridge};
    Body body;
    body.faces = {face(FaceKind::Ground, {d, c, b, a}),
                  face(FaceKind::Roof, {up(a, eaves), up(b, eaves), east, west}),
                  face(FaceKind::Roof, {up(c, eaves), up(d, eaves), west, east}),
                  face(FaceKind::Wall, {a, b, up(b, eaves), up(a, eaves)}),
                  face(FaceKind::Wall, {b, c, up(c, eaves), east, up(b, eaves)}),
                  face(FaceKind::Wall, {c, d, up(d, eaves), up(c, eaves)}),
                  face(FaceKind::Wall, {d, a, up(a, eaves), west, up(d, eaves)})};
    return body;
}

// A footprint with `bays` that stand out of its front and its back.
std::vector<std::array<std::int64_t, 2>> bayedPlan(const Lot& lot, std::int64_t bays) {
    constexpr std::int64_t kDepth = 900;
    std::vector<std::array<std::int64_t, 2>> plan;
    const std::int64_t front = (bays + 1) / 2, back = bays / 2, width = lot.east - lot.west;
    const auto side = [&](std::int64_t count, std::int64_t from, std::int64_t direction, std::int64_t y) {
        plan.push_back({from, y});
        for (std::int64_t i = 0; i < count; ++i) {
            const std::int64_t begin = from + direction * (width * (2 * i + 1) / (2 * count + 1));
            const std::int64_t end = from + direction * (width * (2 * i + 2) / (2 * count + 1));
            plan.push_back({begin, y});
            plan.push_back({begin, y - direction * kDepth});
            plan.push_back({end, y - direction * kDepth});
            plan.push_back({end, y});
        }
    };
    side(front, lot.west, 1, lot.south);
    plan.push_back({lot.east, lot.south});
    side(back, lot.east, -1, lot.north);
    plan.push_back({lot.west, lot.north});
    return plan;
}

// An oval of `count` corners.
std::vector<std::array<std::int64_t, 2>> ovalPlan(const Lot& lot, std::int64_t count) {
    const double halfWidth = double(lot.east - lot.west) / 2, halfDepth = double(lot.north - lot.south) / 2;
    std::vector<std::array<std::int64_t, 2>> plan;
    for (std::int64_t i = 0; i < count; ++i) {
        const double angle = 6.283185307179586 * double(i) / double(count);
        // Rounded twice, so that the last bit of a machine's cosine does not show.
        const auto at = [](double middle, double half, double part) {
            return std::llround(middle + half * (std::round(part * 1e9) / 1e9));
        };
        const std::array<std::int64_t, 2> p{at(double(lot.west) + halfWidth, halfWidth, std::cos(angle)),
                                            at(double(lot.south) + halfDepth, halfDepth, std::sin(angle))};
        if (plan.empty() || plan.back() != p) plan.push_back(p);
    }
    while (plan.size() > 3 && plan.back() == plan.front()) plan.pop_back();
    return plan;
}

// Windows in the wall: holes with a face of their own in the same plane.
void addWindows(Body& body, std::int64_t storeyHeight) {
    const std::size_t walls = body.faces.size();
    for (std::size_t f = 0; f < walls; ++f) {
        const Ring wall = body.faces[f].rings.front();
        if (body.faces[f].kind != FaceKind::Wall || wall.size() != 4) continue;
        const Point a = wall[0], b = wall[1];
        const std::int64_t length = std::max(std::llabs(b.x - a.x), std::llabs(b.y - a.y)), height = wall[2].z - a.z;
        if (length < 3'000 || (b.x - a.x) * (b.y - a.y) != 0) continue;
        const std::int64_t count = length / 2'500;
        for (std::int64_t z = a.z + 900; z + 1'500 < a.z + height; z += storeyHeight)
            for (std::int64_t i = 0; i < count; ++i) {
                const std::int64_t begin = length * (2 * i + 1) / (2 * count + 1);
                const std::int64_t end = length * (2 * i + 2) / (2 * count + 1);
                const auto at = [&](std::int64_t along, std::int64_t up) {
                    return Point{a.x + (b.x - a.x) * along / length, a.y + (b.y - a.y) * along / length, up};
                };
                Ring window{at(begin, z), at(end, z), at(end, z + 1'300), at(begin, z + 1'300)};
                body.faces[f].rings.push_back({window[3], window[2], window[1], window[0]});
                body.faces.push_back(face(FaceKind::Window, std::move(window)));
            }
    }
}

// Two rooms to a storey, 300 mm within the hull; their faces look into the hull, as those of a solid do.
void addRooms(Building& building, const Lot& lot, std::int64_t eaves, std::int64_t storeyHeight) {
    constexpr std::int64_t kWall = 300;
    const std::int64_t middle = (lot.west + lot.east) / 2;
    for (std::int64_t bottom = lot.ground + kWall; bottom + storeyHeight <= eaves; bottom += storeyHeight)
        for (const bool isEast : {false, true}) {
            Body room =
                box({isEast ? middle + kWall / 2 : lot.west + kWall, lot.south + kWall, bottom},
                    {isEast ? lot.east - kWall : middle - kWall / 2, lot.north - kWall, bottom + storeyHeight - kWall});
            room.isRoom = true;
            for (Face& f : room.faces)
                f.kind = f.kind == FaceKind::Ground ? FaceKind::Floor
                         : f.kind == FaceKind::Roof ? FaceKind::Ceiling
                                                    : FaceKind::InteriorWall;
            building.bodies.push_back(std::move(room));
        }
}

std::int64_t heightOf(const CitySampleOptions& options, const Layout& layout, std::int64_t column, std::int64_t row,
                      Draw& draw) {
    const double x = double(2 * column + 1) / double(layout.columns) - 1,
                 y = double(2 * row + 1) / double(layout.rows) - 1;
    const double nearness = std::max(0.0, 1 - 2.5 * (x * x + y * y));
    const double median = options.profile == CityProfile::NewYork || options.profile == CityProfile::Plateau
                              ? 8 + 26 * nearness * nearness
                              : 8.5 + 7 * nearness * nearness;
    const double metres = median * std::exp(0.32 * draw.normal());
    return std::clamp<std::int64_t>(std::llround(metres * 100) * 10, 3'000, 380'000);
}

// The shape that has about `vertices` of them.
void shape(Building& building, const Lot& lot, std::int64_t vertices, std::int64_t height) {
    const std::int64_t top = lot.ground + height;
    building.roof = "1000";
    if (building.lod == 1 || vertices < 10) {
        building.bodies.push_back(box({lot.west, lot.south, lot.ground}, {lot.east, lot.north, top}));
    } else if (vertices < 36) {
        const std::int64_t rise = std::min<std::int64_t>(height / 2, (lot.north - lot.south) * 3 / 8);
        building.roof = "1030";
        building.bodies.push_back(gabled(lot, top - rise, top));
        std::int64_t west = lot.west + 500;
        for (std::int64_t n = 0; n < (vertices - 6) / 8 && west + 2'000 < lot.east; ++n, west += 2'600)
            building.bodies.push_back(box({west, lot.north, lot.ground},
                                          {west + 2'000, lot.north + 1'800 + 300 * n,
                                           lot.ground + std::min<std::int64_t>(2'600, (height - rise) * 3 / 4)}));
    } else if (vertices < 160) {
        building.bodies.push_back(prism(bayedPlan(lot, (vertices - 8) / 8), lot.ground, top));
    } else {
        building.bodies.push_back(prism(ovalPlan(lot, vertices / 2), lot.ground, top));
    }
}

}  // namespace

Body box(Point low, Point high) {
    return prism({{low.x, low.y}, {high.x, low.y}, {high.x, high.y}, {low.x, high.y}}, low.z, high.z);
}

double Draw::normal() {
    double sum = -6;
    for (int i = 0; i < 12; ++i) sum += double(next() >> 12) * 0x1p-52;
    return sum;
}

Layout Layout::of(const CitySampleOptions& options) {
    Layout layout;
    const auto blocks = static_cast<std::int64_t>((options.buildings + kLots - 1) / kLots);
    const double ratio = double(kBlockDepth + kStreet) / double(kBlockWidth + kStreet);
    layout.columns = std::max<std::int64_t>(1, std::llround(std::sqrt(double(blocks) * ratio)));
    layout.rows = (blocks + layout.columns - 1) / layout.columns;
    for (int n = 1; n * n <= options.files; ++n)
        if (options.files % n == 0) layout.fileColumns = n;
    layout.fileRows = options.files / layout.fileColumns;
    return layout;
}

Building makeBuilding(const CitySampleOptions& options, const Layout& layout, std::int64_t column, std::int64_t row,
                      std::int64_t lotNumber) {
    Lot lot = lotOf(options, column, row, lotNumber);
    Building building;
    building.number = static_cast<std::uint64_t>((row * layout.columns + column) * Layout::kLots + lotNumber);
    Draw draw(mixed(options.seed ^ 0xC17Eull, building.number));
    const std::int64_t height = heightOf(options, layout, column, row, draw);
    if (!lot.isTerraced) {
        lot.west += draw.between(1'000, 1'600);
        lot.east -= draw.between(1'000, 1'600);
    }
    const std::int64_t lodDraw = draw.below(1000);
    building.lod = lodDraw < 100 ? 1 : lodDraw < 110 ? 3 : lodDraw < 112 ? 4 : 2;
    // Below LoD3 a building of the measured cities has no opening; the few with openings have their own distribution.
    const std::int64_t vertices =
        building.lod >= 3 ? 10 : std::clamp<std::int64_t>(std::llround(22 * std::exp(1.1 * draw.normal())), 8, 4'200);
    shape(building, lot, vertices, height);
    building.heightMillimetres = height;
    building.storeys = static_cast<int>(std::max<std::int64_t>(1, height / 3'000));
    if (building.lod >= 3) addWindows(building.bodies.front(), 2'900);
    if (building.lod == 4) addRooms(building, lot, lot.ground + height / 2, 2'700);
    if (draw.below(1000) == 0) {
        building.isBroken = true;
        auto& faces = building.bodies.front().faces;
        faces.erase(faces.begin() + 2 + draw.below(static_cast<std::int64_t>(faces.size()) - 2));
    }
    const std::int64_t missing = draw.below(200);
    if (missing < 2) building.heightText = missing == 0 ? "-9999" : "9999";
    return building;
}

std::uint64_t vertexCount(const Building& building) {
    std::set<Point> points;
    for (const Body& body : building.bodies)
        for (const Face& f : body.faces)
            if (!body.isRoom) points.insert(f.rings.front().begin(), f.rings.front().end());
    return points.size();
}

}  // namespace svt::samples::city
