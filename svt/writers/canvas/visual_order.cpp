#include <svt/writers/canvas/visual_order.hpp>

#include <svt/core/machine.hpp>
#include <svt/core/text.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace svt::writers {
namespace {

// fribidi_log2vis() of the stable interface of libfribidi.so.0: letters in and out as UTF-32, the direction of the whole
// text, then lists that are not needed here.
using ToVisual = signed char(const std::uint32_t*, int, std::uint32_t*, std::uint32_t*, int*, int*, signed char*);
constexpr std::uint32_t kDirectionOfFirstLetter = 0x40;  // FRIBIDI_PAR_ON
constexpr char32_t kFilling = 0xFEFF;                    // in the place of a letter that a ligature has

// Loaded with the first use.
ToVisual* toVisual() {
    static ToVisual* const function = [] {
        ToVisual* found = nullptr;
        const Result<SharedLibrary> library = SharedLibrary::load("libfribidi.so.0");
        return library && library->find("fribidi_log2vis", found) ? found : nullptr;
    }();
    return function;
}

bool isRightToLeft(char32_t letter) noexcept {
    return (letter >= 0x0590 && letter <= 0x08FF) || (letter >= 0xFB1D && letter <= 0xFDFF) ||
           (letter >= 0xFE70 && letter <= 0xFEFC);
}

}  // namespace

bool hasRightToLeft(std::string_view text) noexcept {
    while (!text.empty()) {
        const Utf8Character letter = firstCharacter(text);
        if (letter.size == 0) return false;
        if (isRightToLeft(letter.code)) return true;
        text.remove_prefix(letter.size);
    }
    return false;
}

std::optional<std::string> visualOrder(std::string_view text) {
    ToVisual* const reorder = toVisual();
    if (reorder == nullptr) return std::nullopt;
    std::vector<std::uint32_t> letters;
    for (std::string_view rest = text; !rest.empty();) {
        const Utf8Character letter = firstCharacter(rest);
        if (letter.size == 0) return std::string(text);
        letters.push_back(letter.code);
        rest.remove_prefix(letter.size);
    }
    std::vector<std::uint32_t> visual(letters.size() + 1);
    std::uint32_t direction = kDirectionOfFirstLetter;
    const bool isDone = reorder(letters.data(), static_cast<int>(letters.size()), &direction, visual.data(), nullptr,
                                nullptr, nullptr) != 0;
    if (!isDone) return std::string(text);
    std::string ordered;
    for (std::size_t n = 0; n < letters.size(); ++n)
        if (visual[n] != kFilling) appendUtf8(visual[n], ordered);
    return ordered;
}

}  // namespace svt::writers
