#pragma once
/// \file
/// Regular expressions that cannot be made to hang: all states run side by side (Thompson 1968), so the time is
/// pattern times text, without backtracking. std::regex takes exponential time on "(a+)+b" and may exhaust the stack.

#include <svt/core/result.hpp>

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

namespace svt::model {

/// A compiled pattern over the characters of UTF-8 text. Copyable, immutable, safe to use from several threads.
///
///     abc  .  [a-z]  [^0-9]  (..)  (?:..)  a|b  ^  $  * + ? {m} {m,} {m,n}  \d \w \s \D \W \S \t \n \r \. and so on
///
/// As in ECMAScript, but without back references, look-around and \b. A lazy quantifier ("*?") is read as a greedy
/// one, which finds the same.
class Regex {
public:
    static constexpr std::size_t kMaxPatternBytes = 256;
    static constexpr std::size_t kMaxInstructions = 2048;  ///< counted repetitions multiply
    static constexpr int kMaxDepth = 32;                   ///< of groups

    /// \return the pattern, or Code::BadQuery with the 1-based byte column in `pattern`
    [[nodiscard]] static Result<Regex> compile(std::string_view pattern);

    /// True where the pattern is found anywhere in `text`; bytes that are no UTF-8 count as one character each.
    /// Cost: O(text * instructions).
    [[nodiscard]] bool isFoundIn(std::string_view text) const;

private:
    friend class RegexCompiler;

    /// Characters in ascending closed ranges, or all others.
    struct CharacterSet {
        std::vector<std::pair<char32_t, char32_t>> ranges;
        bool isNegated = false;
    };
    enum class Operation : std::uint8_t { Set, Split, Jump, Begin, End, Match };
    /// Set: `first` is the set's index. Split: continues at both relative targets. Jump: at `first`.
    struct Instruction {
        Operation operation;
        std::int32_t first = 0, second = 0;
    };

    std::vector<Instruction> program_;
    std::vector<CharacterSet> sets_;
};

}  // namespace svt::model
