#pragma once
/// \file
/// What a tile of a coarse level is made of: sums over columns of detail 1. They are whole numbers that are only ever
/// added, so the level does not depend on the order of what was added.

#include <svt/city/city_levels.hpp>
#include <svt/core/result.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace svt::city {

/// The classes of a city, numbered as they were met. The colour is that of the first building of the class.
struct LevelClasses {
    std::vector<std::string> names;
    std::vector<Vec3f> colors;
    std::vector<std::uint64_t> buildings;
    std::map<std::string, std::uint32_t> numberOf;

    std::uint32_t add(const volume::Label& label);
};

/// A volume of detail 1 on the lattice of the city. Column (0, 0) is column `first` of the lattice, its lowest sample
/// `lowest`.
struct LevelSource {
    const volume::ColumnVolume* columns = nullptr;
    std::array<std::int64_t, 2> first{};
    std::int64_t lowest = 0;
    std::vector<std::uint32_t> classOf;  ///< by scalar

    [[nodiscard]] static LevelSource from(const volume::SemanticVolume& volume, LevelClasses& classes);
};

/// Columns [first, first + size) of a detail.
struct LevelSums {
    int detail = 2;
    std::array<std::int64_t, 2> first{};
    std::array<std::int32_t, 2> size{};
    std::vector<std::int64_t> low, top;  ///< sums of samples of detail 1
    std::map<std::uint32_t, std::vector<std::uint64_t>>
        areaOf;  ///< by class: columns of detail 1 that it fills most of

    LevelSums(int detail, std::array<std::int64_t, 2> first, std::array<std::int32_t, 2> size);
    void add(const LevelSource& source);
    /// Adds columns of the detail before.
    void add(const LevelSums& finer);
    /// The level as a volume; without columns where nothing is filled.
    [[nodiscard]] Result<volume::SemanticVolume> volume(double spacing, const LevelClasses& classes,
                                                        const std::string& crsName) const;

private:
    [[nodiscard]] std::vector<std::uint64_t>& areas(std::uint32_t number);
};

}  // namespace svt::city
