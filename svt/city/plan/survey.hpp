#pragma once
/// \file
/// One pass over the features of a file: bytes, position and cost of each.

#include <svt/city/city_plan.hpp>

#include <deque>

namespace svt::city {

/// A feature between survey and tiles. 48 bytes, because there are millions.
struct Surveyed {
    std::uint64_t begin = 0, size = 0, contentHash = 0;
    std::uint64_t idHash = 0;   ///< its lowest bit: whether the file states the id
    std::int32_t x = 0, y = 0;  ///< middle of its box, centimetres
    std::uint32_t file = 0;
    std::uint32_t cost = 0;  ///< microseconds
};

/// All features of all files.
struct Survey {
    std::deque<Surveyed> features;  ///< grows without moving
    std::uint64_t skipped = 0, unreadable = 0;
    std::string firstUnreadable;  ///< the reason
    int crs = 0;
    std::string crsName;
    std::vector<PlanFile> files;
    std::vector<std::string> fileNames;  ///< as they were given
};

/// Adds the features of a file. The first file with a CRS decides that of the city. If the unit of a file is in doubt, its
/// features are left out, with a warning.
/// \return nothing, or the error of a file that cannot be cut; Cancelled
Result<void> surveyFile(const std::filesystem::path& path, const PlanOptions& options, Survey& survey,
                        Diagnostics& diagnostics);

/// Makes the plan of the surveyed features and writes it into `folder`/plan. Memory: 4 bytes per feature in addition to
/// the survey.
[[nodiscard]] Result<Plan> planSurveyed(const Survey& survey, const std::filesystem::path& folder,
                                        const PlanOptions& options, Diagnostics& diagnostics);

}  // namespace svt::city
