#include <svt/core/text.hpp>
#include <svt/model/query/regex.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>

namespace svt::model {
namespace {

constexpr char32_t kInvalidByte = 0x110000;  ///< + byte: an invalid UTF-8 byte, equal only to itself
constexpr std::int32_t kMaxRepeats = 1000;

/// Decodes the character at `position` and advances `position`.
char32_t nextCharacter(std::string_view text, std::size_t& position) noexcept {
    const Utf8Character character = firstCharacter(text.substr(position));
    if (character.size == 0) return kInvalidByte + static_cast<unsigned char>(text[position++]);
    position += character.size;
    return character.code;
}

using Ranges = std::vector<std::pair<char32_t, char32_t>>;

/// Characters of \d, \w or \s.
std::optional<Ranges> classOf(char letter) {
    switch (letter) {
        case 'd': return Ranges{{'0', '9'}};
        case 'w': return Ranges{{'0', '9'}, {'A', 'Z'}, {'_', '_'}, {'a', 'z'}};
        case 's':
            return Ranges{{'\t', '\r'}, {' ', ' '}, {0xA0, 0xA0}, {0x2000, 0x200A}, {0x2028, 0x2029}, {0x3000, 0x3000}};
        default: return std::nullopt;
    }
}

/// Sorted and without overlaps.
Ranges normalized(Ranges ranges) {
    std::sort(ranges.begin(), ranges.end());
    Ranges result;
    for (const auto& range : ranges) {
        if (!result.empty() && range.first <= result.back().second + 1)
            result.back().second = std::max(result.back().second, range.second);
        else
            result.push_back(range);
    }
    return result;
}

Ranges complement(const Ranges& sorted) {
    Ranges result;
    char32_t next = 0;
    for (const auto& [first, last] : sorted) {
        if (first > next) result.emplace_back(next, first - 1);
        next = last + 1;
    }
    result.emplace_back(next, kInvalidByte + 0xFF);
    return result;
}

}  // namespace

/// Recursive descent; every construct compiles to a code fragment with relative targets, so fragments are
/// concatenated and repeated by copying.
class RegexCompiler {
public:
    explicit RegexCompiler(std::string_view pattern) : pattern_(pattern) {}

    Result<Regex> run() {
        if (pattern_.size() > Regex::kMaxPatternBytes)
            return Error(Code::BadQuery, fmt::format("the pattern has {} bytes; at most {} are allowed",
                                                     pattern_.size(), Regex::kMaxPatternBytes));
        Program program = alternatives(0);
        if (!error_ && !atEnd()) fail("a ')' without '('");
        if (!error_) {
            program.push_back({Operation::Match});
            checkSize(program.size());
        }
        if (error_) return *error_;
        regex_.program_ = std::move(program);
        return std::move(regex_);
    }

private:
    using Operation = Regex::Operation;
    using Program = std::vector<Regex::Instruction>;

    [[nodiscard]] bool atEnd() const noexcept { return position_ >= pattern_.size(); }
    [[nodiscard]] bool at(char c) const noexcept { return !atEnd() && pattern_[position_] == c; }
    bool take(char c) noexcept {
        if (!at(c)) return false;
        ++position_;
        return true;
    }
    void fail(std::string message) {
        if (!error_) error_ = Error(Code::BadQuery, std::move(message), {{}, 0, position_ + 1, {}});
        position_ = pattern_.size();
    }
    void checkSize(std::size_t size) {
        if (size > Regex::kMaxInstructions)
            fail(fmt::format("the pattern unfolds to more than {} steps; use smaller repetitions",
                             Regex::kMaxInstructions));
    }
    static void append(Program& program, const Program& more) {
        program.insert(program.end(), more.begin(), more.end());
    }

    Program alternatives(int depth) {
        Program program = sequence(depth);
        while (take('|')) {
            const Program other = sequence(depth);
            // split(1, n) first jump(over other) other
            Program both{{Operation::Split, 1, static_cast<std::int32_t>(program.size()) + 2}};
            append(both, program);
            both.push_back({Operation::Jump, static_cast<std::int32_t>(other.size()) + 1});
            append(both, other);
            program = std::move(both);
            checkSize(program.size());
        }
        return program;
    }

