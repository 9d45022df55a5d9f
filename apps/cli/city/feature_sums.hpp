#pragma once
/// \file
/// Sums of features by keys, in which each cubic metre counts once: `svt query --by`.

#include <apps/cli/output/table.hpp>

#include <svt/analyze/extents.hpp>
#include <svt/city/feature_rows.hpp>
#include <svt/frontend/label_values.hpp>

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace svt::cli {

using frontend::splitKeys, frontend::valuesOfKey;

/// Adds up the features of one or more volumes by the values of keys.
///
/// Each label counts once, with the values of the finest feature that contains it. The keys `class`, `name`, `id`,
/// `ifcType` and `material` describe this feature itself. `storey` is the storey that contains the label. All other keys
/// are attributes, like keys in quotes. A feature without one has that of the next feature around it: a room has the
/// owner of its flat.
///
/// Volumes are those of analyze::exclusiveMeasures(). A feature that would be counted in voxels has its known volume
/// instead, if all its parts have the same values and lost no voxels to other features.
class FeatureSums {
public:
    /// \param keys      separated by commas
    /// \param hasFaces  sums the areas of faces by analyze::FaceKind as well
    FeatureSums(const std::string& keys, bool hasFaces);

    /// \param meshAreas  of analyze::meshAreas(), if faces are summed
    /// Cost: that of analyze::exclusiveMeasures(), and O(labels of all extents) for each key.
    void add(const volume::SemanticVolume& volume, std::span<const city::FeatureRow> rows,
             std::span<const std::optional<double>> meshAreas);

    /// One row for each combination of values. Volumes and areas of groups without any are null.
    [[nodiscard]] Table table() const;
    /// Prints notes on features that the sums exclude, and on volumes that are counted in voxels.
    void note() const;

private:
    struct Sum {
        std::uint64_t count = 0;
        bool hasVolume = false, hasArea = false;
        double volume = 0, counted = 0, area = 0;
        std::array<double, 5> faces{};  // by FaceKind
        std::array<bool, 5> hasFaces{}, hasUnknownFaces{};
    };

    /// Adds the known volumes of features whose parts all count to one sum.
    /// \return by label: 1 if it counts with one of them
    static std::vector<char> addWholes(const volume::LabelTable& table, const analyze::Extents& extents,
                                       std::span<const city::FeatureRow> rows, std::span<const analyze::Measure> own,
                                       const std::vector<Sum*>& sumOf);
    void addAreas(const volume::LabelTable& table, std::span<const city::FeatureRow> rows,
                  const analyze::Extents& extents, std::span<const analyze::Measure> own,
                  const std::vector<Sum*>& sumOf);
    // Each face counts once, with the values of the finest feature that contains it.
    void addFaces(const volume::LabelTable& table, std::span<const std::optional<double>> meshAreas,
                  std::span<const std::uint32_t> finest, const std::vector<Sum*>& sumOf);

    std::vector<std::string> keys_;
    bool hasFaces_ = false;
    std::map<std::vector<std::string>, Sum> sums_;
    std::uint64_t withoutVolume_ = 0, withoutVoxels_ = 0;
    std::uint64_t inParts_ = 0;      // features whose voxels all count to other values
    std::uint64_t withoutMesh_ = 0;  // labels of faces
};

}  // namespace svt::cli
