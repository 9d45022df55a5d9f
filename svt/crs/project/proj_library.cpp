#include <svt/crs/project/proj_library.hpp>

#include <svt/crs/project/way.hpp>

#include <fmt/format.h>
#include <proj.h>

#include <cmath>
#include <limits>
#include <memory>
#include <mutex>

namespace svt::crs {

std::string projVersion() {
    return fmt::format("{}.{}.{}", PROJ_VERSION_MAJOR, PROJ_VERSION_MINOR, PROJ_VERSION_PATCH);
}

namespace project {
namespace {

struct ContextDeleter {
    void operator()(PJ_CONTEXT* context) const noexcept { proj_context_destroy(context); }
};
using Context = std::unique_ptr<PJ_CONTEXT, ContextDeleter>;
struct ObjectDeleter {
    void operator()(PJ* object) const noexcept { proj_destroy(object); }
};
using Object = std::unique_ptr<PJ, ObjectDeleter>;

// Without network: grids that are not installed are left out, and the result does not depend on who is connected.
Context makeContext() {
    Context context(proj_context_create());
    proj_context_set_enable_network(context.get(), 0);
    proj_log_level(context.get(), PJ_LOG_NONE);
    return context;
}

Object makeCrs(const Context& context, int code) {
    return Object(
        proj_create_from_database(context.get(), "EPSG", std::to_string(code).c_str(), PJ_CATEGORY_CRS, 0, nullptr));
}

Error notKnown(const Context& context, int code, Code kind) {
    if (makeCrs(context, 4326))
        return {kind, fmt::format("EPSG:{} is no reference system that PROJ {} knows", code, projVersion())};
    return {Code::CannotProject,
            "PROJ finds none of its data (proj.db); install it (Debian: proj-data) or name its "
            "folder in PROJ_LIB"};
}

// The horizontal part of a compound; what is none stays.
Object horizontalOf(const Context& context, Object crs) {
    if (proj_get_type(crs.get()) != PJ_TYPE_COMPOUND_CRS) return crs;
    return Object(proj_crs_get_sub_crs(context.get(), crs.get(), 0));
}

// Metres in a unit of both axes; 0 for what is no pair of lengths.
double metresPerUnitOf(const Context& context, const Object& crs) {
    const Object axes(proj_crs_get_coordinate_system(context.get(), crs.get()));
    if (!axes || proj_cs_get_axis_count(context.get(), axes.get()) < 2) return 0;
    double factors[2] = {0, 0};
    for (int axis = 0; axis < 2; ++axis) {
        const char* code = nullptr;
        if (proj_cs_get_axis_info(context.get(), axes.get(), axis, nullptr, nullptr, nullptr, &factors[axis], nullptr,
                                  nullptr, &code) == 0)
            return 0;
    }
    return factors[0] == factors[1] ? factors[0] : 0;
}

Result<void> checkMetres(const Context& context, const Object& crs, int code) {
    if (proj_get_type(crs.get()) != PJ_TYPE_PROJECTED_CRS)
        return Error(Code::BadArgument, fmt::format("EPSG:{} ({}) is no projection; name one with metres, such as the "
                                                    "UTM zone of the place",
                                                    code, proj_get_name(crs.get())));
    if (metresPerUnitOf(context, crs) != 1)
        return Error(Code::BadArgument,
                     fmt::format("EPSG:{} ({}) is not in metres; name a projection in metres, such as "
                                 "the UTM zone of the place",
                                 code, proj_get_name(crs.get())));
    return {};
}

class ProjWay final : public Projection::Way {
public:
    ProjWay(Context context, Object operation) : context_(std::move(context)), operation_(std::move(operation)) {}

    void apply(std::span<Vec3d> points) const override {
        if (points.empty()) return;
        const std::lock_guard guard(mutex_);
        // x and y are what PROJ takes and gives; heights are not its matter.
        proj_trans_generic(operation_.get(), PJ_FWD, &points[0].x, sizeof(Vec3d), points.size(), &points[0].y,
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
    Context context = makeContext();
    const Object to = makeCrs(context, target);
    if (!to) return notKnown(context, target, Code::BadArgument);
    if (Result<void> checked = checkMetres(context, to, target); !checked) return checked.error();
    Object from = makeCrs(context, source);
    if (!from) return notKnown(context, source, Code::CannotProject);
    from = horizontalOf(context, std::move(from));
    Object operation(proj_create_crs_to_crs_from_pj(context.get(), from.get(), to.get(), nullptr, nullptr));
    if (operation) operation.reset(proj_normalize_for_visualization(context.get(), operation.get()));
    if (!operation)
        return Error(Code::CannotProject,
                     fmt::format("PROJ knows no way from EPSG:{} ({}) to EPSG:{} ({}) without further files", source,
                                 proj_get_name(from.get()), target, proj_get_name(to.get())));
    std::string name = proj_get_name(to.get());
    const double unit = proj_get_type(from.get()) == PJ_TYPE_PROJECTED_CRS ? metresPerUnitOf(context, from) : 1;
    return Projection(target, std::move(name), unit,
                      std::make_shared<const ProjWay>(std::move(context), std::move(operation)));
}

Result<PlaceInDegrees> placeInDegrees(int source, Vec3d place) {
    Context context = makeContext();
    Object from = makeCrs(context, source);
    if (!from) return notKnown(context, source, Code::CannotProject);
    from = horizontalOf(context, std::move(from));
    const Object degrees(proj_crs_get_geodetic_crs(context.get(), from.get()));
    const char* const code = degrees ? proj_get_id_code(degrees.get(), 0) : nullptr;
    const Object world = makeCrs(context, 4326);
    Object operation(world ? proj_create_crs_to_crs_from_pj(context.get(), from.get(), world.get(), nullptr, nullptr)
                           : nullptr);
    if (operation) operation.reset(proj_normalize_for_visualization(context.get(), operation.get()));
    if (!operation || code == nullptr) return notKnown(context, source, Code::CannotProject);
    const PJ_COORD there = proj_trans(operation.get(), PJ_FWD, proj_coord(place.x, place.y, 0, 0));
    return PlaceInDegrees{std::atoi(code), {there.xy.x, there.xy.y, 0}};
}

}  // namespace project
}  // namespace svt::crs
