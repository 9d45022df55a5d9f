// For any bytes the reader returns a model whose indices are in range, or an error.
#include "check_model.hpp"

#include <svt/readers/cityjson/cityjson_reader.hpp>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::span bytes(reinterpret_cast<const std::byte*>(data), size);
    (void)svt::readers::looksLikeCityJson(bytes);
    svt::readers::ReadOptions options;
    options.threads = 1;
    svt::Diagnostics diagnostics;
    const auto model = svt::readers::readCityJson(bytes, "fuzz", options, &diagnostics);
    if (model) svt::fuzz::checkModel(*model);
    return 0;
}
