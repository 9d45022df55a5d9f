#include <svt/analyze/selection.hpp>

#include <svt/analyze/known_volumes.hpp>
#include <svt/core/text.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace svt::analyze {
namespace {

// Keys ignore case. A text that holds the word for another reason costs time only.
bool mayCompareVolumes(std::string_view query) {
    constexpr std::string_view kKey = "volume";
    return std::search(query.begin(), query.end(), kKey.begin(), kKey.end(),
                       [](char letter, char wanted) { return lowerAscii(letter) == wanted; }) != query.end();
}

}  // namespace

std::vector<model::QueryRow> queryRows(const volume::LabelTable& table) {
    std::vector<model::QueryRow> rows;
    rows.reserve(table.labels.size());
    for (const volume::Label& label : table.labels)
        rows.push_back({label.id, label.className, label.name, label.parent, label.attributes, label.groups,
                        label.volume > 0 ? std::optional(label.volume) : std::nullopt, label.voxels});
    return rows;
}

std::span<const model::QueryRow> LabelRows::get() const {
    if (rows_.empty()) rows_ = queryRows(labels_);
    return rows_;
}

std::span<const model::QueryRow> LabelRows::withVolumes() const {
    (void)get();
    if (grid_ == nullptr || areVolumesKnown_) return rows_;
    const KnownVolumes volumes(labels_, *grid_, extents());
    for (std::uint32_t l = 0; l < rows_.size(); ++l) rows_[l].volume = volumes.of(l).volume;
    areVolumesKnown_ = true;
    return rows_;
}

const Extents& LabelRows::extents() const {
    if (!extents_) extents_.emplace(labels_);
    return *extents_;
}

Result<std::vector<std::uint32_t>> LabelRows::selectNothing(const std::string& message) const {
    if (nothing_ == nullptr) return Error(Code::NothingSelected, message);
    if (std::find(nothing_->begin(), nothing_->end(), message) == nothing_->end()) nothing_->push_back(message);
    return std::vector<std::uint32_t>{};
}

Result<std::vector<std::uint32_t>> selectLabels(const LabelRows& rows, std::string_view text) {
    SVT_TRY(query, model::Query::parse(text));
    const std::span<const model::QueryRow> all = mayCompareVolumes(text) ? rows.withVolumes() : rows.get();
    std::vector<std::uint32_t> selected = query->select(all);
    if (!selected.empty()) return selected;
    const std::string reason = query->unknownValue(all);
    return rows.selectNothing(
        fmt::format("the query '{}' selects nothing{}{}", text, reason.empty() ? "" : ": ", reason));
}

Result<std::vector<std::uint32_t>> selectWithParts(const LabelRows& rows, std::string_view text) {
    SVT_TRY(selected, selectLabels(rows, text));
    return rows.extents().withParts(*selected);
}

Result<SampleBox> boxAround(const std::vector<std::uint32_t>& labels, const volume::SemanticVolume& volume,
                            std::string_view what) {
    const std::vector<SampleBox> boxes = labelBoxes(volume.columns, volume.labels);
    SampleBox all;
    for (const std::uint32_t l : labels) all.add(boxes[l]);
    if (all.isEmpty()) return Error(Code::NothingSelected, fmt::format("{} has no voxels", what));
    return all;
}

}  // namespace svt::analyze
