#include <apps/cli/check/check_reports.hpp>
#include <apps/cli/check/other_findings.hpp>

#include <svt/core/text.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace svt::cli {
namespace {

using validate::Finding;

constexpr std::size_t kMaxPictures = 50;
constexpr std::size_t kMaxEdges = 6000;   // in one picture
constexpr std::size_t kMaxAround = 3000;  // lines of the building around the defect; a building with more is not drawn
constexpr double kSide = 360;             // side of a picture, pixels

struct FlatPoint {
    double u = 0, v = 0;
};
using FlatLine = std::array<FlatPoint, 2>;

// A parallel projection from the south-west and above: u to the right, v downwards.
FlatPoint flat(Vec3d p) {
    constexpr double kCos = 0.8660254037844386, kSin = 0.5;
    return {(p.x - p.y) * kCos, (p.x + p.y) * -kSin * 0.6 - p.z};
}

void addEdges(const model::BuildingModel& model, const model::SurfaceUse& use, Vec3d origin,
              std::vector<FlatLine>& lines) {
    const model::Polygon& polygon = model.polygons[use.polygon];
    std::size_t begin = 0;
    for (const std::uint32_t end : polygon.ringEnds) {
        for (std::size_t i = begin; i < end && lines.size() < kMaxEdges; ++i)
            lines.push_back(
                {flat(polygon.points[i] - origin), flat(polygon.points[i + 1 == end ? begin : i + 1] - origin)});
        begin = end;
    }
}

std::vector<FlatLine> edgesOf(const model::BuildingModel& model, const model::Geometry& geometry, Vec3d origin) {
    std::vector<FlatLine> lines;
    for (const model::SurfaceUse& use : geometry.surfaces) addEdges(model, use, origin, lines);
    for (const model::Solid& solid : geometry.solids) {
        for (const model::SurfaceUse& use : solid.exterior) addEdges(model, use, origin, lines);
        for (const auto& shell : solid.interiors)
            for (const model::SurfaceUse& use : shell) addEdges(model, use, origin, lines);
    }
    return lines;
}

// Edges of all features of the same level of detail below the topmost one that holds `feature`, such as the building
// of a wall; empty if there are too many.
std::vector<FlatLine> edgesAround(const model::BuildingModel& model, const Finding& finding, double lod, Vec3d origin) {
    std::vector<FlatLine> lines;
    std::vector<model::FeatureIndex> open{rootOf(model, finding.feature)};
    while (!open.empty()) {
        const model::Feature& feature = model.features[open.back()];
        open.pop_back();
        for (const model::Geometry& geometry : feature.geometries) {
            if (geometry.lod != lod) continue;
            const std::vector<FlatLine> edges = edgesOf(model, geometry, origin);
            lines.insert(lines.end(), edges.begin(), edges.end());
            if (lines.size() > kMaxAround) return {};
        }
        open.insert(open.end(), feature.children.begin(), feature.children.end());
    }
    return lines;
}

struct Window {
    FlatPoint low{kInfinity, kInfinity}, high{-kInfinity, -kInfinity};
    void add(FlatPoint p) {
        low = {std::min(low.u, p.u), std::min(low.v, p.v)};
        high = {std::max(high.u, p.u), std::max(high.v, p.v)};
    }
    [[nodiscard]] double size() const { return std::max(high.u - low.u, high.v - low.v); }
};

// Pixels of a picture that shows a square window.
class Picture {
public:
    Picture(FlatPoint center, double size) : center_(center), scale_(kSide / std::max(size, 1e-6)) {}

