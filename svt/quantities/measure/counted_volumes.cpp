#include <svt/quantities/quantities.hpp>

#include <svt/analyze/exclusive_volumes.hpp>

#include <set>
#include <tuple>
#include <utility>

namespace svt::quantities {
namespace {

// The triangles of one label, in any order and from any corner: two sums of independent digests, and their number.
using MeshDigest = std::tuple<std::uint64_t, std::uint64_t, std::uint64_t>;

std::vector<MeshDigest> digestsOf(const volume::SemanticVolume& volume) {
    std::vector<MeshDigest> digests(volume.labels.labels.size());
    for (const auto& triangle : volume.vectors.triangles) {
        auto& [first, second, count] = digests[triangle.label];
        first += volume::digestOf(volume.vectors, triangle, 1);
        second += volume::digestOf(volume.vectors, triangle, 2);
        ++count;
    }
    return digests;
}

// The labels of the objects only, as if the volume had nothing else. Voxels that others took are theirs again.
volume::SemanticVolume onlyObjects(const volume::SemanticVolume& volume, const std::vector<char>& isKept) {
    volume::SemanticVolume kept;
    kept.grid = volume.grid;
    kept.labels.labels = volume.labels.labels;
    auto& labels = kept.labels.labels;
    for (std::size_t l = 0; l < labels.size(); ++l)
        if (isKept[l] == 0) {
            labels[l].filling = volume::Filling::None;
            labels[l].voxels = labels[l].thinVoxels = 0;
            labels[l].count = 0;
            labels[l].volume = 0;
        }
    for (const volume::Overlap& overlap : volume.labels.overlaps) {
        if (isKept[overlap.b] == 0) continue;
        if (isKept[overlap.a] != 0)
            kept.labels.overlaps.push_back(overlap);
        else
            labels[overlap.b].voxels += overlap.voxels;
    }
    kept.vectors.unit = volume.vectors.unit;
    kept.vectors.points = volume.vectors.points;
    for (const auto& triangle : volume.vectors.triangles)
        if (isKept[triangle.label] != 0) kept.vectors.triangles.push_back(triangle);
    return kept;
}

}  // namespace

std::vector<CountedVolume> countedVolumes(const volume::SemanticVolume& volume,
                                          std::span<const ObjectQuantities> objects) {
    // Equal closed meshes at one place count once: the first of them does. Thousands of them would be compared pair by pair.
    const std::vector<MeshDigest> digests = digestsOf(volume);
    std::set<MeshDigest> known;
    std::vector<char> isKept(volume.labels.labels.size(), 0), isRepeated(isKept.size(), 0);
    for (const ObjectQuantities& object : objects)
        for (const std::uint32_t part : object.parts) {
            const bool isSolid =
                volume::hasClosedMesh(volume.labels.labels[part].filling) && std::get<2>(digests[part]) > 0;
            isRepeated[part] = isSolid && !known.insert(digests[part]).second;
            isKept[part] = isRepeated[part] == 0;
        }
    const std::vector<analyze::Measure> own = analyze::exclusiveMeasures(onlyObjects(volume, isKept));
    std::vector<CountedVolume> counted;
    counted.reserve(objects.size());
    for (const ObjectQuantities& object : objects) {
        CountedVolume& sum = counted.emplace_back();
        sum.isExact = true;
        for (const std::uint32_t part : object.parts) {
            if (isRepeated[part] != 0 && object.netVolume) sum.volume = sum.volume.value_or(0);
            if (!own[part].volume || !object.netVolume || isRepeated[part] != 0) continue;
            sum.volume = sum.volume.value_or(0) + *own[part].volume;
            sum.isExact = sum.isExact && own[part].countedVolume == 0;
        }
        sum.isExact = sum.isExact && sum.volume.has_value();
    }
    return counted;
}

}  // namespace svt::quantities
