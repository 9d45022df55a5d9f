#include <svt/readers/ifc_schema/entities.hpp>

#include <svt/core/text.hpp>

#include <iterator>

namespace svt::readers::ifc {
namespace {

using std::string_view;

// The macro joins the prefix to each name.
// NOLINTBEGIN(bugprone-suspicious-missing-comma)
constexpr string_view kNames[] = {"Other",
#define E(name, ...) "Ifc" #name,
                                  SVT_IFC_ENTITIES(E)
#undef E
};
// NOLINTEND(bugprone-suspicious-missing-comma)

}  // namespace

string_view entityName(Entity entity) noexcept { return kNames[static_cast<std::size_t>(entity)]; }

Entity entityNamed(string_view typeName) noexcept {
    // The curve of IFC2x3. A name in C++ does not begin with a digit.
    if (equalsIgnoringCase(typeName, "Ifc2DCompositeCurve")) return Entity::CompositeCurve;
    for (std::size_t i = 1; i < std::size(kNames); ++i)
        if (equalsIgnoringCase(kNames[i], typeName)) return static_cast<Entity>(i);
    return Entity::Other;
}

}  // namespace svt::readers::ifc
