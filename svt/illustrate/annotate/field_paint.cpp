#include <svt/illustrate/annotate/field_paint.hpp>

#include <svt/drawing/field_drawing.hpp>
#include <svt/fields/field_statistics.hpp>
#include <svt/image/color.hpp>
#include <svt/image/color_map.hpp>
#include <svt/model/classes.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace svt::illustrate {
namespace {

constexpr float kNoValue = std::numeric_limits<float>::quiet_NaN();
constexpr std::size_t kColors = 1024;
constexpr double kLineWidth = 1.3;                   // pixels
constexpr double kLineStrength = 0.85;               // of the line over the colour
constexpr double kNearestLines = 3, kFreeLines = 6;  // pixels: nearer lines fade out
constexpr double kGrazing = 0.05;                    // cosine: faces seen more flatly have no lines
constexpr float kDarkLuminance = 0.18f;              // linear light: darker colours get light lines
constexpr Vec3f kDarkLine{0.003f, 0.003f, 0.003f}, kLightLine{0.9f, 0.9f, 0.9f};
constexpr double kInset = 0.02;  // voxels: samples stay this far inside of a voxel that they are moved to

Vec3i voxelOf(Vec3d index) noexcept {
    Vec3i voxel;
    for (int axis = 0; axis < 3; ++axis)
        voxel[axis] = static_cast<std::int32_t>(std::floor(std::clamp(index[axis], -2.0, 1e6) + 0.5));
    return voxel;
}

// The point of a voxel that is nearest to `index`.
Vec3d intoVoxel(Vec3i voxel, Vec3d index) noexcept {
    Vec3d point;
    for (int axis = 0; axis < 3; ++axis)
        point[axis] = std::clamp(index[axis], voxel[axis] - 0.5 + kInset, voxel[axis] + 0.5 - kInset);
    return point;
}

// The nearest point to `index` in those of the 27 voxels around it that `isWanted`.
template <class IsWanted>
std::optional<Vec3d> nearestIn(Vec3d index, const IsWanted& isWanted) noexcept {
    const Vec3i middle = voxelOf(index);
    std::optional<Vec3d> best;
    double least = std::numeric_limits<double>::infinity();
    for (std::int32_t n = 0; n < 27; ++n) {
        const Vec3i voxel = middle + Vec3i{n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1};
        const Vec3d point = intoVoxel(voxel, index), away = point - index;
        if (const double distance = dot(away, away); distance < least && isWanted(voxel)) {
            least = distance;
            best = point;
        }
    }
    return best;
}

}  // namespace

Result<FieldView> FieldView::make(const fields::Field& field, const volume::SemanticVolume& volume) {
    std::shared_ptr<const fields::Field> lengths;
    if (field.head.components > 1) lengths = std::make_shared<const fields::Field>(fields::lengthsOf(field));
    const fields::Field& shown = lengths ? *lengths : field;
    SVT_TRY(sampler, fields::FieldSampler::make(shown, volume));
    SVT_TRY(isMedium, fields::mediumOf(field.head, volume));
    fields::FieldHead air = field.head;
    air.medium = "air";
    SVT_TRY(isAir, fields::mediumOf(air, volume));
    FieldView view(std::move(*sampler));
    view.field_ = &shown;
    view.lengths_ = std::move(lengths);
    view.volume_ = &volume;
    view.isMedium_ = std::move(*isMedium);
    view.labelOf_ = volume.labels.labelOfScalar();
    view.isOfAir_ = true;
    for (std::size_t s = 0; s < view.isMedium_.size(); ++s)
        if (view.isMedium_[s] != 0 && (*isAir)[s] == 0) view.isOfAir_ = false;
    const Vec3d spacing = volume.grid.spacing();
    view.eps_ = 0.01 * std::min({spacing.x, spacing.y, spacing.z});
    return view;
}

volume::Scalar FieldView::scalarAt(Vec3i voxel) const noexcept {
    const Vec3i n = volume_->grid.dimension();
    const bool isInside =
        voxel.x >= 0 && voxel.y >= 0 && voxel.z >= 0 && voxel.x < n.x && voxel.y < n.y && voxel.z < n.z;
    return isInside ? volume_->columns.scalarAt(voxel.x, voxel.y, voxel.z) : 0;
}

// `index`, or the nearest place in a voxel of the label.
std::optional<Vec3d> FieldView::inLabel(volume::Scalar label, Vec3d index) const noexcept {
    const auto isSame = [&](Vec3i voxel) {
        const volume::Scalar scalar = scalarAt(voxel);
        return scalar == label || (scalar != 0 && scalar < labelOf_.size() && label < labelOf_.size() &&
                                   labelOf_[scalar] == labelOf_[label]);
    };
    if (isSame(voxelOf(index))) return index;
    return nearestIn(index, isSame);
}

