#include <svt/drawing/field_drawing.hpp>

#include <svt/core/rounding.hpp>
#include <svt/drawing/field/field_arrows.hpp>
#include <svt/drawing/field/field_contours.hpp>
#include <svt/drawing/field/field_regions.hpp>
#include <svt/drawing/field/region_grid.hpp>
#include <svt/fields/field_sampler.hpp>
#include <svt/fields/units.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <deque>

namespace svt::drawing {
namespace {

constexpr double kKeptHair = 1e-4;       // of a voxel: samples lie this far in the kept side
constexpr double kLeastBand = 1e-6;      // m2
constexpr double kUsualBands = 8;        // the least number, unless a step is given
constexpr double kAreaTolerance = 1e-3;  // of the area of a band: slivers that joining drops

// The round step of bands; 0: none.
Result<double> bandStepOf(const fields::FieldHead& head, const FieldDrawingOptions& options, double range) {
    const bool isGiven = options.bands.has_value();
    const double step = isGiven                ? *options.bands
                        : options.isolines > 0 ? options.isolines
                        : range > 0            ? roundDownTo125(range / kUsualBands)
                                               : 1;
    if (step > 0) SVT_DO(checkStep(head, step, range, isGiven ? "--bands" : "--isolines"));
    return step;
}

Result<std::vector<SectionPolygon>> joined(const BandOutline& band, const char* what) {
    std::vector<SectionPolygon> polygons = fieldPolygons(band.outline, kLeastBand);
    double area = 0;
    for (const SectionPolygon& polygon : polygons) area += polygon.area;
    if (std::abs(area - band.area) > kAreaTolerance * band.area + 1e-4)
        return Error(
            Code::BadSection,
            fmt::format("{} of the field have {:.4f} m2 in parts, but {:.4f} m2 joined; move the plane by some "
                        "millimetres, or leave out the bands (--bands 0)",
                        what, band.area, area));
    return polygons;
}

// Joins the bands of all regions. Limits at the values of nodes make slivers, which joining drops; then the limits are
// shifted a little.
Result<std::vector<FieldBand>> joinedBands(const std::deque<RegionGrid>& grids, double step) {
    std::optional<Error> failed;
    for (const double shift : {0.0, 3e-5, -7e-5, 1.3e-4}) {
        BandOutlines outlines;
        for (const RegionGrid& grid : grids) addBands(grid, step, shift, outlines);
        std::vector<FieldBand> bands;
        failed.reset();
        for (const auto& [k, outline] : outlines) {
            auto polygons = joined(outline, "bands");
            if (!polygons) {
                failed = polygons.error();
                break;
            }
            if (!polygons->empty()) bands.push_back({double(k) * step, double(k + 1) * step, std::move(*polygons)});
        }
        if (!failed) return bands;
    }
    return *failed;
}

}  // namespace

double FieldDrawing::shareOf(double value) const noexcept {
    return high > low ? std::clamp((value - low) / (high - low), 0.0, 1.0) : 0.5;
}

Result<double> timeOfField(const fields::FieldHead& head, std::optional<double> wanted) {
    const double first = head.times.front(), last = head.times.back();
    if (!wanted) return first;
    if (*wanted >= first && *wanted <= last) return *wanted;
    return Error(Code::BadArgument,
                 first == last
                     ? fmt::format("the field '{}' has values only at {:g} s, not at {:g} s", head.name, first, *wanted)
                     : fmt::format("the field '{}' has values from {:g} to {:g} s, not at {:g} s", head.name, first,
                                   last, *wanted));
}

std::string titleOfField(const fields::FieldHead& head, double seconds) {
    const std::string unit = fields::unitText(head.unit);
    std::string title = unit.empty() ? head.name : fmt::format("{} ({})", head.name, unit);
    if (head.times.size() > 1) title += fmt::format(", {:g} s", seconds);
    return title;
}

std::string valueOfField(const fields::FieldHead& head, double value) {
    const std::string unit = fields::unitText(head.unit);
    return fmt::format("{:.6g}{}{}", value, unit.empty() ? "" : " ", unit);
}

Result<void> checkStep(const fields::FieldHead& head, double step, double range, const char* option) {
    if (!(step > 0) || !std::isfinite(step))
        return Error(Code::BadArgument, fmt::format("{} {:g}: expected a step above 0", option, step));
    if (range / step <= kMostLevels) return {};
    return Error(
        Code::BadArgument,
        fmt::format("{} {:g} divides the field '{}', which spans {:g}, into {:.0f} parts; {} are possible, so "
                    "give {:g} or more",
                    option, step, head.name, range, std::ceil(range / step), kMostLevels, range / kMostLevels));
}

namespace {

// Draws a field of one component, with the arrows of `vectors` if it has their lengths.
Result<FieldDrawing> drawNumbers(const SectionDrawing& drawing, const volume::SemanticVolume& volume,
                                 const fields::Field& field, const fields::Field* vectors,
                                 const FieldDrawingOptions& options) {
    const fields::FieldHead& head = field.head;
    SVT_TRY(sampler, fields::FieldSampler::make(field, volume));
    SVT_TRY(isMedium, fields::mediumOf(head, volume));
    fields::FieldHead air = head;
    air.medium = "air";
    SVT_TRY(isAir, fields::mediumOf(air, volume));
    SVT_TRY(seconds, timeOfField(head, options.time));
    const auto range = sampler->range();
    if (!range)
        return Error(Code::BadArgument,
                     fmt::format("the field '{}' has no value at any time; there is nothing to draw", head.name));
    FieldDrawing made;
    made.name = head.name;
    made.seconds = *seconds;
    made.title = titleOfField(head, *seconds);
    made.unit = fields::unitText(head.unit);
    made.low = options.range ? (*options.range)[0] : double(range->first);
    made.high = options.range ? (*options.range)[1] : double(range->second);
    const double span = double(range->second) - double(range->first);
    SVT_TRY(bandStep, bandStepOf(head, options, span));
    made.bandStep = *bandStep;
    made.isolineStep = options.isolines;
    if (options.isolines != 0) SVT_DO(checkStep(head, options.isolines, span, "--isolines"));

    const Vec3d spacing = volume.grid.spacing();
    PlaneAxes axes = drawing.axes;
    axes.origin = axes.origin - drawing.plane.normal * (kKeptHair * std::min({spacing.x, spacing.y, spacing.z}));
    const double least = vectors != nullptr ? 0 : -kInfinity;
    const FieldSource source{field, volume, *sampler, *isMedium, *isAir, axes, *seconds, least, options.threads};
    const std::vector<FieldRegion> regions =
        findFieldRegions(drawing, volume, *isMedium, *isAir, head.kind != fields::FieldKind::Grid);
    std::deque<RegionGrid> grids;
    BandOutline missing;
    for (const FieldRegion& region : regions) {
        const RegionGrid& grid = grids.emplace_back(region, source);
        if (made.isolineStep > 0) addIsolines(grid, made.isolineStep, made.isolines);
        if (made.bandStep > 0) addMissing(grid, missing);
    }
    std::stable_sort(made.isolines.begin(), made.isolines.end(),
                     [](const FieldIsoline& a, const FieldIsoline& b) { return a.value < b.value; });
    if (made.bandStep > 0) {
        SVT_TRY(bands, joinedBands(grids, made.bandStep));
        made.bands = std::move(*bands);
    }
    if (vectors != nullptr) {
        SVT_TRY(step, arrowStepOf(grids, options));
        SVT_TRY(directions, fields::FieldSampler::make(*vectors, volume));
        const FieldSource arrows{*vectors, volume,   *directions, *isMedium,      *isAir,
                                 axes,     *seconds, least,       options.threads};
        made.arrowStep = *step;
        made.arrows = findArrows(grids, arrows, *step, made.high);
    }
    SVT_TRY(without, joined(missing, "places without a value"));
    made.missing = std::move(*without);
    return made;
}

}  // namespace

Result<FieldDrawing> drawField(const SectionDrawing& drawing, const volume::SemanticVolume& volume,
                               const fields::Field& field, const FieldDrawingOptions& options) {
    if (field.head.components == 3) return drawNumbers(drawing, volume, fields::lengthsOf(field), &field, options);
    if (options.arrows && *options.arrows != 0)
        return Error(Code::BadArgument,
                     fmt::format("--arrows: the field '{}' has numbers, not vectors", field.head.name));
    return drawNumbers(drawing, volume, field, nullptr, options);
}

}  // namespace svt::drawing
