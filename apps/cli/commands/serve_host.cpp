#include <apps/cli/commands/serve_arguments.hpp>
#include <apps/cli/output/json_output.hpp>
#include <apps/cli/output/messages.hpp>

#include <svt/core/file.hpp>
#include <svt/core/text.hpp>
#include <svt/serve/convert_call.hpp>
#include <svt/serve/host.hpp>

#include <fmt/format.h>

#include <csignal>

namespace svt::cli {
namespace {

serve::HttpServer* signalTarget = nullptr;

void onSignal(int) {
    if (signalTarget != nullptr) signalTarget->stop();
}

std::string addressOf(const std::string& host, int port) {
    const bool isAny = host == "0.0.0.0" || host == "::";
    const std::string name = isAny ? "127.0.0.1" : host.find(':') != std::string::npos ? "[" + host + "]" : host;
    return fmt::format("http://{}:{}/", name, port);
}

serve::ServerOptions serverOptions(const ServeArguments& arguments, const PrivateFolder& folder) {
    serve::ServerOptions options;
    options.host = arguments.host;
    options.port = arguments.wantedPort();
    options.mayTakeOtherPort = !arguments.port;
    options.bodyFolder = folder.path();
    options.hostNames = arguments.hostNames;
    options.hostNames.push_back(arguments.host);
    if (const std::string name = serve::machineName(); !serve::isLoopback(arguments.host) && !name.empty())
        options.hostNames.push_back(name);
    for (std::string& known : options.hostNames) known = lowerAscii(known);
    return options;
}

serve::ConvertOptions convertOptions(const ServeArguments& arguments) {
    constexpr std::uint64_t kMb = std::uint64_t{1} << 20;
    serve::ConvertOptions options;
    options.command = {"/proc/self/exe", "build"};
    options.options = {"--vectors", "edges", "--no-config"};
    options.maxUploadBytes = arguments.maxUploadMb * kMb;
    options.limits.memoryBytes = arguments.convertMemoryMb * kMb;
    options.limits.seconds = arguments.convertSeconds;
    return options;
}

// The functions of this server besides files. A published folder has no such resource.
std::string abilities(const ServeArguments& arguments) {
    Json json;
    json["picture"] = true;
    json["convert"] = arguments.allowUploads;
    if (arguments.allowUploads) json["maxUploadBytes"] = arguments.maxUploadMb << 20;
    return json.dump() + "\n";
}

void announce(const ServeArguments& arguments, const serve::ServerOptions& options, int port) {
    if (options.port != 0 && port != options.port)
        note(fmt::format("port {} is in use; this is port {}", options.port, port));
    if (!serve::isLoopback(arguments.host))
        note(fmt::format(
            "warning: everyone with access to this machine at {} can see these models{}; the server has no password "
            "and no encryption",
            arguments.host, arguments.allowUploads ? " and can send files to be converted" : ""));
    const std::string address = addressOf(arguments.host, port);
    fmt::print("{}\n", address);
    std::fflush(stdout);
    if (arguments.isView && !arguments.noBrowser && !serve::openBrowser(address))
        note("no browser could be started; open the address yourself");
    note("Ctrl-C stops");
}

Result<void> allowImages(const std::vector<std::string>& addresses, serve::Site& site) {
    for (const std::string& address : addresses) {
        const std::string origin = serve::originOf(address);
        if (origin.empty())
            return Error(Code::BadArgument, fmt::format("--allow-images {}: expected the address of a site, such as "
                                                        "https://tile.example.org",
                                                        address));
        site.allowOrigin(origin);
    }
    return {};
}

}  // namespace

Result<int> runServe(const ServeArguments& arguments) {
    if (arguments.inputs.empty() && !arguments.allowUploads)
        return Error(Code::BadArgument, "nothing to show; give a .svt, a model file or a city, or --allow-uploads");
    SVT_TRY(viewer, arguments.site.viewerFolder());
    SVT_TRY(models, arguments.site.load(arguments.inputs));
    SVT_TRY(site, serve::viewerSite(*viewer, *models));
    SVT_DO(allowImages(arguments.imageSites, *site));
    site->add("/api", serve::Bytes::of(abilities(arguments)));

    const PrivateFolder folder;
    std::vector<serve::Route> routes{pictureRoute(*models, arguments.site.build.threads)};
    if (arguments.allowUploads) routes.push_back(serve::convertRoute(convertOptions(arguments)));
    const serve::ServerOptions options = serverOptions(arguments, folder);
    SVT_TRY(server, serve::HttpServer::listen(std::move(*site), std::move(routes), options));
    signalTarget = &*server;
    auto* const formerInterrupt = std::signal(SIGINT, onSignal);
    auto* const formerTerm = std::signal(SIGTERM, onSignal);
    announce(arguments, options, server->port());
    server->run();
    std::signal(SIGINT, formerInterrupt);
    std::signal(SIGTERM, formerTerm);
    signalTarget = nullptr;
    return kDone;
}

}  // namespace svt::cli
