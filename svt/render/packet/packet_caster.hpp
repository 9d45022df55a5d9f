#pragma once
/// \file
/// Casts rays in packets, with the results of SampleCaster to the last bit.
///
/// The scalar part around the kernel: it collects up to 64 rays and clips them to the hull of the visible parts of a
/// pass. It splits them at clips, so that each round walks the n-th interval of all rays at once. It finds the lines
/// and triangles that they meet, and casts the passes from the last to the first, since rays that an opaque pass hides
/// need not be cast.

#include <svt/render/light/fragments.hpp>
#include <svt/render/light/sample.hpp>
#include <svt/render/light/surface_normal.hpp>
#include <svt/render/packet/packet_kernel.hpp>
#include <svt/render/prepare/prepared_frame.hpp>

#include <span>
#include <vector>

namespace svt::render {

/// The passes of a frame in the form that the packet kernel reads; shared by all threads.
class PacketPasses {
public:
    explicit PacketPasses(const PreparedFrame& frame);

    [[nodiscard]] const PacketPass& operator[](std::size_t pass) const noexcept { return passes_[pass]; }
    /// The same for label and depth only: rays end at the first label.
    [[nodiscard]] PacketPass labelsOnly(std::size_t pass) const noexcept;

private:
    std::vector<std::vector<PacketStyle>> styles_;
    std::vector<std::vector<PacketFace>> faces_;  // by volume
    std::vector<PacketPass> passes_;
};

/// Casts the packets of one tile. Not thread-safe: one per thread.
class PacketCaster {
public:
    PacketCaster(const PreparedFrame& frame, const PacketPasses& passes)
        : frame_(frame), passes_(passes), visible_(frame.passes.size()), finder_(frame) {}

    /// Adds a ray through (u, v), see CameraRays::at(), to the packet. Must not be called if isFull().
    /// \param place  index of its sample in the `samples` of cast()
    void add(double u, double v, std::size_t place) noexcept {
        rays_.u[count_] = u;
        rays_.v[count_] = v;
        places_[count_++] = place;
    }
    [[nodiscard]] bool isFull() const noexcept { return count_ == kPacketRays; }
    /// Whether rays through `rect` may meet anything visible.
    [[nodiscard]] bool isAnyIn(const ViewRect& rect) const noexcept;
    /// Casts the added rays, if any, and empties the packet.
    /// \param withColor  false: label and depth only
    void cast(bool withColor, std::span<Sample> samples);

private:
    void setUpRays(std::size_t volume);
    void castPasses(bool withColor, std::span<Sample> samples);
    void castPass(std::size_t pass, const PacketPass& packetScene);
    void castIntervals(PacketPass& pass);
    void findLines(std::size_t block);
    void walkVisible(const PacketPass& pass);
    void addLastFragments();
    void addPainted();
    void findIntervals(std::size_t ray);
    double findSurfaces(std::size_t ray, std::span<const DrawnInterval> drawn);
    void writeSample(std::size_t ray, Sample& sample) const noexcept;
    void addFragment(std::size_t ray);
    static void blendFragment(void* context, std::size_t ray);
    [[nodiscard]] Sample joinedParts(std::size_t ray, std::size_t head, std::size_t end) const noexcept;
    [[nodiscard]] static double shareOfLight(void* context, const PacketPoint& point);
    [[nodiscard]] static Surface shadeSurface(void* context, const PacketSurface& surface);

    const PreparedFrame& frame_;
    const PacketPasses& passes_;
    NormalCache cache_;
    std::size_t count_ = 0;
    std::array<std::size_t, kPacketRays> places_;
    PacketRays rays_;
    PacketSamples seen_;
    std::vector<Sample> ofPasses_;  // kPacketRays per pass
    std::size_t pass_ = 0;
    std::size_t volume_ = 0;        // volume that the rays are set up for
    std::vector<RaySpan> visible_;  // by pass: outside of this interval no ray meets anything visible
    std::array<CapFace, kPacketRays> caps_{};
    PacketSpans spans_{};
    FragmentFinder finder_;
    std::vector<DrawnInterval> parts_;  // of all rays of the packet, ray by ray
    Fragments fragments_;               // the same
    struct Range {
        std::size_t next = 0, end = 0;
    };
    std::array<Range, kPacketRays> rayIntervals_{}, rayFragments_{};
    bool withColor_ = true, hasShapes_ = false;
};

}  // namespace svt::render
