#pragma once
/// \file
/// The words by which a search finds buildings: of names, of attributes, and of the text of a user.

#include <svt/volume/label_table.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace svt::city {

/// Bytes of a word; longer words are cut before a character.
inline constexpr std::size_t kMostWordBytes = 64;

/// A building, as the index of words lists it.
struct WordsOfBuilding {
    std::string id, name, className;
    std::string address;             ///< analyze::postalAddress() of the building, or of its first part that has one
    std::vector<std::string> words;  ///< ascending, each once
};

/// Words of a building: its name, its attributes, and those of its parts and units (classes that end in Part or Unit).
/// An attribute has each word of its text, and one word "name=value", as have class and name. Numbers with decimals have
/// no words.
[[nodiscard]] WordsOfBuilding wordsOfBuilding(const volume::LabelTable& labels, std::uint32_t building);

/// A word of a query.
struct WantedWord {
    std::string word;
    bool isBeginning = false;  ///< finds all words that begin with it
};

/// The words of a query: separated by blanks, or in quotes. "street=Main Road" in quotes, street="Main Road" and
/// class=Bridge are one word each. The last word is a beginning, unless a blank or a quote follows it.
[[nodiscard]] std::vector<WantedWord> wantedWords(std::string_view query);

}  // namespace svt::city
