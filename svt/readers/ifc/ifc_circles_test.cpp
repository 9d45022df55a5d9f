// Every reference of a file with records of every kind, turned into a circle: reading ends, and names the circle where it
// follows the reference.
#include <svt/readers/ifc/ifc_documents_test.hpp>
#include <svt/readers/ifc_shape/ifc_file.hpp>

#include <svt/core/text.hpp>

#include <gtest/gtest.h>

#include <cctype>
#include <ctime>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace svt::readers {
namespace {

using namespace test;

constexpr const char* kProfiles = R"(
#300=IFCRECTANGLEPROFILEDEF(.AREA.,$,#17,200.,300.);
#301=IFCROUNDEDRECTANGLEPROFILEDEF(.AREA.,$,#17,200.,300.,20.);
#302=IFCRECTANGLEHOLLOWPROFILEDEF(.AREA.,$,#17,200.,300.,10.,$,$);
#303=IFCCIRCLEPROFILEDEF(.AREA.,$,#17,100.);
#304=IFCCIRCLEHOLLOWPROFILEDEF(.AREA.,$,#17,100.,10.);
#305=IFCELLIPSEPROFILEDEF(.AREA.,$,#17,100.,50.);
#306=IFCISHAPEPROFILEDEF(.AREA.,$,#17,100.,200.,10.,20.,$,$,$);
#307=IFCASYMMETRICISHAPEPROFILEDEF(.AREA.,$,#17,100.,200.,10.,20.,$,80.,15.,$,$,$,$,$);
#308=IFCLSHAPEPROFILEDEF(.AREA.,$,#17,100.,80.,10.,$,$,$);
#309=IFCTSHAPEPROFILEDEF(.AREA.,$,#17,100.,80.,10.,12.,$,$,$,$,$);
#310=IFCUSHAPEPROFILEDEF(.AREA.,$,#17,100.,60.,8.,10.,$,$,$);
#311=IFCCSHAPEPROFILEDEF(.AREA.,$,#17,100.,60.,5.,20.,$);
#312=IFCZSHAPEPROFILEDEF(.AREA.,$,#17,100.,60.,8.,10.,$,$);
#313=IFCTRAPEZIUMPROFILEDEF(.AREA.,$,#17,400.,200.,100.,50.);
#314=IFCARBITRARYCLOSEDPROFILEDEF(.AREA.,$,#340);
#315=IFCARBITRARYPROFILEDEFWITHVOIDS(.AREA.,$,#340,(#345));
#316=IFCARBITRARYOPENPROFILEDEF(.CURVE.,$,#341);
#317=IFCCENTERLINEPROFILEDEF(.AREA.,$,#341,100.);
#318=IFCCOMPOSITEPROFILEDEF(.AREA.,$,(#300,#301,#302,#303,#304,#305,#306,#307,#308,#309,#310,#311,#312,#313,#314,#315,#317,#319,#320),$);
#319=IFCDERIVEDPROFILEDEF(.AREA.,$,#300,#321,$);
#320=IFCMIRROREDPROFILEDEF(.AREA.,$,#300,#322,$);
#321=IFCCARTESIANTRANSFORMATIONOPERATOR2D(#323,#324,#16,1.);
#322=IFCCARTESIANTRANSFORMATIONOPERATOR2DNONUNIFORM(#323,#324,#16,1.,2.);
#323=IFCDIRECTION((1.,0.));
#324=IFCDIRECTION((0.,1.));
#325=IFCARBITRARYCLOSEDPROFILEDEF(.AREA.,$,#351);
#326=IFCARBITRARYCLOSEDPROFILEDEF(.AREA.,$,#342);
#327=IFCARBITRARYCLOSEDPROFILEDEF(.AREA.,$,#355);
)";

