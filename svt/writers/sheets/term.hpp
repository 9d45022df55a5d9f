#pragma once
/// \file
/// Terms in English and German, by a key.

#include <svt/writers/sheet_writer.hpp>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <string_view>

namespace svt::writers {

template <class Key>
struct Term {
    Key key;
    std::string_view english, german;
};

/// The term of a key; empty if the table does not have it.
template <class Key, std::size_t N>
std::string_view termOf(const Term<Key> (&terms)[N], Key key, SheetLanguage language) noexcept {
    const auto* found =
        std::find_if(std::begin(terms), std::end(terms), [&](const auto& term) { return term.key == key; });
    if (found == std::end(terms)) return {};
    return language == SheetLanguage::German ? found->german : found->english;
}

}  // namespace svt::writers
