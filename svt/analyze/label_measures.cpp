#include <svt/analyze/label_measures.hpp>

namespace svt::analyze {

std::vector<LabelMeasure> measureLabels(const volume::SemanticVolume& volume, const std::vector<Contact>& contacts) {
    const std::vector<volume::Label>& labels = volume.labels.labels;
    std::vector<LabelMeasure> measures(labels.size());
    const std::vector<SampleBox> boxes = labelBoxes(volume.columns, volume.labels);
    for (std::size_t l = 0; l < labels.size(); ++l) measures[l].box = boxes[l];
    for (const Contact& contact : contacts) {
        measures[contact.a].area += contact.area;
        if (contact.b == volume::kNoLabel)
            measures[contact.a].outsideArea += contact.area;
        else
            measures[contact.b].area += contact.area;
    }
    return measures;
}

std::vector<double> ownVolumes(const volume::LabelTable& table, const volume::Grid& grid) {
    std::vector<double> volumes;
    volumes.reserve(table.labels.size());
    for (const volume::Label& label : table.labels) volumes.push_back(label.volume);
    const auto byVoxels = [&](std::size_t l) {
        const volume::Label& label = table.labels[l];
        volumes[l] = label.filling == volume::Filling::Surface ? 0 : double(label.voxels) * grid.voxelVolume();
    };
    for (const volume::Overlap& overlap : table.overlaps)
        if (overlap.voxels != 0) byVoxels(overlap.b);
    for (std::size_t l = 0; l < volumes.size(); ++l)
        if (table.labels[l].voxels == 0 || !(volumes[l] > 0)) byVoxels(l);
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
