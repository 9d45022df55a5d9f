#include <apps/cli/commands/serve_arguments.hpp>
#include <apps/cli/options/command_line.hpp>
#include <apps/cli/options/shared_options.hpp>

namespace svt::cli {

namespace {

constexpr Option kServe[] = {
    {.name = "input",
     .value = "FILE",
     .help = "what the page opens: .svt or model files",
     .mayRepeat = true,
     .file = FileUse::ModelOrVolume},
    {.name = "--port",
     .kind = Whole,
     .least = 0,
     .most = 65535,
     .otherwise = "8080, or the next free one",
     .help = "port to listen at; 0: any that is free",
     .group = "Server"},
    {.name = "--host",
     .value = "ADDRESS",
     .byDefault = "127.0.0.1",
     .help = "address to listen at; others than 127.0.0.1 let other machines in, without password",
     .group = "Server"},
    {.name = "--allow-host",
     .value = "NAME",
     .help = "a further name by which browsers may call this server",
     .group = "Server",
     .mayRepeat = true},
    {.name = "--allow-uploads", .kind = Flag, .help = "convert models that the page sends", .group = "Uploads"},
    {.name = "--max-upload",
     .kind = Whole,
     .unit = "MB",
     .least = 1,
     .most = 1048576,
     .byDefault = "200",
     .help = "largest model that may be sent",
     .group = "Uploads"},
    {.name = "--convert-memory",
     .kind = Whole,
     .unit = "MB",
     .least = 64,
     .most = 1048576,
     .byDefault = "2048",
     .help = "memory that a conversion may use",
     .group = "Uploads"},
    {.name = "--convert-seconds",
     .kind = Number,
     .unit = "seconds",
     .least = 0.1,
     .most = 86400,
     .byDefault = "120",
     .help = "time that a conversion may take",
     .group = "Uploads"},
};
constexpr Option kView[] = {
    kSiteInputs[0],
    {.name = "--no-browser", .kind = Flag, .help = "print the address, start no browser", .group = "Page"},
};

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

}  // namespace

extern const CommandText kServeCommand{.name = "serve",
                                       .help = "Show models in the browser, from this machine",
                                       .sets = {kServe, kQuiet, kPage, kGrid, kModel, kMemory, kStyle, kVoxels},
                                       .connect = connectServe};

extern const CommandText kViewCommand{.name = "view",
                                      .help = "Open models in the browser",
                                      .sets = {kView, kQuiet, kPage, kGrid, kModel, kMemory, kStyle, kVoxels},
                                      .connect = connectView};

}  // namespace svt::cli
