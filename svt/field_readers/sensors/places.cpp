#include <svt/field_readers/sensors/places.hpp>

#include <svt/analyze/selection.hpp>
#include <svt/core/file.hpp>
#include <svt/core/text.hpp>
#include <svt/record/csv_reader.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace svt::field_readers {
namespace {

constexpr std::uint64_t kMaxPlacesTable = std::uint64_t{64} << 20;

using Places = std::map<std::string, SensorPlace, std::less<>>;

struct PlaceColumns {
    std::optional<std::size_t> name, x, y, z, room;

    [[nodiscard]] bool hasPoint() const noexcept { return x && y && z; }
};

PlaceColumns columnsOf(const std::vector<std::string>& header) {
    PlaceColumns columns;
    for (std::size_t c = 0; c < header.size(); ++c) {
        const std::string title = lowerAscii(header[c]);
        if (title == "name" || title == "sensor" || title == "id") columns.name = c;
        if (title == "x") columns.x = c;
        if (title == "y") columns.y = c;
        if (title == "z") columns.z = c;
        if (title == "room") columns.room = c;
    }
    return columns;
}

// The component that a text names: by id, by name, or as a query.
Result<std::uint32_t> roomOf(const std::string& text, const volume::SemanticVolume& volume,
                             const analyze::LabelRows& rows) {
    const auto& labels = volume.labels.labels;
    std::vector<std::uint32_t> found;
    for (std::uint32_t l = 0; l < labels.size(); ++l)
        if (labels[l].id == text) found.push_back(l);
    if (found.empty())
        for (std::uint32_t l = 0; l < labels.size(); ++l)
            if (labels[l].name == text && labels[l].voxels > 0) found.push_back(l);
    if (found.empty()) {
        const auto selected = analyze::selectLabels(rows, text);
        if (!selected)
            return Error(selected.error().code(),
                         fmt::format("no component has the id or the name '{}', and as a query it selects none: {}",
                                     text, selected.error().message()));
        for (const std::uint32_t l : *selected)
            if (labels[l].voxels > 0) found.push_back(l);
    }
    if (found.size() != 1)
        return Error(Code::BadField,
                     fmt::format("'{}' names {} components with voxels; name one by its id", text, found.size()));
    if (labels[found[0]].voxels == 0)
        return Error(Code::BadField, fmt::format("'{}' has no voxels; give coordinates", text));
    return found[0];
}

// The place of each room, by the rule of readPlaces().
std::map<std::uint32_t, Vec3d> roomPlaces(const std::vector<std::uint32_t>& rooms,
                                          const volume::SemanticVolume& volume) {
    constexpr std::size_t kNone = ~std::size_t{0};
    std::vector<std::size_t> roomOfScalar(volume.labels.scalarCount(), kNone);
    for (std::size_t r = 0; r < rooms.size(); ++r) {
        const volume::Label& label = volume.labels.labels[rooms[r]];
        for (volume::Scalar s = 0; s < label.count; ++s) roomOfScalar[label.first + s] = r;
    }
    const auto forRuns = [&](const auto& visit) {
        const Vec3i size = volume.columns.dimension();
        for (std::int32_t j = 0; j < size.y; ++j)
            for (std::int32_t i = 0; i < size.x; ++i) {
                std::uint32_t begin = 0;
                for (const volume::Run& run : volume.columns.column(i, j)) {
                    if (run.scalar < roomOfScalar.size() && roomOfScalar[run.scalar] != kNone)
                        visit(roomOfScalar[run.scalar], i, j, begin, run.end);
                    begin = run.end;
                }
            }
    };
    std::vector<Vec3d> centroid(rooms.size()), nearest(rooms.size());
    std::vector<double> voxels(rooms.size()), distance(rooms.size(), kInfinity);
    forRuns([&](std::size_t r, std::int32_t i, std::int32_t j, std::uint32_t begin, std::uint32_t end) {
        const double n = end - begin;
        voxels[r] += n;
        centroid[r] = centroid[r] + Vec3d{double(i), double(j), (double(begin) + double(end) - 1) / 2} * n;
    });
    for (std::size_t r = 0; r < rooms.size(); ++r)
        if (voxels[r] > 0) centroid[r] = centroid[r] / voxels[r];
    forRuns([&](std::size_t r, std::int32_t i, std::int32_t j, std::uint32_t begin, std::uint32_t end) {
        const double k = std::clamp(std::round(centroid[r].z), double(begin), double(end) - 1);
        const Vec3d place{double(i), double(j), k};
        const double apart = length(scaled(place - centroid[r], volume.grid.spacing()));
        if (apart < distance[r]) {
            distance[r] = apart;
            nearest[r] = place;
        }
    });
    std::map<std::uint32_t, Vec3d> places;
    for (std::size_t r = 0; r < rooms.size(); ++r) places[rooms[r]] = volume.grid.worldFromIndex(nearest[r]);
    return places;
}

// A row of the table; its room, if it has no coordinates, is found later.
Result<void> addPlaceRow(const std::vector<std::string>& cells, const PlaceColumns& columns,
                         const record::CsvReader& reader, const std::filesystem::path& path, Places& places) {
    const auto cell = [&](std::optional<std::size_t> column) {
        return column && *column < cells.size() ? std::string_view(cells[*column]) : std::string_view();
    };
    const std::string name(cell(columns.name));
    if (name.empty()) return badField("the row has no name of a sensor", path, reader.line());
    SensorPlace place;
    place.line = reader.line();
    place.room = std::string(cell(columns.room));
    const bool hasPoint = columns.hasPoint() && !cell(columns.x).empty();
    if (hasPoint) {
        const auto x = reader.number(cell(columns.x)), y = reader.number(cell(columns.y)),
                   z = reader.number(cell(columns.z));
        if (!x || !y || !z)
            return badField(fmt::format("the place of '{}' is not three numbers", name), path, place.line);
        place.at = {*x, *y, *z};
        place.room.clear();
    } else if (place.room.empty()) {
        return badField(fmt::format("'{}' has neither x, y and z nor a room", name), path, place.line);
    }
    const auto [at, isNew] = places.emplace(name, std::move(place));
    if (!isNew)
        return badField(fmt::format("'{}' has a place on line {} already", name, at->second.line), path, reader.line());
    return {};
}

}  // namespace

