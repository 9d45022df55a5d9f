#pragma once
/// \file
/// Files as text that a person can read, for comparison with an approved one. Compressed content counts as it is after
/// decompression, since the compressed bytes depend on the release of the library.

#include <svt/core/machine.hpp>
#include <svt/core/temporary_folder_test.hpp>
#include <svt/image/png.hpp>
#include <svt/samples/approved_test.hpp>

#include <fmt/format.h>
#include <zlib.h>
#include <zstd.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace svt::writers::approved {

/// The content of a stream of zlib or gzip; empty if there is none. \param used  receives its compressed size
inline std::string inflated(std::string_view bytes, std::size_t* used = nullptr) {
    z_stream stream{};
    if (inflateInit2(&stream, 15 + 32) != Z_OK) return {};
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
    stream.avail_in = static_cast<uInt>(bytes.size());
    std::string content;
    int status = Z_OK;
    for (std::string part(1 << 16, '\0'); status == Z_OK || (status == Z_STREAM_END && stream.avail_in > 8);) {
        if (status == Z_STREAM_END && inflateReset(&stream) != Z_OK) break;  // the next member
        stream.next_out = reinterpret_cast<Bytef*>(part.data());
        stream.avail_out = static_cast<uInt>(part.size());
        status = inflate(&stream, Z_NO_FLUSH);
        content.append(part, 0, part.size() - stream.avail_out);
        if (status != Z_OK && status != Z_STREAM_END) break;
    }
    if (used != nullptr) *used = bytes.size() - stream.avail_in;
    inflateEnd(&stream);
    return content;
}

/// The content of all frames of zstd at the begin of a file, then the number of its other bytes.
inline std::string unzstd(std::string_view bytes) {
    std::string content;
    while (bytes.starts_with("\x28\xB5\x2F\xFD")) {
        const std::size_t size = ZSTD_findFrameCompressedSize(bytes.data(), bytes.size());
        if (ZSTD_isError(size) != 0) return "faulty frame";
        std::string part(ZSTD_getFrameContentSize(bytes.data(), bytes.size()), '\0');
        ZSTD_decompress(part.data(), part.size(), bytes.data(), size);
        content += part;
        bytes.remove_prefix(size);
    }
    return content + fmt::format(" and {}", bytes.size());
}

/// A PDF without what depends on the sizes of its compressed streams, and with their content.
inline std::string pdfContent(std::string_view bytes) {
    std::string content;
    for (std::size_t at = 0; at < bytes.size();) {
        const std::size_t end = std::min(bytes.find('\n', at), bytes.size());
        const std::string_view line = bytes.substr(at, end - at);
        at = end + 1;
        const bool isOffset = line.size() >= 18 && line.find_first_not_of("0123456789 nf\r") == std::string_view::npos;
        if (line == "stream") {
            std::size_t used = 0;
            content += inflated(bytes.substr(at), &used);
            at += used;
        } else if (!isOffset && line.find_first_not_of("0123456789 ") != std::string_view::npos &&
                   line.find("/Length") == std::string_view::npos) {
            content += std::string(line) + '\n';
        }
    }
    return content;
}

inline bool isText(std::string_view bytes) {
    return std::none_of(bytes.begin(), bytes.end(), [](char c) { return c >= 0 && c < ' ' && c != '\n' && c != '\r'; });
}

/// The release of the library that wrote a PDF or a database, since the bytes depend on it: " (release 1.16.0)".
inline std::string releaseOf(std::string_view bytes) {
    const bool isPdf = bytes.starts_with("%PDF");
    if (!isPdf && !bytes.starts_with("SQLite")) return {};
    const char* (*release)() = nullptr;
    const auto library = SharedLibrary::load(isPdf ? "libcairo.so.2" : "libsqlite3.so.0");
    if (!library || !library->find(isPdf ? "cairo_version_string" : "sqlite3_libversion", release))
        return " (release unknown)";
    return fmt::format(" (release {})", release());
}

/// Size and digest of a file; all of it if it is a short text.
inline std::string ofBytes(const std::string& name, std::string_view bytes) {
    if (name.ends_with(".shard")) return name + '\n';  // packed by gzip, see precomputed_test.cpp
    std::string content(bytes);
    if (bytes.starts_with("\x1F\x8B")) content = inflated(bytes);
    if (bytes.starts_with("\x28\xB5\x2F\xFD")) content = unzstd(bytes);
    if (bytes.starts_with("%PDF")) content = pdfContent(bytes);
    if (bytes.starts_with("SQLite")) content.replace(92, 8, "");  // the release of SQLite
    const std::string head =
        fmt::format("{}: {} bytes {:016x}{}\n", name, content.size(), test::digestOf(content), releaseOf(bytes));
    return content.size() <= 1500 && isText(content) ? head + content + '\n' : head;
}

/// A file, or all files of a folder by their names; many files as one digest.
inline std::string ofFile(const std::filesystem::path& path, const std::string& name) {
    if (std::filesystem::is_directory(path)) {
        std::vector<std::string> names;
        for (const auto& entry : std::filesystem::directory_iterator(path))
            names.push_back(entry.path().filename().string());
        std::sort(names.begin(), names.end());
        std::string text;
        for (const std::string& each : names) text += ofFile(path / each, name + '/' + each);
        if (names.size() > 20) text = fmt::format("{} files {:016x}\n", names.size(), test::digestOf(text));
        return name + "/\n" + text;
    }
    if (!name.ends_with(".png")) return ofBytes(name, test::readText(path));
    const auto picture = image::readPng(path);
    if (!picture) return name + ": not a PNG\n";
    const std::string_view pixels(reinterpret_cast<const char*>(picture->pixels().data()),
                                  picture->pixels().size() * sizeof(picture->pixels()[0]));
    return fmt::format("{}: {} x {} pixels {:016x}\n", name, picture->width(), picture->height(),
                       test::digestOf(pixels));
}

}  // namespace svt::writers::approved
