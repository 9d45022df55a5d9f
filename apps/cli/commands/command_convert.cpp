#include <apps/cli/commands/commands.hpp>
#include <apps/cli/options/build_options.hpp>
#include <apps/cli/output/messages.hpp>
#include <apps/cli/output/output_files.hpp>
#include <apps/cli/output/terminal_progress.hpp>

#include <svt/volume/svt_file.hpp>
#include <svt/writers/glb_writer.hpp>
#include <svt/writers/nrrd_writer.hpp>

#include <fmt/format.h>

namespace svt::cli {
namespace {

struct ConvertArguments {
    std::filesystem::path input, output;
    std::string encoding, faces;
    BuildArguments build;
};

int runConvert(const ConvertArguments& arguments) {
    Diagnostics diagnostics;
    const TerminalProgress progress;
    const auto volume = loadVolume(arguments.input, arguments.build, progress.get(), diagnostics);
    printDiagnostics(diagnostics, false);
    if (!volume) return fail(volume.error());
    Progress::tell(progress.get(), "write", 0);
    if (endingOf(arguments.output) == ".glb") {
        writers::GlbOptions options;
        options.faces = arguments.faces == "voxels" ? writers::GlbFaces::Voxels : writers::GlbFaces::Planes;
        options.threads = arguments.build.threads;
        options.progress = progress.get();
        const auto report = writers::writeGlb(*volume, arguments.output, options);
        return report ? static_cast<int>(kDone) : fail(report.error());
    }
    writers::NrrdOptions options;
    options.encoding = arguments.encoding == "raw" ? writers::NrrdEncoding::Raw : writers::NrrdEncoding::Gzip;
    options.threads = arguments.build.threads;
    options.progress = progress.get();
    const auto bytes = writers::writeNrrd(*volume, arguments.output, options);
    if (!bytes) return fail(bytes.error());
    return kDone;
}

}  // namespace

Action connectConvert(Command& command) {
    auto arguments = std::make_shared<ConvertArguments>();
    command.set("input", arguments->input);
    command.set("output", arguments->output);
    command.set("--encoding", arguments->encoding);
    command.set("--faces", arguments->faces);
    arguments->build.connect(command);
    return [arguments] { return runConvert(*arguments); };
}

}  // namespace svt::cli
