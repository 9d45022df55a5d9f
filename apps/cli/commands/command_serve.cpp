#include <apps/cli/commands/serve_arguments.hpp>
#include <apps/cli/options/catalog.hpp>
#include <apps/cli/options/shared_options.hpp>

namespace svt::cli {

Members<ServeArguments> membersOf(const ServeArguments*) noexcept {
    using All = ServeArguments;
    static constexpr Member<All> kMembers[] = {
        member<&All::inputs>("input", "inputs of the page: .svt, model files, or cities: their folders or addresses",
                             {.value = "FILE", .file = FileUse::ModelOrVolume}),
        member<&All::port>("--port", "port to listen on; 0: any free port",
                           {.least = 0, .most = 65535, .otherwise = "8080, or the next free one", .group = "Server"}),
        member<&All::host>(
            "--host", "address to listen on; other than 127.0.0.1, it gives other machines access without a password",
            {.value = "ADDRESS", .group = "Server"}),
        member<&All::hostNames>("--allow-host", "a further host name that browsers may use for this server",
                                {.value = "NAME", .group = "Server"}),
        member<&All::imageSites>("--allow-images",
                                 "a site from which the page may fetch pictures of the ground, such as "
                                 "https://tile.example.org",
                                 {.value = "ADDRESS", .group = "Server"}),
        member<&All::allowUploads>("--allow-uploads", "convert models that the page sends", {.group = "Uploads"}),
        member<&All::maxUploadMb>("--max-upload", "maximum size of an uploaded model",
                                  {.unit = "MB", .least = 1, .most = 1048576, .group = "Uploads"}),
        member<&All::convertMemoryMb>("--convert-memory", "memory limit of a conversion",
                                      {.unit = "MB", .least = 64, .most = 1048576, .group = "Uploads"}),
        member<&All::convertSeconds>("--convert-seconds", "time limit of a conversion",
                                     {.unit = "seconds", .least = 0.1, .most = 86400, .group = "Uploads"}),
        quietOption<All>(),
        part<&All::site>("site"),
    };
    return kMembers;
}

namespace {

struct ViewArguments {
    ServeArguments serve;

    ViewArguments() { serve.isView = true; }
};

Members<ViewArguments> membersOf(const ViewArguments*) noexcept {
    using All = ViewArguments;
    static constexpr Member<All> kMembers[] = {
        siteInputs<&All::serve, &ServeArguments::inputs>(),
        member<&All::serve, &ServeArguments::noBrowser>("--no-browser", "print the address without starting a browser",
                                                        {.group = "Page"}),
        quietOption<All>(),
        part<&All::serve, &ServeArguments::site>("site"),
    };
    return kMembers;
}

Result<int> runView(const ViewArguments& arguments) { return runServe(arguments.serve); }

}  // namespace

extern const CommandText kServeCommand =
    commandOf<ServeArguments, runServe>("serve", "Show models in the browser, from this machine");
extern const CommandText kViewCommand = commandOf<ViewArguments, runView>("view", "Open models in the browser");

}  // namespace svt::cli
