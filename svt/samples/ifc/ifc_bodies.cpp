#include <svt/samples/ifc/ifc_bodies.hpp>

#include <algorithm>
#include <cstdint>
#include <map>

namespace svt::samples {
namespace {

bool isBox(const Piece& piece) {
    return piece.sides.size() == 4 && std::all_of(piece.sides.begin(), piece.sides.end(), [](const HalfPlane& side) {
               return side.across == 0 || side.up == 0;
           });
}

}  // namespace

int IfcBodies::extrusion(const Frame& frame, Axis axis, const Piece& piece) {
    const bool isAlongX = axis == Axis::X;
    const int up = records_.direction({0, 0, 1});
    const std::vector<SectionCorner> section = sectionOf(piece);
    const Vec3d along = isAlongX ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0};
    if (isBox(piece) && frame.z == Vec3d{0, 0, 1}) {
        double low = 1e300, high = -1e300, v0 = 1e300, v1 = -1e300;
        for (const SectionCorner& c : section) {
            v0 = std::min(v0, c.across()), v1 = std::max(v1, c.across());
            low = std::min(low, c.up()), high = std::max(high, c.up());
        }
        const double u0 = double(piece.from), u1 = double(piece.to);
        const Vec3d center =
            isAlongX ? Vec3d{(u0 + u1) / 2, (v0 + v1) / 2, low} : Vec3d{(v0 + v1) / 2, (u0 + u1) / 2, low};
        const Vec3d size = isAlongX ? Vec3d{u1 - u0, v1 - v0, 0} : Vec3d{v1 - v0, u1 - u0, 0};
        const int profile = records_.shared("IFCRECTANGLEPROFILEDEF", ".AREA.,$,$", size.x, size.y);
        const int position = records_.axes(
            {frame.localDirection({1, 0, 0}), frame.localDirection({0, 1, 0}), {0, 0, 1}, frame.local(center)});
        return records_.add("IFCEXTRUDEDAREASOLID", profile, position, up, high - low);
    }
    // Along x the profile is in (y, z), along y in (z, x): both right-handed with the axis.
    std::vector<int> points;
    for (std::size_t i = 0; i < section.size(); ++i) {
        const SectionCorner& c = section[isAlongX ? i : section.size() - 1 - i];
        const std::string v = stepRatio(c.v, c.scale), z = stepRatio(c.z, c.scale);
        points.push_back(isAlongX ? records_.point2(v, z) : records_.point2(z, v));
    }
    points.push_back(points.front());
    const int line = records_.add("IFCPOLYLINE", points);
    const int profile = records_.add("IFCARBITRARYCLOSEDPROFILEDEF", ".AREA.,$", line);
    const Vec3d profileX = isAlongX ? Vec3d{0, 1, 0} : Vec3d{0, 0, 1};
    const int position = records_.axes({frame.localDirection(profileX), frame.localDirection(cross(along, profileX)),
                                        frame.localDirection(along), frame.local(along * double(piece.from))});
    return records_.add("IFCEXTRUDEDAREASOLID", profile, position, up, double(piece.to - piece.from));
}

int IfcBodies::solid(const Frame& frame, const Solid& solid, const std::vector<bool>& isLeftOut, bool& isBoolean) {
    int result = 0;
    for (std::size_t i = 0; i < solid.pieces.size(); ++i) {
        if (i < isLeftOut.size() && isLeftOut[i]) continue;
        const int piece = extrusion(frame, solid.axis, solid.pieces[i]);
        if (result == 0) {
            result = piece;
            continue;
        }
        isBoolean = true;
        result = records_.add("IFCBOOLEANRESULT", solid.pieces[i].adds ? ".UNION." : ".DIFFERENCE.", result, piece);
    }
    style(result, solid.material);
    return result;
}

int IfcBodies::brep(const Frame& frame, std::span<const Point> vertices, const Shell& shell, Material shown) {
    std::map<std::uint32_t, int> points;
    std::vector<int> faces;
    for (const Face& face : shell.faces) {
        std::vector<int> bounds;
        for (const std::vector<std::uint32_t>& ring : face.rings) {
            std::vector<int> corners;
            for (const std::uint32_t vertex : ring) {
                int& point = points[vertex];
                if (point == 0) point = records_.point(frame.local(toDouble(vertices[vertex])));
                corners.push_back(point);
            }
            const int loop = records_.add("IFCPOLYLOOP", corners);
            bounds.push_back(records_.add(bounds.empty() ? "IFCFACEOUTERBOUND" : "IFCFACEBOUND", loop, ".T."));
        }
        faces.push_back(records_.add("IFCFACE", bounds));
    }
    const int body = records_.add("IFCFACETEDBREP", records_.add("IFCCLOSEDSHELL", faces));
    style(body, shown);
    return body;
}

int IfcBodies::representation(const std::vector<int>& items, std::string_view type) {
    return records_.add("IFCSHAPEREPRESENTATION", context_, "'Body'", stepText(type), items);
}

int IfcBodies::shape(const std::vector<int>& representations) {
    return records_.add("IFCPRODUCTDEFINITIONSHAPE", "$,$", representations);
}

int IfcBodies::surfaceStyle(std::string_view name, const std::array<double, 3>& color, double transparency) {
    const int rgb = records_.shared("IFCCOLOURRGB", "$", color[0], color[1], color[2]);
    const int shading = records_.shared("IFCSURFACESTYLESHADING", rgb, transparency);
    return records_.shared("IFCSURFACESTYLE", stepText(name), ".BOTH.", std::array{shading});
}

void IfcBodies::style(int item, Material material) {
    const MaterialInfo& shown = info(material);
    const int style = surfaceStyle(shown.name, shown.color, shown.transparency);
    records_.add("IFCSTYLEDITEM", item, std::array{style}, "$");
}

}  // namespace svt::samples
