#pragma once
/// \file
/// Models that the project generates itself: a furnished house, a residential tower with flats as legal spaces,
/// a district of houses. They are the demo, the ground truth of the tests and the load of the benchmarks.
/// README.md in this folder shows the plans.

#include <svt/core/result.hpp>
#include <svt/core/vec.hpp>

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace svt::samples {

enum class SampleKind : std::uint8_t { House, Tower, District };

enum class SampleFormat : std::uint8_t {
    CityGml3,     ///< CityGML 3.0, GML 3.2
    CityGml2,     ///< CityGML 2.0 LoD4; see SampleOptions::thematic
    CityJson2,    ///< CityJSON 2.0, one document
    CityJsonSeq2  ///< CityJSON 2.0, one line for the head and one for each building
};

/// What to generate. A value out of range is Code::BadArgument with its name, the value and the range.
struct SampleOptions {
    std::uint64_t seed = 1;              ///< decides the owners in the tower and the houses of the district
    int storeys = 8;                     ///< tower, 1..200
    int flatsPerStorey = 4;              ///< tower, 2..8
    int columns = 4;                     ///< district, 1..1000, from west to east
    int rows = 3;                        ///< district, 1..1000, from south to north
    double turnDegrees = 0;              ///< turn in plan about the model's centre, counter-clockwise, -360..360
    Vec3d origin{500000, 5400000, 100};  ///< world position of the plan's south-west corner on the ground floor before
                                         ///< the turn, EPSG:25832, metres, rounded to millimetres; each within +-1e7
    bool thematic = false;  ///< CityGML 2.0 only: the classical LoD4 model, with boundary surfaces, outer hull and
                            ///< rooms but without solids for walls, slabs, beams and roof members
};

/// All p with dot(normal, p) <= offset; normal is a unit vector. World space, metres.
struct HalfSpace {
    Vec3d normal;
    double offset = 0;
};

/// A convex piece: the intersection of its half-spaces.
struct SamplePiece {
    bool adds = true;  ///< false: taken away from the pieces before it
    std::vector<HalfSpace> sides;
};

/// What a component is, known without looking at the file.
struct SampleComponent {
    std::string id;         ///< as in every file, whatever the format
    std::string className;  ///< CityGML 3.0
    std::string name;
    std::string parent;  ///< id of the owner as in CityGML 3.0: wall of a window, room of a chair, storey of a unit;
                         ///< else the building
    std::string storey;  ///< id of the storey it belongs to, or empty
    std::string unit;    ///< id of the flat it belongs to, or empty
    double volume = 0;   ///< m3, exact to rounding; 0 for a storey or building, which have no geometry of their own
    std::vector<std::vector<SamplePiece>> bodies;  ///< disjoint bodies; the pieces of each are applied in order

    /// True where `point` (world, metres) lies inside; undefined within a micrometre of the boundary.
    [[nodiscard]] bool contains(Vec3d point) const;
};

/// Takes a part of the output; false stops the writing.
using SampleSink = std::function<bool(std::string_view)>;

/// Writes a model part by part. The same bytes for the same arguments, on every machine.
/// \return nothing, or Code::BadArgument for an option out of range, Code::CannotWrite where the sink returned false
/// Memory: one building (the house, one storey of the tower, the variants of a district's house), whatever the size of
/// the district.
Result<void> writeSample(SampleKind kind, SampleFormat format, const SampleOptions& options, const SampleSink& sink);

/// The model as text. For a large district use the form with a sink: a house of it takes 40 to 300 KB.
[[nodiscard]] Result<std::string> writeSample(SampleKind kind, SampleFormat format, const SampleOptions& options);

/// Every component with its exact volume and shape, in tree order of the plan; buildings and storeys included.
/// Rooms, elements, windows and doors do not overlap each other and leave no gap inside of the building; furniture and
/// stairs stand inside rooms; a unit encloses its rooms and inner walls.
/// \return the components, or Code::BadArgument for an option out of range or a district of more than 10,000 houses
[[nodiscard]] Result<std::vector<SampleComponent>> describeSample(SampleKind kind, const SampleOptions& options);

}  // namespace svt::samples
