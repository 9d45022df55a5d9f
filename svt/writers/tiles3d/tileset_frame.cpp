#include <svt/writers/tiles3d/tileset_frame.hpp>

#include <svt/writers/drawing/drawing_text.hpp>

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace svt::writers {

Result<crs::GlobeFrame> frameOfVolume(const volume::SemanticVolume& volume, Vec3d corner,
                                      const VolumeWriteOptions& options) {
    if (options.tileset.place) {
        const Vec3d place = *options.tileset.place;
        if (!(std::abs(place.x) <= 90 && std::abs(place.y) <= 360 && std::isfinite(place.z)))
            return Error(
                Code::BadArgument,
                fmt::format("--place {},{},{}: a latitude from -90 to 90 degrees, a longitude from -360 to 360 "
                            "and a height in metres are expected, such as 49.1,8.44,110",
                            place.x, place.y, place.z));
        return crs::frameAt({place.y, place.x, place.z + options.tileset.lift.value_or(0)});
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
    auto frame = crs::frameOf(epsg, corner + Vec3d{0, 0, options.tileset.lift.value_or(0)});
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

/// Values of a matrix whose columns are the axes and the origin.
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

}  // namespace svt::writers
