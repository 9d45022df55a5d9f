#pragma once
/// \file
/// The peers, behind plain interfaces: one source each (peer_*.cpp), without their types here. A peer that is not
/// installed, or cannot run on this machine, is replaced by a reason.

#include <svt/core/vec.hpp>
#include <svt/image/image.hpp>
#include <svt/mesh/mesh_set.hpp>
#include <svt/render/frame_spec.hpp>
#include <svt/volume/grid.hpp>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace svt::bench {

/// A peer, or the reason why it is missing.
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

/// How much of the work a peer does for each object.
enum class SolidStep : std::uint8_t {
    Inside,  ///< its own inside test, in whatever form it provides
    Mask,    ///< a mask, one value per voxel, in the object's own extent
    Labels   ///< all objects' labels written into one dense volume
};

/// Fills closed meshes, one object at a time.
class SolidPeer {
public:
    virtual ~SolidPeer() = default;
    [[nodiscard]] virtual std::string name() const = 0;
    /// Sets the same vertices and triangles as for our voxelizer. Not timed.
    virtual void load(const mesh::MeshSet& meshes, const volume::Grid& grid) = 0;
    /// Processes all objects up to `step`.
    /// \param order    objects in increasing priority
    /// \param scalars  per object
    /// \param labels   output volume: allocated here, as part of the work. Only for Labels
    virtual void run(SolidStep step, std::span<const std::uint32_t> order, std::span<const std::uint16_t> scalars,
                     DenseLabels* labels) = 0;
};

[[nodiscard]] Peer<SolidPeer> makeVtkStencils();
[[nodiscard]] Peer<SolidPeer> makeOpenVdb();

/// Draws a dense label volume without lighting, nearest label, by samples at a fixed step. Color values are
/// blended as given, over black; for linear light, pass linear values.
class VolumePeer {
public:
    virtual ~VolumePeer() = default;
    [[nodiscard]] virtual std::string name() const = 0;
    /// \param labels  must live as long as the peer
    virtual void setVolume(const DenseLabels& labels, const volume::Grid& grid) = 0;
    /// Colors and opacities per metre, by scalar.
    virtual void setStyles(std::span<const render::Style> styles) = 0;
    virtual void setCamera(const render::Camera& camera, std::int32_t width, std::int32_t height) = 0;
    /// Samples per shortest side of a voxel; initially samplesPerVoxel().
    virtual void setSamplesPerVoxel(int samples) = 0;
    [[nodiscard]] virtual int samplesPerVoxel() const = 0;
    /// True if it draws directly from `labels`; else it has its own copy.
    [[nodiscard]] virtual bool usesLabels() const = 0;
    /// Draws and waits for the picture.
    virtual void draw() = 0;
    /// The picture drawn by draw().
    [[nodiscard]] virtual image::Image<image::Rgba8> picture() = 0;
};

enum class VtkMapper : std::uint8_t { FixedPoint, Gpu };
[[nodiscard]] Peer<VolumePeer> makeVtkVolume(VtkMapper mapper);
/// The paper's own method on the CPU, all cores. Always available.
[[nodiscard]] Peer<VolumePeer> makeDenseSteps();

/// Counts reported by another reader for a CityGML file.
struct ReadCounts {
    std::size_t objects = 0;
    std::size_t polygons = 0;
};

class ReaderPeer {
public:
    virtual ~ReaderPeer() = default;
    [[nodiscard]] virtual std::string name() const = 0;
    /// Parses without triangulating, as our reader does. Zero counts if the file is not understood.
    [[nodiscard]] virtual ReadCounts read(const std::filesystem::path& file) = 0;
};

[[nodiscard]] Peer<ReaderPeer> makeLibcitygml();

}  // namespace svt::bench
