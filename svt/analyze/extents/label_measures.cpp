#include <svt/analyze/label_measures.hpp>

#include <svt/model/building_model.hpp>
#include <svt/model/classes.hpp>

#include <algorithm>

namespace svt::analyze {

namespace {

// Entry per label: the number of voxels of the sheets that bound it, which lie inside of it. Sheets below a sheet, such
// as windows, count with it.
std::vector<std::uint64_t> voxelsOfSheets(const std::vector<volume::Label>& labels) {
    std::vector<std::uint64_t> voxels(labels.size(), 0);
    std::vector<std::uint32_t> bodyOf(labels.size(), volume::kNoLabel);
    for (std::uint32_t l = 0; l < labels.size(); ++l) {
        const volume::Label& label = labels[l];
        if (label.filling != volume::Filling::Surface || label.parent >= l) continue;
        const bool isShell = model::isBoundarySurface(label.className) || model::isFilling(label.className);
        const bool isBelowSheet = labels[label.parent].filling == volume::Filling::Surface;
        bodyOf[l] = isBelowSheet ? bodyOf[label.parent] : isShell ? label.parent : volume::kNoLabel;
        if (bodyOf[l] != volume::kNoLabel) voxels[bodyOf[l]] += label.voxels;
    }
    return voxels;
}

}  // namespace

std::vector<Measure> ownMeasures(const volume::LabelTable& table, const volume::Grid& grid) {
    std::vector<char> hasLost(table.labels.size(), 0);
    for (const volume::Overlap& overlap : table.overlaps)
        if (overlap.voxels != 0) hasLost[overlap.b] = 1;
    const std::vector<std::uint64_t> sheets = voxelsOfSheets(table.labels);
    std::vector<Measure> measures(table.labels.size());
    for (std::size_t l = 0; l < measures.size(); ++l) {
        const volume::Label& label = table.labels[l];
        Measure& measure = measures[l];
        measure.voxels = label.voxels;
        if (hasLost[l] == 0 && label.voxels > 0 && label.volume > 0 && !model::isReadInPart(label.attributes)) {
            measure.volume = label.volume;
            if (!volume::hasClosedMesh(label.filling)) measure.countedVolume = label.volume;
        } else if ((label.count > 0 || label.voxels > 0) && label.filling != volume::Filling::Surface) {
            // The inside of an open shell does not include voxels that only draw its faces.
            const bool isOpen = label.filling == volume::Filling::Winding;
            const std::uint64_t inside = label.voxels - (isOpen ? std::min(label.voxels, label.thinVoxels) : 0);
            measure.volume = measure.countedVolume = double(inside + sheets[l]) * grid.voxelVolume();
        }
    }
    return measures;
}

std::vector<Measure> measureLabels(const volume::SemanticVolume& volume, const std::vector<Contact>& contacts) {
    std::vector<Measure> measures = ownMeasures(volume.labels, volume.grid);
    const std::vector<Box3d> boxes = labelWorldBoxes(volume);
    for (std::size_t l = 0; l < measures.size(); ++l) measures[l].box = boxes[l];
    for (const Contact& contact : contacts) {
        measures[contact.a].area += contact.area;
        if (contact.b == volume::kNoLabel)
            measures[contact.a].outsideArea += contact.area;
        else
            measures[contact.b].area += contact.area;
    }
    return measures;
}

std::optional<double> solidVolumeOf(const volume::Label& label) noexcept {
    if (!volume::hasClosedMesh(label.filling) || !(label.volume > 0) || model::isReadInPart(label.attributes))
        return {};
    return label.volume;
}

std::vector<double> ownVolumes(const volume::LabelTable& table, const volume::Grid& grid) {
    std::vector<double> volumes;
    volumes.reserve(table.labels.size());
    for (const Measure& measure : ownMeasures(table, grid)) volumes.push_back(measure.volume.value_or(0));
    return volumes;
}

double solidVolume(const volume::LabelTable& labels, std::uint32_t label) noexcept {
    const volume::Label& own = labels.labels[label];
    if (own.volume > 0) return own.volume;
    double sum = 0;
    for (std::uint32_t below = label + 1; below < own.subtreeEnd; below = labels.labels[below].subtreeEnd)
        sum += solidVolume(labels, below);
    return sum;
}

Box3d worldBox(const SampleBox& box, const volume::Grid& grid) noexcept {
    Box3d world;
    if (box.isEmpty()) return world;
    for (int corner = 0; corner < 8; ++corner) {
        Vec3d index;
        for (int axis = 0; axis < 3; ++axis)
            index[axis] = (corner >> axis & 1) != 0 ? box.max[axis] + 0.5 : box.min[axis] - 0.5;
        world.add(grid.worldFromIndex(index));
    }
    return world;
}

}  // namespace svt::analyze
