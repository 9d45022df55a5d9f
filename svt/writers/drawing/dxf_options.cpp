#include <svt/record/record.hpp>
#include <svt/writers/dxf_drawing.hpp>

namespace svt::writers {

record::Members<DxfOptions> membersOf(const DxfOptions*) noexcept {
    using record::member;
    static constexpr record::Member<DxfOptions> kMembers[] = {
        member<&DxfOptions::isoLayers>("isoLayers", "DXF: names of layers after ISO 13567",
                                       {.group = "Drawing", .option = "--iso-layers", .isForProjects = true}),
        member<&DxfOptions::world>("world", "DXF: coordinates of the model's CRS; upright drawings stand in space",
                                   {.group = "Drawing", .option = "--world", .isForProjects = true}),
    };
    return kMembers;
}

}  // namespace svt::writers
