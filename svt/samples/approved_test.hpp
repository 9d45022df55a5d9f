#pragma once
/// \file
/// Compares a result with the recorded one in tests/golden/NAME.txt, so that no change of a result stays unseen. Most
/// records were not checked by hand. SVT_UPDATE_GOLDEN=1 writes them anew; read the difference before you commit it.

#include <svt/core/temporary_folder_test.hpp>
#include <svt/core/test_data_test.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <string_view>

namespace svt::test {

/// A digest of long texts and of bytes: FNV-1a with 64 bits.
inline std::uint64_t digestOf(std::string_view bytes) {
    std::uint64_t hash = 0xCBF29CE484222325u;
    for (const char byte : bytes) hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100000001B3u;
    return hash;
}

/// The same line, or the same file as another release of a library writes it: " (release NAME)" ends such a line.
inline bool isSameLine(std::string_view actual, std::string_view approved) {
    const std::size_t a = actual.find(" (release "), b = approved.find(" (release ");
    if (a == std::string_view::npos || b == std::string_view::npos || actual.substr(a) == approved.substr(b))
        return actual == approved;
    return actual.substr(0, actual.find(": ")) == approved.substr(0, approved.find(": "));
}

/// The first line that differs, in both texts; empty if none does.
inline std::string differenceOf(std::string_view actual, std::string_view approved) {
    for (int line = 1; !actual.empty() || !approved.empty(); ++line) {
        const std::string_view a = actual.substr(0, actual.find('\n')), b = approved.substr(0, approved.find('\n'));
        if (!isSameLine(a, b))
            return "line " + std::to_string(line) + ":\n  is       " + std::string(a) + "\n  approved " +
                   std::string(b);
        actual.remove_prefix(std::min(actual.size(), a.size() + 1));
        approved.remove_prefix(std::min(approved.size(), b.size() + 1));
    }
    return {};
}

/// \param result  carriage returns of it are `\r` in the file, since programs change ends of lines
inline void expectApproved(const std::string& name, const std::string& result) {
    std::string text;
    for (const char c : result) text += c == '\r' ? std::string("\\r") : std::string(1, c);
    const std::filesystem::path path = std::filesystem::path(kSourceRoot) / "tests/golden" / (name + ".txt");
    if (const char* update = std::getenv("SVT_UPDATE_GOLDEN"); update != nullptr && std::string(update) == "1") {
        std::filesystem::create_directories(path.parent_path());
        writeText(path, text);
        return;
    }
    const std::string approved = readText(path), difference = differenceOf(text, approved);
    if (approved.empty() || !difference.empty()) ADD_FAILURE() << path << ", " << difference;
}

}  // namespace svt::test
