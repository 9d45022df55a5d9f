/// Figures that are called exact depend only on the geometry: whatever the spacing, the turn, the place, the format, the way in
/// which faces are split and the order of features, the house has the same volumes, floors, areas, sections and overlaps.
///
/// What is allowed beside a millionth: the rounding of kept meshes (2^-20 m a coordinate) and the bound that a figure states.

#include <svt/analyze/contacts.hpp>
#include <svt/analyze/solid_overlaps.hpp>
#include <svt/drawing/floor_areas.hpp>
#include <svt/drawing/section_drawing.hpp>
#include <svt/drawing/storey_floors.hpp>
#include <svt/pipeline/build_volume.hpp>
#include <svt/pipeline/split_faces_test.hpp>
#include <svt/readers/read_model.hpp>
#include <svt/samples/sample.hpp>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace svt::pipeline {
namespace {

struct Figure {
    double value = 0, bound = 0;
};
using Figures = std::map<std::string, Figure>;

// One way to give the house.
struct Variant {
    double spacing = 0.1;
    int quarters = 0;  // turns by 90 degrees, counter-clockwise, in the file
    Vec3d origin{500000, 5400000, 100};
    samples::SampleFormat format = samples::SampleFormat::CityGml3;
    bool splitsFaces = false, shuffles = false;
};

// The objects of a CityJSON document from the last to the first.
std::string reversed(const std::string& cityJson) {
    auto document = nlohmann::ordered_json::parse(cityJson);
    std::vector<std::pair<std::string, nlohmann::ordered_json>> objects;
    for (auto& [id, object] : document["CityObjects"].items()) objects.emplace_back(id, object);
    std::reverse(objects.begin(), objects.end());
    nlohmann::ordered_json turned = nlohmann::ordered_json::object();
    for (auto& [id, object] : objects) turned[id] = std::move(object);
    document["CityObjects"] = std::move(turned);
    return document.dump();
}

model::BuildingModel modelOf(const Variant& variant) {
    samples::SampleOptions options;
    options.turnDegrees = 90.0 * variant.quarters;
    options.origin = variant.origin;
    auto text = samples::writeSample(samples::SampleKind::House, variant.format, options);
    EXPECT_TRUE(text);
    if (!text) return {};
    if (variant.shuffles) *text = reversed(*text);
    const bool isJson = variant.format == samples::SampleFormat::CityJson2;
    const bool isIfc = variant.format == samples::SampleFormat::Ifc4;
    auto model = readers::readModel(std::as_bytes(std::span(*text)), isJson  ? "house.city.json"
                                                                     : isIfc ? "house.ifc"
                                                                             : "house.gml");
    EXPECT_TRUE(model);
    if (!model) return {};
    if (variant.splitsFaces) test::splitFaces(*model);
    return *model;
}

volume::SemanticVolume volumeOf(const Variant& variant) {
    model::BuildingModel model = modelOf(variant);
    BuildOptions options;
    options.spacing = Vec3d{variant.spacing, variant.spacing, variant.spacing};
    options.vectors.meshes = true;
    auto built = buildVolume(model, options);
    EXPECT_TRUE(built);
    return built ? std::move(built->volume) : volume::SemanticVolume{};
}

// What is known of a volume's model.
class FigureMaker {
public:
    FigureMaker(const volume::SemanticVolume& volume, const Variant& variant)
        : volume_(volume), labels_(volume.labels.labels), variant_(variant), rounding_(volume.vectors.unit) {}

    Figures make() {
        addExtents();
        addFloors();
        for (const char* plane : {"storey=Ground floor+1.1", "storey=Upper floor+1.1", "storey=Attic+1.1"})
            if (const auto parsed = drawing::parseSectionPlane(plane, volume_))
                addSection(plane, *parsed);
            else
                ADD_FAILURE() << parsed.error().message();
        const Vec3i n = volume_.grid.dimension();
        const Vec3d middle = volume_.grid.worldFromIndex((toDouble(n) - Vec3d{1, 1, 1}) * 0.5);
        for (const auto& [name, normal] : {std::pair("across x", Vec3d{1, 0, 0}), std::pair("across y", Vec3d{0, 1, 0}),
                                           std::pair("slanted", Vec3d{0.6, 0.64, 0.48})}) {
            Vec3d turned = normal;
            for (int q = 0; q < variant_.quarters; ++q) turned = {-turned.y, turned.x, turned.z};
            addSection(name, {turned, middle + turned * 0.3713});
        }
        for (const analyze::SolidOverlap& overlap : analyze::solidOverlaps(volume_).pairs) {
            if (!overlap.isExact) continue;
            const auto [a, b] = std::minmax(labels_[overlap.a].id, labels_[overlap.b].id);
            if (overlap.volume > 2 * overlap.bound) add("overlap of " + a + " and " + b, overlap.volume, overlap.bound);
        }
        return std::move(figures_);
    }

private:
    static constexpr double kOutline = 30;  // metres: no room has a longer one

