#include <svt/illustrate/scene/region.hpp>

#include <svt/analyze/selection.hpp>
#include <svt/core/text.hpp>
#include <svt/drawing/section_plane.hpp>
#include <svt/drawing/storey_floors.hpp>
#include <svt/illustrate/scene.hpp>
#include <svt/illustrate/scene/cutaway.hpp>
#include <svt/plane/point.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

namespace svt::illustrate {
namespace {

// Bodies of one cutaway(); a pass has room for more parts beside them.
constexpr std::size_t kMostCutaways = 16;

using render::ConvexPart;
using render::HalfSpace;
using render::RoundBody;
using Parts = std::vector<ConvexPart>;

constexpr int kMaxDepth = 32;
constexpr std::size_t kMostNumbers = 256;  // of a primitive

using plane::twiceArea;

// Triangulates a simple, counter-clockwise polygon by ear clipping; empty if an ear is missing: it is not simple.
std::vector<std::vector<Vec3d>> triangles(std::vector<Vec3d> polygon) {
    std::vector<std::vector<Vec3d>> result;
    while (polygon.size() > 3) {
        const std::size_t n = polygon.size();
        std::size_t ear = n;
        for (std::size_t i = 0; i < n && ear == n; ++i) {
            const Vec3d a = polygon[(i + n - 1) % n], b = polygon[i], c = polygon[(i + 1) % n];
            if (!(twiceArea(a, b, c) > 0)) continue;
            const bool isFree = std::none_of(polygon.begin(), polygon.end(), [&](Vec3d p) {
                return p != a && p != b && p != c && twiceArea(a, b, p) >= 0 && twiceArea(b, c, p) >= 0 &&
                       twiceArea(c, a, p) >= 0;
            });
            if (isFree) ear = i;
        }
        if (ear == n) return {};
        result.push_back({polygon[(ear + n - 1) % n], polygon[ear], polygon[(ear + 1) % n]});
        polygon.erase(polygon.begin() + static_cast<std::ptrdiff_t>(ear));
    }
    result.push_back(polygon);
    return result;
}

bool isConvex(const std::vector<Vec3d>& polygon) {
    const std::size_t n = polygon.size();
    for (std::size_t i = 0; i < n; ++i)
        if (!(twiceArea(polygon[i], polygon[(i + 1) % n], polygon[(i + 2) % n]) > 0)) return false;
    return true;
}

class RegionParser {
public:
    RegionParser(std::string_view text, const RegionContext& context) : text_(text), context_(context) {}

    Result<Parts> parse() {
        auto region = parseOr(0);
        if (!region) return region;
        skipBlanks();
        if (at_ < text_.size()) return wrong("expected 'and', 'or' or the end");
        for (const ConvexPart& part : *region)
            if (part.halfSpaces.size() + part.rounds.size() > ConvexPart::kMaxFaces)
                return Error(Code::BadSection,
                             fmt::format("the region '{}' is too complex: a part has {} faces, up to {} are possible",
                                         text_, part.halfSpaces.size() + part.rounds.size(), ConvexPart::kMaxFaces));
        return region;
    }

private:
    [[nodiscard]] Error wrong(const std::string& reason) const {
        return Error(Code::BadSection,
                     fmt::format("the region '{}', column {}: {}, found {}", text_, at_ + 1, reason,
                                 at_ < text_.size() ? fmt::format("'{}'", text_.substr(at_, 20)) : "the end"));
    }
    [[nodiscard]] Error bad(std::string_view primitive, const std::string& reason) const {
        return Error(Code::BadSection, fmt::format("the region '{}': {}: {}", text_, primitive, reason));
    }

    void skipBlanks() {
        while (at_ < text_.size() && isBlank(text_[at_])) ++at_;
    }
    bool takeKeyword(std::string_view keyword) {
        skipBlanks();
        const std::size_t end = at_ + keyword.size();
        if (lowerAscii(text_.substr(at_, keyword.size())) != keyword) return false;
        if (end < text_.size() && !isBlank(text_[end]) && text_[end] != '(') return false;
        at_ = end;
        return true;
    }

