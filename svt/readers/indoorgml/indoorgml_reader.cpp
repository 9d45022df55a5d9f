#include <svt/readers/indoorgml/indoorgml_reader.hpp>

#include <svt/core/text.hpp>
#include <svt/readers/georeference/georeference.hpp>
#include <svt/readers/gml/gml_numbers.hpp>
#include <svt/readers/indoorgml/indoor_graph.hpp>
#include <svt/readers/indoorgml/indoor_xml.hpp>
#include <svt/readers/read_model.hpp>
#include <svt/readers/xml/xml_encoding.hpp>
#include <svt/readers/xml/xml_names.hpp>
#include <svt/readers/xml/xml_scanner.hpp>

#include <fmt/format.h>
#include <pugixml.hpp>

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <unordered_set>

namespace svt::readers {
namespace {

using indoor::attributeOf;
using indoor::isCellSpace;
using indoor::localName;
using indoor::nextNode;
using indoor::target;
using pugi::xml_node;
using std::string_view;

// Whether an element below a cell space is another object with its own geometry.
bool isOther(string_view name) {
    return isCellSpace(name) || name.ends_with("Boundary") || indoor::isState(name) || indoor::isTransition(name);
}

// Attributes that programs write into descriptions because there are no elements for them: storey="EG":usage="office".
// False for plain text.
bool addNamedValues(string_view text, std::vector<Attribute>& attributes) {
    std::vector<Attribute> found;
    while (!text.empty()) {
        const std::size_t begin = text.find("=\""), end = text.find('"', begin + 2);
        if (begin == string_view::npos || end == string_view::npos || begin == 0) return false;
        const string_view key = text.substr(0, begin);
        if (key.find_first_of(" \t\r\n\"") != string_view::npos) return false;
        found.push_back({std::string(key), std::string(text.substr(begin + 2, end - begin - 2)), ""});
        text.remove_prefix(end + 1);
        text.remove_prefix(std::min(text.find_first_not_of(": ;,"), text.size()));
    }
    for (Attribute& attribute : found)
        if (std::none_of(attributes.begin(), attributes.end(), [&](const auto& a) { return a.name == attribute.name; }))
            attributes.push_back(std::move(attribute));
    return !found.empty();
}

class IndoorReader {
public:
    IndoorReader(string_view text, string_view name, const ReadOptions& options, Diagnostics& diagnostics)
        : text_(text), name_(name), options_(options), diagnostics_(diagnostics) {}

    Result<model::BuildingModel> run() {
        const pugi::xml_parse_result parsed = document_.load_buffer(
            text_.data(), text_.size(), pugi::parse_default | pugi::parse_doctype, pugi::encoding_utf8);
        if (!parsed)
            return Error(Code::BadXml, fmt::format("not well-formed: {}", parsed.description()),
                         {std::string(name_), xml::lineColumnAt(text_, std::uint64_t(parsed.offset)).line, 0, {}});
        for (const xml_node child : document_.children())
            if (child.type() == pugi::node_doctype)
                return Error(Code::DtdRefused, "the file has a DOCTYPE, which is not read",
                             {std::string(name_), 0, 0, {}});
        model_.source = name_;
        model_.format = "IndoorGML";
        const xml_node root = document_.document_element();
        for (xml_node node = root; node; node = nextNode(node, root)) {
            const string_view id = attributeOf(node, "id");
            if (!id.empty()) byId_.emplace(std::string(id), node);
            if (srsName_.empty()) srsName_ = attributeOf(node, "srsName");
            if (units_.empty()) units_ = attributeOf(node, "uomLabels");
        }
        for (xml_node node = root; node; node = nextNode(node, root)) {
            if (Progress::isCancelled(options_.progress))
                return Error(Code::Cancelled, "stopped while reading", {std::string(name_), 0, 0, {}});
            if (isCellSpace(localName(node))) addCell(node);
        }
        if (cells_.empty())
            return Error(Code::EmptyModel, "the file has no cell space", {std::string(name_), 0, 0, {}});
        indoor::addGraph({root, std::move(cells_), std::move(cellOfId_),
                          [this](const std::string& id) { return byId_.count(id) != 0; },
                          [this](xml_node node, string_view what) { return uniqueId(node, what); },
                          [this](xml_node node, std::string id) { return placeOf(node, std::move(id)); }},
                         model_, diagnostics_);
        return placeModel();
    }

private:
    // Mostly called in document order: continues from the previous position.
    [[nodiscard]] Place placeOf(xml_node node, std::string id = {}) {
        const auto offset = std::min(std::size_t(std::max<std::ptrdiff_t>(0, node.offset_debug())), text_.size());
        if (offset < countedTo_) {
            countedTo_ = 0;
            countedLines_ = 0;
        }
        countedLines_ += xml::countLines(text_.substr(countedTo_, offset - countedTo_));
        countedTo_ = offset;
        return {std::string(name_), countedLines_ + 1, 0, std::move(id)};
    }

