#include <apps/cli/check/check_reports.hpp>
#include <apps/cli/check/other_findings.hpp>
#include <apps/cli/check/use_findings.hpp>
#include <apps/cli/output/version.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <map>
#include <set>

namespace svt::cli {
namespace {

using validate::Finding;

std::string timeNow() {
    const std::time_t now = std::time(nullptr);
    std::tm utc{};
    ::gmtime_r(&now, &utc);
    return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02} (UTC)", utc.tm_year + 1900, utc.tm_mon + 1, utc.tm_mday,
                       utc.tm_hour, utc.tm_min, utc.tm_sec);
}

std::string placeText(Vec3d at) { return fmt::format("({:.3f}, {:.3f}, {:.3f})", at.x, at.y, at.z); }

Json findingJson(const model::BuildingModel& model, const Finding& finding) {
    const model::Feature& feature = model.features[finding.feature];
    const int number = validate::val3dityCode(finding.code);
    Json json{{"code", codeTag(finding.code)},
              {"name", codeName(finding.code)},
              {"val3dity", number},
              {"val3dityName", validate::val3dityName(number)},
              {"iso", validate::isoTerm(finding.code)},
              {"preventsUse", validate::preventsUse(finding.code)},
              {"feature", feature.id},
              {"class", feature.className}};
    if (finding.geometry >= 0) {
        const model::Geometry& geometry = feature.geometries[static_cast<std::size_t>(finding.geometry)];
        json["geometry"] = finding.geometry;
        json["type"] = validate::primitiveType(geometry);
        if (geometry.lod >= 0) json["lod"] = geometry.lod;
    }
    if (finding.solid >= 0) json["solid"] = finding.solid;
    if (finding.shell >= 0) json["shell"] = finding.shell;
    if (finding.polygon != validate::kNoPolygon) json["polygon"] = polygonName(model, finding);
    json["at"] = toJson(finding.at);
    if (finding.value) json["value"] = *finding.value;
    json["message"] = finding.message;
    return json;
}

Json countsJson(const std::map<std::string, validate::ValidCount>& counts) {
    Json json = Json::array();
    for (const auto& [name, count] : counts)
        json.push_back({{"type", name}, {"total", count.total}, {"valid", count.valid}});
    return json;
}

std::string val3dityPlace(const model::BuildingModel& model, const Finding& finding) {
    std::string id = "geom=" + std::to_string(std::max(finding.geometry, 0));
    if (finding.solid >= 0) id += fmt::format("|solid={}", finding.solid);
    if (finding.shell >= 0) id += fmt::format("|shell={}", finding.shell);
    if (finding.polygon != validate::kNoPolygon) id += "|face=" + polygonName(model, finding);
    return id;
}

// Findings of readers by root feature; findings without a known feature belong to the data set.
struct ErrorsByRoot {
    std::map<model::FeatureIndex, Json> errors;
    Json ofDataset = Json::array();
    Json others = Json::array();  // those that val3dity does not test
    std::map<std::string, std::size_t> otherCounts;
    std::set<int> all;
};

Json otherJson(const model::BuildingModel& model, const OtherFinding& other) {
    const Diagnostic& item = *other.item;
    Json json{
        {"code", codeTag(item.code)},       {"name", codeName(item.code)}, {"severity", severityName(item.severity)},
        {"preventsUse", preventsUse(item)}, {"id", item.where.id},         {"message", item.message}};
    if (other.feature != model::kNoFeature) json["feature"] = model.features[rootOf(model, other.feature)].id;
    if (!item.where.file.empty()) json["file"] = item.where.file;
    if (item.where.line != 0) json["line"] = item.where.line;
    return json;
}

ErrorsByRoot collectErrors(const Checked& checked) {
    ErrorsByRoot collected;
    const model::BuildingModel& model = checked.model;
    const auto add = [&](model::FeatureIndex root, int number, std::string id, std::string info) {
        collected.all.insert(number);
        const auto entry = collected.errors.try_emplace(root, Json::array()).first;
        entry->second.push_back({{"code", number},
                                 {"description", validate::val3dityName(number)},
                                 {"id", std::move(id)},
                                 {"info", std::move(info)}});
    };
    for (const OtherFinding& other : otherFindings(model, checked.others)) {
        const Diagnostic& item = *other.item;
        if (!isOfGeometry(item)) {
            collected.others.push_back(otherJson(model, other));
            ++collected.otherCounts[codeTag(item.code)];
        } else if (other.feature != model::kNoFeature) {
            add(rootOf(model, other.feature), validate::val3dityCode(item.code), item.where.id, item.message);
        } else {
            collected.ofDataset.push_back(validate::val3dityCode(item.code));
        }
    }
    for (const Finding& finding : checked.report.findings)
        add(rootOf(model, finding.feature), validate::val3dityCode(finding.code), val3dityPlace(model, finding),
            finding.message + " near " + placeText(finding.at));
    for (const Json& number : collected.ofDataset) collected.all.insert(number.get<int>());
    return collected;
}

}  // namespace