    Result<Parts> parseOr(int depth) {
        auto region = parseAnd(depth);
        while (region && takeKeyword("or")) {
            auto other = parseAnd(depth);
            if (!other) return other;
            region->insert(region->end(), other->begin(), other->end());
            SVT_DO(checkCount(*region));
        }
        return region;
    }

    Result<Parts> parseAnd(int depth) {
        auto region = parseNot(depth);
        while (region && takeKeyword("and")) {
            auto other = parseNot(depth);
            if (!other) return other;
            region = both(*region, *other);
        }
        return region;
    }

    Result<Parts> parseNot(int depth) {
        if (depth > kMaxDepth) return wrong("too deeply nested");
        if (takeKeyword("not")) {
            const auto region = parseNot(depth + 1);
            return region ? inverse(*region) : region;
        }
        skipBlanks();
        if (at_ < text_.size() && text_[at_] == '(') {
            ++at_;
            auto region = parseOr(depth + 1);
            if (!region) return region;
            skipBlanks();
            if (at_ == text_.size() || text_[at_] != ')') return wrong("expected ')'");
            ++at_;
            return region;
        }
        return parsePrimitive();
    }

    Result<void> checkCount(const Parts& parts) const {
        if (parts.size() <= render::Pass::kMaxClipParts) return {};
        return Error(Code::BadSection, fmt::format("the region '{}' is too complex: it has more than {} convex parts",
                                                   text_, render::Pass::kMaxClipParts));
    }

    Result<Parts> both(const Parts& a, const Parts& b) const {
        Parts result;
        for (const ConvexPart& p : a)
            for (const ConvexPart& q : b) {
                ConvexPart joined = p;
                joined.halfSpaces.insert(joined.halfSpaces.end(), q.halfSpaces.begin(), q.halfSpaces.end());
                joined.rounds.insert(joined.rounds.end(), q.rounds.begin(), q.rounds.end());
                result.push_back(std::move(joined));
                SVT_DO(checkCount(result));
            }
        return result;
    }

    // Complement of a union of parts: the intersection over the parts of the union of their inverted half-spaces.
    Result<Parts> inverse(const Parts& parts) const {
        Result<Parts> result = Parts{ConvexPart{}};
        for (const ConvexPart& part : parts) {
            if (!part.rounds.empty())
                return Error(Code::BadSection,
                             fmt::format("the region '{}': 'not' of something round is not possible; keep or cut "
                                         "away its inside instead",
                                         text_));
            Parts beyond;
            for (const HalfSpace& half : part.halfSpaces) beyond.push_back({{{-half.normal, -half.offset}}, {}});
            result = both(*result, beyond);
            if (!result) return result;
        }
        return result;
    }

    Result<Parts> parsePrimitive() {
        const std::size_t begin = at_;
        while (at_ < text_.size() && isLetter(text_[at_])) ++at_;
        const std::string name = lowerAscii(text_.substr(begin, at_ - begin));
        if (at_ == text_.size() || text_[at_] != '(' || name.empty()) {
            at_ = begin;
            return parsePlane();
        }
        ++at_;
        SVT_TRY(arguments, takeArguments());
        if (name == "box") return makeBox(*arguments);
        if (name == "ball") return makeBall(*arguments);
        if (name == "cylinder") return makeCylinder(*arguments);
        if (name == "prism") return makePrism(*arguments);
        if (name == "storey") return makeStorey(*arguments);
        if (name == "around") return makeAround(*arguments);
        if (name == "view") return makeView(*arguments);
        if (name == "cutaway") return makeCutaway(*arguments);
        at_ = begin;
        return wrong("expected a plane such as z>1.2, or box, ball, cylinder, prism, storey, around, view or cutaway");
    }

