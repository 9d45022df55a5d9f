#include <svt/city/plan/survey.hpp>

#include <svt/city/base/sha256.hpp>
#include <svt/model/building_model.hpp>
#include <svt/model/surface_uses.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace svt::city {
namespace {

constexpr std::size_t kBatchBytes = std::size_t{4} << 20;
// Time per building, measured on LoD2: most of it depends on its points, the rest on its surface in voxels.
constexpr double kMicrosecondsEach = 600, kMicrosecondsPerPoint = 5, kMicrosecondsPerThousandVoxels = 20;

struct Batch {
    std::vector<std::string> texts;
    std::vector<readers::FeatureSpan> spans;
    std::size_t bytes = 0;
};

// Data about a feature from the model of its batch.
struct Found {
    Box3d box;
    std::string id;
    std::uint64_t points = 0;
    double area = 0;
    bool isThere = false;  ///< false: it does not exist on the date
};

class FileSurvey {
public:
    FileSurvey(const std::filesystem::path& path, const PlanOptions& options, Survey& survey, Diagnostics& diagnostics)
        : path_(path), options_(options), survey_(survey), diagnostics_(diagnostics) {}

    Result<void> run() {
        SVT_TRY(file, readers::FeatureFile::open(path_, reading()));
        isWhole_ = file->format() == readers::FeatureFormat::Whole;
        std::error_code failed;
        entry_ = {std::filesystem::absolute(path_, failed).lexically_normal().string(),
                  std::filesystem::file_size(path_, failed), 0, 0, 0};
        entry_.headHash = contentHash(file->head());
        number_ = static_cast<std::uint32_t>(survey_.files.size());
        Batch batch;
        while (true) {
            readers::FeatureText feature;
            SVT_TRY(found, file->next(feature));
            if (*found) {
                batch.texts.emplace_back(feature.text);
                batch.spans.push_back(feature.span);
                batch.bytes += feature.text.size();
            }
            if ((!*found || batch.bytes >= kBatchBytes) && !batch.texts.empty()) {
                SVT_DO(takeBatch(*file, batch));
                batch = {};
            }
            if (!*found) break;
            if (Progress::isCancelled(options_.progress)) return Error(Code::Cancelled, "stopped while planning");
        }
        if (file->isTruncated())
            diagnostics_.add(Severity::Warning, Code::Truncated,
                             "the last line ends within its object: the file was cut off; it was read up to the cut",
                             {path_.string(), 0, 0, {}});
        tellSkipped();
        survey_.files.push_back(entry_);
        survey_.fileNames.push_back(path_.string());
        return {};
    }

private:
    [[nodiscard]] readers::ReadOptions reading() const {
        readers::ReadOptions reading;
        reading.threads = options_.threads;
        reading.crs = entry_.crs != 0 ? entry_.crs : options_.city.crs;
        reading.likelyCrs = survey_.crs;
        reading.axisOrder = entry_.axisOrder != 0 ? entry_.axisOrder : options_.city.axisOrder;
        reading.unit = options_.city.unit;
        reading.date = options_.city.date;
        reading.keepFarFeatures = true;
        reading.allowTruncated = options_.allowTruncated;
        return reading;
    }

    [[nodiscard]] static std::vector<std::string_view> viewsOf(const Batch& batch) {
        return {batch.texts.begin(), batch.texts.end()};
    }

    // The first batch of a file that can be read decides how all of it is read.
    void decide(const readers::FeatureFile& file, const Batch& batch) {
        Diagnostics findings;
        const auto first = file.read(viewsOf(batch), reading(), &findings);
        if (!first && first.error().code() == Code::UnitInDoubt) inDoubt_ = first.error().message();
        if (!first) return;  // reported for each feature
        isDecided_ = true;
        for (const Diagnostic& item : findings.items())
            if (item.code == Code::AxisOrder || item.code == Code::MapScale || item.code == Code::OutsideArea)
                diagnostics_.add(item.severity, item.code, item.message, {path_.string(), 0, 0, {}});
        entry_.axisOrder = first->crs.axesSwapped ? -1 : 1;
        if (survey_.crs == 0) survey_.crs = first->crs.epsg;
        if (survey_.crsName.empty() && survey_.crs == first->crs.epsg) survey_.crsName = first->crs.name;
        // A file without a known CRS is taken as it is.
        entry_.crs = first->crs.epsg == 0 ? 0 : survey_.crs;
        if (first->crs.epsg == 0 && survey_.crs != 0)
            diagnostics_.add(Severity::Warning, Code::MixedCrs,
                             fmt::format("the file names no CRS that is known; its coordinates are taken as those of "
                                         "the city, EPSG:{}",
                                         survey_.crs),
                             {path_.string(), 0, 0, {}});
    }

