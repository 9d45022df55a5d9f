#include <apps/cli/options/build_options.hpp>

#include <apps/cli/output/messages.hpp>

#include <svt/core/machine.hpp>
#include <svt/core/text.hpp>
#include <svt/volume/svt_file.hpp>
#include <svt/volume_readers/read_label_volume.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace svt::cli {

Result<Vec3d> parseTriple(const std::string& text, std::string_view option, std::string_view unit) {
    std::array<double, 3> values{};
    std::size_t count = 0, at = 0;
    while (at <= text.size()) {
        std::size_t end = text.find_first_of(",x", at);
        if (end == std::string::npos) end = text.size();
        const auto value = parseNumber(withoutBlanks(std::string_view(text).substr(at, end - at)));
        if (!value || count == 3)
            return Error(
                Code::BadArgument,
                fmt::format("{} '{}': expected one number or three such as 800,700,400 ({})", option, text, unit));
        values[count++] = *value;
        at = end + 1;
    }
    if (count == 1) return Vec3d{values[0], values[0], values[0]};
    if (count != 3)
        return Error(Code::BadArgument,
                     fmt::format("{} '{}': expected one number or three such as 800,700,400 ({})", option, text, unit));
    return Vec3d{values[0], values[1], values[2]};
}

Result<int> parseCrs(const std::string& text) {
    if (text.empty()) return 0;
    std::string_view digits = text;
    if (equalsIgnoringCase(digits.substr(0, 5), "EPSG:")) digits.remove_prefix(5);
    const int code = parseInteger<int>(digits).value_or(0);
    if (code <= 0)
        return Error(
            Code::BadArgument,
            fmt::format("--crs '{}': expected the EPSG code of a projection in metres, such as EPSG:25832", text));
    return code;
}

void ReadArguments::connect(Command& command) {
    command.set("--crs", crs);
    command.set("--keep-far-features", read.keepFarFeatures);
    command.set("--extrude-footprints", read.extrudeFootprints);
    command.set("--allow-truncated", read.allowTruncated);
    if (command.has("--layers")) command.set("--layers", read.splitLayers);
}

Result<readers::ReadOptions> ReadArguments::options() const {
    SVT_TRY(code, parseCrs(crs));
    readers::ReadOptions options = read;
    options.crs = *code;
    return options;
}

void BuildArguments::connect(Command& command) {
    reading.connect(command);
    command.set("--dimension", dimension);
    command.set("--spacing", spacing);
    command.set("--axes", axes);
    command.set("--lod", lod);
    command.set("--no-bodies", noBodies);
    command.set("--style", style);
    command.set("--patterns", patterns);
    command.set("--sheets", sheets);
    command.set("--no-thin", noThin);
    command.set("--threads", threads);
}

Result<pipeline::BuildOptions> BuildArguments::options(std::optional<pipeline::StyleSheet>& styleSheet) const {
    pipeline::BuildOptions options;
    if (!dimension.empty() && !spacing.empty())
        return Error(Code::BadArgument, "--dimension and --spacing exclude each other; give one of them");
    if (!dimension.empty()) {
        SVT_TRY(triple, parseTriple(dimension, "--dimension", "samples, 2 to 65535"));
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
        SVT_TRY(triple, parseTriple(spacing, "--spacing", "metres, greater than 0"));
        for (int axis = 0; axis < 3; ++axis)
            if (const double metres = (*triple)[axis]; !(metres > 0) || !std::isfinite(metres))
                return Error(
                    Code::BadDimension,
                    fmt::format("--spacing {}: {} is out of range; metres greater than 0 are possible, such as "
                                "0.1",
                                spacing, metres));
        options.spacing = *triple;
    }
    // Half of what was granted: reading and meshing come before. What the machine has does not count, so that the same
    // command gives the same volume everywhere.
    if (const MemoryFigures memory = memoryFigures(); memory.limitedBy == "--memory" && memory.limitBytes)
        options.memoryBytes = std::min(options.memoryBytes, *memory.limitBytes / 2);
    options.axes = axes == "building" ? pipeline::AxesKind::Building : pipeline::AxesKind::World;
    options.lod.lod = lod;
    options.assignThematicBodies = !noBodies;
    options.usePatterns = patterns;
    options.sheets = sheets == "thin" ? voxelize::SheetMode::Thin : voxelize::SheetMode::Conservative;
    options.keepThinParts = !noThin;
    options.threads = threads;
    SVT_TRY(read, reading.options());
    options.read = *read;
    options.vectors = vectors;
    if (!style.empty()) {
        SVT_TRY(sheet, pipeline::readStyleSheet(style));
        styleSheet = std::move(*sheet);
        options.style = &*styleSheet;
    }
    return options;
}

Result<volume::SemanticVolume> loadVolume(const std::filesystem::path& input, const BuildArguments& arguments,
                                          const Progress* progress, Diagnostics& diagnostics,
                                          const volume::Grid* grid) {
    if (volume::isSvtFile(input)) return volume::readSvt(input);
    if (volume_readers::looksLikeLabelVolume(input))
        return volume_readers::readLabelVolume(input, {{}, 0, progress, &diagnostics});
    std::optional<pipeline::StyleSheet> sheet;
    SVT_TRY(options, arguments.options(sheet));
    options->progress = progress;
    if (grid != nullptr) options->grid = *grid;
    SVT_TRY(output, pipeline::buildVolume(std::span(&input, 1), *options, &diagnostics));
    if (const auto& choice = output->report.spacing; choice && choice->spacing != pipeline::SpacingChoice::kUsual)
        note("spacing: " + choice->reason);
    return std::move(output->volume);
}

}  // namespace svt::cli