    void add(const std::vector<FlatLine>& lines, std::string_view className) {
        std::string path;
        for (const FlatLine& line : lines) {
            const FlatPoint a = pixel(line[0]), b = pixel(line[1]);
            constexpr double kFar = 20 * kSide;  // lines farther outside are dropped
            if (std::max({std::abs(a.u), std::abs(a.v), std::abs(b.u), std::abs(b.v)}) > kFar) continue;
            path += fmt::format("M{:.1f} {:.1f}L{:.1f} {:.1f}", a.u, a.v, b.u, b.v);
        }
        if (!path.empty()) text_ += fmt::format("<path class=\"{}\" d=\"{}\"/>", className, path);
    }
    void addRing(FlatPoint at) {
        const FlatPoint p = pixel(at);
        text_ += fmt::format("<circle class=\"at\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"9\"/>", p.u, p.v);
    }
    [[nodiscard]] std::string svg(std::string_view title) const {
        return fmt::format(
            "<svg viewBox=\"0 0 {0:.0f} {0:.0f}\" width=\"{0:.0f}\" height=\"{0:.0f}\" "
            "role=\"img\"><title>{1}</title>{2}</svg>",
            kSide, xmlAttribute(title), text_);
    }

private:
    [[nodiscard]] FlatPoint pixel(FlatPoint p) const {
        return {(p.u - center_.u) * scale_ + kSide / 2, (p.v - center_.v) * scale_ + kSide / 2};
    }
    FlatPoint center_;
    double scale_;
    std::string text_;
};

// The defect in its building, and a close-up. Without a geometry, only the building is drawn.
std::string picturesOf(const model::BuildingModel& model, const Finding& finding, double lod) {
    const model::Feature& feature = model.features[finding.feature];
    const Vec3d origin{std::floor(finding.at.x), std::floor(finding.at.y), std::floor(finding.at.z)};
    const std::vector<FlatLine> edges =
        finding.geometry < 0 ? std::vector<FlatLine>()
                             : edgesOf(model, feature.geometries[static_cast<std::size_t>(finding.geometry)], origin);
    const std::vector<FlatLine> around = edgesAround(model, finding, lod, origin);
    std::vector<FlatLine> marks;
    Window whole, near;
    const FlatPoint at = flat(finding.at - origin);
    for (const auto* lines : {&around, &edges})
        for (const FlatLine& line : *lines)
            for (const FlatPoint p : line) whole.add(p);
    near.add(at);
    for (const auto& mark : finding.marks) {
        marks.push_back({flat(mark[0] - origin), flat(mark[1] - origin)});
        for (const FlatPoint p : marks.back()) {
            whole.add(p);
            near.add(p);
        }
    }
    whole.add(at);
    const auto middle = [](const Window& w) { return FlatPoint{(w.low.u + w.high.u) / 2, (w.low.v + w.high.v) / 2}; };
    Picture far(middle(whole), whole.size() * 1.12);
    far.add(around, "around");
    far.add(edges, "edge");
    far.add(marks, "mark");
    far.addRing(at);
    // A close-up of a mark as large as the whole would show nothing more; then the close-up is around the place itself.
    const bool isSmall = near.size() < 0.5 * whole.size() && near.size() > 0;
    const double size = isSmall ? std::max(near.size() * 1.6, 0.002 * whole.size()) : 0.1 * whole.size();
    Picture close(isSmall ? middle(near) : at, size);
    close.add(edges, "edge");
    close.add(marks, "mark");
    close.addRing(at);
    return far.svg("whole feature") + fmt::format("<figure>{}<figcaption>{:.3g} m wide</figcaption></figure>",
                                                  close.svg("close-up of the defect"), size);
}

constexpr std::string_view kHead = R"(<!doctype html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width">
<title>svt check</title><style>
body{font:15px/1.5 system-ui,sans-serif;color:#1b1f24;max-width:62rem;margin:2rem auto;padding:0 1rem}
h1{font-size:1.6rem}h2{font-size:1.2rem;margin-top:2.2rem;border-bottom:1px solid #d5dae0}
table{border-collapse:collapse;margin:.6rem 0}td,th{text-align:left;padding:.2rem .9rem .2rem 0;border-bottom:1px solid #e6e9ed}
td.n{text-align:right;font-variant-numeric:tabular-nums}code{font-family:ui-monospace,monospace;font-size:.92em}
section{margin:1.2rem 0;break-inside:avoid}section p{margin:.2rem 0}.p{display:flex;gap:1rem;flex-wrap:wrap}
svg{border:1px solid #d5dae0;background:#fbfcfd}figure{margin:0}figcaption{color:#5b6570;font-size:.85em}
.around{fill:none;stroke:#c3cad3;stroke-width:.8}.edge{fill:none;stroke:#4d5763;stroke-width:1}.mark{fill:none;stroke:#d1242f;stroke-width:2.4}
.at{fill:none;stroke:#d1242f;stroke-width:2}.ok{color:#1a7f37}.bad{color:#d1242f}
</style></head><body>
)";

std::string countsTable(std::string_view title, const std::map<std::string, validate::ValidCount>& counts) {
    std::string text = fmt::format("<table><tr><th>{}</th><th>tested</th><th>valid</th></tr>", title);
    for (const auto& [name, count] : counts)
        text += fmt::format("<tr><td>{}</td><td class=\"n\">{}</td><td class=\"n\">{}</td></tr>", xmlAttribute(name),
                            count.total, count.valid);
    return text + "</table>\n";
}

std::string findingSection(const model::BuildingModel& model, const Finding& finding, bool hasPicture) {
    const model::Feature& feature = model.features[finding.feature];
    std::string text = fmt::format("<section><p><b>{}</b></p><p>{} <code>{}</code>", xmlAttribute(finding.message),
                                   xmlAttribute(feature.className), xmlAttribute(feature.id));
    if (finding.polygon != validate::kNoPolygon)
        text += fmt::format(", polygon <code>{}</code>", xmlAttribute(polygonName(model, finding)));
    text += fmt::format(", at {:.3f} {:.3f} {:.3f}</p>", finding.at.x, finding.at.y, finding.at.z);
    if (hasPicture && finding.geometry >= 0)
        text += "<div class=\"p\">" +
                picturesOf(model, finding, feature.geometries[static_cast<std::size_t>(finding.geometry)].lod) +
                "</div>";
    return text + "</section>\n";
}

// The leaks of a shell and the caps that close them; empty if the finding has no mesh, or a mesh without leaks.
std::string pictureOfLeak(const Checked& checked, const OtherFinding& other) {
    const Code code = other.item->code;
    if (code != Code::ShellCapped && code != Code::WindingFilled && code != Code::FacesComplemented) return {};
    const auto& objects = checked.meshes.objects;
    const auto object = std::find_if(objects.begin(), objects.end(),
                                     [&](const mesh::ObjectMesh& mesh) { return mesh.feature == other.feature; });
    if (object == objects.end() || object->leaks.empty()) return {};
    Finding shown;
    shown.feature = other.feature;
    shown.at = object->leaks.front() + checked.meshes.origin;
    const auto& geometries = checked.model.features[other.feature].geometries;
    for (std::size_t g = 0; g < geometries.size(); ++g)
        if (geometries[g].lod == object->lod && !object->isAssembled) shown.geometry = static_cast<int>(g);
    for (const mesh::Cap& cap : object->caps)
        for (std::size_t i = 0; i < cap.ring.size(); ++i)
            shown.marks.push_back(
                {cap.ring[i] + checked.meshes.origin, cap.ring[(i + 1) % cap.ring.size()] + checked.meshes.origin});
    return "<div class=\"p\">" + picturesOf(checked.model, shown, object->lod) + "</div>";
}

std::string otherSection(const Checked& checked, const OtherFinding& other, bool hasPicture) {
    const Place& where = other.item->where;
    std::string text = fmt::format("<section><p><b>{}</b></p><p>", xmlAttribute(other.item->message));
    if (other.feature != model::kNoFeature) text += xmlAttribute(checked.model.features[other.feature].className) + " ";
    if (!where.id.empty()) text += fmt::format("<code>{}</code>, ", xmlAttribute(where.id));
    text +=
        where.line == 0 ? xmlAttribute(where.file) : fmt::format("{}, line {}", xmlAttribute(where.file), where.line);
    text += "</p>";
    if (hasPicture && other.feature != model::kNoFeature) text += pictureOfLeak(checked, other);
    return text + "</section>\n";
}

// All findings of one code, from the tests, from readers and from closing.
struct Kind {
    std::size_t tested = 0;
    std::vector<OtherFinding> others;
    std::size_t otherCount = 0;  // of `others`, and of further findings that are only counted
};

std::map<Code, Kind> kindsOf(const Checked& checked, const std::vector<OtherFinding>& others) {
    std::map<Code, Kind> kinds;
    for (const auto& [code, count] : checked.report.counts) kinds[code].tested = count;
    for (const OtherFinding& other : others) kinds[other.item->code].others.push_back(other);
    for (auto& [code, kind] : kinds) {
        kind.otherCount = kind.others.size();
        if (kind.otherCount >= Diagnostics::kKeptPerCode) kind.otherCount = checked.others.count(code);
    }
    return kinds;
}

std::string kindsTable(const std::map<Code, Kind>& kinds) {
    std::string text =
        "<h2>By kind</h2><table><tr><th>code</th><th>name</th><th>prevents use</th><th>val3dity</th><th>ISO 19107</th>"
        "<th>tests</th><th>reading, closing</th></tr>";
    for (const auto& [code, kind] : kinds) {
        const int number = validate::val3dityCode(code);
        text += fmt::format(
            "<tr><td><a href=\"#{0}\">{0}</a></td><td>{1}</td><td>{2}</td><td>{3}</td><td>{4}</td>"
            "<td class=\"n\">{5}</td><td class=\"n\">{6}</td></tr>",
            codeTag(code), codeName(code), validate::preventsUse(code) ? "yes" : "no",
            number == 0 ? std::string() : std::to_string(number), xmlAttribute(validate::isoTerm(code)), kind.tested,
            kind.otherCount);
    }
    return text + "</table>\n";
}

// The number of findings per building, most first.
std::string placesTable(const Checked& checked, const std::vector<OtherFinding>& others) {
    constexpr std::size_t kMostPlaces = 100;
    std::map<model::FeatureIndex, std::map<Code, std::size_t>> places;
    for (const Finding& finding : checked.report.findings)
        ++places[rootOf(checked.model, finding.feature)][finding.code];
    for (const OtherFinding& other : others)
        ++places[other.feature == model::kNoFeature ? model::kNoFeature : rootOf(checked.model, other.feature)]
                [other.item->code];
    struct Row {
        std::size_t count;
        model::FeatureIndex feature;
        std::string codes;
    };
    std::vector<Row> rows;
    for (const auto& [feature, counts] : places) {
        Row row{0, feature, {}};
        for (const auto& [code, count] : counts) {
            row.count += count;
            row.codes += fmt::format("{}{} {}", row.codes.empty() ? "" : ", ", count, codeTag(code));
        }
        rows.push_back(std::move(row));
    }
    std::stable_sort(rows.begin(), rows.end(), [](const Row& p, const Row& q) { return p.count > q.count; });
    std::string text = "<h2>By place</h2><table><tr><th>feature</th><th>id</th><th>count</th><th>codes</th></tr>";
    for (std::size_t r = 0; r < std::min(rows.size(), kMostPlaces); ++r) {
        const bool isKnown = rows[r].feature != model::kNoFeature;
        text += fmt::format(
            "<tr><td>{}</td><td><code>{}</code></td><td class=\"n\">{}</td><td>{}</td></tr>",
            isKnown ? xmlAttribute(checked.model.features[rows[r].feature].className) : "the file as a whole",
            isKnown ? xmlAttribute(checked.model.features[rows[r].feature].id) : "", rows[r].count, rows[r].codes);
    }
    text += "</table>\n";
    if (rows.size() > kMostPlaces)
        text += fmt::format("<p>{} more features have fewer findings.</p>\n", rows.size() - kMostPlaces);
    return text;
}

// A chapter per kind. Each kind gets a share of the pictures, so that a frequent kind does not take them all.
std::string chapters(const Checked& checked, const std::map<Code, Kind>& kinds) {
    const std::size_t each = kinds.empty() ? 0 : std::max<std::size_t>(1, kMaxPictures / kinds.size());
    std::string text;
    std::size_t pictures = 0;
    for (const auto& [code, kind] : kinds) {
        text += fmt::format("<h2 id=\"{0}\">{0} {1}</h2>\n", codeTag(code), codeName(code));
        std::size_t ofKind = 0;
        const auto takesPicture = [&] {
            const bool takes = ofKind++ < each && pictures < kMaxPictures;
            pictures += takes;
            return takes;
        };
        for (const Finding& finding : checked.report.findings)
            if (finding.code == code) text += findingSection(checked.model, finding, takesPicture());
        for (const OtherFinding& other : kind.others) text += otherSection(checked, other, takesPicture());
        const std::size_t all = kind.tested + kind.otherCount;
        if (ofKind < all) text += fmt::format("<p>{} more findings are counted, but not listed.</p>\n", all - ofKind);
    }
    return text;
}

}  // namespace

std::string htmlReport(const Checked& checked, const std::string& inputFile) {
    const validate::ValidationReport& report = checked.report;
    const std::vector<OtherFinding> others = otherFindings(checked.model, checked.others);
    const std::map<Code, Kind> kinds = kindsOf(checked, others);
    const bool isValid = report.counts.empty();
    std::string text(kHead);
    text += fmt::format("<h1>{}</h1>\n<p>{}{}</p>\n", xmlAttribute(inputFile),
                        isValid ? "<b class=\"ok\">Every geometry is valid.</b>"
                                : "<b class=\"bad\">Some geometries are not valid.</b>",
                        others.empty() ? "" : " <b class=\"bad\">Reading or closing found defects.</b>");
    text += fmt::format(
        "<p>{} polygons tested; points closer than {} m count as one, polygons may deviate by {} m and {} "
        "degrees.</p>\n",
        report.polygonCount, checked.options.snap, checked.options.planarity, checked.options.normalsDegrees);
    text += countsTable("features", report.features) + countsTable("geometries", report.primitives);
    if (!kinds.empty()) text += kindsTable(kinds) + placesTable(checked, others) + chapters(checked, kinds);
    return text + "</body></html>\n";
}

}  // namespace svt::cli
