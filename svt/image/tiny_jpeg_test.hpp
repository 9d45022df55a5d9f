#pragma once
/// \file
/// A small JPEG for tests.

#include <cstddef>
#include <string_view>
#include <vector>

namespace svt::image::test {

/// A baseline JPEG of 16 x 16 pixels, all of about the sRGB colour (200, 40, 30).
inline std::vector<std::byte> tinyJpeg() {
    constexpr std::string_view kHex =
        "ffd8ffe000104a46494600010100000100010000ffdb0043000302020302020303030304030304050805050404050a070706"
        "080c0a0c0c0b0a0b0b0d0e12100d0e110e0b0b1016101113141515150c0f171816141812141514ffdb004301030404050405"
        "09050509140d0b0d141414141414141414141414141414141414141414141414141414141414141414141414141414141414"
        "1414141414141414ffc00011080010001003011100021101031101ffc4001500010100000000000000000000000000000007"
        "ffc40014100100000000000000000000000000000000ffc400160101010100000000000000000000000000000708ffc40014"
        "110100000000000000000000000000000000ffda000c03010002110311003f0089254db000003fffd9";
    const auto digit = [](char c) { return c <= '9' ? c - '0' : c - 'a' + 10; };
    std::vector<std::byte> bytes;
    for (std::size_t i = 0; i < kHex.size(); i += 2)
        bytes.push_back(static_cast<std::byte>(digit(kHex[i]) * 16 + digit(kHex[i + 1])));
    return bytes;
}

}  // namespace svt::image::test
