#include <svt/fields/field_statistics.hpp>

#include <svt/analyze/extents.hpp>
#include <svt/analyze/selection.hpp>
#include <svt/core/parallel.hpp>
#include <svt/fields/field_sampler.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace svt::fields {
namespace {

using volume::kNoLabel;
using volume::SemanticVolume;

// The value of a voxel for the statistic.
class VoxelValues {
public:
    VoxelValues(const FieldSampler& sampler, const FieldHead& head, std::int32_t component)
        : sampler_(sampler), components_(head.components), component_(component) {}

    [[nodiscard]] double at(Vec3i voxel, std::size_t time) const noexcept {
        const Vec3d place = toDouble(voxel);
        if (component_ != StatisticsOptions::kMagnitude) return double{sampler_.at(place, time, component_)};
        double squares = 0;
        for (std::int32_t c = 0; c < components_; ++c) {
            const auto value = double{sampler_.at(place, time, c)};
            squares += value * value;
        }
        return std::sqrt(squares);
    }

private:
    const FieldSampler& sampler_;
    std::int32_t components_, component_;
};

// Adds the voxels of the columns of some rows.
class RowSummer {
public:
    RowSummer(const SemanticVolume& volume, const std::vector<char>& isMedium, const VoxelValues& values)
        : volume_(volume), isMedium_(isMedium), values_(values), labelOfScalar_(volume.labels.labelOfScalar()) {}

    void add(std::int32_t j, std::size_t time, const FieldStatistics& to, std::span<FieldSums> sums) const {
        const Vec3i n = volume_.grid.dimension();
        for (std::int32_t i = 0; i < n.x; ++i) {
            std::uint32_t begin = 0;
            for (const volume::Run& run : volume_.columns.column(i, j)) {
                const std::uint32_t label = labelOfScalar_[run.scalar];
                if (label != kNoLabel && isMedium_[run.scalar] != 0) {
                    FieldSums& own = sums[label];
                    for (std::uint32_t k = begin; k < run.end; ++k)
                        own.add(values_.at({i, j, static_cast<std::int32_t>(k)}, time), to.reference, to.options);
                }
                begin = run.end;
            }
        }
    }

private:
    const SemanticVolume& volume_;
    const std::vector<char>& isMedium_;
    const VoxelValues& values_;
    std::vector<std::uint32_t> labelOfScalar_;
};

FieldSums sumOf(const FieldStatistics& statistics, std::span<const std::uint32_t> labels, std::size_t time) {
    FieldSums sum;
    for (const std::uint32_t label : labels) sum += statistics.of(label, time);
    return sum;
}

FieldFigures figuresOf(const FieldSums& sum, const FieldStatistics& statistics, double times) {
    FieldFigures figures;
    figures.volume = double(sum.voxels) * statistics.voxelVolume / times;
    figures.missing = double(sum.missing) * statistics.voxelVolume / times;
    if (sum.voxels == 0) return figures;
    const auto count = double(sum.voxels);
    const double mean = sum.sum / count;
    figures.mean = statistics.reference + mean;
    figures.min = sum.min;
    figures.max = sum.max;
    figures.deviation = std::sqrt(std::max(0.0, sum.squares / count - mean * mean));
    if (statistics.options.over) figures.shareOver = double(sum.over) / count;
    if (statistics.options.under) figures.shareUnder = double(sum.under) / count;
    return figures;
}

// The share of a step in which a line from `from` to `to` is above `limit`.
double shareAbove(double from, double to, double limit) noexcept {
    if (from > limit && to > limit) return 1;
    if (from <= limit && to <= limit) return 0;
    const double above = std::max(from, to) - limit;
    return above / std::abs(to - from);
}

}  // namespace

void FieldSums::add(double value, double reference, const StatisticsOptions& options) noexcept {
    if (std::isnan(value)) {
        ++missing;
        return;
    }
    min = voxels == 0 ? value : std::min(min, value);
    max = voxels == 0 ? value : std::max(max, value);
    ++voxels;
    sum += value - reference;
    squares += (value - reference) * (value - reference);
    if (options.over && value > *options.over) ++over;
    if (options.under && value < *options.under) ++under;
}

FieldSums& FieldSums::operator+=(const FieldSums& other) noexcept {
    if (other.voxels > 0) {
        min = voxels == 0 ? other.min : std::min(min, other.min);
        max = voxels == 0 ? other.max : std::max(max, other.max);
    }
    voxels += other.voxels;
    missing += other.missing;
    over += other.over;
    under += other.under;
    sum += other.sum;
    squares += other.squares;
    return *this;
}

