// serve and view under Node.js: the program writes the site into a temporary folder, which Node.js serves after main()
// has returned (web/npm/lib/server.mjs). Only the page draws models. The server does not convert models.
#include <apps/cli/commands/serve_arguments.hpp>
#include <apps/cli/output/json_output.hpp>
#include <apps/cli/output/messages.hpp>

#include <svt/core/file.hpp>
#include <svt/core/text.hpp>

#include <emscripten.h>

// clang-format off
EM_JS(void, svtHostServe, (const char* orders), { Module["host"]["serve"](JSON.parse(UTF8ToString(orders))); })
// clang-format on

namespace svt::cli {
Result<int> runServe(const ServeArguments& arguments) {
    if (arguments.allowUploads)
        return Error(Code::BadArgument, "--allow-uploads is not possible under Node.js; use the program for Linux");
    if (arguments.inputs.empty())
        return Error(Code::BadArgument, "nothing to show; give a .svt, a model file or a city");
    SVT_TRY(viewer, arguments.site.viewerFolder());
    SVT_TRY(models, arguments.site.load(arguments.inputs));
    SVT_TRY(site, serve::viewerSite(*viewer, *models));

    // Outlives main(); Node.js removes it when the server stops.
    static const PrivateFolder folder;
    if (folder.path().empty())
        return Error(Code::CannotWrite, "cannot create a folder for temporary files; set TMPDIR to a writable folder");
    SVT_DO(serve::writeSite(*site, folder.path()));
    Json orders;
    orders["folder"] = folder.path().string();
    orders["host"] = arguments.host;
    orders["port"] = arguments.wantedPort();
    orders["mayTakeOtherPort"] = !arguments.port;
    orders["hostNames"] = arguments.hostNames;
    orders["opensBrowser"] = arguments.isView && !arguments.noBrowser;
    svtHostServe(orders.dump().c_str());
    return kDone;
}

}  // namespace svt::cli
