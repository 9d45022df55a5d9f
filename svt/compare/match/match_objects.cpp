#include <svt/compare/match/match_objects.hpp>

#include <svt/core/hash.hpp>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <tuple>
#include <unordered_map>

namespace svt::compare {
namespace {

constexpr std::uint32_t kNone = 0xFFFFFFFFu;
constexpr std::size_t kMostCandidates = 64;    // of one object at one place
constexpr std::size_t kMostPairs = 1'000'000;  // of objects that are alike and elsewhere
constexpr double kPartInWhole = 0.9;           // of a part's volume in the whole, and of the whole filled by parts
constexpr double kLeastShared = 0.25;          // common space per united space of two objects of one class
constexpr double kLeastSharedOfOtherClass = 0.9;
constexpr double kLeastSharedByBoxes = 0.4;  // likewise of their boxes, of two objects with one name

// Two shapes that may be one object.
struct Candidate {
    std::uint32_t was = 0, is = 0;
    double score = 0, distance = 0;  // the higher score first, then the smaller distance
};

// The common space of two shapes, in one unit for all three: m3 of meshes, or voxels.
struct Shared {
    std::uint32_t was = 0, is = 0;
    double common = 0, ofWas = 0, ofIs = 0;
    [[nodiscard]] double perUnion() const noexcept { return common / std::max(ofWas + ofIs - common, 1e-12); }
};

class Matcher {
public:
    Matcher(const Sides& sides, const CompareOptions& options, analyze::CommonSpaces& spaces,
            const VoxelOverlaps& voxels)
        : sides_(sides), options_(options), spaces_(spaces), voxels_(voxels) {
        isUsedOfWas_.resize(sides.wasShapes.size());
        isUsedOfIs_.resize(sides.isShapes.size());
        indexIds(sides.was, sides.wasShapes, byIdOfWas_);
        indexIds(sides.is, sides.isShapes, byIdOfIs_);
    }

    std::vector<Match> run() {
        matchPlaces();
        if (options_.match != MatchBy::Id) {
            findShared();
            matchWholes(true);
            matchWholes(false);
        }
        if (options_.match != MatchBy::Space) matchIds();
        if (options_.match != MatchBy::Id) {
            matchShared();
            matchNames();
            matchElsewhere();
        }
        for (std::uint32_t s = 0; s < isUsedOfWas_.size(); ++s)
            if (isUsedOfWas_[s] == 0) matches_.push_back({{s}, {}});
        for (std::uint32_t s = 0; s < isUsedOfIs_.size(); ++s)
            if (isUsedOfIs_[s] == 0) matches_.push_back({{}, {s}});
        return std::move(matches_);
    }

private:
    using Ids = std::unordered_map<std::string_view, std::uint32_t>;

    [[nodiscard]] const volume::Label& wasLabel(std::uint32_t s) const {
        return sides_.was.labels.labels[sides_.wasShapes[s].label];
    }
    [[nodiscard]] const volume::Label& isLabel(std::uint32_t s) const {
        return sides_.is.labels.labels[sides_.isShapes[s].label];
    }

    // Ids that occur twice say nothing.
    static void indexIds(const volume::SemanticVolume& volume, std::span<const Shape> shapes, Ids& ids) {
        for (std::uint32_t s = 0; s < shapes.size(); ++s) {
            const std::string& id = volume.labels.labels[shapes[s].label].id;
            if (id.empty()) continue;
            if (const auto [at, isNew] = ids.try_emplace(id, s); !isNew) at->second = kNone;
        }
    }
    static std::uint32_t find(const Ids& ids, const std::string& id) {
        const auto at = ids.find(id);
        return at == ids.end() ? kNone : at->second;
    }

    void use(std::uint32_t was, std::uint32_t is) {
        isUsedOfWas_[was] = isUsedOfIs_[is] = 1;
        matches_.push_back({{was}, {is}});
    }

