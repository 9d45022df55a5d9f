#include <svt/core/file.hpp>
#include <svt/volume/volume_json.hpp>
#include <svt/writers/labels/label_looks.hpp>
#include <svt/writers/simulation/box_list.hpp>
#include <svt/writers/simulation/solid_boxes.hpp>
#include <svt/writers/table.hpp>
#include <svt/writers/volume_formats.hpp>

#include <fmt/format.h>

#include <iterator>

namespace svt::writers {
namespace {

std::string jsonOf(Vec3d v) { return fmt::format("[{},{},{}]", v.x, v.y, v.z); }
std::string jsonOf(Vec3i v) { return fmt::format("[{},{},{}]", v.x, v.y, v.z); }

}  // namespace

Result<std::string> makeBoxTable(const volume::SemanticVolume& volume, const VolumeWriteOptions& options) {
    SVT_TRY(solids, solidBoxes(volume, options));
    std::string csv = csvLine(Row{"group", "name", "id", "class", "beginX", "beginY", "beginZ", "endX", "endY", "endZ",
                                  "minX", "minY", "minZ", "maxX", "maxY", "maxZ"});
    const bool isOne = options.boxes.mergeBy == MergeBy::Label;
    for (const analyze::GroupBox& box : solids->boxes) {
        const SolidGroup& group = solids->groups[box.group];
        const volume::Label& label = volume.labels.labels[group.label];
        Row row{box.group, group.name, isOne ? label.id : "",
                options.boxes.mergeBy == MergeBy::Material ? "" : label.className};
        for (const Vec3i& corner : {box.box.begin, box.box.end})
            for (int axis = 0; axis < 3; ++axis) row.emplace_back(corner[axis]);
        for (const Vec3i& corner : {box.box.begin, box.box.end})
            for (int axis = 0; axis < 3; ++axis) row.emplace_back(cornerOf(corner, volume.grid)[axis]);
        csv += csvLine(row);
    }
    return csv;
}

Result<std::string> makeBoxJson(const volume::SemanticVolume& volume, const VolumeWriteOptions& options) {
    SVT_TRY(solids, solidBoxes(volume, options));
    const volume::Grid& grid = volume.grid;
    std::string json = fmt::format(
        "{{\n\"grid\": {{\"dimension\": {}, \"spacing\": {}, \"lowerCorner\": {}, \"axes\": [{}, {}, {}], \"crs\": ",
        jsonOf(grid.dimension()), jsonOf(grid.spacing()), jsonOf(lowerCorner(grid)), jsonOf(grid.axes()[0]),
        jsonOf(grid.axes()[1]), jsonOf(grid.axes()[2]));
    volume::appendJsonString(json, volume.crsName);
    json += "},\n\"groups\": [";
    for (std::size_t g = 0; g < solids->groups.size(); ++g) {
        const volume::Label& label = volume.labels.labels[solids->groups[g].label];
        json += g == 0 ? "\n{\"name\": " : ",\n{\"name\": ";
        volume::appendJsonString(json, solids->groups[g].name);
        if (options.boxes.mergeBy == MergeBy::Label) {
            json += ", \"id\": ";
            volume::appendJsonString(json, label.id);
            json += ", \"class\": ";
            volume::appendJsonString(json, label.className);
        }
        json += '}';
    }
    json += "\n],\n\"boxes\": [";
    for (std::size_t b = 0; b < solids->boxes.size(); ++b) {
        const analyze::GroupBox& box = solids->boxes[b];
        fmt::format_to(std::back_inserter(json), R"({}{{"group": {}, "begin": {}, "end": {}, "min": {}, "max": {}}})",
                       b == 0 ? "\n" : ",\n", box.group, jsonOf(box.box.begin), jsonOf(box.box.end),
                       jsonOf(cornerOf(box.box.begin, grid)), jsonOf(cornerOf(box.box.end, grid)));
    }
    return json += "\n]\n}\n";
}

extern const VolumeFormat kBoxTable{
    .name = "boxes",
    .endings = ".boxes.csv",
    .holds = "boxes of the components, as a table",
    .readers = "other solvers, spreadsheets",
    .content = FileContent::Text,
    .write = [](const auto& volume, const auto& path, const auto& options) -> Result<std::uint64_t> {
        SVT_TRY(table, makeBoxTable(volume, options));
        return writeFileAtomically(path, *table);
    }};

extern const VolumeFormat kBoxJson{
    .name = "boxesjson",
    .endings = ".boxes.json",
    .holds = "boxes of the components, with the place of the grid",
    .readers = "other solvers",
    .content = FileContent::PlainJson,
    .write = [](const auto& volume, const auto& path, const auto& options) -> Result<std::uint64_t> {
        SVT_TRY(json, makeBoxJson(volume, options));
        return writeFileAtomically(path, *json);
    }};

}  // namespace svt::writers
