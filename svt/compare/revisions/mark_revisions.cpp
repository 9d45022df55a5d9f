#include <svt/compare/revisions.hpp>

#include <svt/compare/revisions/changed_lines.hpp>
#include <svt/drawing/storey_floors.hpp>
#include <svt/model/classes.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>

namespace svt::compare {
namespace {

using drawing::PlanePoint, drawing::SectionDrawing;

constexpr double kBeside = 0.3;  // metres around the lines of a component, for those of its surfaces and rooms

// A rectangle in a drawing, metres.
struct LineBox {
    PlanePoint low{kInfinity, kInfinity}, high{-kInfinity, -kInfinity};

    void add(PlanePoint p) noexcept {
        low = {std::min(low.u, p.u), std::min(low.v, p.v)};
        high = {std::max(high.u, p.u), std::max(high.v, p.v)};
    }
    [[nodiscard]] bool contains(PlanePoint p, double margin) const noexcept {
        return p.u >= low.u - margin && p.u <= high.u + margin && p.v >= low.v - margin && p.v <= high.v + margin;
    }
};

bool isRevision(const ComparisonRow& row) noexcept {
    return row.hasGeometry && row.change != Change::Same && row.change != Change::Reassigned;
}

// Objects that change with the components around them.
bool followsOthers(const std::string& className) {
    return className.ends_with("Surface") || model::isSpace(className) ||
           model::classRank(className) >= model::ClassRank::Room;
}

class Marker {
public:
    explicit Marker(const Compared& states) : states_(states) {
        rowOfWas_.assign(states.was.labels.labels.size(), volume::kNoLabel);
        rowOfIs_.assign(states.is.labels.labels.size(), volume::kNoLabel);
        for (std::uint32_t r = 0; r < states.comparison.rows.size(); ++r) {
            const ComparisonRow& row = states.comparison.rows[r];
            if (!isRevision(row)) continue;
            for (const std::uint32_t label : row.was) rowOfWas_[label] = std::uint32_t(rows_.size());
            for (const std::uint32_t label : row.is) rowOfIs_[label] = std::uint32_t(rows_.size());
            follows_.push_back(followsOthers(subject(row).className) ? 1 : 0);
            rows_.push_back(r);
        }
    }

    std::vector<drawing::Revision> run(std::span<const SectionDrawing> before,
                                       std::span<SectionDrawing* const> drawings) {
        std::vector<std::vector<drawing::RevisionLines>> marks;  // by drawing, then row
        std::vector<char> isShown(rows_.size(), 0);
        for (std::size_t d = 0; d < drawings.size(); ++d) {
            marks.push_back(changedLines(before[d], *drawings[d]));
            dropFollowers(marks.back());
            for (std::size_t r = 0; r < rows_.size(); ++r)
                if (isMarked(marks.back()[r])) isShown[r] = 1;
        }
        std::vector<drawing::Revision> revisions = number(isShown);
        for (std::size_t d = 0; d < drawings.size(); ++d)
            for (std::size_t r = 0; r < rows_.size(); ++r) {
                if (!isMarked(marks[d][r])) continue;
                marks[d][r].revision = revisions[numberOf_[r] - 1];
                drawings[d]->revisions.push_back(std::move(marks[d][r]));
            }
        return revisions;
    }

private:
    static bool isMarked(const drawing::RevisionLines& lines) noexcept {
        return !lines.added.empty() || !lines.removed.empty();
    }

    [[nodiscard]] const volume::Label& subject(const ComparisonRow& row) const {
        return row.is.empty() ? states_.was.labels.labels[row.was.front()] : states_.is.labels.labels[row.is.front()];
    }

    // The lines of each row. A line between two parts of one row is not an outline of it.
    template <class Place>
    [[nodiscard]] std::vector<std::vector<Line>> linesOf(const SectionDrawing& drawing,
                                                         const std::vector<std::uint32_t>& rowOf,
                                                         const Place& place) const {
        std::vector<std::vector<Line>> lines(rows_.size());
        const auto rowAt = [&](std::uint32_t label) { return label < rowOf.size() ? rowOf[label] : volume::kNoLabel; };
        const auto addPath = [&](std::uint32_t row, const std::vector<PlanePoint>& points) {
            if (row == volume::kNoLabel) return;
            for (std::size_t n = 0; n + 1 < points.size(); ++n)
                lines[row].push_back({place(points[n]), place(points[n + 1])});
        };
        for (const drawing::SectionBorder& border : drawing.borders) {
            const std::uint32_t left = rowAt(border.left), right = rowAt(border.right);
            if (left == right) continue;
            addPath(left, border.points);
            addPath(right, border.points);
        }
        for (const drawing::SectionLine& line : drawing.lines) addPath(rowAt(line.label), line.points);
        for (const drawing::BeyondLine& line : drawing.beyond)
            if (const std::uint32_t row = rowAt(line.label); row != volume::kNoLabel)
                lines[row].push_back({place(line.from), place(line.to)});
        return lines;
    }