constexpr const char* kCurves = R"(
#330=IFCCARTESIANPOINT((0.,0.));
#331=IFCCARTESIANPOINT((1000.,0.));
#332=IFCCARTESIANPOINT((1000.,1000.));
#333=IFCCARTESIANPOINT((0.,0.,0.));
#334=IFCCARTESIANPOINT((1000.,0.,0.));
#335=IFCCARTESIANPOINT((1000.,1000.,0.));
#336=IFCCARTESIANPOINT((1000.,1000.,1000.));
#340=IFCPOLYLINE((#330,#331,#332,#330));
#341=IFCINDEXEDPOLYCURVE(#360,(IFCLINEINDEX((1,2)),IFCARCINDEX((2,3,4))),.F.);
#342=IFCCOMPOSITECURVE((#343,#344),.F.);
#343=IFCCOMPOSITECURVESEGMENT(.CONTINUOUS.,.T.,#347);
#344=IFCREPARAMETRISEDCOMPOSITECURVESEGMENT(.CONTINUOUS.,.T.,#351,1.);
#345=IFCCIRCLE(#17,100.);
#346=IFCCOMPOSITECURVEONSURFACE((#343,#344),.F.);
#347=IFCTRIMMEDCURVE(#345,(IFCPARAMETERVALUE(0.)),(IFCPARAMETERVALUE(1.)),.T.,.PARAMETER.);
#348=IFCELLIPSE(#17,100.,50.);
#349=IFCLINE(#333,#350);
#350=IFCVECTOR(#12,1.);
#351=IFCTRIMMEDCURVE(#340,(#330),(#332),.T.,.CARTESIAN.);
#352=IFCBSPLINECURVEWITHKNOTS(2,(#333,#334,#335),.UNSPECIFIED.,.F.,.F.,(3,3),(0.,1.),.UNSPECIFIED.);
#353=IFCRATIONALBSPLINECURVEWITHKNOTS(2,(#333,#334,#335),.UNSPECIFIED.,.F.,.F.,(3,3),(0.,1.),.UNSPECIFIED.,(1.,2.,1.));
#354=IFCBEZIERCURVE(2,(#333,#334,#335),.UNSPECIFIED.,.F.,.F.);
#355=IFCSURFACECURVE(#340,(#400),.CURVE3D.);
#356=IFCSEAMCURVE(#352,(#400),.CURVE3D.);
#357=IFCINTERSECTIONCURVE(#353,(#400),.CURVE3D.);
#358=IFCTRIMMEDCURVE(#349,(#333),(#334),.T.,.CARTESIAN.);
#359=IFCTRIMMEDCURVE(#355,(#330),(#332),.T.,.CARTESIAN.);
#360=IFCCARTESIANPOINTLIST2D(((0.,0.),(1000.,0.),(1200.,500.),(1000.,1000.)));
#361=IFCPOLYLINE((#333,#334,#335,#336));
#362=IFCPOLYLINE((#333,#334));
)";

