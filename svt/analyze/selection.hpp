#pragma once
/// \file
/// Queries on the labels of a volume: the rows that they read, the labels that they select, and the box around these.

#include <svt/analyze/extents.hpp>
#include <svt/analyze/scalar_boxes.hpp>
#include <svt/model/query.hpp>
#include <svt/volume/label_table.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace svt::analyze {

/// The labels as rows for model::Query; row i is label i. Volumes are those of the features' own solids. The rows refer
/// to `labels`, which must outlive them.
[[nodiscard]] std::vector<model::QueryRow> queryRows(const volume::LabelTable& labels);

/// queryRows() for several queries on one table: made once, when the first query needs them. Not thread-safe.
class LabelRows {
public:
    /// Implicit, so that a single query can name the table itself.
    /// \param labels   must outlive the rows, unchanged
    /// \param nothing  if given, queries that select nothing are not an error: the message of NothingSelected is added
    ///                 here, once, and the selection is empty
    LabelRows(const volume::LabelTable& labels, std::vector<std::string>* nothing = nullptr) noexcept
        : labels_(labels), nothing_(nothing) {}
    /// The same, for queries that compare volumes: these are the best known ones of the features with their parts.
    /// \param volume  must outlive the rows, unchanged
    LabelRows(const volume::SemanticVolume& volume, std::vector<std::string>* nothing = nullptr) noexcept
        : LabelRows(volume.labels, volume.grid, nothing) {}
    LabelRows(const volume::LabelTable& labels, const volume::Grid& grid,
              std::vector<std::string>* nothing = nullptr) noexcept
        : labels_(labels), grid_(&grid), nothing_(nothing) {}

    [[nodiscard]] std::span<const model::QueryRow> get() const;
    /// get() with volumes by KnownVolumes. Rows of a table without its grid keep those of the features' own solids.
    [[nodiscard]] std::span<const model::QueryRow> withVolumes() const;
    /// The extents of the labels, made once.
    [[nodiscard]] const Extents& extents() const;

    /// The result of a query that selects nothing: an empty selection, or NothingSelected with this message.
    [[nodiscard]] Result<std::vector<std::uint32_t>> selectNothing(const std::string& message) const;

private:
    const volume::LabelTable& labels_;
    const volume::Grid* grid_ = nullptr;
    std::vector<std::string>* nothing_;
    mutable std::vector<model::QueryRow> rows_;  // empty: not made yet
    mutable bool areVolumesKnown_ = false;
    mutable std::optional<Extents> extents_;
};

/// Labels that the query `text` selects. A comparison with `volume` is with that of LabelRows::withVolumes().
/// \return the labels, or BadQuery, or NothingSelected (see LabelRows); the latter names the nearest existing value
/// Cost: that of queryRows(), once for all queries on the same rows, and of Query::select().
[[nodiscard]] Result<std::vector<std::uint32_t>> selectLabels(const LabelRows& rows, std::string_view text);

/// selectLabels() with the parts that the selected features stand for, see Extents::wholes(). For commands that show,
/// hide, draw, cut out or frame features: a selected flat or storey is complete.
[[nodiscard]] Result<std::vector<std::uint32_t>> selectWithParts(const LabelRows& rows, std::string_view text);

/// The box around all voxels of `labels`.
/// \param what  describes them in the message
/// \return the box, or NothingSelected if they have no voxels
[[nodiscard]] Result<SampleBox> boxAround(const std::vector<std::uint32_t>& labels,
                                          const volume::SemanticVolume& volume, std::string_view what);

}  // namespace svt::analyze
