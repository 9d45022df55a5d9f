#pragma once
/// \file
/// Divides a flat face by the sections of the bodies in front of it.
///
///     +-----------------+        each part has one set of claims; parts that touch and have the same set are
///     |      +---+      |        one region
///     |  air | A |      |
///     |      +---+      |
///     +-----------------+

#include <svt/quantities/touch/mesh_sections.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace svt::quantities {

/// A trapezoid of a face between two lines of equal u, metres.
struct FacePart {
    std::array<double, 2> u{}, low{}, high{};  ///< at both lines
    double area = 0;
    std::uint32_t claims = 0;  ///< index of FaceParts::claims
    std::uint32_t region = 0;
};

struct FaceParts {
    std::vector<FacePart> parts;
    std::vector<std::vector<std::uint32_t>> claims;  ///< sets, each ascending, without claim 0
    std::size_t regions = 0;
};

/// \param segments  claim 0: borders of the triangles of the face; others: closed sections
/// \return the parts of the face; nothing if a section is not closed, if edges do not settle (see
///         plane/arrangement.hpp), or if there are too many of them
/// Cost: O(n log n + crossings of edges with the lines through all ends).
[[nodiscard]] std::optional<FaceParts> divideFace(std::span<const FlatSegment> segments);

/// The claims that cover the whole of a face; nothing if a section passes its box.
/// \param sections  closed sections
/// \param low, high  box around the face
/// Cost: O(n).
[[nodiscard]] std::optional<std::vector<std::uint32_t>> claimsOfAll(std::span<const FlatSegment> sections,
                                                                    const FlatPoint& low, const FlatPoint& high);

}  // namespace svt::quantities