    void add(const std::string& name, double value, double bound) { figures_[name] = {value, bound}; }

    void addExtents() {
        const auto extents = drawing::labelExtents(volume_);
        for (const drawing::LabelExtent& extent : extents) ground_ = std::min(ground_, extent.box.min.z);
        for (std::size_t l = 0; l < labels_.size(); ++l) {
            const std::string& id = labels_[l].id;
            if (extents[l].box.isEmpty()) continue;
            EXPECT_EQ(extents[l].bound, 0) << id;
            Vec3d size = extents[l].box.size();
            if (variant_.quarters % 2 == 1) std::swap(size.x, size.y);
            for (int axis = 0; axis < 3; ++axis)
                add("size " + std::string(1, "xyz"[axis]) + " of " + id, size[axis], rounding_);
            add("floor of " + id, extents[l].floor - ground_, rounding_);
            add("volume of " + id, labels_[l].volume, 0);
        }
    }

    void addFloors() {
        for (const drawing::StoreyHeights& storey : drawing::findStoreys(volume_)) {
            const std::string& name = labels_[storey.label].name;
            EXPECT_EQ(storey.bound, 0) << name;
            add("floor of " + name, storey.floor - ground_, rounding_);
            add("low of " + name, storey.low - ground_, rounding_);
            add("top of " + name, storey.top - ground_, rounding_);
        }
        const auto levels = drawing::findLevels(volume_);
        const auto areas = drawing::measureFloorAreas(volume_, levels);
        ASSERT_TRUE(areas);
        for (std::size_t n = 0; n < levels.size(); ++n) {
            const drawing::LevelArea& area = areas->levels[n];
            EXPECT_TRUE(area.isExact) << levels[n].name;
            add("level " + levels[n].name, levels[n].floor - ground_, rounding_);
            add("gross of " + levels[n].name, area.gross, area.grossBound);
            add("net of " + levels[n].name, area.net, rounding_ * kOutline * double(area.rooms));
            // A word tells the use: the IFC has other words for some rooms.
            if (variant_.format != samples::SampleFormat::Ifc4)
                add("use of " + levels[n].name, area.use, rounding_ * kOutline * double(area.rooms));
        }
        for (const drawing::RoomArea& room : areas->rooms) {
            EXPECT_TRUE(room.isExact) << room.name;
            add("area of " + labels_[room.label].id, room.area, rounding_ * kOutline);
        }
    }

    void addSection(const std::string& name, const drawing::SectionPlane& plane) {
        EXPECT_EQ(plane.bound, 0) << name;
        const auto drawing = drawing::drawSection(volume_, plane);
        ASSERT_TRUE(drawing) << name;
        double sum = 0, bound = 0;
        for (const drawing::SectionComponent& component : drawing->components) {
            EXPECT_TRUE(component.isExact) << name << " " << labels_[component.label].id;
            add(name + " through " + labels_[component.label].id, component.area, component.areaBound);
            sum += component.area;
            bound += component.areaBound;
        }
        add(name, sum, bound);
    }

