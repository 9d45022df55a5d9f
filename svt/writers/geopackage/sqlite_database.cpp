#include <svt/writers/geopackage/sqlite_database.hpp>

#include <svt/core/machine.hpp>

#include <fmt/format.h>

namespace svt::writers {
namespace {

constexpr const char* kLibrary = "libsqlite3.so.0";
constexpr int kSqliteOk = 0, kSqliteDone = 101;

// Part of SQLite's C interface (sqlite.org/c3ref), which has not changed since 2004; serialize exists since 3.23.
struct Sqlite {
    int (*open)(const char*, void**) = nullptr;
    int (*close)(void*) = nullptr;
    int (*exec)(void*, const char*, void*, void*, char**) = nullptr;
    int (*prepare)(void*, const char*, int, void**, const char**) = nullptr;
    int (*bindInteger)(void*, int, std::int64_t) = nullptr;
    int (*bindNumber)(void*, int, double) = nullptr;
    int (*bindText)(void*, int, const char*, int, void*) = nullptr;
    int (*bindBlob)(void*, int, const void*, int, void*) = nullptr;
    int (*step)(void*) = nullptr;
    int (*finalize)(void*) = nullptr;
    const char* (*message)(void*) = nullptr;
    unsigned char* (*serialize)(void*, const char*, std::int64_t*, unsigned) = nullptr;
    void (*free)(void*) = nullptr;
};

Result<Sqlite> loadSqlite() {
    const Result<SharedLibrary> library = SharedLibrary::load(kLibrary);
    if (!library)
        return Error(Code::CannotWrite,
                     fmt::format("a GeoPackage needs the SQLite library ({}); install it (Debian: libsqlite3-0), or "
                                 "write the views as DXF",
                                 library.error().message()));
    Sqlite sqlite;
    const bool isWhole =
        library->find("sqlite3_open", sqlite.open) && library->find("sqlite3_close", sqlite.close) &&
        library->find("sqlite3_exec", sqlite.exec) && library->find("sqlite3_prepare_v2", sqlite.prepare) &&
        library->find("sqlite3_bind_int64", sqlite.bindInteger) &&
        library->find("sqlite3_bind_double", sqlite.bindNumber) &&
        library->find("sqlite3_bind_text", sqlite.bindText) && library->find("sqlite3_bind_blob", sqlite.bindBlob) &&
        library->find("sqlite3_step", sqlite.step) && library->find("sqlite3_finalize", sqlite.finalize) &&
        library->find("sqlite3_errmsg", sqlite.message) && library->find("sqlite3_serialize", sqlite.serialize) &&
        library->find("sqlite3_free", sqlite.free);
    if (!isWhole) return Error(Code::CannotWrite, fmt::format("{} lacks functions of SQLite 3.23", kLibrary));
    return sqlite;
}

class LoadedDatabase final : public SqliteDatabase {
public:
    LoadedDatabase(const Sqlite& sqlite, void* handle) : sqlite_(sqlite), handle_(handle) {}
    LoadedDatabase(const LoadedDatabase&) = delete;
    LoadedDatabase& operator=(const LoadedDatabase&) = delete;
    ~LoadedDatabase() override { sqlite_.close(handle_); }

    void run(const std::string& statements) override {
        keep(sqlite_.exec(handle_, statements.c_str(), nullptr, nullptr, nullptr), kSqliteOk);
    }

    void insert(std::string_view table, std::span<const Cell> row) override {
        std::string marks;
        for (std::size_t n = 0; n < row.size(); ++n) marks += n == 0 ? "?" : ",?";
        void* statement = nullptr;
        const std::string text = fmt::format("INSERT INTO {} VALUES({})", table, marks);
        if (!keep(sqlite_.prepare(handle_, text.c_str(), -1, &statement, nullptr), kSqliteOk)) return;
        for (std::size_t n = 0; n < row.size(); ++n) bind(statement, static_cast<int>(n) + 1, row[n]);
        keep(sqlite_.step(statement), kSqliteDone);
        sqlite_.finalize(statement);
    }

    Result<std::string> bytes() override {
        if (!error_.empty()) return Error(Code::CannotWrite, "SQLite: " + error_);
        std::int64_t size = 0;
        unsigned char* const data = sqlite_.serialize(handle_, "main", &size, 0);
        if (data == nullptr) return Error(Code::CannotWrite, "SQLite gives no bytes of the database");
        std::string bytes(reinterpret_cast<const char*>(data), static_cast<std::size_t>(size));
        sqlite_.free(data);
        return bytes;
    }

private:
    // The values live until the statement has run, so nothing is copied.
    void bind(void* statement, int number, const Cell& cell) {
        const auto bindBytes = [&](auto* function, const std::string& bytes) {
            keep(function(statement, number, bytes.data(), static_cast<int>(bytes.size()), nullptr), kSqliteOk);
        };
        if (const auto* truth = std::get_if<bool>(&cell.value))
            keep(sqlite_.bindInteger(statement, number, *truth ? 1 : 0), kSqliteOk);
        else if (const auto* whole = std::get_if<std::int64_t>(&cell.value))
            keep(sqlite_.bindInteger(statement, number, *whole), kSqliteOk);
        else if (const auto* real = std::get_if<double>(&cell.value))
            keep(sqlite_.bindNumber(statement, number, *real), kSqliteOk);
        else if (const auto* small = std::get_if<float>(&cell.value))
            keep(sqlite_.bindNumber(statement, number, double(*small)), kSqliteOk);
        else if (const auto* text = std::get_if<std::string>(&cell.value))
            bindBytes(sqlite_.bindText, *text);
        else if (const auto* array = std::get_if<JsonArray>(&cell.value))
            bindBytes(sqlite_.bindText, array->text);
        else if (const auto* blob = std::get_if<Blob>(&cell.value))
            bindBytes(sqlite_.bindBlob, blob->bytes);
    }

    bool keep(int result, int wanted) {
        if (result != wanted && error_.empty()) error_ = sqlite_.message(handle_);
        return result == wanted;
    }

    Sqlite sqlite_;
    void* handle_;
    std::string error_;
};

}  // namespace

Result<std::unique_ptr<SqliteDatabase>> makeSqliteDatabase() {
    static const Result<Sqlite> sqlite = loadSqlite();
    if (!sqlite) return sqlite.error();
    void* handle = nullptr;
    if (sqlite->open(":memory:", &handle) != kSqliteOk) {
        sqlite->close(handle);
        return Error(Code::CannotWrite, "SQLite opens no database in memory");
    }
    return std::unique_ptr<SqliteDatabase>(std::make_unique<LoadedDatabase>(*sqlite, handle));
}

}  // namespace svt::writers
