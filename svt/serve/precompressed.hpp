#pragma once
/// \file
/// Compressed copies of files, for web servers that can send them in place of the files.

#include <svt/serve/site.hpp>

namespace svt::serve {

/// Adds copies of each module, script and style sheet of the site beside it: `x.wasm.gz`, and `x.wasm.br` if the machine
/// has the library libbrotlienc.so.1. A copy that saves little is left out. Cost: 1 s per 10 MB of files and core.
/// \return false if copies by Brotli are missing because the machine lacks the library
[[nodiscard]] bool addCompressedCopies(Site& site);

}  // namespace svt::serve
