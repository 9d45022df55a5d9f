#include <apps/cli/city/feature_query.hpp>

#include <apps/cli/city/city_input.hpp>
#include <apps/cli/options/load_volume.hpp>
#include <apps/cli/output/messages.hpp>
#include <apps/cli/output/table.hpp>
#include <apps/cli/output/terminal_progress.hpp>

#include <svt/analyze/selection.hpp>
#include <svt/city/city_view.hpp>
#include <svt/city/city_walk.hpp>
#include <svt/city/feature_rows.hpp>
#include <svt/core/attribute.hpp>
#include <svt/core/text.hpp>
#include <svt/volume/svt_file.hpp>
#include <svt/writers/feature_layer.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

namespace svt::cli {
namespace {

using writers::CellType;

const std::vector<Column>& ownColumns() {
    static const std::vector<Column> kColumns = {{"id", "id"},
                                                 {"class", "class"},
                                                 {"name", "name"},
                                                 {"ownVolume", "own m3", 2, CellType::Number},
                                                 {"totalVolume", "total m3", 2, CellType::Number},
                                                 {"countedVolume", "", 2, CellType::Number},
                                                 {"area", "area", 2, CellType::Number},
                                                 {"height", "height", 2, CellType::Number},
                                                 {"lowest", "lowest", 2, CellType::Number},
                                                 {"highest", "highest", 2, CellType::Number},
                                                 {"ownVoxels", "own voxels", 0, CellType::Whole},
                                                 {"totalVoxels", "total voxels", 0, CellType::Whole},
                                                 {"filling", "filling"},
                                                 {"open", "open", 0, CellType::Whole},
                                                 // Deprecated names of totalVolume and totalVoxels.
                                                 {"volume", "", 2, CellType::Number},
                                                 {"voxels", "", 0, CellType::Whole}};
    return kColumns;
}

Row cellsOf(const city::FeatureRow& row, const volume::Label& label) {
    const analyze::Measure &own = row.measure.own, &total = row.measure.total;
    const auto ofVoxels = [&](double value) { return total.voxels > 0 ? Cell(value) : Cell(); };
    const auto known = [](const std::optional<double>& value) { return value ? Cell(*value) : Cell(); };
    return {label.id,
            label.className,
            label.name,
            known(own.volume),
            known(total.volume),
            total.volume ? Cell(total.countedVolume) : Cell(),
            ofVoxels(row.area),
            ofVoxels(row.highest - row.lowest),
            ofVoxels(row.lowest),
            ofVoxels(row.highest),
            own.voxels,
            total.voxels,
            volume::fillingName(label.filling),
            row.isOpen ? 1 : 0,
            known(total.volume),
            total.voxels};
}

CellType typeOf(const AttributeValue& value) {
    if (std::holds_alternative<std::int64_t>(value)) return CellType::Whole;
    return std::holds_alternative<double>(value) ? CellType::Number : CellType::Text;
}

// A series of volumes: the tiles of a city, or one volume.
class Source {
public:
    explicit Source(const FeatureQuery& query) : query_(query) {}

    Result<void> open() {
        if (isCity(query_.input)) {
            SVT_TRY(opened, city::City::open(query_.input));
            city_.emplace(std::move(*opened));
            SVT_TRY(frame, city::frameVolume(*city_));
            frame_ = std::move(*frame);
            return {};
        }
        SVT_TRY(loaded, loadVolume(query_.input, query_.build, TerminalProgress().get(), false));
        frame_ = std::move(*loaded);
        return {};
    }
    // The volume whose frame positions refer to.
    [[nodiscard]] const volume::SemanticVolume& frame() const noexcept { return frame_; }

