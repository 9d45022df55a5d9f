#include <svt/analyze/known_volumes.hpp>

#include <svt/model/building_model.hpp>
#include <svt/model/classes.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace svt::analyze {
namespace {

using volume::Filling;

// Part of its voxels that a solid must share with another one to lie in it: rounding may differ where both end.
constexpr double kContained = 0.98;

// Whether a label has voxels, all from the pass for thin parts.
bool isThinOnly(const volume::Label& label) noexcept { return label.voxels > 0 && label.thinVoxels >= label.voxels; }

}  // namespace

std::string_view volumeSourceName(VolumeSource source) noexcept {
    switch (source) {
        case VolumeSource::None: return "";
        case VolumeSource::Meshes: return "meshes";
        case VolumeSource::Voxels: return "voxels";
        case VolumeSource::Both: return "meshes and voxels";
    }
    return "";
}

KnownVolumes::KnownVolumes(const volume::LabelTable& labels, const volume::Grid& grid, const Extents& extents)
    : labels_(labels),
      extents_(extents),
      own_(ownMeasures(labels, grid)),
      firstOverlap_(labels.labels.size() + 1, 0),
      losses_(labels.labels.size(), 0),
      lostArea_(labels.labels.size(), 0),
      isInside_(labels.labels.size(), 0),
      voxelVolume_(grid.voxelVolume()) {
    const Vec3d spacing = grid.spacing();
    halfVoxel_ = std::max({spacing.x, spacing.y, spacing.z}) / 2;
    voxelSurface_ = 2 * (spacing.x * spacing.y + spacing.y * spacing.z + spacing.z * spacing.x);
    for (const volume::Overlap& overlap : labels.overlaps) {
        ++firstOverlap_[overlap.a + 1];
        const double area = labels.labels[overlap.a].area;
        if (overlap.voxels == 0) continue;
        ++losses_[overlap.b];
        lostArea_[overlap.b] += area > 0 ? area : std::numeric_limits<double>::quiet_NaN();
    }
    for (std::size_t l = 0; l < labels.labels.size(); ++l) firstOverlap_[l + 1] += firstOverlap_[l];
}

// Whether a label lies in a closed solid above it, whatever voxels they share: the material behind a surface does, and
// all that a room has, such as furniture. Voxels of open shells and of thin parts are not counted as shared, so a label
// that has only such voxels lies in the building, storey, unit or room around it.
bool KnownVolumes::liesInSolid(std::uint32_t label) const {
    const volume::Label& own = labels_.labels[label];
    const bool isBody = own.filling == Filling::Body, isThin = isThinOnly(own);
    const auto isAround = [&](std::uint32_t above) {
        const volume::Label& solid = labels_.labels[above];
        const model::ClassRank rank = model::classRank(solid.className);
        const bool isWanted = isBody || rank == model::ClassRank::Room || (isThin && rank >= model::ClassRank::Room);
        return isWanted && isInside_[above] != 0 && solidVolumeOf(solid).has_value();
    };
    while (true) {
        const volume::Label& at = labels_.labels[label];
        if (isThin && std::any_of(at.groups.begin(), at.groups.end(), isAround)) return true;
        if (at.parent >= label) return false;
        label = at.parent;
        if (isAround(label)) return true;
    }
}

