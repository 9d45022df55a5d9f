#include <svt/writers/bcf_file.hpp>

#include <svt/core/text.hpp>
#include <svt/volume/zip_file.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <unordered_set>
#include <utility>

namespace svt::writers {
namespace {

constexpr std::string_view kOpen = "Open";

// A GUID of a text: four FNV-1a sums of 32 bits, as UUID version 8.
std::string guidOf(std::string_view text) {
    std::string hex;
    for (std::uint32_t seed = 0; seed < 4; ++seed) {
        std::uint32_t sum = 0x811C9DC5u ^ seed * 0x9E3779B1u;
        for (const char c : text) sum = (sum ^ static_cast<unsigned char>(c)) * 0x01000193u;
        hex += fmt::format("{:08x}", sum);
    }
    hex[12] = '8';
    hex[16] = '8';
    return fmt::format("{}-{}-{}-{}-{}", hex.substr(0, 8), hex.substr(8, 4), hex.substr(12, 4), hex.substr(16, 4),
                       hex.substr(20));
}

// Texts may be neither empty nor blank.
bool isBlank(std::string_view text) { return text.find_first_not_of(" \t\r\n") == std::string_view::npos; }

std::string element(std::string_view name, std::string_view text) {
    return isBlank(text) ? std::string() : fmt::format("<{0}>{1}</{0}>", name, xmlContent(text));
}

std::string xyzElement(std::string_view name, Vec3d p) {
    return fmt::format("<{0}><X>{1:.9f}</X><Y>{2:.9f}</Y><Z>{3:.9f}</Z></{0}>", name, p.x, p.y, p.z);
}

std::string componentList(const std::vector<std::string>& ids) {
    std::string text;
    for (const std::string& id : ids) {
        if (isBlank(id)) continue;
        text += isIfcGuid(id) ? fmt::format("<Component IfcGuid=\"{}\"/>", id)
                              : fmt::format("<Component>{}{}</Component>", element("OriginatingSystem", "SVT"),
                                            element("AuthoringToolId", id));
    }
    return text;
}

std::string viewpointOf(const BcfTopic& topic, const std::string& guid) {
    const std::string list = componentList(topic.components);
    const std::string selection = list.empty() ? "" : fmt::format("<Selection>{}</Selection>", list);
    const std::string coloring =
        list.empty() ? ""
                     : fmt::format(
                           "<Coloring><Color Color=\"{:02X}{:02X}{:02X}\"><Components>{}</Components></Color>"
                           "</Coloring>",
                           topic.color[0], topic.color[1], topic.color[2], list);
    const BcfCamera& camera = topic.camera;
    const Vec3d forward = normalized(camera.direction);
    const Vec3d up = normalized(camera.up - forward * dot(camera.up, forward));
    return fmt::format(
        "<VisualizationInfo Guid=\"{}\"><Components>{}<Visibility DefaultVisibility=\"true\"><ViewSetupHints "
        "SpacesVisible=\"false\" SpaceBoundariesVisible=\"false\" OpeningsVisible=\"false\"/></Visibility>{}"
        "</Components><PerspectiveCamera>{}{}{}<FieldOfView>{:.6g}</FieldOfView><AspectRatio>{:.6f}</AspectRatio>"
        "</PerspectiveCamera></VisualizationInfo>",
        guid, selection, coloring, xyzElement("CameraViewPoint", camera.eye), xyzElement("CameraDirection", forward),
        xyzElement("CameraUpVector", up), camera.fieldOfViewDegrees, camera.aspect);
}

std::string markupOf(const BcfTopic& topic, const std::string& guid, const std::string& viewGuid,
                     std::string_view author, std::string_view date) {
    std::string files;
    for (const std::string& file : topic.files)
        if (!isBlank(file)) files += fmt::format("<File IsExternal=\"true\">{}</File>", element("Filename", file));
    const std::string header = files.empty() ? "" : fmt::format("<Header><Files>{}</Files></Header>", files);
    return fmt::format(
        "<Markup>{}<Topic Guid=\"{}\" TopicType=\"{}\" TopicStatus=\"{}\">{}{}{}{}<Viewpoints><ViewPoint Guid=\"{}\">"
        "{}{}</ViewPoint></Viewpoints></Topic></Markup>",
        header, guid, xmlAttribute(topic.type), kOpen, element("Title", isBlank(topic.title) ? topic.key : topic.title),
        element("CreationDate", date), element("CreationAuthor", author), element("Description", topic.description),
        viewGuid, element("Viewpoint", "viewpoint.bcfv"),
        element("Snapshot", topic.snapshot.empty() ? "" : "snapshot.png"));
}

volume::ZippedFile document(std::string name, const std::string& root) {
    const std::string text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n" + root + "\n";
    const auto bytes = std::as_bytes(std::span(text.data(), text.size()));
    return {std::move(name), {bytes.begin(), bytes.end()}};
}

std::string extensionsOf(std::span<const BcfTopic> topics, std::string_view author) {
    std::vector<std::string_view> types;
    for (const BcfTopic& topic : topics)
        if (std::find(types.begin(), types.end(), topic.type) == types.end()) types.push_back(topic.type);
    std::string list;
    for (const std::string_view type : types) list += element("TopicType", type);
    return fmt::format(
        "<Extensions><TopicTypes>{}</TopicTypes><TopicStatuses>{}{}</TopicStatuses><Users>{}</Users></Extensions>",
        list, element("TopicStatus", kOpen), element("TopicStatus", "Closed"), element("User", author));
}

}  // namespace

bool isIfcGuid(std::string_view id) noexcept {
    if (id.size() != 22 || id.front() < '0' || id.front() > '3') return false;
    return std::all_of(id.begin(), id.end(), [](char c) {
        return isDigit(c) || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '_' || c == '$';
    });
}

Result<std::vector<std::byte>> makeBcf(std::span<const BcfTopic> topics, std::string_view author,
                                       std::string_view date) {
    std::vector<volume::ZippedFile> files{document("bcf.version", "<Version VersionId=\"3.0\"/>"),
                                          document("extensions.xml", extensionsOf(topics, author))};
    std::unordered_set<std::string> guids;
    for (const BcfTopic& topic : topics) {
        const std::string guid = guidOf(topic.key), viewGuid = guidOf("view " + topic.key);
        if (!guids.insert(guid).second)
            return Error(Code::BadArgument, "two topics have one GUID; their keys must differ: '" + topic.key + "'");
        files.push_back(document(guid + "/markup.bcf", markupOf(topic, guid, viewGuid, author, date)));
        files.push_back(document(guid + "/viewpoint.bcfv", viewpointOf(topic, viewGuid)));
        if (!topic.snapshot.empty()) files.push_back({guid + "/snapshot.png", topic.snapshot});
    }
    return volume::makeZip(files);
}

}  // namespace svt::writers
