#pragma once
/// \file
/// The options that say how a model becomes a volume, and the volume that a command works on.

#include <apps/cli/options/command_line.hpp>

#include <svt/core/diagnostics.hpp>
#include <svt/core/progress.hpp>
#include <svt/pipeline/build_volume.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <filesystem>
#include <optional>
#include <string>

namespace svt::cli {

/// Options shared by all commands that read models.
struct ReadArguments {
    readers::ReadOptions read;
    std::string crs;

    void connect(Command& command);
    /// The checked options.
    [[nodiscard]] Result<readers::ReadOptions> options() const;
};

/// Options shared by all commands that turn models into volumes.
struct BuildArguments {
    ReadArguments reading;
    std::string dimension, spacing, axes, sheets, style;
    double lod = -1;
    bool noBodies = false, patterns = false, noThin = false;
    int threads = 0;
    pipeline::VectorChoice vectors;  ///< not an option of all commands

    void connect(Command& command);
    /// The checked options; `styleSheet` owns the data they point to.
    [[nodiscard]] Result<pipeline::BuildOptions> options(std::optional<pipeline::StyleSheet>& styleSheet) const;
};

/// Loads a volume from a `.svt`, or builds it from a model file.
/// \param grid  of another volume, to build the model on; null: according to the arguments
[[nodiscard]] Result<volume::SemanticVolume> loadVolume(const std::filesystem::path& input,
                                                        const BuildArguments& arguments, const Progress* progress,
                                                        Diagnostics& diagnostics, const volume::Grid* grid = nullptr);

/// The code of --crs, such as EPSG:25832 or 25832; 0 for an empty text.
[[nodiscard]] Result<int> parseCrs(const std::string& text);

/// Parses "800,700,400" or "800x700x400" as three numbers; a single number is used for all three.
[[nodiscard]] Result<Vec3d> parseTriple(const std::string& text, std::string_view option, std::string_view unit);

}  // namespace svt::cli
