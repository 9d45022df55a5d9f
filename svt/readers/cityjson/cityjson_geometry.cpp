#include <svt/readers/cityjson/cityjson_geometry.hpp>

#include <svt/model/classes.hpp>
#include <svt/readers/cityjson/cityjson_textures.hpp>
#include <svt/readers/georeference/georeference.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <unordered_map>

namespace svt::readers::cityjson {
namespace {

/// Limit on coordinates: a quarter of the Earth's circumference in millimetres.
constexpr double kMaxCoordinate = 1e10;

using Matrix = std::array<double, 16>;  ///< row-major, world = matrix * (x, y, z, 1) + anchor

/// Iterates an array parallel to another one; yields nothing where the file has null or too few values.
class ParallelArray {
public:
    ParallelArray(std::optional<json::element> value, bool& hasBadNesting) {
        if (!value) return;
        if (const auto array = asArray(*value)) {
            next_ = array->begin();
            end_ = array->end();
            isArray_ = true;
        } else if (!value->is_null()) {
            hasBadNesting = true;
        }
    }
    std::optional<json::element> next() {
        if (!isArray_ || !(next_ != end_)) return std::nullopt;
        const json::element value = *next_;
        ++next_;
        if (value.is_null()) return std::nullopt;
        return value;
    }

private:
    json::array::iterator next_, end_;
    bool isArray_ = false;
};

/// Semantics, material and texture values of a geometry at one nesting level of its boundaries.
struct Values {
    std::optional<json::element> semantics, material, texture;
};

/// The arrays of values, iterated in parallel with the boundaries.
class ParallelValues {
public:
    ParallelValues(const Values& values, bool& hasBadNesting)
        : semantics_(values.semantics, hasBadNesting),
          material_(values.material, hasBadNesting),
          texture_(values.texture, hasBadNesting) {}
    Values next() {
        const auto semantics = semantics_.next(), material = material_.next();
        return {semantics, material, texture_.next()};
    }

private:
    ParallelArray semantics_, material_, texture_;
};

/// True if at least three of the points are distinct.
bool hasThreePoints(std::span<const Vec3d> points) noexcept {
    std::size_t second = 1;
    while (second < points.size() && points[second] == points[0]) ++second;
    for (std::size_t i = second + 1; i < points.size(); ++i)
        if (points[i] != points[0] && points[i] != points[second]) return true;
    return false;
}

class GeometryReader {
public:
    GeometryReader(const TextContext& context, ParsedObject& object) : context_(context), object_(object) {}

    void readAll(json::array geometries) {
        for (const json::element geometry : geometries) {
            if (const auto members = asObject(geometry))
                read(*members);
            else
                report(Code::BadJson, "is not a JSON object; left out");
            ++geometryNumber_;
        }
        giveSurfacesOrder();
    }

private:
    void report(Code code, std::string_view what) { add(code, fmt::format("geometry {} {}", geometryNumber_, what)); }

    // \param part  of the geometry, such as "surface 3"
    void reportPart(Code code, std::string_view part, std::string_view what) {
        add(code, fmt::format("geometry {}, {} {}", geometryNumber_, part, what));
    }

    void add(Code code, std::string message, Severity severity = Severity::Warning) {
        object_.diagnostics.add(severity, code, std::move(message),
                                {std::string(context_.origin.file), object_.feature.line, 0, shortened(object_.id)});
    }

    [[nodiscard]] std::string surfaceName() const { return fmt::format("surface {}", surfaceNumber_); }
    static std::string semanticSurfaceName(std::size_t i) { return fmt::format("semantic surface {}", i); }

    void read(json::object geometry) {
        const auto type = textMember(geometry, "type");
        points_ = context_.vertices;
        isInstance_ = false;
        materialBegin_ = context_.materialBegin;
        materialEnd_ = context_.materialEnd;
        textures_ = context_.ownTextures;
        if (type == "GeometryInstance")
            readInstance(geometry);
        else
            readBoundaries(geometry, type);
    }

    static std::string_view textMember(json::object object, std::string_view key) {
        return asString(findMember(object, key)).value_or(std::string_view());
    }

