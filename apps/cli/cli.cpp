#include <apps/cli/cli.hpp>

#include <svt/volume/svt_file.hpp>

#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <fstream>
#include <memory>

namespace svt::cli {
namespace {

std::atomic<bool>* interruptTarget = nullptr;

void onInterrupt(int) {
    if (interruptTarget != nullptr) interruptTarget->store(true);
}

}  // namespace

int exitCodeOf(Code code) noexcept {
    switch (code) {
        case Code::InputTooBig:
        case Code::GridTooLarge:
        case Code::TooManyLabels: return kLimit;
        case Code::CannotWrite:
        case Code::DiskFull: return kOutput;
        case Code::Cancelled: return kCancelled;
        case Code::BadDimension:
        case Code::BadCamera:
        case Code::BadFrame:
        case Code::BadSection:
        case Code::BadQuery:
        case Code::NothingSelected:
        case Code::BadArgument: return kUsage;
        case Code::Internal: return kInternal;
        case Code::NoGraphics: return kNoGraphics;
        default: return kInput;
    }
}

int fail(const Error& error) {
    fmt::print(stderr, "svt: error {}\n", error.toString());
    return exitCodeOf(error.code());
}

void printDiagnostics(const Diagnostics& diagnostics, bool isVerbose) {
    constexpr int kShown = 12;
    int shown = 0;
    for (const Diagnostic& item : diagnostics.items()) {
        if (!isVerbose && (item.severity == Severity::Note || shown == kShown)) continue;
        ++shown;
        fmt::print(stderr, "svt: {}\n", item.toString());
    }
    const std::size_t serious = diagnostics.count(Severity::Warning) + diagnostics.count(Severity::Error);
    const std::size_t notes = diagnostics.count(Severity::Note);
    if (!isVerbose && serious > std::size_t(shown))
        fmt::print(stderr, "svt: {} more warnings; --verbose shows them\n", serious - std::size_t(shown));
    if (!isVerbose && notes != 0) fmt::print(stderr, "svt: {} notes; --verbose shows them\n", notes);
}

TerminalProgress::TerminalProgress() {
    interruptTarget = &progress_.cancel;
    std::signal(SIGINT, onInterrupt);
    if (isatty(2) == 0) return;
    const auto start = std::chrono::steady_clock::now();
    progress_.report = [this, start](std::string_view stage, double fraction) {
        if (std::chrono::steady_clock::now() - start < std::chrono::seconds(1)) return;
        constexpr int kWidth = 30;
        const int full = static_cast<int>(fraction * kWidth);
        fmt::print(stderr, "\r{:<9} [{}{}] {:3.0f} %", stage, std::string(std::size_t(full), '#'),
                   std::string(std::size_t(kWidth - full), ' '), fraction * 100);
        std::fflush(stderr);
        hasDrawn_ = true;
    };
}

TerminalProgress::~TerminalProgress() {
    if (hasDrawn_) fmt::print(stderr, "\r{:60}\r", "");
    std::signal(SIGINT, SIG_DFL);
    interruptTarget = nullptr;
}

Result<Vec3d> parseTriple(const std::string& text, std::string_view option, std::string_view unit) {
    std::array<double, 3> values{};
    std::size_t count = 0, at = 0;
    while (at <= text.size()) {
        std::size_t end = text.find_first_of(",x", at);
        if (end == std::string::npos) end = text.size();
        const std::string part = text.substr(at, end - at);
        char* rest = nullptr;
        const double value = std::strtod(part.c_str(), &rest);
        if (part.empty() || *rest != '\0' || count == 3)
            return Error(
                Code::BadArgument,
                fmt::format("{} '{}': expected one number or three such as 800,700,400 ({})", option, text, unit));
        values[count++] = value;
        at = end + 1;
    }
    if (count == 1) return Vec3d{values[0], values[0], values[0]};
    if (count != 3)
        return Error(Code::BadArgument,
                     fmt::format("{} '{}': expected one number or three such as 800,700,400 ({})", option, text, unit));
    return Vec3d{values[0], values[1], values[2]};
}

void BuildArguments::addTo(CLI::App& command) {
    command.add_option("--dimension", dimension, "samples along x, y and z, such as 800,700,400 (2 to 65535)")
        ->group("Grid")
        ->type_name("X,Y,Z");
    command
        .add_option("--spacing", spacing,
                    "distance of samples in metres, one number or three; default: 400 samples along the longest side")
        ->group("Grid")
        ->type_name("M");
    command.add_option("--frame", frame, "axes of the grid: world, or building (turned to its dominant edge)")
        ->group("Grid")
        ->check(CLI::IsMember({"world", "building"}))
        ->capture_default_str();
    command
        .add_option("--lod", lod, "use no finer level of detail than this; default: the finest that each feature has")
        ->group("Model");
    command
        .add_flag("--no-bodies", noBodies,
                  "leave the material between hull and rooms to the building, not to its walls and slabs")
        ->group("Model");
    command.add_option("--style", style, "style file (JSON): colours, opacities and patterns by query")
        ->group("Style")
        ->type_name("FILE");
    command.add_flag("--patterns", patterns, "embed the built-in patterns: brick, concrete, timber, ...")
        ->group("Style");
    command.add_option("--sheets", sheets, "open surfaces: thin (6-separating) or conservative (every voxel touched)")
        ->group("Voxels")
        ->check(CLI::IsMember({"thin", "conservative"}))
        ->capture_default_str();
    command.add_flag("--no-thin", noThin, "drop parts of solids that are thinner than a voxel")->group("Voxels");
    command.add_option("--threads", threads, "number of threads; default: all cores. The result is the same")
        ->group("Voxels")
        ->check(CLI::Range(0, 1024));
}

Result<pipeline::BuildOptions> BuildArguments::options(std::optional<pipeline::StyleSheet>& styleSheet) const {
    pipeline::BuildOptions options;
    if (!dimension.empty() && !spacing.empty())
        return Error(Code::BadArgument, "--dimension and --spacing exclude each other; give one of them");
    if (!dimension.empty()) {
        const auto triple = parseTriple(dimension, "--dimension", "samples, 2 to 65535");
        if (!triple) return triple.error();
        Vec3i samples;
        for (int axis = 0; axis < 3; ++axis) {
            const double value = (*triple)[axis];
            if (!(value >= 2 && value <= volume::Grid::kMaxDimension) || value != std::floor(value))
                return Error(
                    Code::BadDimension,
                    fmt::format("--dimension {}: {} is out of range; whole numbers from 2 to {} samples are possible",
                                dimension, value, volume::Grid::kMaxDimension));
            samples[axis] = static_cast<std::int32_t>(value);
        }
        options.dimension = samples;
    }
    if (!spacing.empty()) {
        const auto triple = parseTriple(spacing, "--spacing", "metres, greater than 0");
        if (!triple) return triple.error();
        options.spacing = *triple;
    }
    options.axes = frame == "building" ? pipeline::AxesKind::Building : pipeline::AxesKind::World;
    options.lod.lod = lod;
    options.assignThematicBodies = !noBodies;
    options.usePatterns = patterns;
    options.sheets = sheets == "thin" ? voxelize::SheetMode::Thin : voxelize::SheetMode::Conservative;
    options.keepThinParts = !noThin;
    options.threads = threads;
    options.vectors = vectors;
    if (!style.empty()) {
        auto sheet = pipeline::readStyleSheet(style);
        if (!sheet) return sheet.error();
        styleSheet = std::move(*sheet);
        options.style = &*styleSheet;
    }
    return options;
}

Result<volume::SemanticVolume> loadVolume(const std::filesystem::path& input, const BuildArguments& arguments,
                                          const Progress* progress, Diagnostics& diagnostics,
                                          const volume::Grid* grid) {
    std::array<char, 4096> head{};
    std::ifstream stream(input, std::ios::binary);
    stream.read(head.data(), head.size());
    const auto bytes = std::as_bytes(std::span(head).first(static_cast<std::size_t>(stream.gcount())));
    if (volume::looksLikeSvt(bytes)) return volume::readSvt(input);
    std::optional<pipeline::StyleSheet> sheet;
    auto options = arguments.options(sheet);
    if (!options) return options.error();
    options->progress = progress;
    if (grid != nullptr) options->grid = *grid;
    auto output = pipeline::buildVolume(std::span(&input, 1), *options, &diagnostics);
    if (!output) return output.error();
    return std::move(output->volume);
}

}  // namespace svt::cli
