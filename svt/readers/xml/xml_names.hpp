#pragma once
/// \file
/// Names in XML: elements are compared by namespace and local name, never by prefix.
/// Uses pugixml, which does not support namespaces.

#include <pugixml.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace svt::readers::xml {

/// Meaning of a namespace for the CityGML reader.
enum class Vocabulary : std::uint8_t {
    None,        ///< no namespace, or an undeclared prefix
    Other,       ///< an ADE or any other unknown namespace
    Core,        ///< CityGML core
    Module,      ///< thematic modules: building, construction, bridge, ...
    Appearance,  ///< CityGML appearance
    Generics,    ///< CityGML generics
    Group,       ///< CityGML cityobjectgroup
    Gml,         ///< GML 3.1, 3.2 and the TINs of 3.3
    GmlCompact,  ///< GML 3.3 compact encoding
    XLink,
    Address  ///< xAL
};

[[nodiscard]] Vocabulary vocabularyOf(std::string_view uri) noexcept;

/// 1, 2 or 3 if `uri` is the core namespace of this CityGML version, else 0.
[[nodiscard]] int cityGmlVersion(std::string_view uri) noexcept;

/// An element with its resolved name. Views into the document.
struct Element {
    pugi::xml_node node;
    Vocabulary vocabulary = Vocabulary::None;
    std::string_view localName;

    [[nodiscard]] bool is(Vocabulary expected, std::string_view name) const noexcept {
        return vocabulary == expected && localName == name;
    }
};

/// "gml:id" gives {"gml", "id"}, "id" gives {"", "id"}.
struct QualifiedName {
    std::string_view prefix;
    std::string_view localName;
};
[[nodiscard]] QualifiedName splitName(std::string_view name) noexcept;

/// Prefix declarations in scope during document traversal.
class NameScope {
public:
    /// Adds the declarations of `element` to the scope.
    /// \return a mark for leave(), which removes them again
    std::size_t enter(pugi::xml_node element);
    void leave(std::size_t mark);

    [[nodiscard]] Element resolve(pugi::xml_node node) const;
    /// Namespace of an attribute of `node`; None if it has no prefix.
    [[nodiscard]] Vocabulary ofAttribute(std::string_view prefix, pugi::xml_node node) const;

    /// A prefix that was met without a declaration, and the first element with it or with an attribute of it.
    struct Undeclared {
        std::string prefix;
        pugi::xml_node node;
    };
    [[nodiscard]] const std::vector<Undeclared>& undeclared() const noexcept { return undeclared_; }

    /// Calls `visit(Element)` for each child element, with its declarations in scope.
    template <class Visit>
    void forEachChild(pugi::xml_node parent, Visit&& visit) {
        for (pugi::xml_node child = parent.first_child(); child; child = child.next_sibling()) {
            if (child.type() != pugi::node_element) continue;
            const std::size_t mark = enter(child);
            visit(resolve(child));
            leave(mark);
        }
    }

private:
    struct Binding {
        std::string prefix;
        Vocabulary vocabulary;
    };
    // Cache of lookups, indexed by a hash of the prefix: a document uses few distinct prefixes.
    struct Remembered {
        std::array<char, 14> prefix{};
        std::uint8_t size = 0xFF;
        Vocabulary vocabulary = Vocabulary::None;
    };
    [[nodiscard]] Vocabulary lookUp(std::string_view prefix) const noexcept;
    void noteUndeclared(std::string_view prefix, pugi::xml_node node) const;

    std::vector<Binding> bindings_;
    mutable std::vector<Undeclared> undeclared_;
    mutable std::array<Remembered, 16> remembered_;
};

/// First child element, or an empty node.
[[nodiscard]] pugi::xml_node firstChildElement(pugi::xml_node parent) noexcept;

/// Text of an element without surrounding blanks. Text split by comments or CDATA is joined in `scratch`.
[[nodiscard]] std::string_view textOf(pugi::xml_node element, std::string& scratch);

}  // namespace svt::readers::xml