    Program sequence(int depth) {
        Program program;
        while (!atEnd() && !at('|') && !at(')')) {
            append(program, quantified(depth));
            checkSize(program.size());
        }
        return program;
    }

    Program quantified(int depth) {
        const bool isAssertion = at('^') || at('$');
        Program program = atom(depth);
        bool isQuantified = false;
        while (!atEnd()) {
            std::int32_t least = 0, most = -1;  // -1: unlimited
            if (take('+')) {
                least = 1;
            } else if (take('?')) {
                if (isQuantified) continue;  // lazy
                most = 1;
            } else if (at('{')) {
                if (!count(least, most)) break;
            } else if (!take('*')) {
                break;
            }
            if (isAssertion || isQuantified) {
                --position_;
                fail("a quantifier with nothing to repeat before it");
                break;
            }
            isQuantified = true;
            program = repeated(program, least, most);
        }
        return program;
    }

    Program repeated(const Program& body, std::int32_t least, std::int32_t most) {
        const auto size = static_cast<std::int32_t>(body.size());
        const std::int64_t copies = most < 0 ? std::int64_t{least} + 1 : most;
        checkSize(static_cast<std::size_t>(copies) * (body.size() + 1));
        if (error_) return {};
        Program program;
        for (std::int32_t k = 0; k < least; ++k) append(program, body);
        for (std::int32_t k = least; k < most; ++k) {
            // Each further copy is optional, along with all copies after it.
            program.push_back({Operation::Split, 1, (most - k) * (size + 1)});
            append(program, body);
        }
        if (most < 0) {
            program.push_back({Operation::Split, 1, size + 2});
            append(program, body);
            program.push_back({Operation::Jump, -(size + 1)});
        }
        return program;
    }

    bool number(std::int32_t& value) {
        const std::size_t begin = position_;
        for (value = 0; !atEnd() && isDigit(pattern_[position_]); ++position_)
            value = std::min(value * 10 + (pattern_[position_] - '0'), kMaxRepeats + 1);
        return position_ > begin;
    }

    /// {m}, {m,} or {m,n}
    bool count(std::int32_t& least, std::int32_t& most) {
        ++position_;
        bool isGood = number(least);
        most = least;
        if (isGood && take(',')) {
            most = -1;
            if (!at('}')) isGood = number(most);
        }
        if (!isGood || !take('}')) {
            fail("a '{' without a count such as {2}, {2,} or {2,4}; write \\{ for the character");
        } else if (least > kMaxRepeats || most > kMaxRepeats) {
            fail(fmt::format("a repetition of more than {}", kMaxRepeats));
        } else if (most >= 0 && most < least) {
            fail("a repetition whose limits are in the wrong order");
        }
        return !error_;
    }

    Program set(Ranges ranges, bool isNegated = false) {
        regex_.sets_.push_back({normalized(std::move(ranges)), isNegated});
        return {{Operation::Set, static_cast<std::int32_t>(regex_.sets_.size()) - 1}};
    }

    Program atom(int depth) {
        switch (pattern_[position_]) {
            case '^': ++position_; return {{Operation::Begin}};
            case '$': ++position_; return {{Operation::End}};
            case '.': ++position_; return set({{'\n', '\n'}, {'\r', '\r'}}, true);
            case '(': return group(depth);
            case '[': return bracket();
            case '*':
            case '+':
            case '?':
            case '{': fail("a quantifier with nothing to repeat before it"); return {};
            case '\\': {
                Ranges ranges;
                return escape(ranges) ? set(std::move(ranges)) : Program{};
            }
            default: {
                const char32_t character = nextCharacter(pattern_, position_);
                return set({{character, character}});
            }
        }
    }

    Program group(int depth) {
        if (depth >= Regex::kMaxDepth) {
            fail(fmt::format("groups nested deeper than {}", Regex::kMaxDepth));
            return {};
        }
        ++position_;
        if (take('?') && !take(':')) {
            fail("a group that begins with '?'; only (?:...) is supported");
            return {};
        }
        Program program = alternatives(depth + 1);
        if (!error_ && !take(')')) fail("a '(' without ')'");
        return program;
    }

