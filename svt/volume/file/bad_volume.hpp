#pragma once
/// \file
/// The error of all functions that read a `.svt`.

#include <svt/core/error.hpp>

#include <string>
#include <utility>

namespace svt::volume {

[[nodiscard]] inline Error badVolume(std::string message) { return Error(Code::BadVolume, std::move(message)); }

}  // namespace svt::volume
