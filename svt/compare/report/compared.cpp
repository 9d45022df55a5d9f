#include <svt/compare/compared.hpp>

#include <svt/core/names.hpp>
#include <svt/drawing/storey_floors.hpp>
#include <svt/model/classes.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string_view>

namespace svt::compare {

namespace {

Box3d boxOfGrid(const volume::Grid& grid) {
    Box3d box;
    const Vec3d last = toDouble(grid.dimension() - Vec3i{1, 1, 1});
    for (int corner = 0; corner < 8; ++corner)
        box.add(grid.worldFromIndex({corner & 1 ? last.x : 0.0, corner & 2 ? last.y : 0.0, corner & 4 ? last.z : 0.0}));
    return box;
}

}  // namespace

bool overlapInSpace(const volume::Grid& a, const volume::Grid& b) { return boxOfGrid(a).overlaps(boxOfGrid(b)); }

StateFeatures::StateFeatures(const volume::SemanticVolume& volume)
    : labels_(volume.labels.labels), storeys_(drawing::storeysOfLabels(volume.labels)) {}

std::string StateFeatures::storeyOf(std::uint32_t label) const {
    const std::uint32_t storey = storeys_[label];
    if (storey == volume::kNoLabel) return {};
    return labels_[storey].name.empty() ? labels_[storey].id : labels_[storey].name;
}

std::vector<std::string> StateFeatures::ids(const std::vector<std::uint32_t>& labels) const {
    std::vector<std::string> ids;
    for (const std::uint32_t label : labels) ids.push_back(labels_[label].id);
    return ids;
}

RowSubject subjectOf(const ComparisonRow& row, const StateFeatures& was, const StateFeatures& is) {
    return row.is.empty() ? RowSubject{&was, row.was.front()} : RowSubject{&is, row.is.front()};
}

std::string otherProperties(const ComparisonRow& row, std::size_t most) {
    std::vector<std::string_view> names;
    if (row.hasOtherClass) names.emplace_back("class");
    if (row.hasOtherName) names.emplace_back("name");
    if (row.hasOtherStorey) names.emplace_back("storey");
    for (const AttributeChange& attribute : row.attributes) names.emplace_back(attribute.name);
    std::string text =
        fmt::format("{}", fmt::join(names.begin(), names.begin() + std::ptrdiff_t(std::min(most, names.size())), ", "));
    if (names.size() > most) text += fmt::format(", and {} more", names.size() - most);
    return text;
}

std::optional<double> changedVolume(const ComparisonRow& row) {
    if (!row.added && !row.removed) return std::nullopt;
    return row.added.value_or(0) + row.removed.value_or(0);
}

std::vector<std::uint32_t> rowsByVolume(const Comparison& comparison) {
    std::vector<std::uint32_t> rows;
    for (std::uint32_t r = 0; r < comparison.rows.size(); ++r)
        if (comparison.rows[r].isDifferent()) rows.push_back(r);
    // Rows of storeys and groups, and rows without another shape, have no changed volume.
    const auto keyOf = [&](std::uint32_t r) {
        const ComparisonRow& row = comparison.rows[r];
        const auto volume = changedVolume(row);
        const bool hasSpace = row.hasGeometry && row.change != Change::Same && row.change != Change::Reassigned;
        const int rank = !hasSpace ? 2 : !volume ? 1 : 0;
        return std::pair(rank, rank == 0 ? -*volume : -row.distance.value_or(0));
    };
    std::stable_sort(rows.begin(), rows.end(), [&](std::uint32_t a, std::uint32_t b) { return keyOf(a) < keyOf(b); });
    return rows;
}

std::vector<std::uint32_t> allRows(const Comparison& comparison) {
    std::vector<std::uint32_t> rows(comparison.rows.size());
    std::iota(rows.begin(), rows.end(), 0U);
    return rows;
}

std::vector<ClassSums> sumsByClass(const Compared& compared, std::span<const std::uint32_t> rows,
                                   std::vector<ClassSums> sums) {
    for (const std::uint32_t r : rows) {
        const ComparisonRow& row = compared.comparison.rows[r];
        if (!row.hasGeometry || row.change == Change::Same) continue;
        const volume::Label& label =
            row.is.empty() ? compared.was.labels.labels[row.was.front()] : compared.is.labels.labels[row.is.front()];
        auto at =
            std::find_if(sums.begin(), sums.end(), [&](const ClassSums& s) { return s.className == label.className; });
        if (at == sums.end()) at = sums.insert(sums.end(), ClassSums{label.className});
        ++at->objects;
        if (!changedVolume(row)) {
            ++at->unknown;
            continue;
        }
        const bool isFirst = !at->added && !at->removed;
        if (row.added) at->added = at->added.value_or(0) + *row.added;
        if (row.removed) at->removed = at->removed.value_or(0) + *row.removed;
        if (isFirst)
            at->bound = row.bound;
        else if (at->bound)
            at->bound = row.bound ? std::optional(*at->bound + *row.bound) : std::nullopt;
    }
    return sums;
}

ClassSums sumsOfComponents(const Compared& compared) {
    std::vector<std::uint32_t> components;
    for (std::uint32_t r = 0; r < compared.comparison.rows.size(); ++r) {
        const ComparisonRow& row = compared.comparison.rows[r];
        const std::string& className = row.is.empty() ? compared.was.labels.labels[row.was.front()].className
                                                      : compared.is.labels.labels[row.is.front()].className;
        if (!model::isSpace(className) && model::classRank(className) != model::ClassRank::Building)
            components.push_back(r);
    }
    ClassSums all{{}};
    bool isBounded = true;
    for (const ClassSums& sums : sumsByClass(compared, components)) {
        all.objects += sums.objects;
        all.unknown += sums.unknown;
        if (sums.added) all.added = all.added.value_or(0) + *sums.added;
        if (sums.removed) all.removed = all.removed.value_or(0) + *sums.removed;
        if (!sums.added && !sums.removed) continue;
        isBounded = isBounded && sums.bound;
        if (sums.bound) all.bound = all.bound.value_or(0) + *sums.bound;
    }
    if (!isBounded) all.bound.reset();
    return all;
}

double withoutRounding(double value) noexcept { return std::round(value * 1e7) / 1e7; }

namespace {

// "1 removed, 3 added", from the last kind to the first.
std::string countsText(const std::array<std::size_t, kChangeCount>& counts, bool hasSame) {
    std::string text;
    for (std::size_t change = kChangeCount; change-- > 0;)
        if (counts[change] > 0 && (hasSame || static_cast<Change>(change) != Change::Same))
            text +=
                fmt::format("{}{} {}", text.empty() ? "" : ", ", counts[change], nameOf(static_cast<Change>(change)));
    return text;
}

}  // namespace

std::string propertiesText(const PropertyCounts& counts) {
    std::string text;
    for (const auto& [count, name] : {std::pair(counts.classes, "class"), std::pair(counts.names, "name"),
                                      std::pair(counts.storeys, "storey"), std::pair(counts.attributes, "attributes")})
        if (count > 0) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", name, count);
    return text;
}

std::string ambiguousText(const Comparison& comparison) {
    if (comparison.ambiguousGroups == 0) return {};
    return fmt::format(
        "{} features without geometry have other ids, and several of one class and name, so they are removed and added",
        comparison.ambiguousGroups);
}

std::string comparisonSummary(const Comparison& comparison) {
    std::string text = countsText(comparison.counts, true);
    if (text.empty()) text = "no objects";
    if (const std::string groups = countsText(comparison.groups, false); !groups.empty())
        text += "; without geometry: " + groups;
    if (comparison.otherProperties > 0) {
        const std::string properties = propertiesText(comparison.properties);
        text += fmt::format("; {} with other properties", comparison.otherProperties);
        if (!properties.empty()) text += fmt::format(" ({})", properties);
    }
    return text;
}

}  // namespace svt::compare
