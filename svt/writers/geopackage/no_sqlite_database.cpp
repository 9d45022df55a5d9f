#include <svt/writers/geopackage/sqlite_database.hpp>

namespace svt::writers {

Result<std::unique_ptr<SqliteDatabase>> makeSqliteDatabase() {
    return Error(Code::CannotWrite, "this build writes no GeoPackage; write the views as GeoJSON or DXF");
}

}  // namespace svt::writers
