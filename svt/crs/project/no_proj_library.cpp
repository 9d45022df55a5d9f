#include <svt/crs/project/proj_library.hpp>

#include <fmt/format.h>

namespace svt::crs {

std::string projVersion() { return {}; }
std::string projJsonOf(int, int) { return {}; }
std::string wktOf(int, int) { return {}; }

namespace project {
namespace {

Error withoutProj(int code) {
    return {
        Code::CannotProject,
        fmt::format("EPSG:{} needs the PROJ library, which this build does not contain; project the file first, or use "
                    "the native program",
                    code)};
}

}  // namespace

Result<Projection> projBetween(int source, int) { return withoutProj(source); }
Result<PlaceInDegrees> placeInDegrees(int source, Vec3d) { return withoutProj(source); }
std::optional<Box3d> projAreaOf(int) { return std::nullopt; }
std::optional<double> projGeoidHeight(int, int, Vec3d) { return std::nullopt; }

}  // namespace project
}  // namespace svt::crs
