#pragma once
/// \file
/// The selection language that every command speaks:
///
///     class=BuildingRoom and volume>20
///     name~"Unterzug.*" or under "ID_storey_2"
///     storey="EG" and not (class=Window or ifcType=IfcDoor)
///
/// Grammar (keywords and class names without regard to case; values with blanks in "..." or '...'):
///     query      := and ('or' and)*
///     and        := not ('and' not)*
///     not        := 'not' not | '(' query ')' | term
///     term       := key op value | 'under' value | 'all' | 'none'
///     key        := class | id | name | storey | volume | voxels | lod | any attribute name (quoted where it has blanks)
///     op         := = | != | < | <= | > | >= | ~ (regular expression, found anywhere) | !~
/// `under X` takes everything below the feature whose id or name is X, itself included.
/// `storey=X` takes what is below or a member of a Storey (or of a group with a storey function) of that id or name.
/// A feature without the attribute matches no comparison with it, != and !~ included.

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
    std::uint32_t parent = kNoRow;               ///< row index
    std::span<const Attribute> attributes;
    std::span<const std::uint32_t> groups;       ///< rows of the groups, storeys and units it is a member of
    double volume = 0;                           ///< m3
    std::uint64_t voxels = 0;
};

/// A parsed query. Copyable, immutable, safe to use from several threads.
class Query {
public:
    /// \return the query, or Code::BadQuery with the place and what was expected
    [[nodiscard]] static Result<Query> parse(std::string_view text);

    /// Rows that match, ascending. A value of `class`, `id`, `under` or `storey` that exists nowhere selects nothing; see unknownValue().
    /// Cost: O(rows * terms). Regular expressions are searched in at most 4096 characters of a value.
    [[nodiscard]] std::vector<std::uint32_t> select(std::span<const QueryRow> rows) const;

    /// Why the query selects nothing, in words that name the nearest existing value
    /// ("no class 'BuildingRom'; did you mean 'BuildingRoom'?"), or empty where every value exists.
    [[nodiscard]] std::string unknownValue(std::span<const QueryRow> rows) const;

    [[nodiscard]] const std::string& text() const noexcept { return text_; }

    struct Node;  // in query.cpp

private:
    std::string text_;
    std::shared_ptr<const Node> root_;
};

}  // namespace svt::model
