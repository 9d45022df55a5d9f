#pragma once
/// \file
/// The source of each mesh: a feature, and the faces of its geometry or of its boundary surfaces.

#include <svt/core/diagnostics.hpp>
#include <svt/model/building_model.hpp>
#include <svt/model/classes.hpp>

#include <cstddef>
#include <utility>
#include <vector>

namespace svt::mesh {

/// The source of one mesh.
struct MeshSource {
    model::FeatureIndex feature = model::kNoFeature;
    double lod = -1;
    bool isAssembled = false;      ///< made from the boundary surfaces of the feature
    bool hasSolidMeaning = false;  ///< if so, an open shell will be closed
    std::vector<model::SurfaceUse> uses;
    std::vector<std::pair<std::size_t, std::size_t>> voids;  ///< ranges of `uses` that are shells of voids
    std::vector<std::size_t> solids;                         ///< where each solid begins in `uses`, with its voids
};

/// The sources of all meshes, in tree order. An outline of a building at level of detail 0 is left out if a part of the
/// building has geometry of a finer level.
/// \param log  receives a note on outlines and on coarser surfaces that are left out; may be null
[[nodiscard]] std::vector<MeshSource> collectSources(const model::BuildingModel& model, const model::LodChoice& lod,
                                                     Diagnostics* log);

/// Each solid of a source separately, after the faces that do not belong to a solid; empty if there are fewer than two.
[[nodiscard]] std::vector<MeshSource> splitIntoSolids(const MeshSource& source);

/// Per polygon the boundary surface that lists it, or kNoFeature.
[[nodiscard]] std::vector<model::FeatureIndex> findSurfacesOfPolygons(const model::BuildingModel& model);

}  // namespace svt::mesh
