#pragma once
/// \file
/// The options that say what of a volume is written, and how: of `svt convert`, and keywords of Volume.save() in Python.

#include <apps/cli/options/command_line.hpp>

#include <svt/core/progress.hpp>
#include <svt/core/result.hpp>
#include <svt/volume/semantic_volume.hpp>
#include <svt/writers/volume_formats.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace svt::cli {

struct WriteArguments {
    std::string encoding, faces, select, texture, cityGml, zarr, merge, holes, vents;
    std::filesystem::path model;
    double maxVoxels = 0, maxBoxes = 0, lift = 0;
    std::vector<double> box, place;
    int level = 0;
    bool hasMeshes = false, isSharded = false, hasVoxels = false, hasLevelSets = false;

    void connect(Command& command);
    /// True where a part of the volume is to be written, or a coarser one.
    [[nodiscard]] bool isPart() const noexcept { return !box.empty() || !select.empty() || level > 0; }
    /// The box of the volume, then the labels of the selection, then the level.
    /// \param threads  maximum; 0: all cores
    /// \return the part, or BadQuery, NothingSelected and what volume::croppedVolume() and coarseVolume() return
    [[nodiscard]] Result<volume::SemanticVolume> partOf(volume::SemanticVolume volume, int threads) const;
    /// The options for `part`, which queries of components are asked of; `threads` and `progress` are the caller's.
    /// \return the options, or BadQuery, NothingSelected
    [[nodiscard]] Result<writers::VolumeWriteOptions> options(const volume::SemanticVolume& part) const;
};

}  // namespace svt::cli
