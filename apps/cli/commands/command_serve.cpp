#include <apps/cli/options/site_options.hpp>
#include <apps/cli/output/json_output.hpp>

#include <svt/serve/child_process.hpp>
#include <svt/serve/convert_call.hpp>

#include <arpa/inet.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdlib>

namespace svt::cli {
namespace {

struct Arguments {
    std::vector<std::filesystem::path> inputs;
    SiteArguments site;
    std::string host = "127.0.0.1";
    std::optional<int> port;
    std::vector<std::string> hostNames;
    bool allowUploads = false;
    std::uint64_t maxUploadMb = 200, convertMemoryMb = 2048;
    double convertSeconds = 120;
    bool isView = false, noBrowser = false;
};

serve::HttpServer* signalTarget = nullptr;

void onSignal(int) {
    if (signalTarget != nullptr) signalTarget->stop();
}

bool isLoopback(const std::string& host) {
    constexpr std::uint32_t kLoopbackNet = 127;
    in_addr address{};
    const bool isAddress = ::inet_pton(AF_INET, host.c_str(), &address) == 1;
    return host == "localhost" || host == "::1" || (isAddress && ntohl(address.s_addr) >> 24 == kLoopbackNet);
}

std::string addressOf(const std::string& host, int port) {
    const bool isAny = host == "0.0.0.0" || host == "::";
    const std::string name = isAny ? "127.0.0.1" : host.find(':') != std::string::npos ? "[" + host + "]" : host;
    return fmt::format("http://{}:{}/", name, port);
}

serve::ServerOptions serverOptions(const Arguments& arguments, const serve::PrivateFolder& folder) {
    constexpr int kUsualPort = 8080;
    serve::ServerOptions options;
    options.host = arguments.host;
    options.port = arguments.port.value_or(arguments.isView ? 0 : kUsualPort);
    options.mayTakeOtherPort = !arguments.port;
    options.bodyFolder = folder.path();
    options.hostNames = arguments.hostNames;
    options.hostNames.push_back(arguments.host);
    std::array<char, 256> name{};
    if (!isLoopback(arguments.host) && ::gethostname(name.data(), name.size() - 1) == 0)
        options.hostNames.emplace_back(name.data());
    for (std::string& known : options.hostNames)
        for (char& c : known) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return options;
}

serve::ConvertOptions convertOptions(const Arguments& arguments) {
    constexpr std::uint64_t kMb = std::uint64_t{1} << 20;
    serve::ConvertOptions options;
    options.command = {"/proc/self/exe", "build"};
    options.options = {"--vectors", "edges"};
    options.maxUploadBytes = arguments.maxUploadMb * kMb;
    options.limits.memoryBytes = arguments.convertMemoryMb * kMb;
    options.limits.seconds = arguments.convertSeconds;
    return options;
}

// What this server offers besides files; a published folder has no such resource.
std::string abilities(const Arguments& arguments) {
    Json json;
    json["picture"] = true;
    json["convert"] = arguments.allowUploads;
    if (arguments.allowUploads) json["maxUploadBytes"] = arguments.maxUploadMb << 20;
    return json.dump() + "\n";
}

// \return true if a browser could be started
bool openBrowser(const std::string& address) {
    if (std::getenv("DISPLAY") == nullptr && std::getenv("WAYLAND_DISPLAY") == nullptr) return false;
    std::string program = "xdg-open", argument = address;
    std::array<char*, 3> arguments{program.data(), argument.data(), nullptr};
    posix_spawn_file_actions_t actions;
    ::posix_spawn_file_actions_init(&actions);
    ::posix_spawn_file_actions_addopen(&actions, 1, "/dev/null", O_WRONLY, 0);
    ::posix_spawn_file_actions_addopen(&actions, 2, "/dev/null", O_WRONLY, 0);
    pid_t child = 0;
    const int failed = ::posix_spawnp(&child, program.c_str(), &actions, nullptr, arguments.data(), environ);
    ::posix_spawn_file_actions_destroy(&actions);
    return failed == 0;
}

void announce(const Arguments& arguments, const serve::ServerOptions& options, int port) {
    if (options.port != 0 && port != options.port)
        fmt::print(stderr, "svt: port {} is taken; this is port {}\n", options.port, port);
    if (!isLoopback(arguments.host))
        fmt::print(
            stderr,
            "svt: warning: everybody who reaches this machine at {} sees these models{}; there is no password and "
            "no encryption\n",
            arguments.host, arguments.allowUploads ? " and may send files to be converted" : "");
    const std::string address = addressOf(arguments.host, port);
    fmt::print("{}\n", address);
    std::fflush(stdout);
    if (arguments.isView && !arguments.noBrowser && !openBrowser(address))
        fmt::print(stderr, "svt: no browser could be started; open the address yourself\n");
    fmt::print(stderr, "svt: Ctrl-C stops\n");
}

int runServe(const Arguments& arguments) {
    if (arguments.inputs.empty() && !arguments.allowUploads)
        return fail(Error(Code::BadArgument, "nothing to show; give a .svt or a model file, or --allow-uploads"));
    const auto viewer = arguments.site.viewerFolder();
    if (!viewer) return fail(viewer.error());
    const auto models = arguments.site.load(arguments.inputs);
    if (!models) return fail(models.error());
    auto site = serve::viewerSite(*viewer, *models);
    if (!site) return fail(site.error());
    site->add("/api", serve::Bytes::of(abilities(arguments)));

    const serve::PrivateFolder folder;
    std::vector<serve::Route> routes{pictureRoute(*models, arguments.site.build.threads)};
    if (arguments.allowUploads) routes.push_back(serve::convertRoute(convertOptions(arguments)));
    const serve::ServerOptions options = serverOptions(arguments, folder);
    auto server = serve::HttpServer::listen(std::move(*site), std::move(routes), options);
    if (!server) return fail(server.error());
    signalTarget = &*server;
    std::signal(SIGINT, onSignal);
    std::signal(SIGTERM, onSignal);
    announce(arguments, options, server->port());
    server->run();
    std::signal(SIGINT, SIG_DFL);
    std::signal(SIGTERM, SIG_DFL);
    signalTarget = nullptr;
    return kDone;
}

}  // namespace

Run addServeCommand(CLI::App& app) {
    auto arguments = std::make_shared<Arguments>();
    CLI::App* command = app.add_subcommand("serve", "Show models in the browser, from this machine");
    command->add_option("input", arguments->inputs, "what the page opens: .svt or model files");
    command
        ->add_option("--port", arguments->port,
                     "port to listen at; 0: any that is free; default: 8080, or the next free one")
        ->group("Server")
        ->check(CLI::Range(0, 65535));
    command
        ->add_option("--host", arguments->host,
                     "address to listen at; others than 127.0.0.1 let other machines in, without password")
        ->group("Server")
        ->type_name("ADDRESS")
        ->capture_default_str();
    command
        ->add_option("--allow-host", arguments->hostNames,
                     "a further name by which browsers may call this server; may be repeated")
        ->group("Server")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->type_name("NAME");
    command->add_flag("--allow-uploads", arguments->allowUploads, "convert models that the page sends")
        ->group("Uploads");
    command->add_option("--max-upload", arguments->maxUploadMb, "largest model that may be sent, MB")
        ->group("Uploads")
        ->check(CLI::Range(1, 1 << 20))
        ->capture_default_str();
    command->add_option("--convert-memory", arguments->convertMemoryMb, "memory that a conversion may use, MB")
        ->group("Uploads")
        ->check(CLI::Range(64, 1 << 20))
        ->capture_default_str();
    command->add_option("--convert-seconds", arguments->convertSeconds, "time that a conversion may take, seconds")
        ->group("Uploads")
        ->check(CLI::Range(0.1, 86400.0))
        ->capture_default_str();
    arguments->site.addTo(*command);
    return [arguments] { return runServe(*arguments); };
}

Run addViewCommand(CLI::App& app) {
    auto arguments = std::make_shared<Arguments>();
    arguments->isView = true;
    CLI::App* command = app.add_subcommand("view", "Open models in the browser");
    command->add_option("input", arguments->inputs, "what the page opens: .svt or model files")->required();
    command->add_flag("--no-browser", arguments->noBrowser, "print the address, start no browser")->group("Page");
    arguments->site.addTo(*command);
    return [arguments] { return runServe(*arguments); };
}

}  // namespace svt::cli
