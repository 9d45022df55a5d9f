#include <svt/writers/dense/piece_writer.hpp>
#include <svt/writers/tables/parquet_stream.hpp>

#include <svt/core/check.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace svt::writers {
namespace {

// Numbers of parquet.thrift.
constexpr std::int32_t kPlain = 0, kRunLength = 3, kDataPage = 0, kUncompressed = 0, kUtf8 = 0;
constexpr std::size_t kMostPageBytes = 0x7FFFFFFF;

/// The one type that holds all cells of a column.
CellType typeOf(std::span<const Row> rows, std::size_t column) {
    bool hasText = false, hasWhole = false, hasReal = false, hasSmall = false, hasTruth = false;
    for (const Row& row : rows) {
        const auto& value = row[column].value;
        hasText = hasText || std::holds_alternative<std::string>(value) ||
                  std::holds_alternative<std::vector<std::string>>(value) || std::holds_alternative<JsonArray>(value);
        hasWhole = hasWhole || std::holds_alternative<std::int64_t>(value);
        hasReal = hasReal || std::holds_alternative<double>(value);
        hasSmall = hasSmall || std::holds_alternative<float>(value);
        hasTruth = hasTruth || std::holds_alternative<bool>(value);
    }
    const bool hasNumber = hasWhole || hasReal || hasSmall;
    if (hasText || (hasTruth && hasNumber)) return CellType::Text;
    if (hasTruth) return CellType::Truth;
    if (hasReal || (hasSmall && hasWhole)) return CellType::Number;
    if (hasSmall) return CellType::SmallNumber;
    return hasWhole ? CellType::Whole : CellType::Text;
}

/// The physical type, as parquet.thrift numbers it.
std::int32_t numberOf(CellType type) {
    switch (type) {
        case CellType::Truth: return 0;
        case CellType::Whole: return 2;
        case CellType::SmallNumber: return 4;
        case CellType::Number: return 5;
        case CellType::Text:
        case CellType::Blob: break;
    }
    return 6;
}

double realOf(const Cell& cell) {
    if (const auto* whole = std::get_if<std::int64_t>(&cell.value)) return static_cast<double>(*whole);
    if (const auto* small = std::get_if<float>(&cell.value)) return static_cast<double>(*small);
    return std::get<double>(cell.value);
}

/// Flags of cells that have a value, as one bit-packed run.
std::string definitionLevels(std::span<const Row> rows, std::size_t column) {
    std::string run;
    appendVarint(run, (rows.size() + 7) / 8 << 1 | 1);
    run += packedBits(rows.size(), [&](std::size_t n) { return !rows[n][column].isEmpty(); });
    std::string bytes;
    appendBytes(bytes, static_cast<std::uint32_t>(run.size()));
    return bytes + run;
}

std::string plainValues(std::span<const Row> rows, std::size_t column, CellType type) {
    std::string bytes;
    std::vector<bool> truths;
    for (const Row& row : rows) {
        const Cell& cell = row[column];
        if (cell.isEmpty()) continue;
        if (type == CellType::Whole) appendBytes(bytes, std::get<std::int64_t>(cell.value));
        if (type == CellType::Number) appendBytes(bytes, realOf(cell));
        if (type == CellType::SmallNumber) appendBytes(bytes, std::get<float>(cell.value));
        if (type == CellType::Truth) truths.push_back(std::get<bool>(cell.value));
        if (type != CellType::Text && type != CellType::Blob) continue;
        const std::string text = type == CellType::Blob ? std::get<Blob>(cell.value).bytes : validText(cellText(cell));
        appendBytes(bytes, static_cast<std::uint32_t>(text.size()));
        bytes += text;
    }
    return bytes + packedBits(truths.size(), [&](std::size_t n) { return truths[n]; });
}

}  // namespace

std::string ParquetStream::begin() {
    size_ = 4;
    return "PAR1";
}

