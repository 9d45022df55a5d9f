#pragma once
/// \file
/// The selection language that every command speaks:
///
///     class=BuildingRoom and volume>20
///     name~"Unterzug.*" or under "ID_storey_2"
///     storey="EG" and not (class=Window or ifcType=IfcDoor)
///
/// Grammar (keywords, class names and attribute names without regard to case; all else as written):
///     query      := and ('or' and)*
///     and        := not ('and' not)*
///     not        := 'not' not | '(' query ')' | term
///     term       := key op value | 'under' value | 'all' | 'none'
///     key        := class | id | name | storey | volume | voxels | any attribute name
///     op         := = | == | != | < | <= | > | >= | ~ (regular expression, found anywhere) | !~
/// A key or value with blanks, quotes, brackets ( ) or operators stands in "..." or '...'; there \" and \' are the
/// quotes themselves, any other backslash stays. A key in quotes is always an attribute: "class"=1000 asks the
/// attribute `class`. Two values compare as numbers where both are numbers, else as text; `class`, `id` and `name` are
/// always text, `volume` (m3) and `voxels` always numbers. Class names compare as canonicalClassName() gives them:
/// class=room takes BuildingRoom. `class`, `id` and `storey` know = != ~ !~ only. Patterns are those of regex.hpp.
///
/// `under X` takes the feature whose id or name is X, everything below it, its members and what is below those: a flat
/// has its rooms as children in one format and as members in another. `storey=X` takes what is below or a member of a
/// Storey of that id or name, or of a CityObjectGroup of that id or name whose attribute function, class or usage
/// speaks of a storey or Geschoss, and what is below or a member of those. A feature without the attribute (for storey:
/// in no storey) matches no comparison with it, != and !~ included; an empty name is none. `not` takes the others,
/// those without the attribute included.

#include <svt/core/attribute.hpp>
#include <svt/core/result.hpp>

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace svt::model {

inline constexpr std::uint32_t kNoRow = 0xFFFFFFFFu;

/// One feature as a query sees it. Views into the owner's data.
struct QueryRow {
    std::string_view id;
    std::string_view className;
    std::string_view name;
    std::uint32_t parent = kNoRow;  ///< row index
    std::span<const Attribute> attributes;
    std::span<const std::uint32_t> groups;  ///< rows of the groups, storeys and units it is a member of
    double volume = 0;                      ///< m3
    std::uint64_t voxels = 0;
};

namespace query {
/// True for a Storey and for a group whose function, class or usage speaks of a storey or Geschoss.
[[nodiscard]] bool isStorey(const QueryRow& row);

}  // namespace query

/// A parsed query. Copyable, immutable, safe to use from several threads.
class Query {
public:
    static constexpr std::size_t kMaxBytes = 65536;  ///< of the text of a query
    static constexpr int kMaxDepth = 64;             ///< of brackets and nots

    /// \return the query, or Code::BadQuery with the 1-based byte column, what was found and what was expected
    [[nodiscard]] static Result<Query> parse(std::string_view text);

    /// Rows that match, ascending. A value that exists nowhere selects nothing; see unknownValue(). Rows may come in
    /// any order; a cycle of parents or groups does no harm. Cost: O(rows * terms). Regular expressions are searched in
    /// the first 4096 bytes of a value.
    [[nodiscard]] std::vector<std::uint32_t> select(std::span<const QueryRow> rows) const;

    /// Why the query may select nothing, in words that name the nearest existing value ("no class 'BuildingRom';
    /// did you mean 'BuildingRoom'?"), or empty where every value exists. Looks at what is asked with = or != or
    /// `under`, and at attribute names; the first in the text that no row has counts.
    [[nodiscard]] std::string unknownValue(std::span<const QueryRow> rows) const;

    [[nodiscard]] const std::string& text() const noexcept { return text_; }

    struct Node;  // in query_node.hpp

private:
    Query(std::string text, std::shared_ptr<const Node> root) : text_(std::move(text)), root_(std::move(root)) {}

    std::string text_;
    std::shared_ptr<const Node> root_;
};

}  // namespace svt::model
