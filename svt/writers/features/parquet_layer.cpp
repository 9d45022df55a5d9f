#include <svt/writers/features/parquet_layer.hpp>

#include <svt/core/file.hpp>
#include <svt/crs/crs_name.hpp>
#include <svt/crs/projection.hpp>
#include <svt/writers/dense/piece_writer.hpp>
#include <svt/writers/features/attribute_rows.hpp>
#include <svt/writers/features/file_beside.hpp>
#include <svt/writers/features/plan_blob.hpp>
#include <svt/writers/tables/parquet_stream.hpp>

#include <nlohmann/json.hpp>

#include <optional>
#include <utility>

namespace svt::writers {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kGeometry = "geometry";

std::vector<ParquetColumn> parquetColumns(const std::vector<Column>& columns, bool hasGeometry) {
    std::vector<ParquetColumn> result;
    for (const Column& column : columns) result.push_back({validText(column.name), column.type, true});
    if (hasGeometry) result.push_back({kGeometry, CellType::Blob, true});
    return result;
}

// A file to which rows are added in groups.
class RowFile {
public:
    RowFile(AtomicFile file, std::vector<ParquetColumn> columns) : file_(std::move(file)), stream_(std::move(columns)) {
        text_ = stream_.begin();
    }
    Result<void> add(Row row) {
        constexpr std::size_t kGroupRows = 16384;
        rows_.push_back(std::move(row));
        return rows_.size() < kGroupRows ? Result<void>() : flush();
    }
    Result<std::uint64_t> finish(std::span<const std::pair<std::string, std::string>> notes) {
        SVT_DO(flush());
        SVT_DO(file_.write(stream_.end(notes)));
        return file_.commit();
    }

private:
    Result<void> flush() {
        SVT_TRY(group, stream_.group(rows_));
        rows_.clear();
        text_ += *group;
        return file_.write(std::exchange(text_, {}));
    }

    AtomicFile file_;
    std::string text_;
    ParquetStream stream_;
    std::vector<Row> rows_;
};

// Rows with polygons.
class PlanFile {
public:
    PlanFile(AtomicFile file, const std::vector<Column>& columns, std::string crsName)
        : rows_(std::move(file), parquetColumns(columns, true)), crsName_(std::move(crsName)) {}

    Result<void> add(std::span<const Cell> cells, PlanPolygons polygons) {
        Row row(cells.begin(), cells.end());
        Cell& geometry = row.emplace_back();
        if (!polygons.empty()) {
            bounds_.add(boundsOf(polygons));
            GeometryBlob blob;
            addMultiPolygon(blob, polygons);
            geometry = blob.take();
        }
        return rows_.add(std::move(row));
    }

    Result<std::uint64_t> finish() {
        Json geometry{{"encoding", "WKB"}, {"geometry_types", Json::array({"MultiPolygon"})}};
        geometry["crs"] = nullptr;
        if (const auto epsg = static_cast<int>(crs::epsgCodeOf(crsName_)); epsg != 0)
            if (const std::string text = crs::projJsonOf(epsg); !text.empty())
                geometry["crs"] = Json::parse(text, nullptr, false);
        if (!bounds_.isEmpty()) geometry["bbox"] = {bounds_.minX, bounds_.minY, bounds_.maxX, bounds_.maxY};
        const Json geo{{"version", "1.1.0"}, {"primary_column", kGeometry}, {"columns", {{kGeometry, geometry}}}};
        const std::pair<std::string, std::string> notes[] = {{"geo", geo.dump()}, {"crs", crsName_}, {"unit", "metre"}};
        return rows_.finish(notes);
    }

private:
    RowFile rows_;
    std::string crsName_;
    MapBounds bounds_;
};

class ParquetLayer : public FeatureLayer {
public:
    ParquetLayer(PlanFile features, std::optional<PlanFile> roofs, std::optional<RowFile> values)
        : features_(std::move(features)), roofs_(std::move(roofs)), values_(std::move(values)) {}

    Result<void> add(const Feature& feature) override {
        SVT_DO(features_.add(feature.cells, feature.footprint));
        if (roofs_) SVT_DO(roofs_->add(feature.cells, feature.roof));
        if (!values_) return {};
        Result<void> added;
        for (const AttributeList& list : feature.lists)
            forEachValue(cellText(feature.cells.front()), list, [&](Row row) {
                if (added) added = values_->add(std::move(row));
            });
        return added;
    }

    Result<std::uint64_t> finish() override {
        if (values_)
            if (auto written = values_->finish({}); !written) return written;
        if (roofs_)
            if (auto written = roofs_->finish(); !written) return written;
        return features_.finish();
    }

private:
    PlanFile features_;
    std::optional<PlanFile> roofs_;
    std::optional<RowFile> values_;
};

}  // namespace

Result<std::unique_ptr<FeatureLayer>> makeParquetLayer(const std::filesystem::path& path,
                                                       const std::vector<Column>& columns, const std::string& crsName,
                                                       FeatureLayer::Options options) {
    SVT_TRY(file, AtomicFile::create(path));
    std::optional<PlanFile> roofs;
    if (options.hasRoofs) {
        SVT_TRY(beside, AtomicFile::create(fileBeside(path, "roofs")));
        roofs.emplace(std::move(*beside), columns, crsName);
    }
    std::optional<RowFile> values;
    if (options.hasLists) {
        SVT_TRY(beside, AtomicFile::create(fileBeside(path, "attributes")));
        const std::vector<Column> kColumns{
            {"feature"}, {"name"}, {"record", "", 0, CellType::Whole}, {"position", "", 0, CellType::Whole},
            {"value"},   {"unit"}};
        values.emplace(std::move(*beside), parquetColumns(kColumns, false));
    }
    return std::unique_ptr<FeatureLayer>(std::make_unique<ParquetLayer>(PlanFile(std::move(*file), columns, crsName),
                                                                        std::move(roofs), std::move(values)));
}

}  // namespace svt::writers
