#include <svt/writers/city_tileset.hpp>

#include <svt/analyze/known_volumes.hpp>
#include <svt/analyze/label_measures.hpp>
#include <svt/model/classes.hpp>
#include <svt/writers/dense/new_folder.hpp>
#include <svt/writers/gltf/label_surface.hpp>
#include <svt/writers/gltf/sheet_surfaces.hpp>
#include <svt/writers/gltf/straight_points.hpp>
#include <svt/writers/gltf/surface_positions.hpp>
#include <svt/writers/labels/label_looks.hpp>
#include <svt/writers/tiles3d/building_table.hpp>
#include <svt/writers/tiles3d/globe_patch.hpp>
#include <svt/writers/tiles3d/property_table.hpp>
#include <svt/writers/tiles3d/quadtree_index.hpp>
#include <svt/writers/tiles3d/tile_glb.hpp>
#include <svt/writers/tiles3d/tile_mesh.hpp>
#include <svt/writers/tiles3d/tileset_frame.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace svt::writers {
namespace {

using volume::kNoLabel;

/// The content of a square while it is made.
struct Content {
    TileMesh mesh;
    std::vector<BuildingRow> buildings;
    Box3d box;     // in the frame of the root
    Vec3d origin;  // of the mesh, in the frame of the root
    double cell = 0;
    bool hasVoxels = false;
};

// The label without parent above each label.
std::vector<std::uint32_t> rootsOf(const volume::LabelTable& table) {
    std::vector<std::uint32_t> rootOf(table.labels.size());
    for (std::uint32_t l = 0; l < rootOf.size(); ++l)
        rootOf[l] = table.labels[l].parent < l ? rootOf[table.labels[l].parent] : l;
    return rootOf;
}

// The faces of the model, without those of features with rooms or bodies, whose parts hide each other.
SheetSurfaces outsideSheets(const volume::SemanticVolume& volume, MeshChoice choice,
                            const std::vector<std::uint32_t>& rootOf) {
    const auto& labels = volume.labels.labels;
    std::vector<char> hasInside(labels.size(), 0);
    for (std::size_t l = 0; l < labels.size(); ++l)
        if (labels[l].voxels > 0 && (labels[l].filling == volume::Filling::Body || model::isSpace(labels[l].className)))
            hasInside[rootOf[l]] = 1;
    SheetSurfaces all = sheetSurfaces(volume, choice), kept;
    for (std::size_t s = 0; s < all.surfaces.size(); ++s) {
        if (hasInside[rootOf[all.surfaces[s].label]] != 0) continue;
        kept.surfaces.push_back(std::move(all.surfaces[s]));
        kept.positions.push_back(std::move(all.positions[s]));
    }
    dropStraightPoints(kept);
    return kept;
}

// Colours of upward, upright and downward faces.
std::array<VertexColor, 3> colorsOf(const std::vector<volume::Label>& labels, std::uint32_t root) {
    constexpr std::string_view kClasses[] = {"RoofSurface", "WallSurface", "GroundSurface"};
    std::array<VertexColor, 3> colors;
    colors.fill(linearColor(labels[root].color, 1));
    std::array<bool, 3> isKnown{};
    for (std::uint32_t l = root + 1; l < labels[root].subtreeEnd; ++l)
        for (std::size_t kind = 0; kind < 3; ++kind)
            if (!isKnown[kind] && labels[l].className == kClasses[kind]) {
                colors[kind] = linearColor(labels[l].color, 1);
                isKnown[kind] = true;
            }
    return colors;
}

class Tileset final : public CityTileset {
public:
    Tileset(const std::filesystem::path& path, const CityTilesetFrame& frame, std::unique_ptr<GlobeLattice> lattice)
        : frame_(frame), lattice_(std::move(lattice)), folder_(path) {}

    Result<void> begin() { return folder_.create(); }

    Result<TileContent> make(const NextVolume& next, double error, double cell) const override {
        Content content;
        content.cell = cell;
        while (true) {
            SVT_TRY(volume, next());
            if (!*volume) break;
            SVT_DO(append(**volume, content));
        }
        TileContent made;
        made.error = error;
        made.box = content.box;
        made.features = content.buildings.size();
        made.hasVoxels = content.hasVoxels;
        if (content.mesh.indices.empty()) return made;
        const double mostStep = std::max({kFinestStep, error / 16, cell / 16});
        SVT_TRY(glb,
                makeTileGlb(content.mesh, content.buildings.size(),
                            [&](GltfBuffer& buffer) { return buildingTable(content.buildings, error == 0, buffer); },
                            content.origin, {mostStep, frame_.write.tileset.isCompressed}));
        made.glb = std::move(*glb);
        return made;
    }

