#include <svt/readers/citygml/citygml_part.hpp>

#include <algorithm>
#include <iterator>
#include <map>
#include <string_view>

namespace svt::readers::citygml {
namespace {

using model::FeatureIndex;

constexpr std::size_t kMaxNames = 64;  // limit on distinct srsNames or unknown elements

template <class T>
void append(std::vector<T>& to, std::vector<T>&& from) {
    if (to.empty())
        to = std::move(from);
    else
        to.insert(to.end(), std::make_move_iterator(from.begin()), std::make_move_iterator(from.end()));
}

std::uint32_t shifted(std::uint32_t index, std::uint32_t by) noexcept { return index == kNone ? kNone : index + by; }

// Numbers the records of `more` behind those of the same property in `before`.
void continueRecords(const std::vector<Attribute>& before, std::vector<Attribute>& more) {
    const auto propertyOf = [](const Attribute& attribute) {
        const std::string_view name = attribute.name;
        return name.substr(0, std::min(name.find('/'), name.size()));
    };
    std::map<std::string_view, std::uint32_t> nextOf;
    for (const Attribute& attribute : before)
        if (const std::string_view property = propertyOf(attribute); property.size() < attribute.name.size()) {
            std::uint32_t& next = nextOf[property];
            next = std::max(next, attribute.record + 1);
        }
    for (Attribute& attribute : more) {
        const std::string_view property = propertyOf(attribute);
        if (const auto known = nextOf.find(property); known != nextOf.end() && property.size() < attribute.name.size())
            attribute.record += known->second;
    }
}

// The rest of a feature that was cut at a chunk boundary; its content is added to the first piece.
void mergeFeature(model::Feature& into, model::Feature&& more) {
    if (into.name.empty()) into.name = std::move(more.name);
    continueRecords(into.attributes, more.attributes);
    append(into.attributes, std::move(more.attributes));
    append(into.children, std::move(more.children));
}

// Makes the indices of `next` those that its content gets behind that of `before`. With `mergesFirst` feature 0 of
// `next` is the last root of `before`.
void shiftIndices(Part& next, const Part& before, bool mergesFirst) {
    const auto polygonBase = static_cast<std::uint32_t>(before.polygons.size());
    const auto nodeBase = static_cast<std::uint32_t>(before.nodes.size());
    const auto idBase = static_cast<std::uint32_t>(before.ids.size());
    const auto hrefBase = static_cast<std::uint32_t>(before.hrefs.size());
    const auto placementBase = static_cast<std::uint32_t>(before.placements.size());
    const auto featureBase = static_cast<std::uint32_t>(before.features.size()) - (mergesFirst ? 1 : 0);
    const auto feature = [&](FeatureIndex index) -> FeatureIndex {
        if (index == model::kNoFeature) return index;
        return mergesFirst && index == 0 ? before.roots.back() : index + featureBase;
    };

    for (Node& node : next.nodes) {
        node.firstChild = shifted(node.firstChild, nodeBase);
        node.nextSibling = shifted(node.nextSibling, nodeBase);
        node.id = shifted(node.id, idBase);
        if (node.kind == NodeKind::Polygon) node.payload += polygonBase;
        if (node.kind == NodeKind::Reference) node.payload += hrefBase;
        if (node.kind == NodeKind::Implicit) node.payload = shifted(node.payload, placementBase);
    }
    for (FeatureGeometry& geometry : next.geometries) {
        geometry.feature = feature(geometry.feature);
        geometry.node += nodeBase;
    }
    for (Link& link : next.links) {
        link.feature = feature(link.feature);
        link.href += hrefBase;
    }
    for (model::Membership& membership : next.memberships) {
        membership.group = feature(membership.group);
        membership.member = feature(membership.member);
    }
    for (model::Feature& added : next.features) {
        added.parent = feature(added.parent);
        for (FeatureIndex& child : added.children) child = feature(child);
    }
    for (FeatureIndex& root : next.roots) root = feature(root);
}

}  // namespace

void Findings::add(Severity severity, Code code, std::string message, std::uint64_t offset, std::string id) {
    auto count = std::find_if(counts.begin(), counts.end(),
                              [&](const Count& known) { return known.code == code && known.severity == severity; });
    if (count == counts.end()) count = counts.insert(counts.end(), {severity, code, 0, 0});
    if (count->kept >= Diagnostics::kKeptPerCode) {
        ++count->dropped;
        return;
    }
    ++count->kept;
    items.push_back({severity, code, std::move(message), std::move(id), offset});
}

void Part::addUnknown(std::string_view name, std::uint64_t offset) {
    if (unknownNames.size() >= kMaxNames) return;
    if (std::find(unknownNames.begin(), unknownNames.end(), name) != unknownNames.end()) return;
    unknownNames.emplace_back(name);
    unknownOffsets.push_back(offset);
}

void Part::addUndeclared(Prefix prefix) {
    if (undeclared.size() >= kMaxNames) return;
    for (const Prefix& known : undeclared)
        if (known.name == prefix.name) return;
    undeclared.push_back(std::move(prefix));
}

void Part::addCrsName(std::string_view name, std::string_view units, std::uint64_t offset) {
    if (name.empty() || crsNames.size() >= kMaxNames) return;
    for (const CrsName& known : crsNames)
        if (known.name == name) return;
    crsNames.push_back({std::string(name), std::string(units), offset});
}

void Part::join(Part&& next) {
    const bool mergesFirst = next.continuesRoot && !next.features.empty() && !roots.empty();
    shiftIndices(next, *this, mergesFirst);
    for (MaterialRecord& record : next.materials)
        if (record.inheritsTheme) record.theme = lastTheme.value_or("");
    if constexpr (textures::kReadsTextures) {
        for (TextureRecord& record : next.textures)
            if (record.inheritsTheme) record.theme = lastTheme.value_or("");
        append(this->textures, std::move(next.textures));
    }

    auto firstFeature = next.features.begin();
    auto firstOffset = next.featureOffsets.begin();
    auto firstRoot = next.roots.begin();
    if (mergesFirst) {
        mergeFeature(features[roots.back()], std::move(*firstFeature));
        ++firstFeature, ++firstOffset, ++firstRoot;
    }
    roots.insert(roots.end(), firstRoot, next.roots.end());
    features.insert(features.end(), std::make_move_iterator(firstFeature),
                    std::make_move_iterator(next.features.end()));
    featureOffsets.insert(featureOffsets.end(), firstOffset, next.featureOffsets.end());

    append(geometries, std::move(next.geometries));
    append(links, std::move(next.links));
    append(memberships, std::move(next.memberships));
    append(polygons, std::move(next.polygons));
    append(nodes, std::move(next.nodes));
    append(ids, std::move(next.ids));
    append(hrefs, std::move(next.hrefs));
    append(placements, std::move(next.placements));
    append(materials, std::move(next.materials));
    if (next.lastTheme) lastTheme = std::move(next.lastTheme);
    if (flatRings == 0) firstFlat = next.firstFlat;
    flatRings += next.flatRings;
    fullRings += next.fullRings;
    if (modelName.empty()) modelName = std::move(next.modelName);
    for (const CrsName& crs : next.crsNames) addCrsName(crs.name, crs.units, crs.offset);
    for (std::size_t i = 0; i < next.unknownNames.size(); ++i) addUnknown(next.unknownNames[i], next.unknownOffsets[i]);
    for (Prefix& prefix : next.undeclared) addUndeclared(std::move(prefix));
}

}  // namespace svt::readers::citygml
