#include <svt/writers/feature_layer.hpp>

#include <svt/core/file.hpp>
#include <svt/core/text.hpp>
#include <svt/crs/crs_name.hpp>
#include <svt/crs/projection.hpp>
#include <svt/writers/dense/piece_writer.hpp>
#include <svt/writers/drawing/drawing_text.hpp>
#include <svt/writers/geopackage/geopackage.hpp>
#include <svt/writers/tables/cell_json.hpp>
#include <svt/writers/tables/parquet_stream.hpp>

#include <fmt/format.h>

#include <utility>

namespace svt::writers {
namespace {

using Json = nlohmann::ordered_json;
using OutlineRing = std::span<const MapPoint>;

class CsvLayer : public FeatureLayer {
public:
    CsvLayer(AtomicFile file, const std::vector<Column>& columns) : file_(std::move(file)), text_(csvHeader(columns)) {}
    Result<void> add(std::span<const Cell> cells, OutlineRing) override {
        text_ += csvLine(cells);
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

class GeoJsonLayer : public FeatureLayer {
public:
    GeoJsonLayer(AtomicFile file, std::vector<Column> columns, const std::string& crsName)
        : file_(std::move(file)), columns_(std::move(columns)) {
        head_ = "{\"type\":\"FeatureCollection\"" + geoJsonCrs(crsName) + ",\n\"features\":[";
    }
    Result<void> add(std::span<const Cell> cells, OutlineRing outline) override {
        Json feature;
        feature["type"] = "Feature";
        feature["geometry"] = nullptr;
        if (outline.size() >= 3) {
            Json ring = Json::array();
            for (std::size_t n = 0; n <= outline.size(); ++n)
                ring.push_back({outline[n % outline.size()][0], outline[n % outline.size()][1]});
            feature["geometry"] = {{"type", "Polygon"}, {"coordinates", Json::array({ring})}};
        }
        Json properties = Json::object();
        for (std::size_t n = 0; n < cells.size(); ++n)
            if (!cells[n].isEmpty()) properties[columns_[n].name] = cellJson(cells[n]);
        feature["properties"] = std::move(properties);
        const std::string text = head_ + "\n" + feature.dump(-1, ' ', false, Json::error_handler_t::replace);
        head_ = ",";
        return file_.write(text);
    }
    Result<std::uint64_t> finish() override {
        const std::string end = head_ == "," ? "\n]}\n" : head_ + "]}\n";
        SVT_DO(file_.write(end));
        return file_.commit();
    }

private:
    AtomicFile file_;
    std::vector<Column> columns_;
    std::string head_;
};

class PackageLayer : public FeatureLayer {
public:
    PackageLayer(std::filesystem::path path, GeoPackage package, const std::vector<Column>& columns)
        : path_(std::move(path)), package_(std::move(package)) {
        std::string list;
        for (const Column& column : columns) {
            list += list.empty() ? "\"" : ",\"";
            for (const char c : column.name) list.append(c == '"' ? 2 : 1, c);
            list += column.type == CellType::Text    ? "\" TEXT"
                    : column.type == CellType::Whole ? "\" INTEGER"
                                                     : "\" DOUBLE";
        }
        package_.createFeatures(kTable, kGeometryType, list);
    }

    Result<void> add(std::span<const Cell> cells, OutlineRing outline) override {
        Row row(2);
        if (outline.size() >= 3) {
            MapBounds bounds;
            bounds.add(outline);
            bounds_.add(bounds);
            GeometryBlob blob(package_.reference(), bounds);
            blob.addPolygon(outline);
            row[1] = blob.take();
        }
        row.insert(row.end(), cells.begin(), cells.end());
        package_.insert(kTable, row);
        return {};
    }

    Result<std::uint64_t> finish() override {
        package_.describeFeatures(kTable, kGeometryType, package_.reference(), bounds_);
        SVT_TRY(bytes, package_.finish());
        return writeFileAtomically(path_, *bytes);
    }

private:
    static constexpr const char *kTable = "features", *kGeometryType = "POLYGON";

    std::filesystem::path path_;
    GeoPackage package_;
    MapBounds bounds_;
};

/// GeoParquet 1.1: outlines as well-known binary, the CRS as PROJJSON.
class GeoParquetLayer : public FeatureLayer {
public:
    GeoParquetLayer(AtomicFile file, const std::vector<Column>& columns, std::string crsName)
        : file_(std::move(file)), crsName_(std::move(crsName)), stream_(parquetColumns(columns)) {
        text_ = stream_.begin();
    }

    Result<void> add(std::span<const Cell> cells, OutlineRing outline) override {
        Row& row = rows_.emplace_back(cells.begin(), cells.end());
        Cell& geometry = row.emplace_back();
        if (outline.size() >= 3) {
            bounds_.add(outline);
            GeometryBlob blob;
            blob.addPolygon(outline);
            geometry = blob.take();
        }
        return rows_.size() < kGroupRows ? Result<void>() : flush();
    }

    Result<std::uint64_t> finish() override {
        SVT_DO(flush());
        Json geometry{{"encoding", "WKB"}, {"geometry_types", Json::array({"Polygon"})}};
        geometry["crs"] = nullptr;
        if (const auto epsg = static_cast<int>(crs::epsgCodeOf(crsName_)); epsg != 0)
            if (const std::string text = crs::projJsonOf(epsg); !text.empty())
                geometry["crs"] = Json::parse(text, nullptr, false);
        if (!bounds_.isEmpty()) geometry["bbox"] = {bounds_.minX, bounds_.minY, bounds_.maxX, bounds_.maxY};
        const Json geo{{"version", "1.1.0"}, {"primary_column", kGeometry}, {"columns", {{kGeometry, geometry}}}};
        const std::pair<std::string, std::string> notes[] = {{"geo", geo.dump()}, {"crs", crsName_}, {"unit", "metre"}};
        SVT_DO(file_.write(stream_.end(notes)));
        return file_.commit();
    }

private:
    static constexpr std::size_t kGroupRows = 16384;
    static constexpr const char* kGeometry = "geometry";

    static std::vector<ParquetColumn> parquetColumns(const std::vector<Column>& columns) {
        std::vector<ParquetColumn> result;
        for (const Column& column : columns) result.push_back({validText(column.name), column.type, true});
        result.push_back({kGeometry, CellType::Blob, true});
        return result;
    }

    Result<void> flush() {
        SVT_TRY(group, stream_.group(rows_));
        rows_.clear();
        text_ += *group;
        return file_.write(std::exchange(text_, {}));
    }

    AtomicFile file_;
    std::string crsName_, text_;
    ParquetStream stream_;
    std::vector<Row> rows_;
    MapBounds bounds_;
};

}  // namespace

Result<std::unique_ptr<FeatureLayer>> FeatureLayer::create(const std::filesystem::path& path,
                                                           std::vector<Column> columns, const std::string& crsName) {
    const std::string ending = lowerAscii(path.extension().string());
    if (ending == ".gpkg") {
        SVT_TRY(package, GeoPackage::create(crsName));
        return std::unique_ptr<FeatureLayer>(std::make_unique<PackageLayer>(path, std::move(*package), columns));
    }
    if (ending != ".csv" && ending != ".geojson" && ending != ".parquet")
        return Error(Code::BadArgument, "features are written as .csv, .geojson, .gpkg or .parquet",
                     {path.string(), 0, 0, {}});
    SVT_TRY(file, AtomicFile::create(path));
    if (ending == ".csv") return std::unique_ptr<FeatureLayer>(std::make_unique<CsvLayer>(std::move(*file), columns));
    if (ending == ".parquet")
        return std::unique_ptr<FeatureLayer>(std::make_unique<GeoParquetLayer>(std::move(*file), columns, crsName));
    return std::unique_ptr<FeatureLayer>(std::make_unique<GeoJsonLayer>(std::move(*file), std::move(columns), crsName));
}

}  // namespace svt::writers
