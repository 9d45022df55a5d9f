#pragma once
/// \file
/// The dual space of IndoorGML: states and transitions as features with lines, and checks of their links.

#include <svt/core/diagnostics.hpp>
#include <svt/model/building_model.hpp>

#include <pugixml.hpp>

#include <functional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace svt::readers::indoor {

/// Data of the document that the graph needs.
struct GraphDocument {
    pugi::xml_node root;
    std::vector<std::pair<pugi::xml_node, model::FeatureIndex>> cells;      ///< in document order
    std::unordered_map<std::string, model::FeatureIndex> cellOfId;          ///< by gml:id
    std::function<bool(const std::string&)> hasId;                          ///< of any element
    std::function<std::string(pugi::xml_node, std::string_view)> uniqueId;  ///< of a new feature
    std::function<Place(pugi::xml_node, std::string)> placeOf;
};

/// Adds to the model:
///
/// | element              | feature                                                   | line                          |
/// |----------------------|-----------------------------------------------------------|-------------------------------|
/// | SpaceLayer           | CityObjectGroup, its cell spaces as members               |                               |
/// | State (Node)         | State below its layer; `duality`: id of the cell space    | its point                     |
/// | Transition (Edge)    | Transition; `from`, `to`: ids of states; `weight`, `duality` | its curve, else straight   |
/// | InterLayerConnection | the same, with `layers`                                   | straight, from state to state |
///
/// and to cell spaces `state` (ids of their states) and `connectsTo` (ids of the cell spaces beyond).
/// Findings: DualityBroken for links between cell spaces, states and transitions that have no target or that the target
/// does not return; BadCoordinate; DanglingReference for other links.
void addGraph(const GraphDocument& document, model::BuildingModel& model, Diagnostics& diagnostics);

}  // namespace svt::readers::indoor
