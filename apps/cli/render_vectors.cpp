#include "render_vectors.hpp"

#include <svt/illustrate/selection.hpp>
#include <svt/pipeline/style_sheet.hpp>

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

namespace svt::cli {
namespace {

Error missing(std::string_view option, std::string_view what) {
    return Error(Code::BadArgument,
                 fmt::format("{}: the volume was built without {}; build it with 'svt build --vectors {}', or give the "
                             "model itself",
                             option, what, what));
}

// Labels whose mesh has no side of its bounding box (world axes) as long as `metres`.
std::vector<std::uint32_t> labelsSmallerThan(double metres, const volume::SemanticVolume& volume) {
    std::vector<Box3d> boxes(volume.labels.labels.size());
    for (const auto& triangle : volume.vectors.triangles)
        for (const std::uint32_t corner : triangle.corners)
            boxes[triangle.label].add(volume.vectors.position(corner, {}));
    std::vector<std::uint32_t> small;
    for (std::uint32_t l = 0; l < boxes.size(); ++l) {
        const Vec3d size = boxes[l].size();
        if (boxes[l].max.x >= boxes[l].min.x && std::max({size.x, size.y, size.z}) < metres) small.push_back(l);
    }
    return small;
}

Result<std::vector<std::uint32_t>> selectMeshes(const std::string& text, const volume::SemanticVolume& volume) {
    constexpr std::string_view kSize = "size<";
    if (!text.starts_with(kSize)) return illustrate::selectLabels(volume.labels, text);
    char* rest = nullptr;
    const double metres = std::strtod(text.c_str() + kSize.size(), &rest);
    if (*rest != '\0' || rest == text.c_str() + kSize.size() || !(metres > 0))
        return Error(Code::BadArgument,
                     fmt::format("--vectors '{}': expected a length in metres, such as size<0.3", text));
    auto small = labelsSmallerThan(metres, volume);
    if (small.empty())
        return Error(Code::NothingSelected, fmt::format("--vectors '{}': nothing is smaller than {} m", text, metres));
    return small;
}

std::vector<std::uint8_t> flagsOf(std::span<const std::uint32_t> labels, std::size_t count) {
    std::vector<std::uint8_t> flags(count, 0);
    for (const std::uint32_t l : labels) flags[l] = 1;
    return flags;
}

}  // namespace

void VectorArguments::addTo(CLI::App& command) {
    command
        .add_option_function<std::string>(
            "--wireframe", [this](const std::string& text) { wireframe = text; },
            "draw the edges of what the query selects, at their depth inside the volume; without a query: of all that "
            "is "
            "visible")
        ->group("Lines")
        ->expected(0, 1)
        ->default_str("")
        ->type_name("QUERY");
    command.add_option("--hidden-lines", hiddenLines, "lines behind something opaque")
        ->group("Lines")
        ->check(CLI::IsMember({"faint", "dashed", "none"}))
        ->capture_default_str();
    command.add_option("--line-width", lineWidth, "pixels, 0.1 to 64")
        ->group("Lines")
        ->check(CLI::Range(0.1, 64.0))
        ->capture_default_str();
    command.add_option("--line-color", lineColor, "#rrggbb or a colour name")->group("Lines")->capture_default_str();
    command
        .add_option("--vectors", meshes,
                    "draw what the query selects as meshes, not as voxels; size<M: all that is shorter than M metres "
                    "along each axis; may be repeated")
        ->group("Lines")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->type_name("QUERY");
}

BuildArguments VectorArguments::forBuild(BuildArguments build) const {
    build.vectors.edges = wireframe.has_value();
    build.vectors.meshes = !meshes.empty();
    return build;
}

Result<void> VectorArguments::apply(const volume::SemanticVolume& volume, render::Pass& pass) const {
    const volume::VectorParts& parts = volume.vectors;
    const auto& labels = volume.labels.labels;
    const auto place = [&](std::uint32_t point) { return parts.position(point, volume.grid.origin()); };
    if (wireframe) {
        if (parts.segments.empty()) return missing("--wireframe", "edges");
        std::vector<std::uint8_t> isSelected(labels.size(), 1);
        if (!wireframe->empty()) {
            const auto selected = illustrate::selectLabels(volume.labels, *wireframe);
            if (!selected) return selected.error();
            isSelected = flagsOf(*selected, labels.size());
        }
        const auto color = pipeline::parseColor(lineColor);
        if (!color) return Error(Code::BadArgument, "--line-color: " + color.error().message());
        render::LineSet set;
        set.color = *color;
        set.width = static_cast<float>(lineWidth);
        set.hidden = hiddenLines == "dashed" ? render::HiddenLines::Dashed
                     : hiddenLines == "none" ? render::HiddenLines::None
                                             : render::HiddenLines::Faint;
        if (set.hidden == render::HiddenLines::Dashed) set.hiddenOpacity = 0.6f;
        set.withHiddenLabels = !wireframe->empty();
        for (const auto& segment : parts.segments)
            if (isSelected[segment.label] != 0)
                set.lines.push_back({place(segment.ends[0]), place(segment.ends[1]), labels[segment.label].first});
        pass.lines.push_back(std::move(set));
    }
    if (meshes.empty()) return {};
    if (parts.triangles.empty()) return missing("--vectors", "meshes");
    std::vector<std::uint8_t> isSelected(labels.size(), 0);
    for (const std::string& text : meshes) {
        const auto selected = selectMeshes(text, volume);
        if (!selected) return selected.error();
        for (const std::uint32_t l : *selected) isSelected[l] = 1;
    }
    for (const auto& triangle : parts.triangles)
        if (isSelected[triangle.label] != 0)
            pass.triangles.push_back(
                {{place(triangle.corners[0]), place(triangle.corners[1]), place(triangle.corners[2])},
                 labels[triangle.label].first});
    return {};
}

}  // namespace svt::cli
