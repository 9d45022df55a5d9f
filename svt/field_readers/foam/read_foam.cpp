#include <svt/field_readers/foam/read_foam.hpp>

#include <svt/core/file.hpp>
#include <svt/core/text.hpp>
#include <svt/field_readers/foam/cell_lattice.hpp>
#include <svt/field_readers/foam/foam_text.hpp>
#include <svt/field_readers/lattices/lattice_field.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>

namespace svt::field_readers {
namespace {

namespace fs = std::filesystem;

// Names of folders of times by the time: 0.5 is "0.5", 100 "100" or "1e+02".
using Times = std::map<double, std::string>;

Times timesIn(const fs::path& folder) {
    Times times;
    std::error_code failed;
    for (fs::directory_iterator entry(folder, failed), end; !failed && entry != end; entry.increment(failed)) {
        const std::string name = entry->path().filename().string();
        const auto time = parseNumber(name);
        if (time && *time >= 0 && entry->is_directory(failed)) times.emplace(*time, name);
    }
    return times;
}

std::string_view quantityOf(std::string_view name) noexcept {
    if (name == "T") return "temperature";
    return name == "U" ? "velocity" : name;
}

// A folder with values: the whole case, or one of its parts.
struct Source {
    fs::path folder;
    std::optional<std::vector<std::int64_t>> cells;  // of the case, by cell of the part; unset: the whole case
};

// A time with the folders that have its values.
struct TimeStep {
    double time = 0;
    std::vector<std::pair<const Source*, fs::path>> folders;
};

class FoamCase {
public:
    FoamCase(Reading& reading, fs::path folder) : reading_(reading), folder_(std::move(folder)) {}

    Result<std::vector<fields::Field>> read() {
        SVT_TRY(lattice, readCellLattice(folder_, reading_.options.maxBytes));
        lattice_ = std::move(*lattice);
        SVT_DO(listParts());
        SVT_DO(listTimes());
        SVT_TRY(names, listFields());
        if (!lattice_.frame && !reading_.options.at)
            reading_.note(
                "the mesh does not state its place, so its coordinates count as world coordinates; give the "
                "place of their origin with --at X,Y,Z");
        std::vector<fields::Field> fields;
        for (const auto& [name, className] : *names) {
            SVT_TRY(field, readField(name, className == "volVectorField" ? 3 : 1));
            fields.push_back(std::move(*field));
        }
        return fields;
    }

private:
    // The parts of a decomposed case.
    Result<void> listParts() {
        whole_.folder = folder_;
        std::error_code failed;
        std::size_t covered = 0;
        if (hasCollated())
            reading_.warn(Code::FieldInPart, "collated results of processors are left out; run reconstructPar");
        for (int n = 0;; ++n) {
            const fs::path part = folder_ / fmt::format("processor{}", n);
            if (!fs::is_directory(part, failed)) break;
            const fs::path file = part / "constant" / "polyMesh" / "cellProcAddressing";
            SVT_TRY(bytes, foamBytes(file, reading_.options.maxBytes));
            SVT_TRY(reader, FoamReader::open(*bytes, file));
            SVT_TRY(cells, reader->labels());
            const auto count = static_cast<std::int64_t>(lattice_.nodeOfCell.size());
            for (const std::int64_t cell : *cells)
                if (cell < 0 || cell >= count)
                    return badField(fmt::format("cell {} is not one of the {} cells of the case", cell, count), file);
            covered += cells->size();
            parts_.push_back({part, std::move(*cells)});
        }
        if (!parts_.empty() && covered != lattice_.nodeOfCell.size())
            reading_.warn(Code::FieldInPart,
                          fmt::format("the {} processors have {} of the {} cells; times that only they "
                                      "have lack the others",
                                      parts_.size(), covered, lattice_.nodeOfCell.size()));
        return {};
    }

    [[nodiscard]] bool hasCollated() const {
        std::error_code failed;
        for (fs::directory_iterator entry(folder_, failed), end; !failed && entry != end; entry.increment(failed))
            if (entry->path().filename().string().starts_with("processors")) return true;
        return false;
    }

    Result<void> listTimes() {
        const Times whole = timesIn(folder_);
        std::map<double, std::vector<std::pair<const Source*, fs::path>>> inParts;
        for (const Source& part : parts_)
            for (const auto& [time, name] : timesIn(part.folder)) inParts[time].emplace_back(&part, part.folder / name);
        std::map<double, TimeStep> steps;
        for (const auto& [time, name] : whole) steps[time] = {time, {{&whole_, folder_ / name}}};
        for (auto& [time, folders] : inParts) {
            if (folders.size() == parts_.size())
                steps.emplace(time, TimeStep{time, std::move(folders)});
            else if (!steps.contains(time))
                reading_.warn(Code::FieldInPart, fmt::format("the time {} is left out: {} of {} processors have it",
                                                             time, folders.size(), parts_.size()));
        }
        if (steps.size() > 1 && steps.begin()->first == 0) steps.erase(steps.begin());
        if (steps.empty()) return badField("the case has no folder of a time", folder_);
        std::vector<double> times;
        for (const auto& [time, step] : steps) times.push_back(time);
        SVT_TRY(kept, keptTimes(times, reading_, folder_.filename().string()));
        for (const std::size_t k : *kept) steps_.push_back(std::move(steps[times[k]]));
        return {};
    }