// `index`, or the nearest place in a voxel of the medium that does not lie behind the surface.
std::optional<Vec3d> FieldView::inFront(Vec3d index, Vec3d normal) const noexcept {
    const auto isMedium = [&](Vec3i voxel) { return isOfMedium(scalarAt(voxel)); };
    if (isMedium(voxelOf(index))) return index;
    return nearestIn(index, [&](Vec3i voxel) {
        const Vec3d middle{double(voxel.x), double(voxel.y), double(voxel.z)};
        return dot(volume_->grid.worldFromIndexDirection(middle - index), normal) > 0 && isMedium(voxel);
    });
}

float FieldView::valueAt(const Surface& surface, double seconds) const noexcept {
    std::optional<Vec3d> at;
    if (isOfMedium(surface.label))
        at = inLabel(surface.label, volume_->grid.indexFromWorld(surface.world - surface.normal * eps_));
    else if (isOfAir_ && !surface.isCap)
        at = inFront(volume_->grid.indexFromWorld(surface.world + surface.normal * eps_), surface.normal);
    return at ? sampler_.atSeconds(*at, seconds) : kNoValue;
}

Result<std::vector<float>> FieldView::figures(FieldFigure figure, double seconds,
                                              std::optional<std::pair<float, float>>& range) const {
    SVT_TRY(statistics, fields::sumField(*field_, *volume_));
    const std::size_t labels = volume_->labels.labels.size();
    const auto at = [&](std::uint32_t label, std::size_t time) {
        const fields::FieldFigures found = fields::figuresAt(*statistics, std::span(&label, 1), time);
        const auto& value = figure == FieldFigure::Mean  ? found.mean
                            : figure == FieldFigure::Max ? found.max
                                                         : found.min;
        return value ? static_cast<float>(*value) : kNoValue;
    };
    const std::vector<double>& times = field_->head.times;
    std::size_t next = 0;  // the first time after `seconds`
    while (next < times.size() && times[next] <= seconds) ++next;
    const std::size_t before = next == 0 ? 0 : next - 1, after = std::min(next, times.size() - 1);
    const double span = times[after] - times[before];
    const auto share = static_cast<float>(span > 0 ? (seconds - times[before]) / span : 0);
    std::vector<float> values(labels, kNoValue);
    for (std::uint32_t l = 0; l < labels; ++l) {
        for (std::size_t time = 0; time < times.size(); ++time) {
            const float value = at(l, time);
            if (std::isnan(value)) continue;
            if (!range) range.emplace(value, value);
            range->first = std::min(range->first, value);
            range->second = std::max(range->second, value);
        }
        const float low = at(l, before);
        values[l] = share > 0 ? low + (at(l, after) - low) * share : low;
    }
    return values;
}

Result<void> FieldView::adapt(const Scene& scene, const analyze::LabelRows& rows, render::FrameSpec& spec) const {
    const auto& labels = volume_->labels.labels;
    for (std::size_t n = 0; n < spec.passes.size() && n < scene.passes.size(); ++n) {
        render::Pass& pass = spec.passes[n];
        const ScenePass& wanted = scene.passes[n];
        std::vector<bool> isHidden(labels.size(), false);
        for (const std::string& query : wanted.hide) {
            SVT_TRY(selected, analyze::selectWithParts(rows, query));
            for (const std::uint32_t l : *selected) isHidden[l] = true;
        }
        const bool fills = isOfAir_ && !wanted.cut.empty() && wanted.show.empty();
        for (volume::Scalar s = 1; s < pass.styles.size(); ++s) {
            if (!isOfMedium(s)) continue;
            render::Style& style = pass.styles[s];
            style.hatch = render::Hatch::None;
            const std::uint32_t l = labelOf_[s];
            if (fills && l != volume::kNoLabel && !isHidden[l] && model::isSpace(labels[l].className))
                style.opacity = 1;
        }
    }
    return {};
}

Result<FieldView::FramePaint> FieldView::paintFrame(const Scene& scene, const analyze::LabelRows& rows,
                                                    render::FrameSpec& spec) const {
    SVT_DO(adapt(scene, rows, spec));
    SVT_TRY(paint, FieldPaint::make(*this, *scene.field, spec));
    ColorScale scale = paint->scale();
    return FramePaint{std::make_unique<const FieldPaint>(std::move(*paint)), std::move(scale)};
}

Result<double> timeOfField(const fields::FieldHead& head, std::optional<double> wanted) {
    return drawing::timeOfField(head, wanted);
}

