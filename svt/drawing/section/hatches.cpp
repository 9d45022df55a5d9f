#include <svt/drawing/hatches.hpp>

#include <svt/core/check.hpp>

namespace svt::drawing {
namespace {

using render::Hatch;

struct Rule {
    const char* select;
    Hatch hatch;
};

// The last matching rule wins.
constexpr Rule kRules[] = {
    {"all", Hatch::General},
    {"class=Building or class=BuildingPart or class=CityObjectGroup", Hatch::None},
    {"class=BuildingRoom or class=BuildingUnit or class=Storey or class=HollowSpace or class=ClosureSurface",
     Hatch::None},
    {"class=WallSurface or class=InteriorWallSurface or ifcType~Wall", Hatch::Masonry},
    {"class=GroundSurface or class=FloorSurface or class=CeilingSurface or ifcType~'Slab|Footing|Stair'",
     Hatch::ReinforcedConcrete},
    {"name~'[Ss]lab|[Dd]ecke|[Bb]odenplatte'", Hatch::ReinforcedConcrete},
    {"ifcType~Beam or ifcType~Column or name~'[Bb]eam|Unterzug'", Hatch::ReinforcedConcrete},
    {"class=RoofSurface or ifcType~'Member|Roof' or name~'[Rr]after|Sparren|Pfette|[Pp]urlin'", Hatch::Timber},
    {"class=Door or class=DoorSurface or class=BuildingFurniture or ifcType~Door", Hatch::Timber},
    {"class=Window or class=WindowSurface or ifcType~Window", Hatch::Glass},
    {"class=TINRelief or class=ReliefFeature or class=LandUse", Hatch::Earth},
    {"class=SolitaryVegetationObject or class=PlantCover or class~Water", Hatch::None},
    // Coverings come before load-bearing materials: the last match decides the hatch of a wall with both.
    {"material~'[Ii]nsulation|D(ä|ae)mm|[Mm]ineral [Ww]ool'", Hatch::Insulation},
    {"material~'[Ss]creed|Estrich|[Pp]laster|[Mm]ortar'", Hatch::Concrete},
    {"material~'[Bb]rick|[Mm]asonry|[Bb]lock|Ziegel|Mauerwerk|Kalksandstein|Porenbeton|[Ss]tone'", Hatch::Masonry},
    {"material~'[Cc]oncrete|[Bb]eton'", Hatch::ReinforcedConcrete},
    {"material~'([Pp]lain|[Uu]nreinforced) [Cc]oncrete'", Hatch::Concrete},
    {"material~'[Tt]imber|[Ww]ood|Holz'", Hatch::Timber},
    {"material~'[Ss]teel|[Mm]etal|Stahl|[Aa]lumini'", Hatch::Steel},
    {"material~'[Gg]lass|Glas'", Hatch::Glass},
    {"material~'[Ee]arth|[Ss]oil|Erde|[Gg]ravel|Kies'", Hatch::Earth},
};

}  // namespace

std::vector<Hatch> labelHatches(const analyze::LabelRows& labels) {
    const std::span<const model::QueryRow> rows = labels.get();
    std::vector<Hatch> hatches(rows.size(), Hatch::None);
    for (const Rule& rule : kRules) {
        const auto query = model::Query::parse(rule.select);
        SVT_CHECK(query.hasValue());
        for (const std::uint32_t label : query->select(rows)) hatches[label] = rule.hatch;
    }
    return hatches;
}

}  // namespace svt::drawing
