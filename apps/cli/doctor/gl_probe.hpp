#pragma once
/// \file
/// Tries OpenGL in a separate process, because drivers may crash or wait for a display forever.

#include <cstddef>
#include <string>

namespace svt::cli {

struct GlProbe {
    std::string contextFault;  ///< why there is no context; empty: there is one
    std::string renderer, version;
    bool isSoftware = false;
    std::string pictureFault;               ///< why there is no picture; empty: there is one
    double firstSeconds = 0, seconds = 0;   ///< see TestPicture
    std::size_t pixels = 0, differing = 0;  ///< in the picture; see differingPixels()
    std::string messages;                   ///< lines that the driver wrote to stderr
};

/// Makes a context, draws the test picture by OpenGL and on the CPU, and compares the two. Takes up to 10 seconds.
/// Requires that this process has not started threads, see inOwnProcess().
[[nodiscard]] GlProbe probeGl();

}  // namespace svt::cli
