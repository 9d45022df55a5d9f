#include <svt/volume/face_planes.hpp>
#include <svt/volume/file/bad_volume.hpp>
#include <svt/volume/file/zstd_frame.hpp>

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <map>
#include <string>
#include <string_view>

namespace svt::volume {
namespace {

constexpr std::string_view kPlanesName = "the face planes";
constexpr std::size_t kMaxPlanes = std::size_t{1} << 24;
/// Minimum bytes of a plane: 1 for the number of its normal, 8 for the offset, 6 for the box. And bytes of a normal.
constexpr std::uint64_t kPlaneBytes = 1 + 8 + 6, kNormalBytes = 24;
constexpr double kLengthTolerance = 1e-9;
constexpr std::uint64_t kSign = std::uint64_t{1} << 63;

using NormalBits = std::array<std::uint64_t, 3>;

Error badPlanes(const std::string& message) { return badVolume(fmt::format("{}: {}", kPlanesName, message)); }

NormalBits bitsOf(Vec3d normal) noexcept {
    return {std::bit_cast<std::uint64_t>(normal.x), std::bit_cast<std::uint64_t>(normal.y),
            std::bit_cast<std::uint64_t>(normal.z)};
}

NormalBits negated(const NormalBits& bits) noexcept { return {bits[0] ^ kSign, bits[1] ^ kSign, bits[2] ^ kSign}; }

/// Distinct normals, numbered by first use and compared bit by bit.
class NormalTable {
public:
    /// The code of `normal` in the file; a new normal is added to the table.
    std::uint32_t add(Vec3d normal) {
        const NormalBits bits = bitsOf(normal);
        if (const auto known = numbers_.find(bits); known != numbers_.end()) return 2 * back(known->second);
        if (const auto known = numbers_.find(negated(bits)); known != numbers_.end())
            return 2 * back(known->second) + 1;
        numbers_.emplace(bits, static_cast<std::uint32_t>(normals_.size()));
        normals_.push_back(bits);
        return 0;
    }
    [[nodiscard]] std::span<const NormalBits> normals() const noexcept { return normals_; }

private:
    [[nodiscard]] std::uint32_t back(std::uint32_t number) const noexcept {
        return static_cast<std::uint32_t>(normals_.size()) - number;
    }