    std::string uniqueId(xml_node node, string_view what) {
        std::string id(attributeOf(node, "id"));
        if (id.empty()) {
            id = fmt::format("{}[{}]", what, ids_.size() + 1);
            diagnostics_.add(Severity::Warning, Code::MissingId, fmt::format("without gml:id; it is called '{}'", id),
                             placeOf(node, id));
        }
        if (ids_.insert(id).second) return id;
        const std::string wanted = id;
        for (int i = 2; !ids_.insert(id).second; ++i) id = fmt::format("{}_{}", wanted, i);
        diagnostics_.add(Severity::Warning, Code::DuplicateId,
                         fmt::format("the id '{}' is used again; renamed to '{}'", wanted, id), placeOf(node, id));
        return id;
    }

    void addCell(xml_node node) {
        model::Feature feature;
        feature.id = uniqueId(node, localName(node));
        feature.className = "BuildingRoom";
        feature.line = placeOf(node).line;
        feature.attributes.push_back({"cellSpaceClass", std::string(localName(node)), ""});
        for (const xml_node child : node.children()) {
            const string_view name = localName(child);
            const std::string text(withoutBlanks(child.text().get()));
            if (text.empty()) continue;
            if (name == "name" && feature.name.empty())
                feature.name = text;
            else if (name == "description" && addNamedValues(text, feature.attributes))
                continue;
            else if (name == "description" || name == "function" || name == "class" || name == "usage" ||
                     name == "level")
                feature.attributes.push_back({std::string(name), text, ""});
        }
        model::Geometry geometry;
        readSolids(node, feature.id, geometry);
        if (geometry.solids.empty()) readPolygons(node, feature.id, geometry.surfaces);
        geometry.kind = geometry.solids.empty() ? model::GeometryKind::Surface : model::GeometryKind::Solid;
        const std::string id(attributeOf(node, "id"));
        if (!geometry.solids.empty() || !geometry.surfaces.empty()) feature.geometries.push_back(std::move(geometry));
        const model::FeatureIndex index = model_.addFeature(std::move(feature), model::kNoFeature);
        cells_.emplace_back(node, index);
        if (!id.empty()) cellOfId_.emplace(id, index);
    }

    // All solids of a cell space, without those of nested objects.
    void readSolids(xml_node cell, const std::string& id, model::Geometry& geometry) {
        for (xml_node node = nextNode(cell, cell); node;) {
            const string_view name = localName(node);
            if (name == "Solid") {
                model::Solid solid;
                solid.id = attributeOf(node, "id");
                for (const xml_node shell : node.children()) {
                    std::vector<model::SurfaceUse> uses;
                    if (localName(shell) == "exterior") readPolygons(shell, id, solid.exterior);
                    if (localName(shell) != "interior") continue;
                    readPolygons(shell, id, uses);
                    if (!uses.empty()) solid.interiors.push_back(std::move(uses));
                }
                if (!solid.exterior.empty()) geometry.solids.push_back(std::move(solid));
            }
            node = nextNode(node, cell, name != "Solid" && !isOther(name));
        }
    }

    // Polygons below a node, including referenced ones.
    void readPolygons(xml_node top, const std::string& id, std::vector<model::SurfaceUse>& uses) {
        for (xml_node node = nextNode(top, top); node;) {
            const string_view name = localName(node);
            const bool isPolygon =
                name == "Polygon" || name == "PolygonPatch" || name == "Triangle" || name == "Rectangle";
            if (isPolygon) addPolygon(node, id, isReversed(node, top), uses);
            if (name == "surfaceMember" || name == "baseSurface") {
                const std::string reference = target(node);
                const auto found = byId_.find(reference);
                if (!reference.empty() && found != byId_.end() && localName(found->second) == "Polygon")
                    addPolygon(found->second, id, isReversed(node, top), uses);
                else if (!attributeOf(node, "href").empty())
                    diagnostics_.add(
                        Severity::Warning, Code::DanglingReference,
                        fmt::format("no polygon '{}' is in the file", attributeOf(node, "href").substr(0, 200)),
                        placeOf(node, id));
            }
            node = nextNode(node, top, !isPolygon && !isOther(name));
        }
    }

    // Within an OrientableSurface with a negative orientation.
    static bool isReversed(xml_node node, xml_node top) {
        bool isTurned = false;
        for (xml_node at = node; at && at != top; at = at.parent())
            if (localName(at) == "OrientableSurface" && attributeOf(at, "orientation") == "-") isTurned = !isTurned;
        return isTurned;
    }

