#pragma once
/// \file
/// Zip archives for tests.

#include <svt/core/deflate.hpp>

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace svt::readers::test {

/// The bytes of a number, the lowest first.
inline std::string little(std::uint64_t value, int size) {
    std::string text;
    for (int i = 0; i < size; ++i) text += static_cast<char>(value >> (8 * i) & 0xFF);
    return text;
}

inline std::string deflated(std::string_view text) {
    const auto packed = deflatePiece(std::as_bytes(std::span(text.data(), text.size())), -1, true);
    return {reinterpret_cast<const char*>(packed.data()), packed.size()};
}

struct ArchiveFile {
    std::string name;
    std::string_view text;
    int method = 8, flags = 0;
};

/// An archive of the files, each deflated, or stored with method 0.
inline std::string zipOf(const std::vector<ArchiveFile>& files) {
    std::string archive, directory;
    for (const ArchiveFile& file : files) {
        const std::string packed = file.method == 8 ? deflated(file.text) : std::string(file.text);
        const std::uint32_t checksum = zipChecksum(std::as_bytes(std::span(file.text.data(), file.text.size())));
        const std::string common = little(std::uint64_t(file.flags), 2) + little(std::uint64_t(file.method), 2) +
                                   little(0, 4) + little(checksum, 4) + little(packed.size(), 4) +
                                   little(file.text.size(), 4) + little(file.name.size(), 2) + little(0, 2);
        directory += "PK\1\2" + little(20, 2) + little(20, 2) + common + little(0, 2) + little(0, 2) + little(0, 2) +
                     little(0, 4) + little(archive.size(), 4) + file.name;
        archive += "PK\3\4" + little(20, 2) + common + file.name + packed;
    }
    const std::size_t begin = archive.size();
    archive += directory;
    return archive + "PK\5\6" + little(0, 4) + little(files.size(), 2) + little(files.size(), 2) +
           little(directory.size(), 4) + little(begin, 4) + little(0, 2);
}

}  // namespace svt::readers::test
