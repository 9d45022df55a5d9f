#pragma once
/// \file
/// Options of `svt render` that draw lines and meshes inside the volume.

#include "cli.hpp"

#include <svt/render/frame_spec.hpp>

namespace svt::cli {

struct VectorArguments {
    std::optional<std::string> wireframe;  ///< query; empty text: all that is visible
    std::vector<std::string> meshes;       ///< queries, or size<M
    std::string hiddenLines = "faint", lineColor = "#1a1a1f";
    double lineWidth = 1;

    void addTo(CLI::App& command);
    /// `build` with what these options need of a model.
    [[nodiscard]] BuildArguments forBuild(BuildArguments build) const;
    /// Puts lines and triangles of `volume` into `pass`, whose styles are set.
    /// \return BadArgument where the volume was built without them; BadQuery, NothingSelected
    [[nodiscard]] Result<void> apply(const volume::SemanticVolume& volume, render::Pass& pass) const;
};

}  // namespace svt::cli
