#include <svt/drawing/dimension/dimension_chains.hpp>

#include <svt/model/classes.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>

namespace svt::drawing {
namespace {

using volume::kNoLabel;

constexpr double kSameStop = 1e-3;       // metres
constexpr double kStep = 0.05;           // metres: smaller steps of a face have no stop
constexpr double kThickestFace = 1;      // metres
constexpr double kThinnestFace = 0.3;    // metres: walls of a side differ by a factor of two at most, from here on
constexpr double kNarrowestRoom = 0.3;   // metres, across the face
constexpr double kShortestPart = 0.015;  // metres
constexpr double kOblique = 0.035;       // slope of a face across the line of sight, 2 degrees
constexpr double kAlong = 0.0175;        // sine of 1 degree: walls along an axis
constexpr double kLeastAlong = 0.6;      // share of the length of walls
constexpr std::size_t kMostParts = 80;   // of a chain
constexpr std::size_t kMostCrossings = 50'000'000;

enum class Matter : std::uint8_t { Air, Space, Filling, Wall };

bool isFillingOfIfc(const volume::Label& label) {
    for (const Attribute& attribute : label.attributes)
        if (attribute.name == "ifcType")
            if (const auto* type = std::get_if<std::string>(&attribute.value))
                return type->starts_with("IfcDoor") || type->starts_with("IfcWindow");
    return false;
}

std::vector<Matter> mattersOf(const volume::LabelTable& table) {
    std::vector<Matter> matters;
    for (const volume::Label& label : table.labels) {
        const auto rank = model::classRank(label.className);
        // Files of CityGML 3.0 that were IFC have windows and doors as elements.
        const bool isFilling = rank == model::ClassRank::Filling || isFillingOfIfc(label);
        const bool isNothing = rank == model::ClassRank::Furniture || rank == model::ClassRank::Installation ||
                               rank == model::ClassRank::Other || label.className == "ClosureSurface";
        matters.push_back(model::isSpace(label.className) ? Matter::Space
                          : isNothing                     ? Matter::Air
                          : isFilling                     ? Matter::Filling
                                                          : Matter::Wall);
    }
    return matters;
}

// A piece of a border as a side sees it: `s` runs along the side, `t` away from the eye.
struct SeenEdge {
    double s0 = 0, t0 = 0, s1 = 0, t1 = 0;  // s0 < s1
    std::uint32_t behind = kNoLabel;        // label on the far side
    [[nodiscard]] double slope() const noexcept { return (t1 - t0) / (s1 - s0); }
    [[nodiscard]] double depthAt(double s) const noexcept { return t0 + slope() * (s - s0); }
};

// The first objects on a line of sight between two stops.
struct SeenPart {
    Matter face = Matter::Air;
    double near = 0, far = 0;  // depth of the face at the beginning and the end of the part
    bool isOblique = false;
    double thickness = 0;           // of the face before the room
    std::uint32_t room = kNoLabel;  // label of the room behind the face; kInWall, kOpenRoom, or none
};
constexpr std::uint32_t kInWall = kNoLabel - 1, kOpenRoom = kNoLabel - 2;

class SideReader {
public:
    SideReader(const SectionDrawing& drawing, const std::vector<Matter>& matters, DimensionSide side)
        : matters_(matters), side_(side) {
        for (const SectionComponent& component : drawing.components)
            hasSpaces_ = hasSpaces_ || (matters[component.label] == Matter::Space && !component.polygons.empty());
        for (const SectionBorder& border : drawing.borders)
            for (std::size_t n = 0; n + 1 < border.points.size(); ++n)
                addEdge(border.points[n], border.points[n + 1], border);
    }

