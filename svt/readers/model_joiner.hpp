#pragma once
/// \file
/// Joins the models of several files.

#include <svt/core/diagnostics.hpp>
#include <svt/core/result.hpp>
#include <svt/model/building_model.hpp>
#include <svt/readers/read_options.hpp>

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <unordered_set>

namespace svt::readers {

/// A file in memory.
struct NamedBytes {
    std::string name;  ///< for messages
    std::span<const std::byte> bytes;
};

/// Reads all files into one model with ModelJoiner. Coordinates in degrees or feet in a later file are projected to the
/// CRS of the first.
/// \param log  receives the findings; may be null
/// \return the model, or an error of readModel(); BadArgument if there is no file
[[nodiscard]] Result<model::BuildingModel> readModels(std::span<const std::filesystem::path> files, ReadOptions options,
                                                      Diagnostics* log);
[[nodiscard]] Result<model::BuildingModel> readModels(std::span<const NamedBytes> files, ReadOptions options,
                                                      Diagnostics* log);

/// Takes models one after the other. An id that an earlier model has gets `@` and the number of the model (1-based) as
/// suffix. Renamed ids and different CRSs are warnings.
class ModelJoiner {
public:
    /// \param log  receives the warnings; may be null
    explicit ModelJoiner(Diagnostics* log) : log_(log) {}

    /// Adds a model. The first one is not changed; later ones are appended. Cost: O(features of `from`), plus
    /// O(features of the first model) when the second one is added.
    void add(model::BuildingModel from);
    /// Number of models.
    [[nodiscard]] std::size_t count() const noexcept { return count_; }
    [[nodiscard]] model::BuildingModel& joined() noexcept { return all_; }
    /// Number of ids that were looked up so far.
    [[nodiscard]] std::size_t lookups() const noexcept { return lookups_; }

private:
    void append(model::BuildingModel from);
    void keepIdUnique(model::Feature& feature, const std::string& source);

    Diagnostics* log_;
    model::BuildingModel all_;
    std::unordered_set<std::string> known_;  // ids of all_; empty while there is only one model
    std::size_t count_ = 0, lookups_ = 0;
};

}  // namespace svt::readers