    // A plane ends at the next blank or closing bracket; a storey's name may be quoted.
    Result<Parts> parsePlane() {
        const std::size_t begin = at_;
        std::string plane;
        char quote = 0;
        for (; at_ < text_.size(); ++at_) {
            const char c = text_[at_];
            if (quote == 0 && (c == '"' || c == '\'')) {
                quote = c;
            } else if (quote != 0 && c == quote) {
                quote = 0;
            } else if (quote == 0 && (isBlank(c) || c == ')')) {
                break;
            } else {
                plane += c;
            }
        }
        if (begin == at_) return wrong("expected a region such as z>1.2 or box(0,0,0,1,1,1)");
        SVT_TRY(parsed, drawing::parseSectionPlane(plane, context_.volume, context_.rows));
        const double hair = drawing::hairOffFaces(*parsed, context_.volume);
        if (hair != 0 && context_.moved != nullptr) context_.moved->push_back({plane, hair});
        return Parts{{{{parsed->normal, hair - dot(parsed->normal, parsed->point)}}, {}}};
    }

    // The text up to the matching closing bracket; moves behind it.
    Result<std::string> takeArguments() {
        const std::size_t begin = at_;
        char quote = 0;
        int open = 1;
        for (; at_ < text_.size(); ++at_) {
            const char c = text_[at_];
            if (quote != 0) {
                if (c == '\\')
                    ++at_;
                else if (c == quote)
                    quote = 0;
            } else if (c == '"' || c == '\'') {
                quote = c;
            } else if (c == '(') {
                ++open;
            } else if (c == ')' && --open == 0) {
                return std::string(text_.substr(begin, at_++ - begin));
            }
        }
        at_ = text_.size();
        return wrong("expected ')'");
    }

    Result<std::vector<double>> numbersOf(std::string_view name, const std::string& text, std::size_t count,
                                          const char* expected) const {
        auto numbers = parseNumbers(text, kMostNumbers);
        if (!numbers || numbers->size() != count)
            return bad(name, fmt::format("expected {}, found '{}'", expected, text));
        return std::move(*numbers);
    }

    [[nodiscard]] const volume::Grid& grid() const { return context_.volume.grid; }
    [[nodiscard]] Vec3d worldDirection(Vec3d d) const {
        return grid().axes()[0] * d.x + grid().axes()[1] * d.y + grid().axes()[2] * d.z;
    }
    [[nodiscard]] Vec3d world(Vec3d p) const { return grid().origin() + worldDirection(p); }
    [[nodiscard]] Parts boxOf(Vec3d low, Vec3d high) const {
        return {render::boxPart(grid().origin(), grid().axes(), low, high)};
    }

    Result<Parts> makeBox(const std::string& text) const {
        SVT_TRY(n, numbersOf("box", text, 6, "x0,y0,z0,x1,y1,z1"));
        const Vec3d low{std::min((*n)[0], (*n)[3]), std::min((*n)[1], (*n)[4]), std::min((*n)[2], (*n)[5])};
        const Vec3d high{std::max((*n)[0], (*n)[3]), std::max((*n)[1], (*n)[4]), std::max((*n)[2], (*n)[5])};
        if (!(low.x < high.x && low.y < high.y && low.z < high.z)) return bad("box", "has no inside");
        return boxOf(low, high);
    }

    Result<Parts> makeBall(const std::string& text) const {
        SVT_TRY(n, numbersOf("ball", text, 4, "x,y,z,r"));
        if (!((*n)[3] > 0)) return bad("ball", fmt::format("a radius of {} m; it must be greater than 0", (*n)[3]));
        return Parts{{{}, {RoundBody::ball(world({(*n)[0], (*n)[1], (*n)[2]}), (*n)[3])}}};
    }

