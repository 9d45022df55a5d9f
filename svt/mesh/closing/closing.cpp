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

using FaceIndex = std::uint32_t;

struct Choice {
    model::PolygonIndex polygon;
    bool isReversed;
};

DirectedEdge undirected(const DirectedEdge& edge) { return std::minmax(edge.first, edge.second); }

// Adds the triangles of the chosen faces. A new vertex of the mesh is added to `pointIds`, too.
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

// Polygons with the same directed edges are one face: whichever of them is asked, the answer is the same.
struct FaceFinder::Edges {
    std::vector<std::vector<DirectedEdge>> ofFace;
    std::vector<std::vector<model::PolygonIndex>> polygonsOf;  // per face, ascending
    // Undirected edges (low, high) with faces, sorted: of each face the half of its edges that the fewest others have.
    // A face closes more edges than it opens only if more than half of its edges are missing, so one of these is. An
    // edge that very many faces share does not lead to each of them.
    std::vector<std::pair<DirectedEdge, FaceIndex>> sorted;
};

FaceFinder::FaceFinder(const LocalPolygons& polygons, const model::BuildingModel& model)
    : polygons_(polygons), edges_(std::make_unique<Edges>()) {
    std::map<std::vector<DirectedEdge>, FaceIndex> faceOf;
    for (model::PolygonIndex p = 0; p < model.polygons.size(); ++p) {
        if (polygons.trianglesOf(p).empty()) continue;
        std::vector<DirectedEdge> edges = ringEdges(polygons, model, p);
        std::sort(edges.begin(), edges.end());
        const auto [it, isNew] = faceOf.emplace(std::move(edges), static_cast<FaceIndex>(edges_->polygonsOf.size()));
        if (isNew) edges_->polygonsOf.emplace_back();
        edges_->polygonsOf[it->second].push_back(p);
    }
    edges_->ofFace.resize(faceOf.size());
    std::vector<DirectedEdge> all;  // undirected, one for each use by a face
    for (const auto& [edges, face] : faceOf) {
        edges_->ofFace[face] = edges;
        for (const DirectedEdge& edge : edges) all.push_back(undirected(edge));
    }
    std::sort(all.begin(), all.end());
    for (FaceIndex face = 0; face < edges_->ofFace.size(); ++face) {
        std::vector<std::pair<std::ptrdiff_t, DirectedEdge>> byUses;
        for (const DirectedEdge& edge : edges_->ofFace[face]) {
            const auto uses = std::equal_range(all.begin(), all.end(), undirected(edge));
            byUses.emplace_back(uses.second - uses.first, undirected(edge));
        }
        std::sort(byUses.begin(), byUses.end());
        byUses.resize((byUses.size() + 1) / 2);
        for (const auto& [uses, edge] : byUses) edges_->sorted.emplace_back(edge, face);
    }
    std::sort(edges_->sorted.begin(), edges_->sorted.end());
}

FaceFinder::~FaceFinder() = default;

// Greedy: takes the first polygon with a positive gain, until there is none. Only polygons with one of the edges that
// were open at the start count. A polygon that was rejected is asked again when one of its edges is needed more or
// less.
class FaceFinder::Chooser {
public:
    Chooser(const Edges& edges, const std::vector<model::PolygonIndex>& own, std::map<DirectedEdge, int> need)
        : edges_(edges), own_(own), need_(std::move(need)) {
        for (const auto& [edge, count] : need_) open_.push_back(undirected(edge));
        std::sort(open_.begin(), open_.end());
        open_.erase(std::unique(open_.begin(), open_.end()), open_.end());
    }

    std::vector<Choice> run() {
        for (const DirectedEdge& edge : open_) findFaces(edge);
        std::vector<Choice> chosen;
        while (!waiting_.empty()) {
            const auto [polygon, face] = *waiting_.begin();
            waiting_.erase(waiting_.begin());
            const std::vector<DirectedEdge>& edges = edges_.ofFace[face];
            const int gain = gainOf(edges, need_, false), reversedGain = gainOf(edges, need_, true);
            if (std::max(gain, reversedGain) <= 0) continue;
            const bool isReversed = reversedGain > gain;
            chosen.push_back({polygon, isReversed});
            next_[face] = polygonBehind(face, next_[face] + 1);
            for (const DirectedEdge& edge : edges) use(isReversed ? DirectedEdge{edge.second, edge.first} : edge);
        }
        return chosen;
    }

private:
    void use(const DirectedEdge& edge) {
        if (int& missing = need_[edge]; missing > 0)
            --missing;
        else
            ++need_[{edge.second, edge.first}];
        const DirectedEdge key = undirected(edge);
        findFaces(key);
        for (const FaceIndex face : users_[key]) wait(face);
    }

    // Makes the faces that have an edge among their rare ones candidates.
    void findFaces(const DirectedEdge& key) {
        auto it = std::lower_bound(edges_.sorted.begin(), edges_.sorted.end(), std::pair{key, FaceIndex{0}});
        for (; it != edges_.sorted.end() && it->first == key; ++it) {
            const FaceIndex face = it->second;
            if (next_.contains(face)) continue;
            const std::size_t first = next_[face] = polygonBehind(face, 0);
            const std::vector<DirectedEdge>& edges = edges_.ofFace[face];
            if (first == edges_.polygonsOf[face].size() ||
                std::none_of(edges.begin(), edges.end(), [&](const DirectedEdge& edge) {
                    return std::binary_search(open_.begin(), open_.end(), undirected(edge));
                }))
                continue;
            for (const DirectedEdge& edge : edges) users_[undirected(edge)].push_back(face);
            wait(face);
        }
    }

    // Index in polygonsOf of the first polygon from `from` on that the mesh does not have.
    [[nodiscard]] std::size_t polygonBehind(FaceIndex face, std::size_t from) const {
        const auto& polygons = edges_.polygonsOf[face];
        while (from < polygons.size() && std::binary_search(own_.begin(), own_.end(), polygons[from])) ++from;
        return from;
    }

    void wait(FaceIndex face) {
        const auto& polygons = edges_.polygonsOf[face];
        if (const std::size_t next = next_[face]; next < polygons.size()) waiting_.insert({polygons[next], face});
    }

    const Edges& edges_;
    const std::vector<model::PolygonIndex>& own_;
    std::map<DirectedEdge, int> need_;
    std::vector<DirectedEdge> open_;                        // undirected, ascending
    std::map<FaceIndex, std::size_t> next_;                 // per face seen: the polygon that is asked next
    std::map<DirectedEdge, std::vector<FaceIndex>> users_;  // undirected edge -> candidates
    std::set<std::pair<model::PolygonIndex, FaceIndex>> waiting_;
};

std::uint32_t FaceFinder::complement(ObjectMesh& mesh, std::vector<std::uint32_t>& pointIds,
                                     const std::vector<model::PolygonIndex>& own) const {
    std::map<DirectedEdge, int> need;  // directed edges that the missing faces must have, with multiplicity
    for (const OpenEdge& edge : mesh.openEdges) {
        const std::uint32_t from = pointIds[edge.from], to = pointIds[edge.to];
        if (from != kNoPoint && to != kNoPoint) ++need[{to, from}];
    }
    const std::vector<Choice> chosen = Chooser(*edges_, own, std::move(need)).run();
    if (chosen.empty()) return 0;
    addFaces(chosen, polygons_, mesh, pointIds);
    mesh.openEdges = findOpenEdges(mesh.triangles);
    return static_cast<std::uint32_t>(chosen.size());
}

}  // namespace svt::mesh
