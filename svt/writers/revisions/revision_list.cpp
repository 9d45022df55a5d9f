#include <svt/writers/revisions/revision_list.hpp>

#include <svt/core/text.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace svt::writers {
namespace {

constexpr double kNumberWidth = 9, kChangeWidth = 22, kVolumeWidth = 17;  // millimetres

std::string volumeText(const std::optional<double>& value, char point) {
    if (!value) return "\u2013";
    if (*value == 0) return "0";
    std::string text = *value < 0.0005 ? "<0.001" : fmt::format("{:.3f}", *value);
    if (const std::size_t at = text.find('.'); at != std::string::npos) text[at] = point;
    return text;
}

// The text, or its beginning and an ellipsis if it is wider: letters are about 0.6 of the font size wide.
std::string fittedText(const std::string& text, double width) {
    const auto most = static_cast<std::size_t>(std::max(2.0, width / (0.6 * RevisionList::kText)));
    if (characterCount(text) <= most) return text;
    std::size_t end = 0;
    for (std::size_t n = 0; n + 1 < most; ++n) do
            ++end;
        while (end < text.size() && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80);
    return text.substr(0, end) + "\u2026";
}

}  // namespace

std::vector<std::string> revisionTexts(const drawing::Revision& revision, const RevisionWords& words) {
    const auto word = words.changes.find(revision.change);
    return {revision.number == 0 ? std::string("\u2013") : fmt::format("{}", revision.number),
            word == words.changes.end() ? revision.change : word->second, revision.object,
            volumeText(revision.added, words.point), volumeText(revision.removed, words.point)};
}

RevisionListSize revisionListSize(std::size_t count, double width, std::size_t most) {
    if (count == 0) return {};
    RevisionListSize size;
    const double columns =
        std::floor((width + RevisionList::kBetween) / (RevisionList::kColumn + RevisionList::kBetween));
    size.columns = static_cast<std::size_t>(std::max(1.0, columns));
    size.rows = std::min(most, (count + size.columns - 1) / size.columns);
    size.height = RevisionList::kTitle + RevisionList::kRow * double(size.rows + 1) + 2;
    return size;
}

RevisionList makeRevisionList(std::span<const drawing::Revision> revisions, double left, double top, double width,
                              std::size_t most, const RevisionWords& words) {
    RevisionList list;
    const RevisionListSize size = revisionListSize(revisions.size(), width, most);
    if (size.rows == 0) return list;
    const double columnWidth = (width - RevisionList::kBetween * double(size.columns - 1)) / double(size.columns);
    const double objectWidth = std::max(10.0, columnWidth - kNumberWidth - kChangeWidth - 2 * kVolumeWidth);
    const auto addRow = [&](double x, double y, const std::vector<std::string>& texts) {
        const double ends[] = {x + kNumberWidth, x + kNumberWidth + kChangeWidth, 0, x + columnWidth - kVolumeWidth - 1,
                               x + columnWidth - 1};
        list.texts.push_back({x + 1, y, texts[0]});
        list.texts.push_back({ends[0], y, fittedText(texts[1], kChangeWidth - 1)});
        list.texts.push_back({ends[1], y, fittedText(texts[2], objectWidth - 1)});
        list.texts.push_back({ends[3], y, texts[3], true});
        list.texts.push_back({ends[4], y, texts[4], true});
    };
    list.texts.push_back({left, top + 2.5, words.title});
    const std::size_t places = size.rows * size.columns;
    const std::size_t shown = revisions.size() <= places ? revisions.size() : places - 1;
    const double first = top + RevisionList::kTitle;
    for (std::size_t n = 0; n < std::min(places, shown + 1); ++n) {
        const std::size_t column = n / size.rows, row = n % size.rows;
        const double x = left + double(column) * (columnWidth + RevisionList::kBetween);
        const double y = first + RevisionList::kRow * double(row + 1);
        if (n == shown && shown == revisions.size()) break;
        if (n % size.rows == 0) {
            list.rules.push_back({x, x + columnWidth, first - 1});
            addRow(x, first + 1.8, {words.number, words.change, words.object, words.added, words.removed});
            list.rules.push_back({x, x + columnWidth, first + RevisionList::kRow - 1});
        }
        if (n < shown)
            addRow(x, y + 1.8, revisionTexts(revisions[n], words));
        else
            list.texts.push_back({x + 1, y + 1.8, fmt::format(fmt::runtime(words.further), revisions.size() - shown)});
    }
    return list;
}

}  // namespace svt::writers