    Result<void> forEach(const std::function<Result<void>(const volume::SemanticVolume&)>& work) const {
        if (!city_) return work(frame_);
        const TerminalProgress progress;
        return city::forEachTile(*city_, rectangleOf(query_.box), query_.build.threads, progress.get(), work);
    }
    // The same with only label tables, without columns.
    Result<void> forEachTable(const std::function<Result<void>(const volume::LabelTable&)>& work) const {
        if (!city_) return work(frame_.labels);
        SVT_TRY(entries, city_->find(0, rectangleOf(query_.box)));
        for (const city::IndexEntry& entry : *entries) {
            SVT_TRY(bytes, city_->readBytes(entry));
            SVT_TRY(tile, volume::openSvt(std::as_bytes(std::span(*bytes)), entry.tile.toString()));
            SVT_DO(work(tile->labels));
        }
        return {};
    }

private:
    const FeatureQuery& query_;
    std::optional<city::City> city_;
    volume::SemanticVolume frame_;
};

class Answer {
public:
    explicit Answer(const FeatureQuery& query) : query_(query), source_(query) {}

    Result<void> run() {
        SVT_DO(source_.open());
        if (!query_.cut.empty()) {
            SVT_TRY(plane, drawing::parseSectionPlane(query_.cut, source_.frame()));
            plane_ = *plane;
        }
        for (std::size_t at = 0; at < query_.by.size();) {
            const std::size_t comma = std::min(query_.by.find(',', at), query_.by.size());
            keys_.push_back(query_.by.substr(at, comma - at));
            at = comma + 1;
        }
        if (!query_.output.empty()) SVT_DO(beginFile());
        if (auto asked = source_.forEach([&](const volume::SemanticVolume& volume) { return ask(volume); }); !asked)
            return asked;
        return finish();
    }

private:
    struct Sum {
        std::uint64_t count = 0, withoutVolume = 0, withoutVoxels = 0;
        double volume = 0, area = 0;
    };
    struct Kept {
        double order = 0;
        Row cells;
        std::vector<std::array<double, 2>> outline;
    };

    Result<std::vector<std::uint32_t>> select(const volume::LabelTable& labels) const {
        std::vector<std::string> nothing;
        auto selected = analyze::selectLabels(analyze::LabelRows(labels, &nothing), query_.query);
        if (selected && query_.leaks)
            std::erase_if(*selected, [&](std::uint32_t l) { return !city::isOpenShell(labels.labels[l]); });
        return selected;
    }

    // Collects the columns of attributes, which must be known before the first row.
    Result<void> beginFile() {
        std::map<std::string, CellType> attributes;
        const auto add = [&](const volume::LabelTable& labels) -> Result<void> {
            SVT_TRY(selected, select(labels));
            for (const std::uint32_t l : *selected)
                for (const Attribute& attribute : labels.labels[l].attributes) {
                    const CellType type = typeOf(attribute.value);
                    const auto [known, isNew] = attributes.emplace(attribute.name, type);
                    if (isNew || known->second == type) continue;
                    const bool areNumbers = known->second != CellType::Text && type != CellType::Text;
                    known->second = areNumbers ? CellType::Number : CellType::Text;
                }
            return {};
        };
        SVT_DO(source_.forEachTable(add));
        columns_ = ownColumns();
        for (const auto& [name, type] : attributes) {
            // Names of columns must differ by more than case, and be unique in a table.
            const bool isOwn = std::any_of(columns_.begin(), columns_.end(), [&, &wanted = name](const auto& column) {
                return equalsIgnoringCase(column.name, wanted) || equalsIgnoringCase(wanted, "fid") ||
                       equalsIgnoringCase(wanted, "geom");
            });
            std::string unique = isOwn ? "attribute:" + name : name;
            while (std::any_of(columns_.begin(), columns_.end(),
                               [&](const auto& column) { return equalsIgnoringCase(column.name, unique); }))
                unique += "_";
            placeOf_[name] = columns_.size();
            columns_.push_back({unique, unique, 2, type});
        }
        SVT_TRY(layer, writers::FeatureLayer::create(query_.output, columns_, source_.frame().crsName));
        layer_ = std::move(*layer);
        return {};
    }

