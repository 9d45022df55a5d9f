#include <svt/core/hash.hpp>
#include <svt/volume/file/bad_volume.hpp>
#include <svt/volume/file/zstd_frame.hpp>
#include <svt/volume/vector_parts.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

namespace svt::volume {
namespace {

constexpr std::string_view kPartsName = "the vector parts";
/// Minimum bytes of a point, a segment and a triangle.
constexpr std::uint64_t kPointBytes = 3, kSegmentBytes = 3, kTriangleBytes = 4;

Error badParts(const std::string& message) { return badVolume(fmt::format("{}: {}", kPartsName, message)); }

std::uint32_t bitsOf(std::int32_t value) noexcept { return static_cast<std::uint32_t>(value); }

template <class Part, class Corners>
Result<void> checkPart(const std::vector<Part>& list, Corners corners, std::string_view name, std::size_t labelCount,
                       std::size_t pointCount) {
    std::uint32_t before = 0;
    for (std::size_t n = 0; n < list.size(); ++n) {
        if (list[n].label >= labelCount)
            return badParts(fmt::format("{} {} is of label {}, there are {}", name, n, list[n].label, labelCount));
        if (list[n].label < before) return badParts(fmt::format("{} {} is out of the order of labels", name, n));
        before = list[n].label;
        for (const std::uint32_t point : list[n].*corners)
            if (point >= pointCount)
                return badParts(fmt::format("{} {} uses point {}, there are {}", name, n, point, pointCount));
    }
    return {};
}

bool isUnit(double unit) noexcept {
    return unit >= VectorParts::kFinestUnit && unit <= VectorParts::kCoarsestUnit &&
           std::ldexp(1.0, std::ilogb(unit)) == unit;
}

// Reads the numbers of points, segments and triangles, and makes lists of these sizes.
Result<VectorParts> readCounts(NumberReader& reader) {
    const std::uint64_t points = reader.number(), segments = reader.number(), triangles = reader.number();
    if (!reader.isGood() ||
        points * kPointBytes + segments * kSegmentBytes + triangles * kTriangleBytes > reader.left())
        return badParts(fmt::format("{} points, {} segments and {} triangles do not fit in {} bytes", points, segments,
                                    triangles, reader.left()));
    VectorParts parts;
    parts.points.resize(static_cast<std::size_t>(points));
    parts.segments.resize(static_cast<std::size_t>(segments));
    parts.triangles.resize(static_cast<std::size_t>(triangles));
    return parts;
}

Result<void> checkEnd(const NumberReader& reader, const VectorParts& parts, std::size_t labelCount) {
    if (!reader.isGood()) return badParts("a number is cut short or longer than 32 bits");
    if (reader.left() != 0) return badParts(fmt::format("{} bytes are left over", reader.left()));
    return checkVectorParts(parts, labelCount);
}

// Points of 0.1 mm in the finest unit that holds them.
void toFinestUnit(VectorParts& parts) {
    double reach = 0;
    for (const Vec3i& point : parts.points)
        for (int axis = 0; axis < 3; ++axis) reach = std::max(reach, std::abs(double{1e-4} * point[axis]));
    parts.unit = VectorParts::kFinestUnit;
    while (reach > parts.unit * double(1 << 30)) parts.unit *= 2;
    for (Vec3i& point : parts.points)
        for (int axis = 0; axis < 3; ++axis)
            point[axis] = static_cast<std::int32_t>(std::lround(1e-4 * point[axis] / parts.unit));
}

}  // namespace

std::span<const VectorParts::Triangle> trianglesOf(const VectorParts& parts, std::uint32_t label) noexcept {
    const auto isBelow = [](const VectorParts::Triangle& triangle, std::uint32_t l) { return triangle.label < l; };
    const auto first = std::lower_bound(parts.triangles.begin(), parts.triangles.end(), label, isBelow);
    const auto end = std::lower_bound(first, parts.triangles.end(), label + 1, isBelow);
    return std::span(parts.triangles)
        .subspan(static_cast<std::size_t>(first - parts.triangles.begin()), static_cast<std::size_t>(end - first));
}

std::uint64_t digestOf(const VectorParts& parts, const VectorParts::Triangle& triangle, std::uint64_t seed) noexcept {
    std::array<Vec3i, 3> points{};
    for (std::size_t c = 0; c < 3; ++c) points[c] = parts.points[triangle.corners[c]];
    std::rotate(points.begin(), std::min_element(points.begin(), points.end()), points.end());
    std::uint64_t hash = seed;
    for (const Vec3i& point : points)
        for (int axis = 0; axis < 3; ++axis) hash = mixHash(hash, static_cast<std::uint32_t>(point[axis]));
    return hash ^ hash >> 32;
}

Result<void> checkVectorParts(const VectorParts& parts, std::size_t labelCount) {
    if (!isUnit(parts.unit)) return badParts(fmt::format("a unit of {} m is not one of 2^-20 to 2^-10 m", parts.unit));
    if (auto checked =
            checkPart(parts.segments, &VectorParts::Segment::ends, "segment", labelCount, parts.points.size());
        !checked)
        return checked;
    return checkPart(parts.triangles, &VectorParts::Triangle::corners, "triangle", labelCount, parts.points.size());
}

Result<std::vector<std::byte>> compressVectorParts(const VectorParts& parts) {
    NumberWriter writer;
    const std::uint64_t most = kMaxNumberBytes / 20;  // a triangle takes at most 20 bytes
    if (parts.points.size() + parts.segments.size() + parts.triangles.size() > most)
        return Error(Code::BadArgument,
                     fmt::format("{} points, segments and triangles are over the limit of {}",
                                 parts.points.size() + parts.segments.size() + parts.triangles.size(), most));
    writer.number(static_cast<std::uint32_t>(-std::ilogb(parts.unit)));
    writer.number(static_cast<std::uint32_t>(parts.points.size()));
    writer.number(static_cast<std::uint32_t>(parts.segments.size()));
    writer.number(static_cast<std::uint32_t>(parts.triangles.size()));
    for (int axis = 0; axis < 3; ++axis) {
        std::int32_t before = 0;
        for (const Vec3i& point : parts.points) {
            writer.difference(bitsOf(point[axis]), bitsOf(before));
            before = point[axis];
        }
    }
    const auto writeList = [&](const auto& list, auto corners) {
        std::uint32_t label = 0, next = 0;
        for (const auto& part : list) {
            writer.number(part.label - label);
            label = part.label;
        }
        for (const auto& part : list)
            for (const std::uint32_t corner : part.*corners) {
                writer.difference(next, corner);
                next = std::max(next, corner + 1);
            }
    };
    writeList(parts.segments, &VectorParts::Segment::ends);
    writeList(parts.triangles, &VectorParts::Triangle::corners);
    return compressNumbers(writer.bytes(), kPartsName);
}

Result<VectorParts> readVectorParts(std::span<const std::byte> frame, std::size_t labelCount) {
    SVT_TRY(bytes, unpackNumbers(frame, kPartsName));
    NumberReader reader(*bytes);
    const std::uint32_t exponent = reader.number();
    SVT_TRY(sized, readCounts(reader));
    VectorParts parts = std::move(*sized);
    parts.unit = std::ldexp(1.0, -static_cast<int>(std::min(exponent, 1000u)));
    if (!isUnit(parts.unit)) return badParts(fmt::format("the unit 2^-{} m is not one of 2^-20 to 2^-10 m", exponent));
    for (int axis = 0; axis < 3; ++axis) {
        std::uint32_t before = 0;
        for (Vec3i& point : parts.points) {
            before = reader.difference(before);
            point[axis] = static_cast<std::int32_t>(before);
        }
    }
    const auto readList = [&](auto& list, auto corners) {
        std::uint32_t label = 0, next = 0;
        // If the sum wraps around, the order check will fail.
        for (auto& part : list) part.label = label += reader.number();
        for (auto& part : list)
            for (std::uint32_t& corner : part.*corners) {
                corner = next - reader.difference(0);
                next = std::max(next, corner + 1);
            }
    };
    readList(parts.segments, &VectorParts::Segment::ends);
    readList(parts.triangles, &VectorParts::Triangle::corners);
    SVT_DO(checkEnd(reader, parts, labelCount));
    return parts;
}

Result<VectorParts> readTenthParts(std::span<const std::byte> frame, std::size_t labelCount) {
    SVT_TRY(bytes, unpackNumbers(frame, kPartsName));
    NumberReader reader(*bytes);
    SVT_TRY(sized, readCounts(reader));
    VectorParts parts = std::move(*sized);
    Vec3i before{};
    for (Vec3i& point : parts.points) {
        for (int axis = 0; axis < 3; ++axis)
            point[axis] = static_cast<std::int32_t>(reader.difference(bitsOf(before[axis])));
        before = point;
    }
    const auto readList = [&](auto& list, auto corners) {
        std::uint32_t label = 0, last = 0;
        for (auto& part : list) {
            // If the sum wraps around, the order check will fail.
            part.label = label += reader.number();
            for (std::uint32_t& corner : part.*corners) corner = last = reader.difference(last);
        }
    };
    readList(parts.segments, &VectorParts::Segment::ends);
    readList(parts.triangles, &VectorParts::Triangle::corners);
    SVT_DO(checkEnd(reader, parts, labelCount));
    toFinestUnit(parts);
    return parts;
}

}  // namespace svt::volume
