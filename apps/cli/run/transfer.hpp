#pragma once
/// \file
/// Inputs from stdin and addresses, and an output to stdout. Temporary files take their places before a command runs,
/// so commands know only files.

#include <svt/core/file.hpp>
#include <svt/core/result.hpp>
#include <svt/frontend/option_set.hpp>

#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

namespace svt::cli {

/// The transfers of one command. Its temporary files are removed with it, and by signals.
///
///     transfer.begin(given)   '-' of an output becomes a temporary file
///     transfer.fetch(given)   stdin and files at addresses become temporary files
///     the command runs
///     transfer.deliver()      writes the output to stdout
class Transfer {
public:
    /// Checks each '-' and address. Reads and writes nothing.
    /// \return nothing, or BadArgument; CannotWrite for binary data to a terminal, or without a temporary folder
    [[nodiscard]] Result<void> begin(std::vector<frontend::GivenOption>& given);

    /// Saves stdin, and downloads models and volumes. The address of a city stays: its commands read ranges of it.
    /// \return nothing, or CannotOpen; InputTooBig over --max-input; UnknownFormat for content that no command reads;
    ///         CannotWrite, DiskFull, Cancelled
    [[nodiscard]] Result<void> fetch(std::vector<frontend::GivenOption>& given);

    /// Writes the output to stdout, if there is one. Call it after the command has succeeded.
    /// \return nothing, or CannotWrite if the format has written further files
    /// \throws std::system_error if stdout cannot be written, as fmt::print() does
    [[nodiscard]] Result<void> deliver() const;

private:
    [[nodiscard]] Result<std::filesystem::path> newFolder(std::string_view name);
    [[nodiscard]] Result<void> redirect(const frontend::BoundOption& option, std::string& value,
                                        const std::vector<frontend::GivenOption>& given);
    [[nodiscard]] Result<void> saveInput(std::string& value, std::uint64_t maxBytes);
    [[nodiscard]] Result<void> download(const Option& option, std::string& value, std::uint64_t maxBytes);

    std::optional<PrivateFolder> folder_;
    int folders_ = 0;               // in it
    std::filesystem::path output_;  // that stdout receives; empty: none
};

}  // namespace svt::cli
