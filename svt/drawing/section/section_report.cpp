#include <svt/drawing/section_drawing.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string>
#include <string_view>

namespace svt::drawing {
namespace {

// "a, b, c and 4 others"
std::string listed(const std::vector<std::string>& names) {
    constexpr std::size_t kMost = 3;
    std::string text;
    for (std::size_t n = 0; n < std::min(names.size(), kMost); ++n) text += (n == 0 ? "" : ", ") + names[n];
    if (names.size() > kMost) text += fmt::format(" and {} others", names.size() - kMost);
    return text;
}

}  // namespace

void reportSection(const SectionDrawing& drawing, const volume::SemanticVolume& volume, Diagnostics& log) {
    const Place place{volume.source, 0, 0, {}};
    if (drawing.edgesInPlane != 0)
        log.add(
            Severity::Note, Code::PlaneInFaces,
            fmt::format("the plane lies in faces or edges of the model ({} edges); drawn is what stands just before "
                        "it, on the side that is kept{}",
                        drawing.edgesInPlane,
                        drawing.planeShift != 0
                            ? fmt::format("; the plane was moved there by {:g} mm", 1000 * drawing.planeShift)
                            : std::string()),
            place);
    const SectionDrawing* const one = &drawing;
    reportSections(std::span(&one, 1), volume, log);
}

void reportSections(std::span<const SectionDrawing* const> drawings, const volume::SemanticVolume& volume,
                    Diagnostics& log) {
    // By label, each once, in the order of the drawings.
    std::set<std::size_t> all, areUncertain, areByVoxels;
    std::vector<std::string> coarse, open, narrow, byVoxels;  // the first three: with an uncertain area
    bool isUnsettled = false, lacksMeshes = false;
    for (const SectionDrawing* drawing : drawings) {
        isUnsettled = isUnsettled || drawing->isUnsettled;
        lacksMeshes = lacksMeshes || drawing->lacksMeshes;
        for (const SectionComponent& component : drawing->components) {
            const std::string& id = volume.labels.labels[component.label].id;
            all.insert(component.label);
            if (component.area > 0 && component.areaBound > component.area &&
                areUncertain.insert(component.label).second)
                (component.isExact ? narrow : drawing->isFromMeshes ? open : coarse).push_back(id);
            if (drawing->isFromMeshes && !component.isExact && areByVoxels.insert(component.label).second)
                byVoxels.push_back(id);
        }
    }
    const Place place{volume.source, 0, 0, {}};
    if (isUnsettled)
        log.add(Severity::Warning, Code::DrawnByVoxels,
                fmt::format("all components{} are drawn by their voxels, because the edges of their meshes do not "
                            "converge in integer coordinates; move the plane slightly",
                            drawings.size() > 1 ? " of a view" : ""),
                place);
    if (lacksMeshes)
        log.add(Severity::Warning, Code::NoMeshes,
                "lines beyond the cut are not drawn, because the volume keeps no meshes; give the model itself, or "
                "build the volume with --vectors meshes",
                place);
    if (!byVoxels.empty())
        log.add(Severity::Note, Code::DrawnByVoxels,
                fmt::format("{} of {} components are drawn by their voxels, because their shells are open: {}",
                            byVoxels.size(), all.size(), listed(byVoxels)),
                place);
    const auto warn = [&](const std::vector<std::string>& uncertain, std::string_view reason, std::string_view remedy) {
        if (uncertain.empty()) return;
        log.add(Severity::Warning, Code::UncertainArea,
                fmt::format("{} of {} areas have an error bound above 100 %, because {}: {}; {}", uncertain.size(),
                            all.size(), reason, listed(uncertain), remedy),
                place);
    };
    warn(coarse, "the voxels are too large",
         "give the model itself, a volume that keeps its meshes, or a smaller --spacing");
    warn(open, "their shells are open, and the voxels that stand for them are too large",
         "close their shells, which svt check names, or give a smaller --spacing");
    warn(narrow, "they are hardly wider than the rounding of coordinates", "move the plane slightly");
}

std::string leftOutChains(std::span<const SectionDrawing* const> drawings) {
    std::size_t nothing = 0, turned = 0;
    for (const SectionDrawing* drawing : drawings) {
        nothing += drawing->chainsLeftOut == ChainsLeftOut::NothingMeasured ? 1 : 0;
        turned += drawing->chainsLeftOut == ChainsLeftOut::TurnedWalls ? 1 : 0;
    }
    std::string text;
    if (nothing > 0)
        text = fmt::format(
            "{} of {} drawings have no chains of dimensions, because they cut no wall, slab, roof or "
            "column",
            nothing, drawings.size());
    if (turned > 0)
        text += fmt::format(
            "{}{} of {} drawings have no chains of dimensions, because their walls are turned against "
            "the axes of the grid; build the volume with --axes building",
            text.empty() ? "" : "; ", turned, drawings.size());
    return text;
}

}  // namespace svt::drawing
