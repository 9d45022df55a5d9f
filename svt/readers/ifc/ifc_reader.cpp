#include <svt/readers/ifc/ifc_reader.hpp>

#include <svt/core/text.hpp>
#include <svt/readers/georeference/far_features.hpp>
#include <svt/readers/georeference/georeference.hpp>
#include <svt/readers/ifc/drawing_facts.hpp>
#include <svt/readers/ifc/layers.hpp>
#include <svt/readers/ifc/line_reader.hpp>
#include <svt/readers/ifc/properties.hpp>
#include <svt/readers/ifc/storey_level.hpp>
#include <svt/readers/ifc/structure.hpp>
#include <svt/readers/ifc/styles.hpp>
#include <svt/readers/ifc/units.hpp>
#include <svt/readers/ifc_shape/shape_reader.hpp>
#include <svt/readers/read_model.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <unordered_set>

namespace svt::readers {
namespace {

using namespace ifc;
using std::string_view;

constexpr string_view kByteOrderMark = "\xEF\xBB\xBF";

// "IFC4X3_ADD2" -> "IFC 4.3".
std::optional<std::string> versionName(string_view schema) {
    const std::string lower = lowerAscii(schema);
    if (lower.starts_with("ifc2x")) return "IFC " + lower.substr(3);
    if (lower.starts_with("ifc4x")) return fmt::format("IFC 4.{}", lower.size() > 5 ? lower.substr(5, 1) : "0");
    if (lower.starts_with("ifc4")) return "IFC 4";
    return std::nullopt;
}

class IfcReader {
public:
    IfcReader(const step::StepFile& step, string_view name, const ReadOptions& options, Diagnostics& diagnostics)
        : file_(step), name_(name), options_(options), diagnostics_(diagnostics) {}

    Result<model::BuildingModel> read() {
        const auto version = versionName(file_.step().schema());
        if (!version)
            return Error(
                Code::UnknownVersion,
                fmt::format("the schema of this STEP file is '{}', not IFC2X3, IFC4 or IFC4X3; only IFC is read from "
                            "STEP files",
                            file_.step().schema().substr(0, 60)),
                place());
        SVT_DO(checkEnd());
        model_.source = name_;
        model_.format = *version;
        readProject();
        const Styles styles = readStyles(file_, name_, options_, diagnostics_);
        model_.materials = styles.materials;
        structure_ = readStructure(file_);
        if (file_.guard().isFileSpent()) return tooMuch();
        if (structure_.order.empty()) {
            file_.missing().report(name_, diagnostics_);
            return Error(Code::EmptyModel, "the file has no product: no building, storey, space or element", place());
        }
        reportStructure();
        presentationLayers_ = readPresentationLayers(file_);
        northBearer_ = northBearer(structure_);
        const Properties properties(file_, units_);
        for (const std::size_t p : structure_.order) {
            addFeature(structure_.products[p], p, properties);
            if (file_.guard().isFileSpent()) return tooMuch();
        }
        addGroups();
        SVT_DO(readShapes(styles, properties));
        file_.missing().report(name_, diagnostics_);
        reportCircles();
        reportCounts();
        return placeModel();
    }

private:
    [[nodiscard]] Place place(std::uint64_t line = 0, std::string id = {}) const {
        return {std::string(name_), line, 0, std::move(id)};
    }
    void warn(Code code, std::string message, const Place& where) {
        diagnostics_.add(Severity::Warning, code, std::move(message), where);
    }
    void note(Code code, std::string message, const Place& where) {
        diagnostics_.add(Severity::Note, code, std::move(message), where);
    }
    [[nodiscard]] std::uint64_t lineOf(RecordIndex record) const {
        return file_.step().lineOf(file_.step().records()[record]);
    }

