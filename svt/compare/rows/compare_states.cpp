#include <svt/compare/compare_states.hpp>
#include <svt/compare/difference_volume.hpp>

#include <optional>
#include <utility>

namespace svt::compare {
namespace {

Result<void> align(ComparedStates& states, const StateSource& source) {
    const std::optional<Vec3d> offset = estimateTranslation(states.was, states.is, states.options.tolerance);
    if (!offset || length(*offset) <= states.options.tolerance) {
        states.alignment = offset ? Alignment::Aligned : Alignment::NotFound;
        return {};
    }
    if (!source.isVolume) {
        const volume::Grid& grid = states.was.grid;
        SVT_TRY(shifted,
                volume::Grid::fromParts(grid.dimension(), grid.spacing(), grid.origin() + *offset, grid.axes()));
        SVT_TRY(again, source.read(&*shifted));
        states.is = std::move(*again);
    }
    SVT_TRY(moved, translated(states.is, -*offset));
    states.is = std::move(*moved);
    states.shift = -*offset;
    states.alignment = Alignment::Moved;
    return {};
}

}  // namespace

Result<ComparedStates> compareStates(const StateSource& was, const StateSource& is, bool isAligned,
                                     const CompareOptions& options) {
    const bool isNewFirst = is.isVolume && !was.isVolume;
    SVT_TRY(one, (isNewFirst ? is : was).read(nullptr));
    SVT_TRY(other, (isNewFirst ? was : is).read(&one->grid));
    if (isNewFirst) std::swap(*one, *other);
    ComparedStates states{std::move(*one), std::move(*other), {}, options};
    if (isAligned) SVT_DO(align(states, is));
    SVT_TRY(comparison, compareVolumes(states.was, states.is, options));
    states.comparison = std::move(*comparison);
    states.options.progress = nullptr;
    return states;
}

}  // namespace svt::compare
