#include <svt/voxelize/levels.hpp>

#include <algorithm>

namespace svt::voxelize {

Level::Level(const FaceHeight& face, std::int32_t depth) noexcept
    // Sample k stands at quanta 512 k + 1, and the one strictly above is wanted.
    : base(face.height.base + (std::int64_t{1} << kBits) - (std::int64_t{1} << Height::kBits)),
      slopeX(face.height.slopeX),
      slopeY(face.height.slopeY),
      lowest(std::clamp(face.lowest, 0, depth)),
      highest(std::clamp(face.highest, 0, depth)) {}

std::uint32_t LevelTable::add(const FaceHeight& face) {
    const Level level(face, depth);
    if (face.height.isFlat()) return static_cast<std::uint32_t>(level.sampleAbove(0, 0));
    sloped.push_back(level);
    return next() - 1;
}

std::vector<std::uint32_t> addPlanes(std::span<const std::optional<FaceHeight>> planes, LevelTable& levels) {
    std::vector<std::uint32_t> numbers;
    numbers.reserve(planes.size());
    for (const auto& plane : planes) numbers.push_back(plane ? levels.add(*plane) : kNoLevel);
    return numbers;
}

}  // namespace svt::voxelize
