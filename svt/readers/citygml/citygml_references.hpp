#pragma once
/// \file
/// What ids stand for, and what references by id mean. Internal to the readers.

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

/// Ids of a joined part. Holds views: the part's features, nodes, ids and polygons must stay as they are.
class References {
public:
    /// \param fileName  a reference "name.gml#id" to the file itself is no reference elsewhere
    References(const Part& part, std::string_view fileName);

    /// What a geometry reference points to: a geometry, else a feature.
    [[nodiscard]] Target geometry(std::string_view href) const { return find(href, true); }
    /// What a feature reference points to: a feature, else a geometry.
    [[nodiscard]] Target feature(std::string_view href) const { return find(href, false); }

    /// Ids of geometry that occur more than once: the later nodes.
    [[nodiscard]] const std::vector<NodeIndex>& duplicates() const noexcept { return duplicates_; }

private:
    [[nodiscard]] Target find(std::string_view href, bool prefersGeometry) const;
    [[nodiscard]] Target lookUp(std::string_view id, bool prefersGeometry) const;

    std::unordered_map<std::string_view, NodeIndex> nodes_;
    std::unordered_map<std::string_view, model::FeatureIndex> features_;
    std::vector<NodeIndex> duplicates_;
    std::string_view fileName_;
};

/// The id that `href` names: behind '#' if there is one; percent-encoding is undone by the caller where needed.
[[nodiscard]] std::string_view idOfHref(std::string_view href) noexcept;

/// "a%20b" as "a b"; what is no encoding stays.
[[nodiscard]] std::string percentDecoded(std::string_view text);

/// gml:id of a node, or empty.
[[nodiscard]] std::string_view idOfNode(const Part& part, NodeIndex node) noexcept;

}  // namespace svt::readers::citygml
