#pragma once
/// \file
/// The writers of the formats. Each writes one building at a time and keeps nothing of it.

#include <svt/samples/designs/source.hpp>
#include <svt/samples/formats/sample_text.hpp>

#include <string>
#include <string_view>

namespace svt::samples {

void writeCityGml3(SampleSource& source, TextSink& out);
void writeCityGml2(SampleSource& source, bool isThematic, TextSink& out);
void writeCityJson(SampleSource& source, TextSink& out);
void writeCityJsonSeq(SampleSource& source, TextSink& out);
void writeIfc(SampleSource& source, TextSink& out);  ///< ifc/ifc_writer.cpp

/// GML elements common to both versions. Ids and names of samples need no escaping.
class GmlText {
public:
    explicit GmlText(TextSink& out) : out_(out) {}

    /// Coordinates of `point`, separated by blanks.
    void position(const WorldPoint& point, int decimals);
    /// A gml:Polygon; without id if `id` is empty.
    void polygon(const PlacedPlan& placed, const Face& face, std::string_view id);
    /// A gml:Polygon of a shape in its local coordinates.
    void localPolygon(const Instance& instance, const Face& face);
    /// gml:boundedBy of the whole model.
    void envelope(SampleSource& source);
    /// The 16 numbers of a transformation matrix: quarter turns, then the turn of the placement.
    void matrix(const PlacedPlan& placed, const Instance& instance);
    /// The ground as land use; nothing if the source has none.
    /// \param module  prefix of the module whose property holds the surface
    void ground(SampleSource& source, std::string_view module);
    /// The colours of a building, each with its polygons; nothing without colours.
    /// \param property  the property that holds the appearance
    /// \param member    the property that holds a material
    void appearance(const Document& document, bool isThematic, std::string_view property, std::string_view member);

private:
    /// app:X3DMaterial of a material, without its targets and closing tag.
    void material(Material material, std::string_view id);
    template <class Coordinates>
    void rings(const Face& face, const Coordinates& write);

    TextSink& out_;
};

/// Polygon id of a component: its id, "_p", and the number counted over all its shells.
[[nodiscard]] std::string polygonId(const std::string& componentId, std::size_t number);

/// Colored materials of a building with the polygons that have them.
struct MaterialTargets {
    Material material = Material::Brick;
    std::vector<std::string> polygons;
};
/// \param isThematic  only outer faces: those of the elements that are part of the hull
[[nodiscard]] std::vector<MaterialTargets> materialTargets(const Document& document, bool isThematic);

/// A number with up to six decimals and no trailing zeros.
[[nodiscard]] std::string decimalText(double value);

}  // namespace svt::samples
