#include <svt/readers/ifc/layers.hpp>

#include <svt/readers/ifc_shape/curves.hpp>
#include <svt/readers/ifc_shape/solid_boolean.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace svt::readers::ifc {
namespace {

constexpr double kTolerance = 0.001;  // metres that a body may be thicker than its layers
constexpr double kNoBody = 1e-6;      // metres: thinner layers are foils
constexpr double kStraight = 1e-4;    // metres, maximum distance of a point of an axis from the line
constexpr std::size_t kMaxLayers = 256;

using Polygons = std::vector<model::Polygon>;

// Planes at dot(direction, p) = offset, in the axes of the product.
struct Stack {
    Vec3d direction{0, 0, 1};
    double base = 0;  // of the reference line or plane along the direction
};

struct Range {
    double low = kInfinity, high = -kInfinity;
};

Range extent(const std::vector<Body>& bodies, Vec3d direction) {
    Range range;
    for (const Body& body : bodies)
        for (const model::Polygon& face : body.faces)
            for (const Vec3d p : face.points) {
                range.low = std::min(range.low, dot(direction, p));
                range.high = std::max(range.high, dot(direction, p));
            }
    return range;
}

// The line of the representation Axis in plan; the x axis without one; nothing, and a reason, if it is not straight.
std::optional<Stack> wallStack(const IfcFile& file, RecordIndex definition, std::string& why) {
    Stack stack{{0, 1, 0}, 0};
    for (const RecordIndex representation : file.representations(definition)) {
        const Fields fields = file.fieldsOf(representation);
        if (fields[at::Representation::RepresentationIdentifier].string() != "Axis") continue;
        const std::vector<RecordIndex> items = file.followAll(fields[at::Representation::Items]);
        std::vector<Vec3d> line;
        std::string unread;
        if (items.size() != 1 || !readCurve(file, items[0], line, unread) || line.size() < 2) break;
        const Vec3d along{line.back().x - line.front().x, line.back().y - line.front().y, 0};
        if (!(length(along) > kStraight)) {
            why = "its axis is closed or has no length";
            return std::nullopt;
        }
        const Vec3d unit = normalized(along);
        Vec3d across{-unit.y, unit.x, 0};
        if (across.y < 0) across = -across;
        for (const Vec3d p : line)
            if (std::abs(dot(across, p - line.front())) > kStraight) {
                why = "its axis is not straight";
                return std::nullopt;
            }
        return Stack{across, dot(across, line.front())};
    }
    return stack;
}

// The direction of the first extrusion of the body, and its start.
std::optional<Stack> extrusionStack(const IfcFile& file, RecordIndex definition) {
    for (const RecordIndex representation : file.representations(definition)) {
        const Fields fields = file.fieldsOf(representation);
        const std::vector<RecordIndex> items = file.followAll(fields[at::Representation::Items]);
        if (fields[at::Representation::RepresentationIdentifier].string() != "Body" || items.empty()) continue;
        RecordIndex item = items.front();
        ReadGuard::Scope scope(file.guard());
        while (scope.enter(item)) {
            const Entity entity = file.entityOf(item);
            if (entity != Entity::BooleanResult && entity != Entity::BooleanClippingResult) break;
            item = file.follow(item, at::BooleanResult::FirstOperand);
        }
        if (file.entityOf(item) != Entity::ExtrudedAreaSolid) return std::nullopt;
        const Transform axes = file.axes(file.follow(item, at::ExtrudedAreaSolid::Position));
        return Stack{axes.z, dot(axes.z, axes.origin)};
    }
    return std::nullopt;
}

// The part of `faces` between two planes; nothing if it is not closed.
std::optional<Polygons> between(const Polygons& faces, Vec3d direction, double low, double high, ReadGuard& guard) {
    const Transform axes = axesFrom({}, direction, {1, 0, 0});
    Box3d box = boundsOf(faces);
    const Vec3d center = box.center();
    const double reach = length(box.size()) + 1;
    const double middle = dot(center, axes.z);
    low = std::max(low, middle - reach);
    high = std::min(high, middle + reach);
    if (!(low < high)) return Polygons{};
    const double x = dot(center, axes.x), y = dot(center, axes.y);
    const auto corner = [&](int i) {
        return axes.x * (x + ((i & 1) != 0 ? reach : -reach)) + axes.y * (y + ((i & 2) != 0 ? reach : -reach)) +
               axes.z * ((i & 4) != 0 ? high : low);
    };
    Polygons slab;
    for (const auto& [a, b, c, d] : {std::array{0, 2, 3, 1}, std::array{4, 5, 7, 6}, std::array{0, 1, 5, 4},
                                     std::array{2, 6, 7, 3}, std::array{0, 4, 6, 2}, std::array{1, 3, 7, 5}})
        addFace(slab, {{corner(a), corner(b), corner(c), corner(d)}});
    return evaluateBoolean(BooleanOperator::Intersection, {faces, slab}, guard);
}

class LayerSplitter {
public:
    LayerSplitter(const IfcFile& file, RecordIndex definition, const Shape& shape)
        : file_(file), definition_(definition), shape_(shape) {}

