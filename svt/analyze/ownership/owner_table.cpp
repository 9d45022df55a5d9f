#include <svt/analyze/owners.hpp>

#include <svt/analyze/extents.hpp>
#include <svt/analyze/selection.hpp>
#include <svt/core/edit_distance.hpp>
#include <svt/core/text.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <tuple>
#include <unordered_map>

namespace svt::analyze {
namespace {

constexpr std::size_t kMaxBytes = std::size_t{64} << 20;
// Maximum number of features that all rows together may test: about a minute of work.
constexpr std::uint64_t kMaxVisits = std::uint64_t{1} << 30;
constexpr std::size_t kMaxRights = std::size_t{1} << 24;

struct TableRow {
    std::vector<std::string> fields;
    std::uint64_t line = 0;
};

// Parses a table row by row; a quoted field may contain line breaks.
class TableReader {
public:
    TableReader(std::string_view text, std::string_view file) : text_(text), file_(file) {
        if (text_.substr(0, 3) == "\xEF\xBB\xBF") text_.remove_prefix(3);
        bool isQuoted = false;
        for (const char c : text_) {
            if (c == '"') isQuoted = !isQuoted;
            if (isQuoted) continue;
            if (c == '\n') break;
            if (c == ',' || c == ';') {
                separator_ = c;
                break;
            }
        }
    }

    [[nodiscard]] bool isAtEnd() const noexcept { return at_ == text_.size(); }

    /// The next row; without fields if its line is empty.
    [[nodiscard]] Result<TableRow> next() {
        TableRow row;
        row.line = line_;
        while (true) {
            SVT_TRY(field, nextField());
            row.fields.push_back(std::move(*field));
            if (isAtEnd()) break;
            const char c = text_[at_++];
            if (c == separator_) continue;
            ++line_;
            break;
        }
        if (row.fields.size() == 1 && row.fields[0].empty()) row.fields.clear();
        return row;
    }

private:
    [[nodiscard]] Error bad(std::string_view reason) const {
        return Error(Code::BadValue, fmt::format("owners table: {}", reason), {std::string(file_), line_, 0, {}});
    }

    // Reads a field, up to a separator, or the end of the line or text.
    Result<std::string> nextField() {
        const auto isEnd = [&] { return isAtEnd() || text_[at_] == separator_ || text_[at_] == '\n'; };
        std::string field;
        skipBlanks();
        if (!isAtEnd() && text_[at_] == '"') {
            const std::uint64_t begin = line_;
            for (++at_;; ++at_) {
                if (isAtEnd()) {
                    line_ = begin;
                    return bad("a quote that is opened here is never closed");
                }
                if (text_[at_] == '"' && text_.substr(at_ + 1, 1) == "\"")
                    ++at_;
                else if (text_[at_] == '"')
                    break;
                if (text_[at_] == '\n') ++line_;
                field += text_[at_];
            }
            ++at_;
            skipBlanks();
            if (!isEnd())
                return bad("text behind a closing quote; write a quote inside of a field twice, the field in quotes");
            return field;
        }
        while (!isEnd()) field += text_[at_++];
        while (!field.empty() && isBlank(field.back())) field.pop_back();
        return field;
    }
    static bool isBlank(char c) noexcept { return c == ' ' || c == '\t' || c == '\r'; }
    void skipBlanks() noexcept {
        while (!isAtEnd() && isBlank(text_[at_])) ++at_;
    }

    std::string_view text_, file_;
    std::size_t at_ = 0;
    std::uint64_t line_ = 1;
    char separator_ = ',';
};

// Look-up of features by id.
class Features {
public:
    explicit Features(const volume::LabelTable& table) : table_(table) {
        for (std::uint32_t l = 0; l < table.labels.size(); ++l) byId_.emplace(table.labels[l].id, l);
    }

