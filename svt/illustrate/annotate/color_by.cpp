#include <svt/illustrate/color_by.hpp>

#include <svt/core/text.hpp>
#include <svt/model/classes.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <variant>

namespace svt::illustrate {
namespace {

constexpr Vec3f rgb(unsigned value) {
    return {static_cast<float>((value >> 16U) & 255U) / 255, static_cast<float>((value >> 8U) & 255U) / 255,
            static_cast<float>(value & 255U) / 255};
}

// viridis at nine equal steps.
constexpr std::array kViridis{rgb(0x440154), rgb(0x472d7b), rgb(0x3b528b), rgb(0x2c728e), rgb(0x21918c),
                              rgb(0x28ae80), rgb(0x5ec962), rgb(0xaddc30), rgb(0xfde725)};
constexpr std::array kMuted{rgb(0x88ccee), rgb(0xcc6677), rgb(0xddcc77), rgb(0x117733), rgb(0x332288),
                            rgb(0xaa4499), rgb(0x44aa99), rgb(0x999933), rgb(0x882255)};
constexpr Vec3f kGray = rgb(0xd5d5d5);
constexpr std::size_t kMostEntries = 2 * kMuted.size();

Vec3f paletteColor(std::size_t n) {
    if (n < kMuted.size()) return kMuted[n];
    return kMuted[n - kMuted.size()] * 0.5f + Vec3f{0.5f, 0.5f, 0.5f};
}

// A value of a row; `unit` is that of an attribute.
struct Value {
    std::string text, unit;
    bool isWord = false;  // text in the model, even if it reads like a number: a code
};

class ValueFinder {
public:
    ValueFinder(std::string_view key, std::span<const model::QueryRow> rows, std::span<const double> areas)
        : key_(key), rows_(rows), areas_(areas) {}

    [[nodiscard]] std::optional<Value> of(std::uint32_t row) const {
        const model::QueryRow& own = rows_[row];
        if (equalsIgnoringCase(key_, "class")) return textOf(model::canonicalClassName(own.className));
        if (equalsIgnoringCase(key_, "id")) return textOf(own.id);
        if (equalsIgnoringCase(key_, "name")) return own.name.empty() ? std::optional<Value>() : textOf(own.name);
        if (equalsIgnoringCase(key_, "volume"))
            return own.volume ? std::optional(Value{fmt::format("{}", *own.volume), "m3", false}) : std::nullopt;
        if (equalsIgnoringCase(key_, "voxels")) return Value{fmt::format("{}", own.voxels), "", false};
        if (row < areas_.size() && areas_[row] > 0) return Value{fmt::format("{}", areas_[row]), "m2", false};
        const bool isStorey = equalsIgnoringCase(key_, "storey");
        return firstAbove(row, [&](const model::QueryRow& above) -> std::optional<Value> {
            if (!isStorey) return attributeOf(above);
            if (!model::query::isStorey(above)) return std::nullopt;
            return textOf(above.name.empty() ? above.id : above.name);
        });
    }

private:
    static Value textOf(std::string_view text) { return {std::string(text), "", true}; }

    [[nodiscard]] std::optional<Value> attributeOf(const model::QueryRow& row) const {
        for (const Attribute& attribute : row.attributes)
            if (equalsIgnoringCase(attribute.name, key_))
                return Value{toText(attribute.value), attribute.unit,
                             std::holds_alternative<std::string>(attribute.value)};
        return std::nullopt;
    }

    // The first result of `find` in the row, the features above it, and their groups, from the nearest.
    template <class Find>
    [[nodiscard]] std::optional<Value> firstAbove(std::uint32_t row, const Find& find) const {
        std::vector<std::uint32_t> found{row};
        for (std::size_t n = 0; n < found.size() && n < kMostAbove; ++n) {
            const model::QueryRow& at = rows_[found[n]];
            if (auto value = find(at)) return value;
            const auto add = [&](std::uint32_t above) {
                if (above < rows_.size() && std::find(found.begin(), found.end(), above) == found.end())
                    found.push_back(above);
            };
            add(at.parent);
            for (const std::uint32_t group : at.groups) add(group);
        }
        return std::nullopt;
    }

