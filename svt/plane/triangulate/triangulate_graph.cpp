#include <svt/plane/triangulate_graph.hpp>

#include <svt/plane/sweep.hpp>

namespace svt::plane {
namespace {

// Between two neighbouring edges that the sweeping line meets, the inside that has no triangles yet is bounded on its
// left by a chain of vertices, from the lower edge to the upper one. It bends to the right or is straight: where it
// bends to the left, triangles have been cut off.
//
//        \___ upper edge                  The vertex that was visited last is the rightmost of the chain. A new vertex
//         \                               between the two edges sees it, so the chain is parted there.
//          )  chain, rightmost at )
//         /___ lower edge
//
class GraphTriangulator {
public:
    explicit GraphTriangulator(const EdgeGraph& graph)
        : graph_(graph), chainOver_(graph.edges.size(), kNone), isInsideOver_(graph.edges.size(), 0) {}

    std::vector<std::array<std::uint32_t, 3>> run() {
        sweepEdges(
            static_cast<std::uint32_t>(graph_.edges.size()), [&](std::uint32_t edge) { return graph_.endsOf(edge); },
            [&](Point, Edges ending, Edges starting, std::uint32_t below) { visit(ending, starting, below); });
        return std::move(triangles_);
    }

private:
    using Edges = std::span<const std::uint32_t>;  // by number

    // A link of a chain.
    struct Link {
        std::uint32_t vertex, below, above;
    };
    struct Chain {
        std::uint32_t bottom, top, rightmost;  // links
    };

    [[nodiscard]] const Point& at(std::uint32_t vertex) const { return graph_.vertices[vertex].at; }
    [[nodiscard]] std::uint32_t vertexOf(std::uint32_t link) const { return links_[link].vertex; }

    void visit(Edges ending, Edges starting, std::uint32_t edgeBelow) {
        const std::uint32_t v =
            starting.empty() ? graph_.edges[ending.front()].right : graph_.edges[starting.front()].left;
        bool isInside = edgeBelow != kNone && isInsideOver_[edgeBelow] != 0;
        for (std::size_t i = 0; i + 1 < ending.size(); ++i)
            if (isInsideOver_[ending[i]] != 0) close(chainOver_[ending[i]], v);

        std::uint32_t upper = kNone;  // the chain of the inside over the last edge
        if (!ending.empty()) {
            if (isInside) extendTop(chainOver_[edgeBelow], v);
            if (isInsideOver_[ending.back()] != 0) extendBottom(upper = chainOver_[ending.back()], v);
        } else if (isInside) {
            upper = part(chainOver_[edgeBelow], v);
        }
        if (starting.empty() && isInside && upper != kNone) join(chainOver_[edgeBelow], upper);
        for (const std::uint32_t edge : starting) {
            isInside = !isInside;
            isInsideOver_[edge] = isInside ? 1 : 0;
            if (isInside) chainOver_[edge] = edge == starting.back() ? upper : startChain(v);
        }
    }

    std::uint32_t makeLink(std::uint32_t vertex, std::uint32_t below, std::uint32_t above) {
        const auto link = static_cast<std::uint32_t>(links_.size());
        links_.push_back({vertex, below, above});
        if (below != kNone) links_[below].above = link;
        if (above != kNone) links_[above].below = link;
        return link;
    }

    std::uint32_t startChain(std::uint32_t v) {
        const std::uint32_t link = makeLink(v, kNone, kNone);
        chains_.push_back({link, link, link});
        return static_cast<std::uint32_t>(chains_.size() - 1);
    }

    // Adds the end of the upper edge to the chain, and cuts off the triangles that it sees.
    void extendTop(std::uint32_t index, std::uint32_t v) {
        Chain& chain = chains_[index];
        while (chain.top != chain.bottom) {
            const std::uint32_t under = links_[chain.top].below;
            if (turn(at(vertexOf(under)), at(vertexOf(chain.top)), at(v)) >= 0) break;
            emit(v, vertexOf(chain.top), vertexOf(under));
            chain.top = under;
        }
        chain.top = chain.rightmost = makeLink(v, chain.top, kNone);
    }

