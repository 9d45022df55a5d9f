#include <svt/samples/designs/source.hpp>

#include <svt/samples/parts/random.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace svt::samples {
namespace {

constexpr Length kLotWidth = 22000, kLotDepth = 20000;
constexpr Length kGroundLevel = -200, kHighestPoint = 16000;

Result<void> checkRange(std::string_view name, int value, int lowest, int highest) {
    if (value >= lowest && value <= highest) return {};
    return Error(Code::BadArgument, fmt::format("{} is {}, allowed is {} to {}", name, value, lowest, highest));
}

Result<void> checkOptions(const SampleOptions& options) {
    for (const Result<void>& check :
         {checkRange("storeys", options.storeys, 1, 200), checkRange("flatsPerStorey", options.flatsPerStorey, 2, 8),
          checkRange("columns", options.columns, 1, 1000), checkRange("rows", options.rows, 1, 1000)})
        if (!check) return check.error();
    if (!(options.turnDegrees >= -360 && options.turnDegrees <= 360))
        return Error(Code::BadArgument,
                     fmt::format("turnDegrees is {}, allowed is -360 to 360 degrees", options.turnDegrees));
    for (const int axis : {0, 1, 2})
        if (!(std::abs(options.origin[axis]) <= 1e7))
            return Error(Code::BadArgument, fmt::format("origin.{} is {}, allowed is -10000000 to 10000000 m",
                                                        "xyz"[axis], options.origin[axis]));
    return {};
}

Length toMillimetres(double metres) { return Length(std::llround(metres * 1000)); }

constexpr std::array<std::string_view, 12> kOwners{"A. Becker",   "B. Yilmaz", "C. Novak",  "D. Schneider",
                                                   "E. Rossi",    "F. Weber",  "G. Nguyen", "H. Hoffmann",
                                                   "I. Kowalski", "J. Braun",  "K. Okafor", "L. Wagner"};

// Small rotations with rational sine and cosine, identical on every machine.
struct Ratio {
    double cosine, sine;
};
constexpr std::array<Ratio, 6> kSmallTurns{{{40.0 / 41, 9.0 / 41},
                                            {40.0 / 41, -9.0 / 41},
                                            {12.0 / 13, 5.0 / 13},
                                            {12.0 / 13, -5.0 / 13},
                                            {63.0 / 65, 16.0 / 65},
                                            {63.0 / 65, -16.0 / 65}}};

template <class List>
const auto& oneOf(const List& list, Random& random) {
    return list[std::size_t(random.below(std::int64_t(list.size())))];
}

// Every flat has a number and an owner.
std::vector<Attribute> unitAttributes(const Component& unit, int storey, int number, Random& random) {
    if (unit.function == "common") return {{"owner", std::string("all owners"), ""}};
    return {{"unitNumber", fmt::format("{}.{}", storey, number), ""},
            {"owner", std::string(oneOf(kOwners, random)), ""}};
}

// Floor area of a flat in dm2; 0 for common areas.
std::int64_t areaOf(const Component& unit) {
    if (unit.kind != Kind::Unit || unit.function == "common") return 0;
    for (const Attribute& a : unit.attributes)
        if (a.name == "floorArea") return std::llround(std::get<double>(a.value) * 100);
    return 0;
}

// The share of each flat is its area over the area of all flats.
void addShares(Document& tower) {
    std::int64_t total = 0;
    tower.forEach([&](const PlacedPlan&, int, const Component& component) { total += areaOf(component); });
    for (PlacedPlan& placed : tower.plans) {
        std::size_t unit = 0;
        for (const Component& component : placed.plan->components) {
            if (component.kind != Kind::Unit) continue;
            const std::int64_t area = areaOf(component);
            if (area > 0) placed.unitAttributes[unit].push_back({"share", fmt::format("{}/{}", area, total), ""});
            ++unit;
        }
    }
}

}  // namespace

Material Document::shown(Material designed) const {
    if (designed == Material::PlasterWhite) return wallMaterial;
    if (designed == Material::RoofTiles) return roofMaterial;
    return designed;
}

std::string Document::idOf(const PlacedPlan& placed, int component) const {
    return placed.prefix + placed.component(component).id;
}

std::string Document::markOf(const PlacedPlan& placed, int component) const {
    const Component& c = placed.component(component);
    return placed.prefix + (c.mark.empty() ? c.id : c.mark);
}

std::string Document::nameOf(const PlacedPlan& placed, int component) const {
    return placed.namePrefix + placed.component(component).name;
}

