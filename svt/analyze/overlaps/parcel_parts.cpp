#include <svt/analyze/parcel_parts.hpp>

#include <svt/analyze/extents.hpp>
#include <svt/analyze/label_measures.hpp>
#include <svt/analyze/overlaps/exclusive_parts.hpp>
#include <svt/analyze/overlaps/solid_clips.hpp>
#include <svt/analyze/shared_voxels.hpp>
#include <svt/analyze/solid_overlaps.hpp>

#include <algorithm>
#include <cmath>
#include <map>

namespace svt::analyze {
namespace {

using volume::kNoLabel;

constexpr double kLeastPart = 1e-9;  // m3; smaller parts come from rounding

// Whether all parcels are closed meshes without common space.
bool areExactParcels(const volume::SemanticVolume& parcels) {
    const std::vector<MeshSolid> solids = meshSolids(parcels);
    for (std::uint32_t l = 0; l < parcels.labels.labels.size(); ++l) {
        const bool hasMesh = std::any_of(solids.begin(), solids.end(), [&](const auto& s) { return s.label == l; });
        if (parcels.labels.labels[l].voxels > 0 && !hasMesh) return false;
    }
    return !solids.empty() && solidOverlaps(parcels).pairs.empty();
}

class ParcelDivider {
public:
    ParcelDivider(const volume::SemanticVolume& volume, const volume::SemanticVolume& parcels,
                  std::vector<SharedVoxels> shared)
        : volume_(volume),
          parcels_(parcels),
          extents_(volume.labels),
          own_(ownMeasures(volume.labels, volume.grid)),
          shared_(std::move(shared)) {
        first_.resize(volume.labels.labels.size() + 1);
        for (std::uint32_t l = 0; l < first_.size(); ++l)
            first_[l] = static_cast<std::size_t>(
                std::lower_bound(shared_.begin(), shared_.end(), l,
                                 [](const SharedVoxels& pair, std::uint32_t a) { return pair.a < a; }) -
                shared_.begin());
    }

    std::vector<ParcelPart> run(std::span<const std::uint32_t> features, std::uint64_t work) {
        exact_.all.assign(volume_.labels.labels.size(), std::nan(""));
        areExact_ = areExactParcels(parcels_);
        if (areExact_) {
            exact_ = exclusiveParts(volume_, extents_.of(features), parcels_, work);
            parcelSolids_ = meshSolids(parcels_);
            boxes_ = labelWorldBoxes(volume_);
            const Vec3d origin = volume_.grid.origin();
            for (Box3d& box : boxes_)
                if (!box.isEmpty()) box = {box.min - origin, box.max - origin};
        }
        for (const std::uint32_t feature : features) divide(feature);
        return std::move(parts_);
    }

private:
    // The volume of a feature in one parcel.
    struct Sum {
        std::uint64_t voxels = 0;
        double exact = 0, counted = 0, bound = 0;
    };

    void divide(std::uint32_t feature) {
        std::map<std::uint32_t, Sum> sums;  // by parcel; kNoLabel is the last
        double countedBound = 0, all = 0;
        bool hasExact = false;
        for (const std::uint32_t label : extents_.of(feature)) {
            const bool isExact = !std::isnan(exact_.all[label]);
            hasExact = hasExact || (isExact && exact_.all[label] > 0);
            if (isExact) addExact(label, sums);
            countedBound += addVoxels(label, isExact, sums);
        }
        for (const auto& [parcel, sum] : sums) all += std::max(0.0, sum.exact) + sum.counted;
        // A feature of surfaces has no volume: its voxels are divided.
        const bool isSurface = !(all > 0);
        const double voxelVolume = volume_.grid.voxelVolume();
        if (isSurface)
            for (const auto& [parcel, sum] : sums) all += double(sum.voxels) * voxelVolume;
        for (const auto& [parcel, sum] : sums) {
            const double counted = isSurface ? double(sum.voxels) * voxelVolume : sum.counted;
            const double volume = std::max(0.0, sum.exact) + counted;
            if (volume <= std::max(kLeastPart, counted > 0 ? 0 : sum.bound)) continue;
            ParcelPart part{feature, parcel, sum.voxels, volume, volume / all, std::nullopt};
            part.source = counted == 0 ? VolumeSource::Meshes : hasExact ? VolumeSource::Both : VolumeSource::Voxels;
            if (areExact_ && !isSurface) part.bound = sum.bound + countedBound;
            parts_.push_back(part);
        }
    }

    // Adds the voxels of a label, and its volume in proportion to them if it is not exact. Sheets have no volume.
    // \return m3 by which the counted volume may be off
    double addVoxels(std::uint32_t label, bool isExact, std::map<std::uint32_t, Sum>& sums) const {
        double voxels = 0;
        for (std::size_t at = first_[label]; at < first_[label + 1]; ++at) voxels += double(shared_[at].voxels);
        const double volume = isExact ? 0 : own_[label].volume.value_or(0);
        for (std::size_t at = first_[label]; at < first_[label + 1]; ++at) {
            Sum& sum = sums[shared_[at].b];
            sum.voxels += shared_[at].voxels;
            sum.counted += volume * double(shared_[at].voxels) / voxels;
        }
        return volume > 0 && voxels > 0 ? boundOf(label) : 0;
    }

    void addExact(std::uint32_t label, std::map<std::uint32_t, Sum>& sums) const {
        double outside = exact_.all[label], bound = 0;
        for (auto at = exact_.shared.lower_bound({label, 0}); at != exact_.shared.end() && at->first.first == label;
             ++at) {
            Sum& sum = sums[at->first.second];
            sum.exact += at->second.volume;
            sum.bound += at->second.bound;
            outside -= at->second.volume;
            bound += at->second.bound;
        }
        Sum& rest = sums[kNoLabel];
        rest.exact += outside;
        rest.bound += bound;
    }

    // m3 by which counting may be off: half a voxel along the surface of a label and along the borders in it.
    [[nodiscard]] double boundOf(std::uint32_t label) const {
        const volume::Label& known = volume_.labels.labels[label];
        const double all = own_[label].volume.value_or(0);
        if (!(known.area > 0)) return all;
        double area = known.area;
        for (const MeshSolid& parcel : parcelSolids_)
            if (const Box3d box = commonBox(boxes_[label], parcel.box); !box.isEmpty())
                area += clipSolid(parcel, parcels_.vectors, box).area;
        return std::min(all, 0.5 * length(volume_.grid.spacing()) * area);
    }

    const volume::SemanticVolume& volume_;
    const volume::SemanticVolume& parcels_;
    const Extents extents_;
    const std::vector<Measure> own_;
    const std::vector<SharedVoxels> shared_;
    std::vector<std::size_t> first_;  // of label l: shared_[first_[l]] .. [l + 1]
    bool areExact_ = false;
    ExclusiveParts exact_;
    std::vector<MeshSolid> parcelSolids_;
    std::vector<Box3d> boxes_;
    std::vector<ParcelPart> parts_;
};

}  // namespace

Result<std::vector<ParcelPart>> partsInParcels(const volume::SemanticVolume& volume,
                                               std::span<const std::uint32_t> features,
                                               const volume::SemanticVolume& parcels, int threads, std::uint64_t work) {
    SVT_TRY(shared, sharedVoxels(volume, parcels, threads));
    return ParcelDivider(volume, parcels, std::move(*shared)).run(features, work);
}

}  // namespace svt::analyze