    // Reports a file that was cut off, whose last records are missing.
    Result<void> checkEnd() {
        if (!file_.step().isTruncated()) return {};
        const step::Record& last = file_.step().records().back();
        const Place where = place(file_.step().lineOf(last));
        const std::string found =
            fmt::format("the file ends behind the record #{}, without END-ISO-10303-21: it was cut off", last.id);
        if (!options_.allowTruncated)
            return Error(Code::Truncated,
                         found + "; copy or export it again, or read it up to the cut (--allow-truncated)", where);
        warn(Code::Truncated, found + "; it was read up to the cut", where);
        return {};
    }

    [[nodiscard]] Error tooMuch() const {
        return {
            Code::InputTooBig,
            fmt::format("the file stands for {}: its records refer to the same ones too often; export it with shapes "
                        "of their own, or split it",
                        file_.guard().whatIsSpent()),
            place()};
    }

    void readProject() {
        const std::vector<RecordIndex> projects = file_.all(Entity::Project);
        const RecordIndex project = projects.empty() ? kNoRecord : projects.front();
        units_ = readUnits(file_, project, place(), diagnostics_);
        file_.lengthUnit = units_.length;
        file_.angleUnit = units_.angle;
        map_ = readMapPlace(file_, project, place(), diagnostics_);
        const Fields fields = file_.fieldsOf(project);
        model_.name = fields[at::Project::Name].string().value_or("");
        projectName_ = fields[at::Project::LongName].string().value_or("");
        if (model_.name.empty()) model_.name = projectName_;
    }

    void reportStructure() {
        for (const std::string& circle : structure_.circles)
            warn(Code::ReferenceCycle,
                 fmt::format(
                     "products contain, cut or fill each other in a circle: {}; the closing reference is left out",
                     circle),
                 place());
        for (const auto& [type, count] : structure_.unknownClasses)
            note(
                Code::UnknownElement,
                fmt::format("the class {} is not known; its {} products are read as GenericOccupiedSpace", type, count),
                place());
    }

    void reportCircles() {
        for (const ReadGuard::Circle& circle : file_.guard().circles())
            warn(Code::ReferenceCycle,
                 fmt::format("records refer to each other in a circle: {}; the closing reference is left out",
                             circle.text),
                 place(lineOf(circle.first)));
    }

    // Omits attributes beyond the budget of a product, with a finding.
    void finishAttributes(const model::Feature& feature) {
        ReadGuard& guard = file_.guard();
        for (const Attribute& attribute : feature.attributes) guard.takeElements(elementsOf(attribute));
        if (guard.isSpent() && !guard.isFileSpent())
            warn(Code::ReadInPart,
                 fmt::format("the attributes of this product were read in part: they have {}", guard.whatIsSpent()),
                 place(feature.line, feature.id));
        guard.endProduct();
    }

    std::string uniqueId(const Fields& fields, const Product& product) {
        std::string id = fields[at::Root::GlobalId].string().value_or("");
        if (id.empty()) {
            id = fmt::format("{}_{}", product.ifcType, file_.step().records()[product.record].id);
            warn(Code::MissingId, fmt::format("a product without GlobalId; it is called '{}'", id),
                 place(lineOf(product.record), id));
        }
        if (ids_.insert(id).second) return id;
        const std::string wanted = id;
        // Continues with the number after the last one that was free for this id.
        for (int& i = nextNumber_.emplace(wanted, 2).first->second; !ids_.insert(id).second; ++i)
            id = fmt::format("{}_{}", wanted, i);
        warn(Code::DuplicateId, fmt::format("the GlobalId '{}' is used again; renamed to '{}'", wanted, id),
             place(lineOf(product.record), id));
        return id;
    }

    model::Feature newFeature(const Product& product, const Fields& fields) {
        model::Feature feature;
        feature.id = uniqueId(fields, product);
        feature.className = product.className;
        feature.name = fields[at::Root::Name].string().value_or("");
        feature.line = lineOf(product.record);
        feature.attributes.push_back({"ifcType", product.ifcType, ""});
        return feature;
    }

