#include <svt/writers/dense/piece_writer.hpp>
#include <svt/writers/tables/parquet_stream.hpp>

#include <svt/core/attribute.hpp>
#include <svt/core/check.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace svt::writers {
namespace {

// Numbers of parquet.thrift.
constexpr std::int32_t kPlain = 0, kRunLength = 3, kDataPage = 0, kUncompressed = 0, kUtf8 = 0;
constexpr std::size_t kMostPageBytes = 0x7FFFFFFF;

/// The one type that holds all cells.
ParquetType typeOf(const TableColumn& column) {
    bool hasText = false, hasWhole = false, hasReal = false, hasSmall = false, hasTruth = false;
    for (const TableCell& cell : column.cells) {
        hasText = hasText || std::holds_alternative<std::string>(cell);
        hasWhole = hasWhole || std::holds_alternative<std::int64_t>(cell);
        hasReal = hasReal || std::holds_alternative<double>(cell);
        hasSmall = hasSmall || std::holds_alternative<float>(cell);
        hasTruth = hasTruth || std::holds_alternative<bool>(cell);
    }
    const bool hasNumber = hasWhole || hasReal || hasSmall;
    if (hasText || (hasTruth && hasNumber)) return ParquetType::Text;
    if (hasTruth) return ParquetType::Truth;
    if (hasReal || (hasSmall && hasWhole)) return ParquetType::Real;
    if (hasSmall) return ParquetType::Small;
    return hasWhole ? ParquetType::Whole : ParquetType::Text;
}

std::string textOf(const TableCell& cell) {
    if (const auto* text = std::get_if<std::string>(&cell)) return validText(*text);
    if (const auto* whole = std::get_if<std::int64_t>(&cell)) return fmt::format("{}", *whole);
    if (const auto* real = std::get_if<double>(&cell)) return fmt::format("{}", *real);
    if (const auto* small = std::get_if<float>(&cell)) return fmt::format("{}", *small);
    return std::get<bool>(cell) ? "true" : "false";
}

double realOf(const TableCell& cell) {
    if (const auto* whole = std::get_if<std::int64_t>(&cell)) return static_cast<double>(*whole);
    if (const auto* small = std::get_if<float>(&cell)) return static_cast<double>(*small);
    return std::get<double>(cell);
}

bool isPresent(const TableCell& cell) { return !std::holds_alternative<std::monostate>(cell); }

/// Bits, the lowest of each byte first.
template <class IsSet>
std::string packedBits(std::size_t count, const IsSet& isSet) {
    std::string bytes((count + 7) / 8, '\0');
    for (std::size_t n = 0; n < count; ++n)
        if (isSet(n)) bytes[n / 8] = static_cast<char>(bytes[n / 8] | 1 << n % 8);
    return bytes;
}

/// Which cells have a value, as one bit-packed run.
std::string definitionLevels(const TableColumn& column) {
    std::string run;
    for (std::uint64_t header = (column.cells.size() + 7) / 8 << 1 | 1; header != 0 || run.empty(); header >>= 7)
        run += static_cast<char>(header > 127 ? (header & 127) | 128 : header);
    run += packedBits(column.cells.size(), [&](std::size_t n) { return isPresent(column.cells[n]); });
    std::string bytes;
    appendBytes(bytes, static_cast<std::uint32_t>(run.size()));
    return bytes + run;
}

std::string plainValues(const TableColumn& column, ParquetType type, bool isBinary) {
    std::string bytes;
    std::vector<bool> truths;
    for (const TableCell& cell : column.cells) {
        if (!isPresent(cell)) continue;
        if (type == ParquetType::Whole) appendBytes(bytes, std::get<std::int64_t>(cell));
        if (type == ParquetType::Real) appendBytes(bytes, realOf(cell));
        if (type == ParquetType::Small) appendBytes(bytes, std::get<float>(cell));
        if (type == ParquetType::Truth) truths.push_back(std::get<bool>(cell));
        if (type != ParquetType::Text) continue;
        const std::string text = isBinary ? std::get<std::string>(cell) : textOf(cell);
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

Result<std::string> ParquetStream::group(std::span<const TableColumn> columns) {
    SVT_CHECK(columns.size() == columns_.size());
    const auto rows = static_cast<std::int64_t>(columns.empty() ? 0 : columns.front().cells.size());
    if (rows == 0) return std::string();
    std::string bytes;
    std::vector<ThriftStruct> chunks;
    std::int64_t total = 0;
    for (std::size_t c = 0; c < columns.size(); ++c) {
        const auto& [name, type, isOptional, isBinary] = columns_[c];
        const std::string page =
            (isOptional ? definitionLevels(columns[c]) : std::string()) + plainValues(columns[c], type, isBinary);
        if (page.size() > kMostPageBytes)
            return Error(Code::GridTooLarge, fmt::format("column '{}' has more than 2 GiB; use --select", name));
        const auto size = static_cast<std::int32_t>(page.size());
        const std::string head = ThriftStruct()
                                     .number32(1, kDataPage)
                                     .number32(2, size)
                                     .number32(3, size)
                                     .inner(5, ThriftStruct()
                                                   .number32(1, static_cast<std::int32_t>(rows))
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
                                                           .number32(1, static_cast<std::int32_t>(type))
                                                           .list(2, std::vector<std::int32_t>{kPlain, kRunLength})
                                                           .list(3, std::vector<std::string>{name})
                                                           .number32(4, kUncompressed)
                                                           .number64(5, rows)
                                                           .number64(6, length)
                                                           .number64(7, length)
                                                           .number64(9, begin)));
    }
    groups_.push_back(ThriftStruct().list(1, chunks).number64(2, total).number64(3, rows));
    rows_ += rows;
    size_ += bytes.size();
    return bytes;
}

std::string ParquetStream::end(std::span<const std::pair<std::string, std::string>> texts) const {
    std::vector<ThriftStruct> schema{
        ThriftStruct().text(4, "schema").number32(5, static_cast<std::int32_t>(columns_.size()))};
    for (const ParquetColumn& column : columns_) {
        ThriftStruct element;
        element.number32(1, static_cast<std::int32_t>(column.type))
            .number32(3, column.isOptional ? 1 : 0)
            .text(4, column.name);
        if (column.type == ParquetType::Text && !column.isBinary)
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
    for (const TableColumn& column : table.columns)
        columns.push_back({validText(column.name), typeOf(column),
                           !std::all_of(column.cells.begin(), column.cells.end(), isPresent), false});
    ParquetStream stream(std::move(columns));
    std::string file = stream.begin();
    SVT_TRY(group, stream.group(table.columns));
    return file + *group + stream.end(table.notes);
}

}  // namespace svt::writers
