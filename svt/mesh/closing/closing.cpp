#include <svt/mesh/closing/closing.hpp>

#include <svt/mesh/polygons/edges.hpp>
#include <svt/mesh/polygons/triangulate.hpp>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace svt::mesh {
namespace {

using DirectedEdge = std::pair<std::uint32_t, std::uint32_t>;

// Directed edges of a polygon's rings in welded points.
std::vector<DirectedEdge> ringEdges(const LocalPolygons& polygons, const model::BuildingModel& model,
                                    model::PolygonIndex p) {
    std::vector<DirectedEdge> edges;
    std::uint32_t begin = 0;
    for (const std::uint32_t end : model.polygons[p].ringEnds) {
        for (std::uint32_t i = begin; i < end; ++i) {
            const std::uint32_t a = polygons.pointIds[polygons.firstPoint[p] + i];
            const std::uint32_t b = polygons.pointIds[polygons.firstPoint[p] + (i + 1 == end ? begin : i + 1)];
            if (a != b) edges.emplace_back(a, b);
        }
        begin = end;
    }
    return edges;
}

// Edges closed minus edges opened by adding a face with `edges`; `need` counts the missing directed edges.
int gainOf(const std::vector<DirectedEdge>& edges, const std::map<DirectedEdge, int>& need, bool isReversed) {
    int gain = 0;
    for (const auto& [a, b] : edges) {
        const auto found = need.find(isReversed ? DirectedEdge{b, a} : DirectedEdge{a, b});
        gain += found != need.end() && found->second > 0 ? 1 : -1;
    }
    return gain;
}

struct Choice {
    model::PolygonIndex polygon;
    bool isReversed;
};

// Greedy: takes the first candidate with a positive gain. A rejected candidate is tried again when the need of one of
// its edges has changed.
std::vector<Choice> chooseFaces(const std::vector<model::PolygonIndex>& candidates,
                                const std::vector<std::vector<DirectedEdge>>& edgesOf,
                                std::map<DirectedEdge, int> need) {
    std::map<DirectedEdge, std::vector<std::size_t>> users;  // undirected edge (low, high) -> candidates
    std::set<std::size_t> waiting;
    for (std::size_t c = 0; c < candidates.size(); ++c) {
        for (const auto& [a, b] : edgesOf[c]) users[std::minmax(a, b)].push_back(c);
        waiting.insert(waiting.end(), c);
    }
    std::vector<Choice> chosen;
    std::vector<std::uint8_t> isChosen(candidates.size(), 0);
    while (!waiting.empty()) {
        const std::size_t c = *waiting.begin();
        waiting.erase(waiting.begin());
        const int gain = gainOf(edgesOf[c], need, false), reversedGain = gainOf(edgesOf[c], need, true);
        if (std::max(gain, reversedGain) <= 0) continue;
        const bool isReversed = reversedGain > gain;
        chosen.push_back({candidates[c], isReversed});
        isChosen[c] = 1;
        for (const auto& [a, b] : edgesOf[c]) {
            const DirectedEdge used = isReversed ? DirectedEdge{b, a} : DirectedEdge{a, b};
            if (int& missing = need[used]; missing > 0)
                --missing;
            else
                ++need[{used.second, used.first}];
            for (const std::size_t user : users[std::minmax(a, b)])
                if (isChosen[user] == 0) waiting.insert(user);
        }
    }
    return chosen;
}

// Adds the triangles of the chosen faces; a vertex where the mesh has none yet joins `pointIds`, too.
void addFaces(const std::vector<Choice>& chosen, const LocalPolygons& polygons, ObjectMesh& mesh,
              std::vector<std::uint32_t>& pointIds) {
    std::map<std::uint32_t, std::uint32_t> vertexOfPoint;
    for (std::uint32_t v = 0; v < pointIds.size(); ++v)
        if (pointIds[v] != kNoPoint) vertexOfPoint.emplace(pointIds[v], v);
    for (const Choice& choice : chosen) {
        for (const auto& corners : polygons.trianglesOf(choice.polygon)) {
            Triangle triangle;
            for (std::size_t c = 0; c < 3; ++c) {
                const std::uint32_t point = polygons.pointIds[corners[c]];
                const auto [it, isNew] = vertexOfPoint.emplace(point, static_cast<std::uint32_t>(mesh.vertices.size()));
                if (isNew) {
                    mesh.vertices.push_back(polygons.points[corners[c]]);
                    pointIds.push_back(point);
                }
                triangle.corners[c] = it->second;
            }
            if (choice.isReversed) std::swap(triangle.corners[1], triangle.corners[2]);
            mesh.triangles.push_back(triangle);
        }
    }
}

}  // namespace

struct FaceFinder::Edges {
    std::vector<std::pair<DirectedEdge, model::PolygonIndex>> sorted;  // undirected key (low, high)
};

FaceFinder::FaceFinder(const LocalPolygons& polygons, const model::BuildingModel& model)
    : polygons_(polygons), model_(model), edges_(std::make_unique<Edges>()) {
    for (model::PolygonIndex p = 0; p < model.polygons.size(); ++p) {
        if (polygons.trianglesOf(p).empty()) continue;
        for (const auto& [a, b] : ringEdges(polygons, model, p)) edges_->sorted.push_back({std::minmax(a, b), p});
    }
    std::sort(edges_->sorted.begin(), edges_->sorted.end());
}

FaceFinder::~FaceFinder() = default;

std::uint32_t FaceFinder::complement(ObjectMesh& mesh, std::vector<std::uint32_t>& pointIds,
                                     const std::vector<model::PolygonIndex>& own) const {
    std::map<DirectedEdge, int> need;  // directed edges that the missing faces must have, with multiplicity
    std::vector<model::PolygonIndex> candidates;
    for (const OpenEdge& edge : mesh.openEdges) {
        const std::uint32_t from = pointIds[edge.from], to = pointIds[edge.to];
        if (from == kNoPoint || to == kNoPoint) continue;
        ++need[{to, from}];
        const DirectedEdge key = std::minmax(from, to);
        auto it =
            std::lower_bound(edges_->sorted.begin(), edges_->sorted.end(), std::pair{key, model::PolygonIndex{0}});
        for (; it != edges_->sorted.end() && it->first == key; ++it)
            if (!std::binary_search(own.begin(), own.end(), it->second)) candidates.push_back(it->second);
    }
    std::sort(candidates.begin(), candidates.end());
    candidates.erase(std::unique(candidates.begin(), candidates.end()), candidates.end());

    std::vector<std::vector<DirectedEdge>> edgesOf;
    for (const model::PolygonIndex candidate : candidates) edgesOf.push_back(ringEdges(polygons_, model_, candidate));
    const std::vector<Choice> chosen = chooseFaces(candidates, edgesOf, std::move(need));
    if (chosen.empty()) return 0;
    addFaces(chosen, polygons_, mesh, pointIds);
    mesh.openEdges = findOpenEdges(mesh.triangles);
    return static_cast<std::uint32_t>(chosen.size());
}

}  // namespace svt::mesh
