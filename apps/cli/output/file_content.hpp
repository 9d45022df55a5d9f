#pragma once
/// \file
/// The kind of a file by its first bytes, and the formats that commands write.

#include <svt/core/file_content.hpp>

#include <filesystem>
#include <string_view>

namespace svt::cli {

/// \param head  the first bytes of the file, a few KiB, or all of it
[[nodiscard]] FileContent contentOf(std::string_view head);

/// The same of a regular file; Unknown if it cannot be read. Cost: 4 KiB are read.
[[nodiscard]] FileContent contentOf(const std::filesystem::path& file);

/// A format of output.
struct FileFormat {
    std::string_view name;     ///< as Option::formats has it
    std::string_view endings;  ///< ".gml|.xml"
    FileContent content;       ///< kind of files that it may replace
    std::string_view holds;    ///< content, for people
    std::string_view readers;  ///< programs that read it; may be empty
};

/// The format of that name; null: none has it.
[[nodiscard]] const FileFormat* formatOfName(std::string_view name);

}  // namespace svt::cli
