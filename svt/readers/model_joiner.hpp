#pragma once
/// \file
/// Joins the models of several files into one.

#include <svt/core/diagnostics.hpp>
#include <svt/model/building_model.hpp>

#include <cstddef>
#include <string>
#include <unordered_set>

namespace svt::readers {

/// Takes models one after the other. An id that an earlier model has gets `@` and the number of the model (1-based) as
/// suffix. That, and CRSs that differ, are warnings.
class ModelJoiner {
public:
    /// \param log  receives the warnings; may be null
    explicit ModelJoiner(Diagnostics* log) : log_(log) {}

    /// The first model is taken as it is; later ones are appended. Cost: O(features of `from`), once more for the first
    /// model when the second one comes.
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
    std::unordered_set<std::string> known_;  // ids of all_; empty as long as there is one model
    std::size_t count_ = 0, lookups_ = 0;
};

}  // namespace svt::readers
