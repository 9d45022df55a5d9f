#pragma once
/// \file
/// Answers questions on many features of a city or volume, tile by tile: rows into a file, sums by attribute, the
/// largest features.

#include <apps/cli/output/table.hpp>

#include <svt/pipeline/build_volume.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace svt::cli {

struct FeatureQuery {
    std::filesystem::path input, output;
    std::string query = "all";
    std::vector<double> box;
    std::string by, cut, sort;
    int first = 0;
    bool leaks = false, roofs = false;
    bool faces = false;  ///< columns of faceAreas(), by --with; it does not count as asked
    TableFormat format = TableFormat::Text;
    pipeline::BuildOptions build;

    /// Whether an option is given that only runFeatureQuery() answers.
    [[nodiscard]] bool isAsked() const {
        return !output.empty() || !box.empty() || !by.empty() || !cut.empty() || !sort.empty() || first > 0 || leaks ||
               roofs;
    }
};

/// \return the exit code
[[nodiscard]] Result<int> runFeatureQuery(const FeatureQuery& query);

}  // namespace svt::cli