    // The fields of the chosen times with their classes.
    Result<std::map<std::string, std::string>> listFields() {
        std::map<std::string, std::string> names;
        std::set<std::string> other, known;
        for (const TimeStep& step : steps_) {
            std::error_code failed;
            for (fs::directory_iterator entry(step.folders[0].second, failed), end; !failed && entry != end;
                 entry.increment(failed)) {
                if (!entry->is_regular_file(failed)) continue;
                fs::path name = entry->path().filename();
                if (name.extension() == ".gz") name.replace_extension();
                SVT_TRY(className, classOf(step.folders[0].second / name));
                const bool isField = *className == "volScalarField" || *className == "volVectorField";
                if (!isField) {
                    if (className->ends_with("Field")) other.insert(name.string());
                    continue;
                }
                known.insert(name.string());
                const std::array<std::string_view, 2> texts{known.find(name.string())->c_str(),
                                                            quantityOf(*known.find(name.string()))};
                if (isAskedFor(reading_.options, texts)) names.emplace(name.string(), *className);
            }
        }
        if (names.empty() && !known.empty())
            return Error(Code::BadArgument,
                         fmt::format("the case has no quantity '{}'; it has: {}", reading_.options.quantity,
                                     fmt::join(known, ", ")),
                         {folder_.string(), 0, 0, {}});
        if (names.empty()) return badField("the folders of times have no scalars and vectors of cells", folder_);
        if (reading_.options.quantity.empty() && !other.empty())
            reading_.note(fmt::format("fields of other kinds are left out: {}", fmt::join(other, ", ")));
        return names;
    }

    // The class of a file; empty if the file has no header of OpenFOAM.
    Result<std::string> classOf(const fs::path& file) {
        constexpr std::size_t kHead = 4096;
        std::error_code failed;
        std::string head;
        if (fs::exists(file, failed)) {
            SVT_TRY(part, PartFile::open(file));
            SVT_TRY(bytes, part->read(0, kHead));
            head = std::move(*bytes);
        } else {
            SVT_TRY(bytes, foamBytes(file, reading_.options.maxBytes));
            head = std::move(*bytes);
        }
        const auto reader = FoamReader::open(head, file);
        return reader ? reader->header().className : std::string();
    }

    Result<fields::Field> readField(const std::string& name, int components) {
        LatticeArray array;
        array.name = quantityOf(name);
        array.places = lattice_.places;
        if (lattice_.frame) {
            array.frame = *lattice_.frame;
            array.place = "by the note of the mesh";
        }
        array.components = components;
        array.by = "OpenFOAM";
        array.times.clear();
        std::vector<const TimeStep*> steps;
        std::error_code failed;
        for (const TimeStep& step : steps_) {
            const fs::path file = step.folders[0].second / name;
            if (!fs::exists(file, failed) && !fs::exists(fs::path(file.string() + ".gz"), failed)) continue;
            steps.push_back(&step);
            array.times.push_back(step.time);
        }
        const std::size_t each = lattice_.nodes() * static_cast<std::size_t>(components);
        SVT_DO(reading_.addValues(each, steps.size(), name));
        array.values.assign(each * steps.size(), std::numeric_limits<float>::quiet_NaN());
        for (std::size_t s = 0; s < steps.size(); ++s)
            for (const auto& [source, folder] : steps[s]->folders)
                SVT_DO(readValues(*source, folder / name, std::span(array.values).subspan(s * each, each), array));
        Assumptions assumptions;
        assumptions.add("places", "centres of cells");
        SVT_TRY(field, fieldOfArray(std::move(array), reading_, std::move(assumptions)));
        if (reading_.options.medium.empty()) field->head.medium = "air";
        return field;
    }

    // Puts the values of a file to the nodes of its cells.
    Result<void> readValues(const Source& source, const fs::path& file, std::span<float> to, LatticeArray& array) {
        SVT_TRY(bytes, foamBytes(file, reading_.options.maxBytes));
        SVT_TRY(reader, FoamReader::open(*bytes, file));
        SVT_TRY(field, reader->field());
        const std::size_t cells = source.cells ? source.cells->size() : lattice_.nodeOfCell.size();
        const auto components = static_cast<std::size_t>(array.components);
        if (field->components != array.components)
            return badField(fmt::format("the field is a {}, unlike at other times", reader->header().className), file);
        if (!field->isUniform && field->values.size() != cells * components)
            return badField(
                fmt::format("{} values stand where {} cells need {}", field->values.size(), cells, cells * components),
                file);
        if (!array.unit.empty() && array.unit != field->unit)
            return badField(fmt::format("the dimensions are {}, and {} at other times", field->unit, array.unit), file);
        array.unit = field->unit;
        for (std::size_t cell = 0; cell < cells; ++cell) {
            const std::size_t of = source.cells ? static_cast<std::size_t>((*source.cells)[cell]) : cell;
            const std::size_t from = field->isUniform ? 0 : cell * components;
            for (std::size_t c = 0; c < components; ++c)
                to[lattice_.nodeOfCell[of] * components + c] = static_cast<float>(field->values[from + c]);
        }
        return {};
    }

    Reading& reading_;
    fs::path folder_;
    CellLattice lattice_;
    Source whole_;
    std::vector<Source> parts_;
    std::vector<TimeStep> steps_;
};

}  // namespace

std::optional<fs::path> foamFolder(const fs::path& path) {
    std::error_code failed;
    fs::path folder = path;
    if (!fs::is_directory(path, failed)) {
        if (lowerAscii(path.extension().string()) != ".foam") return std::nullopt;
        folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
    }
    if (!fs::exists(folder / "system" / "controlDict", failed)) return std::nullopt;
    return folder;
}

Result<std::vector<fields::Field>> readFoam(Reading& reading) {
    const auto folder = foamFolder(reading.path);
    if (!folder)
        return badField("the folder has no case of OpenFOAM, because it lacks system/controlDict", reading.path);
    return FoamCase(reading, *folder).read();
}

}  // namespace svt::field_readers
