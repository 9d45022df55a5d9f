#include <svt/core/text.hpp>
#include <svt/model/classes.hpp>
#include <svt/model/query/query_node.hpp>

#include <fmt/format.h>

#include <array>
#include <charconv>

namespace svt::model::query {
namespace {

using Kind = Node::Kind;
using Key = Node::Key;
using Op = Node::Op;

struct Token {
    enum class Type : std::uint8_t { Word, Quoted, Operator, Open, Close, End };
    Type type = Type::End;
    std::string text;        ///< without quotes
    std::size_t column = 1;  ///< 1-based byte
};

// The query as messages show it; a long one is cut off between two characters.
std::string shown(std::string_view query) {
    constexpr std::size_t kMaxShownBytes = 200;
    if (query.size() <= kMaxShownBytes) return std::string(query);
    std::size_t end = kMaxShownBytes;
    while (end > 0 && (static_cast<unsigned char>(query[end]) & 0xC0u) == 0x80u) --end;
    return fmt::format("{}...", query.substr(0, end));
}

class Parser {
public:
    explicit Parser(std::string_view text) : text_(text) {}

    Result<Node> run() {
        if (text_.size() > Query::kMaxBytes)
            return Error(Code::BadQuery,
                         fmt::format("the query has {} bytes; at most {} are allowed", text_.size(), Query::kMaxBytes));
        advance();
        if (token_.type == Token::Type::End && !error_)
            fail(token_.column, "the query is empty; write 'all' to select everything");
        Node root = alternatives(0);
        if (!error_ && token_.type != Token::Type::End) failExpected("'and', 'or' or the end of the query");
        if (error_) return *error_;
        return root;
    }

private:
    void fail(std::size_t column, std::string message) {
        if (!error_)
            error_ = Error(Code::BadQuery, fmt::format("the query '{}', column {}: {}", shown(text_), column, message),
                           {{}, 0, column, {}});
        token_ = {Token::Type::End, {}, column};
        position_ = text_.size();
    }
    void failExpected(std::string_view what) {
        std::string found = fmt::format("'{}'", token_.text);
        if (token_.type == Token::Type::End) found = "the end of the query";
        std::string hint;
        const bool isMore =
            token_.type == Token::Type::Word || token_.type == Token::Type::Quoted || token_.type == Token::Type::Open;
        if (isMore && afterValue_) hint = "; a value with blanks or brackets needs quotes";
        fail(token_.column, fmt::format("expected {}, found {}{}", what, found, hint));
    }

    void advance() {
        while (position_ < text_.size() && isBlank(text_[position_])) ++position_;
        token_ = {Token::Type::End, {}, position_ + 1};
        if (position_ >= text_.size()) return;
        const char c = text_[position_];
        if (c == '(' || c == ')') {
            token_.type = c == '(' ? Token::Type::Open : Token::Type::Close;
            token_.text = c;
            ++position_;
        } else if (c == '"' || c == '\'') {
            readQuoted(c);
        } else if (const std::string_view op = operatorAt(position_); !op.empty()) {
            token_.type = Token::Type::Operator;
            token_.text = op;
            position_ += op.size();
        } else {
            token_.type = Token::Type::Word;
            while (position_ < text_.size() && !isBlank(text_[position_]) && operatorAt(position_).empty() &&
                   std::string_view("()\"'").find(text_[position_]) == std::string_view::npos)
                token_.text += text_[position_++];
        }
    }

    [[nodiscard]] std::string_view operatorAt(std::size_t position) const noexcept {
        // Longer operators first.
        for (const std::string_view op : {"==", "!=", "<=", ">=", "!~", "=", "<", ">", "~"})
            if (text_.substr(position, op.size()) == op) return op;
        return {};
    }

    void readQuoted(char quote) {
        token_.type = Token::Type::Quoted;
        for (++position_; position_ < text_.size() && text_[position_] != quote; ++position_) {
            const bool isEscaped =
                text_[position_] == '\\' && position_ + 1 < text_.size() && text_[position_ + 1] == quote;
            if (isEscaped) ++position_;
            token_.text += text_[position_];
        }
        if (position_ >= text_.size()) return fail(token_.column, fmt::format("the quote {} is not closed", quote));
        ++position_;
    }

    [[nodiscard]] bool isKeyword(std::string_view word) const noexcept {
        return token_.type == Token::Type::Word && equalsIgnoringCase(token_.text, word);
    }
    bool takeKeyword(std::string_view word) {
        if (!isKeyword(word)) return false;
        advance();
        return true;
    }

    static Node joined(Kind kind, std::vector<Node> parts) {
        if (parts.size() == 1) return std::move(parts.front());
        Node node;
        node.kind = kind;
        node.children = std::move(parts);
        return node;
    }

    Node alternatives(int depth) {
        std::vector<Node> parts;
        do parts.push_back(conjunction(depth));
        while (takeKeyword("or"));
        return joined(Kind::Or, std::move(parts));
    }

    Node conjunction(int depth) {
        std::vector<Node> parts;
        do parts.push_back(negation(depth));
        while (takeKeyword("and"));
        return joined(Kind::And, std::move(parts));
    }