    std::map<NormalBits, std::uint32_t> numbers_;
    std::vector<NormalBits> normals_;
};

std::uint8_t byteOf(std::uint64_t bits, int number) noexcept { return static_cast<std::uint8_t>(bits >> (8 * number)); }

/// A reference to a normal of the table, possibly negated.
struct NormalUse {
    std::uint32_t number = 0;
    bool isNegated = false;
};

/// Reads the normals of the planes.
/// \return empty if a number refers to a normal that has not been defined yet
std::vector<NormalUse> readUses(NumberReader& reader, std::size_t planeCount, std::uint32_t& normalCount) {
    std::vector<NormalUse> uses(planeCount);
    for (NormalUse& use : uses) {
        const std::uint32_t value = reader.number();
        if (value == 0) {
            use.number = normalCount++;
            continue;
        }
        const std::uint32_t back = value >> 1;
        if (back == 0 || back > normalCount) return {};
        use = {normalCount - back, (value & 1u) != 0};
    }
    return uses;
}

void readNormals(NumberReader& reader, std::span<const NormalUse> uses, std::uint32_t normalCount,
                 std::span<FacePlane> planes) {
    std::vector<NormalBits> normals(normalCount);
    for (NormalBits& normal : normals)
        for (std::uint64_t& bits : normal)
            for (int byte = 0; byte < 8; ++byte) bits |= std::uint64_t{reader.byte()} << (8 * byte);
    for (std::size_t p = 0; p < planes.size(); ++p) {
        const NormalBits& stored = normals[uses[p].number];
        const NormalBits bits = uses[p].isNegated ? negated(stored) : stored;
        for (int axis = 0; axis < 3; ++axis)
            planes[p].plane.normal[axis] = std::bit_cast<double>(bits[static_cast<std::size_t>(axis)]);
    }
}

void readOffsets(NumberReader& reader, std::span<FacePlane> planes) {
    std::vector<std::uint64_t> offsets(planes.size());
    for (int byte = 0; byte < 8; ++byte)
        for (std::uint64_t& bits : offsets) bits |= std::uint64_t{reader.byte()} << (8 * byte);
    for (std::size_t p = 0; p < planes.size(); ++p) planes[p].plane.offset = std::bit_cast<double>(offsets[p]);
}

/// \return whether all bounds fit into 16 bits
bool readBoxes(NumberReader& reader, std::span<FacePlane> planes) {
    bool isInRange = true;
    const auto narrowed = [&](std::uint32_t value) {
        isInRange = isInRange && value <= 0xFFFF;
        return static_cast<std::uint16_t>(value);
    };
    for (std::size_t axis = 0; axis < 3; ++axis) {
        std::uint32_t before = 0;
        for (FacePlane& plane : planes) {
            before = reader.difference(before);
            plane.min[axis] = narrowed(before);
        }
    }
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (FacePlane& plane : planes) plane.max[axis] = narrowed(plane.min[axis] + reader.number());
    return isInRange;
}

}  // namespace

Result<void> checkFacePlanes(std::span<const FacePlane> planes, Vec3i dimension) {
    for (std::size_t p = 0; p < planes.size(); ++p) {
        const FacePlane& face = planes[p];
        const double size = length(face.plane.normal);
        if (!(std::abs(size - 1) <= kLengthTolerance))
            return badPlanes(fmt::format("the normal of plane {} has length {}, it must be 1", p, size));
        if (!std::isfinite(face.plane.offset))
            return badPlanes(fmt::format("plane {} has the offset {}, it must be finite", p, face.plane.offset));
        for (int axis = 0; axis < 3; ++axis) {
            const int begin = face.min[static_cast<std::size_t>(axis)], end = face.max[static_cast<std::size_t>(axis)];
            if (begin >= end || end > dimension[axis])
                return badPlanes(fmt::format("plane {} is within voxels [{}, {}) along {}, there are {}", p, begin, end,
                                             "xyz"[axis], dimension[axis]));
        }
    }
    return {};
}

Result<std::vector<std::byte>> compressFacePlanes(std::span<const FacePlane> planes) {
    if (planes.size() > kMaxPlanes)
        return Error(Code::BadArgument,
                     fmt::format("{} face planes are over the limit of {}", planes.size(), kMaxPlanes));
    // Stored field by field for better compression. Normals repeat as a whole; offsets share only their upper bytes, so
    // they are split into bytes.
    NumberWriter writer;
    writer.number(static_cast<std::uint32_t>(planes.size()));
    NormalTable table;
    for (const FacePlane& face : planes) writer.number(table.add(face.plane.normal));
    for (const NormalBits& normal : table.normals())
        for (const std::uint64_t bits : normal)
            for (int byte = 0; byte < 8; ++byte) writer.byte(byteOf(bits, byte));
    for (int byte = 0; byte < 8; ++byte)
        for (const FacePlane& face : planes) writer.byte(byteOf(std::bit_cast<std::uint64_t>(face.plane.offset), byte));
    for (std::size_t axis = 0; axis < 3; ++axis) {
        std::uint32_t before = 0;
        for (const FacePlane& face : planes) {
            writer.difference(face.min[axis], before);
            before = face.min[axis];
        }
    }
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (const FacePlane& face : planes) writer.number(std::uint32_t{face.max[axis]} - face.min[axis]);
    return compressNumbers(writer.bytes(), kPlanesName);
}

Result<std::vector<FacePlane>> readFacePlanes(std::span<const std::byte> frame, Vec3i dimension) {
    SVT_TRY(bytes, unpackNumbers(frame, kPlanesName));
    NumberReader reader(*bytes);
    const std::uint64_t count = reader.number();
    if (!reader.isGood() || count * kPlaneBytes > reader.left())
        return badPlanes(fmt::format("{} planes do not fit in {} bytes", count, reader.left()));
    if (count > kMaxPlanes) return badPlanes(fmt::format("{} planes are over the limit of {}", count, kMaxPlanes));
    std::vector<FacePlane> planes(static_cast<std::size_t>(count));
    std::uint32_t normalCount = 0;
    const std::vector<NormalUse> uses = readUses(reader, planes.size(), normalCount);
    if (uses.size() != planes.size()) return badPlanes("a plane refers to a normal that is not defined before it");
    if (normalCount * kNormalBytes > reader.left())
        return badPlanes(fmt::format("{} normals do not fit in {} bytes", normalCount, reader.left()));
    readNormals(reader, uses, normalCount, planes);
    readOffsets(reader, planes);
    const bool isInRange = readBoxes(reader, planes);
    if (!reader.isGood()) return badPlanes("a number is cut short or longer than 32 bits");
    if (reader.left() != 0) return badPlanes(fmt::format("{} bytes are left over", reader.left()));
    if (!isInRange) return badPlanes("a box reaches beyond voxel 65535");
    SVT_DO(checkFacePlanes(planes, dimension));
    return planes;
}

}  // namespace svt::volume
