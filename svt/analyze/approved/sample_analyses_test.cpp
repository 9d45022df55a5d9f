/// Analyses of the generated models against approved ones in tests/golden/analyze.

#include <svt/analyze/contacts.hpp>
#include <svt/analyze/exclusive_volumes.hpp>
#include <svt/analyze/gaps.hpp>
#include <svt/analyze/known_volumes.hpp>
#include <svt/analyze/land_administration.hpp>
#include <svt/analyze/legal_units.hpp>
#include <svt/analyze/merged_boxes.hpp>
#include <svt/analyze/outside_faces.hpp>
#include <svt/analyze/owners.hpp>
#include <svt/analyze/parcel_parts.hpp>
#include <svt/analyze/plan_faces.hpp>
#include <svt/analyze/shared_voxels.hpp>
#include <svt/analyze/solid_overlaps.hpp>
#include <svt/analyze/space_boundaries.hpp>
#include <svt/pipeline/sample_models_test.hpp>
#include <svt/samples/approved_test.hpp>
#include <svt/volume/sample_volume_test.hpp>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace svt::analyze {
namespace {

using samples::SampleFormat, samples::SampleKind;
using volume::SemanticVolume;

std::string number(double value) {
    const std::string text = fmt::format("{:.4f}", value);
    return text == "-0.0000" ? "0.0000" : text;
}
std::string number(const std::optional<double>& value) { return value ? number(*value) : "-"; }
/// Bounds and sizes of rounding are small.
std::string precise(double value) { return fmt::format("{:.6g}", value); }
std::string precise(const std::optional<double>& value) { return value ? precise(*value) : "-"; }
std::string point(Vec3d p) { return number(p.x) + ',' + number(p.y) + ',' + number(p.z); }

/// Lines as they are if they are few, otherwise as their number and digest.
class Lines {
public:
    Lines(std::string title, const SemanticVolume& volume) : title_(std::move(title)), volume_(volume) {}
    template <class... Parts>
    void add(fmt::format_string<Parts...> form, Parts&&... parts) {
        text_ += "  " + fmt::format(form, std::forward<Parts>(parts)...) + '\n';
        ++count_;
    }
    [[nodiscard]] std::string id(std::uint32_t label) const {
        return label == volume::kNoLabel ? "-" : volume_.labels.labels[label].id;
    }
    [[nodiscard]] std::string ids(std::span<const std::uint32_t> labels) const {
        std::string text;
        for (const std::uint32_t label : labels) text += id(label) + ' ';
        return text;
    }
    [[nodiscard]] std::string text() const {
        const std::string head = fmt::format("{}: {} lines {:016x}\n", title_, count_, test::digestOf(text_));
        return count_ <= 25 ? head + text_ : head;
    }

private:
    std::string title_, text_;
    const SemanticVolume& volume_;
    std::size_t count_ = 0;
};

std::vector<std::uint32_t> allLabels(const SemanticVolume& volume) {
    std::vector<std::uint32_t> labels(volume.labels.labels.size());
    std::iota(labels.begin(), labels.end(), 0u);
    return labels;
}

std::vector<std::uint32_t> labelOfScalars(const SemanticVolume& volume) {
    std::vector<std::uint32_t> of(volume.labels.scalarCount(), volume::kNoLabel);
    for (std::uint32_t l = 0; l < volume.labels.labels.size(); ++l)
        for (volume::Scalar s = 0; s < volume.labels.labels[l].count; ++s) of[volume.labels.labels[l].first + s] = l;
    return of;
}

std::string measuresOf(const SemanticVolume& volume, const std::vector<Contact>& contacts) {
    Lines touching("contacts", volume), own("measures", volume), features("features", volume);
    for (const Contact& contact : contacts)
        touching.add("{} {} {} {} {} {}", touching.id(contact.a), touching.id(contact.b), number(contact.area),
                     contact.faces[0], contact.faces[1], contact.faces[2]);
    const auto measures = measureLabels(volume, contacts);
    const auto exclusive = exclusiveMeasures(volume);
    const auto volumes = ownVolumes(volume.labels, volume.grid);
    const Extents extents(volume.labels);
    const KnownVolumes known(volume.labels, volume.grid, extents);
    const PlanFaces faces(volume.labels, volume.vectors);
    const auto all = allLabels(volume);
    const auto whole = measureFeatures(extents, all, measures, contacts);
    const NeighborFinder neighbors(contacts, all.size());
    const auto finest = finestFeatures(extents, std::span(all).first(all.size() / 2), all.size());
    for (const std::uint32_t l : all) {
        const Measure& m = measures[l];
        const KnownVolume best = known.of(l);
        own.add("{} {} voxels {} {} area {} {} box {} {} exclusive {} {} own {} solid {} best {} {} {} in {}",
                own.id(l), m.voxels, number(m.volume), number(m.countedVolume), number(m.area), number(m.outsideArea),
                point(m.box.min), point(m.box.max), number(exclusive[l].volume), number(exclusive[l].countedVolume),
                number(volumes[l]), number(solidVolume(volume.labels, l)), number(best.volume), precise(best.bound),
                volumeSourceName(best.source), own.id(finest[l]));
        const auto extent = extents.of(l);
        std::string around;
        for (const Neighbor& neighbor : neighbors.of(extent))
            around += features.id(neighbor.label) + ' ' + number(neighbor.area) + ' ';
        std::string plan;
        for (const PlanOutline outline : {PlanOutline::Footprint, PlanOutline::Roof}) {
            const PlanParts parts = faces.of(extent, outline);
            plan += fmt::format(" {} {} {}{} {}", parts.faces.size(), features.ids(parts.labels),
                                int(parts.hasSurfaces), int(parts.hasSolids),
                                std::accumulate(parts.faces.begin(), parts.faces.end(), std::uint64_t{0}));
        }
        features.add("{} {} total {} {} {} {} parts {} extent {} around {} plan{}", features.id(l),
                     number(whole[l].own.volume), number(whole[l].total.volume), number(whole[l].total.area),
                     number(whole[l].total.outsideArea), whole[l].total.voxels, extents.standsForParts(l),
                     features.ids(extent), around, plan);
    }
    return touching.text() + own.text() + features.text();
}

std::string legalSpacesText(const SemanticVolume& volume) {
    Lines gaps("gaps", volume), sides("sides", volume), boxes("boxes", volume), layers("layers", volume),
        overlaps("overlaps", volume);
    for (const Gap& gap : findGaps(volume.columns, volume.labels))
        gaps.add("{} from {} to {} around {}", gap.voxels, point(toDouble(gap.box.min)), point(toDouble(gap.box.max)),
                 gaps.ids(gap.around));
    const auto of = labelOfScalars(volume);
    for (const SideArea& side : findSideAreas(volume.columns, volume.grid, of, volume.labels.labels.size()))
        sides.add("{} {}", number(side.whole), number(side.outside));
    const auto merged = mergeBoxes(volume.columns, of, 1000000);
    EXPECT_TRUE(merged);
    for (const GroupBox& box : *merged)
        boxes.add("{} {} {}", boxes.id(box.group), point(toDouble(box.box.begin)), point(toDouble(box.box.end)));
    EXPECT_TRUE(mergeBoxes(volume.columns, of, merged->size()));
    EXPECT_FALSE(mergeBoxes(volume.columns, of, merged->size() - 1));
    for (const SpaceBoundary& boundary : findSpaceBoundaries(volume.columns, volume.grid, volume.labels)) {
        std::string text;
        for (const BoundaryLayer& layer : boundary.layers)
            text += layers.id(layer.label) + ' ' + number(layer.thickness) + ' ';
        layers.add("{} {} {} {} {}", layers.id(boundary.a), layers.id(boundary.b), boundary.axis, number(boundary.area),
                   text);
    }
    const SolidOverlaps claimed = solidOverlaps(volume);
    for (const SolidOverlap& pair : claimed.pairs)
        overlaps.add("{} {} {} {} {} {} {}", overlaps.id(pair.a), overlaps.id(pair.b), pair.voxels, number(pair.volume),
                     precise(pair.bound), pair.isExact, pair.isNested);
    return gaps.text() + sides.text() + boxes.text() + layers.text() + overlaps.text() +
           fmt::format("without mesh {} complete {}\n", claimed.withoutMesh, claimed.isComplete);
}

std::string unitsText(const SemanticVolume& volume, const std::vector<Contact>& contacts) {
    Lines units("units", volume), spaces("spaces", volume), faces("faces", volume), relations("relations", volume),
        rights("rights", volume);
    const LegalUnits checked = checkLegalUnits(volume, contacts);
    for (const LegalUnit& unit : checked.units)
        units.add("{} common {} access {}", units.id(unit.label), unit.isCommon, int(unit.access));
    for (const UnitOverlap& overlap : checked.overlaps)
        units.add("{} {} {} {}", units.id(overlap.a), units.id(overlap.b), number(overlap.volume),
                  precise(overlap.bound));
    for (const StoreyGap& gap : checked.gaps)
        units.add("gap {} {} {} {}", units.id(gap.storey), gap.voxels, number(gap.volume),
                  point(toDouble(gap.box.min)));
    const auto administration = makeLandAdministration(volume, nullptr, "");
    EXPECT_TRUE(administration) << administration.error().toString();
    for (const LegalSpace& space : administration->spaces.spaces) {
        std::string outline;
        for (const PlanPolygon& polygon : space.outline)
            outline += fmt::format(" {} m2 {} corners {} holes", number(polygon.area), polygon.outer.size(),
                                   polygon.holes.size());
        spaces.add("{} {} {} solids {} volume {} {} box {} {}{}", spaces.id(space.label), space.isCommon,
                   spaceBodyName(space.body), space.solids.size(), number(space.bodyVolume), number(space.totalVolume),
                   point(space.box.min), point(space.box.max), outline);
    }
    for (const BoundaryFace& face : administration->spaces.faces) {
        std::string rings;
        for (const auto& ring : face.rings) {
            rings += " ring";
            for (const Vec3d corner : ring) rings += ' ' + point(corner);
        }
        faces.add("{} {} normal {} area {} {} {} {}{}", face.minus, face.plus, point(face.normal), number(face.area),
                  number(face.low), number(face.high), faceDirectionName(face.direction), rings);
    }
    for (const SpaceRelation& relation : administration->spaces.relations)
        relations.add("{} {} {} volume {} area {} from {} to {} bound {} exact {} {} faces between {} open {}",
                      relationName(relation.kind), relation.a, relation.b, number(relation.volume),
                      number(relation.area), number(relation.narrowest), number(relation.widest),
                      precise(relation.bound), relation.isExact, relation.faces.size(), relations.ids(relation.between),
                      relation.isOpen);
    for (const PartyRight& right : administration->rights)
        rights.add("{} {} {} {}", administration->parties[right.party], right.unit, right.rightType().name,
                   shareText(right));
    return units.text() + spaces.text() + faces.text() + relations.text() + rights.text();
}

std::string ownersText(const SemanticVolume& volume, const std::vector<Contact>& contacts, std::string_view table) {
    const auto owners = parseOwners(table, "owners.csv", volume.labels);
    EXPECT_TRUE(owners) << owners.error().toString();
    const Ownership all = divideByOwners(volume, contacts, *owners);
    Lines totals("owners", volume), components("components", volume), common("common", volume);
    const auto with = [&](const std::vector<OwnerShare>& shares) {
        std::string text;
        for (const OwnerShare& share : shares)
            text += fmt::format(" {} {} {}", share.owner == kNoOwner ? -1 : int(share.owner), number(share.area),
                                number(share.volume));
        return text;
    };
    for (std::size_t o = 0; o < all.owners.size(); ++o)
        totals.add("{} own {} undivided {} shared {} with{}", owners->names[o], number(all.owners[o].own),
                   number(all.owners[o].alone), number(all.owners[o].shared), with(all.owners[o].with));
    for (const DividedComponent& component : all.components)
        components.add("{}{}", components.id(component.label), with(component.shares));
    for (const CommonProperty& property : all.common)
        common.add("{} {} {} {}", common.id(property.building), common.id(property.storey), number(property.spaces),
                   number(property.components));
    Lines features("owned features", volume);
    for (std::size_t f = 0; f < owners->features.size(); ++f)
        features.add("{} {} {}", features.id(owners->features[f].label), number(all.ofFeature[f]),
                     features.ids(owners->features[f].parts));
    return totals.text() + components.text() + common.text() + features.text() +
           fmt::format("unowned {} untouched {} spaces {} shared {} all {}\n", number(all.unowned),
                       number(all.untouched), number(all.unownedSpaces), number(all.shared), number(all.all));
}

/// Two parcels west and east of a slanted border of the grid.
std::string parcelsText(const SemanticVolume& volume) {
    SemanticVolume parcels;
    parcels.grid = volume.grid;
    volume::test::addObject(parcels, "west", "Parcel");
    volume::test::addObject(parcels, "east", "Parcel");
    volume::test::paint(parcels, [&](int i, int j, int) {
        return j < 6 ? 0 : 3 * i + j < 2 * parcels.grid.dimension().x ? 1 : 2;
    });
    Lines shared("shared", volume), parts("parcels", volume);
    const auto pairs = sharedVoxels(volume, parcels, 1);
    EXPECT_TRUE(pairs);
    for (const SharedVoxels& pair : *pairs) shared.add("{} {} {}", shared.id(pair.a), int(pair.b), pair.voxels);
    const auto found = partsInParcels(volume, allLabels(volume), parcels, 1);
    EXPECT_TRUE(found);
    for (const ParcelPart& part : *found)
        parts.add("{} {} {} {} {} {} {}", parts.id(part.label), int(part.parcel), part.voxels, number(part.volume),
                  number(part.part), precise(part.bound), volumeSourceName(part.source));
    return shared.text() + parts.text();
}

TEST(ApprovedAnalyses, OfAHouseOfSolids) {
    const SemanticVolume house = test::volumeOfSample(SampleKind::House, SampleFormat::Ifc4, 0.2);
    const auto contacts = findContacts(house.columns, house.grid, house.labels, 1);
    test::expectApproved("analyze/house_of_solids",
                         measuresOf(house, contacts) + legalSpacesText(house) + parcelsText(house) +
                             ownersText(house, contacts, "class=BuildingRoom,Ann\nclass=Window,Bob,1/4\n"));
}

TEST(ApprovedAnalyses, OfAHouseOfSurfaces) {
    samples::SampleOptions options;
    options.thematic = true;
    options.turnDegrees = 30;
    const SemanticVolume house = test::volumeOfSample(SampleKind::House, SampleFormat::CityGml2, 0.25, options);
    const auto contacts = findContacts(house.columns, house.grid, house.labels, 1);
    test::expectApproved("analyze/house_of_surfaces",
                         measuresOf(house, contacts) + legalSpacesText(house) + parcelsText(house));
}

TEST(ApprovedAnalyses, OfATower) {
    for (const bool hasMeshes : {true, false}) {
        samples::SampleOptions options;
        options.storeys = 2;
        options.turnDegrees = 15;
        const SemanticVolume tower =
            test::volumeOfSample(SampleKind::Tower, SampleFormat::CityGml3, 0.3, options, hasMeshes);
        const auto contacts = findContacts(tower.columns, tower.grid, tower.labels, 1);
        std::string table = "feature,owner,share\n";
        int owner = 0;
        for (const volume::Label& label : tower.labels.labels)
            if (label.className == "BuildingUnit" && !isCommonUnit(label))
                table += fmt::format("{0},Owner {1},1/3\n{0},Owner {2},0.5\n", label.id, owner % 3, (owner + 1) % 3),
                    ++owner;
        test::expectApproved(std::string("analyze/tower") + (hasMeshes ? "" : "_of_voxels"),
                             measuresOf(tower, contacts) + legalSpacesText(tower) + unitsText(tower, contacts) +
                                 parcelsText(tower) + ownersText(tower, contacts, table));
    }
}

}  // namespace
}  // namespace svt::analyze