    // Whether there was something to see, and not too much.
    bool read() {
        for (const SeenEdge& edge : edges_) {
            stops_.push_back(edge.s0);
            stops_.push_back(edge.s1);
        }
        std::sort(stops_.begin(), stops_.end());
        std::size_t kept = 0;
        for (const double stop : stops_)
            if (kept == 0 || stop - stops_[kept - 1] > 0.1 * kSameStop) stops_[kept++] = stop;
        stops_.resize(kept);
        if (stops_.size() < 2 || !findParts()) return false;
        return std::any_of(parts_.begin(), parts_.end(), [](const SeenPart& p) { return p.face != Matter::Air; });
    }

    // From the first to the last place where there is a face.
    [[nodiscard]] std::vector<double> overall() const {
        std::size_t first = 0, last = parts_.size();
        while (parts_[first].face == Matter::Air) ++first;
        while (parts_[last - 1].face == Matter::Air) --last;
        return {stops_[first], stops_[last]};
    }
    [[nodiscard]] std::vector<double> openings() const {
        return stopsWhere([](const SeenPart& a, const SeenPart& b) {
            if (a.face == Matter::Air && b.face == Matter::Air) return false;
            if (a.isOblique && b.isOblique) return false;
            const bool isStep = a.face != Matter::Air && b.face != Matter::Air && std::abs(a.far - b.near) > kStep;
            return a.face != b.face || (isStep && a.face == Matter::Wall);
        });
    }
    [[nodiscard]] std::vector<double> rooms() const {
        return stopsWhere(
            [](const SeenPart& a, const SeenPart& b) { return a.room != b.room && !(a.isOblique && b.isOblique); });
    }

private:
    [[nodiscard]] Matter matterOf(std::uint32_t label) const noexcept {
        return label == kNoLabel ? Matter::Air : matters_[label];
    }

    [[nodiscard]] bool isSolid(std::uint32_t label) const noexcept {
        const Matter matter = matterOf(label);
        return matter == Matter::Wall || matter == Matter::Filling;
    }

    void addEdge(PlanePoint a, PlanePoint b, const SectionBorder& border) {
        const auto turned = [&](PlanePoint p) {
            switch (side_) {
                case DimensionSide::Above: return PlanePoint{p.u, -p.v};
                case DimensionSide::Left: return PlanePoint{p.v, p.u};
                case DimensionSide::Right: return PlanePoint{p.v, -p.u};
                case DimensionSide::Below: break;
            }
            return p;
        };
        // Above and Left are mirrored: left and right of a border change.
        const bool isMirrored = side_ == DimensionSide::Above || side_ == DimensionSide::Left;
        const PlanePoint p = turned(a), q = turned(b);
        if (std::abs(q.u - p.u) < 1e-9) return;
        const bool isForward = q.u > p.u;
        const std::uint32_t behind = isForward != isMirrored ? border.left : border.right;
        edges_.push_back(isForward ? SeenEdge{p.u, p.v, q.u, q.v, behind} : SeenEdge{q.u, q.v, p.u, p.v, behind});
    }

    bool findParts() {
        std::vector<std::vector<std::uint32_t>> edgesOf(stops_.size() - 1);
        std::size_t crossings = 0;
        for (std::uint32_t e = 0; e < edges_.size(); ++e) {
            // Edges reach over the middle of a part or do not.
            auto n =
                static_cast<std::size_t>(std::lower_bound(stops_.begin(), stops_.end(), edges_[e].s0) - stops_.begin());
            for (n = n == 0 ? 0 : n - 1; n + 1 < stops_.size(); ++n) {
                const double middle = 0.5 * (stops_[n] + stops_[n + 1]);
                if (middle > edges_[e].s1) break;
                if (middle < edges_[e].s0) continue;
                edgesOf[n].push_back(e);
                if (++crossings > kMostCrossings) return false;
            }
        }
        for (std::size_t n = 0; n < edgesOf.size(); ++n) parts_.push_back(partOf(edgesOf[n], stops_[n], stops_[n + 1]));
        closeNiches();
        return true;
    }

