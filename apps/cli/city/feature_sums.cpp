#include <apps/cli/city/feature_sums.hpp>

#include <apps/cli/output/messages.hpp>
#include <apps/cli/output/query_reports.hpp>

#include <svt/analyze/exclusive_volumes.hpp>
#include <svt/analyze/face_areas.hpp>
#include <svt/core/text.hpp>
#include <svt/model/classes.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <map>
#include <numeric>
#include <utility>

namespace svt::cli {
FeatureSums::FeatureSums(const std::string& keys, bool hasFaces) : keys_(splitKeys(keys)), hasFaces_(hasFaces) {}

void FeatureSums::add(const volume::SemanticVolume& volume, std::span<const city::FeatureRow> rows,
                      std::span<const std::optional<double>> meshAreas) {
    const volume::LabelTable& table = volume.labels;
    const std::size_t count = table.labels.size();
    const analyze::Extents extents(table);
    std::vector<std::uint32_t> features;
    for (const city::FeatureRow& row : rows) features.push_back(row.label);
    std::vector<std::vector<std::string>> values(count);
    for (const std::string& key : keys_) {
        std::vector<std::string> ofKey = valuesOfKey(key, table, extents, features);
        for (std::size_t l = 0; l < count; ++l) values[l].push_back(std::move(ofKey[l]));
    }
    const std::vector<analyze::Measure> own = analyze::exclusiveMeasures(volume);
    const std::vector<std::uint32_t> finest = analyze::finestFeatures(extents, features, count);
    std::vector<Sum*> sumOf(count, nullptr);  // by label of an extent
    for (std::size_t l = 0; l < count; ++l)
        if (finest[l] != volume::kNoLabel) sumOf[l] = &sums_[values[l]];
    const std::vector<char> isAdded = addWholes(table, extents, rows, own, sumOf);
    for (std::size_t l = 0; l < count; ++l) {
        if (sumOf[l] == nullptr || isAdded[l] != 0) continue;
        if (own[l].volume.value_or(0) > 0) sumOf[l]->hasVolume = true;
        sumOf[l]->volume += own[l].volume.value_or(0);
        sumOf[l]->counted += own[l].countedVolume;
    }
    addAreas(table, rows, extents, own, sumOf);
    if (hasFaces_) addFaces(table, meshAreas, finest, sumOf);
}

void FeatureSums::addFaces(const volume::LabelTable& table, std::span<const std::optional<double>> meshAreas,
                           std::span<const std::uint32_t> finest, const std::vector<Sum*>& sumOf) {
    std::vector<std::uint32_t> all;
    for (std::uint32_t l = 0; l < sumOf.size(); ++l)
        if (sumOf[l] != nullptr) all.push_back(l);
    std::map<std::uint32_t, std::vector<analyze::CountedFaces>> countedOf;  // by feature
    for (const analyze::CountedFaces& faces : analyze::countedFaces(table, all, meshAreas))
        countedOf[finest[faces.label]].push_back(faces);
    for (auto& [feature, counted] : countedOf) {
        analyze::dropOpeningsOfRooms(table, counted);
        for (const analyze::CountedFaces& faces : counted) {
            Sum& sum = *sumOf[faces.label];
            const auto kind = static_cast<std::size_t>(faces.kind);
            withoutMesh_ += !faces.area;
            (faces.area ? sum.hasFaces : sum.hasUnknownFaces)[kind] = true;
            sum.faces[kind] += faces.area.value_or(0);
        }
    }
}

// The largest of features that contain each other counts. Volumes without counted parts are exact as they are. A feature
// that lost voxels to others has less than its known volume.
std::vector<char> FeatureSums::addWholes(const volume::LabelTable& table, const analyze::Extents& extents,
                                         std::span<const city::FeatureRow> rows, std::span<const analyze::Measure> own,
                                         const std::vector<Sum*>& sumOf) {
    constexpr std::size_t kNone = ~std::size_t{0};
    std::vector<std::vector<std::uint32_t>> wholes;
    std::vector<double> volumes;
    for (const city::FeatureRow& row : rows) {
        if (row.volume.source != analyze::VolumeSource::Meshes || !row.volume.volume) continue;
        std::vector<std::uint32_t> parts = extents.of(row.label);
        const bool isWhole = std::all_of(parts.begin(), parts.end(),
                                         [&](std::uint32_t part) { return sumOf[part] == sumOf[row.label]; });
        const bool isCounted =
            std::any_of(parts.begin(), parts.end(), [&](std::uint32_t part) { return own[part].countedVolume > 0; });
        if (!isWhole || !isCounted) continue;
        wholes.push_back(std::move(parts));
        volumes.push_back(*row.volume.volume);
    }
    std::vector<std::size_t> order(wholes.size()), wholeOf(own.size(), kNone);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return wholes[a].size() > wholes[b].size(); });
    std::vector<char> isUsed(wholes.size(), 0), isAdded(own.size(), 0);
    for (const std::size_t w : order) {
        isUsed[w] = std::all_of(wholes[w].begin(), wholes[w].end(), [&](auto part) { return wholeOf[part] == kNone; });
        if (isUsed[w] != 0)
            for (const std::uint32_t part : wholes[w]) wholeOf[part] = w;
    }
    for (const volume::Overlap& overlap : table.overlaps)
        if (wholeOf[overlap.b] != kNone && wholeOf[overlap.a] != wholeOf[overlap.b]) isUsed[wholeOf[overlap.b]] = 0;
    for (std::size_t w = 0; w < wholes.size(); ++w) {
        if (isUsed[w] == 0) continue;
        Sum& sum = *sumOf[wholes[w].front()];
        sum.hasVolume = true;
        sum.volume += volumes[w];
        for (const std::uint32_t part : wholes[w]) isAdded[part] = 1;
    }
    return isAdded;
}

