#include <svt/drawing/dimension/side_reader.hpp>

#include <algorithm>
#include <cmath>

namespace svt::drawing {
namespace {

using volume::kNoLabel;

constexpr double kSameStop = 1e-3;      // metres
constexpr double kStep = 0.05;          // metres: smaller steps of a face have no stop
constexpr double kThickestFace = 1;     // metres
constexpr double kThinnestFace = 0.3;   // metres: walls of a side differ by a factor of two at most, from here on
constexpr double kNarrowestRoom = 0.3;  // metres, across the face
constexpr double kWidestNotch = 0.15;   // metres
constexpr double kDeeper = 1.75;        // times the thickness of the wall: behind it lies a niche of the next wall
constexpr double kDeepestCasing = 0.25, kWidestCasing = 0.1;  // metres
constexpr double kOblique = 0.035;                            // slope of a face across the line of sight, 2 degrees
constexpr std::size_t kMostCrossings = 50'000'000;

}  // namespace

SideReader::SideReader(const SectionDrawing& drawing, const std::vector<PartRole>& roles, DimensionSide side)
    : roles_(roles), side_(side) {
    for (const SectionComponent& component : drawing.components)
        hasSpaces_ = hasSpaces_ || (matterOf(component.label) == Matter::Space && !component.polygons.empty());
    for (const SectionBorder& border : drawing.borders)
        for (std::size_t n = 0; n + 1 < border.points.size(); ++n)
            addEdge(border.points[n], border.points[n + 1], border);
    // Windows and doors without a body close the opening too.
    for (const SectionLine& line : drawing.lines)
        for (std::size_t n = 0; matterOf(line.label) == Matter::Filling && n + 1 < line.points.size(); ++n) {
            const std::size_t count = edges_.size();
            addEdge(line.points[n], line.points[n + 1], {{}, line.label, line.label});
            if (edges_.size() > count) edges_.back().isPane = true;
        }
}

bool SideReader::read() {
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
    return std::any_of(parts_.begin(), parts_.end(), [](const SeenPart& p) { return p.matter != Matter::Air; });
}

std::vector<double> SideReader::overall() const {
    const bool hasWalls =
        std::any_of(parts_.begin(), parts_.end(), [](const SeenPart& p) { return p.matter == Matter::Wall; });
    const auto isOutside = [&](const SeenPart& part) {
        return hasWalls ? part.matter != Matter::Wall : part.matter == Matter::Air;
    };
    std::size_t first = 0, last = parts_.size();
    while (isOutside(parts_[first])) ++first;
    while (isOutside(parts_[last - 1])) --last;
    return {stops_[first], stops_[last]};
}

std::vector<double> SideReader::openings() const {
    return stopsWhere([](const SeenPart& a, const SeenPart& b) {
        if (a.matter == Matter::Air && b.matter == Matter::Air) return false;
        if (a.face.isOblique && b.face.isOblique) return false;
        const bool isStep =
            a.matter != Matter::Air && b.matter != Matter::Air && std::abs(a.face.far - b.face.near) > kStep;
        return a.matter != b.matter || (isStep && a.matter == Matter::Wall);
    });
}

std::vector<double> SideReader::rooms() const {
    return stopsWhere([](const SeenPart& a, const SeenPart& b) {
        return a.face.room != b.face.room && !(a.face.isOblique && b.face.isOblique);
    });
}

bool SideReader::hasOpenings() const noexcept {
    return std::any_of(parts_.begin(), parts_.end(), [](const SeenPart& p) { return p.matter == Matter::Filling; });
}

SideReader::Matter SideReader::matterOf(std::uint32_t label) const noexcept {
    if (label == kNoLabel) return Matter::Air;
    switch (roles_[label]) {
        case PartRole::Space: return Matter::Space;
        case PartRole::Opening: return Matter::Filling;
        case PartRole::Hull: return Matter::Wall;
        default: return Matter::Air;
    }
}

bool SideReader::isSolid(std::uint32_t label) const noexcept {
    const Matter matter = matterOf(label);
    return matter == Matter::Wall || matter == Matter::Filling;
}

void SideReader::addEdge(PlanePoint a, PlanePoint b, const SectionBorder& border) {
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

bool SideReader::findParts() {
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
    removeCasings();
    fillNotches();
    closeNiches();
    return true;
}

// A casing, a shutter or a handle stands before the wall beside an opening. There the wall continues in the plane of its
// visible part, so the wall is the face. A casing that is let into the wall hides up to 0.1 m of its length. Behind a
// window, a wall that runs away from the eye begins deeper, or is wider.
void SideReader::removeCasings() {
    const Face* wall = nullptr;  // of the part before, if it is a wall
    double hidden = 0;           // length behind casings that are let in, since that wall
    const auto next = [&](std::size_t n, bool isForward) {
        const auto depthAtEnd = [](const Face& face, bool isFar) { return isFar ? face.far : face.near; };
        SeenPart& part = parts_[n];
        if (part.matter == Matter::Filling && part.hasWall && wall != nullptr) {
            const double before = depthAtEnd(*wall, isForward), behind = depthAtEnd(part.wall, !isForward),
                         casing = depthAtEnd(part.face, !isForward), length = stops_[n + 1] - stops_[n];
            const bool isBeforeWall = std::abs(behind - before) <= kStep && behind < casing + kDeepestCasing;
            const bool isLetIn = casing < before + kStep && behind > before && behind < before + kDeepestCasing &&
                                 hidden + length < kWidestCasing;
            if (isBeforeWall || isLetIn) {
                hidden += isBeforeWall ? 0 : length;
                part.matter = Matter::Wall;
                part.face = part.wall;
                if (!isBeforeWall) part.face.near = part.face.far = before;
                wall = &part.face;
                return;
            }
        }
        if (part.matter == Matter::Wall) hidden = 0;
        wall = part.matter == Matter::Wall ? &part.face : nullptr;
    };
    for (std::size_t n = 0; n < parts_.size(); ++n) next(n, true);
    wall = nullptr;
    hidden = 0;
    for (std::size_t n = parts_.size(); n-- > 0;) next(n, false);
    // Seen from its edge, a casing stands between a wall and the air.
    for (std::size_t first = 0, end = 0; first < parts_.size(); first = end) {
        for (end = first + 1; end < parts_.size() && parts_[end].matter == parts_[first].matter;) ++end;
        const bool isAtAir = (first > 0 && parts_[first - 1].matter == Matter::Air) ||
                             (end < parts_.size() && parts_[end].matter == Matter::Air);
        if (parts_[first].matter != Matter::Filling || !isAtAir || stops_[end] - stops_[first] >= kWidestCasing)
            continue;
        for (std::size_t n = first; n < end; ++n) parts_[n] = {};
    }
}

// A rafter or a pipe that is let into a wall leaves a notch, which has no stops: the wall goes on in one plane beside it.
void SideReader::fillNotches() {
    for (std::size_t first = 1; first + 1 < parts_.size(); ++first) {
        const SeenPart& before = parts_[first - 1];
        if (before.matter != Matter::Wall) continue;
        const auto isDeeper = [&](std::size_t n) {
            return parts_[n].matter == Matter::Wall && parts_[n].face.near > before.face.far + kStep;
        };
        std::size_t end = first;
        while (end < parts_.size() && isDeeper(end) && stops_[end + 1] - stops_[first] < kWidestNotch) ++end;
        if (end == first || end == parts_.size() || parts_[end].matter != Matter::Wall ||
            std::abs(parts_[end].face.near - before.face.far) > kStep)
            continue;
        for (std::size_t n = first; n < end; ++n) parts_[n].face = before.face;
    }
}

// Behind more than the usual thickness lies the niche of a window in a wall that runs away from the eye; so does
// what is too narrow for a room.
void SideReader::closeNiches() {
    double thinnest = kThickestFace;
    for (const SeenPart& part : parts_)
        if (part.face.thickness > 0) thinnest = std::min(thinnest, part.face.thickness);
    for (SeenPart& part : parts_)
        if (part.face.thickness > 2 * std::max(thinnest, kThinnestFace)) part.face.room = kInWall;
    for (std::size_t first = 0, end = 0; first < parts_.size(); first = end) {
        for (end = first + 1; end < parts_.size() && parts_[end].face.room == parts_[first].face.room;) ++end;
        if (parts_[first].face.room == kNoLabel) continue;
        if (parts_[first].face.room == kOpenRoom) closeNichesBeside(first, end);
        if (stops_[end] - stops_[first] >= kNarrowestRoom) continue;
        for (std::size_t n = first; n < end; ++n) parts_[n].face.room = kInWall;
    }
}

// Without spaces, the air in a niche continues the air of the room beside it. The niche is narrow, and lies deeper.
void SideReader::closeNichesBeside(std::size_t first, std::size_t end) {
    double least = kThickestFace;
    for (std::size_t n = first; n < end; ++n)
        if (parts_[n].matter == Matter::Wall) least = std::min(least, parts_[n].face.thickness);
    const auto isDeeper = [&](std::size_t n) { return parts_[n].face.thickness > kDeeper * least; };
    std::size_t low = first, high = end;
    while (low < end && isDeeper(low)) ++low;
    while (high > low && isDeeper(high - 1)) --high;
    if (stops_[low] - stops_[first] < kNarrowestRoom)
        for (std::size_t n = first; n < low; ++n) parts_[n].face.room = kInWall;
    if (stops_[end] - stops_[high] < kNarrowestRoom)
        for (std::size_t n = high; n < end; ++n) parts_[n].face.room = kInWall;
}

SideReader::SeenPart SideReader::partOf(std::vector<std::uint32_t>& crossed, double from, double to) const {
    const double middle = 0.5 * (from + to);
    std::sort(crossed.begin(), crossed.end(), [&](std::uint32_t a, std::uint32_t b) {
        const double x = edges_[a].depthAt(middle), y = edges_[b].depthAt(middle);
        return x != y ? x < y : a < b;
    });
    SeenPart part;
    for (std::size_t n = 0; n < crossed.size(); ++n) {
        const Matter matter = matterOf(edges_[crossed[n]].behind);
        if (matter != Matter::Wall && (matter != Matter::Filling || part.matter == Matter::Filling)) continue;
        const Face face = faceOf(std::span(crossed).subspan(n), from, to);
        if (part.matter == Matter::Air) {
            part.matter = matter;
            part.face = face;
        } else {
            part.hasWall = true;
            part.wall = face;
        }
        if (matter == Matter::Wall) break;
    }
    return part;
}

// The face at the first of the edges.
SideReader::Face SideReader::faceOf(std::span<const std::uint32_t> crossed, double from, double to) const {
    const SeenEdge& edge = edges_[crossed.front()];
    Face face{edge.depthAt(from), edge.depthAt(to), std::abs(edge.slope()) > kOblique, 0, kNoLabel};
    face.room = roomBehind(crossed, 0.5 * (from + to), face.thickness);
    return face;
}

// The first room behind a face that is wide enough; `crossed` begins with the face.
std::uint32_t SideReader::roomBehind(std::span<const std::uint32_t> crossed, double at, double& thickness) const {
    const double face = edges_[crossed.front()].depthAt(at);
    for (std::size_t n = 1; n + 1 < crossed.size();) {
        const SeenEdge& edge = edges_[crossed[n]];
        const double depth = edge.depthAt(at);
        if (depth - face > kThickestFace) break;
        if (edge.isPane) {  // a pane in a wall, or at its inner side
            ++n;
            continue;
        }
        // The stretch up to the next wall; furniture does not end it.
        std::size_t end = n;
        std::uint32_t room = hasSpaces_ ? kInWall : kOpenRoom;
        for (; end < crossed.size() && (edges_[crossed[end]].isPane || !isSolid(edges_[crossed[end]].behind)); ++end)
            if (room == kInWall && matterOf(edges_[crossed[end]].behind) == Matter::Space)
                room = edges_[crossed[end]].behind;
        const std::size_t last = room == kInWall ? n : endOfRoom(crossed, n, end, room);
        if (last > n && last < crossed.size() && edges_[crossed[last]].depthAt(at) - depth >= kNarrowestRoom) {
            thickness = depth - face;
            return room;
        }
        end = std::max(end, n + 1);
        n = end;
    }
    return kInWall;
}

// Where a room ends that lies between the edges `first` and `end`: at the next wall. Windows without a body leave a gap
// in the wall: there, a space ends at its own border.
std::size_t SideReader::endOfRoom(std::span<const std::uint32_t> crossed, std::size_t first, std::size_t end,
                                  std::uint32_t room) const noexcept {
    if (end < crossed.size() || room == kOpenRoom) return end;
    std::size_t last = first;
    for (std::size_t n = first; n < crossed.size(); ++n)
        if (edges_[crossed[n]].behind == room) last = n + 1;
    return last;
}

// Whether a narrow part continues in its neighbours, so that together they are wide enough.
bool SideReader::isPiece(std::size_t n) const noexcept {
    const auto goesOn = [&](const SeenPart& other) {
        return other.matter == parts_[n].matter && other.face.room == parts_[n].face.room;
    };
    double from = stops_[n], to = stops_[n + 1];
    for (std::size_t m = n; m > 0 && goesOn(parts_[m - 1]) && to - from < kShortestPart; --m) from = stops_[m - 1];
    for (std::size_t m = n + 1; m < parts_.size() && goesOn(parts_[m]) && to - from < kShortestPart; ++m)
        to = stops_[m + 1];
    return to - from >= kShortestPart;
}

template <class IsStop>
std::vector<double> SideReader::stopsWhere(const IsStop& isStop) const {
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

}  // namespace svt::drawing
