#include <svt/writers/tiles3d/globe_patch.hpp>

#include <svt/crs/crs_name.hpp>
#include <svt/writers/tiles3d/tileset_frame.hpp>

#include <algorithm>
#include <cmath>

namespace svt::writers {
namespace {

constexpr double kCell = 256;            // metres
constexpr std::int64_t kMostCells = 16;  // along a side; larger rectangles have larger cells

// The rows of the inverse of a matrix with these columns.
std::array<Vec3d, 3> inverseOf(const std::array<Vec3d, 3>& columns) {
    const double determinant = dot(columns[0], cross(columns[1], columns[2]));
    return {cross(columns[1], columns[2]) * (1 / determinant), cross(columns[2], columns[0]) * (1 / determinant),
            cross(columns[0], columns[1]) * (1 / determinant)};
}

}  // namespace

Vec3d GlobePatch::place(Vec3d world) const noexcept {
    if (columns_ == 0) return world - first_;
    const double x = (world.x - first_.x) / cell_, y = (world.y - first_.y) / cell_;
    const auto rows = static_cast<std::int64_t>(corners_.size()) / columns_;
    const auto i = std::clamp<std::int64_t>(static_cast<std::int64_t>(std::floor(x)), 0, columns_ - 2);
    const auto j = std::clamp<std::int64_t>(static_cast<std::int64_t>(std::floor(y)), 0, rows - 2);
    const double u = x - double(i), v = y - double(j);
    const auto at = [&](std::int64_t di, std::int64_t dj) {
        const Corner& corner = corners_[static_cast<std::size_t>((j + dj) * columns_ + i + di)];
        return corner.place + corner.up * world.z;
    };
    return (at(0, 0) * (1 - u) + at(1, 0) * u) * (1 - v) + (at(0, 1) * (1 - u) + at(1, 1) * u) * v;
}

Result<std::unique_ptr<GlobeLattice>> GlobeLattice::create(const std::string& crsName, Vec3d reference,
                                                           const VolumeWriteOptions& options) {
    volume::SemanticVolume named;
    named.crsName = crsName;
    SVT_TRY(frame, frameOfVolume(named, reference, options));
    auto lattice = std::make_unique<GlobeLattice>();
    lattice->frame_ = *frame;
    lattice->inverse_ = inverseOf(frame->axes);
    lattice->reference_ = reference;
    lattice->lift_ = options.tileset.lift.value_or(0);
    lattice->epsg_ = options.tileset.place ? 0 : static_cast<int>(crs::epsgCodeOf(crsName));
    return lattice;
}

Result<GlobePatch::Corner> GlobeLattice::cornerAt(std::int64_t i, std::int64_t j) {
    {
        const std::lock_guard guard(mutex_);
        if (const auto known = corners_.find({i, j}); known != corners_.end()) return known->second;
    }
    SVT_TRY(degrees, crs::placeOnEarth(epsg_, {double(i) * kCell, double(j) * kCell, lift_}));
    const Vec3d from = crs::earthCentred(*degrees) - frame_.origin, up = crs::frameAt(*degrees).axes[2];
    const auto inFrame = [&](Vec3d v) { return Vec3d{dot(inverse_[0], v), dot(inverse_[1], v), dot(inverse_[2], v)}; };
    const GlobePatch::Corner corner{inFrame(from), inFrame(up)};
    const std::lock_guard guard(mutex_);
    corners_.emplace(std::pair(i, j), corner);
    return corner;
}

Result<GlobePatch> GlobeLattice::patch(std::array<double, 4> rectangle) {
    GlobePatch patch;
    patch.first_ = reference_;
    if (epsg_ == 0) return patch;
    const double size = std::max(rectangle[2] - rectangle[0], rectangle[3] - rectangle[1]);
    std::int64_t step = 1;
    while (size > kCell * double(step * kMostCells)) step *= 2;
    patch.cell_ = kCell * double(step);
    const auto cellOf = [&](double value) { return static_cast<std::int64_t>(std::floor(value / patch.cell_)); };
    const std::int64_t i = cellOf(rectangle[0]), j = cellOf(rectangle[1]);
    const std::int64_t endI = cellOf(rectangle[2]) + 1, endJ = cellOf(rectangle[3]) + 1;
    patch.first_ = {double(i) * patch.cell_, double(j) * patch.cell_, 0};
    patch.columns_ = endI - i + 1;
    for (std::int64_t row = j; row <= endJ; ++row)
        for (std::int64_t column = i; column <= endI; ++column) {
            SVT_TRY(corner, cornerAt(column * step, row * step));
            patch.corners_.push_back(*corner);
        }
    return patch;
}

}  // namespace svt::writers
