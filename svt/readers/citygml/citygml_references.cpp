#include <svt/readers/citygml/citygml_references.hpp>

#include <svt/readers/gml/percent_decoded.hpp>

#include <algorithm>

namespace svt::readers::citygml {
namespace {

using std::string_view;

string_view baseName(string_view path) noexcept {
    const std::size_t slash = path.find_last_of("/\\");
    return slash == string_view::npos ? path : path.substr(slash + 1);
}

bool looksLikeFile(string_view href) noexcept {
    return href.find("://") != string_view::npos || href.find('/') != string_view::npos || href.ends_with(".gml") ||
           href.ends_with(".xml");
}

}  // namespace

string_view idOfHref(string_view href) noexcept {
    const std::size_t hash = href.find('#');
    return hash == string_view::npos ? href : href.substr(hash + 1);
}

string_view idOfNode(const Part& part, NodeIndex index) noexcept {
    const Node& node = part.nodes[index];
    if (node.kind == NodeKind::Polygon) return part.polygons[node.payload].id;
    return node.id == kNone ? string_view{} : string_view(part.ids[node.id]);
}

References::References(const Part& part, string_view fileName) : fileName_(baseName(fileName)) {
    nodes_.reserve(part.ids.size() + part.polygons.size());
    for (NodeIndex i = 0; i < part.nodes.size(); ++i) {
        const string_view id = idOfNode(part, i);
        if (!id.empty() && !nodes_.emplace(id, i).second) duplicates_.push_back(i);
    }
    features_.reserve(part.features.size());
    for (model::FeatureIndex i = 0; i < part.features.size(); ++i)
        if (!part.features[i].id.empty()) features_.emplace(part.features[i].id, i);
}

Target References::lookUp(string_view id, bool prefersGeometry) const {
    const auto node = nodes_.find(id);
    const auto feature = features_.find(id);
    const bool hasNode = node != nodes_.end();
    const bool hasFeature = feature != features_.end();
    if (hasNode && (prefersGeometry || !hasFeature)) return {Target::Kind::Node, node->second};
    if (hasFeature) return {Target::Kind::Feature, feature->second};
    return {};
}

Target References::find(string_view href, bool prefersGeometry) const {
    const std::size_t hash = href.find('#');
    const string_view document = hash == string_view::npos ? string_view{} : href.substr(0, hash);
    if (!document.empty() && baseName(document) != fileName_) return {Target::Kind::Elsewhere, kNone};

    const string_view id = idOfHref(href);
    if (const Target target = lookUp(id, prefersGeometry); target.kind != Target::Kind::Nothing) return target;
    if (id.find('%') != string_view::npos || id.find(' ') != string_view::npos) {
        std::string decoded = gml::percentDecoded(id);
        const auto isSpace = [](char c) { return c == ' '; };
        decoded.erase(decoded.begin(), std::find_if_not(decoded.begin(), decoded.end(), isSpace));
        decoded.erase(std::find_if_not(decoded.rbegin(), decoded.rend(), isSpace).base(), decoded.end());
        if (const Target target = lookUp(decoded, prefersGeometry); target.kind != Target::Kind::Nothing) return target;
    }
    if (hash == string_view::npos && looksLikeFile(href)) return {Target::Kind::Elsewhere, kNone};
    return {};
}

}  // namespace svt::readers::citygml
