// Any bytes as GeoJSON, a GeoPackage, another SQLite file or a shapefile give parcels and owners, or an error. All
// points of parcels are finite, and all parcels have a solid.
//
// The first byte is 's' for a shapefile: then the sizes of the .shp and the .dbf follow, two bytes each, low byte first,
// and the bytes of .shp, .dbf and .prj. Any other first byte stands for one file, which follows.
#include <svt/readers/owner_table.hpp>
#include <svt/readers/parcels.hpp>

#include <tests/fuzz/check_model.hpp>

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>

namespace {

namespace fs = std::filesystem;

using svt::fuzz::require;

void write(const fs::path& path, std::span<const std::uint8_t> bytes) {
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

// Writes the three files of a shapefile beside each other.
void writeShapefile(const fs::path& path, std::span<const std::uint8_t> bytes) {
    std::size_t at = 4;
    for (const std::size_t n : {std::size_t{0}, std::size_t{2}}) {
        const std::size_t size = bytes[n] + std::size_t{256} * bytes[n + 1];
        const std::size_t end = std::min(bytes.size(), at + size);
        write(fs::path(path).replace_extension(n == 0 ? ".shp" : ".dbf"), bytes.subspan(at, end - at));
        at = end;
    }
    write(fs::path(path).replace_extension(".prj"), bytes.subspan(at));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const fs::path folder = fs::temp_directory_path() / ("svt-parcels-fuzz-" + std::to_string(::getpid()));
    static const bool isMade = fs::create_directory(folder);
    static const int kAtEnd = std::atexit([] { fs::remove_all(folder); });
    (void)isMade;
    (void)kAtEnd;
    if (size < 5) return 0;
    const std::span<const std::uint8_t> bytes(data + 1, size - 1);
    const bool isShapefile = data[0] == 's';
    const fs::path path = folder / (isShapefile ? "parcels.shp" : "parcels");
    if (isShapefile)
        writeShapefile(path, bytes);
    else
        write(path, bytes);
    (void)svt::readers::looksLikeParcels(path);
    svt::Diagnostics findings;
    for (const char* crs : {"", "EPSG:25832"}) {
        const auto model = svt::readers::readParcels(path, {90, 110, crs, std::uint64_t{1} << 20}, &findings);
        if (!model) continue;
        require(!model->features.empty());
        svt::fuzz::checkModel(*model);
        for (const auto& polygon : model->polygons)
            for (const svt::Vec3d& point : polygon.points)
                require(std::isfinite(point.x) && std::isfinite(point.y) && std::isfinite(point.z));
        for (const auto& feature : model->features) require(!feature.geometries.empty());
    }
    (void)svt::readers::readOwnerTable(path);
    return 0;
}
