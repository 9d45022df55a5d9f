// For any bytes the reader returns a volume, or an error.
#include <svt/volume/svt_file.hpp>

#include <cstdint>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::span bytes(reinterpret_cast<const std::byte*>(data), size);
    const auto volume = svt::volume::readSvt(bytes, "fuzz");
    if (volume) (void)volume->columns.countVoxels(volume->labels.scalarCount());
    const auto blocks = svt::volume::openSvt(bytes, "fuzz");
    if (blocks && blocks->blocks.count() > 0)
        (void)blocks->blocks.decodeTile(0, 0, blocks->frames.first(blocks->blocks.block(0).size));
    return 0;
}
