#include <svt/core/file.hpp>
#include <svt/writers/indoorgml/indoorgml_writer.hpp>
#include <svt/writers/volume_formats.hpp>

#include <svt/core/text.hpp>
#include <svt/writers/drawing/drawing_text.hpp>
#include <svt/writers/indoorgml/cell_plan.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <unordered_set>

namespace svt::writers {
namespace {

using indoor::Boundary;
using indoor::CellPlan;
using indoor::CellShape;
using volume::Label;

// Bytes that an address may not have, as %XX.
std::string uriText(std::string_view text) {
    std::string uri;
    for (const char c : text) {
        const bool isPlain = isLetter(c) || isDigit(c) || c == '-' || c == '.' || c == '_' || c == '~';
        if (isPlain)
            uri += c;
        else
            fmt::format_to(std::back_inserter(uri), "%{:02X}", static_cast<unsigned char>(c));
    }
    return uri;
}

class DocumentWriter {
public:
    DocumentWriter(const volume::SemanticVolume& volume, const CellPlan& plan) : volume_(volume), plan_(plan) {
        for (const indoor::Cell& cell : plan.cells) ids_.insert(cell.id);
        // The ids of cells are those of the model, all others keep clear of them.
        while (isTaken(prefix_)) prefix_ += '_';
    }

    std::string run() {
        head();
        out_ += "<core:primalSpaceFeatures>\n";
        open("core:PrimalSpaceFeatures", "primal");
        for (std::size_t c = 0; c < plan_.cells.size(); ++c) writeCell(c);
        for (std::size_t b = 0; b < plan_.boundaries.size(); ++b) writeBoundary(b);
        out_ += "</core:PrimalSpaceFeatures>\n</core:primalSpaceFeatures>\n";
        writeGraph();
        return std::move(out_ += "</core:IndoorFeatures>\n");
    }

private:
    [[nodiscard]] bool isTaken(const std::string& prefix) const {
        for (const std::string& id : ids_)
            if (id.starts_with(prefix)) return true;
        return false;
    }
    [[nodiscard]] std::string name(std::string_view what) const { return prefix_ + std::string(what); }
    template <class T>
    [[nodiscard]] std::string name(std::string_view what, T number) const {
        return fmt::format("{}{}-{}", prefix_, what, number);
    }

    void open(std::string_view element, std::string_view what) {
        out_ += fmt::format("<{} gml:id=\"{}\">\n", element, name(what));
    }
    void link(std::string_view element, const std::string& id) {
        out_ += fmt::format("<{} xlink:href=\"#{}\"/>\n", element, xmlAttribute(id));
    }
    void text(std::string_view element, std::string_view content) {
        out_ += fmt::format("<{0}>{1}</{0}>\n", element, xmlContent(content));
    }

    void place(Vec3d local) { out_ += vectorText(volume_.grid.origin() + local, 7); }

    void head() {
        out_ =
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
            "<core:IndoorFeatures xmlns:core=\"http://www.opengis.net/indoorgml/1.0/core\" "
            "xmlns:navi=\"http://www.opengis.net/indoorgml/1.0/navigation\" "
            "xmlns:gml=\"http://www.opengis.net/gml/3.2\" "
            "xmlns:xlink=\"http://www.w3.org/1999/xlink\" xmlns:xsi=\"http://www.w3.org/2001/XMLSchema-instance\" "
            "xsi:schemaLocation=\"http://www.opengis.net/indoorgml/1.0/core "
            "http://schemas.opengis.net/indoorgml/1.0/indoorgmlcore.xsd "
            "http://www.opengis.net/indoorgml/1.0/navigation "
            "http://schemas.opengis.net/indoorgml/1.0/indoorgmlnavi.xsd\"";
        out_ += fmt::format(" gml:id=\"{}\">\n", name("building"));
        if (!volume_.modelName.empty()) text("gml:name", volume_.modelName);
        Box3d box;
        for (const indoor::Cell& cell : plan_.cells)
            for (const Vec3d& p : cell.body.shell.points) box.add(p);
        // A projection to which the model was brought stands before the system that it came from.
        const std::string crs = volume_.crsName.substr(0, volume_.crsName.find(" ("));
        out_ += "<gml:boundedBy>\n<gml:Envelope";
        if (!crs.empty() && crs.find_first_of(" \t\r\n") == std::string::npos)
            out_ += fmt::format(" srsName=\"{}\"", xmlAttribute(crs));
        out_ += " srsDimension=\"3\">\n<gml:lowerCorner>";
        place(box.min);
        out_ += "</gml:lowerCorner>\n<gml:upperCorner>";
        place(box.max);
        out_ += "</gml:upperCorner>\n</gml:Envelope>\n</gml:boundedBy>\n";
    }

