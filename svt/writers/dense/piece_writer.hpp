#pragma once
/// \file
/// Text or bytes that are collected and go to a file in pieces of a megabyte; UTF-8 that is valid.

#include <svt/core/file.hpp>
#include <svt/core/text.hpp>

#include <cstddef>
#include <cstring>
#include <string>
#include <string_view>

namespace svt::writers {

class PieceWriter {
public:
    explicit PieceWriter(AtomicFile& file) : file_(file) {}
    std::string text;
    /// Writes what has been collected, where it is a megabyte or the last of it.
    Result<void> flush(bool isLast = false) {
        if (text.size() < (std::size_t{1} << 20) && !isLast) return {};
        auto done = file_.write(text);
        text.clear();
        return done;
    }

private:
    AtomicFile& file_;
};

/// Appends a number as it stands in memory: little-endian.
template <class T>
void appendBytes(std::string& out, T value) {
    char bytes[sizeof value];
    std::memcpy(bytes, &value, sizeof value);
    out.append(bytes, sizeof bytes);
}

/// `text` with '?' for each byte that belongs to no character.
[[nodiscard]] inline std::string validText(std::string_view text) {
    std::string valid;
    while (!text.empty()) {
        const std::size_t size = firstCharacter(text).size;
        valid += size == 0 ? "?" : text.substr(0, size);
        text.remove_prefix(size == 0 ? 1 : size);
    }
    return valid;
}

}  // namespace svt::writers