    Node negation(int depth) {
        if (depth > Query::kMaxDepth) {
            fail(token_.column, fmt::format("brackets and 'not' are nested deeper than {} levels, which is the limit",
                                            Query::kMaxDepth));
            return {};
        }
        afterValue_ = false;
        if (takeKeyword("not")) {
            Node node;
            node.kind = Kind::Not;
            node.children.push_back(negation(depth + 1));
            return node;
        }
        if (token_.type != Token::Type::Open) return term();
        const std::size_t column = token_.column;
        advance();
        Node node = alternatives(depth + 1);
        if (error_) return node;
        if (token_.type != Token::Type::Close) {
            failExpected(fmt::format("'and', 'or' or the ')' for the '(' at column {}", column));
            return node;
        }
        advance();
        return node;
    }

    Node term() {
        Node node;
        if (takeKeyword("all")) {
            node.kind = Kind::All;
        } else if (takeKeyword("none")) {
            node.kind = Kind::None;
        } else if (takeKeyword("under")) {
            node.kind = Kind::Under;
            node.value = value("'under'");
        } else if (token_.type == Token::Type::Word || token_.type == Token::Type::Quoted) {
            comparison(node);
        } else {
            failExpected("a term such as class=BuildingRoom, 'not' or '('");
        }
        return node;
    }

    std::string value(std::string_view after) {
        if (token_.type != Token::Type::Word && token_.type != Token::Type::Quoted) {
            failExpected(fmt::format("a value after {}", after));
            return {};
        }
        std::string text = token_.text;
        advance();
        afterValue_ = true;
        return text;
    }

    void comparison(Node& node) {
        node.kind = Kind::Compare;
        node.name = token_.text;
        node.key = token_.type == Token::Type::Quoted ? Key::Attribute : keyOf(token_.text);
        advance();
        if (token_.type != Token::Type::Operator)
            return failExpected(fmt::format("one of = != < <= > >= ~ !~ after '{}'", node.name));
        const std::string op = token_.text;
        const std::size_t opColumn = token_.column;
        node.op = opOf(op);
        advance();
        const Token valueToken = token_;
        node.value = value(fmt::format("'{}{}'", node.name, op));
        if (error_) return;

        const bool isPattern = node.op == Op::Found || node.op == Op::NotFound;
        const bool isEquality = node.op == Op::Equal || node.op == Op::NotEqual;
        const bool isNumber = node.key == Key::Volume || node.key == Key::Voxels;
        const bool isNameLike = node.key == Key::Class || node.key == Key::Id || node.key == Key::Storey;
        if (isNameLike && !isPattern && !isEquality)
            return fail(opColumn, fmt::format("'{}' can be compared by = != ~ !~, found '{}'", node.name, op));
        if (isNumber && isPattern)
            return fail(opColumn, fmt::format("'{}' is a number and can be compared by = != < <= > >=, found '{}'",
                                              node.name, op));
        if (isNumber && !isNumeric(node.value))
            return fail(valueToken.column,
                        fmt::format("expected a number after '{}{}', found '{}'", node.name, op, node.value));
        if (isPattern) return compilePattern(node, valueToken);
        if (node.key == Key::Class) node.value = canonicalClassName(node.value);
    }

    void compilePattern(Node& node, const Token& token) {
        auto pattern = Regex::compile(node.value);
        if (pattern) {
            node.pattern = std::move(*pattern);
            return;
        }
        const bool isQuoted = token.type == Token::Type::Quoted;
        const std::size_t inside = pattern.error().where().column;
        const std::size_t column = token.column + isQuoted + (inside > 0 ? inside - 1 : 0);
        fail(column, fmt::format("the regular expression cannot be used: {}", pattern.error().message()));
    }

    static bool isNumeric(std::string_view text) noexcept {
        double number = 0;
        const auto parsed = std::from_chars(text.data(), text.data() + text.size(), number);
        return parsed.ec == std::errc() && parsed.ptr == text.data() + text.size();
    }

    static Key keyOf(std::string_view word) noexcept {
        constexpr std::array<std::pair<std::string_view, Key>, 6> kKeys{{{"class", Key::Class},
                                                                         {"id", Key::Id},
                                                                         {"name", Key::Name},
                                                                         {"storey", Key::Storey},
                                                                         {"volume", Key::Volume},
                                                                         {"voxels", Key::Voxels}}};
        for (const auto& [name, key] : kKeys)
            if (equalsIgnoringCase(name, word)) return key;
        return Key::Attribute;
    }

    static Op opOf(std::string_view op) noexcept {
        if (op == "!=") return Op::NotEqual;
        if (op == "<") return Op::Less;
        if (op == "<=") return Op::LessEqual;
        if (op == ">") return Op::Greater;
        if (op == ">=") return Op::GreaterEqual;
        if (op == "~") return Op::Found;
        if (op == "!~") return Op::NotFound;
        return Op::Equal;
    }

    std::string_view text_;
    std::size_t position_ = 0;
    Token token_;
    bool afterValue_ = false;
    std::optional<Error> error_;
};

}  // namespace

Result<Node> parse(std::string_view text) { return Parser(text).run(); }

}  // namespace svt::model::query
