#include <svt/readers/citygml/citygml_reader.hpp>

#include <svt/core/parallel.hpp>
#include <svt/core/text.hpp>
#include <svt/readers/citygml/citygml_assembly.hpp>
#include <svt/readers/citygml/citygml_chunk.hpp>
#include <svt/readers/read_model.hpp>
#include <svt/readers/xml/xml_encoding.hpp>
#include <svt/readers/xml/xml_names.hpp>
#include <svt/readers/xml/xml_scanner.hpp>

#include <fmt/format.h>
#include <pugixml.hpp>

#include <algorithm>
#include <optional>

namespace svt::readers {
namespace {

using citygml::Part;
using std::string_view;

// Chunks parsed in one batch. Fixed, so that memory and results do not depend on the number of threads.
constexpr std::size_t kBatchChunks = 64;
// Deeper recursion could overflow the stack of a thread, whatever limit the caller sets.
constexpr std::uint32_t kMaxDepth = 1000;
constexpr string_view kCityGml04 = "http://www.citygml.org/citygml/1/0/0";

// Line number at the start of each chunk.
class LineIndex {
public:
    explicit LineIndex(string_view document) : document_(document) {}

    void add(std::uint64_t offset, std::uint64_t line) {
        offsets_.push_back(offset);
        lines_.push_back(line);
    }
    [[nodiscard]] std::uint64_t lineOf(std::uint64_t offset) {
        const auto after = std::upper_bound(offsets_.begin(), offsets_.end(), offset);
        const auto index = static_cast<std::size_t>(after - offsets_.begin());
        std::uint64_t from = index == 0 ? 0 : offsets_[index - 1];
        std::uint64_t line = index == 0 ? 1 : lines_[index - 1];
        // Lookups mostly come in document order: continue from the previous one if that is nearer.
        if (lastOffset_ >= from && lastOffset_ <= offset) {
            from = lastOffset_;
            line = lastLine_;
        }
        lastOffset_ = offset;
        lastLine_ = line + xml::countLines(document_.substr(from, offset - from));
        return lastLine_;
    }

private:
    string_view document_;
    std::vector<std::uint64_t> offsets_;
    std::vector<std::uint64_t> lines_;
    std::uint64_t lastOffset_ = 0;
    std::uint64_t lastLine_ = 1;
};

// Feature lines relative to the start of the chunk, found in one pass: features are in document order.
void setRelativeLines(string_view document, const xml::Chunk& chunk, Part& part) {
    std::uint64_t at = chunk.content.begin;
    std::uint64_t line = 0;
    for (std::size_t i = 0; i < part.features.size(); ++i) {
        const std::uint64_t offset = part.featureOffsets[i];
        if (offset < at) continue;  // the continued feature: it already has its line
        line += xml::countLines(document.substr(at, offset - at));
        at = offset;
        part.features[i].line = line;
    }
}

struct Root {
    xml::Range tag;
    int version = 0;
};

Result<Root> checkRoot(string_view document, xml::Range tag, const std::string& fileName) {
    const Place place{fileName, xml::lineColumnAt(document, tag.begin).line, 0, {}};
    std::string text(document.substr(tag.begin, tag.size()));
    if (!text.ends_with("/>")) text.insert(text.size() - 1, 1, '/');
    pugi::xml_document tree;
    if (!tree.load_buffer(text.data(), text.size(), pugi::parse_default, pugi::encoding_utf8))
        return Error(Code::BadXml, "the start tag of the root element is not well-formed", place);
    const pugi::xml_node root = tree.document_element();
    const xml::QualifiedName name = xml::splitName(root.name());
    const std::string key = name.prefix.empty() ? "xmlns" : fmt::format("xmlns:{}", name.prefix);
    const string_view uri = withoutBlanks(root.attribute(key.c_str()).value());
    if (name.localName != "CityModel")
        return Error(Code::UnknownFormat, fmt::format("the root element is <{}>; expected a CityModel", root.name()),
                     place);
    if (const int version = xml::cityGmlVersion(uri); version != 0) return Root{tag, version};
    if (uri == kCityGml04)
        return Error(Code::UnknownVersion,
                     "this is CityGML 0.4, which came before the standard; convert it to CityGML 1.0 or later", place);
    return Error(Code::UnknownVersion,
                 fmt::format("the CityModel is in the namespace '{}'; CityGML 1.0, 2.0 and 3.0 "
                             "(http://www.opengis.net/citygml/2.0) can be read",
                             uri.substr(0, 200)),
                 place);
}

class Reading {
public:
    Reading(string_view document, std::string fileName, const ReadOptions& options, Diagnostics& diagnostics)
        : document_(document),
          fileName_(std::move(fileName)),
          options_(options),
          diagnostics_(diagnostics),
          scanner_(document, fileName_, std::min(options.maxDepth, kMaxDepth)),
          lines_(document) {}

