#include <svt/writers/revisions/revision_list.hpp>
#include <svt/writers/sheets/class_words.hpp>
#include <svt/writers/sheets/sheet_texts.hpp>
#include <svt/writers/sheets/title_block.hpp>

#include <algorithm>
#include <set>
#include <utility>

namespace svt::writers {
namespace {

RevisionWords revisionWords(SheetLanguage language) {
    const auto word = [&](SheetWord w) { return std::string(sheetWord(w, language)); };
    RevisionWords words{word(SheetWord::Revisions),
                        word(SheetWord::Number),
                        word(SheetWord::RevisionChange),
                        word(SheetWord::RevisionObject),
                        word(SheetWord::RevisionAdded),
                        word(SheetWord::RevisionRemoved),
                        word(SheetWord::FurtherRevisions),
                        {},
                        language == SheetLanguage::German ? ',' : '.'};
    for (const auto& [change, w] : {std::pair("moved", SheetWord::Moved), std::pair("changed", SheetWord::Changed),
                                    std::pair("split", SheetWord::Split), std::pair("merged", SheetWord::Merged),
                                    std::pair("added", SheetWord::Added), std::pair("removed", SheetWord::Removed)})
        words.changes.emplace(change, word(w));
    return words;
}

}  // namespace

SheetTable makeRevisionTable(const std::vector<drawing::Revision>& revisions, SheetLanguage language) {
    if (!kDrawsRevisions) return {};
    const RevisionWords words = revisionWords(language);
    SheetTable table{words.title,
                     {{words.number, true},
                      {words.change},
                      {words.object},
                      {std::string(sheetWord(SheetWord::Type, language))},
                      {std::string(sheetWord(SheetWord::Storey, language))},
                      {words.added, true},
                      {words.removed, true}},
                     {},
                     0};
    for (const drawing::Revision& revision : revisions) {
        const std::vector<std::string> texts = revisionTexts(revision, words);
        table.rows.push_back({texts[0], texts[1], texts[2], classWord(revision.className, language), revision.storey,
                              texts[3], texts[4]});
    }
    return table;
}

void paintRevisionList(const BlockContext& context, SheetCanvas& canvas) {
    constexpr double kFromFrame = 8;
    if (!kDrawsRevisions) return;
    std::set<std::uint32_t> shown;
    for (const PlacedView& placed : context.sheet.views)
        for (const drawing::RevisionLines& lines : context.content.views[placed.view].drawing.revisions)
            shown.insert(lines.revision.number);
    if (shown.empty() || context.layout.paper.revisions == 0) return;
    std::vector<drawing::Revision> revisions;
    for (const drawing::Revision& revision : context.content.revisions)
        if (shown.count(revision.number) != 0) revisions.push_back(revision);
    const SheetPaper& paper = context.layout.paper;
    const double left = paper.left + kFromFrame, width = paper.right - kFromFrame - left;
    const double top = paper.bottom - SheetPaper::kTitleHeight - paper.legend - paper.revisions + 1;
    const RevisionList list = makeRevisionList(revisions, left, top, width, SheetPaper::kRevisionRows,
                                               revisionWords(context.options.language));
    for (const RevisionList::Rule& rule : list.rules)
        canvas.stroke({{{rule.left, rule.y}, {rule.right, rule.y}}}, {0.18});
    for (const RevisionList::Text& text : list.texts)
        canvas.text(
            {{text.x, text.y}, RevisionList::kText, text.text, text.isEnd ? TextAnchor::End : TextAnchor::Start});
}

}  // namespace svt::writers
