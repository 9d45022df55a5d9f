#pragma once
/// \file
/// The changes between two volumes of one building: objects are matched by the space they occupy, and by ids.
///
/// All other programs known to us match objects by id or by a digest of their mesh. Space needs neither: it still matches
/// after an export with new ids, in another format, or with other triangles.

#include <svt/core/attribute.hpp>
#include <svt/core/names.hpp>
#include <svt/core/progress.hpp>
#include <svt/core/result.hpp>
#include <svt/core/vec.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace svt::compare {

enum class Change : std::uint8_t {
    Same,        ///< no face is farther away than the tolerance
    Moved,       ///< the same shape elsewhere
    Changed,     ///< another shape
    Split,       ///< one object became several
    Merged,      ///< several objects became one
    Reassigned,  ///< the same space belongs to an object with another id and class
    Added,
    Removed
};
constexpr auto namesOf(Change) {
    return std::to_array<Name<Change>>({{Change::Same, "same"},
                                        {Change::Moved, "moved"},
                                        {Change::Changed, "changed"},
                                        {Change::Split, "split"},
                                        {Change::Merged, "merged"},
                                        {Change::Reassigned, "reassigned"},
                                        {Change::Added, "added"},
                                        {Change::Removed, "removed"}});
}
inline constexpr std::size_t kChangeCount = 8;

enum class MatchBy : std::uint8_t {
    Both,   ///< space, and ids where the two objects with one id can be one object
    Space,  ///< space only
    Id      ///< ids only
};
constexpr auto namesOf(MatchBy) {
    return std::to_array<Name<MatchBy>>({{MatchBy::Both, "both"}, {MatchBy::Space, "space"}, {MatchBy::Id, "id"}});
}

enum class Properties : std::uint8_t {
    All,    ///< class, name, storey and attributes
    Names,  ///< class, name and storey
    None
};
constexpr auto namesOf(Properties) {
    return std::to_array<Name<Properties>>(
        {{Properties::All, "all"}, {Properties::Names, "names"}, {Properties::None, "none"}});
}

struct CompareOptions {
    MatchBy match = MatchBy::Both;
    Properties properties = Properties::All;      ///< that are compared, beside space
    double tolerance = 0.01;                      ///< metres, > 0
    std::uint64_t work = std::uint64_t{1} << 32;  ///< maximum number of steps of analyze::CommonSpaces
    int threads = 0;
    const Progress* progress = nullptr;
};

/// An attribute with different values. The lists refer to the two volumes.
struct AttributeChange {
    std::string name;
    std::optional<AttributeList> was, is;  ///< empty: the object does not have it
};

/// The change of an object, or of several that were split or merged.
struct ComparisonRow {
    Change change = Change::Same;
    std::vector<std::uint32_t> was, is;  ///< labels of the old and the new volume, ascending
    bool hasGeometry = false;            ///< false: a storey or group, which has only names and attributes
    std::optional<Vec3d> vector;         ///< metres, of moved objects
    /// Degrees about the vertical, counter-clockwise seen from above, in (-180, 180]: the smallest turn that makes the new
    /// shape of the old one, wherever it is. Only of changed objects. Empty: no turn does, or none is found.
    std::optional<double> rotation;
    std::optional<double> added,
        removed;                     ///< m3 of the new shape outside of the old one, and the reverse; empty: unknown
    std::optional<double> bound;     ///< m3 by which each of the two may be off; empty: unknown
    std::optional<double> distance;  ///< metres: the largest distance of sampled points from the other shape's faces
    bool isExact = false;            ///< added and removed come from closed meshes; else from voxels
    bool hasOtherId = false, hasOtherClass = false, hasOtherName = false, hasOtherStorey = false;
    std::vector<AttributeChange> attributes{};

    [[nodiscard]] bool hasOtherProperties() const noexcept {
        return hasOtherClass || hasOtherName || hasOtherStorey || !attributes.empty();
    }
    /// Whether space, name, class, storey or attributes differ. Other ids do not count.
    [[nodiscard]] bool isDifferent() const noexcept { return change != Change::Same || hasOtherProperties(); }
};

/// Rows by the property that differs. One row may count in several.
struct PropertyCounts {
    std::size_t classes = 0, names = 0, storeys = 0, attributes = 0;
};

struct Comparison {
    std::vector<ComparisonRow> rows;                 ///< by new label, then removed objects by old label
    std::array<std::size_t, kChangeCount> counts{};  ///< objects with geometry, by Change
    std::array<std::size_t, kChangeCount> groups{};  ///< features without geometry, by Change: same, added, removed
    std::size_t otherProperties = 0;                 ///< rows whose class, name, storey or attributes differ
    PropertyCounts properties;
    /// Features without geometry in both states that have no partner because several are possible. Their rows are added
    /// and removed.
    std::size_t ambiguousGroups = 0;
    bool isReferenceSystemUnknown = false;  ///< of one volume, or of two with different names: coordinates are compared
    bool isOnOneLattice = false;            ///< the samples of both grids coincide; else voxels give no volumes
    bool isComplete = true;                 ///< false: the work did not suffice for all exact volumes

    [[nodiscard]] bool isDifferent() const noexcept;
    /// Counts a row in counts, groups, otherProperties and properties.
    void count(const ComparisonRow& row) noexcept;
};

/// Compares two volumes in one coordinate reference system.
/// \param was, is  with meshes where exact volumes are wanted; must outlive the result, unchanged
/// \return the rows; BadArgument if the names of two known coordinate reference systems differ, if the tolerance is not
///         positive, or if the grids have different axes; Cancelled
/// Cost: O(n log n) in objects that did not change. Others: that of analyze::CommonSpaces, and O(t log t) in triangles.
[[nodiscard]] Result<Comparison> compareVolumes(const volume::SemanticVolume& was, const volume::SemanticVolume& is,
                                                const CompareOptions& options = {});

/// The translation from the old to the new volume that most objects share: the median offset of objects whose class and
/// area occur once. Empty if fewer than half of these agree with it within twice the tolerance, or if there are none.
/// Cost: O(n log n) in objects.
[[nodiscard]] std::optional<Vec3d> estimateTranslation(const volume::SemanticVolume& was,
                                                       const volume::SemanticVolume& is, double tolerance);

}  // namespace svt::compare
