#include <svt/readers/indoorgml/indoor_xml.hpp>

#include <svt/core/text.hpp>

#include <algorithm>
#include <iterator>

namespace svt::readers::indoor {

using pugi::xml_node;
using std::string_view;

bool isCellSpace(string_view localName) {
    constexpr string_view kClasses[] = {"CellSpace",        "NavigableSpace",  "NonNavigableSpace", "GeneralSpace",
                                        "TransferSpace",    "ConnectionSpace", "TransitionSpace",   "AnchorSpace",
                                        "UnnavigableSpace", "ObjectSpace",     "NonNaviSpace"};
    return std::find(std::begin(kClasses), std::end(kClasses), localName) != std::end(kClasses);
}

xml_node nextNode(xml_node node, xml_node top, bool goesDown) {
    if (goesDown && node.first_child()) return node.first_child();
    while (node && node != top && !node.next_sibling()) node = node.parent();
    return node && node != top ? node.next_sibling() : xml_node();
}

string_view attributeOf(xml_node node, string_view name) {
    for (const pugi::xml_attribute attribute : node.attributes())
        if (xml::splitName(attribute.name()).localName == name) return withoutBlanks(attribute.value());
    return {};
}

std::string target(xml_node node) {
    const string_view href = attributeOf(node, "href");
    return href.starts_with('#') ? std::string(href.substr(1)) : std::string();
}

}  // namespace svt::readers::indoor
