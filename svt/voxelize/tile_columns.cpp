#include <svt/voxelize/tile_columns.hpp>

#include <algorithm>
#include <bit>

namespace svt::voxelize {
namespace {

std::uint32_t clampToDepth(std::int32_t k, std::int32_t depth) noexcept {
    return static_cast<std::uint32_t>(k < 0 ? 0 : k > depth ? depth : k);
}

// A crossing in one word, in the order in which the sweep meets them: depth up to 2^16, 2^31 claims.
constexpr int kDepthShift = 40;
std::uint64_t packCrossing(std::uint32_t k, std::uint32_t claim, bool isEntry) noexcept {
    return std::uint64_t(k) << kDepthShift | std::uint64_t(claim) << 1 | std::uint64_t(isEntry);
}
std::uint32_t claimOf(std::uint64_t crossing) noexcept {
    return static_cast<std::uint32_t>(crossing >> 1 & 0x7FFFFFFFu);
}

}  // namespace

void TileColumns::collectSpans(const TileInput& input) {
    for (std::int32_t row = 0; row < input.height; ++row) rows_[row].clear();
    for (const std::uint32_t index : input.triangleIndices) {
        const ScanTriangle& t = input.triangles[index];
        const bool isFlat = t.height.isFlat();
        const std::int32_t flatK = isFlat ? sampleAbove(t, t.height.base) : 0;
        scanRows(t, input.firstRow, input.firstRow + input.height, input.firstColumn, input.firstColumn + input.width,
                 [&](std::int32_t j, std::int32_t begin, std::int32_t end) {
                     const bool isEntry = t.sign > 0;
                     Span span{keyOf(t.claim, isEntry, flatK), 0, 0, 0, 0, begin - input.firstColumn,
                               end - input.firstColumn};
                     if (!isFlat) {
                         const std::int64_t base =
                             t.height.base + t.height.slopeY * j + t.height.slopeX * input.firstColumn;
                         if (t.height.slopeX == 0) {
                             span.key = keyOf(t.claim, isEntry, sampleAbove(t, base));
                         } else {
                             span.base = base;
                             span.slope = t.height.slopeX;
                             span.lowest = t.lowest;
                             span.highest = t.highest;
                         }
                     }
                     rows_[j - input.firstRow].push_back(span);
                 });
    }
    for (const ClaimedBox& box : input.boxes) {
        const std::int32_t begin = std::max(box.begin - input.firstColumn, 0);
        const std::int32_t end = std::min(box.end - input.firstColumn, input.width);
        if (begin >= end) continue;
        auto& spans = rows_[box.j - input.firstRow];
        spans.push_back({keyOf(box.claim, true, box.low), 0, 0, 0, 0, begin, end});
        spans.push_back({keyOf(box.claim, false, box.high), 0, 0, 0, 0, begin, end});
    }
}

// Joins neighbours on the same plane, so that the row reads the same however faces were triangulated.
void TileColumns::mergeSpans(std::vector<Span>& spans) {
    const auto isBefore = [](const Span& p, const Span& q) {
        if (p.key != q.key) return p.key < q.key;
        if (p.slope != q.slope) return p.slope < q.slope;
        if (p.base != q.base) return p.base < q.base;
        return p.begin != q.begin ? p.begin < q.begin : p.end < q.end;
    };
    // Triangles come in the order of claims, so short rows are nearly sorted: insertion is the faster way.
    constexpr std::size_t kShort = 64;
    if (spans.size() > kShort) {
        std::sort(spans.begin(), spans.end(), isBefore);
    } else {
        for (std::size_t s = 1; s < spans.size(); ++s) {
            if (!isBefore(spans[s], spans[s - 1])) continue;
            const Span moving = spans[s];
            std::size_t to = s;
            for (; to > 0 && isBefore(moving, spans[to - 1]); --to) spans[to] = spans[to - 1];
            spans[to] = moving;
        }
    }
    std::size_t kept = 0;
    for (std::size_t s = 1; s < spans.size(); ++s) {
        Span& last = spans[kept];
        const Span& next = spans[s];
        if (last.key == next.key && last.end == next.begin && last.slope == next.slope && last.base == next.base &&
            last.lowest == next.lowest && last.highest == next.highest)
            last.end = next.end;
        else
            spans[++kept] = next;
    }
    if (!spans.empty()) spans.resize(kept + 1);
}

void TileColumns::changeWinding(std::uint32_t claim, bool isEntry) {
    std::int32_t& winding = winding_[claim];
    if (isEntry) {
        if (++winding == 1) active_.insert(std::lower_bound(active_.begin(), active_.end(), claim), claim);
    } else if (--winding == 0) {
        active_.erase(std::lower_bound(active_.begin(), active_.end(), claim));
    }
}

// crossings_ to runs_; `columns` equal columns stand side by side.
void TileColumns::sweepColumn(const TileInput& input, std::uint64_t columns) {
    std::sort(crossings_.begin(), crossings_.end());
    runs_.clear();
    const auto depth = static_cast<std::uint32_t>(input.depth);
    std::uint32_t from = 0;
    const auto emit = [&](std::uint32_t to) {
        if (to == from) return;
        const volume::Scalar scalar = active_.empty() ? 0 : input.claims[active_.front()].scalar;
        if (!runs_.empty() && runs_.back().scalar == scalar)
            runs_.back().end = to;
        else
            runs_.push_back({to, scalar});
        for (std::size_t a = 0; a + 1 < active_.size(); ++a) {
            if (!input.claims[active_[a]].isSolid) continue;
            for (std::size_t b = a + 1; b < active_.size(); ++b)
                if (input.claims[active_[b]].isSolid)
                    rowShared_.push_back({active_[a], active_[b], (to - from) * columns});
        }
        from = to;
    };
    for (const std::uint64_t crossing : crossings_) {
        emit(static_cast<std::uint32_t>(crossing >> kDepthShift));
        changeWinding(claimOf(crossing), (crossing & 1) != 0);
    }
    emit(depth);
    for (const std::uint64_t crossing : crossings_) winding_[claimOf(crossing)] = 0;
    active_.clear();
}

// Merged spans to a row of columns.
void TileColumns::addRow(const TileInput& input, const std::vector<Span>& spans, std::vector<SharedCount>& shared) {
    const auto width = static_cast<std::size_t>(input.width);
    rowShared_.clear();
    // Bit x is set where some crossing begins, ends or changes its sample.
    std::uint64_t breaks = 1;
    heights_.clear();
    for (const Span& span : spans) {
        breaks |= std::uint64_t{1} << span.begin;
        if (span.end < 64) breaks |= std::uint64_t{1} << span.end;
        if (span.slope == 0) continue;
        const std::size_t first = heights_.size();
        heights_.resize(first + width);
        std::int64_t height = span.base + span.slope * span.begin - (std::int64_t{1} << Height::kBits);
        std::int32_t previous = 0;
        for (std::int32_t x = span.begin; x < span.end; ++x, height += span.slope) {
            const std::int64_t above = (height >> (Height::kBits + kQuantaBits)) + 1;
            const auto k = static_cast<std::int32_t>(std::clamp<std::int64_t>(above, span.lowest, span.highest));
            if (x != span.begin && k != previous) breaks |= std::uint64_t{1} << x;
            previous = heights_[first + std::size_t(x)] = k;
        }
    }
    if (input.width < 64) breaks &= (std::uint64_t{1} << input.width) - 1;

    row_.resize(width);
    while (breaks != 0) {
        const int x = std::countr_zero(breaks);
        breaks &= breaks - 1;
        const int next = breaks != 0 ? std::countr_zero(breaks) : input.width;
        crossings_.clear();
        std::size_t sloped = 0;
        for (const Span& span : spans) {
            const std::size_t heights = sloped;
            if (span.slope != 0) sloped += width;
            if (x < span.begin || x >= span.end) continue;
            const std::int32_t k = span.slope == 0 ? span.flatK() : heights_[heights + std::size_t(x)];
            crossings_.push_back(packCrossing(clampToDepth(k, input.depth), span.claim(), span.isEntry()));
        }
        sweepColumn(input, static_cast<std::uint64_t>(next - x));
        const std::uint16_t column = builder_->addColumn(runs_);
        std::fill(row_.begin() + x, row_.begin() + next, column);
    }
    builder_->addRow(row_);
    shared.insert(shared.end(), rowShared_.begin(), rowShared_.end());
}

volume::ColumnTileData TileColumns::make(const TileInput& input, std::vector<SharedCount>& shared) {
    winding_.resize(input.claims.size(), 0);  // all zero between columns
    collectSpans(input);
    volume::ColumnTileBuilder builder(input.width);
    builder_ = &builder;
    for (std::int32_t row = 0; row < input.height; ++row) {
        mergeSpans(rows_[row]);
        if (row > 0 && rows_[row] == rows_[row - 1]) {
            builder.repeatRow();
            shared.insert(shared.end(), rowShared_.begin(), rowShared_.end());
        } else {
            addRow(input, rows_[row], shared);
        }
    }
    builder_ = nullptr;
    return builder.finish();
}

}  // namespace svt::voxelize
