#include <svt/analyze/label_measures.hpp>

#include <algorithm>

namespace svt::analyze {

std::vector<Box3d> labelWorldBoxes(const volume::SemanticVolume& volume) {
    const std::vector<volume::Label>& labels = volume.labels.labels;
    std::vector<Box3d> boxes(labels.size());
    for (const volume::VectorParts::Triangle& triangle : volume.vectors.triangles)
        for (const std::uint32_t corner : triangle.corners)
            boxes[triangle.label].add(volume.vectors.position(corner, volume.grid.origin()));
    std::vector<std::uint32_t> byVoxels;
    for (std::uint32_t l = 0; l < labels.size(); ++l)
        if (labels[l].voxels > 0 && (boxes[l].isEmpty() || labels[l].filling == volume::Filling::Body))
            byVoxels.push_back(l);
    if (byVoxels.empty()) return boxes;
    const std::vector<SampleBox> samples = labelBoxes(volume.columns, volume.labels);
    for (const std::uint32_t l : byVoxels) boxes[l].add(worldBox(samples[l], volume.grid));
    return boxes;
}

}  // namespace svt::analyze
