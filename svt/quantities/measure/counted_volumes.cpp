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
    const std::vector<analyze::Measure> own = analyze::exclusiveMeasures(analyze::keepLabels(volume, isKept));
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
