// A reference that leads nowhere never changes a body, or where it stands, in silence.
#include <svt/readers/ifc/ifc_documents_test.hpp>
#include <svt/readers/ifc_shape/body.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

namespace svt::readers {
namespace {

using namespace test;

//            #140 roof (faces)
//      +--------------------+
//      | #100 wall, clipped |  #160 column on a placement below that of the storey, round, with a rail #180
//      |  [#110 opening     |
//      |   with #120 door]  |
//      +--------------------+
const std::string kHouse = ifcFile(R"(#21=IFCMAPCONVERSION(#20,#22,1000.,2000.,100.,1.,0.,1.);
#22=IFCPROJECTEDCRS('EPSG:25832',$,$,$,$,$,#3);
#100=IFCWALL('wall',$,'Wall',$,$,#15,#101,$,$);
#101=IFCPRODUCTDEFINITIONSHAPE($,$,(#102));
#102=IFCSHAPEREPRESENTATION(#20,'Body','Clipping',(#103));
#103=IFCBOOLEANCLIPPINGRESULT(.DIFFERENCE.,#105,#106);
#104=IFCRECTANGLEPROFILEDEF(.AREA.,$,#17,4000.,300.);
#105=IFCEXTRUDEDAREASOLID(#104,#14,#11,2500.);
#106=IFCPOLYGONALBOUNDEDHALFSPACE(#107,.F.,#14,#108);
#107=IFCPLANE(#109);
#108=IFCPOLYLINE((#16,#92,#93,#16));
#109=IFCAXIS2PLACEMENT3D(#91,#11,#12);
#91=IFCCARTESIANPOINT((0.,0.,2000.));
#92=IFCCARTESIANPOINT((500.,0.));
#93=IFCCARTESIANPOINT((500.,500.));
#110=IFCOPENINGELEMENT('opening',$,$,$,$,#111,#114,$,$);
#111=IFCLOCALPLACEMENT(#15,#112);
#112=IFCAXIS2PLACEMENT3D(#113,$,$);
#113=IFCCARTESIANPOINT((-1000.,0.,0.));
#114=IFCPRODUCTDEFINITIONSHAPE($,$,(#115));
#115=IFCSHAPEREPRESENTATION(#20,'Body','SweptSolid',(#116));
#116=IFCEXTRUDEDAREASOLID(#117,#14,#11,1200.);
#117=IFCRECTANGLEPROFILEDEF(.AREA.,$,#17,1000.,300.);
#118=IFCRELVOIDSELEMENT('v',$,$,$,#100,#110);
#119=IFCRELFILLSELEMENT('f',$,$,$,#110,#120);
#120=IFCDOOR('door',$,$,$,$,#111,#121,$,$,$,$,.SINGLE_SWING_LEFT.,$);
#121=IFCPRODUCTDEFINITIONSHAPE($,$,(#122));
#122=IFCSHAPEREPRESENTATION(#20,'Body','MappedRepresentation',(#123));
#123=IFCMAPPEDITEM(#124,#126);
#124=IFCREPRESENTATIONMAP(#14,#125);
#125=IFCSHAPEREPRESENTATION(#20,'Body','CSG',(#127));
#126=IFCCARTESIANTRANSFORMATIONOPERATOR3D(#13,#128,#113,1.,#11);
#127=IFCBLOCK(#112,900.,50.,1200.);
#128=IFCDIRECTION((-1.,0.,0.));
#140=IFCSLAB('roof',$,$,$,$,#15,#141,$,$);
#141=IFCPRODUCTDEFINITIONSHAPE($,$,(#142));
#142=IFCSHAPEREPRESENTATION(#20,'Body','Brep',(#143));
#143=IFCFACETEDBREP(#144);
#144=IFCCLOSEDSHELL((#145,#146,#147,#148));
#145=IFCFACE((#149));
#146=IFCFACE((#150));
#147=IFCFACE((#151));
#148=IFCFACE((#152));
#149=IFCFACEOUTERBOUND(#153,.T.);
#150=IFCFACEOUTERBOUND(#154,.T.);
#151=IFCFACEOUTERBOUND(#155,.T.);
#152=IFCFACEOUTERBOUND(#156,.T.);
#153=IFCPOLYLOOP((#130,#132,#131));
#154=IFCPOLYLOOP((#130,#131,#133));
#155=IFCPOLYLOOP((#131,#132,#133));
#156=IFCPOLYLOOP((#132,#130,#133));
#130=IFCCARTESIANPOINT((0.,0.,3000.));
#131=IFCCARTESIANPOINT((1000.,0.,3000.));
#132=IFCCARTESIANPOINT((0.,1000.,3000.));
#133=IFCCARTESIANPOINT((0.,0.,4000.));
#160=IFCCOLUMN('column',$,$,$,$,#161,#164,$,$);
#161=IFCLOCALPLACEMENT(#15,#162);
#162=IFCAXIS2PLACEMENT3D(#163,#11,#13);
#163=IFCCARTESIANPOINT((5000.,0.,0.));
#164=IFCPRODUCTDEFINITIONSHAPE($,$,(#165));
#165=IFCSHAPEREPRESENTATION(#20,'Body','SweptSolid',(#166));
#166=IFCEXTRUDEDAREASOLID(#167,#162,#11,2000.);
#167=IFCARBITRARYPROFILEDEFWITHVOIDS(.AREA.,$,#168,(#172));
#168=IFCCOMPOSITECURVE((#169,#170),.F.);
#169=IFCCOMPOSITECURVESEGMENT(.CONTINUOUS.,.T.,#171);
#170=IFCCOMPOSITECURVESEGMENT(.CONTINUOUS.,.T.,#173);
#171=IFCTRIMMEDCURVE(#174,(#176),(#177),.T.,.CARTESIAN.);
#172=IFCCIRCLE(#175,50.);
#173=IFCPOLYLINE((#177,#176));
#174=IFCCIRCLE(#17,200.);
#175=IFCAXIS2PLACEMENT2D(#178,#179);
#176=IFCCARTESIANPOINT((200.,0.));
#177=IFCCARTESIANPOINT((-200.,0.));
#178=IFCCARTESIANPOINT((0.,100.));
#179=IFCDIRECTION((1.,0.));
#180=IFCRAILING('rail',$,$,$,$,#161,#181,$,$);
#181=IFCPRODUCTDEFINITIONSHAPE($,$,(#182));
#182=IFCSHAPEREPRESENTATION(#20,'Body','AdvancedSweptSolid',(#183));
#183=IFCSWEPTDISKSOLID(#184,20.,$,$,$);
#184=IFCINDEXEDPOLYCURVE(#185,$,.F.);
#185=IFCCARTESIANPOINTLIST3D(((0.,0.,1000.),(0.,2000.,1000.)));
#190=IFCMATERIALLAYERSETUSAGE(#191,.AXIS2.,.POSITIVE.,-150.);
#191=IFCMATERIALLAYERSET((#192),$);
#192=IFCMATERIALLAYER(#193,300.,$);
#193=IFCMATERIAL('Brick');
#194=IFCRELASSOCIATESMATERIAL('m',$,$,$,(#100),#190);
#195=IFCPROPERTYSET('p',$,'Pset_WallCommon',$,(#196));
#196=IFCPROPERTYSINGLEVALUE('IsExternal',$,IFCBOOLEAN(.T.),$);
#197=IFCRELDEFINESBYPROPERTIES('d',$,$,$,(#100),#195);
#198=IFCZONE('z',$,'Zone',$,$);
#199=IFCRELASSIGNSTOGROUP('g',$,$,$,(#100),$,#198);
)",
                                   "#100,#120,#140,#160,#180");

// How much each feature encloses, and where.
struct Body {
    double volume = 0;
    Box3d box;
    bool operator==(const Body& other) const {
        return volume == other.volume && box.min == other.box.min && box.max == other.box.max;
    }
};

struct Read {
    bool isRead = false;
    std::map<std::string, Body> bodies;
    Diagnostics log;

