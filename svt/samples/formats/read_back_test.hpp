#pragma once
/// \file
/// Reads the generated files with an independent parser, so that the tests do not depend on the writers: shells of
/// polygons by feature id, with XLinks and reversed surfaces resolved.

#include <svt/core/vec.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace svt::samples::test {

using Ring = std::vector<Vec3d>;
using Rings = std::vector<Ring>;      ///< of one polygon
using Polygons = std::vector<Rings>;  ///< of one shell

struct ReadBack {
    std::map<std::string, std::vector<Polygons>> shells;  ///< by feature id
    std::set<std::string> ids;
    std::vector<std::string> dangling;  ///< references without target
};

/// Number of edges without an opposite edge.
inline std::size_t openEdges(const Polygons& shell) {
    std::map<std::pair<Vec3d, Vec3d>, int> edges;
    for (const Rings& polygon : shell)
        for (const Ring& ring : polygon)
            for (std::size_t i = 0; i < ring.size(); ++i) {
                const Vec3d p = ring[i], q = ring[(i + 1) % ring.size()];
                ++edges[{p, q}];
                --edges[{q, p}];
            }
    std::size_t open = 0;
    for (const auto& [edge, balance] : edges) open += balance != 0 ? 1 : 0;
    return open;
}

/// Signed volume, positive where the faces look outwards.
inline double volumeOf(const Polygons& shell) {
    const Vec3d origin = shell.front().front().front();
    double volume = 0;
    for (const Rings& polygon : shell)
        for (const Ring& ring : polygon)
            for (std::size_t i = 1; i + 1 < ring.size(); ++i)
                volume += dot(ring[0] - origin, cross(ring[i] - origin, ring[i + 1] - origin)) / 6;
    return volume;
}

/// Largest distance of a vertex from the plane of its polygon.
inline double unevenness(const Polygons& shell) {
    double worst = 0;
    for (const Rings& polygon : shell) {
        Vec3d sum;
        const Vec3d o = polygon.front().front();
        for (const Ring& ring : polygon)
            for (std::size_t i = 1; i + 1 < ring.size(); ++i)
                sum = sum + cross(ring[i] - ring[0], ring[i + 1] - ring[0]);
        const Vec3d normal = normalized(sum);
        for (const Ring& ring : polygon)
            for (const Vec3d p : ring) worst = std::max(worst, std::abs(dot(normal, p - o)));
    }
    return worst;
}

/// A scanner for the GML of the samples; not a general XML reader.
class GmlScanner {
public:
    explicit GmlScanner(std::string_view text) : text_(text) { scan(); }

    ReadBack result() {
        for (const std::string& href : hrefs_)
            if (read_.ids.count(href) == 0) read_.dangling.push_back(href);
        for (auto& [owner, members] : members_) {
            Polygons shell;
            for (const auto& [id, isReversed] : members) append(id, isReversed, shell, 0);
            read_.shells[owner.first].push_back(std::move(shell));
        }
        return std::move(read_);
    }

private:
    struct Element {
        std::string name, id;
    };

    static std::string attribute(std::string_view tag, std::string_view name) {
        const std::size_t start = tag.find(name);
        if (start == std::string_view::npos) return {};
        const std::size_t from = start + name.size() + 2;  // behind ="
        return std::string(tag.substr(from, tag.find('"', from) - from));
    }

    void scan() {
        std::size_t at = 0;
        while ((at = text_.find('<', at)) != std::string_view::npos) {
            const std::size_t end = text_.find('>', at);
            const std::string_view tag = text_.substr(at + 1, end - at - 1);
            at = end + 1;
            if (tag.front() == '?') continue;
            if (tag.front() == '/') {
                close();
                continue;
            }
            open(tag, text_.substr(at, text_.find('<', at) - at));
            if (tag.back() == '/') close();
        }
    }

    [[nodiscard]] bool isInside(std::string_view name) const {
        for (const Element& element : stack_)
            if (element.name == name) return true;
        return false;
    }

    // The feature that the geometry belongs to, and the index of the solid.
    [[nodiscard]] std::pair<std::string, int> owner() const {
        static const std::set<std::string> features{"bldg:Building",
                                                    "bldg:BuildingPart",
                                                    "bldg:BuildingRoom",
                                                    "bldg:Room",
                                                    "bldg:BuildingConstructiveElement",
                                                    "bldg:BuildingInstallation",
                                                    "bldg:IntBuildingInstallation",
                                                    "bldg:BuildingFurniture",
                                                    "bldg:BuildingUnit",
                                                    "con:Door",
                                                    "con:Window",
                                                    "bldg:Door",
                                                    "bldg:Window"};
        for (auto element = stack_.rbegin(); element != stack_.rend(); ++element)
            if (features.count(element->name) != 0) return {element->id, solid_};
        return {};
    }