constexpr const char* kSolids = R"(
#200=IFCEXTRUDEDAREASOLID(#318,#14,#11,1000.);
#201=IFCEXTRUDEDAREASOLIDTAPERED(#300,#14,#11,1000.,#319);
#202=IFCREVOLVEDAREASOLID(#300,#14,#290,1.);
#203=IFCFIXEDREFERENCESWEPTAREASOLID(#303,#14,#361,0.,1.,#11);
#204=IFCDIRECTRIXDERIVEDREFERENCESWEPTAREASOLID(#303,#14,#361,0.,1.,#11);
#205=IFCSURFACECURVESWEPTAREASOLID(#303,#14,#340,0.,1.,#400);
#206=IFCSECTIONEDSOLIDHORIZONTAL(#361,(#300,#319),(#291,#292),.F.);
#207=IFCSECTIONEDSPINE(#342,(#300,#319),(#14,#293));
#208=IFCSWEPTDISKSOLID(#361,50.,20.,$,$);
#209=IFCSWEPTDISKSOLIDPOLYGONAL(#361,50.,20.,$,$,$);
#210=IFCFACETEDBREP(#500);
#211=IFCFACETEDBREPWITHVOIDS(#500,(#501));
#212=IFCADVANCEDBREP(#502);
#213=IFCADVANCEDBREPWITHVOIDS(#502,(#500));
#214=IFCFACEBASEDSURFACEMODEL((#503));
#215=IFCSHELLBASEDSURFACEMODEL((#504,#500));
#216=IFCTRIANGULATEDFACESET(#600,$,.T.,((1,2,3),(1,4,2),(2,4,3),(1,3,4)),$);
#217=IFCTRIANGULATEDIRREGULARNETWORK(#600,$,.F.,((1,2,3),(1,4,2)),$,(0,0));
#218=IFCPOLYGONALFACESET(#600,.T.,(#601,#602),$);
#219=IFCBOOLEANRESULT(.UNION.,#220,#227);
#220=IFCBOOLEANCLIPPINGRESULT(.DIFFERENCE.,#221,#224);
#221=IFCBOOLEANRESULT(.DIFFERENCE.,#222,#225);
#222=IFCBOOLEANRESULT(.INTERSECTION.,#223,#226);
#223=IFCBLOCK(#14,1000.,1000.,1000.);
#224=IFCHALFSPACESOLID(#400,.T.);
#225=IFCBOXEDHALFSPACE(#400,.F.,#235);
#226=IFCPOLYGONALBOUNDEDHALFSPACE(#400,.F.,#14,#340);
#227=IFCCSGSOLID(#228);
#228=IFCBOOLEANRESULT(.UNION.,#229,#230);
#229=IFCRECTANGULARPYRAMID(#14,100.,100.,100.);
#230=IFCRIGHTCIRCULARCONE(#14,100.,50.);
#231=IFCRIGHTCIRCULARCYLINDER(#14,100.,50.);
#232=IFCSPHERE(#14,50.);
#233=IFCMAPPEDITEM(#280,#283);
#234=IFCMAPPEDITEM(#280,#284);
#235=IFCBOUNDINGBOX(#10,100.,100.,100.);
#236=IFCEXTRUDEDAREASOLID(#316,#14,#11,1000.);
#237=IFCEXTRUDEDAREASOLID(#325,#14,#11,1000.);
#238=IFCEXTRUDEDAREASOLID(#326,#14,#11,1000.);
#239=IFCEXTRUDEDAREASOLID(#327,#14,#11,1000.);
#240=IFCSWEPTDISKSOLID(#352,50.,$,$,$);
#241=IFCSWEPTDISKSOLID(#357,50.,$,$,$);
#242=IFCCURVEBOUNDEDPLANE(#400,#340,());
#280=IFCREPRESENTATIONMAP(#14,#281);
#281=IFCSHAPEREPRESENTATION(#20,'Body','MappedRepresentation',(#223,#282));
#282=IFCMAPPEDITEM(#285,#283);
#283=IFCCARTESIANTRANSFORMATIONOPERATOR3D(#12,#13,#10,1.,#11);
#284=IFCCARTESIANTRANSFORMATIONOPERATOR3DNONUNIFORM(#12,#13,#10,1.,#11,2.,3.);
#285=IFCREPRESENTATIONMAP(#14,#286);
#286=IFCSHAPEREPRESENTATION(#20,'Body','CSG',(#229));
#290=IFCAXIS1PLACEMENT(#334,#13);
#291=IFCAXIS2PLACEMENTLINEAR(#294,#11,#12);
#292=IFCAXIS2PLACEMENTLINEAR(#295,#11,#12);
#293=IFCAXIS2PLACEMENT3D(#336,#11,#12);
#294=IFCPOINTBYDISTANCEEXPRESSION(IFCLENGTHMEASURE(0.),$,$,$,#361);
#295=IFCPOINTBYDISTANCEEXPRESSION(IFCLENGTHMEASURE(1500.),$,$,$,#361);
#600=IFCCARTESIANPOINTLIST3D(((0.,0.,0.),(1000.,0.,0.),(0.,1000.,0.),(0.,0.,1000.)));
#601=IFCINDEXEDPOLYGONALFACE((1,2,3));
#602=IFCINDEXEDPOLYGONALFACEWITHVOIDS((1,2,3),((1,2,4)));
)";

