#include <svt/core/text.hpp>
#include <svt/writers/ade/model_document.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace svt::writers {
namespace {

constexpr std::string_view kCityGml = "http://www.opengis.net/citygml/";
constexpr std::size_t kHeadBytes = 65536;

bool isNameCharacter(char c) {
    // Letters of other alphabets are bytes from 0x80 on; nearly all of them are allowed.
    return isLetter(c) || isDigit(c) || c == '_' || c == '-' || c == '.' || static_cast<unsigned char>(c) >= 0x80;
}

Error documentError(const std::filesystem::path& path, Code code, std::string message) {
    return Error(code, std::move(message), Place{path.string(), 0, 0, {}});
}

std::string plainFeature(const volume::LabelTable& labels, std::size_t number, CityGmlVersion version) {
    const volume::Label& label = labels.labels[number];
    const std::string id = gmlId(label.id, number), name = xmlContent(label.name);
    std::string text = "<core:cityObjectMember>";
    const bool isBuilding = label.className == "Building" && label.parent == volume::kNoLabel;
    if (isBuilding) {
        text += fmt::format("<bldg:Building gml:id=\"{}\"><gml:name>{}</gml:name></bldg:Building>", id, name);
    } else if (version == CityGmlVersion::V2) {
        text += fmt::format(
            "<gen:GenericCityObject gml:id=\"{}\"><gml:name>{}</gml:name><gen:class>{}</gen:class>"
            "</gen:GenericCityObject>",
            id, name, xmlContent(label.className));
    } else {
        text += fmt::format(
            "<gen:GenericOccupiedSpace gml:id=\"{}\"><gml:name>{}</gml:name><gen:class>{}</gen:class>"
            "</gen:GenericOccupiedSpace>",
            id, name, xmlContent(label.className));
    }
    return text + "</core:cityObjectMember>\n";
}

}  // namespace

std::string_view adeNamespace(CityGmlVersion version) noexcept {
    return version == CityGmlVersion::V2 ? "urn:svt:citygml:ade:2.0" : "urn:svt:citygml:ade:3.0";
}

Result<ModelDocument> ModelDocument::open(const std::filesystem::path& path) {
    SVT_TRY(mapped, FileBytes::read(path));
    const std::string_view text = mapped->text();
    const std::string_view head = text.substr(0, kHeadBytes);
    const std::size_t root = head.find("CityModel");
    const std::size_t close = text.rfind("</");
    const std::size_t encoding = head.substr(0, head.find("?>")).find("encoding");
    const auto isUtf8 = [&] {
        if (encoding == std::string_view::npos) return true;
        const std::string_view name = head.substr(encoding, 24);
        return name.find("UTF-8") != std::string_view::npos || name.find("utf-8") != std::string_view::npos;
    };
    if (root == std::string_view::npos || close == std::string_view::npos || !isUtf8() ||
        text.substr(close).find("CityModel") == std::string_view::npos)
        return documentError(
            path, Code::UnknownFormat,
            "the model is not a CityGML document in UTF-8 that ends with its CityModel; leave it out to "
            "write features without geometry");
    if (text.find("urn:svt:citygml:ade:") != std::string_view::npos)
        return documentError(path, Code::BadArgument, "the model already contains a volume; give the model without it");
    ModelDocument document;
    const auto has = [&](std::string_view version) {
        return head.find(fmt::format("{}{}", kCityGml, version)) != std::string_view::npos;
    };
    document.isFirstVersion_ = has("1.0");
    if (!has("1.0") && !has("2.0") && !has("3.0"))
        return documentError(path, Code::UnknownVersion,
                             "the model is not CityGML 1.0, 2.0 or 3.0; convert it, or leave it out");
    document.version_ = has("3.0") ? CityGmlVersion::V3 : CityGmlVersion::V2;
    document.cut_ = close;
    document.mapped_.emplace(std::move(*mapped));
    return document;
}

ModelDocument ModelDocument::plain(const volume::SemanticVolume& volume, CityGmlVersion version) {
    ModelDocument document;
    document.version_ = version;
    const bool isThird = version == CityGmlVersion::V3;
    const std::string_view number = isThird ? "3.0" : "2.0";
    document.begin_ = fmt::format(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<core:CityModel xmlns:core=\"{0}{1}\" "
        "xmlns:bldg=\"{0}building/{1}\" "
        "xmlns:gen=\"{0}generics/{1}\" xmlns:gml=\"http://www.opengis.net/gml{2}\">\n<gml:name>{3}</gml:name>\n",
        kCityGml, number, isThird ? "/3.2" : "", xmlContent(volume.modelName));
    for (std::size_t l = 0; l < volume.labels.labels.size(); ++l)
        document.begin_ += plainFeature(volume.labels, l, version);
    document.end_ = "</core:CityModel>\n";
    return document;
}

std::vector<std::string_view> ModelDocument::ids() const {
    std::vector<std::string_view> ids;
    if (!mapped_) return ids;
    constexpr std::string_view kAttribute = ":id=";
    const std::string_view text = mapped_->text();
    for (std::size_t at = text.find(kAttribute); at != std::string_view::npos; at = text.find(kAttribute, at)) {
        at += kAttribute.size();
        const char quote = at < text.size() ? text[at] : '\0';
        const std::size_t end = text.find(quote, std::min(at + 1, text.size()));
        if (end == std::string_view::npos) break;
        if (quote == '"' || quote == '\'') ids.push_back(text.substr(at + 1, end - at - 1));
    }
    std::ranges::sort(ids);
    return ids;
}

Result<void> ModelDocument::writeBegin(AtomicFile& file) const {
    return mapped_ ? write(mapped_->text().substr(0, cut_), file) : file.write(begin_);
}

Result<void> ModelDocument::writeEnd(AtomicFile& file) const {
    return mapped_ ? write(mapped_->text().substr(cut_), file) : file.write(end_);
}

// Namespaces of CityGML 1.0 become those of 2.0.
Result<void> ModelDocument::write(std::string_view text, AtomicFile& file) const {
    if (!isFirstVersion_) return file.write(text);
    while (!text.empty()) {
        const std::size_t at = std::min(text.find(kCityGml), text.size());
        const std::size_t end = std::min(text.find_first_of("\"' \t\r\n<", at), text.size());
        const bool isOld = end > at && text.substr(at, end - at).ends_with("/1.0");
        SVT_DO(file.write(text.substr(0, isOld ? end - 3 : end)));
        if (isOld) SVT_DO(file.write("2.0"));
        text.remove_prefix(end);
    }
    return {};
}

std::string referenceTo(std::string_view id) {
    std::string reference = "#";
    for (const char c : id) {
        if (isNameCharacter(c))
            reference += c;
        else
            reference += fmt::format("%{:02X}", static_cast<unsigned char>(c));
    }
    return reference;
}

std::string gmlId(std::string_view id, std::size_t number) {
    const bool isName = !id.empty() && std::all_of(id.begin(), id.end(), isNameCharacter) &&
                        !(id[0] >= '0' && id[0] <= '9') && id[0] != '-' && id[0] != '.';
    return isName ? std::string(id) : fmt::format("label-{}", number);
}

}  // namespace svt::writers