    // \return the feature with the id, or those that the query selects
    [[nodiscard]] Result<std::vector<std::uint32_t>> find(const std::string& text, std::uint64_t& visits) const {
        if (const auto known = byId_.find(text); known != byId_.end()) return std::vector<std::uint32_t>{known->second};
        visits += table_.labels.size();
        if (!model::Query::parse(text))
            return Error(Code::NothingSelected,
                         fmt::format("'{}' is neither the id of a feature nor a query{}", text, nearest(text)));
        return selectLabels(table_, text);
    }

private:
    // "; did you mean 'x'?", or empty.
    [[nodiscard]] std::string nearest(std::string_view id) const {
        const std::size_t limit = std::max<std::size_t>(2, id.size() / 4);
        std::string_view best;
        std::size_t least = limit + 1;
        for (const volume::Label& label : table_.labels) {
            const std::size_t distance = editDistance(id, label.id, limit);
            if (distance < least) {
                least = distance;
                best = label.id;
            }
        }
        return best.empty() ? "" : fmt::format("; did you mean '{}'?", best);
    }

    const volume::LabelTable& table_;
    std::unordered_map<std::string_view, std::uint32_t> byId_;
};

// The columns of a table: the place of each field in a row.
struct TableColumns {
    enum Name : std::size_t { Feature, Owner, Share, Right, Source, Count };
    static constexpr std::array<std::string_view, Count> kNames{"feature", "owner", "share", "right", "source"};
    std::array<std::size_t, Count> at{0, 1, 2, kNone, kNone};
    bool areNamed = false;

    /// The field of a column; empty if the row or the table does not have it.
    [[nodiscard]] std::string_view field(const TableRow& row, Name name) const {
        return at[name] < row.fields.size() ? std::string_view(row.fields[at[name]]) : std::string_view();
    }
    static constexpr std::size_t kNone = ~std::size_t{0};
};

// \return the columns that the first row names, or nothing if it is not a heading
Result<std::optional<TableColumns>> columnsOf(const TableRow& row, std::string_view file) {
    const auto hasField = [&](std::string_view name) {
        return std::any_of(row.fields.begin(), row.fields.end(),
                           [&](const std::string& field) { return equalsIgnoringCase(field, name); });
    };
    if (row.line != 1 || !hasField("feature") || !hasField("owner")) return std::optional<TableColumns>();
    TableColumns columns;
    columns.at.fill(TableColumns::kNone);
    columns.areNamed = true;
    for (std::size_t n = 0; n < row.fields.size(); ++n) {
        const auto known = std::find_if(TableColumns::kNames.begin(), TableColumns::kNames.end(),
                                        [&](std::string_view name) { return equalsIgnoringCase(row.fields[n], name); });
        const auto name = std::size_t(known - TableColumns::kNames.begin());
        if (name == TableColumns::Count || columns.at[name] != TableColumns::kNone)
            return Error(
                Code::BadValue,
                fmt::format("owners table: the column '{}' is {}; columns are feature, owner, share, right and "
                            "source",
                            row.fields[n], name == TableColumns::Count ? "unknown" : "there twice"),
                {std::string(file), row.line, 0, {}});
        columns.at[name] = n;
    }
    return std::optional<TableColumns>(columns);
}

// 1/2, 50 % or 0.5 as a number over 0, up to 1; empty for anything else.
std::optional<double> parseShare(std::string_view text) {
    const auto number = [](std::string_view part) { return parseNumber(withoutBlanks(part)); };
    std::optional<double> share;
    if (const std::size_t slash = text.find('/'); slash != std::string_view::npos) {
        const auto above = number(text.substr(0, slash)), below = number(text.substr(slash + 1));
        if (above && below && *below > 0) share = *above / *below;
    } else if (!text.empty() && text.back() == '%') {
        if (const auto percent = number(text.substr(0, text.size() - 1))) share = *percent / 100;
    } else if (const auto plain = number(text)) {
        share = *plain;
    }
    return share && *share > 0 && *share <= 1 ? share : std::nullopt;
}

// Owners of a feature while rows are read.
struct Owners {
    std::vector<OwnerFraction> fractions;
    bool hasShares = false;
    std::uint64_t line = 0;  // of the last row
};

class TableMaker {
public:
    TableMaker(std::string_view file, const volume::LabelTable& labels, Diagnostics* unknown)
        : file_(file), labels_(labels), find_(labels), unknown_(unknown) {
        table_.ofLabel.resize(labels.labels.size());
        table_.sources.emplace_back();
    }

