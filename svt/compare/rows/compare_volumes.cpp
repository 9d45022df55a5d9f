#include <svt/compare/comparison.hpp>

#include <svt/compare/match/match_objects.hpp>
#include <svt/compare/rows/geometry_change.hpp>
#include <svt/compare/rows/match_groups.hpp>
#include <svt/compare/rows/properties.hpp>
#include <svt/core/parallel.hpp>
#include <svt/crs/crs_name.hpp>
#include <svt/drawing/storey_floors.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>
#include <variant>

namespace svt::compare {
namespace {

Result<void> checkInputs(const volume::SemanticVolume& was, const volume::SemanticVolume& is,
                         const CompareOptions& options) {
    if (!(options.tolerance > 0) || !std::isfinite(options.tolerance))
        return Error(Code::BadArgument, "the tolerance of a comparison must be greater than 0");
    const std::uint32_t before = crs::epsgCodeOf(was.crsName), after = crs::epsgCodeOf(is.crsName);
    if (before != 0 && after != 0 && before != after)
        return Error(
            Code::BadArgument,
            fmt::format("the models have different coordinate reference systems, EPSG:{} and EPSG:{}; convert one of "
                        "them, for example with 'svt build NEW -o NEW.svt --crs EPSG:{}'",
                        before, after, before));
    return {};
}

// By label: voxels decide the comparison of the object.
std::vector<char> countedLabels(const volume::SemanticVolume& volume, std::span<const Shape> shapes) {
    std::vector<char> isCounted(volume.labels.labels.size(), 0);
    for (const Shape& shape : shapes) isCounted[shape.label] = shape.isSolid ? 0 : 1;
    return isCounted;
}

// Faces that close an open shell. The reader made and numbered them, so they say nothing about the state.
bool isGeneratedCap(const volume::Label& label) {
    const auto isMark = [](const Attribute& attribute) {
        const bool* value = std::get_if<bool>(&attribute.value);
        return attribute.name == "generated" && value != nullptr && *value;
    };
    return label.className == "ClosureSurface" && std::any_of(label.attributes.begin(), label.attributes.end(), isMark);
}

// By label: features that have a row of their geometry, or no row.
std::vector<char> labelsWithoutGroups(const volume::SemanticVolume& volume, std::span<const Shape> shapes) {
    std::vector<char> isOther(volume.labels.labels.size(), 0);
    for (std::size_t l = 0; l < isOther.size(); ++l) isOther[l] = isGeneratedCap(volume.labels.labels[l]) ? 1 : 0;
    for (const Shape& shape : shapes) isOther[shape.label] = 1;
    return isOther;
}

class Comparer {
public:
    Comparer(const volume::SemanticVolume& was, const volume::SemanticVolume& is, const CompareOptions& options)
        : was_(was),
          is_(is),
          options_(options),
          wasShapes_(findShapes(was, {})),
          isShapes_(findShapes(is, is.grid.origin() - was.grid.origin())) {}

    Result<Comparison> run() {
        Progress::tell(options_.progress, "match", 0);
        const VoxelOverlaps voxels(was_, is_, countedLabels(was_, wasShapes_), countedLabels(is_, isShapes_));
        analyze::CommonSpaces spaces(was_, is_, options_.work);
        const Sides sides{was_, is_, wasShapes_, isShapes_};
        std::vector<Match> matches = matchObjects(sides, options_, spaces, voxels);
        // Rows by new label, then what was removed by old label.
        std::sort(matches.begin(), matches.end(), [](const Match& a, const Match& b) {
            const auto key = [](const Match& m) {
                return m.is.empty() ? std::pair(true, m.was[0]) : std::pair(false, m.is[0]);
            };
            return key(a) < key(b);
        });
        SVT_DO(measure(sides, matches, spaces, voxels));
        comparison_.isReferenceSystemUnknown =
            was_.crsName != is_.crsName && (crs::epsgCodeOf(was_.crsName) == 0 || crs::epsgCodeOf(is_.crsName) == 0);
        comparison_.isOnOneLattice = voxels.isOnOneLattice();
        comparison_.isComplete = spaces.isComplete();
        addProperties();
        for (const ComparisonRow& row : comparison_.rows) comparison_.count(row);
        return std::move(comparison_);
    }

private:
    Result<void> measure(const Sides& sides, const std::vector<Match>& matches, analyze::CommonSpaces& spaces,
                         const VoxelOverlaps& voxels) {
        GeometryMeasurer measurer(sides, options_, spaces, voxels);
        std::vector<ComparisonRow>& rows = comparison_.rows;
        rows.resize(matches.size());
        for (std::size_t m = 0; m < matches.size(); ++m) {
            for (const std::uint32_t s : matches[m].was) rows[m].was.push_back(wasShapes_[s].label);
            for (const std::uint32_t s : matches[m].is) rows[m].is.push_back(isShapes_[s].label);
            std::sort(rows[m].was.begin(), rows[m].was.end());
            std::sort(rows[m].is.begin(), rows[m].is.end());
            rows[m].hasGeometry = true;
            measurer.measureVolumes(matches[m], rows[m]);
            if (Progress::isCancelled(options_.progress)) return Error(Code::Cancelled, "the comparison was stopped");
        }
        ProgressCounter counter(options_.progress, "compare", matches.size());
        parallelFor(matches.size(), 16, options_.threads, [&](std::size_t begin, std::size_t end) {
            for (std::size_t m = begin; m < end && !Progress::isCancelled(options_.progress); ++m)
                measurer.measureFaces(matches[m], rows[m]);
            counter.add(end - begin);
        });
        if (Progress::isCancelled(options_.progress)) return Error(Code::Cancelled, "the comparison was stopped");
        return {};
    }

