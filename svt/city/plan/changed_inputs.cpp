// Compares the source files of a plan with the plan.
#include <svt/city/base/sha256.hpp>
#include <svt/city/city_plan.hpp>

#include <algorithm>
#include <map>

namespace svt::city {
namespace {

namespace fs = std::filesystem;

// Whether all planned features of a file, in its order, have the planned content.
bool hasContent(const PlanFile& file, std::span<const PlanFeature> features) {
    auto opened = readers::FeatureFile::open(file.path);
    if (!opened || contentHash(opened->head()) != file.headHash) return false;
    std::vector<readers::FeatureSpan> spans;
    for (const PlanFeature& feature : features) spans.push_back(feature.span);
    bool isSame = true;
    const auto picked = opened->pick(spans, [&](std::size_t n, std::string_view text) -> Result<void> {
        isSame = isSame && contentHash(text) == features[n].contentHash;
        return {};
    });
    return picked && isSame;
}

using FeaturesByFile = std::map<std::uint32_t, std::vector<PlanFeature>>;

// The features of the files that `to` has, each in the order of its file.
Result<void> readFeatures(const fs::path& folder, const Plan& plan, FeaturesByFile& to) {
    for (std::uint32_t pack = 0; pack < plan.packs && !to.empty(); ++pack) {
        const auto [first, last] = plan.tilesOf(pack);
        SVT_TRY(features, readPlanFeatures(folder, plan, first, last));
        for (const PlanFeature& feature : *features)
            if (const auto own = to.find(feature.file); own != to.end()) own->second.push_back(feature);
    }
    for (auto& [file, features] : to)
        std::sort(features.begin(), features.end(),
                  [](const PlanFeature& a, const PlanFeature& b) { return a.span.begin < b.span.begin; });
    return {};
}

}  // namespace

Result<std::vector<ChangedInput>> changedInputs(const fs::path& folder, const Plan& plan, bool isProven) {
    std::vector<ChangedInput> changed;
    FeaturesByFile suspects;
    std::error_code failed;
    const fs::file_time_type planned = fs::last_write_time(folder / "plan" / "plan.json", failed);
    for (std::uint32_t n = 0; n < plan.files.size(); ++n) {
        std::error_code missing, unknown;
        const std::uint64_t size = fs::file_size(plan.files[n].path, missing);
        const auto written = fs::last_write_time(plan.files[n].path, unknown);
        if (!missing && size == plan.files[n].size && (isProven || unknown || failed || written > planned)) suspects[n];
    }
    SVT_DO(readFeatures(folder, plan, suspects));
    for (std::uint32_t n = 0; n < plan.files.size(); ++n) {
        const PlanFile& file = plan.files[n];
        std::error_code missing;
        const std::uint64_t size = fs::file_size(file.path, missing);
        const auto suspect = suspects.find(n);
        if (missing || size != file.size || (suspect != suspects.end() && !hasContent(file, suspect->second)))
            changed.push_back({file.path, bool(missing)});
    }
    return changed;
}

}  // namespace svt::city
