#include <svt/readers/cityjson/cityjson_crs.hpp>

#include <svt/readers/gml/gml_crs.hpp>

#include <fmt/format.h>

#include <utility>

namespace svt::readers::cityjson {

void readMetadata(const std::optional<json::element>& metadata, model::BuildingModel& model, std::string_view file,
                  Diagnostics& diagnostics) {
    if (!metadata || metadata->is_null()) return;
    const auto object = asObject(*metadata);
    if (!object) {
        diagnostics.add(Severity::Warning, Code::BadValue, "'metadata' is no JSON object; left out",
                        {std::string(file), 0, 0, {}});
        return;
    }
    if (const auto title = findMember(*object, "title")) model.name = asString(*title).value_or(std::string_view());
    if (const auto system = findMember(*object, "referenceSystem")) {
        model.crs.name = asString(*system).value_or(std::string_view());
        model.crs.epsg = gml::epsgCode(model.crs.name);
    }
}

Result<void> settleCrs(model::BuildingModel& model, std::string_view file, Diagnostics& diagnostics) {
    Box3d box;
    for (const model::Polygon& polygon : model.polygons)
        for (const Vec3d& point : polygon.points) box.add(point);
    if (box.isEmpty()) return {};
    const Place place{std::string(file), 0, 0, {}};
    // The form "EPSG:n" implies no axis order; +1: the axis order of the coordinates is taken as correct.
    const std::string name = model.crs.epsg != 0 ? fmt::format("EPSG:{}", model.crs.epsg) : model.crs.name;
    const gml::AxisDecision decision = gml::decideAxes(name, box, +1);
    if (decision.isGeographic)
        return Error(Code::GeographicCrs,
                     fmt::format("the coordinates are degrees (x {} to {}, y {} to {}, CRS '{}'); project the model to "
                                 "a CRS in metres first",
                                 box.min.x, box.max.x, box.min.y, box.max.y, shortened(model.crs.name)),
                     place);
    if (!decision.remark.empty()) diagnostics.add(Severity::Warning, Code::BadValue, decision.remark, place);
    if (!decision.isNorthFirst) return {};
    for (model::Polygon& polygon : model.polygons)
        for (Vec3d& point : polygon.points) std::swap(point.x, point.y);
    model.crs.axesSwapped = true;
    return {};
}

}  // namespace svt::readers::cityjson
