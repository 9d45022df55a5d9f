#include <svt/drawing/sheet_set.hpp>

#include <svt/record/record.hpp>

#include <fmt/format.h>

namespace svt::drawing {

using record::Choice, record::FormatName, record::FormatVersion, record::Member, record::member, record::memberAs,
    record::memberOf, record::Members;

Members<SetView> membersOf(const SetView*) noexcept {
    static constexpr Member<SetView> kMembers[] = {
        member<&SetView::plan>(
            "plan", "horizontal plane, such as storey=EG+1.1 or z=1.2; metres from the lower corner of the grid",
            {.value = "PLANE"}),
        member<&SetView::section>("section",
                                  "upright plane, such as x>4 (looks to smaller x), y<3 (to larger y) or A,B,C,D",
                                  {.value = "PLANE"}),
        memberAs<Choice, &SetView::elevation>(
            "elevation", "the outside from that side",
            {.choices = "north|north-east|east|south-east|south|south-west|west|north-west"}),
        member<&SetView::name>(
            "name", "of a plan that of its storey, of a section its letter, which plans have at their marks"),
        member<&SetView::hidden>("hidden", "also edges that are hidden, dashed"),
    };
    return kMembers;
}

void checkMembers(record::Faults& faults, const std::string& path, const SetView& view) {
    if (int(!view.plan.empty()) + int(!view.section.empty()) + int(!view.elevation.empty()) != 1)
        faults.add(path, "needs one of plan, section and elevation");
}

Members<SetSheet> membersOf(const SetSheet*) noexcept {
    static constexpr Member<SetSheet> kMembers[] = {
        member<&SetSheet::title>("title", "in the title block", {.otherwise = "by its views"}),
        member<&SetSheet::scale>("scale", "scale of the views of this sheet",
                                 {.least = 0.01, .most = 1e7, .otherwise = "that of all"}),
        member<&SetSheet::views>("views", "each is a plan, a section or an elevation",
                                 {.least = 1, .most = 1000, .isRequired = true}),
    };
    return kMembers;
}

Members<TitleBlock> membersOf(const TitleBlock*) noexcept {
    static constexpr Member<TitleBlock> kMembers[] = {
        member<&TitleBlock::number>("number", "number of the drawings; each sheet adds its own"),
        member<&TitleBlock::creator>("creator", "person who made the drawings"),
        member<&TitleBlock::approver>("approver", "person who approved the drawings"),
        member<&TitleBlock::owner>("owner", "legal owner of the drawings"),
        member<&TitleBlock::date>("date", "date of issue"),
        member<&TitleBlock::revision>("revision", "index of the revision"),
        member<&TitleBlock::documentType>("documentType", "type of the document", {.otherwise = "by its views"}),
    };
    return kMembers;
}

Members<SheetSet> membersOf(const SheetSet*) noexcept {
    static constexpr Member<SheetSet> kMembers[] = {
        memberOf<SheetSet, FormatName<SheetSet>>("format", "says that this is a set of sheets",
                                                 {.choices = "svt-sheets", .isRequired = true}),
        memberOf<SheetSet, FormatVersion<SheetSet>>("version", "version of the format", {.least = 1, .most = 1}),
        member<&SheetSet::title>("title", "name of the building, in the title block",
                                 {.otherwise = "the name of the model"}),
        memberAs<Choice, &SheetSet::paper>(
            "paper", "size of the sheets, landscape",
            {.choices = "A4|A3|A2|A1|A0", .otherwise = "A3; with a scale, the smallest on which all views fit"}),
        member<&SheetSet::titleBlock>("titleBlock", "fields of the title block"),
        memberAs<Choice, &SheetSet::language>("language", "of the words on sheets", {.choices = "en|de"}),
        member<&SheetSet::scale>(
            "scale", "scale of all views: 50 draws 1 m as 20 mm",
            {.least = 0.01, .most = 1e7, .otherwise = "100, or the next of 200, 500, ... at which all views fit"}),
        member<&SheetSet::dimensions>("dimensions", "dimensions of plans and sections"),
        member<&SheetSet::dimensionUnit>("dimensionUnit",
                                         "unit of dimensions; m-cm is metres from 1 m, and centimetres below it"),
        member<&SheetSet::above>("above", "plans show what is above the cut"),
        member<&SheetSet::tables>("tables", "tables of rooms, floor areas and components, after the views"),
        member<&SheetSet::hide>("hide", "leave out what the query selects", {.value = "QUERY"}),
        member<&SheetSet::sheets>("sheets", "each with its views; where they do not fit, they go on to another sheet",
                                  {.least = 1, .most = 1000, .isRequired = true}),
    };
    return kMembers;
}

std::span<const Option> sheetMembers() noexcept { return record::declared<SheetSet>(); }

Result<SheetSet> parseSheetSet(std::string_view text, const std::string& name) {
    return record::parseRecord<SheetSet>(text, name, Code::BadSheets);
}

std::string writeSheetSet(const SheetSet& set) { return record::recordText(set); }

}  // namespace svt::drawing