Result<std::string> ParquetStream::group(std::span<const Row> rows) {
    if (rows.empty()) return std::string();
    SVT_CHECK(rows.front().size() == columns_.size());
    const auto rowCount = static_cast<std::int64_t>(rows.size());
    std::string bytes;
    std::vector<ThriftStruct> chunks;
    std::int64_t total = 0;
    for (std::size_t c = 0; c < columns_.size(); ++c) {
        const auto& [name, type, isOptional] = columns_[c];
        const std::string page = (isOptional ? definitionLevels(rows, c) : std::string()) + plainValues(rows, c, type);
        if (page.size() > kMostPageBytes)
            return Error(Code::GridTooLarge, fmt::format("column '{}' has more than 2 GiB; use --select", name));
        const auto size = static_cast<std::int32_t>(page.size());
        const std::string head = ThriftStruct()
                                     .number32(1, kDataPage)
                                     .number32(2, size)
                                     .number32(3, size)
                                     .inner(5, ThriftStruct()
                                                   .number32(1, static_cast<std::int32_t>(rowCount))
                                                   .number32(2, kPlain)
                                                   .number32(3, kRunLength)
                                                   .number32(4, kRunLength))
                                     .end();
        const auto begin = static_cast<std::int64_t>(size_ + bytes.size()),
                   length = static_cast<std::int64_t>(head.size() + page.size());
        (bytes += head) += page;
        total += length;
        chunks.push_back(
            ThriftStruct().number64(2, begin).inner(3, ThriftStruct()
                                                           .number32(1, numberOf(type))
                                                           .list(2, std::vector<std::int32_t>{kPlain, kRunLength})
                                                           .list(3, std::vector<std::string>{name})
                                                           .number32(4, kUncompressed)
                                                           .number64(5, rowCount)
                                                           .number64(6, length)
                                                           .number64(7, length)
                                                           .number64(9, begin)));
    }
    groups_.push_back(ThriftStruct().list(1, chunks).number64(2, total).number64(3, rowCount));
    rows_ += rowCount;
    size_ += bytes.size();
    return bytes;
}

std::string ParquetStream::end(std::span<const std::pair<std::string, std::string>> texts) const {
    std::vector<ThriftStruct> schema{
        ThriftStruct().text(4, "schema").number32(5, static_cast<std::int32_t>(columns_.size()))};
    for (const ParquetColumn& column : columns_) {
        ThriftStruct element;
        element.number32(1, numberOf(column.type)).number32(3, column.isOptional ? 1 : 0).text(4, column.name);
        if (column.type == CellType::Text)
            element.number32(6, kUtf8).inner(10, ThriftStruct().inner(1, ThriftStruct()));  // the logical type STRING
        schema.push_back(element);
    }
    std::vector<ThriftStruct> notes;
    for (const auto& [key, value] : texts)
        notes.push_back(ThriftStruct().text(1, validText(key)).text(2, validText(value)));
    ThriftStruct metadata;
    metadata.number32(1, 1).list(2, schema).number64(3, rows_).list(4, groups_);
    if (!notes.empty()) metadata.list(5, notes);
    std::string footer = metadata.text(6, "svt").end();
    appendBytes(footer, static_cast<std::uint32_t>(footer.size()));
    return footer + "PAR1";
}

Result<std::string> makeParquet(const Table& table) {
    std::vector<ParquetColumn> columns;
    for (std::size_t c = 0; c < table.columns.size(); ++c) {
        const auto isEmpty = [c](const Row& row) { return row[c].isEmpty(); };
        columns.push_back({validText(table.columns[c].name), typeOf(table.rows, c),
                           std::any_of(table.rows.begin(), table.rows.end(), isEmpty)});
    }
    ParquetStream stream(std::move(columns));
    std::string file = stream.begin();
    SVT_TRY(group, stream.group(table.rows));
    return file + *group + stream.end(table.notes);
}

}  // namespace svt::writers
