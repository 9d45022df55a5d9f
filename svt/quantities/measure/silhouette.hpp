#pragma once
/// \file
/// A body seen across its thickness: its outline, and the voids between its two faces.

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace svt::quantities {

using FlatPoint = std::array<double, 2>;  // u, v in metres; v is up for upright bodies

/// The claims of triangles: a triangle of the front plane is seen, too.
enum Claim : std::uint32_t { kSeen = 0, kFront = 1, kBack = 2 };

struct FlatTriangle {
    std::array<FlatPoint, 3> corners;  ///< of any orientation
    std::uint32_t claim = kSeen;
};

struct Void {
    double area = 0;               ///< m2 that one sees through
    std::optional<double> rebate;  ///< m2 of thinner material around it, which may belong to it; empty: unknown
};

struct Silhouette {
    double area = 0;       ///< m2, without voids
    double perimeter = 0;  ///< metres, with closed voids
    FlatPoint low{}, high{};
    std::vector<Void> voids;  ///< by place: v, then u of the lower corner
};

inline constexpr double kLeastVoid = 1e-4;  // m2; smaller ones are slivers between faces that do not quite meet
inline constexpr double kLeastNotch = 0.5;  // metres: a lower notch at the lower edge is a seat, not a door

/// \param hasNotches  whether voids that reach only the lower edge count
/// \return nothing without area, or if the edges do not settle (see plane::arrangeSegments())
/// Cost: O(n log n).
[[nodiscard]] std::optional<Silhouette> silhouetteOf(std::span<const FlatTriangle> triangles, bool hasNotches);

}  // namespace svt::quantities
