#pragma once
/// \file
/// Builds a GeoPackage (OGC 12-128r19): reference systems, tables of features, their rows and their contents.

#include <svt/core/result.hpp>
#include <svt/writers/geopackage/geometry_blob.hpp>
#include <svt/writers/geopackage/sqlite_database.hpp>

#include <memory>
#include <string>
#include <utility>

namespace svt::writers {

class GeoPackage {
public:
    static constexpr std::int64_t kCartesian = -1;  ///< the reference system of coordinates without a CRS

    /// \return an empty package, or CannotWrite if the SQLite library is missing
    [[nodiscard]] static Result<GeoPackage> create(const std::string& crsName);

    /// The EPSG code of the CRS, or kCartesian.
    [[nodiscard]] std::int64_t reference() const noexcept { return reference_; }

    /// Creates a table with a key `fid`, a geometry `geom` of the given type, and columns in SQL.
    void createFeatures(const std::string& name, const char* geometryType, const std::string& columns);
    /// Creates the same table without a geometry.
    void createTable(const std::string& name, const std::string& columns);
    /// Adds a row; its first cell is the key, or empty for the next number. finish() returns errors.
    void insert(std::string_view table, std::span<const Cell> row) { database_->insert(table, row); }
    /// Adds a table of features to the package's contents. \param bounds  its extent; empty: none
    void describeFeatures(const std::string& name, const char* geometryType, std::int64_t reference,
                          const MapBounds& bounds);
    /// Adds a table without geometries to the package's contents.
    void describeAttributes(const std::string& name);

    /// \return the file's bytes, or CannotWrite. Equal calls give equal bytes with the same release of SQLite.
    [[nodiscard]] Result<std::string> finish();

private:
    GeoPackage(std::unique_ptr<SqliteDatabase> database, const std::string& crsName);

    std::unique_ptr<SqliteDatabase> database_;
    std::int64_t reference_ = kCartesian;
};

}  // namespace svt::writers
