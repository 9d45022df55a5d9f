#include <svt/readers/cityjson/cityjson_link.hpp>

#include <svt/model/surface_uses.hpp>
#include <svt/readers/georeference/georeference.hpp>

#include <fmt/format.h>

#include <limits>
#include <map>
#include <unordered_map>
#include <unordered_set>

namespace svt::readers::cityjson {
namespace {

constexpr std::int32_t kNone = -1;

class Linker {
public:
    Linker(std::vector<ParsedObject> objects, std::string_view file, model::BuildingModel& model,
           std::vector<Vec3d>& anchors, Diagnostics& diagnostics)
        : objects_(std::move(objects)), file_(file), model_(model), anchors_(anchors), diagnostics_(diagnostics) {}

    Result<void> run() {
        for (const ParsedObject& object : objects_) diagnostics_.append(object.diagnostics);
        dropDuplicates();
        std::size_t features = objects_.size(), polygons = 0;
        for (const ParsedObject& object : objects_) {
            features += object.surfaces.size();
            polygons += object.polygons.size();
        }
        constexpr std::size_t kMaxCount = std::numeric_limits<std::int32_t>::max();
        if (features > kMaxCount || polygons > kMaxCount)
            return Error(Code::InputTooBig,
                         fmt::format("{} features with {} polygons; at most {} of each can be read", features, polygons,
                                     kMaxCount),
                         {std::string(file_), 0, 0, {}});
        model_.features.reserve(features);
        model_.polygons.reserve(polygons);
        findParents();
        orderChildren();
        emit();
        if (!anchors_.empty()) anchors_.resize(model_.polygons.size(), georeference::kNoAnchor);
        addMemberships();
        return {};
    }

private:
    void report(Code code, const ParsedObject& object, std::string message) {
        diagnostics_.add(Severity::Warning, code, std::move(message),
                         {std::string(file_), object.feature.line, 0, shortened(object.id)});
    }

    /// Keeps the first object of each id.
    void dropDuplicates() {
        indexOfId_.reserve(objects_.size());
        std::size_t kept = 0;
        for (std::size_t i = 0; i < objects_.size(); ++i) {
            if (i != kept) objects_[kept] = std::move(objects_[i]);
            // The key is a copy, because moving an object moves its text.
            if (indexOfId_.emplace(objects_[kept].id, static_cast<std::int32_t>(kept)).second)
                ++kept;
            else
                report(Code::DuplicateId, objects_[kept],
                       "a second city object of this id; the first stays, this one is left out");
        }
        objects_.erase(objects_.begin() + static_cast<std::ptrdiff_t>(kept), objects_.end());
    }

    [[nodiscard]] std::int32_t find(const std::string& id) const {
        const auto found = indexOfId_.find(id);
        return found == indexOfId_.end() ? kNone : found->second;
    }

    /// `parents` of the child takes precedence; `children` of the parent is used if the child does not have `parents`.
    void findParents() {
        parents_.assign(objects_.size(), kNone);
        for (std::size_t i = 0; i < objects_.size(); ++i)
            for (const std::string& id : objects_[i].parents) {
                const std::int32_t parent = find(id);
                if (parent == kNone)
                    report(Code::DanglingReference, objects_[i],
                           fmt::format("names the parent '{}', which is not in the file", shortened(id)));
                else if (parents_[i] == kNone && !objects_[parent].isGroup)
                    parents_[i] = parent;
            }
        for (std::size_t i = 0; i < objects_.size(); ++i)
            for (const std::string& id : objects_[i].children) {
                const std::int32_t child = find(id);
                if (child == kNone)
                    report(Code::DanglingReference, objects_[i],
                           fmt::format("names the child '{}', which is not in the file", shortened(id)));
                else if (parents_[child] == kNone && !objects_[i].isGroup)
                    parents_[child] = static_cast<std::int32_t>(i);
            }
        claimedParents_ = parents_;
        for (const std::int32_t i : breakCycles(parents_))
            report(Code::ReferenceCycle, objects_[i], "is its own ancestor; it becomes a root");
    }

    /// Children in the order of the parent's `children`, then the remaining ones in file order.
    void orderChildren() {
        children_.resize(objects_.size());
        std::vector<bool> isPlaced(objects_.size(), false);
        for (std::size_t i = 0; i < objects_.size(); ++i)
            for (const std::string& id : objects_[i].children) {
                const std::int32_t child = find(id);
                if (child == kNone || parents_[child] != static_cast<std::int32_t>(i) || isPlaced[child]) continue;
                children_[i].push_back(child);
                isPlaced[child] = true;
            }
        for (std::size_t i = 0; i < objects_.size(); ++i)
            if (parents_[i] != kNone && !isPlaced[i]) children_[parents_[i]].push_back(static_cast<std::int32_t>(i));
    }

    void emit() {
        featureOf_.assign(objects_.size(), model::kNoFeature);
        // The capacity is reserved, so views of ids of features in the model stay valid.
        std::vector<std::int32_t> stack;
        for (std::size_t i = objects_.size(); i-- > 0;)
            if (parents_[i] == kNone) stack.push_back(static_cast<std::int32_t>(i));
        while (!stack.empty()) {
            const std::int32_t i = stack.back();
            stack.pop_back();
            emitObject(i);
            stack.insert(stack.end(), children_[i].rbegin(), children_[i].rend());
        }
    }