    Result<void> add(const TableRow& row) {
        const Place place{std::string(file_), row.line, 0, {}};
        SVT_DO(checkFields(row, place));
        std::optional<double> share;
        if (const std::string_view text = columns_.field(row, TableColumns::Share); !text.empty()) {
            share = parseShare(text);
            if (!share)
                return Error(Code::BadValue,
                             fmt::format("owners table: '{}' is not a share; expected a fraction over 0 and up to 1, "
                                         "such as 1/2, 50% or 0.5",
                                         text),
                             place);
        }
        std::uint8_t type = kOwnership;
        if (const std::string_view text = columns_.field(row, TableColumns::Right); !text.empty()) {
            const auto known = rightTypeOf(text);
            if (!known)
                return Error(
                    Code::BadValue,
                    fmt::format("owners table: '{}' is not a known right; expected one of {}", text, rightTypeNames()),
                    place);
            type = *known;
        }
        const auto selected = find_.find(std::string(columns_.field(row, TableColumns::Feature)), visits_);
        if (!selected) return reportUnknown(Error(selected.error().code(), selected.error().message(), place));
        visits_ += selected->size();
        SVT_DO(checkVisits(place));
        const std::string party(columns_.field(row, TableColumns::Owner));
        TableRight right{0, numberIn(parties_, table_.parties, party),
                         numberIn(sources_, table_.sources, std::string(columns_.field(row, TableColumns::Source))),
                         type, share};
        const std::uint32_t owner = type == kOwnership ? numberIn(numberOf_, table_.names, party) : kNoOwner;
        for (const std::uint32_t label : *selected) {
            if (type == kOwnership) SVT_DO(give(label, owner, share, place));
            right.label = label;
            SVT_DO(addRight(right, place));
        }
        return {};
    }

    Result<OwnerTable> finish() {
        if (table_.parties.empty() && firstUnknown_) return *firstUnknown_;
        if (table_.parties.empty())
            return Error(Code::BadValue, "owners table: no rows; expected lines such as flat-1,Smith",
                         {std::string(file_), 0, 0, {}});
        SVT_DO(findParts());
        std::stable_sort(table_.rights.begin(), table_.rights.end(), [](const TableRight& r, const TableRight& s) {
            return std::tie(r.label, r.type) < std::tie(s.label, s.type);
        });
        for (const OwnedFeature& feature : table_.features)
            for (const std::uint32_t part : feature.parts)
                for (const auto& [owner, fraction] : feature.owners)
                    addFraction(table_.ofLabel[part], owner, fraction / featuresOf_[part]);
        return std::move(table_);
    }

    /// Takes the columns that a heading names.
    void setColumns(const TableColumns& columns) noexcept { columns_ = columns; }

private:
    [[nodiscard]] Result<void> reportUnknown(const Error& error) {
        if (unknown_ == nullptr || error.code() != Code::NothingSelected) return error;
        unknown_->add(Severity::Warning, error.code(), error.message(), error.where());
        if (!firstUnknown_) firstUnknown_ = error;
        return {};
    }

    [[nodiscard]] Result<void> checkFields(const TableRow& row, const Place& place) const {
        const auto isEmpty = [](const std::string& field) { return field.empty(); };
        if (columns_.areNamed) {
            const std::size_t most = std::size_t(std::count_if(
                columns_.at.begin(), columns_.at.end(), [](std::size_t at) { return at != TableColumns::kNone; }));
            for (const auto name : {TableColumns::Feature, TableColumns::Owner})
                if (columns_.field(row, name).empty())
                    return Error(Code::BadValue,
                                 fmt::format("owners table: the column '{}' is empty", TableColumns::kNames[name]),
                                 place);
            if (row.fields.size() > most)
                return Error(
                    Code::BadValue,
                    fmt::format("owners table: expected {} columns, as in the first line, found {}; put fields "
                                "with commas in quotes",
                                most, row.fields.size()),
                    place);
            return {};
        }
        const std::size_t count = row.fields.size();
        if (count >= 2 && count <= 3 && std::none_of(row.fields.begin(), row.fields.end(), isEmpty)) return {};
        return Error(Code::BadValue,
                     fmt::format("owners table: expected two or three columns, feature, owner and share, found {}; put "
                                 "fields with commas in quotes, and name further columns in the first line",
                                 count == 2 || count == 3 ? "an empty one" : std::to_string(count)),
                     place);
    }

