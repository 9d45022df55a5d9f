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

    /// Rays to cast together.
    struct Rays {
        std::array<double, kPacketRays> u, v;        ///< see CameraRays::at()
        std::array<std::size_t, kPacketRays> place;  ///< which sample each makes
        std::size_t count = 0;

        void add(double atU, double atV, std::size_t atPlace) noexcept {
            u[count] = atU;
            v[count] = atV;
            place[count++] = atPlace;
        }
        [[nodiscard]] bool isFull() const noexcept { return count == kPacketRays; }
    };
    /// Casts the rays, if there are any, to `samples`.
    void cast(const Rays& rays, bool withColor, std::span<Sample> samples);

private:
    void castPass(std::size_t pass, const PacketScene& packetScene, std::size_t count);
    [[nodiscard]] Sample sampleOf(std::size_t ray) const noexcept;
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