    void readInstance(json::object instance) {
        const auto index = asInteger(findMember(instance, "template"));
        const TemplateSet& templates = *context_.templates;
        if (!index || *index < 0 || static_cast<std::uint64_t>(*index) >= templates.geometries.size())
            return report(Code::DanglingReference,
                          fmt::format("refers to template {}, the file has {}; left out",
                                      index ? fmt::format("{}", *index) : "(none)", templates.geometries.size()));
        const auto geometry = asObject(templates.geometries[static_cast<std::size_t>(*index)]);
        if (!geometry) return report(Code::BadJson, "refers to a template that is not a JSON object; left out");
        const std::string_view type = textMember(*geometry, "type");
        if (type == "GeometryInstance")
            return report(Code::ReferenceCycle, "refers to a template that is an instance itself; left out");
        if (!readAnchor(instance) || !readMatrix(instance)) return;
        points_ = templates.vertices;
        isInstance_ = true;
        materialBegin_ = 0;
        materialEnd_ = context_.templateMaterialEnd;
        textures_ = context_.headTextures;
        readBoundaries(*geometry, type);
    }

    bool readAnchor(json::object instance) {
        const auto array = asArray(findMember(instance, "boundaries"));
        json::element first;
        const bool hasFirst = array && array->at(0).get(first) == simdjson::SUCCESS;
        const auto index = hasFirst ? asInteger(first) : std::nullopt;
        if (!index || *index < 0 || static_cast<std::uint64_t>(*index) >= context_.vertices.size()) {
            report(Code::BadIndex, "is an instance without a reference vertex that exists; left out");
            return false;
        }
        anchor_ = context_.vertices[static_cast<std::size_t>(*index)];
        if (isFinite(anchor_)) return true;
        report(Code::BadCoordinate, "is an instance at a vertex that cannot be used; left out");
        return false;
    }

    bool readMatrix(json::object instance) {
        matrix_ = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
        const auto value = findMember(instance, "transformationMatrix");
        if (!value) return true;
        const auto array = asArray(*value);
        std::size_t count = 0;
        if (array)
            for (const json::element item : *array) {
                const auto number = asNumber(item);
                if (!number || count == matrix_.size()) {
                    count = 0;
                    break;
                }
                matrix_[count++] = *number;
            }
        if (count == matrix_.size()) return true;
        report(Code::BadValue, "has a transformationMatrix that is not 16 numbers; left out");
        return false;
    }

    void readBoundaries(json::object geometry, std::string_view type) {
        const bool isSurface = type == "MultiSurface" || type == "CompositeSurface";
        const bool isSolidList = type == "MultiSolid" || type == "CompositeSolid";
        if (!isSurface && !isSolidList && type != "Solid") {
            if (type != "MultiPoint" && type != "MultiLineString")
                report(Code::UnknownElement, fmt::format("has the unknown type '{}'; left out", shortened(type)));
            return;
        }
        const auto parts = asArray(findMember(geometry, "boundaries"));
        if (!parts) return report(Code::BadJson, "has no array 'boundaries'; left out");

        model::Geometry result;
        result.kind = isSurface ? model::GeometryKind::Surface : model::GeometryKind::Solid;
        result.isComposite = type == "CompositeSolid" || type == "CompositeSurface";
        result.lod = readLod(geometry);
        result.id = textMember(geometry, "id");
        beginSemantics(geometry, result.lod);
        Values values{semanticValues_, materialValues(geometry), std::nullopt};
        if constexpr (textures::kReadsTextures)
            if (textures_ != nullptr) values.texture = textureValues(geometry, textures_->theme);
        hasBadNesting_ = hasBadNestingOfValues_ = false;
        surfaceNumber_ = 0;
        if (isSurface) {
            readSurfaces(*parts, values, result.surfaces);
        } else if (isSolidList) {
            ParallelValues beside(values, hasBadNestingOfValues_);
            for (const json::element part : *parts) {
                const Values inner = beside.next();
                if (const auto shells = asArray(part))
                    readSolid(*shells, inner, result.solids);
                else
                    hasBadNesting_ = true;
            }
        } else {
            readSolid(*parts, values, result.solids);
        }
        if (hasBadNesting_)
            report(Code::BadValue,
                   fmt::format("has boundaries that are not nested as a {} is; those parts are left out", type));
        if (hasBadNestingOfValues_)
            report(Code::BadValue,
                   fmt::format(
                       "has semantics, material or texture values that are not nested as a {} is; those are left out",
                       type));
        if (!result.solids.empty() || !result.surfaces.empty()) object_.feature.geometries.push_back(std::move(result));
        endSemantics();
    }

