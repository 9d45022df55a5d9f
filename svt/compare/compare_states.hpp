#pragma once
/// \file
/// Two states of a building from their sources to rows: reading on common samples, a common translation, comparison.

#include <svt/compare/compared.hpp>
#include <svt/core/names.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>

namespace svt::compare {

/// The result of looking for a common translation of two states.
enum class Alignment : std::uint8_t {
    NotAsked,
    NotFound,  ///< fewer than half of the objects with one shape agree; the states stay in their places
    Aligned,   ///< the states lie at one place within the tolerance
    Moved      ///< the new state was moved to the old one
};
constexpr auto namesOf(Alignment) {
    return std::to_array<Name<Alignment>>({{Alignment::NotAsked, ""},
                                           {Alignment::NotFound, "notFound"},
                                           {Alignment::Aligned, "aligned"},
                                           {Alignment::Moved, "moved"}});
}

/// A source of a state.
struct StateSource {
    /// Reads the state with its meshes. \param grid  a model has its sample positions; null: those of the source
    std::function<Result<volume::SemanticVolume>(const volume::Grid* grid)> read;
    bool isVolume = false;  ///< a volume has its own samples
};

/// Two states and their comparison.
struct ComparedStates {
    volume::SemanticVolume was, is;
    Comparison comparison;
    CompareOptions options;  ///< without progress
    Vec3d shift{};           ///< metres by which the new state was moved
    Alignment alignment = Alignment::NotAsked;

    /// \param wasFile, isFile  as given by the user. The result refers to these states.
    [[nodiscard]] Compared compared(std::string wasFile = {}, std::string isFile = {}) const {
        return {was, is, comparison, std::move(wasFile), std::move(isFile), shift, options};
    }
};

/// Reads two states on the samples of a volume if there is one, else on those of the old state, and compares them.
/// \param isAligned  moves the new state by estimateTranslation(). A model is read a second time, so that its samples
///                   coincide with those of the old state after the move.
/// \return the states; an error of the sources or of compareVolumes()
/// Cost: that of reading, of estimateTranslation() and of compareVolumes().
[[nodiscard]] Result<ComparedStates> compareStates(const StateSource& was, const StateSource& is, bool isAligned,
                                                   const CompareOptions& options);

}  // namespace svt::compare