Result<FieldPaint> FieldPaint::make(const FieldView& view, const SceneField& look, const render::FrameSpec& spec) {
    FieldPaint paint(view, render::CameraRays(spec, view.volume().grid), spec.camera);
    SVT_TRY(seconds, timeOfField(view.head(), look.time));
    paint.seconds_ = *seconds;
    auto range = view.sampler().range();
    if (look.per) {
        if (look.isolines > 0)
            return Error(Code::BadArgument,
                         "isolines need the values at places, not one per component; leave out --isolines or --per");
        range.reset();
        SVT_TRY(figures, view.figures(*look.per, *seconds, range));
        paint.figures_ = std::move(*figures);
    }
    if (!range && !look.range)
        return Error(Code::BadArgument,
                     fmt::format("the field '{}' has no value at any time; there is nothing to show", view.name()));
    ColorScale& scale = paint.scale_;
    scale.isRamp = true;
    scale.title = drawing::titleOfField(view.head(), *seconds);
    if (look.per) scale.title = fmt::format("{} of {}", nameOf(*look.per), scale.title);
    scale.low = look.range ? (*look.range)[0] : double(range->first);
    scale.high = look.range ? (*look.range)[1] : double(range->second);
    scale.ramp = image::mapColors(look.map);
    scale.missingText = "no value";
    if (look.isolines > 0) {
        SVT_DO(drawing::checkStep(view.head(), look.isolines, scale.high - scale.low, "--isolines"));
        paint.isolines_ = look.isolines;
        scale.notes.push_back(fmt::format("lines every {}", drawing::valueOfField(view.head(), look.isolines)));
    }
    for (std::size_t n = 0; n < kColors; ++n) {
        const Vec3f color = image::linearFromSrgb(image::mapColor(look.map, double(n) / (kColors - 1)));
        paint.linear_.push_back(color);
        paint.isDark_.push_back(0.2126f * color.x + 0.7152f * color.y + 0.0722f * color.z < kDarkLuminance);
    }
    return paint;
}

// Coverage of a surface's pixel by a line of equal value. Values one pixel to the right and one above, on the plane of the
// surface, give the distance to the line in pixels.
double FieldPaint::lineAt(const Point& point, double value) const noexcept {
    const Vec3d forward = rays_.isPerspective() ? (point.world - eye_) / point.depth : rays_.forward();
    const double facing = dot(forward, point.normal);
    if (std::abs(facing) < kGrazing) return 0;
    const double pixel = rays_.pixelSize(point.depth);
    const auto change = [&](Vec3d aside) {
        const Vec3d step = aside - forward * (dot(aside, point.normal) / facing);
        for (const double sign : {1.0, -1.0}) {
            const float other =
                view_->valueAt({point.label, point.world + step * sign, point.normal, point.isCap}, seconds_);
            if (!std::isnan(other)) return sign * (double(other) - value);
        }
        return 0.0;
    };
    const double perPixel = std::hypot(change(rays_.right() * pixel), change(rays_.up() * pixel));
    if (!(perPixel > 1e-9 * isolines_)) return 0;
    const double level = std::round(value / isolines_) * isolines_;
    const double away = std::abs(value - level) / perPixel;
    const double apart = std::clamp((isolines_ / perPixel - kNearestLines) / (kFreeLines - kNearestLines), 0.0, 1.0);
    return std::clamp(kLineWidth / 2 + 0.5 - away, 0.0, 1.0) * apart * kLineStrength;
}

float FieldPaint::valueAt(const Point& point) const noexcept {
    if (figures_.empty()) return view_->valueAt({point.label, point.world, point.normal, point.isCap}, seconds_);
    const std::uint32_t label = view_->labelOf(point.label);
    return label < figures_.size() ? figures_[label] : kNoValue;
}

Vec3f FieldPaint::colorAt(const Point& point) const noexcept {
    const float value = valueAt(point);
    if (std::isnan(value))
        return view_->isOfMedium(point.label) ? image::linearFromSrgb(image::kNoValueColor) : point.color;
    const double range = scale_.high - scale_.low;
    const double share = range > 0 ? std::clamp((double(value) - scale_.low) / range, 0.0, 1.0) : 0.5;
    const auto entry = static_cast<std::size_t>(share * (kColors - 1) + 0.5);
    const Vec3f color = linear_[entry];
    if (!(isolines_ > 0)) return color;
    const auto ink = static_cast<float>(lineAt(point, double(value)));
    return color * (1 - ink) + (isDark_[entry] ? kLightLine : kDarkLine) * ink;
}

}  // namespace svt::illustrate
