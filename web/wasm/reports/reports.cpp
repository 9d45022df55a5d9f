// The module of reports is fetched only for one of them, and runs in a worker of its own.
#include "reports.hpp"

#include <svt/pipeline/build_volume.hpp>
#include <svt/readers/model_joiner.hpp>
#include <svt/volume/svt_file.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <utility>

namespace svt::web {
namespace {

// Notes on missing or assumed facts, which the commands print as well.
bool isAlwaysShown(Code code) {
    return code == Code::ProductsRead || code == Code::AxisOrder || code == Code::FeatureEnded;
}

}  // namespace

Result<Files> filesOf(const Json& names, const Json& sizes, std::span<const std::byte> bytes, std::size_t& at) {
    Files files;
    for (std::size_t n = 0; n < names.size(); ++n) {
        const auto size = sizes.at(n).get<std::size_t>();
        files.push_back({names.at(n).get<std::string>(), bytes.subspan(at, size)});
        at += size;
    }
    if (files.empty()) return Error(Code::BadArgument, "a state has no file");
    return files;
}

bool isVolume(const Files& files) {
    return std::any_of(files.begin(), files.end(),
                       [](const NamedBytes& file) { return volume::looksLikeSvt(file.bytes); });
}

Result<volume::SemanticVolume> readVolume(const Files& files, std::uint64_t memoryBytes, const volume::Grid* grid,
                                          const Progress& progress, Diagnostics& findings, std::string* spacing) {
    if (isVolume(files)) {
        if (files.size() > 1)
            return Error(Code::BadArgument, "a state is one volume (.svt), or one or several models; give one volume");
        return volume::readSvt(files.front().bytes, files.front().name);
    }
    readers::ReadOptions reading;
    reading.progress = &progress;
    SVT_TRY(model, readers::readModels(files, reading, &findings));
    pipeline::BuildOptions building;
    building.vectors.meshes = true;
    building.progress = &progress;
    if (memoryBytes != 0) building.memoryBytes = std::min(building.memoryBytes, memoryBytes);
    if (grid != nullptr) building.grid = *grid;
    building.extendsGrid = grid != nullptr;
    SVT_TRY(output, pipeline::buildVolume(*model, building, &findings));
    const auto& choice = output->report.spacing;
    if (spacing != nullptr && choice && choice->spacing != pipeline::SpacingChoice::kUsual) *spacing = choice->reason;
    return std::move(output->volume);
}

Json findingsJson(const Diagnostics& findings) {
    Json list = Json::array();
    for (const Diagnostic& finding : findings.items())
        if (finding.severity != Severity::Note || isAlwaysShown(finding.code)) list.push_back(finding.toString());
    return list;
}

Result<Reply> runCall(std::string_view name, const Arguments& arguments) {
    for (const std::span<const Call> calls : {comparisonCalls(), quantityCalls()})
        if (const Call* const call = findCall(calls, name)) return call->run(arguments);
    return unknownCall(name);
}

}  // namespace svt::web