    LayeredShape run(const Fields& usage) {
        readLayers(usage);
        if (result_.why.empty()) split(usage);
        if (!result_.why.empty()) {
            result_.layers.clear();
            result_.rest.clear();
        }
        return std::move(result_);
    }

private:
    void readLayers(const Fields& usage) {
        const RecordIndex set = file_.follow(usage[at::MaterialLayerSetUsage::ForLayerSet]);
        for (const RecordIndex record : file_.followAll(set, at::MaterialLayerSet::MaterialLayers)) {
            const Fields fields = file_.fieldsOf(record);
            LayerPart layer;
            layer.material = file_.follow(fields[at::MaterialLayer::Material]);
            const Fields material = file_.fieldsOf(layer.material);
            layer.name = material[at::Material::Name].string().value_or("");
            if (layer.name.empty()) layer.name = fields[at::MaterialLayer::Name].string().value_or("");
            if (layer.name.empty()) layer.name = fmt::format("layer {}", result_.layers.size() + 1);
            layer.function = fields[at::MaterialLayer::Category].string().value_or("");
            if (layer.function.empty()) layer.function = material[at::Material::Category].string().value_or("");
            layer.thickness = file_.metres(fields[at::MaterialLayer::LayerThickness]);
            if (!(layer.thickness >= 0) || !std::isfinite(layer.thickness))
                result_.why = "a layer has no thickness that is a number of 0 or more";
            total_ += layer.thickness;
            result_.layers.push_back(std::move(layer));
        }
        if (result_.layers.empty() || !(total_ > kNoBody)) result_.why = "its layers have no thickness";
        if (result_.layers.size() > kMaxLayers) result_.why = fmt::format("it has {} layers", result_.layers.size());
    }

    // Begin and end of the layers along a stack.
    [[nodiscard]] Range layerRange(const Fields& usage, const Stack& stack) const {
        const double begin = stack.base + file_.metres(usage[at::MaterialLayerSetUsage::OffsetFromReferenceLine]);
        return isNegative_ ? Range{begin - total_, begin} : Range{begin, begin + total_};
    }

    [[nodiscard]] bool fits(const Range& layers, const Range& body) const {
        return body.low >= layers.low - kTolerance && body.high <= layers.high + kTolerance;
    }

    bool findStack(const Fields& usage) {
        const std::string_view axis = usage[at::MaterialLayerSetUsage::LayerSetDirection].enumeration();
        if (axis == "AXIS2") {
            const auto stack = wallStack(file_, definition_, result_.why);
            if (!stack) return false;
            stack_ = *stack;
            return true;
        }
        stack_ = {axis == "AXIS1" ? Vec3d{1, 0, 0} : Vec3d{0, 0, 1}, 0};
        if (axis == "AXIS3" && !fits(layerRange(usage, stack_), extent(shape_.bodies, stack_.direction)))
            if (const auto other = extrusionStack(file_, definition_);
                other && fits(layerRange(usage, *other), extent(shape_.bodies, other->direction)))
                stack_ = *other;
        return true;
    }