Result<Places> readPlaces(const Reading& reading) {
    const std::filesystem::path& path = reading.options.places;
    SVT_TRY(bytes, FileBytes::read(path, kMaxPlacesTable));
    SVT_DO(record::checkTableText(bytes->text(), path.string()));
    record::CsvReader reader(bytes->text());
    std::vector<std::string> cells;
    const bool hasHeader = reader.next(cells);
    const PlaceColumns columns = hasHeader ? columnsOf(cells) : PlaceColumns();
    if (!columns.name || (!columns.hasPoint() && !columns.room))
        return badField("the first line must name the columns: name,x,y,z or name,room", path, 1);
    Places places;
    while (reader.next(cells)) SVT_DO(addPlaceRow(cells, columns, reader, path, places));
    const analyze::LabelRows rows(reading.volume);
    std::map<std::string, std::uint32_t> rooms;
    std::vector<std::uint32_t> distinct;
    for (const auto& [name, place] : places) {
        if (place.room.empty() || rooms.count(place.room) > 0) continue;
        const auto room = roomOf(place.room, reading.volume, rows);
        if (!room) return badField(room.error().message(), path, place.line);
        rooms[place.room] = *room;
        if (std::find(distinct.begin(), distinct.end(), *room) == distinct.end()) distinct.push_back(*room);
    }
    if (distinct.empty()) return places;
    const auto found = roomPlaces(distinct, reading.volume);
    for (auto& [name, place] : places)
        if (!place.room.empty()) place.at = found.at(rooms[place.room]);
    return places;
}

}  // namespace svt::field_readers
