#include <svt/field_readers/common/placement.hpp>

#include <svt/core/text.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace svt::field_readers {
namespace {

// An angle of 1.4e-5: 1.4 mm in 100 m.
constexpr double kParallel = 1 - 1e-10;
// Coordinates of FDS have five decimals.
constexpr double kEvenSlack = 1e-3;

// Sets the nodes of one axis: a first node and a step if they are evenly spaced.
void setAxis(std::vector<double> index, int axis, fields::Lattice& lattice, bool& isEven) {
    const auto n = index.size();
    lattice.size[axis] = static_cast<std::int32_t>(n);
    lattice.first[axis] = index.front();
    lattice.step[axis] = n == 1 ? 1 : (index.back() - index.front()) / static_cast<double>(n - 1);
    for (std::size_t i = 0; i < n; ++i)
        if (std::abs(index[i] - lattice.first[axis] - static_cast<double>(i) * lattice.step[axis]) >
            kEvenSlack * lattice.step[axis])
            isEven = false;
    lattice.positions[static_cast<std::size_t>(axis)] = std::move(index);
}

// Removes "(x, y, z)" from the front of a text.
bool takeVector(std::string_view& text, Vec3d& to) {
    for (int axis = 0; axis < 3; ++axis) {
        const std::size_t begin = text.find_first_not_of(axis == 0 ? " (" : " ,");
        if (begin == std::string_view::npos) return false;
        text.remove_prefix(begin);
        const auto number = takeNumber(text);
        if (!number) return false;
        to[axis] = *number;
    }
    if (!text.starts_with(')')) return false;
    text.remove_prefix(1);
    return true;
}

bool takeWord(std::string_view& text, std::string_view word) {
    if (!text.starts_with(word)) return false;
    text.remove_prefix(word.size());
    return true;
}

}  // namespace

std::optional<Frame> frameOfComment(std::string_view comment) {
    constexpr std::string_view kMark = "Metres from ";
    const std::size_t at = comment.find(kMark);
    if (at == std::string_view::npos) return std::nullopt;
    std::string_view text = comment.substr(at + kMark.size());
    Frame frame;
    if (!takeVector(text, frame.origin) || !takeWord(text, " along ") || !takeVector(text, frame.axes[0]) ||
        !takeWord(text, " and ") || !takeVector(text, frame.axes[1]))
        return std::nullopt;
    const auto isUnit = [](Vec3d v) { return std::abs(length(v) - 1) < 1e-6; };
    if (!isUnit(frame.axes[0]) || !isUnit(frame.axes[1]) || std::abs(dot(frame.axes[0], frame.axes[1])) > 1e-6)
        return std::nullopt;
    frame.axes[2] = cross(frame.axes[0], frame.axes[1]);
    return frame;
}

Result<PlacedLattice> placeLattice(const NodePlaces& places, const Frame& frame, const volume::Grid& grid) {
    PlacedLattice placed;
    bool isEven = true;
    for (std::size_t g = 0; g < 3; ++g) {
        const Vec3d gridAxis = grid.axes()[g];
        std::size_t f = 0;
        for (std::size_t a = 1; a < 3; ++a)
            if (std::abs(dot(gridAxis, frame.axes[a])) > std::abs(dot(gridAxis, frame.axes[f]))) f = a;
        const double cosine = dot(gridAxis, frame.axes[f]);
        if (std::abs(cosine) < kParallel)
            return Error(
                Code::BadArgument,
                fmt::format("the axes of the file are turned by {:.3g} degrees against the grid of the volume; "
                            "build the volume with --axes world, or along the axes of the file",
                            std::acos(std::min(1.0, std::abs(cosine))) * 180 / std::numbers::pi));
        placed.fileAxis[g] = static_cast<int>(f);
        placed.isReversed[g] = cosine < 0;
        const int axis = static_cast<int>(g);
        const double origin = dot(gridAxis, frame.origin - grid.origin());
        std::vector<double> index(places[f].size());
        for (std::size_t i = 0; i < index.size(); ++i)
            index[i] = (origin + (cosine < 0 ? -places[f][index.size() - 1 - i] : places[f][i])) / grid.spacing()[axis];
        setAxis(std::move(index), axis, placed.lattice, isEven);
    }
    if (isEven) placed.lattice.positions = {};
    if (!isEven) {
        placed.lattice.first = {};
        placed.lattice.step = {1, 1, 1};
    }
    return placed;
}