    double readLod(json::object geometry) {
        const auto value = findMember(geometry, "lod");
        if (!value || value->is_null()) return -1;
        double lod = -1;
        if (const auto text = asString(*value)) {
            const auto parsed = std::from_chars(text->data(), text->data() + text->size(), lod);
            if (parsed.ec != std::errc() || parsed.ptr != text->data() + text->size()) lod = -1;
        } else {
            lod = asNumber(*value).value_or(-1);
        }
        if (lod >= 0 && lod < 100) return lod;
        report(Code::BadValue, "has a 'lod' that is not a level of detail; ignored");
        return -1;
    }

    void readSolid(json::array shells, const Values& values, std::vector<model::Solid>& solids) {
        model::Solid solid;
        ParallelValues beside(values, hasBadNestingOfValues_);
        bool isExterior = true;
        for (const json::element shell : shells) {
            const Values inner = beside.next();
            std::vector<model::SurfaceUse> uses;
            if (const auto surfaces = asArray(shell))
                readSurfaces(*surfaces, inner, uses);
            else
                hasBadNesting_ = true;
            if (isExterior)
                solid.exterior = std::move(uses);
            else if (!uses.empty())
                solid.interiors.push_back(std::move(uses));
            isExterior = false;
        }
        if (!solid.exterior.empty()) solids.push_back(std::move(solid));
    }

    void readSurfaces(json::array surfaces, const Values& values, std::vector<model::SurfaceUse>& uses) {
        uses.reserve(surfaces.size());
        ParallelValues beside(values, hasBadNestingOfValues_);
        for (const json::element surface : surfaces) {
            const Values own = beside.next();
            model::Polygon polygon;
            const auto rings = asArray(surface);
            if (!rings) {
                hasBadNesting_ = true;
            } else if (readPolygon(*rings, polygon)) {
                polygon.material = materialOf(own.material);
                readTexture(own.texture, polygon);
                const auto index = static_cast<model::PolygonIndex>(object_.polygons.size());
                object_.polygons.push_back(std::move(polygon));
                if (isInstance_) {
                    object_.anchors.resize(index, georeference::kNoAnchor);
                    object_.anchors.push_back(anchor_);
                }
                uses.push_back({index, false});
                giveToSemantics(own.semantics, index);
            }
            ++surfaceNumber_;
        }
    }

    // Whether a polygon keeps its material also if it has a texture.
    [[nodiscard]] bool hasColor(std::int32_t material) const {
        if (material < 0) return false;
        const auto number = static_cast<std::size_t>(material);
        if (number < context_.templateMaterialEnd) return !textures::isPlainGrey((*context_.headMaterials)[number]);
        return context_.ownMaterials == nullptr ||
               !textures::isPlainGrey((*context_.ownMaterials)[number - context_.templateMaterialEnd]);
    }

    void readTexture([[maybe_unused]] const std::optional<json::element>& rings,
                     [[maybe_unused]] model::Polygon& polygon) {
        if constexpr (textures::kReadsTextures) {
            if (!rings || textures_ == nullptr || hasColor(polygon.material)) return;
            auto use = readTextureUse(*rings, *textures_);
            if (!use || object_.textureUses.size() >= textures::kMaxUses) return;
            const bool isOfHead = textures_ == context_.headTextures;
            if (!isOfHead) use->image += static_cast<std::uint32_t>(context_.headTextures->images.size());
            use->otherwise = polygon.material;
            polygon.material = textures::materialOfUse(object_.textureUses.size());
            object_.textureUses.push_back(std::move(*use));
        }
    }

    bool readPolygon(json::array rings, model::Polygon& polygon) {
        std::size_t capacity = 0;
        for (const json::element ring : rings)
            if (const auto indices = asArray(ring)) capacity += indices->size();
        polygon.points.reserve(capacity);
        polygon.ringEnds.reserve(rings.size());
        bool isExterior = true;
        for (const json::element ring : rings) {
            const auto indices = asArray(ring);
            if (!indices) {
                hasBadNesting_ = true;
                return false;
            }
            const std::size_t begin = polygon.points.size();
            if (!readRing(*indices, polygon.points)) return false;
            if (polygon.points.size() - begin > 1 && polygon.points.back() == polygon.points[begin])
                polygon.points.pop_back();
            if (!hasThreePoints(std::span(polygon.points).subspan(begin))) {
                reportPart(Code::TooFewPoints, surfaceName(),
                           fmt::format("has {} ring of fewer than three distinct points; left out",
                                       isExterior ? "an exterior" : "an interior"));
                if (isExterior) return false;
                polygon.points.resize(begin);
                continue;
            }
            polygon.ringEnds.push_back(static_cast<std::uint32_t>(polygon.points.size()));
            isExterior = false;
        }
        if (polygon.ringEnds.empty()) reportPart(Code::TooFewPoints, surfaceName(), "has no ring; left out");
        return !polygon.ringEnds.empty();
    }

