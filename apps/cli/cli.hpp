#pragma once
/// \file
/// Shared by all commands: exit codes, messages, progress, loading of inputs.

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

/// Prints findings to stderr: all with --verbose, else up to a dozen errors and warnings and the number of the rest.
void printDiagnostics(const Diagnostics& diagnostics, bool isVerbose);

/// A progress bar on stderr if that is a terminal, shown after the first second; Ctrl-C cancels.
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

/// Options shared by all commands that turn models into volumes.
struct BuildArguments {
    std::string dimension, spacing, frame = "world", sheets = "thin", style;
    double lod = -1;
    bool noBodies = false, patterns = false, noThin = false;
    int threads = 0;
    pipeline::VectorChoice vectors;  ///< not an option of all commands

    void addTo(CLI::App& command);
    /// The checked options; `styleSheet` owns the data they point to.
    [[nodiscard]] Result<pipeline::BuildOptions> options(std::optional<pipeline::StyleSheet>& styleSheet) const;
};

/// Loads a volume from a `.svt`, or builds it from a model file.
/// \param grid  of another volume, to build the model on; null: according to the arguments
[[nodiscard]] Result<volume::SemanticVolume> loadVolume(const std::filesystem::path& input,
                                                        const BuildArguments& arguments, const Progress* progress,
                                                        Diagnostics& diagnostics, const volume::Grid* grid = nullptr);

/// Parses "800,700,400" or "800x700x400" as three numbers; a single number is used for all three.
[[nodiscard]] Result<Vec3d> parseTriple(const std::string& text, std::string_view option, std::string_view unit);

/// Each command adds its options to its subcommand and returns the function to run.
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
