#include <svt/city/levels/level_builder.hpp>

#include <svt/core/parallel.hpp>
#include <svt/volume/svt_file.hpp>

#include <algorithm>

namespace svt::city {

int topDetail(const ColumnRange& whole) noexcept {
    int detail = kFirstClassDetail;
    const auto columns = [&](std::size_t axis) {
        return (whole.last[axis] >> (detail - 1)) - (whole.first[axis] >> (detail - 1)) + 1;
    };
    while (columns(0) > kLevelCells || columns(1) > kLevelCells) ++detail;
    return detail;
}

LevelBuilder::LevelBuilder(std::span<const ColumnRange> members, double spacing, std::string crsName, int threads)
    : members_(members.begin(), members.end()),
      spacing_(spacing),
      crsName_(std::move(crsName)),
      threads_(threads),
      whole_(members.front()) {
    for (const ColumnRange& member : members_) whole_.add(member);
    top_ = topDetail(whole_);
    const auto open = [&](const Key& key, const ColumnRange& below) {
        Open& own = open_[key];
        ++own.left;
        own.range ? own.range->add(below) : void(own.range = below);
    };
    for (const ColumnRange& member : members_) open(tileOf(member), member);
    // Finer details come before the ones that are made from them.
    for (int detail = kFirstClassDetail; detail < top_; ++detail)
        for (auto at = open_.lower_bound({detail, 0, {}}); at != open_.end() && at->first.detail == detail; ++at)
            open(above(at->first), *at->second.range);
}

void ColumnRange::add(const ColumnRange& other) {
    for (const std::size_t axis : {0u, 1u}) {
        first[axis] = std::min(first[axis], other.first[axis]);
        last[axis] = std::max(last[axis], other.last[axis]);
    }
}

LevelBuilder::Key LevelBuilder::tileOf(const ColumnRange& member) const {
    if (top_ == kFirstClassDetail) return above({kFirstClassDetail - 1, 0, {}});
    const TileKey tile = tileAbove(member.tile, kFirstClassDetail - 1, spacing_);
    return {kFirstClassDetail, mortonOf(tile), tile};
}

LevelBuilder::Key LevelBuilder::above(const Key& key) const {
    TileKey tile = tileAbove(key.tile, kFirstClassDetail, spacing_);
    if (key.detail + 1 == top_) {
        const auto cell = [&](std::size_t axis) {
            return static_cast<std::int32_t>(whole_.first[axis] >> (top_ - 1) >> 8);
        };
        tile = {top_ - kFirstClassDetail, cell(0), cell(1)};
    }
    return {key.detail + 1, mortonOf(tile), tile};
}

LevelSums LevelBuilder::emptySums(const Key& key) const {
    const ColumnRange& range = *open_.at(key).range;
    const int shift = key.detail - 1;
    const std::array first{range.first[0] >> shift, range.first[1] >> shift};
    return LevelSums(key.detail, first,
                     {static_cast<std::int32_t>((range.last[0] >> shift) - first[0] + 1),
                      static_cast<std::int32_t>((range.last[1] >> shift) - first[1] + 1)});
}

template <class Source>
void LevelBuilder::addTo(const Key& key, const Source& source, std::vector<Ready>& ready) {
    Open& open = open_.at(key);
    if (!open.sums) open.sums = emptySums(key);
    open.sums->add(source);
    if (--open.left != 0) return;
    ready.push_back({key, std::move(*open.sums)});
    open.sums.reset();
    if (key.detail == top_) return;
    const LevelSums own = ready.back().sums;
    addTo(above(key), own, ready);
}

Result<LevelMember> LevelBuilder::memberOf(const Ready& ready) const {
    LevelMember result;
    result.member.tile = ready.key.tile;
    result.member.detail = ready.key.detail;
    SVT_TRY(volume, ready.sums.volume(spacing_, classes_, crsName_));
    if (volume->labels.labels.empty()) return result;
    SVT_TRY(bytes, volume::svtBytes(*volume));
    result.bytes = std::move(*bytes);
    const Vec3d half = volume->grid.spacing() * 0.5;
    result.member.box.min = volume->grid.origin() - half;
    result.member.box.max =
        volume->grid.origin() + scaled(toDouble(volume->grid.dimension()), volume->grid.spacing()) - half;
    return result;
}

Result<void> LevelBuilder::add(std::span<const volume::SemanticVolume> volumes,
                               const std::function<Result<void>(LevelMember)>& give) {
    std::vector<Ready> ready;
    for (const volume::SemanticVolume& volume : volumes) {
        const LevelSource source = LevelSource::from(volume, classes_);
        addTo(tileOf(members_[next_]), source, ready);
        ++next_;
    }
    std::vector<std::optional<Result<LevelMember>>> made(ready.size());
    parallelFor(ready.size(), 1, threads_, [&](std::size_t begin, std::size_t end) {
        for (std::size_t n = begin; n < end; ++n) made[n] = memberOf(ready[n]);
    });
    for (std::size_t n = 0; n < ready.size(); ++n) {
        if (!*made[n]) return made[n]->error();
        waiting_[ready[n].key] = std::move(**made[n]);
    }
    return giveInOrder(give);
}

Result<void> LevelBuilder::giveInOrder(const std::function<Result<void>(LevelMember)>& give) {
    for (auto at = waiting_.begin(); at != waiting_.end();) {
        // All tiles before it in its detail were returned and are no longer in open_.
        const auto first = open_.lower_bound({at->first.detail, 0, {}});
        if (first->first < at->first) {
            at = waiting_.lower_bound({at->first.detail + 1, 0, {}});
            continue;
        }
        open_.erase(first);
        if (!at->second.bytes.empty()) SVT_DO(give(std::move(at->second)));
        at = waiting_.erase(at);
    }
    return {};
}

}  // namespace svt::city
