#pragma once
/// \file
/// The bodies of legal spaces: closed triangle meshes from solids or voxels.

#include <svt/analyze/extents.hpp>
#include <svt/analyze/known_volumes.hpp>
#include <svt/analyze/legal_spaces.hpp>

#include <cstddef>
#include <vector>

namespace svt::analyze {

/// Makes bodies from one volume. Not thread-safe.
class BodyMaker {
public:
    BodyMaker(const volume::SemanticVolume& volume, const Extents& extents, std::size_t maxBoxes);

    /// The legal space of a label: its body, the volumes and the box, relative to the lower corner of the grid.
    /// \param hasBoxes  false if the voxels need more than `maxBoxes` boxes; the space then has no solids
    [[nodiscard]] LegalSpace make(std::uint32_t label, bool& hasBoxes) const;

private:
    [[nodiscard]] bool hasSolid(std::uint32_t label) const noexcept;
    [[nodiscard]] std::vector<SpaceTriangle> trianglesOf(std::uint32_t label) const;
    void addParts(const std::vector<std::uint32_t>& extent, LegalSpace& space) const;
    void addBoxes(const std::vector<std::uint32_t>& extent, LegalSpace& space, bool& hasBoxes) const;

    const volume::SemanticVolume& volume_;
    const Extents& extents_;
    std::size_t maxBoxes_;
    std::vector<std::size_t> firstTriangle_;  // of label l: [l], end: [l + 1]
    KnownVolumes known_;
};

}  // namespace svt::analyze
