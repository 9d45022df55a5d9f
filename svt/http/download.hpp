#pragma once
/// \file
/// Saves files from web servers.

#include <svt/core/progress.hpp>
#include <svt/core/result.hpp>
#include <svt/http/retry.hpp>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace svt::http {

struct DownloadOptions {
    std::uint64_t maxBytes = 0;  ///< larger files are an error
    std::string remedy;          ///< for larger files: "a higher --max-input permits more"
    /// Looks at the first bytes of the file (up to 64 KiB) before the rest is requested. An error ends the download.
    std::function<Result<void>(std::string_view head)> check{};
    const Progress* progress = nullptr;  ///< stage "download"
    RetryClock clock = machineClock();
};

/// Saves the file at an address as the new file `to`. It asks for ranges, so that a broken connection costs only one of
/// them. If the server has no ranges, it asks for the whole file. Each request has up to kMostAttempts attempts.
/// \return bytes; CannotOpen (no server, no file, a wrong answer, a file that changes meanwhile), InputTooBig, an error
///         of `check`, CannotWrite, DiskFull or Cancelled, all with the address as place
[[nodiscard]] Result<std::uint64_t> downloadFile(const std::string& address, const std::filesystem::path& to,
                                                 const DownloadOptions& options);

}  // namespace svt::http