constexpr const char* kFaces = R"(
#400=IFCPLANE(#14);
#401=IFCCYLINDRICALSURFACE(#14,1000.);
#402=IFCCONICALSURFACE(#14,1000.,0.5);
#403=IFCSPHERICALSURFACE(#14,1000.);
#404=IFCTOROIDALSURFACE(#14,1000.,200.);
#405=IFCBSPLINESURFACEWITHKNOTS(1,1,((#333,#334),(#335,#336)),.UNSPECIFIED.,.F.,.F.,.F.,(2,2),(2,2),(0.,1.),(0.,1.),.UNSPECIFIED.);
#406=IFCRATIONALBSPLINESURFACEWITHKNOTS(1,1,((#333,#334),(#335,#336)),.UNSPECIFIED.,.F.,.F.,.F.,(2,2),(2,2),(0.,1.),(0.,1.),.UNSPECIFIED.,((1.,1.),(1.,1.)));
#407=IFCSURFACEOFLINEAREXTRUSION(#316,#14,#11,1000.);
#408=IFCSURFACEOFREVOLUTION(#316,#14,#290);
#500=IFCCLOSEDSHELL((#510,#511));
#501=IFCCLOSEDSHELL((#512));
#502=IFCCLOSEDSHELL((#520,#521,#522,#523,#524,#525,#526,#527,#528));
#503=IFCCONNECTEDFACESET((#510));
#504=IFCOPENSHELL((#511));
#510=IFCFACE((#530,#531));
#511=IFCFACE((#530));
#512=IFCFACESURFACE((#530),#400,.T.);
#520=IFCADVANCEDFACE((#532),#400,.T.);
#521=IFCADVANCEDFACE((#532),#401,.T.);
#522=IFCADVANCEDFACE((#532),#402,.T.);
#523=IFCADVANCEDFACE((#532),#403,.T.);
#524=IFCADVANCEDFACE((#532),#404,.T.);
#525=IFCADVANCEDFACE((#532),#405,.T.);
#526=IFCADVANCEDFACE((#532),#406,.T.);
#527=IFCADVANCEDFACE((#532),#407,.T.);
#528=IFCADVANCEDFACE((#532),#408,.T.);
#530=IFCFACEOUTERBOUND(#540,.T.);
#531=IFCFACEBOUND(#540,.F.);
#532=IFCFACEOUTERBOUND(#541,.T.);
#540=IFCPOLYLOOP((#333,#334,#335));
#541=IFCEDGELOOP((#550,#551,#552));
#550=IFCORIENTEDEDGE(*,*,#560,.T.);
#551=IFCORIENTEDEDGE(*,*,#561,.T.);
#552=IFCORIENTEDEDGE(*,*,#562,.T.);
#560=IFCEDGECURVE(#570,#571,#349,.T.);
#561=IFCEDGECURVE(#571,#572,#356,.T.);
#562=IFCEDGE(#572,#570);
#570=IFCVERTEXPOINT(#333);
#571=IFCVERTEXPOINT(#334);
#572=IFCVERTEXPOINT(#335);
)";

