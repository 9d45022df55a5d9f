/// The search for places of texts: it finds what a search of all obstacles and all places finds, and its work grows with
/// the number of rooms and no faster.

#include <svt/drawing/clip_segment.hpp>
#include <svt/writers/marks/blocked_places.hpp>
#include <svt/writers/marks/room_stamps.hpp>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace svt::writers {
namespace {

using drawing::PlanePoint;

/// Obstacles in plain lists: the search without an index.
struct PlainSpace {
    struct Segment {
        PlanePoint from, to;
        Obstacle kind;
    };
    std::vector<Segment> segments;
    std::vector<MarkBox> taken;

    [[nodiscard]] static bool overlap(const MarkBox& a, const MarkBox& b) {
        return a.low.u < b.high.u && b.low.u < a.high.u && a.low.v < b.high.v && b.low.v < a.high.v;
    }
    [[nodiscard]] FreeSpace::Hits hitsOf(const MarkBox& box) const {
        FreeSpace::Hits hits;
        for (const Segment& segment : segments)
            if (meets(segment.from, segment.to, box))
                ++(segment.kind == Obstacle::Border ? hits.borders
                   : segment.kind == Obstacle::Line ? hits.lines
                                                    : hits.light);
        hits.isTaken = std::any_of(taken.begin(), taken.end(), [&](const MarkBox& b) { return overlap(b, box); });
        return hits;
    }
    [[nodiscard]] bool crossesTaken(PlanePoint from, PlanePoint to) const {
        return std::any_of(taken.begin(), taken.end(), [&](const MarkBox& b) { return meets(from, to, b); });
    }
};

/// The same obstacles with and without the index: short, long, upright, level and oblique ones, points, and taken places.
struct BothSpaces {
    FreeSpace fast;
    PlainSpace plain;
    std::mt19937 random{7};

    double number(double low, double high) {
        return low + (high - low) * static_cast<double>(random()) / static_cast<double>(std::mt19937::max());
    }
    PlanePoint point(double reach) { return {number(-reach, reach), number(-reach, reach)}; }

    void add(PlanePoint from, PlanePoint to, Obstacle kind) {
        fast.add(from, to, kind);
        plain.segments.push_back({from, to, kind});
    }
    void take(const MarkBox& box) {
        fast.take(box);
        plain.taken.push_back(box);
    }
    void addAll(int count, double reach) {
        for (int n = 0; n < count; ++n) {
            const PlanePoint from = point(reach);
            const double length = n % 10 == 0 ? reach : 12;
            PlanePoint to{from.u + number(-length, length), from.v + number(-length, length)};
            if (n % 5 == 1) to.u = from.u;
            if (n % 5 == 2) to.v = from.v;
            if (n % 50 == 3) to = from;
            add(from, to, static_cast<Obstacle>(n % 3));
            // On the sides of squares, cells and tiles.
            if (n % 20 == 4) add({std::round(from.u), std::round(from.v)}, {std::round(from.u), 64}, Obstacle::Line);
            if (n % 8 == 5) take({from, {from.u + number(0, 9), from.v + number(0, 5)}});
        }
    }
};

TEST(FreeSpace, FindsWhatASearchOfAllObstaclesFinds) {
    constexpr double kReach = 150;  // across the zero of the coordinates, and over several tiles
    BothSpaces spaces;
    spaces.addAll(400, kReach);
    int clear = 0, taken = 0;
    for (int n = 0; n < 20000; ++n) {
        const PlanePoint low = spaces.point(1.2 * kReach);
        MarkBox box{low, {low.u + spaces.number(0.1, n % 3 == 0 ? 40 : 8), low.v + spaces.number(0.1, 8)}};
        if (n % 7 == 0) box = {{std::round(low.u), std::round(low.v)}, {std::round(low.u) + 8, std::round(low.v) + 3}};
        const FreeSpace::Hits plain = spaces.plain.hitsOf(box), all = spaces.fast.hitsOf(box);
        ASSERT_EQ(all.borders, plain.borders) << n;
        ASSERT_EQ(all.lines, plain.lines) << n;
        ASSERT_EQ(all.light, plain.light) << n;
        ASSERT_EQ(all.isTaken, plain.isTaken) << n;
        ASSERT_EQ(spaces.fast.isClear(box), plain.isClear()) << n;
        const FreeSpace::Hits few = spaces.fast.hitsOf(box, 2);
        const bool isRefused = plain.isTaken || plain.borders > 0 || plain.lines > 2;
        ASSERT_EQ(few.isTaken || few.borders > 0 || few.lines > 2, isRefused) << n;
        ASSERT_EQ(few.light, isRefused ? few.light : plain.light) << n;
        const PlanePoint to = spaces.point(kReach);
        ASSERT_EQ(spaces.fast.crossesTaken(low, to), spaces.plain.crossesTaken(low, to)) << n;
        clear += plain.isClear() ? 1 : 0;
        taken += plain.isTaken ? 1 : 0;
    }
    EXPECT_GT(clear, 1000);
    EXPECT_GT(taken, 500);
}

// One bit refuses most places that have an obstacle, and no others.
TEST(BlockedPlaces, RefuseOnlyWhatASearchRefuses) {
    constexpr double kReach = 150;
    BothSpaces spaces;
    spaces.addAll(300, kReach);
    for (const auto& [width, height] :
         {std::pair(8.0, 3.0), {21.7, 4.3}, {64.0, 64.0}, {150.2, 9.9}, {2.0, 2.0}, {1.9, 9.0}}) {
        const BlockedPlaces all(spaces.fast, {{-kReach, -100}, {kReach, 130.5}}, {width, height}, true),
            solid(spaces.fast, {{-kReach, -100}, {kReach, 130.5}}, {width, height}, false);
        int refused = 0, notClear = 0;
        for (int n = 0; n < 4000; ++n) {
            PlanePoint low = spaces.point(1.2 * kReach);
            if (n % 7 == 0) low = {std::round(low.u), std::round(low.v)};
            const MarkBox box{low, {low.u + width, low.v + height}};
            const FreeSpace::Hits plain = spaces.plain.hitsOf(box);
            ASSERT_FALSE(all.isBlocked(box) && plain.isClear()) << width << ' ' << n;
            ASSERT_FALSE(solid.isBlocked(box) && !plain.isTaken && plain.borders == 0) << width << ' ' << n;
            ASSERT_FALSE(solid.isBlocked(box) && !all.isBlocked(box)) << width << ' ' << n;
            refused += all.isBlocked(box) ? 1 : 0;
            notClear += plain.isClear() ? 0 : 1;
        }
        // Rectangles below 3 mm may contain no whole square.
        EXPECT_EQ(refused > 0, width > 2 && height > 2) << width;
        EXPECT_TRUE(width < 8 || refused > notClear / 5) << width;
    }
}

constexpr double kPerMetre = 10;  // on paper per metre

/// A drawing with rooms, numbered from 0, in metres.
struct Rooms {
    drawing::SectionDrawing drawing;
    std::vector<RoomStamp> stamps;