    Result<void> takeBatch(const readers::FeatureFile& file, const Batch& batch) {
        if (!isDecided_ && inDoubt_.empty()) decide(file, batch);
        if (!inDoubt_.empty()) {
            featuresInDoubt_ += batch.texts.size();
            return {};
        }
        Diagnostics findings;
        std::vector<std::uint32_t> featureOf;
        const std::vector<std::string_view> views = viewsOf(batch);
        const auto model = file.read(views, reading(), &findings, &featureOf);
        if (!model && batch.texts.size() > 1) {  // one of them is bad
            for (std::size_t n = 0; n < batch.texts.size(); ++n)
                if (auto taken = takeBatch(file, {{batch.texts[n]}, {batch.spans[n]}, 0}); !taken) return taken;
            return {};
        }
        if (!model) {
            if (model.error().code() == Code::Cancelled || model.error().code() == Code::Truncated)
                return model.error();
            if (survey_.unreadable++ == 0) survey_.firstUnreadable = model.error().message();
            skip(fmt::format("the feature at byte {} cannot be read: {}", batch.spans[0].begin,
                             model.error().message()));
            return {};
        }
        linked_ += findings.count(Code::DanglingReference);
        for (const Diagnostic& item : findings.items())
            if (item.code == Code::Truncated)
                diagnostics_.add(item.severity, item.code, item.message, {path_.string(), 0, 0, {}});
        std::vector<Found> found = examine(*model, featureOf, batch.texts.size());
        noteEnded(findings, found);
        for (std::size_t n = 0; n < found.size(); ++n) add(found[n], batch.spans[n], batch.texts[n]);
        Progress::tell(options_.progress, "plan", file.progress());
        return {};
    }

    static std::vector<Found> examine(const model::BuildingModel& model, const std::vector<std::uint32_t>& featureOf,
                                      std::size_t count) {
        std::vector<Found> found(count);
        std::vector<std::uint32_t> numberOf(model.features.size(), 0);
        for (std::size_t r = 0; r < model.roots.size(); ++r) {
            numberOf[model.roots[r]] = featureOf[r];
            Found& feature = found[featureOf[r]];
            feature.isThere = true;
            if (feature.id.empty()) feature.id = model.features[model.roots[r]].id;
        }
        // Parents stand before their children.
        for (std::size_t f = 0; f < model.features.size(); ++f) {
            const model::Feature& feature = model.features[f];
            if (feature.parent != model::kNoFeature) numberOf[f] = numberOf[feature.parent];
            Found& to = found[numberOf[f]];
            for (const model::Geometry& geometry : feature.geometries) {
                const Box3d box = model.bounds(geometry);
                to.box.add(box);
                to.points += pointsOf(model, geometry);
                const Vec3d size = box.size();
                if (!box.isEmpty()) to.area = std::max(to.area, 2 * (size.x * size.y + (size.x + size.y) * size.z));
            }
        }
        return found;
    }

    static std::uint64_t pointsOf(const model::BuildingModel& model, const model::Geometry& geometry) {
        std::uint64_t points = 0;
        model::forEachUse(geometry,
                          [&](const model::SurfaceUse& use) { points += model.polygons[use.polygon].points.size(); });
        return points;
    }

