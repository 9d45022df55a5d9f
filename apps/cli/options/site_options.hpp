#pragma once
/// \file
/// Common parts of serve, view and publish: the page, its models, and server-side pictures for browsers that cannot
/// draw.

#include <apps/cli/output/messages.hpp>

#include <svt/pipeline/build_volume.hpp>
#include <svt/serve/http_server.hpp>
#include <svt/serve/site.hpp>

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace svt::cli {

/// Options of the commands that create a site.
struct SiteArguments {
    std::filesystem::path viewer;  ///< folder of the page; empty: see findViewerFolder()
    pipeline::BuildOptions build;
    bool verbose = false;

    SiteArguments() { build.vectors = {.edges = true, .meshes = true, .isRequired = false}; }
    /// The folder of the page.
    /// \return CannotOpen if it does not exist
    [[nodiscard]] Result<std::filesystem::path> viewerFolder() const;
    /// The inputs as `.svt`; model files are built first, with feature edges. Findings go to stderr.
    [[nodiscard]] Result<std::vector<serve::SiteModel>> load(const std::vector<std::filesystem::path>& inputs) const;
};

record::Members<SiteArguments> membersOf(const SiteArguments*) noexcept;

/// The preview of a published page: its models' titles, and a picture of the first.
/// \param address  of the page, or empty
[[nodiscard]] Result<serve::PagePreview> pagePreview(std::span<const serve::SiteModel> models, std::string address,
                                                     int threads);

/// POST /api/picture: {"model": NAME, "scene": {...}} -> PNG. NAME may end in ".svt"; without it, the first model. One
/// picture at a time; 422 if the scene cannot be drawn or has over 16,777,216 rays (pixels times samples).
/// \param threads  0: all cores
[[nodiscard]] serve::Route pictureRoute(std::vector<serve::SiteModel> models, int threads);

}  // namespace svt::cli
