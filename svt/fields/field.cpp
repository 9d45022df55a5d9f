#include <svt/fields/field.hpp>

namespace svt::fields {

std::size_t placeCount(const FieldHead& head, std::size_t labelCount) noexcept {
    switch (head.kind) {
        case FieldKind::Grid:
            return static_cast<std::size_t>(head.lattice.size.x) * static_cast<std::size_t>(head.lattice.size.y) *
                   static_cast<std::size_t>(head.lattice.size.z);
        case FieldKind::Label: return labelCount;
        case FieldKind::Points: return head.points.size();
    }
    return 0;
}

}  // namespace svt::fields
