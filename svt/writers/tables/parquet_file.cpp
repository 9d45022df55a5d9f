#include <svt/writers/dense/piece_writer.hpp>
#include <svt/writers/tables/table.hpp>
#include <svt/writers/tables/thrift_struct.hpp>

#include <svt/core/attribute.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace svt::writers {
namespace {

// Numbers of parquet.thrift.
enum class ParquetType : std::int32_t { Truth = 0, Whole = 2, Small = 4, Real = 5, Text = 6 };
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

std::string plainValues(const TableColumn& column, ParquetType type) {
    std::string bytes;
    std::vector<bool> truths;
    for (const TableCell& cell : column.cells) {
        if (!isPresent(cell)) continue;
        if (type == ParquetType::Whole) appendBytes(bytes, std::get<std::int64_t>(cell));
        if (type == ParquetType::Real) appendBytes(bytes, realOf(cell));
        if (type == ParquetType::Small) appendBytes(bytes, std::get<float>(cell));
        if (type == ParquetType::Truth) truths.push_back(std::get<bool>(cell));
        if (type != ParquetType::Text) continue;
        const std::string text = textOf(cell);
        appendBytes(bytes, static_cast<std::uint32_t>(text.size()));
        bytes += text;
    }
    return bytes + packedBits(truths.size(), [&](std::size_t n) { return truths[n]; });
}

}  // namespace

Result<std::string> makeParquet(const Table& table) {
    std::string file = "PAR1";
    const auto rows = static_cast<std::int64_t>(table.rows());
    std::vector<ThriftStruct> schema{
        ThriftStruct().text(4, "schema").number32(5, static_cast<std::int32_t>(table.columns.size()))};
    std::vector<ThriftStruct> chunks;
    std::int64_t total = 0;
    for (const TableColumn& column : table.columns) {
        const ParquetType type = typeOf(column);
        const bool isOptional = !std::all_of(column.cells.begin(), column.cells.end(), isPresent);
        const std::string name = validText(column.name);
        ThriftStruct element;
        element.number32(1, static_cast<std::int32_t>(type)).number32(3, isOptional ? 1 : 0).text(4, name);
        if (type == ParquetType::Text)
            element.number32(6, kUtf8).inner(10, ThriftStruct().inner(1, ThriftStruct()));  // the logical type STRING
        schema.push_back(element);

        const std::string page = (isOptional ? definitionLevels(column) : std::string()) + plainValues(column, type);
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
        const auto begin = static_cast<std::int64_t>(file.size()),
                   bytes = static_cast<std::int64_t>(head.size() + page.size());
        if (rows > 0) file += head + page;
        total += bytes;
        chunks.push_back(
            ThriftStruct().number64(2, begin).inner(3, ThriftStruct()
                                                           .number32(1, static_cast<std::int32_t>(type))
                                                           .list(2, std::vector<std::int32_t>{kPlain, kRunLength})
                                                           .list(3, std::vector<std::string>{name})
                                                           .number32(4, kUncompressed)
                                                           .number64(5, rows)
                                                           .number64(6, bytes)
                                                           .number64(7, bytes)
                                                           .number64(9, begin)));
    }
    std::vector<ThriftStruct> groups, notes;
    if (rows > 0) groups.push_back(ThriftStruct().list(1, chunks).number64(2, total).number64(3, rows));
    for (const auto& [key, value] : table.notes)
        notes.push_back(ThriftStruct().text(1, validText(key)).text(2, validText(value)));
    ThriftStruct metadata;
    metadata.number32(1, 1).list(2, schema).number64(3, rows).list(4, groups);
    if (!notes.empty()) metadata.list(5, notes);
    const std::string footer = metadata.text(6, "svt").end();
    file += footer;
    appendBytes(file, static_cast<std::uint32_t>(footer.size()));
    return file + "PAR1";
}

}  // namespace svt::writers
