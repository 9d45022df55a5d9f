#pragma once
/// \file
/// The kind of a file by its first bytes, and the formats that commands write.

#include <svt/core/file_content.hpp>

#include <filesystem>
#include <string_view>

namespace svt::cli {

/// The kind of a file. \param head  its first bytes, a few KiB, or all of it
[[nodiscard]] FileContent contentOf(std::string_view head);

/// The same for a regular file; Unknown if it cannot be read. Cost: reads 4 KiB.
[[nodiscard]] FileContent contentOf(const std::filesystem::path& file);

/// Whether files of this kind are text for terminals and editors.
[[nodiscard]] bool isTextContent(FileContent content) noexcept;

/// A format of output.
struct FileFormat {
    std::string_view name;     ///< as in Option::formats
    std::string_view endings;  ///< ".gml|.xml"
    FileContent content;       ///< kind of existing files that it may replace
    std::string_view holds;    ///< description of the content
    std::string_view readers;  ///< programs that read it; may be empty
};

/// The format with this name, or null.
[[nodiscard]] const FileFormat* formatOfName(std::string_view name);

}  // namespace svt::cli