    Result<void> add(QuadtreeNode node, const TileContent& content) override {
        if (content.glb.empty()) return {};
        index_.add(node, content.box, content.error);
        return folder_.write(fmt::format("content/{}/{}/{}.glb", node.level, node.x, node.y), content.glb);
    }

    Result<std::uint64_t> finish() override {
        if (index_.isEmpty()) return Error(Code::NothingSelected, "nothing is filled, so there is no surface");
        index_.close();
        auto written = index_.forEachSubtree([&](QuadtreeNode node, const std::string& bytes) {
            return folder_.write(fmt::format("subtrees/{}/{}/{}.subtree", node.level, node.x, node.y), bytes);
        });
        if (!written) return written.error();
        written = folder_.write("tileset.json", document());
        if (!written) return written.error();
        return folder_.commit();
    }

private:
    Result<void> append(const volume::SemanticVolume& volume, Content& content) const {
        if (Progress::isCancelled(frame_.write.progress)) return Error(Code::Cancelled, "stopped; nothing was left");
        const std::vector<std::uint32_t> rootOf = rootsOf(volume.labels);
        const SheetSurfaces sheets = outsideSheets(volume, meshChoice(frame_.write, MeshChoice::Open), rootOf);
        std::vector<std::uint32_t> labelOf = withoutSheets(volume.labels.labelOfScalar(), volume.labels, sheets);
        for (std::uint32_t& label : labelOf)
            if (label != kNoLabel) label = rootOf[label];
        SVT_TRY(surfaces, labelSurfaces(volume.columns, labelOf, {std::uint64_t{1} << 27, 1, nullptr}));
        if (surfaces->empty() && sheets.surfaces.empty()) return {};
        SVT_TRY(positions, placeVertices(volume, *surfaces, frame_.write.faces, nullptr, 1, nullptr));
        const volume::Grid& grid = volume.grid;
        const Vec3d low = lowerCorner(grid);
        const Vec3d high = grid.worldFromIndex(toDouble(grid.dimension()) + Vec3d{-0.5, -0.5, -0.5});
        SVT_TRY(patch, lattice_->patch({low.x, low.y, high.x, high.y}));
        if (content.mesh.positions.empty()) content.origin = patch->place(low);
        content.mesh.isDoubleSided = content.mesh.isDoubleSided || !sheets.surfaces.empty();
        content.hasVoxels = content.hasVoxels || volume.vectors.triangles.empty();
        const auto& labels = volume.labels.labels;
        std::size_t sheet = 0, voxels = 0;
        for (std::uint32_t root = 0; root < labels.size(); root = std::max(root + 1, labels[root].subtreeEnd)) {
            Parts parts{*patch, low, content.origin, {}, {labels[root]}};
            const auto colors = colorsOf(labels, root);
            const auto byDirection = [&](Vec3d normal) -> VertexColor {
                constexpr double kUpright = 0.2;  // 78 degrees
                return colors[normal.z > kUpright ? 0 : normal.z < -kUpright ? 2 : 1];
            };
            for (; voxels < surfaces->size() && (*surfaces)[voxels].label == root; ++voxels)
                parts.add((*surfaces)[voxels], (*positions)[voxels], byDirection);
            for (; sheet < sheets.surfaces.size() && rootOf[sheets.surfaces[sheet].label] == root; ++sheet) {
                const volume::Label& own = labels[sheets.surfaces[sheet].label];
                const VertexColor color = linearColor(own.color, 1);
                const bool isBody = model::classRank(own.className) == model::ClassRank::Building;
                parts.add(sheets.surfaces[sheet], sheets.positions[sheet],
                          [&](Vec3d normal) { return isBody ? byDirection(normal) : color; });
            }
            if (!parts.hasAny) continue;
            parts.building.volume = volumeOf(volume, root);
            addBuilding(parts, content);
        }
        return {};
    }

    /// The surfaces of a building.
    struct Parts {
        const GlobePatch& patch;
        Vec3d low, origin;
        FeatureFaces faces;
        BuildingRow building;
        bool hasAny = false;

        void add(const LabelSurface& surface, const Positions& positions,
                 const std::function<VertexColor(Vec3d)>& colorOfNormal) {
            hasAny = true;
            std::vector<Vec3d> places;
            for (const Vec3f position : positions) {
                const Vec3d world = low + toDouble(position);
                building.lowest = std::min(building.lowest, world.z);
                building.highest = std::max(building.highest, world.z);
                places.push_back(patch.place(world) - origin);
            }
            faces.add(surface, places, colorOfNormal);
        }
    };

