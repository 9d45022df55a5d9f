#pragma once
/// \file
/// Text or bytes that are collected and go to a file in pieces of a megabyte; UTF-8 that is valid.

#include <svt/core/bytes.hpp>
#include <svt/core/file.hpp>
#include <svt/core/text.hpp>

#include <cstddef>
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
