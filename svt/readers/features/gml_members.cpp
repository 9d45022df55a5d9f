#include <svt/readers/features/gml_members.hpp>

#include <svt/core/text.hpp>
#include <svt/readers/xml/xml_names.hpp>
#include <svt/readers/xml/xml_scanner.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace svt::readers::features {
namespace {

using std::string_view;

constexpr std::size_t kMaxHeadBytes = std::size_t{4} << 20;

string_view tagNameAt(string_view text, std::size_t from) {
    std::size_t end = from;
    while (end < text.size() && !isBlank(text[end]) && text[end] != '>' && text[end] != '/') ++end;
    return text.substr(from, end - from);
}

bool holdsFeatures(string_view localName) {
    for (const string_view name : {"cityObjectMember", "featureMember", "featureMembers", "cityObjectMembers"})
        if (localName == name) return true;
    return false;
}

bool belongsToHead(string_view localName) {
    for (const string_view name : {"boundedBy", "name", "description", "metaDataProperty"})
        if (localName == name) return true;
    return false;
}

}  // namespace

Error GmlMembers::cutOff(std::uint64_t offset) const {
    return {Code::BadXml,
            fmt::format("the file ends inside an element that begins at byte {}; it seems to be cut off", offset),
            {fileName_, 0, 0, {}}};
}

// Position of `what` in the window, which grows until it is found.
Result<std::size_t> GmlMembers::find(TextStream& stream, string_view what, std::size_t from) {
    while (true) {
        const std::size_t found = stream.window().find(what, from);
        if (found != string_view::npos) return found;
        from = std::max(from, stream.window().size() - std::min(stream.window().size(), what.size() - 1));
        SVT_TRY(more, stream.more());
        if (!*more) return cutOff(stream.base());
    }
}

Result<bool> GmlMembers::has(TextStream& stream, std::size_t at, string_view text) {
    while (stream.window().size() < at + text.size()) {
        SVT_TRY(more, stream.more());
        if (!*more) return false;
    }
    return stream.window().substr(at, text.size()) == text;
}

// Position of the next character that is neither blank nor in a comment or processing instruction; the end of the
// window at the end of the text.
Result<std::size_t> GmlMembers::skipBlanks(TextStream& stream, std::size_t at) {
    while (true) {
        while (at < stream.window().size() && isBlank(stream.window()[at])) ++at;
        if (at >= stream.window().size()) {
            SVT_TRY(more, stream.more());
            if (!*more) return at;
            continue;
        }
        string_view end;
        for (const auto& [open, close] : {std::pair<string_view, string_view>{"<!--", "-->"}, {"<?", "?>"}}) {
            SVT_TRY(begins, has(stream, at, open));
            if (*begins) end = close;
        }
        if (end.empty()) return at;
        SVT_TRY(found, find(stream, end, at + 2));
        at = *found + end.size();
    }
}

Result<std::size_t> GmlMembers::endOfTag(TextStream& stream, std::size_t at, bool& isEmpty) {
    char quote = 0;
    while (true) {
        const string_view text = stream.window();
        for (; at < text.size(); ++at) {
            const char c = text[at];
            if (quote != 0) {
                quote = c == quote ? '\0' : quote;
            } else if (c == '"' || c == '\'') {
                quote = c;
            } else if (c == '>') {
                isEmpty = text[at - 1] == '/';
                return at + 1;
            }
        }
        SVT_TRY(more, stream.more());
        if (!*more) return cutOff(stream.base());
    }
}

// Position after the element that begins at `at`.
Result<std::size_t> GmlMembers::endOfElement(TextStream& stream, std::size_t at) {
    std::uint64_t depth = 0;
    while (true) {
        SVT_TRY(open, find(stream, "<", at));
        at = *open;
        string_view close;
        for (const auto& [begin, end] :
             {std::pair<string_view, string_view>{"<!--", "-->"}, {"<![CDATA[", "]]>"}, {"<?", "?>"}}) {
            const char next = at + 1 < stream.window().size() ? stream.window()[at + 1] : '!';
            if (next != '!' && next != '?') break;
            SVT_TRY(begins, has(stream, at, begin));
            if (*begins) close = end;
        }
        if (!close.empty()) {
            SVT_TRY(found, find(stream, close, at + 2));
            at = *found + close.size();
            continue;
        }
        bool isEmpty = false;
        SVT_TRY(end, endOfTag(stream, at + 1, isEmpty));
        const char next = stream.window()[at + 1];
        if (next == '!')
            return Error(Code::DtdRefused, "the file declares a DOCTYPE or entities, which are never read",
                         {fileName_, 0, 0, {}});
        at = *end;
        if (next == '/')
            --depth;
        else if (!isEmpty)
            ++depth;
        if (depth == 0) return at;
    }
}

Result<void> GmlMembers::begin(TextStream& stream) {
    SVT_TRY(root, skipBlanks(stream, 0));
    bool isEmpty = false;
    SVT_TRY(end, endOfTag(stream, *root + 1, isEmpty));
    const string_view text = stream.window();
    if (text[*root] != '<' || text[*root + 1] == '!')
        return Error(text.substr(*root).starts_with("<!") ? Code::DtdRefused : Code::BadXml,
                     "the file does not begin with the element CityModel, or declares a DOCTYPE",
                     {fileName_, 0, 0, {}});
    rootName_ = tagNameAt(text, *root + 1);
    head_ = text.substr(0, *end);
    isEnd_ = isEmpty;
    countHead();
    stream.discard(stream.base() + *end);
    return {};
}

void GmlMembers::countHead() { lines_ = xml::countLines(head_) + 1; }

Result<FeatureText> GmlMembers::memberHere(TextStream& stream) {
    SVT_TRY(end, endOfElement(stream, 0));
    return FeatureText{{stream.base(), *end}, stream.window().substr(0, *end), stream.line()};
}

Result<bool> GmlMembers::next(TextStream& stream, FeatureText& feature) {
    while (!isEnd_) {
        SVT_TRY(at, skipBlanks(stream, 0));
        stream.discard(stream.base() + *at);
        if (stream.window().empty()) return cutOff(stream.base());
        if (stream.window()[0] != '<')
            return Error(Code::BadXml, fmt::format("text between the members of the model, at byte {}", stream.base()),
                         {fileName_, 0, 0, {}});
        SVT_TRY(isRootEnd, has(stream, 0, "</"));
        if (*isRootEnd) {
            isEnd_ = true;
            return false;
        }
        SVT_TRY(member, memberHere(stream));
        feature = *member;
        const string_view name = xml::splitName(tagNameAt(feature.text, 1)).localName;
        // Members after the first feature do not apply to earlier features.
        if (!hasFeatures_ && belongsToHead(name) && head_.size() + feature.text.size() < kMaxHeadBytes) {
            head_ += feature.text;
            countHead();
        }
        // The text stays in the window until more is read.
        stream.discard(stream.base() + feature.span.size);
        if (holdsFeatures(name)) {
            hasFeatures_ = true;
            return true;
        }
    }
    return false;
}

std::string GmlMembers::document(std::span<const string_view> members) const {
    std::string text = head_;
    if (text.ends_with("/>")) text.replace(text.size() - 2, 2, ">");
    std::size_t size = text.size() + rootName_.size() + 8;
    for (const string_view member : members) size += member.size() + 1;
    text.reserve(size);
    for (const string_view member : members) (text += '\n') += member;
    return text + "\n</" + rootName_ + ">\n";
}

}  // namespace svt::readers::features
