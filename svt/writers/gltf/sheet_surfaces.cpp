#include <svt/writers/gltf/model_faces.hpp>
#include <svt/writers/gltf/sheet_surfaces.hpp>

#include <array>
#include <cstddef>
#include <unordered_map>

namespace svt::writers {
namespace {

// A point of the volume's vectors in metres from the grid's lower corner, along the grid's axes.
Vec3f placeOf(const volume::SemanticVolume& volume, std::uint32_t point) {
    const Vec3d index = volume.grid.indexFromWorld(volume.vectors.position(point, volume.grid.origin()));
    const Vec3d metres = scaled(index + Vec3d{0.5, 0.5, 0.5}, volume.grid.spacing());
    return {static_cast<float>(metres.x), static_cast<float>(metres.y), static_cast<float>(metres.z)};
}

}  // namespace

SheetSurfaces sheetSurfaces(const volume::SemanticVolume& volume, MeshChoice choice) {
    SheetSurfaces sheets;
    const std::vector<TriangleUse> uses = drawnTriangles(volume, choice);
    std::unordered_map<std::uint32_t, std::uint32_t> vertexOf;  // by point, in the last surface
    for (std::size_t t = 0; t < uses.size(); ++t) {
        if (uses[t] == TriangleUse::None) continue;
        const volume::VectorParts::Triangle& triangle = volume.vectors.triangles[t];
        if (sheets.surfaces.empty() || sheets.surfaces.back().label != triangle.label) {
            sheets.surfaces.emplace_back().label = triangle.label;
            sheets.positions.emplace_back();
            vertexOf.clear();
        }
        if (uses[t] == TriangleUse::Covered) continue;
        Positions& positions = sheets.positions.back();
        std::array<std::uint32_t, 3> corners{};
        for (std::size_t c = 0; c < 3; ++c) {
            const auto [at, isNew] =
                vertexOf.try_emplace(triangle.corners[c], static_cast<std::uint32_t>(positions.size()));
            if (isNew) positions.push_back(placeOf(volume, triangle.corners[c]));
            corners[c] = at->second;
        }
        sheets.surfaces.back().triangles.push_back(corners);
    }
    for (std::size_t s = 0; s < sheets.surfaces.size(); ++s)
        sheets.surfaces[s].vertices.resize(sheets.positions[s].size());
    return sheets;
}

std::vector<std::uint32_t> withoutSheets(std::vector<std::uint32_t> labelOfScalar, const volume::LabelTable& labels,
                                         const SheetSurfaces& sheets) {
    for (const LabelSurface& sheet : sheets.surfaces) {
        const volume::Label& label = labels.labels[sheet.label];
        for (volume::Scalar s = label.first; s < label.first + label.count; ++s) labelOfScalar[s] = volume::kNoLabel;
    }
    return labelOfScalar;
}

}  // namespace svt::writers