    static void addBuilding(Parts& parts, Content& content) {
        if (content.cell > 0) {
            parts.faces = simplified(parts.faces, content.cell);
            if (parts.faces.triangles.empty()) return;
        }
        for (const auto& triangle : parts.faces.triangles)
            for (const std::uint32_t corner : triangle) content.box.add(parts.faces.points[corner] + content.origin);
        content.mesh.append(parts.faces, static_cast<std::uint32_t>(content.buildings.size()));
        content.buildings.push_back(std::move(parts.building));
    }

    // m3; 0: unknown. Open shells have no volume of their own at detail 0.
    static double volumeOf(const volume::SemanticVolume& volume, std::uint32_t label) {
        const auto& labels = volume.labels.labels;
        const bool isCounted =
            std::any_of(labels.begin() + label, labels.begin() + labels[label].subtreeEnd,
                        [](const auto& part) { return part.filling == volume::Filling::Winding && part.volume == 0; });
        if (!isCounted) return analyze::solidVolume(volume.labels, label);
        const analyze::Extents extents(volume.labels);
        return analyze::KnownVolumes(volume.labels, volume.grid, extents).of(label).volume.value_or(0);
    }

    [[nodiscard]] std::string document() const {
        const auto& [box, error, hasContent] = index_.root();
        // In plan the square of the root, so that its quarters are squares of the quadtree for readers who divide it.
        const Vec3d half{frame_.side / 2, frame_.side / 2, 0};
        Box3d own = box;
        own.add(frame_.write.tileset.place ? Vec3d{} : half * -1.0);
        own.add(frame_.write.tileset.place ? half * 2.0 : half);
        own.min.z = box.min.z;
        own.max.z = box.max.z;
        const double rootError = std::max(error, length(own.size()) / 16);
        const TilesetJson tile{{"boundingBox",
                                {{"type", "SCALAR"},
                                 {"componentType", "FLOAT64"},
                                 {"array", true},
                                 {"count", 12},
                                 {"required", true},
                                 {"semantic", "TILE_BOUNDING_BOX"}}},
                               {"geometricError",
                                {{"type", "SCALAR"},
                                 {"componentType", "FLOAT64"},
                                 {"required", true},
                                 {"semantic", "TILE_GEOMETRIC_ERROR"}}}};
        const TilesetJson root{{"transform", transformOf(lattice_->frame())},
                               {"boundingVolume", boundingVolume(own)},
                               {"geometricError", rootError},
                               {"refine", "REPLACE"},
                               {"content", {{"uri", "content/{level}/{x}/{y}.glb"}}},
                               {"implicitTiling",
                                {{"subdivisionScheme", "QUADTREE"},
                                 {"subtreeLevels", QuadtreeIndex::kSubtreeLevels},
                                 {"availableLevels", frame_.levels},
                                 {"subtrees", {{"uri", "subtrees/{level}/{x}/{y}.subtree"}}}}}};
        volume::SemanticVolume named;
        named.crsName = frame_.crsName;
        named.source = frame_.source;
        const TilesetJson tileset{{"asset", assetOf(named, frame_.corner)},
                                  {"schema", {{"id", "svt"}, {"classes", {{"tile", {{"properties", tile}}}}}}},
                                  {"geometricError", 2 * rootError},
                                  {"root", root}};
        return tileset.dump(1, ' ', false, TilesetJson::error_handler_t::replace) + "\n";
    }

    CityTilesetFrame frame_;
    std::unique_ptr<GlobeLattice> lattice_;
    NewFolder folder_;
    QuadtreeIndex index_;
};

}  // namespace

Result<std::unique_ptr<CityTileset>> CityTileset::create(const std::filesystem::path& path,
                                                         const CityTilesetFrame& frame) {
    if (frame.levels < 1 || frame.levels > kMostLevels)
        return Error(Code::BadArgument,
                     fmt::format("a quadtree of {} levels: 1 to {} are possible", frame.levels, kMostLevels));
    // A given place is that of the corner; else the frame touches the globe in the middle.
    Vec3d reference = frame.corner;
    if (!frame.write.tileset.place) reference = reference + Vec3d{frame.side / 2, frame.side / 2, 0};
    SVT_TRY(lattice, GlobeLattice::create(frame.crsName, reference, frame.write));
    auto tileset = std::make_unique<Tileset>(path, frame, std::move(*lattice));
    SVT_DO(tileset->begin());
    return std::unique_ptr<CityTileset>(std::move(tileset));
}

}  // namespace svt::writers
