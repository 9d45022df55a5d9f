#pragma once
/// \file
/// Apache Parquet in groups of rows, so that a table may be longer than memory. Plain encoding, not compressed.
/// Source: the format's own parquet.thrift and Encodings.md.

#include <svt/core/result.hpp>
#include <svt/writers/table.hpp>
#include <svt/writers/tables/thrift_struct.hpp>

#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace svt::writers {

struct ParquetColumn {
    std::string name;  ///< valid UTF-8
    CellType type = CellType::Text;
    bool isOptional = false;  ///< cells may be empty
};

/// Pieces of a file, to be written one after the other: begin(), groups, end().
class ParquetStream {
public:
    explicit ParquetStream(std::vector<ParquetColumn> columns) : columns_(std::move(columns)) {}

    [[nodiscard]] std::string begin();
    /// \param rows  cells of the types of their columns; Text accepts all types except blobs, Number all numbers
    /// \return the bytes, none without rows; or GridTooLarge if a column would have 2 GiB
    [[nodiscard]] Result<std::string> group(std::span<const Row> rows);
    /// \param texts  key/value metadata
    [[nodiscard]] std::string end(std::span<const std::pair<std::string, std::string>> texts) const;

private:
    std::vector<ParquetColumn> columns_;
    std::vector<ThriftStruct> groups_;
    std::uint64_t size_ = 0;
    std::int64_t rows_ = 0;
};

}  // namespace svt::writers
