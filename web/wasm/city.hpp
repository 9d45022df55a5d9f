#pragma once
/// \file
/// A city whose bytes the page fetches: makes a session of the tiles that a camera sees.

#include "session.hpp"

#include <svt/city/city_bytes.hpp>
#include <svt/city/city_view.hpp>
#include <svt/city/city_walk.hpp>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace svt::web {

/// A request for a picture of a city.
struct CityWish {
    std::optional<illustrate::Scene> scene;  ///< none: the one tile of the coarsest detail
    double pixels = 1;                       ///< maximum width of voxels, in pixels
    std::uint64_t memoryBytes = 0;           ///< limit for decoded tiles
    std::string shown;                       ///< Look::key of the tiles that are already visible
};

/// Makes sessions and cameras of a city. A call that needs bytes returns an error, and CityBytes::wanted() lists them:
/// give them to bytes(), and call again.
class CityPage {
public:
    city::CityBytes& bytes() noexcept { return bytes_; }

    struct Look {
        std::unique_ptr<Session> session;  ///< null: the visible tiles are sufficient
        std::string key;                   ///< of the chosen tiles
        std::size_t tiles = 0;
        std::uint64_t bytes = 0;       ///< of the tiles' members
        double pixels = 1;             ///< largest width of voxels, in pixels; over CityWish::pixels if memory is short
        int finest = 0, coarsest = 0;  ///< details
        std::vector<std::string> lacks;  ///< the reason for each unavailable tile
    };
    /// Chooses, reads and joins tiles.
    /// \return the visible part, or an error of City::open(), makeFrameSpec(), chooseTiles(), joinLabels(). If wanted()
    ///         is not empty after an error, the call needs bytes
    [[nodiscard]] Result<Look> look(const CityWish& wish);

    /// A camera that shows the building with an id, from the direction of `now`.
    /// \return the camera; NothingSelected if there is no such building; else as look()
    [[nodiscard]] Result<illustrate::SceneCamera> find(const std::string& id, const illustrate::SceneCamera& now,
                                                       double aspect);
    /// Buildings of the whole city by words: City::search(). Errors also as look().
    [[nodiscard]] Result<city::City::Found> search(const std::string& text, std::size_t most);
    /// Cuts the tiles of detail 0 that a plane meets: city::cutCity(). All these tiles are fetched at once.
    /// \param mostBytes  limit of their members
    /// \return the section; BadSection if the limit is exceeded; else an error of cutCity(), or as look()
    [[nodiscard]] Result<city::CitySection> cut(const std::string& plane, const drawing::SectionOptions& options,
                                                std::uint64_t mostBytes, const Progress* progress);
    [[nodiscard]] const std::optional<city::City>& city() const noexcept { return city_; }

private:
    [[nodiscard]] Result<void> open();
    [[nodiscard]] Result<city::ChosenTiles> choose(const CityWish& wish);

    city::CityBytes bytes_;
    std::optional<city::City> city_;
    volume::SemanticVolume frame_;
};

}  // namespace svt::web