std::string Document::parentIdOf(const PlacedPlan& placed, int component) const {
    const Component& c = placed.component(component);
    if (c.parent >= 0) return idOf(placed, c.parent);
    if (c.kind == Kind::Unit && c.storey >= 0) return idOf(placed, c.storey);
    return id;
}

std::vector<Attribute> Document::attributesOf(const PlacedPlan& placed, int component) const {
    const std::vector<Component>& all = placed.plan->components;
    const Component& c = all[std::size_t(component)];
    std::vector<Attribute> attributes = c.attributes;
    const bool hasMaterial =
        std::any_of(attributes.begin(), attributes.end(), [](const Attribute& a) { return a.name == "material"; });
    if (!c.solids.empty() && !hasMaterial && c.kind != Kind::Room && c.kind != Kind::Unit) {
        const Material material = c.kind == Kind::Door ? Material::Timber : shown(c.solids.front().material);
        attributes.insert(attributes.begin(), {"material", std::string(info(material).name), ""});
    }
    if (c.kind == Kind::Unit) {
        const auto unit = std::count_if(all.begin(), all.begin() + component,
                                        [](const Component& other) { return other.kind == Kind::Unit; });
        if (std::size_t(unit) < placed.unitAttributes.size())
            for (const Attribute& a : placed.unitAttributes[std::size_t(unit)]) attributes.push_back(a);
    }
    return attributes;
}

Result<SampleSource> SampleSource::make(SampleKind kind, const SampleOptions& options) {
    if (const Result<void> check = checkOptions(options); !check) return check.error();
    if (options.change && kind != SampleKind::House)
        return Error(Code::BadArgument,
                     fmt::format("a {} cannot be changed; only the house has edits with known answers", nameOf(kind)));
    return SampleSource(kind, options);
}

SampleSource::SampleSource(SampleKind kind, const SampleOptions& options) : kind_(kind), options_(options) {
    origin_ = {toMillimetres(options.origin.x), toMillimetres(options.origin.y), toMillimetres(options.origin.z)};
    Point size{11000, 9000, 0};
    if (kind == SampleKind::Tower) size = towerSize(options.flatsPerStorey);
    if (kind == SampleKind::District) size = {options.columns * kLotWidth, options.rows * kLotDepth, 0};
    modelRotation_ = Rotation::byDegrees(options.turnDegrees, double(size.x) / 2, double(size.y) / 2);
}

std::int64_t SampleSource::buildingCount() const {
    return kind_ == SampleKind::District ? std::int64_t(options_.columns) * options_.rows : 1;
}

Document SampleSource::building(std::int64_t index) {
    if (kind_ == SampleKind::House) return house();
    return kind_ == SampleKind::Tower ? tower() : villageHouse(index);
}

std::string SampleSource::title() const {
    if (kind_ == SampleKind::House) return "Sample house";
    if (kind_ == SampleKind::Tower) return fmt::format("Sample tower, {} storeys", options_.storeys);
    return fmt::format("Sample district, {} x {} houses", options_.columns, options_.rows);
}

int SampleSource::decimals() const { return kind_ == SampleKind::District || !modelRotation_.isExact() ? 6 : 3; }

Document SampleSource::house() {
    const auto [it, isNew] = plans_.try_emplace("house");
    if (isNew) it->second = housePlan();
    if (isNew && options_.change) changes_ = changePlan(it->second, *options_.change);
    Document document;
    document.id = "house";
    document.name = "Sample house";
    document.function = "residential";
    document.roofType = "gable";
    document.storeys = 2;
    document.plans.push_back({&it->second, "house_", "", Placement({}, {}, modelRotation_, origin_), {}});
    return document;
}

Document SampleSource::tower() {
    Document document;
    document.id = "tower";
    document.name = "Sample tower";
    document.function = "residential";
    document.roofType = "flat";
    document.storeys = options_.storeys;
    const Placement base({}, {}, modelRotation_, origin_);
    Random random(options_.seed);
    for (int storey = 0; storey < options_.storeys; ++storey) {
        TowerStorey kind{options_.flatsPerStorey, storey == 0, storey + 1 == options_.storeys};
        const auto [it, isNew] = plans_.try_emplace(fmt::format("{}{}", kind.isLowest, kind.isHighest));
        if (isNew) it->second = towerPlan(kind);
        PlacedPlan placed{&it->second,
                          fmt::format("tower_S{:02}_", storey),
                          fmt::format("S{:02} ", storey),
                          base.lifted(storey * kTowerStoreyHeight),
                          {}};
        for (const Component& component : placed.plan->components)
            if (component.kind == Kind::Unit)
                placed.unitAttributes.push_back(
                    unitAttributes(component, storey, int(placed.unitAttributes.size()), random));
        document.plans.push_back(std::move(placed));
    }
    addShares(document);
    return document;
}

