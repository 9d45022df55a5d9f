#include <svt/readers/features/json_objects.hpp>

#include <svt/core/text.hpp>
#include <svt/readers/features/json_scan.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

namespace svt::readers::features {
namespace {

using std::string_view;

constexpr std::uint64_t kMark = 16;
constexpr std::size_t kMaxMemberBytes = std::size_t{16} << 20;

Error badJson(const std::string& fileName, std::string_view what) {
    return {Code::BadJson, fmt::format("the CityJSON object {}", what), {fileName, 0, 0, {}}};
}

// The appearance without members for textures.
std::string plainAppearance(string_view text) {
    std::string members;
    forEachMember(text, 0, [&](string_view key, std::size_t begin, std::size_t end) {
        if (key == "\"textures\"" || key == "\"vertices-texture\"") return;
        members += fmt::format("{}{}:{}", members.empty() ? "" : ",", key, text.substr(begin, end - begin));
    });
    return "{" + members + "}";
}

// The text of a member without line breaks.
std::string inOneLine(std::string text) {
    for (char& c : text)
        if (c == '\n' || c == '\r') c = ' ';  // within a string they would not be valid JSON
    return text;
}

}  // namespace

Result<std::string> headOf(string_view object, const std::string& fileName) {
    std::string head = "{";
    const std::size_t end = forEachMember(object, 0, [&](string_view key, std::size_t begin, std::size_t last) {
        const string_view value = object.substr(begin, last - begin);
        if (key == "\"CityObjects\"" || key == "\"vertices\"" || value.size() > kMaxMemberBytes) return;
        head += fmt::format("{}:{},", key, key == "\"appearance\"" ? plainAppearance(value) : std::string(value));
    });
    if (end == kNoJson) return badJson(fileName, "is not well-formed, or cut off");
    return inOneLine(head + R"("CityObjects":{},"vertices":[]})");
}

Result<JsonObjects> JsonObjects::open(string_view text, const std::string& fileName) {
    JsonObjects result;
    result.text_ = text;
    std::size_t objectsAt = kNoJson, verticesAt = kNoJson;
    const std::size_t end = forEachMember(text, 0, [&](string_view key, std::size_t begin, std::size_t) {
        if (key == "\"CityObjects\"") objectsAt = begin;
        if (key == "\"vertices\"") verticesAt = begin;
    });
    if (end == kNoJson) return badJson(fileName, "is not well-formed, or cut off");
    if (objectsAt == kNoJson || verticesAt == kNoJson)
        return badJson(fileName, "lacks the member 'CityObjects' or 'vertices'");
    const std::size_t lastObject =
        forEachMember(text, objectsAt, [&](string_view key, std::size_t begin, std::size_t last) {
            result.objects_.push_back(
                {static_cast<std::uint64_t>(key.data() - text.data()), begin, last, key, {}, false});
        });
    const std::size_t lastVertex = forEachElement(text, verticesAt, [&](std::size_t begin, std::size_t) {
        if (result.vertexCount_++ % kMark == 0) result.vertexMarks_.push_back(begin);
    });
    if (lastObject == kNoJson || lastVertex == kNoJson)
        return badJson(fileName,
                       "has a member 'CityObjects' that is not an object, or 'vertices' that is not an array");
    result.connect();
    return result;
}

void JsonObjects::connect() {
    std::unordered_map<string_view, std::uint32_t> numberOf;
    numberOf.reserve(objects_.size());
    for (std::uint32_t o = 0; o < objects_.size(); ++o) numberOf.emplace(objects_[o].key, o);
    for (std::uint32_t o = 0; o < objects_.size(); ++o)
        forEachMember(text_, objects_[o].begin, [&](string_view key, std::size_t begin, std::size_t) {
            if (key != "\"parents\"") return;
            forEachElement(text_, begin, [&](std::size_t first, std::size_t last) {
                const auto parent = numberOf.find(text_.substr(first, last - first));
                // It belongs to the first existing parent; others refer to it.
                if (parent == numberOf.end() || parent->second == o || objects_[o].hasParent) return;
                objects_[o].hasParent = true;
                objects_[parent->second].children.push_back(o);
            });
        });
    for (std::uint32_t o = 0; o < objects_.size(); ++o)
        if (!objects_[o].hasParent) tops_.push_back(o);
}

FeatureSpan JsonObjects::spanOf(std::size_t top) const noexcept {
    const Object& object = objects_[tops_[top]];
    return {object.keyBegin, object.end - object.keyBegin};
}

std::size_t JsonObjects::findAt(std::uint64_t begin) const noexcept {
    const auto found = std::lower_bound(tops_.begin(), tops_.end(), begin, [&](std::uint32_t top, std::uint64_t at) {
        return objects_[top].keyBegin < at;
    });
    return found == tops_.end() || objects_[*found].keyBegin != begin ? tops_.size()
                                                                      : static_cast<std::size_t>(found - tops_.begin());
}

string_view JsonObjects::vertex(std::uint64_t number) const {
    std::size_t at = vertexMarks_[number / kMark];
    for (std::uint64_t n = number % kMark; n > 0; --n)
        at = skipJsonBlanks(text_, skipJsonBlanks(text_, skipJson(text_, at)) + 1);
    return text_.substr(at, skipJson(text_, at) - at);
}

// Vertices are numbered anew in the order in which they are used.
void JsonObjects::appendBoundaries(string_view boundaries, Numbers& numbers, std::string& to) const {
    for (std::size_t at = 0; at < boundaries.size();) {
        if (!isDigit(boundaries[at])) {
            to += boundaries[at++];
            continue;
        }
        std::uint64_t number = 0;
        const auto [end, failed] =
            std::from_chars(boundaries.data() + at, boundaries.data() + boundaries.size(), number);
        if (failed != std::errc{} || number >= vertexCount_)
            to.append(boundaries.data() + at, end);  // the reader finds it, since no feature has that many vertices
        else
            to += std::to_string(numbers.emplace(number, static_cast<std::uint32_t>(numbers.size())).first->second);
        at = static_cast<std::size_t>(end - boundaries.data());
    }
}

void JsonObjects::appendObject(const Object& object, Numbers& numbers, std::string& to) const {
    const auto copy = [&](std::size_t from, std::size_t end) { to += text_.substr(from, end - from); };
    std::size_t done = object.begin;
    forEachMember(text_, object.begin, [&](string_view key, std::size_t begin, std::size_t) {
        if (key != "\"geometry\"") return;
        forEachElement(text_, begin, [&](std::size_t geometry, std::size_t) {
            forEachMember(text_, geometry, [&](string_view member, std::size_t first, std::size_t last) {
                if (member != "\"boundaries\"") return;
                copy(done, first);
                appendBoundaries(text_.substr(first, last - first), numbers, to);
                done = last;
            });
        });
    });
    copy(done, object.end);
}

std::string JsonObjects::line(std::size_t top) const {
    Numbers numbers;
    const Object& first = objects_[tops_[top]];
    std::string text = fmt::format(R"({{"type":"CityJSONFeature","id":{},"CityObjects":{{)", first.key);
    // Objects whose parents form a cycle are not below an object without parent, so this ends.
    std::vector<std::uint32_t> open{tops_[top]};
    for (bool isFirst = true; !open.empty(); isFirst = false) {
        const Object& object = objects_[open.back()];
        open.pop_back();
        open.insert(open.end(), object.children.rbegin(), object.children.rend());
        text += fmt::format("{}{}:", isFirst ? "" : ",", object.key);
        appendObject(object, numbers, text);
    }
    std::vector<std::uint64_t> used(numbers.size());
    for (const auto& [number, place] : numbers) used[place] = number;
    text += R"(},"vertices":[)";
    for (std::size_t v = 0; v < used.size(); ++v) {
        if (v != 0) text += ',';
        text += vertex(used[v]);
    }
    // A number that is not a vertex of the document must not become a vertex of the feature: it has more digits.
    return inOneLine(text + "]}");
}

}  // namespace svt::readers::features
