#include <svt/validate/validate.hpp>

namespace svt::validate {
namespace {

struct Term {
    Code code;
    int val3dity;
    std::string_view iso;
};

// Codes of files and readers stand for val3dity's 9xx.
constexpr Term kTerms[] = {
    {Code::TooFewPoints, 101, "GM_Ring: at least three points"},
    {Code::RepeatedPoint, 102, "GM_Ring: points differ from the next"},
    {Code::RingNotClosed, 103, "GM_Ring: cycle (isCycle)"},
    {Code::SelfTouchingRing, 104, "GM_Ring: simple (isSimple)"},
    {Code::ZeroArea, 104, "GM_Ring: simple (isSimple)"},
    {Code::RingsIntersect, 201, "GM_Polygon: rings of the boundary do not cross"},
    {Code::DuplicateRing, 202, "GM_Polygon: rings of the boundary differ"},
    {Code::NonPlanar, 203, "GM_Polygon: spanning surface is a plane (distance)"},
    {Code::NormalsDeviate, 204, "GM_Polygon: spanning surface is a plane (normals)"},
    {Code::PolygonSplit, 205, "GM_Polygon: interior is connected"},
    {Code::InnerRingOutside, 206, "GM_SurfaceBoundary: interior ring within the exterior"},
    {Code::InnerRingsNested, 207, "GM_SurfaceBoundary: interior rings beside each other"},
    {Code::InnerRingTurnsAlike, 208, "GM_SurfaceBoundary: interior rings opposed to the exterior"},
    {Code::TooFewFaces, 301, "GM_Shell: closed (isCycle)"},
    {Code::ShellNotClosed, 302, "GM_Shell: closed (isCycle)"},
    {Code::TJunction, 302, "GM_Shell: closed (isCycle)"},
    {Code::NonManifold, 303, "GM_Shell: simple (2-manifold)"},
    {Code::ShellDisconnected, 305, "GM_Shell: connected"},
    {Code::ShellSelfIntersects, 306, "GM_Shell: simple (isSimple)"},
    {Code::FaceTurnedOver, 307, "GM_OrientableSurface: orientation consistent"},
    {Code::ShellsIntersect, 401, "GM_SolidBoundary: shells do not cross"},
    {Code::DuplicateShell, 402, "GM_SolidBoundary: shells differ"},
    {Code::InnerShellOutside, 403, "GM_SolidBoundary: interior shell within the exterior"},
    {Code::SolidSplit, 404, "GM_Solid: interior is connected"},
    {Code::ShellTurnedOver, 405, "GM_SolidBoundary: upward normals look away from the solid"},
    {Code::SolidsIntersect, 501, "GM_CompositeSolid: interiors are disjoint"},
    {Code::DuplicateSolid, 502, "GM_CompositeSolid: solids differ"},
    {Code::SolidsDisconnected, 503, "GM_CompositeSolid: connected by common faces"},
    {Code::PartsOverlap, 601, "CityGML: parts of a building have disjoint interiors"},
    {Code::CellsOverlap, 701, "IndoorGML: cell spaces of a layer have disjoint interiors"},
    {Code::StateOutsideCell, 702, "IndoorGML: the state lies in its cell space"},
    {Code::DualityBroken, 703, "IndoorGML: duality and connections refer to each other"},
    {Code::CellsNotAdjacent, 704, "IndoorGML: transitions join adjacent cell spaces"},
    {Code::CannotOpen, 901, {}},
    {Code::BadXml, 901, {}},
    {Code::BadJson, 901, {}},
    {Code::BadEncoding, 901, {}},
    {Code::BadIndex, 901, {}},
    {Code::EmptyModel, 902, {}},
    {Code::NoGeometry, 902, {}},
    {Code::BadArgument, 903, {}},
    {Code::UnknownFormat, 904, {}},
    {Code::UnknownVersion, 904, {}},
    {Code::Internal, 999, {}},
};

// As in val3dity's documentation, without its 300 (a shell with an unknown error): here every error is known.
struct Name {
    int code;
    std::string_view name;
};
constexpr Name kNames[] = {
    {101, "TOO_FEW_POINTS"},
    {102, "CONSECUTIVE_POINTS_SAME"},
    {103, "RING_NOT_CLOSED"},
    {104, "RING_SELF_INTERSECTION"},
    {201, "INTERSECTION_RINGS"},
    {202, "DUPLICATED_RINGS"},
    {203, "NON_PLANAR_POLYGON_DISTANCE_PLANE"},
    {204, "NON_PLANAR_POLYGON_NORMALS_DEVIATION"},
    {205, "POLYGON_INTERIOR_DISCONNECTED"},
    {206, "INNER_RING_OUTSIDE"},
    {207, "INNER_RINGS_NESTED"},
    {208, "ORIENTATION_RINGS_SAME"},
    {301, "TOO_FEW_POLYGONS"},
    {302, "SHELL_NOT_CLOSED"},
    {303, "NON_MANIFOLD_CASE"},
    {305, "MULTIPLE_CONNECTED_COMPONENTS"},
    {306, "SHELL_SELF_INTERSECTION"},
    {307, "POLYGON_WRONG_ORIENTATION"},
    {401, "INTERSECTION_SHELLS"},
    {402, "DUPLICATED_SHELLS"},
    {403, "INNER_SHELL_OUTSIDE"},
    {404, "SOLID_INTERIOR_DISCONNECTED"},
    {405, "WRONG_ORIENTATION_SHELL"},
    {501, "INTERSECTION_SOLIDS"},
    {502, "DUPLICATED_SOLIDS"},
    {503, "DISCONNECTED_SOLIDS"},
    {601, "BUILDINGPARTS_OVERLAP"},
    {701, "CELLS_OVERLAP"},
    {702, "DUAL_VERTEX_OUTSIDE_CELL"},
    {703, "PRIMAL_DUAL_XLINKS_ERROR"},
    {704, "PRIMAL_DUAL_ADJACENCIES_INCONSISTENT"},
    {901, "INVALID_INPUT_FILE"},
    {902, "EMPTY_PRIMITIVE"},
    {903, "WRONG_INPUT_PARAMETERS"},
    {904, "FORMAT_NOT_SUPPORTED"},
    {999, "UNKNOWN_ERROR"},
};

const Term* termOf(Code code) noexcept {
    for (const Term& term : kTerms)
        if (term.code == code) return &term;
    return nullptr;
}

}  // namespace

int val3dityCode(Code code) noexcept {
    const Term* term = termOf(code);
    return term == nullptr ? 0 : term->val3dity;
}

std::string_view val3dityName(int val3dityCode) noexcept {
    for (const Name& name : kNames)
        if (name.code == val3dityCode) return name.name;
    return {};
}

std::string_view isoTerm(Code code) noexcept {
    const Term* term = termOf(code);
    return term == nullptr ? std::string_view() : term->iso;
}

std::string_view primitiveType(const model::Geometry& geometry) noexcept {
    if (geometry.kind == model::GeometryKind::Surface)
        return geometry.isComposite ? "CompositeSurface" : "MultiSurface";
    if (geometry.isComposite) return "CompositeSolid";
    return geometry.solids.size() == 1 ? "Solid" : "MultiSolid";
}

}  // namespace svt::validate