    void split(const Fields& usage) {
        for (const Body& body : shape_.bodies)
            if (!isClosed(body.faces)) result_.why = "its body is not closed";
        isNegative_ = usage[at::MaterialLayerSetUsage::DirectionSense].enumeration() == "NEGATIVE";
        if (!result_.why.empty() || !findStack(usage)) return;
        const Range body = extent(shape_.bodies, stack_.direction);
        Range layers = layerRange(usage, stack_);
        if (!fits(layers, body) && std::abs(body.high - body.low - total_) < kTolerance) {
            result_.moved = std::abs(body.low - layers.low);
            layers = body;
        }
        if (body.low > layers.high - kTolerance || body.high < layers.low + kTolerance) {
            result_.why = "its layers lie beside its body";
            return;
        }
        // The outermost layers take a body that is slightly thicker than all layers.
        const bool isOpenLow = body.low >= layers.low - kTolerance, isOpenHigh = body.high <= layers.high + kTolerance;
        double at = isNegative_ ? layers.high : layers.low;
        const auto cut = [&](double low, double high, std::vector<Body>& into) {
            if (low <= layers.low + kNoBody && isOpenLow) low = -kInfinity;
            if (high >= layers.high - kNoBody && isOpenHigh) high = kInfinity;
            addBetween(low, high, into);
        };
        for (LayerPart& layer : result_.layers) {
            const double next = isNegative_ ? at - layer.thickness : at + layer.thickness;
            if (layer.thickness > kNoBody) cut(std::min(at, next), std::max(at, next), layer.bodies);
            at = next;
        }
        if (!isOpenLow) addBetween(-kInfinity, layers.low, result_.rest);
        if (!isOpenHigh) addBetween(layers.high, kInfinity, result_.rest);
    }

    void addBetween(double low, double high, std::vector<Body>& into) {
        for (const Body& body : shape_.bodies) {
            auto part = between(body.faces, stack_.direction, low, high, file_.guard());
            if (!part || !file_.guard().takeElements(pointCount(*part)))
                result_.why = file_.guard().isSpent() ? file_.guard().whatIsSpent() : "a layer would not be closed";
            else if (!part->empty())
                into.push_back({std::move(*part), true, body.material});
        }
    }

    const IfcFile& file_;
    RecordIndex definition_;
    const Shape& shape_;
    Stack stack_;
    double total_ = 0;
    bool isNegative_ = false;
    LayeredShape result_;
};

}  // namespace

std::optional<LayeredShape> splitIntoLayers(const IfcFile& file, const Properties& properties, RecordIndex product,
                                            RecordIndex definition, const Shape& shape) {
    LayeredShape unsplit;
    for (const RecordIndex material : properties.materialsOf(product)) {
        const Entity entity = file.entityOf(material);
        const bool isUsage = entity == Entity::MaterialLayerSetUsage;
        if (!isUsage && entity != Entity::MaterialLayerSet) continue;
        const RecordIndex set = isUsage ? file.follow(material, at::MaterialLayerSetUsage::ForLayerSet) : material;
        const std::vector<RecordIndex> layers = file.followAll(set, at::MaterialLayerSet::MaterialLayers);
        const auto isThick = [&](RecordIndex layer) {
            return file.metres(file.fieldsOf(layer)[at::MaterialLayer::LayerThickness]) > kNoBody;
        };
        if (std::count_if(layers.begin(), layers.end(), isThick) < 2) continue;
        if (isUsage) return LayerSplitter(file, definition, shape).run(file.fieldsOf(material));
        if (unsplit.why.empty()) unsplit.why = "its layer set has no usage, which would say where the layers lie";
    }
    if (unsplit.why.empty()) return std::nullopt;
    return unsplit;
}

}  // namespace svt::readers::ifc