const Plan& SampleSource::villagePlan(const VillageHouse& variant) {
    const auto [it, isNew] = villagePlans_.try_emplace(variant);
    if (isNew) it->second = villageHousePlan(variant);
    return it->second;
}

Document SampleSource::villageHouse(std::int64_t index) {
    const std::int64_t column = index % options_.columns, row = index / options_.columns;
    Random random(options_.seed * 0xD1342543DE82EF95u + std::uint64_t(row) * 1000003u + std::uint64_t(column));
    random.next();
    const auto below = [&](int count) { return int(random.below(count)); };
    VillageHouse variant{below(4), below(2), below(3), 1 + below(2)};
    const Length width = 9000 + 1000 * variant.widthStep, depth = 8000 + 1000 * variant.depthStep;
    // A multiple of a quarter turn for every house; two of five are rotated further.
    Rotation rotation = Rotation::byDegrees(90.0 * below(4), double(width) / 2, double(depth) / 2);
    if (below(5) < 2) {
        const Ratio ratio = oneOf(kSmallTurns, random);
        const double cosine = rotation.cosine * ratio.cosine - rotation.sine * ratio.sine;
        rotation.sine = rotation.sine * ratio.cosine + rotation.cosine * ratio.sine;
        rotation.cosine = cosine;
    }
    const Point shift{column * kLotWidth + (kLotWidth - width) / 2 + 10 * (random.below(301) - 150),
                      row * kLotDepth + (kLotDepth - depth) / 2 + 10 * (random.below(201) - 100), 0};
    constexpr std::array kWalls{Material::PlasterWhite, Material::PlasterSand, Material::PlasterOchre,
                                Material::PlasterSage, Material::Brick};
    constexpr std::array kRoofs{Material::RoofTiles, Material::RoofBrown, Material::RoofSlate};
    Document document;
    document.id = fmt::format("B{:04}_{:04}", row, column);
    document.name = fmt::format("House {} in row {}", column + 1, row + 1);
    document.function = "residential";
    document.roofType = "gable";
    document.storeys = variant.storeys;
    document.wallMaterial = oneOf(kWalls, random);
    document.roofMaterial = oneOf(kRoofs, random);
    document.plans.push_back(
        {&villagePlan(variant), document.id + "_", "", Placement(rotation, shift, modelRotation_, origin_), {}});
    return document;
}

WorldPoint SampleSource::rescaled(const Placement& placement, Point p) const {
    return placement.at(p) * (placement.decimals() < decimals() ? 1000 : 1);
}

std::array<WorldPoint, 2> SampleSource::envelope() {
    Box3d box;  // its numbers are whole
    const auto add = [&](const Placement& placement, Point p) { box.add(toDouble(rescaled(placement, p))); };
    if (kind_ == SampleKind::District) {
        const Placement placement({}, {}, modelRotation_, origin_);
        for (const Length x : {Length{0}, options_.columns * kLotWidth})
            for (const Length y : {Length{0}, options_.rows * kLotDepth})
                for (const Length z : {Length{-250}, kHighestPoint}) add(placement, {x, y, z});
    } else {
        const Document document = building(0);
        for (const PlacedPlan& placed : document.plans)
            for (const Point& p : placed.plan->vertices) add(placed.placement, p);
    }
    const auto whole = [](Vec3d p) { return WorldPoint{std::int64_t(p.x), std::int64_t(p.y), std::int64_t(p.z)}; };
    return {whole(box.min), whole(box.max)};
}

std::vector<WorldPoint> SampleSource::ground() const {
    if (kind_ != SampleKind::District) return {};
    const Placement placement({}, {}, modelRotation_, origin_);
    const Length width = options_.columns * kLotWidth, depth = options_.rows * kLotDepth;
    std::vector<WorldPoint> corners;
    for (const Point p : {Point{0, 0, kGroundLevel}, Point{width, 0, kGroundLevel}, Point{width, depth, kGroundLevel},
                          Point{0, depth, kGroundLevel}})
        corners.push_back(rescaled(placement, p));
    return corners;
}

}  // namespace svt::samples
