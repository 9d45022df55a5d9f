#pragma once
/// \file
/// The way in: a model file of any format that can be read. What a file is, its content says;
/// its name does not matter.

#include <svt/core/diagnostics.hpp>
#include <svt/core/result.hpp>
#include <svt/model/building_model.hpp>
#include <svt/readers/read_options.hpp>

#include <cstddef>
#include <filesystem>
#include <span>
#include <string_view>

namespace svt::readers {

/// One format. readModel() asks the formats of formats() in order and takes the first that says yes.
struct Format {
    std::string_view name;  ///< "CityGML"
    /// Whether the first bytes of a file (up to 1 MiB) are of this format.
    bool (*looksLike)(std::span<const std::byte> head) noexcept;
    Result<model::BuildingModel> (*read)(std::span<const std::byte> bytes, std::string_view name,
                                         const ReadOptions& options, Diagnostics* diagnostics);
};

/// All formats that can be read.
[[nodiscard]] std::span<const Format> formats() noexcept;

/// Reads a model file; one compressed with gzip is decompressed first. A feature with the attribute `svtClass` takes
/// that class: a way to say BuildingConstructiveElement in formats that lack it. \param diagnostics  receives findings
/// that did not stop the reading; may be null \return the model; CannotOpen (missing, unreadable, a folder, damaged
/// gzip), UnknownFormat, InputTooBig for more
///         than options.maxBytes (after decompression), or what the reader of the format returns
/// Cost: the file is mapped, not copied; see the readers. Do not shorten the file while it is read.
[[nodiscard]] Result<model::BuildingModel> readModel(const std::filesystem::path& path, const ReadOptions& options = {},
                                                     Diagnostics* diagnostics = nullptr);

/// The same for a file that is in memory. `name` is used in messages.
[[nodiscard]] Result<model::BuildingModel> readModel(std::span<const std::byte> bytes, std::string_view name,
                                                     const ReadOptions& options = {},
                                                     Diagnostics* diagnostics = nullptr);

}  // namespace svt::readers
