#include <apps/cli/quantities/city_take_off.hpp>

#include <apps/cli/output/messages.hpp>
#include <apps/cli/output/output_files.hpp>
#include <apps/cli/output/terminal_progress.hpp>

#include <svt/city/city_surroundings.hpp>
#include <svt/city/city_walk.hpp>
#include <svt/core/file.hpp>
#include <svt/model/classes.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <numeric>
#include <optional>
#include <utility>

namespace svt::cli {
namespace {

using Form = CityTakeOff::Form;
constexpr std::size_t kRowsAtOnce = 1000;  // of text, which aligns its columns

std::string textOf(const Json& value, int indent = -1) {
    return value.dump(indent, ' ', false, Json::error_handler_t::replace);
}

// Gives the rows of all tiles to stdout or a file. With keys, only their sums.
class RowOutput {
public:
    using Put = std::function<Result<void>(std::string_view)>;
    RowOutput(Form form, bool isFile, Put put) : form_(form), isFile_(isFile), put_(std::move(put)) {}
    virtual ~RowOutput() = default;

    virtual Result<void> add(const TakeOff& takeOff) {
        if (form_ == Form::JsonText) return addJson(takeOff);
        if (!takeOff.keys.empty()) return {};
        Table table = takeOffTable(takeOff, false);
        if (form_ == Form::Csv) return putCsv(table);
        if (rows_.columns.empty()) rows_.columns = table.columns;
        for (Row& row : table.rows) rows_.rows.push_back(std::move(row));
        return rows_.rows.size() < kRowsAtOnce ? Result<void>() : putText();
    }

    virtual Result<void> finish(const TakeOffTotals& totals, const std::vector<std::string>& assumptions,
                                bool hasKeys) {
        if (form_ == Form::JsonText) return finishJson(totals, assumptions, hasKeys);
        if (hasKeys) {
            const Table sums = totals.sums(form_ == Form::Text);
            return form_ == Form::Csv ? putCsv(sums) : put_(writers::makeText(sums));
        }
        if (form_ == Form::Csv) return {};
        if (totals.objects() > 0) rows_.rows.push_back(totals.totalRow());
        return rows_.rows.empty() ? Result<void>() : putText();
    }

private:
    Result<void> putCsv(const Table& table) {
        const auto csvForm = isFile_ ? writers::CsvForm::File : writers::CsvForm::Stream;
        std::string text;
        if (!isBegun_) text = writers::csvHeader(table.columns, csvForm);
        isBegun_ = true;
        for (const Row& row : table.rows) text += writers::csvLine(row, csvForm);
        return put_(text);
    }
    Result<void> putText() {
        Result<void> done = put_(writers::makeText(rows_));
        rows_.rows.clear();
        return done;
    }
    Result<void> addJson(const TakeOff& takeOff) {
        std::string text;
        for (std::size_t n = 0; n < takeOff.objects.size(); ++n) {
            text += isBegun_ ? ",\n    " : "{\n  \"rows\": [\n    ";
            isBegun_ = true;
            text += textOf(takeOffRowJson(takeOff, n));
            if (takeOff.hasExterior)
                exterior_ += (exterior_.empty() ? "\n    " : ",\n    ") + textOf(takeOffExteriorJson(takeOff, n));
        }
        hasExterior_ = takeOff.hasExterior;
        return put_(text);
    }
    Result<void> finishJson(const TakeOffTotals& totals, const std::vector<std::string>& assumptions, bool hasKeys) {
        std::string text = isBegun_ ? "\n  ]" : "{\n  \"rows\": []";
        if (hasKeys) text += ",\n  \"sums\": " + textOf(totals.sumsJson());
        if (hasExterior_) text += ",\n  \"exterior\": [" + exterior_ + "\n  ]";
        text += ",\n  \"total\": " + textOf(totals.totalJson());
        text += ",\n  \"assumptions\": " + textOf(Json(assumptions)) + "\n}\n";
        return put_(text);
    }

    Form form_;
    bool isFile_;
    Put put_;
    bool isBegun_ = false, hasExterior_ = false;
    Table rows_;            // of text
    std::string exterior_;  // of JSON
};

// Keeps all rows, because the format has its counts in front.
class ParquetOutput : public RowOutput {
public:
    explicit ParquetOutput(Put put) : RowOutput(Form::Csv, true, put), put_(std::move(put)) {}
    Result<void> add(const TakeOff& takeOff) override {
        if (!takeOff.keys.empty()) return {};
        Table table = takeOffTable(takeOff, false);
        if (rows_.columns.empty()) rows_.columns = table.columns;
        for (Row& row : table.rows) rows_.rows.push_back(std::move(row));
        return {};
    }
    Result<void> finish(const TakeOffTotals& totals, const std::vector<std::string>&, bool hasKeys) override {
        SVT_TRY(bytes, writers::makeParquet(hasKeys ? totals.sums(false) : rows_));
        return put_(*bytes);
    }

private:
    Put put_;
    Table rows_;
};

class CityMeasurer {
public:
    explicit CityMeasurer(const CityTakeOff& take) : take_(take) {}

