#pragma once
/// \file
/// External walls and doors: those that the file states, otherwise those that the outside air touches.

#include <svt/volume/semantic_volume.hpp>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace svt::drawing {

/// The share of one side of a wall (half of its faces across x and y) that outside air must touch. The ends of an inner
/// wall that reaches through the hull have less.
inline constexpr double kExternalShare = 0.25;
/// From this share on, the air is on both sides.
inline constexpr double kBothSidesShare = 1.5;

enum class ExternalSource : std::uint8_t {
    None,  ///< not a wall or door, or without voxels
    File,  ///< the property `IsExternal`, or the class (`WallSurface`, `InteriorWallSurface`)
    Hull,  ///< outside air, see analyze::findSideAreas()
    Open   ///< undecided: the outside air reaches both sides, because the model has no rooms and is not closed
};

struct ExternalPart {
    bool isExternal = false;
    ExternalSource source = ExternalSource::None;
    friend bool operator==(const ExternalPart&, const ExternalPart&) = default;
};

/// One entry per label. A wall counts with its layers and phases. Terrain and vegetation count as outside air. A wall
/// behind cladding that is a component of its own has no air beside it and counts as internal.
/// Cost: O(labels) if the file states all; otherwise O(runs of all columns).
[[nodiscard]] std::vector<ExternalPart> findExternalParts(const volume::SemanticVolume& volume);

/// A sentence with the number of external walls and doors by source; empty without walls and doors.
[[nodiscard]] std::string externalSources(std::span<const ExternalPart> parts, const volume::LabelTable& table);

}  // namespace svt::drawing
