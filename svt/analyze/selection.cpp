#include <svt/analyze/selection.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace svt::analyze {

std::vector<model::QueryRow> queryRows(const volume::LabelTable& table) {
    std::vector<model::QueryRow> rows;
    rows.reserve(table.labels.size());
    for (const volume::Label& label : table.labels)
        rows.push_back({label.id, label.className, label.name, label.parent, label.attributes, label.groups,
                        label.volume, label.voxels});
    return rows;
}

std::span<const model::QueryRow> LabelRows::get() const {
    if (rows_.empty()) rows_ = queryRows(labels_);
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
    std::vector<std::uint32_t> selected = query->select(rows.get());
    if (!selected.empty()) return selected;
    const std::string reason = query->unknownValue(rows.get());
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
