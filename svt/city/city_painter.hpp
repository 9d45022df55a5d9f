#pragma once
/// \file
/// Pictures of a city. The command draws with CityPainter, which chooses and reads tiles for each camera. The page
/// fetches tiles itself and joins them with joinTiles(). A scene therefore has the same styles in both.

#include <svt/city/city_view.hpp>
#include <svt/illustrate/scene_painter.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace svt::city {

/// Tiles with one table of labels, ready to be drawn.
struct JoinedTiles {
    volume::SemanticVolume frame;  ///< frameVolume(), with the classes of the city and the labels of all parts
    std::vector<volume::SemanticVolume> parts;  ///< of readTiles()
    bool hasNear = false;                       ///< slopes of the last part are visible: see ChosenTiles::near
    /// Labels of coarse details, which take their styles from the classes that they cover.
    std::vector<illustrate::ScenePainter::StyleMixture> mixtures;

    /// Adds the parts and the mixtures to a painter of `frame`, which this object must outlive.
    void addTo(illustrate::ScenePainter& painter) const;
};

/// Joins tiles that were read.
/// \param frame  frameVolume() of the city
/// \param parts  readTiles() of `chosen`
/// \return the joined tiles, or an error of joinLabels()
[[nodiscard]] Result<JoinedTiles> joinTiles(const City& city, const volume::SemanticVolume& frame,
                                            const ChosenTiles& chosen, std::vector<volume::SemanticVolume> parts);

/// The view of a scene's camera on a city, for chooseTiles().
/// \param frame  frameVolume() of the city
/// \return the view, or an error of makeFrameSpec()
[[nodiscard]] Result<CameraView> viewOf(const illustrate::Scene& scene, const volume::SemanticVolume& frame);

/// Checks that a scene can be drawn for a city, whose parts are read tile by tile.
/// \return success, or BadArgument for a member that needs a whole model: explode, insets, or lines or meshes of a pass
[[nodiscard]] Result<void> checkCityScene(const illustrate::Scene& scene);

struct CityPaintOptions {
    std::uint64_t memoryBytes = 1'000'000'000;  ///< limit for tiles; a lower limit makes them coarser
    int threads = 0;                            ///< 0: all cores
    const Progress* progress = nullptr;
};

/// Not thread-safe.
class CityPainter {
public:
    /// \return the painter, or an error of frameVolume()
    [[nodiscard]] static Result<CityPainter> make(City city, const CityPaintOptions& options);

    /// The box of the city: cameras, planes and regions refer to it.
    [[nodiscard]] const volume::SemanticVolume& frame() const noexcept { return frame_; }

    /// Reads the visible tiles of a scene and draws them. A camera around the query "id=ID" shows this building.
    /// \return the picture, or an error of checkCityScene(), makeFrameSpec(), readTiles(), castRays(); BadArgument for
    ///         a
    ///         camera around another query
    [[nodiscard]] Result<illustrate::Painting> paint(illustrate::Scene scene, const render::CastOptions& options);

    /// Tiles of the last picture.
    [[nodiscard]] const ChosenTiles& chosen() const noexcept { return chosen_; }
    /// Queries of the last picture that select nothing.
    [[nodiscard]] const std::vector<std::string>& nothing() const noexcept { return nothing_; }

private:
    CityPainter(City city, volume::SemanticVolume frame, const CityPaintOptions& options)
        : city_(std::move(city)), frame_(std::move(frame)), options_(options) {}
    Result<void> lookAround(illustrate::Scene& scene) const;
    [[nodiscard]] Result<JoinedTiles> read() const;
    [[nodiscard]] Result<illustrate::Painting> draw(const illustrate::Scene& scene, const render::CastOptions& options);
    Result<void> leaveOutHidden(illustrate::Scene scene, const CameraView& view, const render::CastOptions& options);
    [[nodiscard]] bool takeBack(const CameraView& view, const illustrate::Painting& painting);

    City city_;
    volume::SemanticVolume frame_;
    CityPaintOptions options_;
    ChosenTiles chosen_;
    std::vector<IndexEntry> leftOut_;  // chosen, but hidden by other tiles
    std::vector<std::string> nothing_;
};

}  // namespace svt::city
