// Measures the objects of a model: files in; rows, sums, and the files of `svt quantities` out.
#include "reports.hpp"

#include <svt/frontend/measure_take_off.hpp>
#include <svt/frontend/take_off.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <utility>

namespace svt::web {
namespace {

using frontend::TakeOff;

// A model and its last take-off, which refers to it.
struct Measuring {
    volume::SemanticVolume volume;
    frontend::TakeOffQuestion question;
    std::optional<TakeOff> takeOff;
};
std::unique_ptr<Measuring> measuring;

std::string textOf(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

std::string member(const Json& given, const char* name) {
    return given.is_object() ? given.value(name, std::string()) : std::string();
}

Json cellJson(const writers::Cell& cell) {
    if (const auto* text = std::get_if<std::string>(&cell.value)) return *text;
    if (const auto* number = std::get_if<double>(&cell.value)) return *number;
    if (const auto* whole = std::get_if<std::int64_t>(&cell.value)) return *whole;
    return {};
}

// {columns: names, rows: arrays of cells}; null: unknown.
Json tableJson(const writers::Table& table) {
    Json columns = Json::array(), rows = Json::array();
    for (const writers::Column& column : table.columns) columns.push_back(column.name);
    for (const writers::Row& row : table.rows) {
        Json& cells = rows.emplace_back(Json::array());
        for (const writers::Cell& cell : row) cells.push_back(cellJson(cell));
    }
    return {{"columns", std::move(columns)}, {"rows", std::move(rows)}};
}

// (names, sizes, {memory}) and the concatenated bytes of all files -> {spacing, reason, hasMeshes, findings}
Result<Reply> readModel(const Arguments& arguments) {
    measuring.reset();
    std::size_t at = 0;
    SVT_TRY(files, filesOf(arguments.at(0), arguments.at(1), arguments.bytes(), at));
    const Json& given = arguments.at(2);
    const double memory = given.is_object() ? given.value("memory", 0.0) : 0.0;
    const Progress progress = progressOfPage();
    Diagnostics findings;
    std::string reason;
    SVT_TRY(volume, readVolume(*files, static_cast<std::uint64_t>(std::max(0.0, memory)), nullptr, progress, findings,
                               &reason));
    measuring = std::make_unique<Measuring>();
    measuring->volume = std::move(*volume);
    const Vec3d spacing = measuring->volume.grid.spacing();
    return Reply(textOf({{"spacing", {spacing.x, spacing.y, spacing.z}},
                         {"reason", reason},
                         {"hasMeshes", !measuring->volume.vectors.triangles.empty()},
                         {"findings", findingsJson(findings)}}));
}

// ({where, exterior, formwork}) -> {columns, rows, total, notes, assumptions}. After an error, the last take-off stays.
Result<Reply> measure(const Arguments& arguments) {
    if (!measuring) return Error(Code::BadArgument, "no model is read; read one first");
    const Json& given = arguments.at(0);
    frontend::TakeOffQuestion question;
    question.where = member(given, "where");
    question.formwork = member(given, "formwork");
    question.exterior = given.is_object() && given.value("exterior", false);
    const Progress progress = progressOfPage();
    std::vector<std::string> notes;
    SVT_TRY(takeOff, frontend::measureTakeOff(measuring->volume, question, notes, &progress));
    measuring->question = question;
    Json reply = tableJson(frontend::takeOffTable(*takeOff, false));
    frontend::TakeOffTotals totals;
    totals.add(*takeOff);
    reply["total"] = totals.totalJson();
    reply["notes"] = notes;
    reply["assumptions"] = frontend::takeOffAssumptions(*takeOff);
    measuring->takeOff.emplace(std::move(*takeOff));
    return Reply(textOf(reply));
}

// The last take-off with the values of keys, separated by commas.
Result<const TakeOff*> takeOffBy(const std::string& keys) {
    if (!measuring || !measuring->takeOff)
        return Error(Code::BadArgument, "nothing is measured; measure a model first");
    if (measuring->question.by != keys) {
        measuring->question.by = keys;
        frontend::addTexts(measuring->question, *measuring->takeOff);
    }
    return static_cast<const TakeOff*>(&*measuring->takeOff);
}

// (keys) -> {columns, rows, members: numbers of the objects of each row, unknown: [{figure: objects without it}]}
Result<Reply> sums(const Arguments& arguments) {
    if (arguments.text(0).empty()) return Error(Code::BadArgument, "sums need a key");
    SVT_TRY(found, takeOffBy(arguments.text(0)));
    const TakeOff& takeOff = **found;
    frontend::TakeOffTotals totals;
    totals.add(takeOff);
    Json reply = tableJson(totals.sums(false));
    std::map<std::vector<std::string>, std::vector<std::size_t>> members;  // in the order of the rows
    for (std::size_t n = 0; n < takeOff.values.size(); ++n) members[takeOff.values[n]].push_back(n);
    Json& lists = reply["members"] = Json::array();
    for (const auto& entry : members) lists.push_back(entry.second);
    Json& unknown = reply["unknown"] = Json::array();
    for (const auto& sum : totals.sumsJson()) unknown.push_back(Json(sum.value("unknown", frontend::Json::object())));
    return Reply(textOf(reply));
}

// (keys; empty: the rows) -> the bytes that `svt quantities -o F.csv` writes
Result<Reply> csvFile(const Arguments& arguments) {
    SVT_TRY(takeOff, takeOffBy(arguments.text(0)));
    return Reply(writers::makeCsv(frontend::chosenTable(**takeOff, false, false)));
}

// (keys) -> the bytes that `svt quantities -o F.json` writes
Result<Reply> jsonFile(const Arguments& arguments) {
    SVT_TRY(takeOff, takeOffBy(arguments.text(0)));
    return Reply(frontend::takeOffFile(**takeOff, false));
}

constexpr Call kQuantityCalls[] = {{"readModel", readModel, false},
                                   {"measure", measure, false},
                                   {"sums", sums, false},
                                   {"quantitiesCsv", csvFile, false},
                                   {"quantitiesJson", jsonFile, false}};

}  // namespace

std::span<const Call> quantityCalls() noexcept { return kQuantityCalls; }

}  // namespace svt::web
