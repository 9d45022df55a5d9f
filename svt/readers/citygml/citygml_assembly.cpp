#include <svt/readers/citygml/citygml_assembly.hpp>

#include <svt/model/classes.hpp>
#include <svt/model/surface_uses.hpp>
#include <svt/readers/citygml/citygml_materials.hpp>
#include <svt/readers/citygml/citygml_references.hpp>
#include <svt/readers/citygml/citygml_resolver.hpp>
#include <svt/readers/georeference/georeference.hpp>
#include <svt/readers/gml/gml_crs.hpp>
#include <svt/readers/textures/texture_colors.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <unordered_map>
#include <unordered_set>

namespace svt::readers::citygml {
namespace {

using model::BuildingModel;
using model::Feature;
using model::FeatureIndex;
using std::string_view;

// Work limit for following references, base and per byte of the file; see GeometryResolver.
constexpr std::uint64_t kBudgetBase = 16'000'000;
constexpr std::uint64_t kBudgetPerByte = 10;

class Assembly {
public:
    Assembly(Part&& part, const DocumentFacts& facts, const ReadOptions& options, Diagnostics& diagnostics)
        : part_(std::move(part)), facts_(facts), options_(options), diagnostics_(diagnostics) {}

    Result<BuildingModel> run() {
        makeIdsUnique();
        makeMissingIds();
        const References references(part_, facts_.fileName);
        for (const NodeIndex node : references.duplicates())
            report(Severity::Warning, Code::DuplicateId, "this id was used before; references mean its first use",
                   part_.nodes[node].offset, idOfNode(part_, node));
        followLinks(references);
        const GeometriesByFeature geometries(part_);
        GeometryResolver resolver(part_, references, geometries, kBudgetBase + kBudgetPerByte * facts_.bytes,
                                  [this](Severity severity, Code code, std::string message, std::uint64_t offset,
                                         string_view id) { report(severity, code, std::move(message), offset, id); });
        applyMaterials(part_, references, resolver, geometries, materials_);
        if constexpr (textures::kReadsTextures)
            if (!options_.imageFolder.empty()) textures_ = applyTextures(part_, references, resolver, materials_);
        std::vector<std::vector<model::Geometry>> resolved = resolveAll(resolver, geometries);
        if (resolver.isOverBudget())
            return Error(Code::InputTooBig,
                         fmt::format("references repeat the geometry too often: more than {} elements would be read "
                                     "from a file of {} bytes",
                                     kBudgetBase + kBudgetPerByte * facts_.bytes, facts_.bytes),
                         {facts_.fileName, 0, 0, {}});
        for (std::size_t i = 0; i < resolved.size(); ++i) part_.features[i].geometries = std::move(resolved[i]);
        if (!resolver.anchors().empty()) {
            anchors_.resize(part_.polygons.size(), georeference::kNoAnchor);
            anchors_.insert(anchors_.end(), resolver.anchors().begin(), resolver.anchors().end());
        }
        std::move(resolver.placedPolygons().begin(), resolver.placedPolygons().end(),
                  std::back_inserter(part_.polygons));
        dropUnusedPolygons();
        noteUnknown();
        noteUndeclared();
        noteEmpty();
        return finish();
    }

private:
    void report(Severity severity, Code code, std::string message, std::uint64_t offset, string_view id) {
        // Findings beyond the limit are only counted, because finding their line means scanning the file again.
        const bool isKept = diagnostics_.count(code) < Diagnostics::kKeptPerCode;
        diagnostics_.add(severity, code, std::move(message),
                         isKept ? Place{facts_.fileName, facts_.lineOf(offset), 0, std::string(id)} : Place{});
    }

