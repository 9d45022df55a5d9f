#pragma once
/// \file
/// The HTTP call that converts a model to a volume: POST with the model as body, `?name=house.gml`. Another program
/// does the conversion under resource limits, because models from clients are untrusted.

#include <svt/serve/child_process.hpp>
#include <svt/serve/http_server.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace svt::serve {

struct ConvertOptions {
    /// Program and first arguments; followed by the model's file, `-o`, the volume's file and `options`.
    std::vector<std::string> command;
    std::vector<std::string> options;
    std::uint64_t maxUploadBytes = std::uint64_t{200} << 20;
    ChildLimits limits;
};

/// Converts one model at a time; the queue length is two. The reply is the `.svt`; or {code, message} with status 422
/// if the program rejects the model or exceeds a limit (E104); the message is its last `svt: error E...` line.
/// Needs ServerOptions::bodyFolder.
[[nodiscard]] Route convertRoute(ConvertOptions options);

}  // namespace svt::serve
