#pragma once
/// \file
/// What all commands share: exit codes, messages, progress, loading of inputs.

#include <svt/core/diagnostics.hpp>
#include <svt/core/progress.hpp>
#include <svt/pipeline/build_volume.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <CLI/CLI.hpp>

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace svt::cli {

/// Exit codes, as documented in docs/user/exit-codes.md.
enum Exit {
    kDone = 0,
    kInternal = 1,
    kUsage = 2,
    kInput = 3,
    kInvalid = 4,
    kOutput = 5,
    kNoGraphics = 6,
    kLimit = 8,
    kCancelled = 9
};

/// Exit code for an error code.
[[nodiscard]] int exitCodeOf(Code code) noexcept;

/// Prints "svt: error ..." to stderr and returns the exit code.
int fail(const Error& error);

/// Prints findings to stderr: all with --verbose, else errors and warnings up to a dozen and a count of the rest.
void printDiagnostics(const Diagnostics& diagnostics, bool isVerbose);

/// A bar on stderr where that is a terminal, from the first second on; Ctrl-C cancels.
class TerminalProgress {
public:
    TerminalProgress();
    ~TerminalProgress();
    TerminalProgress(const TerminalProgress&) = delete;
    TerminalProgress& operator=(const TerminalProgress&) = delete;
    [[nodiscard]] const Progress* get() const noexcept { return &progress_; }

private:
    Progress progress_;
    bool hasDrawn_ = false;
};

/// Options of everything that turns models into volumes.
struct BuildArguments {
    std::string dimension, spacing, frame = "world", sheets = "thin", style;
    double lod = -1;
    bool noBodies = false, patterns = false, noThin = false;
    int threads = 0;
    pipeline::VectorChoice vectors;  ///< no option of all commands

    void addTo(CLI::App& command);
    /// The options, checked; `styleSheet` keeps what they point at.
    [[nodiscard]] Result<pipeline::BuildOptions> options(std::optional<pipeline::StyleSheet>& styleSheet) const;
};

/// A volume from a `.svt` or, by building it, from a model file.
/// \param grid  of another volume that a model is built on; null: as the arguments say
[[nodiscard]] Result<volume::SemanticVolume> loadVolume(const std::filesystem::path& input,
                                                        const BuildArguments& arguments, const Progress* progress,
                                                        Diagnostics& diagnostics, const volume::Grid* grid = nullptr);

/// "800,700,400" or "800x700x400" -> three numbers; one number stands for all three.
[[nodiscard]] Result<Vec3d> parseTriple(const std::string& text, std::string_view option, std::string_view unit);

/// A command puts its options on its subcommand and returns what to run.
using Run = std::function<int()>;
Run addSampleCommand(CLI::App& app);
Run addBuildCommand(CLI::App& app);
Run addInfoCommand(CLI::App& app);
Run addCheckCommand(CLI::App& app);
Run addRenderCommand(CLI::App& app);
Run addSectionCommand(CLI::App& app);
Run addQueryCommand(CLI::App& app);
Run addShellCommand(CLI::App& app);
Run addConvertCommand(CLI::App& app);
Run addServeCommand(CLI::App& app);
Run addViewCommand(CLI::App& app);
Run addPublishCommand(CLI::App& app);

}  // namespace svt::cli
