#include <svt/field_readers/fds/devices.hpp>

#include <svt/core/file.hpp>
#include <svt/core/text.hpp>
#include <svt/record/csv_reader.hpp>

#include <fmt/format.h>

#include <limits>
#include <map>

namespace svt::field_readers {
namespace {

constexpr std::uint64_t kMaxDeviceTable = std::uint64_t{1} << 30;

// The columns of a quantity in the table of devices.
struct DeviceColumns {
    std::string unit;
    std::vector<std::size_t> columns;
    std::vector<fields::FieldPoint> points;
};

struct DeviceTable {
    std::vector<std::string> units, names;
    std::vector<double> times;
    std::vector<std::vector<float>> rows;
    std::uint64_t unreadable = 0;
};

Result<DeviceTable> readDeviceTable(std::string_view text, const std::filesystem::path& path, const Reading& reading) {
    record::CsvReader reader(text);
    DeviceTable table;
    if (!reader.next(table.units) || !reader.next(table.names) || table.units.size() != table.names.size())
        return badField("a line of units and a line of as many names are expected", path);
    std::vector<std::string> cells;
    while (reader.next(cells)) {
        const auto time = cells.empty() ? std::nullopt : parseNumber(cells[0]);
        // FDS ends each row with a line break, so the last number of another row may lack digits.
        if (cells.size() != table.names.size() || !time || !reader.isWhole()) {
            if (reader.isWhole())
                return badField(
                    fmt::format("{} numbers are expected, and not {} cells", table.names.size(), cells.size()), path,
                    reader.line());
            reading.warn(
                Code::FieldInPart,
                fmt::format("the table ends within line {}: {} whole rows are read", reader.line(), table.times.size()),
                path.string());
            break;
        }
        // A run that was started again writes times again.
        while (!table.times.empty() && table.times.back() >= *time) {
            table.times.pop_back();
            table.rows.pop_back();
        }
        std::vector<float> row;
        row.reserve(cells.size());
        for (const std::string& cell : cells) {
            const auto number = parseNumber(cell);
            if (!number && !isMissingCell(cell)) ++table.unreadable;
            row.push_back(number ? static_cast<float>(*number) : std::numeric_limits<float>::quiet_NaN());
        }
        table.times.push_back(*time);
        table.rows.push_back(std::move(row));
    }
    return table;
}

Result<void> addDeviceField(const std::string& quantity, DeviceColumns columns, const DeviceTable& table,
                            const SmvCase& fds, Assumptions assumptions, Reading& reading,
                            std::vector<fields::Field>& to) {
    fields::Field field;
    fields::FieldHead& head = field.head;
    head.name = "devices_" + fieldName(quantity, "values");
    head.kind = fields::FieldKind::Points;
    head.quantity = lowerAscii(quantity);
    head.medium = reading.options.medium.empty() ? "air" : reading.options.medium;
    head.by = fds.version.empty() ? "FDS" : fds.version;
    head.points = std::move(columns.points);
    SVT_TRY(kept, keptTimes(table.times, reading, head.name));
    SVT_DO(reading.addValues(head.points.size(), kept->size(), head.name));
    head.times.clear();
    for (const std::size_t t : *kept) {
        head.times.push_back(table.times[t]);
        for (const std::size_t column : columns.columns) field.values.push_back(table.rows[t][column]);
    }
    SVT_DO(setUnit(field, columns.unit, reading, assumptions));
    if (reading.options.precision) head.precision = *reading.options.precision;
    head.parameters = assumptions.json();
    to.push_back(std::move(field));
    return {};
}

}  // namespace

Result<void> readDevices(const SmvCase& fds, const Frame& frame, const Assumptions& place, Reading& reading,
                         std::vector<fields::Field>& to) {
    if (fds.deviceFile.empty()) return {};
    const std::filesystem::path path = reading.path.parent_path() / std::filesystem::path(fds.deviceFile).filename();
    std::error_code error;
    if (!std::filesystem::exists(path, error)) {
        reading.warn(Code::FieldInPart, "the table of devices is missing; their values are left out", path.string());
        return {};
    }
    SVT_TRY(bytes, FileBytes::read(path, std::min(kMaxDeviceTable, reading.options.maxBytes)));
    SVT_TRY(table, readDeviceTable(bytes->text(), path, reading));
    std::map<std::string, DeviceColumns> quantities;
    std::size_t placeless = 0;
    for (std::size_t c = 1; c < table->names.size(); ++c) {
        const auto found = fds.devices.find(table->names[c]);
        if (found == fds.devices.end()) {
            ++placeless;
            continue;
        }
        const std::string& quantity = found->second.quantity;
        if (!isAskedFor(reading.options,
                        std::array<std::string_view, 2>{quantity, std::string_view(fieldName(quantity, "values"))}))
            continue;
        DeviceColumns& columns = quantities[quantity + "\n" + table->units[c]];
        columns.unit = table->units[c];
        columns.columns.push_back(c);
        const Vec3d at = found->second.at;
        columns.points.push_back(
            {table->names[c], frame.origin + frame.axes[0] * at.x + frame.axes[1] * at.y + frame.axes[2] * at.z});
    }
    if (placeless > 0)
        reading.note(fmt::format("{} devices have no place in the .smv; they are left out", placeless), path.string());
    if (table->unreadable > 0)
        reading.warn(Code::BadField, fmt::format("{} cells are not numbers; they count as missing", table->unreadable),
                     path.string());
    if (table->times.empty()) return {};
    for (auto& [key, columns] : quantities)
        SVT_DO(addDeviceField(key.substr(0, key.find('\n')), std::move(columns), *table, fds, place, reading, to));
    return {};
}

}  // namespace svt::field_readers
