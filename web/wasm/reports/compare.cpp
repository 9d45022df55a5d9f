// Compares two states of a building: files in; rows, and a volume of the difference out.
#include "reports.hpp"

#include <svt/compare/compare_states.hpp>
#include <svt/compare/difference_volume.hpp>
#include <svt/frontend/comparison_json.hpp>
#include <svt/image/color_text.hpp>
#include <svt/volume/svt_file.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <memory>
#include <utility>

namespace svt::web {
namespace {

std::unique_ptr<compare::ComparedStates> comparing;

struct Wish {
    compare::CompareOptions options;
    bool isAligned = false;
    std::uint64_t memoryBytes = 0;  // limit of each volume without a given spacing; 0: as for `svt diff`
};

Result<Wish> wishOf(const Json& given) {
    Wish wish;
    const auto text = [&](const char* name, const char* byDefault) {
        return given.is_object() ? given.value(name, std::string(byDefault)) : std::string(byDefault);
    };
    const auto number = [&](const char* name, double byDefault) {
        return given.is_object() ? given.value(name, byDefault) : byDefault;
    };
    const auto match = fromName<compare::MatchBy>(text("match", "both"));
    const auto properties = fromName<compare::Properties>(text("properties", "all"));
    if (!match || !properties) return Error(Code::BadArgument, "match or properties of a comparison are unknown");
    wish.options.match = *match;
    wish.options.properties = *properties;
    wish.options.tolerance = number("tolerance", wish.options.tolerance);
    wish.isAligned = given.is_object() && given.value("align", false);
    wish.memoryBytes = static_cast<std::uint64_t>(std::max(0.0, number("memory", 0)));
    return wish;
}

Json knownOrNull(const std::optional<double>& value) { return value ? Json(compare::withoutRounding(*value)) : Json(); }

// The Report of the page (web/viewer/src/comparing/compared.ts).
std::string reportOf(const compare::ComparedStates& states, const Diagnostics& findings) {
    const compare::Comparison& comparison = states.comparison;
    const compare::ClassSums sums = compare::sumsOfComponents(states.compared());
    Json report{{"aligned", nameOf(states.alignment)},
                {"shift", Json::array({states.shift.x, states.shift.y, states.shift.z})},
                {"hasMeshes", !states.was.vectors.triangles.empty() && !states.is.vectors.triangles.empty()},
                {"overlaps", compare::overlapInSpace(states.was.grid, states.is.grid)},
                {"isReferenceSystemUnknown", comparison.isReferenceSystemUnknown},
                {"isOnOneLattice", comparison.isOnOneLattice},
                {"isComplete", comparison.isComplete},
                {"components",
                 {{"objects", sums.objects},
                  {"added", knownOrNull(sums.added)},
                  {"removed", knownOrNull(sums.removed)},
                  {"bound", knownOrNull(sums.bound)},
                  {"withoutVolume", sums.unknown}}}};
    for (std::size_t n = 0; n < compare::kChangeCount; ++n) {
        const auto change = static_cast<compare::Change>(n);
        report["colors"][std::string(nameOf(change))] = image::colorText(compare::colorOfChange(change));
    }
    report["findings"] = findingsJson(findings);
    return report.dump(-1, ' ', false, Json::error_handler_t::replace);
}

// ([[names of the old state], [names of the new state]], sizes in the same way, {match, properties, tolerance, align,
// memory}) and the concatenated bytes of all files -> Report of
// web/viewer/src/comparing/compared.ts
Result<Reply> compareFiles(const Arguments& arguments) {
    comparing.reset();
    std::array<Files, 2> files;
    std::size_t at = 0;
    for (std::size_t state = 0; state < 2; ++state) {
        SVT_TRY(given, filesOf(arguments.at(0).at(state), arguments.at(1).at(state), arguments.bytes(), at));
        files[state] = std::move(*given);
    }
    SVT_TRY(wish, wishOf(arguments.at(2)));
    const Progress progress = progressOfPage();
    Diagnostics findings;
    const auto sourceOf = [&](const Files& given) -> compare::StateSource {
        return {
            [&](const volume::Grid* grid) { return readVolume(given, wish->memoryBytes, grid, progress, findings); },
            isVolume(given)};
    };
    compare::CompareOptions options = wish->options;
    options.progress = &progress;
    SVT_TRY(states, compare::compareStates(sourceOf(files[0]), sourceOf(files[1]), wish->isAligned, options));
    comparing = std::make_unique<compare::ComparedStates>(std::move(*states));
    return Reply(reportOf(*comparing, findings));
}

Result<const compare::ComparedStates*> compared() {
    if (!comparing) return Error(Code::BadArgument, "no states are compared; compare two first");
    return static_cast<const compare::ComparedStates*>(comparing.get());
}

// () -> the bytes that `svt diff -o F.json` writes
Result<Reply> rows(const Arguments&) {
    SVT_TRY(states, compared());
    return Reply(frontend::comparisonFile((*states)->compared()));
}

// () -> the numbers of the rows that differ, with the largest change first
Result<Reply> order(const Arguments&) {
    SVT_TRY(states, compared());
    return Reply(Json(compare::rowsByVolume((*states)->comparison)).dump());
}

// () -> the bytes that `svt diff -o F.svt` writes
Result<Reply> difference(const Arguments&) {
    SVT_TRY(states, compared());
    SVT_TRY(volume, compare::makeDifferenceVolume((*states)->was, (*states)->is, (*states)->comparison));
    SVT_TRY(bytes, volume::svtBytes(*volume));
    return Reply(std::move(*bytes));
}

constexpr Call kCompareCalls[] = {{"compare", compareFiles, false},
                                  {"rows", rows, false},
                                  {"order", order, false},
                                  {"difference", difference, false}};

}  // namespace

std::span<const Call> comparisonCalls() noexcept { return kCompareCalls; }

}  // namespace svt::web
