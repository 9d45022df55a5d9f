#include <svt/core/machine.hpp>
#include <svt/core/parallel.hpp>
#include <svt/serve/precompressed.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace svt::serve {
namespace {

// BrotliEncoderCompress() of brotli/encode.h, whose interface is the same in all versions 1.x.
using BrotliCompress = int(int quality, int windowBits, int mode, std::size_t size, const std::uint8_t* bytes,
                           std::size_t* packedSize, std::uint8_t* packed);
// Level 11 saves 11 % more and takes 12 times as long.
constexpr int kBrotliQuality = 9, kBrotliWindow = 22, kBrotliGeneric = 0;

// Empty if it saves less than a tenth.
std::string brotliOf(std::string_view text, BrotliCompress* compress) {
    std::string packed(text.size() - text.size() / 10, '\0');
    std::size_t size = packed.size();
    const int isDone = compress(kBrotliQuality, kBrotliWindow, kBrotliGeneric, text.size(),
                                reinterpret_cast<const std::uint8_t*>(text.data()), &size,
                                reinterpret_cast<std::uint8_t*>(packed.data()));
    packed.resize(isDone != 0 ? size : 0);
    return packed;
}

}  // namespace

bool addCompressedCopies(Site& site) {
    std::vector<std::string> paths;
    for (const auto& [path, resource] : site.resources()) {
        const bool isOfPage = path.ends_with(".wasm") || path.ends_with(".js") || path.ends_with(".css");
        if (isOfPage && resource.gzip.size() > 0) paths.push_back(path);
    }
    const Result<SharedLibrary> library = SharedLibrary::load("libbrotlienc.so.1");
    BrotliCompress* compress = nullptr;
    const bool hasBrotli = library && library->find("BrotliEncoderCompress", compress);
    std::vector<std::string> packed(paths.size());
    if (hasBrotli)
        parallelFor(paths.size(), 1, 0, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) packed[i] = brotliOf(site.find(paths[i])->bytes.text(), compress);
        });
    for (std::size_t i = 0; i < paths.size(); ++i) {
        site.add(paths[i] + ".gz", site.find(paths[i])->gzip);
        if (!packed[i].empty()) site.add(paths[i] + ".br", Bytes::of(std::move(packed[i])));
    }
    return hasBrotli;
}

}  // namespace svt::serve
