#pragma once
/// \file
/// What every GeoPackage has: its tables of contents and of reference systems.

#include <svt/writers/sheets/sqlite_database.hpp>

#include <cstdint>
#include <string>

namespace svt::writers {

/// Tables that the standard asks for (OGC 12-128r19).
inline constexpr const char* kGeoPackageTables = R"(
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

/// Fills the table of reference systems: the three that the standard asks for, and that of the data.
/// \param reference  an EPSG code; -1: none
inline void addReferenceSystems(SqliteDatabase& database, std::int64_t reference, const std::string& crsName) {
    const auto add = [&](const std::string& name, std::int64_t number, const std::string& organization,
                         const std::string& definition) {
        database.insert("gpkg_spatial_ref_sys", {name, number, organization, number, definition, SqliteValue{}});
    };
    add("Undefined Cartesian SRS", -1, "NONE", "undefined");
    add("Undefined geographic SRS", 0, "NONE", "undefined");
    add("WGS 84 geodetic", 4326, "EPSG",
        "GEOGCS[\"WGS 84\",DATUM[\"WGS_1984\",SPHEROID[\"WGS 84\",6378137,298.257223563,AUTHORITY[\"EPSG\",\"7030\"]],"
        "AUTHORITY[\"EPSG\",\"6326\"]],PRIMEM[\"Greenwich\",0,AUTHORITY[\"EPSG\",\"8901\"]],UNIT[\"degree\","
        "0.0174532925199433,AUTHORITY[\"EPSG\",\"9122\"]],AUTHORITY[\"EPSG\",\"4326\"]]");
    // Readers take the definition from their own register, by the code.
    if (reference > 0 && reference != 4326) add(crsName, reference, "EPSG", "undefined");
}

}  // namespace svt::writers
