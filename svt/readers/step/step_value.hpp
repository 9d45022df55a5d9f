#pragma once
/// \file
/// Values of a STEP record, cut out of the text on request.
///
///     '2XPy',#5,(1.,2.),$,.T.,IFCLABEL('x')     the values of a record
///       |    |     |    |  |       `--- a typed value: typeName() and inner()
///       |    |     |    |  enumeration or truth value
///       |    |     |    nothing ($, or * for a derived one)
///       |    |     list
///       |    reference
///       string

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace svt::readers::step {

/// One value, a view of the text without blanks and comments around it.
class Value {
public:
    Value() = default;
    explicit Value(std::string_view text) noexcept : text_(text) {}

    [[nodiscard]] std::string_view text() const noexcept { return text_; }
    [[nodiscard]] bool isNothing() const noexcept { return text_.empty() || text_ == "$" || text_ == "*"; }
    [[nodiscard]] bool isList() const noexcept { return text_.starts_with('('); }
    [[nodiscard]] bool isString() const noexcept { return text_.starts_with('\''); }
    [[nodiscard]] bool isTyped() const noexcept;

    /// Id of the record that a reference names.
    [[nodiscard]] std::optional<std::uint32_t> reference() const noexcept;
    /// A finite number; for a typed value, the number within it.
    [[nodiscard]] std::optional<double> number() const noexcept;
    [[nodiscard]] std::optional<std::int64_t> integer() const noexcept;
    /// A string with its escapes decoded, as UTF-8.
    [[nodiscard]] std::optional<std::string> string() const;
    /// The name between the dots of an enumeration: "T", "ELEMENT"; empty for anything else.
    [[nodiscard]] std::string_view enumeration() const noexcept;

    /// Type of a typed value, IFCLABEL of IFCLABEL('x'); empty for others.
    [[nodiscard]] std::string_view typeName() const noexcept;
    /// The value within a typed value, else the value itself.
    [[nodiscard]] Value inner() const noexcept;

private:
    std::string_view text_;
};

/// Iterates over the values of a record or list.
class ValueCursor {
public:
    /// \param text  the text between the brackets
    explicit ValueCursor(std::string_view text) noexcept : rest_(text) {}
    /// Iterates over the items of a list; no items for another value.
    explicit ValueCursor(Value list) noexcept;
    /// The next value; false at the end. Cost: O(its bytes).
    bool next(Value& value) noexcept;

private:
    std::string_view rest_;
    bool isDone_ = false;
};

/// All values between two brackets. Cost: O(bytes), no recursion.
[[nodiscard]] std::vector<Value> splitValues(std::string_view text);
/// The items of a list; none for another value.
[[nodiscard]] std::vector<Value> itemsOf(Value list);

/// Text of a STEP string. Escapes: '' is a quote, \\ a backslash, \X\hh a byte of ISO 8859-1, \S\c the same plus 128
/// (of the part of ISO 8859 that \P.\ chose), \X2\hhhh...\X0\ UTF-16, \X4\hhhhhhhh...\X0\ UTF-32. Bytes beyond ASCII
/// are not allowed but common. They are read as UTF-8, or as ISO 8859-1 if they are not valid UTF-8. An invalid escape
/// is kept unchanged.
/// \param quoted  without the quotes around it
[[nodiscard]] std::string decodeString(std::string_view quoted);

}  // namespace svt::readers::step
