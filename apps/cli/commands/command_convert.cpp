#include <apps/cli/cli.hpp>

#include <svt/volume/svt_file.hpp>
#include <svt/writers/glb_writer.hpp>
#include <svt/writers/nrrd_writer.hpp>

#include <fmt/format.h>

namespace svt::cli {
namespace {

struct Arguments {
    std::filesystem::path input, output;
    std::string encoding = "gzip", faces = "planes";
    BuildArguments build;
};

int runConvert(const Arguments& arguments) {
    const std::string extension = arguments.output.extension().string();
    if (extension != ".nrrd" && extension != ".glb")
        return fail(Error(Code::BadArgument, fmt::format("'{}': cannot write '{}'; possible are .nrrd and .glb",
                                                         arguments.output.string(), extension)));
    Diagnostics diagnostics;
    const TerminalProgress progress;
    const auto volume = loadVolume(arguments.input, arguments.build, progress.get(), diagnostics);
    printDiagnostics(diagnostics, false);
    if (!volume) return fail(volume.error());
    if (extension == ".glb") {
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

Run addConvertCommand(CLI::App& app) {
    auto arguments = std::make_shared<Arguments>();
    CLI::App* command = app.add_subcommand("convert", "Write a volume in another format");
    command->add_option("input", arguments->input, "a .svt or a model file")->required();
    command->add_option("output", arguments->output, "file to write; the extension tells the format: .nrrd or .glb")
        ->required();
    command->add_option("--encoding", arguments->encoding, "NRRD samples: gzip or raw")
        ->check(CLI::IsMember({"gzip", "raw"}))
        ->capture_default_str();
    command
        ->add_option("--faces", arguments->faces,
                     "slopes of a .glb: planes (flat, as far as the volume knows them) or voxels (stairs)")
        ->check(CLI::IsMember({"planes", "voxels"}))
        ->capture_default_str();
    arguments->build.addTo(*command);
    return [arguments] { return runConvert(*arguments); };
}

}  // namespace svt::cli