constexpr const char* kProducts = R"(
#100=IFCWALL('wall',$,'Wall',$,$,#15,#101,$,$);
#101=IFCPRODUCTDEFINITIONSHAPE($,$,(#102,#103,#104));
#102=IFCSHAPEREPRESENTATION(#20,'Body','AdvancedSweptSolid',(#200,#201,#202,#203,#204,#205,#206,#207,#208,#209,#210,#211,#212,#213,#214,#215,#216,#217,#218,#219,#231,#232,#233,#234,#235,#236,#237,#238,#239,#240,#241,#242));
#103=IFCSHAPEREPRESENTATION(#21,'Axis','Curve2D',(#362));
#104=IFCTOPOLOGYREPRESENTATION(#20,'Reference','FaceSet',(#503));
#21=IFCGEOMETRICREPRESENTATIONSUBCONTEXT('Axis','Model',*,*,*,*,#20,$,.GRAPH_VIEW.,$);
#110=IFCWALL('layered',$,'Layered',$,$,#120,#111,$,$);
#111=IFCPRODUCTDEFINITIONSHAPE($,$,(#112,#103));
#112=IFCSHAPEREPRESENTATION(#20,'Body','Clipping',(#113));
#113=IFCBOOLEANCLIPPINGRESULT(.DIFFERENCE.,#114,#224);
#114=IFCEXTRUDEDAREASOLID(#300,#14,#11,1000.);
#115=IFCOPENINGELEMENT('opening',$,$,$,$,#120,#111,$,$);
#116=IFCRELVOIDSELEMENT('v',$,$,$,#110,#115);
#117=IFCPROJECTIONELEMENT('projection',$,$,$,$,#120,#111,$,$);
#118=IFCRELPROJECTSELEMENT('q',$,$,$,#110,#117);
#119=IFCDOOR('door',$,'Door',$,$,#121,#111,$,2000.,900.);
#120=IFCLOCALPLACEMENT(#15,#14);
#121=IFCGRIDPLACEMENT(#122,#12);
#122=IFCVIRTUALGRIDINTERSECTION((#123,#124),(0.,0.,0.));
#123=IFCGRIDAXIS('A',#362,.T.);
#124=IFCGRIDAXIS('1',#125,.T.);
#125=IFCLINE(#10,#126);
#126=IFCVECTOR(#13,1.);
#127=IFCGRID('grid',$,'Grid',$,$,#120,#128,(#123),(#124),$);
#128=IFCPRODUCTDEFINITIONSHAPE($,$,(#129));
#129=IFCSHAPEREPRESENTATION(#20,'FootPrint','GeometricCurveSet',(#130,#131,#132,#133));
#130=IFCGEOMETRICCURVESET((#340,#341,#342,#345,#346,#347,#348));
#131=IFCGEOMETRICSET((#352,#353,#354,#355,#356,#357,#358,#359));
#132=IFCANNOTATIONFILLAREA(#340,(#345));
#133=IFCMAPPEDITEM(#134,#283);
#134=IFCREPRESENTATIONMAP(#14,#135);
#135=IFCSHAPEREPRESENTATION(#20,'FootPrint','GeometricCurveSet',(#130));
#136=IFCRELFILLSELEMENT('f',$,$,$,#115,#119);
#137=IFCBEAM('beam',$,'Beam',$,$,#138,#111,$,$);
#138=IFCLINEARPLACEMENT(#120,#291,#14);
#139=IFCWALL('part',$,'Part',$,$,#120,#111,$,$);
#140=IFCRELAGGREGATES('g',$,$,$,#110,(#139));
#141=IFCRELNESTS('n',$,$,$,#119,(#137));
#142=IFCRELREFERENCEDINSPATIALSTRUCTURE('s',$,$,$,(#100),#32);
#150=IFCSTYLEDITEM(#223,(#151),$);
#151=IFCPRESENTATIONSTYLEASSIGNMENT((#152));
#152=IFCSURFACESTYLE('red',.BOTH.,(#153,#154));
#153=IFCSURFACESTYLERENDERING(#155,0.5,$,$,$,$,$,$,.FLAT.);
#154=IFCSURFACESTYLESHADING(#155,0.);
#155=IFCCOLOURRGB('red',1.,0.,0.);
#156=IFCINDEXEDCOLOURMAP(#216,1.,#157,(1,1,2,2));
#157=IFCCOLOURRGBLIST(((1.,0.,0.),(0.,1.,0.)));
#158=IFCMATERIALDEFINITIONREPRESENTATION($,$,(#159),#180);
#159=IFCSTYLEDREPRESENTATION(#20,'Style','Material',(#160));
#160=IFCSTYLEDITEM($,(#152),$);
#161=IFCPRESENTATIONLAYERASSIGNMENT('layer',$,(#102,#223),$);
#162=IFCPRESENTATIONLAYERWITHSTYLE('styled',$,(#112),$,.T.,.F.,.F.,(#151));
#163=IFCSHAPEASPECT((#102,#112),'Framing',$,.T.,#101);
#800=IFCSIGN('sign',$,'Sign',$,$,#801,#111,$,$);
#801=IFCLINEARPLACEMENT($,#802,$);
#802=IFCAXIS2PLACEMENTLINEAR(#803,$,$);
#803=IFCPOINTBYDISTANCEEXPRESSION(IFCLENGTHMEASURE(100.),$,$,$,#804);
#804=IFCSEGMENTEDREFERENCECURVE((#805),.F.,#806,$);
#805=IFCCURVESEGMENT(.DISCONTINUOUS.,#17,IFCLENGTHMEASURE(0.),IFCLENGTHMEASURE(500.),#810);
#806=IFCGRADIENTCURVE((#807),.F.,#808,$);
#807=IFCCURVESEGMENT(.DISCONTINUOUS.,#17,IFCLENGTHMEASURE(0.),IFCLENGTHMEASURE(500.),#810);
#808=IFCCOMPOSITECURVE((#809,#816,#817,#818,#819,#820),.F.);
#809=IFCCURVESEGMENT(.DISCONTINUOUS.,#17,IFCLENGTHMEASURE(0.),IFCLENGTHMEASURE(500.),#810);
#810=IFCCLOTHOID(#17,1000.);
#811=IFCCOSINESPIRAL(#17,1000.,$);
#812=IFCSINESPIRAL(#17,1000.,$,$);
#813=IFCSECONDORDERPOLYNOMIALSPIRAL(#17,1000.,$,$);
#814=IFCTHIRDORDERPOLYNOMIALSPIRAL(#17,1000.,$,$,$);
#815=IFCSEVENTHORDERPOLYNOMIALSPIRAL(#17,1000.,$,$,$,$,$,$,$);
#816=IFCCURVESEGMENT(.DISCONTINUOUS.,#17,IFCLENGTHMEASURE(0.),IFCLENGTHMEASURE(500.),#811);
#817=IFCCURVESEGMENT(.DISCONTINUOUS.,#17,IFCLENGTHMEASURE(0.),IFCLENGTHMEASURE(500.),#812);
#818=IFCCURVESEGMENT(.DISCONTINUOUS.,#17,IFCLENGTHMEASURE(0.),IFCLENGTHMEASURE(500.),#813);
#819=IFCCURVESEGMENT(.DISCONTINUOUS.,#17,IFCLENGTHMEASURE(0.),IFCLENGTHMEASURE(500.),#814);
#820=IFCCURVESEGMENT(.DISCONTINUOUS.,#17,IFCLENGTHMEASURE(0.),IFCLENGTHMEASURE(500.),#815);
)";

