// Interface for JavaScript: one function that takes the name of a call, its arguments as a JSON array, and bytes. It
// stores a reply, JSON or bytes, that must be read before the next call.
#include "calls.hpp"

#include <emscripten.h>
#include <nlohmann/json.hpp>

#include <new>
#include <string>
#include <utility>

// Reports progress to the page during a call.
EM_JS(void, svt_progress, (const char* stage, int size, double done), {
    if (Module["onProgress"]) Module["onProgress"](UTF8ToString(stage, size), done);
});

namespace svt::web {
namespace {

Reply lastReply;

Result<Reply> runGuarded(std::string_view name, std::string_view text, std::span<const std::byte> bytes) {
    try {
        const Json values = Json::parse(text, nullptr, false);
        if (!values.is_array()) return Error(Code::BadArgument, "the arguments of a call are a JSON array");
        return runCall(name, Arguments(values, bytes));
    } catch (const std::bad_alloc&) {
        return Error(Code::InputTooBig,
                     "this needs more than the 2 GB of memory that a page has; build the volume with a coarser spacing "
                     "with the command, or draw a smaller picture");
    } catch (const std::exception& defect) {
        return Error(Code::Internal, defect.what());
    }
}

// EngineError
std::string errorOf(const Error& error) {
    const std::string place = error.where().toString();
    const Json fields{{"code", codeTag(error.code())},
                      {"message", place.empty() ? error.message() : place + ": " + error.message()}};
    return fields.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

Error unknownCall(std::string_view name) {
    return {Code::BadArgument, "this module lacks the call '" + std::string(name) + "'"};
}

Progress progressOfPage() {
    return {.report = [](std::string_view stage, double done) {
        svt_progress(stage.data(), static_cast<int>(stage.size()), done);
    }};
}

}  // namespace svt::web

extern "C" {

/// Runs a call. \return 0: the reply is the result; 1: it is an EngineError
EMSCRIPTEN_KEEPALIVE int svt_call(const char* name, const char* json, const void* bytes, std::size_t size) {
    using namespace svt::web;
    lastReply = {};
    auto reply = runGuarded(name, json, std::span(static_cast<const std::byte*>(bytes), size));
    lastReply = reply ? std::move(*reply) : Reply(errorOf(reply.error()));
    return reply ? 0 : 1;
}

/// The reply to the last call; valid until the next.
EMSCRIPTEN_KEEPALIVE const void* svt_reply() { return svt::web::lastReply.bytes.data(); }
EMSCRIPTEN_KEEPALIVE std::size_t svt_reply_size() { return svt::web::lastReply.bytes.size(); }
}
