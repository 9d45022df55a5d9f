#pragma once
/// \file
/// serve and view: their options and entry point. The program for Linux has its own server; the program for Node.js
/// uses that of Node.js.

#include <apps/cli/options/site_options.hpp>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace svt::cli {

struct ServeArguments {
    std::vector<std::filesystem::path> inputs;
    SiteArguments site;
    std::string host = "127.0.0.1";
    std::optional<int> port;  ///< unset: wantedPort(), or the next free one
    std::vector<std::string> hostNames;
    std::vector<std::string> imageSites;
    bool allowUploads = false;
    std::uint64_t maxUploadMb = 200, convertMemoryMb = 2048;
    double convertSeconds = 120;
    bool isView = false;  ///< opens a browser, unless noBrowser
    bool noBrowser = false;

    /// The port to listen at; 0: any.
    [[nodiscard]] int wantedPort() const noexcept { return port.value_or(isView ? 0 : 8080); }
};

/// Serves until a signal ends it. Defined once for each platform.
/// \return the exit code
[[nodiscard]] Result<int> runServe(const ServeArguments& arguments);

}  // namespace svt::cli
