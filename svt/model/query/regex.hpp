#pragma once
/// \file
/// Regular expressions with guaranteed running time: all states are simulated in parallel (Thompson 1968), so the time
/// is pattern times text, without backtracking. std::regex is exponential on "(a+)+b" and may overflow the stack.

#include <svt/core/result.hpp>

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

namespace svt::model {

/// A compiled pattern over the characters of UTF-8 text. Copyable, immutable, safe to use from several threads.
///
/// abc  .  [a-z]  [^0-9]  (..)  (?:..)  a|b  ^  $  * + ? {m} {m,} {m,n}  \d \w \s \D \W \S \t \n \r \. and so on
///
/// As in ECMAScript, but without back references, look-around and \b. A lazy quantifier ("*?") is treated as a greedy
/// one, which gives the same result here.
class Regex {
public:
    static constexpr std::size_t kMaxPatternBytes = 256;
    static constexpr std::size_t kMaxInstructions = 2048;  ///< counted repetitions are expanded, so they multiply
    static constexpr int kMaxDepth = 32;                   ///< maximum nesting of groups

    /// \return the pattern, or Code::BadQuery with the 1-based byte column in `pattern`
    [[nodiscard]] static Result<Regex> compile(std::string_view pattern);

    /// True if the pattern occurs anywhere in `text`; each invalid UTF-8 byte counts as one character.
    /// Cost: O(text * instructions).
    [[nodiscard]] bool isFoundIn(std::string_view text) const;

private:
    friend class RegexCompiler;

    /// Characters as ascending closed ranges, or all others.
    struct CharacterSet {
        std::vector<std::pair<char32_t, char32_t>> ranges;
        bool isNegated = false;
    };
    enum class Operation : std::uint8_t { Set, Split, Jump, Begin, End, Match };
    /// Set: `first` is the index of the set. Split: continues at both relative targets. Jump: continues at `first`.
    struct Instruction {
        Operation operation;
        std::int32_t first = 0, second = 0;
    };

    std::vector<Instruction> program_;
    std::vector<CharacterSet> sets_;
};

}  // namespace svt::model
