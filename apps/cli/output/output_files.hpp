#pragma once
/// \file
/// Checks the files that a command reads and writes before its work begins, so that unusable files are reported before
/// the work. Protects existing files. The declarations of options define which options name files.

#include <apps/cli/output/file_content.hpp>

#include <svt/core/result.hpp>
#include <svt/frontend/option_set.hpp>

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace svt::cli {

/// Whether a value of an input names no file: '-' (stdin) or an address.
[[nodiscard]] bool isFromElsewhere(std::string_view value) noexcept;

/// The formats that an output may have; only the one that --format names, if the output has it.
[[nodiscard]] std::vector<const FileFormat*> formatsOf(const Option& option,
                                                       std::span<const frontend::GivenOption> given);

/// Checks the files that the options name:
/// - inputs: pipes, sockets and devices are invalid, because reading one may wait forever or never end. /dev/stdin is
///   valid if it leads to a file. Folders are valid only for options that take folders.
/// - endings: an output has an ending of its formats. With several formats an ending is required, unless --format
///   selects the format.
/// - overwriting: an output must not be an input (compared by device and inode, through links; includes the files that
///   a style names), nor the file of another output. It must not replace a file of another kind, by its first 4 KiB.
///   With --no-clobber it must not replace any file, and an output folder must be empty or missing.
/// - writing: the folder of an output exists, permissions allow writing, and space is left.
///
/// Devices and pipes are valid as outputs. Removes leftovers of killed writers (AtomicFile), and changes nothing else.
/// \param given  all options that were given
/// \return nothing, or CannotOpen (an input), BadArgument (an ending), WouldDestroy, CannotWrite, DiskFull
[[nodiscard]] Result<void> checkFiles(std::span<const frontend::GivenOption> given);

/// The folder of a city among the inputs that may be a model or a volume; empty: none.
[[nodiscard]] std::string cityOf(std::span<const frontend::GivenOption> given);

/// Whether all models and volumes that the options name are volumes (.svt). False without any.
[[nodiscard]] bool areAllVolumes(std::span<const frontend::GivenOption> given);

/// Options on building a volume from a model have no meaning if all inputs are volumes.
/// \return nothing, or BadArgument
[[nodiscard]] Result<void> checkOptionsForModels(std::span<const frontend::GivenOption> given);

/// The ending of a file's name in lower case, with its dot: ".png"; empty without a dot.
[[nodiscard]] std::string endingOf(const std::filesystem::path& file);

/// The longest of `endings` that follows another character in the file's name, in upper or lower case: ".nii.gz";
/// without a match, endingOf(file).
[[nodiscard]] std::string endingOf(const std::filesystem::path& file, std::span<const std::string_view> endings);

/// The name of file `number` out of `count`: P.png -> P_0007.png; `file` itself if `count` is 1 or `file` is empty.
[[nodiscard]] std::filesystem::path numberedFile(const std::filesystem::path& file, int number, int count);

}  // namespace svt::cli
