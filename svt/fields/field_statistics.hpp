#pragma once
/// \file
/// Statistics of a field per component: mean, extremes, deviation, volume, share and hours beyond a limit. They count the voxels of
/// a label that are in the medium of the field, each with the value at its centre. So sums of labels are those of their
/// union, and a storey is the sum of its rooms.

#include <svt/core/result.hpp>
#include <svt/fields/field.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace svt::fields {

/// Limits of a statistic.
struct StatisticsOptions {
    std::optional<double> over, under;  ///< in the unit of the field; values beyond them are counted
    /// 0 .. components - 1; kMagnitude: the length of the vector
    std::int32_t component = 0;
    int threads = 0;  ///< 0: all cores; the result does not depend on it
    static constexpr std::int32_t kMagnitude = -1;
};

/// Additive sums over voxels.
struct FieldSums {
    std::uint64_t voxels = 0;   ///< in the medium, with a value
    std::uint64_t missing = 0;  ///< in the medium, without a value
    std::uint64_t over = 0, under = 0;
    double sum = 0, squares = 0;  ///< of value - FieldStatistics::reference, so that squares keep their digits
    double min = 0, max = 0;      ///< where voxels > 0

    void add(double value, double reference, const StatisticsOptions& options) noexcept;
    FieldSums& operator+=(const FieldSums& other) noexcept;
};

/// The sums of all labels at all times.
struct FieldStatistics {
    std::vector<double> times;  ///< seconds
    double voxelVolume = 0;     ///< m3
    double reference = 0;       ///< a value in the range of the field
    StatisticsOptions options;
    std::size_t labelCount = 0;
    std::vector<FieldSums> sums;  ///< label + labelCount * time; of the label's own voxels

    [[nodiscard]] const FieldSums& of(std::uint32_t label, std::size_t time) const noexcept {
        return sums[label + labelCount * time];
    }
};

/// The labels of a row of statistics.
struct StatisticsRow {
    std::uint32_t label = 0;            ///< names the row
    std::vector<std::uint32_t> labels;  ///< whose voxels count
};
/// A row per selected component; storeys and other groups stand for all their parts.
/// \param query  empty: all components with voxels in the medium of the field
/// \return the rows; or as mediumOf(), BadQuery, NothingSelected
[[nodiscard]] Result<std::vector<StatisticsRow>> statisticsRows(const std::string& query, const FieldHead& head,
                                                                const volume::SemanticVolume& volume);

/// Cost: one sample per voxel of a label and time. Memory: 64 bytes per label and time.
/// \return the sums; or as FieldSampler::make(); BadArgument for a component that does not exist
[[nodiscard]] Result<FieldStatistics> sumField(const Field& field, const volume::SemanticVolume& volume,
                                               const StatisticsOptions& options = {});

/// Statistics of some labels together. Unknown figures are empty.
struct FieldFigures {
    std::optional<double> mean, min, max;
    std::optional<double> deviation;              ///< standard deviation over the volume
    double volume = 0;                            ///< m3 with values; the mean over times where there are several
    double missing = 0;                           ///< m3 in the medium, without values
    std::optional<double> shareOver, shareUnder;  ///< of the volume with values, 0 .. 1
};

/// Figures of a set of labels at one time.
/// \param labels  each at most once
[[nodiscard]] FieldFigures figuresAt(const FieldStatistics& statistics, std::span<const std::uint32_t> labels,
                                     std::size_t time);

/// Figures of a set of labels over all times: each time counts once, whatever its distance to the others.
[[nodiscard]] FieldFigures figuresOverTimes(const FieldStatistics& statistics, std::span<const std::uint32_t> labels);

/// How long the mean of a set of labels is beyond the limits.
struct HoursBeyond {
    std::optional<double> over, under;  ///< hours; empty without the limit, or if no hours are known
    double known = 0;                   ///< hours between two times whose means are both known
    double unknown = 0;                 ///< the other hours from the first to the last time
};

/// The mean is linear between times, so the moment at which it crosses a limit is interpolated.
[[nodiscard]] HoursBeyond hoursBeyond(const FieldStatistics& statistics, std::span<const std::uint32_t> labels);

}  // namespace svt::fields
