#include <svt/writers/city_tileset.hpp>

#include <svt/analyze/known_volumes.hpp>
#include <svt/analyze/label_measures.hpp>
#include <svt/writers/dense/new_folder.hpp>
#include <svt/writers/gltf/label_surface.hpp>
#include <svt/writers/gltf/surface_positions.hpp>
#include <svt/writers/labels/label_looks.hpp>
#include <svt/writers/tiles3d/feature_glb.hpp>
#include <svt/writers/tiles3d/globe_patch.hpp>
#include <svt/writers/tiles3d/quadtree_index.hpp>
#include <svt/writers/tiles3d/tileset_frame.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace svt::writers {
namespace {

using volume::kNoLabel;

/// Data of a building for a row of the table, besides its label.
struct Building {
    const volume::Label* label = nullptr;
    double volume = 0, lowest = 0, highest = 0;
};

/// The content of a square while it is made.
struct Content {
    FlatMesh mesh;
    std::vector<Building> buildings;
    Box3d box;     // in the frame of the root
    Vec3d origin;  // of the mesh, in the frame of the root
};

// The label without parent above each scalar.
std::vector<std::uint32_t> rootOfScalar(const volume::LabelTable& table) {
    std::vector<std::uint32_t> rootOf(table.labels.size()), roots = table.labelOfScalar();
    for (std::uint32_t l = 0; l < rootOf.size(); ++l)
        rootOf[l] = table.labels[l].parent < l ? rootOf[table.labels[l].parent] : l;
    for (std::uint32_t& label : roots)
        if (label != kNoLabel) label = rootOf[label];
    return roots;
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

/// The table of a content.
nlohmann::ordered_json tableOf(const std::vector<Building>& buildings, GltfBuffer& buffer) {
    std::vector<std::string> ids, names, classes, attributes;
    std::vector<double> volumes, heights, lowest;
    for (const Building& building : buildings) {
        const volume::Label& label = *building.label;
        ids.push_back(label.id);
        names.push_back(label.name);
        classes.push_back(label.className);
        volumes.push_back(building.volume);
        heights.push_back(building.highest - building.lowest);
        lowest.push_back(building.lowest);
        attributes.push_back(attributesText(label));
    }
    PropertyTable table(buffer, buildings.size());
    table.strings("id", "id of the building in the model; of coarse content the classes that stand there", ids);
    table.strings("name", "name of the building, may be empty", names);
    table.strings("class", "class of CityGML", classes);
    table.knownNumbers("volume", "cubic metres", volumes);
    table.numbers("height", "metres from the lowest to the highest voxel", heights);
    table.numbers("lowest", "metres above datum", lowest);
    table.strings("attributes", "attributes of the building as JSON", attributes);
    return table.extension("building", "a building, or all features of a place in coarse content");
}

class Tileset final : public CityTileset {
public:
    Tileset(const std::filesystem::path& path, const CityTilesetFrame& frame, std::unique_ptr<GlobeLattice> lattice)
        : frame_(frame), lattice_(std::move(lattice)), folder_(path) {}

    Result<void> begin() { return folder_.create(); }

    Result<TileContent> make(std::span<const volume::SemanticVolume> volumes, double error) const override {
        Content content;
        for (const volume::SemanticVolume& volume : volumes) SVT_DO(append(volume, content));
        TileContent made;
        made.error = error;
        made.box = content.box;
        made.features = content.buildings.size();
        if (content.mesh.indices.empty()) return made;
        SVT_TRY(glb, makeMeshGlb(
                         content.mesh, {}, content.buildings.size(),
                         [&](GltfBuffer& buffer) { return tableOf(content.buildings, buffer); }, content.origin,
                         content.buildings.size() < 65536 ? VertexStorage::Quantized : VertexStorage::Full));
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
        SVT_TRY(surfaces,
                labelSurfaces(volume.columns, rootOfScalar(volume.labels), {std::uint64_t{1} << 27, 1, nullptr}));
        if (surfaces->empty()) return {};
        SVT_TRY(positions, placeVertices(volume, *surfaces, frame_.write.faces, nullptr, 1, nullptr));
        const volume::Grid& grid = volume.grid;
        const Vec3d low = lowerCorner(grid);
        const Vec3d high = grid.worldFromIndex(toDouble(grid.dimension()) + Vec3d{-0.5, -0.5, -0.5});
        SVT_TRY(patch, lattice_->patch({low.x, low.y, high.x, high.y}));
        if (content.mesh.positions.empty()) content.origin = patch->place(low);
        const auto& labels = volume.labels.labels;
        for (std::size_t s = 0; s < surfaces->size(); ++s) {
            const LabelSurface& surface = (*surfaces)[s];
            std::vector<Vec3d> places;
            Building building{&labels[surface.label], volumeOf(volume, surface.label), INFINITY, -INFINITY};
            for (const Vec3f position : (*positions)[s]) {
                const Vec3d world = low + toDouble(position);
                building.lowest = std::min(building.lowest, world.z);
                building.highest = std::max(building.highest, world.z);
                const Vec3d place = patch->place(world);
                content.box.add(place);
                places.push_back(place - content.origin);
            }
            const auto colors = colorsOf(labels, surface.label);
            content.mesh.append(surface, places, static_cast<float>(content.buildings.size()), [&](Vec3d normal) {
                constexpr double kUpright = 0.2;  // 78 degrees
                return colors[normal.z > kUpright ? 0 : normal.z < -kUpright ? 2 : 1];
            });
            content.buildings.push_back(building);
        }
        return {};
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
