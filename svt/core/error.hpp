#pragma once
/// \file
/// Errors: a stable code, a place, and a message with the problem, the expected input and the remedy. Each code has a
/// page in docs/errors/.

#include <cstdint>
#include <string>
#include <string_view>

namespace svt {

/// Stable codes, grouped: 1xx read, 2xx geometry, 3xx voxel, 4xx volume, 5xx render, 6xx cities, 7xx fields,
/// 9xx program. The meaning of a code never changes.
enum class Code : std::uint16_t {
    // 1xx: reading a model
    CannotOpen = 101,         ///< file missing or unreadable
    BadXml = 102,             ///< not well-formed XML
    UnknownFormat = 103,      ///< not a supported format
    InputTooBig = 104,        ///< over a stated limit (bytes, depth, count)
    BadJson = 105,            ///< not well-formed JSON, or not the expected structure
    UnknownVersion = 106,     ///< unsupported version of the format
    DtdRefused = 107,         ///< a DOCTYPE or entity declaration in XML
    BadEncoding = 108,        ///< invalid UTF-8 (or invalid in the declared encoding)
    EmptyModel = 109,         ///< no feature with geometry
    DanglingReference = 110,  ///< an XLink, child or template reference without target
    ReferenceCycle = 111,     ///< circular references
    DuplicateId = 112,        ///< the same id used twice
    MissingId = 113,          ///< a feature without id; its path becomes its id
    BadValue = 114,           ///< a number, code or attribute that cannot be interpreted
    ExternalReference = 115,  ///< a reference to another file or host; never fetched
    UnknownElement = 116,     ///< an unknown element or type; skipped
    MixedCrs = 117,           ///< parts of one model in different CRSs
    GeographicCrs = 118,      ///< coordinates in degrees; projected if the CRS is known
    BadIndex = 119,           ///< a vertex, material or template index out of range
    ForeignUnit = 120,        ///< coordinates in feet or another unit that is not the metre
    CannotProject = 121,      ///< coordinates that cannot be converted to another CRS
    FarFeature = 122,         ///< a feature far away from all others; left out
    NoHeights = 123,          ///< coordinates of two numbers: heights are missing
    DualityBroken = 124,      ///< contradictory links between cell spaces, states and transitions
    AxisOrder = 125,          ///< the order of the axes: the order taken, or a doubt about it
    MapScale = 126,           ///< a projection that shows lengths far from their true size
    UnitInDoubt = 127,        ///< coordinates that do not look like metres, in a file without a unit
    FeatureEnded = 128,       ///< a feature that does not exist at the date that is read; left out
    OutsideArea = 129,        ///< coordinates outside of the area in which their CRS is used
    BadStep = 130,            ///< not a STEP file (ISO 10303-21), or one without records
    BadRecord = 131,          ///< a record of a STEP file that cannot be read; left out
    ReadInPart = 132,         ///< a product without a part of its shape or an opening that was not read
    ShapeNotRead = 133,       ///< a product whose shape could not be read
    ProductsRead = 134,       ///< number of products read, and of those with missing parts
    LayersNotSplit = 135,     ///< a product not split into its material layers, or not as its file specifies
    LayersSplit = 136,        ///< number of products split into their material layers
    Truncated = 137,          ///< a truncated file: it ends before its last part
    // 2xx: geometry
    TooFewPoints = 201,         ///< a ring of fewer than three distinct points
    BadCoordinate = 202,        ///< NaN, infinite or absurdly large coordinate
    ZeroArea = 203,             ///< a face without area
    DuplicateFace = 204,        ///< the same face twice in one shell
    SelfTouchingRing = 205,     ///< a ring that touches or crosses itself
    NonPlanar = 206,            ///< a polygon further from its plane than the tolerance
    ShellNotClosed = 207,       ///< open edges: the shell is not closed
    TJunction = 208,            ///< edges that match only up to T-junctions; geometrically tight
    ShellCapped = 209,          ///< open shell closed by planar caps (ClosureSurface)
    WindingFilled = 210,        ///< open shell filled by generalized winding number
    FaceFlipped = 211,          ///< faces reoriented
    TriangulationFailed = 212,  ///< a polygon that could not be triangulated; left out
    NoGeometry = 213,           ///< a feature without the geometry expected of it
    FacesComplemented = 214,    ///< open shell completed with faces of adjoining objects
    VolumeDiffers = 215,        ///< an object with more or less volume in voxels than in its shell
    RepeatedPoint = 220,        ///< a point of a ring that equals the point before it
    RingNotClosed = 221,        ///< a ring whose last point is not its first
    RingsIntersect = 222,       ///< rings of a polygon that cross or share a line
    DuplicateRing = 223,        ///< the same ring twice in a polygon
    NormalsDeviate = 224,       ///< a polygon folded by more than the tolerance
    PolygonSplit = 225,         ///< touching rings that divide the interior of their polygon
    InnerRingOutside = 226,     ///< an interior ring outside of the exterior one
    InnerRingsNested = 227,     ///< an interior ring within another
    InnerRingTurnsAlike = 228,  ///< an interior ring with the same direction as the exterior ring
    TooFewFaces = 229,          ///< a shell of fewer than four faces
    NonManifold = 230,          ///< an edge with more than two faces, or parts that meet only in a point
    ShellDisconnected = 231,    ///< a shell of several disconnected pieces
    ShellSelfIntersects = 232,  ///< faces of a shell that intersect
    FaceTurnedOver = 233,       ///< a face with the opposite orientation to its neighbours
    ShellsIntersect = 234,      ///< shells of a solid that intersect or share a face
    DuplicateShell = 235,       ///< the same interior shell twice in a solid
    InnerShellOutside = 236,    ///< an interior shell outside of the exterior one
    SolidSplit = 237,           ///< touching shells that divide the interior of their solid
    ShellTurnedOver = 238,      ///< an exterior shell facing inwards, or an interior shell facing out of its void
    SolidsIntersect = 239,      ///< solids of a composite that overlap
    DuplicateSolid = 240,       ///< the same solid twice in a composite
    SolidsDisconnected = 241,   ///< solids of a composite that share no face
    PartsOverlap = 242,         ///< parts of a building that overlap
    CellsOverlap = 243,         ///< cell spaces of one layer that overlap
    StateOutsideCell = 244,     ///< a state that does not lie in its cell space
    CellsNotAdjacent = 245,     ///< a transition between cell spaces that do not touch
    UnitsOverlap = 246,         ///< legal units that overlap
    StoreyGap = 247,            ///< space of a storey that no unit or other feature claims
    UnitNotReached = 248,       ///< a legal unit that no common part reaches
    // 3xx: voxels
    BadDimension = 301,   ///< grid dimension or spacing out of range
    GridTooLarge = 302,   ///< over the limits of a grid
    TooManyLabels = 303,  ///< more labels than a volume can number
    BadPattern = 304,     ///< a spatial pattern that cannot be used
    BadStyle = 305,       ///< a style file that does not follow its schema
    ThinObject = 306,     ///< an object thinner than a voxel, kept by a surface pass
    Overlap = 307,        ///< two objects claim the same voxels
    // 4xx: volumes and files
    BadVolume = 401,      ///< not a .svt file, or damaged
    BadChecksum = 402,    ///< CRC32 of an entry does not match
    VolumeVersion = 403,  ///< written by a newer version
    CannotWrite = 404,    ///< output cannot be written
    DiskFull = 405,       ///< no space left for the output
    BadImage = 406,       ///< an image or raw file that cannot be read
    BadNrrd = 407,        ///< not a readable NRRD file
    WouldDestroy = 408,   ///< an output would replace an input, another output or a file of another kind
    // 5xx: pictures
    BadCamera = 501,           ///< up parallel to view, or field of view out of range
    BadFrame = 502,            ///< picture size or plane out of range
    BadSection = 503,          ///< a plane, region or lens that cannot be used
    BadScene = 504,            ///< a scene file that does not follow its schema
    NoGraphics = 505,          ///< no graphics context, or one without the required features
    UncertainArea = 506,       ///< the bound of a cut area is larger than the area
    PlaneInFaces = 507,        ///< a section plane lies in faces of the model
    DrawnByVoxels = 508,       ///< a cut object drawn from its voxels, next to exact objects
    NoMeshes = 509,            ///< lines beyond a cut requested from a volume without meshes
    NoCairo = 510,             ///< no cairo library, so no PDF
    BadSheets = 511,           ///< a file of sheets that does not follow its schema
    StoreyLevelDiffers = 512,  ///< the declared level of a storey contradicts its rooms or slabs
    NetExceedsGross = 513,     ///< the rooms of a level have more area than its gross floor area
    RoomsShareSpace = 514,     ///< rooms of a level overlap, or are zones; their sums count shared space once
    // 6xx: cities
    BadPlan = 601,         ///< not the plan of a city, or a damaged one
    PlanVersion = 602,     ///< a plan that another version of the program wrote
    BadPack = 603,         ///< a damaged pack of a city, or a damaged member of it
    BadCity = 604,         ///< a damaged index of a city
    CityIncomplete = 605,  ///< a city with unfinished tasks
    FeatureSkipped = 606,  ///< a feature left out of a city
    LinkedFeature = 607,   ///< a feature with references to content of another feature; read without this content
    InputChanged = 608,    ///< an input file that changed after planning
    TaskFailed = 609,      ///< a task of a city that failed
    Replica = 610,         ///< a feature with the same id and content as an earlier one
    IdConflict = 611,      ///< a feature with the id of a feature of an earlier file, but other content
    ManySkipped = 612,     ///< a plan that would leave out more features than allowed
    // 7xx: fields
    BadField = 701,         ///< a field, or a file with one, that cannot be read or is not valid
    UnknownField = 702,     ///< a name that no field of the volume has
    FieldOutside = 703,     ///< a field that covers no part of the volume
    FieldInPart = 704,      ///< a file whose last values are missing or were left out
    UnknownMaterial = 705,  ///< components without known thermal properties; defaults assumed
    AirLeak = 706,          ///< a room that is connected with the outside through a gap
    NotConverged = 707,     ///< a simulation that did not reach its tolerance
    // 9xx: program
    BadQuery = 901,         ///< a query that cannot be parsed
    NothingSelected = 902,  ///< a query that selects nothing
    Cancelled = 903,        ///< the caller asked to stop
    BadArgument = 904,      ///< an argument out of range
    BadDefaults = 905,      ///< a file with defaults of options that cannot be used
    Internal = 999,         ///< a defect of the program
};

/// Name of a code as in the enum, such as "ShellNotClosed".
[[nodiscard]] std::string_view codeName(Code code) noexcept;

/// The code as a tag: "E207".
[[nodiscard]] std::string codeTag(Code code);

/// Location of a finding in the input. Empty parts are unknown.
struct Place {
    std::string file;          ///< path or name as the caller gave it
    std::uint64_t line = 0;    ///< 1-based; 0: unknown
    std::uint64_t column = 0;  ///< 1-based; 0: unknown; shown only after a line
    std::string id;            ///< gml:id or CityJSON id of the feature or geometry

    /// "house.gml:12:5 (id 'wall-3')", or empty.
    [[nodiscard]] std::string toString() const;
};

/// A problem with its place and its remedy.
class Error {
public:
    Error() = default;
    Error(Code code, std::string message, Place where = {})
        : code_(code), message_(std::move(message)), where_(std::move(where)) {}

    [[nodiscard]] Code code() const noexcept { return code_; }
    [[nodiscard]] const std::string& message() const noexcept { return message_; }
    [[nodiscard]] const Place& where() const noexcept { return where_; }

    /// "E102 BadXml: house.gml:12:5: <message>"
    [[nodiscard]] std::string toString() const;

private:
    Code code_ = Code::Internal;
    std::string message_;
    Place where_;
};

/// Stops the program: the value of a Result was requested, but the Result holds `error`.
[[noreturn]] void valueMissing(const Error& error) noexcept;
/// Stops the program: the error of a Result was requested, but the Result holds a value.
[[noreturn]] void errorMissing() noexcept;

}  // namespace svt
