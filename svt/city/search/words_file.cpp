#include <svt/city/search/words_file.hpp>

#include <svt/city/base/sha256.hpp>
#include <svt/core/bytes.hpp>
#include <svt/core/deflate.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <queue>
#include <unordered_map>

namespace svt::city {
namespace {

constexpr std::uint32_t kVersion = 1;
constexpr std::size_t kMostTextBytes = 1000;  // of an id, a name, a class or an address in a page of buildings
constexpr std::size_t kBytesOfEntry = 150;    // of a word in memory, besides its text

void appendText(std::string& to, std::string_view text) {
    appendVarint(to, text.size());
    to += text;
}

std::optional<std::string_view> takeText(ByteReader& from, std::size_t most) {
    const std::uint64_t size = from.takeVarint();
    if (!from.isGood() || size > most || size > from.left()) return std::nullopt;
    return from.text(size);
}

// Buildings of a word: differences of their numbers.
struct Postings {
    std::uint64_t count = 0;
    std::uint32_t first = 0, last = 0;
    std::string rest;  // differences after the first

    void add(std::uint32_t building) {
        if (count++ == 0)
            first = building;
        else
            appendVarint(rest, building - last);
        last = building;
    }
    // \param later  buildings after all of these
    void add(const Postings& later) {
        if (count == 0) {
            *this = later;
            return;
        }
        appendVarint(rest, later.first - last);
        rest += later.rest;
        count += later.count;
        last = later.last;
    }
};

// Appends a word as temporary files have it; Run reads it.
void appendRun(std::string& to, const std::string& word, const Postings& postings) {
    appendText(to, word);
    appendBytes(to, postings.count, postings.first, postings.last);
    appendText(to, postings.rest);
}

// Reads the words of a temporary file one by one.
class Run {
public:
    static Result<Run> open(const std::filesystem::path& path) {
        SVT_TRY(file, PartFile::open(path));
        Run run(std::move(*file));
        SVT_DO(run.next());
        return run;
    }
    Result<void> next() {
        isAtEnd = at_ == file_.size() && used_ == buffer_.size();
        if (isAtEnd) return {};
        SVT_TRY(wordBytes, size());
        SVT_DO(take(*wordBytes, word));
        std::string numbers;
        SVT_DO(take(16, numbers));
        ByteReader(numbers).take(postings.count, postings.first, postings.last);
        SVT_TRY(restBytes, size());
        return take(*restBytes, postings.rest);
    }

    bool isAtEnd = false;
    std::string word;
    Postings postings;

private:
    explicit Run(PartFile file) : file_(std::move(file)) {}
    Result<void> fill(std::size_t least) {
        if (buffer_.size() - used_ >= least) return {};
        buffer_.erase(0, used_);
        used_ = 0;
        SVT_TRY(more, file_.readAll(at_, std::min<std::uint64_t>(std::max(least, kWordsPage), file_.size() - at_)));
        at_ += more->size();
        buffer_ += *more;
        return {};
    }
    Result<std::uint64_t> size() {
        SVT_DO(fill(std::min<std::uint64_t>(10, file_.size() - at_ + buffer_.size() - used_)));
        ByteReader from(std::string_view(buffer_).substr(used_));
        const std::size_t before = from.left();
        const std::uint64_t value = from.takeVarint();
        used_ += before - from.left();
        return value;
    }
    Result<void> take(std::size_t bytes, std::string& to) {
        if (bytes > buffer_.size() - used_) SVT_DO(fill(bytes));
        to.assign(buffer_, used_, bytes);
        used_ += bytes;
        return {};
    }

    PartFile file_;
    std::uint64_t at_ = 0;
    std::string buffer_;
    std::size_t used_ = 0;
};

std::size_t sharedBytes(std::string_view a, std::string_view b) {
    return static_cast<std::size_t>(std::mismatch(a.begin(), a.end(), b.begin(), b.end()).first - a.begin());
}

void appendPages(std::string& to, const std::vector<WordsPage>& pages) {
    appendVarint(to, pages.size());
    for (const WordsPage& page : pages) {
        appendVarint(to, page.size);
        appendBytes(to, page.checksum);
        appendText(to, page.first);
    }
}

}  // namespace

struct WordsWriter::State {
    State(AtomicFile target, std::size_t memory) : file(std::move(target)), memoryBytes(memory), packer(9) {}

    Result<void> write(std::string_view text) {
        sum.add(text);
        return file.write(text);
    }
    Result<void> writePage(std::string_view text, std::string firstWord, std::vector<WordsPage>& pages) {
        pages.push_back({file.size(), text.size(), idHash(text), std::move(firstWord)});
        return write(text);
    }
    Result<void> endBuildings() {
        if (buildings.empty()) return {};
        const auto packed = packer.pack(std::as_bytes(std::span(buildings)));
        std::string text;
        appendVarint(text, buildings.size());
        text.append(reinterpret_cast<const char*>(packed.data()), packed.size());
        buildings.clear();
        return writePage(text, {}, fence.buildings);
    }

