#pragma once
/// \file
/// The format-independent model of every generated file: components with solids, whose faces know their
/// neighbours. A plan is a whole house, or one storey of a tower that is used repeatedly.

#include <svt/core/attribute.hpp>
#include <svt/samples/parts/solid.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace svt::samples {

struct MaterialInfo {
    std::string_view name;
    std::array<double, 3> color;  ///< sRGB, 0..1
    double transparency;          ///< 0 opaque .. 1 invisible
    bool isColoredInGml;          ///< the polygons get an X3DMaterial
};
/// By material.
[[nodiscard]] std::span<const MaterialInfo> materials();
[[nodiscard]] inline const MaterialInfo& info(Material material) { return materials()[std::size_t(material)]; }

enum class Kind : std::uint8_t { Element, Room, Furniture, Installation, Window, Door, Storey, Unit };

/// CityGML 3.0 class name, such as "BuildingRoom".
[[nodiscard]] std::string_view className(Kind kind);

/// Role of an element for rooms and outer hull: all faces of a Wall towards a room are interior wall
/// surfaces, those of the others also floors and ceilings; outside, slabs count as walls.
enum class HullPart : std::uint8_t { Wall, Slab, Roof, Ground };

/// A planar face with holes; rings index into Plan::vertices, counter-clockwise seen from outside, not closed.
struct Face {
    std::vector<std::vector<std::uint32_t>> rings;
    int neighbor = -1;      ///< component on the other side, -1: outside (or a component that may overlap)
    int neighborFace = -1;  ///< the reversed face in `neighbor`, counted over all its solids; -1: none
};

/// One closed shell.
struct Shell {
    std::vector<Face> faces;
    Material material = Material::Air;
};

/// A shape in local coordinates, placed by quarter turns about z and a translation: world = turned(p) + shift.
struct Instance {
    Solid solid;
    int quarterTurns = 0;
    Point shift;
    Shell shell;                  ///< of `solid`, indices into `vertices`
    std::vector<Point> vertices;  ///< millimetres, local

    /// The direction of the shape's x axis.
    [[nodiscard]] Vec3d xAxis() const {
        return std::array<Vec3d, 4>{{{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}}}[std::size_t(quarterTurns)];
    }
};

struct Component {
    Kind kind = Kind::Element;
    std::string id;      ///< unique in the plan; files prepend the prefix of the building
    std::string mark{};  ///< number of a room, tag of an element; empty: the id. It stays if ids are renewed
    std::string name;
    std::string function;
    std::vector<Attribute> attributes;
    int parent = -1;  ///< room of furniture, wall of a window; -1: the building
    int storey = -1;  ///< component of Kind::Storey
    int unit = -1;    ///< component of Kind::Unit
    HullPart hullPart = HullPart::Wall;
    bool isOutside = false;            ///< an installation outside the building
    bool isStandIn = false;            ///< stand-in for a component of the storey above or below; not written
    std::vector<Solid> solids;         ///< disjoint; may touch
    std::optional<Instance> instance;  ///< same shape as solids[0]; CityGML 2.0 and CityJSON write it as a template
    std::vector<Shell> shells;         ///< of `solids`, filled by resolve()
    double volume = 0;                 ///< m3, filled by resolve()
    /// Whether the element has a side outside of the building; empty: hasOuterFace() tells. A hole to a cavity is an outer
    /// face of a neighbour that stays inside.
    std::optional<bool> isExternal;
};

/// True for components that fill the space of the building without overlap: elements, rooms, fillings.
/// Furniture and installations are inside rooms; units contain rooms.
[[nodiscard]] bool fillsSpace(const Component& component);

/// Whether a face of the resolved component has no neighbour.
[[nodiscard]] bool hasOuterFace(const Component& component);

/// True for components that storeys and units list as members: those owned by the building, and installations in rooms.
[[nodiscard]] bool isGrouped(const Component& component);

struct Plan {
    std::vector<Component> components;       ///< parents precede their children
    std::vector<Point> vertices;             ///< millimetres, filled by resolve()
    std::vector<std::vector<int>> children;  ///< by component; filled by resolve()
};

/// Adds a component and returns its index.
int addComponent(Plan& plan, Kind kind, std::string id, std::string name, int parent = -1);

/// Adds an element of one piece; its solid can be extended or cut later.
int addElement(Plan& plan, int storey, std::string id, std::string name, std::string function, Material material,
               Piece piece, HullPart part, bool isLoadBearing);

/// Adds a room of one piece.
int addRoom(Plan& plan, int storey, std::string id, std::string name, std::string function, Piece piece);

/// Adds an installation; `parent` is its room, or -1 for the building.
int addInstallation(Plan& plan, int storey, int parent, std::string id, std::string name, std::string function,
                    Solid solid);

/// Computes shells, volumes, vertices and children from the solids. Once per plan.
void resolve(Plan& plan);

/// Sum of cross products of the coordinates: twice the area along the outward normal, mm2.
[[nodiscard]] Vec3d normalOf(const Plan& plan, const Face& face);

/// The faces of a room towards one neighbour, as one boundary surface; openings are part of the surface of their wall.
struct BoundaryGroup {
    std::string_view
        type;  ///< FloorSurface, CeilingSurface, InteriorWallSurface, ClosureSurface; DoorSurface, WindowSurface
    int neighbor = -1;
    std::vector<int> faces;  ///< of the room's first shell
    std::vector<BoundaryGroup> openings;
};

/// Boundary surfaces of a room, ordered by type and neighbour.
[[nodiscard]] std::vector<BoundaryGroup> boundaryGroups(const Plan& plan, int room);

}  // namespace svt::samples
