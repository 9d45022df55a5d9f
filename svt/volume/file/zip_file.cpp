#include <svt/volume/zip_file.hpp>

#include <svt/volume/file/zip_container.hpp>

namespace svt::volume {

Result<std::vector<std::byte>> makeZip(std::span<const ZippedFile> files) {
    std::vector<ZipSource> sources;
    sources.reserve(files.size());
    for (const ZippedFile& file : files) sources.push_back({file.name, {std::span(file.bytes)}, false, false});
    return zipBytes(sources);
}

}  // namespace svt::volume
