#pragma once
/// \file
/// A table: named columns, and rows of typed cells. It can be written as text, JSON, CSV and Parquet.

#include <svt/core/attribute.hpp>
#include <svt/core/result.hpp>
#include <svt/core/vec.hpp>

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace svt::writers {

/// Bytes that are not text, such as a geometry. Only GeoPackage and Parquet store them.
struct Blob {
    std::string bytes;
};

/// An array as JSON: the values of an attribute with several. JSON and GeoJSON store it as an array, all others as text.
struct JsonArray {
    std::string text;
};

/// A value, or empty. Cells of one column may differ in type, like attributes of models.
struct Cell {
    std::variant<std::monostate, bool, std::int64_t, float, double, std::string, std::vector<std::string>, Blob,
                 JsonArray>
        value;

    Cell() = default;
    Cell(std::nullptr_t) {}
    Cell(bool truth) : value(truth) {}
    template <std::integral T>
    Cell(T whole) : value(static_cast<std::int64_t>(whole)) {}
    Cell(float number) : value(number) {}
    Cell(double number) : value(number) {}
    Cell(const char* text) : value(std::string(text)) {}
    Cell(std::string_view text) : value(std::string(text)) {}
    Cell(std::string text) : value(std::move(text)) {}
    Cell(std::vector<std::string> texts) : value(std::move(texts)) {}
    Cell(Blob blob) : value(std::move(blob)) {}
    Cell(JsonArray array) : value(std::move(array)) {}
    Cell(const AttributeValue& attribute) {
        std::visit([this](const auto& known) { value = known; }, attribute);
    }
    /// The one rule for attributes: a single value with its own type, else an array.
    Cell(const AttributeList& list) {
        if (list.isSingle())
            *this = Cell(list.items.front().attribute->value);
        else
            value = JsonArray{toJsonText(list)};
    }

    [[nodiscard]] bool isEmpty() const noexcept { return value.index() == 0; }
};
using Row = std::vector<Cell>;

/// Appends the six coordinates of a box, its lower corner first; empty cells for an empty box.
void appendCorners(Row& row, const Box3d& box);

enum class CellType : std::uint8_t { Text, Whole, Number, SmallNumber, Truth, Blob };

struct Column {
    std::string name;
    std::string title{};             ///< heading in text: the unit or a shorter name; empty: text omits the column
    int decimals = 3;                ///< of floating-point numbers in text
    CellType type = CellType::Text;  ///< for GeoPackage and GeoParquet: each cell has this type or is empty
};

struct Table {
    std::vector<Column> columns;
    std::vector<Row> rows;                                     ///< one cell per column
    std::vector<std::pair<std::string, std::string>> notes{};  ///< of the whole table, for formats that can store them
};

/// The cell as text: numbers in shortest round-trip form, lists joined by blanks; empty for empty cells and blobs.
[[nodiscard]] std::string cellText(const Cell& cell);

/// Aligned columns under their titles: numbers at the right, `-` for empty cells.
[[nodiscard]] std::string makeText(const Table& table);

/// A JSON array with one object per row, indented by two blanks. Empty cells are null. Invalid UTF-8 is replaced.
[[nodiscard]] std::string makeJson(const Table& table);

/// Variants of comma-separated values.
enum class CsvForm : std::uint8_t {
    File,   ///< RFC 4180; numbers have up to twelve digits
    Stream  ///< for shell tools: lines end with LF only, numbers as in JSON, texts with `;` have quotes too
};
[[nodiscard]] std::string csvLine(std::span<const Cell> cells, CsvForm form = CsvForm::File);
/// The line of column names.
[[nodiscard]] std::string csvHeader(std::span<const Column> columns, CsvForm form = CsvForm::File);
/// Header and rows in UTF-8, without the notes.
[[nodiscard]] std::string makeCsv(const Table& table);

/// Apache Parquet: one row group, plain encoding, not compressed. A column of whole numbers is INT64, of numbers DOUBLE
/// (FLOAT), of truth values BOOLEAN, otherwise UTF-8 text. A column with empty cells is optional. Notes are key/value
/// metadata. Source: the format's own parquet.thrift and Encodings.md.
/// \return the file, or GridTooLarge if a column would have 2 GiB
[[nodiscard]] Result<std::string> makeParquet(const Table& table);

}  // namespace svt::writers