    const volume::SemanticVolume& volume_;
    const std::vector<volume::Label>& labels_;
    const Variant& variant_;
    double rounding_;
    double ground_ = kInfinity;  // lowest point of the model, metres above the grid's lower corner
    Figures figures_;
};

Figures figuresOf(const Variant& variant) {
    const volume::SemanticVolume volume = volumeOf(variant);
    return FigureMaker(volume, variant).make();
}

const Figures& expected() {
    static const Figures figures = figuresOf({});
    return figures;
}

// Whether a figure is not zero beyond its bound: solids that touch may overlap by the rounding of their points.
bool isThere(const Figure& figure) { return figure.bound == 0 || figure.value > 4 * figure.bound; }

void expectSame(const Figures& known, const Figures& found, const std::string& how, bool isWhole = true) {
    EXPECT_GT(found.size(), 500u) << how;
    for (const auto& [name, figure] : known) {
        const auto at = found.find(name);
        if (at == found.end()) {
            if (isWhole && isThere(figure)) ADD_FAILURE() << how << ": no " << name;
            continue;
        }
        const double bound = 1e-6 * std::abs(figure.value) + figure.bound + at->second.bound;
        EXPECT_NEAR(at->second.value, figure.value, bound) << how << ": " << name;
    }
    for (const auto& [name, figure] : found)
        if (isWhole && isThere(figure) && !known.contains(name)) ADD_FAILURE() << how << ": " << name << " is new";
}

// \param isWhole  the variant has the same figures; else those that it has are the same
void expectSame(const Variant& variant, const std::string& how, bool isWhole = true) {
    expectSame(expected(), figuresOf(variant), how, isWhole);
}

TEST(ExactFigures, DoNotDependOnSpacing) {
    for (const double spacing : {0.03, 0.05, 0.0731, 0.15, 0.25})
        expectSame({.spacing = spacing}, "spacing " + std::to_string(spacing));
}

TEST(ExactFigures, DoNotDependOnTurn) {
    for (int quarters = 1; quarters < 4; ++quarters)
        expectSame({.quarters = quarters}, "turned " + std::to_string(quarters) + " times");
}

TEST(ExactFigures, DoNotDependOnPlace) {
    expectSame({.origin = {0, 0, 0}}, "at the origin");
    expectSame({.origin = {458877.313, 5438353.719, -7.241}}, "elsewhere");
}

TEST(ExactFigures, DoNotDependOnFormat) {
    expectSame({.format = samples::SampleFormat::CityGml2}, "CityGML 2.0", false);
    expectSame({.format = samples::SampleFormat::CityJson2}, "CityJSON", false);  // its surfaces have other ids
    expectSame({.format = samples::SampleFormat::Ifc4}, "IFC", false);
}

TEST(ExactFigures, DoNotDependOnSplittingOfFaces) { expectSame({.splitsFaces = true}, "split"); }

TEST(ExactFigures, DoNotDependOnOrderOfFeatures) {
    constexpr auto kFormat = samples::SampleFormat::CityJson2;
    expectSame(figuresOf({.format = kFormat}), figuresOf({.format = kFormat, .shuffles = true}), "reversed");
}

struct Touch {
    double area = 0;
    double length = 0;  // metres around the place where the two may touch
};

// Contacts by the ids of both; those with air are left out.
std::map<std::pair<std::string, std::string>, Touch> contactsOf(const Variant& variant) {
    const volume::SemanticVolume volume = volumeOf(variant);
    const auto& labels = volume.labels.labels;
    const auto extents = drawing::labelExtents(volume);
    std::map<std::pair<std::string, std::string>, Touch> contacts;
    for (const analyze::Contact& contact : analyze::findContacts(volume.columns, volume.grid, volume.labels)) {
        if (contact.b == volume::kNoLabel) continue;
        double length = 0;
        for (int axis = 0; axis < 3; ++axis) {
            const Box3d &a = extents[contact.a].box, &b = extents[contact.b].box;
            length += std::max(0.0, std::min(a.max[axis], b.max[axis]) - std::max(a.min[axis], b.min[axis]));
        }
        contacts[std::minmax(labels[contact.a].id, labels[contact.b].id)] = {contact.area, 4 * length};
    }
    return contacts;
}

// Contacts are counted on voxels, so they are not exact. Of CityGML, the voxels of a surface without volume lie between two
// solids that touch at some spacings, so the house is taken without its surfaces: as IFC. Each edge of a contact may be off by a voxel in either volume, and
// faces that are not along the grid by 5 %. Two edges for each axis of the box in which two things may touch, twice.
TEST(ExactFigures, ContactsAreOfVoxelsAndStayWithinTheirBound) {
    constexpr auto kFormat = samples::SampleFormat::Ifc4;
    const Variant straight{.spacing = 0.05, .format = kFormat};
    const auto known = contactsOf(straight);
    for (const int quarters : {1, 2, 3}) {
        const Variant variant{.spacing = 0.05, .quarters = quarters, .format = kFormat};
        auto found = contactsOf(variant);
        for (const auto& [pair, touch] : known) {
            const double area = found[pair].area;
            const double bound =
                0.05 * std::max(area, touch.area) + (touch.length + 0.4) * (straight.spacing + variant.spacing);
            EXPECT_NEAR(area, touch.area, bound) << pair.first << " and " << pair.second << ", turned "
                                                 << variant.quarters << " times, spacing " << variant.spacing;
        }
    }
}

// The figures are those that the design has.
TEST(ExactFigures, AreThoseOfTheDesign) {
    const Figures& figures = expected();
    const auto described = samples::describeSample(samples::SampleKind::House, {});
    ASSERT_TRUE(described);
    for (const samples::SampleComponent& component : *described) {
        const auto found = figures.find("volume of " + component.id);
        if (found == figures.end()) continue;
        EXPECT_NEAR(found->second.value, component.volume, 1e-6 * component.volume) << component.id;
    }
    EXPECT_NEAR(figures.at("level Attic").value - figures.at("level Ground floor").value, 5.56, 2e-6);
}

}  // namespace
}  // namespace svt::pipeline
