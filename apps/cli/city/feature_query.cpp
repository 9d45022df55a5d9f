#include <apps/cli/city/feature_query.hpp>

#include <apps/cli/city/city_input.hpp>
#include <apps/cli/city/feature_sums.hpp>
#include <apps/cli/options/load_volume.hpp>
#include <apps/cli/output/messages.hpp>
#include <apps/cli/output/query_reports.hpp>
#include <apps/cli/output/table.hpp>
#include <apps/cli/output/terminal_progress.hpp>

#include <svt/analyze/extents.hpp>
#include <svt/analyze/face_areas.hpp>
#include <svt/analyze/known_volumes.hpp>
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
#include <functional>
#include <map>
#include <optional>
#include <set>
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
                                                 // The deprecated name of totalVoxels is voxels.
                                                 {"volume", "best m3", 2, CellType::Number},
                                                 {"voxels", "", 0, CellType::Whole},
                                                 {"volumeBound", "+- m3", 2, CellType::Number},
                                                 {"volumeSource", "best m3 from"},
                                                 {"footprint", "area from"}};
    return kColumns;
}

Row cellsOf(const city::FeatureRow& row, const volume::Label& label) {
    const analyze::Measure &own = row.measure.own, &total = row.measure.total;
    const auto hasPlan = [](const drawing::Footprint& footprint) { return !footprint.polygons.empty(); };
    const auto textCell = [](std::string_view text) { return text.empty() ? Cell() : Cell(text); };
    const auto ofVoxels = [&](double value) { return total.voxels > 0 ? Cell(value) : Cell(); };
    const auto known = [](const std::optional<double>& value) { return value ? Cell(*value) : Cell(); };
    return {label.id,
            label.className,
            label.name,
            known(own.volume),
            known(total.volume),
            total.volume ? Cell(total.countedVolume) : Cell(),
            hasPlan(row.footprint) ? Cell(row.area) : Cell(),
            ofVoxels(row.highest - row.lowest),
            ofVoxels(row.lowest),
            ofVoxels(row.highest),
            own.voxels,
            total.voxels,
            volume::fillingName(label.filling),
            row.isOpen ? 1 : 0,
            known(row.volume.volume),
            total.voxels,
            row.volume.volume ? known(row.volume.bound) : Cell(),
            textCell(analyze::volumeSourceName(row.volume.source)),
            textCell(row.footprint.source)};
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
        pipeline::BuildOptions build = query_.build;
        build.vectors = {.meshes = true, .isRequired = false};
        SVT_TRY(loaded, loadVolume(query_.input, build, TerminalProgress().get(), false));
        frame_ = std::move(*loaded);
        return {};
    }
    // The volume whose frame positions refer to.
    [[nodiscard]] const volume::SemanticVolume& frame() const noexcept { return frame_; }

    // `work` takes a volume, and the areas of its meshes if faces are asked for.
    using MeshAreas = std::vector<std::optional<double>>;
    Result<void> forEach(
        const std::function<Result<void>(const volume::SemanticVolume&, const MeshAreas&)>& work) const {
        if (!city_) return work(frame_, query_.faces ? analyze::meshAreas(frame_) : MeshAreas());
        const TerminalProgress progress;
        const auto withAreas = [&](volume::SemanticVolume& tile) -> Result<void> {
            const MeshAreas areas = query_.faces ? analyze::meshAreas(tile) : MeshAreas();
            city::keepAsFootprints(tile);
            return work(tile, areas);
        };
        return city::forEachTile(*city_, rectangleOf(query_.box), query_.build.threads, progress.get(), withAreas, {},
                                 city::TileFaces::Meshes);
    }
    // The same with only label tables, without columns.
    Result<void> forEachTable(
        const std::function<Result<void>(const volume::LabelTable&, const volume::Grid&)>& work) const {
        if (!city_) return work(frame_.labels, frame_.grid);
        SVT_TRY(entries, city_->find(0, rectangleOf(query_.box)));
        for (const city::IndexEntry& entry : *entries) {
            SVT_TRY(bytes, city_->readBytes(entry));
            SVT_TRY(tile, volume::openSvt(std::as_bytes(std::span(*bytes)), entry.tile.toString()));
            SVT_DO(work(tile->labels, tile->grid));
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
        if (!query_.by.empty()) sums_.emplace(query_.by, query_.faces);
        if (!query_.output.empty()) SVT_DO(beginFile());
        const auto askVolume = [&](const auto& volume, const auto& areas) -> Result<void> {
            return ask(volume, areas);
        };
        SVT_DO(source_.forEach(askVolume));
        return finish();
    }

private:
    struct Kept {
        double order = 0;
        Row cells;
        std::vector<drawing::PlanPolygon> footprint, roof;
        std::vector<Attribute> lists;  // attributes with several values
    };

    Result<std::vector<std::uint32_t>> select(const volume::LabelTable& labels, const volume::Grid& grid) const {
        std::vector<std::string> nothing;
        auto selected = analyze::selectLabels(analyze::LabelRows(labels, grid, &nothing), query_.query);
        if (selected && query_.leaks)
            std::erase_if(*selected, [&](std::uint32_t l) { return !city::isOpenShell(labels.labels[l]); });
        return selected;
    }

    // Collects the columns of attributes, which must be known before the first row.
    Result<void> beginFile() {
        std::map<std::string, CellType> attributes;
        const auto add = [&](const volume::LabelTable& labels, const volume::Grid& grid) -> Result<void> {
            SVT_TRY(selected, select(labels, grid));
            for (const std::uint32_t l : *selected)
                for (const AttributeList& list : attributeLists(labels.labels[l].attributes)) {
                    const CellType type =
                        list.isSingle() ? typeOf(list.items.front().attribute->value) : CellType::Text;
                    if (!list.isSingle()) listNames_.emplace(list.name);
                    const auto [known, isNew] = attributes.emplace(list.name, type);
                    if (isNew || known->second == type) continue;
                    const bool areNumbers = known->second != CellType::Text && type != CellType::Text;
                    known->second = areNumbers ? CellType::Number : CellType::Text;
                }
            return {};
        };
        SVT_DO(source_.forEachTable(add));
        columns_ = columns();
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
        SVT_TRY(layer, writers::FeatureLayer::create(query_.output, columns_, source_.frame().crsName,
                                                     {.hasLists = !listNames_.empty(), .hasRoofs = query_.roofs}));
        layer_ = std::move(*layer);
        return {};
    }

    [[nodiscard]] bool isInBox(const city::FeatureRow& row) const {
        const std::vector<double>& box = query_.box;
        if (box.empty()) return true;
        const auto& polygons = row.footprint.polygons;
        if (row.measure.total.voxels == 0 || polygons.empty() || row.highest < box[2] || row.lowest > box[5])
            return false;
        std::array<double, 4> own{1e300, 1e300, -1e300, -1e300};
        for (const drawing::PlanPolygon& polygon : polygons)
            for (const auto& [x, y] : polygon.rings.front())
                own = {std::min(own[0], x), std::min(own[1], y), std::max(own[2], x), std::max(own[3], y)};
        return own[0] <= box[3] && box[0] <= own[2] && own[1] <= box[4] && box[1] <= own[3];
    }

    Result<void> ask(const volume::SemanticVolume& volume, const Source::MeshAreas& areas) {
        SVT_TRY(selected, select(volume.labels, volume.grid));
        if (selected->empty()) return {};
        const analyze::Extents extents(volume.labels);
        std::vector<city::FeatureRow> counted;
        for (city::FeatureRow& row : rowsOf(volume, *selected)) {
            if ((plane_ && !row.isCut) || !isInBox(row)) continue;
            ++count_;
            if (sums_) counted.push_back(row);
            const volume::Label& label = volume.labels.labels[row.label];
            Row faces;
            if (query_.faces)
                for (const auto& area : analyze::faceAreas(volume.labels, extents.of(row.label), areas))
                    faces.push_back(area ? Cell(*area) : Cell());
            SVT_DO(take(std::move(row), label, faces));
        }
        if (sums_) sums_->add(volume, counted, areas);
        return {};
    }

    [[nodiscard]] std::vector<city::FeatureRow> rowsOf(const volume::SemanticVolume& volume,
                                                       const std::vector<std::uint32_t>& selected) const {
        return city::featureRows(
            volume, selected,
            {.plane = plane_ ? &*plane_ : nullptr, .hasRoofs = query_.roofs, .threads = query_.build.threads});
    }

    [[nodiscard]] std::vector<Column> columns() const {
        std::vector<Column> all = ownColumns();
        if (query_.roofs) all.push_back({"roofArea", "roof area", 2, CellType::Number});
        if (query_.faces) addFaceColumns(all);
        return all;
    }

    void addAttributes(const volume::Label& label, Kept& kept) const {
        kept.cells.resize(columns_.size());
        for (const AttributeList& list : attributeLists(label.attributes)) {
            const std::size_t place = placeOf_.find(list.name)->second;
            if (!list.isSingle()) {
                kept.cells[place] = list;
                for (const AttributeList::Item& item : list.items)
                    if (item.attribute != nullptr) kept.lists.push_back(*item.attribute);
                continue;
            }
            // Numbers stay numbers beside lists, but not beside texts: all cells of a column are alike then.
            const AttributeValue& value = list.items.front().attribute->value;
            const bool isText = columns_[place].type == CellType::Text && !listNames_.contains(list.name);
            kept.cells[place] = isText || std::holds_alternative<bool>(value) ? Cell(toText(value)) : Cell(value);
        }
    }

    Result<void> take(city::FeatureRow row, const volume::Label& label, const Row& faces) {
        Kept kept{0, cellsOf(row, label), std::move(row.footprint.polygons), std::move(row.roof.polygons), {}};
        if (query_.roofs) kept.cells.push_back(kept.roof.empty() ? Cell() : Cell(row.roof.area));
        kept.cells.insert(kept.cells.end(), faces.begin(), faces.end());
        if (layer_) addAttributes(label, kept);
        if (!query_.sort.empty()) {
            constexpr double kUnknown = -1;  // last
            kept.order = query_.sort == "volume" ? row.volume.volume.value_or(kUnknown)
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
        if (layer_) return layer_->add({kept.cells, kept.footprint, kept.roof, attributeLists(kept.lists)});
        if (sums_) return {};
        table_.rows.push_back(kept.cells);
        if (query_.format == TableFormat::JsonRows || table_.rows.size() < 1000) return {};
        printTable();
        return {};
    }

    // Prints the rows so far, so that memory does not grow with their number.
    void printTable() {
        table_.columns = columns();
        print(table_, query_.format, !isBegun_);
        isBegun_ = true;
        table_.rows.clear();
    }

    Result<void> finish() {
        if (!query_.sort.empty()) {
            dropSmaller();
            for (const Kept& kept : largest_) SVT_DO(give(kept));
        }
        if (layer_)
            if (const auto written = layer_->finish(); !written) return written.error();
        TerminalProgress::hide();
        if (sums_) {
            print(sums_->table(), query_.format);
            sums_->note();
        } else if (!layer_ && (!table_.rows.empty() || !isBegun_)) {
            printTable();
        }
        if (count_ == 0)
            note(
                fmt::format("the query '{}' selects nothing{}", query_.query, query_.box.empty() ? "" : " in the box"));
        if (layer_)
            summarize(fmt::format("{}: {} features", query_.output.string(),
                                  query_.sort.empty() ? given_ : int(largest_.size())));
        return {};
    }

    const FeatureQuery& query_;
    Source source_;
    std::optional<drawing::SectionPlane> plane_;
    std::vector<Column> columns_;
    std::map<std::string, std::size_t, std::less<>> placeOf_;
    std::set<std::string, std::less<>> listNames_;  // attributes of which a feature has several values
    std::unique_ptr<writers::FeatureLayer> layer_;
    std::optional<FeatureSums> sums_;  // with --by
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