    void addFeature(const Product& product, std::size_t number, const Properties& properties) {
        file_.guard().beginProduct();
        const Fields fields = file_.fieldsOf(product.record);
        model::Feature feature = newFeature(product, fields);
        const auto add = [&](string_view attribute, Value value) {
            if (auto text = value.string(); text && !text->empty())
                feature.attributes.push_back({std::string(attribute), std::move(*text), ""});
        };
        add("description", fields[at::Product::Description]);
        add("objectType", fields[at::Product::ObjectType]);
        if (product.kind == ProductKind::Spatial)
            add("longName", fields[at::SpatialElement::LongName]);
        else
            add("tag", fields[at::Element::Tag]);
        if (product.ifcType == "IfcSpace" || product.ifcType == "IfcSpatialZone") nameSpace(fields, feature);
        if (product.ifcType == "IfcBuildingStorey") addElevation(product, fields, feature);
        if (product.ifcType == "IfcSite") addSitePlace(fields, feature);
        if (number == northBearer_ && !projectName_.empty())
            feature.attributes.push_back({"projectName", projectName_, ""});
        addDrawingFacts(file_, product, map_, feature);
        if (number == northBearer_ && map_.trueNorthDegrees)
            feature.attributes.push_back({"trueNorth", *map_.trueNorthDegrees, "deg"});
        // IFC2x3 has InteriorOrExteriorSpace at the place of the PredefinedType of a space.
        const bool isSpace = product.ifcType == "IfcSpace";
        const string_view predefined =
            fields[isSpace ? at::Space::PredefinedType : predefinedTypeOf(product.ifcType)].enumeration();
        if ((product.kind == ProductKind::Element || isSpace) && predefined.size() > 1)
            feature.attributes.push_back({"predefinedType", std::string(predefined), ""});
        if (product.ifcType == "IfcDoor" || product.ifcType == "IfcDoorStandardCase")
            addDoorOperation(product.record, properties, feature);
        if (const auto host = structure_.filled.find(product.record); host != structure_.filled.end())
            if (auto id = file_.fieldsOf(host->second)[at::Root::GlobalId].string())
                feature.attributes.push_back({"fills", std::move(*id), ""});
        addPresentationLayers(product, feature);
        properties.append(product.record, feature.attributes);
        finishAttributes(feature);
        const auto parent = product.parent == Product::kNoProduct ? model::kNoFeature : featureOf_[product.parent];
        featureOf_.resize(structure_.products.size(), model::kNoFeature);
        featureOf_[number] = model_.addFeature(std::move(feature), parent);
    }

    // A door (IFC4), its type, or its style (IFC2x3) states the operation. The door opens to the side of the y axis of
    // its placement.
    void addDoorOperation(RecordIndex door, const Properties& properties, model::Feature& feature) const {
        const auto known = [](string_view operation) { return operation.size() > 1 && operation != "NOTDEFINED"; };
        string_view operation = file_.fieldsOf(door)[at::Door::OperationType].enumeration();
        for (const RecordIndex type : properties.typesOf(door)) {
            if (known(operation)) break;
            const string_view name = file_.typeName(type);
            if (name == "IFCDOORTYPE") operation = file_.fieldsOf(type)[at::DoorType::OperationType].enumeration();
            if (name == "IFCDOORSTYLE") operation = file_.fieldsOf(type)[at::DoorStyle::OperationType].enumeration();
        }
        if (!known(operation)) return;
        feature.attributes.push_back({"operationType", std::string(operation), ""});
        std::vector<std::string> lost;
        const Vec3d towards = map_.mapFromProject.direction(placementOf(door, lost).y);
        if (!lost.empty() || !(std::hypot(towards.x, towards.y) > 0)) return;
        const double degrees = std::atan2(towards.x, towards.y) * 180 / std::numbers::pi;
        const double rounded = std::round(degrees * 1000) / 1000;
        feature.attributes.push_back({"opensTowards", rounded < 0 ? rounded + 360 : rounded + 0.0, "deg"});
    }

