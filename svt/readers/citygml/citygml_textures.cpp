#include <svt/core/text.hpp>
#include <svt/readers/citygml/citygml_materials.hpp>
#include <svt/readers/citygml/gml_geometry.hpp>
#include <svt/readers/gml/gml_numbers.hpp>

#include <algorithm>
#include <string_view>
#include <unordered_map>
#include <utility>

namespace svt::readers::citygml {
namespace {

using std::string_view;
using textures::isUse, textures::materialOfUse, textures::useOf;
using textures::TextureImage, textures::TextureSet, textures::TextureUse, textures::Wrap;
using xml::Element;

class TextureReader {
public:
    TextureReader(xml::NameScope& scope, TextureRecord& record) : scope_(scope), record_(record) {}

    // False for a texture of backs.
    bool read(const Element& texture) {
        const bool isGeoreferenced = texture.localName == "GeoreferencedTexture";
        bool isFront = true;
        scope_.forEachChild(texture.node, [&](const Element& property) {
            const string_view name = property.localName;
            const string_view text = xml::textOf(property.node, scratch_);
            if (name == "imageURI")
                record_.image.file = text;
            else if (name == "wrapMode")
                record_.wrap = wrapNamed(text);
            else if (name == "isFront")
                isFront = text != "false" && text != "0";
            else if (name == "orientation")
                orientation_ = numbersOf(property.node);
            else if (name == "referencePoint")
                readReferencePoint(property);
            else if (name == "target" || name == "textureParameterization")
                readTarget(property);
        });
        record_.image.isGeoreferenced = isGeoreferenced;
        if (orientation_.size() == 4 && referencePoint_.size() >= 2)
            record_.image.world = textures::WorldPlace{orientation_[0], orientation_[1],    orientation_[2],
                                                       orientation_[3], referencePoint_[0], referencePoint_[1]};
        return isFront;
    }

private:
    static Wrap wrapNamed(string_view name) {
        if (name == "mirror") return Wrap::Mirror;
        if (name == "clamp") return Wrap::Clamp;
        return name == "none" || name == "border" ? Wrap::None : Wrap::Repeat;
    }

    // The numbers of an element; none if one of them is not a number.
    std::vector<double> numbersOf(pugi::xml_node node) {
        std::vector<double> numbers;
        if (!gml::parseNumbers(xml::textOf(node, scratch_), numbers).empty()) numbers.clear();
        return numbers;
    }

    void readReferencePoint(const Element& property) {
        scope_.forEachChild(property.node, [&](const Element& point) {
            scope_.forEachChild(point.node,
                                [&](const Element& position) { referencePoint_ = numbersOf(position.node); });
        });
    }

    // CityGML 1 and 2: <target uri="#polygon"><TexCoordList>; a GeoreferencedTexture and CityGML 3: <target>#polygon</target>,
    // the latter within <textureParameterization><TextureAssociation>.
    void readTarget(const Element& property) {
        TextureTarget target;
        if (property.localName == "target") {
            readHref(property, target);
            scope_.forEachChild(property.node, [&](const Element& list) { readParameters(list, target); });
        } else {
            scope_.forEachChild(property.node,
                                [&](const Element& association) { readParameters(association, target); });
        }
        if (!target.href.empty()) record_.targets.push_back(std::move(target));
    }

    void readHref(const Element& property, TextureTarget& target) {
        const string_view uri = property.node.attribute("uri").value();
        const string_view text = xml::textOf(property.node, scratch_);
        target.href = !uri.empty() ? uri : !text.empty() ? text : gml::attributesOf(scope_, property.node).href;
    }

    // Elements are nested as deeply as the document, whose depth is limited.
    void readParameters(const Element& element, TextureTarget& target) {
        const string_view name = element.localName;
        if (name == "target") return readHref(element, target);
        if (name == "textureCoordinates") return readCoordinates(element, target);
        if (name == "worldToTexture") {
            target.worldToTexture = numbersOf(element.node);
            return;
        }
        if (name == "TexCoordList" || name == "TexCoordGen" || name == "TextureAssociation" ||
            name == "textureParameterization")
            scope_.forEachChild(element.node, [&](const Element& inner) { readParameters(inner, target); });
    }

    void readCoordinates(const Element& element, TextureTarget& target) {
        const std::vector<double> numbers = numbersOf(element.node);
        for (std::size_t i = 0; i + 1 < numbers.size(); i += 2) target.points.push_back({numbers[i], numbers[i + 1]});
        if (target.points.size() > (target.ringEnds.empty() ? 0 : target.ringEnds.back()))
            target.ringEnds.push_back(static_cast<std::uint32_t>(target.points.size()));
    }

