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
    for (const ColumnRange& member : members_)
        for (const std::size_t axis : {0u, 1u}) {
            whole_.first[axis] = std::min(whole_.first[axis], member.first[axis]);
            whole_.last[axis] = std::max(whole_.last[axis], member.last[axis]);
        }
    top_ = topDetail(whole_);
    for (const ColumnRange& member : members_)
        for (const Key& key : tilesOf(member)) ++open_[key].left;
    // A finer detail stands before the ones that are made of it.
    for (int detail = kFirstClassDetail; detail < top_; ++detail)
        for (auto at = open_.lower_bound({detail, 0, {}}); at != open_.end() && at->first.detail == detail; ++at)
            ++open_[above(at->first)].left;
}

std::vector<LevelBuilder::Key> LevelBuilder::tilesOf(const ColumnRange& range) const {
    std::vector<Key> keys;
    if (top_ == kFirstClassDetail) return {above({kFirstClassDetail - 1, 0, {}})};
    const auto tile = [](std::int64_t column) { return static_cast<std::int32_t>(column >> 1 >> 8); };
    for (std::int32_t y = tile(range.first[1]); y <= tile(range.last[1]); ++y)
        for (std::int32_t x = tile(range.first[0]); x <= tile(range.last[0]); ++x) {
            const TileKey key{0, x, y};
            keys.push_back({kFirstClassDetail, mortonOf(key), key});
        }
    return keys;
}

LevelBuilder::Key LevelBuilder::above(const Key& key) const {
    TileKey tile{key.tile.level + 1, key.tile.x >> 1, key.tile.y >> 1};
    if (key.detail + 1 == top_) {
        const auto cell = [&](std::size_t axis) {
            return static_cast<std::int32_t>(whole_.first[axis] >> (top_ - 1) >> 8);
        };
        tile = {top_ - kFirstClassDetail, cell(0), cell(1)};
    }
    return {key.detail + 1, mortonOf(tile), tile};
}

LevelSums LevelBuilder::emptySums(const Key& key) const {
    if (key.detail < top_)
        return LevelSums(key.detail, {std::int64_t{key.tile.x} * kLevelCells, std::int64_t{key.tile.y} * kLevelCells},
                         {kLevelCells, kLevelCells});
    const int shift = top_ - 1;
    const std::array first{whole_.first[0] >> shift, whole_.first[1] >> shift};
    return LevelSums(top_, first,
                     {static_cast<std::int32_t>((whole_.last[0] >> shift) - first[0] + 1),
                      static_cast<std::int32_t>((whole_.last[1] >> shift) - first[1] + 1)});
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
    const auto volume = ready.sums.volume(spacing_, classes_, crsName_);
    if (!volume) return volume.error();
    if (volume->labels.labels.empty()) return result;
    auto bytes = volume::svtBytes(*volume);
    if (!bytes) return bytes.error();
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
        for (const Key& key : tilesOf(members_[next_])) addTo(key, source, ready);
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
        // All before it of its detail are given away, which takes them out of open_.
        const auto first = open_.lower_bound({at->first.detail, 0, {}});
        if (first->first < at->first) {
            at = waiting_.lower_bound({at->first.detail + 1, 0, {}});
            continue;
        }
        open_.erase(first);
        if (!at->second.bytes.empty())
            if (auto given = give(std::move(at->second)); !given) return given;
        at = waiting_.erase(at);
    }
    return {};
}

}  // namespace svt::city
