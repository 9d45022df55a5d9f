#include <svt/readers/gis/sqlite_file.hpp>

#include <svt/core/machine.hpp>

#include <fmt/format.h>

#include <utility>

namespace svt::readers::gis {
namespace {

constexpr const char* kLibrary = "libsqlite3.so.0";
constexpr int kOk = 0, kRow = 100, kDone = 101, kReadOnly = 1;
constexpr int kInteger = 1, kFloat = 2, kText = 3, kBlob = 4;

// Part of SQLite's C interface (sqlite.org/c3ref).
struct Sqlite {
    int (*open)(const char*, void**, int, const char*) = nullptr;
    int (*close)(void*) = nullptr;
    int (*prepare)(void*, const char*, int, void**, const char**) = nullptr;
    int (*step)(void*) = nullptr;
    int (*finalize)(void*) = nullptr;
    int (*columnCount)(void*) = nullptr;
    const char* (*columnName)(void*, int) = nullptr;
    int (*columnType)(void*, int) = nullptr;
    std::int64_t (*columnInteger)(void*, int) = nullptr;
    double (*columnNumber)(void*, int) = nullptr;
    const void* (*columnBlob)(void*, int) = nullptr;
    int (*columnBytes)(void*, int) = nullptr;
    const char* (*message)(void*) = nullptr;
    void (*progress)(void*, int, int (*)(void*), void*) = nullptr;
};

// A view of a hostile file may have no end.
constexpr std::uint64_t kMaxBytes = std::uint64_t{1} << 30;  // of all values of a SELECT
constexpr int kStepsPerCall = 1'000'000, kMostCalls = 300;   // some seconds

int countCalls(void* calls) noexcept { return ++*static_cast<int*>(calls) > kMostCalls ? 1 : 0; }

Result<Sqlite> findSqlite() {
    const Result<SharedLibrary> library = SharedLibrary::load(kLibrary);
    if (!library)
        return Error(Code::CannotOpen, fmt::format("a GeoPackage needs the SQLite library ({}); install it (Debian: "
                                                   "libsqlite3-0), or export GeoJSON or CSV",
                                                   library.error().message()));
    Sqlite sqlite;
    const bool isWhole =
        library->find("sqlite3_open_v2", sqlite.open) && library->find("sqlite3_close", sqlite.close) &&
        library->find("sqlite3_prepare_v2", sqlite.prepare) && library->find("sqlite3_step", sqlite.step) &&
        library->find("sqlite3_finalize", sqlite.finalize) &&
        library->find("sqlite3_column_count", sqlite.columnCount) &&
        library->find("sqlite3_column_name", sqlite.columnName) &&
        library->find("sqlite3_column_type", sqlite.columnType) &&
        library->find("sqlite3_column_int64", sqlite.columnInteger) &&
        library->find("sqlite3_column_double", sqlite.columnNumber) &&
        library->find("sqlite3_column_blob", sqlite.columnBlob) &&
        library->find("sqlite3_column_bytes", sqlite.columnBytes) && library->find("sqlite3_errmsg", sqlite.message) &&
        library->find("sqlite3_progress_handler", sqlite.progress);
    if (!isWhole) return Error(Code::CannotOpen, fmt::format("{} lacks functions of SQLite 3", kLibrary));
    return sqlite;
}

const Result<Sqlite>& sqliteLibrary() {
    static const Result<Sqlite> sqlite = findSqlite();
    return sqlite;
}

SqliteValue valueOf(const Sqlite& sqlite, void* statement, int column) {
    const auto bytes = [&]() -> std::string {
        const auto* data = static_cast<const char*>(sqlite.columnBlob(statement, column));
        const int size = sqlite.columnBytes(statement, column);
        return data == nullptr || size <= 0 ? std::string() : std::string(data, static_cast<std::size_t>(size));
    };
    switch (sqlite.columnType(statement, column)) {
        case kInteger: return sqlite.columnInteger(statement, column);
        case kFloat: return sqlite.columnNumber(statement, column);
        case kText: return bytes();
        case kBlob: return SqliteBlob{bytes()};
        default: return {};
    }
}

}  // namespace

Result<SqliteFile> SqliteFile::open(const std::filesystem::path& path) {
    const Result<Sqlite>& sqlite = sqliteLibrary();
    if (!sqlite) return sqlite.error();
    void* handle = nullptr;
    if (sqlite->open(path.string().c_str(), &handle, kReadOnly, nullptr) != kOk) {
        const std::string reason = handle == nullptr ? "no memory" : sqlite->message(handle);
        sqlite->close(handle);
        return Error(Code::CannotOpen, reason, {path.string(), 0, 0, {}});
    }
    return SqliteFile(handle, path.string());
}

SqliteFile::SqliteFile(SqliteFile&& other) noexcept
    : handle_(std::exchange(other.handle_, nullptr)), name_(std::move(other.name_)) {}

SqliteFile::~SqliteFile() {
    if (handle_ != nullptr) sqliteLibrary()->close(handle_);
}

Result<std::vector<std::string>> SqliteFile::select(const std::string& text,
                                                    const std::function<void(SqliteRow)>& use) const {
    const Sqlite& sqlite = *sqliteLibrary();
    const auto bad = [&] {
        return Error(Code::BadValue, fmt::format("SQLite: {}; export the file again", sqlite.message(handle_)),
                     {name_, 0, 0, {}});
    };
    void* statement = nullptr;
    if (sqlite.prepare(handle_, text.c_str(), -1, &statement, nullptr) != kOk) return bad();
    std::vector<std::string> names;
    const int count = sqlite.columnCount(statement);
    for (int n = 0; n < count; ++n) names.emplace_back(sqlite.columnName(statement, n));
    int result = kRow, calls = 0;
    std::uint64_t bytes = 0;
    sqlite.progress(handle_, kStepsPerCall, countCalls, &calls);
    while (bytes <= kMaxBytes && (result = sqlite.step(statement)) == kRow) {
        SqliteRow row;
        for (int n = 0; n < count; ++n) {
            row.push_back(valueOf(sqlite, statement, n));
            bytes += sizeof(SqliteValue) + static_cast<std::uint64_t>(sqlite.columnBytes(statement, n));
        }
        use(std::move(row));
    }
    sqlite.progress(handle_, 0, nullptr, nullptr);
    Result<std::vector<std::string>> found = names;
    if (result != kDone) found = bad();
    if (bytes > kMaxBytes || calls > kMostCalls)
        found = Error(Code::InputTooBig, "the table has more than 1 GiB, or takes too long; export fewer rows",
                      {name_, 0, 0, {}});
    sqlite.finalize(statement);
    return found;
}

std::string quotedName(const std::string& name) {
    std::string quoted = "\"";
    for (const char c : name) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    return quoted + "\"";
}

}  // namespace svt::readers::gis