std::string polygonName(const model::BuildingModel& model, const Finding& finding) {
    if (finding.polygon == validate::kNoPolygon) return {};
    const std::string& id = model.polygons[finding.polygon].id;
    return id.empty() ? std::to_string(finding.polygon) : id;
}

void addValidationJson(Json& json, const Checked& checked) {
    Json findings = Json::array(), counts = Json::object();
    std::map<Code, std::size_t> all = checked.report.counts;
    for (const Diagnostic& item : checked.others.items()) {
        if (!isOfGeometry(item)) continue;
        if (all.count(item.code) == 0 || checked.report.counts.count(item.code) == 0) ++all[item.code];
    }
    for (const Finding& finding : checked.report.findings) findings.push_back(findingJson(checked.model, finding));
    for (const auto& [code, count] : all) counts[codeTag(code)] = count;
    json["valid"] = all.empty();
    json["findings"] = std::move(findings);
    json["counts"] = std::move(counts);
    json["features"] = countsJson(checked.report.features);
    json["primitives"] = countsJson(checked.report.primitives);
    json["polygons"] = checked.report.polygonCount;
}

Json val3dityJson(const Checked& checked, const std::string& inputFile) {
    const model::BuildingModel& model = checked.model;
    const ErrorsByRoot collected = collectErrors(checked);
    std::vector<bool> hasGeometry(model.features.size());
    for (model::FeatureIndex f = 0; f < model.features.size(); ++f)
        if (!model.features[f].geometries.empty()) hasGeometry[rootOf(model, f)] = true;
    std::map<std::string, validate::ValidCount> overview;
    Json features = Json::array();
    for (const model::FeatureIndex root : model.roots) {
        if (!hasGeometry[root]) continue;
        const auto errors = collected.errors.find(root);
        const bool isValid = errors == collected.errors.end();
        const model::Feature& feature = model.features[root];
        features.push_back({{"id", feature.id},
                            {"type", feature.className},
                            {"validity", isValid},
                            {"errors", isValid ? Json::array() : errors->second}});
        ++overview[feature.className].total;
        overview[feature.className].valid += isValid;
    }
    Json all = Json::array();
    for (const int number : collected.all) all.push_back(number);
    Json datasetErrors = collected.ofDataset;
    const std::string format = model.format.rfind("CityJSON", 0) == 0 ? "CityJSON"
                               : model.format == "IndoorGML"          ? "IndoorGML"
                                                                      : "CityGML";
    return {{"type", "val3dity_report"},
            {"val3dity_version", fmt::format("svt {}", versionNumber())},
            {"input_file", inputFile},
            {"input_file_type", format},
            {"time", timeNow()},
            {"validity", collected.all.empty()},
            {"parameters",
             {{"snap_tol", checked.options.snap},
              {"overlap_tol", checked.options.overlap},
              {"planarity_d2p_tol", checked.options.planarity},
              {"planarity_n_tol", checked.options.normalsDegrees}}},
            {"all_errors", std::move(all)},
            {"dataset_errors", std::move(datasetErrors)},
            {"features_overview", countsJson(overview)},
            {"primitives_overview", countsJson(checked.report.primitives)},
            {"features", std::move(features)},
            {"other_findings", collected.others},
            {"other_counts", collected.otherCounts}};
}

void addFindings(Diagnostics& diagnostics, const Checked& checked) {
    std::set<std::pair<Code, std::string>> known;
    // The note of the meshes that common space counts once does not replace the finding that solids of a composite overlap.
    const auto isOnlyNoted = [](const Diagnostic& item) {
        return item.code == Code::SolidsIntersect && item.severity == Severity::Note;
    };
    for (const Diagnostic& item : diagnostics.items())
        if (!isOnlyNoted(item)) known.emplace(item.code, item.where.id);
    for (const Finding& finding : checked.report.findings) {
        const model::Feature& feature = checked.model.features[finding.feature];
        std::string id = feature.id;
        if (finding.polygon != validate::kNoPolygon && !checked.model.polygons[finding.polygon].id.empty())
            id = checked.model.polygons[finding.polygon].id;
        if (known.count({finding.code, id}) != 0) continue;
        std::string message = finding.message + " near " + placeText(finding.at);
        if (id != feature.id) message += fmt::format(", of {} '{}'", feature.className, feature.id);
        Place place = checked.model.placeOf(finding.feature);
        place.id = std::move(id);
        diagnostics.add(Severity::Warning, finding.code, std::move(message), std::move(place));
    }
}

}  // namespace svt::cli