    // Takes the candidates in order, each shape once.
    void takeBest(std::vector<Candidate>& candidates) {
        std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
            return std::tuple(-a.score, a.distance, a.was, a.is) < std::tuple(-b.score, b.distance, b.was, b.is);
        });
        for (const Candidate& candidate : candidates)
            if (isUsedOfWas_[candidate.was] == 0 && isUsedOfIs_[candidate.is] == 0) use(candidate.was, candidate.is);
    }

    // Whether ids say that both belong to other objects: one with the same id is alike, so it moved. Surfaces do not move
    // on their own, and exports number them anew.
    [[nodiscard]] bool belongElsewhere(std::uint32_t was, std::uint32_t is) const {
        if (!sides_.wasShapes[was].isSolid) return false;
        const std::uint32_t next = find(byIdOfIs_, wasLabel(was).id), before = find(byIdOfWas_, isLabel(is).id);
        const auto moved = [&](std::uint32_t a, std::uint32_t b) {
            return a != kNone && b != kNone && wasLabel(a).className == isLabel(b).className &&
                   areAlike(sides_.wasShapes[a], sides_.isShapes[b], options_.tolerance);
        };
        return (next != is && moved(was, next)) || (before != was && moved(before, is));
    }

    [[nodiscard]] bool mayBeOne(std::uint32_t was, std::uint32_t is) const {
        const bool haveOneId = wasLabel(was).id == isLabel(is).id;
        if (options_.match == MatchBy::Id && !haveOneId) return false;
        if (!areAtOnePlace(sides_.wasShapes[was], sides_.isShapes[is], options_.tolerance)) return false;
        return haveOneId || options_.match != MatchBy::Both || !belongElsewhere(was, is);
    }

    [[nodiscard]] Candidate candidateOf(std::uint32_t was, std::uint32_t is) const {
        const volume::Label &a = wasLabel(was), &b = isLabel(is);
        const double score = (options_.match != MatchBy::Space && a.id == b.id ? 4 : 0) +
                             (a.className == b.className ? 2 : 0) + (a.name == b.name ? 1 : 0);
        return {was, is, score, length(sides_.isShapes[is].center - sides_.wasShapes[was].center)};
    }

    void matchPlaces() {
        std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cells;
        const auto cellOf = [&](Vec3d center, int dx, int dy, int dz) {
            std::uint64_t hash = 1;
            const Vec3d cell = center / options_.tolerance;
            for (const double at : {std::floor(cell.x) + dx, std::floor(cell.y) + dy, std::floor(cell.z) + dz})
                hash = mixHash(hash, static_cast<std::uint64_t>(static_cast<std::int64_t>(at)));
            return hash;
        };
        for (std::uint32_t s = 0; s < sides_.isShapes.size(); ++s)
            cells[cellOf(sides_.isShapes[s].center, 0, 0, 0)].push_back(s);
        std::vector<Candidate> candidates;
        std::unordered_map<std::uint64_t, std::size_t> turns;  // equal objects begin at different candidates
        for (std::uint32_t was = 0; was < sides_.wasShapes.size(); ++was) {
            const Vec3d center = sides_.wasShapes[was].center;
            if (const std::uint32_t is = find(byIdOfIs_, wasLabel(was).id); is != kNone && mayBeOne(was, is))
                candidates.push_back(candidateOf(was, is));
            const std::size_t turn = turns[cellOf(center, 0, 0, 0)]++;
            std::size_t count = 0;
            for (int near = 0; near < 27; ++near) {
                const auto at = cells.find(cellOf(center, near % 3 - 1, near / 3 % 3 - 1, near / 9 - 1));
                if (at == cells.end()) continue;
                const std::vector<std::uint32_t>& there = at->second;
                for (std::size_t n = 0; n < there.size() && count < kMostCandidates; ++n)
                    if (const std::uint32_t is = there[(n + turn) % there.size()]; mayBeOne(was, is)) {
                        candidates.push_back(candidateOf(was, is));
                        ++count;
                    }
            }
        }
        takeBest(candidates);
    }

