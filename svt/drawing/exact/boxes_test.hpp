#pragma once
/// \file
/// Volumes of a few boxes and faces whose drawings are known; for tests.

#include <svt/drawing/section_drawing.hpp>
#include <svt/volume/sample_volume_test.hpp>

#include <array>
#include <string>

namespace svt::drawing {

/// A volume of boxes with meshes; the voxels do not matter.
struct Boxes {
    volume::SemanticVolume volume = volume::test::emptyVolume({11, 11, 11}, {1, 1, 1}, {500000, 5400000, 100});

    void addLabel(const std::string& id, const std::string& className, volume::Filling filling, double volumeOf) {
        volume::Label& label = volume::test::addObject(volume, id, className);
        label.filling = filling;
        label.volume = volumeOf;
    }

    void addQuad(std::array<Vec3d, 4> corners) {
        volume::test::addQuad(volume, static_cast<std::uint32_t>(volume.labels.labels.size() - 1), corners);
    }

    void addBox(const std::string& id, const std::string& className, Vec3d low, Vec3d high) {
        const Vec3d size = high - low;
        addLabel(id, className, volume::Filling::Solid, size.x * size.y * size.z);
        volume::test::addBoxMesh(volume, static_cast<std::uint32_t>(volume.labels.labels.size() - 1), low, high);
    }

    [[nodiscard]] SectionDrawing cut(Vec3d normal, Vec3d point) const {
        return *drawSection(volume, {normalized(normal), volume.grid.origin() + point});
    }
};

}  // namespace svt::drawing
