#pragma once
/// \file
/// A SQLite database in memory, with the bytes of a file. The library is loaded on first use, like cairo, so the build
/// needs neither its headers nor linking.

#include <svt/core/result.hpp>
#include <svt/writers/table.hpp>

#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace svt::writers {

/// Errors are stored, and returned by bytes().
class SqliteDatabase {
public:
    virtual ~SqliteDatabase() = default;
    /// Runs statements without results.
    virtual void run(const std::string& statements) = 0;
    /// Adds a row to a table: one cell per column. Truth values become 0 and 1. Lists of texts are not stored (null).
    virtual void insert(std::string_view table, std::span<const Cell> row) = 0;
    /// The database as a file, or CannotWrite. Equal statements give equal bytes with the same release of SQLite.
    [[nodiscard]] virtual Result<std::string> bytes() = 0;
};

/// An empty database, or CannotWrite if the library is missing.
[[nodiscard]] Result<std::unique_ptr<SqliteDatabase>> makeSqliteDatabase();

}  // namespace svt::writers
