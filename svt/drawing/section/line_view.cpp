#include <svt/drawing/line_view.hpp>

#include <svt/drawing/beyond/lines_beyond.hpp>
#include <svt/drawing/section/draw_labels.hpp>
#include <svt/drawing/section/exact_section.hpp>
#include <svt/drawing/section/wall_joints.hpp>
#include <svt/model/classes.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

namespace svt::drawing {
namespace {

constexpr double kNearPlane = 0.05;  // metres before a perspective eye

// The plane that a pass is cut by; none where nothing is cut.
Result<std::optional<SectionPlane>> planeOfClips(const std::vector<render::ClipRegion>& clips) {
    if (clips.empty()) return std::optional<SectionPlane>{};
    const render::ClipRegion& clip = clips.front();
    const bool isPlane = clips.size() == 1 && clip.mode == render::ClipRegion::Mode::CutAway &&
                         clip.parts.size() == 1 && clip.parts.front().rounds.empty() &&
                         clip.parts.front().halfSpaces.size() == 1;
    if (!isPlane)
        return Error(Code::BadFrame, "a line drawing is cut by one plane at most; give one --section, or draw a PNG");
    const render::HalfSpace& half = clip.parts.front().halfSpaces.front();
    const double size = length(half.normal);
    return std::optional<SectionPlane>({half.normal * (1 / size), half.normal * (-half.offset / (size * size))});
}

EyeView eyeOf(const render::Camera& camera) {
    EyeView eye;
    eye.away = normalized(camera.target - camera.eye);
    eye.axes.origin = camera.target;
    eye.axes.u = normalized(cross(eye.away, camera.up));
    eye.axes.v = cross(eye.axes.u, eye.away);
    eye.axes.normal = -eye.away;
    const double distance = length(camera.target - camera.eye);
    if (camera.projection == render::Camera::Projection::Perspective) {
        eye.distance = distance;
        eye.nearest = std::min(kNearPlane, 0.01 * distance) - distance;
    } else {
        eye.nearest = -distance;
    }
    return eye;
}

// Moves a cut from its plane to the picture; false where a point is not before the camera.
class CutPicturer {
public:
    CutPicturer(const EyeView& eye, const PlaneAxes& from) : eye_(eye), from_(from) {}

    bool run(SectionDrawing& drawing) {
        for (SectionComponent& component : drawing.components) {
            component.area = 0;
            for (SectionPolygon& polygon : component.polygons) {
                movePoints(polygon.outer);
                polygon.area = std::abs(areaOf(polygon.outer));
                for (Ring& hole : polygon.holes) {
                    movePoints(hole);
                    polygon.area -= std::abs(areaOf(hole));
                }
                component.area += polygon.area;
            }
        }
        for (SectionBorder& border : drawing.borders) movePoints(border.points);
        for (SectionLine& line : drawing.lines) movePoints(line.points);
        return isBefore_;
    }

private:
    void movePoints(std::vector<PlanePoint>& points) {
        for (PlanePoint& p : points) {
            const Vec3d view = eye_.viewed(from_.worldFromPlane(p));
            isBefore_ = isBefore_ && view.z > eye_.nearest;
            if (!isBefore_) return;
            const Vec3d seen = eye_.pictured(view);
            p = {seen.x, seen.y};
        }
    }
    static double areaOf(const Ring& ring) noexcept {
        double area = 0;
        for (std::size_t n = 0; n < ring.size(); ++n) {
            const PlanePoint a = ring[n], b = ring[(n + 1) % ring.size()];
            area += 0.5 * (a.u * b.v - a.v * b.u);
        }
        return area;
    }

    const EyeView& eye_;
    PlaneAxes from_;
    bool isBefore_ = true;
};

// Whether the eye is on the side that is cut away.
bool looksAtCut(const render::Camera& camera, const EyeView& eye) {
    return eye.distance > 0 ? dot(camera.eye - eye.cut.point, eye.cut.normal) > 0 : dot(eye.away, eye.cut.normal) < 0;
}

}  // namespace

Result<LineView> drawLineView(const volume::SemanticVolume& volume, const render::FrameSpec& frame,
                              const LineViewOptions& options) {
    if (frame.passes.size() != 1)
        return Error(Code::BadFrame, "a line drawing has one pass; lenses, highlights and contexts need a PNG");
    if (!hasMeshes(volume))
        return Error(Code::BadArgument,
                     "a line drawing needs the model's meshes, which the volume does not keep; build it again with "
                     "--vectors meshes, or give the model itself");
    const render::Pass& pass = frame.passes.front();
    SVT_TRY(plane, planeOfClips(pass.clips));
    std::vector<std::uint8_t> isDrawn(volume.labels.labels.size(), 0);
    for (std::size_t l = 0; l < isDrawn.size(); ++l) {
        const volume::Label& label = volume.labels.labels[l];
        isDrawn[l] =
            label.count > 0 && label.first < pass.styles.size() && pass.styles[label.first].opacity > 0 ? 1 : 0;
    }
    EyeView eye = eyeOf(frame.camera);
    LineView view;
    const DrawingTables tables(volume);
    if (*plane) {
        // Rooms are air: they are not filled, and the objects in them are visible.
        std::vector<std::uint8_t> isCut = isDrawn;
        for (std::size_t l = 0; l < isCut.size(); ++l)
            if (model::isSpace(volume.labels.labels[l].className)) isCut[l] = 0;
        SectionOptions section;
        section.threads = options.threads;
        section.smallestArea = kSliverArea;
        SVT_TRY(drawing, drawLabels(volume, nullptr, **plane, isCut, section, tables));
        view.drawing = std::move(*drawing);
        eye.hasCut = true;
        eye.cut = view.drawing.plane;
        if (!looksAtCut(frame.camera, eye)) {
            view.drawing.components.clear();
            view.drawing.borders.clear();
            view.drawing.lines.clear();
        }
        if (!CutPicturer(eye, view.drawing.axes).run(view.drawing))
            return Error(Code::BadCamera, "the camera stands in a component that is cut; move --eye away from it");
    }
    view.drawing.axes = eye.axes;
    view.drawing.plane = {eye.axes.normal, eye.axes.origin};
    addLinesOfView(view.drawing, volume, isDrawn, eye, options.hidden, options.threads);
    joinWalls(view.drawing, volume.labels, tables);
    view.height = eye.distance > 0
                      ? 2 * eye.distance * std::tan(frame.camera.verticalFovDegrees * 3.14159265358979323846 / 360)
                      : frame.camera.orthographicHeight;
    view.width = view.height * frame.width / frame.height;
    return view;
}

}  // namespace svt::drawing
