#include <svt/readers/format/ended_features.hpp>

#include <svt/core/text.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <utility>
#include <vector>

namespace svt::readers {
namespace {

using model::FeatureIndex, model::kNoFeature;

std::string todayText() {
    const std::chrono::year_month_day today(std::chrono::floor<std::chrono::days>(std::chrono::system_clock::now()));
    return fmt::format("{:04}-{:02}-{:02}", static_cast<int>(today.year()), static_cast<unsigned>(today.month()),
                       static_cast<unsigned>(today.day()));
}

// Why a feature does not exist on a day, such as "ended 2019-05-01"; empty if it does.
std::string absenceOf(const model::Feature& feature, std::string_view day, bool countsBegin) {
    constexpr std::size_t kDay = 10, kYear = 4;
    for (const Attribute& attribute : feature.attributes) {
        const bool isEnd = attribute.name == "terminationDate" || attribute.name == "validTo";
        const bool isBegin = attribute.name == "creationDate" || attribute.name == "validFrom";
        if (!isEnd && !(isBegin && countsBegin)) continue;
        const std::string text = toText(attribute.value).substr(0, kDay);
        if (text.size() < kYear || !std::all_of(text.begin(), text.begin() + kYear, isDigit)) continue;
        if (isEnd && text <= day) return "ended " + text;
        if (isBegin && text > day) return "begins " + text;
    }
    return {};
}

// Removes the features without `isKept`, which is false for all features below a removed one.
void keepOnly(const std::vector<bool>& isKept, model::BuildingModel& model) {
    std::vector<FeatureIndex> numbers(isKept.size(), kNoFeature);
    FeatureIndex count = 0;
    for (std::size_t f = 0; f < isKept.size(); ++f)
        if (isKept[f]) numbers[f] = count++;
    const auto renumber = [&](std::vector<FeatureIndex>& list) {
        std::erase_if(list, [&](FeatureIndex f) { return !isKept[f]; });
        for (FeatureIndex& f : list) f = numbers[f];
    };
    for (std::size_t f = 0; f < isKept.size(); ++f) {
        if (!isKept[f]) continue;
        model::Feature& feature = model.features[f];
        if (feature.parent != kNoFeature) feature.parent = numbers[feature.parent];
        renumber(feature.children);
        if (numbers[f] != f) model.features[numbers[f]] = std::move(feature);
    }
    model.features.resize(count);
    renumber(model.roots);
    std::erase_if(model.memberships, [&](const auto& each) { return !isKept[each.group] || !isKept[each.member]; });
    for (model::Membership& each : model.memberships)
        each = {numbers[each.group], numbers[each.member], std::move(each.role)};
    std::erase_if(model.lines, [&](const auto& line) { return !isKept[line.feature]; });
    for (model::Polyline& line : model.lines) line.feature = numbers[line.feature];
}

}  // namespace

bool isDay(std::string_view text) noexcept {
    if (text.size() != 10 || text[4] != '-' || text[7] != '-') return false;
    for (const std::size_t at : {0, 1, 2, 3, 5, 6, 8, 9})
        if (!isDigit(text[at])) return false;
    const std::string_view month = text.substr(5, 2), day = text.substr(8);
    return month >= "01" && month <= "12" && day >= "01" && day <= "31";
}

std::size_t removeEnded(model::BuildingModel& model, const std::string& date, Diagnostics* diagnostics) {
    constexpr std::size_t kNamed = 5;
    if (date == "all") return 0;
    const std::string day = date.empty() ? todayText() : date;
    std::vector<bool> isKept(model.features.size(), true);
    std::size_t count = 0;
    std::string named, first;
    // Parents precede their children.
    for (std::size_t f = 0; f < model.features.size(); ++f) {
        const model::Feature& feature = model.features[f];
        const bool isBelow = feature.parent != kNoFeature && !isKept[feature.parent];
        const std::string why = isBelow ? std::string() : absenceOf(feature, day, !date.empty());
        isKept[f] = !isBelow && why.empty();
        if (why.empty()) continue;
        if (count++ == 0) first = feature.id;
        if (count <= kNamed)
            named += fmt::format("{}{} '{}' ({})", count == 1 ? "" : ", ", feature.className, feature.id, why);
    }
    if (count == 0) return 0;
    keepOnly(isKept, model);
    if (diagnostics != nullptr)
        diagnostics->add(
            Severity::Note, Code::FeatureEnded,
            fmt::format("{} on {} and {} left out: {}{}; --date chooses another day, or all",
                        count == 1 ? "a feature does not exist" : fmt::format("{} features do not exist", count), day,
                        count == 1 ? "is" : "are", named, count > kNamed ? ", ..." : ""),
            {model.source, 0, 0, std::move(first)});
    return count;
}

}  // namespace svt::readers
