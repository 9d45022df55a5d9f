#include <svt/voxelize/lattice/levels.hpp>

#include <algorithm>

namespace svt::voxelize {

Level::Level(const FaceHeight& face, std::int32_t depth) noexcept
    // Sample k is at quanta 512 k + 1, and the first sample strictly above the face is wanted.
    : base(face.height.base + (std::int64_t{1} << kBits) - (std::int64_t{1} << Height::kBits)),
      slopeX(face.height.slopeX),
      slopeY(face.height.slopeY),
      lowest(std::clamp(face.lowest, 0, depth)),
      highest(std::clamp(face.highest, 0, depth)) {}

std::uint32_t LevelTable::add(const Level& level) {
    if (!level.isFlat()) sloped.emplace_back();
    return put(sloped.size() - 1, level);
}

std::uint32_t LevelTable::put(std::size_t place, const Level& level) noexcept {
    if (level.isFlat()) return static_cast<std::uint32_t>(level.sampleAbove(0, 0));
    sloped[place] = level;
    return first + static_cast<std::uint32_t>(place);
}

}  // namespace svt::voxelize
