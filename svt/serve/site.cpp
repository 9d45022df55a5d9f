#include <svt/core/deflate.hpp>
#include <svt/core/parallel.hpp>
#include <svt/core/text.hpp>
#include <svt/serve/site.hpp>

#include <fmt/format.h>
#include <stdlib.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <set>
#include <system_error>

namespace svt::serve {
namespace {

namespace fs = std::filesystem;

struct Type {
    std::string_view extension, name;
    bool isCompressible;
};
constexpr std::array kTypes{
    Type{".html", "text/html; charset=utf-8", true},
    Type{".js", "text/javascript; charset=utf-8", true},
    Type{".mjs", "text/javascript; charset=utf-8", true},
    Type{".css", "text/css; charset=utf-8", true},
    Type{".json", "application/json", true},
    Type{".map", "application/json", true},
    Type{".webmanifest", "application/manifest+json", true},
    Type{".wasm", "application/wasm", true},
    Type{".svg", "image/svg+xml", true},
    Type{".txt", "text/plain; charset=utf-8", true},
    Type{".md", "text/plain; charset=utf-8", true},
    Type{".svt", "application/vnd.svt+zip", false},
    Type{".png", "image/png", false},
    Type{".jpg", "image/jpeg", false},
    Type{".webp", "image/webp", false},
    Type{".ico", "image/x-icon", false},
    Type{".woff2", "font/woff2", false},
    Type{".ttf", "font/ttf", true},
};
constexpr Type kOtherType{"", "application/octet-stream", false};

constexpr std::size_t kMinCompressed = 1000;
constexpr std::size_t kFilePiece = std::size_t{1} << 20;

// The policy of the server (http_server.cpp), without the directive that only a header can set: which pages may embed
// this one.
std::string pagePolicy(const std::string& origins) {
    return "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; worker-src 'self'; style-src 'self'; "
           "img-src 'self' data: blob:" +
           origins + "; font-src 'self'; connect-src 'self'" + origins + "; base-uri 'none'; form-action 'none'";
}

std::string_view textOf(const Bytes& bytes) {
    return {reinterpret_cast<const char*>(bytes.data.data()), bytes.data.size()};
}

std::string attributeText(const std::string& text) {
    std::string safe;
    for (const char c : text) {
        if (c == '&')
            safe += "&amp;";
        else if (c == '"')
            safe += "&quot;";
        else if (c == '<')
            safe += "&lt;";
        else if (static_cast<unsigned char>(c) >= ' ')
            safe += c;
    }
    return safe;
}

std::string lowerExtension(std::string_view path) {
    const std::size_t slash = path.rfind('/'), dot = path.rfind('.');
    if (dot == std::string_view::npos || (slash != std::string_view::npos && dot < slash)) return {};
    std::string extension(path.substr(dot));
    extension = lowerAscii(extension);
    return extension;
}

const Type& typeOf(std::string_view path) {
    const std::string extension = lowerExtension(path);
    if (extension.empty()) return kTypes[4];  // paths of the server itself, such as /api
    const auto* found =
        std::find_if(kTypes.begin(), kTypes.end(), [&](const Type& type) { return type.extension == extension; });
    return found == kTypes.end() ? kOtherType : *found;
}

// Hands all bytes to `take`, piece by piece; those of a file must be as they were when it was opened.
template <class Take>
Result<void> forEachPiece(const Bytes& bytes, const Take& take) {
    std::string buffer;
    for (std::uint64_t at = 0; at < bytes.size();) {
        SVT_TRY(piece, bytes.read(at, kFilePiece, buffer));
        SVT_DO(take(*piece));
        at += piece->size();
    }
    return bytes.checkUnchanged();
}

// FNV-1a, 64 bits.
Result<std::uint64_t> hashOf(const Bytes& bytes) {
    std::uint64_t hash = 0xcbf29ce484222325u;
    SVT_DO(forEachPiece(bytes, [&](std::string_view piece) -> Result<void> {
        for (const char c : piece) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
        return {};
    }));
    return hash;
}

// One gzip member; empty if it saves less than a tenth.
Bytes compressed(std::span<const std::byte> bytes) {
    if (bytes.size() < kMinCompressed || bytes.size() > UINT32_MAX / 2) return {};
    const std::vector<std::byte> packed = gzipBytes(bytes);
    if (packed.size() > bytes.size() - bytes.size() / 10) return {};
    return Bytes::of(std::string(reinterpret_cast<const char*>(packed.data()), packed.size()));
}

// Files that Vite names by a content hash: assets/index-BX3k9a1_.js. Such a file never changes.
bool isNamedByContent(std::string_view path) noexcept {
    constexpr std::size_t kHash = 8;
    if (path.find("/assets/") == std::string_view::npos) return false;
    const std::string_view name = path.substr(path.rfind('/') + 1);
    const std::string_view stem = name.substr(0, name.rfind('.'));
    if (stem.size() < kHash + 2 || stem[stem.size() - kHash - 1] != '-') return false;
    return std::all_of(stem.end() - kHash, stem.end(),
                       [](char c) { return isLetter(c) || isDigit(c) || c == '_' || c == '-'; });
}

bool acceptsGzip(std::string_view header) {
    bool isAccepted = false;
    while (!header.empty()) {
        std::string item(header.substr(0, header.find(',')));
        header.remove_prefix(std::min(header.size(), item.size() + 1));
        item.erase(std::remove(item.begin(), item.end(), ' '), item.end());
        const std::string name = item.substr(0, item.find(';'));
        if (name != "gzip" && name != "*") continue;
        const std::size_t q = item.find(";q=");
        const bool isRefused = q != std::string::npos && item.find_first_of("123456789", q) == std::string::npos;
        if (name == "gzip") return !isRefused;
        isAccepted = !isRefused;
    }
    return isAccepted;
}

// Tags of If-None-Match are compared weakly: W/ is ignored, and so is whether the bytes were compressed.
bool namesTag(std::string_view header, std::string_view tag) {
    return header == "*" || (!header.empty() && header.find(tag) != std::string_view::npos);
}

// A file of the folder, and its path on the site.
struct Found {
    fs::path file;
    std::string path;
};

bool leadsOut(const fs::path& file, const fs::path& root) {
    std::error_code error;
    const fs::path real = fs::canonical(file, error);
    if (error) return true;
    return std::mismatch(root.begin(), root.end(), real.begin(), real.end()).first != root.end();
}

Error cannotOpen(const fs::path& path, std::string message) {
    return Error(Code::CannotOpen, std::move(message), Place{path.string(), 0, 0, {}});
}

Result<std::vector<Found>> filesOf(const fs::path& folder) {
    std::error_code error;
    const fs::path root = fs::canonical(folder, error);
    if (error || !fs::is_directory(root, error)) return cannotOpen(folder, "this is not a folder; check the spelling");
    std::vector<Found> found;
    auto at = fs::recursive_directory_iterator(root, error);
    for (; !error && at != fs::recursive_directory_iterator(); at.increment(error)) {
        const std::string name = at->path().filename().string();
        std::error_code ignored;
        if (name.front() == '.') {
            at.disable_recursion_pending();
            continue;
        }
        if (!at->is_regular_file(ignored) || leadsOut(at->path(), root)) continue;
        if (found.size() == Site::kMaxFiles)
            return Error(Code::InputTooBig,
                         fmt::format("over {} files; is this the folder of the viewer?", found.size()),
                         Place{folder.string(), 0, 0, {}});
        found.push_back({at->path(), "/" + at->path().lexically_relative(root).generic_string()});
    }
    if (error) return cannotOpen(folder, "the folder cannot be read: " + error.message());
    return found;
}

Error cannotWrite(const fs::path& path, std::string message) {
    return Error(Code::CannotWrite, std::move(message), Place{path.string(), 0, 0, {}});
}

// Whether a folder has a page that writeSite() has written.
bool isOwnPage(const fs::path& folder) {
    constexpr std::uint64_t kMostBytes = std::uint64_t{64} << 20;  // of the list of models
    const auto list = FileBytes::read(folder / "models.json", kMostBytes);
    if (!list) return false;
    const auto json = nlohmann::ordered_json::parse(list->text(), nullptr, false);
    return json.is_object() && json.contains("models") && json["models"].is_array();
}

Error notOurs(const fs::path& file) {
    return Error(
        Code::WouldDestroy,
        "the page would replace this file, which is not part of a page of SVT; choose another folder, or remove "
        "the file",
        Place{file.string(), 0, 0, {}});
}

// A staging folder, removed with its contents by the destructor.
struct Staging {
    fs::path path;
    Unfinished unfinished;
    ~Staging() {
        std::error_code ignored;
        if (!path.empty()) fs::remove_all(path, ignored);
    }
};

// Does not create folders while the handling of a signal removes the folder above.
std::error_code makeFolders(const fs::path& folder) {
    std::error_code error;
    static_cast<void>(Unfinished::path([&] {
        fs::create_directories(folder, error);
        return fs::path();
    }));
    return error;
}

Result<std::uint64_t> writeBytes(const Bytes& bytes, const fs::path& path) {
    SVT_TRY(file, AtomicFile::create(path));
    SVT_DO(forEachPiece(bytes, [&](std::string_view piece) { return file->write(piece); }));
    return file->commit();
}

Result<void> moveInto(const fs::path& staging, const fs::path& folder, const std::string& path) {
    std::error_code error;
    const fs::path target = folder / path.substr(1);
    error = makeFolders(target.parent_path());
    if (!error) fs::rename(staging / path.substr(1), target, error);
    if (error) return cannotWrite(target, error.message());
    return {};
}

Result<nlohmann::ordered_json> addCity(Site& site, const SiteModel& model) {
    std::string file = model.city;
    if (const std::string origin = originOf(model.city); !origin.empty()) {
        site.allowOrigin(origin);
    } else {
        file = "models/" + model.name + "/";
        for (const auto& [name, bytes] : model.cityFiles) SVT_DO(site.addStored("/" + file + name, bytes));
    }
    return nlohmann::ordered_json{
        {"name", model.name}, {"file", file}, {"bytes", 0}, {"title", model.title}, {"city", true}};
}

// The resource for a path. Cost: that of compressing.
Result<Resource> resourceOf(const std::string& path, Bytes bytes) {
    const Type& type = typeOf(path);
    SVT_TRY(hash, hashOf(bytes));
    Resource resource;
    resource.type = type.name;
    resource.tag = fmt::format("\"{:x}-{:016x}\"", bytes.size(), *hash);
    resource.isImmutable = isNamedByContent(path);
    if (type.isCompressible) resource.gzip = compressed(bytes.data);
    resource.bytes = std::move(bytes);
    return resource;
}

}  // namespace

std::string originOf(const std::string& location) {
    if (!location.starts_with("http://") && !location.starts_with("https://")) return {};
    const std::string origin = location.substr(0, location.find_first_of("/?#", location.find("//") + 2));
    const auto isPlain = [](unsigned char c) {
        return isLetter(char(c)) || isDigit(char(c)) ||
               std::string_view(":/.-[]").find(char(c)) != std::string_view::npos;
    };
    return !origin.ends_with("/") && std::all_of(origin.begin(), origin.end(), isPlain) ? origin : std::string();
}

void Site::add(const std::string& path, Bytes bytes) {
    resources_.insert_or_assign(path, *resourceOf(path, std::move(bytes)));
}

Result<void> Site::addStored(const std::string& path, Bytes bytes) {
    SVT_TRY(resource, resourceOf(path, std::move(bytes)));
    resources_.insert_or_assign(path, std::move(*resource));
    return {};
}

void Site::allowOrigin(const std::string& origin) {
    if ((origins_ + " ").find(" " + origin + " ") == std::string::npos) origins_ += " " + origin;
}

Result<void> Site::addFolder(const fs::path& folder) {
    SVT_TRY(files, filesOf(folder));
    std::uint64_t total = 0;
    std::vector<Bytes> contents;
    for (const Found& found : *files) {
        SVT_TRY(file, FileBytes::read(found.file));
        total += file->bytes().size();
        if (total > kMaxFolderBytes)
            return Error(Code::InputTooBig,
                         fmt::format("over {} MiB; is this the folder of the viewer?", kMaxFolderBytes >> 20),
                         Place{folder.string(), 0, 0, {}});
        contents.push_back(Bytes::of(std::string(file->text())));
    }
    std::vector<Resource> made(contents.size());
    parallelFor(contents.size(), 1, 0, [&](std::size_t begin, std::size_t end) {
        for (std::size_t n = begin; n < end; ++n) made[n] = *resourceOf((*files)[n].path, std::move(contents[n]));
    });
    for (std::size_t n = 0; n < made.size(); ++n) resources_.insert_or_assign((*files)[n].path, std::move(made[n]));
    return {};
}

const Resource* Site::find(std::string_view path) const noexcept {
    const auto at = resources_.find(path == "/" ? std::string_view("/index.html") : path);
    return at == resources_.end() ? nullptr : &at->second;
}

Reply Site::reply(const Request& request) const {
    const Resource* resource = find(request.path);
    if (resource == nullptr) return Reply::refusal(404, "there is nothing at this address");
    const bool isHead = request.method == "HEAD";
    if (request.method != "GET" && !isHead) {
        Reply reply = Reply::refusal(405, "only GET and HEAD are possible here");
        reply.headers.emplace_back("Allow", "GET, HEAD");
        return reply;
    }
    if (!resource->bytes.checkUnchanged())
        return Reply::refusal(500, "another program changed the file at this address; start the server again");
    Reply reply;
    reply.headers = {{"Cache-Control", resource->isImmutable ? "public, max-age=31536000, immutable" : "no-cache"},
                     {"ETag", resource->tag},
                     {"Accept-Ranges", "bytes"}};
    if (!resource->gzip.data.empty()) reply.headers.emplace_back("Vary", "Accept-Encoding");
    if (namesTag(request.header("if-none-match"), resource->tag)) {
        reply.status = 304;
        return reply;
    }
    reply.type = resource->type;
    reply.body = resource->bytes;

    ByteRange range;
    const std::uint64_t size = resource->bytes.size();
    const std::string_view ifRange = request.header("if-range");
    const bool isRangeMeant = !isHead && (ifRange.empty() || ifRange == resource->tag);
    switch (isRangeMeant ? parseRange(request.header("range"), size, range) : RangeKind::Whole) {
        case RangeKind::Unsatisfiable: {
            Reply refused = Reply::refusal(416, fmt::format("the range begins behind the {} bytes there are", size));
            refused.headers.emplace_back("Content-Range", fmt::format("bytes */{}", size));
            return refused;
        }
        case RangeKind::Part:
            reply.status = 206;
            reply.body = reply.body.part(range.first, range.last - range.first + 1);
            reply.headers.emplace_back("Content-Range", fmt::format("bytes {}-{}/{}", range.first, range.last, size));
            break;
        case RangeKind::Whole:
            if (resource->gzip.data.empty() || !acceptsGzip(request.header("accept-encoding"))) break;
            reply.body = resource->gzip;
            reply.headers.emplace_back("Content-Encoding", "gzip");
            // Different bytes must not have the same strong tag, so it becomes weak; If-None-Match ignores the W/.
            reply.headers[1].second = "W/" + resource->tag;
            break;
    }
    if (isHead) {
        reply.skippedBody = reply.body.size();
        reply.body = {};
    }
    return reply;
}

Result<Site> viewerSite(const fs::path& viewer, std::span<const SiteModel> models) {
    Site site;
    SVT_DO(site.addFolder(viewer));
    if (site.find("/index.html") == nullptr)
        return cannotOpen(viewer,
                          "the folder has no index.html, so it holds no viewer's page; `make viewer` builds it");
    nlohmann::ordered_json list = nlohmann::json::array();
    for (const SiteModel& model : models) {
        if (!model.city.empty()) {
            SVT_TRY(city, addCity(site, model));
            list.push_back(std::move(*city));
            continue;
        }
        const std::string file = "models/" + model.name + ".svt";
        list.push_back(
            {{"name", model.name}, {"file", file}, {"bytes", model.svt.data.size()}, {"title", model.title}});
        site.add("/" + file, model.svt);
    }
    const nlohmann::ordered_json json{{"models", std::move(list)}};
    site.add("/models.json", Bytes::of(json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n"));
    return site;
}

Result<void> addPageHead(Site& site, PagePreview preview) {
    constexpr std::string_view kHead = "<head>";
    const Resource* page = site.find("/index.html");
    const std::string_view text = page == nullptr ? std::string_view() : textOf(page->bytes);
    const std::size_t at = text.find(kHead);
    if (at == std::string_view::npos) return Error(Code::CannotOpen, "the viewer's index.html has no <head>");
    std::string head = fmt::format("\n    <meta http-equiv=\"Content-Security-Policy\" content=\"{}\" />",
                                   attributeText(pagePolicy(site.origins())));
    const auto tag = [&](std::string_view property, const std::string& content) {
        head += fmt::format("\n    <meta property=\"{}\" content=\"{}\" />", property, attributeText(content));
    };
    tag("og:type", "website");
    tag("og:title", preview.title);
    tag("og:description", preview.description);
    if (!preview.address.empty()) tag("og:url", preview.address);
    tag("og:image", preview.address + "preview.png");
    tag("og:image:type", "image/png");
    tag("og:image:width", fmt::format("{}", preview.size.x));
    tag("og:image:height", fmt::format("{}", preview.size.y));
    head += "\n    <meta name=\"twitter:card\" content=\"summary_large_image\" />";
    // The encoding must be within the first 1024 bytes of a page.
    constexpr std::string_view kCharset = "<meta charset=\"utf-8\" />";
    const std::size_t charset = text.find(kCharset, at);
    std::string changed(text);
    // The picture that is seen until the model has one of its own; src/main.ts of the viewer takes it.
    constexpr std::string_view kBody = "<body>";
    if (const std::size_t body = text.find(kBody, at); body != std::string_view::npos)
        changed.insert(body + kBody.size(), fmt::format("\n    <img id=\"preview\" src=\"preview.png\" alt=\"{}\" />",
                                                        attributeText(preview.title)));
    changed.insert(charset == std::string_view::npos ? at + kHead.size() : charset + kCharset.size(), head);
    site.add("/index.html", Bytes::of(std::move(changed)));
    site.add("/preview.png", std::move(preview.picture));
    return {};
}

std::vector<std::string> uniqueNames(std::span<const fs::path> files, std::span<const std::string_view> extensions) {
    const auto isOfModels = [&](const std::string& extension) {
        return extension == ".gz" || extension == ".city" ||
               std::ranges::find(extensions, extension) != extensions.end();
    };
    std::vector<std::string> names;
    std::set<std::string> taken;  // in lower case: some file systems ignore case
    for (const fs::path& file : files) {
        fs::path bare = file.filename();
        while (isOfModels(lowerExtension(bare.string()))) bare = bare.stem();
        std::string name;
        for (const char c : bare.string()) {
            const bool isKept = isLetter(c) || isDigit(c) || c == '-' || c == '.' || c == '_';
            if (isKept || name.empty() || name.back() != '_') name += isKept ? c : '_';
        }
        if (name.find_first_not_of("._") == std::string::npos) name = "model";
        const auto isTaken = [&](std::string text) {
            text = lowerAscii(text);
            return !taken.insert(text).second;
        };
        std::string unique = name;
        for (int number = 2; isTaken(unique); ++number) unique = fmt::format("{}-{}", name, number);
        names.push_back(unique);
    }
    return names;
}

Result<void> checkSiteFolder(const fs::path& folder) {
    std::error_code error;
    if (!fs::exists(folder, error)) return {};
    if (!fs::is_directory(folder, error)) return cannotWrite(folder, "this is a file; give the name of a folder");
    if (isOwnPage(folder)) return {};
    for (const char* name : {"index.html", "models.json"})
        if (fs::exists(folder / name, error)) return notOurs(folder / name);
    return {};
}

Result<std::uint64_t> writeSite(const Site& site, const fs::path& folder) {
    SVT_DO(checkSiteFolder(folder));
    std::error_code error;
    if (!isOwnPage(folder))
        for (const auto& [path, resource] : site.resources())
            if (fs::exists(folder / path.substr(1), error)) return notOurs(folder / path.substr(1));
    const bool isThere = fs::exists(folder, error);
    const Unfinished made = Unfinished::path([&] {
        fs::create_directories(folder, error);
        return isThere ? fs::path() : folder;
    });
    if (error) return cannotWrite(folder, "the folder cannot be made: " + error.message());

    Staging staging;
    staging.unfinished = Unfinished::path([&] {
        std::string pattern = (folder / ".svt-XXXXXX").string();
        if (::mkdtemp(pattern.data()) != nullptr) staging.path = pattern;
        return staging.path;
    });
    if (staging.path.empty())
        return cannotWrite(folder, "no permission to write here; change the permissions or choose another folder");
    std::uint64_t total = 0;
    const auto write = [&]() -> Result<void> {
        for (const auto& [path, resource] : site.resources()) {
            const fs::path file = staging.path / path.substr(1);
            makeFolders(file.parent_path());
            SVT_TRY(written, writeBytes(resource.bytes, file));
            total += *written;
        }
        for (const auto& [path, resource] : site.resources())
            if (path != "/index.html") SVT_DO(moveInto(staging.path, folder, path));
        return site.find("/") == nullptr ? Result<void>() : moveInto(staging.path, folder, "/index.html");
    };
    if (auto done = write(); !done) {
        if (!isThere) fs::remove_all(folder, error);
        return done.error();
    }
    return total;
}

}  // namespace svt::serve