    // Name is the number of a space in the plan, LongName the name that people use. A zone for occupancy is a unit.
    static void nameSpace(const Fields& fields, model::Feature& feature) {
        const std::string longName = fields[at::SpatialElement::LongName].string().value_or("");
        if (!longName.empty() && longName != feature.name) {
            if (!feature.name.empty()) feature.attributes.push_back({"number", feature.name, ""});
            feature.name = longName;
        }
        if (fields[at::SpatialZone::PredefinedType].enumeration() == "OCCUPANCY") feature.className = "BuildingUnit";
    }

    // Adds the layers of the representations of a product, their items, and the items of their maps; each once.
    void addPresentationLayers(const Product& product, model::Feature& feature) const {
        if (presentationLayers_.empty()) return;
        std::string names;
        const auto add = [&](RecordIndex record) {
            const auto found = presentationLayers_.find(record);
            if (found == presentationLayers_.end() || !file_.guard().takeSteps(names.size())) return;
            if (("; " + names + "; ").find("; " + found->second + "; ") == std::string::npos)
                names += (names.empty() ? "" : "; ") + found->second;
        };
        for (const RecordIndex representation : file_.representations(shapeDefinition(product.record))) {
            add(representation);
            for (const RecordIndex item : file_.items(representation)) {
                add(item);
                if (file_.entityOf(item) != Entity::MappedItem) continue;
                const RecordIndex map = file_.follow(item, at::MappedItem::MappingSource);
                const RecordIndex shown = file_.follow(map, at::RepresentationMap::MappedRepresentation);
                add(shown);
                for (const RecordIndex inner : file_.items(shown)) add(inner);
            }
        }
        if (!names.empty()) feature.attributes.push_back({"presentationLayer", std::move(names), ""});
    }

    void addLength(string_view attribute, Value length, model::Feature& feature) const {
        if (const auto number = length.number())
            feature.attributes.push_back({std::string(attribute), converted(*number, units_.length), "m"});
    }

    void addSitePlace(const Fields& fields, model::Feature& feature) const {
        if (const auto latitude = compoundDegrees(fields[at::Site::RefLatitude]))
            feature.attributes.push_back({"latitude", *latitude, "deg"});
        if (const auto longitude = compoundDegrees(fields[at::Site::RefLongitude]))
            feature.attributes.push_back({"longitude", *longitude, "deg"});
        addLength("elevation", fields[at::Site::RefElevation], feature);
    }

    // The elevation as stated, relative to the building, and the height of the level in the coordinates of the model.
    void addElevation(const Product& product, const Fields& fields, model::Feature& feature) const {
        addLength("elevation", fields[at::BuildingStorey::Elevation], feature);
        if (const auto height = storeyLevel(file_, structure_, product, map_))
            feature.attributes.push_back({"modelElevation", *height, "m"});
    }

    model::FeatureIndex addGroup(RecordIndex record) {
        const Entity entity = file_.entityOf(record);
        const string_view type = entity == Entity::Other ? file_.typeName(record) : entityName(entity);
        const Product product{record, ProductKind::Spatial, std::string(type), "CityObjectGroup", Product::kNoProduct};
        return model_.addFeature(newFeature(product, file_.fieldsOf(record)), model::kNoFeature);
    }

    void addGroups() {
        for (const Structure::Group& group : structure_.groups) {
            const auto [known, isNew] = groupFeature_.try_emplace(group.record);
            if (isNew) known->second = addGroup(group.record);
            for (const std::size_t member : group.members)
                if (featureOf_[member] != model::kNoFeature)
                    model_.memberships.push_back({known->second, featureOf_[member], "member"});
        }
    }

    [[nodiscard]] RecordIndex shapeDefinition(RecordIndex product) const {
        return file_.follow(product, at::Product::Representation);
    }
    // Unreadable parts are added to `leftOut`.
    [[nodiscard]] Transform placementOf(RecordIndex product, std::vector<std::string>& leftOut) const {
        std::string lost;
        const Transform placement = file_.placement(file_.follow(product, at::Product::ObjectPlacement), lost);
        if (!lost.empty()) leftOut.push_back(std::move(lost));
        for (std::string& what : file_.missing().take()) leftOut.push_back("for its place, " + std::move(what));
        return placement;
    }