    Result<model::BuildingModel> run() {
        SVT_TRY(rootTag, scanner_.begin());
        SVT_TRY(root, checkRoot(document_, *rootTag, fileName_));
        line_ = 1 + xml::countLines(document_.substr(0, rootTag->end));

        const string_view rootText = document_.substr(rootTag->begin, rootTag->size());
        while (!isAtEnd_) {
            SVT_DO(readBatch(rootText));
            Progress::tell(options_.progress, "read",
                           static_cast<double>(scanner_.position()) / static_cast<double>(document_.size() + 1));
            if (Progress::isCancelled(options_.progress))
                return Error(Code::Cancelled, "reading was cancelled", {fileName_, 0, 0, {}});
        }
        const citygml::DocumentFacts facts{fileName_, fmt::format("CityGML {}.0", root->version), document_.size(),
                                           [this](std::uint64_t offset) { return lines_.lineOf(offset); }};
        return citygml::assemble(std::move(whole_), facts, options_, diagnostics_);
    }

private:
    Result<void> readBatch(string_view rootText) {
        std::vector<xml::Chunk> chunks;
        std::optional<Error> scanError;
        while (chunks.size() < kBatchChunks && !isAtEnd_ && !scanError) {
            xml::Chunk chunk;
            const Result<bool> found = scanner_.next(chunk);
            if (!found)
                scanError = found.error();
            else if (*found)
                chunks.push_back(std::move(chunk));
            else
                isAtEnd_ = true;
        }
        std::vector<Part> parts(chunks.size());
        std::vector<std::uint64_t> lineCounts(chunks.size());
        parallelFor(chunks.size(), 1, options_.threads, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                parts[i] = citygml::parseChunk(document_, rootText, chunks[i], fileName_);
                setRelativeLines(document_, chunks[i], parts[i]);
                lineCounts[i] = xml::countLines(document_.substr(chunks[i].content.begin, chunks[i].content.size()));
            }
        });
        for (std::size_t i = 0; i < chunks.size(); ++i) {
            if (parts[i].error) return *parts[i].error;
            joinPart(chunks[i], std::move(parts[i]));
            line_ += lineCounts[i];
        }
        if (scanError) return *scanError;
        return {};
    }

    void joinPart(const xml::Chunk& chunk, Part&& part) {
        lines_.add(chunk.content.begin, line_);
        for (model::Feature& feature : part.features) feature.line += line_;
        for (citygml::Finding& finding : part.findings.items)
            diagnostics_.add(finding.severity, finding.code, std::move(finding.message),
                             {fileName_, lines_.lineOf(finding.offset), 0, std::move(finding.id)});
        // The kept findings already fill the list of their code, so these are only counted.
        for (const citygml::Findings::Count& count : part.findings.counts)
            for (std::size_t i = 0; i < count.dropped; ++i) diagnostics_.add(count.severity, count.code, {});
        whole_.join(std::move(part));
    }

    string_view document_;
    std::string fileName_;
    const ReadOptions& options_;
    Diagnostics& diagnostics_;
    xml::Scanner scanner_;
    LineIndex lines_;
    std::uint64_t line_ = 1;
    bool isAtEnd_ = false;
    Part whole_;
};

}  // namespace

bool looksLikeCityGml(std::span<const std::byte> head) noexcept {
    std::string_view text(reinterpret_cast<const char*>(head.data()), head.size());
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
    const bool isUtf16 = text.size() >= 4 && (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF") ||
                                              text[0] == '\0' || text[1] == '\0');
    std::string narrowed;
    if (isUtf16) {
        // Sufficient to find an ASCII name.
        for (const char c : text.substr(0, 1 << 16))
            if (c != '\0' && static_cast<unsigned char>(c) < 0x80) narrowed += c;
        text = narrowed;
    }
    const xml::Prolog prolog = xml::readProlog(text);
    return prolog.hasRoot && xml::splitName(prolog.rootName).localName == "CityModel";
}

Result<model::BuildingModel> readCityGml(std::span<const std::byte> bytes, string_view name, const ReadOptions& options,
                                         Diagnostics* diagnostics) {
    std::string fileName(name);
    if (bytes.size() > options.maxBytes)
        return Error(Code::InputTooBig,
                     fmt::format("the file has {} bytes, the limit is {}", bytes.size(), options.maxBytes),
                     {fileName, 0, 0, {}});
    SVT_TRY(text, xml::toUtf8(bytes, name));
    Diagnostics ignored;
    return Reading(text->view(), std::move(fileName), options, diagnostics != nullptr ? *diagnostics : ignored).run();
}

extern const Format kCityGml{.name = "citygml",
                             .endings = ".gml|.xml|.citygml",
                             .holds = "CityGML 1.0 to 3.0",
                             .looksLike = looksLikeCityGml,
                             .read = readCityGml};

}  // namespace svt::readers
