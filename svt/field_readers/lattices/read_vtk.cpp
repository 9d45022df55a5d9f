#include <svt/core/file.hpp>
#include <svt/core/text.hpp>
#include <svt/field_readers/lattices/read_lattices.hpp>
#include <svt/field_readers/lattices/vtk_file.hpp>

#include <fmt/format.h>
#include <pugixml.hpp>

#include <algorithm>
#include <set>

namespace svt::field_readers {
namespace {

// The arrays to read: those that are asked for, else all floats. Names the others in a note.
Result<std::vector<VtkArray>> chosenArrays(const VtkFile& file, const Reading& reading,
                                           const std::filesystem::path& path) {
    std::vector<VtkArray> chosen;
    std::set<std::string> names, left;
    for (const VtkArray& array : file.arrays()) {
        names.insert(array.name);
        const std::string name = fieldName(array.name, "field");
        if (!isAskedFor(reading.options, std::array<std::string_view, 2>{array.name, name})) continue;
        if (array.components != 1 && array.components != 3) {
            left.insert(fmt::format("'{}' ({} components)", array.name, array.components));
            continue;
        }
        if (reading.options.quantity.empty() && array.type.kind != 'f') {
            left.insert(fmt::format("'{}' (whole numbers)", array.name));
            continue;
        }
        chosen.push_back(array);
    }
    std::string list;
    for (const std::string& name : chosen.empty() && left.empty() ? names : left)
        list += (list.empty() ? "" : ", ") + name;
    if (chosen.empty())
        return badField(fmt::format("the file has no array to read{}{}; name one with --quantity",
                                    list.empty() ? "" : "; it has ", list),
                        path);
    if (!left.empty())
        reading.note(fmt::format("arrays are left out: {}; name one with --quantity", list), path.string());
    return chosen;
}

LatticeArray latticeArray(const VtkFile& file, const VtkArray& array) {
    LatticeArray lattice;
    lattice.name = array.name;
    lattice.places = file.places(array.isCell);
    lattice.frame = file.frame();
    lattice.components = array.components;
    lattice.by = "VTK";
    const VtkFacts& facts = file.facts();
    lattice.unit = facts.unit;
    lattice.quantity = facts.quantity;
    lattice.medium = facts.medium;
    lattice.epoch = facts.epoch;
    if (facts.time) lattice.times = {*facts.time};
    return lattice;
}

Assumptions placesOfArray(const VtkArray& array) {
    Assumptions assumptions;
    if (array.isCell) assumptions.add("places", "centres of cells");
    return assumptions;
}

// A file of a series and its time.
struct TimedFile {
    double time = 0;
    std::filesystem::path path;
};

Result<std::vector<TimedFile>> listSeries(const std::filesystem::path& path) {
    constexpr std::uint64_t kMaxSeries = std::uint64_t{64} << 20;
    SVT_TRY(bytes, FileBytes::read(path, kMaxSeries));
    pugi::xml_document document;
    if (const auto parsed = document.load_buffer(bytes->bytes().data(), bytes->bytes().size()); !parsed)
        return badField(fmt::format("the XML is damaged: {}", parsed.description()), path);
    std::vector<TimedFile> files;
    for (const pugi::xml_node set : document.child("VTKFile").child("Collection").children("DataSet")) {
        const auto time = parseNumber(set.attribute("timestep").value());
        const std::filesystem::path name(set.attribute("file").value());
        if (!time || name.empty()) return badField("a DataSet has no timestep or no file", path);
        // The list may come from another machine, so only files below its own folder are read.
        const auto isUp = [](const std::filesystem::path& part) { return part == ".."; };
        if (name.is_absolute() || std::find_if(name.begin(), name.end(), isUp) != name.end())
            return badField(fmt::format("the file '{}' lies outside of the folder of the list", name.string()), path);
        if (!files.empty() && !(*time > files.back().time))
            return badField(fmt::format("the times do not ascend at {} s; lists of several parts are not read", *time),
                            path);
        files.push_back({*time, path.parent_path() / name});
    }
    if (files.empty()) return badField("the list has no files", path);
    return files;
}

}  // namespace

Result<std::vector<fields::Field>> readVtkFields(Reading& reading) {
    SVT_TRY(file, VtkFile::open(reading.path, reading.options.maxBytes));
    SVT_TRY(arrays, chosenArrays(*file, reading, reading.path));
    std::vector<fields::Field> fields;
    for (const VtkArray& array : *arrays) {
        LatticeArray lattice = latticeArray(*file, array);
        SVT_DO(reading.addValues(placesOf(lattice.places) * static_cast<std::uint64_t>(lattice.components), 1,
                                 array.name));
        SVT_DO(file->read(array, lattice.values));
        SVT_TRY(field, fieldOfArray(std::move(lattice), reading, placesOfArray(array)));
        fields.push_back(std::move(*field));
    }
    return fields;
}

Result<std::vector<fields::Field>> readVtkSeries(Reading& reading) {
    SVT_TRY(list, listSeries(reading.path));
    std::vector<double> times;
    for (const TimedFile& file : *list) times.push_back(file.time);
    SVT_TRY(kept, keptTimes(times, reading, reading.path.stem().string()));
    std::vector<VtkArray> arrays;
    std::vector<LatticeArray> lattices;
    for (const std::size_t t : *kept) {
        const std::filesystem::path& path = (*list)[t].path;
        SVT_TRY(file, VtkFile::open(path, reading.options.maxBytes));
        if (lattices.empty()) {
            SVT_TRY(chosen, chosenArrays(*file, reading, path));
            arrays = std::move(*chosen);
            for (const VtkArray& array : arrays) {
                lattices.push_back(latticeArray(*file, array));
                lattices.back().times.clear();
                SVT_DO(
                    reading.addValues(placesOf(lattices.back().places) * static_cast<std::uint64_t>(array.components),
                                      kept->size(), array.name));
            }
        }
        for (std::size_t a = 0; a < arrays.size(); ++a) {
            const auto found = std::find_if(file->arrays().begin(), file->arrays().end(), [&](const VtkArray& array) {
                return array.name == arrays[a].name && array.isCell == arrays[a].isCell &&
                       array.components == arrays[a].components;
            });
            if (found == file->arrays().end() || file->places(found->isCell) != lattices[a].places)
                return badField(
                    fmt::format("the file has no array '{}' on the lattice of the first file", arrays[a].name), path);
            SVT_DO(file->read(*found, lattices[a].values));
            lattices[a].times.push_back(times[t]);
        }
    }
    std::vector<fields::Field> fields;
    for (std::size_t a = 0; a < arrays.size(); ++a) {
        SVT_TRY(field, fieldOfArray(std::move(lattices[a]), reading, placesOfArray(arrays[a])));
        fields.push_back(std::move(*field));
    }
    return fields;
}

}  // namespace svt::field_readers
