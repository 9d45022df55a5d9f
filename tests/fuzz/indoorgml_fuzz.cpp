// For any bytes the reader returns a model whose indices are in range, or an error.
#include "check_model.hpp"

#include <svt/readers/indoorgml/indoorgml_reader.hpp>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    svt::readers::ReadOptions options;
    options.maxBytes = 1 << 20;
    options.threads = 1;
    svt::Diagnostics diagnostics;
    const std::span bytes(reinterpret_cast<const std::byte*>(data), size);
    const auto model = svt::readers::readIndoorGml(bytes, "fuzz.gml", options, &diagnostics);
    if (!model) return 0;
    svt::fuzz::checkModel(*model);
    svt::fuzz::checkIds(*model);
    return 0;
}
