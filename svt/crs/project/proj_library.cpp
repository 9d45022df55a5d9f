#include <svt/crs/project/proj_library.hpp>

#include <svt/core/machine.hpp>
#include <svt/core/text.hpp>
#include <svt/crs/project/way.hpp>

#include <fmt/format.h>
#include <proj.h>

#include <cmath>
#include <limits>
#include <memory>
#include <mutex>

namespace svt::crs {
namespace project {
namespace {

// PROJ's functions, under PROJ's names. The library is loaded on first use and not linked: with its 34 dependencies,
// every command would start 8 ms later, and few models need it.
struct Proj {
    decltype(&::proj_context_create) context_create = nullptr;
    decltype(&::proj_context_destroy) context_destroy = nullptr;
    decltype(&::proj_context_set_enable_network) context_set_enable_network = nullptr;
    decltype(&::proj_log_level) log_level = nullptr;
    decltype(&::proj_create) create = nullptr;
    decltype(&::proj_create_from_database) create_from_database = nullptr;
    decltype(&::proj_destroy) destroy = nullptr;
    decltype(&::proj_get_type) get_type = nullptr;
    decltype(&::proj_crs_get_sub_crs) crs_get_sub_crs = nullptr;
    decltype(&::proj_crs_get_coordinate_system) crs_get_coordinate_system = nullptr;
    decltype(&::proj_cs_get_axis_count) cs_get_axis_count = nullptr;
    decltype(&::proj_cs_get_axis_info) cs_get_axis_info = nullptr;
    decltype(&::proj_get_name) get_name = nullptr;
    decltype(&::proj_get_id_code) get_id_code = nullptr;
    decltype(&::proj_crs_get_geodetic_crs) crs_get_geodetic_crs = nullptr;
    decltype(&::proj_create_crs_to_crs_from_pj) create_crs_to_crs_from_pj = nullptr;
    decltype(&::proj_normalize_for_visualization) normalize_for_visualization = nullptr;
    decltype(&::proj_trans) trans = nullptr;
    decltype(&::proj_trans_generic) trans_generic = nullptr;
    decltype(&::proj_as_projjson) as_projjson = nullptr;
    decltype(&::proj_as_wkt) as_wkt = nullptr;
    decltype(&::proj_get_area_of_use) get_area_of_use = nullptr;
    decltype(&::proj_info) info = nullptr;
};

Result<Proj> loadProj() {
    const Result<SharedLibrary> library = SharedLibrary::load(SVT_PROJ_LIBRARY);
    if (!library) return library.error();
    Proj proj;
    const auto find = [&](const char* name, auto& function) { return library->find(name, function); };
    const bool isWhole =
        find("proj_context_create", proj.context_create) && find("proj_context_destroy", proj.context_destroy) &&
        find("proj_context_set_enable_network", proj.context_set_enable_network) &&
        find("proj_log_level", proj.log_level) && find("proj_create", proj.create) &&
        find("proj_create_from_database", proj.create_from_database) && find("proj_destroy", proj.destroy) &&
        find("proj_get_type", proj.get_type) && find("proj_crs_get_sub_crs", proj.crs_get_sub_crs) &&
        find("proj_crs_get_coordinate_system", proj.crs_get_coordinate_system) &&
        find("proj_cs_get_axis_count", proj.cs_get_axis_count) &&
        find("proj_cs_get_axis_info", proj.cs_get_axis_info) && find("proj_get_name", proj.get_name) &&
        find("proj_get_id_code", proj.get_id_code) && find("proj_crs_get_geodetic_crs", proj.crs_get_geodetic_crs) &&
        find("proj_create_crs_to_crs_from_pj", proj.create_crs_to_crs_from_pj) &&
        find("proj_normalize_for_visualization", proj.normalize_for_visualization) && find("proj_trans", proj.trans) &&
        find("proj_trans_generic", proj.trans_generic) && find("proj_as_projjson", proj.as_projjson) &&
        find("proj_as_wkt", proj.as_wkt) && find("proj_get_area_of_use", proj.get_area_of_use) &&
        find("proj_info", proj.info);
    if (!isWhole) return Error(Code::CannotOpen, SVT_PROJ_LIBRARY " lacks functions of PROJ");
    return proj;
}

const Result<Proj>& loadedProj() {
    static const Result<Proj> proj = loadProj();
    return proj;
}

// Requires that checkLoaded() found the library.
const Proj& proj() { return *loadedProj(); }

Result<void> checkLoaded(int code) {
    if (loadedProj()) return {};
    return Error(Code::CannotProject,
                 fmt::format("EPSG:{} needs the PROJ library ({}); install it (Debian: libproj25), or project the file "
                             "first",
                             code, loadedProj().error().message()));
}

struct ContextDeleter {
    void operator()(PJ_CONTEXT* context) const noexcept { proj().context_destroy(context); }
};
using Context = std::unique_ptr<PJ_CONTEXT, ContextDeleter>;
struct ObjectDeleter {
    void operator()(PJ* object) const noexcept { proj().destroy(object); }
};
using Object = std::unique_ptr<PJ, ObjectDeleter>;

// Without network: grids that are not installed are left out, and the result does not depend on a connection.
Context makeContext() {
    Context context(proj().context_create());
    proj().context_set_enable_network(context.get(), 0);
    proj().log_level(context.get(), PJ_LOG_NONE);
    return context;
}

Object makeCrs(const Context& context, int code) {
    return Object(
        proj().create_from_database(context.get(), "EPSG", std::to_string(code).c_str(), PJ_CATEGORY_CRS, 0, nullptr));
}

// A compound with the code of heights, unless `vertical` is 0.
Object makeCrs(const Context& context, int horizontal, int vertical) {
    if (vertical == 0) return makeCrs(context, horizontal);
    return Object(proj().create(context.get(), fmt::format("EPSG:{}+{}", horizontal, vertical).c_str()));
}

Error notKnown(const Context& context, int code, Code kind) {
    if (makeCrs(context, 4326))
        return {kind, fmt::format("EPSG:{} is not a reference system known to PROJ {}", code, projVersion())};
    return {Code::CannotProject,
            "PROJ cannot find its data (proj.db); install them (Debian: proj-data) or name their "
            "folder in PROJ_LIB"};
}

// The horizontal part of a compound; any other reference system is returned unchanged.
Object horizontalOf(const Context& context, Object crs) {
    if (proj().get_type(crs.get()) != PJ_TYPE_COMPOUND_CRS) return crs;
    return Object(proj().crs_get_sub_crs(context.get(), crs.get(), 0));
}

// Metres per unit of both axes; 0 if the axes are not two lengths in the same unit.
double metresPerUnitOf(const Context& context, const Object& crs) {
    const Object axes(proj().crs_get_coordinate_system(context.get(), crs.get()));
    if (!axes || proj().cs_get_axis_count(context.get(), axes.get()) < 2) return 0;
    double factors[2] = {0, 0};
    for (int axis = 0; axis < 2; ++axis) {
        const char* code = nullptr;
        if (proj().cs_get_axis_info(context.get(), axes.get(), axis, nullptr, nullptr, nullptr, &factors[axis], nullptr,
                                    nullptr, &code) == 0)
            return 0;
    }
    return factors[0] == factors[1] ? factors[0] : 0;
}

Result<void> checkMetres(const Context& context, const Object& crs, int code) {
    if (proj().get_type(crs.get()) != PJ_TYPE_PROJECTED_CRS)
        return Error(Code::BadArgument, fmt::format("EPSG:{} ({}) is not a projection; name one in metres, such as the "
                                                    "UTM zone of the place",
                                                    code, proj().get_name(crs.get())));
    if (metresPerUnitOf(context, crs) != 1)
        return Error(Code::BadArgument,
                     fmt::format("EPSG:{} ({}) is not in metres; name a projection in metres, such as "
                                 "the UTM zone of the place",
                                 code, proj().get_name(crs.get())));
    return {};
}

class ProjWay final : public Projection::Way {
public:
    ProjWay(Context context, Object operation) : context_(std::move(context)), operation_(std::move(operation)) {}