    void add(const Found& found, const readers::FeatureSpan& span, std::string_view text) {
        constexpr double kReach = 2.1e7;  // of centimetres in 32 bits
        const Vec3d middle = found.box.center();
        if (!found.isThere) return;
        if (found.box.isEmpty() || !isFinite(middle)) {
            ++empty_;
            ++survey_.skipped;
            return;
        }
        if (std::abs(middle.x) > kReach || std::abs(middle.y) > kReach)
            return skip(fmt::format("the feature '{}' lies at ({:.0f}, {:.0f}), which no CRS in metres has", found.id,
                                    middle.x, middle.y));
        const double spacing = options_.city.spacing;
        const double cost = kMicrosecondsEach + kMicrosecondsPerPoint * double(found.points) +
                            kMicrosecondsPerThousandVoxels * found.area / (spacing * spacing) / 1000;
        // Readers make ids such as "Building[3]" where a file gives none.
        // The first id of a whole file is often that of a project with several files.
        const bool isStated = !isWhole_ && !found.id.empty() && found.id.back() != ']';
        survey_.features.push_back({span.begin, span.size, contentHash(text),
                                    (idHash(found.id) & ~std::uint64_t{1}) | (isStated ? 1 : 0),
                                    static_cast<std::int32_t>(std::floor(middle.x * 100)),
                                    static_cast<std::int32_t>(std::floor(middle.y * 100)), number_,
                                    static_cast<std::uint32_t>(std::min(cost, 4e9))});
    }

    // If no feature ended, those that the model lacks have no content, such as a line that was cut off.
    void noteEnded(const Diagnostics& findings, std::vector<Found>& found) {
        if (findings.count(Code::FeatureEnded) == 0)
            for (Found& feature : found) feature.isThere = true;
        ended_ += static_cast<std::uint64_t>(
            std::count_if(found.begin(), found.end(), [](const Found& feature) { return !feature.isThere; }));
        for (const Diagnostic& item : findings.items())
            if (item.code == Code::FeatureEnded && firstEnded_.empty()) firstEnded_ = item.message;
    }

    void skip(std::string message) {
        ++survey_.skipped;
        diagnostics_.add(Severity::Warning, Code::FeatureSkipped, std::move(message), {path_.string(), 0, 0, {}});
    }

    void tellSkipped() {
        if (featuresInDoubt_ != 0) {
            if (survey_.unreadable == 0) survey_.firstUnreadable = inDoubt_;
            survey_.unreadable += featuresInDoubt_;
            survey_.skipped += featuresInDoubt_;
            diagnostics_.add(Severity::Warning, Code::UnitInDoubt,
                             fmt::format("all {} features of the file are left out: {}", featuresInDoubt_, inDoubt_),
                             {path_.string(), 0, 0, {}});
        }
        if (empty_ != 0)
            diagnostics_.add(Severity::Warning, Code::FeatureSkipped,
                             fmt::format("{} features without geometry are left out", empty_),
                             {path_.string(), 0, 0, {}});
        if (!firstEnded_.empty())
            diagnostics_.add(Severity::Note, Code::FeatureEnded,
                             fmt::format("{} whole features are left out, for example: {}", ended_, firstEnded_),
                             {path_.string(), 0, 0, {}});
        if (linked_ != 0)
            diagnostics_.add(
                Severity::Warning, Code::LinkedFeature,
                fmt::format("{} references lead out of the features that have them; these are read without the "
                            "targets",
                            linked_),
                {path_.string(), 0, 0, {}});
    }

    const std::filesystem::path& path_;
    const PlanOptions& options_;
    Survey& survey_;
    Diagnostics& diagnostics_;
    PlanFile entry_;
    std::uint32_t number_ = 0;
    std::uint64_t empty_ = 0, linked_ = 0, ended_ = 0, featuresInDoubt_ = 0;
    std::string firstEnded_;
    std::string inDoubt_;  ///< reason why the unit of the file is in doubt
    bool isDecided_ = false, isWhole_ = false;
};

}  // namespace

Result<void> surveyFile(const std::filesystem::path& path, const PlanOptions& options, Survey& survey,
                        Diagnostics& diagnostics) {
    return FileSurvey(path, options, survey, diagnostics).run();
}

}  // namespace svt::city
