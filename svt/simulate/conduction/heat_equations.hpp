#pragma once
/// \file
/// The equations of a volume: conductances between cells, and between cells and the air of zones.

#include <svt/render/face_model.hpp>
#include <svt/simulate/conduction/air_map.hpp>
#include <svt/simulate/conduction/face_finder.hpp>
#include <svt/simulate/solver/cell_equations.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace svt::simulate {

/// A face between a cell and the air of a zone.
struct BoundaryFace {
    std::uint32_t cell = 0;
    std::uint32_t zone = 0;
    float conductance = 0;       ///< W/K between the centre of the cell and the air
    float film = 0;              ///< K/W of the air at the surface
    float distance = 0;          ///< from the centre of the cell to the surface, along the axis, in voxels
    float area = 0;              ///< m2 of the surface: the face's area times the normal's part along the axis
    std::uint8_t direction = 0;  ///< 2 * axis, plus 1 if the air is above the cell on this axis
};

/// m2 of faces between cells and air, by voxel faces.
struct FaceAreas {
    std::array<double, 3> bySource{};  ///< FaceSource
    std::array<double, 3> parallel{};  ///< of these, faces parallel to an axis; and all without a plane
};

struct HeatEquations {
    CellEquations cells;
    std::vector<BoundaryFace> faces;  ///< ordered by row and column of the volume
    FaceAreas areas;
};

/// Resistance of the air at each surface of a cavity, m2 K/W: half of the value for layers of air over 25 mm (ISO 6946).
inline constexpr double kCavityFilm = 0.09;
/// W/(m K) of the mixed air in a cavity: its temperature is nearly constant.
inline constexpr double kMixedAir = 100;

/// The inputs of the equations. All must outlive the call.
struct EquationParts {
    const volume::SemanticVolume& volume;
    const ThermalRoles& roles;
    const AirMap& map;
    const FaceFinder& finder;
    const render::FaceModel* faces;  ///< null: faces are planes that the finder finds
    const SurfaceResistances& resistances;
    int threads = 0;  ///< the result does not depend on it
};

/// Cost: O(cells), and a ray for each row of voxels along each axis, or O(planes of a brick) for each face between labels.
/// Memory: the result, and the rays of one axis.
[[nodiscard]] HeatEquations makeHeatEquations(const EquationParts& parts);

/// Whether a zone's air is linked with each cell, directly or by other cells; count + 2 entries.
[[nodiscard]] std::vector<char> findDetermined(const HeatEquations& equations);

}  // namespace svt::simulate
