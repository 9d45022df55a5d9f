#include <svt/illustrate/sheet_set.hpp>

#include <svt/record/record.hpp>

#include <fmt/format.h>

namespace svt::illustrate {

using record::Choice, record::FormatName, record::FormatVersion, record::Member, record::member, record::memberAs,
    record::memberOf, record::Members;

Members<SetView> membersOf(const SetView*) noexcept {
    static constexpr Member<SetView> kMembers[] = {
        member<&SetView::plan>(
            {.name = "plan",
             .value = "PLANE",
             .help = "horizontal plane, such as storey=EG+1.1 or z=1.2; metres from the lower corner of the grid"}),
        member<&SetView::section>(
            {.name = "section",
             .value = "PLANE",
             .help = "upright plane, such as x>4 (looks to smaller x), y<3 (to larger y) or A,B,C,D"}),
        memberAs<Choice, &SetView::elevation>(
            {.name = "elevation", .choices = "north|east|south|west", .help = "the outside from that side"}),
        member<&SetView::name>(
            {.name = "name",
             .help = "of a plan that of its storey, of a section its letter, which plans have at their marks"}),
        member<&SetView::hidden>({.name = "hidden", .help = "also edges that are hidden, dashed"}),
    };
    return kMembers;
}

void checkMembers(record::Faults& faults, const std::string& path, const SetView& view) {
    if (int(!view.plan.empty()) + int(!view.section.empty()) + int(!view.elevation.empty()) != 1)
        faults.add(path, "needs one of plan, section and elevation");
}

Members<SetSheet> membersOf(const SetSheet*) noexcept {
    static constexpr Member<SetSheet> kMembers[] = {
        member<&SetSheet::title>({.name = "title", .otherwise = "by its views", .help = "in the title block"}),
        member<&SetSheet::scale>({.name = "scale",
                                  .least = 0.01,
                                  .most = 1e7,
                                  .otherwise = "that of all",
                                  .help = "scale of the views of this sheet"}),
        member<&SetSheet::views>({.name = "views",
                                  .least = 1,
                                  .most = 1000,
                                  .help = "each is a plan, a section or an elevation",
                                  .isRequired = true}),
    };
    return kMembers;
}

Members<SheetSet> membersOf(const SheetSet*) noexcept {
    static constexpr Member<SheetSet> kMembers[] = {
        memberOf<SheetSet, FormatName<SheetSet>>({.name = "format",
                                                  .choices = "svt-sheets",
                                                  .help = "says that this is a set of sheets",
                                                  .isRequired = true}),
        memberOf<SheetSet, FormatVersion<SheetSet>>(
            {.name = "version", .least = 1, .most = 1, .help = "version of the format"}),
        member<&SheetSet::title>({.name = "title",
                                  .otherwise = "the name of the model",
                                  .help = "name of the building, in the title block"}),
        memberAs<Choice, &SheetSet::paper>(
            {.name = "paper", .choices = "A4|A3|A2|A1|A0", .help = "size of the sheets, landscape"}),
        memberAs<Choice, &SheetSet::language>(
            {.name = "language", .choices = "en|de", .help = "of the words on sheets"}),
        member<&SheetSet::scale>({.name = "scale",
                                  .least = 0.01,
                                  .most = 1e7,
                                  .otherwise = "100, or the next of 200, 500, ... at which all views fit",
                                  .help = "scale of all views: 50 draws 1 m as 20 mm"}),
        member<&SheetSet::dimensions>({.name = "dimensions", .help = "chains of dimensions around plans"}),
        member<&SheetSet::above>({.name = "above", .help = "plans show what is above the cut"}),
        member<&SheetSet::tables>(
            {.name = "tables", .help = "tables of rooms, floor areas and components, after the views"}),
        member<&SheetSet::hide>({.name = "hide", .value = "QUERY", .help = "leave out what the query selects"}),
        member<&SheetSet::sheets>({.name = "sheets",
                                   .least = 1,
                                   .most = 1000,
                                   .help = "each with its views; where they do not fit, they go on to another sheet",
                                   .isRequired = true}),
    };
    return kMembers;
}

std::span<const Option> sheetMembers() noexcept { return record::declared<SheetSet>(); }

Result<SheetSet> parseSheetSet(std::string_view text, const std::string& name) {
    return record::parseRecord<SheetSet>(text, name, Code::BadSheets);
}

std::string writeSheetSet(const SheetSet& set) { return record::recordText(set); }

}  // namespace svt::illustrate
