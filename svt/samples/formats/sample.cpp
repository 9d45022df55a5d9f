#include <svt/samples/sample.hpp>

#include <svt/samples/designs/source.hpp>
#include <svt/samples/formats/writers.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace svt::samples {
namespace {

constexpr std::int64_t kMaxDescribed = 10000;  // houses

// n . local <= c with local = inverse(world), in millimetres, as a half-space in world metres.
HalfSpace worldHalfSpace(const Placement& placement, Vec3d normal, double limit) {
    const double size = length(normal);
    const Vec3d anchor = normal * (limit / dot(normal, normal));
    const Vec3d worldNormal = placement.worldDirection(normal) / size;
    return {worldNormal, dot(worldNormal, placement.worldPosition(anchor))};
}

SamplePiece worldPiece(const Placement& placement, Axis axis, const Piece& piece) {
    SamplePiece result;
    result.adds = piece.adds;
    const bool alongX = axis == Axis::X;
    const Vec3d along = alongX ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0};
    const Vec3d across = alongX ? Vec3d{0, 1, 0} : Vec3d{1, 0, 0};
    result.sides.push_back(worldHalfSpace(placement, along, double(piece.to)));
    result.sides.push_back(worldHalfSpace(placement, -along, -double(piece.from)));
    for (const HalfPlane& side : piece.sides)
        result.sides.push_back(
            worldHalfSpace(placement, across * double(side.across) + Vec3d{0, 0, double(side.up)}, double(side.limit)));
    return result;
}

SampleComponent describe(const Document& document, const PlacedPlan& placed, int index) {
    const Component& component = placed.component(index);
    SampleComponent result;
    result.id = document.idOf(placed, index);
    result.className = className(component.kind);
    result.name = document.nameOf(placed, index);
    result.parent = document.parentIdOf(placed, index);
    if (component.storey >= 0) result.storey = document.idOf(placed, component.storey);
    if (component.unit >= 0) result.unit = document.idOf(placed, component.unit);
    result.volume = component.volume;
    for (const Solid& solid : component.solids) {
        auto& pieces = result.solids.emplace_back();
        for (const Piece& piece : solid.pieces) pieces.push_back(worldPiece(placed.placement, solid.axis, piece));
    }
    return result;
}

}  // namespace

std::string matrixText(const PlacedPlan& placed, const Instance& instance, std::string_view separator) {
    const Vec3d east = placed.placement.worldDirection(instance.xAxis());
    const auto number = [](double value) { return fixedText(std::llround(value * 1e12), 12); };
    const std::string cosine = number(east.x);
    return fmt::format("{1}{0}{2}{0}0{0}0{0}{3}{0}{1}{0}0{0}0{0}0{0}0{0}1{0}0{0}0{0}0{0}0{0}1", separator, cosine,
                       number(-east.y), number(east.y));
}

bool SampleComponent::contains(Vec3d point) const {
    const auto isInPiece = [&](const SamplePiece& piece) {
        return std::all_of(piece.sides.begin(), piece.sides.end(),
                           [&](const HalfSpace& side) { return dot(side.normal, point) <= side.offset; });
    };
    for (const auto& pieces : solids) {
        const auto last = std::find_if(pieces.rbegin(), pieces.rend(), isInPiece);
        if (last != pieces.rend() && last->adds) return true;
    }
    return false;
}

Result<void> writeSample(SampleKind kind, SampleFormat format, const SampleOptions& options, const SampleSink& sink) {
    if (options.bakeOpenings && format != SampleFormat::Ifc4)
        return Error(Code::BadArgument, "only IFC files have openings to bake; write the sample as IFC");
    SVT_TRY(source, SampleSource::make(kind, options));
    TextSink out(sink);
    switch (format) {
        case SampleFormat::CityGml3: writeCityGml3(*source, out); break;
        case SampleFormat::CityGml2: writeCityGml2(*source, options.thematic, out); break;
        case SampleFormat::CityJson2: writeCityJson(*source, out); break;
        case SampleFormat::CityJsonSeq2: writeCityJsonSeq(*source, out); break;
        case SampleFormat::Ifc4: writeIfc(*source, options.bakeOpenings, out); break;
    }
    out.flush();
    if (out.hasFailed()) return Error(Code::CannotWrite, "the sink took no more of the sample");
    return {};
}

Result<std::string> writeSample(SampleKind kind, SampleFormat format, const SampleOptions& options) {
    std::string text;
    const Result<void> written = writeSample(kind, format, options, [&](std::string_view part) {
        text += part;
        return true;
    });
    if (!written) return written.error();
    return text;
}

Result<std::vector<SampleComponent>> describeSample(SampleKind kind, const SampleOptions& options) {
    SVT_TRY(source, SampleSource::make(kind, options));
    if (source->buildingCount() > kMaxDescribed)
        return Error(Code::BadArgument, fmt::format("columns x rows is {}, at most {} houses can be described",
                                                    source->buildingCount(), kMaxDescribed));
    std::vector<SampleComponent> result;
    for (std::int64_t i = 0; i < source->buildingCount(); ++i) {
        const Document document = source->building(i);
        result.push_back({document.id, "Building", document.name, "", "", "", 0, {}});
        document.forEach([&](const PlacedPlan& placed, int c, const Component& component) {
            if (!component.isStandIn) result.push_back(describe(document, placed, c));
        });
    }
    return result;
}

Result<SampleChanges> describeChanges(SampleKind kind, SampleFormat format, const SampleOptions& options) {
    if (!options.change) return Error(Code::BadArgument, "the seed of a change is missing");
    SVT_TRY(source, SampleSource::make(kind, options));
    const Document document = source->building(0);
    const PlacedPlan& placed = document.plans.front();
    const PlanChanges& changes = source->changes();
    const auto idOf = [&](const std::optional<std::string>& inPlan) {
        if (!inPlan) return std::optional<std::string>();
        const std::string id = placed.prefix + *inPlan;
        return std::optional<std::string>(format == SampleFormat::Ifc4 ? globalId(id) : id);
    };
    SampleChanges described{
        {}, changes.hasNewIds, changes.hasNewTriangles && format != SampleFormat::Ifc4, changes.isReordered};
    for (const PlanChange& change : changes.edits) {
        SampleChange& row = described.edits.emplace_back();
        row.edit = change.edit;
        row.was = idOf(change.was);
        row.is = idOf(change.is);
        if (change.edit == SampleEdit::Move)
            row.vector = placed.placement.worldDirection(toDouble(change.vector)) / 1000.0;
        if (change.edit == SampleEdit::Rotate) row.rotation = 90.0 * change.quarterTurns;
        row.added = double(change.added) * 1e-9;
        row.removed = double(change.removed) * 1e-9;
        row.className = change.className;
        row.name = change.name;
    }
    return described;
}

}  // namespace svt::samples
