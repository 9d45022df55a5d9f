#pragma once
/// \file
/// Volumes of a few boxes and faces whose drawings are known; for tests.

#include <svt/illustrate/section_drawing.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace svt::illustrate {

/// A volume of boxes with meshes; the voxels do not matter.
struct Boxes {
    volume::SemanticVolume volume;

    Boxes() {
        volume.grid = *volume::Grid::fromParts({11, 11, 11}, {1, 1, 1}, {500000, 5400000, 100},
                                               {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}});
        volume.columns = volume::ColumnVolume::fromDense({11, 11, 11}, std::vector<volume::Scalar>(1331, 0));
    }

    void addLabel(const std::string& id, const std::string& className, volume::Filling filling, double volumeOf) {
        volume::Label label;
        label.id = id;
        label.className = className;
        label.filling = filling;
        label.volume = volumeOf;
        label.first = volume.labels.scalarCount();
        label.count = 1;
        volume.labels.labels.push_back(label);
        volume.labels.labels.back().subtreeEnd = static_cast<std::uint32_t>(volume.labels.labels.size());
    }

    void addQuad(std::array<Vec3d, 4> corners) {
        volume::VectorParts& parts = volume.vectors;
        std::array<std::uint32_t, 4> at{};
        for (std::size_t n = 0; n < 4; ++n) {
            Vec3i point;
            for (int axis = 0; axis < 3; ++axis)
                point[axis] = static_cast<std::int32_t>(std::lround(corners[n][axis] / parts.unit));
            const auto found = std::find(parts.points.begin(), parts.points.end(), point);
            at[n] = static_cast<std::uint32_t>(found - parts.points.begin());
            if (found == parts.points.end()) parts.points.push_back(point);
        }
        const auto label = static_cast<std::uint32_t>(volume.labels.labels.size() - 1);
        parts.triangles.push_back({label, {at[0], at[1], at[2]}});
        parts.triangles.push_back({label, {at[0], at[2], at[3]}});
    }

    void addBox(const std::string& id, const std::string& className, Vec3d low, Vec3d high) {
        const Vec3d size = high - low;
        addLabel(id, className, volume::Filling::Solid, size.x * size.y * size.z);
        const auto corner = [&](int n) {
            return Vec3d{(n & 1) != 0 ? high.x : low.x, (n & 2) != 0 ? high.y : low.y, (n & 4) != 0 ? high.z : low.z};
        };
        for (const auto& side : {std::array{0, 2, 3, 1}, std::array{4, 5, 7, 6}, std::array{0, 1, 5, 4},
                                 std::array{2, 6, 7, 3}, std::array{0, 4, 6, 2}, std::array{1, 3, 7, 5}})
            addQuad({corner(side[0]), corner(side[1]), corner(side[2]), corner(side[3])});
    }

    [[nodiscard]] SectionDrawing cut(Vec3d normal, Vec3d point) const {
        return *drawSection(volume, {normalized(normal), volume.grid.origin() + point});
    }
};

}  // namespace svt::illustrate
