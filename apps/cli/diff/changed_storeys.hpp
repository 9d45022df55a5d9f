#pragma once
/// \file
/// The changes of each storey, and pictures of them.

#include <apps/cli/diff/compared.hpp>

#include <svt/illustrate/scene_painter.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace svt::cli {

/// The rows of one storey whose space changed.
struct ChangedStorey {
    std::string name;                 ///< empty: of features without a storey
    std::vector<std::uint32_t> rows;  ///< numbers of Comparison::rows, in the given order
    /// Height above the old volume's lower corner, metres: from the lowest floor to the highest ceiling of both states,
    /// wider for changed objects of up to one and a half storeys in height. Empty: unknown.
    std::optional<std::array<double, 2>> heights{};
};

/// The storeys with a change of space, from the lowest; storeys of unknown height come first.
/// \param rows  numbers of Comparison::rows
/// Cost: that of drawing::findStoreys() and drawing::labelExtents() of both volumes.
[[nodiscard]] std::vector<ChangedStorey> changedStoreys(const Compared& compared, std::span<const std::uint32_t> rows);

/// Draws a difference volume, see compare::makeDifferenceVolume(). Unchanged objects are a ghost, and the space that
/// both states of a changed object share is translucent, so that changes behind it are visible. Rooms and other spaces
/// are drawn only if nothing else changed.
class ChangePictures {
public:
    /// \param difference  must outlive the object
    ChangePictures(const volume::SemanticVolume& difference, int threads);

    /// One storey, or all of the building for a storey of unknown height.
    /// \param isPlan     seen from above, north up; else from the south-east. Turned grids replace north by their y axis
    /// \param hasSolids  whether other objects than spaces changed on the storey
    /// \return the PNG, or an error of ScenePainter::paint()
    [[nodiscard]] Result<std::vector<std::byte>> drawStorey(const ChangedStorey& storey, bool isPlan, bool hasSolids,
                                                            const volume::Grid& was);
    /// The picture of a camera, 4:3. It shows only spaces with an id of `ids`.
    /// \param eye, target  world space
    [[nodiscard]] Result<std::vector<std::byte>> drawView(Vec3d eye, Vec3d target, double fieldOfViewDegrees,
                                                          std::span<const std::string> ids);

private:
    [[nodiscard]] illustrate::Scene scene() const;
    [[nodiscard]] std::string hiddenSpaces(std::string_view unless) const;
    [[nodiscard]] Result<std::vector<std::byte>> draw(const illustrate::Scene& scene);

    const volume::SemanticVolume& difference_;
    illustrate::ScenePainter painter_;
    std::vector<std::string> nothing_, spaceClasses_;
    int threads_;
};

/// Whether a row of an object that is not a room or another space has a change of space.
[[nodiscard]] bool hasChangedSolids(const Compared& compared, std::span<const std::uint32_t> rows);

}  // namespace svt::cli
