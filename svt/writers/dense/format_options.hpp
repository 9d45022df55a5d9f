#pragma once
/// \file
/// What the dense formats of this folder have in common.

#include <svt/core/progress.hpp>
#include <svt/writers/volume_formats.hpp>

namespace svt::writers {

struct DenseOptions {
    bool isCompressed = true;            ///< zlib or gzip, whichever the format has; else the samples as they are
    int threads = 0;                     ///< maximum; 0: all cores. The bytes do not depend on it.
    const Progress* progress = nullptr;  ///< stage "write"
};

/// The options that all dense formats have.
[[nodiscard]] inline DenseOptions denseOptions(const VolumeWriteOptions& options) noexcept {
    return {options.isCompressed, options.threads, options.progress};
}

}  // namespace svt::writers
