#include <svt/fields/sampler/lattice_axes.hpp>

#include <svt/fields/check_field.hpp>

namespace svt::fields {
namespace {

// Rounding of the ends must not exclude a point on them.
constexpr double kEndSlack = 1e-6;

LatticeAxis makeAxis(const Lattice& lattice, int axis) {
    LatticeAxis made;
    made.size = lattice.size[axis];
    made.first = lattice.first[axis];
    made.step = lattice.step[axis];
    made.inverseStep = 1 / made.step;
    made.positions = lattice.positions[static_cast<std::size_t>(axis)];
    const std::int32_t last = made.size - 1;
    double before = made.step / 2, behind = made.step / 2;
    if (!made.positions.empty() && made.size > 1) {
        before = (made.at(1) - made.at(0)) / 2;
        behind = (made.at(last) - made.at(last - 1)) / 2;
    }
    made.low = made.at(0) - before - kEndSlack;
    made.high = made.at(last) + behind + kEndSlack;
    made.voxelOf.reserve(std::size_t(made.size));
    for (std::int32_t n = 0; n < made.size; ++n) made.voxelOf.push_back(voxelAt(made.at(n)));
    made.lowest = voxelAt(made.low + 2 * kEndSlack);
    made.highest = voxelAt(made.high - 2 * kEndSlack);
    return made;
}

double longestStep(const LatticeAxis& axis) {
    if (axis.positions.empty() || axis.size == 1) return axis.step;
    double longest = 0;
    for (std::int32_t n = 1; n < axis.size; ++n) longest = std::max(longest, axis.at(n) - axis.at(n - 1));
    return longest;
}

}  // namespace

Result<LatticeAxes> LatticeAxes::make(const Lattice& lattice) {
    SVT_DO(checkLattice(lattice));
    LatticeAxes made;
    made.largestCell = 1;
    for (int axis = 0; axis < 3; ++axis) {
        LatticeAxis& one = made.axes[std::size_t(axis)];
        one = makeAxis(lattice, axis);
        made.isFine = made.isFine && longestStep(one) <= 1 + kEndSlack;
        std::int64_t longest = 0;
        for (std::int32_t c = 0; c < one.cells(); ++c)
            longest = std::max(longest, std::int64_t{one.highVoxel(c)} - one.lowVoxel(c) + 1);
        // Places are below 2^30, so three factors could exceed 64 bits.
        made.largestCell =
            made.largestCell > (std::uint64_t{1} << 31) ? made.largestCell : made.largestCell * std::uint64_t(longest);
    }
    return made;
}

}  // namespace svt::fields