    // Behind more than the usual thickness lies the niche of a window in a wall that runs away from the eye; so does
    // what is too narrow for a room.
    void closeNiches() {
        double thinnest = kThickestFace;
        for (const SeenPart& part : parts_)
            if (part.thickness > 0) thinnest = std::min(thinnest, part.thickness);
        for (SeenPart& part : parts_)
            if (part.thickness > 2 * std::max(thinnest, kThinnestFace)) part.room = kInWall;
        for (std::size_t first = 0, end = 0; first < parts_.size(); first = end) {
            for (end = first + 1; end < parts_.size() && parts_[end].room == parts_[first].room;) ++end;
            if (parts_[first].room == kNoLabel || stops_[end] - stops_[first] >= kNarrowestRoom) continue;
            for (std::size_t n = first; n < end; ++n) parts_[n].room = kInWall;
        }
    }

    SeenPart partOf(std::vector<std::uint32_t>& crossed, double from, double to) const {
        const double middle = 0.5 * (from + to);
        std::sort(crossed.begin(), crossed.end(), [&](std::uint32_t a, std::uint32_t b) {
            const double x = edges_[a].depthAt(middle), y = edges_[b].depthAt(middle);
            return x != y ? x < y : a < b;
        });
        SeenPart part;
        for (std::size_t n = 0; n < crossed.size(); ++n) {
            const SeenEdge& edge = edges_[crossed[n]];
            if (!isSolid(edge.behind)) continue;
            part.face = matterOf(edge.behind);
            part.near = edge.depthAt(from);
            part.far = edge.depthAt(to);
            part.isOblique = std::abs(edge.slope()) > kOblique;
            part.room = roomBehind(std::span(crossed).subspan(n), middle, part.thickness);
            break;
        }
        return part;
    }

    // The first room behind a face that is wide enough; `crossed` begins with the face.
    std::uint32_t roomBehind(std::span<const std::uint32_t> crossed, double at, double& thickness) const {
        const double face = edges_[crossed.front()].depthAt(at);
        for (std::size_t n = 1; n + 1 < crossed.size();) {
            const SeenEdge& edge = edges_[crossed[n]];
            const double depth = edge.depthAt(at);
            if (depth - face > kThickestFace) break;
            // The stretch up to the next wall; furniture does not end it.
            std::size_t end = n;
            std::uint32_t room = hasSpaces_ ? kInWall : kOpenRoom;
            for (; end < crossed.size() && !isSolid(edges_[crossed[end]].behind); ++end)
                if (room == kInWall && matterOf(edges_[crossed[end]].behind) == Matter::Space)
                    room = edges_[crossed[end]].behind;
            if (room != kInWall && end > n && end < crossed.size() &&
                edges_[crossed[end]].depthAt(at) - depth >= kNarrowestRoom) {
                thickness = depth - face;
                return room;
            }
            end = std::max(end, n + 1);
            n = end;
        }
        return kInWall;
    }

    // Whether a narrow part continues in its neighbours, so that together they are wide enough.
    [[nodiscard]] bool isPiece(std::size_t n) const noexcept {
        const auto goesOn = [&](const SeenPart& other) {
            return other.face == parts_[n].face && other.room == parts_[n].room;
        };
        double from = stops_[n], to = stops_[n + 1];
        for (std::size_t m = n; m > 0 && goesOn(parts_[m - 1]) && to - from < kShortestPart; --m) from = stops_[m - 1];
        for (std::size_t m = n + 1; m < parts_.size() && goesOn(parts_[m]) && to - from < kShortestPart; ++m)
            to = stops_[m + 1];
        return to - from >= kShortestPart;
    }

    template <class IsStop>
    [[nodiscard]] std::vector<double> stopsWhere(const IsStop& isStop) const {
        const std::vector<double> ends = overall();
        std::vector<double> stops{ends[0]};
        const SeenPart* before = nullptr;  // the last part that is wide enough
        for (std::size_t n = 0; n < parts_.size(); ++n) {
            if (stops_[n + 1] - stops_[n] < kShortestPart && !isPiece(n)) continue;
            if (before != nullptr && stops_[n] > ends[0] + kShortestPart && stops_[n] < ends[1] - kShortestPart &&
                isStop(*before, parts_[n]) && stops_[n] - stops.back() > kShortestPart)
                stops.push_back(stops_[n]);
            before = &parts_[n];
        }
        stops.push_back(ends[1]);
        return stops;
    }