constexpr const char* kRelations = R"(
#170=IFCRELDEFINESBYPROPERTIES('d',$,$,$,(#100,#110),#190);
#171=IFCRELDEFINESBYPROPERTIES('e',$,$,$,(#100),#191);
#172=IFCRELDEFINESBYTYPE('t',$,$,$,(#100,#119),#173);
#173=IFCDOORTYPE('type',$,'Type',$,$,(#190,#1920),(#280),$,$,.DOOR.,.SINGLE_SWING_LEFT.,$,$);
#174=IFCRELASSOCIATESMATERIAL('m',$,$,$,(#110),#182);
#175=IFCRELASSOCIATESMATERIAL('m',$,$,$,(#100),#184);
#176=IFCRELASSOCIATESMATERIAL('m',$,$,$,(#119),#186);
#177=IFCRELASSOCIATESMATERIAL('m',$,$,$,(#137),#188);
#178=IFCRELASSOCIATESCLASSIFICATION('c',$,$,$,(#100),#195);
#179=IFCRELASSIGNSTOGROUP('a',$,$,$,(#100,#110),$,#198);
#180=IFCMATERIAL('Brick',$,'LoadBearing');
#181=IFCMATERIALLAYER(#180,100.,$,$,$,$,$);
#182=IFCMATERIALLAYERSETUSAGE(#183,.AXIS2.,.POSITIVE.,-150.,$);
#183=IFCMATERIALLAYERSET((#181,#1810),'set',$);
#1810=IFCMATERIALLAYERWITHOFFSETS(#180,200.,$,$,$,$,$,.AXIS1.,(0.));
#184=IFCMATERIALLIST((#180));
#185=IFCMATERIALCONSTITUENT('part',$,#180,$,$);
#186=IFCMATERIALCONSTITUENTSET('set',$,(#185));
#187=IFCMATERIALPROFILE('p',$,#180,#300,$,$);
#188=IFCMATERIALPROFILESETUSAGE(#189,$,$);
#189=IFCMATERIALPROFILESET('set',$,(#187),$);
#1920=IFCDOORLININGPROPERTIES('lining',$,'L',$,100.,50.,$,$,$,$,$,$,$,$,$,$,$);
#190=IFCPROPERTYSET('ps',$,'Pset',$,(#1900,#1901,#1902,#1903,#1904,#1905));
#1900=IFCPROPERTYSINGLEVALUE('Single',$,IFCLABEL('x'),$);
#1901=IFCPROPERTYENUMERATEDVALUE('Enum',$,(IFCLABEL('x')),$);
#1902=IFCPROPERTYLISTVALUE('List',$,(IFCLABEL('x')),$);
#1903=IFCPROPERTYBOUNDEDVALUE('Bounded',$,IFCREAL(1.),IFCREAL(2.),$,$);
#1904=IFCCOMPLEXPROPERTY('Complex',$,'use',(#1900,#1906));
#1905=IFCPROPERTYTABLEVALUE('Table',$,(IFCLABEL('x')),(IFCLABEL('y')),$,$,$,$);
#1906=IFCCOMPLEXPROPERTY('Inner',$,'use',(#1901));
#191=IFCELEMENTQUANTITY('eq',$,'Quantities',$,$,(#1910,#1911,#1912,#1913,#1914,#1915));
#1910=IFCQUANTITYLENGTH('L',$,$,1.,$);
#1911=IFCQUANTITYAREA('A',$,$,1.,$);
#1912=IFCQUANTITYVOLUME('V',$,$,1.,$);
#1913=IFCQUANTITYCOUNT('C',$,$,1.,$);
#1914=IFCQUANTITYWEIGHT('W',$,$,1.,$);
#1915=IFCQUANTITYTIME('T',$,$,1.,$);
#195=IFCCLASSIFICATIONREFERENCE($,'Ss_25','Walls',#196,$,$);
#196=IFCCLASSIFICATION('NBS','1',$,'Uniclass',$,$,$);
#198=IFCSYSTEM('sys',$,'System',$,$);
#199=IFCDISTRIBUTIONSYSTEM('dis',$,'Pipes',$,$,$,.WATERSUPPLY.);
#1990=IFCBUILDINGSYSTEM('bs',$,'Facade',$,$,.FENESTRATION.,$);
#1991=IFCGROUP('group',$,'Group',$,$);
#1992=IFCZONE('zone',$,'Zone',$,$,$);
#1993=IFCRELASSIGNSTOGROUP('b',$,$,$,(#100),$,#199);
#1994=IFCRELASSIGNSTOGROUP('c',$,$,$,(#100),$,#1990);
#1995=IFCRELASSIGNSTOGROUP('d',$,$,$,(#100),$,#1991);
#1996=IFCRELASSIGNSTOGROUP('e',$,$,$,(#100),$,#1992);
#700=IFCMAPCONVERSION(#20,#701,500000.,5400000.,100.,1.,0.,1.);
#701=IFCPROJECTEDCRS('EPSG:25832',$,'ETRS89','DHHN2016','UTM','32N',#3);
#702=IFCMAPCONVERSIONSCALED(#20,#701,500000.,5400000.,100.,1.,0.,1.,1.,1.,1.);
#703=IFCRIGIDOPERATION(#20,#701,IFCLENGTHMEASURE(500000.),IFCLENGTHMEASURE(5400000.),100.);
#7=IFCCONVERSIONBASEDUNIT(#704,.PLANEANGLEUNIT.,'DEGREE',#705);
#8=IFCCONVERSIONBASEDUNITWITHOFFSET(#704,.THERMODYNAMICTEMPERATUREUNIT.,'F',#706,-459.67);
#704=IFCDIMENSIONALEXPONENTS(0,0,0,0,0,0,0);
#705=IFCMEASUREWITHUNIT(IFCPLANEANGLEMEASURE(0.0174532925199433),#6);
#706=IFCMEASUREWITHUNIT(IFCRATIOMEASURE(0.55),#3);
#2=IFCUNITASSIGNMENT((#3,#4,#5,#7,#8));
)";