    // Bodies of openings or projections, in the axes of their product.
    std::vector<Body> readOpenings(const std::vector<RecordIndex>& records, const Transform& intoProduct,
                                   ShapeReader& shapes, Shape& shape) {
        std::vector<Body> bodies;
        for (const RecordIndex record : records) {
            if (record == kNoRecord) {
                shape.leftOut.push_back("an opening that the file lacks");
                continue;
            }
            const Shape opening = shapes.readShape(shapeDefinition(record));
            if (opening.bodies.empty() && opening.hasRepresentation)
                shape.leftOut.push_back("an opening without a body");
            for (const std::string& what : opening.leftOut) shape.leftOut.push_back("of an opening: " + what);
            std::vector<std::string> lost;
            const Transform relative = intoProduct.after(placementOf(record, lost));
            for (const std::string& what : lost) shape.leftOut.push_back("of an opening: " + what);
            for (const Body& body : opening.bodies) bodies.push_back(transformed(body, relative));
            if (shape.leftOut.size() > kMaxLeftOut) shape.leftOut.resize(kMaxLeftOut);
        }
        return bodies;
    }

    // The openings of a product and of the elements that it is a part of.
    [[nodiscard]] std::vector<RecordIndex> openingsOf(const Product& product) const {
        std::vector<RecordIndex> records;
        const Product* at = &product;
        for (int level = 0; level < 4; ++level) {
            if (const auto found = structure_.openings.find(at->record); found != structure_.openings.end())
                records.insert(records.end(), found->second.begin(), found->second.end());
            if (at->parent == Product::kNoProduct || structure_.products[at->parent].kind != ProductKind::Element)
                break;
            at = &structure_.products[at->parent];
        }
        return records;
    }

    Result<void> readShapes(const Styles& styles, const Properties& properties) {
        ShapeReader shapes(file_, styles.ofItem, styles.ofFaces);
        std::size_t done = 0;
        for (const std::size_t p : structure_.order) {
            if (Progress::isCancelled(options_.progress))
                return Error(Code::Cancelled, "stopped while reading", place());
            if (++done % 64 == 0)
                Progress::tell(options_.progress, "read", double(done) / double(structure_.order.size()));
            const Product& product = structure_.products[p];
            file_.missing().drop();  // these belong to other records
            file_.guard().beginProduct();
            const RecordIndex definition = shapeDefinition(product.record);
            if (definition == kNoRecord && !file_.missing().isAny()) continue;
            Shape shape = shapes.readShape(definition);
            const Transform placement = placementOf(product.record, shape.leftOut);
            if (!isFinite(placement.origin)) shape.bodies.clear();
            if (!shape.bodies.empty() && !shape.isBoundingBox) cutOpenings(product, placement, shapes, shape);
            if (file_.guard().isFileSpent()) return tooMuch();
            // Discards a shape that was read until the budget was spent: it is incomplete, and large.
            if (file_.guard().isSpent()) shape = {{}, {file_.guard().whatIsSpent()}, true};
            if (shape.hasRepresentation)
                finishProduct(p, shape, placement, styles, properties);
            else
                addLines(p, definition, placement, std::move(shape.leftOut));
            if (file_.guard().isFileSpent()) return tooMuch();
        }
        file_.guard().endProduct();
        return {};
    }

    // Adds the curves of a product without a body.
    void addLines(std::size_t number, RecordIndex definition, const Transform& placement,
                  std::vector<std::string> leftOut) {
        std::vector<std::vector<Vec3d>> lines = readLines(file_, definition, leftOut);
        if (file_.guard().isSpent()) {
            lines.clear();
            leftOut = {file_.guard().whatIsSpent()};
        }
        for (std::vector<Vec3d>& line : lines) {
            for (Vec3d& p : line) p = map_.mapFromProject.point(placement.point(p));
            if (std::all_of(line.begin(), line.end(), [](Vec3d p) { return isFinite(p); }))
                model_.lines.push_back({featureOf_[number], std::move(line)});
        }
        for (std::string& what : file_.missing().take()) leftOut.push_back(std::move(what));
        if (leftOut.empty()) return;
        const model::Feature& feature = model_.features[featureOf_[number]];
        note(Code::ReadInPart,
             fmt::format("the lines of this {} were read in part; left out: {}", structure_.products[number].ifcType,
                         leftOut.front()),
             place(feature.line, feature.id));
    }

