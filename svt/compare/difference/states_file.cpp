#include <svt/compare/states_file.hpp>

#include <svt/compare/difference_volume.hpp>
#include <svt/volume/svt_file.hpp>
#include <svt/volume/zip_entries.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace svt::compare {
namespace {

using RowsJson = nlohmann::ordered_json;

constexpr const char *kRowsEntry = "states/rows.json", *kWasEntry = "states/was.svt", *kIsEntry = "states/is.svt";
constexpr std::uint64_t kMostRowBytes = std::uint64_t{1} << 28, kMostStateBytes = std::uint64_t{1} << 36;
constexpr int kDeepest = 16;  // nesting of rows.json

RowsJson orNull(const std::optional<double>& value) { return value ? RowsJson(*value) : RowsJson(); }

RowsJson rowToJson(const ComparisonRow& row) {
    RowsJson to;
    to["change"] = nameOf(row.change);
    to["was"] = row.was;
    to["is"] = row.is;
    to["geometry"] = row.hasGeometry;
    to["exact"] = row.isExact;
    to["vector"] = row.vector ? RowsJson{row.vector->x, row.vector->y, row.vector->z} : RowsJson();
    to["added"] = orNull(row.added);
    to["removed"] = orNull(row.removed);
    to["bound"] = orNull(row.bound);
    to["distance"] = orNull(row.distance);
    to["properties"] = row.hasOtherProperties();
    return to;
}

Error badStates(std::string_view problem) {
    return Error(Code::BadVolume, fmt::format("{}: {}; compare the states again", kRowsEntry, problem));
}

Result<std::vector<std::uint32_t>> labelsOf(const RowsJson& row, const char* key, std::size_t count) {
    std::vector<std::uint32_t> labels;
    const auto at = row.find(key);
    if (at == row.end() || !at->is_array()) return badStates("a row lacks its labels");
    for (const RowsJson& label : *at) {
        if (!label.is_number_unsigned() || label.get<std::uint64_t>() >= count)
            return badStates("a row has a label that its state does not have");
        labels.push_back(label.get<std::uint32_t>());
    }
    return labels;
}

std::optional<double> numberOf(const RowsJson& row, const char* key) {
    const auto at = row.find(key);
    return at != row.end() && at->is_number() ? std::optional(at->get<double>()) : std::nullopt;
}

bool isTrue(const RowsJson& row, const char* key) {
    const auto at = row.find(key);
    return at != row.end() && at->is_boolean() && at->get<bool>();
}

Result<ComparisonRow> rowFromJson(const RowsJson& from, std::size_t wasCount, std::size_t isCount) {
    if (!from.is_object()) return badStates("a row is not an object");
    const auto change = from.find("change");
    if (change == from.end() || !change->is_string()) return badStates("a row lacks its change");
    const auto kind = fromName<Change>(change->get<std::string>());
    if (!kind) return badStates("a row has an unknown change");
    ComparisonRow row;
    row.change = *kind;
    SVT_TRY(was, labelsOf(from, "was", wasCount));
    SVT_TRY(is, labelsOf(from, "is", isCount));
    if (was->empty() && is->empty()) return badStates("a row has no labels");
    row.was = std::move(*was);
    row.is = std::move(*is);
    row.hasGeometry = isTrue(from, "geometry");
    row.isExact = isTrue(from, "exact");
    if (const auto at = from.find("vector"); at != from.end() && at->is_array() && at->size() == 3) {
        Vec3d vector{};
        for (int axis = 0; axis < 3; ++axis) {
            const RowsJson& value = (*at)[std::size_t(axis)];
            if (!value.is_number()) return badStates("a vector has a member that is not a number");
            vector[axis] = value.get<double>();
        }
        row.vector = vector;
    }
    row.added = numberOf(from, "added");
    row.removed = numberOf(from, "removed");
    row.bound = numberOf(from, "bound");
    row.distance = numberOf(from, "distance");
    return row;
}

Result<void> readRows(std::string_view text, ComparedStates& states) {
    bool isTooDeep = false;
    const auto guard = [&](int depth, RowsJson::parse_event_t, RowsJson&) {
        isTooDeep = isTooDeep || depth > kDeepest;
        return !isTooDeep;
    };
    const RowsJson document = RowsJson::parse(text, guard, false);
    if (isTooDeep || document.is_discarded() || !document.is_object()) return badStates("it is not the expected JSON");
    const auto rows = document.find("rows");
    if (rows == document.end() || !rows->is_array()) return badStates("it has no rows");
    const std::size_t wasCount = states.was.labels.labels.size(), isCount = states.is.labels.labels.size();
    Comparison& comparison = states.comparison;
    for (const RowsJson& from : *rows) {
        SVT_TRY(row, rowFromJson(from, wasCount, isCount));
        comparison.count(*row);
        comparison.otherProperties += isTrue(from, "properties") ? 1 : 0;
        comparison.rows.push_back(std::move(*row));
    }
    states.options.tolerance = numberOf(document, "tolerance").value_or(states.options.tolerance);
    if (!(states.options.tolerance > 0 && states.options.tolerance <= 1e6))
        return badStates("its tolerance is out of range");
    comparison.isOnOneLattice = true;
    return {};
}

Result<volume::SemanticVolume> readState(const volume::ZipRanges& file, const char* name) {
    const volume::EntryPlace* entry = file.find(name);
    if (entry == nullptr) return badStates(fmt::format("the file lacks {}", name));
    SVT_TRY(bytes, file.unpacked(*entry, kMostStateBytes));
    return volume::readSvt(*bytes, name);
}

}  // namespace

Result<std::uint64_t> writeDifference(const volume::SemanticVolume& difference, const Compared& compared,
                                      const std::filesystem::path& path) {
    RowsJson document;
    document["tolerance"] = compared.options.tolerance;
    document["rows"] = RowsJson::array();
    for (const ComparisonRow& row : compared.comparison.rows) document["rows"].push_back(rowToJson(row));
    const std::string rows = document.dump();
    const auto bytesOf = [&](const volume::SemanticVolume& state) -> Result<std::vector<std::byte>> {
        if (compared.shift == Vec3d{}) return volume::svtBytes(state);
        SVT_TRY(moved, translated(state, -compared.shift));
        return volume::svtBytes(*moved);
    };
    SVT_TRY(before, bytesOf(compared.was));
    SVT_TRY(after, bytesOf(compared.is));
    SVT_TRY(file, volume::svtBytes(difference));
    const auto* const text = reinterpret_cast<const std::byte*>(rows.data());
    const std::vector<volume::NewEntry> entries{
        {kRowsEntry, {std::span(text, rows.size())}, true}, {kWasEntry, {*before}, false}, {kIsEntry, {*after}, false}};
    return volume::writeWithEntries(
        *file, path, [](std::string_view) { return true; }, entries);
}

Result<std::optional<ComparedStates>> readStates(const std::filesystem::path& path) {
    SVT_TRY(file, volume::ZipRanges::open(path));
    const volume::EntryPlace* rows = file->find(kRowsEntry);
    if (rows == nullptr) return std::optional<ComparedStates>{};
    ComparedStates states;
    SVT_TRY(was, readState(*file, kWasEntry));
    states.was = std::move(*was);
    SVT_TRY(is, readState(*file, kIsEntry));
    states.is = std::move(*is);
    SVT_TRY(text, file->unpacked(*rows, kMostRowBytes));
    SVT_DO(readRows({reinterpret_cast<const char*>(text->data()), text->size()}, states));
    return std::optional(std::move(states));
}

}  // namespace svt::compare