// The file with its second IFCUNITASSIGNMENT in place of the first, which names no unit by conversion.
std::string allKinds() {
    std::string text = ifcFile(std::string(kProfiles) + kCurves + kSolids + kFaces + kProducts + kRelations,
                               "#100,#110,#119,#127,#137,#139");
    const std::size_t first = text.find("#2=IFCUNITASSIGNMENT");
    text.erase(first, text.find('\n', first) + 1 - first);
    return text;
}

struct Reference {
    std::size_t at = 0, size = 0;  // of "#12" in the text
    std::string from, to;          // "#7", "#12"
};

// All references of the data section.
std::vector<Reference> referencesOf(const std::string& text) {
    std::vector<Reference> references;
    std::string record;
    for (std::size_t i = text.find("DATA;"); i < text.size(); ++i) {
        if (text[i] != '#') continue;
        std::size_t end = i + 1;
        while (std::isdigit(static_cast<unsigned char>(text[end])) != 0) ++end;
        const std::string id = text.substr(i, end - i);
        if (text[end] == '=')
            record = id;
        else
            references.push_back({i, end - i, record, id});
    }
    return references;
}

std::string with(const std::string& text, const Reference& reference, const std::string& id) {
    return text.substr(0, reference.at) + id + text.substr(reference.at + reference.size);
}

struct CircleOutcome {
    bool isModel = false;
    std::string findings;
};

CircleOutcome readLayered(const std::string& text) {
    ReadOptions options;
    options.splitLayers = true;
    Diagnostics log;
    const auto model = readIfc(std::as_bytes(std::span(text.data(), text.size())), "test.ifc", options, &log);
    CircleOutcome outcome{model.hasValue(), model ? "" : model.error().toString()};
    for (const Diagnostic& d : log.items()) outcome.findings += d.toString() + "\n";
    return outcome;
}

TEST(IfcCircles, TheFileHasRecordsOfEveryKind) {
    const std::string text = allKinds();
    constexpr std::string_view kNames[] = {
#define X(name, ...) "IFC" #name,
        SVT_IFC_ENTITIES(X)
#undef X
    };
    for (const std::string_view name : kNames)
        EXPECT_NE(lowerAscii(text).find("=" + lowerAscii(name) + "("), std::string::npos) << name;
    const CircleOutcome outcome = readLayered(text);
    EXPECT_TRUE(outcome.isModel) << outcome.findings;
    EXPECT_EQ(outcome.findings.find("circle"), std::string::npos) << outcome.findings;
}

