#pragma once
/// \file
/// The call that turns a model into a volume: POST with the model as body, `?name=house.gml`. The work is done by
/// another program, under limits, since a model from a stranger may be anything.

#include <svt/serve/child_process.hpp>
#include <svt/serve/http_server.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace svt::serve {

struct ConvertOptions {
    /// Program and first arguments; behind them stand the model's file, `-o`, the volume's file and `options`.
    std::vector<std::string> command;
    std::vector<std::string> options;
    std::uint64_t maxUploadBytes = std::uint64_t{200} << 20;
    ChildLimits limits;
};

/// One model at a time, two more may wait. The reply is the `.svt`; or {code, message} with 422 where the program
/// refuses the model or is over a limit (E104), its message being what it last said as `svt: error E...`.
/// Needs ServerOptions::bodyFolder.
[[nodiscard]] Route convertRoute(ConvertOptions options);

}  // namespace svt::serve
