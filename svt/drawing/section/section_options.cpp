#include <svt/drawing/section_drawing.hpp>
#include <svt/record/record.hpp>

namespace svt::drawing {

record::Members<SectionOptions> membersOf(const SectionOptions*) noexcept {
    using All = SectionOptions;
    using record::member;
    static constexpr record::Member<All> kMembers[] = {
        member<&All::beyond, &BeyondOptions::visible>(
            "beyond", "also draw the visible lines behind the plane",
            {.group = "Drawing", .option = "--beyond", .isForProjects = true}),
        member<&All::beyond, &BeyondOptions::hidden>("hidden", "also draw the hidden edges behind the plane, dashed",
                                                     {.group = "Drawing", .option = "--hidden", .isForProjects = true}),
        member<&All::beyond, &BeyondOptions::above>(
            "above", "also draw the parts that are cut away, as seen from the plane, dashed and dotted",
            {.group = "Drawing", .option = "--above", .isForProjects = true}),
        member<&All::dimensions>("dimensions",
                                 "dimensions: openings, rooms and overall lengths of plans, heights of sections",
                                 {.group = "Drawing", .option = "--dimensions", .isForProjects = true}),
        member<&All::dimensionUnit>("dimensionUnit",
                                    "unit of dimensions; m-cm is metres from 1 m, and centimetres below it",
                                    {.group = "Drawing", .option = "--dimension-unit", .isForProjects = true}),
        member<&All::hide>("hide", "leave out the selection of the query",
                           {.value = "QUERY", .group = "Drawing", .option = "--hide", .isForProjects = true}),
        member<&All::show>("show", "draw only the selection of the query",
                           {.value = "QUERY", .group = "Drawing", .option = "--show", .isForProjects = true}),
        record::memberAs<record::Not, &All::spaces>(
            "noRooms", "leave out rooms, units and storeys",
            {.group = "Drawing", .option = "--no-rooms", .isForProjects = true}),
    };
    return kMembers;
}

}  // namespace svt::drawing
