#pragma once
/// \file
/// The hatch of a material by words of its name, in several languages.

#include <svt/core/result.hpp>
#include <svt/render/hatch.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace svt::drawing {

/// Names of materials consist of words: letters and digits. An entry of the table is one or more words that follow each
/// other in a name, in any case, with or without the English plural: "concrete block" matches "Concrete blocks, 100". A
/// `*` at the end of an entry means that the word may go on; a `*` at the beginning means that it may begin earlier.
/// `*beton` matches "Stahlbeton", but `glass` does not match "Fiberglass". Chinese and Japanese entries match anywhere.
/// The entry with the most words decides, then the first row.
class MaterialTable {
public:
    struct Row {
        render::Hatch hatch = render::Hatch::General;
        bool isLoadBearing = false;  ///< whether a layer of it decides the hatch of a wall before all other layers
    };
    struct Match {
        Row row;
        std::string entry;  ///< the matching entry
    };

    /// The table of the program: English, German, French, Dutch, Norwegian, Swedish, Danish, Finnish, Spanish, Italian,
    /// Japanese.
    [[nodiscard]] static const MaterialTable& builtIn();

    /// Parses CSV with the columns `hatch`, `loadBearing` (`yes` or `no`) and `words` (entries separated by `|`). Lines
    /// that begin with `#` are comments.
    /// \param file  for messages
    /// \return the rows, or BadValue with the line
    [[nodiscard]] static Result<MaterialTable> parseCsv(std::string_view text, std::string_view file);

    void add(const Row& row, std::string_view entries);
    /// Adds the rows of another table after the own ones, which take precedence.
    void append(const MaterialTable& other);

    /// The row of a material by its name; nothing if no entry matches. Cost: O(entries).
    [[nodiscard]] std::optional<Match> find(std::string_view name) const;

private:
    struct Entry {
        std::vector<std::string> words;  ///< lower case; one text for Chinese and Japanese
        std::string text;
        std::size_t row = 0;
        bool hasMoreBefore = false, hasMoreAfter = false, isAnywhere = false;
    };
    [[nodiscard]] static bool matches(const Entry& entry, const std::vector<std::string>& words,
                                      const std::string& folded);

    std::vector<Row> rows_;
    std::vector<Entry> entries_;
};

/// Parses a table of the user: CSV as above, or JSON, `{"replace": false, "materials": [{"words": ["Poroton"],
/// "hatch": "masonry", "loadBearing": true}]}`. Its rows take precedence over the table of the program. With `replace`,
/// or a line `#replace` in CSV, they replace it.
/// \return the table, or BadValue (CSV), or BadJson
[[nodiscard]] Result<MaterialTable> parseMaterials(std::string_view text, const std::string& file);

}  // namespace svt::drawing
