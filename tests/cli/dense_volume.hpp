#pragma once
/// \file
/// A built volume sample by sample, as seen by other programs: `svt convert` to raw NRRD, labels from `svt info
/// --json`.

#include "run_command.hpp"

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace svt::test {

struct DenseVolume {
    nlohmann::json info;                            ///< of `svt info --json`
    std::map<std::string, nlohmann::json> objects;  ///< by id
    std::vector<std::uint32_t> scalars;             ///< per sample, x fastest, then y, then z

    /// One name per sample: `nameOf` of the object's JSON, empty for background.
    [[nodiscard]] std::vector<std::string> names(const std::function<std::string(const nlohmann::json&)>& nameOf) const;
};

/// Converts `volume` of `folder` and reads the result back.
[[nodiscard]] DenseVolume readDense(const TemporaryFolder& folder, const std::string& volume);

/// Objects of `svt info --json` by id.
[[nodiscard]] std::map<std::string, nlohmann::json> objectsById(const nlohmann::json& info);

}  // namespace svt::test
