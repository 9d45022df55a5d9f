#include <tests/cli/drawings/small_ifc.hpp>

#include <fmt/format.h>

namespace svt::test {
namespace {

// A number as STEP writes it.
std::string real(double value) { return fmt::format("{:.6f}", value); }

std::string rooted(std::string_view type, int id, std::string_view name) {
    return fmt::format("{}('id{}',$,'{}'", type, id, name);
}

}  // namespace

SmallIfc::SmallIfc(std::string_view trueNorth, std::string_view conversion, std::string_view crs) {
    if (!trueNorth.empty()) records_ += fmt::format("#21=IFCDIRECTION({});\n", trueNorth);
    records_ += fmt::format("#20=IFCGEOMETRICREPRESENTATIONCONTEXT($,'Model',3,1.E-05,#14,{});\n",
                            trueNorth.empty() ? "$" : "#21");
    if (!conversion.empty())
        records_ += fmt::format("#22=IFCPROJECTEDCRS('{}',$,$,$,$,$,#3);\n#23=IFCMAPCONVERSION(#20,#22,{});\n", crs,
                                conversion);
}

int SmallIfc::add(const std::string& record) {
    records_ += fmt::format("#{}={};\n", next_, record);
    return next_++;
}

int SmallIfc::place(Corner origin) {
    const int point = add(fmt::format("IFCCARTESIANPOINT(({},{},{}))", real(origin.x), real(origin.y), real(origin.z)));
    return add(fmt::format("IFCAXIS2PLACEMENT3D(#{},#11,#12)", point));
}

int SmallIfc::storey(std::string_view name, double height, std::string_view elevation) {
    const int placement = add(fmt::format("IFCLOCALPLACEMENT(#15,#{})", place({0, 0, height})));
    storeys_.push_back(add(
        fmt::format("{},$,$,#{},$,$,.ELEMENT.,{})", rooted("IFCBUILDINGSTOREY", next_, name), placement, elevation)));
    spaces_.emplace_back();
    elements_.emplace_back();
    return static_cast<int>(storeys_.size()) - 1;
}

int SmallIfc::box(std::string_view type, std::string_view name, int storey, Corner low, Corner high) {
    const int body = add(fmt::format("IFCBLOCK(#{},{},{},{})", place(low), real(high.x - low.x), real(high.y - low.y),
                                     real(high.z - low.z)));
    const int shown = add(fmt::format("IFCSHAPEREPRESENTATION(#20,'Body','CSG',(#{}))", body));
    const int shape = add(fmt::format("IFCPRODUCTDEFINITIONSHAPE($,$,(#{}))", shown));
    const bool isSpace = type == "SPACE";
    const int product = add(fmt::format("{},$,$,#15,#{},{})", rooted(fmt::format("IFC{}", type), next_, name), shape,
                                        isSpace ? "$,.ELEMENT.,.INTERNAL.,$" : "$,$"));
    auto& parts = (isSpace ? spaces_ : elements_)[static_cast<std::size_t>(storey)];
    parts += fmt::format("{}#{}", parts.empty() ? "" : ",", product);
    return product;
}

void SmallIfc::layers(int product, const std::vector<Layer>& layers) {
    std::string list;
    for (const Layer& layer : layers) {
        const int material = add(fmt::format("IFCMATERIAL('{}',$,$)", layer.material));
        const int made = add(fmt::format("IFCMATERIALLAYER(#{},{},$,$,$,$,$)", material, real(layer.thickness)));
        list += fmt::format("{}#{}", list.empty() ? "" : ",", made);
    }
    const int set = add(fmt::format("IFCMATERIALLAYERSET(({}),'set',$)", list));
    const int usage = add(fmt::format("IFCMATERIALLAYERSETUSAGE(#{},.AXIS2.,.POSITIVE.,0.,$)", set));
    add(fmt::format("IFCRELASSOCIATESMATERIAL('layers{}',$,$,$,(#{}),#{})", next_, product, usage));
}

void SmallIfc::materials(int product, const std::vector<std::string_view>& names) {
    std::string list;
    for (const std::string_view name : names)
        list += fmt::format("{}#{}", list.empty() ? "" : ",", add(fmt::format("IFCMATERIAL('{}',$,$)", name)));
    const int made = add(fmt::format("IFCMATERIALLIST(({}))", list));
    add(fmt::format("IFCRELASSOCIATESMATERIAL('list{}',$,$,$,(#{}),#{})", next_, product, made));
}

void SmallIfc::shell(int storey, Corner low, Corner high) {
    constexpr double kThick = 0.3;
    box("SLAB", "slab", storey, {low.x, low.y, low.z - kThick}, {high.x, high.y, low.z});
    box("WALL", "south wall", storey, low, {high.x, low.y + kThick, high.z});
    box("WALL", "north wall", storey, {low.x, high.y - kThick, low.z}, high);
    box("WALL", "west wall", storey, {low.x, low.y + kThick, low.z}, {low.x + kThick, high.y - kThick, high.z});
    box("WALL", "east wall", storey, {high.x - kThick, low.y + kThick, low.z}, {high.x, high.y - kThick, high.z});
}

std::string SmallIfc::text() const {
    std::string text = R"(ISO-10303-21;
HEADER;
FILE_DESCRIPTION(('ViewDefinition [CoordinationView]'),'2;1');
FILE_NAME('small.ifc','2026-01-01T00:00:00',(''),(''),'','','');
FILE_SCHEMA(('IFC4'));
ENDSEC;
DATA;
#1=IFCPROJECT('project',$,'Project',$,$,$,$,(#20),#2);
#2=IFCUNITASSIGNMENT((#3));
#3=IFCSIUNIT(*,.LENGTHUNIT.,$,.METRE.);
#10=IFCCARTESIANPOINT((0.,0.,0.));
#11=IFCDIRECTION((0.,0.,1.));
#12=IFCDIRECTION((1.,0.,0.));
#14=IFCAXIS2PLACEMENT3D(#10,#11,#12);
#15=IFCLOCALPLACEMENT($,#14);
#30=IFCSITE('site',$,'Site',$,$,#15,$,$,.ELEMENT.,(49,5,59,0),(8,26,10,0),0.,$,$);
#31=IFCBUILDING('building',$,'House',$,$,#15,$,$,.ELEMENT.,$,$,$);
#32=IFCRELAGGREGATES('rel1',$,$,$,#1,(#30));
#33=IFCRELAGGREGATES('rel2',$,$,$,#30,(#31));
)";
    text += records_;
    std::string storeys;
    for (std::size_t n = 0; n < storeys_.size(); ++n) {
        storeys += fmt::format("{}#{}", n == 0 ? "" : ",", storeys_[n]);
        if (!spaces_[n].empty())
            text +=
                fmt::format("#{}=IFCRELAGGREGATES('spaces{}',$,$,$,#{},({}));\n", 40 + n, n, storeys_[n], spaces_[n]);
        if (!elements_[n].empty())
            text += fmt::format("#{}=IFCRELCONTAINEDINSPATIALSTRUCTURE('elements{}',$,$,$,({}),#{});\n", 60 + n, n,
                                elements_[n], storeys_[n]);
    }
    if (!storeys.empty()) text += fmt::format("#34=IFCRELAGGREGATES('rel3',$,$,$,#31,({}));\n", storeys);
    return text + "ENDSEC;\nEND-ISO-10303-21;\n";
}

}  // namespace svt::test
