#include <apps/cli/field/field_export.hpp>

#include <apps/cli/field/field_tables.hpp>
#include <apps/cli/options/field_input.hpp>
#include <apps/cli/output/messages.hpp>
#include <apps/cli/output/output_files.hpp>
#include <apps/cli/output/terminal_progress.hpp>

#include <svt/core/file.hpp>
#include <svt/field_writers/write_lattice.hpp>
#include <svt/fields/svt_fields.hpp>
#include <svt/volume/svt_file.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace svt::cli {
namespace {

using fields::FieldHead;

// The numbers of the times to write.
Result<std::vector<std::size_t>> chosenTimes(const FieldHead& head, std::optional<double> wanted) {
    std::vector<std::size_t> times;
    for (std::size_t t = 0; t < head.times.size(); ++t)
        if (!wanted || std::abs(head.times[t] - *wanted) <= 1e-6) times.push_back(t);
    if (!times.empty()) return times;
    return Error(Code::BadArgument,
                 fmt::format("--time: the field '{}' has no values at {} s; it has {} times from {} to {} s, see "
                             "svt field list --json",
                             head.name, *wanted, head.times.size(), head.times.front(), head.times.back()));
}

Result<std::uint64_t> exportLattice(const fields::Field& field, const volume::SemanticVolume& volume,
                                    const std::vector<std::size_t>& times, const std::filesystem::path& output) {
    const std::string ending = endingOf(output);
    if (field.head.kind != fields::FieldKind::Grid)
        return Error(
            Code::BadArgument,
            fmt::format("the field '{}' has values of {}, and {} holds those of a lattice; write a .csv, .json or "
                        ".parquet",
                        field.head.name, field.head.kind == fields::FieldKind::Label ? "components" : "points",
                        ending));
    if (times.size() > 1)
        return Error(Code::BadArgument,
                     fmt::format("{} holds one time, and the field '{}' has {}; choose one with --time", ending,
                                 field.head.name, times.size()));
    return field_writers::writeLattice(field, volume.grid, times.front(), output);
}

}  // namespace

Result<int> runFieldExport(const FieldExportArguments& arguments) {
    SVT_DO(requireSvt(arguments.input));
    const TerminalProgress progress;
    SVT_TRY(field, fields::readField(arguments.input, arguments.name));
    SVT_TRY(times, chosenTimes(field->head, arguments.time));
    SVT_TRY(volume, volume::readSvt(arguments.input));
    const std::string ending = endingOf(arguments.output);
    if (ending != ".csv" && ending != ".json" && ending != ".parquet") {
        SVT_TRY(bytes, exportLattice(*field, *volume, *times, arguments.output));
        TerminalProgress::hide();
        summarize(fmt::format("{}: {} at {:g} s, {:.1f} kB", arguments.output.string(), field->head.name,
                              field->head.times[times->front()], double(*bytes) / 1000));
        return kDone;
    }
    SVT_TRY(table, valueTable(*field, *volume, *times));
    SVT_DO(writeTable(*table, arguments.output));
    TerminalProgress::hide();
    summarize(fmt::format("{}: {} rows", arguments.output.string(), table->rows.size()));
    return kDone;
}

Members<FieldExportArguments> membersOf(const FieldExportArguments*) noexcept {
    using All = FieldExportArguments;
    static constexpr Member<All> kMembers[] = {
        member<&All::input>("volume", "a .svt with the field",
                            {.value = "F.svt", .isRequired = true, .file = FileUse::ModelOrVolume}),
        member<&All::name>("name", "the name of the field, see 'svt field list'",
                           {.value = "NAME", .isRequired = true}),
        member<&All::output>("-o,--output",
                             "file to write: .vti or .vtr of VTK or .nrrd for a lattice at one time; .csv, .json or "
                             ".parquet for the values of any field",
                             {.value = "FILE",
                              .isRequired = true,
                              .file = FileUse::Output,
                              .formats = "vti|vtr|nrrd|csv|json|objectparquet"}),
        member<&All::time>("--time", "one of the times of the field",
                           {.unit = "seconds", .otherwise = "all times; the only time for a lattice"}),
        quietOption<All>(),
    };
    return kMembers;
}

}  // namespace svt::cli
