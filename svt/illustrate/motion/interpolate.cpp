#include <svt/illustrate/motion/interpolate.hpp>

#include <svt/core/text.hpp>
#include <svt/illustrate/scene_members.hpp>
#include <svt/image/color_text.hpp>

#include <fmt/format.h>

#include <vector>

namespace svt::illustrate {
namespace {

using Json = nlohmann::ordered_json;

// A number as the text writes it.
struct Number {
    double value = 0;
    std::string text;
};

// A text cut at its numbers: the words around them, one more than there are numbers.
struct Pieces {
    std::vector<std::string> words;
    std::vector<Number> numbers;
};

// A number begins with a digit, or with a sign or point before one, where no name goes on.
bool beginsNumber(std::string_view text, std::size_t at) {
    const auto digitAt = [&](std::size_t n) { return n < text.size() && isDigit(text[n]); };
    const char before = at == 0 ? ' ' : text[at - 1];
    const bool isInName =
        isDigit(before) || before == '_' || before == '.' || before == '"' || before == '\'' || isLetter(before);
    if (isInName) return false;
    if (text[at] == '-' || text[at] == '+')
        return digitAt(at + 1) || (at + 1 < text.size() && text[at + 1] == '.' && digitAt(at + 2));
    return isDigit(text[at]) || (text[at] == '.' && digitAt(at + 1));
}

Pieces cutAtNumbers(const std::string& text) {
    Pieces pieces;
    std::string word;
    for (std::size_t at = 0; at < text.size();) {
        if (!beginsNumber(text, at)) {
            word += text[at++];
            continue;
        }
        std::string_view rest = std::string_view(text).substr(at);
        const auto number = takeNumber(rest);
        if (!number) {  // out of range
            word += text[at++];
            continue;
        }
        const std::size_t end = text.size() - rest.size();
        pieces.numbers.push_back({*number, text.substr(at, end - at)});
        pieces.words.push_back(std::exchange(word, {}));
        at = end;
    }
    pieces.words.push_back(word);
    return pieces;
}

double mix(double from, double to, double share) { return share == 1 ? to : from + (to - from) * share; }

std::string colorBetween(const std::string& from, const std::string& to, double share) {
    const auto a = image::parseColor(from), b = image::parseColor(to);
    if (!a || !b) return from;
    const auto channel = [&](float x, float y) { return static_cast<float>(mix(x, y, share)); };
    return image::colorText({channel(a->x, b->x), channel(a->y, b->y), channel(a->z, b->z)});
}

}  // namespace

std::string textBetween(const std::string& from, const std::string& to, double share) {
    const Pieces a = cutAtNumbers(from), b = cutAtNumbers(to);
    if (a.words != b.words) return from;
    std::string text;
    for (std::size_t n = 0; n < a.words.size(); ++n) {
        text += a.words[n];
        if (n == a.numbers.size()) break;
        const Number &x = a.numbers[n], &y = b.numbers[n];
        // A number that stays may be part of a name: "1." of "storey=1.OG+0".
        text += x.text == y.text ? x.text : fmt::format("{:.6g}", mix(x.value, y.value, share));
    }
    return text;
}

Json valueBetween(const Json& from, const Json& to, double share, std::string_view pointer) {
    if (share >= 1) return to;
    const Option* member = findSceneMember(pointer);
    if (member == nullptr) return from;
    // Nothing lies between two whole numbers, such as levels of detail.
    if (member->kind == OptionKind::Number && from.is_number() && to.is_number())
        return mix(from.get<double>(), to.get<double>(), share);
    if (!from.is_string() || !to.is_string()) return from;
    const auto &a = from.get_ref<const std::string&>(), &b = to.get_ref<const std::string&>();
    if (member->value == "COLOR") return colorBetween(a, b, share);
    if (member->value == "REGION") return textBetween(a, b, share);
    return from;
}

}  // namespace svt::illustrate
