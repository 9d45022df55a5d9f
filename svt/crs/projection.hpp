#pragma once
/// \file
/// Converts horizontal coordinates of one reference system to metres of another. Heights are unchanged.

#include <svt/core/result.hpp>
#include <svt/core/vec.hpp>

#include <memory>
#include <span>
#include <string>

namespace svt::crs {

/// A conversion of coordinates of one code to those of another, a projection in metres. Immutable.
class Projection {
public:
    /// Converts to the usual projection in metres for the source. A projection in feet becomes the same projection in
    /// metres. Degrees become the UTM zone of their datum at `place`, in Japan the zone of the plane rectangular
    /// system. All others become the UTM zone of WGS 84.
    /// \param source  EPSG code, horizontal or compound
    /// \param place   a point of the model, x: east or longitude, y: north or latitude, in units of the source
    /// \return the conversion, or CannotProject with the reason: the code is unknown, `place` is not on earth, or the
    ///         conversion needs PROJ in a build without it
    [[nodiscard]] static Result<Projection> toUsualMetres(int source, Vec3d place);

    /// Converts to the code `target`.
    /// \return the conversion; BadArgument if the target is unknown or not a projection in metres; CannotProject if no
    ///         conversion from the source is known, or if it needs PROJ in a build without it
    [[nodiscard]] static Result<Projection> between(int source, int target, Vec3d place);

    [[nodiscard]] int epsg() const noexcept { return epsg_; }                 ///< code of the target
    [[nodiscard]] const std::string& name() const noexcept { return name_; }  ///< name of the target, may be empty

    /// Metres per unit of the source; 1 for degrees.
    [[nodiscard]] double metresPerUnit() const noexcept { return metresPerUnit_; }

    /// Replaces x and y of each point (east or longitude, north or latitude) by metres east and north; z is unchanged.
    /// Points that cannot be projected become NaN. Cost: less than a microsecond per point. Not for several threads at
    /// once.
    void apply(std::span<Vec3d> points) const;

    class Way;
    Projection(int epsg, std::string name, double metresPerUnit, std::shared_ptr<const Way> way)
        : epsg_(epsg), name_(std::move(name)), metresPerUnit_(metresPerUnit), way_(std::move(way)) {}

private:
    int epsg_;
    std::string name_;
    double metresPerUnit_;
    std::shared_ptr<const Way> way_;
};

/// Length of a degree to the east (x) and to the north (y) at a latitude, on the ellipsoid GRS 1980; z: 1.
/// \param latitude  degrees, less than 90 in magnitude
[[nodiscard]] Vec3d metresPerDegree(double latitude) noexcept;

/// Version of the PROJ library that is used, or empty for a build without it.
[[nodiscard]] std::string projVersion();

/// The definition of a code as PROJJSON, on one line; empty if PROJ is missing or does not know the code.
/// Cost: milliseconds.
/// \param vertical  code of the heights, for a compound of both; 0: none
[[nodiscard]] std::string projJsonOf(int epsg, int vertical = 0);

/// The same definition as WKT 2 (ISO 19162:2019), on one line.
[[nodiscard]] std::string wktOf(int epsg, int vertical = 0);

}  // namespace svt::crs