    void ring(std::string_view part, const std::vector<Vec3d>& points) {
        out_ += fmt::format("<gml:{}><gml:LinearRing><gml:posList>", part);
        for (const Vec3d& p : points) {
            place(p);
            out_ += ' ';
        }
        place(points.front());
        out_ += fmt::format("</gml:posList></gml:LinearRing></gml:{}>", part);
    }

    void shell(std::string_view part, const CellShape& shape, const std::string& id) {
        out_ += fmt::format("<gml:{}>\n<gml:Shell>\n", part);
        std::size_t number = 0;
        for (const indoor::FaceRings& rings : facesOf(shape)) {
            out_ += fmt::format("<gml:surfaceMember><gml:Polygon gml:id=\"{}-{}\">", id, ++number);
            for (std::size_t r = 0; r < rings.size(); ++r) {
                std::vector<Vec3d> points;
                for (const std::uint32_t p : rings[r]) points.push_back(shape.points[p]);
                ring(r == 0 ? "exterior" : "interior", points);
            }
            out_ += "</gml:Polygon></gml:surfaceMember>\n";
        }
        out_ += fmt::format("</gml:Shell>\n</gml:{}>\n", part);
    }

    void writeCell(std::size_t number) {
        const indoor::Cell& cell = plan_.cells[number];
        const Label& label = volume_.labels.labels[cell.label];
        const bool isNavigable = cell.kind != "CellSpace";
        const std::string element = (isNavigable ? "navi:" : "core:") + std::string(cell.kind);
        out_ += fmt::format("<core:cellSpaceMember>\n<{} gml:id=\"{}\">\n", element, xmlAttribute(cell.id));
        if (!cell.storey.empty()) {
            std::string storey = cell.storey;
            std::replace(storey.begin(), storey.end(), '"', '\'');
            text("gml:description", fmt::format("storey=\"{}\"", storey));
        }
        if (!label.name.empty()) text("gml:name", label.name);
        const std::string solid = name("solid", number + 1);
        out_ += fmt::format("<core:cellSpaceGeometry>\n<core:Geometry3D>\n<gml:Solid gml:id=\"{}\">\n", solid);
        shell("exterior", cell.body.shell, solid + "-face");
        for (std::size_t i = 0; i < cell.body.cavities.size(); ++i)
            shell("interior", cell.body.cavities[i], fmt::format("{}-cavity-{}-face", solid, i + 1));
        out_ += "</gml:Solid>\n</core:Geometry3D>\n</core:cellSpaceGeometry>\n";
        link("core:duality", name("state", number + 1));
        out_ += "<core:externalReference>\n";
        if (!volume_.source.empty()) text("core:informationSystem", uriText(volume_.source));
        out_ += "<core:externalObject>\n";
        text("core:name", label.id);
        out_ += "</core:externalObject>\n</core:externalReference>\n";
        for (const std::size_t boundary : cell.boundaries)
            link("core:partialboundedBy", name("boundary", boundary + 1));
        for (const std::string_view property : {"class", "function", "usage"}) {
            if (!isNavigable) break;
            std::string value = "unknown";
            for (const AttributeList& list : attributeLists(label.attributes))
                if (list.name == property) value = toText(list);
            text(fmt::format("navi:{}", property), value);
        }
        out_ += fmt::format("</{}>\n</core:cellSpaceMember>\n", element);
    }

    void writeBoundary(std::size_t number) {
        const Boundary& boundary = plan_.boundaries[number];
        const std::string id = name("boundary", number + 1);
        const bool isWay = boundary.transition != Boundary::kNone;
        const std::string element = isWay ? "navi:NavigableBoundary" : "core:CellSpaceBoundary";
        out_ += fmt::format("<core:cellSpaceBoundaryMember>\n<{} gml:id=\"{}\">\n", element, id);
        if (isWay) link("core:duality", name("transition", boundary.transition + 1));
        out_ += "<core:cellSpaceBoundaryGeometry>\n<core:geometry3D>\n";
        const bool isOne = boundary.pieces.size() == 1;
        if (!isOne) out_ += fmt::format("<gml:CompositeSurface gml:id=\"{}-surface\">\n", id);
        for (std::size_t i = 0; i < boundary.pieces.size(); ++i) {
            if (!isOne) out_ += "<gml:surfaceMember>";
            out_ += fmt::format("<gml:Polygon gml:id=\"{}-{}\">", id, i + 1);
            ring("exterior", boundary.pieces[i]);
            out_ += isOne ? "</gml:Polygon>\n" : "</gml:Polygon></gml:surfaceMember>\n";
        }
        if (!isOne) out_ += "</gml:CompositeSurface>\n";
        out_ += fmt::format(
            "</core:geometry3D>\n</core:cellSpaceBoundaryGeometry>\n</{}>\n</core:cellSpaceBoundaryMember>\n", element);
    }