    void cutOpenings(const Product& product, const Transform& placement, ShapeReader& shapes, Shape& shape) {
        const std::vector<RecordIndex> openings = openingsOf(product);
        const auto added = structure_.projections.find(product.record);
        if (openings.empty() && added == structure_.projections.end()) return;
        if (!(std::abs(placement.determinant()) > 1e-12)) {
            shape.leftOut.push_back("its openings, because its placement has no volume");
            return;
        }
        const Transform intoProduct = placement.inverse();
        if (added != structure_.projections.end())
            for (Body& body : readOpenings(added->second, intoProduct, shapes, shape))
                shape.bodies.push_back(std::move(body));
        if (!openings.empty()) shapes.subtract(shape, readOpenings(openings, intoProduct, shapes, shape));
    }

    void finishProduct(std::size_t number, Shape& shape, const Transform& placement, const Styles& styles,
                       const Properties& properties) {
        model::Feature& feature = model_.features[featureOf_[number]];
        const Place where = place(feature.line, feature.id);
        const std::string& type = structure_.products[number].ifcType;
        ++withShape_;
        std::string what;
        for (std::size_t i = 0; i < shape.leftOut.size() && i < 5; ++i) what += (i == 0 ? "" : "; ") + shape.leftOut[i];
        if (shape.leftOut.size() > 5) what += fmt::format("; and {} more", shape.leftOut.size() - 5);
        if (shape.bodies.empty()) {
            ++skipped_;
            if (what.empty()) what = "its representation has no body, or openings take all of it";
            return warn(Code::ShapeNotRead, fmt::format("no shape of this {} could be read: {}", type, what), where);
        }
        if (!what.empty()) {
            ++partial_;
            warn(Code::ReadInPart, fmt::format("this {} was read in part; left out: {}", type, what), where);
            feature.attributes.push_back({std::string(model::kReadInPartAttribute), what, ""});
        }
        if (shape.isBoundingBox) feature.attributes.push_back({"shape", std::string("bounding box"), ""});
        const auto style = styles.ofMaterial.find(properties.mainMaterial(structure_.products[number].record));
        const std::int32_t material = style == styles.ofMaterial.end() ? -1 : style->second;
        colorParts(structure_.products[number].record, shape, styles, properties);
        if (options_.splitLayers && splitProduct(number, shape, placement, styles, properties, material)) return;
        addGeometry(model_.features[featureOf_[number]], shape.bodies, placement, material);
    }

    // Parts that the file names without a colour take that of their material constituent, found by name.
    void colorParts(RecordIndex product, Shape& shape, const Styles& styles, const Properties& properties) {
        for (Body& body : shape.bodies) {
            if (body.material < 0 || model_.materials[static_cast<std::size_t>(body.material)].hasColor) continue;
            const std::string part = model_.materials[static_cast<std::size_t>(body.material)].part;
            const RecordIndex record = properties.constituent(product, part);
            if (record == kNoRecord) continue;
            const auto [number, isNew] = materialsOfParts_.try_emplace({record, part}, body.material);
            if (isNew) {
                model::Material material;
                const auto style = styles.ofMaterial.find(record);
                material.hasColor = style != styles.ofMaterial.end();
                if (material.hasColor) material = styles.materials[static_cast<std::size_t>(style->second)];
                material.name = file_.fieldsOf(record)[at::Material::Name].string().value_or("");
                material.part = part;
                number->second = static_cast<std::int32_t>(model_.materials.size());
                model_.materials.push_back(std::move(material));
            }
            body.material = number->second;
        }
    }

