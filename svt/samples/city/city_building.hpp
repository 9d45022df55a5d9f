#pragma once
/// \file
/// One building of a generated city: the place of its lot, and its shape in whole millimetres of the town's own plan.

#include <svt/core/vec.hpp>
#include <svt/samples/city_sample.hpp>
#include <svt/samples/parts/random.hpp>

#include <cstdint>
#include <string_view>
#include <vector>

namespace svt::samples::city {

/// The random numbers of a building.
class Draw : public Random {
public:
    using Random::Random;
    /// least <= value <= most
    std::int64_t between(std::int64_t least, std::int64_t most) { return least + below(most - least + 1); }
    /// Normal with mean 0 and deviation 1: the sum of twelve uniform numbers less six, exact on every machine.
    double normal();
};

using Point = Vec3<std::int64_t>;  ///< millimetres, plan of the town: x along the streets, z above datum
using Ring = std::vector<Point>;

enum class FaceKind : std::uint8_t { Ground, Wall, Roof, Window, Ceiling, Floor, InteriorWall };

/// A face, counter-clockwise from outside (of a room: from within the room's air outwards).
struct Face {
    FaceKind kind = FaceKind::Wall;
    std::vector<Ring> rings;  ///< the first is the exterior
};

/// A body with its faces; a room has `isRoom`.
struct Body {
    std::vector<Face> faces;
    bool isRoom = false;
};

struct Building {
    std::uint64_t number = 0;
    int lod = 2;               ///< 1..4
    std::vector<Body> bodies;  ///< the first is the main one, others are parts and rooms
    std::int64_t heightMillimetres = 0;
    int storeys = 1;
    bool isBroken = false;          ///< a face of the first body is missing
    std::string_view roof;          ///< "1000" flat, "1030" gable
    std::string_view heightText{};  ///< in place of the height: a number that means that it is unknown
};

/// The arrangement of the lots of a city.
struct Layout {
    static constexpr std::int64_t kLots = 16;  ///< of a block: two rows of eight
    std::int64_t columns = 1, rows = 1;        ///< blocks from west to east and from south to north
    int fileColumns = 1, fileRows = 1;         ///< files, likewise

    [[nodiscard]] static Layout of(const CitySampleOptions& options);
    /// First block column (or row) of a file's column (or row).
    [[nodiscard]] std::int64_t firstColumn(std::int64_t fileColumn) const { return columns * fileColumn / fileColumns; }
    [[nodiscard]] std::int64_t firstRow(std::int64_t fileRow) const { return rows * fileRow / fileRows; }
};

/// The building on lot `lot` of block (column, row).
[[nodiscard]] Building makeBuilding(const CitySampleOptions& options, const Layout& layout, std::int64_t column,
                                    std::int64_t row, std::int64_t lot);

/// A vertical box.
[[nodiscard]] Body box(Point low, Point high);

/// The number of different points of all bodies except rooms.
[[nodiscard]] std::uint64_t vertexCount(const Building& building);

}  // namespace svt::samples::city
