// serve and view where the program runs under Node.js: the site is written into a temporary folder, which Node.js serves
// when main() has returned (web/npm/lib/server.mjs). Models are drawn by the page alone, and none are converted.
#include <apps/cli/commands/commands.hpp>
#include <apps/cli/options/site_options.hpp>
#include <apps/cli/output/json_output.hpp>
#include <apps/cli/output/messages.hpp>

#include <svt/core/file.hpp>
#include <svt/core/text.hpp>

#include <emscripten.h>

// clang-format off
EM_JS(void, svtHostServe, (const char* orders), { Module["host"]["serve"](JSON.parse(UTF8ToString(orders))); })
// clang-format on

namespace svt::cli {
namespace {

struct ServeArguments {
    std::vector<std::filesystem::path> inputs;
    SiteArguments site;
    std::string host = "127.0.0.1";
    std::optional<int> port;
    std::vector<std::string> hostNames;
    bool allowUploads = false;
    std::uint64_t maxUploadMb = 0, convertMemoryMb = 0;
    double convertSeconds = 0;
    bool isView = false, noBrowser = false;
};

int runServe(const ServeArguments& arguments) {
    if (arguments.allowUploads)
        return fail(
            Error(Code::BadArgument, "--allow-uploads is not possible under Node.js; use the program for Linux"));
    if (arguments.inputs.empty()) return fail(Error(Code::BadArgument, "nothing to show; give a .svt or a model file"));
    const auto viewer = arguments.site.viewerFolder();
    if (!viewer) return fail(viewer.error());
    const auto models = arguments.site.load(arguments.inputs);
    if (!models) return fail(models.error());
    const auto site = serve::viewerSite(*viewer, *models);
    if (!site) return fail(site.error());

    // Outlives main(); Node.js removes it when the server stops.
    static const PrivateFolder folder;
    if (folder.path().empty())
        return fail(Error(Code::CannotWrite, "there is no folder for temporary files; set TMPDIR to one"));
    if (const auto written = serve::writeSite(*site, folder.path(), true); !written) return fail(written.error());
    constexpr int kUsualPort = 8080;
    Json orders;
    orders["folder"] = folder.path().string();
    orders["host"] = arguments.host;
    orders["port"] = arguments.port.value_or(arguments.isView ? 0 : kUsualPort);
    orders["mayTakeOtherPort"] = !arguments.port;
    orders["hostNames"] = arguments.hostNames;
    orders["opensBrowser"] = arguments.isView && !arguments.noBrowser;
    svtHostServe(orders.dump().c_str());
    return kDone;
}

}  // namespace

Action connectServe(Command& command) {
    auto arguments = std::make_shared<ServeArguments>();
    command.set("input", arguments->inputs);
    command.set("--port", arguments->port);
    command.set("--host", arguments->host);
    command.set("--allow-host", arguments->hostNames);
    command.set("--allow-uploads", arguments->allowUploads);
    command.set("--max-upload", arguments->maxUploadMb);
    command.set("--convert-memory", arguments->convertMemoryMb);
    command.set("--convert-seconds", arguments->convertSeconds);
    arguments->site.connect(command);
    return [arguments] { return runServe(*arguments); };
}

Action connectView(Command& command) {
    auto arguments = std::make_shared<ServeArguments>();
    arguments->isView = true;
    command.set("input", arguments->inputs);
    command.set("--no-browser", arguments->noBrowser);
    arguments->site.connect(command);
    return [arguments] { return runServe(*arguments); };
}

}  // namespace svt::cli
