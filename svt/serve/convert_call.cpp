#include <svt/serve/convert_call.hpp>

#include <svt/core/text.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <system_error>

namespace svt::serve {
namespace {

namespace fs = std::filesystem;

// Name of the model's file for messages; safe for any client input.
std::string fileName(std::string_view wanted) {
    constexpr std::size_t kMaxLength = 100;
    std::string name;
    for (const char c : wanted.substr(0, kMaxLength)) {
        const bool isKept = isLetter(c) || isDigit(c) || c == '.' || c == '_' || c == '-';
        name += isKept ? c : '_';
    }
    name.erase(0, std::min(name.find_first_not_of(".-"), name.size()));
    return name.empty() ? "model" : name;
}

// Parses the last line of the form `svt: error E102 BadXml: message` or `svt: error: message`.
Reply refusalOf(std::string_view messages) {
    constexpr std::string_view kStart = "svt: error";
    const std::size_t at = messages.rfind(kStart);
    if (at == std::string_view::npos)
        return Reply::error(422, codeTag(Code::InputTooBig),
                            "the conversion needs more memory than this server allows; choose a smaller model");
    std::string_view line = messages.substr(at + kStart.size());
    line = line.substr(0, line.find('\n'));
    const std::size_t colon = std::min(line.find(": "), line.size());
    const std::string_view code = line.substr(0, colon), message = line.substr(std::min(line.size(), colon + 2));
    if (code.substr(0, 2) != " E") return Reply::error(422, codeTag(Code::InputTooBig), message);
    return Reply::error(422, code.substr(1, code.find(' ', 1) - 1), message);
}

Reply replyTo(const ChildResult& result, const ChildLimits& limits, const fs::path& volume) {
    if (result.cannotStart) return Reply::error(500, codeTag(Code::Internal), "the conversion cannot be started");
    if (result.isTimeout)
        return Reply::error(
            422, codeTag(Code::InputTooBig),
            fmt::format("the conversion took longer than {:g} s; choose a smaller model", limits.seconds));
    if (result.signal != 0)
        return Reply::error(
            422, codeTag(Code::InputTooBig),
            fmt::format("the conversion was ended by signal {}; it may need more memory than the {} MB that this "
                        "server allows",
                        result.signal, limits.memoryBytes >> 20));
    if (result.exitCode != 0) return refusalOf(result.messages);
    auto file = FileBytes::read(volume);
    if (!file) return Reply::error(500, codeTag(file.error().code()), "the conversion left no volume");
    Reply reply;
    reply.type = "application/vnd.svt+zip";
    reply.body = Bytes::of(std::move(*file));
    reply.headers = {{"Cache-Control", "no-store"}};
    return reply;
}

Reply convert(const ConvertOptions& options, const Request& request, const Progress& stop) {
    const PrivateFolder folder;
    const std::string name = fileName(request.parameter("name"));
    std::error_code error;
    fs::rename(request.bodyFile, folder.path() / name, error);
    if (folder.path().empty() || error)
        return Reply::error(503, codeTag(Code::DiskFull), "no space is left for the model");
    std::vector<std::string> arguments = options.command;
    // No model has such a name, because fileName() removes leading dots.
    const std::string volume = ".volume.svt";
    arguments.insert(arguments.end(), {name, "-o", volume});
    arguments.insert(arguments.end(), options.options.begin(), options.options.end());
    return replyTo(runChild(arguments, folder.path(), options.limits, stop), options.limits, folder.path() / volume);
}

}  // namespace

Route convertRoute(ConvertOptions options) {
    Route route;
    route.path = "/api/convert";
    route.maxBodyBytes = options.maxUploadBytes;
    route.queueLength = 2;
    route.isBodyInFile = true;
    route.handle = [options = std::move(options)](const Request& request, const Progress& stop) {
        return convert(options, request, stop);
    };
    return route;
}

}  // namespace svt::serve