    static std::vector<std::uint32_t> unusedSolids(std::span<const Shape> shapes, const std::vector<char>& isUsed) {
        std::vector<std::uint32_t> labels;
        for (std::size_t s = 0; s < shapes.size(); ++s)
            if (isUsed[s] == 0 && shapes[s].isSolid) labels.push_back(shapes[s].label);
        return labels;
    }
    static std::uint32_t shapeOf(std::span<const Shape> shapes, std::uint32_t label) {
        const auto at = std::lower_bound(shapes.begin(), shapes.end(), label,
                                         [](const Shape& shape, std::uint32_t l) { return shape.label < l; });
        return static_cast<std::uint32_t>(at - shapes.begin());
    }

    // The common space of all pairs that are not matched yet.
    void findShared() {
        const auto ofWas = unusedSolids(sides_.wasShapes, isUsedOfWas_),
                   ofIs = unusedSolids(sides_.isShapes, isUsedOfIs_);
        for (const analyze::CommonSpace& common : spaces_.among(ofWas, ofIs)) {
            const std::uint32_t a = shapeOf(sides_.wasShapes, common.a), b = shapeOf(sides_.isShapes, common.b);
            shared_.push_back(
                {a, b, common.volume, sides_.wasShapes[a].volume.value_or(0), sides_.isShapes[b].volume.value_or(0)});
        }
        for (const VoxelOverlaps::Entry& entry : voxels_.entries()) {
            const std::uint32_t a = shapeOf(sides_.wasShapes, entry.was), b = shapeOf(sides_.isShapes, entry.is);
            const Shape &s = sides_.wasShapes[a], &t = sides_.isShapes[b];
            if (isUsedOfWas_[a] != 0 || isUsedOfIs_[b] != 0 || (s.isSolid && t.isSolid)) continue;
            shared_.push_back({a, b, double(entry.voxels), double(s.voxels), double(t.voxels)});
        }
    }

    // Whether a part goes on as an object of its own: the other state has its id and class in an object that is neither the
    // whole nor matched.
    [[nodiscard]] bool goesOn(const Shared& shared, bool isSplit) const {
        if (options_.match != MatchBy::Both) return false;
        const volume::Label& part = isSplit ? isLabel(shared.is) : wasLabel(shared.was);
        const std::uint32_t other = find(isSplit ? byIdOfWas_ : byIdOfIs_, part.id);
        if (other == kNone || other == (isSplit ? shared.was : shared.is)) return false;
        if ((isSplit ? isUsedOfWas_ : isUsedOfIs_)[other] != 0) return false;
        return (isSplit ? wasLabel(other) : isLabel(other)).className == part.className;
    }

    // Splits (an old whole, new parts), or merges.
    void matchWholes(bool isSplit) {
        std::unordered_map<std::uint32_t, std::vector<std::size_t>> partsOf;
        std::vector<std::uint32_t> wholes;
        for (std::size_t n = 0; n < shared_.size(); ++n) {
            const Shared& shared = shared_[n];
            if (shared.common < kPartInWhole * (isSplit ? shared.ofIs : shared.ofWas)) continue;
            if (wasLabel(shared.was).className != isLabel(shared.is).className || goesOn(shared, isSplit)) continue;
            const std::uint32_t whole = isSplit ? shared.was : shared.is;
            std::vector<std::size_t>& parts = partsOf[whole];
            if (parts.empty()) wholes.push_back(whole);
            parts.push_back(n);
        }
        std::sort(wholes.begin(), wholes.end());
        for (const std::uint32_t whole : wholes) takeWhole(whole, partsOf[whole], isSplit);
    }

