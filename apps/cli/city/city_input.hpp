#pragma once
/// \file
/// Cities as inputs of commands that work on volumes.

#include <apps/cli/options/build_options.hpp>
#include <apps/cli/options/city_page.hpp>

#include <svt/city/city_view.hpp>
#include <svt/illustrate/scene_painter.hpp>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace svt::cli {

/// Prints what a city has, for `svt info` and `svt city info`. \return the exit code
int printCity(const std::filesystem::path& folder, bool json);

/// Memory that tiles may take: half of --memory, or 1 GB.
[[nodiscard]] std::uint64_t tileMemory();

/// A picture of a city: its tiles are chosen and read for each view.
class CityPicture {
public:
    /// \return the picture, or an error of City::open()
    [[nodiscard]] static Result<CityPicture> open(const std::filesystem::path& folder, const BuildArguments& build,
                                                  const Progress* progress);

    /// What cameras, planes and regions refer to: the box of the city.
    [[nodiscard]] const volume::SemanticVolume& frame() const noexcept { return frame_; }
    /// Reads what the scene shows, and draws it.
    /// \return the picture, or an error of makeFrameSpec(), readTiles(), castRays()
    [[nodiscard]] Result<illustrate::Painting> paint(illustrate::Scene scene, const render::CastOptions& options);

    /// All labels of the last picture, whose parts and scalars are those of its frame.
    [[nodiscard]] const volume::SemanticVolume& labels() const noexcept { return shown_; }
    [[nodiscard]] const city::ChosenTiles& chosen() const noexcept { return chosen_; }
    /// Queries of the last picture that select nothing.
    [[nodiscard]] const std::vector<std::string>& nothing() const noexcept { return nothing_; }

private:
    CityPicture(city::City city, volume::SemanticVolume frame, const BuildArguments& build, const Progress* progress)
        : city_(std::move(city)), frame_(std::move(frame)), build_(build), progress_(progress) {}
    Result<void> lookAround(illustrate::Scene& scene) const;
    Result<void> read();
    [[nodiscard]] Result<illustrate::Painting> draw(const illustrate::Scene& scene, const render::CastOptions& options);
    Result<void> leaveOutHidden(illustrate::Scene scene, const city::CameraView& view,
                                const render::CastOptions& options);
    [[nodiscard]] bool takeBack(const city::CameraView& view, const illustrate::Painting& painting);

    city::City city_;
    volume::SemanticVolume frame_, shown_;
    BuildArguments build_;
    const Progress* progress_;
    city::ChosenTiles chosen_;
    std::vector<city::IndexEntry> leftOut_;  // chosen, but behind what is seen
    std::vector<volume::SemanticVolume> parts_;
    std::vector<illustrate::ScenePainter::StyleMixture> mixtures_;
    float gaps_ = 0;  // the share of what is empty in columns of coarse details that is not hidden by what stands there
    std::vector<std::string> nothing_;
};

/// Asks each tile of a city, one after the other, so that memory is that of one tile for each thread.
/// \param box   west, south, lowest, east, north, highest; empty: all of the city
/// \param work  called in the order of tiles, never twice at once; an error ends it
/// \param isWanted  tiles that are read; null: all
[[nodiscard]] Result<void> forEachTile(const city::City& city, const std::vector<double>& box, int threads,
                                       const Progress* progress,
                                       const std::function<Result<void>(const volume::SemanticVolume&)>& work,
                                       const std::function<bool(const city::IndexEntry&)>& isWanted = {});

}  // namespace svt::cli
