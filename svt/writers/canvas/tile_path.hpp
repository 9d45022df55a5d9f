#pragma once
/// \file
/// The paths of hatch tiles, step by step.

#include <string_view>
#include <vector>

namespace svt::writers {

/// A step of a path, in absolute coordinates.
struct TileStep {
    enum class Kind { Move, Line, Curve, Close } kind = Kind::Move;
    double x = 0, y = 0;                    ///< end point
    double x1 = 0, y1 = 0, x2 = 0, y2 = 0;  ///< control points of a cubic Bezier curve
};

/// Reads the part of SVG's path data that tiles use: M, L, H, V, C, S and z, absolute or relative. Other commands end
/// the path, because the input is a constant of the program.
[[nodiscard]] std::vector<TileStep> readTilePath(std::string_view path);

}  // namespace svt::writers