    [[nodiscard]] bool isInBox(const city::FeatureRow& row) const {
        const std::vector<double>& box = query_.box;
        if (box.empty()) return true;
        if (row.measure.total.voxels == 0 || row.outline.empty() || row.highest < box[2] || row.lowest > box[5])
            return false;
        std::array<double, 4> own{1e300, 1e300, -1e300, -1e300};
        for (const auto& [x, y] : row.outline)
            own = {std::min(own[0], x), std::min(own[1], y), std::max(own[2], x), std::max(own[3], y)};
        return own[0] <= box[3] && box[0] <= own[2] && own[1] <= box[4] && box[1] <= own[3];
    }

    Result<void> ask(const volume::SemanticVolume& volume) {
        SVT_TRY(selected, select(volume.labels));
        if (selected->empty()) return {};
        std::map<std::vector<std::string>, std::vector<city::FeatureRow>> groups;
        for (city::FeatureRow& row : city::featureRows(volume, *selected, plane_ ? &*plane_ : nullptr)) {
            if ((plane_ && !row.isCut) || !isInBox(row)) continue;
            ++count_;
            const volume::Label& label = volume.labels.labels[row.label];
            if (!keys_.empty()) groups[valuesOf(label)].push_back(row);
            SVT_DO(take(std::move(row), label));
        }
        const analyze::Extents extents(volume.labels);
        const std::vector<analyze::Measure> own = analyze::ownMeasures(volume.labels, volume.grid);
        for (const auto& [values, rows] : groups) addToSum(rows, extents, own, sums_[values]);
        return {};
    }

    // Values of the keys of --by. The key class is the class of a feature, and "class" in quotes the attribute.
    [[nodiscard]] std::vector<std::string> valuesOf(const volume::Label& label) const {
        std::vector<std::string> values;
        for (const std::string& key : keys_) {
            std::string& value = values.emplace_back();
            if (equalsIgnoringCase(key, "class")) {
                value = label.className;
                continue;
            }
            const bool isQuoted = key.size() > 2 && key.front() == '"' && key.back() == '"';
            const std::string name = isQuoted ? key.substr(1, key.size() - 2) : key;
            for (const Attribute& attribute : label.attributes)
                if (equalsIgnoringCase(attribute.name, name)) value = toText(attribute.value);
        }
        return values;
    }

    // Adds features of equal values. A label in several of them counts once, and a feature within others adds no area.
    static void addToSum(const std::vector<city::FeatureRow>& rows, const analyze::Extents& extents,
                         const std::vector<analyze::Measure>& own, Sum& sum) {
        std::vector<std::size_t> sizes, order(rows.size());
        for (const city::FeatureRow& row : rows) sizes.push_back(extents.of(row.label).size());
        std::iota(order.begin(), order.end(), std::size_t{0});
        std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return sizes[a] > sizes[b]; });
        std::vector<char> isCounted(own.size(), 0);
        for (const std::size_t n : order) {
            const analyze::Measure& total = rows[n].measure.total;
            ++sum.count;
            sum.withoutVolume += !total.volume;
            sum.withoutVoxels += total.voxels == 0;
            bool isNew = false;
            for (const std::uint32_t part : extents.of(rows[n].label)) {
                if (std::exchange(isCounted[part], 1) != 0) continue;
                isNew = true;
                sum.volume += own[part].volume.value_or(0);
            }
            if (isNew) sum.area += rows[n].area;
        }
    }

    Result<void> take(city::FeatureRow row, const volume::Label& label) {
        Kept kept{0, cellsOf(row, label), std::move(row.outline)};
        if (layer_) {
            kept.cells.resize(columns_.size());
            for (const Attribute& attribute : label.attributes) {
                const std::size_t place = placeOf_.at(attribute.name);
                kept.cells[place] =
                    columns_[place].type == CellType::Text ? Cell(toText(attribute.value)) : Cell(attribute.value);
            }
        }
        if (!query_.sort.empty()) {
            kept.order = query_.sort == "volume" ? row.measure.total.volume.value_or(0)
                         : query_.sort == "area" ? row.area
                                                 : row.highest - row.lowest;
            return keepLargest(std::move(kept));
        }
        if (query_.first > 0 && given_ >= query_.first) return {};
        ++given_;
        return give(kept);
    }

