#include <svt/frontend/volume_part.hpp>

#include <svt/analyze/selection.hpp>
#include <svt/record/record.hpp>
#include <svt/volume/volume_part.hpp>

#include <utility>

namespace svt::frontend {

record::Members<VolumePart> membersOf(const VolumePart*) noexcept {
    using All = VolumePart;
    static constexpr record::Member<All> kMembers[] = {
        record::member<&All::select>("--select",
                                     "only the voxels of the selected features; the rest becomes background",
                                     {.value = "QUERY", .group = "Part"}),
        record::memberAs<record::Numbers<6>, &All::box>(
            "--box", "only the samples in this box of world coordinates",
            {.value = "X0,Y0,Z0,X1,Y1,Z1", .unit = "metres", .group = "Part"}),
        record::member<&All::level>("--level",
                                    "coarser by 2^level along each axis: a cell has the label that fills most of it",
                                    {.least = 0, .most = 6, .group = "Part"}),
    };
    return kMembers;
}

Result<volume::SemanticVolume> VolumePart::of(volume::SemanticVolume volume, int threads) const {
    if (!box.empty()) {
        SVT_TRY(cropped, volume::volumeIn(volume, {{box[0], box[1], box[2]}, {box[3], box[4], box[5]}}));
        volume = std::move(*cropped);
    }
    if (!select.empty()) {
        SVT_TRY(labels, analyze::selectWithParts(volume, select));
        SVT_TRY(selected, volume::selectedVolume(volume, *labels));
        volume = std::move(*selected);
    }
    return volume::coarseVolume(volume, level, threads);
}

}  // namespace svt::frontend