    [[nodiscard]] std::vector<drawing::RevisionLines> changedLines(const SectionDrawing& before,
                                                                   const SectionDrawing& after) const {
        const auto old = linesOf(
            before, rowOfWas_, [&](PlanePoint p) { return after.axes.planeFromWorld(before.axes.worldFromPlane(p)); });
        const auto now = linesOf(after, rowOfIs_, [](PlanePoint p) { return p; });
        std::vector<drawing::RevisionLines> changed(rows_.size());
        for (std::size_t r = 0; r < rows_.size(); ++r) {
            for (const Line& line : now[r]) addMissingParts(line, old[r], states_.options.tolerance, changed[r].added);
            for (const Line& line : old[r])
                addMissingParts(line, now[r], states_.options.tolerance, changed[r].removed);
        }
        return changed;
    }

    // Removes the marks of surfaces and spaces whose changed lines are those of components.
    void dropFollowers(std::vector<drawing::RevisionLines>& marks) const {
        std::vector<LineBox> boxes;
        for (std::size_t r = 0; r < rows_.size(); ++r) {
            if (follows_[r] != 0 || !isMarked(marks[r])) continue;
            LineBox& box = boxes.emplace_back();
            for (const auto* lines : {&marks[r].added, &marks[r].removed})
                for (const Line& line : *lines) {
                    box.add(line.from);
                    box.add(line.to);
                }
        }
        const auto isThere = [&](const Line& line) {
            return std::any_of(boxes.begin(), boxes.end(), [&](const LineBox& box) {
                return box.contains(line.from, kBeside) && box.contains(line.to, kBeside);
            });
        };
        for (std::size_t r = 0; r < rows_.size(); ++r) {
            if (follows_[r] == 0) continue;
            const auto areThere = [&](const std::vector<Line>& lines) {
                return std::all_of(lines.begin(), lines.end(), isThere);
            };
            if (areThere(marks[r].added) && areThere(marks[r].removed)) marks[r] = {};
        }
    }

    std::vector<drawing::Revision> number(const std::vector<char>& isShown) {
        const std::vector<std::uint32_t> wasStoreys = drawing::storeysOfLabels(states_.was.labels),
                                         isStoreys = drawing::storeysOfLabels(states_.is.labels);
        std::vector<drawing::Revision> revisions;
        numberOf_.assign(rows_.size(), 0);
        for (const bool shown : {true, false})
            for (std::size_t r = 0; r < rows_.size(); ++r) {
                if ((isShown[r] != 0) != shown || (!shown && follows_[r] != 0)) continue;
                const ComparisonRow& row = states_.comparison.rows[rows_[r]];
                drawing::Revision revision;
                if (shown) revision.number = numberOf_[r] = std::uint32_t(revisions.size() + 1);
                const volume::Label& label = subject(row);
                revision.change = nameOf(row.change);
                revision.object = label.name.empty() ? label.id : label.name;
                if (const std::size_t count = std::max(row.was.size(), row.is.size()); count > 1)
                    revision.object += fmt::format(" +{}", count - 1);
                revision.className = label.className;
                const auto& table = row.is.empty() ? states_.was.labels : states_.is.labels;
                const std::uint32_t storey = row.is.empty() ? wasStoreys[row.was.front()] : isStoreys[row.is.front()];
                if (storey != volume::kNoLabel)
                    revision.storey =
                        table.labels[storey].name.empty() ? table.labels[storey].id : table.labels[storey].name;
                revision.added = row.added;
                revision.removed = row.removed;
                revisions.push_back(std::move(revision));
            }
        return revisions;
    }

    const Compared& states_;
    std::vector<std::uint32_t> rows_;                // numbers of Comparison::rows
    std::vector<std::uint32_t> rowOfWas_, rowOfIs_;  // by label: index into rows_
    std::vector<char> follows_;                      // by index into rows_
    std::vector<std::uint32_t> numberOf_;            // by index into rows_; 0: not shown
};

}  // namespace

std::vector<drawing::Revision> markRevisions(const Compared& states, std::span<const SectionDrawing> before,
                                             std::span<SectionDrawing* const> drawings) {
    return Marker(states).run(before, drawings);
}

}  // namespace svt::compare
