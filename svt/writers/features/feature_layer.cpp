#include <svt/writers/feature_layer.hpp>

#include <svt/core/file.hpp>
#include <svt/core/text.hpp>
#include <svt/writers/drawing/drawing_text.hpp>
#include <svt/writers/features/file_beside.hpp>
#include <svt/writers/features/package_layer.hpp>
#include <svt/writers/features/parquet_layer.hpp>
#include <svt/writers/tables/cell_json.hpp>

#include <optional>
#include <utility>

namespace svt::writers {
namespace {

using Json = nlohmann::ordered_json;

class CsvLayer : public FeatureLayer {
public:
    CsvLayer(AtomicFile file, const std::vector<Column>& columns) : file_(std::move(file)), text_(csvHeader(columns)) {}
    Result<void> add(const Feature& feature) override {
        text_ += csvLine(feature.cells);
        return file_.write(std::exchange(text_, {}));
    }
    Result<std::uint64_t> finish() override {
        SVT_DO(file_.write(text_));
        return file_.commit();
    }

private:
    AtomicFile file_;
    std::string text_;
};

Json polygonJson(const drawing::PlanPolygon& polygon) {
    Json rings = Json::array();
    for (const auto& ring : polygon.rings) {
        Json& points = rings.emplace_back(Json::array());
        for (std::size_t n = 0; n <= ring.size(); ++n)
            points.push_back({ring[n % ring.size()][0], ring[n % ring.size()][1]});
    }
    return rings;
}

Json geometryJson(FeatureLayer::Polygons polygons) {
    if (polygons.empty()) return nullptr;
    if (polygons.size() == 1) return {{"type", "Polygon"}, {"coordinates", polygonJson(polygons.front())}};
    Json parts = Json::array();
    for (const drawing::PlanPolygon& polygon : polygons) parts.push_back(polygonJson(polygon));
    return {{"type", "MultiPolygon"}, {"coordinates", std::move(parts)}};
}

// One file of GeoJSON.
class GeoJsonFile {
public:
    GeoJsonFile(AtomicFile file, const std::string& crsName) : file_(std::move(file)) {
        head_ = "{\"type\":\"FeatureCollection\"" + geoJsonCrs(crsName) + ",\n\"features\":[";
    }
    Result<void> add(const Json& properties, FeatureLayer::Polygons polygons) {
        Json feature;
        feature["type"] = "Feature";
        feature["geometry"] = geometryJson(polygons);
        feature["properties"] = properties;
        const std::string text = head_ + "\n" + feature.dump(-1, ' ', false, Json::error_handler_t::replace);
        head_ = ",";
        return file_.write(text);
    }
    Result<std::uint64_t> finish() {
        const std::string end = head_ == "," ? "\n]}\n" : head_ + "]}\n";
        SVT_DO(file_.write(end));
        return file_.commit();
    }

private:
    AtomicFile file_;
    std::string head_;
};

class GeoJsonLayer : public FeatureLayer {
public:
    GeoJsonLayer(GeoJsonFile features, std::optional<GeoJsonFile> roofs, std::vector<Column> columns)
        : features_(std::move(features)), roofs_(std::move(roofs)), columns_(std::move(columns)) {}

    Result<void> add(const Feature& feature) override {
        Json properties = Json::object();
        for (std::size_t n = 0; n < feature.cells.size(); ++n)
            if (!feature.cells[n].isEmpty()) properties[columns_[n].name] = cellJson(feature.cells[n]);
        SVT_DO(features_.add(properties, feature.footprint));
        return roofs_ ? roofs_->add(properties, feature.roof) : Result<void>();
    }
    Result<std::uint64_t> finish() override {
        if (roofs_)
            if (auto written = roofs_->finish(); !written) return written;
        return features_.finish();
    }

private:
    GeoJsonFile features_;
    std::optional<GeoJsonFile> roofs_;
    std::vector<Column> columns_;
};

}  // namespace

Result<std::unique_ptr<FeatureLayer>> FeatureLayer::create(const std::filesystem::path& path,
                                                           std::vector<Column> columns, const std::string& crsName,
                                                           Options options) {
    const std::string ending = lowerAscii(path.extension().string());
    if (ending == ".gpkg") return makePackageLayer(path, columns, crsName, options);
    if (ending == ".parquet") return makeParquetLayer(path, columns, crsName, options);
    if (ending != ".csv" && ending != ".geojson")
        return Error(Code::BadArgument, "features are written as .csv, .geojson, .gpkg or .parquet",
                     {path.string(), 0, 0, {}});
    SVT_TRY(file, AtomicFile::create(path));
    if (ending == ".csv") return std::unique_ptr<FeatureLayer>(std::make_unique<CsvLayer>(std::move(*file), columns));
    std::optional<GeoJsonFile> roofs;
    if (options.hasRoofs) {
        SVT_TRY(beside, AtomicFile::create(fileBeside(path, "roofs")));
        roofs.emplace(std::move(*beside), crsName);
    }
    return std::unique_ptr<FeatureLayer>(
        std::make_unique<GeoJsonLayer>(GeoJsonFile(std::move(*file), crsName), std::move(roofs), std::move(columns)));
}

}  // namespace svt::writers
