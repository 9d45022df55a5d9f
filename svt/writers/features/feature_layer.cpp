#include <svt/writers/feature_layer.hpp>

#include <svt/core/attribute.hpp>
#include <svt/core/file.hpp>
#include <svt/core/text.hpp>
#include <svt/crs/crs_name.hpp>
#include <svt/crs/projection.hpp>
#include <svt/writers/dense/piece_writer.hpp>
#include <svt/writers/sheets/geopackage_tables.hpp>
#include <svt/writers/sheets/sqlite_database.hpp>
#include <svt/writers/tables/csv_text.hpp>
#include <svt/writers/tables/parquet_stream.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

namespace svt::writers {
namespace {

using Json = nlohmann::ordered_json;
using Ring = std::span<const std::array<double, 2>>;

class CsvLayer : public FeatureLayer {
public:
    CsvLayer(AtomicFile file, const std::vector<FeatureColumn>& columns) : file_(std::move(file)) {
        for (const FeatureColumn& column : columns) text_.field(column.name);
        text_.endLine();
    }
    Result<void> add(std::span<const FeatureCell> cells, Ring) override {
        for (const FeatureCell& cell : cells) {
            if (const auto* text = std::get_if<std::string>(&cell)) text_.field(*text);
            if (const auto* whole = std::get_if<std::int64_t>(&cell)) text_.number(*whole);
            if (const auto* number = std::get_if<double>(&cell)) text_.number(*number);
            if (const auto* truth = std::get_if<bool>(&cell)) text_.field(*truth ? "true" : "false");
            if (std::holds_alternative<std::monostate>(cell)) text_.nothing();
        }
        text_.endLine();
        return file_.write(text_.take());
    }
    Result<std::uint64_t> finish() override {
        SVT_DO(file_.write(text_.take()));
        return file_.commit();
    }

private:
    AtomicFile file_;
    CsvText text_;
};

Json jsonOf(const FeatureCell& cell) {
    if (const auto* text = std::get_if<std::string>(&cell)) return *text;
    if (const auto* whole = std::get_if<std::int64_t>(&cell)) return *whole;
    if (const auto* number = std::get_if<double>(&cell)) return *number;
    if (const auto* truth = std::get_if<bool>(&cell)) return *truth;
    return nullptr;
}

class GeoJsonLayer : public FeatureLayer {
public:
    GeoJsonLayer(AtomicFile file, std::vector<FeatureColumn> columns, const std::string& crsName)
        : file_(std::move(file)), columns_(std::move(columns)) {
        head_ = "{\"type\":\"FeatureCollection\"";
        if (const std::uint32_t epsg = crs::epsgCodeOf(crsName); epsg != 0)
            head_ += fmt::format(
                ",\n\"crs\":{{\"type\":\"name\",\"properties\":{{\"name\":\"urn:ogc:def:crs:EPSG::{}\"}}}}", epsg);
        head_ += ",\n\"features\":[";
    }
    Result<void> add(std::span<const FeatureCell> cells, Ring outline) override {
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
            if (!std::holds_alternative<std::monostate>(cells[n])) properties[columns_[n].name] = jsonOf(cells[n]);
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
    std::vector<FeatureColumn> columns_;
    std::string head_;
};

// Well-known binary, little-endian. \param put  takes one value after the other
template <class Put>
void appendPolygon(Ring outline, const Put& put) {
    put(char{1});
    put(std::uint32_t{3});  // a polygon
    put(std::uint32_t{1});  // of one ring
    put(static_cast<std::uint32_t>(outline.size() + 1));
    for (std::size_t n = 0; n <= outline.size(); ++n)
        for (const double value : outline[n % outline.size()]) put(value);
}

class PackageLayer : public FeatureLayer {
public:
    PackageLayer(std::filesystem::path path, std::unique_ptr<SqliteDatabase> database,
                 const std::vector<FeatureColumn>& columns, const std::string& crsName)
        : path_(std::move(path)), database_(std::move(database)) {
        database_->run(std::string("BEGIN;") + kGeoPackageTables);
        if (const std::uint32_t epsg = crs::epsgCodeOf(crsName); epsg != 0) reference_ = epsg;
        addReferenceSystems(*database_, reference_, crsName);
        std::string table = "CREATE TABLE features(fid INTEGER PRIMARY KEY AUTOINCREMENT NOT NULL,geom POLYGON";
        for (const FeatureColumn& column : columns) {
            std::string quoted;
            for (const char c : column.name) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
            table += fmt::format(",\"{}\" {}", quoted,
                                 column.kind == FeatureColumn::Kind::Text    ? "TEXT"
                                 : column.kind == FeatureColumn::Kind::Whole ? "INTEGER"
                                                                             : "DOUBLE");
        }
        database_->run(table + ");");
    }

