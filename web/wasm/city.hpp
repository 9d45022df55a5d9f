#pragma once
/// \file
/// A city whose bytes the page fetches: the session of what a camera sees of it.

#include "session.hpp"

#include <svt/city/city_bytes.hpp>
#include <svt/city/city_view.hpp>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace svt::web {

/// What a picture of a city needs.
struct CityWish {
    std::optional<illustrate::Scene> scene;  ///< none: the one tile of the coarsest detail
    double pixels = 1;                       ///< voxels may be as wide
    std::uint64_t memoryBytes = 0;           ///< of decoded tiles
    std::string shown;                       ///< Look::key of what is seen already
};

/// Calls that need bytes return nothing, and wanted() names them: give them, and call again.
class CityPage {
public:
    city::CityBytes& bytes() noexcept { return bytes_; }

    struct Look {
        std::unique_ptr<Session> session;  ///< null: what is seen already will do
        std::string key;                   ///< of the tiles that were chosen
        std::size_t tiles = 0;
        std::uint64_t bytes = 0;         ///< of the tiles' members
        double pixels = 1;               ///< voxels are at most as wide; more than wished for where memory is short
        int finest = 0, coarsest = 0;    ///< details
        std::vector<std::string> lacks;  ///< tiles that cannot be had: why
    };
    /// Chooses, reads and joins tiles.
    /// \return what is seen, or an error of City::open(), makeFrameSpec(), chooseTiles(), joinLabels(). If wanted() is
    ///         not empty after an error, bytes are needed
    [[nodiscard]] Result<Look> look(const CityWish& wish);

    /// A camera that shows the building with an id, from the direction of `now`.
    /// \return the camera; NothingSelected if there is none; else as look()
    [[nodiscard]] Result<illustrate::SceneCamera> find(const std::string& id, const illustrate::SceneCamera& now,
                                                       double aspect);
    [[nodiscard]] const std::optional<city::City>& city() const noexcept { return city_; }

private:
    [[nodiscard]] Result<void> open();
    [[nodiscard]] Result<city::ChosenTiles> choose(const CityWish& wish);

    city::CityBytes bytes_;
    std::optional<city::City> city_;
    volume::SemanticVolume frame_;
};

}  // namespace svt::web
