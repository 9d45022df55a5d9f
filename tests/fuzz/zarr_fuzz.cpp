// For any metadata and any chunk a folder of Zarr becomes a volume, or an error. The bytes are the attributes of a group, the
// metadata of its array, and a chunk, with a line "---" between them.
#include <svt/core/file.hpp>
#include <svt/volume/label_table.hpp>
#include <svt/volume_readers/read_label_volume.hpp>

#include <array>
#include <cstdint>
#include <fstream>
#include <string_view>

namespace {

void write(const std::filesystem::path& file, std::string_view text) {
    std::filesystem::create_directories(file.parent_path());
    std::ofstream stream(file, std::ios::binary);
    stream.write(text.data(), static_cast<std::streamsize>(text.size()));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const svt::PrivateFolder kFolder;
    const auto root = kFolder.path() / "fuzz.zarr";
    std::filesystem::remove_all(root);
    std::string_view rest(reinterpret_cast<const char*>(data), size);
    std::array<std::string_view, 3> parts;
    for (std::size_t p = 0; p < 3; ++p) {
        const std::size_t end = p < 2 ? rest.find("\n---\n") : std::string_view::npos;
        parts[p] = rest.substr(0, end);
        rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 5);
    }
    const bool isVersion3 = parts[1].find("node_type") != std::string_view::npos;
    const auto array = parts[0].empty() ? root : root / "0";
    if (!parts[0].empty())
        write(root / (parts[0].find("node_type") != std::string_view::npos ? "zarr.json" : ".zattrs"), parts[0]);
    write(array / (isVersion3 ? "zarr.json" : ".zarray"), parts[1]);
    // Whatever the metadata call the first chunk.
    for (const char* name : {"0/0/0", "0.0.0", "c/0/0/0"}) write(array / name, parts[2]);
    const auto volume = svt::volume_readers::readLabelVolume(root, {{}, std::uint64_t{256} << 20, nullptr, nullptr});
    if (volume) (void)volume->columns.countVoxels(volume->labels.scalarCount());
    return 0;
}
