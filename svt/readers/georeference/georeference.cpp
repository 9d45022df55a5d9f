#include <svt/readers/georeference/georeference.hpp>

#include <svt/crs/crs_facts.hpp>
#include <svt/crs/projection.hpp>
#include <svt/model/surface_uses.hpp>
#include <svt/readers/georeference/far_features.hpp>
#include <svt/readers/georeference/handedness.hpp>
#include <svt/readers/georeference/units.hpp>
#include <svt/readers/gml/gml_crs.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace svt::readers::georeference {
namespace {

using std::string_view;

constexpr double kMetresPerDegree = 111'000;
constexpr double kWidestBuilding = 0.1;  // degrees, 11 km

class Georeference {
public:
    Georeference(model::BuildingModel& model, const GivenCrs& given, const ReadOptions& options,
                 Diagnostics& diagnostics)
        : model_(model), given_(given), options_(options), diagnostics_(diagnostics) {
        model_.crs.name = given.name;
        code_ = gml::epsgCode(given.name);
        model_.crs.epsg = crs::factsOf(code_).horizontal;
    }

    Result<void> run() {
        if (crs::factsOf(code_).isGeocentric)
            return cannotProject(
                "the coordinates count from the centre of the earth, so no axis points up; project the file first, "
                "to degrees or metres");
        findUsed(given_.anchors);
        SVT_TRY(unit, unitOfModel(model_, given_.units, options_.unit, given_.place));
        unit_ = *unit;
        if (given_.name.empty() && given_.units.empty() && options_.unit == 0 && options_.crs == 0)
            warnOfHighRooms(model_, given_.place, diagnostics_);
        gml::AxisDecision axes = decide();
        if (axes.isGeographic && (code_ != 0 || gml::isCrs84(given_.name))) SVT_DO(checkDegrees(axes));
        if (axes.isGeographic && !given_.anchors.empty()) {
            placeInDegrees(axes.isNorthFirst);
            findUsed();
        }
        if (!options_.keepFarFeatures && leaveOutFar(axes.isGeographic) != 0) {
            findUsed();
            axes = decide();
        }
        model_.crs.axesSwapped = axes.isNorthFirst;
        if (axes.isNorthFirst)
            forEachUsed([](std::vector<Vec3d>& points) {
                for (Vec3d& point : points) std::swap(point.x, point.y);
            });
        if (axes.isNorthFirst) {
            std::swap(box_.min.x, box_.min.y);
            std::swap(box_.max.x, box_.max.y);
        }
        noteOrder(axes);
        return box_.isEmpty() ? Result<void>() : toMetres(axes.isGeographic);
    }

private:
    // Polygons that geometry uses, and the box around them; around lines where there are none.
    void findUsed(std::span<const Vec3d> anchors = {}) {
        isUsed_.assign(model_.polygons.size(), false);
        for (const model::Feature& feature : model_.features)
            for (const model::Geometry& geometry : feature.geometries)
                model::forEachUse(geometry, [&](const model::SurfaceUse& use) { isUsed_[use.polygon] = true; });
        box_ = {};
        for (std::size_t i = 0; i < isUsed_.size(); ++i) {
            if (!isUsed_[i]) continue;
            if (!anchors.empty() && anchors[i] != kNoAnchor)
                box_.add(anchors[i]);
            else
                for (const Vec3d& point : model_.polygons[i].points) box_.add(point);
        }
        if (box_.isEmpty())
            for (const model::Polyline& line : model_.lines)
                for (const Vec3d& point : line.points) box_.add(point);
    }

    // Degrees in which buildings would be kilometres wide are lengths, if the user says so.
    Result<void> checkDegrees(gml::AxisDecision& axes) {
        const double width = medianWidth(model_, given_.anchors);
        if (!(width > kWidestBuilding)) return {};
        if (options_.unit == 0)
            return Error(
                Code::UnitInDoubt,
                fmt::format("the coordinates are degrees by their CRS, '{}', but half of the buildings and rooms "
                            "are {:.3g} degrees wide or more, which is {:.0f} km. If the coordinates are lengths, "
                            "state their unit, such as --unit m, to read them without the CRS",
                            given_.name.substr(0, 200), width, width * kMetresPerDegree / 1000),
                given_.place);
        axes = {};
        axes.isNorthFirst = options_.axisOrder < 0;
        axes.remark = "the name means degrees, but --unit states lengths; taken without the CRS";
        return {};
    }

    // Shapes that the reader placed by adding metres to degrees.
    void placeInDegrees(bool isNorthFirst) {
        for (std::size_t i = 0; i < isUsed_.size(); ++i) {
            const Vec3d anchor = given_.anchors[i];
            if (!isUsed_[i] || anchor == kNoAnchor) continue;
            const Vec3d metres = crs::metresPerDegree(isNorthFirst ? anchor.x : anchor.y);
            for (Vec3d& point : model_.polygons[i].points) {
                const Vec3d local = point - anchor;
                point.x = anchor.x + (isNorthFirst ? local.y / metres.y : local.x / metres.x);
                point.y = anchor.y + (isNorthFirst ? local.x / metres.x : local.y / metres.y);
            }
        }
    }