    /// At '\': parses one character or one class.
    bool escape(Ranges& ranges) {
        ++position_;
        if (atEnd()) {
            fail("a '\\' at the end");
            return false;
        }
        const char letter = pattern_[position_];
        const char lower = static_cast<char>(letter | 0x20);
        if (const auto characters = classOf(lower)) {
            ++position_;
            ranges = letter == lower ? *characters : complement(*characters);
            return true;
        }
        const std::size_t control = std::string_view("tnrfv").find(letter);
        if (control != std::string_view::npos) {
            ++position_;
            const char32_t character = static_cast<unsigned char>("\t\n\r\f\v"[control]);
            ranges = {{character, character}};
            return true;
        }
        const bool isAlphanumeric = (lower >= 'a' && lower <= 'z') || isDigit(letter);
        if (isAlphanumeric) {
            fail(fmt::format("the escape '\\{}', which is not supported", letter));
            return false;
        }
        const char32_t character = nextCharacter(pattern_, position_);
        ranges = {{character, character}};
        return true;
    }

    Program bracket() {
        const std::size_t begin = position_++;
        const bool isNegated = take('^');
        Ranges all;
        while (!at(']')) {
            Ranges first, last;
            if (!member(begin, first)) return {};
            const bool isRange = at('-') && position_ + 1 < pattern_.size() && pattern_[position_ + 1] != ']';
            if (isRange) {
                ++position_;
                if (!member(begin, last)) return {};
                const bool isSingle = first.size() == 1 && last.size() == 1 && first[0].first == first[0].second &&
                                      last[0].first == last[0].second;
                if (!isSingle || last[0].first < first[0].first) {
                    fail("a range in [...] that is not from a lower to a higher character");
                    return {};
                }
                first[0].second = last[0].first;
            }
            all.insert(all.end(), first.begin(), first.end());
        }
        ++position_;
        return set(std::move(all), isNegated);
    }

    bool member(std::size_t begin, Ranges& ranges) {
        if (atEnd()) {
            position_ = begin;
            fail("a '[' without ']'");
            return false;
        }
        if (at('\\')) return escape(ranges);
        const char32_t character = nextCharacter(pattern_, position_);
        ranges = {{character, character}};
        return true;
    }

    std::string_view pattern_;
    std::size_t position_ = 0;
    Regex regex_;
    std::optional<Error> error_;
};

Result<Regex> Regex::compile(std::string_view pattern) { return RegexCompiler(pattern).run(); }

bool Regex::isFoundIn(std::string_view text) const {
    std::vector<std::int32_t> now, next, stack;
    std::vector<std::size_t> seen(program_.size(), 0);  // 1 + position at which a state was last entered
    bool isMatched = false;
    const auto enter = [&](std::vector<std::int32_t>& states, std::int32_t state, std::size_t position) {
        stack.push_back(state);
        while (!stack.empty()) {
            const std::int32_t k = stack.back();
            stack.pop_back();
            if (seen[k] == position + 1) continue;
            seen[k] = position + 1;
            const Instruction& instruction = program_[k];
            switch (instruction.operation) {
                case Operation::Set: states.push_back(k); break;
                case Operation::Split: stack.push_back(k + instruction.second); [[fallthrough]];
                case Operation::Jump: stack.push_back(k + instruction.first); break;
                case Operation::Begin:
                    if (position == 0) stack.push_back(k + 1);
                    break;
                case Operation::End:
                    if (position == text.size()) stack.push_back(k + 1);
                    break;
                case Operation::Match: isMatched = true; break;
            }
        }
    };
    const auto contains = [](const CharacterSet& set, char32_t character) {
        for (const auto& [first, last] : set.ranges)
            if (character >= first && character <= last) return !set.isNegated;
        return set.isNegated;
    };
    for (std::size_t position = 0;;) {
        enter(now, 0, position);
        if (isMatched) return true;
        if (position >= text.size()) return false;
        const char32_t character = nextCharacter(text, position);
        next.clear();
        for (const std::int32_t k : now)
            if (contains(sets_[program_[k].first], character)) enter(next, k + 1, position);
        std::swap(now, next);
    }
}

}  // namespace svt::model
