#pragma once
/// \file
/// Entry point: reads a model file of any supported format. The format is detected from the content;
/// the file name does not matter.

#include <svt/core/diagnostics.hpp>
#include <svt/core/result.hpp>
#include <svt/model/building_model.hpp>
#include <svt/readers/read_options.hpp>

#include <cstddef>
#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

namespace svt::readers {

/// A format, declared next to its reader. readModel() tries formats() in order and uses the first that matches.
struct Format {
    std::string_view name;     ///< "citygml"; unique
    std::string_view endings;  ///< of its files, lower case, separated by '|': ".gml|.xml". Detection ignores them.
    std::string_view holds;    ///< content, for messages and the manual: "CityGML 1.0 to 3.0"
    /// Whether a file with these first bytes (up to 1 MiB) has this format.
    bool (*looksLike)(std::span<const std::byte> head) noexcept;
    Result<model::BuildingModel> (*read)(std::span<const std::byte> bytes, std::string_view name,
                                         const ReadOptions& options, Diagnostics* diagnostics);
};

/// All readable formats.
[[nodiscard]] std::span<const Format> formats() noexcept;

/// The endings of all formats, each once, in their order. The only list of endings: commands, folders of cities and the
/// page use it.
[[nodiscard]] std::vector<std::string_view> modelEndings();
/// Whether a file name has one of modelEndings(), optionally followed by ".gz", in upper or lower case.
[[nodiscard]] bool hasModelEnding(const std::filesystem::path& path);

/// Reads a model file; gzip files are decompressed first. The attribute `svtClass` of a feature replaces its
/// class: a way to express BuildingConstructiveElement in formats that lack it.
/// \param diagnostics  receives findings that did not stop reading; may be null
/// \return the model; CannotOpen (missing, unreadable, a folder, a changing size, damaged gzip data), UnknownFormat,
///         InputTooBig, or an error of the reader of the format. InputTooBig: more than options.maxBytes; gzip data
///         that unpack to more than a third of the memory or to 100 times their size; files that need more than the
///         available memory.
/// Cost: the file is in memory together with its model; see the readers. Changes that other programs make to the file
/// meanwhile have no effect.
[[nodiscard]] Result<model::BuildingModel> readModel(const std::filesystem::path& path, const ReadOptions& options = {},
                                                     Diagnostics* diagnostics = nullptr);

/// The same for a file in memory. `name` is used in messages. Images of textures are read only if the options name their
/// folder.
[[nodiscard]] Result<model::BuildingModel> readModel(std::span<const std::byte> bytes, std::string_view name,
                                                     const ReadOptions& options = {},
                                                     Diagnostics* diagnostics = nullptr);

}  // namespace svt::readers
