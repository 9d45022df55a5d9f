#include <svt/field_readers/fds/joined_pieces.hpp>

#include <algorithm>
#include <cmath>

namespace svt::field_readers {
namespace {

// Places are equal within this share of the smallest step; they have five decimals in a .smv.
constexpr double kSameShare = 0.01;
constexpr double kSamePlane = 1e-3;  // metres
constexpr double kMostEmpty = 4;

double smallestStep(std::span<const Piece> pieces, std::size_t axis) {
    double step = kInfinity;
    for (const Piece& piece : pieces)
        for (std::size_t n = 1; n < piece.places[axis].size(); ++n)
            step = std::min(step, piece.places[axis][n] - piece.places[axis][n - 1]);
    return step;
}

// Whether values would be interpolated across space between two meshes. Centres of cells of adjacent meshes are half a cell
// of each apart.
bool hasGap(std::span<const Piece> pieces, std::size_t axis, const Joined& joined) {
    const std::vector<double>& all = joined.places[axis];
    std::vector<char> isCovered(all.size(), 0);  // the interval behind each place
    for (std::size_t p = 0; p < pieces.size(); ++p)
        for (std::size_t n = 0; n + 1 < pieces[p].places[axis].size(); ++n) isCovered[joined.first[p][axis] + n] = 1;
    for (std::size_t n = 0; n + 1 < all.size(); ++n) {
        if (isCovered[n] != 0) continue;
        if (pieces[0].file->kind != SmvKind::CellSlice) return true;
        double most = 0;
        if (n > 0) most = all[n] - all[n - 1];
        if (n + 2 < all.size()) most = std::max(most, all[n + 2] - all[n + 1]);
        if (all[n + 1] - all[n] > (1 + 2 * kSameShare) * most) return true;
    }
    return false;
}

// Joins the places along an axis; false where they do not agree.
bool joinAxis(std::span<const Piece> pieces, std::size_t axis, Joined& joined) {
    const double step = smallestStep(pieces, axis);
    const double slack = step == kInfinity ? kSamePlane : kSameShare * step;
    std::vector<double>& all = joined.places[axis];
    for (const Piece& piece : pieces) all.insert(all.end(), piece.places[axis].begin(), piece.places[axis].end());
    std::sort(all.begin(), all.end());
    std::size_t kept = 0;
    for (const double place : all)
        if (kept == 0 || place > all[kept - 1] + slack) all[kept++] = place;
    all.resize(kept);
    for (std::size_t p = 0; p < pieces.size(); ++p) {
        const std::vector<double>& own = pieces[p].places[axis];
        if (own.size() == 1 && all.size() != 1) return false;  // planes at different places
        const auto first = std::lower_bound(all.begin(), all.end(), own.front() - 2 * slack);
        const auto begin = static_cast<std::size_t>(first - all.begin());
        for (std::size_t n = 0; n < own.size(); ++n)
            if (begin + n >= all.size() || std::abs(all[begin + n] - own[n]) > 2 * slack) return false;
        joined.first[p][axis] = begin;
    }
    return !hasGap(pieces, axis, joined);
}

}  // namespace

bool hasSameTimes(std::span<const double> a, std::span<const double> b) noexcept {
    for (std::size_t t = 0; t < std::min(a.size(), b.size()); ++t)
        if (std::abs(a[t] - b[t]) > 1e-4 * std::max(1.0, std::abs(a[t]))) return false;
    return true;
}

std::optional<Joined> joinPieces(std::span<const Piece> pieces) {
    Joined joined;
    joined.first.resize(pieces.size());
    for (std::size_t axis = 0; axis < 3; ++axis)
        if (!joinAxis(pieces, axis, joined)) return std::nullopt;
    double values = 0;
    for (const Piece& piece : pieces) {
        if (!hasSameTimes(pieces[0].list.times, piece.list.times)) return std::nullopt;
        values += double(piece.places[0].size()) * double(piece.places[1].size()) * double(piece.places[2].size());
    }
    const double nodes =
        double(joined.places[0].size()) * double(joined.places[1].size()) * double(joined.places[2].size());
    if (nodes > kMostEmpty * values) return std::nullopt;
    return joined;
}

}  // namespace svt::field_readers
