#include <svt/city/city_folder.hpp>
#include <svt/city/city_levels.hpp>
#include <svt/city/join/join_volumes.hpp>
#include <svt/volume/volume_part.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace svt::city {
namespace {

// The volume with only the chosen labels, and a table of these. \param kept  ascending; whole subtrees
volume::SemanticVolume withLabels(const volume::SemanticVolume& volume, const std::vector<std::uint32_t>& kept) {
    const std::vector<volume::Label>& labels = volume.labels.labels;
    volume::SemanticVolume result;
    result.grid = volume.grid;
    result.crsName = volume.crsName;
    result.modelName = volume.modelName;
    result.planes = volume.planes;
    std::vector<std::uint32_t> newOf(labels.size(), volume::kNoLabel);
    for (std::uint32_t n = 0; n < kept.size(); ++n) newOf[kept[n]] = n;
    std::vector<volume::Scalar> scalarOf(volume.labels.scalarCount(), 0);
    volume::Scalar next = 1;
    for (const std::uint32_t l : kept) {
        volume::Label label = labels[l];
        // The end of a subtree is behind its last label, which is kept, too.
        label.subtreeEnd = newOf[label.subtreeEnd - 1] + 1;
        label.parent = label.parent == volume::kNoLabel ? volume::kNoLabel : newOf[label.parent];
        std::vector<std::uint32_t> groups;
        for (const std::uint32_t group : label.groups)
            if (newOf[group] != volume::kNoLabel) groups.push_back(newOf[group]);
        label.groups = std::move(groups);
        for (volume::Scalar s = 0; s < label.count; ++s) scalarOf[label.first + s] = next + s;
        if (label.count > 0) label.first = next;
        next += label.count;
        result.labels.labels.push_back(std::move(label));
    }
    for (volume::Overlap overlap : volume.labels.overlaps) {
        overlap.a = newOf[overlap.a];
        overlap.b = newOf[overlap.b];
        if (overlap.a != volume::kNoLabel && overlap.b != volume::kNoLabel) result.labels.overlaps.push_back(overlap);
    }
    result.footprints = volume.footprints;
    std::erase_if(result.footprints.triangles,
                  [&](const auto& triangle) { return newOf[triangle.label] == volume::kNoLabel; });
    for (auto& triangle : result.footprints.triangles) triangle.label = newOf[triangle.label];
    result.columns = volume::replaceScalars(volume.columns, scalarOf);
    return result;
}

// The labels of buildings by id, with all below them.
std::vector<std::uint32_t> labelsOf(const volume::LabelTable& table, const std::vector<std::string>& ids) {
    std::vector<std::uint32_t> kept;
    for (std::uint32_t l = 0; l < table.labels.size(); ++l)
        if (std::find(ids.begin(), ids.end(), table.labels[l].id) != ids.end())
            for (std::uint32_t below = l; below < table.labels[l].subtreeEnd; ++below) kept.push_back(below);
    std::sort(kept.begin(), kept.end());
    kept.erase(std::unique(kept.begin(), kept.end()), kept.end());
    return kept;
}

Result<std::vector<IndexEntry>> entriesOf(const City& city, const Extract& extract) {
    std::array<double, 4> rectangle = kEverywhere;
    if (extract.hasBox) rectangle = {extract.box[0], extract.box[1], extract.box[3], extract.box[4]};
    std::vector<TileKey> tiles = extract.tiles;
    for (const std::string& id : extract.ids) {
        SVT_TRY(places, city.find(id));
        if (places->empty())
            return Error(Code::NothingSelected, fmt::format("the city has no building with the id '{}'", id));
        for (const City::Place& place : *places) tiles.push_back(place.tile);
    }
    if (!tiles.empty() && !extract.hasBox && extract.detail < kFirstClassDetail) {
        // Reads only the pages of the index around these tiles. The survey counts geometry that a tile may lack, such
        // as another level of detail, so samples may also lie beside the square.
        rectangle = {rectangle[2], rectangle[3], rectangle[0], rectangle[1]};
        for (const TileKey& tile : tiles) {
            const double side = tileSide(tile, extract.detail, city.spacing());
            rectangle = {std::min(rectangle[0], tile.x * side - kMostReach),
                         std::min(rectangle[1], tile.y * side - kMostReach),
                         std::max(rectangle[2], (tile.x + 1) * side + kMostReach),
                         std::max(rectangle[3], (tile.y + 1) * side + kMostReach)};
        }
    }
    SVT_TRY(entries, city.find(extract.detail, rectangle));
    if (!tiles.empty())
        std::erase_if(*entries, [&](const IndexEntry& entry) {
            return std::find(tiles.begin(), tiles.end(), entry.tile) == tiles.end();
        });
    if (entries->empty()) return Error(Code::NothingSelected, "no tile of the city lies there, or its pack is missing");
    return entries;
}

}  // namespace

Result<volume::SemanticVolume> extractVolume(const City& city, const Extract& extract) {
    if (extract.detail > city.topDetail())
        return Error(Code::BadArgument,
                     fmt::format("detail {}: the coarsest of this city is {}", extract.detail, city.topDetail()));
    if (extract.detail >= kFirstClassDetail && !extract.ids.empty())
        return Error(Code::BadArgument, "details 2 and up have classes, no buildings; choose by --box or --tile");
    SVT_TRY(entries, entriesOf(city, extract));
    std::vector<volume::SemanticVolume> parts;
    for (const IndexEntry& entry : *entries) {
        SVT_TRY(volume, city.read(entry));
        if (!extract.ids.empty()) {
            const std::vector<std::uint32_t> kept = labelsOf(volume->labels, extract.ids);
            if (kept.empty()) continue;
            volume = withLabels(*volume, kept);
        }
        parts.push_back(std::move(*volume));
    }
    if (parts.empty()) return Error(Code::NothingSelected, "no building of the city has such an id");
    SVT_TRY(joined, parts.size() == 1 ? Result<volume::SemanticVolume>(std::move(parts.front()))
                                      : joinVolumes(parts, extract.detail >= kFirstClassDetail));
    const auto& b = extract.box;
    if (extract.hasBox) return volume::volumeIn(*joined, {{b[0], b[1], b[2]}, {b[3], b[4], b[5]}});
    if (extract.ids.empty()) return joined;
    const volume::IndexBox box = volume::samplesAround(joined->columns);
    if (box.begin.x >= box.end.x) return joined;
    return volume::croppedVolume(*joined, box);
}

Result<volume::SemanticVolume> wholeVolume(const City& city, std::uint64_t mostBytes, double mostSamples) {
    const Box3d& box = city.box();
    const double extent = std::max(box.max.x - box.min.x, box.max.y - box.min.y);
    Extract extract;
    extract.box = {box.min.x, box.min.y, box.min.z, box.max.x, box.max.y, box.max.z};
    extract.hasBox = true;
    for (extract.detail = 0; extract.detail < city.topDetail(); ++extract.detail) {
        SVT_TRY(entries, city.find(extract.detail, kEverywhere));
        std::uint64_t bytes = 0;
        for (const IndexEntry& entry : *entries) bytes += entry.size;
        if (bytes <= mostBytes && extent / spacingOf(extract.detail, city.spacing()).x <= mostSamples) break;
    }
    return extractVolume(city, extract);
}

}  // namespace svt::city
