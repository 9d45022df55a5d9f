#include <svt/readers/step/read_guard.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace svt::readers::step {
namespace {

constexpr std::size_t kMaxDepth = 96;      // nested calls
constexpr std::size_t kMaxPath = 10'000;   // nested records, such as chains of booleans and placements
constexpr std::size_t kMaxCircles = 1000;  // the number of findings that are kept per code
constexpr std::size_t kMaxNamed = 12;      // records of a circle

// A product gets half of the file's free budget, so that a product that is too large does not prevent reading the
// others.
constexpr std::uint64_t kFreeSteps = 600'000'000, kStepsPerByte = 4000;
constexpr std::uint64_t kFreeElements = 1'000'000, kElementsPerByte = 32, kMostElements = 200'000'000;

}  // namespace

ReadGuard::ReadGuard(const StepFile& file) : file_(file), isOnPath_(file.records().size()) {
    const std::uint64_t bytes = file.sizeBytes();
    steps_.ofFile = kFreeSteps + kStepsPerByte * bytes;
    steps_.ofProduct = steps_.ofFile / 2;
    const std::uint64_t grown = std::min(kElementsPerByte * bytes, kMostElements) + bytes;
    elements_.ofFile = kFreeElements + grown;
    elements_.ofProduct = kFreeElements / 2 + grown;
}

ReadGuard::Scope::~Scope() {
    while (guard_.path_.size() > first_) guard_.pop();
    --guard_.depth_;
}

bool ReadGuard::Scope::enter(RecordIndex record) { return guard_.push(record); }

bool ReadGuard::Scope::enter(RecordIndex record, std::string& why) {
    const bool isEntered = enter(record);
    if (!isEntered) why = guard_.why_;
    return isEntered;
}

void ReadGuard::Scope::leave() noexcept {
    if (guard_.path_.size() > first_) guard_.pop();
}

bool ReadGuard::push(RecordIndex record) {
    if (isSpent()) {
        why_ = whatIsSpent();
        return false;
    }
    if (record == kNoRecord) return true;
    if (isOnPath_[record]) {
        const auto first = std::find(path_.begin(), path_.end(), record);
        why_ = "records that refer to each other in a circle: " + addCircle({first, path_.end()});
        return false;
    }
    if (depth_ > kMaxDepth || path_.size() >= kMaxPath) {
        why_ = fmt::format("records nested deeper than {} levels, with the record {}",
                           depth_ > kMaxDepth ? kMaxDepth : kMaxPath, nameOf(record));
        return false;
    }
    path_.push_back(record);
    isOnPath_[record] = true;
    return true;
}

void ReadGuard::pop() noexcept {
    isOnPath_[path_.back()] = false;
    path_.pop_back();
}

std::string ReadGuard::nameOf(RecordIndex record) const {
    const Record& named = file_.records()[record];
    return fmt::format("#{} {}", named.id, file_.typeName(named).substr(0, 60));
}

std::string ReadGuard::nameCircle(std::vector<RecordIndex> records) const {
    std::rotate(records.begin(), std::min_element(records.begin(), records.end()), records.end());
    const std::size_t named = std::min(records.size(), kMaxNamed);
    std::string text;
    for (std::size_t i = 0; i < named; ++i) text += nameOf(records[i]) + " -> ";
    if (records.size() > named) text += fmt::format("{} more -> ", records.size() - named);
    return text + fmt::format("#{}", file_.records()[records.front()].id);
}

std::string ReadGuard::addCircle(std::vector<RecordIndex> records) {
    const RecordIndex first = *std::min_element(records.begin(), records.end());
    std::string text = nameCircle(std::move(records));
    if (circles_.size() < kMaxCircles && known_.insert(text).second) circles_.push_back({first, text});
    return text;
}

bool ReadGuard::Budget::take(std::uint64_t count, bool isInProduct) noexcept {
    constexpr std::uint64_t kMost = std::uint64_t{1} << 62;
    count = std::min(count, kMost);
    takenOfFile = std::min(takenOfFile + count, kMost);
    if (isInProduct) takenOfProduct = std::min(takenOfProduct + count, kMost);
    return !isSpent(isInProduct);
}

std::uint64_t ReadGuard::Budget::left(bool isInProduct) const noexcept {
    if (isSpent(isInProduct)) return 0;
    const std::uint64_t inFile = ofFile - takenOfFile;
    return isInProduct ? std::min(inFile, ofProduct - takenOfProduct) : inFile;
}

bool ReadGuard::affords(std::uint64_t elements) noexcept {
    if (elements <= elements_.left(isInProduct_)) return true;
    if (elements > elements_.left(false))
        elements_.takenOfFile = elements_.ofFile + 1;
    else
        elements_.takenOfProduct = elements_.ofProduct + 1;
    return false;
}

void ReadGuard::beginProduct() noexcept {
    isInProduct_ = true;
    steps_.takenOfProduct = elements_.takenOfProduct = 0;
}

std::string ReadGuard::whatIsSpent() const {
    const bool isFile = isFileSpent();
    const bool isElements = elements_.isSpent(!isFile && isInProduct_);
    const Budget& budget = isElements ? elements_ : steps_;
    return fmt::format("more than {} {}, the limit for {}", isFile ? budget.ofFile : budget.ofProduct,
                       isElements ? "points and values" : "steps of reading",
                       isFile ? "a file of this size" : "one product of a file of this size");
}

}  // namespace svt::readers::step
