#include <apps/cli/diff/comparison_reports.hpp>

#include <svt/core/names.hpp>

#include <optional>
#include <string>
#include <vector>

namespace svt::cli {
namespace {

using compare::ComparisonRow;

Cell cellOf(const std::optional<double>& value) { return value ? Cell(withoutRounding(*value)) : Cell(); }

}  // namespace

Table comparisonTable(const Compared& compared, bool hasAll, std::size_t mostProperties) {
    const StateFeatures was(compared.was), is(compared.is);
    Table table;
    table.columns = {{"change", "change"},     {"class", "class"},
                     {"old", "old id"},        {"new", "new id"},
                     {"name", "name"},         {"storey", "storey"},
                     {"vectorX", "dx m", 4},   {"vectorY", "dy m", 4},
                     {"vectorZ", "dz m", 4},   {"rotation", "turned deg", 3},
                     {"added", "added m3", 4}, {"removed", "removed m3", 4},
                     {"bound", "+- m3", 4},    {"distance", "distance m", 4},
                     {"exact", "exact"},       {"properties", "other properties"}};
    for (const ComparisonRow& row : compared.comparison.rows) {
        if (!hasAll && !row.isDifferent()) continue;
        const RowSubject subject = subjectOf(row, was, is);
        const volume::Label& label = *subject;
        Row cells;
        cells.emplace_back(nameOf(row.change));
        cells.emplace_back(label.className);
        cells.emplace_back(was.ids(row.was));
        cells.emplace_back(is.ids(row.is));
        cells.emplace_back(label.name);
        const std::string storey = subject.storey();
        cells.push_back(storey.empty() ? Cell() : Cell(storey));
        for (int axis = 0; axis < 3; ++axis)
            cells.push_back(row.vector ? Cell(withoutRounding((*row.vector)[axis])) : Cell());
        cells.push_back(cellOf(row.rotation));
        for (const auto* value : {&row.added, &row.removed, &row.bound, &row.distance}) cells.push_back(cellOf(*value));
        cells.push_back(row.hasGeometry ? Cell(row.isExact) : Cell());
        const std::string properties = otherProperties(row, mostProperties);
        cells.push_back(properties.empty() ? Cell() : Cell(properties));
        table.rows.push_back(std::move(cells));
    }
    return table;
}

}  // namespace svt::cli
