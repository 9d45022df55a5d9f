/// Figures that are called exact depend only on the geometry: whatever the spacing, the turn, the place, the format, the way in
/// which faces are split and the order of features, the house has the same volumes, floors, areas, sections and overlaps.
/// Gross areas, sections and volumes are those of its design, too.
///
/// What is allowed beside a millionth: the rounding of kept meshes (2^-20 m a coordinate) and the bound that a figure states.

#include <svt/analyze/contacts.hpp>
#include <svt/analyze/solid_overlaps.hpp>
#include <svt/drawing/floor_areas.hpp>
#include <svt/drawing/section_drawing.hpp>
#include <svt/drawing/storey_floors.hpp>
#include <svt/pipeline/build_volume.hpp>
#include <svt/pipeline/drawing/design_cut_test.hpp>
#include <svt/pipeline/drawing/shuffled_files_test.hpp>
#include <svt/pipeline/split_faces_test.hpp>
#include <svt/readers/read_model.hpp>
#include <svt/samples/sample.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace svt::pipeline {
namespace {

struct Figure {
    double value = 0, bound = 0;
    bool isOfDesign = true;  // of what all formats name alike; else of a boundary surface, or of a room's use
};
using Figures = std::map<std::string, Figure>;

// One way to give the house.
struct Variant {
    double spacing = 0.1;
    int quarters = 0;  // turns by 90 degrees, counter-clockwise, in the file
    Vec3d origin{500000, 5400000, 100};
    samples::SampleFormat format = samples::SampleFormat::CityGml3;
    bool splitsFaces = false;
    std::uint64_t seed = 0;  // of the order in the file; 0: as it is written
};

std::string shuffled(const std::string& text, const Variant& variant) {
    using samples::SampleFormat;
    if (variant.format == SampleFormat::CityJson2) return test::shuffledCityJson(text, variant.seed);
    if (variant.format == SampleFormat::Ifc4) return test::shuffledStep(text, variant.seed);
    EXPECT_EQ(variant.format, SampleFormat::CityGml3);
    return test::shuffledCityGml(text, variant.seed);
}

model::BuildingModel modelOf(const Variant& variant) {
    samples::SampleOptions options;
    options.turnDegrees = 90.0 * variant.quarters;
    options.origin = variant.origin;
    auto text = samples::writeSample(samples::SampleKind::House, variant.format, options);
    EXPECT_TRUE(text);
    if (!text) return {};
    if (variant.seed != 0) {
        const std::string inOrder = std::exchange(*text, shuffled(*text, variant));
        EXPECT_NE(*text, inOrder);
    }
    const bool isJson = variant.format == samples::SampleFormat::CityJson2;
    const bool isIfc = variant.format == samples::SampleFormat::Ifc4;
    auto model = readers::readModel(std::as_bytes(std::span(*text)), isJson  ? "house.city.json"
                                                                     : isIfc ? "house.ifc"
                                                                             : "house.gml");
    EXPECT_TRUE(model);
    if (!model) return {};
    if (variant.splitsFaces) {
        EXPECT_EQ(test::splitFaces(*model), 0u) << "faces with holes that stay whole";
    }
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

// The id that a component has in the other formats: IFC ids are GlobalIds, so it stands in the tag, or in the number of
// a room.
std::string idOfDesign(const volume::Label& label) {
    for (const std::string_view name : {"tag", "number"})
        for (const Attribute& attribute : label.attributes)
            if (attribute.name == name) return toText(attribute.value);
    return label.id;
}

const std::vector<samples::SampleComponent>& design() {
    static const auto described = samples::describeSample(samples::SampleKind::House, {});
    return *described;
}

bool isOfDesign(const std::string& id) {
    return std::any_of(design().begin(), design().end(),
                       [&](const samples::SampleComponent& component) { return component.id == id; });
}

// The planes of plans, and how high they are above the ground floor.
constexpr std::array<std::pair<const char*, double>, 3> kPlans{
    {{"storey=Ground floor+1.1", 1.1}, {"storey=Upper floor+1.1", 2.96 + 1.1}, {"storey=Attic+1.1", 5.56 + 1.1}}};

// What is known of a volume's model.
class FigureMaker {
public:
    FigureMaker(const volume::SemanticVolume& volume, const Variant& variant)
        : volume_(volume), labels_(volume.labels.labels), variant_(variant), rounding_(volume.vectors.unit) {
        std::set<std::string> ids;
        for (const volume::Label& label : labels_) {
            EXPECT_TRUE(ids.insert(idOfDesign(label)).second) << idOfDesign(label) << " is there twice";
            ids_.push_back(idOfDesign(label));
            areOfDesign_.push_back(isOfDesign(ids_.back()));
        }
    }

    Figures make() {
        addExtents();
        addFloors();
        for (const auto& [plane, height] : kPlans)
            if (const auto parsed = drawing::parseSectionPlane(plane, volume_)) {
                add(std::string("height of ") + plane, parsed->point.z - volume_.grid.origin().z - ground_, rounding_);
                addSection(plane, *parsed);
            } else {
                ADD_FAILURE() << parsed.error().message();
            }
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
            if (overlap.volume <= 2 * overlap.bound) continue;
            const auto [a, b] = std::minmax(ids_[overlap.a], ids_[overlap.b]);
            add("overlap of " + a + " and " + b, overlap.volume, overlap.bound,
                areOfDesign_[overlap.a] && areOfDesign_[overlap.b]);
        }
        return std::move(figures_);
    }

private:
    static constexpr double kOutline = 30;  // metres: no room has a longer one

    void add(const std::string& name, double value, double bound, bool isOfDesign = true) {
        EXPECT_TRUE(figures_.try_emplace(name, Figure{value, bound, isOfDesign}).second) << name << " is there twice";
    }

    void addExtents() {
        const auto extents = drawing::labelExtents(volume_);
        for (const drawing::LabelExtent& extent : extents) ground_ = std::min(ground_, extent.box.min.z);
        for (std::size_t l = 0; l < labels_.size(); ++l) {
            const std::string& id = ids_[l];
            const bool isOfDesign = areOfDesign_[l];
            if (extents[l].box.isEmpty()) continue;
            EXPECT_EQ(extents[l].bound, 0) << id;
            Vec3d size = extents[l].box.size();
            if (variant_.quarters % 2 == 1) std::swap(size.x, size.y);
            for (int axis = 0; axis < 3; ++axis)
                add("size " + std::string(1, "xyz"[axis]) + " of " + id, size[axis], rounding_, isOfDesign);
            add("floor of " + id, extents[l].floor - ground_, rounding_, isOfDesign);
            add("volume of " + id, labels_[l].volume, 0, isOfDesign);
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
                add("use of " + levels[n].name, area.use, rounding_ * kOutline * double(area.rooms), false);
        }
        for (const drawing::RoomArea& room : areas->rooms) {
            EXPECT_TRUE(room.isExact) << room.name;
            add("area of " + ids_[room.label], room.area, rounding_ * kOutline, areOfDesign_[room.label]);
        }
    }

    void addSection(const std::string& name, const drawing::SectionPlane& plane) {
        EXPECT_EQ(plane.bound, 0) << name;
        const auto drawing = drawing::drawSection(volume_, plane);
        ASSERT_TRUE(drawing) << name;
        double sum = 0, bound = 0;
        for (const drawing::SectionComponent& component : drawing->components) {
            const std::string& id = ids_[component.label];
            EXPECT_TRUE(component.isExact) << name << " " << id;
            add(name + " through " + id, component.area, component.areaBound, areOfDesign_[component.label]);
            sum += component.area;
            bound += component.areaBound;
        }
        add(name, sum, bound);
    }

    const volume::SemanticVolume& volume_;
    const std::vector<volume::Label>& labels_;
    const Variant& variant_;
    std::vector<std::string> ids_;   // by label
    std::vector<bool> areOfDesign_;  // by label
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

// Which figures two variants share.
enum class Shared { All, OfDesign };

// \param least  as many figures are compared, or more
void expectSame(const Figures& known, const Figures& found, const std::string& how, Shared shared, std::size_t least) {
    const auto isNeeded = [&](const Figure& figure) {
        return isThere(figure) && (shared == Shared::All || figure.isOfDesign);
    };
    std::size_t compared = 0;
    for (const auto& [name, figure] : known) {
        const auto at = found.find(name);
        if (at == found.end()) {
            if (isNeeded(figure)) ADD_FAILURE() << how << ": no " << name;
            continue;
        }
        ++compared;
        const double bound = 1e-6 * std::abs(figure.value) + figure.bound + at->second.bound;
        EXPECT_NEAR(at->second.value, figure.value, bound) << how << ": " << name;
    }
    EXPECT_GE(compared, least) << how;
    for (const auto& [name, figure] : found)
        if (isNeeded(figure) && !known.contains(name)) ADD_FAILURE() << how << ": " << name << " is new";
}

constexpr std::size_t kLeastOfAll = 2500, kLeastOfDesign = 1000;

// The house as it is known, and as it is here; in CityGML 3.0.
void expectSame(const Variant& variant, const std::string& how) {
    expectSame(expected(), figuresOf(variant), how, Shared::All, kLeastOfAll);
}

// The same in another format, where surfaces have other ids, or there are none.
void expectSameDesign(const Variant& variant, const std::string& how) {
    expectSame(expected(), figuresOf(variant), how, Shared::OfDesign, kLeastOfDesign);
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
    expectSameDesign({.format = samples::SampleFormat::CityGml2}, "CityGML 2.0");
    expectSameDesign({.format = samples::SampleFormat::CityJson2}, "CityJSON");
    expectSameDesign({.format = samples::SampleFormat::Ifc4}, "IFC");
}

TEST(ExactFigures, DoNotDependOnSplittingOfFaces) { expectSame({.splitsFaces = true}, "split"); }

TEST(ExactFigures, DoNotDependOnOrderOfFeatures) {
    expectSame({.seed = 1}, "CityGML, shuffled");
    for (const auto format : {samples::SampleFormat::CityJson2, samples::SampleFormat::Ifc4})
        expectSame(figuresOf({.format = format}), figuresOf({.format = format, .seed = 2}),
                   "shuffled, format " + std::to_string(int(format)), Shared::All, kLeastOfDesign);
}

TEST(ExactFigures, DoNotDependOnAllOfThemTogether) {
    const Vec3d elsewhere{458877.313, 5438353.719, -7.241};
    expectSame({.spacing = 0.0731, .quarters = 3, .origin = elsewhere, .splitsFaces = true, .seed = 3},
               "CityGML, all together");
    expectSameDesign({.spacing = 0.15,
                      .quarters = 1,
                      .origin = elsewhere,
                      .format = samples::SampleFormat::Ifc4,
                      .splitsFaces = true,
                      .seed = 4},
                     "IFC, all together");
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
    for (const samples::SampleComponent& component : design()) {
        if (component.solids.empty()) continue;
        // With its phases, whose ids are those of the component with a suffix.
        const std::string name = "volume of " + component.id;
        ASSERT_TRUE(figures.contains(name)) << component.id;
        double volume = 0;
        for (const auto& [key, figure] : figures)
            if (key == name || key.starts_with(name + "_phase")) volume += figure.value;
        EXPECT_NEAR(volume, component.volume, 1e-6 * component.volume) << component.id;
    }
    EXPECT_NEAR(figures.at("level Attic").value - figures.at("level Ground floor").value, 5.56, 2e-6);
}

TEST(ExactFigures, GrossAreasAndPlansAreThoseOfTheDesign) {
    const double ground = 100;  // metres in the CRS, as in the options of samples
    const auto expectOfDesign = [&](const std::string& name, double height, double closed = 0) {
        const Figure& figure = expected().at(name);
        const double area = test::designCut(design(), ground + height, closed > 0 ? ground + closed : 0);
        EXPECT_NEAR(figure.value, area, 1e-6 * area + figure.bound) << name;
        EXPECT_LT(figure.bound, 0.01) << name;
    };
    // 10 cm below the ceilings of most rooms, walls have no openings.
    expectOfDesign("gross of Ground floor", 0.15, 2.66);
    expectOfDesign("gross of Upper floor", 2.96 + 0.15, 5.26);
    EXPECT_GT(expected().at("gross of Ground floor").value, test::designCut(design(), ground + 0.15) + 0.2)
        << "the doors of the house";
    expectOfDesign("gross of Attic", 5.56 + 0.15);
    for (const auto& [plane, height] : kPlans) {
        expectOfDesign(plane, height);
        // The lowest point is that of the ground slab.
        EXPECT_NEAR(expected().at(std::string("height of ") + plane).value, height + 0.25, 2e-6) << plane;
    }
}

// By hand, from the section of the house in svt/samples/designs/house.cpp. The underside of the roof is at 4.16 m over the
// outer faces of the walls and rises by 4/5, so 5.71 m above the ground floor it is (5.71 - 4.16) * 5/4 m further in.
TEST(ExactFigures, TheGrossAreaOfTheAtticIsThatOfItsSection) {
    const double in = (5.56 + 0.15 - 4.16) * 5 / 4;
    const double loftAndGables = 11 * (9 - 2 * in);
    const double roof = 2 * (11 + 2 * 0.4) * 0.25 * 5 / 4;     // two slabs, 0.25 m high, 0.4 m beyond the gables
    const double raftersOutside = 2 * 2 * 0.08 * 0.2 * 5 / 4;  // two at each gable, 0.08 m wide and 0.2 m high
    const double flue = 0.2 * 0.2;                             // the air in the chimney
    const double gross = loftAndGables + roof + raftersOutside - flue;
    EXPECT_NEAR(gross, 63.79, 1e-9);
    const Figure& figure = expected().at("gross of Attic");
    EXPECT_NEAR(figure.value, gross, 1e-6 * gross + figure.bound);
}

}  // namespace
}  // namespace svt::pipeline
