#pragma once
/// \file
/// Sums over columns of detail 1, from which a tile of a coarse level is made. They are whole numbers and are only
/// added, so the level does not depend on the order of additions.

#include <svt/city/city_levels.hpp>
#include <svt/core/result.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace svt::city {

/// Classes of a city, numbered in the order in which they were found: classes of buildings ("Building"), and classes of
/// their parts ("Building/RoofSurface"). The colour is that of the first label.
struct LevelClasses {
    std::vector<std::string> names;  ///< as above
    std::vector<std::string> roots;  ///< the class of the building
    std::vector<Vec3f> colors;
    std::vector<std::uint64_t> buildings;  ///< 0 for parts
    std::map<std::string, std::uint32_t> numberOf;

    /// \param root  the building that the label is, or is a part of
    std::uint32_t add(const volume::Label& root, const volume::Label& label);
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
    using ByClass = std::map<std::uint32_t, std::vector<std::uint64_t>>;
    ByClass areaOf;  ///< columns of detail 1 whose highest sample is of the class
    ByClass sideOf;  ///< faces of samples of detail 1 below the highest one that have no neighbour in the same member

    LevelSums(int detail, std::array<std::int64_t, 2> first, std::array<std::int32_t, 2> size);
    void add(const LevelSource& source);
    /// Adds columns of the next finer detail.
    void add(const LevelSums& finer);
    /// The level as a volume; without columns if nothing is filled.
    [[nodiscard]] Result<volume::SemanticVolume> volume(double spacing, const LevelClasses& classes,
                                                        const std::string& crsName) const;

private:
    [[nodiscard]] std::vector<std::uint64_t>& ofClass(ByClass& all, std::uint32_t number) const;
    void addColumn(const LevelSource& source, std::int32_t i, std::int32_t j);
};

}  // namespace svt::city
