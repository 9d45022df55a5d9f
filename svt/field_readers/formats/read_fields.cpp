#include <svt/field_readers/read_fields.hpp>

#include <svt/core/file.hpp>
#include <svt/core/text.hpp>
#include <svt/field_readers/common/placement.hpp>
#include <svt/field_readers/common/reading.hpp>
#include <svt/field_readers/fds/read_fds.hpp>
#include <svt/field_readers/foam/read_foam.hpp>
#include <svt/field_readers/lattices/read_lattices.hpp>
#include <svt/field_readers/sensors/sensor_series.hpp>
#include <svt/fields/check_field.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace svt::field_readers {
namespace {

struct FieldFormat {
    std::string_view ending, head;  ///< of the file; either is enough
    Result<std::vector<fields::Field>> (*read)(Reading&);
    bool isOfSensors = false;
};

constexpr std::string_view kKnownFormats =
    ".smv of FDS, .csv of sensors, .json of OGC SensorThings, .vti, .vtr, .pvd of VTK, .nrrd, folders of OpenFOAM";

constexpr FieldFormat kFormats[] = {{".smv", "TITLE", readFds},
                                    {".csv", "", readSensorTable, true},
                                    {".json", "{", readSensorThings, true},
                                    {".vti", "<VTKFile type=\"ImageData\"", readVtkFields},
                                    {".vtr", "<VTKFile type=\"RectilinearGrid\"", readVtkFields},
                                    {".pvd", "<VTKFile type=\"Collection\"", readVtkSeries},
                                    {".nrrd", "NRRD000", readNrrdField}};

// A case is a folder, or a file within the folder.
constexpr FieldFormat kFoam{".foam", "", readFoam};

Result<const FieldFormat*> formatOf(const std::filesystem::path& path) {
    std::error_code failed;
    const bool isFolder = std::filesystem::is_directory(path, failed);
    if (isFolder || foamFolder(path)) return &kFoam;
    SVT_TRY(file, PartFile::open(path));
    const std::string ending = lowerAscii(path.extension().string());
    for (const FieldFormat& format : kFormats)
        if (ending == format.ending) return &format;
    SVT_TRY(head, file->read(0, 4096));
    for (const FieldFormat& format : kFormats)
        if (!format.head.empty() && withoutBlanks(*head).find(format.head) < 64) return &format;
    return badField(fmt::format("the format is not known; fields come from {}", kKnownFormats), path);
}

// Warns of points outside of the volume. \return FieldOutside if all are outside
Result<void> checkPoints(const fields::FieldHead& head, const Reading& reading) {
    const volume::Grid& grid = reading.volume.grid;
    const Box3d box = boxOf(grid);
    Box3d points;
    std::string outside;
    std::size_t count = 0;
    for (const fields::FieldPoint& point : head.points) {
        const Vec3d index = grid.indexFromWorld(point.at);
        points.add(index);
        if (!box.contains(index) && ++count <= 5) outside += (outside.empty() ? "'" : ", '") + point.id + "'";
    }
    if (count == head.points.size())
        return outsideError(head.name, points, reading,
                            "correct the places, in world space, or give them by rooms with --places");
    if (count > 0)
        reading.warn(Code::FieldOutside,
                     fmt::format("'{}': {} of {} points lie outside of the volume: {}{}", head.name, count,
                                 head.points.size(), outside, count > 5 ? " and others" : ""));
    return {};
}

Result<void> checkPlace(const fields::FieldHead& head, const Reading& reading) {
    if (head.kind == fields::FieldKind::Points) return checkPoints(head, reading);
    if (head.kind != fields::FieldKind::Grid) return {};
    const Box3d field = boxOf(head.lattice);
    if (!field.overlaps(boxOf(reading.volume.grid))) return outsideError(head.name, field, reading);
    return {};
}

}  // namespace

Result<std::vector<fields::Field>> readFields(const std::filesystem::path& path, const volume::SemanticVolume& volume,
                                              const FieldReadOptions& options, Diagnostics& diagnostics) {
    if (!(options.firstTime <= options.lastTime))
        return Error(Code::BadArgument, fmt::format("the first time, {} s, is behind the last, {} s", options.firstTime,
                                                    options.lastTime));
    if (!(options.timeStep >= 0))
        return Error(Code::BadArgument, "the time between kept values must be a number of seconds of at least 0");
    Reading reading{path, volume, options, diagnostics, 0};
    SVT_TRY(format, formatOf(path));
    if ((*format)->isOfSensors && options.at)
        return Error(Code::BadArgument, "--at has no meaning for sensors; their places come from --places");
    if (!(*format)->isOfSensors && !options.places.empty())
        return Error(Code::BadArgument,
                     "--places has a meaning for tables of sensors only; give the place of a lattice with "
                     "--at");
    SVT_TRY(read, (*format)->read(reading));
    std::vector<fields::Field> fields;
    std::optional<Error> outside;
    std::set<std::string> names;
    for (fields::Field& field : *read) {
        if (const auto place = checkPlace(field.head, reading); !place) {
            if (outside) reading.warn(Code::FieldOutside, outside->message());
            outside = place.error();
            continue;
        }
        const std::string name = field.head.name;
        for (int n = 2; !names.insert(field.head.name).second; ++n) field.head.name = fmt::format("{}_{}", name, n);
        if (const auto checked = fields::checkField(field, volume.labels.labels.size()); !checked)
            return Error(checked.error().code(), checked.error().message(), {path.string(), 0, 0, {}});
        fields.push_back(std::move(field));
    }
    if (fields.empty() && outside) return *outside;
    if (outside) reading.warn(Code::FieldOutside, outside->message());
    if (fields.empty()) return badField("the file has no values", path);
    return fields;
}

}  // namespace svt::field_readers
