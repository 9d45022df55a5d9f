#pragma once
/// \file
/// Files that a command reads and writes, checked before its work begins. No existing file is destroyed. A file that
/// cannot be read or written is an error before the work, not after it. The declarations say which options name files.

#include <svt/core/result.hpp>
#include <svt/frontend/option_set.hpp>

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace svt::cli {

/// Checks the files that the options name:
/// - no input is a pipe, a socket or a device: reading one may wait forever or never end. /dev/stdin is an input where it
///   leads to a file. A folder is an input only where the option takes folders
/// - an output ends as its formats do; with several formats it must have an ending, unless --format tells the format
/// - no output is a file that is read (by device and inode, through links; with the files that a style names), no two
///   outputs are one file, and no output takes the place of a file of another kind, told by its first 4 KiB
/// - outputs can be written: the folder is there, permissions allow it, space is left
/// - options that say how a model becomes a volume are not given where only volumes are read
/// Devices and pipes may be written as they are. Nothing is changed, but for leftovers of killed writers (AtomicFile).
/// \param given  all options that were given
/// \return nothing, or CannotOpen (an input), BadArgument (an ending, an option without meaning), WouldDestroy, CannotWrite, DiskFull
[[nodiscard]] Result<void> checkFiles(std::span<const frontend::GivenOption> given);

/// The ending of a file's name in lower case, with its dot: ".png"; empty if it has none.
[[nodiscard]] std::string endingOf(const std::filesystem::path& file);

/// The longest of `endings` that the file's name has behind some other character, in any case: ".nii.gz"; where there is
/// none, endingOf() of the file alone.
[[nodiscard]] std::string endingOf(const std::filesystem::path& file, std::span<const std::string_view> endings);

/// Number `number` of `count` files: P.png -> P_0007.png; the file itself if there is one, or `file` is empty.
[[nodiscard]] std::filesystem::path numberedFile(const std::filesystem::path& file, int number, int count);

}  // namespace svt::cli