    Result<Parts> makeCylinder(const std::string& text) const {
        SVT_TRY(n, numbersOf("cylinder", text, 7, "x,y,z,dx,dy,dz,r"));
        const Vec3d axis = worldDirection({(*n)[3], (*n)[4], (*n)[5]});
        if (!((*n)[6] > 0)) return bad("cylinder", fmt::format("a radius of {} m; it must be greater than 0", (*n)[6]));
        if (!(length(axis) > 0)) return bad("cylinder", "its axis is zero");
        return Parts{{{}, {RoundBody::cylinder(world({(*n)[0], (*n)[1], (*n)[2]}), axis, (*n)[6])}}};
    }

    Result<Parts> makePrism(const std::string& text) const {
        const std::size_t semicolon = text.find(';');
        const char* const expected = "x1,y1,x2,y2,x3,y3,...;z0,z1";
        const auto plan = parseNumbers(std::string_view(text).substr(0, semicolon), kMostNumbers);
        if (semicolon == std::string::npos || !plan || plan->size() < 6 || plan->size() % 2 != 0)
            return bad("prism", fmt::format("expected {}, found '{}'", expected, text));
        SVT_TRY(heights, numbersOf("prism", text.substr(semicolon + 1), 2, expected));
        const double low = std::min((*heights)[0], (*heights)[1]), high = std::max((*heights)[0], (*heights)[1]);
        if (!(low < high)) return bad("prism", "has no height");
        std::vector<Vec3d> polygon;
        for (std::size_t i = 0; i < plan->size(); i += 2) polygon.push_back({(*plan)[i], (*plan)[i + 1], 0});
        double area = 0;
        for (std::size_t i = 0; i < polygon.size(); ++i)
            area += twiceArea({}, polygon[i], polygon[(i + 1) % polygon.size()]);
        if (area < 0) std::reverse(polygon.begin(), polygon.end());
        const bool isOne = isConvex(polygon) && polygon.size() + 2 <= ConvexPart::kMaxFaces;
        const auto pieces = isOne ? std::vector<std::vector<Vec3d>>{polygon} : triangles(polygon);
        if (pieces.empty() || area == 0) return bad("prism", "its polygon crosses itself or has no area");
        Parts parts;
        for (const auto& piece : pieces) {
            ConvexPart part;
            const auto add = [&](Vec3d normal, Vec3d point) {
                const Vec3d n = worldDirection(normal);
                part.halfSpaces.push_back({n, -dot(n, world(point))});
            };
            for (std::size_t i = 0; i < piece.size(); ++i) {
                const Vec3d a = piece[i], b = piece[(i + 1) % piece.size()];
                add(normalized({a.y - b.y, b.x - a.x, 0}), a);
            }
            add({0, 0, 1}, {0, 0, low});
            add({0, 0, -1}, {0, 0, high});
            parts.push_back(std::move(part));
        }
        SVT_DO(checkCount(parts));
        return parts;
    }

    Result<Parts> makeStorey(const std::string& text) const {
        std::string name = text;
        if (name.size() >= 2 && (name.front() == '"' || name.front() == '\'') && name.back() == name.front())
            name = name.substr(1, name.size() - 2);
        SVT_TRY(heights, drawing::storeyVoxels(name, context_.volume, context_.rows));
        const Vec3d spacing = grid().spacing();
        const auto reach = [&](int axis) { return grid().dimension()[axis] * spacing[axis]; };
        return boxOf({-reach(0), -reach(1), heights->first}, {2 * reach(0), 2 * reach(1), heights->second});
    }

    // A region without points, beside the grid: there is nothing to be around.
    [[nodiscard]] Parts nowhere() const { return boxOf({-1, -1, -1}, {-1, -1, -1}); }

