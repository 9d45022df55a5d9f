#pragma once
/// \file
/// The peers, behind plain interfaces: one source each (peer_*.cpp), none of their types here. A peer that is not
/// installed, or cannot run on this machine, is a reason instead.

#include <svt/core/vec.hpp>
#include <svt/image/image.hpp>
#include <svt/mesh/mesh_scene.hpp>
#include <svt/render/frame_spec.hpp>
#include <svt/volume/grid.hpp>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace svt::bench {

/// A peer, or why there is none.
template <class T>
struct Peer {
    std::unique_ptr<T> peer;
    std::string missing;
};

/// 16-bit labels, x fastest, then y, then z.
struct DenseLabels {
    Vec3i dimension;
    std::vector<std::uint16_t> scalars;
};

/// How far a peer goes with each object.
enum class SolidStep : std::uint8_t {
    Inside,  ///< whatever it has that tells inside from outside
    Mask,    ///< a mask, one value a voxel, in the object's own extent
    Labels   ///< all objects' labels written into one dense volume
};

/// Fills closed meshes, one object at a time.
class SolidPeer {
public:
    virtual ~SolidPeer() = default;
    [[nodiscard]] virtual std::string name() const = 0;
    /// Takes the same vertices and triangles as our voxelizer. Not timed.
    virtual void load(const mesh::MeshScene& scene, const volume::Grid& grid) = 0;
    /// Does all objects up to `step`.
    /// \param order    objects from the one that loses to the one that wins; \param scalars  per object
    /// \param labels   the volume that is written: allocated here, as part of the work. Only for Labels
    virtual void run(SolidStep step, std::span<const std::uint32_t> order, std::span<const std::uint16_t> scalars,
                     DenseLabels* labels) = 0;
};

[[nodiscard]] Peer<SolidPeer> makeVtkStencils();
[[nodiscard]] Peer<SolidPeer> makeOpenVdb();

/// Draws a dense label volume without light, nearest label, by samples at a fixed step. The numbers of a color are
/// blended as they are given, over black; who wants linear light gives linear numbers.
class VolumePeer {
public:
    virtual ~VolumePeer() = default;
    [[nodiscard]] virtual std::string name() const = 0;
    /// \param labels  must live as long as the peer
    virtual void setVolume(const DenseLabels& labels, const volume::Grid& grid) = 0;
    /// Colors and opacities per metre, by scalar.
    virtual void setStyles(std::span<const render::Style> styles) = 0;
    virtual void setCamera(const render::Camera& camera, std::int32_t width, std::int32_t height) = 0;
    /// Samples on the shortest side of a voxel, from the start samplesPerVoxel().
    virtual void setSamplesPerVoxel(int samples) = 0;
    [[nodiscard]] virtual int samplesPerVoxel() const = 0;
    /// Whether it draws from `labels` as they are; else it has made a copy of its own.
    [[nodiscard]] virtual bool usesLabels() const = 0;
    /// Draws and waits for the picture.
    virtual void draw() = 0;
    /// What draw() has drawn.
    [[nodiscard]] virtual image::Image<image::Rgba8> picture() = 0;
};

enum class VtkMapper : std::uint8_t { FixedPoint, Gpu };
[[nodiscard]] Peer<VolumePeer> makeVtkVolume(VtkMapper mapper);
/// The paper's own method on the CPU, all cores. Always there.
[[nodiscard]] Peer<VolumePeer> makeDenseSteps();

/// What another reader found in a CityGML file.
struct ReadCounts {
    std::size_t objects = 0;
    std::size_t polygons = 0;
};

class ReaderPeer {
public:
    virtual ~ReaderPeer() = default;
    [[nodiscard]] virtual std::string name() const = 0;
    /// Parses without triangulating, as our reader does. Nothing where the file is not understood.
    [[nodiscard]] virtual ReadCounts read(const std::filesystem::path& file) = 0;
};

[[nodiscard]] Peer<ReaderPeer> makeLibcitygml();

}  // namespace svt::bench
