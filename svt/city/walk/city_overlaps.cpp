#include <svt/city/city_walk.hpp>

#include <svt/analyze/selection.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>

namespace svt::city {
namespace {

// A tile, and facts of its labels.
struct Tile {
    volume::SemanticVolume volume;
    std::vector<std::uint32_t> rootOf;   // by label
    std::vector<std::uint32_t> labelOf;  // by scalar
    std::vector<bool> isSelected;        // by root: it, or something below it
};

using Pairs = std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint64_t>;

// Samples that both tiles fill, by their roots.
Pairs commonSamples(const Tile& a, const Tile& b) {
    const volume::Grid &g = a.volume.grid, &h = b.volume.grid;
    Vec3i by;  // sample (0, 0, 0) of b in a
    for (int axis = 0; axis < 3; ++axis)
        by[axis] = static_cast<std::int32_t>(std::lround((h.origin()[axis] - g.origin()[axis]) / g.spacing()[axis]));
    const Vec3i n = g.dimension(), m = h.dimension();
    Pairs pairs;
    for (std::int32_t j = std::max(0, by.y); j < std::min(n.y, by.y + m.y); ++j)
        for (std::int32_t i = std::max(0, by.x); i < std::min(n.x, by.x + m.x); ++i) {
            const auto runs = a.volume.columns.column(i, j), others = b.volume.columns.column(i - by.x, j - by.y);
            std::int64_t from = 0;
            for (const volume::Run& run : runs) {
                std::int64_t low = by.z;
                for (const volume::Run& other : others) {
                    const std::int64_t high = std::int64_t{by.z} + other.end;
                    const std::int64_t common = std::min<std::int64_t>(run.end, high) - std::max(from, low);
                    if (run.scalar != 0 && other.scalar != 0 && common > 0)
                        pairs[{a.rootOf[a.labelOf[run.scalar]], b.rootOf[b.labelOf[other.scalar]]}] +=
                            static_cast<std::uint64_t>(common);
                    low = high;
                }
                from = run.end;
            }
        }
    return pairs;
}

class Overlaps {
public:
    Overlaps(const City& city, const std::string& query) : city_(city), query_(query) {}

    Result<std::vector<CityOverlap>> run(const Progress* progress) {
        SVT_TRY(entries, city_.find(0, kEverywhere));
        entries_ = std::move(*entries);
        ProgressCounter counter(progress, "tiles", entries_.size());
        for (std::size_t n = 0; n < entries_.size(); ++n) {
            if (Progress::isCancelled(progress)) return Error(Code::Cancelled, "stopped between tiles");
            SVT_DO(compare(n));
            tiles_.erase(n);
            counter.add();
        }
        return std::move(found_);
    }

private:
    static constexpr std::size_t kMostTiles = 64;

    Result<std::shared_ptr<const Tile>> tile(std::size_t n) {
        if (const auto known = tiles_.find(n); known != tiles_.end()) return known->second;
        SVT_TRY(volume, city_.read(entries_[n]));
        auto made = std::make_shared<Tile>();
        made->volume = std::move(*volume);
        const std::vector<volume::Label>& labels = made->volume.labels.labels;
        made->labelOf = made->volume.labels.labelOfScalar();
        for (std::uint32_t l = 0; l < labels.size(); ++l)
            made->rootOf.push_back(labels[l].parent == volume::kNoLabel ? l : made->rootOf[labels[l].parent]);
        made->isSelected.assign(labels.size(), false);
        std::vector<std::string> nothing;
        SVT_TRY(selected, analyze::selectLabels(analyze::LabelRows(made->volume, &nothing), query_));
        for (const std::uint32_t l : *selected) made->isSelected[made->rootOf[l]] = true;
        // The last one in the order of the curve is needed last.
        if (tiles_.size() >= kMostTiles) tiles_.erase(std::prev(tiles_.end()));
        tiles_[n] = made;
        return std::shared_ptr<const Tile>(made);
    }

    Result<void> compare(std::size_t n) {
        SVT_TRY(own, tile(n));
        Pairs within;
        for (const volume::Overlap& overlap : (*own)->volume.labels.overlaps) {
            const std::uint32_t a = (*own)->rootOf[overlap.a], b = (*own)->rootOf[overlap.b];
            if (a != b) within[{std::min(a, b), std::max(a, b)}] += overlap.voxels;
        }
        add(within, **own, **own, entries_[n].tile.toString());
        for (std::size_t other = n + 1; other < entries_.size(); ++other) {
            if (!meet(entries_[n], entries_[other])) continue;
            SVT_TRY(next, tile(other));
            add(commonSamples(**own, **next), **own, **next,
                entries_[n].tile.toString() + " " + entries_[other].tile.toString());
        }
        return {};
    }

    // Whether samples of both may lie at the same place.
    [[nodiscard]] bool meet(const IndexEntry& a, const IndexEntry& b) const {
        if (!a.hasRectangle() || !b.hasRectangle()) {
            // Cities of version 1: neighbours.
            const double s = std::ldexp(1.0, a.tile.level), t = std::ldexp(1.0, b.tile.level);
            constexpr double kReach = 100;
            return a.tile.x * s - kReach < (b.tile.x + 1) * t && b.tile.x * t < (a.tile.x + 1) * s + kReach &&
                   a.tile.y * s - kReach < (b.tile.y + 1) * t && b.tile.y * t < (a.tile.y + 1) * s + kReach;
        }
        return a.rectangle[0] < b.rectangle[2] && b.rectangle[0] < a.rectangle[2] && a.rectangle[1] < b.rectangle[3] &&
               b.rectangle[1] < a.rectangle[3];
    }

    void add(const Pairs& pairs, const Tile& a, const Tile& b, const std::string& tiles) {
        for (const auto& [pair, voxels] : pairs) {
            const auto& [first, second] = pair;
            if (!a.isSelected[first] && !b.isSelected[second]) continue;
            const volume::Label &one = a.volume.labels.labels[first], &other = b.volume.labels.labels[second];
            found_.push_back({{one.id, one.name},
                              {other.id, other.name},
                              voxels,
                              double(voxels) * a.volume.grid.voxelVolume(),
                              tiles});
        }
    }

    const City& city_;
    const std::string& query_;
    std::vector<IndexEntry> entries_;
    std::map<std::size_t, std::shared_ptr<const Tile>> tiles_;
    std::vector<CityOverlap> found_;
};

}  // namespace

Result<std::vector<CityOverlap>> cityOverlaps(const City& city, const std::string& query, const Progress* progress) {
    return Overlaps(city, query).run(progress);
}

}  // namespace svt::city
