#pragma once
/// \file
/// A semantic volume texture: grid, labels and columns. The output of `svt build` and the content of a `.svt` file.

#include <svt/volume/column_volume.hpp>
#include <svt/volume/face_planes.hpp>
#include <svt/volume/grid.hpp>
#include <svt/volume/label_table.hpp>
#include <svt/volume/vector_parts.hpp>

#include <string>
#include <vector>

namespace svt::volume {

struct SemanticVolume {
    Grid grid;
    LabelTable labels;
    ColumnVolume columns;
    std::string crsName;              ///< srsName or referenceSystem of the model, or empty
    std::string modelName;            ///< name of the model, or empty
    std::string source;               ///< file name (without folder) of the model
    VectorParts vectors{};            ///< empty unless requested
    std::vector<FacePlane> planes{};  ///< planes of the model's faces, largest area first; empty if unknown
    /// Triangles that give the outlines in plan, see analyze::PlanFaces. For volumes without meshes, such as the tiles of
    /// a city; else empty.
    VectorParts footprints{};
};

}  // namespace svt::volume