    [[nodiscard]] const Diagnostic* find(Code code, std::string_view words) const {
        const auto found = std::ranges::find_if(log.items(), [&](const Diagnostic& item) {
            return item.code == code && item.message.find(words) != std::string::npos;
        });
        return found == log.items().end() ? nullptr : &*found;
    }
};

Read readBodies(const std::string& text, const ReadOptions& options = {}) {
    Read read;
    const auto model = readIfc(std::as_bytes(std::span(text)), "house.ifc", options, &read.log);
    read.isRead = bool(model);
    if (!model) return read;
    for (const model::Feature& feature : model->features) {
        std::vector<model::Polygon> faces;
        for (const model::Geometry& geometry : feature.geometries) {
            for (const model::Solid& solid : geometry.solids)
                for (const model::SurfaceUse use : solid.exterior) faces.push_back(model->polygons[use.polygon]);
            for (const model::SurfaceUse use : geometry.surfaces) faces.push_back(model->polygons[use.polygon]);
        }
        if (!faces.empty()) read.bodies[feature.id] = {ifc::enclosedVolume(faces), ifc::boundsOf(faces)};
    }
    return read;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

TEST(IfcDanglingReferences, NoneChangesABodyInSilence) {
    const Read whole = readBodies(kHouse);
    ASSERT_TRUE(whole.isRead);
    ASSERT_EQ(whole.bodies.size(), 5u);
    ASSERT_EQ(whole.log.count(Code::DanglingReference), 0u);
    std::size_t references = 0, told = 0, changed = 0;
    for (std::size_t at = kHouse.find("DATA;"); (at = kHouse.find('#', at + 1)) != std::string::npos;) {
        if (kHouse[at - 1] == '\n') continue;  // the number of the record itself
        const std::size_t end = kHouse.find_first_not_of("0123456789", at + 1);
        std::string text = kHouse;
        text.replace(at, end - at, "#9999");
        const Read read = readBodies(text);
        ++references;
        const bool isTold = read.find(Code::DanglingReference, "#9999") != nullptr;
        told += isTold;
        if (read.isRead && read.bodies == whole.bodies) continue;
        ++changed;
        EXPECT_TRUE(isTold) << kHouse.substr(kHouse.rfind('\n', at) + 1,
                                             kHouse.find('\n', at) - kHouse.rfind('\n', at));
    }
    EXPECT_GT(references, 150u);
    EXPECT_GT(changed, 60u);
    EXPECT_GE(told, changed);
}

TEST(IfcDanglingReferences, AreToldWithRecordLineAndAttribute) {
    const std::string text = replaced(kHouse, "#162=IFCAXIS2PLACEMENT3D(#163,", "#162=IFCAXIS2PLACEMENT3D(#9999,");
    const Read read = readBodies(text);
    ASSERT_EQ(read.log.count(Code::DanglingReference), 1u) << "once, although two placements and a solid follow it";
    const Diagnostic* found =
        read.find(Code::DanglingReference, "attribute 1 of #162 IFCAXIS2PLACEMENT3D refers to #9999");
    ASSERT_NE(found, nullptr);
    EXPECT_EQ(found->severity, Severity::Warning);
    EXPECT_EQ(found->where.line, 1u + std::size_t(std::count(text.begin(), text.begin() + text.find("#162="), '\n')));
    for (const char* id : {"column", "rail"})
        EXPECT_TRUE(std::ranges::any_of(read.log.items(), [&](const Diagnostic& item) {
            return item.code == Code::ReadInPart && item.where.id == id &&
                   item.message.find("#9999") != std::string::npos;
        })) << id;
    EXPECT_NE(read.find(Code::ProductsRead, "5 of 5 products with a shape were read, 2 of them in part"), nullptr);
}

TEST(IfcDanglingReferences, TheProductThatTheyBelongToIsNamed) {
    const struct {
        const char *from, *to, *id;
        Code code;
    } cases[] = {
        {"#100=IFCWALL('wall',$,'Wall',$,$,#15", "#100=IFCWALL('wall',$,'Wall',$,$,#9999", "wall", Code::ReadInPart},
        {"#107=IFCPLANE(#109)", "#107=IFCPLANE(#9999)", "wall", Code::ReadInPart},
        {"(#16,#92,", "(#16,#9999,", "wall", Code::ReadInPart},
        {"(.AREA.,$,#17,4000.", "(.AREA.,$,#9999,4000.", "wall", Code::ReadInPart},
        {"$,$,$,#100,#110)", "$,$,$,#100,#9999)", "wall", Code::ReadInPart},
        {"#114=IFCPRODUCTDEFINITIONSHAPE($,$,(#115))", "#114=IFCPRODUCTDEFINITIONSHAPE($,$,(#9999))", "wall",
         Code::ReadInPart},
        {"$,$,#111,#114,$,$)", "$,$,#111,#9999,$,$)", "wall", Code::ReadInPart},
        {"#123=IFCMAPPEDITEM(#124,#126)", "#123=IFCMAPPEDITEM(#124,#9999)", "door", Code::ReadInPart},
        {"#127=IFCBLOCK(#112", "#127=IFCBLOCK(#9999", "door", Code::ReadInPart},
        {"#15,#141,$,$)", "#15,#9999,$,$)", "roof", Code::ShapeNotRead},
        {"#141=IFCPRODUCTDEFINITIONSHAPE($,$,(#142))", "#141=IFCPRODUCTDEFINITIONSHAPE($,$,(#9999))", "roof",
         Code::ShapeNotRead},
        {"(#130,#132,#131)", "(#130,#9999,#131)", "roof", Code::ReadInPart},
        // No number of a record: beyond 32 bits.
        {"#175=IFCAXIS2PLACEMENT2D(#178", "#175=IFCAXIS2PLACEMENT2D(#99990000000000", "column", Code::ReadInPart},
    };
    for (const auto& [from, to, id, code] : cases) {
        const Read read = readBodies(replaced(kHouse, from, to));
        EXPECT_EQ(read.log.count(Code::DanglingReference), 1u) << to;
        EXPECT_EQ(read.log.count(code), 1u) << to;
        const Diagnostic* found = read.find(code, "#9999");
        if (std::string_view(to).starts_with("$,$,$,#100")) found = read.find(code, "an opening that the file lacks");
        ASSERT_NE(found, nullptr) << to;
        EXPECT_EQ(found->where.id, id) << to;
    }
}

TEST(IfcDanglingReferences, OfAMapAreToldOfEachProductThatUsesIt) {
    std::string text = replaced(kHouse, "#127=IFCBLOCK(#112", "#127=IFCBLOCK(#9999");
    text = replaced(text, "#15,#141,$,$)", "#15,#121,$,$)");
    const Read read = readBodies(text);
    EXPECT_EQ(read.log.count(Code::ReadInPart), 2u);
    EXPECT_EQ(read.log.count(Code::DanglingReference), 1u);
}

TEST(IfcDanglingReferences, ManyInOneRecordEnd) {
    std::string list;
    for (int i = 0; i < 200'000; ++i) list += ",#9999";
    const Read read = readBodies(replaced(kHouse, "(#16,#92,", "(#16" + list + ","));
    EXPECT_EQ(read.log.count(Code::DanglingReference), 200'000u);
    EXPECT_NE(read.find(Code::DanglingReference, "attribute 1 of #108 IFCPOLYLINE"), nullptr);
}

}  // namespace
}  // namespace svt::readers
