#pragma once
/// \file
/// Small IFC files for tests: a project in millimetres with a building and a storey, and products with given items.

#include <svt/readers/ifc/ifc_reader.hpp>

#include <fmt/format.h>

#include <string>
#include <string_view>

namespace svt::readers::test {

/// A whole file around `records`. #1 project, #10 origin, #11 to #13 z, x and y axes, #14 axes, #15 placement in the world,
/// #16 point (0,0), #17 flat axes, #20 body context, #30 site, #31 building, #32 storey 'EG' that contains `contained`.
inline std::string ifcFile(std::string_view records, std::string_view contained = "", std::string_view schema = "IFC4",
                           std::string_view lengthUnit = "#3=IFCSIUNIT(*,.LENGTHUNIT.,.MILLI.,.METRE.);") {
    std::string text = fmt::format(R"(ISO-10303-21;
HEADER;
FILE_DESCRIPTION(('ViewDefinition [CoordinationView]'),'2;1');
FILE_NAME('test.ifc','2026-01-01T00:00:00',(''),(''),'','','');
FILE_SCHEMA(('{}'));
ENDSEC;
DATA;
#1=IFCPROJECT('0project',$,'Project',$,$,$,$,(#20),#2);
#2=IFCUNITASSIGNMENT((#3,#4,#5,#6));
{}
#4=IFCSIUNIT(*,.AREAUNIT.,$,.SQUARE_METRE.);
#5=IFCSIUNIT(*,.VOLUMEUNIT.,$,.CUBIC_METRE.);
#6=IFCSIUNIT(*,.PLANEANGLEUNIT.,$,.RADIAN.);
#10=IFCCARTESIANPOINT((0.,0.,0.));
#11=IFCDIRECTION((0.,0.,1.));
#12=IFCDIRECTION((1.,0.,0.));
#13=IFCDIRECTION((0.,1.,0.));
#14=IFCAXIS2PLACEMENT3D(#10,#11,#12);
#15=IFCLOCALPLACEMENT($,#14);
#16=IFCCARTESIANPOINT((0.,0.));
#17=IFCAXIS2PLACEMENT2D(#16,$);
#20=IFCGEOMETRICREPRESENTATIONCONTEXT($,'Model',3,1.E-05,#14,$);
#30=IFCSITE('0site',$,'Site',$,$,#15,$,$,.ELEMENT.,(49,5,59,0),(8,26,10,0),100.,$,$);
#31=IFCBUILDING('0building',$,'House',$,$,#15,$,$,.ELEMENT.,$,$,$);
#32=IFCBUILDINGSTOREY('0storey',$,'EG',$,$,#15,$,$,.ELEMENT.,0.);
#33=IFCRELAGGREGATES('0rel1',$,$,$,#1,(#30));
#34=IFCRELAGGREGATES('0rel2',$,$,$,#30,(#31));
#35=IFCRELAGGREGATES('0rel3',$,$,$,#31,(#32));
)",
                                   schema, lengthUnit);
    if (!contained.empty())
        text += fmt::format("#36=IFCRELCONTAINEDINSPATIALSTRUCTURE('0rel4',$,$,$,({}),#32);\n", contained);
    text += records;
    return text + "\nENDSEC;\nEND-ISO-10303-21;\n";
}

/// A file with one product, the wall #100 'wall', whose body is the item #200 among `records`.
inline std::string ifcWithItem(std::string_view records, std::string_view schema = "IFC4") {
    return ifcFile(fmt::format("#100=IFCWALL('wall',$,'Wall',$,$,#15,#101,$,$);\n"
                               "#101=IFCPRODUCTDEFINITIONSHAPE($,$,(#102));\n"
                               "#102=IFCSHAPEREPRESENTATION(#20,'Body','SweptSolid',(#200));\n{}",
                               records),
                   "#100", schema);
}

/// The same with the profile #300, extruded by a metre.
inline std::string ifcWithProfile(std::string_view records) {
    return ifcWithItem(fmt::format("#200=IFCEXTRUDEDAREASOLID(#300,#14,#11,1000.);\n{}", records));
}

inline Result<model::BuildingModel> readText(std::string_view text, Diagnostics* log = nullptr) {
    return readIfc(std::as_bytes(std::span(text.data(), text.size())), "test.ifc", {}, log);
}

}  // namespace svt::readers::test