    // Labels of each feature that a query selects, and the margin in metres after the last semicolon.
    Result<std::pair<std::vector<std::vector<std::uint32_t>>, double>> selectionOf(std::string_view name,
                                                                                   const std::string& text) const {
        const std::size_t semicolon = text.rfind(';');
        double margin = 0;
        if (semicolon != std::string::npos) {
            const auto numbers = parseNumbers(std::string_view(text).substr(semicolon + 1), kMostNumbers);
            if (!numbers || numbers->size() != 1 || (*numbers)[0] < 0)
                return bad(name, fmt::format("expected a margin in metres behind ';', found '{}'",
                                             text.substr(semicolon + 1)));
            margin = (*numbers)[0];
        }
        SVT_TRY(selected, analyze::selectLabels(context_.rows, text.substr(0, semicolon)));
        return std::pair(context_.rows.extents().wholes(*selected), margin);
    }

    // The box of each feature with voxels.
    Result<std::vector<analyze::SampleBox>> boxesOf(const std::vector<std::vector<std::uint32_t>>& features,
                                                    std::string_view name) const {
        const auto boxOfLabel = analyze::labelBoxes(context_.volume.columns, context_.volume.labels);
        std::vector<analyze::SampleBox> boxes;
        for (const std::vector<std::uint32_t>& feature : features) {
            analyze::SampleBox box;
            for (const std::uint32_t label : feature) box.add(boxOfLabel[label]);
            if (!box.isEmpty()) boxes.push_back(box);
        }
        if (boxes.empty()) return Error(Code::NothingSelected, fmt::format("{} has no voxels", name));
        return boxes;
    }

    Result<Parts> makeAround(const std::string& text) const {
        SVT_TRY(selection, selectionOf("around", text));
        if (selection->first.empty()) return nowhere();
        SVT_TRY(targets, boxesOf(selection->first, "the selection of around()"));
        analyze::SampleBox box;
        for (const analyze::SampleBox& target : *targets) box.add(target);
        Vec3d low, high;
        for (int axis = 0; axis < 3; ++axis) {
            low[axis] = (box.min[axis] - 0.5) * grid().spacing()[axis] - selection->second;
            high[axis] = (box.max[axis] + 0.5) * grid().spacing()[axis] + selection->second;
        }
        return boxOf(low, high);
    }

    Result<Parts> makeView(const std::string& text) const {
        SVT_TRY(n, numbersOf("view", text, 3, "x,y,r (shares of the picture)"));
        if (!((*n)[2] > 0)) return bad("view", fmt::format("a radius of {}; it must be greater than 0", (*n)[2]));
        return Parts{{{}, {viewBody(context_.camera, context_.aspect, (*n)[0], (*n)[1], (*n)[2])}}};
    }

    Result<Parts> makeCutaway(const std::string& text) const {
        SVT_TRY(selection, selectionOf("cutaway", text));
        if (selection->first.empty()) return nowhere();
        SVT_TRY(targets, boxesOf(selection->first, "the selection of cutaway()"));
        return cutawayParts(context_.camera, grid(), std::move(*targets), selection->second, kMostCutaways);
    }

    std::string_view text_;
    const RegionContext& context_;
    std::size_t at_ = 0;
};

}  // namespace

Result<std::vector<ConvexPart>> parseRegion(std::string_view text, const RegionContext& context) {
    return RegionParser(text, context).parse();
}

bool dependsOnView(std::string_view region) {
    const std::string text = lowerAscii(region);
    return text.find("view") != std::string::npos || text.find("cutaway") != std::string::npos;
}

std::vector<MovedPlane> planesInFaces(const Scene& scene, const volume::SemanticVolume& volume) {
    const analyze::LabelRows rows(volume);
    std::vector<MovedPlane> moved;
    // Drawing reports other errors of a region.
    for (const ScenePass& pass : scene.passes)
        for (const std::string& region : {pass.cut, pass.keep})
            if (!region.empty()) (void)parseRegion(region, {volume, rows, {}, 1, &moved});
    std::vector<MovedPlane> once;
    for (MovedPlane& plane : moved)
        if (std::none_of(once.begin(), once.end(), [&](const MovedPlane& other) { return other.text == plane.text; }))
            once.push_back(std::move(plane));
    return once;
}

}  // namespace svt::illustrate