    void addPolygon(xml_node node, const std::string& id, bool isTurned, std::vector<model::SurfaceUse>& uses) {
        const auto known = polygonOf_.find(node.internal_object());
        if (known != polygonOf_.end()) {
            if (known->second >= 0) uses.push_back({static_cast<model::PolygonIndex>(known->second), isTurned});
            return;
        }
        polygonOf_[node.internal_object()] = -1;
        model::Polygon polygon;
        for (const string_view part : {string_view("exterior"), string_view("interior")})
            for (const xml_node boundary : node.children())
                if (localName(boundary) == part && !addRing(boundary, id, polygon) && part == "exterior") return;
        if (polygon.ringEnds.empty()) return;
        const model::PolygonIndex index = model_.addPolygon(std::move(polygon));
        polygonOf_[node.internal_object()] = index;
        uses.push_back({index, isTurned});
    }

    bool addRing(xml_node boundary, const std::string& id, model::Polygon& polygon) {
        std::vector<double> numbers;
        string_view rest;
        for (xml_node node = nextNode(boundary, boundary); node; node = nextNode(node, boundary)) {
            const string_view name = localName(node);
            if (name != "posList" && name != "pos") continue;
            rest = gml::parseNumbers(node.text().get(), numbers);
            if (!withoutBlanks(rest).empty()) break;
        }
        if (!withoutBlanks(rest).empty() || numbers.size() % 3 != 0) {
            diagnostics_.add(Severity::Warning, Code::BadCoordinate,
                             "a ring whose coordinates are not three numbers each; left out", placeOf(boundary, id));
            return false;
        }
        const std::size_t begin = polygon.points.size();
        for (std::size_t i = 0; i + 2 < numbers.size(); i += 3) {
            const Vec3d p{numbers[i], numbers[i + 1], numbers[i + 2]};
            if (polygon.points.size() == begin || p != polygon.points.back()) polygon.points.push_back(p);
        }
        while (polygon.points.size() > begin + 1 && polygon.points.back() == polygon.points[begin])
            polygon.points.pop_back();
        if (polygon.points.size() < begin + 3) {
            polygon.points.resize(begin);
            diagnostics_.add(Severity::Warning, Code::TooFewPoints, "a ring of fewer than three points; left out",
                             placeOf(boundary, id));
            return false;
        }
        polygon.ringEnds.push_back(static_cast<std::uint32_t>(polygon.points.size()));
        return true;
    }

    Result<model::BuildingModel> placeModel() {
        const Place place{std::string(name_), 0, 0, {}};
        const georeference::GivenCrs given{srsName_, units_, false, place, {}};
        SVT_DO(georeference::georeference(model_, given, options_, diagnostics_));
        return std::move(model_);
    }

    string_view text_, name_;
    std::size_t countedTo_ = 0;
    std::uint64_t countedLines_ = 0;
    const ReadOptions& options_;
    Diagnostics& diagnostics_;
    pugi::xml_document document_;
    model::BuildingModel model_;
    std::string srsName_, units_;
    std::unordered_map<std::string, xml_node> byId_;
    std::unordered_map<const void*, std::int64_t> polygonOf_;  // by element; -1: it cannot be read
    std::unordered_set<std::string> ids_;
    std::vector<std::pair<xml_node, model::FeatureIndex>> cells_;
    std::unordered_map<std::string, model::FeatureIndex> cellOfId_;
};

}  // namespace

bool looksLikeIndoorGml(std::span<const std::byte> head) noexcept {
    string_view text(reinterpret_cast<const char*>(head.data()), head.size());
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
    const xml::Prolog prolog = xml::readProlog(text);
    return prolog.hasRoot && xml::splitName(prolog.rootName).localName == "IndoorFeatures";
}

Result<model::BuildingModel> readIndoorGml(std::span<const std::byte> bytes, string_view name,
                                           const ReadOptions& options, Diagnostics* diagnostics) {
    if (bytes.size() > options.maxBytes)
        return Error(Code::InputTooBig,
                     fmt::format("the file has {} bytes, the limit is {}", bytes.size(), options.maxBytes),
                     {std::string(name), 0, 0, {}});
    SVT_TRY(text, xml::toUtf8(bytes, name));
    Diagnostics ignored;
    return IndoorReader(text->view(), name, options, diagnostics != nullptr ? *diagnostics : ignored).run();
}

extern const Format kIndoorGml{.name = "indoorgml",
                               .endings = ".gml|.xml",
                               .holds = "IndoorGML",
                               .looksLike = looksLikeIndoorGml,
                               .read = readIndoorGml};

}  // namespace svt::readers
