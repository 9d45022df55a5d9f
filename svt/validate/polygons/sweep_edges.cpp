#include <svt/validate/polygons/sweep_edges.hpp>

#include <algorithm>
#include <functional>
#include <iterator>
#include <set>

namespace svt::validate {
namespace {

// An end of an edge, where the sweep stops. Points are swept by u, those of one u by v.
struct Stop {
    Point2 at;
    bool isStart;
    std::uint32_t edge;
};

class EdgeSweep {
public:
    explicit EdgeSweep(const std::vector<FlatEdge>& edges)
        : active_([this](std::uint32_t e, std::uint32_t f) { return isBelow(e, f); }), places_(edges.size()) {
        edges_.reserve(edges.size());
        for (const FlatEdge& edge : edges) edges_.push_back({std::min(edge[0], edge[1]), std::max(edge[0], edge[1])});
    }

    bool findsMeeting() {
        std::vector<Stop> stops;
        stops.reserve(2 * edges_.size());
        for (std::uint32_t e = 0; e < edges_.size(); ++e) {
            if (edges_[e][0] == edges_[e][1]) return true;
            stops.push_back({edges_[e][0], true, e});
            stops.push_back({edges_[e][1], false, e});
        }
        // Edges end before others start in the same place.
        std::sort(stops.begin(), stops.end(), [](const Stop& a, const Stop& b) {
            if (a.at != b.at) return a.at < b.at;
            return a.isStart != b.isStart ? b.isStart : a.edge < b.edge;
        });
        for (std::size_t i = 0; i + 2 < stops.size(); ++i)
            if (stops[i].at == stops[i + 2].at) return true;
        return std::any_of(stops.begin(), stops.end(), [this](const Stop& stop) {
            return (stop.isStart ? start(stop.edge) : end(stop.edge)) || hasMet_;
        });
    }

private:
    using Active = std::set<std::uint32_t, std::function<bool(std::uint32_t, std::uint32_t)>>;

    // Of two edges that the sweep line cuts: the one that started earlier tells on which side the other starts, or where
    // both start in one place, on which side it goes on.
    bool isBelow(std::uint32_t e, std::uint32_t f) {
        if (e == f) return false;
        const bool isEarlier = edges_[e][0] <= edges_[f][0];
        const auto &earlier = edges_[isEarlier ? e : f], &later = edges_[isEarlier ? f : e];
        int side = turn(earlier[0], earlier[1], later[0]);
        if (side == 0) side = turn(earlier[0], earlier[1], later[1]);
        if (side == 0) hasMet_ = true;  // they lie on each other
        return isEarlier ? side > 0 : side < 0;
    }

    [[nodiscard]] bool meetsBeyondEnd(std::uint32_t e, std::uint32_t f) const {
        const auto &a = edges_[e], &b = edges_[f];
        const bool sharesEnd = a[0] == b[0] || a[1] == b[1] || a[0] == b[1] || a[1] == b[0];
        if (!sharesEnd) return meet(a[0], a[1], b[0], b[1]) != Meeting::None;
        return turn(a[0], a[1], b[0]) == 0 && turn(a[0], a[1], b[1]) == 0 && (a[0] == b[0] || a[1] == b[1]);
    }

    bool start(std::uint32_t edge) {
        const auto [place, isNew] = active_.insert(edge);
        if (!isNew) return true;
        places_[edge] = place;
        if (place != active_.begin() && meetsBeyondEnd(*std::prev(place), edge)) return true;
        const auto above = std::next(place);
        return above != active_.end() && meetsBeyondEnd(edge, *above);
    }

    bool end(std::uint32_t edge) {
        const auto above = active_.erase(places_[edge]);
        return above != active_.begin() && above != active_.end() && meetsBeyondEnd(*std::prev(above), *above);
    }

    std::vector<FlatEdge> edges_;  // each from its lower end
    bool hasMet_ = false;
    Active active_;  // bottom up along the sweep line
    std::vector<Active::iterator> places_;
};

}  // namespace

bool meetBeyondEnds(const std::vector<FlatEdge>& edges) { return EdgeSweep(edges).findsMeeting(); }

}  // namespace svt::validate
