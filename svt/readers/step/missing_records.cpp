#include <svt/readers/step/missing_records.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace svt::readers::step {
namespace {

// "attribute 1 of #201 IFCAXIS2PLACEMENT3D"
std::string attributeText(const StepFile& file, const Record& record, Value reference) {
    std::size_t number = 0;
    ValueCursor cursor(file.valuesOf(record));
    for (Value value; cursor.next(value);) {
        ++number;
        if (reference.text().data() < value.text().data() + value.text().size()) break;
    }
    return fmt::format("attribute {} of #{} {}", number, record.id, file.typeName(record).substr(0, 80));
}

}  // namespace

void MissingRecords::note(Value reference) {
    const auto isSame = [&](Value other) { return other.text().data() == reference.text().data(); };
    if (recent_.size() < kMaxTaken && std::none_of(recent_.begin(), recent_.end(), isSame))
        recent_.push_back(reference);
    if (known_.size() == kMaxKnown) {
        if (!isKnown_.contains(reference.text().data())) ++more_;
    } else if (isKnown_.insert(reference.text().data()).second) {
        known_.push_back(reference);
    }
}

std::vector<std::string> MissingRecords::take() {
    std::vector<std::string> words;
    for (const Value reference : recent_)
        if (const RecordIndex record = file_.recordHolding(reference.text()); record != kNoRecord)
            words.push_back(fmt::format("{}, to which {} refers and which the file lacks", reference.text(),
                                        attributeText(file_, file_.records()[record], reference)));
    recent_.clear();
    return words;
}

void MissingRecords::report(std::string_view name, Diagnostics& diagnostics) const {
    std::vector<Value> sorted = known_;
    std::sort(sorted.begin(), sorted.end(),
              [](Value a, Value b) { return std::less<>{}(a.text().data(), b.text().data()); });
    std::size_t count = 0;
    for (const Value reference : sorted) {
        const RecordIndex index = file_.recordHolding(reference.text());
        // Texts that would not be kept are not made: a list of a million such references is one long record.
        if (index == kNoRecord || ++count > Diagnostics::kKeptPerCode) {
            diagnostics.add(Severity::Warning, Code::DanglingReference, "");
            continue;
        }
        const Record& record = file_.records()[index];
        diagnostics.add(Severity::Warning, Code::DanglingReference,
                        fmt::format("{} refers to {}, which the file lacks", attributeText(file_, record, reference),
                                    reference.text()),
                        {std::string(name), file_.lineOf(record), 0, {}});
    }
    for (std::size_t i = 0; i < more_; ++i) diagnostics.add(Severity::Warning, Code::DanglingReference, "");
}

}  // namespace svt::readers::step
