#pragma once
/// \file
/// Answers of `svt doctor`: for each resource that the program needs or can use, its availability and a remedy.

#include <apps/cli/doctor/gl_probe.hpp>
#include <apps/cli/doctor/trial.hpp>
#include <apps/cli/output/json_output.hpp>

#include <svt/core/error.hpp>

#include <optional>
#include <string>

namespace svt::cli {

enum class State : std::uint8_t {
    Ok,
    Warning,  ///< something is missing; build and render work without it
    Error     ///< build or render do not work
};

struct Answer {
    std::string key;     ///< in JSON
    std::string title;   ///< in text
    std::string text{};  ///< one line: the facts, and the remedy for missing parts
    Json values = Json::object();
    State state = State::Ok;
    std::optional<Error> error{};  ///< of State::Error
};

/// "ok", "warning" or "error".
[[nodiscard]] std::string_view stateName(State state) noexcept;

[[nodiscard]] Answer programAnswer();
[[nodiscard]] Answer processorAnswer();
[[nodiscard]] Answer memoryAnswer();
[[nodiscard]] Answer graphicsAnswer(const GlProbe& probe);
[[nodiscard]] Answer viewerAnswer();
[[nodiscard]] Answer browserAnswer();
[[nodiscard]] Answer fontAnswer();
[[nodiscard]] Answer temporaryFolderAnswer();
[[nodiscard]] Answer currentFolderAnswer();
[[nodiscard]] Answer testVolumeAnswer(const Result<TestVolume>& built);
[[nodiscard]] Answer testPictureAnswer(const Result<TestPicture>& drawn);
/// Requires a probe with a context.
[[nodiscard]] Answer testOpenGlAnswer(const GlProbe& probe);

}  // namespace svt::cli
