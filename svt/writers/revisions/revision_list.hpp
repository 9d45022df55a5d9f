#pragma once
/// \file
/// The revisions of a drawing as a list on paper, with their numbers.

#include <svt/drawing/section_drawing.hpp>

#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace svt::writers {

/// The words of a list of revisions.
struct RevisionWords {
    std::string title = "Revisions", number = "No.", change = "Change", object = "Object", added = "+ m\u00B3",
                removed = "\u2212 m\u00B3", further = "{} further changes";
    std::map<std::string, std::string> changes{};  ///< by Revision::change; without a word, it stands itself
    char point = '.';                              ///< of decimals
};

/// The texts of a revision: number, change, object, m3 added and removed. Unknown values have a dash.
[[nodiscard]] std::vector<std::string> revisionTexts(const drawing::Revision& revision, const RevisionWords& words);

/// Lines and texts, millimetres from the upper left corner of the sheet.
struct RevisionList {
    static constexpr double kRow = 3.6, kText = 2, kTitle = 4.5, kColumn = 110, kBetween = 6;
    struct Text {
        double x, y;  ///< on the baseline
        std::string text;
        bool isEnd = false;  ///< x is its right end
    };
    struct Rule {
        double left, right, y;
    };
    std::vector<Text> texts;
    std::vector<Rule> rules;
};

/// Rows of a list in columns of 110 mm or more.
/// \param most  rows of a column
struct RevisionListSize {
    std::size_t columns = 1, rows = 0;
    double height = 0;  ///< millimetres; 0 without revisions
};
[[nodiscard]] RevisionListSize revisionListSize(std::size_t count, double width, std::size_t most);

/// The list. If the places do not suffice, the last one states how many are left out.
[[nodiscard]] RevisionList makeRevisionList(std::span<const drawing::Revision> revisions, double left, double top,
                                            double width, std::size_t most, const RevisionWords& words = {});

}  // namespace svt::writers
