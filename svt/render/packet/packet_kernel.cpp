// Chooses the kernel for the machine that this runs on; packet_kernel_*.cpp compile them.
#include <svt/core/simd_targets.hpp>
#include <svt/render/packet/packet_kernel.hpp>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "svt/render/packet/packet_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

namespace svt::render::HWY_NAMESPACE {

void setUp(const CameraRays& camera, Vec3i count, PacketRays& rays);
void walk(const PacketPass& pass, const PacketRays& rays, const PacketSpans& spans, void* context,
          PacketSamples& samples);

}  // namespace svt::render::HWY_NAMESPACE

#if HWY_ONCE
namespace svt::render {

HWY_EXPORT(setUp);
HWY_EXPORT(walk);

void setUpPacket(const CameraRays& camera, Vec3i count, PacketRays& rays) {
    HWY_DYNAMIC_DISPATCH(setUp)(camera, count, rays);
}

void walkPacket(const PacketPass& pass, const PacketRays& rays, const PacketSpans& spans, void* context,
                PacketSamples& samples) {
    HWY_DYNAMIC_DISPATCH(walk)(pass, rays, spans, context, samples);
}

}  // namespace svt::render
#endif
