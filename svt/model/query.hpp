#pragma once
/// \file
/// The selection language used by all commands:
///
///     class=BuildingRoom and volume>20
///     name~"Unterzug.*" or under "ID_storey_2"
///     storey="EG" and not (class=Window or ifcType=IfcDoor)
///
/// Grammar (keywords, class names and attribute names ignore case; everything else is case-sensitive):
///
///     query      := and ('or' and)*
///     and        := not ('and' not)*
///     not        := 'not' not | '(' query ')' | term
///     term       := key op value | 'under' value | 'all' | 'none'
///     key        := class | id | name | storey | volume | voxels | any attribute
///     op         := = | == | != | < | <= | > | >= | ~ (regular expression, found anywhere) | !~
///
/// A key or value with blanks, quotes, brackets ( ) or operators must be quoted as "..." or '...'; inside, \" and \'
/// are literal quotes and any other backslash is kept. A quoted key is always an attribute: "class"=1000 tests the
/// attribute `class`. Two values compare as numbers if both are numbers, else as text; `class`, `id` and `name` are
/// always text, `volume` (m3) and `voxels` always numbers. An attribute with several values, such as an array or a
/// repeated property, matches if any of its values does; also with != and !~. Class names are compared after canonicalClassName():
/// class=room selects BuildingRoom. The attribute `ifcType` of a row counts as a class, too: class=IfcWall. `class`,
/// `id` and `storey` support only = != ~ !~. See regex.hpp for patterns.
///
/// `under X` selects the feature whose id or name is X, all its descendants, its members and their descendants: a flat
/// has its rooms as children in one format and as members in another. `storey=X` selects the descendants and members of
/// a storey with the id or name X, and their descendants and members. A storey is a Storey, or a CityObjectGroup whose
/// attribute function, class or usage contains "storey" or "Geschoss". A feature without the attribute (for storey: in
/// no storey) matches no comparison with it, not even != or !~; an empty name counts as missing. `not` selects all
/// others, including those without the attribute.

#include <svt/core/attribute.hpp>
#include <svt/core/result.hpp>

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace svt::model {

inline constexpr std::uint32_t kNoRow = 0xFFFFFFFFu;

/// One feature as a query sees it. Views into data of the caller.
struct QueryRow {
    std::string_view id;
    std::string_view className;
    std::string_view name;
    std::uint32_t parent = kNoRow;  ///< row index
    std::span<const Attribute> attributes;
    std::span<const std::uint32_t> groups;  ///< rows of the groups, storeys and units that it is a member of
    std::optional<double> volume{};         ///< m3; empty: unknown, which matches no comparison
    std::uint64_t voxels = 0;
};

namespace query {
/// True for a Storey and for a group whose function, class or usage contains "storey" or "Geschoss".
[[nodiscard]] bool isStorey(const QueryRow& row);

}  // namespace query

/// A parsed query. Copyable, immutable, safe to use from several threads.
class Query {
public:
    static constexpr std::size_t kMaxBytes = 65536;  ///< maximum length of a query
    static constexpr int kMaxDepth = 64;             ///< maximum nesting of brackets and nots

    /// \return the query, or Code::BadQuery with the 1-based byte column, the text found and the expected text
    [[nodiscard]] static Result<Query> parse(std::string_view text);

    /// Matching rows, ascending. A value that occurs nowhere selects nothing; see unknownValue(). Rows may be in any
    /// order; cycles of parents or groups are allowed. Cost: O(rows * terms). Regular expressions are searched in
    /// the first 4096 bytes of a value.
    [[nodiscard]] std::vector<std::uint32_t> select(std::span<const QueryRow> rows) const;

    /// Explains why the query may select nothing and names the nearest existing value ("no class 'BuildingRom';
    /// did you mean 'BuildingRoom'?"); empty if every value exists. Checks values compared with = or != or
    /// `under`, and attribute names; reports the first in the text that no row has.
    [[nodiscard]] std::string unknownValue(std::span<const QueryRow> rows) const;

    [[nodiscard]] const std::string& text() const noexcept { return text_; }

    struct Node;  // in query_node.hpp

private:
    Query(std::string text, std::shared_ptr<const Node> root) : text_(std::move(text)), root_(std::move(root)) {}

    std::string text_;
    std::shared_ptr<const Node> root_;
};

/// A query and a number, as in options that give values to features.
struct QueryValue {
    std::string query;
    double value = 0;
};

/// Parses "QUERY:NUMBER", such as "name=Bath:24". The last colon separates, so the query may contain colons.
/// \param form  for the message, such as "QUERY:CELSIUS, as in 'name=Bath:24'"
/// \return both, or BadArgument with `form`, or BadQuery as Query::parse()
[[nodiscard]] Result<QueryValue> parseQueryValue(std::string_view text, std::string_view form);

}  // namespace svt::model
