#include <svt/readers/cityjson/cityjson_crs.hpp>

#include <svt/readers/georeference/georeference.hpp>

namespace svt::readers::cityjson {

void readMetadata(const std::optional<json::element>& metadata, model::BuildingModel& model, std::string_view file,
                  Diagnostics& diagnostics) {
    if (!metadata || metadata->is_null()) return;
    const auto object = asObject(*metadata);
    if (!object) {
        diagnostics.add(Severity::Warning, Code::BadValue, "'metadata' is not a JSON object; left out",
                        {std::string(file), 0, 0, {}});
        return;
    }
    if (const auto title = findMember(*object, "title")) model.name = asString(*title).value_or(std::string_view());
    if (const auto system = findMember(*object, "referenceSystem"))
        model.crs.name = asString(*system).value_or(std::string_view());
}

Result<void> settleCrs(model::BuildingModel& model, std::string_view file, std::span<const Vec3d> anchors,
                       const ReadOptions& options, Diagnostics& diagnostics) {
    const georeference::GivenCrs given{model.crs.name, {}, true, {std::string(file), 0, 0, {}}, anchors};
    return georeference::georeference(model, given, options, diagnostics);
}

}  // namespace svt::readers::cityjson
