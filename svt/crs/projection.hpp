#pragma once
/// \file
/// Takes coordinates of one reference system to metres of another, in plan; heights stay.

#include <svt/core/result.hpp>
#include <svt/core/vec.hpp>

#include <memory>
#include <span>
#include <string>

namespace svt::crs {

/// How coordinates of one code come to those of another, a projection in metres. Immutable.
class Projection {
public:
    /// To the metres that are usual for the source: a projection in feet to the same one in metres; degrees to the
    /// UTM zone of their datum at `place`, in Japan to the zone of the plane rectangular system; others to the UTM zone
    /// of WGS 84.
    /// \param source  EPSG code, horizontal or compound
    /// \param place   a point of the model, x: east or longitude, y: north or latitude, in units of the source
    /// \return CannotProject, saying why: the code is not known, `place` is nowhere on earth, or the way needs PROJ and
    ///         this build is without it
    [[nodiscard]] static Result<Projection> toUsualMetres(int source, Vec3d place);

    /// To the code `target`.
    /// \return BadArgument where the target is not known or no projection in metres; CannotProject where there is no way
    ///         from the source to it, or it needs PROJ and this build is without it
    [[nodiscard]] static Result<Projection> between(int source, int target, Vec3d place);

    [[nodiscard]] int epsg() const noexcept { return epsg_; }                 ///< code of the target
    [[nodiscard]] const std::string& name() const noexcept { return name_; }  ///< name of the target, may be empty

    /// Metres in a unit of the source; 1 for degrees.
    [[nodiscard]] double metresPerUnit() const noexcept { return metresPerUnit_; }

    /// Replaces x and y of each point (east or longitude, north or latitude) by metres east and north; z stays.
    /// What cannot be projected becomes NaN. Cost: below a microsecond for each point. Not for several threads at once.
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
/// \param latitude  degrees, less than 90 in size
[[nodiscard]] Vec3d metresPerDegree(double latitude) noexcept;

/// Version of the PROJ library that is used, or empty for a build without it.
[[nodiscard]] std::string projVersion();

/// The definition of a code as PROJJSON, on one line; empty where PROJ is not there or does not know it.
/// Cost: milliseconds.
[[nodiscard]] std::string projJsonOf(int epsg);

}  // namespace svt::crs
