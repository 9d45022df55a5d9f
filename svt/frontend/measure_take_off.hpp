#pragma once
/// \file
/// Measures the objects of a volume for a take-off.

#include <svt/core/progress.hpp>
#include <svt/core/result.hpp>
#include <svt/frontend/take_off.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace svt::frontend {

/// Queries and options of a take-off.
struct TakeOffQuestion {
    std::string where, by, formwork;  ///< queries and keys; empty: none
    bool exterior = false;
    int threads = 0;      ///< 0: all cores
    bool isPart = false;  ///< the volume is one of many: a query may select nothing in it
};

/// The note on a volume without meshes.
inline constexpr const char* kNoMeshes =
    "the volume has no meshes, so areas, lengths and openings are unknown; build it with --vectors meshes";

/// The objects of a query; without one, all components, else all bodies, else all that have geometry.
/// \param notes  gets a note if the model has no components
/// \return labels, ascending; or an error of analyze::selectLabels()
[[nodiscard]] Result<std::vector<std::uint32_t>> findObjects(const volume::SemanticVolume& volume,
                                                             const std::string& query, std::vector<std::string>& notes);

/// The take-off of a volume as `svt quantities` makes it. A query that selects nothing gives no rows and a note.
/// \param notes     gets the notes that the command prints beside the figures
/// \param progress  gets the stages "measure", "share" and "touch"; may be null
/// \return the take-off, which refers to the volume; or an error of a query
/// Cost: that of quantities::measureObjects(), countedVolumes() and, for exterior and formwork, findTouchingAreas().
[[nodiscard]] Result<TakeOff> measureTakeOff(const volume::SemanticVolume& volume, const TakeOffQuestion& question,
                                             std::vector<std::string>& notes, const Progress* progress = nullptr);

/// The labels that a query selects, ascending. \param isPart  as in TakeOffQuestion: empty if it selects nothing
/// \return the labels, or an error of analyze::selectLabels()
[[nodiscard]] Result<std::vector<std::uint32_t>> selectedLabels(const volume::SemanticVolume& volume,
                                                                const std::string& query, bool isPart);

/// The areas of --exterior and --formwork. They stay empty for objects that lack a mesh.
/// \return nothing, or an error of the query
[[nodiscard]] Result<void> addTouchingAreas(const TakeOffQuestion& question, TakeOff& takeOff);

/// Storeys, materials, and the values of the keys. It can be called again with other keys.
void addTexts(const TakeOffQuestion& question, TakeOff& takeOff);

/// All of a take-off for objects of quantities::measureObjects(). \param progress  as in measureTakeOff()
/// \return nothing, or an error of a query
[[nodiscard]] Result<void> completeTakeOff(const TakeOffQuestion& question, TakeOff& takeOff,
                                           const Progress* progress = nullptr);

}  // namespace svt::frontend