    Result<int> run() {
        SVT_TRY(city, city::City::open(take_.input));
        if (city->missingPacks() > 0)
            note(fmt::format("{} packs of the city are missing; their buildings have no rows", city->missingPacks()));
        SVT_DO(openOutputs());
        SVT_DO(take_.question.exterior || !take_.question.formwork.empty() ? measureSurrounded(*city)
                                                                           : measureAlone(*city));
        std::vector<std::string> assumptions = assumptions_;
        assumptions.emplace_back("space that buildings of two tiles share counts twice in sums");
        TerminalProgress::hide();
        for (const auto& output : outputs_) SVT_DO(output->finish(totals_, assumptions, !take_.question.by.empty()));
        if (file_)
            if (const auto written = file_->commit(); !written) return written.error();
        if (totals_.objects() == 0) note("no objects are measured; use --where with a query that selects objects");
        for (const std::string& text : totals_.notes(!take_.question.where.empty())) note(text);
        if (file_) summarize(fmt::format("{}: {} objects", take_.output.string(), totals_.objects()));
        return kDone;
    }

private:
    Result<void> openOutputs() {
        if (!take_.output.empty()) {
            SVT_TRY(file, AtomicFile::create(take_.output));
            file_.emplace(std::move(*file));
            const auto put = [this](std::string_view text) { return file_->write(text); };
            const std::string ending = endingOf(take_.output);
            if (ending == ".parquet")
                outputs_.push_back(std::make_unique<ParquetOutput>(put));
            else
                outputs_.push_back(
                    std::make_unique<RowOutput>(ending == ".json" ? Form::JsonText : Form::Csv, true, put));
        }
        if (take_.form == Form::None) return {};
        const auto print = [](std::string_view text) -> Result<void> {
            fmt::print("{}", text);
            return {};
        };
        outputs_.push_back(std::make_unique<RowOutput>(take_.form, false, print));
        return {};
    }

    Result<void> measureAlone(const city::City& city) {
        const TerminalProgress progress;
        const auto work = [this](volume::SemanticVolume& tile) -> Result<void> {
            return measure(tile, std::uint32_t(tile.labels.labels.size()));
        };
        return city::forEachTile(city, city::kEverywhere, take_.question.threads, progress.get(), work, {},
                                 city::TileFaces::Meshes);
    }

    Result<void> measureSurrounded(const city::City& city) {
        constexpr double kSteps = 3;  // of findTouchingAreas(), and one sample more
        SVT_TRY(tiles, city::SurroundedTiles::open(city, kSteps * city.spacing()));
        const TerminalProgress progress;
        ProgressCounter counter(progress.get(), "tiles", tiles->size());
        for (std::size_t n = 0; n < tiles->size(); ++n) {
            if (Progress::isCancelled(progress.get())) return Error(Code::Cancelled, "stopped between tiles");
            SVT_TRY(tile, tiles->read(n));
            SVT_DO(measure(tile->volume, tile->ownLabels));
            counter.add();
        }
        return {};
    }

    // The buildings, or the objects of the query, out of the first labels.
    [[nodiscard]] Result<std::vector<quantities::ObjectQuantities>> objectsOf(const volume::SemanticVolume& volume,
                                                                              std::uint32_t ownLabels) const {
        std::vector<std::uint32_t> chosen;
        if (take_.question.where.empty()) {
            for (std::uint32_t l = 0; l < ownLabels; ++l) {
                const volume::Label& label = volume.labels.labels[l];
                const bool isBuilding = model::classRank(label.className) == model::ClassRank::Building;
                if (isBuilding || quantities::isComponent(label) || quantities::isBoundarySheet(label))
                    chosen.push_back(l);
            }
        } else {
            SVT_TRY(selected, selectedLabels(volume, take_.question.where, true));
            for (const std::uint32_t l : *selected)
                if (l < ownLabels) chosen.push_back(l);
        }
        std::vector<std::uint32_t> objects = quantities::objectsOf(volume, chosen);
        std::erase_if(objects, [&](std::uint32_t l) { return l >= ownLabels; });
        auto measured = quantities::measureObjects(volume, objects, take_.question.threads);
        if (take_.question.where.empty()) return quantities::buildingQuantities(volume, measured);
        return measured;
    }

    Result<void> measure(const volume::SemanticVolume& volume, std::uint32_t ownLabels) {
        SVT_TRY(objects, objectsOf(volume, ownLabels));
        TakeOff takeOff{volume, std::move(*objects)};
        SVT_DO(completeTakeOff(take_.question, takeOff));
        if (assumptions_.empty()) assumptions_ = takeOffAssumptions(takeOff);
        totals_.add(takeOff);
        for (const auto& output : outputs_) SVT_DO(output->add(takeOff));
        return {};
    }

    const CityTakeOff& take_;
    std::optional<AtomicFile> file_;
    std::vector<std::unique_ptr<RowOutput>> outputs_;
    TakeOffTotals totals_;
    std::vector<std::string> assumptions_;
};

}  // namespace

Result<int> runCityTakeOff(const CityTakeOff& take) { return CityMeasurer(take).run(); }

}  // namespace svt::cli
