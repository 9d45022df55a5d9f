#pragma once
/// \file
/// words.bin: which buildings have a word in their name or attributes. docs/formats/city.md specifies it.

#include <svt/city/city_folder.hpp>
#include <svt/city/search/words.hpp>
#include <svt/core/file.hpp>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace svt::city {

inline constexpr std::size_t kWordsHead = 16, kBuildingsOfPage = 256, kWordsPage = std::size_t{16} << 10;
/// Limit of the unpacked bytes of a page of buildings. Texts are cut before, so that 256 buildings fit.
inline constexpr std::size_t kMostPageBytes = std::size_t{1} << 20;  // at least 256 * 4 * 1002

/// The place and checksum of a page.
struct WordsPage {
    std::uint64_t offset = 0, size = 0, checksum = 0;
    std::string first;  ///< first word of a page of words; empty for buildings
};
/// The end of words.bin: where its pages are.
struct WordsFence {
    std::vector<WordsPage> buildings, words;
};
/// \param fenceAt  offset of the fence: the pages end there
/// \return the fence; nothing if it is damaged
[[nodiscard]] std::optional<WordsFence> takeFence(std::string_view bytes, std::uint64_t fenceAt);

/// A word and its buildings: numbers in the order of the index, ascending.
struct WordRow {
    std::string word;
    std::vector<std::uint32_t> buildings;
};
/// Rows of a page of words; nothing if it is damaged. \param count  of all buildings
[[nodiscard]] std::optional<std::vector<WordRow>> takeWords(std::string_view page, std::uint64_t count);
/// Buildings of a page, without words; nothing if it is damaged.
[[nodiscard]] std::optional<std::vector<WordsOfBuilding>> takeBuildings(std::string_view page);

/// Writes words.bin. The bytes depend only on the buildings and their order.
/// Memory: `memoryBytes` and a page. Words beyond that are sorted into temporary files.
class WordsWriter {
public:
    /// \return the writer, or CannotWrite, DiskFull as AtomicFile::create()
    [[nodiscard]] static Result<WordsWriter> create(const std::filesystem::path& path,
                                                    std::size_t memoryBytes = std::size_t{256} << 20);
    WordsWriter(WordsWriter&&) noexcept;
    WordsWriter& operator=(WordsWriter&&) noexcept;
    ~WordsWriter();

    /// \return nothing, or CannotWrite, DiskFull; InputTooBig beyond 2^32 buildings
    Result<void> add(WordsOfBuilding building);
    /// \return the entry of city.json; CannotWrite, DiskFull, CannotOpen
    [[nodiscard]] Result<CityProof::Words> finish();

private:
    struct State;
    explicit WordsWriter(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

}  // namespace svt::city