Result<FieldStatistics> sumField(const Field& field, const SemanticVolume& volume, const StatisticsOptions& options) {
    if (options.component < StatisticsOptions::kMagnitude || options.component >= field.head.components)
        return Error(Code::BadArgument, fmt::format("the field '{}' has {} components; component {} does not exist",
                                                    field.head.name, field.head.components, options.component));
    SVT_TRY(sampler, FieldSampler::make(field, volume));
    SVT_TRY(isMedium, mediumOf(field.head, volume));
    FieldStatistics statistics;
    statistics.times = field.head.times;
    statistics.voxelVolume = volume.grid.voxelVolume();
    statistics.options = options;
    if (const auto range = sampler->range())
        statistics.reference = 0.5 * (double{range->first} + double{range->second});
    statistics.labelCount = volume.labels.labels.size();
    statistics.sums.resize(statistics.labelCount * statistics.times.size());
    const VoxelValues values(*sampler, field.head, options.component);
    const RowSummer summer(volume, *isMedium, values);
    // Rows are summed in a fixed number of parts, so that the sums do not depend on the threads.
    const std::int32_t rows = volume.grid.dimension().y;
    constexpr std::size_t kMostSums = std::size_t{1} << 22;
    const std::size_t parts = std::clamp<std::size_t>(kMostSums / (statistics.labelCount + 1), 1, 16);
    std::vector<std::vector<FieldSums>> sums(parts);
    for (std::size_t time = 0; time < statistics.times.size(); ++time) {
        parallelFor(parts, 1, options.threads, [&](std::size_t begin, std::size_t end) {
            for (std::size_t p = begin; p < end; ++p) {
                sums[p].assign(statistics.labelCount, FieldSums());
                for (auto j = static_cast<std::int32_t>(p); j < rows; j += static_cast<std::int32_t>(parts))
                    summer.add(j, time, statistics, sums[p]);
            }
        });
        for (const auto& part : sums)
            for (std::size_t l = 0; l < part.size(); ++l) statistics.sums[l + statistics.labelCount * time] += part[l];
    }
    return statistics;
}

FieldFigures figuresAt(const FieldStatistics& statistics, std::span<const std::uint32_t> labels, std::size_t time) {
    return figuresOf(sumOf(statistics, labels, time), statistics, 1);
}

FieldFigures figuresOverTimes(const FieldStatistics& statistics, std::span<const std::uint32_t> labels) {
    FieldSums sum;
    for (std::size_t time = 0; time < statistics.times.size(); ++time) sum += sumOf(statistics, labels, time);
    return figuresOf(sum, statistics, double(statistics.times.size()));
}

HoursBeyond hoursBeyond(const FieldStatistics& statistics, std::span<const std::uint32_t> labels) {
    constexpr double kSecondsPerHour = 3600;
    HoursBeyond hours;
    double over = 0, under = 0;
    std::optional<double> before;
    for (std::size_t time = 0; time < statistics.times.size(); ++time) {
        const std::optional<double> mean = figuresAt(statistics, labels, time).mean;
        if (time > 0) {
            const double step = (statistics.times[time] - statistics.times[time - 1]) / kSecondsPerHour;
            (before && mean ? hours.known : hours.unknown) += step;
            if (before && mean && statistics.options.over)
                over += step * shareAbove(*before, *mean, *statistics.options.over);
            if (before && mean && statistics.options.under)
                under += step * shareAbove(-*before, -*mean, -*statistics.options.under);
        }
        before = mean;
    }
    if (hours.known > 0 && statistics.options.over) hours.over = over;
    if (hours.known > 0 && statistics.options.under) hours.under = under;
    return hours;
}

Result<std::vector<StatisticsRow>> statisticsRows(const std::string& query, const FieldHead& head,
                                                  const SemanticVolume& volume) {
    std::vector<StatisticsRow> rows;
    const auto& labels = volume.labels.labels;
    if (query.empty()) {
        SVT_TRY(isMedium, mediumOf(head, volume));
        for (std::uint32_t l = 0; l < labels.size(); ++l)
            if (labels[l].voxels > 0 && (*isMedium)[labels[l].first] != 0) rows.push_back({l, {l}});
        return rows;
    }
    SVT_TRY(selected, analyze::selectLabels(volume, query));
    const analyze::Extents extents(volume.labels);
    for (const std::uint32_t l : *selected)
        rows.push_back({l, extents.standsForParts(l) ? extents.of(l) : std::vector{l}});
    return rows;
}

}  // namespace svt::fields
