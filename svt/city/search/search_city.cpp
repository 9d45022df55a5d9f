#include <svt/city/base/sha256.hpp>
#include <svt/city/city_folder.hpp>
#include <svt/city/search/words_file.hpp>
#include <svt/city/store/store.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace svt::city {
namespace {

constexpr const char* kFile = "words.bin";
constexpr std::uint64_t kMostBytes = std::uint64_t{16} << 20;  // of the pages of a beginning
constexpr std::size_t kMostFence = std::size_t{64} << 20;

}  // namespace

/// Reads words.bin. Each step reads all of its pages before it fails, so that a web page fetches them in one round
/// (CityBytes).
class WordSearch {
public:
    explicit WordSearch(const City& city) : city_(city) {}

    Result<City::Found> run(std::string_view text, std::size_t most) {
        const std::vector<WantedWord> wanted = wantedWords(text);
        if (wanted.empty()) return Error(Code::BadArgument, "the search has no words; give letters or digits");
        SVT_DO(open());
        SVT_TRY(pages, pagesOf(wanted));
        SVT_DO(request(*pages));
        std::vector<std::uint32_t> numbers;
        for (std::size_t n = 0; n < wanted.size(); ++n) {
            SVT_TRY(own, buildingsOf(wanted[n], (*pages)[n]));
            if (n == 0)
                numbers = std::move(*own);
            else
                numbers = common(numbers, *own);
        }
        City::Found found;
        found.count = numbers.size();
        numbers.resize(std::min(numbers.size(), most));
        SVT_DO(addBuildings(numbers, found));
        return found;
    }

private:
    using Pages = std::vector<const WordsPage*>;

    Result<void> open() {
        const auto& proof = city_.proof_;
        if (!proof || !proof->words)
            return city_.damaged(kFile, "the city has no index of words, because an earlier program merged it");
        words_ = *proof->words;
        // Buildings have 32-bit numbers.
        if (words_.count > 0xFFFFFFFF || words_.fenceAt > words_.bytes || words_.bytes - words_.fenceAt > kMostFence)
            return city_.damaged(kFile, "city.json names an impossible index of words");
        SVT_TRY(bytes, city_.store_->read(kFile, words_.fenceAt, words_.bytes - words_.fenceAt));
        auto fence = idHash(*bytes) == words_.fence ? takeFence(*bytes, words_.fenceAt) : std::nullopt;
        if (!fence || fence->buildings.size() != (words_.count + kBuildingsOfPage - 1) / kBuildingsOfPage)
            return city_.damaged(kFile, "the index of words is damaged or of another merge");
        fence_ = std::move(*fence);
        return {};
    }

    // The pages of each word.
    Result<std::vector<Pages>> pagesOf(const std::vector<WantedWord>& wanted) const {
        std::vector<Pages> all;
        for (const auto& [word, isBeginning] : wanted) {
            Pages pages;
            std::uint64_t bytes = 0;
            // The page before the first one that begins with the word may end with it.
            auto page = std::lower_bound(fence_.words.begin(), fence_.words.end(), word,
                                         [](const WordsPage& a, const std::string& b) { return a.first < b; });
            if (page != fence_.words.begin()) --page;
            for (; page != fence_.words.end() && (page->first <= word || page->first.starts_with(word)); ++page) {
                bytes += page->size;
                pages.push_back(&*page);
            }
            if (bytes > kMostBytes && isBeginning && pages.size() > 2)
                return Error(Code::BadArgument, fmt::format("too many words begin with \"{}\"; give more of it", word));
            all.push_back(std::move(pages));
        }
        return all;
    }

    // Reads all pages, and keeps none: CityBytes notes each missing one.
    Result<void> request(const std::vector<Pages>& all) const {
        std::optional<Error> missing;
        for (const Pages& pages : all)
            for (const WordsPage* page : pages)
                if (auto read = city_.store_->read(kFile, page->offset, page->size); !read) missing = read.error();
        return missing ? Result<void>(*missing) : Result<void>();
    }

    Result<std::string> read(const WordsPage& page) const {
        SVT_TRY(bytes, city_.store_->read(kFile, page.offset, page.size));
        if (idHash(*bytes) != page.checksum) return badPage(page);
        return bytes;
    }
    [[nodiscard]] Error badPage(const WordsPage& page) const {
        return city_.damaged(kFile, fmt::format("the page at byte {} is damaged", page.offset));
    }

    Result<std::vector<std::uint32_t>> buildingsOf(const WantedWord& wanted, const Pages& pages) const {
        std::vector<std::uint32_t> numbers;
        for (const WordsPage* page : pages) {
            SVT_TRY(bytes, read(*page));
            auto rows = takeWords(*bytes, words_.count);
            if (!rows) return badPage(*page);
            for (const auto& [word, buildings] : *rows)
                if (wanted.isBeginning ? word.starts_with(wanted.word) : word == wanted.word)
                    numbers.insert(numbers.end(), buildings.begin(), buildings.end());
        }
        std::sort(numbers.begin(), numbers.end());
        numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
        return numbers;
    }

    static std::vector<std::uint32_t> common(const std::vector<std::uint32_t>& a, const std::vector<std::uint32_t>& b) {
        std::vector<std::uint32_t> both;
        std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(both));
        return both;
    }

    // \param numbers  ascending
    Result<void> addBuildings(const std::vector<std::uint32_t>& numbers, City::Found& to) const {
        Pages pages;
        for (const std::uint32_t number : numbers)
            if (const WordsPage* page = &fence_.buildings[number / kBuildingsOfPage];
                pages.empty() || pages.back() != page)
                pages.push_back(page);
        SVT_DO(request({pages}));
        std::vector<WordsOfBuilding> rows;
        const WordsPage* open = nullptr;
        for (const std::uint32_t number : numbers) {
            const WordsPage& page = fence_.buildings[number / kBuildingsOfPage];
            if (&page != open) {
                SVT_TRY(bytes, read(page));
                auto own = takeBuildings(*bytes);
                if (!own) return badPage(page);
                rows = std::move(*own);
                open = &page;
            }
            if (number % kBuildingsOfPage >= rows.size()) return badPage(page);
            const WordsOfBuilding& row = rows[number % kBuildingsOfPage];
            to.buildings.push_back({row.id, row.name, row.className, row.address});
        }
        return {};
    }

    const City& city_;
    CityProof::Words words_;
    WordsFence fence_;
};

Result<City::Found> City::search(std::string_view text, std::size_t most) const {
    return WordSearch(*this).run(text, most);
}

}  // namespace svt::city