    void takeWhole(std::uint32_t whole, const std::vector<std::size_t>& parts, bool isSplit) {
        double sum = 0, largest = 0, all = 0;
        Match match;
        (isSplit ? match.was : match.is).push_back(whole);
        for (const std::size_t n : parts) {
            const Shared& shared = shared_[n];
            if (isUsedOfWas_[shared.was] != 0 || isUsedOfIs_[shared.is] != 0) continue;
            all = isSplit ? shared.ofWas : shared.ofIs;
            sum += shared.common;
            largest = std::max(largest, shared.common);
            (isSplit ? match.is : match.was).push_back(isSplit ? shared.is : shared.was);
        }
        if ((isSplit ? match.is : match.was).size() < 2 || sum < kPartInWhole * all || sum > all / kPartInWhole ||
            largest >= kPartInWhole * all)
            return;
        for (const std::uint32_t s : match.was) isUsedOfWas_[s] = 1;
        for (const std::uint32_t s : match.is) isUsedOfIs_[s] = 1;
        matches_.push_back(std::move(match));
    }

    void matchIds() {
        for (std::uint32_t was = 0; was < sides_.wasShapes.size(); ++was) {
            if (isUsedOfWas_[was] != 0 || find(byIdOfWas_, wasLabel(was).id) != was) continue;
            const std::uint32_t is = find(byIdOfIs_, wasLabel(was).id);
            if (is == kNone || isUsedOfIs_[is] != 0) continue;
            const volume::Label &a = wasLabel(was), &b = isLabel(is);
            if (options_.match == MatchBy::Id || a.className == b.className || (!a.name.empty() && a.name == b.name) ||
                areAlike(sides_.wasShapes[was], sides_.isShapes[is], options_.tolerance))
                use(was, is);
        }
    }

    void matchShared() {
        std::vector<Candidate> candidates;
        for (const Shared& shared : shared_) {
            if (isUsedOfWas_[shared.was] != 0 || isUsedOfIs_[shared.is] != 0) continue;
            const bool isOneClass = wasLabel(shared.was).className == isLabel(shared.is).className;
            const double share = shared.perUnion();
            if (share >= (isOneClass ? kLeastShared : kLeastSharedOfOtherClass))
                candidates.push_back({shared.was, shared.is, isOneClass ? 1.0 : 0.0, -share});
        }
        takeBest(candidates);
    }

    // By name the shapes that are still open; kNone where several have it.
    static Ids openNames(const volume::SemanticVolume& volume, std::span<const Shape> shapes,
                         const std::vector<char>& isUsed) {
        Ids names;
        for (std::uint32_t s = 0; s < shapes.size(); ++s) {
            const std::string& name = volume.labels.labels[shapes[s].label].name;
            if (isUsed[s] != 0 || name.empty()) continue;
            if (const auto [at, isNew] = names.try_emplace(name, s); !isNew) at->second = kNone;
        }
        return names;
    }

    // Such as a window of one solid, and one of a frame and panes.
    void matchNames() {
        const Ids before = openNames(sides_.was, sides_.wasShapes, isUsedOfWas_),
                  after = openNames(sides_.is, sides_.isShapes, isUsedOfIs_);
        for (std::uint32_t was = 0; was < isUsedOfWas_.size(); ++was) {
            if (isUsedOfWas_[was] != 0 || find(before, wasLabel(was).name) != was) continue;
            const std::uint32_t is = find(after, wasLabel(was).name);
            if (is != kNone && sides_.wasShapes[was].isSolid && sides_.isShapes[is].isSolid &&
                sharedByBoxes(sides_.wasShapes[was].box, sides_.isShapes[is].box) >= kLeastSharedByBoxes)
                use(was, is);
        }
    }

    static double sharedByBoxes(const Box3d& a, const Box3d& b) noexcept {
        double common = 1, ofA = 1, ofB = 1;
        for (int axis = 0; axis < 3; ++axis) {
            common *= std::max(0.0, std::min(a.max[axis], b.max[axis]) - std::max(a.min[axis], b.min[axis]));
            ofA *= a.max[axis] - a.min[axis];
            ofB *= b.max[axis] - b.min[axis];
        }
        return common / std::max(ofA + ofB - common, 1e-12);
    }