    const std::vector<Matter>& matters_;
    DimensionSide side_;
    bool hasSpaces_ = false;
    std::vector<SeenEdge> edges_;
    std::vector<double> stops_;
    std::vector<SeenPart> parts_;  // between stops
};

// The share of the length of walls that runs along u or v.
double shareAlongAxes(const SectionDrawing& drawing, const std::vector<Matter>& matters) {
    double all = 0, along = 0;
    const auto isWall = [&](std::uint32_t label) { return label != kNoLabel && matters[label] == Matter::Wall; };
    for (const SectionBorder& border : drawing.borders) {
        if (isWall(border.left) == isWall(border.right)) continue;
        for (std::size_t n = 0; n + 1 < border.points.size(); ++n) {
            const double du = std::abs(border.points[n + 1].u - border.points[n].u),
                         dv = std::abs(border.points[n + 1].v - border.points[n].v), length = std::hypot(du, dv);
            all += length;
            if (std::min(du, dv) <= kAlong * length) along += length;
        }
    }
    return all > 0 ? along / all : 0;
}

bool isSame(const std::vector<double>& a, const std::vector<double>& b) {
    return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin(),
                                              [](double x, double y) { return std::abs(x - y) < 0.5 * kShortestPart; });
}

// The extent of the cut: of its borders, or of its lines if it has no borders.
std::vector<double> extentOf(const SectionDrawing& drawing, const std::vector<Matter>& matters, bool isAlongU) {
    std::vector<double> extent{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
    const auto add = [&](std::uint32_t label, const std::vector<PlanePoint>& points) {
        if (matters[label] != Matter::Wall && matters[label] != Matter::Filling) return;
        for (const PlanePoint p : points) {
            extent[0] = std::min(extent[0], isAlongU ? p.u : p.v);
            extent[1] = std::max(extent[1], isAlongU ? p.u : p.v);
        }
    };
    for (const SectionLine& line : drawing.lines) add(line.label, line.points);
    for (const SectionComponent& component : drawing.components)
        for (const SectionPolygon& polygon : component.polygons) add(component.label, polygon.outer);
    return extent;
}

}  // namespace

std::vector<DimensionChain> findDimensions(const SectionDrawing& drawing, const volume::SemanticVolume& volume) {
    std::vector<DimensionChain> chains;
    if (std::abs(dot(drawing.axes.normal, volume.grid.axes()[2])) < 1 - 1e-12) return chains;
    const std::vector<Matter> matters = mattersOf(volume.labels);
    const bool isAlongAxes = shareAlongAxes(drawing, matters) >= kLeastAlong;
    for (const DimensionSide side :
         {DimensionSide::Below, DimensionSide::Right, DimensionSide::Above, DimensionSide::Left}) {
        const std::vector<double> extent =
            extentOf(drawing, matters, side == DimensionSide::Below || side == DimensionSide::Above);
        if (!(extent[1] - extent[0] > kShortestPart)) continue;
        std::vector<std::vector<double>> rows;
        SideReader reader(drawing, matters, side);
        if (isAlongAxes && reader.read()) {
            for (const std::vector<double>& row : {reader.openings(), reader.rooms()})
                if (row.size() > 2 && row.size() <= kMostParts + 1 && (rows.empty() || !isSame(rows.back(), row)))
                    rows.push_back(row);
        }
        rows.push_back(extent);
        for (std::size_t row = 0; row < rows.size(); ++row)
            chains.push_back({side, static_cast<int>(row), std::move(rows[row])});
    }
    return chains;
}

}  // namespace svt::drawing