    // Layers inherit the attributes of their wall, except for measures and materials, so that queries for walls find
    // them.
    static std::vector<Attribute> layerAttributes(const std::vector<Attribute>& ofProduct) {
        constexpr string_view kOwn[] = {"material", "materialLayers", "tag", "layer", "thickness", "function"};
        std::vector<Attribute> attributes;
        for (const Attribute& attribute : ofProduct)
            if (std::find(std::begin(kOwn), std::end(kOwn), attribute.name) == std::end(kOwn) &&
                attribute.name.find("Quantities.") == std::string::npos)
                attributes.push_back(attribute);
        return attributes;
    }

    // Adds layers as features below the product; false if it does not have layers, or the body cannot be split.
    bool splitProduct(std::size_t number, const Shape& shape, const Transform& placement, const Styles& styles,
                      const Properties& properties, std::int32_t material) {
        const RecordIndex record = structure_.products[number].record;
        auto layered = splitIntoLayers(file_, properties, record, shapeDefinition(record), shape);
        if (!layered) return false;
        ++withLayers_;
        const model::FeatureIndex product = featureOf_[number];
        const std::string id = model_.features[product].id;
        const std::uint64_t line = model_.features[product].line;
        const auto report = [&](const std::string& what) {
            warn(Code::LayersNotSplit, fmt::format("this {} {}", structure_.products[number].ifcType, what),
                 place(line, id));
        };
        if (!layered->why.empty()) {
            report("was not split into its layers: " + layered->why);
            return false;
        }
        std::uint64_t copied = 0;
        for (const Attribute& attribute : model_.features[product].attributes) copied += elementsOf(attribute);
        if (!file_.guard().affords(copied * layered->layers.size())) {
            report("was not split into its layers: they have " + file_.guard().whatIsSpent());
            return false;
        }
        file_.guard().takeElements(copied * layered->layers.size());
        ++split_;
        if (layered->moved > 0)
            report(fmt::format("has its layers beside its body; they were moved onto it, by {:.4g} m", layered->moved));
        if (!layered->rest.empty()) report("is thicker than its layers; the rest does not belong to a layer");
        addGeometry(model_.features[product], layered->rest, placement, material);
        for (std::size_t i = 0; i < layered->layers.size(); ++i) {
            LayerPart& layer = layered->layers[i];
            if (layer.bodies.empty()) continue;
            model::Feature feature;
            feature.id = fmt::format("{}_layer{}", id, i + 1);
            ids_.insert(feature.id);
            feature.className = model_.features[product].className;
            feature.name = layer.name;
            feature.line = line;
            feature.attributes = layerAttributes(model_.features[product].attributes);
            feature.attributes.push_back({"material", layer.name, ""});
            feature.attributes.push_back({"layer", static_cast<std::int64_t>(i + 1), ""});
            feature.attributes.push_back({"thickness", layer.thickness, "m"});
            if (!layer.function.empty()) feature.attributes.push_back({"function", layer.function, ""});
            std::int32_t own = material;
            if (const auto found = styles.ofMaterial.find(layer.material); found != styles.ofMaterial.end()) {
                own = found->second;
                for (Body& body : layer.bodies) body.material = own;
            }
            const model::FeatureIndex index = model_.addFeature(std::move(feature), product);
            addGeometry(model_.features[index], layer.bodies, placement, own);
        }
        return true;
    }

    void addGeometry(model::Feature& feature, std::vector<Body>& bodies, const Transform& placement,
                     std::int32_t otherwise) {
        model::Geometry geometry;
        const bool isMirrored = placement.determinant() < 0;
        for (Body& body : bodies) {
            std::vector<model::SurfaceUse> uses;
            if (isMirrored) turnOver(body.faces);
            for (model::Polygon& face : body.faces) {
                for (Vec3d& p : face.points) p = map_.mapFromProject.point(placement.point(p));
                if (!std::all_of(face.points.begin(), face.points.end(), [](Vec3d p) { return isFinite(p); })) continue;
                if (face.material < 0) face.material = body.material >= 0 ? body.material : otherwise;
                uses.push_back({model_.addPolygon(std::move(face)), false});
            }
            if (uses.empty()) continue;
            if (body.isSolid)
                geometry.solids.push_back({"", std::move(uses), {}});
            else
                geometry.surfaces.insert(geometry.surfaces.end(), uses.begin(), uses.end());
        }
        geometry.kind = geometry.solids.empty() ? model::GeometryKind::Surface : model::GeometryKind::Solid;
        if (!geometry.solids.empty() || !geometry.surfaces.empty()) feature.geometries.push_back(std::move(geometry));
    }

