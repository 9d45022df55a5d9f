#pragma once
/// \file
/// Selection of a part of a volume: for `svt convert`, and for Volume.part() and Volume.save() in Python.

#include <svt/core/result.hpp>
#include <svt/record/members.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <string>
#include <vector>

namespace svt::frontend {

struct VolumePart {
    std::string select;       ///< query; empty: all
    std::vector<double> box;  ///< lower and upper corner in world coordinates, metres; empty: all
    int level = 0;            ///< coarser by 2^level along each axis

    /// True for a part of the volume, or a coarser one.
    [[nodiscard]] bool isPart() const noexcept { return !box.empty() || !select.empty() || level > 0; }
    /// Crops the volume to the box, then selects labels, then makes the level.
    /// \param threads  maximum; 0: all cores
    /// \return the part, or BadQuery, NothingSelected, or an error of volume::volumeIn() or coarseVolume()
    [[nodiscard]] Result<volume::SemanticVolume> of(volume::SemanticVolume volume, int threads) const;
};

record::Members<VolumePart> membersOf(const VolumePart*) noexcept;

}  // namespace svt::frontend