    Result<void> add(std::span<const FeatureCell> cells, Ring outline) override {
        std::vector<SqliteValue> row{SqliteValue(), SqliteValue()};
        if (outline.size() >= 3) row[1] = blobOf(outline);
        for (const FeatureCell& cell : cells) {
            SqliteValue value;
            if (const auto* text = std::get_if<std::string>(&cell)) value = *text;
            if (const auto* whole = std::get_if<std::int64_t>(&cell)) value = *whole;
            if (const auto* number = std::get_if<double>(&cell)) value = *number;
            if (const auto* truth = std::get_if<bool>(&cell)) value = std::int64_t{*truth ? 1 : 0};
            row.push_back(std::move(value));
        }
        database_->insert("features", row);
        return {};
    }

    Result<std::uint64_t> finish() override {
        const bool isEmpty = !(bounds_[0] <= bounds_[2]);
        std::vector<SqliteValue> row{std::string("features"), std::string("features"), std::string("features"),
                                     std::string(), std::string("2000-01-01T00:00:00.000Z")};
        for (const double bound : bounds_) {
            row.emplace_back();
            if (!isEmpty) row.back() = bound;
        }
        row.emplace_back(reference_);
        database_->insert("gpkg_contents", row);
        database_->insert("gpkg_geometry_columns",
                          {std::string("features"), std::string("geom"), std::string("POLYGON"), reference_,
                           std::int64_t{0}, std::int64_t{0}});
        database_->run("COMMIT;");
        SVT_TRY(bytes, database_->bytes());
        return writeFileAtomically(path_, *bytes);
    }

private:
    // A header with the extent, then well-known binary, all little-endian.
    std::vector<std::byte> blobOf(Ring outline) {
        std::array<double, 4> box{1e300, 1e300, -1e300, -1e300};
        for (const auto& [x, y] : outline)
            box = {std::min(box[0], x), std::min(box[1], y), std::max(box[2], x), std::max(box[3], y)};
        bounds_ = {std::min(bounds_[0], box[0]), std::min(bounds_[1], box[1]), std::max(bounds_[2], box[2]),
                   std::max(bounds_[3], box[3])};
        std::vector<std::byte> bytes;
        const auto put = [&](auto value) {
            static_assert(std::endian::native == std::endian::little);
            std::array<std::byte, sizeof(value)> raw;
            std::memcpy(raw.data(), &value, sizeof(value));
            bytes.insert(bytes.end(), raw.begin(), raw.end());
        };
        for (const char c : {'G', 'P', '\0', '\3'}) put(c);
        put(static_cast<std::int32_t>(reference_));
        for (const double value : {box[0], box[2], box[1], box[3]}) put(value);
        appendPolygon(outline, put);
        return bytes;
    }

    std::filesystem::path path_;
    std::unique_ptr<SqliteDatabase> database_;
    std::int64_t reference_ = -1;
    std::array<double, 4> bounds_{1e300, 1e300, -1e300, -1e300};
};

/// GeoParquet 1.1: outlines as well-known binary, the CRS as PROJJSON.
class GeoParquetLayer : public FeatureLayer {
public:
    GeoParquetLayer(AtomicFile file, const std::vector<FeatureColumn>& columns, std::string crsName)
        : file_(std::move(file)), crsName_(std::move(crsName)), stream_(parquetColumns(columns)) {
        for (const FeatureColumn& column : columns) {
            kinds_.push_back(column.kind);
            rows_.push_back({column.name, {}});
        }
        rows_.push_back({kGeometry, {}});
        text_ = stream_.begin();
    }