    static constexpr std::size_t kMostAbove = 64;  // hostile models: groups in groups
    std::string_view key_;
    std::span<const model::QueryRow> rows_;
    std::span<const double> areas_;
};

std::optional<double> numberOf(const std::string& text) {
    const auto number = parseNumber(withoutBlanks(text));
    if (!number || !(*number > -1e300 && *number < 1e300)) return std::nullopt;
    return number;
}

Error nothingToColor(std::string_view key, std::span<const model::QueryRow> rows,
                     std::span<const std::uint8_t> isShown) {
    std::set<std::string> names;
    for (std::size_t row = 0; row < rows.size(); ++row)
        if (isShown[row] != 0)
            for (const Attribute& attribute : rows[row].attributes)
                if (!equalsIgnoringCase(attribute.name, "class")) names.insert(attribute.name);
    std::vector<std::string> some(names.begin(), names.end());
    if (some.size() > 12) some.resize(12);
    return {Code::BadArgument,
            fmt::format("no visible component has the key '{}' for colours; use class, name, storey, "
                        "volume, area (of rooms), voxels{}{}{}{}",
                        key, equalsIgnoringCase(key, "owner") ? ", owner with a table of owners (--owners)" : "",
                        some.empty() ? "" : ", ", fmt::join(some, ", "), names.size() > 12 ? ", ..." : "")};
}

void colorByRamp(const std::vector<std::optional<Value>>& values, Coloring& coloring) {
    ColorScale& scale = coloring.scale;
    scale.isRamp = true;
    bool isFirst = true;
    for (const auto& value : values) {
        if (!value) continue;
        const double number = *numberOf(value->text);
        scale.low = isFirst ? number : std::min(scale.low, number);
        scale.high = isFirst ? number : std::max(scale.high, number);
        isFirst = false;
    }
    for (std::size_t row = 0; row < values.size(); ++row)
        if (values[row]) coloring.colors[row] = rampColor(scale, *numberOf(values[row]->text));
}

// Rows with a value of a palette, hidden or not, and those of them that are shown.
struct Count {
    std::size_t all = 0, shown = 0;
};

void colorByPalette(const std::vector<std::optional<Value>>& values, const std::map<std::string, Count>& counts,
                    Coloring& coloring) {
    std::vector<std::pair<std::string_view, Count>> known(counts.begin(), counts.end());
    if (known.size() > kMostEntries)
        std::stable_sort(known.begin(), known.end(),
                         [](const auto& a, const auto& b) { return a.second.all > b.second.all; });
    std::map<std::string_view, Vec3f> colors;
    std::size_t otherCount = 0;
    ColorScale::Entry others{"", kGray, 0};
    for (std::size_t n = 0; n < known.size(); ++n) {
        const auto& [text, count] = known[n];
        colors[text] = n < kMostEntries ? paletteColor(n) : kGray;
        if (count.shown == 0) continue;
        if (n < kMostEntries) {
            coloring.scale.entries.push_back({std::string(text), colors[text], count.shown});
        } else {
            ++otherCount;
            others.count += count.shown;
        }
    }
    for (std::size_t row = 0; row < values.size(); ++row)
        if (values[row]) coloring.colors[row] = colors[values[row]->text];
    if (otherCount == 0) return;
    others.text = fmt::format("{} others", otherCount);
    coloring.scale.entries.push_back(std::move(others));
}

}  // namespace

Vec3f missingColor() noexcept { return kGray; }

Vec3f rampColor(const ColorScale& scale, double value) {
    const double share =
        scale.high > scale.low ? std::clamp((value - scale.low) / (scale.high - scale.low), 0.0, 1.0) : 0.5;
    const auto colorAt = [&](const auto& ramp) {
        const double at = share * double(ramp.size() - 1);
        const auto below = std::min(static_cast<std::size_t>(at), ramp.size() - 2);
        const auto rest = static_cast<float>(at - static_cast<double>(below));
        return ramp[below] * (1 - rest) + ramp[below + 1] * rest;
    };
    return scale.ramp.size() > 1 ? colorAt(scale.ramp) : colorAt(kViridis);
}

Result<Coloring> colorBy(std::string_view key, std::span<const model::QueryRow> rows,
                         std::span<const std::uint8_t> isShown, std::span<const double> areas,
                         std::span<const std::uint8_t> isHidden) {
    const ValueFinder finder(key, rows, areas);
    std::vector<std::optional<Value>> values(rows.size());
    Coloring coloring;
    coloring.colors.assign(rows.size(), kGray);
    bool isNumeric = true, isWord = false;
    std::string unit;
    std::map<std::string, Count> counts;
    std::size_t shownCount = 0;
    for (std::uint32_t row = 0; row < rows.size(); ++row) {
        const bool isCounted = isShown[row] != 0;
        if (!isCounted && (row >= isHidden.size() || isHidden[row] == 0)) continue;
        values[row] = finder.of(row);
        if (!values[row]) {
            coloring.scale.missing += isCounted ? 1 : 0;
            continue;
        }
        Count& count = counts[values[row]->text];
        ++count.all;
        count.shown += isCounted ? 1 : 0;
        shownCount += isCounted ? 1 : 0;
        isNumeric = isNumeric && numberOf(values[row]->text).has_value();
        isWord = isWord || values[row]->isWord;
        if (unit.empty()) unit = values[row]->unit;
    }
    if (shownCount == 0) return nothingToColor(key, rows, isShown);
    coloring.scale.title = unit.empty() ? std::string(key) : fmt::format("{} ({})", key, unit);
    // Text that reads like numbers is codes where it is a few, and measures where it is many.
    if (isNumeric && (!isWord || counts.size() > kMostEntries))
        colorByRamp(values, coloring);
    else
        colorByPalette(values, counts, coloring);
    for (std::size_t row = 0; row < rows.size(); ++row)
        if (isShown[row] == 0) coloring.colors[row] = kGray;
    return coloring;
}

}  // namespace svt::illustrate
