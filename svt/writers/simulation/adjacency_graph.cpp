#include <svt/analyze/contacts.hpp>
#include <svt/analyze/label_measures.hpp>
#include <svt/analyze/space_boundaries.hpp>
#include <svt/core/file.hpp>
#include <svt/core/text.hpp>
#include <svt/volume/volume_json.hpp>
#include <svt/writers/simulation/adjacency_graph.hpp>
#include <svt/writers/simulation/solid_boxes.hpp>
#include <svt/writers/volume_formats.hpp>

#include <fmt/format.h>

#include <iterator>

namespace svt::writers {
namespace {

using volume::kNoLabel;

constexpr char kAxisNames[] = {'x', 'y', 'z'};

struct Graph {
    std::vector<std::uint32_t> labels;  // of nodes from 1 on
    std::vector<std::size_t> nodeOf;    // per label; 0: none
    std::vector<std::uint32_t> spaces;  // per label, as of spacesOfLabels()
    std::vector<double> volumes;        // per label, m3
    std::vector<analyze::Contact> contacts;
    std::vector<analyze::SpaceBoundary> boundaries;

    Graph(const volume::SemanticVolume& volume, int threads)
        : nodeOf(volume.labels.labels.size(), 0),
          spaces(analyze::spacesOfLabels(volume.labels)),
          volumes(analyze::ownVolumes(volume.labels, volume.grid)),
          contacts(analyze::findContacts(volume.columns, volume.grid, volume.labels, threads)),
          boundaries(analyze::findSpaceBoundaries(volume.columns, volume.grid, volume.labels)) {
        // A space has a node also where its surfaces took all of its voxels.
        std::vector<bool> isNode(nodeOf.size());
        for (std::size_t l = 0; l < isNode.size(); ++l) isNode[l] = volume.labels.labels[l].voxels > 0;
        for (const auto& boundary : boundaries)
            for (const std::uint32_t label : {boundary.a, boundary.b})
                if (label != kNoLabel) isNode[label] = true;
        for (std::uint32_t l = 0; l < isNode.size(); ++l) {
            if (!isNode[l]) continue;
            labels.push_back(l);
            nodeOf[l] = labels.size();
        }
    }
    [[nodiscard]] std::size_t node(std::uint32_t label) const { return label == kNoLabel ? 0 : nodeOf[label]; }
};

void appendNode(std::string& json, const volume::Label& label, bool isSpace, double cubicMetres) {
    json += ",\n{\"id\": ";
    volume::appendJsonString(json, label.id);
    json += ", \"class\": ";
    volume::appendJsonString(json, label.className);
    json += ", \"name\": ";
    volume::appendJsonString(json, label.name);
    if (!isSpace) {
        json += ", \"material\": ";
        volume::appendJsonString(json, materialOf(label));
    }
    fmt::format_to(std::back_inserter(json), ", \"isSpace\": {}, \"volume\": {}}}", isSpace,
                   roundedMetres(cubicMetres));
}

void appendData(std::string& xml, std::string_view key, std::string_view value) {
    fmt::format_to(std::back_inserter(xml), "<data key=\"{}\">{}</data>", key, xmlContent(value));
}

}  // namespace

std::string makeAdjacencyJson(const volume::SemanticVolume& volume, int threads) {
    const Graph graph(volume, threads);
    const auto& labels = volume.labels.labels;
    std::string json =
        "{\n\"nodes\": [\n{\"id\": \"outside\", \"class\": \"\", \"name\": \"\", \"isSpace\": true, \"volume\": null}";
    for (const std::uint32_t l : graph.labels) appendNode(json, labels[l], graph.spaces[l] == l, graph.volumes[l]);
    json += "\n],\n\"contacts\": [";
    const char* separator = "\n";
    for (const analyze::Contact& contact : graph.contacts) {
        fmt::format_to(std::back_inserter(json), R"({}{{"a": {}, "b": {}, "area": {}}})", separator,
                       graph.node(contact.a), graph.node(contact.b), roundedMetres(contact.area));
        separator = ",\n";
    }
    json += "\n],\n\"boundaries\": [";
    separator = "\n";
    for (const analyze::SpaceBoundary& boundary : graph.boundaries) {
        fmt::format_to(std::back_inserter(json), R"({}{{"a": {}, "b": {}, "axis": "{}", "area": {}, "layers": [)",
                       separator, graph.node(boundary.a), graph.node(boundary.b), kAxisNames[boundary.axis],
                       roundedMetres(boundary.area));
        separator = ",\n";
        for (std::size_t i = 0; i < boundary.layers.size(); ++i)
            fmt::format_to(std::back_inserter(json), R"({}{{"node": {}, "thickness": {}}})", i == 0 ? "" : ", ",
                           graph.node(boundary.layers[i].label), roundedMetres(boundary.layers[i].thickness));
        json += "]}";
    }
    return json += "\n]\n}\n";
}

std::string makeGraphMl(const volume::SemanticVolume& volume, int threads) {
    const Graph graph(volume, threads);
    const auto& labels = volume.labels.labels;
    std::string xml =
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<graphml xmlns=\"http://graphml.graphdrawing.org/xmlns\">\n";
    const auto key = [&](std::string_view name, std::string_view of, std::string_view type) {
        fmt::format_to(std::back_inserter(xml), "<key id=\"{0}\" for=\"{1}\" attr.name=\"{0}\" attr.type=\"{2}\"/>\n",
                       name, of, type);
    };
    for (const char* name : {"id", "class", "name", "material"}) key(name, "node", "string");
    key("isSpace", "node", "boolean");
    key("volume", "node", "double");
    for (const char* name : {"kind", "axis", "layers"}) key(name, "edge", "string");
    key("area", "edge", "double");
    xml +=
        "<graph edgedefault=\"undirected\">\n<node id=\"n0\"><data key=\"id\">outside</data><data "
        "key=\"isSpace\">true</data></node>\n";
    for (const std::uint32_t l : graph.labels) {
        fmt::format_to(std::back_inserter(xml), "<node id=\"n{}\">", graph.nodeOf[l]);
        appendData(xml, "id", labels[l].id);
        appendData(xml, "class", labels[l].className);
        appendData(xml, "name", labels[l].name);
        const bool isSpace = graph.spaces[l] == l;
        if (!isSpace) appendData(xml, "material", materialOf(labels[l]));
        appendData(xml, "isSpace", isSpace ? "true" : "false");
        appendData(xml, "volume", fmt::format("{}", roundedMetres(graph.volumes[l])));
        xml += "</node>\n";
    }
    const auto edge = [&](std::uint32_t a, std::uint32_t b, std::string_view kind, double area) {
        fmt::format_to(std::back_inserter(xml), "<edge source=\"n{}\" target=\"n{}\">", graph.node(a), graph.node(b));
        appendData(xml, "kind", kind);
        appendData(xml, "area", fmt::format("{}", roundedMetres(area)));
    };
    for (const analyze::Contact& contact : graph.contacts) {
        edge(contact.a, contact.b, "contact", contact.area);
        xml += "</edge>\n";
    }
    for (const analyze::SpaceBoundary& boundary : graph.boundaries) {
        edge(boundary.a, boundary.b, "boundary", boundary.area);
        appendData(xml, "axis", std::string(1, kAxisNames[boundary.axis]));
        std::string layers;
        for (const analyze::BoundaryLayer& layer : boundary.layers)
            layers += fmt::format("{}{}:{}", layers.empty() ? "" : "|", labels[layer.label].id,
                                  roundedMetres(layer.thickness));
        appendData(xml, "layers", layers);
        xml += "</edge>\n";
    }
    return xml += "</graph>\n</graphml>\n";
}

extern const VolumeFormat kAdjacency{.name = "adjacency",
                                     .endings = ".adjacency.json",
                                     .holds = "contacts of components, and the layers between rooms and outside",
                                     .readers = "energy and acoustic models",
                                     .content = FileContent::PlainJson,
                                     .write = [](const auto& volume, const auto& path, const auto& options) {
                                         return writeFileAtomically(path, makeAdjacencyJson(volume, options.threads));
                                     }};

extern const VolumeFormat kGraphMl{.name = "graphml",
                                   .endings = ".graphml",
                                   .holds = "the adjacency of components as a graph",
                                   .readers = "NetworkX, Gephi, yEd",
                                   .content = FileContent::Xml,
                                   .write = [](const auto& volume, const auto& path, const auto& options) {
                                       return writeFileAtomically(path, makeGraphMl(volume, options.threads));
                                   }};

}  // namespace svt::writers
