#include <svt/writers/geopackage/geopackage.hpp>

#include <svt/crs/crs_name.hpp>

#include <fmt/format.h>

namespace svt::writers {
namespace {

// Tables that the standard asks for (OGC 12-128r19).
constexpr const char* kStandardTables = R"(
PRAGMA application_id=0x47504B47; PRAGMA user_version=10300;
CREATE TABLE gpkg_spatial_ref_sys(srs_name TEXT NOT NULL,srs_id INTEGER NOT NULL PRIMARY KEY,organization TEXT NOT NULL,
 organization_coordsys_id INTEGER NOT NULL,definition TEXT NOT NULL,description TEXT);
CREATE TABLE gpkg_contents(table_name TEXT NOT NULL PRIMARY KEY,data_type TEXT NOT NULL,identifier TEXT UNIQUE,
 description TEXT DEFAULT '',last_change DATETIME NOT NULL,min_x DOUBLE,min_y DOUBLE,max_x DOUBLE,max_y DOUBLE,srs_id INTEGER,
 CONSTRAINT fk_gc_r_srs_id FOREIGN KEY(srs_id) REFERENCES gpkg_spatial_ref_sys(srs_id));
CREATE TABLE gpkg_geometry_columns(table_name TEXT NOT NULL,column_name TEXT NOT NULL,geometry_type_name TEXT NOT NULL,
 srs_id INTEGER NOT NULL,z TINYINT NOT NULL,m TINYINT NOT NULL,CONSTRAINT pk_geom_cols PRIMARY KEY(table_name,column_name),
 CONSTRAINT uk_gc_table_name UNIQUE(table_name),
 CONSTRAINT fk_gc_tn FOREIGN KEY(table_name) REFERENCES gpkg_contents(table_name),
 CONSTRAINT fk_gc_srs FOREIGN KEY(srs_id) REFERENCES gpkg_spatial_ref_sys(srs_id));
)";

constexpr const char* kLastChange = "2000-01-01T00:00:00.000Z";  // so that equal models give equal bytes

}  // namespace

Result<GeoPackage> GeoPackage::create(const std::string& crsName) {
    SVT_TRY(database, makeSqliteDatabase());
    return GeoPackage(std::move(*database), crsName);
}

GeoPackage::GeoPackage(std::unique_ptr<SqliteDatabase> database, const std::string& crsName)
    : database_(std::move(database)) {
    if (const std::uint32_t epsg = crs::epsgCodeOf(crsName); epsg != 0) reference_ = epsg;
    database_->run(std::string("BEGIN;") + kStandardTables);
    const auto add = [&](const std::string& name, std::int64_t number, const char* organization,
                         const char* definition) {
        insert("gpkg_spatial_ref_sys", Row{name, number, organization, number, definition, {}});
    };
    add("Undefined Cartesian SRS", -1, "NONE", "undefined");
    add("Undefined geographic SRS", 0, "NONE", "undefined");
    add("WGS 84 geodetic", 4326, "EPSG",
        "GEOGCS[\"WGS 84\",DATUM[\"WGS_1984\",SPHEROID[\"WGS 84\",6378137,298.257223563,AUTHORITY[\"EPSG\",\"7030\"]],"
        "AUTHORITY[\"EPSG\",\"6326\"]],PRIMEM[\"Greenwich\",0,AUTHORITY[\"EPSG\",\"8901\"]],UNIT[\"degree\","
        "0.0174532925199433,AUTHORITY[\"EPSG\",\"9122\"]],AUTHORITY[\"EPSG\",\"4326\"]]");
    // Readers take the definition from their own register, by the code.
    if (reference_ > 0 && reference_ != 4326) add(crsName, reference_, "EPSG", "undefined");
}

void GeoPackage::createFeatures(const std::string& name, const char* geometryType, const std::string& columns) {
    createTable(name, fmt::format("geom {},{}", geometryType, columns));
}

void GeoPackage::createTable(const std::string& name, const std::string& columns) {
    database_->run(fmt::format("CREATE TABLE {}(fid INTEGER PRIMARY KEY AUTOINCREMENT NOT NULL,{});", name, columns));
}

void GeoPackage::describeFeatures(const std::string& name, const char* geometryType, std::int64_t reference,
                                  const MapBounds& bounds) {
    Row row{name, "features", name, "", kLastChange};
    for (const double value : {bounds.minX, bounds.minY, bounds.maxX, bounds.maxY}) {
        Cell& cell = row.emplace_back();
        if (!bounds.isEmpty()) cell = value;
    }
    row.emplace_back(reference);
    insert("gpkg_contents", row);
    insert("gpkg_geometry_columns", Row{name, "geom", geometryType, reference, 0, 0});
}

void GeoPackage::describeAttributes(const std::string& name) {
    insert("gpkg_contents", Row{name, "attributes", name, "", kLastChange, {}, {}, {}, {}, {}});
}

Result<std::string> GeoPackage::finish() {
    database_->run("COMMIT;");
    return database_->bytes();
}

}  // namespace svt::writers
