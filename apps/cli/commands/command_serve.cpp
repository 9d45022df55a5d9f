#include <apps/cli/commands/commands.hpp>
#include <apps/cli/commands/serve_arguments.hpp>

namespace svt::cli {

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
