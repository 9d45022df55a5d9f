#include <apps/cli/diff/changed_storeys.hpp>

#include <svt/drawing/storey_floors.hpp>
#include <svt/image/png.hpp>
#include <svt/model/classes.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace svt::cli {
namespace {

using compare::Change, compare::ComparisonRow;
using Heights = std::array<double, 2>;

constexpr std::string_view kChangedParts = R"(id~"/(added|removed)$")";

void widen(std::optional<Heights>& heights, Heights by) {
    if (!heights)
        heights = by;
    else
        heights = Heights{std::min((*heights)[0], by[0]), std::max((*heights)[1], by[1])};
}

// Heights of the storeys of one volume, and of its objects.
class StateHeights {
public:
    StateHeights(const volume::SemanticVolume& volume, const volume::Grid& frame)
        : extents_(drawing::labelExtents(volume)), shift_(dot(volume.grid.origin() - frame.origin(), frame.axes()[2])) {
        const StateFeatures features(volume);
        for (const drawing::StoreyHeights& storey : drawing::findStoreys(volume))
            widen(storeys_[features.storeyOf(storey.label)], {storey.low + shift_, storey.top + shift_});
    }
    [[nodiscard]] std::optional<Heights> ofStorey(const std::string& name) const {
        const auto found = storeys_.find(name);
        return found == storeys_.end() ? std::nullopt : found->second;
    }
    [[nodiscard]] std::optional<Heights> ofObject(std::uint32_t label) const {
        const Box3d& box = extents_[label].box;
        if (box.isEmpty()) return std::nullopt;
        return Heights{box.min.z + shift_, box.max.z + shift_};
    }

private:
    std::vector<drawing::LabelExtent> extents_;
    double shift_;
    std::map<std::string, std::optional<Heights>> storeys_;
};

bool hasOtherSpace(const ComparisonRow& row) {
    return row.hasGeometry && row.change != Change::Same && row.change != Change::Reassigned;
}

// A roof or a slab beyond the rooms belongs to the picture; a shaft through all storeys does not.
void addObject(std::optional<Heights> object, double most, ChangedStorey& storey) {
    if (object && storey.heights && (*object)[1] - (*object)[0] <= most) widen(storey.heights, *object);
}

}  // namespace

std::vector<ChangedStorey> changedStoreys(const Compared& compared, std::span<const std::uint32_t> rows) {
    const StateFeatures was(compared.was), is(compared.is);
    const StateHeights before(compared.was, compared.was.grid), after(compared.is, compared.was.grid);
    std::map<std::string, std::size_t> numberOf;
    std::vector<ChangedStorey> storeys;
    for (const std::uint32_t r : rows) {
        const ComparisonRow& row = compared.comparison.rows[r];
        if (!hasOtherSpace(row)) continue;
        const std::string name = subjectOf(row, was, is).storey();
        const auto [at, isNew] = numberOf.try_emplace(name, storeys.size());
        if (isNew) storeys.push_back({name, {}});
        storeys[at->second].rows.push_back(r);
    }
    for (ChangedStorey& storey : storeys) {
        if (storey.name.empty()) continue;
        for (const StateHeights* state : {&before, &after})
            if (const auto heights = state->ofStorey(storey.name)) widen(storey.heights, *heights);
        if (!storey.heights) continue;
        const double most = 1.5 * ((*storey.heights)[1] - (*storey.heights)[0]);
        for (const std::uint32_t r : storey.rows) {
            for (const std::uint32_t l : compared.comparison.rows[r].was) addObject(before.ofObject(l), most, storey);
            for (const std::uint32_t l : compared.comparison.rows[r].is) addObject(after.ofObject(l), most, storey);
        }
    }
    std::stable_sort(storeys.begin(), storeys.end(), [](const ChangedStorey& s, const ChangedStorey& t) {
        if (!s.heights || !t.heights) return !s.heights && t.heights;
        return (*s.heights)[0] < (*t.heights)[0];
    });
    return storeys;
}

