#pragma once
/// \file
/// Reads tables of a SQLite file, such as a GeoPackage. The library is loaded on first use.

#include <svt/core/result.hpp>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <variant>
#include <vector>

namespace svt::readers::gis {

/// Bytes of a BLOB.
struct SqliteBlob {
    std::string bytes;
};
using SqliteValue = std::variant<std::monostate, std::int64_t, double, std::string, SqliteBlob>;
using SqliteRow = std::vector<SqliteValue>;

/// An open file, read-only.
class SqliteFile {
public:
    /// \return the file, or CannotOpen if the library is missing or the file cannot be opened
    [[nodiscard]] static Result<SqliteFile> open(const std::filesystem::path& path);
    ~SqliteFile();
    SqliteFile(SqliteFile&& other) noexcept;
    SqliteFile(const SqliteFile&) = delete;
    SqliteFile& operator=(const SqliteFile&) = delete;

    /// Runs a SELECT and calls use(row) for each row.
    /// \return the names of the columns, or BadValue with the message of SQLite: damaged, or no such table. InputTooBig
    ///         for rows of more than 1 GiB, or some seconds of work.
    [[nodiscard]] Result<std::vector<std::string>> select(const std::string& statement,
                                                          const std::function<void(SqliteRow)>& use) const;

private:
    SqliteFile(void* handle, std::string name) : handle_(handle), name_(std::move(name)) {}
    void* handle_;
    std::string name_;
};

/// A name in quotes, as SQL has it.
[[nodiscard]] std::string quotedName(const std::string& name);

}  // namespace svt::readers::gis