void reorder(const PlacedLattice& placed, const Vec3i& fileSize, std::vector<float>& values) {
    if (placed.isSame() || values.empty()) return;
    const auto extent = [&](int axis) { return static_cast<std::size_t>(fileSize[axis]); };
    const std::array<std::size_t, 3> strides{1, extent(0), extent(0) * extent(1)};
    const std::size_t nodes = strides[2] * extent(2);
    const Vec3i size = placed.lattice.size;
    std::vector<float> frame(nodes);
    for (std::size_t begin = 0; begin + nodes <= values.size(); begin += nodes) {
        std::size_t at = 0;
        const auto step = [&](std::size_t g, std::int32_t i) {
            const auto n = placed.isReversed[g] ? size[static_cast<int>(g)] - 1 - i : i;
            return static_cast<std::size_t>(n) * strides[static_cast<std::size_t>(placed.fileAxis[g])];
        };
        for (std::int32_t k = 0; k < size.z; ++k)
            for (std::int32_t j = 0; j < size.y; ++j)
                for (std::int32_t i = 0; i < size.x; ++i)
                    frame[at++] = values[begin + step(0, i) + step(1, j) + step(2, k)];
        std::copy(frame.begin(), frame.end(), values.begin() + static_cast<std::ptrdiff_t>(begin));
    }
}

Box3d boxOf(const fields::Lattice& lattice) noexcept {
    Box3d box;
    Vec3d last;
    Vec3d first = lattice.first;
    for (int axis = 0; axis < 3; ++axis) {
        const auto& positions = lattice.positions[static_cast<std::size_t>(axis)];
        if (!positions.empty()) {
            first[axis] = positions.front();
            last[axis] = positions.back();
        } else {
            last[axis] = first[axis] + lattice.step[axis] * (lattice.size[axis] - 1);
        }
    }
    box.add(first);
    box.add(last);
    return box;
}

Box3d boxOf(const volume::Grid& grid) noexcept {
    return {{-0.5, -0.5, -0.5}, toDouble(grid.dimension()) - Vec3d{0.5, 0.5, 0.5}};
}

Box3d worldBox(const Box3d& index, const volume::Grid& grid) noexcept {
    Box3d box;
    for (int corner = 0; corner < 8; ++corner)
        box.add(grid.worldFromIndex({(corner & 1) != 0 ? index.max.x : index.min.x,
                                     (corner & 2) != 0 ? index.max.y : index.min.y,
                                     (corner & 4) != 0 ? index.max.z : index.min.z}));
    return box;
}

std::string boxText(const Box3d& box) {
    return fmt::format("({:.3f}, {:.3f}, {:.3f}) to ({:.3f}, {:.3f}, {:.3f})", box.min.x, box.min.y, box.min.z,
                       box.max.x, box.max.y, box.max.z);
}

Error outsideError(std::string_view name, const Box3d& field, const Reading& reading, std::string_view remedy) {
    const volume::Grid& grid = reading.volume.grid;
    return Error(Code::FieldOutside,
                 fmt::format("'{}' lies outside of the volume: it covers {}, and the volume {} (metres, world space); "
                             "{}",
                             name, boxText(worldBox(field, grid)), boxText(worldBox(boxOf(grid), grid)), remedy),
                 {reading.path.string(), 0, 0, {}});
}

}  // namespace svt::field_readers
