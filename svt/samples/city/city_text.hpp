#pragma once
/// \file
/// The text of a generated city's file: CityGML or CityJSONSeq, building by building.

#include <svt/samples/city/city_building.hpp>
#include <svt/samples/formats/gml_text.hpp>

#include <string>

namespace svt::samples::city {

class CityText {
public:
    /// Writes the text before the first building.
    CityText(const CitySampleOptions& options, int file, const SampleSink& sink);
    void write(const Building& building);
    void finish();
    [[nodiscard]] bool hasFailed() const { return sink_.hasFailed(); }

private:
    void gmlHead();
    void gmlBuilding(const Building& building);
    void gmlBody(const Body& body, const std::string& id, const Building& building);
    void gmlSurface(const Face& face, const std::string& id, int lod);
    void gmlRoom(const Body& room, const std::string& id);
    void gmlMember(const Face& face, const std::string& id);
    void gmlLinkedSolid(const std::string& property, const Body& body, const std::string& id);
    void jsonHead();
    void jsonBuilding(const Building& building);
    void coordinates(const Point& point);

    const CitySampleOptions& options_;
    TextSink sink_;
    GmlText gml_;
};

/// The point of the map, in the units of the profile's numbers: millimetres; thousandths of a US survey foot; 1e-9
/// degrees (longitude, latitude) and millimetres.
[[nodiscard]] Point mapPoint(CityProfile profile, Point point);

}  // namespace svt::samples::city