    void open(std::string_view tag, std::string_view content) {
        const std::size_t nameEnd = std::min(tag.find(' '), tag.find('/'));
        Element element{std::string(tag.substr(0, nameEnd)), attribute(tag, "gml:id")};
        const std::string href = attribute(tag, "xlink:href");
        if (!element.id.empty() && !read_.ids.insert(element.id).second)
            read_.dangling.push_back("twice: " + element.id);
        if (!href.empty()) hrefs_.push_back(href.substr(1));
        if (element.name == "gml:Solid") ++solid_;
        // In CityGML 2.0 the surfaces of a door or window enclose its solid.
        const bool isOpening =
            stack_.size() > 1 && element.name == "gml:MultiSurface" &&
            (stack_[stack_.size() - 2].name == "bldg:Door" || stack_[stack_.size() - 2].name == "bldg:Window");
        if (isOpening) ++solid_;
        stack_.push_back(element);
        const bool isInSolid = isInside("gml:Solid") || isInside("bldg:Door") || isInside("bldg:Window");
        if (element.name == "gml:surfaceMember" && !href.empty() && isInSolid && !isInside("gml:OrientableSurface"))
            members_[owner()].push_back({href.substr(1), false});
        if (element.name == "gml:OrientableSurface" && isInSolid) members_[owner()].push_back({element.id, false});
        if (element.name == "gml:baseSurface") bases_[stack_[stack_.size() - 2].id] = href.substr(1);
        if (element.name == "gml:Polygon") {
            if (element.id.empty()) stack_.back().id = "unnamed" + std::to_string(polygons_.size());
            polygon_ = &polygons_[stack_.back().id];
            if (isInSolid) members_[owner()].push_back({stack_.back().id, false});
        }
        if (element.name == "app:target") hrefs_.emplace_back(content.substr(1));
        if (element.name == "gml:posList") polygon_->push_back(positions(content));
    }

    static Ring positions(std::string_view content) {
        const std::string text(content);
        std::vector<double> values;
        const char* at = text.c_str();
        for (char* next = nullptr;; at = next) {
            const double value = std::strtod(at, &next);
            if (next == at) break;
            values.push_back(value);
        }
        Ring ring;
        for (std::size_t i = 0; i + 5 < values.size(); i += 3)
            ring.push_back({values[i], values[i + 1], values[i + 2]});
        return ring;
    }

    void close() { stack_.pop_back(); }

    void append(const std::string& id, bool isReversed, Polygons& shell, int depth) {
        const auto base = bases_.find(id);
        if (base != bases_.end() && depth < 8) return append(base->second, !isReversed, shell, depth + 1);
        const auto polygon = polygons_.find(id);
        if (polygon == polygons_.end()) {
            read_.dangling.push_back(id);
            return;
        }
        Rings rings = polygon->second;
        if (isReversed)
            for (Ring& ring : rings) ring = Ring(ring.rbegin(), ring.rend());
        shell.push_back(std::move(rings));
    }

    std::string_view text_;
    std::vector<Element> stack_;
    int solid_ = 0;
    ReadBack read_;
    std::vector<std::string> hrefs_;
    std::map<std::string, Rings> polygons_;
    Rings* polygon_ = nullptr;
    std::map<std::string, std::string> bases_;
    std::map<std::pair<std::string, int>, std::vector<std::pair<std::string, bool>>> members_;
};

inline ReadBack readGml(std::string_view text) { return GmlScanner(text).result(); }

/// CityJSON: coordinates relative to the translation, in metres.
inline ReadBack readCityJson(const nlohmann::json& file) {
    ReadBack read;
    const double scale = file["transform"]["scale"][0];
    const auto vertex = [&](const nlohmann::json& index) {
        const nlohmann::json& v = file["vertices"].at(index.get<std::size_t>());
        return Vec3d{v[0].get<double>() * scale, v[1].get<double>() * scale, v[2].get<double>() * scale};
    };
    const auto shell = [](const nlohmann::json& faces, const auto& point) {
        Polygons polygons;
        for (const auto& face : faces) {
            Rings& rings = polygons.emplace_back();
            for (const auto& indices : face) {
                Ring& ring = rings.emplace_back();
                for (const auto& index : indices) ring.push_back(point(index));
            }
        }
        return polygons;
    };
    for (const auto& [id, object] : file["CityObjects"].items()) {
        read.ids.insert(id);
        for (const char* member : {"parents", "children"})
            for (const auto& other : object.value(member, nlohmann::json::array()))
                if (!file["CityObjects"].contains(other)) read.dangling.push_back(other);
        for (const auto& geometry : object.value("geometry", nlohmann::json::array())) {
            if (geometry["type"] == "Solid") read.shells[id].push_back(shell(geometry["boundaries"][0], vertex));
            if (geometry["type"] == "CompositeSolid")
                for (const auto& solid : geometry["boundaries"]) read.shells[id].push_back(shell(solid[0], vertex));
            if (geometry["type"] != "GeometryInstance") continue;
            const auto& templates = file["geometry-templates"];
            const auto& m = geometry["transformationMatrix"];
            const Vec3d anchor = vertex(geometry["boundaries"][0]);
            const auto placed = [&](const nlohmann::json& index) {
                const auto& p = templates["vertices-templates"].at(index.get<std::size_t>());
                const auto row = [&](std::size_t r) {
                    return m[r].get<double>() * p[0].get<double>() + m[r + 1].get<double>() * p[1].get<double>() +
                           m[r + 2].get<double>() * p[2].get<double>() + m[r + 3].get<double>();
                };
                return anchor + Vec3d{row(0), row(4), row(8)};
            };
            const auto& shape = templates["templates"].at(geometry["template"].get<std::size_t>());
            read.shells[id].push_back(shell(shape["boundaries"][0], placed));
        }
    }
    return read;
}

}  // namespace svt::samples::test
