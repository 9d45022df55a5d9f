#pragma once
/// \file
/// Resolves ids and references by id.

#include <svt/readers/citygml/citygml_part.hpp>

#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>

namespace svt::readers::citygml {

struct Target {
    enum class Kind : std::uint8_t { Nothing, Node, Feature, Elsewhere };
    Kind kind = Kind::Nothing;
    std::uint32_t index = kNone;
};

/// Ids of a joined part. Holds views: the part's features, nodes, ids and polygons must not change.
class References {
public:
    /// \param fileName  a reference "name.gml#id" to the file itself counts as internal
    References(const Part& part, std::string_view fileName);

    /// Target of a geometry reference: a geometry, else a feature.
    [[nodiscard]] Target geometry(std::string_view href) const { return find(href, true); }
    /// Target of a feature reference: a feature, else a geometry.
    [[nodiscard]] Target feature(std::string_view href) const { return find(href, false); }

    /// Duplicate geometry ids: the later nodes.
    [[nodiscard]] const std::vector<NodeIndex>& duplicates() const noexcept { return duplicates_; }

private:
    [[nodiscard]] Target find(std::string_view href, bool prefersGeometry) const;
    [[nodiscard]] Target lookUp(std::string_view id, bool prefersGeometry) const;

    std::unordered_map<std::string_view, NodeIndex> nodes_;
    std::unordered_map<std::string_view, model::FeatureIndex> features_;
    std::vector<NodeIndex> duplicates_;
    std::string_view fileName_;
};

/// The id in `href`: the text after '#' if there is one; the caller decodes percent-encoding where needed.
[[nodiscard]] std::string_view idOfHref(std::string_view href) noexcept;

/// gml:id of a node, or empty.
[[nodiscard]] std::string_view idOfNode(const Part& part, NodeIndex node) noexcept;

}  // namespace svt::readers::citygml