    bool readRing(json::array indices, std::vector<Vec3d>& points) {
        for (const json::element item : indices) {
            if (item.is_array()) {
                hasBadNesting_ = true;
                return false;
            }
            const auto index = asInteger(item);
            if (!index || *index < 0 || static_cast<std::uint64_t>(*index) >= points_.size()) {
                reportPart(Code::BadIndex, surfaceName(),
                           fmt::format("refers to vertex {}, there are {}; left out", shortened(simdjson::minify(item)),
                                       points_.size()));
                return false;
            }
            const Vec3d point = place(points_[static_cast<std::size_t>(*index)]);
            if (!isFinite(point) ||
                std::max({std::abs(point.x), std::abs(point.y), std::abs(point.z)}) > kMaxCoordinate) {
                reportPart(Code::BadCoordinate, surfaceName(),
                           fmt::format("uses vertex {}, which is not three usable numbers; left out", *index));
                return false;
            }
            points.push_back(point);
        }
        return true;
    }

    [[nodiscard]] Vec3d place(Vec3d p) const {
        if (!isInstance_) return p;
        const auto row = [&](int i) {
            return matrix_[4 * i] * p.x + matrix_[4 * i + 1] * p.y + matrix_[4 * i + 2] * p.z + matrix_[4 * i + 3];
        };
        return Vec3d{row(0), row(1), row(2)} + anchor_;
    }

    // Materials

    std::optional<json::element> materialValues(json::object geometry) {
        uniformMaterial_ = -1;
        const auto themes = asObject(findMember(geometry, "material"));
        if (!themes) return std::nullopt;
        std::optional<json::object> chosen;
        std::string_view chosenName;
        for (const auto [name, theme] : *themes) {
            const auto members = asObject(theme);
            if (!members) continue;
            const bool isDefault = !context_.materialTheme.empty() && name == context_.materialTheme;
            if (!chosen || isDefault || name < chosenName) {
                chosen = members;
                chosenName = name;
            }
            if (isDefault) break;
        }
        if (!chosen) return std::nullopt;
        const auto uniform = findMember(*chosen, "value");
        if (uniform && !uniform->is_null()) uniformMaterial_ = materialOf(*uniform);
        return findMember(*chosen, "values");
    }

    std::int32_t materialOf(const std::optional<json::element>& value) {
        if (!value) return uniformMaterial_;
        const auto index = asInteger(*value);
        if (index && *index >= 0 && static_cast<std::uint64_t>(*index) < materialEnd_ - materialBegin_)
            return static_cast<std::int32_t>(materialBegin_ + static_cast<std::size_t>(*index));
        // Only a colour is lost; the solids of the model are not affected.
        add(Code::BadIndex,
            fmt::format("geometry {} refers to a material that does not exist; there are {}", geometryNumber_,
                        materialEnd_ - materialBegin_),
            Severity::Note);
        return -1;
    }

    // Semantics: the surfaces of this geometry, each with its polygons.

    struct Draft {
        json::object members;
        std::int32_t parent = kNoSurface;  ///< into drafts_
        bool isKept = false;
        std::vector<model::SurfaceUse> uses;
    };

    void beginSemantics(json::object geometry, double lod) {
        drafts_.clear();
        semanticValues_.reset();
        lod_ = lod;
        const auto value = findMember(geometry, "semantics");
        if (!value || value->is_null()) return;
        const auto semantics = asObject(*value);
        const auto surfaces = asArray(findMember(semantics, "surfaces"));
        if (!surfaces) return report(Code::BadValue, "has 'semantics' without an array 'surfaces'; left out");
        for (const json::element item : *surfaces) {
            const auto members = asObject(item);
            if (!members) report(Code::BadValue, "has a semantic surface that is not a JSON object; left out");
            drafts_.push_back({members.value_or(json::object()), kNoSurface, false, {}});
            if (!members) drafts_.back().parent = kNotAnObject;
        }
        semanticValues_ = findMember(*semantics, "values");
        readSurfaceParents();
    }

