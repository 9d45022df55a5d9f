#include <apps/cli/check/unit_findings.hpp>

#include <svt/analyze/label_measures.hpp>
#include <svt/analyze/legal_units.hpp>
#include <svt/model/classes.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <unordered_map>

namespace svt::cli {
namespace {

using analyze::UnitAccess;

Json accessJson(UnitAccess access) {
    switch (access) {
        case UnitAccess::Common: return "common";
        case UnitAccess::Outside: return "outside";
        case UnitAccess::None: return "none";
        case UnitAccess::Unknown: break;
    }
    return nullptr;
}

class Reporter {
public:
    Reporter(const model::BuildingModel& model, const volume::SemanticVolume& volume, Diagnostics& diagnostics)
        : model_(model), labels_(volume.labels.labels), grid_(volume.grid), diagnostics_(diagnostics) {
        for (model::FeatureIndex f = 0; f < model.features.size(); ++f) featureOf_.emplace(model.features[f].id, f);
    }

    Json report(const analyze::LegalUnits& found) {
        Json json{{"units", Json::array()}, {"overlaps", Json::array()}, {"gaps", Json::array()}};
        for (const analyze::UnitOverlap& overlap : found.overlaps) json["overlaps"].push_back(report(overlap));
        for (const analyze::StoreyGap& gap : found.gaps) json["gaps"].push_back(report(gap));
        for (const analyze::LegalUnit& unit : found.units) json["units"].push_back(report(unit));
        const auto unknown = std::count_if(found.units.begin(), found.units.end(), [](const analyze::LegalUnit& unit) {
            return unit.access == UnitAccess::Unknown;
        });
        if (unknown > 0)
            diagnostics_.add(
                Severity::Note, Code::UnitNotReached,
                fmt::format("it is unknown whether a common part reaches {} units: the model has no doors, "
                            "or no common parts",
                            unknown));
        return json;
    }

private:
    void warn(Code code, std::uint32_t label, std::string message, Severity severity = Severity::Warning) {
        const std::string& id = labels_[label].id;
        const auto feature = featureOf_.find(id);
        diagnostics_.add(
            severity, code, std::move(message),
            feature == featureOf_.end() ? Place{model_.source, 0, 0, id} : model_.placeOf(feature->second));
    }

    Json report(const analyze::UnitOverlap& overlap) {
        const std::string& other = labels_[overlap.b].id;
        const bool isExact = std::isfinite(overlap.bound);
        warn(Code::UnitsOverlap, overlap.a,
             fmt::format("the unit overlaps with '{}', by {:.3f} m3{}; cut one unit at the border of the other", other,
                         overlap.volume, isExact ? "" : " counted in voxels"));
        return {{"a", labels_[overlap.a].id},
                {"b", other},
                {"volume", overlap.volume},
                {"bound", isExact ? Json(overlap.bound) : Json(nullptr)}};
    }

    Json report(const analyze::StoreyGap& gap) {
        const Box3d box = analyze::worldBox(gap.box, grid_);
        const Vec3d middle = (box.min + box.max) * 0.5;
        warn(Code::StoreyGap, gap.storey,
             fmt::format("{:.3f} m3 of the storey belong to no unit, room or wall, near ({:.3f}, {:.3f}, {:.3f}); "
                         "extend a unit, or add the missing part",
                         gap.volume, middle.x, middle.y, middle.z));
        return {{"storey", labels_[gap.storey].id},
                {"volume", gap.volume},
                {"voxels", gap.voxels},
                {"box", {{"min", toJson(box.min)}, {"max", toJson(box.max)}}}};
    }

    Json report(const analyze::LegalUnit& unit) {
        if (unit.access == UnitAccess::None)
            warn(Code::UnitNotReached, unit.label,
                 "no common part reaches the unit, by contact or by a door; add the door, or mark the common part by "
                 "its function");
        if (unit.access == UnitAccess::Outside)
            warn(Code::UnitNotReached, unit.label, "no common part reaches the unit; a door leads outside",
                 Severity::Note);
        return {{"id", labels_[unit.label].id}, {"common", unit.isCommon}, {"access", accessJson(unit.access)}};
    }

    const model::BuildingModel& model_;
    const std::vector<volume::Label>& labels_;
    const volume::Grid& grid_;
    Diagnostics& diagnostics_;
    std::unordered_map<std::string_view, model::FeatureIndex> featureOf_;  // by id
};

}  // namespace

Json checkUnits(const model::BuildingModel& model, const pipeline::BuildOptions& options, double overlap,
                Diagnostics& diagnostics) {
    const bool hasUnits = std::any_of(model.features.begin(), model.features.end(), [](const model::Feature& feature) {
        return model::classRank(feature.className) == model::ClassRank::Unit;
    });
    if (!hasUnits) return nullptr;
    model::BuildingModel copy = model;
    pipeline::BuildOptions build = options;
    build.vectors = {.meshes = true, .isRequired = false};
    const auto built = pipeline::buildVolume(copy, build);
    if (!built) {
        diagnostics.add(Severity::Warning, built.error().code(),
                        fmt::format("the legal units were not compared: {}", built.error().message()));
        return nullptr;
    }
    const volume::SemanticVolume& volume = built->volume;
    const auto contacts = analyze::findContacts(volume.columns, volume.grid, volume.labels, options.threads);
    analyze::LegalUnitOptions tolerances;
    tolerances.depth = overlap > 0 ? 2 * overlap : 0.001;
    return Reporter(model, volume, diagnostics).report(analyze::checkLegalUnits(volume, contacts, tolerances));
}

}  // namespace svt::cli