    // The words in memory, in order.
    std::vector<std::pair<std::string, Postings>> takeSorted() {
        std::vector<std::pair<std::string, Postings>> sorted;
        sorted.reserve(words.size());
        while (!words.empty()) {
            auto node = words.extract(words.begin());
            sorted.emplace_back(std::move(node.key()), std::move(node.mapped()));
        }
        std::sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
        bytes = 0;
        return sorted;
    }
    Result<void> spill() {
        if (!folder) folder.emplace();
        if (folder->path().empty())
            return Error(Code::CannotWrite,
                         "cannot make a temporary folder for the index of words; set TMPDIR to a writable folder");
        const std::filesystem::path path = folder->path() / fmt::format("words-{}", runs.size());
        SVT_TRY(run, AtomicFile::create(path));
        std::string text;
        for (const auto& [word, postings] : takeSorted()) {
            text.clear();
            appendRun(text, word, postings);
            SVT_DO(run->write(text));
        }
        SVT_DO(run->commit(AtomicFile::Durability::Temporary));
        runs.push_back(path);
        return {};
    }

    Result<void> addWord(const std::string& word, const Postings& postings) {
        const std::size_t shared = page.empty() ? 0 : sharedBytes(before, word);
        if (page.empty()) first = word;
        appendVarint(page, shared);
        appendText(page, std::string_view(word).substr(shared));
        appendVarint(page, postings.count);
        appendVarint(page, postings.first);
        page += postings.rest;
        before = word;
        return page.size() < kWordsPage ? Result<void>() : endWords();
    }
    Result<void> endWords() {
        if (page.empty()) return {};
        SVT_DO(writePage(page, first, fence.words));
        page.clear();
        return {};
    }
    // Words of all temporary files; those of one word in the order of the files, which is that of the buildings.
    Result<void> mergeRuns() {
        std::vector<Run> open;
        for (const std::filesystem::path& path : runs) {
            SVT_TRY(run, Run::open(path));
            open.push_back(std::move(*run));
        }
        const auto isLater = [&](std::size_t a, std::size_t b) {
            return std::tie(open[a].word, a) > std::tie(open[b].word, b);
        };
        std::priority_queue<std::size_t, std::vector<std::size_t>, decltype(isLater)> queue(isLater);
        for (std::size_t n = 0; n < open.size(); ++n)
            if (!open[n].isAtEnd) queue.push(n);
        while (!queue.empty()) {
            const std::string word = open[queue.top()].word;
            Postings all;
            while (!queue.empty() && open[queue.top()].word == word) {
                const std::size_t n = queue.top();
                queue.pop();
                all.add(open[n].postings);
                SVT_DO(open[n].next());
                if (!open[n].isAtEnd) queue.push(n);
            }
            SVT_DO(addWord(word, all));
        }
        return {};
    }

