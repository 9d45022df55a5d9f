#pragma once
/// \file
/// Cuts a large XML document into chunks that can be parsed independently, in one pass over its
/// bytes that examines only tags, quotes, comments and CDATA. Strict: accepted documents are
/// balanced, without DTD, and not nested deeper than allowed.

#include <svt/core/result.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace svt::readers::xml {

/// Bytes [begin, end) of the document.
struct Range {
    std::uint64_t begin = 0;
    std::uint64_t end = 0;
    [[nodiscard]] std::uint64_t size() const noexcept { return end - begin; }
};

/// A piece of the content of the root. Cuts lie between children of the root if possible. If a child is too large, cuts
/// lie one or two levels below, between its children or grandchildren. A file with one huge building is therefore cut
/// as well:
///
///     <CityModel> <member> <Building> ... | ... </Building> </member> <member> ... | ... </CityModel>
///                 `------- open ---------'     open tags of the second chunk: <member> <Building>
struct Chunk {
    Range content;
    std::vector<Range> open;  ///< start tags of the elements that are open at the start of the content, outermost first
    std::string closing;      ///< end tags of the elements that are open at the end of the content
};

/// Threads: not thread-safe. Cost: O(bytes), about 2 GB/s.
class Scanner {
public:
    /// \param text      the document, UTF-8, without byte order mark; must outlive the scanner
    /// \param fileName  used in error locations
    Scanner(std::string_view text, std::string fileName, std::uint32_t maxDepth);

    /// Reads the prolog and the start tag of the root.
    /// \return the tag of the root, or BadXml, DtdRefused
    Result<Range> begin();

    /// Finds the next chunk.
    /// \return false at the end of the document; BadXml, DtdRefused, or InputTooBig if nested too deeply
    Result<bool> next(Chunk& chunk);

    [[nodiscard]] std::uint64_t position() const noexcept { return position_; }

private:
    struct Tag {
        Range range;
        std::string_view name;
        bool isEnd = false;
        bool isEmpty = false;
    };
    // These return false after fail().
    bool nextTag(Tag& tag, bool& hasTag);  // hasTag: false at the end of the text
    bool readStartTag(Tag& tag);
    bool skipDeclaration();
    bool enterElement(const Tag& tag);
    bool leaveElement(const Tag& tag);
    bool fillChunk(Chunk& chunk);
    bool finish();
    bool fail(Code code, std::string message, std::uint64_t offset);
    [[nodiscard]] bool isCutAllowed(std::uint64_t chunkBegin) const noexcept;
    void close(Chunk& chunk, std::uint64_t end) const;

    std::string_view text_;
    std::string fileName_;
    std::uint64_t position_ = 0;
    std::uint32_t depth_ = 0;  // open elements
    std::uint32_t maxDepth_;
    Tag open_[4];  // the outermost open elements: root, member, feature, property
    std::optional<Error> error_;
};

/// The part of a document before the root element.
struct Prolog {
    bool hasRoot = false;
    bool hasDoctype = false;
    std::string_view rootName;  ///< qualified, as written
    std::string_view rootTag;   ///< from '<' to the end of the text
    std::string_view encoding;  ///< of the XML declaration, or empty
};

/// Reads the prolog of possible XML without validating it; `text` may be truncated anywhere.
[[nodiscard]] Prolog readProlog(std::string_view text) noexcept;

/// 1-based line and column (in bytes) of an offset.
struct LineColumn {
    std::uint64_t line = 1;
    std::uint64_t column = 1;
};
[[nodiscard]] LineColumn lineColumnAt(std::string_view text, std::uint64_t offset) noexcept;
[[nodiscard]] std::uint64_t countLines(std::string_view text) noexcept;

}  // namespace svt::readers::xml
