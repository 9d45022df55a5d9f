#include <svt/illustrate/scene/vector_shapes.hpp>

#include <svt/core/text.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <span>

namespace svt::illustrate {
namespace {

Error missing(std::string_view what) {
    return Error(
        Code::BadArgument,
        fmt::format("the volume was built without {}; build it with 'svt build --vectors {}', or give the model "
                    "itself",
                    what, what));
}

// Labels whose mesh has a bounding box (world axes) with all sides shorter than `metres`.
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

Result<std::vector<std::uint32_t>> selectMeshes(const std::string& text, const volume::SemanticVolume& volume,
                                                const analyze::LabelRows& rows) {
    constexpr std::string_view kSize = "size<";
    if (!text.starts_with(kSize)) return analyze::selectLabels(rows, text);
    const double metres = parseNumber(withoutBlanks(std::string_view(text).substr(kSize.size()))).value_or(0);
    if (!(metres > 0))
        return Error(Code::BadArgument,
                     fmt::format("meshes '{}': expected a length in metres, such as size<0.3", text));
    auto small = labelsSmallerThan(metres, volume);
    if (small.empty())
        return rows.selectNothing(fmt::format("meshes '{}': nothing is smaller than {} m", text, metres));
    return small;
}

std::vector<std::uint8_t> flagsOf(std::span<const std::uint32_t> labels, std::size_t count) {
    std::vector<std::uint8_t> flags(count, 0);
    for (const std::uint32_t l : labels) flags[l] = 1;
    return flags;
}

Result<void> addLines(const SceneLines& wanted, const volume::SemanticVolume& volume, const analyze::LabelRows& rows,
                      render::Pass& pass) {
    const volume::VectorParts& parts = volume.vectors;
    const auto& labels = volume.labels.labels;
    if (parts.segments.empty()) return missing("edges");
    std::vector<std::uint8_t> isSelected(labels.size(), 1);
    if (!wanted.select.empty()) {
        SVT_TRY(selected, analyze::selectLabels(rows, wanted.select));
        isSelected = flagsOf(*selected, labels.size());
    }
    render::LineSet set;
    if (wanted.color) set.color = *wanted.color;
    set.width = wanted.width;
    set.hidden = wanted.hidden;
    if (set.hidden == render::HiddenLines::Dashed) set.hiddenOpacity = 0.6f;
    set.withHiddenLabels = !wanted.select.empty();
    const auto place = [&](std::uint32_t point) { return parts.position(point, volume.grid.origin()); };
    for (const auto& segment : parts.segments)
        if (isSelected[segment.label] != 0)
            set.lines.push_back({place(segment.ends[0]), place(segment.ends[1]), labels[segment.label].first});
    pass.lines.push_back(std::move(set));
    return {};
}

}  // namespace

Result<void> addShapes(const ScenePass& wanted, const volume::SemanticVolume& volume, const analyze::LabelRows& rows,
                       render::Pass& pass) {
    for (const SceneLines& lines : wanted.lines)
        if (auto added = addLines(lines, volume, rows, pass); !added) return added;
    if (wanted.meshes.empty()) return {};
    const volume::VectorParts& parts = volume.vectors;
    const auto& labels = volume.labels.labels;
    if (parts.triangles.empty()) return missing("meshes");
    std::vector<std::uint8_t> isSelected(labels.size(), 0);
    for (const std::string& text : wanted.meshes) {
        SVT_TRY(selected, selectMeshes(text, volume, rows));
        for (const std::uint32_t l : *selected) isSelected[l] = 1;
    }
    const auto place = [&](std::uint32_t point) { return parts.position(point, volume.grid.origin()); };
    for (const auto& triangle : parts.triangles)
        if (isSelected[triangle.label] != 0)
            pass.triangles.push_back(
                {{place(triangle.corners[0]), place(triangle.corners[1]), place(triangle.corners[2])},
                 labels[triangle.label].first});
    return {};
}

}  // namespace svt::illustrate
