#include <apps/cli/commands/commands.hpp>
#include <apps/cli/options/build_options.hpp>
#include <apps/cli/options/paper_scale.hpp>
#include <apps/cli/output/messages.hpp>
#include <apps/cli/output/output_files.hpp>
#include <apps/cli/output/terminal_progress.hpp>

#include <svt/core/file.hpp>
#include <svt/illustrate/sheet_views.hpp>
#include <svt/writers/sheet_writer.hpp>

#include <fmt/format.h>

#include <system_error>

namespace svt::cli {
namespace {

struct SheetsArguments {
    std::filesystem::path input, output, folder;
    std::string scale, paper, language;
    std::vector<std::string> hide;
    bool noAbove = false, noDimensions = false, noTables = false, verbose = false;
    BuildArguments build;
};

writers::SheetLanguage languageOf(const std::string& name) {
    return name == "de" ? writers::SheetLanguage::German : writers::SheetLanguage::English;
}

Result<writers::SheetContent> drawViews(const SheetsArguments& arguments, const volume::SemanticVolume& volume) {
    auto chosen = illustrate::chooseSheetViews(volume, arguments.build.threads);
    if (!chosen) return chosen.error();
    writers::SheetContent content;
    content.levels = std::move(chosen->levels);
    std::vector<std::string> nothing;
    for (illustrate::SheetView& view : chosen->views) {
        illustrate::SectionOptions options;
        options.hide = arguments.hide;
        options.smallestArea = 1e-4;
        options.threads = arguments.build.threads;
        options.beyond = view.beyond;
        if (arguments.noAbove) options.beyond.above = false;
        options.dimensions = view.kind == illustrate::ViewKind::Plan && !arguments.noDimensions;
        if (content.views.empty()) options.nothing = &nothing;
        auto drawing = illustrate::drawSection(volume, view.plane, options);
        if (!drawing) return drawing.error();
        content.views.push_back({std::move(view), std::move(*drawing)});
    }
    if (!arguments.noTables) {
        const auto areas = illustrate::measureFloorAreas(volume, content.levels, arguments.build.threads);
        if (!areas) return areas.error();
        content.tables = writers::makeAreaTables(*areas, content.levels, languageOf(arguments.language));
    }
    for (const std::string& message : nothing) note(message);
    return content;
}

Result<void> writeSvgFolder(const std::vector<std::string>& sheets, const std::filesystem::path& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error) return Error(Code::CannotWrite, fmt::format("{}: {}", folder.string(), error.message()));
    for (std::size_t n = 0; n < sheets.size(); ++n)
        if (auto written = writeFileAtomically(folder / fmt::format("sheet-{}.svg", n + 1), sheets[n]); !written)
            return written.error();
    return {};
}

int runSheets(const SheetsArguments& arguments) {
    if (arguments.output.empty() && arguments.folder.empty())
        return fail(Error(Code::BadArgument, "nothing to write; give -o P.pdf or --svg DIR"));
    writers::SheetOptions options;
    options.paper = arguments.paper;
    options.language = languageOf(arguments.language);
    if (!arguments.scale.empty()) {
        const auto scale = parseScale(arguments.scale);
        if (!scale) return fail(scale.error());
        options.scale = *scale;
    }
    Diagnostics diagnostics;
    const TerminalProgress progress;
    BuildArguments build = arguments.build;
    build.vectors.meshes = true;
    const auto volume = loadVolume(arguments.input, build, progress.get(), diagnostics);
    printDiagnostics(diagnostics, arguments.verbose);
    if (!volume) return fail(volume.error());
    Progress::tell(progress.get(), "sheets", 0);
    const auto content = drawViews(arguments, *volume);
    if (!content) return fail(content.error());
    if (content->views.front().drawing.lacksMeshes) {
        Diagnostics findings;
        illustrate::reportSection(content->views.front().drawing, *volume, findings);
        printDiagnostics(findings, true);
    }
    const auto sheets = writers::makeSvgSheets(*content, *volume, options);
    if (!sheets) return fail(sheets.error());
    if (!arguments.output.empty()) {
        const auto pdf = writers::makePdfSheets(*content, *volume, options);
        if (!pdf) return fail(pdf.error());
        if (auto written = writeFileAtomically(arguments.output, *pdf); !written) return fail(written.error());
    }
    if (!arguments.folder.empty())
        if (auto written = writeSvgFolder(*sheets, arguments.folder); !written) return fail(written.error());
    TerminalProgress::hide();
    if (!isQuiet())
        fmt::print("{}: {} sheets with {} views\n",
                   (arguments.output.empty() ? arguments.folder : arguments.output).string(), sheets->size(),
                   content->views.size());
    return kDone;
}

}  // namespace

Action connectSheets(Command& command) {
    auto arguments = std::make_shared<SheetsArguments>();
    command.set("input", arguments->input);
    command.set("--output", arguments->output);
    command.set("--svg", arguments->folder);
    command.set("--scale", arguments->scale);
    command.set("--paper", arguments->paper);
    command.set("--hide", arguments->hide);
    command.set("--no-above", arguments->noAbove);
    command.set("--no-dimensions", arguments->noDimensions);
    command.set("--no-tables", arguments->noTables);
    command.set("--language", arguments->language);
    command.set("--verbose", arguments->verbose);
    arguments->build.connect(command);
    return [arguments] { return runSheets(*arguments); };
}

}  // namespace svt::cli
