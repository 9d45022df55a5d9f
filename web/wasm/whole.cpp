#include "whole.hpp"

#include <svt/drawing/section_drawing.hpp>
#include <svt/drawing/section_plane.hpp>
#include <svt/pipeline/build_volume.hpp>
#include <svt/writers/draw_sheets.hpp>
#include <svt/writers/drawing_formats.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace svt::web {
namespace {

// Size of a draft, which is built immediately.
constexpr std::uint64_t kDraftBytes = 40'000'000;

Result<void> checkDrawn(const drawing::SectionDrawing& drawing, const std::string& plane) {
    if (!drawing.components.empty() || !drawing.beyond.empty()) return {};
    return Error(Code::BadSection, fmt::format("the plane '{}' cuts no visible feature; move it", plane));
}

// (plane, format, {beyond, above, dimensions}) -> the file's bytes
Result<Reply> drawing(const Arguments& arguments) {
    const volume::SemanticVolume& volume = openSession().volume();
    SVT_TRY(plane, drawing::parseSectionPlane(arguments.text(0), volume));
    const Json& wanted = arguments.at(2);
    drawing::SectionOptions options;
    options.smallestArea = drawing::kSliverArea;
    options.beyond.visible = wanted.is_object() && wanted.value("beyond", false);
    options.beyond.above = wanted.is_object() && wanted.value("above", false);
    options.dimensions = wanted.is_object() && wanted.value("dimensions", false);
    SVT_TRY(drawn, drawing::drawSection(volume, *plane, options));
    SVT_DO(checkDrawn(*drawn, arguments.text(0)));
    return replyOf(writers::makeDrawing(*drawn, volume, arguments.text(1)));
}

// (plane, format, maximum of bytes of the tiles) -> {needs}, or {text}: the file of a section of the city
Result<Reply> cityDrawing(const Arguments& arguments) {
    const Progress progress = progressOfPage();
    const auto most = static_cast<std::uint64_t>(std::max(0.0, arguments.number(2)));
    drawing::SectionOptions options;
    options.smallestArea = drawing::kSliverArea;
    const auto section = openCity().cut(arguments.text(0), options, most, &progress);
    const Json needs = neededBytes();
    if (!section) return needs.is_null() ? Result<Reply>(section.error()) : Reply(needs.dump());
    SVT_DO(checkDrawn(section->drawing, arguments.text(0)));
    SVT_TRY(text, writers::makeDrawing(section->drawing, section->volume, arguments.text(1)));
    return Reply(Json{{"text", *text}}.dump(-1, ' ', false, Json::error_handler_t::replace));
}

// ("en" or "de") -> the sheets of `svt sheets --svg`: SVG documents. Needs the font.
Result<Reply> sheets(const Arguments& arguments) {
    if (!hasFont()) return Error(Code::BadArgument, "sheets cannot be drawn without their font; give it first");
    const volume::SemanticVolume& volume = openSession().volume();
    drawing::SheetSet set;
    set.language = arguments.text(0);
    SVT_TRY(content, writers::drawSheets(set, volume));
    SVT_TRY(made, writers::makeSvgSheets(*content, volume, writers::sheetOptionsOf(set)));
    return Reply(Json(*made).dump());
}

}  // namespace

Result<BuiltVolume> buildModels(std::span<const NamedBytes> files, const OpenOptions& options, const Progress* progress,
                                Diagnostics& findings) {
    readers::ReadOptions reading;
    reading.progress = progress;
    SVT_TRY(model, readers::readModels(files, reading, &findings));
    pipeline::BuildOptions building;
    if (!options.isDraft) building.vectors = {.edges = true, .meshes = true, .isRequired = false};
    if (options.isDraft)
        building.memoryBytes = kDraftBytes;
    else if (options.memoryBytes != 0)
        building.memoryBytes = std::min(building.memoryBytes, options.memoryBytes);
    building.progress = progress;
    SVT_TRY(output, pipeline::buildVolume(*model, building, &findings));
    BuiltVolume built{std::move(output->volume), {}};
    if (output->report.spacing) built.spacingReason = output->report.spacing->reason;
    return built;
}

illustrate::FaceMaker faceMaker() noexcept { return illustrate::makeFaces; }

std::span<const Call> wholeCalls() noexcept {
    static constexpr Call kCalls[] = {{"drawing", drawing}, {"sheets", sheets}, {"cityDrawing", cityDrawing, false}};
    return kCalls;
}

}  // namespace svt::web
