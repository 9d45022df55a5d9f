#include <svt/writers/tiles3d/tileset_writer.hpp>

#include <svt/crs/globe.hpp>
#include <svt/writers/dense/new_folder.hpp>
#include <svt/writers/drawing/drawing_text.hpp>
#include <svt/writers/tiles3d/feature_glb.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace svt::writers {
namespace {

using TilesetJson = nlohmann::ordered_json;

constexpr std::uint64_t kTileTriangles = 300'000;

Result<crs::GlobeFrame> frameOfVolume(const volume::SemanticVolume& volume, Vec3d corner,
                                      const VolumeWriteOptions& options) {
    if (options.place) {
        const Vec3d place = *options.place;
        if (!(std::abs(place.x) <= 90 && std::abs(place.y) <= 360 && std::isfinite(place.z)))
            return Error(
                Code::BadArgument,
                fmt::format("--place {},{},{}: a latitude from -90 to 90 degrees, a longitude from -360 to 360 "
                            "and a height in metres are expected, such as 49.1,8.44,110",
                            place.x, place.y, place.z));
        return crs::frameAt({place.y, place.x, place.z + options.lift});
    }
    const auto epsg = static_cast<int>(epsgCodeOf(volume.crsName));
    if (epsg == 0)
        return Error(
            Code::CannotProject,
            volume.crsName.empty()
                ? "the volume has no CRS, so its place on the globe is not known; give latitude, longitude and "
                  "height of its lower corner by --place, such as --place 49.1,8.44,110"
                : fmt::format("the CRS '{}' names no code of EPSG, so the place on the globe is not known; give "
                              "latitude, longitude and height of the lower corner by --place",
                              volume.crsName));
    auto frame = crs::frameOf(epsg, corner + Vec3d{0, 0, options.lift});
    if (!frame)
        return Error(
            frame.error().code(),
            frame.error().message() + "; or give latitude, longitude and height of the lower corner by --place");
    return frame;
}

/// A box as its centre and half axes.
TilesetJson boundingVolume(const Box3d& box) {
    const Vec3d centre = (box.min + box.max) * 0.5, half = (box.max - box.min) * 0.5;
    return {{"box", {centre.x, centre.y, centre.z, half.x, 0, 0, 0, half.y, 0, 0, 0, half.z}}};
}

/// Of a matrix whose columns are the axes and the origin.
TilesetJson transformOf(const crs::GlobeFrame& frame) {
    TilesetJson matrix = TilesetJson::array();
    for (const Vec3d axis : frame.axes)
        for (const double value : {axis.x, axis.y, axis.z, 0.0}) matrix.push_back(value);
    for (const double value : {frame.origin.x, frame.origin.y, frame.origin.z, 1.0}) matrix.push_back(value);
    return matrix;
}

TilesetJson assetOf(const volume::SemanticVolume& volume, Vec3d corner) {
    TilesetJson extras{{"origin", {corner.x, corner.y, corner.z}}, {"crs", volume.crsName}, {"source", volume.source}};
    return {{"version", "1.1"}, {"generator", "svt"}, {"extras", std::move(extras)}};
}

}  // namespace

Result<std::uint64_t> writeTileset(const volume::SemanticVolume& volume, const std::filesystem::path& path,
                                   const VolumeWriteOptions& options) {
    const Vec3d corner = volume.grid.worldFromIndex({-0.5, -0.5, -0.5});
    const auto frame = frameOfVolume(volume, corner, options);
    if (!frame) return frame.error();
    NewFolder folder(path);
    if (auto made = folder.create(); !made) return made.error();
    const auto hulls = makeLabelHulls(volume, options);
    if (!hulls) return hulls.error();
    const FeatureTexts texts = featureTexts(volume);

    const std::size_t count = hulls->surfaces.size();
    TilesetJson children = TilesetJson::array();
    for (std::size_t begin = 0, end = 0; begin < count; begin = end) {
        std::uint64_t triangles = 0;
        while (end < count && (end == begin || triangles + hulls->surfaces[end].triangles.size() <= kTileTriangles))
            triangles += hulls->surfaces[end++].triangles.size();
        if (Progress::isCancelled(options.progress))
            return Error(Code::Cancelled, "writing the volume was stopped; nothing was left");
        Progress::tell(options.progress, "write", double(begin) / double(count));
        const auto glb = makeFeatureGlb(*hulls, begin, end, texts);
        if (!glb) return glb.error();
        const std::string name = fmt::format("{}.glb", children.size());
        if (auto done = folder.write(name, *glb); !done) return done.error();
        children.push_back({{"boundingVolume", boundingVolume(boxOfHulls(*hulls, begin, end))},
                            {"geometricError", 0},
                            {"content", {{"uri", name}}}});
    }
    const Box3d box = boxOfHulls(*hulls, 0, count);
    const double size = length(box.max - box.min);
    TilesetJson root{{"transform", transformOf(*frame)},
                     {"boundingVolume", boundingVolume(box)},
                     {"geometricError", children.size() == 1 ? 0 : size},
                     {"refine", "ADD"}};
    if (children.size() == 1)
        root["content"] = children[0]["content"];
    else
        root["children"] = std::move(children);
    const TilesetJson tileset{{"asset", assetOf(volume, corner)}, {"geometricError", size}, {"root", std::move(root)}};
    const std::string text = tileset.dump(1, ' ', false, TilesetJson::error_handler_t::replace) + "\n";
    if (auto done = folder.write("tileset.json", text); !done) return done.error();
    return folder.commit();
}

}  // namespace svt::writers
