#include <svt/readers/indoorgml/indoor_graph.hpp>

#include <svt/core/text.hpp>
#include <svt/readers/gml/gml_numbers.hpp>
#include <svt/readers/indoorgml/indoor_xml.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>

namespace svt::readers::indoor {
namespace {

using model::FeatureIndex;
using model::kNoFeature;
using pugi::xml_node;
using std::string_view;

// A reference in the file.
struct Link {
    std::string id;    // empty: none within this file
    std::string text;  // as written
    xml_node node;
};

struct State {
    xml_node node;
    std::string id;  // gml:id
    FeatureIndex feature = kNoFeature, cell = kNoFeature;
    std::optional<Vec3d> at;
    std::optional<Link> duality;
    std::vector<Link> connects;
};

struct Transition {
    xml_node node;
    std::string id;
    FeatureIndex feature = kNoFeature;
    std::vector<Link> ends;
    std::vector<Vec3d> points;
    bool isBetweenLayers = false;
};

class GraphReader {
public:
    GraphReader(const GraphDocument& document, model::BuildingModel& model, Diagnostics& diagnostics)
        : document_(document), model_(model), diagnostics_(diagnostics) {}

    void run() {
        for (const auto& [node, cell] : document_.cells) {
            const std::vector<Link> links = linksOf(node, "duality");
            if (!links.empty()) dualityOfCell_.emplace(cell, links.front());
        }
        readElements();
        for (std::size_t s = 0; s < states_.size(); ++s)
            if (!states_[s].id.empty()) stateOfId_.emplace(states_[s].id, s);
        for (std::size_t t = 0; t < transitions_.size(); ++t)
            if (!transitions_[t].id.empty()) transitionOfId_.emplace(transitions_[t].id, t);
        checkCells();
        for (State& state : states_) finishState(state);
        for (Transition& transition : transitions_) finishTransition(transition);
        connectCells();
        addMembers();
        std::stable_sort(model_.lines.begin(), model_.lines.end(),
                         [](const auto& a, const auto& b) { return a.feature < b.feature; });
    }

private:
    static std::vector<Link> linksOf(xml_node node, string_view property) {
        std::vector<Link> links;
        for (const xml_node child : node.children()) {
            if (localName(child) != property) continue;
            const string_view text = attributeOf(child, "href");
            if (!text.empty()) links.push_back({target(child), std::string(text.substr(0, 200)), child});
        }
        return links;
    }

    void report(Code code, xml_node node, FeatureIndex feature, std::string message) {
        diagnostics_.add(Severity::Warning, code, std::move(message),
                         document_.placeOf(node, model_.features[feature].id));
    }

    // False if it is not a number.
    static bool addWeight(const std::string& text, model::Feature& feature) {
        const auto weight = parseNumber(text);
        feature.attributes.push_back({"weight", weight ? AttributeValue(*weight) : AttributeValue(text), ""});
        return weight.has_value();
    }

    FeatureIndex addFeature(xml_node node, string_view className, FeatureIndex parent) {
        model::Feature feature;
        bool hasBadWeight = false;
        feature.id = document_.uniqueId(node, localName(node));
        feature.className = className;
        feature.line = document_.placeOf(node, {}).line;
        for (const xml_node child : node.children()) {
            const string_view name = localName(child);
            const std::string text(withoutBlanks(child.text().get()));
            if (text.empty()) continue;
            if (name == "name" && feature.name.empty())
                feature.name = text;
            else if (name == "description" || name == "usage" || name == "class" || name == "function" ||
                     name == "typeOfTopoExpression" || name == "comment")
                feature.attributes.push_back({std::string(name), text, ""});
            else if (name == "weight")
                hasBadWeight = !addWeight(text, feature) || hasBadWeight;
        }
        const FeatureIndex added = model_.addFeature(std::move(feature), parent);
        if (hasBadWeight)
            report(Code::BadValue, node, added, "the value of 'weight' is not a number; it is kept as text");
        return added;
    }