// Counts the features, a window with its panes as one. A feature within others of its values adds no area, nor does one
// whose voxels have other values.
void FeatureSums::addAreas(const volume::LabelTable& table, std::span<const city::FeatureRow> rows,
                           const analyze::Extents& extents, std::span<const analyze::Measure> own,
                           const std::vector<Sum*>& sumOf) {
    std::vector<char> isRow(own.size(), 0);
    for (const city::FeatureRow& row : rows) isRow[row.label] = 1;
    const auto isPartOfRow = [&](std::uint32_t feature) {
        const volume::Label& label = table.labels[feature];
        return model::isPhase(label.className) && label.parent < isRow.size() && isRow[label.parent] != 0 &&
               sumOf[label.parent] == sumOf[feature];
    };
    std::vector<std::size_t> sizes, order(rows.size());
    for (const city::FeatureRow& row : rows) sizes.push_back(extents.of(row.label).size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return sizes[a] > sizes[b]; });
    std::vector<char> isCovered(own.size(), 0);
    for (const std::size_t n : order) {
        const std::uint32_t feature = rows[n].label;
        const analyze::Measure& total = rows[n].measure.total;
        Sum& sum = *sumOf[feature];
        sum.count += !isPartOfRow(feature);
        withoutVolume_ += !total.volume;
        withoutVoxels_ += total.voxels == 0;
        bool isNew = false, isInParts = total.voxels > 0;
        for (const std::uint32_t part : extents.of(feature)) {
            if (sumOf[part] != &sum || own[part].voxels == 0) continue;
            isInParts = false;
            isNew = std::exchange(isCovered[part], 1) == 0 || isNew;
        }
        inParts_ += isInParts;
        if (!isNew) continue;
        sum.hasArea = true;
        sum.area += rows[n].area;
    }
}

Table FeatureSums::table() const {
    Table table;
    for (const std::string& key : keys_) table.columns.push_back({key, key, 0});
    const Column columns[] = {{"features", "features", 0},
                              {"totalVolume", "total m3"},
                              {"area", "m2 in plan", 1},
                              {"countedVolume"},
                              {"volume"}};  // deprecated name of totalVolume
    table.columns.insert(table.columns.end(), std::begin(columns), std::end(columns));
    if (hasFaces_) addFaceColumns(table.columns);
    for (const auto& [values, sum] : sums_) {
        Row& row = table.rows.emplace_back();
        for (const std::string& value : values) row.push_back(value.empty() ? Cell() : Cell(value));
        const auto known = [](bool isKnown, double value) { return isKnown ? Cell(value) : Cell(); };
        row.push_back(sum.count);
        row.push_back(known(sum.hasVolume, sum.volume));
        row.push_back(known(sum.hasArea, sum.area));
        row.push_back(known(sum.hasVolume, sum.counted));
        row.push_back(known(sum.hasVolume, sum.volume));
        for (std::size_t kind = 0; hasFaces_ && kind < sum.faces.size(); ++kind)
            row.push_back(known(sum.hasFaces[kind] && !sum.hasUnknownFaces[kind], sum.faces[kind]));
    }
    return table;
}

void FeatureSums::note() const {
    for (std::size_t k = 0; k < keys_.size(); ++k)
        if (!std::ranges::any_of(sums_, [&](const auto& sum) { return !sum.first[k].empty(); }))
            cli::note(frontend::noValueOfKey(keys_[k]));
    if (inParts_ > 0)
        cli::note(
            fmt::format("{} features count only with their parts, which have values of their own: each m3 counts "
                        "once",
                        inParts_));
    double volume = 0, counted = 0;
    for (const auto& [values, sum] : sums_) {
        volume += sum.volume;
        counted += sum.counted;
    }
    if (counted > 0)
        cli::note(fmt::format("{:.3f} of {:.3f} m3 are counted in voxels; the rest is exact", counted, volume));
    const auto noteMissing = [](std::uint64_t without, const char* measure, const char* basis) {
        if (without > 0)
            cli::note(fmt::format("the sums of {} exclude {} features without {}", measure, without, basis));
    };
    noteMissing(withoutVolume_, "volume", "solids");
    noteMissing(withoutVoxels_, "area", "voxels");
    if (withoutMesh_ > 0)
        cli::note(fmt::format("{} features have no mesh in this volume: the areas of faces of their rows are unknown",
                              withoutMesh_));
}

}  // namespace svt::cli