    void emitObject(std::int32_t i) {
        ParsedObject& object = objects_[i];
        const auto offset = static_cast<model::PolygonIndex>(model_.polygons.size());
        for (model::Polygon& polygon : object.polygons) model_.polygons.push_back(std::move(polygon));
        if (!object.anchors.empty()) {
            anchors_.resize(offset, georeference::kNoAnchor);
            anchors_.insert(anchors_.end(), object.anchors.begin(), object.anchors.end());
        }
        object.polygons = {};
        shiftPolygons(object.feature, offset);
        if (object.feature.id.empty()) nameObject(object);
        const std::int32_t parent = parents_[i];
        featureOf_[i] =
            model_.addFeature(std::move(object.feature), parent == kNone ? model::kNoFeature : featureOf_[parent]);
        emitSurfaces(i, offset);
    }

    // The key "" is an id that no query can name.
    void nameObject(ParsedObject& object) {
        std::string& id = object.feature.id;
        for (std::size_t number = 1; id.empty() || isTaken(id); ++number)
            id = fmt::format("{}[{}]", object.feature.className, number);
        diagnostics_.add(Severity::Note, Code::MissingId,
                         fmt::format("a city object has an empty id; it gets '{}'", id),
                         {std::string(file_), object.feature.line, 0, id});
    }

    void emitSurfaces(std::int32_t i, model::PolygonIndex offset) {
        ParsedObject& object = objects_[i];
        std::map<std::string, std::size_t, std::less<>> numberOfClass;
        std::vector<model::FeatureIndex> features(object.surfaces.size());
        for (std::size_t k = 0; k < object.surfaces.size(); ++k) {
            SemanticSurface& surface = object.surfaces[k];
            model::Feature& feature = surface.feature;
            const std::size_t number = ++numberOfClass[feature.className];
            if (!feature.id.empty() && isTaken(feature.id)) {
                report(Code::DuplicateId, object,
                       fmt::format("has a semantic surface with the id '{}', which is taken; it gets one of its own",
                                   shortened(feature.id)));
                feature.id.clear();
            }
            if (feature.id.empty()) feature.id = makeId(i, feature.className, number);
            shiftPolygons(feature, offset);
            const model::FeatureIndex parent = surface.parent == kNoSurface ? featureOf_[i] : features[surface.parent];
            features[k] = model_.addFeature(std::move(feature), parent);
            surfaceIds_.insert(model_.features[features[k]].id);
        }
        object.surfaces = {};
    }

    [[nodiscard]] bool isTaken(const std::string& id) const { return surfaceIds_.contains(id) || find(id) != kNone; }

    [[nodiscard]] std::string makeId(std::int32_t i, std::string_view className, std::size_t number) const {
        const std::string& objectId = objects_[i].id;
        std::string stem = shortened(objectId);
        // The removed text may be the only difference between two objects.
        if (stem.size() != objectId.size()) stem += fmt::format("#{}", i);
        const std::string id = fmt::format("{}/{}[{}]", stem, shortened(className), number);
        std::string free = id;
        for (std::size_t more = 2; isTaken(free); ++more) free = fmt::format("{}~{}", id, more);
        return free;
    }

    static void shiftPolygons(model::Feature& feature, model::PolygonIndex offset) {
        for (model::Geometry& geometry : feature.geometries)
            model::forEachUse(geometry, [offset](model::SurfaceUse& use) { use.polygon += offset; });
    }

    /// Groups with their members in the order of `children`; then all parents other than the one in the tree.
    void addMemberships() {
        std::unordered_set<std::uint64_t> known;
        const auto add = [&](std::int32_t group, std::int32_t member, std::string role) {
            if (group == kNone || member == kNone || group == member || group == claimedParents_[member]) return;
            const std::uint64_t key = std::uint64_t(featureOf_[group]) << 32 | featureOf_[member];
            if (known.insert(key).second)
                model_.memberships.push_back({featureOf_[group], featureOf_[member], std::move(role)});
        };
        for (std::size_t i = 0; i < objects_.size(); ++i) {
            const ParsedObject& object = objects_[i];
            for (std::size_t k = 0; k < object.children.size(); ++k) {
                const bool hasRole = k < object.childrenRoles.size();
                add(static_cast<std::int32_t>(i), find(object.children[k]),
                    hasRole ? object.childrenRoles[k] : std::string());
            }
        }
        for (std::size_t i = 0; i < objects_.size(); ++i)
            for (const std::string& id : objects_[i].parents) add(find(id), static_cast<std::int32_t>(i), {});
    }

    std::vector<ParsedObject> objects_;
    std::string_view file_;
    model::BuildingModel& model_;
    std::vector<Vec3d>& anchors_;
    Diagnostics& diagnostics_;
    std::unordered_map<std::string, std::int32_t> indexOfId_;
    std::vector<std::int32_t> parents_;
    std::vector<std::int32_t> claimedParents_;  ///< parents_ before cycles were broken
    std::vector<std::vector<std::int32_t>> children_;
    std::vector<model::FeatureIndex> featureOf_;
    std::unordered_set<std::string_view> surfaceIds_;
};

}  // namespace

Result<void> linkObjects(std::vector<ParsedObject> objects, std::string_view file, model::BuildingModel& model,
                         std::vector<Vec3d>& anchors, Diagnostics& diagnostics) {
    return Linker(std::move(objects), file, model, anchors, diagnostics).run();
}

}  // namespace svt::readers::cityjson
