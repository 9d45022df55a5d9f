#include <svt/frontend/measure_take_off.hpp>

#include <svt/analyze/extents.hpp>
#include <svt/analyze/selection.hpp>
#include <svt/frontend/label_values.hpp>
#include <svt/model/classes.hpp>

#include <algorithm>
#include <numeric>
#include <utility>

namespace svt::frontend {
namespace {

using quantities::TouchingArea;

// Terrain, land use, roads. Not a class that no one knows, which may be a building.
bool isSoil(const volume::Label& label) {
    return model::classRank(label.className) == model::ClassRank::Other &&
           model::insideOf(label.className) == model::Inside::Never;
}

}  // namespace

Result<std::vector<std::uint32_t>> selectedLabels(const volume::SemanticVolume& volume, const std::string& query,
                                                  bool isPart) {
    if (!isPart) return analyze::selectLabels(volume, query);
    std::vector<std::string> nothing;
    return analyze::selectLabels(analyze::LabelRows(volume, &nothing), query);
}

Result<void> addTouchingAreas(const TakeOffQuestion& question, TakeOff& takeOff) {
    const volume::SemanticVolume& volume = takeOff.volume;
    std::vector<char> isConcrete;
    if (!question.formwork.empty()) {
        SVT_TRY(concrete, selectedLabels(volume, question.formwork, question.isPart));
        isConcrete.assign(volume.labels.labels.size(), 0);
        for (const std::uint32_t object : quantities::objectsOf(volume, *concrete)) {
            isConcrete[object] = 1;
            for (std::uint32_t part = object + 1; part < volume.labels.labels[object].subtreeEnd; ++part)
                if (volume.labels.labels[part].parent == object && model::isPhase(volume.labels.labels[part].className))
                    isConcrete[part] = 1;
        }
    }
    const auto areas = quantities::findTouchingAreas(volume, takeOff.objects, question.threads);
    const std::size_t count = takeOff.objects.size();
    takeOff.hasExterior = question.exterior;
    takeOff.hasFormwork = !question.formwork.empty();
    if (takeOff.hasExterior) {
        takeOff.exterior.resize(count);
        takeOff.exteriorCounted.resize(count);
    }
    if (takeOff.hasFormwork) {
        takeOff.formwork.resize(count);
        takeOff.formworkTop.resize(count);
    }
    for (std::size_t n = 0; n < count; ++n) {
        if (!takeOff.objects[n].outerArea) continue;
        if (question.exterior) {
            auto& exterior = takeOff.exterior[n].emplace();
            double& counted = takeOff.exteriorCounted[n].emplace(0.0);
            for (const TouchingArea& area : areas[n]) {
                if (!area.isOutside) continue;
                exterior[std::size_t(area.facing)] += area.area;
                counted += area.countedArea;
            }
        }
        if (isConcrete.empty() || isConcrete[takeOff.objects[n].parts.front()] == 0) continue;
        takeOff.formwork[n] = takeOff.formworkTop[n] = 0;
        for (const TouchingArea& area : areas[n]) {
            const bool isFree = area.label == volume::kNoLabel ||
                                (isConcrete[area.label] == 0 && !isSoil(volume.labels.labels[area.label]));
            if (!isFree) continue;
            *takeOff.formwork[n] += area.area;
            if (area.facing == quantities::Facing::Top) *takeOff.formworkTop[n] += area.area;
        }
    }
    return {};
}

void addTexts(const TakeOffQuestion& question, TakeOff& takeOff) {
    const volume::LabelTable& table = takeOff.volume.labels;
    const analyze::Extents extents(table);
    std::vector<std::uint32_t> all(table.labels.size());
    std::iota(all.begin(), all.end(), 0U);
    const auto valuesOf = [&](const std::string& key) {
        const std::vector<std::string> ofLabels = valuesOfKey(key, table, extents, all);
        std::vector<std::string> values;
        for (const auto& object : takeOff.objects) values.push_back(ofLabels[object.label]);
        return values;
    };
    takeOff.storeys = valuesOf("storey");
    takeOff.materials = valuesOf("material");
    takeOff.keys = splitKeys(question.by);
    takeOff.values.assign(takeOff.objects.size(), {});
    for (const std::string& key : takeOff.keys) {
        std::vector<std::string> values = valuesOf(key);
        for (std::size_t n = 0; n < values.size(); ++n) takeOff.values[n].push_back(std::move(values[n]));
    }
}

Result<void> completeTakeOff(const TakeOffQuestion& question, TakeOff& takeOff, const Progress* progress) {
    Progress::tell(progress, "share", 0);
    takeOff.counted = quantities::countedVolumes(takeOff.volume, takeOff.objects);
    if (question.exterior || !question.formwork.empty()) {
        Progress::tell(progress, "touch", 0);
        SVT_DO(addTouchingAreas(question, takeOff));
    }
    addTexts(question, takeOff);
    return {};
}

Result<std::vector<std::uint32_t>> findObjects(const volume::SemanticVolume& volume, const std::string& query,
                                               std::vector<std::string>& notes) {
    if (!query.empty()) {
        SVT_TRY(selected, analyze::selectLabels(volume, query));
        return quantities::objectsOf(volume, *selected);
    }
    std::vector<std::uint32_t> objects = quantities::defaultObjects(volume);
    if (!objects.empty() && !quantities::isComponent(volume.labels.labels[objects.front()]))
        notes.emplace_back(
            "the model has no walls, slabs or other components; the rows are its buildings, rooms and other objects");
    return objects;
}

Result<TakeOff> measureTakeOff(const volume::SemanticVolume& volume, const TakeOffQuestion& question,
                               std::vector<std::string>& notes, const Progress* progress) {
    if (volume.vectors.triangles.empty()) notes.emplace_back(kNoMeshes);
    auto objects = findObjects(volume, question.where, notes);
    if (!objects && objects.error().code() == Code::NothingSelected) {
        // An answer, not an error: the query is valid, but selects no feature.
        notes.push_back(objects.error().message());
        objects = std::vector<std::uint32_t>();
    }
    if (!objects) return objects.error();
    Progress::tell(progress, "measure", 0);
    TakeOff takeOff{volume, quantities::measureObjects(volume, *objects, question.threads)};
    SVT_DO(completeTakeOff(question, takeOff, progress));
    if (takeOff.objects.empty())
        notes.emplace_back("no objects are measured; use --where with a query that selects objects");
    for (std::size_t k = 0; k < takeOff.keys.size() && !takeOff.objects.empty(); ++k)
        if (!std::ranges::any_of(takeOff.values, [&](const auto& values) { return !values[k].empty(); }))
            notes.push_back(noValueOfKey(takeOff.keys[k]));
    for (std::string& text : takeOffNotes(takeOff)) notes.push_back(std::move(text));
    return takeOff;
}

}  // namespace svt::frontend
