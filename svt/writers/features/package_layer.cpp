#include <svt/writers/features/package_layer.hpp>

#include <svt/core/file.hpp>
#include <svt/writers/features/attribute_rows.hpp>
#include <svt/writers/features/plan_blob.hpp>
#include <svt/writers/geopackage/geopackage.hpp>

#include <utility>

namespace svt::writers {
namespace {

constexpr const char *kTable = "features", *kRoofs = "roofs", *kValues = "attribute_values",
                     *kGeometryType = "MULTIPOLYGON";

// The columns in SQL.
std::string sqlColumns(const std::vector<Column>& columns) {
    std::string list;
    for (const Column& column : columns) {
        list += list.empty() ? "\"" : ",\"";
        for (const char c : column.name) list.append(c == '"' ? 2 : 1, c);
        list += column.type == CellType::Text ? "\" TEXT" : column.type == CellType::Whole ? "\" INTEGER" : "\" DOUBLE";
    }
    return list;
}

class PackageLayer : public FeatureLayer {
public:
    PackageLayer(std::filesystem::path path, GeoPackage package, const std::vector<Column>& columns, Options options)
        : path_(std::move(path)), package_(std::move(package)), options_(options) {
        package_.createFeatures(kTable, kGeometryType, sqlColumns(columns));
        if (options_.hasRoofs) package_.createFeatures(kRoofs, kGeometryType, sqlColumns(columns));
        if (options_.hasLists)
            package_.createTable(kValues,
                                 "feature_fid INTEGER NOT NULL REFERENCES features(fid),feature TEXT,name TEXT,record "
                                 "INTEGER,position INTEGER,value TEXT,unit TEXT");
    }

    Result<void> add(const Feature& feature) override {
        insert(kTable, feature.cells, feature.footprint, bounds_);
        if (options_.hasRoofs) insert(kRoofs, feature.cells, feature.roof, roofBounds_);
        ++count_;
        for (const AttributeList& list : feature.lists)
            forEachValue(cellText(feature.cells.front()), list, [&](const Row& value) {
                Row row{Cell(), count_};
                row.insert(row.end(), value.begin(), value.end());
                package_.insert(kValues, row);
            });
        return {};
    }

    Result<std::uint64_t> finish() override {
        package_.describeFeatures(kTable, kGeometryType, package_.reference(), bounds_);
        if (options_.hasRoofs) package_.describeFeatures(kRoofs, kGeometryType, package_.reference(), roofBounds_);
        if (options_.hasLists) package_.describeAttributes(kValues);
        SVT_TRY(bytes, package_.finish());
        return writeFileAtomically(path_, *bytes);
    }

private:
    void insert(const char* table, std::span<const Cell> cells, Polygons polygons, MapBounds& all) {
        Row row(2);
        if (!polygons.empty()) {
            const MapBounds bounds = boundsOf(polygons);
            all.add(bounds);
            GeometryBlob blob(package_.reference(), bounds);
            addMultiPolygon(blob, polygons);
            row[1] = blob.take();
        }
        row.insert(row.end(), cells.begin(), cells.end());
        package_.insert(table, row);
    }

    std::filesystem::path path_;
    GeoPackage package_;
    Options options_;
    MapBounds bounds_, roofBounds_;
    std::int64_t count_ = 0;  // also the fid of the last feature
};

}  // namespace

Result<std::unique_ptr<FeatureLayer>> makePackageLayer(const std::filesystem::path& path,
                                                       const std::vector<Column>& columns, const std::string& crsName,
                                                       FeatureLayer::Options options) {
    SVT_TRY(package, GeoPackage::create(crsName));
    return std::unique_ptr<FeatureLayer>(std::make_unique<PackageLayer>(path, std::move(*package), columns, options));
}

}  // namespace svt::writers