    /// `parent` of the child takes precedence; `children` of the parent is used if the child does not have `parent`.
    void readSurfaceParents() {
        const auto count = static_cast<std::int64_t>(drafts_.size());
        const auto isUsable = [&](std::optional<std::int64_t> index) {
            return index && *index >= 0 && *index < count && drafts_[*index].parent != kNotAnObject;
        };
        std::vector<std::int32_t> parents(drafts_.size(), kNoSurface);
        for (std::size_t i = 0; i < drafts_.size(); ++i) {
            if (drafts_[i].parent == kNotAnObject) continue;
            const auto value = findMember(drafts_[i].members, "parent");
            if (!value || value->is_null()) continue;
            const auto index = asInteger(*value);
            if (isUsable(index))
                parents[i] = static_cast<std::int32_t>(*index);
            else
                reportPart(Code::DanglingReference, semanticSurfaceName(i), "has a parent that does not exist");
        }
        for (std::size_t i = 0; i < drafts_.size(); ++i) {
            if (drafts_[i].parent == kNotAnObject) continue;
            const auto children = asArray(findMember(drafts_[i].members, "children"));
            if (!children) continue;
            for (const json::element child : *children) {
                const auto index = asInteger(child);
                if (!isUsable(index))
                    reportPart(Code::DanglingReference, semanticSurfaceName(i), "has a child that does not exist");
                else if (parents[*index] == kNoSurface)
                    parents[*index] = static_cast<std::int32_t>(i);
            }
        }
        for (const std::int32_t i : breakCycles(parents))
            reportPart(Code::ReferenceCycle, semanticSurfaceName(i), "is its own ancestor; its parent is left out");
        for (std::size_t i = 0; i < drafts_.size(); ++i)
            if (drafts_[i].parent != kNotAnObject) drafts_[i].parent = parents[i];
    }

    void giveToSemantics(const std::optional<json::element>& value, model::PolygonIndex polygon) {
        if (!value) return;
        const auto index = asInteger(*value);
        if (!index || *index < 0 || static_cast<std::uint64_t>(*index) >= drafts_.size())
            return reportPart(Code::BadIndex, surfaceName(),
                              fmt::format("refers to semantic surface {}, there are {}",
                                          shortened(simdjson::minify(*value)), drafts_.size()));
        Draft& draft = drafts_[static_cast<std::size_t>(*index)];
        if (draft.parent != kNotAnObject) draft.uses.push_back({polygon, false});
    }

    void endSemantics() {
        for (std::size_t i = 0; i < drafts_.size(); ++i) {
            if (drafts_[i].uses.empty()) continue;
            for (auto k = static_cast<std::int32_t>(i); k >= 0 && !drafts_[k].isKept; k = drafts_[k].parent)
                drafts_[k].isKept = true;
        }
        std::vector<std::int32_t> surfaceOfDraft(drafts_.size(), kNoSurface);
        for (std::size_t i = 0; i < drafts_.size(); ++i)
            if (drafts_[i].isKept) surfaceOfDraft[i] = surfaceFor(drafts_[i]);
        for (std::size_t i = 0; i < drafts_.size(); ++i) {
            if (!drafts_[i].isKept) continue;
            const std::int32_t surface = surfaceOfDraft[i];
            std::int32_t& parent = object_.surfaces[surface].parent;
            const std::int32_t own = drafts_[i].parent >= 0 ? surfaceOfDraft[drafts_[i].parent] : kNoSurface;
            if (parent == kNoSurface && own != surface) parent = own;
        }
    }

    /// A new semantic surface; or the one of an earlier geometry with the same id and type.
    std::int32_t surfaceFor(Draft& draft) {
        const auto type = textMember(draft.members, "type");
        if (type.empty()) report(Code::BadValue, "has a semantic surface without type; read as GenericThematicSurface");
        const std::string className = type.empty() ? "GenericThematicSurface" : model::canonicalClassName(type);
        std::string_view idKey = "id";
        if (textMember(draft.members, idKey).empty()) idKey = "gml:id";
        const std::string_view id = textMember(draft.members, idKey);

        auto index = static_cast<std::int32_t>(object_.surfaces.size());
        if (!id.empty()) {
            const auto [known, isNew] = surfaceOfId_.emplace(std::string(id), index);
            if (!isNew && object_.surfaces[known->second].feature.className == className) index = known->second;
        }
        if (index == static_cast<std::int32_t>(object_.surfaces.size())) {
            SemanticSurface& surface = object_.surfaces.emplace_back();
            model::Feature& feature = surface.feature;
            feature.id = id;
            feature.className = className;
            feature.line = object_.feature.line;
            for (const auto [key, value] : draft.members)
                if (key != "type" && key != "parent" && key != "children" && (id.empty() || key != idKey))
                    appendAttribute(key, value, feature.attributes);
            feature.name = nameOf(feature.attributes);
        }
        if (!draft.uses.empty()) addUses(object_.surfaces[index].feature, std::move(draft.uses));
        return index;
    }