    void writeGraph() {
        out_ += "<core:multiLayeredGraph>\n";
        open("core:MultiLayeredGraph", "graph");
        open("core:spaceLayers", "layers");
        out_ += "<core:spaceLayerMember>\n";
        open("core:SpaceLayer", "layer");
        text("core:class", "TOPOGRAPHIC");
        open("core:nodes", "nodes");
        for (std::size_t c = 0; c < plan_.cells.size(); ++c) writeState(c);
        out_ += "</core:nodes>\n";
        open("core:edges", "edges");
        for (std::size_t t = 0; t < plan_.transitions.size(); ++t) writeTransition(t);
        out_ +=
            "</core:edges>\n</core:SpaceLayer>\n</core:spaceLayerMember>\n</core:spaceLayers>\n"
            "</core:MultiLayeredGraph>\n</core:multiLayeredGraph>\n";
    }

    void writeState(std::size_t number) {
        const indoor::Cell& cell = plan_.cells[number];
        const std::string id = name("state", number + 1);
        out_ += fmt::format("<core:stateMember>\n<core:State gml:id=\"{}\">\n", id);
        if (const std::string& label = volume_.labels.labels[cell.label].name; !label.empty()) text("gml:name", label);
        link("core:duality", cell.id);
        for (const std::size_t transition : cell.transitions) link("core:connects", name("transition", transition + 1));
        out_ += fmt::format("<core:geometry><gml:Point gml:id=\"{}-point\"><gml:pos>", id);
        place(cell.inner);
        out_ += "</gml:pos></gml:Point></core:geometry>\n</core:State>\n</core:stateMember>\n";
    }

    void writeTransition(std::size_t number) {
        const indoor::Transition& transition = plan_.transitions[number];
        const std::string id = name("transition", number + 1);
        double metres = 0;
        for (std::size_t i = 1; i < transition.line.size(); ++i)
            metres += length(transition.line[i] - transition.line[i - 1]);
        out_ +=
            fmt::format("<core:transitionMember>\n<core:Transition gml:id=\"{}\">\n<core:weight>{:.3f}</core:weight>\n",
                        id, metres);
        for (const std::size_t cell : {transition.a, transition.b}) link("core:connects", name("state", cell + 1));
        if (transition.boundary != Boundary::kNone) link("core:duality", name("boundary", transition.boundary + 1));
        out_ += fmt::format("<core:geometry><gml:LineString gml:id=\"{}-line\"><gml:posList>", id);
        for (std::size_t i = 0; i < transition.line.size(); ++i) {
            if (i > 0) out_ += ' ';
            place(transition.line[i]);
        }
        out_ += "</gml:posList></gml:LineString></core:geometry>\n</core:Transition>\n</core:transitionMember>\n";
    }

    const volume::SemanticVolume& volume_;
    const CellPlan& plan_;
    std::unordered_set<std::string> ids_;
    std::string prefix_ = "svt-";
    std::string out_;
};

}  // namespace

Result<std::string> makeIndoorGml(const volume::SemanticVolume& volume, const VolumeWriteOptions& options) {
    SVT_TRY(plan, indoor::planCells(volume, options));
    return DocumentWriter(volume, *plan).run();
}

extern const VolumeFormat kIndoorGml{
    .name = "indoorgml",
    .endings = ".indoor.gml",
    .holds = "IndoorGML 1.0.3: rooms and doors as cell spaces, their graph",
    .readers = "InViewer, FME, navigation, svt build",
    .content = FileContent::IndoorGml,
    .write = [](const auto& volume, const auto& path, const auto& options) -> Result<std::uint64_t> {
        SVT_TRY(document, makeIndoorGml(volume, options));
        return writeFileAtomically(path, *document);
    }};

}  // namespace svt::writers