    static bool isLarger(const Kept& a, const Kept& b) {
        const auto id = [](const Kept& kept) { return std::get<std::string>(kept.cells[0].value); };
        return a.order != b.order ? a.order > b.order : id(a) < id(b);
    }

    Result<void> keepLargest(Kept kept) {
        largest_.push_back(std::move(kept));
        if (largest_.size() >= 2 * wanted()) dropSmaller();
        return {};
    }
    [[nodiscard]] std::size_t wanted() const { return static_cast<std::size_t>(query_.first > 0 ? query_.first : 100); }
    void dropSmaller() {
        std::sort(largest_.begin(), largest_.end(), isLarger);
        if (largest_.size() > wanted()) largest_.resize(wanted());
    }

    // Writes a row to the file, or prints it as a line.
    Result<void> give(const Kept& kept) {
        if (layer_) return layer_->add(kept.cells, kept.outline);
        if (!keys_.empty()) return {};
        table_.rows.push_back(kept.cells);
        if (query_.format == TableFormat::JsonRows || table_.rows.size() < 1000) return {};
        printTable();
        return {};
    }

    // Prints the rows so far, so that memory does not grow with their number.
    void printTable() {
        table_.columns = ownColumns();
        print(table_, query_.format, !isBegun_);
        isBegun_ = true;
        table_.rows.clear();
    }

    void printSums() const {
        Table table;
        for (const std::string& key : keys_) table.columns.push_back({key, key, 0});
        table.columns.push_back({"features", "features", 0});
        table.columns.push_back({"totalVolume", "total m3", 1});
        table.columns.push_back({"area", "m2 in plan", 1});
        table.columns.push_back({"volume"});  // deprecated name of totalVolume
        std::uint64_t withoutVolume = 0, withoutVoxels = 0;
        for (const auto& [values, sum] : sums_) {
            withoutVolume += sum.withoutVolume;
            withoutVoxels += sum.withoutVoxels;
            Row& row = table.rows.emplace_back();
            for (const std::string& value : values) row.push_back(value.empty() ? Cell() : Cell(value));
            row.push_back(sum.count);
            const Cell cubicMetres = sum.withoutVolume < sum.count ? Cell(sum.volume) : Cell();
            row.push_back(cubicMetres);
            row.push_back(sum.withoutVoxels < sum.count ? Cell(sum.area) : Cell());
            row.push_back(cubicMetres);
        }
        print(table, query_.format);
        const auto noteMissing = [](std::uint64_t count, const char* measure, const char* basis) {
            if (count > 0) note(fmt::format("the sums of {} exclude {} features without {}", measure, count, basis));
        };
        noteMissing(withoutVolume, "volume", "solids");
        noteMissing(withoutVoxels, "area", "voxels");
    }

    Result<void> finish() {
        if (!query_.sort.empty()) {
            dropSmaller();
            for (const Kept& kept : largest_) SVT_DO(give(kept));
        }
        if (layer_)
            if (const auto written = layer_->finish(); !written) return written.error();
        TerminalProgress::hide();
        if (!keys_.empty())
            printSums();
        else if (!layer_ && (!table_.rows.empty() || !isBegun_))
            printTable();
        if (count_ == 0) note(fmt::format("the query '{}' selects nothing", query_.query));
        if (layer_)
            summarize(fmt::format("{}: {} features", query_.output.string(),
                                  query_.sort.empty() ? given_ : int(largest_.size())));
        return {};
    }

    const FeatureQuery& query_;
    Source source_;
    std::optional<drawing::SectionPlane> plane_;
    std::vector<std::string> keys_;
    std::vector<Column> columns_;
    std::map<std::string, std::size_t> placeOf_;
    std::unique_ptr<writers::FeatureLayer> layer_;
    std::map<std::vector<std::string>, Sum> sums_;
    std::vector<Kept> largest_;
    Table table_;
    bool isBegun_ = false;
    int given_ = 0;
    std::uint64_t count_ = 0;
};

}  // namespace

Result<int> runFeatureQuery(const FeatureQuery& query) {
    SVT_DO(Answer(query).run());
    return kDone;
}

}  // namespace svt::cli
