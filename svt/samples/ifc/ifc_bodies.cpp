#include <svt/samples/ifc/ifc_bodies.hpp>

#include <algorithm>
#include <cmath>

namespace svt::samples {
namespace {

// a / scale is the same point; scales are positive.
bool isSame(const SectionCorner& a, const SectionCorner& b) {
    return a.v * b.scale == b.v * a.scale && a.z * b.scale == b.z * a.scale;
}

bool isBox(const Piece& piece) {
    return piece.sides.size() == 4 && std::all_of(piece.sides.begin(), piece.sides.end(), [](const HalfPlane& side) {
               return side.across == 0 || side.up == 0;
           });
}

}  // namespace

// All crossings of two sides that lie in all others. Sides have small whole coefficients, so that nothing overflows.
std::vector<SectionCorner> sectionOf(const Piece& piece) {
    std::vector<SectionCorner> corners;
    for (std::size_t i = 0; i < piece.sides.size(); ++i)
        for (std::size_t j = i + 1; j < piece.sides.size(); ++j) {
            const HalfPlane &a = piece.sides[i], &b = piece.sides[j];
            SectionCorner corner{a.limit * b.up - b.limit * a.up, a.across * b.limit - b.across * a.limit,
                                 a.across * b.up - b.across * a.up};
            if (corner.scale == 0) continue;
            if (corner.scale < 0) corner = {-corner.v, -corner.z, -corner.scale};
            const bool isInside = std::all_of(piece.sides.begin(), piece.sides.end(), [&](const HalfPlane& side) {
                return side.across * corner.v + side.up * corner.z <= side.limit * corner.scale;
            });
            const bool isNew = std::none_of(corners.begin(), corners.end(),
                                            [&](const SectionCorner& known) { return isSame(known, corner); });
            if (isInside && isNew) corners.push_back(corner);
        }
    double middleV = 0, middleZ = 0;
    for (const SectionCorner& c : corners) {
        middleV += double(c.v) / double(c.scale) / double(corners.size());
        middleZ += double(c.z) / double(c.scale) / double(corners.size());
    }
    const auto angleOf = [&](const SectionCorner& c) {
        return std::atan2(double(c.z) / double(c.scale) - middleZ, double(c.v) / double(c.scale) - middleV);
    };
    std::sort(corners.begin(), corners.end(),
              [&](const SectionCorner& a, const SectionCorner& b) { return angleOf(a) < angleOf(b); });
    return corners;
}

std::string stepList(std::span<const int> records) {
    std::string text = "(";
    for (const int record : records) text += (text.size() > 1 ? "," : "") + stepReference(record);
    return text + ")";
}

int IfcBodies::extrusion(const Frame& frame, Axis axis, const Piece& piece) {
    const bool isAlongX = axis == Axis::X;
    const int up = records_.direction({0, 0, 1});
    const std::vector<SectionCorner> section = sectionOf(piece);
    const Vec3d along = isAlongX ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0};
    if (isBox(piece) && frame.z == Vec3d{0, 0, 1}) {
        double low = 1e300, high = -1e300, v0 = 1e300, v1 = -1e300;
        for (const SectionCorner& c : section) {
            v0 = std::min(v0, double(c.v) / double(c.scale));
            v1 = std::max(v1, double(c.v) / double(c.scale));
            low = std::min(low, double(c.z) / double(c.scale));
            high = std::max(high, double(c.z) / double(c.scale));
        }
        const double u0 = double(piece.from), u1 = double(piece.to);
        const Vec3d center =
            isAlongX ? Vec3d{(u0 + u1) / 2, (v0 + v1) / 2, low} : Vec3d{(v0 + v1) / 2, (u0 + u1) / 2, low};
        const Vec3d size = isAlongX ? Vec3d{u1 - u0, v1 - v0, 0} : Vec3d{v1 - v0, u1 - u0, 0};
        const int profile =
            records_.shared("IFCRECTANGLEPROFILEDEF", ".AREA.,$,$," + stepNumber(size.x) + "," + stepNumber(size.y));
        const int position = records_.axes(
            {frame.localDirection({1, 0, 0}), frame.localDirection({0, 1, 0}), {0, 0, 1}, frame.local(center)});
        return records_.add("IFCEXTRUDEDAREASOLID", stepReference(profile) + "," + stepReference(position) + "," +
                                                        stepReference(up) + "," + stepNumber(high - low));
    }
    // Along x the profile is in (y, z), along y in (z, x): both right-handed with the axis.
    std::string points;
    std::string first;
    for (std::size_t i = 0; i <= section.size(); ++i) {
        const std::size_t at = i % section.size();
        const SectionCorner& c = section[isAlongX ? at : section.size() - 1 - at];
        const std::string v = stepRatio(c.v, c.scale), z = stepRatio(c.z, c.scale);
        if (i == section.size()) {
            points += "," + first;
            break;
        }
        const std::string point = stepReference(isAlongX ? records_.point2(v, z) : records_.point2(z, v));
        if (i == 0) first = point;
        points += (i == 0 ? "" : ",") + point;
    }
    const int line = records_.add("IFCPOLYLINE", "(" + points + ")");
    const int profile = records_.add("IFCARBITRARYCLOSEDPROFILEDEF", ".AREA.,$," + stepReference(line));
    const Vec3d profileX = isAlongX ? Vec3d{0, 1, 0} : Vec3d{0, 0, 1};
    const int position = records_.axes({frame.localDirection(profileX), frame.localDirection(cross(along, profileX)),
                                        frame.localDirection(along), frame.local(along * double(piece.from))});
    return records_.add("IFCEXTRUDEDAREASOLID", stepReference(profile) + "," + stepReference(position) + "," +
                                                    stepReference(up) + "," +
                                                    stepNumber(double(piece.to - piece.from)));
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
        result = records_.add("IFCBOOLEANRESULT", std::string(solid.pieces[i].adds ? ".UNION.," : ".DIFFERENCE.,") +
                                                      stepReference(result) + "," + stepReference(piece));
    }
    style(result, solid.material);
    return result;
}

int IfcBodies::representation(const std::vector<int>& items, std::string_view type) {
    return records_.add("IFCSHAPEREPRESENTATION",
                        stepReference(context_) + ",'Body'," + stepText(type) + "," + stepList(items));
}

int IfcBodies::shape(const std::vector<int>& representations) {
    return records_.add("IFCPRODUCTDEFINITIONSHAPE", "$,$," + stepList(representations));
}

int IfcBodies::surfaceStyle(std::string_view name, const std::array<double, 3>& color, double transparency) {
    const int rgb = records_.shared(
        "IFCCOLOURRGB", "$," + stepNumber(color[0]) + "," + stepNumber(color[1]) + "," + stepNumber(color[2]));
    const int shading = records_.shared("IFCSURFACESTYLESHADING", stepReference(rgb) + "," + stepNumber(transparency));
    return records_.shared("IFCSURFACESTYLE", stepText(name) + ",.BOTH.,(" + stepReference(shading) + ")");
}

void IfcBodies::style(int item, Material material) {
    const MaterialInfo& shown = info(material);
    const int style = surfaceStyle(shown.name, shown.color, shown.transparency);
    records_.add("IFCSTYLEDITEM", stepReference(item) + ",(" + stepReference(style) + "),$");
}

}  // namespace svt::samples
