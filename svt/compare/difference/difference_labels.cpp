#include <svt/compare/difference/difference_labels.hpp>

#include <svt/compare/difference_volume.hpp>
#include <svt/model/classes.hpp>

#include <string>
#include <string_view>

namespace svt::compare {
namespace {

struct Look {
    Vec3f color;
    float opacity;
};

constexpr Vec3f colorOf(int red, int green, int blue) {
    return {float(red) / 255, float(green) / 255, float(blue) / 255};
}

// Okabe and Ito (2008). Unchanged objects are a ghost, so that changes inside of it are visible.
Look lookOf(Change change, std::string_view suffix) {
    if (suffix == "/added" || change == Change::Added) return {colorOf(0x00, 0x72, 0xB2), 1};
    if (suffix == "/removed" || change == Change::Removed) return {colorOf(0xD5, 0x5E, 0x00), 1};
    switch (change) {
        case Change::Same: return {colorOf(0xC8, 0xC8, 0xC8), 0.4f};
        case Change::Moved: return {colorOf(0xCC, 0x79, 0xA7), 1};
        default: return {colorOf(0xF0, 0xE4, 0x42), 1};
    }
}

std::vector<char> spacesOf(const volume::SemanticVolume& volume) {
    std::vector<char> isSpace;
    for (const volume::Label& label : volume.labels.labels)
        isSpace.push_back(
            model::isSpace(label.className) || model::classRank(label.className) == model::ClassRank::Building ? 1 : 0);
    return isSpace;
}

}  // namespace

Vec3f colorOfChange(Change change) noexcept { return lookOf(change, "").color; }

DifferenceLabels::DifferenceLabels(const volume::SemanticVolume& was, const volume::SemanticVolume& is,
                                   const Comparison& comparison)
    : was_(was), is_(is), isSpaceOfWas_(spacesOf(was)), isSpaceOfIs_(spacesOf(is)) {
    const std::size_t wasCount = was.labels.labels.size(), isCount = is.labels.labels.size();
    rowOfWas_.assign(wasCount, volume::kNoLabel);
    rowOfIs_.assign(isCount, volume::kNoLabel);
    wholeOfWas_ = rowOfWas_;
    wholeOfIs_ = rowOfIs_;
    kept_.assign(isCount, 0);
    added_.assign(isCount, 0);
    removed_.assign(wasCount, 0);
    for (std::size_t change = 0; change < kChangeCount; ++change) {
        if (comparison.counts[change] == 0) continue;
        volume::Label group;
        group.id = group.name = nameOf(static_cast<Change>(change));
        group.className = "CityObjectGroup";
        group_ = static_cast<std::uint32_t>(table_.labels.size());
        table_.labels.push_back(std::move(group));
        for (std::uint32_t r = 0; r < comparison.rows.size(); ++r)
            if (comparison.rows[r].hasGeometry && std::size_t(comparison.rows[r].change) == change)
                addRow(comparison.rows[r], r);
        table_.labels[group_].subtreeEnd = static_cast<std::uint32_t>(table_.labels.size());
    }
}

void DifferenceLabels::addRow(const ComparisonRow& row, std::uint32_t number) {
    for (const std::uint32_t l : row.was) rowOfWas_[l] = number;
    for (const std::uint32_t l : row.is) rowOfIs_[l] = number;
    const auto& before = was_.labels.labels;
    const auto& after = is_.labels.labels;
    const bool isWhole = row.change == Change::Same || row.change == Change::Reassigned || row.change == Change::Added;
    for (const std::uint32_t l : row.is) {
        kept_[l] = addPart(after[l], "", row, isWhole);
        if (isWhole)
            wholeOfIs_[l] = static_cast<std::uint32_t>(table_.labels.size() - 1);
        else
            added_[l] = addPart(after[l], "/added", row, false);
    }
    if (isWhole) return;
    for (const std::uint32_t l : row.was) {
        const bool isGone = row.change == Change::Removed;
        removed_[l] = addPart(before[l], isGone ? "" : "/removed", row, isGone);
        if (isGone) wholeOfWas_[l] = static_cast<std::uint32_t>(table_.labels.size() - 1);
    }
}

// \param isWhole  the part is an object with its own mesh and volume; other parts are counted in voxels
volume::Scalar DifferenceLabels::addPart(const volume::Label& object, const char* suffix, const ComparisonRow& row,
                                         bool isWhole) {
    volume::Label label;
    label.id = object.id + suffix;
    label.className = object.className;
    label.name = object.name;
    label.attributes = object.attributes;
    label.attributes.push_back({"change", std::string(nameOf(row.change))});
    label.parent = group_;
    label.subtreeEnd = static_cast<std::uint32_t>(table_.labels.size() + 1);
    label.first = table_.labels.empty() ? 1 : table_.scalarCount();
    label.count = 1;
    label.filling = isWhole ? object.filling : volume::Filling::Winding;
    label.volume = isWhole ? object.volume : 0;
    label.area = isWhole ? object.area : 0;
    const Look look = lookOf(row.change, suffix);
    label.color = look.color;
    label.opacity = look.opacity;
    const volume::Scalar scalar = label.first;
    table_.labels.push_back(std::move(label));
    return scalar;
}

volume::Scalar DifferenceLabels::scalarAt(std::uint32_t was, std::uint32_t is) const noexcept {
    const bool hadObject = was != volume::kNoLabel && rowOfWas_[was] != volume::kNoLabel;
    const bool hasObject = is != volume::kNoLabel && rowOfIs_[is] != volume::kNoLabel;
    if (!hadObject && !hasObject) return 0;
    if (hadObject && hasObject && rowOfWas_[was] == rowOfIs_[is]) return kept_[is];
    const volume::Scalar lost = hadObject ? removed_[was] : 0;
    const volume::Scalar gained = !hasObject ? 0 : added_[is] != 0 ? added_[is] : kept_[is];
    if (lost == 0 || gained == 0) return lost + gained;
    return isSpaceOfIs_[is] != 0 && isSpaceOfWas_[was] == 0 ? lost : gained;
}

}  // namespace svt::compare