    void addProperties() {
        const std::size_t wasCount = was_.labels.labels.size(), isCount = is_.labels.labels.size();
        FeaturePairs pairs{std::vector(wasCount, volume::kNoLabel), std::vector(isCount, volume::kNoLabel)};
        const std::vector<char> hasGeometryOfWas = labelsWithoutGroups(was_, wasShapes_),
                                hasGeometryOfIs = labelsWithoutGroups(is_, isShapes_);
        for (const ComparisonRow& row : comparison_.rows)
            if (row.was.size() == 1 && row.is.size() == 1) {
                pairs.isOfWas[row.was[0]] = row.is[0];
                pairs.wasOfIs[row.is[0]] = row.was[0];
            }
        comparison_.ambiguousGroups = matchGroups(was_, is_, options_.match, hasGeometryOfWas, hasGeometryOfIs, pairs);
        for (std::uint32_t l = 0; l < isCount; ++l)
            if (hasGeometryOfIs[l] == 0) addGroup(pairs.wasOfIs[l], l);
        for (std::uint32_t l = 0; l < wasCount; ++l)
            if (hasGeometryOfWas[l] == 0 && pairs.isOfWas[l] == volume::kNoLabel) addGroup(l, volume::kNoLabel);
        const auto wasStoreys = drawing::storeysOfLabels(was_.labels), isStoreys = drawing::storeysOfLabels(is_.labels);
        if (options_.properties == Properties::None) return;
        FeatureIds wasIds(was_.labels), isIds(is_.labels);
        for (ComparisonRow& row : comparison_.rows) {
            compareProperties(was_, is_, pairs, wasStoreys, isStoreys, wasIds, isIds, row);
            if (options_.properties == Properties::Names) row.attributes.clear();
        }
    }

    void addGroup(std::uint32_t was, std::uint32_t is) {
        ComparisonRow row;
        if (was != volume::kNoLabel) row.was.push_back(was);
        if (is != volume::kNoLabel) row.is.push_back(is);
        row.change = row.was.empty() ? Change::Added : row.is.empty() ? Change::Removed : Change::Same;
        comparison_.rows.push_back(std::move(row));
    }

    const volume::SemanticVolume &was_, &is_;
    CompareOptions options_;
    std::vector<Shape> wasShapes_, isShapes_;
    Comparison comparison_;
};

}  // namespace

bool Comparison::isDifferent() const noexcept {
    return std::any_of(rows.begin(), rows.end(), [](const ComparisonRow& row) { return row.isDifferent(); });
}

void Comparison::count(const ComparisonRow& row) noexcept {
    ++(row.hasGeometry ? counts : groups)[std::size_t(row.change)];
    if (row.hasOtherProperties()) ++otherProperties;
    properties.classes += row.hasOtherClass ? 1 : 0;
    properties.names += row.hasOtherName ? 1 : 0;
    properties.storeys += row.hasOtherStorey ? 1 : 0;
    properties.attributes += row.attributes.empty() ? 0 : 1;
}

Result<Comparison> compareVolumes(const volume::SemanticVolume& was, const volume::SemanticVolume& is,
                                  const CompareOptions& options) {
    SVT_DO(checkInputs(was, is, options));
    return Comparer(was, is, options).run();
}

}  // namespace svt::compare
