#pragma once
/// \file
/// Collects text or bytes and writes them to a file in pieces of a megabyte. Also makes text valid UTF-8.

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
    /// Writes the collected bytes if they are a megabyte or more, or the last ones.
    Result<void> flush(bool isLast = false) {
        if (text.size() < (std::size_t{1} << 20) && !isLast) return {};
        auto done = file_.write(text);
        text.clear();
        return done;
    }

private:
    AtomicFile& file_;
};

/// `text` with '?' for each byte that is not part of a character.
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
