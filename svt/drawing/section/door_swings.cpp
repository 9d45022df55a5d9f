#include <svt/drawing/section/door_swings.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

namespace svt::drawing {
namespace {

using std::string_view;

constexpr double kLeastEdge = 0.03;  // metres of the door's border at one depth, for it to be a face
constexpr double kLeastWidth = 0.3, kArrowGap = 0.08, kArrowHead = 0.06;  // metres

// A door's own axes: x along it to the right, y to where it opens.
struct DoorFrame {
    PlanePoint x{}, y{};
    double left = 0, right = 0, face = 0, back = 0;
    [[nodiscard]] PlanePoint at(double along, double away) const noexcept {
        return {x.u * along + y.u * away, x.v * along + y.v * away};
    }
};

double along(PlanePoint axis, PlanePoint p) noexcept { return axis.u * p.u + axis.v * p.v; }

const Attribute* attributeOf(const volume::Label& label, string_view name) noexcept {
    const auto found = std::find_if(label.attributes.begin(), label.attributes.end(),
                                    [&](const Attribute& attribute) { return attribute.name == name; });
    return found == label.attributes.end() ? nullptr : &*found;
}

std::optional<double> numberOf(const Attribute* attribute) noexcept {
    if (attribute == nullptr) return std::nullopt;
    if (const double* number = std::get_if<double>(&attribute->value)) return *number;
    if (const std::int64_t* whole = std::get_if<std::int64_t>(&attribute->value)) return double(*whole);
    return std::nullopt;
}

// The greatest depth at which the border runs across for some length: a handle does not.
double faceOf(const SectionComponent& component, PlanePoint x, PlanePoint y) {
    std::vector<std::pair<double, double>> edges;  // depth, length
    const auto add = [&](const Ring& ring) {
        for (std::size_t n = 0; n < ring.size(); ++n) {
            const PlanePoint a = ring[n], b = ring[(n + 1) % ring.size()];
            const double across = std::abs(along(x, b) - along(x, a));
            if (across > 4 * std::abs(along(y, b) - along(y, a)))
                edges.emplace_back(std::max(along(y, a), along(y, b)), across);
        }
    };
    for (const SectionPolygon& polygon : component.polygons) add(polygon.outer);
    std::sort(edges.begin(), edges.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
    for (const auto& [depth, length] : edges) {
        double sum = 0;
        for (const auto& other : edges) sum += std::abs(other.first - depth) < 1e-3 ? other.second : 0;
        if (sum >= kLeastEdge) return depth;
    }
    return edges.empty() ? 0 : edges.front().first;
}

std::optional<DoorFrame> frameOf(const SectionComponent& component, const PlaneAxes& axes, double degrees) {
    const double angle = degrees * std::numbers::pi / 180;
    const Vec3d towards{std::sin(angle), std::cos(angle), 0};
    DoorFrame frame;
    frame.y = {dot(axes.u, towards), dot(axes.v, towards)};
    const double size = std::hypot(frame.y.u, frame.y.v);
    if (!(size > 0.5)) return std::nullopt;
    frame.y = {frame.y.u / size, frame.y.v / size};
    frame.x = {frame.y.v, -frame.y.u};
    double low = 1e300, high = -1e300;
    frame.left = 1e300;
    frame.right = -1e300;
    for (const SectionPolygon& polygon : component.polygons)
        for (const PlanePoint p : polygon.outer) {
            frame.left = std::min(frame.left, along(frame.x, p));
            frame.right = std::max(frame.right, along(frame.x, p));
            low = std::min(low, along(frame.y, p));
            high = std::max(high, along(frame.y, p));
        }
    if (!(frame.right - frame.left >= kLeastWidth) || high - low > frame.right - frame.left) return std::nullopt;
    frame.face = faceOf(component, frame.x, frame.y);
    frame.back = -faceOf(component, frame.x, {-frame.y.u, -frame.y.v});
    return frame;
}

class SwingMaker {
public:
    explicit SwingMaker(const DoorFrame& frame) : frame_(frame), middle_(0.5 * (frame.left + frame.right)) {}

    // False for an operation without a symbol.
    bool make(string_view operation, DoorSwing& swing) {
        swing_ = &swing;
        // IFC 4.3 has PANEL where IFC4 and 2x3 have DOOR.
        const bool isDouble = operation.starts_with("DOUBLE_DOOR_") || operation.starts_with("DOUBLE_PANEL_");
        const string_view rest = isDouble ? operation.substr(operation.find('_', 7) + 1) : operation;
        const bool isLeft = operation.ends_with("_LEFT");
        if (rest == "SINGLE_SWING") return both(true, false, true, false);
        if (rest == "DOUBLE_SWING") return both(true, true, true, true);
        // Both leaves turn to the left, one to this side, one to the other.
        if (rest == "SINGLE_SWING_OPPOSITE_LEFT") return both(true, false, false, true);
        if (rest == "SINGLE_SWING_OPPOSITE_RIGHT") return both(false, true, true, false);
        if (rest == "SLIDING") return slide(middle_, frame_.left) && slide(middle_, frame_.right);
        if (rest == "FOLDING") return fold(frame_.left, middle_) && fold(frame_.right, middle_);
        if (isDouble) return false;
        if (rest == "SINGLE_SWING_LEFT" || rest == "SINGLE_SWING_RIGHT") return one(isLeft, false);
        if (rest == "DOUBLE_SWING_LEFT" || rest == "DOUBLE_SWING_RIGHT") return one(isLeft, true);
        if (rest == "SWING_FIXED_LEFT") return leaf(frame_.left, middle_, true);
        if (rest == "SWING_FIXED_RIGHT") return leaf(frame_.right, middle_, true);
        if (rest == "SLIDING_TO_LEFT") return slide(frame_.right, frame_.left);
        if (rest == "SLIDING_TO_RIGHT") return slide(frame_.left, frame_.right);
        if (rest == "FOLDING_TO_LEFT") return fold(frame_.left, frame_.right);
        if (rest == "FOLDING_TO_RIGHT") return fold(frame_.right, frame_.left);
        if (rest == "REVOLVING" || rest == "REVOLVING_VERTICAL") return revolve();
        return false;
    }

private:
    bool one(bool isLeft, bool alsoBack) {
        const double hinge = isLeft ? frame_.left : frame_.right, lock = isLeft ? frame_.right : frame_.left;
        leaf(hinge, lock, true);
        if (alsoBack) leaf(hinge, lock, false);
        return true;
    }

    bool both(bool leftAhead, bool leftBack, bool rightAhead, bool rightBack) {
        if (leftAhead) leaf(frame_.left, middle_, true);
        if (leftBack) leaf(frame_.left, middle_, false);
        if (rightAhead) leaf(frame_.right, middle_, true);
        if (rightBack) leaf(frame_.right, middle_, false);
        return true;
    }

    // The open leaf, and the quarter of a circle from where it is when closed.
    bool leaf(double hinge, double lock, bool isAhead) {
        const double width = std::abs(lock - hinge), face = isAhead ? frame_.face : frame_.back;
        const PlanePoint center = frame_.at(hinge, face), closed = frame_.at(lock, face),
                         open = frame_.at(hinge, face + (isAhead ? width : -width));
        swing_->lines.push_back({center, open});
        // Counter-clockwise: of the two ways round the one that is a quarter.
        const bool isForward = (lock > hinge) == isAhead;
        swing_->arcs.push_back({center, isForward ? closed : open, isForward ? open : closed});
        return true;
    }

    // An arrow beside the door.
    bool slide(double from, double to) {
        const double away = frame_.face + kArrowGap, way = to > from ? 1.0 : -1.0, inset = 0.15 * (to - from);
        const PlanePoint tip = frame_.at(to - inset, away);
        swing_->lines.push_back({frame_.at(from + inset, away), tip});
        const double back = to - inset - way * kArrowHead;
        swing_->lines.push_back(
            {frame_.at(back, away + 0.5 * kArrowHead), tip, frame_.at(back, away - 0.5 * kArrowHead)});
        return true;
    }

    // Two panels, half open.
    bool fold(double hinge, double lock) {
        const double panel = 0.5 * std::abs(lock - hinge), turn = std::numbers::pi / 3, way = lock > hinge ? 1 : -1;
        swing_->lines.push_back({frame_.at(hinge, frame_.face),
                                 frame_.at(hinge + way * panel * std::cos(turn), frame_.face + panel * std::sin(turn)),
                                 frame_.at(hinge + way * 2 * panel * std::cos(turn), frame_.face)});
        return true;
    }

    // Four wings in a circle.
    bool revolve() {
        const double radius = 0.5 * (frame_.right - frame_.left), depth = 0.5 * (frame_.face + frame_.back);
        const PlanePoint center = frame_.at(middle_, depth);
        std::array<PlanePoint, 4> ends;
        for (std::size_t n = 0; n < 4; ++n) {
            const double turn = std::numbers::pi * (0.25 + 0.5 * double(n));
            ends[n] = frame_.at(middle_ + radius * std::cos(turn), depth + radius * std::sin(turn));
        }
        for (std::size_t n = 0; n < 4; ++n) swing_->arcs.push_back({center, ends[n], ends[(n + 1) % 4]});
        swing_->lines.push_back({ends[0], ends[2]});
        swing_->lines.push_back({ends[1], ends[3]});
        return true;
    }

    const DoorFrame& frame_;
    double middle_;
    DoorSwing* swing_ = nullptr;
};

}  // namespace

std::vector<DoorSwing> findDoorSwings(const SectionDrawing& drawing, const volume::SemanticVolume& volume) {
    std::vector<DoorSwing> swings;
    if (std::abs(dot(drawing.axes.normal, volume.grid.axes()[2])) < 1 - 1e-9) return swings;
    for (const SectionComponent& component : drawing.components) {
        const volume::Label& label = volume.labels.labels[component.label];
        const Attribute* const operation = attributeOf(label, "operationType");
        const auto towards = numberOf(attributeOf(label, "opensTowards"));
        if (operation == nullptr || !towards || component.polygons.empty()) continue;
        const std::string* const name = std::get_if<std::string>(&operation->value);
        if (name == nullptr) continue;
        const auto frame = frameOf(component, drawing.axes, *towards);
        DoorSwing swing{component.label, {}, {}};
        if (frame && SwingMaker(*frame).make(*name, swing)) swings.push_back(std::move(swing));
    }
    return swings;
}

std::vector<PlanePoint> pointsOf(const DoorSwing::Arc& arc) {
    constexpr int kParts = 12;
    const double u = arc.from.u - arc.center.u, v = arc.from.v - arc.center.v;
    std::vector<PlanePoint> points{arc.from};
    for (int n = 1; n < kParts; ++n) {
        const double turn = 0.5 * std::numbers::pi * n / kParts, c = std::cos(turn), s = std::sin(turn);
        points.push_back({arc.center.u + c * u - s * v, arc.center.v + s * u + c * v});
    }
    points.push_back(arc.to);
    return points;
}

}  // namespace svt::drawing