TEST(IfcCircles, EveryReferenceMayCloseACircle) {
    const std::string text = allKinds();
    const std::vector<Reference> references = referencesOf(text);
    std::map<std::string, std::set<std::string>> referrers;
    for (const Reference& reference : references) referrers[reference.to].insert(reference.from);
    ASSERT_GT(references.size(), 500U);
    const std::clock_t begin = std::clock();
    std::size_t files = 0, named = 0;
    for (const Reference& reference : references) {
        // To its own record, and to those that refer to it.
        std::set<std::string> targets = referrers[reference.from];
        if (targets.size() > 3) targets.erase(std::next(targets.begin(), 3), targets.end());
        targets.insert(reference.from);
        for (const std::string& target : targets) {
            const CircleOutcome outcome = readLayered(with(text, reference, target));
            EXPECT_FALSE(outcome.findings.empty()) << reference.from << " to " << target;
            ++files;
            if (outcome.findings.find("circle") != std::string::npos) ++named;
        }
    }
    EXPECT_GT(files, 1000U);
    EXPECT_GT(named, 100U);
    // Each takes some milliseconds; one that doubles its work with each record would take for ever.
    EXPECT_LT(double(std::clock() - begin) / CLOCKS_PER_SEC, 0.2 * double(files));
}

// Where the reader goes from a record to others of its kind: a circle is named, with the product that has it.
TEST(IfcCircles, CirclesAreNamedWithTheirRecords) {
    const struct {
        const char *record, *from, *to, *circle;
    } cases[] = {
        {"#351=", "#340", "#351", "#351 IFCTRIMMEDCURVE -> #351"},
        {"#355=", "#340", "#355", "#355 IFCSURFACECURVE -> #355"},
        {"#356=", "#352", "#356", "#356 IFCSEAMCURVE -> #356"},
        {"#340=", "IFCPOLYLINE((#330,#331,#332,#330))", "IFCTRIMMEDCURVE(#355,(#330),(#332),.T.,.CARTESIAN.)",
         "#340 IFCTRIMMEDCURVE -> #355 IFCSURFACECURVE -> #340"},
        {"#343=", "#347", "#342", "#342 IFCCOMPOSITECURVE -> #342"},
        {"#318=", "#300", "#318", "#318 IFCCOMPOSITEPROFILEDEF -> #318"},
        {"#319=", "#300", "#318", "#318 IFCCOMPOSITEPROFILEDEF -> #319 IFCDERIVEDPROFILEDEF -> #318"},
        {"#221=", "#222", "#220", "#220 IFCBOOLEANCLIPPINGRESULT -> #221 IFCBOOLEANRESULT -> #220"},
        {"#228=", "#230", "#227", "#227 IFCCSGSOLID -> #228 IFCBOOLEANRESULT -> #227"},
        {"#281=", "#223", "#233",
         "#233 IFCMAPPEDITEM -> #280 IFCREPRESENTATIONMAP -> #281 IFCSHAPEREPRESENTATION -> #233"},
        {"#286=", "#229", "#282",
         "#282 IFCMAPPEDITEM -> #285 IFCREPRESENTATIONMAP -> #286 IFCSHAPEREPRESENTATION -> #282"},
        {"#120=", "#15", "#120", "#120 IFCLOCALPLACEMENT -> #120"},
        {"#182=", "#183", "#182", "#182 IFCMATERIALLAYERSETUSAGE -> #182"},
        {"#1906=", "#1901", "#1904", "#1904 IFCCOMPLEXPROPERTY -> #1906 IFCCOMPLEXPROPERTY -> #1904"},
        {"#705=", "#6)", "#7)", "#7 IFCCONVERSIONBASEDUNIT -> #7"},
        {"#140=", "(#139)", "(#110)", "#110 IFCWALL -> #110"},
        {"#131=", "#352", "#131", "#131 IFCGEOMETRICSET -> #131"},
        {"#116=", "#115", "#110", "#110 IFCWALL -> #110"},
    };
    for (const auto& [record, from, to, circle] : cases) {
        std::string text = allKinds();
        const std::size_t at = text.find(std::string("\n") + record);
        ASSERT_NE(at, std::string::npos) << record;
        const std::size_t place = text.find(from, at + 1 + std::string_view(record).size());
        ASSERT_LT(place, text.find('\n', at + 1)) << record;
        text.replace(place, std::string_view(from).size(), to);
        const CircleOutcome outcome = readLayered(text);
        EXPECT_TRUE(outcome.isModel);
        const std::size_t found = outcome.findings.find("E111");
        ASSERT_NE(found, std::string::npos) << record << "\n" << outcome.findings;
        EXPECT_NE(outcome.findings.find(circle, found), std::string::npos) << outcome.findings;
    }
}

}  // namespace
}  // namespace svt::readers
