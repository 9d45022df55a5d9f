#pragma once
/// \file
/// Regions of a plane from the loops of several closed curves. A function of the winding numbers determines the
/// regions. One step of solid_boolean.hpp.

#include <svt/core/vec.hpp>

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace svt::readers::ifc {

/// Points closer than this are one, and points this close to a line lie on it, metres.
inline constexpr double kSnap = 1e-5;

/// A directed piece of the boundary of a channel, z = 0; the channel's inside is on its left.
struct OverlaySegment {
    Vec3d from, to;
    std::uint32_t channel = 0;
    std::int32_t count = 1;  ///< multiplicity
};

/// Exterior ring counter-clockwise, holes clockwise, z = 0.
struct OverlayFace {
    std::vector<std::vector<Vec3d>> rings;
    std::uint8_t state = 0;
};

/// Cuts the plane along all segments and joins the cells with equal state.
/// \param segments      closed loops in each channel
/// \param channelCount  channels are numbered below it
/// \param stateOf       state of a cell with these winding numbers, one per channel; 0: nothing
/// \return the regions of states other than 0, each ring in the order in which it was found
/// \param budget      remaining steps, reduced by those taken; if it does not suffice, nothing is returned, and it is 0
/// Cost: O(n^2) for n pieces after cutting, with a small constant.
[[nodiscard]] std::vector<OverlayFace> overlay(
    std::span<const OverlaySegment> segments, std::uint32_t channelCount,
    const std::function<std::uint8_t(std::span<const std::int32_t>)>& stateOf, std::uint64_t& budget);

}  // namespace svt::readers::ifc
