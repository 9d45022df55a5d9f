#include <svt/voxelize/lattice/height_planes.hpp>

#include <algorithm>

namespace svt::voxelize {

HeightPlane::HeightPlane(const FaceHeight& face, std::int32_t depth) noexcept
    // Sample k is at quanta 512 k + 1, and the first sample strictly above the face is wanted.
    : base(face.height.base + (std::int64_t{1} << kBits) - (std::int64_t{1} << Height::kBits)),
      slopeX(face.height.slopeX),
      slopeY(face.height.slopeY),
      lowest(std::clamp(face.lowest, 0, depth)),
      highest(std::clamp(face.highest, 0, depth)) {}

std::uint32_t HeightPlanes::add(const HeightPlane& heightPlane) {
    if (!heightPlane.isFlat()) sloped.emplace_back();
    return put(sloped.size() - 1, heightPlane);
}

std::uint32_t HeightPlanes::put(std::size_t place, const HeightPlane& heightPlane) noexcept {
    if (heightPlane.isFlat()) return static_cast<std::uint32_t>(heightPlane.sampleAbove(0, 0));
    sloped[place] = heightPlane;
    return first + static_cast<std::uint32_t>(place);
}

}  // namespace svt::voxelize
