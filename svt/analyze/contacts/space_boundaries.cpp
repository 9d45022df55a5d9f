#include <svt/analyze/space_boundaries.hpp>

#include <svt/model/classes.hpp>

#include <algorithm>
#include <map>
#include <tuple>

namespace svt::analyze {
namespace {

using volume::kNoLabel;
using volume::Run;

struct Sums {
    std::uint64_t faces = 0;
    std::vector<std::uint64_t> samples;  // of each layer, over all lines
};

// Counts lines by the labels on their way. Key: a, b, axis, then the labels from a to b.
class PathCounter {
public:
    void add(std::uint32_t from, std::uint32_t to, int axis,
             const std::vector<std::pair<std::uint32_t, std::int32_t>>& layers) {
        if (from == to) return;
        key_.assign({std::min(from, to), std::max(from, to), static_cast<std::uint32_t>(axis)});
        for (const auto& layer : layers) key_.push_back(layer.first);
        const bool isReversed = from > to;
        if (isReversed) std::reverse(key_.begin() + 3, key_.end());
        // Neighbouring lines mostly lead through the same labels.
        if (last_ == paths_.end() || last_->first != key_) last_ = paths_.try_emplace(key_).first;
        Sums& sums = last_->second;
        sums.samples.resize(layers.size());
        ++sums.faces;
        for (std::size_t l = 0; l < layers.size(); ++l)
            sums.samples[isReversed ? layers.size() - 1 - l : l] += static_cast<std::uint64_t>(layers[l].second);
    }

    [[nodiscard]] std::vector<SpaceBoundary> result(Vec3d spacing) const {
        std::vector<SpaceBoundary> boundaries;
        for (const auto& [key, sums] : paths_) {
            SpaceBoundary& boundary = boundaries.emplace_back();
            boundary.a = key[0];
            boundary.b = key[1];
            boundary.axis = static_cast<int>(key[2]);
            const double step = spacing[boundary.axis];
            boundary.area = double(sums.faces) * spacing.x * spacing.y * spacing.z / step;
            for (std::size_t l = 0; l < sums.samples.size(); ++l)
                boundary.layers.push_back({key[3 + l], double(sums.samples[l]) / double(sums.faces) * step});
        }
        return boundaries;
    }

private:
    using Paths = std::map<std::vector<std::uint32_t>, Sums>;
    Paths paths_;
    Paths::iterator last_ = paths_.end();
    std::vector<std::uint32_t> key_;
};

// A line of samples, as far as it was followed: the last space that it left, and the labels since then.
class Line {
public:
    // From `position` on the line is in `label`, which belongs to `space`.
    void enter(std::uint32_t label, std::uint32_t space, bool isOpen, std::int32_t position, int axis,
               PathCounter& paths) {
        if (isOpen_ && isOpen && space_ == space) return;
        if (!isOpen_ && position > begin_) layers_.emplace_back(label_, position - begin_);
        if (isOpen) {
            paths.add(from_, space, axis, layers_);
            layers_.clear();
            from_ = space;
        }
        label_ = label;
        space_ = space;
        isOpen_ = isOpen;
        begin_ = position;
    }

private:
    std::uint32_t from_ = kNoLabel;
    std::vector<std::pair<std::uint32_t, std::int32_t>> layers_;  // label, samples
    std::uint32_t label_ = kNoLabel, space_ = kNoLabel;           // current ones
    bool isOpen_ = true;
    std::int32_t begin_ = 0;
};

class BoundaryFinder {
public:
    BoundaryFinder(const volume::ColumnVolume& columns, const volume::LabelTable& labels)
        : columns_(columns),
          size_(columns.dimension()),
          labelOfScalar_(labels.labelOfScalar()),
          spaces_(spacesOfLabels(labels)) {}

    void alongZ() {
        for (std::int32_t j = 0; j < size_.y; ++j)
            for (std::int32_t i = 0; i < size_.x; ++i) {
                Line line;
                std::uint32_t begin = 0;
                for (const Run& run : columns_.column(i, j)) {
                    enter(line, labelOfScalar_[run.scalar], static_cast<std::int32_t>(begin), 2);
                    begin = run.end;
                }
                enter(line, kNoLabel, size_.z, 2);
            }
    }

    // Along x for each row, or along y for each column of the plan: one line for each height.
    void across(int axis) {
        const std::int32_t count = size_[axis], others = size_[1 - axis];
        std::vector<Line> lines;
        const std::vector<Run> nothing{{static_cast<std::uint32_t>(size_.z), 0}};
        for (std::int32_t other = 0; other < others; ++other) {
            lines.assign(static_cast<std::size_t>(size_.z), Line());
            std::span<const Run> before = nothing;
            for (std::int32_t at = 0; at < count; ++at) {
                const auto runs = axis == 0 ? columns_.column(at, other) : columns_.column(other, at);
                if (runs.data() != before.data()) enterChanged(lines, before, runs, at, axis);
                before = runs;
            }
            enterChanged(lines, before, nothing, count, axis);
        }
    }

    PathCounter paths;

private:
    void enter(Line& line, std::uint32_t label, std::int32_t position, int axis) {
        const std::uint32_t space = label == kNoLabel ? kNoLabel : spaces_[label];
        line.enter(label, space, label == kNoLabel || space != kNoLabel, position, axis, paths);
    }

    void enterChanged(std::vector<Line>& lines, std::span<const Run> before, std::span<const Run> after,
                      std::int32_t position, int axis) {
        std::size_t b = 0, a = 0;
        for (std::uint32_t z = 0; z < static_cast<std::uint32_t>(size_.z);) {
            const std::uint32_t end = std::min(before[b].end, after[a].end);
            const std::uint32_t label = labelOfScalar_[after[a].scalar];
            if (labelOfScalar_[before[b].scalar] != label)
                for (std::uint32_t k = z; k < end; ++k) enter(lines[k], label, position, axis);
            z = end;
            if (before[b].end == end) ++b;
            if (after[a].end == end) ++a;
        }
    }

    const volume::ColumnVolume& columns_;
    Vec3i size_;
    std::vector<std::uint32_t> labelOfScalar_, spaces_;
};

}  // namespace

std::vector<std::uint32_t> spacesOfLabels(const volume::LabelTable& labels) {
    std::vector<std::uint32_t> spaces(labels.labels.size(), kNoLabel);
    // Parents come before their children.
    for (std::uint32_t l = 0; l < spaces.size(); ++l) {
        const volume::Label& label = labels.labels[l];
        if (model::isSpace(label.className)) {
            spaces[l] = l;
            continue;
        }
        const model::ClassRank rank = model::classRank(label.className);
        const bool isSheet = model::isBoundarySurface(label.className) && label.filling != volume::Filling::Body;
        const bool isPartOfRoom =
            isSheet || rank == model::ClassRank::Furniture || rank == model::ClassRank::Installation;
        if (!isPartOfRoom || label.parent == kNoLabel) continue;
        const std::uint32_t space = spaces[label.parent];
        if (space == kNoLabel) continue;
        const model::ClassRank ofSpace = model::classRank(labels.labels[space].className);
        if (ofSpace == model::ClassRank::Room || ofSpace == model::ClassRank::Unit) spaces[l] = space;
    }
    return spaces;
}

std::vector<SpaceBoundary> findSpaceBoundaries(const volume::ColumnVolume& columns, const volume::Grid& grid,
                                               const volume::LabelTable& labels) {
    BoundaryFinder finder(columns, labels);
    finder.across(0);
    finder.across(1);
    finder.alongZ();
    return finder.paths.result(grid.spacing());
}

}  // namespace svt::analyze
