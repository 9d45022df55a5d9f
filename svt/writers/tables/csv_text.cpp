#include <svt/writers/tables/csv_text.hpp>
#include <svt/writers/tables/table.hpp>

namespace svt::writers {

std::string makeCsv(const Table& table) {
    CsvText csv;
    for (const TableColumn& column : table.columns) csv.field(column.name);
    csv.endLine();
    for (std::size_t row = 0; row < table.rows(); ++row) {
        for (const TableColumn& column : table.columns) {
            const TableCell& cell = column.cells[row];
            if (const auto* text = std::get_if<std::string>(&cell))
                csv.field(*text);
            else if (const auto* whole = std::get_if<std::int64_t>(&cell))
                csv.number(*whole);
            else if (const auto* real = std::get_if<double>(&cell))
                csv.number(*real);
            else if (const auto* small = std::get_if<float>(&cell))
                csv.number(*small);
            else if (const auto* truth = std::get_if<bool>(&cell))
                csv.field(*truth ? "true" : "false");
            else
                csv.nothing();
        }
        csv.endLine();
    }
    return csv.take();
}

}  // namespace svt::writers