    static std::uint32_t numberIn(std::map<std::string, std::uint32_t>& numbers, std::vector<std::string>& names,
                                  const std::string& name) {
        const auto [at, isNew] = numbers.try_emplace(name, static_cast<std::uint32_t>(names.size()));
        if (isNew) names.push_back(name);
        return at->second;
    }

    // Adds a right. Rows with the same feature, party, type and source are one right: shares of ownership add up.
    Result<void> addRight(const TableRight& right, const Place& place) {
        const auto [at, isNew] =
            rightOf_.try_emplace({right.label, right.party, right.source, right.type}, table_.rights.size());
        if (isNew) {
            if (right.type == kOwnership && !right.fraction && isOwnedBySource(right))
                return Error(
                    Code::BadValue,
                    fmt::format("owners table: '{}' is given to '{}' twice, with several sources; give each row "
                                "a share, such as 1/2",
                                labels_.labels[right.label].id, table_.parties[right.party]),
                    place);
            if (table_.rights.size() == kMaxRights)
                return Error(Code::InputTooBig,
                             fmt::format("owners table: the rows up to here state more than {} rights; name features "
                                         "by id",
                                         kMaxRights),
                             place);
            table_.rights.push_back(right);
            if (right.type == kOwnership && !right.fraction) table_.rights.back().fraction = 1;
            return {};
        }
        std::optional<double>& known = table_.rights[at->second].fraction;
        if (right.type != kOwnership) {
            if (right.fraction) known = right.fraction;
        } else if (right.fraction) {
            *known += *right.fraction;
        }
        return {};
    }

    // Whether another source gives the feature to the same owner.
    [[nodiscard]] bool isOwnedBySource(const TableRight& right) const {
        for (auto at = rightOf_.lower_bound({right.label, right.party, 0, 0});
             at != rightOf_.end() && at->first[0] == right.label && at->first[1] == right.party; ++at)
            if (at->first[2] != right.source && at->first[3] == kOwnership) return true;
        return false;
    }

    [[nodiscard]] Result<void> checkVisits(const Place& place) const {
        if (visits_ <= kMaxVisits) return {};
        return Error(
            Code::InputTooBig,
            fmt::format("owners table: the rows up to here look at more than {} features; name features by id, "
                        "and each once",
                        kMaxVisits),
            place);
    }

    static void addFraction(std::vector<OwnerFraction>& fractions, std::uint32_t owner, double fraction) {
        const auto at = std::lower_bound(fractions.begin(), fractions.end(), owner,
                                         [](const OwnerFraction& known, std::uint32_t o) { return known.owner < o; });
        if (at == fractions.end() || at->owner != owner)
            fractions.insert(at, {owner, fraction});
        else
            at->fraction += fraction;
    }

    Result<void> give(std::uint32_t label, std::uint32_t owner, std::optional<double> share, const Place& place) {
        const auto [at, isNew] = ownersOf_.try_emplace(label);
        Owners& owners = at->second;
        const auto error = [&](std::string_view problem) {
            return Error(Code::BadValue,
                         fmt::format("owners table: '{}' is given to '{}' here and to '{}' in line {}; {}",
                                     labels_.labels[label].id, table_.names[owner],
                                     table_.names[owners.fractions.front().owner], owners.line, problem),
                         place);
        };
        if (!isNew && !share && !owners.hasShares && owners.fractions.front().owner == owner) return {};
        if (!isNew && (!share || !owners.hasShares)) return error("give each of them a share, such as 1/2");
        addFraction(owners.fractions, owner, share.value_or(1));
        double sum = 0;
        for (const OwnerFraction& known : owners.fractions) sum += known.fraction;
        if (sum > 1 + 1e-9) return error("the shares add up to more than 1");
        owners.hasShares = share.has_value();
        owners.line = place.line;
        return {};
    }

