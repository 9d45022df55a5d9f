#pragma once
/// \file
/// Casts rays in packets of sixteen, with the results of SampleCaster to the last bit. Internal to render.

#include <svt/render/packet_kernel.hpp>
#include <svt/render/sample_caster.hpp>

#include <span>
#include <vector>

namespace svt::render {

/// The passes of a picture as the packet kernel reads them; shared by all threads.
class PacketPasses {
public:
    explicit PacketPasses(const Scene& scene);

    [[nodiscard]] const PacketScene& operator[](std::size_t pass) const noexcept { return passes_[pass]; }
    /// The same, ending at the first label.
    [[nodiscard]] PacketScene labelsOnly(std::size_t pass) const noexcept;

private:
    std::vector<std::vector<PacketStyle>> styles_;
    std::vector<double> planeDirections_;
    std::vector<PacketScene> passes_;
};

/// Casts packets of one tile; belongs to one thread.
class PacketCaster {
public:
    PacketCaster(const Scene& scene, const PacketPasses& passes) : scene_(scene), passes_(passes) {}

    /// Rays through (u[n], v[n]); see CameraRays::at(). All three have 1 to kPacketRays elements.
    void cast(std::span<const double> u, std::span<const double> v, bool withColor, std::span<Sample> samples);

private:
    void castPass(std::size_t pass, const PacketScene& packetScene, std::size_t count, std::span<Sample> samples);
    [[nodiscard]] static Surface surfaceOf(void* context, const PacketSurface& surface);

    const Scene& scene_;
    const PacketPasses& passes_;
    NormalCache cache_;
    PacketRays rays_;
    PacketSamples seen_;
    std::size_t pass_ = 0;
    std::array<const HalfSpace*, kPacketRays> capPlanes_{};
    Lanes<double> from_{};
};

}  // namespace svt::render
