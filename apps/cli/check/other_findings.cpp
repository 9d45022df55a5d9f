#include <apps/cli/check/other_findings.hpp>

#include <unordered_map>

namespace svt::cli {

bool isOfGeometry(const Diagnostic& item) noexcept {
    return item.code == Code::TooFewPoints || item.code == Code::RingNotClosed || item.code == Code::DualityBroken;
}

model::FeatureIndex rootOf(const model::BuildingModel& model, model::FeatureIndex feature) noexcept {
    while (model.features[feature].parent != model::kNoFeature) feature = model.features[feature].parent;
    return feature;
}

std::vector<OtherFinding> otherFindings(const model::BuildingModel& model, const Diagnostics& diagnostics) {
    std::unordered_map<std::string, model::FeatureIndex> byId;
    for (model::FeatureIndex f = 0; f < model.features.size(); ++f) {
        byId.emplace(model.features[f].id, f);
        for (const model::Geometry& geometry : model.features[f].geometries)
            for (const model::SurfaceUse& use : geometry.surfaces) byId.emplace(model.polygons[use.polygon].id, f);
    }
    std::vector<OtherFinding> found;
    for (const Diagnostic& item : diagnostics.items()) {
        if (item.severity == Severity::Note) continue;
        const auto known = item.where.id.empty() ? byId.end() : byId.find(item.where.id);
        found.push_back({&item, known == byId.end() ? model::kNoFeature : known->second});
    }
    return found;
}

}  // namespace svt::cli