    void reportCounts() {
        note(Code::ProductsRead,
             fmt::format("{} of {} products with a shape were read, {} of them in part", withShape_ - skipped_,
                         withShape_, partial_),
             place());
        if (options_.splitLayers)
            note(Code::LayersSplit,
                 fmt::format("{} of {} products with layers of materials were split into them", split_, withLayers_),
                 place());
    }

    Result<model::BuildingModel> placeModel() {
        if (options_.crs != 0 || !map_.crs.empty()) {
            const georeference::GivenCrs given{map_.crs, "", true, place(), {}};
            ReadOptions options = options_;
            options.axisOrder = 0;  // a conversion states which axis is east
            SVT_DO(georeference::georeference(model_, given, options, diagnostics_));
        } else if (!options_.keepFarFeatures) {
            georeference::leaveOutFarFeatures(model_, {1, 1, 1}, place(), diagnostics_);
        }
        return std::move(model_);
    }

    IfcFile file_;
    string_view name_;
    const ReadOptions& options_;
    Diagnostics& diagnostics_;
    Units units_;
    MapPlace map_;
    Structure structure_;
    std::size_t northBearer_ = Product::kNoProduct;
    std::string projectName_;  // LongName of the project
    std::unordered_set<std::string> ids_;
    std::unordered_map<std::string, int> nextNumber_;  // of an id that is used more than once
    std::unordered_map<RecordIndex, std::string> presentationLayers_;
    std::map<std::pair<RecordIndex, std::string>, std::int32_t> materialsOfParts_;  // by IfcMaterial and part
    std::vector<model::FeatureIndex> featureOf_;                                    // by product
    std::unordered_map<RecordIndex, model::FeatureIndex> groupFeature_;
    std::size_t withShape_ = 0, partial_ = 0, skipped_ = 0, withLayers_ = 0, split_ = 0;
    model::BuildingModel model_;
};

}  // namespace

bool looksLikeIfc(std::span<const std::byte> head) noexcept {
    string_view text(reinterpret_cast<const char*>(head.data()), std::min<std::size_t>(head.size(), 4096));
    if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
    while (!text.empty() && isBlank(text.front())) text.remove_prefix(1);
    return text.starts_with("ISO-10303-21");
}

Result<model::BuildingModel> readIfc(std::span<const std::byte> bytes, string_view name, const ReadOptions& options,
                                     Diagnostics* diagnostics) {
    Diagnostics ignored;
    Diagnostics& log = diagnostics != nullptr ? *diagnostics : ignored;
    if (bytes.size() > options.maxBytes)
        return Error(Code::InputTooBig,
                     fmt::format("the file has {} bytes, the limit is {}", bytes.size(), options.maxBytes),
                     {std::string(name), 0, 0, {}});
    if (options.unit != 0)
        return Error(Code::BadArgument, "--unit is for GML and CityJSON; an IFC file states its unit",
                     {std::string(name), 0, 0, {}});
    string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
    Progress::tell(options.progress, "read", 0);
    SVT_TRY(step, step::StepFile::scan(text, name, log));
    return IfcReader(*step, name, options, log).read();
}

extern const Format kIfc{.name = "ifc",
                         .endings = ".ifc|.ifczip",
                         .holds = "IFC 2x3 to 4.3 (STEP)",
                         .looksLike = looksLikeIfc,
                         .read = readIfc};

}  // namespace svt::readers
