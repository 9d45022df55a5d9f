// For any bytes the reader returns a model whose indices are in range, or an error. Half of the inputs are made by a mutator
// that knows records and references.
#include "check_model.hpp"
#include "ifc_mutator.hpp"

#include <svt/readers/ifc/ifc_reader.hpp>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <random>
#include <string>

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t maxSize);

// Half of the inputs come from the mutator of libFuzzer, with its dictionary.
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t maxSize,
                                               unsigned seed) {
    std::minstd_rand random(seed);
    if (random() % 2 == 0) return LLVMFuzzerMutate(data, size, maxSize);
    const std::string text = svt::fuzz::mutatedIfc({reinterpret_cast<const char*>(data), size}, random);
    if (text.empty() || text.size() > maxSize) return LLVMFuzzerMutate(data, size, maxSize);
    std::memcpy(data, text.data(), text.size());
    return text.size();
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::span bytes(reinterpret_cast<const std::byte*>(data), size);
    (void)svt::readers::looksLikeIfc(bytes);
    svt::readers::ReadOptions options;
    options.threads = 1;
    options.splitLayers = true;
    svt::Diagnostics diagnostics;
    const auto model = svt::readers::readIfc(bytes, "fuzz", options, &diagnostics);
    if (!model) return 0;
    svt::fuzz::checkModel(*model);
    svt::fuzz::checkIds(*model);
    return 0;
}
