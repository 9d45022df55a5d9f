#include <svt/readers/gis/gis_features.hpp>

#include <svt/crs/crs_name.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace svt::readers::gis {
namespace {

using nlohmann::json;

GisPolygon polygonOf(const json& rings) {
    GisPolygon polygon;
    if (!rings.is_array()) return polygon;
    for (const json& points : rings) {
        GisRing ring;
        if (!points.is_array()) return {};
        for (const json& point : points) {
            if (!point.is_array() || point.size() < 2 || !point[0].is_number() || !point[1].is_number()) return {};
            ring.push_back({point[0].get<double>(), point[1].get<double>(), 0});
        }
        polygon.rings.push_back(std::move(ring));
    }
    return polygon;
}

void addGeometry(const json& geometry, GisFile& file, GisFeature& feature) {
    if (!geometry.is_object()) return;
    const std::string type = geometry.value("type", std::string());
    const auto coordinates = geometry.find("coordinates");
    if (type == "Polygon" && coordinates != geometry.end()) {
        feature.polygons.push_back(polygonOf(*coordinates));
    } else if (type == "MultiPolygon" && coordinates != geometry.end() && coordinates->is_array()) {
        for (const json& rings : *coordinates) feature.polygons.push_back(polygonOf(rings));
    } else if (type == "GeometryCollection" && geometry.contains("geometries") && geometry["geometries"].is_array()) {
        // Collections of collections are not used (RFC 7946, 3.1.8).
        for (const json& part : geometry["geometries"])
            if (part.is_object() && part.value("type", std::string()) != "GeometryCollection")
                addGeometry(part, file, feature);
    } else {
        ++file.skipped;
    }
}

void addAttributes(const json& properties, GisFeature& feature) {
    if (!properties.is_object()) return;
    for (const auto& [name, value] : properties.items()) {
        if (value.is_string()) feature.attributes.push_back({name, value.get<std::string>()});
        if (value.is_boolean()) feature.attributes.push_back({name, value.get<bool>()});
        if (value.is_number_integer()) feature.attributes.push_back({name, value.get<std::int64_t>()});
        if (value.is_number_float()) feature.attributes.push_back({name, value.get<double>()});
    }
}

// The member of 2008, which newer files should not have, but many do.
void readCrs(const json& document, GisFile& file) {
    const auto crs = document.find("crs");
    if (crs == document.end() || !crs->is_object() || !crs->contains("properties")) return;
    const json& properties = (*crs)["properties"];
    if (!properties.is_object() || !properties.contains("name") || !properties["name"].is_string()) return;
    file.crsText = properties["name"].get<std::string>();
    file.epsg =
        file.crsText.find("CRS84") != std::string::npos ? 4326 : static_cast<int>(crs::epsgCodeOf(file.crsText));
    file.isUnknownCrs = file.epsg == 0;
}

// RFC 7946: coordinates are degrees. Many files have metres anyway.
bool areDegrees(const GisFile& file) {
    for (const GisFeature& feature : file.features)
        for (const GisPolygon& polygon : feature.polygons)
            for (const GisRing& ring : polygon.rings)
                for (const Vec3d& p : ring)
                    if (!(std::abs(p.x) <= 180 && std::abs(p.y) <= 90)) return false;
    return true;
}

}  // namespace

Result<GisFile> readGeoJson(std::string_view text, const std::string& name) {
    if (text.substr(0, 3) == "\xEF\xBB\xBF") text.remove_prefix(3);
    const json document = json::parse(text, nullptr, false);
    if (document.is_discarded() || !document.is_object())
        return Error(Code::BadJson, "not JSON; export the parcels again as GeoJSON", {name, 0, 0, {}});
    GisFile file;
    const auto add = [&](const json& item) {
        if (!item.is_object()) return;
        GisFeature feature;
        if (item.contains("properties")) addAttributes(item["properties"], feature);
        if (const auto id = item.find("id"); id != item.end()) {
            if (id->is_string()) feature.attributes.insert(feature.attributes.begin(), {"id", id->get<std::string>()});
            if (id->is_number_integer())
                feature.attributes.insert(feature.attributes.begin(), {"id", id->get<std::int64_t>()});
        }
        if (item.contains("geometry")) addGeometry(item["geometry"], file, feature);
        file.features.push_back(std::move(feature));
    };
    const auto features = document.find("features");
    if (features != document.end() && features->is_array()) {
        for (const json& item : *features) add(item);
    } else if (document.value("type", std::string()) == "Feature") {
        add(document);
    } else {
        return Error(Code::BadJson, "not a FeatureCollection; export the parcels as GeoJSON", {name, 0, 0, {}});
    }
    readCrs(document, file);
    if (file.crsText.empty() && areDegrees(file)) file.epsg = 4326;
    return file;
}

}  // namespace svt::readers::gis
