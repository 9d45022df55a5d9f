#include <apps/cli/options/site_options.hpp>

#include <fmt/format.h>

namespace svt::cli {
namespace {

struct Arguments {
    std::vector<std::filesystem::path> inputs;
    std::filesystem::path output;
    SiteArguments site;
    bool mayReplace = false;
};

int runPublish(const Arguments& arguments) {
    const auto viewer = arguments.site.viewerFolder();
    if (!viewer) return fail(viewer.error());
    const auto models = arguments.site.load(arguments.inputs);
    if (!models) return fail(models.error());
    const auto site = serve::viewerSite(*viewer, *models);
    if (!site) return fail(site.error());
    const auto bytes = serve::writeSite(*site, arguments.output, arguments.mayReplace);
    if (!bytes) return fail(bytes.error());
    fmt::print("{}: {} files, {:.1f} kB; any web server shows it\n", arguments.output.string(),
               site->resources().size(), double(*bytes) / 1000);
    return kDone;
}

}  // namespace

Run addPublishCommand(CLI::App& app) {
    auto arguments = std::make_shared<Arguments>();
    CLI::App* command = app.add_subcommand("publish", "Write the viewer with models as a folder for any web server");
    command->add_option("input", arguments->inputs, "what the page opens: .svt or model files")->required();
    command->add_option("-o,--output", arguments->output, "the folder to write")->required()->type_name("DIR");
    command->add_flag("--force", arguments->mayReplace,
                      "write into a folder that is not empty; what is not of the page stays");
    arguments->site.addTo(*command);
    return [arguments] { return runPublish(*arguments); };
}

}  // namespace svt::cli