    // Gives each label to the finest features whose extent has it.
    Result<void> findParts() {
        const Extents extents(labels_);
        for (const auto& [label, owners] : ownersOf_) table_.features.push_back({label, owners.fractions, {}});
        const std::size_t count = labels_.labels.size();
        std::vector<std::size_t> sizes;
        for (const OwnedFeature& feature : table_.features) {
            sizes.push_back(extents.of(feature.label).size());
            visits_ += sizes.back();
            SVT_DO(checkVisits({std::string(file_), ownersOf_.at(feature.label).line, 0, {}}));
        }
        std::vector<std::uint32_t> order(table_.features.size());
        std::iota(order.begin(), order.end(), 0U);
        std::stable_sort(order.begin(), order.end(),
                         [&](std::uint32_t a, std::uint32_t b) { return sizes[a] < sizes[b]; });
        std::vector<std::vector<std::uint32_t>> holders(count);  // labels of the features that have the label so far
        std::vector<char> isInside(count, 0);
        featuresOf_.assign(count, 0);
        for (const std::uint32_t n : order) {
            OwnedFeature& feature = table_.features[n];
            const std::vector<std::uint32_t> extent = extents.of(feature.label);
            for (const std::uint32_t part : extent) isInside[part] = 1;
            for (const std::uint32_t part : extent) {
                const auto isFiner = [&](std::uint32_t holder) { return isInside[holder] != 0; };
                if (std::any_of(holders[part].begin(), holders[part].end(), isFiner)) continue;
                holders[part].push_back(feature.label);
                feature.parts.push_back(part);
                if (++featuresOf_[part] == 2) table_.shared.push_back(part);
            }
            for (const std::uint32_t part : extent) isInside[part] = 0;
        }
        std::sort(table_.shared.begin(), table_.shared.end());
        return {};
    }

    std::string_view file_;
    const volume::LabelTable& labels_;
    Features find_;
    Diagnostics* unknown_;
    std::optional<Error> firstUnknown_;
    TableColumns columns_;
    OwnerTable table_;
    std::map<std::string, std::uint32_t> numberOf_, parties_, sources_{{std::string(), 0}};
    std::map<std::array<std::uint32_t, 4>, std::size_t> rightOf_;  // by label, party, source and type
    std::map<std::uint32_t, Owners> ownersOf_;                     // by label
    std::vector<std::uint32_t> featuresOf_;                        // by label: number of features that have it
    std::uint64_t visits_ = 0;
};

}  // namespace

Result<OwnerTable> parseOwners(std::string_view text, std::string_view file, const volume::LabelTable& labels,
                               Diagnostics* unknown) {
    if (const std::size_t at = findInvalidUtf8(text); at != std::string_view::npos) {
        const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n');
        return Error(Code::BadValue, "owners table: the table is not in UTF-8; save it as CSV UTF-8",
                     {std::string(file), static_cast<std::uint64_t>(line), 0, {}});
    }
    if (text.size() > kMaxBytes)
        return Error(Code::InputTooBig,
                     fmt::format("an owners table of {} bytes; at most {} are read", text.size(), kMaxBytes),
                     {std::string(file), 0, 0, {}});
    TableMaker maker(file, labels, unknown);
    TableReader reader(text, file);
    while (!reader.isAtEnd()) {
        SVT_TRY(row, reader.next());
        if (row->fields.empty()) continue;
        SVT_TRY(columns, columnsOf(*row, file));
        if (*columns)
            maker.setColumns(**columns);
        else
            SVT_DO(maker.add(*row));
    }
    return maker.finish();
}

}  // namespace svt::analyze