    void readElements() {
        for (xml_node node = document_.root; node; node = nextNode(node, document_.root)) {
            const string_view name = localName(node);
            if (name == "SpaceLayer" || name == "ThematicLayer") {
                const FeatureIndex layer = addFeature(node, "CityObjectGroup", kNoFeature);
                layers_.emplace(node.internal_object(), layer);
            } else if (isState(name) && !attributeOf(node, "id").empty()) {
                State state{node, std::string(attributeOf(node, "id")), {}, {}, {}, {}, linksOf(node, "connects")};
                state.feature = addFeature(node, "State", layerOf(node));
                state.cell = kNoFeature;
                if (auto links = linksOf(node, "duality"); !links.empty()) state.duality = links.front();
                const std::vector<Vec3d> points = pointsOf(node, state.feature);
                if (!points.empty()) state.at = points.front();
                states_.push_back(std::move(state));
            } else if (isTransition(name) || name == "InterLayerConnection") {
                const bool isBetween = name == "InterLayerConnection";
                Transition transition{node, std::string(attributeOf(node, "id")), {}, {}, {}, isBetween};
                transition.feature = addFeature(node, isBetween ? name : "Transition", layerOf(node));
                transition.ends = linksOf(node, isBetween ? "interConnects" : "connects");
                transition.points = pointsOf(node, transition.feature);
                transitions_.push_back(std::move(transition));
            }
        }
    }

    [[nodiscard]] FeatureIndex layerOf(xml_node node) const {
        for (xml_node at = node.parent(); at; at = at.parent())
            if (const auto found = layers_.find(at.internal_object()); found != layers_.end()) return found->second;
        return kNoFeature;
    }

    // The points of the property `geometry`.
    std::vector<Vec3d> pointsOf(xml_node top, FeatureIndex feature) {
        std::vector<double> numbers;
        bool isGood = true;
        for (const xml_node geometry : top.children()) {
            if (localName(geometry) != "geometry") continue;
            for (xml_node node = nextNode(geometry, geometry); node; node = nextNode(node, geometry)) {
                const string_view name = localName(node);
                if (name != "pos" && name != "posList") continue;
                const std::size_t before = numbers.size();
                isGood = isGood && withoutBlanks(gml::parseNumbers(node.text().get(), numbers)).empty() &&
                         (name == "posList" || numbers.size() == before + 3);
            }
        }
        if (!isGood || numbers.size() % 3 != 0) {
            report(Code::BadCoordinate, top, feature, "coordinates that are not three numbers each; left out");
            return {};
        }
        std::vector<Vec3d> points;
        for (std::size_t i = 0; i + 2 < numbers.size(); i += 3)
            points.push_back({numbers[i], numbers[i + 1], numbers[i + 2]});
        if (std::all_of(points.begin(), points.end(), [](Vec3d p) { return isFinite(p); })) return points;
        report(Code::BadCoordinate, top, feature, "coordinates that are not finite; left out");
        return {};
    }

    [[nodiscard]] const State* stateOf(const Link& link) const {
        const auto found = stateOfId_.find(link.id);
        return found == stateOfId_.end() ? nullptr : &states_[found->second];
    }
    [[nodiscard]] FeatureIndex cellOf(const std::string& id) const {
        const auto found = document_.cellOfId.find(id);
        return found == document_.cellOfId.end() ? kNoFeature : found->second;
    }

    // Some writers give the cell space itself where a state is meant.
    [[nodiscard]] FeatureIndex cellBehind(const Link& link) const {
        const State* state = stateOf(link);
        return state != nullptr ? state->cell : cellOf(link.id);
    }

    void checkCells() {
        for (const auto& [node, cell] : document_.cells) {
            const auto link = dualityOfCell_.find(cell);
            if (link == dualityOfCell_.end()) continue;
            const State* state = stateOf(link->second);
            const std::string id(attributeOf(node, "id"));
            if (state == nullptr)
                report(Code::DualityBroken, node, cell,
                       fmt::format("its duality '{}' is not a state of this file", link->second.text));
            else if (!state->duality || state->duality->id != id)
                report(Code::DualityBroken, node, cell,
                       fmt::format("its duality is the state '{}', whose duality is {}", state->id,
                                   state->duality ? "'" + state->duality->text + "'" : "missing"));
        }
    }

    // Its cell space names a state that does not agree. In several layers, it may name that of another one.
    [[nodiscard]] bool isContradicted(const State& state) const {
        const auto link = dualityOfCell_.find(state.cell);
        if (link == dualityOfCell_.end() || link->second.id == state.id) return false;
        const State* named = stateOf(link->second);
        return named == nullptr || !named->duality || cellOf(named->duality->id) != state.cell;
    }

