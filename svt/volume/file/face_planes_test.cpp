#include <svt/volume/face_planes.hpp>

#include <svt/volume/file/zstd_frame_test.hpp>

#include <gtest/gtest.h>
#include <zstd.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <random>
#include <string>

namespace svt::volume {
namespace {

constexpr Vec3i kDimension{800, 700, 65535};
using Bytes = std::vector<std::uint8_t>;

/// All fields of a plane, with the sign of zeros.
std::array<std::uint64_t, 10> bitsOf(const FacePlane& face) {
    const auto bits = [](double value) { return std::bit_cast<std::uint64_t>(value); };
    const auto& plane = face.plane;
    return {bits(plane.normal.x), bits(plane.normal.y), bits(plane.normal.z), bits(plane.offset), face.min[0],
            face.min[1],          face.min[2],          face.max[0],          face.max[1],        face.max[2]};
}

void expectSame(const std::vector<FacePlane>& read, const std::vector<FacePlane>& planes) {
    ASSERT_EQ(read.size(), planes.size());
    for (std::size_t p = 0; p < planes.size(); ++p) ASSERT_EQ(bitsOf(read[p]), bitsOf(planes[p])) << "plane " << p;
}

/// Planes with repeated normals, some of them negated.
std::vector<FacePlane> somePlanes(std::size_t count) {
    std::mt19937_64 random(11);
    const auto real = [&] { return double(random() >> 11) / double(std::uint64_t{1} << 53) - 0.5; };
    const auto below = [&](std::uint64_t most) { return static_cast<std::uint16_t>(random() % most); };
    std::vector<FacePlane> planes;
    for (std::size_t p = 0; p < count; ++p) {
        FacePlane face;
        face.plane.normal = normalized(Vec3d{real(), real(), real()});
        if (p > 4 && p % 3 != 0) face.plane.normal = planes[random() % p].plane.normal;
        if (p % 5 == 0) face.plane.normal = -face.plane.normal;
        face.plane.offset = 900 * real();
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto size = static_cast<std::uint64_t>(kDimension[static_cast<int>(axis)]);
            face.min[axis] = below(size);
            face.max[axis] = static_cast<std::uint16_t>(face.min[axis] + 1 + below(size - face.min[axis]));
        }
        planes.push_back(face);
    }
    return planes;
}

FacePlane planeAlongZ(double offset) { return {{{0, 0, 1}, offset}, {0, 0, 0}, {800, 700, 65535}}; }

Bytes unpacked(const std::vector<std::byte>& frame) {
    Bytes bytes(static_cast<std::size_t>(ZSTD_getFrameContentSize(frame.data(), frame.size())));
    EXPECT_EQ(ZSTD_decompress(bytes.data(), bytes.size(), frame.data(), frame.size()), bytes.size());
    return bytes;
}

/// The worked example of docs/formats/svt.md.
const std::vector<FacePlane> kExample{{{{1, 0, 0}, -2}, {2, 0, 0}, {3, 6, 4}},
                                      {{{-1, -0.0, -0.0}, 8}, {8, 1, 0}, {9, 6, 4}}};
const Bytes kExampleBytes{2,                                   // count
                          0,    3,                             // normals of the planes
                          0,    0,    0, 0, 0, 0, 0xF0, 0x3F,  // the normal
                          0,    0,    0, 0, 0, 0, 0,    0,     //
                          0,    0,    0, 0, 0, 0, 0,    0,     //
                          0,    0,    0, 0, 0, 0, 0,    0,     // offsets, bytes 0 to 3
                          0,    0,    0, 0,                    // 4 and 5
                          0,    0x20,                          // 6
                          0xC0, 0x40,                          // 7
                          4,    12,   0, 2, 0, 0,              // min
                          1,    1,    6, 5, 4, 4};             // max

/// kExampleBytes with those from `at` on replaced.
std::vector<std::byte> exampleWith(std::size_t at, const Bytes& bytes) {
    Bytes changed = kExampleBytes;
    std::copy(bytes.begin(), bytes.end(), changed.begin() + static_cast<std::ptrdiff_t>(at));
    return test::zstdFrameOf(changed);
}

void expectRefused(const std::vector<std::byte>& frame, std::string_view reason, Vec3i dimension = kDimension) {
    const auto planes = readFacePlanes(frame, dimension);
    ASSERT_FALSE(planes) << "accepted, expected: " << reason;
    EXPECT_EQ(planes.error().code(), Code::BadVolume);
    EXPECT_NE(planes.error().message().find(reason), std::string::npos) << planes.error().message();
}

void expectBad(const FacePlane& face, std::string_view reason) {
    const FacePlane planes[] = {planeAlongZ(-1), face};
    const auto checked = checkFacePlanes(planes, kDimension);
    ASSERT_FALSE(checked) << "accepted, expected: " << reason;
    EXPECT_EQ(checked.error().code(), Code::BadVolume);
    EXPECT_NE(checked.error().message().find(reason), std::string::npos) << checked.error().message();
}

TEST(FacePlanes, ComeBackBitByBit) {
    for (const std::size_t count : {0u, 1u, 2u, 400u, 65535u, 65536u, 70001u}) {
        SCOPED_TRACE(count);
        const auto planes = somePlanes(count);
        ASSERT_TRUE(checkFacePlanes(planes, kDimension));
        const auto frame = compressFacePlanes(planes);
        ASSERT_TRUE(frame) << frame.error().toString();
        const auto read = readFacePlanes(*frame, kDimension);
        ASSERT_TRUE(read) << read.error().toString();
        expectSame(*read, planes);
        EXPECT_EQ(*compressFacePlanes(*read), *frame);
    }
}

TEST(FacePlanes, NumbersThatLookAlikeStayApart) {
    std::vector<FacePlane> planes;
    const double tiny = std::numeric_limits<double>::denorm_min();
    for (const double offset : {0.0, -0.0, tiny, -tiny, std::numeric_limits<double>::max(),
                                std::numeric_limits<double>::lowest(), std::nextafter(1.0, 2.0), 1.0 / 3})
        planes.push_back(planeAlongZ(offset));
    for (const Vec3d normal : {Vec3d{0, 0, -1}, Vec3d{-0.0, -0.0, -1}, Vec3d{-0.0, 0, 1}, Vec3d{tiny, 0, 1},
                               Vec3d{0, 0, std::nextafter(1.0, 2.0)}, Vec3d{0, -tiny, -1}, Vec3d{-tiny, -0.0, -1}}) {
        planes.push_back(planeAlongZ(5));
        planes.back().plane.normal = normal;
    }
    const auto frame = compressFacePlanes(planes);
    ASSERT_TRUE(frame);
    const auto read = readFacePlanes(*frame, kDimension);
    ASSERT_TRUE(read) << read.error().toString();
    expectSame(*read, planes);
}

TEST(FacePlanes, TheExampleOfTheFormatIsWrittenAndRead) {
    const auto frame = compressFacePlanes(kExample);
    ASSERT_TRUE(frame);
    EXPECT_EQ(unpacked(*frame), kExampleBytes);
    const auto read = readFacePlanes(test::zstdFrameOf(kExampleBytes), {9, 6, 4});
    ASSERT_TRUE(read) << read.error().toString();
    expectSame(*read, kExample);
}

TEST(FacePlanes, ThoseOfOneNormalTakeItOnce) {
    std::vector<FacePlane> planes;
    for (int p = 0; p < 1000; ++p) {
        planes.push_back(planeAlongZ(p));
        if (p % 2 != 0) planes.back().plane.normal = -planes.back().plane.normal;
    }
    const auto frame = compressFacePlanes(planes);
    ASSERT_TRUE(frame);
    // Count, a byte for each plane's normal, the one normal, offsets; a box is 800 x 700 x 65535 from 0, 0, 0.
    EXPECT_EQ(unpacked(*frame).size(), 2u + 1000 + 24 + 8 * 1000 + (3 + 2 + 2 + 3) * 1000);
}

TEST(FacePlanes, WrongOnesAreFound) {
    const double inf = std::numeric_limits<double>::infinity(), nan = std::nan("");
    const auto with = [](const auto& change) {
        FacePlane face = planeAlongZ(-3);
        change(face);
        return face;
    };
    for (const Vec3d normal : {Vec3d{0, 0, 0}, Vec3d{0, 0, 1 + 2e-9}, Vec3d{0, 0, 1 - 2e-9}, Vec3d{1, 1, 1},
                               Vec3d{nan, 0, 1}, Vec3d{0, inf, 0}, Vec3d{1e300, 0, 0}})
        expectBad(with([&](FacePlane& face) { face.plane.normal = normal; }), "the normal of plane 1 has length");
    for (const double offset : {inf, -inf, nan})
        expectBad(with([&](FacePlane& face) { face.plane.offset = offset; }), "plane 1 has the offset");
    expectBad(with([](FacePlane& face) { face.min[0] = 800; }), "plane 1 is within voxels [800, 800) along x");
    expectBad(with([](FacePlane& face) { face.max[0] = 801; }), "[0, 801) along x, there are 800");
    expectBad(with([](FacePlane& face) { face.max[1] = 0; }), "[0, 0) along y");
    expectBad(with([](FacePlane& face) { face.min[2] = 9, face.max[2] = 8; }), "[9, 8) along z");
    const FacePlane close[] = {with([](FacePlane& face) { face.plane.normal.z = 1 + 0.9e-9; }),
                               with([](FacePlane& face) {
                                   face.min = {799, 699, 65534};
                               })};
    EXPECT_TRUE(checkFacePlanes(close, kDimension));
}

TEST(FacePlanes, DamagedOnesAreRefused) {
    expectRefused({}, "not a zstd frame");
    expectRefused(std::vector<std::byte>(40, std::byte{7}), "not a zstd frame");
    expectRefused(test::zstdFrameOf({}), "0 planes do not fit in 0 bytes");
    expectRefused(test::zstdFrameOf({1, 0, 0}), "1 planes do not fit in 2 bytes");
    expectRefused(test::zstdFrameOf({0xFF, 0xFF, 0xFF, 0xFF, 0x0F, 0}), "4294967295 planes do not fit in 1 bytes");
    expectRefused(test::zstdFrameOf({0xFF, 0xFF, 0xFF, 0xFF, 0x7F, 0}), "do not fit in");
    expectRefused(test::zstdFrameOf({0, 0}), "1 bytes are left over");
    expectRefused(exampleWith(1, {1}), "a normal that is not defined before it");
    expectRefused(exampleWith(1, {2}), "a normal that is not defined before it");
    expectRefused(exampleWith(2, {1}), "a normal that is not defined before it");
    expectRefused(exampleWith(2, {4}), "a normal that is not defined before it");
    expectRefused(exampleWith(2, {0}), "cut short");  // a second normal takes what the rest needs
    expectRefused(exampleWith(10, {0x40}), "the normal of plane 0 has length 65536,");
    expectRefused(exampleWith(9, {0xF8, 0x7F}), "the normal of plane 0 has length nan");
    expectRefused(exampleWith(39, {0xF0, 0, 0x7F}), "plane 0 has the offset inf");
    expectRefused(exampleWith(49, {0}), "plane 0 is within voxels [2, 2) along x");
    expectRefused(exampleWith(53, {0xFF}), "cut short");
    expectRefused(test::zstdFrameOf(kExampleBytes), "plane 1 is within voxels [8, 9) along x, there are 8", {8, 6, 4});
    Bytes longer = kExampleBytes;
    longer.push_back(0);
    expectRefused(test::zstdFrameOf(longer), "1 bytes are left over");
    // 65536 above the smallest voxel of the last plane.
    Bytes far(kExampleBytes.begin(), kExampleBytes.end() - 1);
    far.insert(far.end(), {0x80, 0x80, 4});
    expectRefused(test::zstdFrameOf(far), "beyond voxel 65535");
    // A difference of -1 from 0.
    expectRefused(exampleWith(43, {1, 0}), "beyond voxel 65535");
    expectRefused(test::zstdFrameOf(Bytes(std::size_t{64} << 20, 0)), "are possible");
}

TEST(FacePlanes, MoreNormalsThanBytesAreRefused) {
    Bytes bytes{100};
    bytes.resize(1 + 100 * 15, 0);
    expectRefused(test::zstdFrameOf(bytes), "100 normals do not fit in 1400 bytes");
}

TEST(FacePlanes, TooManyAreRefused) {
    // 2^24 + 1 planes of one normal; noise, so that the frame may hold them.
    const std::uint32_t count = (1u << 24) + 1;
    Bytes bytes(4 + std::size_t{count} * 15, 2);
    const Bytes coded{0x81, 0x80, 0x80, 8};
    std::copy(coded.begin(), coded.end(), bytes.begin());
    std::mt19937 random(1);
    for (std::size_t at = bytes.size() / 2; at < bytes.size(); at += 64)
        bytes[at] = static_cast<std::uint8_t>(random());
    expectRefused(test::zstdFrameOf(bytes), "16777217 planes are over the limit of 16777216");
}

TEST(FacePlanes, WhatRepeatsVeryOftenIsReadBack) {
    const std::vector<FacePlane> planes(300'000, planeAlongZ(0));
    const auto frame = compressFacePlanes(planes);
    ASSERT_TRUE(frame);
    const auto back = readFacePlanes(*frame, Vec3i{800, 700, 65535});
    ASSERT_TRUE(back) << back.error().message();
    EXPECT_EQ(back->size(), planes.size());
}

TEST(FacePlanes, EveryTruncationIsRefused) {
    const auto frame = compressFacePlanes(somePlanes(20));
    ASSERT_TRUE(frame);
    for (std::size_t size = 0; size < frame->size(); ++size)
        expectRefused({frame->begin(), frame->begin() + static_cast<std::ptrdiff_t>(size)}, "the face planes: ");
    const Bytes bytes = unpacked(*frame);
    for (std::size_t size = 0; size < bytes.size(); ++size)
        expectRefused(test::zstdFrameOf({bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size)}),
                      "the face planes: ");
}

TEST(FacePlanes, EveryChangedByteIsToldOrReadsAsPlanes) {
    const auto frame = compressFacePlanes(somePlanes(8));
    ASSERT_TRUE(frame);
    const Bytes bytes = unpacked(*frame);
    const auto expectSafe = [](const std::vector<std::byte>& damaged) {
        const auto planes = readFacePlanes(damaged, kDimension);
        if (planes) {
            EXPECT_TRUE(checkFacePlanes(*planes, kDimension));
        } else {
            EXPECT_EQ(planes.error().code(), Code::BadVolume);
        }
    };
    for (int value = 1; value < 256; ++value) {
        for (std::size_t at = 0; at < frame->size(); ++at) {
            auto damaged = *frame;
            damaged[at] ^= static_cast<std::byte>(value);
            expectSafe(damaged);
        }
        if (value % 8 != 1) continue;
        for (std::size_t at = 0; at < bytes.size(); ++at) {
            Bytes damaged = bytes;
            damaged[at] = static_cast<std::uint8_t>(damaged[at] ^ value);
            expectSafe(test::zstdFrameOf(damaged));
        }
    }
}

}  // namespace
}  // namespace svt::volume