    xml::NameScope& scope_;
    TextureRecord& record_;
    std::vector<double> orientation_, referencePoint_;
    std::string scratch_;
};

class TextureApplier {
public:
    TextureApplier(Part& part, const References& references, GeometryResolver& resolver,
                   const std::vector<model::Material>& materials)
        : part_(part), references_(references), resolver_(resolver), materials_(materials) {}

    TextureSet run() {
        std::unordered_map<string_view, TextureRecord*> byId;
        for (TextureRecord& record : part_.textures)
            if (!record.id.empty()) byId.emplace(record.id, &record);
        const std::string theme = part_.textures.front().theme;
        for (TextureRecord& record : part_.textures)
            if (record.theme == theme) findTargets(record);
        for (const MaterialRecord& reference : part_.materials) {
            if (!reference.isReference || reference.theme != theme) continue;
            const auto found = byId.find(idOfHref(reference.id));
            if (found != byId.end()) findTargets(*found->second);
        }
        std::stable_sort(applications_.begin(), applications_.end(),
                         [](const Application& a, const Application& b) { return a.isPolygon < b.isPolygon; });
        for (const Application& application : applications_) apply(application);
        return std::move(set_);
    }

private:
    struct Application {
        bool isPolygon;
        NodeIndex node;
        const TextureTarget* target;
        Wrap wrap;
        std::uint32_t image;
    };

    void findTargets(TextureRecord& record) {
        const std::uint32_t image = imageOf(record.image);
        for (const TextureTarget& target : record.targets) {
            const Target found = references_.geometry(target.href);
            if (found.kind != Target::Kind::Node) continue;
            const bool isPolygon = part_.nodes[found.index].kind == NodeKind::Polygon;
            applications_.push_back({isPolygon, found.index, &target, record.wrap, image});
        }
    }

    // Many textures share one image.
    std::uint32_t imageOf(const TextureImage& image) {
        const auto next = static_cast<std::uint32_t>(set_.images.size());
        if (!image.isGeoreferenced) {
            const auto [known, isNew] = images_.emplace(image.file, next);
            if (!isNew) return known->second;
        }
        set_.images.push_back(image);
        return next;
    }

    void apply(const Application& application) {
        const bool isOfPolygon =
            set_.images[application.image].isGeoreferenced || application.target->worldToTexture.size() == 12;
        std::int32_t shared = -1;  // the use that polygons below the target share
        resolver_.forEachPolygon(application.node, [&](model::PolygonIndex p) {
            model::Polygon& polygon = part_.polygons[p];
            std::int32_t otherwise = polygon.material;
            if (isUse(otherwise)) otherwise = set_.uses[useOf(otherwise)].otherwise;
            const bool hasColor =
                otherwise >= 0 && !textures::isPlainGrey(materials_[static_cast<std::size_t>(otherwise)]);
            if (hasColor || set_.uses.size() >= textures::kMaxUses) return;
            if (isOfPolygon || shared == -1 || set_.uses[useOf(shared)].otherwise != otherwise) {
                shared = materialOfUse(set_.uses.size());
                set_.uses.push_back(isOfPolygon ? useOfPolygon(application, polygon) : sharedUse(application));
                set_.uses.back().otherwise = otherwise;
            }
            polygon.material = shared;
        });
    }

    static TextureUse sharedUse(const Application& application) {
        const TextureTarget& target = *application.target;
        return {application.image, application.wrap, -1, !application.isPolygon, target.points, target.ringEnds};
    }

    // The places on the map of a polygon, or its texture coordinates by the matrix of a TexCoordGen.
    static TextureUse useOfPolygon(const Application& application, const model::Polygon& polygon) {
        TextureUse use{application.image, application.wrap, -1, false, {}, polygon.ringEnds};
        const std::vector<double>& m = application.target->worldToTexture;
        for (const Vec3d p : polygon.points) {
            if (m.size() != 12) {
                use.points.push_back({p.x, p.y});
                continue;
            }
            const auto row = [&](std::size_t i) { return m[i] * p.x + m[i + 1] * p.y + m[i + 2] * p.z + m[i + 3]; };
            use.points.push_back({row(0) / row(8), row(4) / row(8)});
        }
        return use;
    }

    Part& part_;
    const References& references_;
    GeometryResolver& resolver_;
    const std::vector<model::Material>& materials_;
    TextureSet set_;
    std::unordered_map<std::string, std::uint32_t> images_;
    std::vector<Application> applications_;
};

}  // namespace

void readTexture(xml::NameScope& scope, const Element& texture, TextureRecord record, std::vector<TextureRecord>& to) {
    record.id = gml::attributesOf(scope, texture.node).id;
    if (TextureReader(scope, record).read(texture)) to.push_back(std::move(record));
}

TextureSet applyTextures(Part& part, const References& references, GeometryResolver& resolver,
                         const std::vector<model::Material>& materials) {
    if (part.textures.empty()) return {};
    return TextureApplier(part, references, resolver, materials).run();
}

}  // namespace svt::readers::citygml