    // The first feature keeps its id; later ones get "_2", "_3".
    void makeIdsUnique() {
        std::unordered_set<string_view> used;
        std::vector<FeatureIndex> duplicates;
        used.reserve(part_.features.size());
        for (FeatureIndex i = 0; i < part_.features.size(); ++i) {
            const std::string& id = part_.features[i].id;
            if (!id.empty() && !used.insert(id).second) duplicates.push_back(i);
        }
        std::unordered_map<std::string, std::uint32_t> counters;
        std::unordered_set<std::string> made;
        for (const FeatureIndex i : duplicates) {
            std::string& id = part_.features[i].id;
            std::uint32_t& counter = counters.try_emplace(id, 1).first->second;
            std::string unique;
            do unique = fmt::format("{}_{}", id, ++counter);
            while (used.count(unique) != 0 || made.count(unique) != 0);
            report(Severity::Warning, Code::DuplicateId,
                   fmt::format("this id was used before; this {} is now '{}'", part_.features[i].className, unique),
                   part_.featureOffsets[i], id);
            made.insert(unique);
            id = std::move(unique);
        }
    }

    // "parent/WallSurface[2]": the second WallSurface of its parent, counted among all features of the class.
    void makeMissingIds() {
        std::unordered_set<std::string> used;
        std::size_t missing = 0;
        for (const Feature& feature : part_.features) missing += feature.id.empty() ? 1 : 0;
        if (missing == 0) return;
        for (const Feature& feature : part_.features)
            if (feature.id.find('[') != std::string::npos) used.insert(feature.id);

        struct Made {
            std::size_t count = 0;
            FeatureIndex first = 0;
        };
        std::map<string_view, Made> perClass;
        const auto nameChildren = [&](string_view parentId, const std::vector<FeatureIndex>& children) {
            std::map<string_view, std::uint32_t> ordinals;
            for (const FeatureIndex child : children) {
                Feature& feature = part_.features[child];
                const std::uint32_t ordinal = ++ordinals[feature.className];
                if (!feature.id.empty()) continue;
                std::string id =
                    fmt::format("{}{}{}[{}]", parentId, parentId.empty() ? "" : "/", feature.className, ordinal);
                while (!used.insert(id).second) id += '_';
                feature.id = std::move(id);
                Made& made = perClass[feature.className];
                if (made.count++ == 0) made.first = child;
            }
        };
        nameChildren({}, part_.roots);
        // Parents precede their children, so the parent already has its id.
        for (const Feature& feature : part_.features) nameChildren(feature.id, feature.children);
        for (const auto& [className, made] : perClass)
            report(Severity::Note, Code::MissingId,
                   fmt::format("{} features of class {} have no gml:id; ids were made from their place in the file, "
                               "this is the first",
                               made.count, className),
                   part_.featureOffsets[made.first], part_.features[made.first].id);
    }

    // Properties that are references: memberships, or geometry if the target is a geometry.
    void followLinks(const References& references) {
        for (Link& link : part_.links) {
            const std::string& href = part_.hrefs[link.href];
            const Target target = references.feature(href);
            const Feature& owner = part_.features[link.feature];
            const auto shown = string_view(href).substr(0, 200);
            if (target.kind == Target::Kind::Feature) {
                if (target.index == link.feature) {
                    report(Severity::Warning, Code::ReferenceCycle,
                           fmt::format("{} '{}' refers to itself", owner.className, shown), link.offset, owner.id);
                    continue;
                }
                const bool isGroupMember = link.property == "groupMember";
                std::string role = link.role.empty() && !isGroupMember ? link.property : std::move(link.role);
                memberships_.push_back({link.feature, target.index, std::move(role)});
            } else if (target.kind == Target::Kind::Node) {
                part_.geometries.push_back({link.feature, target.index, -1});
            } else if (target.kind == Target::Kind::Elsewhere) {
                report(Severity::Warning, Code::ExternalReference,
                       fmt::format("{} '{}' is in another file, which is not read", link.property, shown), link.offset,
                       owner.id);
            } else {
                report(Severity::Warning, Code::DanglingReference,
                       fmt::format("{}: nothing in this file has the id '{}'", link.property, idOfHref(shown)),
                       link.offset, owner.id);
            }
        }
    }

