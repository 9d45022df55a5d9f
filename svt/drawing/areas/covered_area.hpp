#pragma once
/// \file
/// The area that components of several horizontal sections cover together.

#include <svt/drawing/section_drawing.hpp>
#include <svt/plane/arrangement.hpp>

#include <optional>
#include <vector>

namespace svt::drawing {

/// Adds up polygons, and counts their common parts once. All drawings must have the same axes u and v, and origins on
/// one line along the normal.
class CoveredArea {
public:
    /// \param component  of `drawing`
    void add(const SectionComponent& component, const SectionDrawing& drawing);

    /// Square metres; nothing if plane::arrangeSegments() returns nothing.
    [[nodiscard]] std::optional<double> get() const;

private:
    struct Part {
        const SectionComponent* component;
        std::uint32_t claim;  // one per drawing
    };
    std::vector<Part> parts_;
    std::vector<const SectionDrawing*> drawings_;
};

}  // namespace svt::drawing