    // Those of one class whose areas follow each other closely form a cluster.
    void matchElsewhere() {
        struct Member {
            std::string_view className;
            double area = 0;
            bool isOld = false;
            std::uint32_t shape = 0;
        };
        std::vector<Member> members;
        for (std::uint32_t s = 0; s < isUsedOfWas_.size(); ++s)
            if (isUsedOfWas_[s] == 0) members.push_back({wasLabel(s).className, sides_.wasShapes[s].area, true, s});
        for (std::uint32_t s = 0; s < isUsedOfIs_.size(); ++s)
            if (isUsedOfIs_[s] == 0) members.push_back({isLabel(s).className, sides_.isShapes[s].area, false, s});
        std::sort(members.begin(), members.end(), [](const Member& a, const Member& b) {
            return std::tie(a.className, a.area, a.isOld, a.shape) < std::tie(b.className, b.area, b.isOld, b.shape);
        });
        for (std::size_t begin = 0, end = 0; begin < members.size(); begin = end) {
            std::vector<std::uint32_t> was, is;
            for (end = begin; end < members.size(); ++end) {
                const Member& member = members[end];
                if (end > begin && (member.className != members[end - 1].className ||
                                    member.area > members[end - 1].area * (1 + 1e-3) + 1e-6))
                    break;
                (member.isOld ? was : is).push_back(member.shape);
            }
            matchCluster(was, is);
        }
    }

    void matchCluster(std::vector<std::uint32_t>& was, std::vector<std::uint32_t>& is) {
        if (was.size() * is.size() > kMostPairs) {
            matchInOrder(was, is);
            return;
        }
        std::vector<Candidate> moved, turned;
        for (const std::uint32_t s : was)
            for (const std::uint32_t t : is) {
                const Shape &a = sides_.wasShapes[s], &b = sides_.isShapes[t];
                if (areAlike(a, b, options_.tolerance))
                    moved.push_back(candidateOf(s, t));
                else if (length(a.center - b.center) <= length(a.box.size()) &&
                         areAlikeTurned(a, b, options_.tolerance))
                    turned.push_back(candidateOf(s, t));
            }
        takeBest(moved);
        takeBest(turned);
    }

    // Many equal objects: a translation keeps their order in space.
    void matchInOrder(std::vector<std::uint32_t>& was, std::vector<std::uint32_t>& is) {
        const auto sortByPlace = [&](std::vector<std::uint32_t>& shapes, std::span<const Shape> all) {
            std::sort(shapes.begin(), shapes.end(), [&](std::uint32_t s, std::uint32_t t) {
                return std::tie(all[s].center, s) < std::tie(all[t].center, t);
            });
        };
        sortByPlace(was, sides_.wasShapes);
        sortByPlace(is, sides_.isShapes);
        for (std::size_t n = 0; n < std::min(was.size(), is.size()); ++n)
            if (areAlike(sides_.wasShapes[was[n]], sides_.isShapes[is[n]], options_.tolerance)) use(was[n], is[n]);
    }

    Sides sides_;
    CompareOptions options_;
    analyze::CommonSpaces& spaces_;
    const VoxelOverlaps& voxels_;
    Ids byIdOfWas_, byIdOfIs_;
    std::vector<char> isUsedOfWas_, isUsedOfIs_;
    std::vector<Shared> shared_;
    std::vector<Match> matches_;
};

}  // namespace

std::vector<Match> matchObjects(const Sides& sides, const CompareOptions& options, analyze::CommonSpaces& spaces,
                                const VoxelOverlaps& voxels) {
    return Matcher(sides, options, spaces, voxels).run();
}

}  // namespace svt::compare