    std::vector<std::vector<model::Geometry>> resolveAll(GeometryResolver& resolver,
                                                         const GeometriesByFeature& geometries) {
        std::vector<std::vector<model::Geometry>> all(part_.features.size());
        for (FeatureIndex i = 0; i < part_.features.size() && !resolver.isOverBudget(); ++i)
            for (const FeatureGeometry* geometry = geometries.begin(i); geometry != geometries.end(i); ++geometry)
                addGeometries(all[i], resolver, i, *geometry);
        return all;
    }

    void addGeometries(std::vector<model::Geometry>& geometries, GeometryResolver& resolver, FeatureIndex feature,
                       const FeatureGeometry& geometry) {
        const double lod = geometry.lod >= 0 ? geometry.lod : statedLod(feature);
        Resolved resolved = resolver.resolve(geometry.node, lod, part_.features[feature].id);
        const std::string id(idOfNode(part_, geometry.node));
        if (!resolved.solids.empty()) {
            model::Geometry solids;
            solids.kind = model::GeometryKind::Solid;
            solids.lod = lod;
            solids.id = id;
            solids.isComposite = part_.nodes[geometry.node].isComposite;
            solids.solids = std::move(resolved.solids);
            geometries.push_back(std::move(solids));
        }
        if (!resolved.surfaces.empty()) {
            model::Geometry surfaces;
            surfaces.kind = model::GeometryKind::Surface;
            surfaces.lod = lod;
            surfaces.id = id;
            surfaces.isComposite = part_.nodes[geometry.node].isComposite && resolved.solids.empty();
            surfaces.surfaces = std::move(resolved.surfaces);
            geometries.push_back(std::move(surfaces));
        }
    }

    // Relief features state their level of detail in a separate property.
    [[nodiscard]] double statedLod(FeatureIndex feature) const {
        for (int up = 0; up < 2 && feature != model::kNoFeature; ++up) {
            for (const Attribute& attribute : part_.features[feature].attributes)
                if (attribute.name == "lod")
                    if (const auto* lod = std::get_if<std::int64_t>(&attribute.value); lod && *lod >= 0 && *lod <= 4)
                        return static_cast<double>(*lod);
            feature = part_.features[feature].parent;
        }
        return -1;
    }

    // Prototypes and polygons of rejected geometry.
    void dropUnusedPolygons() {
        std::vector<std::uint32_t> newIndex(part_.polygons.size(), kNone);
        const auto forEachUse = [this](auto&& visit) {
            for (Feature& feature : part_.features)
                for (model::Geometry& geometry : feature.geometries) model::forEachUse(geometry, visit);
        };
        forEachUse([&](const model::SurfaceUse& use) { newIndex[use.polygon] = 0; });
        std::uint32_t kept = 0;
        for (std::uint32_t& index : newIndex)
            if (index != kNone) index = kept++;
        if (kept == newIndex.size()) return;
        for (std::size_t i = 0; i < newIndex.size(); ++i) {
            if (newIndex[i] == kNone || newIndex[i] == i) continue;
            part_.polygons[newIndex[i]] = std::move(part_.polygons[i]);
            if (!anchors_.empty()) anchors_[newIndex[i]] = anchors_[i];
        }
        part_.polygons.resize(kept);
        if (!anchors_.empty()) anchors_.resize(kept);
        forEachUse([&](model::SurfaceUse& use) { use.polygon = newIndex[use.polygon]; });
    }

    void noteUnknown() {
        for (std::size_t i = 0; i < part_.unknownNames.size(); ++i)
            report(Severity::Note, Code::UnknownElement,
                   fmt::format("<{}> is not known and was skipped wherever it occurs", part_.unknownNames[i]),
                   part_.unknownOffsets[i], {});
    }

    void noteUndeclared() {
        for (const Part::Prefix& prefix : part_.undeclared)
            report(
                Severity::Warning, Code::BadXml,
                fmt::format(
                    "the prefix '{0}' at <{1}> is not declared (xmlns:{0}), so names with it do not have a namespace: "
                    "their meaning is unknown, and they may be missing from the model",
                    prefix.name, prefix.element),
                prefix.offset, {});
    }

