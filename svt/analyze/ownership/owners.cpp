#include <svt/analyze/owners.hpp>

#include <svt/analyze/label_measures.hpp>
#include <svt/analyze/selection.hpp>
#include <svt/core/edit_distance.hpp>
#include <svt/model/classes.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <unordered_map>

namespace svt::analyze {
namespace {

constexpr std::size_t kMaxBytes = std::size_t{64} << 20;
// Maximum number of features that all rows together may test: about a minute of work.
constexpr std::uint64_t kMaxVisits = std::uint64_t{1} << 30;

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

// Look-up of features by id, and of all that they include.
class Features {
public:
    explicit Features(const volume::LabelTable& table) : table_(table), members_(table.labels.size()) {
        for (std::uint32_t l = 0; l < table.labels.size(); ++l) {
            byId_.emplace(table.labels[l].id, l);
            for (const std::uint32_t group : table.labels[l].groups) members_[group].push_back(l);
        }
    }

    [[nodiscard]] bool has(const std::string& id) const { return byId_.count(id) != 0; }

    [[nodiscard]] std::uint32_t byId(const std::string& id) const { return byId_.at(id); }

    // The features, all below them in the tree, and their members, ascending.
    [[nodiscard]] std::vector<std::uint32_t> under(std::vector<std::uint32_t> open) const {
        std::vector<std::uint32_t> found;
        std::vector<bool> isKnown(table_.labels.size(), false);
        while (!open.empty()) {
            const std::uint32_t root = open.back();
            open.pop_back();
            for (std::uint32_t l = root; l < std::max(root + 1, table_.labels[root].subtreeEnd); ++l) {
                if (isKnown[l]) continue;
                isKnown[l] = true;
                found.push_back(l);
                open.insert(open.end(), members_[l].begin(), members_[l].end());
            }
        }
        std::sort(found.begin(), found.end());
        return found;
    }

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

private:
    const volume::LabelTable& table_;
    std::unordered_map<std::string_view, std::uint32_t> byId_;
    std::vector<std::vector<std::uint32_t>> members_;
};

Result<std::vector<std::uint32_t>> resolve(const std::string& feature, const volume::LabelTable& labels,
                                           const Features& features) {
    if (features.has(feature)) return features.under({features.byId(feature)});
    if (!model::Query::parse(feature))
        return Error(Code::NothingSelected, fmt::format("'{}' is neither the id of a feature nor a query{}", feature,
                                                        features.nearest(feature)));
    SVT_TRY(selected, selectLabels(labels, feature));
    return features.under(std::move(*selected));
}

// Entry per label: whether it is a space, or a surface that bounds one, which is between a room and its walls.
std::vector<bool> findSpaces(const std::vector<volume::Label>& labels) {
    std::vector<bool> isSpace(labels.size());
    for (std::size_t l = 0; l < labels.size(); ++l) {
        const std::uint32_t parent = labels[l].parent;
        isSpace[l] = model::isSpace(labels[l].className) ||
                     (parent < l && isSpace[parent] && model::isBoundarySurface(labels[l].className));
    }
    return isSpace;
}

bool isHeader(const TableRow& row) {
    return row.line == 1 && row.fields.size() == 2 && editDistance(row.fields[0], "feature", 0) == 0 &&
           editDistance(row.fields[1], "owner", 0) == 0;
}

void addShare(std::vector<OwnerShare>& shares, const OwnerShare& share) {
    const auto at = std::lower_bound(shares.begin(), shares.end(), share.owner,
                                     [](const OwnerShare& known, std::uint32_t owner) { return known.owner < owner; });
    if (at == shares.end() || at->owner != share.owner)
        shares.insert(at, share);
    else {
        at->area += share.area;
        at->volume += share.volume;
    }
}

}  // namespace

Result<OwnerTable> parseOwners(std::string_view text, std::string_view file, const volume::LabelTable& labels) {
    if (text.size() > kMaxBytes)
        return Error(Code::InputTooBig,
                     fmt::format("an owners table of {} bytes; at most {} are read", text.size(), kMaxBytes),
                     {std::string(file), 0, 0, {}});
    OwnerTable table;
    table.ofLabel.assign(labels.labels.size(), kNoOwner);
    const Features features(labels);
    std::map<std::string, std::uint32_t> numberOf;
    std::vector<std::uint64_t> lineOf(labels.labels.size(), 0);
    std::uint64_t visits = 0;
    TableReader reader(text, file);
    while (!reader.isAtEnd()) {
        SVT_TRY(row, reader.next());
        if (row->fields.empty() || isHeader(*row)) continue;
        const Place place{std::string(file), row->line, 0, {}};
        if (row->fields.size() != 2 || row->fields[0].empty() || row->fields[1].empty())
            return Error(Code::BadValue,
                         fmt::format("owners table: expected two columns, feature and owner, found {}; put fields with "
                                     "commas in quotes",
                                     row->fields.size() == 2 ? "an empty one" : std::to_string(row->fields.size())),
                         place);
        const auto selected = resolve(row->fields[0], labels, features);
        if (!selected) return Error(selected.error().code(), selected.error().message(), place);
        visits += selected->size() + (features.has(row->fields[0]) ? 0 : labels.labels.size());
        if (visits > kMaxVisits)
            return Error(Code::InputTooBig,
                         fmt::format("owners table: the rows up to here look at more than {} features; name features "
                                     "by id, and each once",
                                     kMaxVisits),
                         place);
        const auto [owner, isNew] =
            numberOf.try_emplace(row->fields[1], static_cast<std::uint32_t>(table.names.size()));
        if (isNew) table.names.push_back(row->fields[1]);
        for (const std::uint32_t l : *selected) {
            if (lineOf[l] != 0 && table.ofLabel[l] != owner->second)
                return Error(Code::BadValue,
                             fmt::format("owners table: '{}' is given to '{}' here and to '{}' in line {}; name one "
                                         "owner for each feature",
                                         labels.labels[l].id, row->fields[1], table.names[table.ofLabel[l]], lineOf[l]),
                             place);
            table.ofLabel[l] = owner->second;
            lineOf[l] = row->line;
        }
    }
    if (table.names.empty())
        return Error(Code::BadValue, "owners table: no rows; expected lines such as flat-1,Smith",
                     {std::string(file), 0, 0, {}});
    return table;
}

Ownership divideByOwners(const volume::SemanticVolume& volume, const std::vector<Contact>& contacts,
                         const OwnerTable& table) {
    const std::vector<volume::Label>& labels = volume.labels.labels;
    const std::vector<double> volumes = ownVolumes(volume.labels, volume.grid);
    const auto isOwned = [&](std::uint32_t l) { return table.ofLabel[l] != kNoOwner; };
    const std::vector<bool> isSpace = findSpaces(labels);
    const auto isComponent = [&](std::uint32_t l) { return !isOwned(l) && !isSpace[l]; };
    std::vector<std::vector<OwnerShare>> shares(labels.size());
    for (const Contact& contact : contacts) {
        if (contact.b == volume::kNoLabel) continue;
        if (isComponent(contact.a) && !isComponent(contact.b))
            addShare(shares[contact.a], {table.ofLabel[contact.b], contact.area, 0});
        else if (isComponent(contact.b) && !isComponent(contact.a))
            addShare(shares[contact.b], {table.ofLabel[contact.a], contact.area, 0});
    }
    Ownership result;
    result.owners.resize(table.names.size());
    for (std::uint32_t l = 0; l < labels.size(); ++l) {
        if (isOwned(l)) result.owners[table.ofLabel[l]].own += volumes[l];
        if (!isComponent(l)) continue;
        double area = 0;
        for (const OwnerShare& share : shares[l]) area += share.area;
        if (!(area > 0)) {
            result.untouched += volumes[l];
            continue;
        }
        for (OwnerShare& share : shares[l]) {
            share.volume = volumes[l] * share.area / area;
            if (share.owner == kNoOwner) {
                result.unowned += share.volume;
                continue;
            }
            OwnerTotal& total = result.owners[share.owner];
            (shares[l].size() == 1 ? total.alone : total.shared) += share.volume;
        }
        for (const OwnerShare& share : shares[l])
            for (const OwnerShare& other : shares[l])
                if (share.owner != kNoOwner && other.owner != share.owner)
                    addShare(result.owners[share.owner].with,
                             {other.owner, share.area, volumes[l] * share.area / area});
        result.components.push_back({l, std::move(shares[l])});
    }
    return result;
}

}  // namespace svt::analyze
