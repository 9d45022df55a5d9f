// For any bytes a label volume of another program becomes a volume, or an error.
#include <svt/core/file.hpp>
#include <svt/volume/label_table.hpp>
#include <svt/volume_readers/read_label_volume.hpp>

#include <cstdint>
#include <fstream>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    // The readers map a file; a document may look for others in its folder, where there are none.
    static const svt::PrivateFolder kFolder;
    const auto path = kFolder.path() / "fuzz";
    {
        std::ofstream stream(path, std::ios::binary);
        stream.write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
    }
    const auto volume = svt::volume_readers::readLabelVolume(path, {{}, std::uint64_t{256} << 20, nullptr, nullptr});
    if (volume) (void)volume->columns.countVoxels(volume->labels.scalarCount());
    return 0;
}