    void add(const drawing::Ring& outer, double area, std::vector<std::string> lines) {
        const auto label = static_cast<std::uint32_t>(stamps.size());
        drawing.components.push_back({label, {{outer, {}, area}}, area, 0, true, 0});
        stamps.push_back({label, std::move(lines)});
    }
};

constexpr double kTriedSizes[] = {2.5, 2, 1.8}, kTriedAround = 0.8;

/// Whether a stamp of a room may stand at a place: its cost, or nothing.
std::optional<double> costAt(PlanePoint at, PlanePoint center, std::pair<double, double> extent,
                             const drawing::Ring& room, const PlainSpace& space, int mostLines) {
    const double u = 0.5 * extent.first + kTriedAround, v = 0.5 * extent.second + kTriedAround;
    const MarkBox box{{at.u - u, at.v - v}, {at.u + u, at.v + v}};
    bool isInside = false;
    for (std::size_t n = 0; n < room.size(); ++n) {
        const PlanePoint a{room[n].u * kPerMetre, room[n].v * kPerMetre},
            b{room[(n + 1) % room.size()].u * kPerMetre, room[(n + 1) % room.size()].v * kPerMetre};
        if (meets(a, b, box)) return std::nullopt;
        if ((a.v > at.v) != (b.v > at.v) && at.u < a.u + (at.v - a.v) / (b.v - a.v) * (b.u - a.u)) isInside = !isInside;
    }
    const FreeSpace::Hits hits = space.hitsOf(box);
    if (!isInside || hits.isTaken || hits.borders > 0 || hits.lines > mostLines) return std::nullopt;
    return std::hypot(at.u - center.u, at.v - center.v) + 20 * hits.lines + 2 * hits.light;
}

/// The place and size of a stamp of one line by a search of all places, in the order of the lattice.
std::optional<std::pair<PlanePoint, double>> placeByAll(const Rooms& rooms, const PlainSpace& space) {
    const auto& polygon = rooms.drawing.components.front().polygons.front();
    const auto [left, right] =
        std::minmax_element(polygon.outer.begin(), polygon.outer.end(), [](auto a, auto b) { return a.u < b.u; });
    const auto [low, high] =
        std::minmax_element(polygon.outer.begin(), polygon.outer.end(), [](auto a, auto b) { return a.v < b.v; });
    const drawing::TextPlace text = drawing::findTextPlace(polygon);
    const PlanePoint center{text.center.u * kPerMetre, text.center.v * kPerMetre};
    for (const int mostLines : {0, 6})
        for (const double size : kTriedSizes) {
            const auto extent = sizeOfLines(rooms.stamps.front().lines, size);
            double least = std::numeric_limits<double>::infinity();
            PlanePoint best;
            const auto attempt = [&](PlanePoint at) {
                const auto cost = costAt(at, center, extent, polygon.outer, space, mostLines);
                if (!cost || *cost >= least) return;
                least = *cost;
                best = at;
            };
            attempt(center);
            for (int i = 0; i <= 24; ++i)
                for (int j = 0; j <= 24; ++j)
                    attempt({left->u * kPerMetre + (right->u * kPerMetre - left->u * kPerMetre) * i / 24,
                             low->v * kPerMetre + (high->v * kPerMetre - low->v * kPerMetre) * j / 24});
            if (std::isfinite(least)) return std::pair(best, size);
        }
    return std::nullopt;
}

// A room with furniture, an L-shaped one, with few and with many obstacles.
TEST(RoomStamps, StandWhereASearchOfAllPlacesPutsThem) {
    const drawing::Ring wide{{0, 0}, {6, 0}, {6, 4}, {0, 4}}, bent{{0, 0}, {6, 0}, {6, 1.5}, {2, 1.5}, {2, 5}, {0, 5}};
    int inside = 0, none = 0, moved = 0;
    for (unsigned seed = 0; seed < 60; ++seed) {
        BothSpaces spaces;
        spaces.random.seed(seed);
        for (unsigned n = 0; n < 9 * seed; ++n) {
            const PlanePoint from{spaces.number(0, 60), spaces.number(0, 50)};
            spaces.add(from, {from.u + spaces.number(-9, 9), from.v + spaces.number(-9, 9)},
                       n % 4 == 0 ? Obstacle::Border : static_cast<Obstacle>(1 + n % 2));
        }
        Rooms rooms;
        rooms.add(seed % 2 == 0 ? wide : bent, 10, {"Bicyclestorage"});
        const auto expected = placeByAll(rooms, spaces.plain);
        const MarkBox nowhere{{0, 0}, {0, 0}};
        const PlacedStamps placed = placeStamps(rooms.drawing, rooms.stamps, kPerMetre, nowhere, spaces.fast);
        ASSERT_EQ(placed.shapes.texts.size(), expected ? 1u : 0u) << seed;
        (expected ? inside : none) += 1;
        if (!expected) continue;
        const MarkText& text = placed.shapes.texts.front();
        EXPECT_EQ(text.size, expected->second) << seed;
        EXPECT_EQ(text.at.u, expected->first.u) << seed;
        moved += seed > 0 && text.size < 2.5 ? 1 : 0;
    }
    EXPECT_GT(inside, 20);
    EXPECT_GT(none, 3);
    EXPECT_GT(moved, 3);
}

/// The work of placing the stamps of a section through a tower: per storey, wide rooms with a stamp in them, and narrow
/// ones whose stamps look for a place outside.
FreeSpace::Effort effortOf(int storeys) {
    constexpr int kWide = 6, kNarrow = 6;
    constexpr double kHeight = 3, kWidth = 4, kSlim = 0.4;  // metres
    Rooms rooms;
    FreeSpace space;
    const double width = kWide * kWidth + kNarrow * kSlim;
    for (int storey = 0; storey < storeys; ++storey) {
        const double low = storey * kHeight;
        double left = 0;
        space.add({0, low * kPerMetre}, {width * kPerMetre, low * kPerMetre}, Obstacle::Border);
        for (int room = 0; room < kWide + kNarrow; ++room) {
            const double right = left + (room < kWide ? kWidth : kSlim), top = low + kHeight;
            space.add({left * kPerMetre, low * kPerMetre}, {left * kPerMetre, top * kPerMetre}, Obstacle::Border);
            rooms.add({{left, low}, {right, low}, {right, top}, {left, top}}, (right - left) * kHeight,
                      {fmt::format("Room{}.{}", storey, room)});
            left = right;
        }
    }
    const double all = storeys * kHeight * kPerMetre;
    const MarkBox allowed{{-150, -20}, {width * kPerMetre + 150, all + 20}};
    (void)placeStamps(rooms.drawing, rooms.stamps, kPerMetre, allowed, space);
    return space.effort();
}

// Operations are counted, because times depend on the machine.
TEST(RoomStamps, TheWorkGrowsWithTheStoreys) {
    const FreeSpace::Effort few = effortOf(20), many = effortOf(60);
    ASSERT_GT(few.searches, 100'000u);
    ASSERT_GT(few.compared, 100'000u);
    EXPECT_LE(many.searches, 3.6 * static_cast<double>(few.searches));
    EXPECT_LE(many.compared, 3.6 * static_cast<double>(few.compared));
    // Bits decide most searches: few obstacles are left to compare with.
    EXPECT_LE(many.compared, 2 * many.searches);
}

}  // namespace
}  // namespace svt::writers
