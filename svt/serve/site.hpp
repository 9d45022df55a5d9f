#pragma once
/// \file
/// The content to serve: a table from path to bytes, complete before the first request. Request paths are only looked
/// up in this table and never joined to a folder, so path traversal is impossible. Large files stay on the disk and are
/// read in parts. A file that is replaced by rename is served as it was; a file that is changed in place is no longer
/// served.

#include <svt/core/result.hpp>
#include <svt/core/vec.hpp>
#include <svt/serve/http_message.hpp>

#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace svt::serve {

struct Resource {
    Bytes bytes;
    Bytes gzip;  ///< the same, compressed; empty if that saves little
    std::string type;
    std::string tag;  ///< ETag of the content, quotes included
    bool isImmutable = false;
};

/// Threads: filled by one thread; then safe to read from any number.
class Site {
public:
    static constexpr std::size_t kMaxFiles = 10000;
    static constexpr std::uint64_t kMaxFolderBytes = std::uint64_t{512} << 20;

    /// Puts `bytes` at `path` ("/models/house.svt"); replaces an existing entry. Text, scripts and WebAssembly are
    /// compressed here, once. Cost: 1 s per 50 MB of those, 1 s per GB of others.
    /// \param bytes  in memory
    void add(const std::string& path, Bytes bytes);
    /// Like add(), but also takes bytes in a file. Those are read once, in parts, and are not compressed.
    /// \return CannotOpen if another program changes the file meanwhile
    [[nodiscard]] Result<void> addStored(const std::string& path, Bytes bytes);

    /// Adds all files of `folder` at their relative paths, `index.html` also at "/". The files are read into memory.
    /// Skipped: names that begin with a dot, anything but regular files, links that lead out of the folder.
    /// \return CannotOpen if the folder or a file cannot be read, InputTooBig over 10,000 files or 512 MiB
    Result<void> addFolder(const std::filesystem::path& folder);

    /// Null if the path does not exist.
    [[nodiscard]] const Resource* find(std::string_view path) const noexcept;
    /// The reply to a GET or HEAD: 200, 206 for a single range, 304, 404, 416; 405 for other methods; 500 if another
    /// program changed the file of the resource, because the tag of its content is then wrong.
    [[nodiscard]] Reply reply(const Request& request) const;

    [[nodiscard]] const std::map<std::string, Resource, std::less<>>& resources() const noexcept { return resources_; }

    /// Lets the page fetch data and pictures from another server: "https://example.org".
    void allowOrigin(const std::string& origin);
    /// All allowed origins, each with a blank before it.
    [[nodiscard]] const std::string& origins() const noexcept { return origins_; }

private:
    std::string origins_;
    std::map<std::string, Resource, std::less<>> resources_;
};

/// "https://example.org:8080" of "https://example.org:8080/town"; empty for a folder, and for an address that a policy
/// cannot contain.
[[nodiscard]] std::string originOf(const std::string& location);

/// A volume or a city that users of the page can open.
struct SiteModel {
    std::string name;   ///< used in links; see uniqueNames()
    std::string title;  ///< display name
    Bytes svt;          ///< empty for a city
    /// Folder or address (http://, https://) of a city, which the page fetches in parts; else empty.
    std::string city = {};
    /// Files of a city's folder, by names relative to it; none at an address.
    std::vector<std::pair<std::string, Bytes>> cityFiles = {};
};

/// The page in the folder `viewer` with its data: the files of the folder, `/models/NAME.svt`, and `/models.json`,
/// which lists the models in order as {"models": [{"name", "file", "bytes", "title"}]}. The files of a city are in
/// `/models/NAME/`; this path is its `file`, with `"city": true`. For a city at an address, `file` is the address, and
/// the page may fetch from its server.
/// \return the site, or the errors of addFolder() and addStored(), or CannotOpen if the folder has no index.html
[[nodiscard]] Result<Site> viewerSite(const std::filesystem::path& viewer, std::span<const SiteModel> models);

/// The preview that other sites and chat programs show for a link to a page (Open Graph).
struct PagePreview {
    std::string title, description;
    std::string address;  ///< of the published page, with "https://" and a slash at its end; empty: unknown
    Bytes picture;        ///< PNG
    Vec3i size;           ///< of the picture, pixels; z is not used
};

/// Adds to the page the data that file hosts do not send as headers: a Content-Security-Policy that allows only its own
/// scripts, models and pictures, and the tags of a preview, with `/preview.png`. Previews need an absolute address to
/// find the picture; without `address` it is relative, which some programs do not follow.
/// \return CannotOpen if /index.html has no <head>
[[nodiscard]] Result<void> addPageHead(Site& site, PagePreview preview);

/// Model names derived from file names: without folder and extensions, only letters, digits, '.', '_' and '-', made
/// unique by numbers.
/// \param extensions  of models, lower case, with the dot; ".gz", and ".city" of "a.city.json", are removed as well
[[nodiscard]] std::vector<std::string> uniqueNames(std::span<const std::filesystem::path> files,
                                                   std::span<const std::string_view> extensions);

/// Checks whether writeSite() may write into a folder: a page in it is one that writeSite() has written, with its
/// models.json, or it has neither index.html nor models.json.
/// \return nothing, or CannotWrite if it is a file, WouldDestroy if it has the page of another program
[[nodiscard]] Result<void> checkSiteFolder(const std::filesystem::path& folder);

/// Writes a site as a folder that any web server can serve. The files are staged next to `folder` and then moved into
/// it, index.html last, so that a failure leaves the existing content and no partial files. Files in `folder` that are
/// not part of the site are kept. Files of an earlier page are replaced. In a folder without a page, no file is replaced.
/// \return bytes written, or an error of checkSiteFolder(); WouldDestroy for a file in the place of one of the site;
///         CannotWrite or DiskFull; CannotOpen if another program changed a file of the site
[[nodiscard]] Result<std::uint64_t> writeSite(const Site& site, const std::filesystem::path& folder);

}  // namespace svt::serve