    void finishState(State& state) {
        model::Feature& feature = model_.features[state.feature];
        if (state.duality) {
            state.cell = cellOf(state.duality->id);
            if (state.cell == kNoFeature)
                report(Code::DualityBroken, state.node, state.feature,
                       fmt::format("its duality '{}' is not a cell space of this file", state.duality->text));
            else if (!isContradicted(state))
                feature.attributes.push_back({"duality", model_.features[state.cell].id, ""});
        }
        for (const Link& link : state.connects) {
            const auto found = transitionOfId_.find(link.id);
            if (found == transitionOfId_.end()) {
                report(Code::DualityBroken, link.node, state.feature,
                       fmt::format("it connects '{}', which is not a transition of this file", link.text));
                continue;
            }
            const auto& ends = transitions_[found->second].ends;
            if (std::none_of(ends.begin(), ends.end(), [&](const Link& end) { return end.id == state.id; }))
                report(Code::DualityBroken, link.node, state.feature,
                       fmt::format("it connects the transition '{}', which does not lead to it", link.id));
        }
        if (state.at) model_.lines.push_back({state.feature, {*state.at}});
    }

    void finishTransition(Transition& transition) {
        if (transition.ends.size() != 2)
            report(Code::DualityBroken, transition.node, transition.feature,
                   fmt::format("it connects {} states; two are expected", transition.ends.size()));
        constexpr const char* kNames[] = {"from", "to"};
        std::vector<Vec3d> straight;
        for (std::size_t e = 0; e < transition.ends.size(); ++e) {
            const State* state = stateOf(transition.ends[e]);
            if (state == nullptr) {
                report(Code::DualityBroken, transition.node, transition.feature,
                       fmt::format("it connects '{}', which is not a state of this file", transition.ends[e].text));
                continue;
            }
            if (e < 2)
                model_.features[transition.feature].attributes.push_back(
                    {kNames[e], model_.features[state->feature].id, ""});
            if (state->at) straight.push_back(*state->at);
        }
        for (const Link& link : linksOf(transition.node, "duality")) {
            if (!document_.hasId(link.id))
                report(Code::DanglingReference, transition.node, transition.feature,
                       fmt::format("its duality '{}' is not in this file", link.text));
            else
                model_.features[transition.feature].attributes.push_back({"duality", link.id, ""});
        }
        if (transition.points.size() < 2) transition.points = std::move(straight);
        if (transition.points.size() > 1) model_.lines.push_back({transition.feature, std::move(transition.points)});
    }

    static void addIds(model::Feature& feature, const char* name, const std::set<std::string>& ids) {
        std::string text;
        for (const std::string& id : ids) text += (text.empty() ? "" : "; ") + id;
        feature.attributes.push_back({name, std::move(text), ""});
    }

    void connectCells() {
        std::map<FeatureIndex, std::set<std::string>> states, beyond;
        for (const State& state : states_)
            if (state.cell != kNoFeature) states[state.cell].insert(model_.features[state.feature].id);
        for (const Transition& transition : transitions_) {
            if (transition.ends.size() != 2 || transition.isBetweenLayers) continue;
            const FeatureIndex a = cellBehind(transition.ends[0]), b = cellBehind(transition.ends[1]);
            if (a == kNoFeature || b == kNoFeature || a == b) continue;
            beyond[a].insert(model_.features[b].id);
            beyond[b].insert(model_.features[a].id);
        }
        for (const auto& [cell, ids] : states) addIds(model_.features[cell], "state", ids);
        for (const auto& [cell, ids] : beyond) addIds(model_.features[cell], "connectsTo", ids);
    }

    // Layers have the cell spaces of their states, and those that stand in them.
    void addMembers() {
        std::map<FeatureIndex, std::set<FeatureIndex>> members;
        for (const State& state : states_)
            if (const FeatureIndex layer = model_.features[state.feature].parent; layer != kNoFeature)
                if (state.cell != kNoFeature) members[layer].insert(state.cell);
        for (const auto& [node, cell] : document_.cells)
            if (const FeatureIndex layer = layerOf(node); layer != kNoFeature) members[layer].insert(cell);
        for (const auto& [layer, cells] : members)
            for (const FeatureIndex cell : cells) model_.memberships.push_back({layer, cell, "member"});
    }

    const GraphDocument& document_;
    model::BuildingModel& model_;
    Diagnostics& diagnostics_;
    std::map<FeatureIndex, Link> dualityOfCell_;
    std::unordered_map<const void*, FeatureIndex> layers_;  // by element
    std::vector<State> states_;
    std::vector<Transition> transitions_;
    std::unordered_map<std::string, std::size_t> stateOfId_, transitionOfId_;
};

}  // namespace

void addGraph(const GraphDocument& document, model::BuildingModel& model, Diagnostics& diagnostics) {
    GraphReader(document, model, diagnostics).run();
}

}  // namespace svt::readers::indoor
