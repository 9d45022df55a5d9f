#pragma once
/// \file
/// The parsed form of a query.

#include <svt/model/query.hpp>
#include <svt/model/query/regex.hpp>

#include <optional>

namespace svt::model {

struct Query::Node {
    enum class Kind : std::uint8_t { And, Or, Not, Compare, Under, All, None };
    enum class Key : std::uint8_t { Class, Id, Name, Storey, Volume, Voxels, Attribute };
    enum class Op : std::uint8_t { Equal, NotEqual, Less, LessEqual, Greater, GreaterEqual, Found, NotFound };

    Kind kind = Kind::None;
    std::vector<Node> children;  ///< of And, Or, Not

    // Used by Compare; Under uses `value` only
    Key key = Key::Attribute;
    Op op = Op::Equal;
    std::string name;   ///< name of the key as written
    std::string value;  ///< as written; for a class its canonical name
    std::optional<Regex> pattern;
};

namespace query {

using Node = Query::Node;

/// Parses a query; errors as Query::parse().
[[nodiscard]] Result<Node> parse(std::string_view text);

/// The class of a row in the source, in addition to that of the model: its attribute `ifcType`, or empty.
[[nodiscard]] std::string_view sourceClass(const QueryRow& row) noexcept;

[[nodiscard]] bool containsWord(std::string_view text, std::string_view word) noexcept;

}  // namespace query
}  // namespace svt::model
