#include <apps/cli/check/feature_batches.hpp>

#include <svt/readers/feature_file.hpp>

#include <fmt/format.h>

#include <string>
#include <unordered_set>
#include <utility>
#include <vector>

namespace svt::cli {
namespace {

using readers::FeatureFile;
using readers::FeatureFormat;

constexpr std::uint64_t kLargeFile = std::uint64_t{64} << 20, kLargeGzip = std::uint64_t{6} << 20;
constexpr std::size_t kBatchBytes = std::size_t{16} << 20;

struct Batch {
    std::vector<std::string> texts;
    std::vector<std::uint64_t> lines;
    std::size_t bytes = 0;
};

class BatchReader {
public:
    BatchReader(FeatureFile file, readers::ReadOptions options,
                const std::function<Result<void>(model::BuildingModel&, Diagnostics&)>& take)
        : file_(std::move(file)), options_(std::move(options)), progress_(options_.progress), take_(take) {
        options_.progress = nullptr;  // it would restart with each batch
        options_.keepFarFeatures = true;
    }

    Result<bool> run() {
        Batch batch;
        readers::FeatureText feature;
        while (true) {
            SVT_TRY(found, file_.next(feature));
            if (*found) {
                batch.texts.emplace_back(feature.text);
                batch.lines.push_back(feature.line);
                batch.bytes += feature.text.size();
            }
            if (*found && batch.bytes < kBatchBytes) continue;
            if (!batch.texts.empty()) {
                SVT_TRY(taken, takeBatch(batch));
                if (!*taken) return false;
            }
            if (!*found) return isEmpty_ ? Result<bool>(false) : Result<bool>(true);
            batch = {};
        }
    }

private:
    Result<bool> takeBatch(const Batch& batch) {
        Diagnostics findings;
        const std::vector<std::string_view> texts(batch.texts.begin(), batch.texts.end());
        auto model = file_.read(texts, options_, &findings, nullptr, batch.lines);
        // The reader of the whole file has a better message.
        if (!model && model.error().code() != Code::EmptyModel) return false;
        if (findings.count(Code::DanglingReference) != 0) return false;
        Progress::tell(progress_, "check", file_.progress());
        if (Progress::isCancelled(progress_)) return Error(Code::Cancelled, "stopped while checking");
        if (!model) return true;
        isEmpty_ = false;
        if (options_.axisOrder == 0) {  // the first batch decides for all
            options_.axisOrder = model->crs.axesSwapped ? -1 : 1;
            if (model->crs.epsg != 0) options_.crs = model->crs.epsg;
        }
        dropRepeated(findings);
        findDuplicates(*model, findings);
        SVT_DO(take_(*model, findings));
        return true;
    }

    // Reports a finding about the whole file once.
    void dropRepeated(Diagnostics& findings) {
        Diagnostics once;
        for (const Diagnostic& item : findings.items()) {
            const bool isOfFile = item.where.id.empty() && item.where.line == 0;
            if (!isOfFile || told_.insert(item.message).second)
                once.add(item.severity, item.code, item.message, item.where);
        }
        if (once.items().size() != findings.items().size()) findings = std::move(once);
    }

    // Ids that occur in an earlier batch. The reader of a batch finds duplicates within it.
    void findDuplicates(const model::BuildingModel& model, Diagnostics& findings) {
        std::vector<std::uint64_t> own;
        for (const model::Feature& feature : model.features) {
            const std::uint64_t hash = std::hash<std::string>{}(feature.id);
            if (ids_.contains(hash))
                findings.add(Severity::Warning, Code::DuplicateId,
                             "this id was used before; references mean its first use",
                             {model.source, feature.line, 0, feature.id});
            own.push_back(hash);
        }
        ids_.insert(own.begin(), own.end());
    }

    FeatureFile file_;
    readers::ReadOptions options_;
    const Progress* progress_;
    const std::function<Result<void>(model::BuildingModel&, Diagnostics&)>& take_;
    std::unordered_set<std::uint64_t> ids_;
    std::unordered_set<std::string> told_;
    bool isEmpty_ = true;
};

}  // namespace

bool isWorthBatches(const std::filesystem::path& file) {
    std::error_code failed;
    const std::uint64_t size = std::filesystem::file_size(file, failed);
    return !failed && size >= (file.extension() == ".gz" ? kLargeGzip : kLargeFile);
}

Result<bool> forEachBatch(const std::filesystem::path& file, const readers::ReadOptions& options,
                          const std::function<Result<void>(model::BuildingModel&, Diagnostics&)>& take) {
    auto opened = FeatureFile::open(file, options);
    if (!opened) return false;
    if (opened->format() != FeatureFormat::CityGml && opened->format() != FeatureFormat::CityJsonSeq) return false;
    return BatchReader(std::move(*opened), options, take).run();
}

}  // namespace svt::cli
