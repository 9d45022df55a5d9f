#pragma once
/// \file
/// Writes a volume with all its levels for VTK and ParaView: a multi-block file (.vtm) and beside it a .vti per level,
/// `<stem>.level0.vti` and so on, until 64 samples are the longest side.

#include <svt/core/result.hpp>
#include <svt/volume/semantic_volume.hpp>
#include <svt/writers/dense/format_options.hpp>

#include <cstdint>
#include <filesystem>

namespace svt::writers {

/// Writes the levels first, then the file that names them; each all or nothing. Equal volumes give equal bytes.
/// \return bytes of all files, or WouldDestroy (something else beside it), CannotWrite, DiskFull, Cancelled; BadArgument as
///         checkedSampleBits()
[[nodiscard]] Result<std::uint64_t> writeVtm(const volume::SemanticVolume& volume, const std::filesystem::path& path,
                                             const DenseOptions& options = {});

}  // namespace svt::writers
