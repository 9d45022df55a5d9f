#include <svt/readers/citygml/citygml_chunk.hpp>

#include <svt/readers/citygml/citygml_features.hpp>
#include <svt/readers/xml/xml_encoding.hpp>
#include <svt/readers/xml/xml_names.hpp>

#include <fmt/format.h>

#include <charconv>
#include <memory>
#include <new>
#include <system_error>

namespace svt::readers::citygml {
namespace {

using std::string_view;

// A chunk as a separate document: the open start tags, the content, the missing end tags.
class ChunkText {
public:
    ChunkText(string_view document, const xml::Chunk& chunk) : chunk_(chunk) {
        for (const xml::Range& tag : chunk.open) prefixSize_ += tag.size();
        size_ = prefixSize_ + chunk.content.size() + chunk.closing.size();
        text_ = std::make_unique_for_overwrite<char[]>(size_ + 1);
        char* to = text_.get();
        const auto put = [&](string_view piece) { to += piece.copy(to, piece.size()); };
        for (const xml::Range& tag : chunk.open) put(document.substr(tag.begin, tag.size()));
        put(document.substr(chunk.content.begin, chunk.content.size()));
        put(chunk.closing);
    }

    [[nodiscard]] char* data() noexcept { return text_.get(); }
    [[nodiscard]] std::size_t size() const noexcept { return size_; }

    /// Offset in the document of a position in this text.
    [[nodiscard]] std::uint64_t offsetOf(const char* at) const noexcept {
        auto offset = static_cast<std::uint64_t>(at - text_.get());
        for (const xml::Range& tag : chunk_.open) {
            if (offset < tag.size()) return tag.begin + offset;
            offset -= tag.size();
        }
        return std::min(chunk_.content.begin + offset, chunk_.content.end);
    }

private:
    const xml::Chunk& chunk_;
    std::uint64_t prefixSize_ = 0;
    std::size_t size_ = 0;
    std::unique_ptr<char[]> text_;
};

std::string describe(const pugi::xml_parse_result& result) {
    switch (result.status) {
        case pugi::status_end_element_mismatch: return "an end tag does not match the start tag";
        case pugi::status_bad_attribute: return "an attribute is not well-formed";
        case pugi::status_bad_start_element: return "a start tag is not well-formed";
        case pugi::status_bad_end_element: return "an end tag is not well-formed";
        default: return fmt::format("not well-formed: {}", result.description());
    }
}

// Whether XML 1.0 has a character (its production 2).
bool isXmlCharacter(std::uint32_t code) noexcept {
    if (code < 0x20) return code == 0x9 || code == 0xA || code == 0xD;
    return code < 0xD800 || (code >= 0xE000 && code <= 0x10FFFF && code != 0xFFFE && code != 0xFFFF);
}

// References to characters that XML does not allow, such as "&#0;": the parser ends a text there, or keeps them.
void noteBadReferences(string_view content, std::uint64_t begin, Part& part) {
    for (std::size_t at = content.find("&#"); at != string_view::npos; at = content.find("&#", at + 2)) {
        const bool isHex = content.substr(at + 2).starts_with('x');
        const char* const from = content.data() + at + (isHex ? 3 : 2);
        const char* const end = content.data() + content.size();
        std::uint32_t code = 0;
        const auto [after, error] = std::from_chars(from, end, code, isHex ? 16 : 10);
        const bool isTooLarge = error == std::errc::result_out_of_range;
        if (after == from || after == end || *after != ';' || (!isTooLarge && isXmlCharacter(code))) continue;
        part.findings.add(
            Severity::Warning, Code::BadXml,
            fmt::format("the reference '{}' is not a character that XML allows: the id or text that holds it is "
                        "damaged, or ends there",
                        content.substr(at, static_cast<std::size_t>(after + 1 - content.data()) - at).substr(0, 40)),
            begin + at);
    }
}

}  // namespace

Part parseChunk(string_view document, string_view rootTag, const xml::Chunk& chunk, string_view fileName) {
    Part part;
    const auto fail = [&](Code code, std::string message, std::uint64_t offset) {
        const xml::LineColumn at = xml::lineColumnAt(document, offset);
        part.error = Error(code, std::move(message), {std::string(fileName), at.line, at.column, {}});
    };
    const string_view content = document.substr(chunk.content.begin, chunk.content.size());
    if (const std::size_t bad = xml::firstBadUtf8(content); bad != string_view::npos) {
        fail(Code::BadEncoding,
             fmt::format("the byte 0x{:02X} is not valid UTF-8; the file may be in another encoding than it declares",
                         static_cast<unsigned char>(content[bad])),
             chunk.content.begin + bad);
        return part;
    }

    noteBadReferences(content, chunk.content.begin, part);
    ChunkText text(document, chunk);
    pugi::xml_document tree;
    constexpr unsigned kOptions = pugi::parse_escapes | pugi::parse_cdata | pugi::parse_eol |
                                  pugi::parse_wconv_attribute | pugi::parse_embed_pcdata | pugi::parse_fragment;
    const pugi::xml_parse_result result =
        tree.load_buffer_inplace(text.data(), text.size(), kOptions, pugi::encoding_utf8);
    if (result.status == pugi::status_out_of_memory) throw std::bad_alloc();
    if (!result) {
        fail(Code::BadXml, describe(result), text.offsetOf(text.data() + result.offset));
        return part;
    }

    // The declarations of the root apply to every chunk.
    pugi::xml_document root;
    std::string rootText(rootTag);
    if (!rootText.ends_with("/>")) rootText.insert(rootText.size() - 1, 1, '/');
    root.load_buffer(rootText.data(), rootText.size(), pugi::parse_default, pugi::encoding_utf8);

    xml::NameScope scope;
    scope.enter(root.document_element());
    FeatureReader reader(scope, part, [&](pugi::xml_node node) { return text.offsetOf(node.name()); });
    bool continues = chunk.open.size() == 2;
    scope.forEachChild(tree, [&](const xml::Element& member) {
        reader.readMember(member, continues);
        continues = false;
    });
    for (const xml::NameScope::Undeclared& prefix : scope.undeclared())
        part.addUndeclared({prefix.prefix, prefix.node.name(), text.offsetOf(prefix.node.name())});
    return part;
}

}  // namespace svt::readers::citygml