    Result<void> add(std::span<const FeatureCell> cells, Ring outline) override {
        for (std::size_t n = 0; n < cells.size(); ++n) rows_[n].cells.push_back(cellOf(cells[n], kinds_[n]));
        TableCell geometry;
        if (outline.size() >= 3) {
            for (const auto& [x, y] : outline)
                bounds_ = {std::min(bounds_[0], x), std::min(bounds_[1], y), std::max(bounds_[2], x),
                           std::max(bounds_[3], y)};
            std::string bytes;
            appendPolygon(outline, [&](auto value) { appendBytes(bytes, value); });
            geometry = std::move(bytes);
        }
        rows_.back().cells.push_back(std::move(geometry));
        return rows_.back().cells.size() < kGroupRows ? Result<void>() : flush();
    }

    Result<std::uint64_t> finish() override {
        SVT_DO(flush());
        Json geometry{{"encoding", "WKB"}, {"geometry_types", Json::array({"Polygon"})}};
        geometry["crs"] = nullptr;
        if (const auto epsg = static_cast<int>(crs::epsgCodeOf(crsName_)); epsg != 0)
            if (const std::string text = crs::projJsonOf(epsg); !text.empty())
                geometry["crs"] = Json::parse(text, nullptr, false);
        if (bounds_[0] <= bounds_[2]) geometry["bbox"] = bounds_;
        const Json geo{{"version", "1.1.0"}, {"primary_column", kGeometry}, {"columns", {{kGeometry, geometry}}}};
        const std::pair<std::string, std::string> notes[] = {{"geo", geo.dump()}, {"crs", crsName_}, {"unit", "metre"}};
        SVT_DO(file_.write(stream_.end(notes)));
        return file_.commit();
    }

private:
    static constexpr std::size_t kGroupRows = 16384;
    static constexpr const char* kGeometry = "geometry";

    static std::vector<ParquetColumn> parquetColumns(const std::vector<FeatureColumn>& columns) {
        std::vector<ParquetColumn> result;
        for (const FeatureColumn& column : columns)
            result.push_back({validText(column.name),
                              column.kind == FeatureColumn::Kind::Text    ? ParquetType::Text
                              : column.kind == FeatureColumn::Kind::Whole ? ParquetType::Whole
                                                                          : ParquetType::Real,
                              true, false});
        result.push_back({kGeometry, ParquetType::Text, true, true});
        return result;
    }

    static TableCell cellOf(const FeatureCell& cell, FeatureColumn::Kind kind) {
        if (std::holds_alternative<std::monostate>(cell)) return {};
        if (kind == FeatureColumn::Kind::Text)
            return std::visit([](const auto& value) -> TableCell { return value; }, cell);
        if (const auto* truth = std::get_if<bool>(&cell)) return std::int64_t{*truth ? 1 : 0};
        if (const auto* whole = std::get_if<std::int64_t>(&cell)) return *whole;
        if (const auto* number = std::get_if<double>(&cell); number != nullptr && kind == FeatureColumn::Kind::Number)
            return *number;
        return {};
    }

    Result<void> flush() {
        SVT_TRY(group, stream_.group(rows_));
        for (TableColumn& column : rows_) column.cells.clear();
        text_ += *group;
        auto written = file_.write(text_);
        text_.clear();
        return written;
    }

    AtomicFile file_;
    std::string crsName_, text_;
    ParquetStream stream_;
    std::vector<FeatureColumn::Kind> kinds_;
    std::vector<TableColumn> rows_;
    std::array<double, 4> bounds_{1e300, 1e300, -1e300, -1e300};
};

}  // namespace

Result<std::unique_ptr<FeatureLayer>> FeatureLayer::create(const std::filesystem::path& path,
                                                           std::vector<FeatureColumn> columns,
                                                           const std::string& crsName) {
    const std::string ending = lowerAscii(path.extension().string());
    if (ending == ".gpkg") {
        SVT_TRY(database, makeSqliteDatabase());
        return std::unique_ptr<FeatureLayer>(
            std::make_unique<PackageLayer>(path, std::move(*database), columns, crsName));
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
