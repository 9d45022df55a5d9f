#include <svt/readers/georeference/georeference.hpp>

#include <svt/crs/crs_facts.hpp>
#include <svt/crs/projection.hpp>
#include <svt/model/surface_uses.hpp>
#include <svt/readers/georeference/far_features.hpp>
#include <svt/readers/georeference/handedness.hpp>
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

// Length of a unit by its label in GML or its code; 0: not known.
double unitLength(string_view label) noexcept {
    const std::size_t at = label.find_last_of(":/#");
    if (at != string_view::npos) label.remove_prefix(at + 1);
    for (const string_view metre : {"m", "metre", "meter", "9001"})
        if (label == metre) return 1;
    for (const string_view foot : {"ft", "foot", "feet", "[ft_i]", "9002"})
        if (label == foot) return crs::kFoot;
    for (const string_view foot : {"ftUS", "us-ft", "[ft_us]", "US_survey_foot", "9003"})
        if (label == foot) return crs::kSurveyFoot;
    return 0;
}

string_view thirdWord(string_view text) noexcept {
    string_view word;
    for (int count = 0; count < 3; ++count) {
        const std::size_t begin = text.find_first_not_of(" \t\r\n");
        if (begin == string_view::npos) return {};
        text.remove_prefix(begin);
        word = text.substr(0, text.find_first_of(" \t\r\n"));
        text.remove_prefix(word.size());
    }
    return word;
}

class Georeference {
public:
    Georeference(model::BuildingModel& model, const GivenCrs& given, const ReadOptions& options,
                 Diagnostics& diagnostics)
        : model_(model), given_(given), options_(options), diagnostics_(diagnostics) {
        model_.crs.name = given.name;
        model_.crs.epsg = gml::epsgCode(given.name);
    }

    Result<void> run() {
        findUsed(given_.anchors);
        gml::AxisDecision axes = decide();
        if (axes.isGeographic && !given_.anchors.empty()) {
            placeInDegrees(axes.isNorthFirst);
            findUsed();
        }
        if (!options_.keepFarFeatures && leaveOutFar(axes.isGeographic) != 0) {
            findUsed();
            axes = decide();
        }
        if (!axes.remark.empty())
            diagnostics_.add(Severity::Warning, Code::BadValue,
                             given_.name.empty() ? axes.remark : fmt::format("CRS '{}': {}", given_.name, axes.remark),
                             given_.place);
        model_.crs.axesSwapped = axes.isNorthFirst;
        if (axes.isNorthFirst)
            forEachUsed([](std::vector<Vec3d>& points) {
                for (Vec3d& point : points) std::swap(point.x, point.y);
            });
        if (axes.isNorthFirst) {
            std::swap(box_.min.x, box_.min.y);
            std::swap(box_.max.x, box_.max.y);
        }
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
        gml::AxisDecision decision = decideByContent();
        if (options_.axisOrder == 0) return decision;
        return {decision.isGeographic, options_.axisOrder < 0, {}};
    }
    [[nodiscard]] gml::AxisDecision decideByContent() const {
        const bool isDegrees = gml::decideAxes(given_.name, box_, 0).isGeographic;
        // The form "EPSG:n" promises no order; +1: the coordinates are taken as they are.
        const std::string name =
            given_.isEastFirst && model_.crs.epsg != 0 ? fmt::format("EPSG:{}", model_.crs.epsg) : given_.name;
        return gml::decideAxes(name, box_, given_.isEastFirst && !isDegrees ? +1 : handedness(model_));
    }

    std::size_t leaveOutFar(bool isDegrees) {
        Vec3d metres{1, 1, 1};
        // Too large by the cosine of the latitude along one axis: enough to tell continents apart.
        if (isDegrees) metres = {kMetresPerDegree, kMetresPerDegree, 1};
        return leaveOutFarFeatures(model_, metres, given_.place, diagnostics_);
    }

    Result<void> toMetres(bool isDegrees) {
        const bool isWorld = gml::isCrs84(given_.name);
        const int source = isWorld ? 4326 : model_.crs.epsg;
        const crs::CrsFacts facts = crs::factsOf(source);
        if (isDegrees && source == 0)
            return Error(
                Code::GeographicCrs,
                fmt::format("the coordinates look like degrees (x {:.6f} to {:.6f}, y {:.6f} to {:.6f}), but the "
                            "name of their CRS, '{}', is not known. Name the CRS in the file (such as EPSG:4326), or "
                            "project the file to metres first",
                            box_.min.x, box_.max.x, box_.min.y, box_.max.y, given_.name.substr(0, 200)),
                given_.place);
        if (facts.isDegrees && !isDegrees)  // the name is wrong
            return options_.crs == 0 ? Result<void>() : cannotProject("the coordinates are not those of its CRS");
        const bool isForeign = isDegrees || !facts.isMetres;
        double heightUnit = unitLength(thirdWord(given_.units));
        const int vertical = facts.vertical != 0 ? facts.vertical : gml::verticalCode(given_.name);
        if (heightUnit == 0 && vertical != 0) heightUnit = crs::metresPerHeight(vertical);
        if (isForeign || (options_.crs != 0 && options_.crs != facts.horizontal)) {
            if (source == 0)
                return cannotProject("the file names no CRS that is known, so it cannot be brought into another one");
            const auto projection = chooseProjection(source);
            if (!projection) return Error(projection.error().code(), projection.error().message(), given_.place);
            if (heightUnit == 0) heightUnit = projection->metresPerUnit();
            if (Result<void> done = project(*projection); !done) return done;
            tell(*projection, source, isDegrees, isForeign, heightUnit);
        }
        if (heightUnit != 0 && heightUnit != 1) scaleHeights(heightUnit, isForeign);
        return {};
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
        model_.crs.name = fmt::format("EPSG:{} (from EPSG:{})", projection.epsg(), source);
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
};

}  // namespace

Result<void> georeference(model::BuildingModel& model, const GivenCrs& given, const ReadOptions& options,
                          Diagnostics& diagnostics) {
    return Georeference(model, given, options, diagnostics).run();
}

}  // namespace svt::readers::georeference
