#pragma once
/// \file
/// What there is to be served: a table from path to bytes, made before the first request. A request's path is looked up
/// in it and never joined to a folder, so no spelling of a path leads out of one.

#include <svt/core/result.hpp>
#include <svt/serve/http_message.hpp>

#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <string_view>

namespace svt::serve {

struct Resource {
    Bytes bytes;
    Bytes gzip;  ///< the same, compressed; empty where that gains little
    std::string type;
    std::string tag;  ///< of the content, as in ETag, quotes included
    bool isImmutable = false;
};

/// Threads: filled by one; then read by as many as you like.
class Site {
public:
    static constexpr std::size_t kMaxFiles = 10000;
    static constexpr std::uint64_t kMaxFolderBytes = std::uint64_t{512} << 20;

    /// Puts `bytes` at `path` ("/models/house.svt"); replaces what is there. Text, scripts and WebAssembly are
    /// compressed now, once. Cost: 1 s per 50 MB of those, 1 s per GB of others.
    void add(const std::string& path, Bytes bytes);

    /// Puts all files of `folder` at their paths in it, `index.html` also at "/". The files are read into memory. Left
    /// out: names that begin with a dot, what is no regular file, links that lead out of the folder.
    /// \return CannotOpen where the folder or a file cannot be read, InputTooBig over 10,000 files or 512 MiB
    Result<void> addFolder(const std::filesystem::path& folder);

    /// Null where nothing is there.
    [[nodiscard]] const Resource* find(std::string_view path) const noexcept;
    /// The reply to a GET or HEAD: 200, 206 of a single range, 304, 404, 416; 405 to other methods.
    [[nodiscard]] Reply reply(const Request& request) const;

    [[nodiscard]] const std::map<std::string, Resource, std::less<>>& resources() const noexcept { return resources_; }

private:
    std::map<std::string, Resource, std::less<>> resources_;
};

/// A volume that the page can open.
struct SiteModel {
    std::string name;   ///< by which links choose it; see uniqueNames()
    std::string title;  ///< for people
    Bytes svt;
};

/// The page of `viewer` with its data: the files of that folder, `/models/NAME.svt`, and `/models.json` that lists them
/// in their order as {"models": [{"name", "file", "bytes", "title"}]}.
/// \return the site, or what addFolder() returns, or CannotOpen where the folder has no index.html
[[nodiscard]] Result<Site> viewerSite(const std::filesystem::path& viewer, std::span<const SiteModel> models);

/// Names for models by their files: without folder and extension, of letters, digits, '.', '_' and '-' alone, told
/// apart by numbers where two are equal.
[[nodiscard]] std::vector<std::string> uniqueNames(std::span<const std::filesystem::path> files);

/// Writes a site as a folder that any web server can show. The files are made beside `folder` and then moved into it,
/// index.html last, so that a failure leaves what was there and nothing half-written. What stands in `folder` and is
/// not of the site stays.
/// \param mayReplace  false: a folder that holds anything is refused
/// \return bytes written, or CannotWrite or DiskFull
[[nodiscard]] Result<std::uint64_t> writeSite(const Site& site, const std::filesystem::path& folder, bool mayReplace);

}  // namespace svt::serve
