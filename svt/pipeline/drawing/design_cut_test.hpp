#pragma once
/// \file
/// What a horizontal plane cuts of a generated model, from the half-spaces of its design; for tests.

#include <svt/samples/sample.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace svt::test {

/// The area that a plane cuts of all components together, m2. The model must not be turned: at one height, the sides of all
/// pieces are then lines along x or y. Nothing begins or ends between two neighbouring lines, so one point tests a cell.
/// \param z       metres in the CRS
/// \param closed  also counts the walls that the plane cuts as they are at this height, where they have no openings; 0: no
/// \return the area; not a number where a side is slanted in plan
inline double designCut(const std::vector<samples::SampleComponent>& components, double z, double closed = 0) {
    std::vector<double> xs, ys;
    std::vector<const samples::SampleComponent*> cut;
    bool isSlanted = false;
    const auto addLinesAt = [&](const samples::SamplePiece& piece, double height) {
        for (const samples::HalfSpace& side : piece.sides) {
            const bool isAcrossX = std::abs(side.normal.x) > 1e-9, isAcrossY = std::abs(side.normal.y) > 1e-9;
            const double limit = side.offset - side.normal.z * height;
            if (!isAcrossX && !isAcrossY && limit < 0) return false;  // the piece is not at this height
            isSlanted = isSlanted || (isAcrossX && isAcrossY);
            if (isAcrossX) xs.push_back(limit / side.normal.x);
            if (isAcrossY) ys.push_back(limit / side.normal.y);
        }
        return true;
    };
    const auto addComponent = [&](const samples::SampleComponent& component, double height) {
        bool isCut = false;
        for (const auto& solid : component.solids)
            for (const samples::SamplePiece& piece : solid) isCut = (addLinesAt(piece, height) && piece.adds) || isCut;
        return isCut;
    };
    for (const samples::SampleComponent& component : components)
        if (addComponent(component, z)) cut.push_back(&component);
    std::vector<const samples::SampleComponent*> walls;
    for (const samples::SampleComponent* component : cut)
        if (closed > 0 && component->id.find("_wall_") != std::string::npos && addComponent(*component, closed))
            walls.push_back(component);
    if (isSlanted) return std::nan("");
    std::sort(xs.begin(), xs.end());
    std::sort(ys.begin(), ys.end());
    double area = 0;
    for (std::size_t i = 1; i < xs.size(); ++i)
        for (std::size_t j = 1; j < ys.size(); ++j) {
            const double width = xs[i] - xs[i - 1], depth = ys[j] - ys[j - 1];
            if (width < 1e-6 || depth < 1e-6) continue;
            const Vec3d middle{xs[i - 1] + 0.5 * width, ys[j - 1] + 0.5 * depth, z};
            const auto isIn = [&](const auto& list, double height) {
                return std::any_of(list.begin(), list.end(), [&](const samples::SampleComponent* component) {
                    return component->contains({middle.x, middle.y, height});
                });
            };
            if (isIn(cut, z) || isIn(walls, closed)) area += width * depth;
        }
    return area;
}

}  // namespace svt::test
