#pragma once
/// \file
/// A section of a city as one drawing.

#include <svt/illustrate/section_drawing.hpp>

#include <filesystem>
#include <string>

namespace svt::cli {

/// A drawing, and a volume with the labels that it names and the grid that its coordinates refer to.
struct CitySection {
    illustrate::SectionDrawing drawing;
    volume::SemanticVolume volume;
};

/// Cuts the tiles of a city that a plane meets, one after the other. A building is whole in its tile, so nothing has a seam.
/// \param plane  see parseSectionPlane(); positions refer to the box of the city
/// \return the section, or an error of City, parseSectionPlane(), drawSection()
/// Memory: that of one tile for each thread, and the drawing.
[[nodiscard]] Result<CitySection> cutCity(const std::filesystem::path& folder, const std::string& plane,
                                          const illustrate::SectionOptions& options, const Progress* progress);

}  // namespace svt::cli