    AtomicFile file;
    std::size_t memoryBytes;
    ZlibPacker packer;
    Sha256 sum;
    WordsFence fence;
    std::uint64_t count = 0;
    std::string buildings;  // of the page, unpacked
    std::unordered_map<std::string, Postings> words;
    std::size_t bytes = 0;  // of the words in memory
    std::optional<PrivateFolder> folder;
    std::vector<std::filesystem::path> runs;
    std::string page, first, before;  // of words
};

WordsWriter::WordsWriter(std::unique_ptr<State> state) : state_(std::move(state)) {}
WordsWriter::WordsWriter(WordsWriter&&) noexcept = default;
WordsWriter& WordsWriter::operator=(WordsWriter&&) noexcept = default;
WordsWriter::~WordsWriter() = default;

Result<WordsWriter> WordsWriter::create(const std::filesystem::path& path, std::size_t memoryBytes) {
    SVT_TRY(file, AtomicFile::create(path));
    auto state = std::make_unique<State>(std::move(*file), memoryBytes);
    std::string head("svtwords", 8);
    appendAs<std::uint32_t>(head, kVersion, kBuildingsOfPage);
    SVT_DO(state->write(head));
    return WordsWriter(std::move(state));
}

Result<void> WordsWriter::add(WordsOfBuilding building) {
    State& own = *state_;
    if (own.count == std::numeric_limits<std::uint32_t>::max())
        return Error(Code::InputTooBig, "the index of words holds at most 4,294,967,295 buildings");
    for (const std::string* text : {&building.id, &building.name, &building.className, &building.address})
        appendText(own.buildings, shortened(*text, kMostTextBytes));
    const auto number = static_cast<std::uint32_t>(own.count++);
    for (std::string& word : building.words) {
        const std::size_t textBytes = word.size();
        Postings& postings = own.words[std::move(word)];
        const std::size_t before = postings.rest.size();
        postings.add(number);
        own.bytes += postings.count == 1 ? kBytesOfEntry + textBytes : postings.rest.size() - before;
    }
    if (own.count % kBuildingsOfPage == 0) SVT_DO(own.endBuildings());
    return own.bytes < own.memoryBytes ? Result<void>() : own.spill();
}

Result<CityProof::Words> WordsWriter::finish() {
    State& own = *state_;
    SVT_DO(own.endBuildings());
    if (own.runs.empty()) {
        for (const auto& [word, postings] : own.takeSorted()) SVT_DO(own.addWord(word, postings));
    } else {
        if (!own.words.empty()) SVT_DO(own.spill());
        SVT_DO(own.mergeRuns());
    }
    SVT_DO(own.endWords());
    std::string fence;
    appendPages(fence, own.fence.buildings);
    appendPages(fence, own.fence.words);
    CityProof::Words proof;
    proof.count = own.count;
    proof.fenceAt = own.file.size();
    proof.fence = idHash(fence);
    SVT_DO(own.write(fence));
    proof.bytes = own.file.size();
    proof.sha256 = hexOf(own.sum.finish());
    SVT_DO(own.file.commit());
    return proof;
}

std::optional<WordsFence> takeFence(std::string_view bytes, std::uint64_t fenceAt) {
    if (fenceAt < kWordsHead) return std::nullopt;
    WordsFence fence;
    std::uint64_t offset = kWordsHead;
    ByteReader from(bytes);
    for (std::vector<WordsPage>* pages : {&fence.buildings, &fence.words}) {
        const std::uint64_t count = from.takeVarint();
        if (!from.isGood() || count > from.left() / 10) return std::nullopt;
        for (std::uint64_t n = 0; n < count; ++n) {
            WordsPage& page = pages->emplace_back();
            page.offset = offset;
            page.size = from.takeVarint();
            page.checksum = from.take<std::uint64_t>();
            const auto first = takeText(from, kMostWordBytes);
            if (!first || page.size > fenceAt - offset) return std::nullopt;
            page.first = *first;
            offset += page.size;
            if (n > 0 && page.first < (*pages)[n - 1].first) return std::nullopt;
        }
    }
    if (!from.isGood() || from.left() != 0 || offset != fenceAt) return std::nullopt;
    return fence;
}

std::optional<std::vector<WordRow>> takeWords(std::string_view page, std::uint64_t count) {
    std::vector<WordRow> rows;
    std::string word;
    for (ByteReader from(page); from.left() > 0;) {
        const std::uint64_t shared = from.takeVarint();
        const auto rest = takeText(from, kMostWordBytes);
        if (!rest || shared > word.size()) return std::nullopt;
        word.resize(shared);
        word += *rest;
        const std::uint64_t buildings = from.takeVarint();
        if (!from.isGood() || word.size() > kMostWordBytes || buildings > from.left()) return std::nullopt;
        WordRow& row = rows.emplace_back(WordRow{word, {}});
        row.buildings.reserve(buildings);
        std::uint64_t number = 0;
        for (std::uint64_t n = 0; n < buildings; ++n) {
            const std::uint64_t step = from.takeVarint();
            if (!from.isGood() || step > count || (n > 0 && step == 0)) return std::nullopt;
            number += step;
            if (number >= count) return std::nullopt;
            row.buildings.push_back(static_cast<std::uint32_t>(number));
        }
    }
    return rows;
}

std::optional<std::vector<WordsOfBuilding>> takeBuildings(std::string_view page) {
    ByteReader packed(page);
    const std::uint64_t size = packed.takeVarint();
    if (!packed.isGood() || size > kMostPageBytes) return std::nullopt;
    std::string bytes(size, '\0');
    const std::string_view rest = packed.text(packed.left());
    if (!inflateInto(std::as_bytes(std::span(rest)), DeflateFormat::Zlib, std::as_writable_bytes(std::span(bytes))))
        return std::nullopt;
    std::vector<WordsOfBuilding> buildings;
    for (ByteReader from(bytes); from.left() > 0;) {
        const auto id = takeText(from, kMostTextBytes), name = takeText(from, kMostTextBytes),
                   className = takeText(from, kMostTextBytes), address = takeText(from, kMostTextBytes);
        if (!id || !name || !className || !address || buildings.size() == kBuildingsOfPage) return std::nullopt;
        buildings.push_back({std::string(*id), std::string(*name), std::string(*className), std::string(*address), {}});
    }
    return buildings;
}

}  // namespace svt::city