    void extendBottom(std::uint32_t index, std::uint32_t v) {
        Chain& chain = chains_[index];
        while (chain.top != chain.bottom) {
            const std::uint32_t over = links_[chain.bottom].above;
            if (turn(at(vertexOf(chain.bottom)), at(vertexOf(over)), at(v)) >= 0) break;
            emit(v, vertexOf(over), vertexOf(chain.bottom));
            chain.bottom = over;
        }
        chain.bottom = chain.rightmost = makeLink(v, kNone, chain.bottom);
    }

    // Parts the chain at its rightmost vertex, which `v` between its edges sees. Returns the upper part.
    std::uint32_t part(std::uint32_t index, std::uint32_t v) {
        const Chain whole = chains_[index];
        const std::uint32_t over = links_[whole.rightmost].above;
        const std::uint32_t twin = makeLink(vertexOf(whole.rightmost), kNone, over);
        chains_.push_back({twin, over == kNone ? twin : whole.top, twin});
        const auto upper = static_cast<std::uint32_t>(chains_.size() - 1);
        links_[whole.rightmost].above = kNone;
        chains_[index].top = whole.rightmost;
        extendTop(index, v);
        extendBottom(upper, v);
        return upper;
    }

    // Joins two chains; both end at the vertex where the inside between them begins.
    void join(std::uint32_t index, std::uint32_t upper) {
        Chain& chain = chains_[index];
        const std::uint32_t over = links_[chains_[upper].bottom].above;
        if (over == kNone) return;
        links_[chain.top].above = over;
        links_[over].below = chain.top;
        chain.top = chains_[upper].top;
    }

    // Both edges end at `v`: it sees all of the chain. A part of the chain may lie on a line with `v`, at either end;
    // its vertices are joined to the first vertex off that line.
    void close(std::uint32_t index, std::uint32_t v) {
        std::vector<std::uint32_t>& ring = ring_;
        ring.clear();
        for (std::uint32_t link = chains_[index].bottom; link != kNone; link = links_[link].above)
            ring.push_back(vertexOf(link));
        std::size_t low = 0, high = ring.size() - 1;  // ring[0 .. low] and ring[high ..] lie on lines with v
        while (low + 1 < high && turn(at(ring[0]), at(ring[low + 1]), at(v)) == 0) ++low;
        while (high > low + 1 && turn(at(ring[high - 1]), at(ring.back()), at(v)) == 0) --high;
        for (std::size_t i = low; i > 0; --i) emit(ring[low + 1], ring[i], ring[i - 1]);
        if (low + 1 == high) {
            // One triangle is left, with vertices on up to two of its sides.
            std::uint32_t under = ring[low];
            if (low > 0) under = ring[0];
            for (std::size_t i = high; i + 1 < ring.size(); ++i) emit(under, ring[i + 1], ring[i]);
            emit(under, v, ring.back());
            return;
        }
        emit(v, ring[low + 1], ring[0]);
        for (std::size_t i = low + 1; i + 1 < high; ++i) emit(v, ring[i + 1], ring[i]);
        for (std::size_t i = high; i + 1 < ring.size(); ++i) emit(ring[high - 1], ring[i + 1], ring[i]);
        emit(ring[high - 1], v, ring.back());
    }

    void emit(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        triangles_.push_back({graph_.vertices[a].point, graph_.vertices[b].point, graph_.vertices[c].point});
    }

    const EdgeGraph& graph_;
    std::vector<Link> links_;
    std::vector<Chain> chains_;
    std::vector<std::uint32_t> chainOver_;    // per edge with inside over it
    std::vector<std::uint8_t> isInsideOver_;  // per edge
    std::vector<std::uint32_t> ring_;
    std::vector<std::array<std::uint32_t, 3>> triangles_;
};

}  // namespace

std::vector<std::array<std::uint32_t, 3>> triangulateInside(const EdgeGraph& graph) {
    return GraphTriangulator(graph).run();
}

}  // namespace svt::plane
