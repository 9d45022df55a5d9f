#pragma once
/// \file
/// The cell spaces of a volume, their common faces, and the transitions between them: the content of an IndoorGML
/// document.

#include <svt/writers/indoorgml/doorway.hpp>
#include <svt/writers/volume_formats.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace svt::writers::indoor {

struct Cell {
    std::uint32_t label = 0;
    std::string id;         ///< a unique XML name; the id of the label if it is an XML name
    std::string_view kind;  ///< class of the navigation module, or CellSpace
    std::string storey;     ///< its name, or empty
    CellBody body;
    Vec3d inner{};  ///< position of its state
    std::vector<std::size_t> boundaries, transitions;
};

/// A common face of two cells.
struct Boundary {
    std::size_t a = 0, b = 0;       ///< cells
    std::vector<FacePiece> pieces;  ///< in one plane, seen from a
    std::size_t transition = kNone;
    static constexpr std::size_t kNone = ~std::size_t{0};
};

struct Transition {
    std::size_t a = 0, b = 0;  ///< cells
    std::size_t boundary = Boundary::kNone;
    std::vector<Vec3d> line;  ///< from state to state, through the face
};

/// Places are those of CellShape.
struct CellPlan {
    std::vector<Cell> cells;  ///< rooms, then doors, each in the order of labels
    std::vector<Boundary> boundaries;
    std::vector<Transition> transitions;
};

/// \return the plan; NothingSelected if the volume has no room; or an error of labelSurfaces()
[[nodiscard]] Result<CellPlan> planCells(const volume::SemanticVolume& volume, const VolumeWriteOptions& options);

}  // namespace svt::writers::indoor