bool hasChangedSolids(const Compared& compared, std::span<const std::uint32_t> rows) {
    return std::any_of(rows.begin(), rows.end(), [&](std::uint32_t r) {
        const ComparisonRow& row = compared.comparison.rows[r];
        if (!hasOtherSpace(row)) return false;
        const auto& labels = (row.is.empty() ? compared.was : compared.is).labels.labels;
        return !model::isSpace(labels[row.is.empty() ? row.was.front() : row.is.front()].className);
    });
}

ChangePictures::ChangePictures(const volume::SemanticVolume& difference, int threads)
    : difference_(difference), painter_(difference, threads), threads_(threads) {
    painter_.tolerateNothing(&nothing_);
    for (const volume::Label& label : difference.labels.labels)
        if (model::isSpace(label.className) &&
            std::find(spaceClasses_.begin(), spaceClasses_.end(), label.className) == spaceClasses_.end())
            spaceClasses_.push_back(label.className);
}

illustrate::Scene ChangePictures::scene() const {
    illustrate::Scene scene;
    scene.width = 560;
    scene.height = 420;
    illustrate::SceneStyle shared;
    shared.select =
        fmt::format("(change=changed or change=split or change=merged or change=moved) and not {}", kChangedParts);
    shared.opacity = 0.85f;
    scene.passes.front().styles.push_back(shared);
    return scene;
}

// A query for spaces that are not drawn. \param unless  a query; empty: all spaces
std::string ChangePictures::hiddenSpaces(std::string_view unless) const {
    std::string query;
    for (const std::string& name : spaceClasses_)
        query += fmt::format("{}class=\"{}\"", query.empty() ? "" : " or ", name);
    return unless.empty() ? query : fmt::format("({}) and not ({})", query, unless);
}

Result<std::vector<std::byte>> ChangePictures::draw(const illustrate::Scene& scene) {
    render::CastOptions cast;
    cast.threads = threads_;
    cast.isAdaptive = true;
    SVT_TRY(painting, painter_.paint(scene, cast));
    return image::encodePng(painting->frame.color);
}

Result<std::vector<std::byte>> ChangePictures::drawStorey(const ChangedStorey& storey, bool isPlan, bool hasSolids,
                                                          const volume::Grid& was) {
    illustrate::Scene scene = this->scene();
    illustrate::ScenePass& pass = scene.passes.front();
    if (storey.heights) {
        const double shift = dot(was.origin() - difference_.grid.origin(), was.axes()[2]);
        pass.keep = fmt::format("z>{:.4f} and z<{:.4f}", (*storey.heights)[0] + shift, (*storey.heights)[1] + shift);
    }
    pass.show = {"all"};
    if (!spaceClasses_.empty()) pass.hide = {hiddenSpaces(hasSolids ? "" : "not change=same")};
    scene.camera.preset = isPlan ? "top" : "iso";
    scene.camera.isParallel = isPlan;
    return draw(scene);
}

Result<std::vector<std::byte>> ChangePictures::drawView(Vec3d eye, Vec3d target, double fieldOfViewDegrees,
                                                        std::span<const std::string> ids) {
    illustrate::Scene scene = this->scene();
    scene.width = 400;
    scene.height = 300;
    std::string shown;
    for (const std::string& id : ids)
        if (id.find('"') == std::string::npos)
            for (const char* suffix : {"", "/added", "/removed"})
                shown += fmt::format("{}id=\"{}{}\"", shown.empty() ? "" : " or ", id, suffix);
    illustrate::ScenePass& pass = scene.passes.front();
    pass.show = {"all"};
    if (!spaceClasses_.empty()) pass.hide = {hiddenSpaces(shown)};
    scene.camera.eye = eye - difference_.grid.origin();
    scene.camera.target = target - difference_.grid.origin();
    scene.camera.fieldOfView = fieldOfViewDegrees;
    return draw(scene);
}

}  // namespace svt::cli
