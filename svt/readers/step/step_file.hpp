#pragma once
/// \file
/// A STEP physical file (ISO 10303-21, "clear text encoding") as an index of its records. Nothing is copied: a record
/// is a span of the text, and its values are cut out of it on request.
///
///     #12= IFCWALL('2XPyKWY018sA1ygZKgQPtU',#5,'Wall',$,$,#30,#40,$);
///      |   |       `--- values: step_value.hpp
///      |   type, numbered by the order in which types first occur
///      id

#include <svt/core/diagnostics.hpp>
#include <svt/core/result.hpp>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace svt::readers::step {

using RecordIndex = std::uint32_t;
inline constexpr RecordIndex kNoRecord = 0xFFFFFFFFu;

/// One `#id = TYPE(values);` of the data sections.
struct Record {
    std::uint64_t values = 0;  ///< offset in the text, behind the opening bracket
    std::uint32_t size = 0;    ///< bytes up to the closing bracket
    std::uint32_t id = 0;
    std::uint32_t type = 0;  ///< into StepFile::typeNames()
};

class StepFile {
public:
    /// Finds all records. Text within strings and comments is skipped. A record that cannot be read, such as one with
    /// a quote that is never closed, is left out with a finding (BadRecord). Reading continues at the next line that
    /// begins with `#<number>=`.
    /// \param text  must live as long as the result
    /// \param name  for messages
    /// \return the file; BadStep if the text is not a STEP file or has no record; InputTooBig for more than 2^31
    ///         records
    /// Cost: one pass, above 500 MB/s; 24 bytes per record.
    [[nodiscard]] static Result<StepFile> scan(std::string_view text, std::string_view name, Diagnostics& diagnostics);

    [[nodiscard]] const std::vector<Record>& records() const noexcept {
        return records_;
    }  ///< in the order of the file
    [[nodiscard]] std::size_t sizeBytes() const noexcept { return text_.size(); }
    /// Upper-case names of the types, by the order in which they first occur.
    [[nodiscard]] const std::vector<std::string_view>& typeNames() const noexcept { return typeNames_; }
    [[nodiscard]] std::string_view typeName(const Record& record) const noexcept { return typeNames_[record.type]; }
    /// Text between the brackets of a record.
    [[nodiscard]] std::string_view valuesOf(const Record& record) const noexcept {
        return text_.substr(record.values, record.size);
    }
    /// The record with this id, or kNoRecord; the first one if several have the id. Cost: O(1) for files numbered
    /// without large gaps, else O(log n).
    [[nodiscard]] RecordIndex find(std::uint32_t id) const noexcept;

    /// The record whose values hold `part`, a view of the text; kNoRecord if no record does. Cost: O(log n).
    [[nodiscard]] RecordIndex recordHolding(std::string_view part) const noexcept;

    /// 1-based line of a record. Cost: the first call counts all lines.
    [[nodiscard]] std::uint64_t lineOf(const Record& record) const;

    /// Whether the text ends without END-ISO-10303-21: a part of the file is missing.
    [[nodiscard]] bool isTruncated() const noexcept { return isTruncated_; }

    /// The names in FILE_SCHEMA, upper case as in the file: "IFC4X3_ADD2". Empty if the header does not have any.
    [[nodiscard]] const std::string& schema() const noexcept { return schema_; }

private:
    class Scanner;
    void makeIndex(std::string_view name, Diagnostics& diagnostics);

    std::string_view text_;
    std::string schema_;
    bool isTruncated_ = false;
    std::vector<Record> records_;
    std::vector<std::string_view> typeNames_;
    std::vector<RecordIndex> byId_;                                 // dense: id -> record
    std::vector<std::pair<std::uint32_t, RecordIndex>> sortedIds_;  // sparse
    mutable std::vector<std::uint64_t> lineStarts_;                 // of every eighth line
};

}  // namespace svt::readers::step