    void apply(std::span<Vec3d> points) const override {
        if (points.empty()) return;
        const std::lock_guard guard(mutex_);
        // PROJ reads and writes x and y; heights stay unchanged.
        proj().trans_generic(operation_.get(), PJ_FWD, &points[0].x, sizeof(Vec3d), points.size(), &points[0].y,
                             sizeof(Vec3d), points.size(), nullptr, 0, 0, nullptr, 0, 0);
        constexpr double kSteps = 1 << 20;
        for (Vec3d& point : points) {
            // To a micrometre: below that, mathematical libraries differ from machine to machine.
            point.x = std::isfinite(point.x) ? std::round(point.x * kSteps) / kSteps
                                             : std::numeric_limits<double>::quiet_NaN();
            point.y = std::isfinite(point.y) ? std::round(point.y * kSteps) / kSteps
                                             : std::numeric_limits<double>::quiet_NaN();
        }
    }

private:
    Context context_;
    Object operation_;
    mutable std::mutex mutex_;
};

}  // namespace

Result<Projection> projBetween(int source, int target) {
    if (Result<void> loaded = checkLoaded(source); !loaded) return loaded.error();
    Context context = makeContext();
    const Object to = makeCrs(context, target);
    if (!to) return notKnown(context, target, Code::BadArgument);
    if (Result<void> checked = checkMetres(context, to, target); !checked) return checked.error();
    Object from = makeCrs(context, source);
    if (!from) return notKnown(context, source, Code::CannotProject);
    from = horizontalOf(context, std::move(from));
    Object operation(proj().create_crs_to_crs_from_pj(context.get(), from.get(), to.get(), nullptr, nullptr));
    if (operation) operation.reset(proj().normalize_for_visualization(context.get(), operation.get()));
    if (!operation)
        return Error(Code::CannotProject,
                     fmt::format("PROJ knows no conversion from EPSG:{} ({}) to EPSG:{} ({}) without further files",
                                 source, proj().get_name(from.get()), target, proj().get_name(to.get())));
    std::string name = proj().get_name(to.get());
    const double unit = proj().get_type(from.get()) == PJ_TYPE_PROJECTED_CRS ? metresPerUnitOf(context, from) : 1;
    return Projection(target, std::move(name), unit,
                      std::make_shared<const ProjWay>(std::move(context), std::move(operation)));
}

Result<PlaceInDegrees> placeInDegrees(int source, Vec3d place) {
    if (Result<void> loaded = checkLoaded(source); !loaded) return loaded.error();
    Context context = makeContext();
    Object from = makeCrs(context, source);
    if (!from) return notKnown(context, source, Code::CannotProject);
    from = horizontalOf(context, std::move(from));
    const Object degrees(proj().crs_get_geodetic_crs(context.get(), from.get()));
    const char* const code = degrees ? proj().get_id_code(degrees.get(), 0) : nullptr;
    const Object world = makeCrs(context, 4326);
    Object operation(world ? proj().create_crs_to_crs_from_pj(context.get(), from.get(), world.get(), nullptr, nullptr)
                           : nullptr);
    if (operation) operation.reset(proj().normalize_for_visualization(context.get(), operation.get()));
    if (!operation || code == nullptr) return notKnown(context, source, Code::CannotProject);
    const PJ_COORD there = proj().trans(operation.get(), PJ_FWD, PJ_COORD{{place.x, place.y, 0, 0}});
    return PlaceInDegrees{parseInteger<int>(code).value_or(0), {there.xy.x, there.xy.y, 0}};
}

std::optional<Box3d> projAreaOf(int epsg) {
    if (!loadedProj()) return std::nullopt;
    const Context context = makeContext();
    const Object crs = makeCrs(context, epsg);
    Box3d area;
    const bool isKnown = crs && proj().get_area_of_use(context.get(), crs.get(), &area.min.x, &area.min.y, &area.max.x,
                                                       &area.max.y, nullptr) != 0;
    return isKnown && area.min.y > -1000 ? std::optional(area) : std::nullopt;
}

std::optional<double> projGeoidHeight(int epsg, int vertical, Vec3d place) {
    if (!loadedProj()) return std::nullopt;
    const Context context = makeContext();
    const Object from = makeCrs(context, epsg, vertical), world = makeCrs(context, 4979);
    if (!from || !world) return std::nullopt;
    Object operation(proj().create_crs_to_crs_from_pj(context.get(), from.get(), world.get(), nullptr, nullptr));
    if (operation) operation.reset(proj().normalize_for_visualization(context.get(), operation.get()));
    if (!operation) return std::nullopt;
    const PJ_COORD there = proj().trans(operation.get(), PJ_FWD, PJ_COORD{{place.x, place.y, 0, 0}});
    // Without the grid, PROJ leaves heights as they are.
    constexpr double kUnchanged = 1e-6;
    if (!std::isfinite(there.xyz.z) || std::abs(there.xyz.z) < kUnchanged) return std::nullopt;
    return there.xyz.z;
}

}  // namespace project

std::string projVersion() { return project::loadedProj() ? project::proj().info().version : std::string(); }

std::string projJsonOf(int epsg, int vertical) {
    if (!project::loadedProj()) return {};
    const project::Context context = project::makeContext();
    const project::Object crs = project::makeCrs(context, epsg, vertical);
    const char* const options[] = {"MULTILINE=NO", nullptr};
    const char* const text = crs ? project::proj().as_projjson(context.get(), crs.get(), options) : nullptr;
    return text != nullptr ? text : "";
}

std::string wktOf(int epsg, int vertical) {
    if (!project::loadedProj()) return {};
    const project::Context context = project::makeContext();
    const project::Object crs = project::makeCrs(context, epsg, vertical);
    const char* const options[] = {"MULTILINE=NO", nullptr};
    const char* const text = crs ? project::proj().as_wkt(context.get(), crs.get(), PJ_WKT2_2019, options) : nullptr;
    return text != nullptr ? text : "";
}

}  // namespace svt::crs
