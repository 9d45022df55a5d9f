#include <svt/writers/labels/label_looks.hpp>
#include <svt/writers/tiles3d/feature_glb.hpp>

#include <svt/analyze/extents.hpp>
#include <svt/analyze/known_volumes.hpp>
#include <svt/analyze/label_measures.hpp>
#include <svt/analyze/selection.hpp>
#include <svt/writers/dense/sample_stream.hpp>
#include <svt/writers/gltf/sheet_surfaces.hpp>
#include <svt/writers/gltf/straight_points.hpp>
#include <svt/writers/tiles3d/building_table.hpp>
#include <svt/writers/tiles3d/property_table.hpp>
#include <svt/writers/tiles3d/tile_glb.hpp>

#include <algorithm>
#include <map>
#include <utility>

namespace svt::writers {
namespace {

using GltfJson = nlohmann::ordered_json;

void appendSurface(const LabelHulls& hulls, std::size_t surface, std::uint32_t feature, TileMesh& mesh) {
    const volume::Label& label = hulls.label(surface);
    const VertexColor color = linearColor(label.color, surfaceOpacity(label));
    std::vector<Vec3d> places;
    for (std::size_t v = 0; v < hulls.positions[surface].size(); ++v) places.push_back(hulls.fromCorner(surface, v));
    FeatureFaces faces;
    faces.add(hulls.surfaces[surface], places, [&](Vec3d) { return color; });
    mesh.append(faces, feature);
}

GltfJson metadataOf(const LabelHulls& hulls, std::size_t begin, std::size_t end, const FeatureTexts& texts,
                    GltfBuffer& buffer) {
    std::vector<std::string> ids, names, classes, parents, storeys, attributes;
    std::vector<double> volumes;
    const auto& labels = hulls.volume->labels.labels;
    for (std::size_t s = begin; s < end; ++s) {
        const volume::Label& label = hulls.label(s);
        ids.push_back(label.id);
        names.push_back(label.name);
        classes.push_back(label.className);
        parents.push_back(label.parent < labels.size() ? labels[label.parent].id : std::string());
        storeys.push_back(texts.storeys[hulls.surfaces[s].label]);
        volumes.push_back(texts.volumes[hulls.surfaces[s].label]);
        attributes.push_back(attributesText(label));
    }
    PropertyTable table(buffer, end - begin);
    table.strings("id", "id in the model", ids);
    const auto hasAny = [](const std::vector<std::string>& column) {
        return std::any_of(column.begin(), column.end(), [](const std::string& text) { return !text.empty(); });
    };
    table.namesBesideIds(names, ids);
    table.names("class", "", classes);
    table.names("parent", "id of the feature that it is a part of", parents);
    if (hasAny(storeys)) table.names("storey", "name of its storey", storeys);
    table.knownNumbers("volume", "m3", volumes);
    table.attributes(attributes);
    return table.extension("component");
}

/// Adds the surfaces with the numbers of their buildings. \return the buildings, in the order of their labels
std::vector<BuildingRow> appendBuildings(const LabelHulls& hulls, std::size_t begin, std::size_t end, TileMesh& mesh) {
    const volume::SemanticVolume& volume = *hulls.volume;
    const std::vector<std::uint32_t> buildingOf = buildingOfLabels(volume.labels);
    const analyze::Extents extents(volume.labels);
    const analyze::KnownVolumes volumes(volume.labels, volume.grid, extents);
    const double bottom = lowerCorner(volume.grid).z;
    std::map<std::uint32_t, std::uint32_t> rowOf;
    for (std::size_t s = begin; s < end; ++s) rowOf.emplace(buildingOf[hulls.surfaces[s].label], 0);
    std::vector<BuildingRow> rows;
    for (auto& [label, row] : rowOf) {
        row = static_cast<std::uint32_t>(rows.size());
        rows.push_back({volume.labels.labels[label], volumes.of(label).volume.value_or(0)});
    }
    for (std::size_t s = begin; s < end; ++s) {
        const std::uint32_t row = rowOf.at(buildingOf[hulls.surfaces[s].label]);
        appendSurface(hulls, s, row, mesh);
        for (std::size_t v = 0; v < hulls.positions[s].size(); ++v) {
            const double height = bottom + hulls.fromCorner(s, v).z;
            rows[row].lowest = std::min(rows[row].lowest, height);
            rows[row].highest = std::max(rows[row].highest, height);
        }
    }
    // A building whose faces are all covered has no extent.
    for (BuildingRow& row : rows)
        if (!(row.lowest <= row.highest)) row.lowest = row.highest = bottom;
    return rows;
}

}  // namespace

Result<LabelHulls> makeTileHulls(const volume::SemanticVolume& volume, MeshChoice choice,
                                 const VolumeWriteOptions& options) {
    SVT_DO(checkDimension(volume.grid, volume.columns));
    SheetSurfaces sheets = sheetSurfaces(volume, choice);
    dropStraightPoints(sheets);
    SVT_TRY(surfaces, labelSurfaces(volume.columns, withoutSheets(volume.labels.labelOfScalar(), volume.labels, sheets),
                                    {std::uint64_t{1} << 27, options.threads, options.progress}));
    if (surfaces->empty() && sheets.surfaces.empty())
        return Error(Code::NothingSelected, "the volume has no voxels and therefore no surface");
    SVT_TRY(positions, placeVertices(volume, *surfaces, options.faces, nullptr, options.threads, options.progress));
    LabelHulls hulls;
    hulls.volume = &volume;
    hulls.hasMeshes = !sheets.surfaces.empty();
    for (std::size_t s = 0, v = 0; s < sheets.surfaces.size() || v < surfaces->size();) {
        const bool isSheet =
            v == surfaces->size() || (s < sheets.surfaces.size() && sheets.surfaces[s].label < (*surfaces)[v].label);
        hulls.surfaces.push_back(std::move(isSheet ? sheets.surfaces[s] : (*surfaces)[v]));
        hulls.positions.push_back(std::move(isSheet ? sheets.positions[s] : (*positions)[v]));
        ++(isSheet ? s : v);
    }
    return hulls;
}

FeatureTexts featureTexts(const volume::SemanticVolume& volume) {
    const auto& labels = volume.labels.labels;
    const auto rows = analyze::queryRows(volume.labels);
    FeatureTexts texts{std::vector<std::string>(labels.size()), analyze::ownVolumes(volume.labels, volume.grid)};
    // Parents precede their children; groups may be anywhere. The storey is a group of the label, or the storey of its
    // parent.
    for (std::size_t l = 0; l < labels.size(); ++l) {
        if (model::query::isStorey(rows[l])) {
            texts.storeys[l] = shownName(labels[l]);
            continue;
        }
        for (const std::uint32_t group : labels[l].groups)
            if (group < rows.size() && texts.storeys[l].empty() && model::query::isStorey(rows[group]))
                texts.storeys[l] = shownName(labels[group]);
        if (texts.storeys[l].empty() && labels[l].parent < l) texts.storeys[l] = texts.storeys[labels[l].parent];
    }
    return texts;
}

Box3d boxOfHulls(const LabelHulls& hulls, std::size_t begin, std::size_t end) {
    Box3d box;
    for (std::size_t s = begin; s < end; ++s)
        for (std::size_t v = 0; v < hulls.positions[s].size(); ++v) box.add(hulls.fromCorner(s, v));
    return box;
}

Result<std::string> makeFeatureGlb(const LabelHulls& hulls, std::size_t begin, std::size_t end,
                                   const FeatureTexts& texts, const TilesetWriteOptions& options) {
    const TileCoding coding{kFinestStep, options.isCompressed};
    TileMesh mesh;
    mesh.isDoubleSided = hulls.hasMeshes;
    if (options.isPerBuilding) {
        const std::vector<BuildingRow> buildings = appendBuildings(hulls, begin, end, mesh);
        return makeTileGlb(
            mesh, buildings.size(), [&](GltfBuffer& buffer) { return buildingTable(buildings, true, buffer); }, {},
            coding);
    }
    for (std::size_t s = begin; s < end; ++s) appendSurface(hulls, s, static_cast<std::uint32_t>(s - begin), mesh);
    return makeTileGlb(
        mesh, end - begin, [&](GltfBuffer& buffer) { return metadataOf(hulls, begin, end, texts, buffer); }, {},
        coding);
}

}  // namespace svt::writers
