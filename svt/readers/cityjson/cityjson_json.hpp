#pragma once
/// \file
/// Parses JSON text and locates syntax errors. simdjson reports only the kind of an error,
/// so invalid text is scanned again by a simple scanner that tracks offsets.

#include <svt/core/diagnostics.hpp>
#include <svt/core/result.hpp>

#include <simdjson.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace svt::readers::cityjson {

namespace json = simdjson::dom;

/// The first syntax error of a text.
struct JsonFault {
    std::size_t offset = 0;
    Code code = Code::BadJson;  ///< BadJson, BadEncoding or InputTooBig (depth)
    std::string message;        ///< the found and the expected text
};

/// Half-open byte range of a text.
struct TextRange {
    std::size_t begin = 0, end = 0;
};

/// Checks `text` as one JSON value of at most `maxDepth` levels.
/// \param outOfRange  receives well-formed numbers that fit neither 64 bits nor a double
[[nodiscard]] std::optional<JsonFault> findJsonFault(std::string_view text, std::uint32_t maxDepth,
                                                     std::vector<TextRange>& outOfRange);

/// Position of a text in its file.
struct TextOrigin {
    std::string_view file;
    std::uint64_t firstLine = 1;  ///< 1-based line of the first byte of the text
};

/// One parsed text; its elements are valid as long as this object, or until the next parse.
class JsonText {
public:
    /// Parses one JSON value. A number beyond the range of double is read as null and reported (BadValue).
    /// \return the root, or BadJson, BadEncoding or InputTooBig with line and column
    [[nodiscard]] Result<json::element> parse(std::string_view text, const TextOrigin& origin, std::uint32_t maxDepth,
                                              Diagnostics& diagnostics);

private:
    [[nodiscard]] Result<json::element> parseAgain(std::string_view text, const TextOrigin& origin,
                                                   std::uint32_t maxDepth, simdjson::error_code error,
                                                   Diagnostics& diagnostics);

    json::parser parser_;
};

/// Whether `text` ends within a string, an object or an array. Cost: O(size).
[[nodiscard]] bool isCutOff(std::string_view text) noexcept;

/// `text` truncated at a character boundary to a length suitable for messages and generated ids.
[[nodiscard]] std::string shortened(std::string_view text);

// Typed access; absent for an absent value or a wrong type.
using OptionalElement = std::optional<json::element>;
[[nodiscard]] std::optional<json::object> asObject(const OptionalElement& value) noexcept;
[[nodiscard]] std::optional<json::array> asArray(const OptionalElement& value) noexcept;
[[nodiscard]] std::optional<std::string_view> asString(const OptionalElement& value) noexcept;
[[nodiscard]] std::optional<double> asNumber(const OptionalElement& value) noexcept;
/// An integer, also if written as 3.0.
[[nodiscard]] std::optional<std::int64_t> asInteger(const OptionalElement& value) noexcept;
/// The first member `key` of `object`; absent for an absent object or member.
[[nodiscard]] OptionalElement findMember(std::optional<json::object> object, std::string_view key) noexcept;

}  // namespace svt::readers::cityjson
