#include "whole.hpp"

namespace svt::web {

Result<BuiltVolume> buildModels(std::span<const NamedBytes>, const OpenOptions&, const Progress*, Diagnostics&) {
    return Error(Code::BadArgument, "this module reads no models; the whole module does");
}

illustrate::FaceMaker faceMaker() noexcept { return nullptr; }

std::span<const Call> wholeCalls() noexcept { return {}; }

std::span<const Call> fieldCalls() noexcept { return {}; }

}  // namespace svt::web
