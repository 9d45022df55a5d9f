#include <svt/readers/xml/xml_names.hpp>

#include <svt/core/text.hpp>

#include <algorithm>

namespace svt::readers::xml {
namespace {

using std::string_view;

constexpr string_view kCityGml = "http://www.opengis.net/citygml/";

std::size_t slotOf(string_view prefix) noexcept {
    if (prefix.empty()) return 0;
    const auto first = static_cast<unsigned char>(prefix.front());
    const auto last = static_cast<unsigned char>(prefix.back());
    return (first * 3u + last + prefix.size()) % 16u;
}

}  // namespace

int cityGmlVersion(string_view uri) noexcept {
    if (uri == "http://www.opengis.net/citygml/3.0") return 3;
    if (uri == "http://www.opengis.net/citygml/2.0") return 2;
    if (uri == "http://www.opengis.net/citygml/1.0") return 1;
    return 0;
}

Vocabulary vocabularyOf(string_view uri) noexcept {
    if (uri.starts_with(kCityGml)) {
        if (cityGmlVersion(uri) != 0) return Vocabulary::Core;
        const string_view rest = uri.substr(kCityGml.size());
        const string_view module = rest.substr(0, rest.find('/'));
        if (module == "appearance") return Vocabulary::Appearance;
        if (module == "generics") return Vocabulary::Generics;
        if (module == "cityobjectgroup") return Vocabulary::Group;
        return Vocabulary::Module;
    }
    if (uri == "http://www.opengis.net/gml/3.3/ce") return Vocabulary::GmlCompact;
    if (uri == "http://www.opengis.net/gml" || uri.starts_with("http://www.opengis.net/gml/3.")) return Vocabulary::Gml;
    if (uri == "http://www.w3.org/1999/xlink") return Vocabulary::XLink;
    if (uri.starts_with("urn:oasis:names:tc:ciq:")) return Vocabulary::Address;
    return Vocabulary::Other;
}

QualifiedName splitName(string_view name) noexcept {
    const std::size_t colon = name.find(':');
    if (colon == string_view::npos) return {{}, name};
    return {name.substr(0, colon), name.substr(colon + 1)};
}

std::size_t NameScope::enter(pugi::xml_node element) {
    const std::size_t mark = bindings_.size();
    for (pugi::xml_attribute attribute = element.first_attribute(); attribute; attribute = attribute.next_attribute()) {
        const string_view name = attribute.name();
        if (!name.starts_with("xmlns")) continue;
        if (name.size() > 5 && name[5] != ':') continue;
        const string_view prefix = name.size() > 5 ? name.substr(6) : string_view{};
        const string_view uri = withoutBlanks(attribute.value());
        bindings_.push_back({std::string(prefix), uri.empty() ? Vocabulary::None : vocabularyOf(uri)});
    }
    if (bindings_.size() != mark) remembered_.fill({});
    return mark;
}

void NameScope::leave(std::size_t mark) {
    if (bindings_.size() == mark) return;
    bindings_.resize(mark);
    remembered_.fill({});
}

Vocabulary NameScope::lookUp(string_view prefix) const noexcept {
    Remembered& slot = remembered_[slotOf(prefix)];
    if (slot.size == prefix.size() && std::equal(prefix.begin(), prefix.end(), slot.prefix.begin()))
        return slot.vocabulary;
    const auto found = std::find_if(bindings_.rbegin(), bindings_.rend(),
                                    [&](const Binding& binding) { return binding.prefix == prefix; });
    const Vocabulary vocabulary = found == bindings_.rend() ? Vocabulary::None : found->vocabulary;
    if (prefix.size() <= slot.prefix.size()) {
        std::copy(prefix.begin(), prefix.end(), slot.prefix.begin());
        slot.size = static_cast<std::uint8_t>(prefix.size());
        slot.vocabulary = vocabulary;
    }
    return vocabulary;
}

void NameScope::noteUndeclared(string_view prefix, pugi::xml_node node) const {
    constexpr std::size_t kMost = 64;
    if (prefix.empty() || prefix == "xml" || undeclared_.size() >= kMost) return;
    for (const Undeclared& known : undeclared_)
        if (known.prefix == prefix) return;
    undeclared_.push_back({std::string(prefix), node});
}

Element NameScope::resolve(pugi::xml_node node) const {
    const QualifiedName name = splitName(node.name());
    const Vocabulary vocabulary = lookUp(name.prefix);
    if (vocabulary == Vocabulary::None) noteUndeclared(name.prefix, node);
    return {node, vocabulary, name.localName};
}

Vocabulary NameScope::ofAttribute(string_view prefix, pugi::xml_node node) const {
    const Vocabulary vocabulary = prefix.empty() ? Vocabulary::None : lookUp(prefix);
    if (vocabulary == Vocabulary::None) noteUndeclared(prefix, node);
    return vocabulary;
}

pugi::xml_node firstChildElement(pugi::xml_node parent) noexcept {
    for (pugi::xml_node child = parent.first_child(); child; child = child.next_sibling())
        if (child.type() == pugi::node_element) return child;
    return {};
}

string_view textOf(pugi::xml_node element, std::string& scratch) {
    string_view text = element.value();
    bool isJoined = false;
    for (pugi::xml_node child = element.first_child(); child; child = child.next_sibling()) {
        if (child.type() != pugi::node_pcdata && child.type() != pugi::node_cdata) continue;
        const string_view piece = child.value();
        if (text.empty()) {
            text = piece;
            continue;
        }
        if (!isJoined) scratch = text;
        isJoined = true;
        scratch += piece;
        text = scratch;
    }
    return withoutBlanks(text);
}

}  // namespace svt::readers::xml