    void addUses(model::Feature& feature, std::vector<model::SurfaceUse> uses) const {
        if (!feature.geometries.empty() && feature.geometries.back().lod == lod_) {
            auto& surfaces = feature.geometries.back().surfaces;
            surfaces.insert(surfaces.end(), uses.begin(), uses.end());
            return;
        }
        model::Geometry& geometry = feature.geometries.emplace_back();
        geometry.lod = lod_;
        geometry.surfaces = std::move(uses);
    }

    /// Sorts object_.surfaces into tree order, so that parents precede their children.
    void giveSurfacesOrder() {
        const std::size_t count = object_.surfaces.size();
        if (count == 0) return;
        std::vector<std::int32_t> parents(count);
        for (std::size_t i = 0; i < count; ++i) parents[i] = object_.surfaces[i].parent;
        // Surfaces shared by id between two geometries can form a cycle that neither geometry has by itself.
        for (const std::int32_t i : breakCycles(parents)) {
            reportPart(Code::ReferenceCycle,
                       fmt::format("semantic surface '{}'", shortened(object_.surfaces[i].feature.id)),
                       "is its own ancestor; its parent is left out");
        }
        std::vector<std::vector<std::int32_t>> children(count);
        std::vector<std::int32_t> stack, placeOf(count);
        for (std::size_t i = count; i-- > 0;) {
            if (parents[i] == kNoSurface)
                stack.push_back(static_cast<std::int32_t>(i));
            else
                children[parents[i]].push_back(static_cast<std::int32_t>(i));
        }
        std::vector<SemanticSurface> sorted;
        sorted.reserve(count);
        while (!stack.empty()) {
            const std::int32_t i = stack.back();
            stack.pop_back();
            placeOf[i] = static_cast<std::int32_t>(sorted.size());
            sorted.push_back(std::move(object_.surfaces[i]));
            sorted.back().parent = parents[i] == kNoSurface ? kNoSurface : placeOf[parents[i]];
            stack.insert(stack.end(), children[i].begin(), children[i].end());
        }
        object_.surfaces = std::move(sorted);
    }

    static constexpr std::int32_t kNotAnObject = -2;  ///< as the parent of a draft: the draft is unusable

    const TextContext& context_;
    ParsedObject& object_;
    std::size_t geometryNumber_ = 0;
    std::size_t surfaceNumber_ = 0;
    bool hasBadNesting_ = false;
    bool hasBadNestingOfValues_ = false;

    std::span<const Vec3d> points_;
    bool isInstance_ = false;
    Vec3d anchor_;
    Matrix matrix_{};

    std::size_t materialBegin_ = 0, materialEnd_ = 0;
    std::int32_t uniformMaterial_ = -1;
    const TextureSource* textures_ = nullptr;

    double lod_ = -1;
    std::vector<Draft> drafts_;
    std::optional<json::element> semanticValues_;
    std::unordered_map<std::string, std::int32_t> surfaceOfId_;
};

}  // namespace

std::uint64_t instancedBytes(json::element cityObject, const TemplateSet& templates) {
    if (templates.geometries.empty()) return 0;
    const auto geometries = asArray(findMember(asObject(cityObject), "geometry"));
    if (!geometries) return 0;
    std::uint64_t bytes = 0;
    for (const json::element item : *geometries) {
        const auto index = asInteger(findMember(asObject(item), "template"));
        if (index && *index >= 0 && static_cast<std::uint64_t>(*index) < templates.textBytes.size())
            bytes += templates.textBytes[static_cast<std::size_t>(*index)];
    }
    return bytes;
}

void readGeometries(json::array geometries, const TextContext& context, ParsedObject& object) {
    GeometryReader(context, object).readAll(geometries);
}

}  // namespace svt::readers::cityjson