    template <class Visit>
    void forEachUsed(Visit&& visit) {
        for (std::size_t i = 0; i < isUsed_.size(); ++i)
            if (isUsed_[i]) visit(model_.polygons[i].points);
        for (model::Polyline& line : model_.lines) visit(line.points);
    }

    [[nodiscard]] gml::AxisDecision decide() const {
        // The form "EPSG:n" means east first.
        const std::string name = given_.isEastFirst && code_ != 0 ? fmt::format("EPSG:{}", code_) : given_.name;
        gml::AxisDecision decision = gml::decideAxes(name, box_);
        if (options_.axisOrder != 0) {
            decision.isNorthFirst = options_.axisOrder < 0;
            decision.remark.clear();
        }
        return decision;
    }

    // Reports the order that was taken where the CRS, the name and the coordinates leave a choice.
    void noteOrder(const gml::AxisDecision& axes) {
        if (options_.axisOrder != 0 || box_.isEmpty()) return;
        if (!axes.remark.empty()) {
            diagnostics_.add(Severity::Warning, axes.isDoubtful ? Code::AxisOrder : Code::BadValue,
                             given_.name.empty() ? axes.remark : fmt::format("CRS '{}': {}", given_.name, axes.remark),
                             given_.place);
        } else if (axes.hasNorthFirst && !given_.isEastFirst) {
            diagnostics_.add(Severity::Note, Code::AxisOrder,
                             fmt::format("axes taken as {}, as the name '{}' means; --axis-order {} takes the other "
                                         "order",
                                         axes.isNorthFirst ? "north, east" : "east, north", given_.name.substr(0, 200),
                                         axes.isNorthFirst ? "east-north" : "north-east"),
                             given_.place);
        }
        warnOfMirror(model_, axes.isNorthFirst, given_.place, diagnostics_);
    }

    std::size_t leaveOutFar(bool isDegrees) {
        Vec3d metres{unit_, unit_, unit_};
        // Too large by the cosine of the latitude along one axis: enough to tell continents apart.
        if (isDegrees) metres = {kMetresPerDegree, kMetresPerDegree, 1};
        return leaveOutFarFeatures(model_, metres, given_.place, diagnostics_);
    }

    Result<void> toMetres(bool isDegrees) {
        const bool isWorld = gml::isCrs84(given_.name);
        const int source = isWorld ? 4326 : code_;
        const crs::CrsFacts facts = crs::factsOf(source);
        if (isDegrees && source == 0)
            return Error(
                Code::GeographicCrs,
                fmt::format("the coordinates look like degrees (x {:.6f} to {:.6f}, y {:.6f} to {:.6f}), but the "
                            "name of their CRS, '{}', is not known. Name the CRS in the file (such as EPSG:4326), or "
                            "project the file to metres first",
                            box_.min.x, box_.max.x, box_.min.y, box_.max.y, given_.name.substr(0, 200)),
                given_.place);
        if (facts.isDegrees && !isDegrees) {  // the name is wrong
            model_.crs.name.clear();
            model_.crs.epsg = 0;
            if (options_.crs != 0) return cannotProject("the coordinates are not those of its CRS");
            double heightUnit = 1;
            scaleAll(heightUnit);
            return {};
        }
        const bool isForeign = isDegrees || !facts.isMetres;
        if (isForeign && options_.unit != 0)
            return Error(Code::BadArgument,
                         "--unit is for coordinates in lengths; the CRS of this file has its own unit", given_.place);
        double heightUnit = heightUnitOf(given_.units);
        vertical_ = gml::verticalCode(given_.name);
        if (heightUnit == 0 && vertical_ != 0) heightUnit = crs::metresPerHeight(vertical_);
        if (!isForeign) scaleAll(heightUnit);
        if (isForeign || (options_.crs != 0 && options_.crs != facts.horizontal)) {
            if (source == 0)
                return cannotProject("the file names no CRS that is known, so it cannot be brought into another one");
            const auto projection = chooseProjection(source);
            if (!projection) return Error(projection.error().code(), projection.error().message(), given_.place);
            if (heightUnit == 0) heightUnit = projection->metresPerUnit();
            if (Result<void> done = project(*projection); !done) return done;
            findUsed();
            tell(*projection, source, isDegrees, isForeign, heightUnit);
        }
        if (heightUnit != 0 && heightUnit != 1) scaleHeights(heightUnit, isForeign);
        warnOfScale();
        warnOfArea();
        return {};
    }