// The volume of the outermost solids; empty unless they hold all voxels of the extent and share none.
std::optional<double> KnownVolumes::ofSolids(const std::vector<std::uint32_t>& extent) const {
    std::vector<char> isTop(extent.size(), 0);
    const auto placeOf = [&](std::uint32_t label) {
        return static_cast<std::size_t>(std::lower_bound(extent.begin(), extent.end(), label) - extent.begin());
    };
    std::vector<std::pair<std::size_t, std::size_t>> partial;  // places of solids that share voxels
    std::vector<std::uint32_t> losses(extent.size(), 0);       // to others of the extent
    for (std::size_t n = 0; n < extent.size(); ++n) {
        const volume::Label& label = labels_.labels[extent[n]];
        std::uint64_t most = 0;
        for (std::uint32_t o = firstOverlap_[extent[n]]; o < firstOverlap_[extent[n] + 1]; ++o) {
            const volume::Overlap& overlap = labels_.overlaps[o];
            if (isInside_[overlap.b] == 0 || overlap.voxels == 0) continue;
            partial.emplace_back(n, placeOf(overlap.b));
            ++losses[partial.back().second];
            most = std::max(most, overlap.voxels);
        }
        if (label.filling == Filling::None || label.filling == Filling::Surface) continue;
        // Voxels of thin parts are not among those that solids share.
        const std::uint64_t whole = label.voxels - std::min(label.voxels, label.thinVoxels);
        const bool isContained = most > 0 && double(most) >= kContained * double(whole);
        if (isContained || liesInSolid(extent[n])) continue;
        isTop[n] = 1;
    }
    std::optional<double> sum;
    for (std::size_t n = 0; n < extent.size(); ++n) {
        if (isTop[n] == 0) continue;
        const volume::Label& label = labels_.labels[extent[n]];
        if (label.voxels == 0 && losses[n] == 0) continue;  // outside the grid, or smaller than its samples
        const std::optional<double> volume = solidVolumeOf(label);
        if (!volume) return std::nullopt;
        sum = sum.value_or(0) + *volume;
    }
    // Several solids: only the parts of buildings stand beside each other without doubt. Voxels that other features took
    // do not belong to them.
    if (std::count(isTop.begin(), isTop.end(), 1) < 2) return sum;
    for (std::size_t n = 0; n < extent.size(); ++n) {
        if (isTop[n] == 0) continue;
        const volume::Label& label = labels_.labels[extent[n]];
        const bool isPart = model::classRank(label.className) == model::ClassRank::Building;
        if (!isPart || isThinOnly(label) || losses_[extent[n]] > losses[n]) return std::nullopt;
    }
    for (const auto& [a, b] : partial)
        if (isTop[a] != 0 && isTop[b] != 0) return std::nullopt;
    return sum;
}

std::optional<double> KnownVolumes::countingBound(std::uint32_t label) const {
    const volume::Label& l = labels_.labels[label];
    if (model::isReadInPart(l.attributes)) return std::nullopt;
    const double sides = l.filling == Filling::Body ? 2 : 1;
    double area = sides * l.area + lostArea_[label];
    if (!(l.area > 0) || !std::isfinite(area)) return std::nullopt;
    // Others may have taken nearly all of it: a flat leaves single voxels between its rooms and walls.
    area = std::min(area, own_[label].countedVolume / voxelVolume_ * voxelSurface_);
    return area * halfVoxel_ + double(l.uncertainVoxels) * voxelVolume_;
}

KnownVolume KnownVolumes::ofOwn(const std::vector<std::uint32_t>& extent) const {
    KnownVolume known;
    double counted = 0;
    known.bound = 0;
    for (const std::uint32_t label : extent) {
        const Measure& own = own_[label];
        if (!own.volume) continue;
        known.volume = known.volume.value_or(0) + *own.volume;
        counted += own.countedVolume;
        if (own.countedVolume == 0 || !known.bound) continue;
        const std::optional<double> bound = countingBound(label);
        known.bound = bound ? std::optional(*known.bound + *bound) : std::nullopt;
    }
    if (!known.volume) return {};
    known.source = counted == 0               ? VolumeSource::Meshes
                   : counted == *known.volume ? VolumeSource::Voxels
                                              : VolumeSource::Both;
    return known;
}

KnownVolume KnownVolumes::of(std::uint32_t label) const {
    if (model::isReadInPart(labels_.labels[label].attributes)) return {};
    const std::vector<std::uint32_t> extent = extents_.of(label);
    for (const std::uint32_t part : extent) isInside_[part] = 1;
    const std::optional<double> solids = ofSolids(extent);
    const KnownVolume known = solids ? KnownVolume{solids, 0.0, VolumeSource::Meshes} : ofOwn(extent);
    for (const std::uint32_t part : extent) isInside_[part] = 0;
    return known;
}

}  // namespace svt::analyze