    void noteEmpty() {
        std::vector<bool> isGroup(part_.features.size(), false);
        for (const auto& membership : memberships_) isGroup[membership.group] = true;
        bool hasGeometry = false;
        for (FeatureIndex i = 0; i < part_.features.size(); ++i) {
            const Feature& feature = part_.features[i];
            hasGeometry = hasGeometry || !feature.geometries.empty();
            const bool isEmpty = feature.geometries.empty() && feature.children.empty() && !isGroup[i];
            if (isEmpty)
                report(Severity::Note, Code::NoGeometry,
                       fmt::format("this {} has no geometry that bounds anything, and no parts", feature.className),
                       part_.featureOffsets[i], feature.id);
        }
        if (!hasGeometry)
            diagnostics_.add(Severity::Warning, Code::EmptyModel, "no feature of this file has geometry",
                             {facts_.fileName, 0, 0, {}});
    }

    // A model of footprints has no volume, even if it names walls.
    Result<void> checkHeights() {
        if (part_.flatRings == 0) return {};
        const Place first{facts_.fileName, facts_.lineOf(part_.firstFlat), 0, {}};
        if (options_.extrudeFootprints) return {};
        if (part_.fullRings == 0)
            return Error(Code::NoHeights,
                         fmt::format("all {} rings have points of two numbers (srsDimension=\"2\"), this is the first: "
                                     "without heights there is no volume; take a model with heights, or "
                                     "where the attributes have some --extrude-footprints",
                                     part_.flatRings),
                         first);
        diagnostics_.add(Severity::Warning, Code::NoHeights,
                         fmt::format("{} of {} rings have points of two numbers and are taken at height 0, this is the "
                                     "first",
                                     part_.flatRings, part_.flatRings + part_.fullRings),
                         first);
        return {};
    }

    Result<BuildingModel> finish() {
        SVT_DO(checkHeights());
        BuildingModel model;
        model.source = facts_.fileName;
        model.format = facts_.format;
        model.name = std::move(part_.modelName);
        model.features = std::move(part_.features);
        model.roots = std::move(part_.roots);
        model.polygons = std::move(part_.polygons);
        model.materials = std::move(materials_);
        model.memberships = std::move(part_.memberships);
        model.memberships.insert(model.memberships.end(), memberships_.begin(), memberships_.end());
        if constexpr (textures::kReadsTextures)
            SVT_DO(textures::colorTextured(model, textures_, facts_.fileName, options_, diagnostics_));
        SVT_DO(settleCrs(model));
        return model;
    }

    Result<void> settleCrs(BuildingModel& model) {
        georeference::GivenCrs given;
        given.anchors = anchors_;
        given.place.file = facts_.fileName;
        if (!part_.crsNames.empty()) {
            const CrsName& first = part_.crsNames.front();
            given.name = first.name;
            given.units = first.units;
            given.place.line = facts_.lineOf(first.offset);
        }
        for (const CrsName& other : part_.crsNames)
            if (!gml::isSameCrs(given.name, other.name))
                report(Severity::Warning, Code::MixedCrs,
                       fmt::format("srsName '{}' differs from the file's '{}'; all coordinates are taken to be in the "
                                   "latter",
                                   other.name, given.name),
                       other.offset, {});
        return georeference::georeference(model, given, options_, diagnostics_);
    }

    Part part_;
    const DocumentFacts& facts_;
    const ReadOptions& options_;
    Diagnostics& diagnostics_;
    std::vector<model::Material> materials_;
    textures::TextureSet textures_;
    std::vector<model::Membership> memberships_;
    std::vector<Vec3d> anchors_;  // see GivenCrs
};

}  // namespace

Result<BuildingModel> assemble(Part&& part, const DocumentFacts& facts, const ReadOptions& options,
                               Diagnostics& diagnostics) {
    return Assembly(std::move(part), facts, options, diagnostics).run();
}

}  // namespace svt::readers::citygml