    // Lengths in millimetres or another unit that the file or the user states.
    void scaleAll(double& heightUnit) {
        if (unit_ == 1) return;
        heightUnit = 1;
        forEachUsed([&](std::vector<Vec3d>& points) {
            for (Vec3d& point : points) point = point * unit_;
        });
        box_ = {box_.min * unit_, box_.max * unit_};
        diagnostics_.add(Severity::Note, Code::ForeignUnit,
                         fmt::format("the coordinates are in units of {:g} m; taken to metres", unit_), given_.place);
    }

    void warnOfScale() {
        const crs::MapScale scale = crs::mapScaleAt(model_.crs.epsg, box_.center());
        if (scale.factor < 1.01) return;
        diagnostics_.add(
            Severity::Warning, Code::MapScale,
            fmt::format("EPSG:{} (Mercator) shows lengths {:.3f} times, areas and volumes {:.2f} times as large as "
                        "they are at this place; --crs EPSG:{} gives true sizes",
                        model_.crs.epsg, scale.factor, scale.factor * scale.factor, scale.localCode),
            given_.place);
    }

    void warnOfArea() {
        if (box_.isEmpty()) return;
        const Vec3d center = box_.center();
        for (const Vec3d place : {center, box_.min, box_.max})
            if (crs::isInAreaOfUse(model_.crs.epsg, place).value_or(true)) return;
        diagnostics_.add(
            Severity::Warning, Code::OutsideArea,
            fmt::format("the model lies at ({:.0f}, {:.0f}), outside of the area in which EPSG:{} is used: "
                        "the name of the CRS or the coordinates are wrong, and maps show another place",
                        center.x, center.y, model_.crs.epsg),
            given_.place);
    }

    [[nodiscard]] Error cannotProject(std::string_view why) const {
        return {Code::CannotProject, fmt::format("{} (CRS '{}')", why, given_.name.substr(0, 200)), given_.place};
    }

    Result<crs::Projection> chooseProjection(int source) const {
        const Vec3d place = box_.center();
        if (options_.crs != 0) return crs::Projection::between(source, options_.crs, place);
        if (options_.likelyCrs != 0)
            if (auto likely = crs::Projection::between(source, options_.likelyCrs, place)) return likely;
        return crs::Projection::toUsualMetres(source, place);
    }

    Result<void> project(const crs::Projection& projection) {
        std::optional<Vec3d> lost;
        forEachUsed([&](std::vector<Vec3d>& points) {
            if (lost) return;
            const Vec3d before = points.empty() ? Vec3d{} : points.front();
            projection.apply(points);
            if (!std::all_of(points.begin(), points.end(), [](Vec3d p) { return isFinite(p); })) lost = before;
        });
        if (!lost) return {};
        return cannotProject(
            fmt::format("the point ({}, {}) cannot be brought to EPSG:{}: it lies too far away from where "
                        "that is used",
                        lost->x, lost->y, projection.epsg()));
    }

    void tell(const crs::Projection& projection, int source, bool isDegrees, bool isForeign, double heightUnit) {
        const std::string target = projection.name().empty()
                                       ? fmt::format("EPSG:{}", projection.epsg())
                                       : fmt::format("EPSG:{} ({})", projection.epsg(), projection.name());
        std::string message = fmt::format("the coordinates are {} of EPSG:{}, projected to {}",
                                          isDegrees   ? "degrees"
                                          : isForeign ? "not in metres, but in units"
                                                      : "those",
                                          source, target);
        if (heightUnit != 1) message += fmt::format("; heights are feet, one is {:.7f} m", heightUnit);
        diagnostics_.add(Severity::Note, isDegrees ? Code::GeographicCrs : Code::ForeignUnit, std::move(message),
                         given_.place);
        model_.crs.epsg = projection.epsg();
        // Heights keep their datum.
        const std::string heights =
            vertical_ != 0 && crs::factsOf(source).vertical == 0 ? fmt::format("+{}", vertical_) : std::string();
        model_.crs.name = fmt::format("EPSG:{} (from EPSG:{}{})", projection.epsg(), source, heights);
    }

    void scaleHeights(double unit, bool isTold) {
        forEachUsed([&](std::vector<Vec3d>& points) {
            for (Vec3d& point : points) point.z *= unit;
        });
        if (!isTold)
            diagnostics_.add(Severity::Note, Code::ForeignUnit,
                             fmt::format("the heights are feet, one is {:.7f} m; taken to metres", unit), given_.place);
    }

    model::BuildingModel& model_;
    const GivenCrs& given_;
    const ReadOptions& options_;
    Diagnostics& diagnostics_;
    std::vector<bool> isUsed_;
    Box3d box_;
    int code_ = 0, vertical_ = 0;  // of the name
    double unit_ = 1;              // metres per unit of lengths
};

}  // namespace

Result<void> georeference(model::BuildingModel& model, const GivenCrs& given, const ReadOptions& options,
                          Diagnostics& diagnostics) {
    return Georeference(model, given, options, diagnostics).run();
}

}  // namespace svt::readers::georeference
