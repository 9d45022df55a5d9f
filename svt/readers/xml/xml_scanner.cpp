#include <svt/readers/xml/xml_scanner.hpp>

#include <svt/core/text.hpp>
#include <svt/readers/xml/xml_names.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

namespace svt::readers::xml {
namespace {

using std::string_view;

constexpr std::uint64_t kChunkBytes = 256 << 10;       // chunk size when cutting between children of the root
constexpr std::uint64_t kInnerChunkBytes = 512 << 10;  // chunk size above which a child of the root is itself cut
constexpr std::size_t kNone = string_view::npos;

constexpr bool startsName(char c) noexcept {
    return isLetter(c) || c == '_' || c == ':' || static_cast<unsigned char>(c) >= 0x80;
}

constexpr bool endsName(char c) noexcept { return isBlank(c) || c == '>' || c == '/' || c == '='; }

std::size_t find(string_view text, char c, std::size_t from) noexcept {
    if (from >= text.size()) return kNone;
    const void* found = std::memchr(text.data() + from, c, text.size() - from);
    return found == nullptr ? kNone : static_cast<std::size_t>(static_cast<const char*>(found) - text.data());
}

// Position after a DOCTYPE that starts at `from`, including its internal subset, or npos.
std::size_t skipDoctype(string_view text, std::size_t from) noexcept {
    int brackets = 0;
    for (std::size_t i = from; i < text.size(); ++i) {
        const char c = text[i];
        if (c == '"' || c == '\'') {
            i = find(text, c, i + 1);
            if (i == kNone) return kNone;
        } else if (c == '[') {
            ++brackets;
        } else if (c == ']') {
            --brackets;
        } else if (c == '>' && brackets <= 0) {
            return i + 1;
        }
    }
    return kNone;
}

string_view nameAt(string_view text, std::size_t from) noexcept {
    std::size_t end = from;
    while (end < text.size() && !endsName(text[end]) && text[end] != '<') ++end;
    return text.substr(from, end - from);
}

string_view declaredEncoding(string_view declaration) noexcept {
    const std::size_t key = declaration.find("encoding");
    if (key == kNone) return {};
    const std::size_t quote = declaration.find_first_of("\"'", key);
    if (quote == kNone) return {};
    const std::size_t end = declaration.find(declaration[quote], quote + 1);
    return end == kNone ? string_view{} : declaration.substr(quote + 1, end - quote - 1);
}

}  // namespace

std::uint64_t countLines(string_view text) noexcept {
    // One-byte counters let the compiler compare 16 or more bytes at once.
    constexpr std::size_t kBlock = 128;
    std::uint64_t lines = 0;
    std::size_t i = 0;
    for (; i + kBlock <= text.size(); i += kBlock) {
        unsigned char inBlock = 0;
        for (std::size_t k = 0; k < kBlock; ++k) inBlock = static_cast<unsigned char>(inBlock + (text[i + k] == '\n'));
        lines += inBlock;
    }
    for (; i < text.size(); ++i) lines += text[i] == '\n' ? 1 : 0;
    return lines;
}

LineColumn lineColumnAt(string_view text, std::uint64_t offset) noexcept {
    const string_view before = text.substr(0, std::min<std::uint64_t>(offset, text.size()));
    const std::size_t lineStart = before.rfind('\n');
    return {countLines(before) + 1, lineStart == kNone ? before.size() + 1 : before.size() - lineStart};
}

Prolog readProlog(string_view text) noexcept {
    Prolog prolog;
    std::size_t i = 0;
    while (true) {
        while (i < text.size() && isBlank(text[i])) ++i;
        const string_view rest = text.substr(std::min(i, text.size()));
        if (rest.size() < 2 || rest[0] != '<') return prolog;
        std::size_t end = kNone;
        if (rest.starts_with("<?")) {
            end = rest.find("?>");
            if (rest.starts_with("<?xml") && rest.size() > 5 && isBlank(rest[5]))
                prolog.encoding = declaredEncoding(rest.substr(0, end));
            if (end != kNone) end += 2;
        } else if (rest.starts_with("<!--")) {
            end = rest.find("-->", 4);
            if (end != kNone) end += 3;
        } else if (rest.starts_with("<!")) {
            prolog.hasDoctype = true;
            end = skipDoctype(rest, 2);
        } else if (startsName(rest[1])) {
            prolog.hasRoot = true;
            prolog.rootName = nameAt(rest, 1);
            prolog.rootTag = rest;
            return prolog;
        }
        if (end == kNone) return prolog;
        i += end;
    }
}

Scanner::Scanner(string_view text, std::string fileName, std::uint32_t maxDepth)
    : text_(text), fileName_(std::move(fileName)), maxDepth_(maxDepth) {}

bool Scanner::fail(Code code, std::string message, std::uint64_t offset) {
    const LineColumn at = lineColumnAt(text_, offset);
    error_ = Error(code, std::move(message), {fileName_, at.line, at.column, {}});
    return false;
}

bool Scanner::skipDeclaration() {
    const string_view rest = text_.substr(position_);
    const auto skipTo = [&](string_view end, std::size_t from, string_view what) -> bool {
        const std::size_t found = rest.find(end, from);
        if (found == kNone)
            return fail(Code::BadXml, fmt::format("{} is not closed; expected '{}'", what, end), position_);
        position_ += found + end.size();
        return true;
    };
    if (rest.starts_with("<?")) return skipTo("?>", 2, "a processing instruction");
    if (rest.starts_with("<!--")) return skipTo("-->", 4, "a comment");
    if (rest.starts_with("<![CDATA[")) {
        if (depth_ == 0) return fail(Code::BadXml, "CDATA outside of the root element", position_);
        return skipTo("]]>", 9, "a CDATA section");
    }
    if (rest.starts_with("<!DOCTYPE") || rest.starts_with("<!ENTITY"))
        return fail(Code::DtdRefused,
                    "the file declares a DOCTYPE or entities, which are never read; remove the declaration", position_);
    return fail(Code::BadXml, "'<!' starts neither a comment nor CDATA", position_);
}

bool Scanner::readStartTag(Tag& tag) {
    const char* const data = text_.data();
    const std::size_t size = text_.size();
    std::size_t i = tag.range.begin + 1;
    while (i < size) {
        const char c = data[i];
        if (c == '>') {
            tag.isEmpty = data[i - 1] == '/';
            tag.range.end = i + 1;
            return true;
        }
        if (c == '"' || c == '\'') {
            i = find(text_, c, i + 1);
            if (i == kNone) break;
        } else if (c == '<') {
            return fail(Code::BadXml, fmt::format("'<' inside the tag of <{}>", nameAt(text_, tag.range.begin + 1)), i);
        }
        ++i;
    }
    return fail(
        Code::BadXml,
        fmt::format("the file ends inside the tag of <{}>; it seems to be cut off", nameAt(text_, tag.range.begin + 1)),
        size);
}

bool Scanner::nextTag(Tag& tag, bool& hasTag) {
    while (true) {
        const std::size_t at = find(text_, '<', position_);
        if (depth_ == 0) {
            const std::size_t end = at == kNone ? text_.size() : at;
            for (std::size_t i = position_; i < end; ++i)
                if (!isBlank(text_[i])) return fail(Code::BadXml, "text outside of the root element", i);
        }
        if (at == kNone) {
            hasTag = false;
            return true;
        }
        position_ = at;
        const char next = at + 1 < text_.size() ? text_[at + 1] : '\0';
        if (next == '!' || next == '?') {
            if (!skipDeclaration()) return false;
            continue;
        }
        hasTag = true;
        tag.range.begin = at;
        tag.isEnd = next == '/';
        tag.isEmpty = false;
        const std::size_t nameBegin = at + (tag.isEnd ? 2 : 1);
        if (nameBegin >= text_.size() || !startsName(text_[nameBegin]))
            return fail(Code::BadXml, "'<' is not followed by a name; write '&lt;' in text", at);
        // Deeper names are compared when their chunk is parsed.
        const bool needsName = depth_ <= std::size(open_);
        if (needsName) tag.name = nameAt(text_, nameBegin);
        if (!tag.isEnd) {
            if (!readStartTag(tag)) return false;
        } else if (!needsName) {
            const std::size_t end = find(text_, '>', nameBegin);
            if (end == kNone) return fail(Code::BadXml, "an end tag is not closed", at);
            tag.range.end = end + 1;
        } else {
            const std::size_t end = text_.find_first_not_of(" \t\r\n", nameBegin + tag.name.size());
            if (end == kNone || text_[end] != '>')
                return fail(Code::BadXml, fmt::format("the end tag </{} is not closed", tag.name), at);
            tag.range.end = end + 1;
        }
        position_ = tag.range.end;
        return true;
    }
}

bool Scanner::enterElement(const Tag& tag) {
    if (depth_ >= maxDepth_)
        return fail(
            Code::InputTooBig,
            fmt::format("elements are nested deeper than {} levels, which is the limit; the file seems to be damaged",
                        maxDepth_),
            tag.range.begin);
    if (depth_ < std::size(open_)) open_[depth_] = tag;
    ++depth_;
    return true;
}

bool Scanner::leaveElement(const Tag& tag) {
    if (depth_ == 0) return fail(Code::BadXml, fmt::format("</{}> closes nothing", tag.name), tag.range.begin);
    --depth_;
    if (depth_ < std::size(open_) && open_[depth_].name != tag.name)
        return fail(Code::BadXml, fmt::format("</{}> closes <{}>", tag.name, open_[depth_].name), tag.range.begin);
    return true;
}

Result<Range> Scanner::begin() {
    Tag tag;
    bool hasTag = false;
    if (!nextTag(tag, hasTag)) return *error_;
    if (!hasTag || tag.isEnd) {
        fail(Code::BadXml, "no root element was found", position_);
        return *error_;
    }
    if (!tag.isEmpty && !enterElement(tag)) return *error_;
    return tag.range;
}

bool Scanner::isCutAllowed(std::uint64_t chunkBegin) const noexcept {
    const std::uint64_t size = position_ - chunkBegin;
    if (depth_ == 1) return size >= kChunkBytes;
    return depth_ <= 3 && size >= kInnerChunkBytes;
}

void Scanner::close(Chunk& chunk, std::uint64_t end) const {
    chunk.content.end = end;
    for (std::uint32_t i = depth_; i > 1; --i) chunk.closing += fmt::format("</{}>", open_[i - 1].name);
}

bool Scanner::finish() {
    Tag tag;
    bool hasTag = false;
    if (!nextTag(tag, hasTag)) return false;
    return !hasTag || fail(Code::BadXml, "a second root element", tag.range.begin);
}

bool Scanner::fillChunk(Chunk& chunk) {
    chunk.content.begin = position_;
    for (std::uint32_t i = 1; i < depth_; ++i) chunk.open.push_back(open_[i].range);
    while (true) {
        Tag tag;
        bool hasTag = false;
        if (!nextTag(tag, hasTag)) return false;
        if (!hasTag)
            return fail(Code::BadXml,
                        fmt::format("the file ends inside of <{}>, {} elements are still open; it seems to be cut off",
                                    open_[std::min<std::size_t>(depth_, std::size(open_)) - 1].name, depth_),
                        text_.size());
        if (!tag.isEnd) {
            if (!enterElement(tag)) return false;
            if (!tag.isEmpty) continue;
            --depth_;
        } else if (!leaveElement(tag)) {
            return false;
        }
        if (depth_ == 0) {
            close(chunk, tag.range.begin);
            return true;
        }
        if (isCutAllowed(chunk.content.begin)) {
            close(chunk, position_);
            return true;
        }
    }
}

Result<bool> Scanner::next(Chunk& chunk) {
    chunk = {};
    const bool isAtEnd = depth_ == 0;
    const bool isDone = isAtEnd ? finish() : fillChunk(chunk);
    if (!isDone) return *error_;
    return !isAtEnd;
}

}  // namespace svt::readers::xml
