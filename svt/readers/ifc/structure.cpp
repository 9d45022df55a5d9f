#include <svt/readers/ifc/structure.hpp>

#include <algorithm>
#include <map>
#include <optional>
#include <unordered_set>

namespace svt::readers::ifc {
namespace {

class StructureReader {
public:
    explicit StructureReader(const IfcFile& file) : file_(file) {}

    Structure run() {
        findProducts();
        for (RecordIndex i = 0; i < file_.step().records().size(); ++i) relate(i);
        keepEarthworks();
        sortTree();
        return std::move(result_);
    }

private:
    void findProducts() {
        std::vector<ProductClass> classes;
        for (const std::string_view type : file_.step().typeNames()) classes.push_back(productClassOf(type));
        std::map<std::string, std::size_t> unknown;
        for (RecordIndex i = 0; i < file_.step().records().size(); ++i) {
            if (file_.entityOf(i) != Entity::Other) continue;
            const step::Record& record = file_.step().records()[i];
            const ProductClass& known = classes[record.type];
            Product product{i, known.kind, "", std::string(known.className), Product::kNoProduct};
            if (!known.ifcType.empty()) {
                product.ifcType = "Ifc" + std::string(known.ifcType);
            } else {
                // An unknown class with a GlobalId and a shape is a product.
                const Fields fields = file_.fieldsOf(i);
                const RecordIndex shape = file_.follow(fields[at::Product::Representation]);
                if (file_.entityOf(shape) != Entity::ProductDefinitionShape ||
                    !fields[at::Product::GlobalId].isString())
                    continue;
                product.ifcType = std::string(file_.typeName(i).substr(0, 100));
                product.className = "GenericOccupiedSpace";
                ++unknown[product.ifcType];
            }
            numberOf_[i] = result_.products.size();
            result_.products.push_back(std::move(product));
        }
        result_.unknownClasses.assign(unknown.begin(), unknown.end());
    }

    [[nodiscard]] std::size_t productOf(RecordIndex record) const {
        const auto found = numberOf_.find(record);
        return found == numberOf_.end() ? Product::kNoProduct : found->second;
    }

    void relate(RecordIndex relation) {
        const Fields fields = file_.fieldsOf(relation);
        switch (file_.entityOf(relation)) {
            case Entity::RelAggregates:
            case Entity::RelNests:
                for (const RecordIndex part : file_.followAll(fields[at::RelDecomposes::RelatedObjects]))
                    setParent(part, file_.follow(fields[at::RelDecomposes::RelatingObject]), true);
                break;
            case Entity::RelContainedInSpatialStructure: {
                namespace contained = at::RelContainedInSpatialStructure;
                for (const RecordIndex element : file_.followAll(fields[contained::RelatedElements]))
                    setParent(element, file_.follow(fields[contained::RelatingStructure]), false);
                break;
            }
            case Entity::RelVoidsElement:
                if (const auto ends = readEnds(fields, at::RelVoidsElement::RelatingBuildingElement,
                                               at::RelVoidsElement::RelatedOpeningElement)) {
                    result_.openings[ends->first].push_back(ends->second);
                    if (ends->second != kNoRecord) hostOf_.emplace(ends->second, ends->first);
                }
                break;
            case Entity::RelProjectsElement:
                if (const auto ends = readEnds(fields, at::RelProjectsElement::RelatingElement,
                                               at::RelProjectsElement::RelatedFeatureElement))
                    result_.projections[ends->first].push_back(ends->second);
                break;
            case Entity::RelFillsElement:
                if (const auto ends = readEnds(fields, at::RelFillsElement::RelatingOpeningElement,
                                               at::RelFillsElement::RelatedBuildingElement))
                    fills_.push_back(*ends);
                break;
            case Entity::RelAssignsToGroup: {
                Structure::Group group{file_.follow(fields[at::RelAssignsToGroup::RelatingGroup]), {}};
                if (group.record == kNoRecord) break;
                for (const RecordIndex member : file_.followAll(fields[at::RelAssignsToGroup::RelatedObjects]))
                    if (const std::size_t product = productOf(member); product != Product::kNoProduct)
                        group.members.push_back(product);
                if (!group.members.empty()) result_.groups.push_back(std::move(group));
                break;
            }
            default: break;
        }
    }

    // The relating and the related product. Nothing, and a report, for a relation of a product to itself.
    std::optional<std::pair<RecordIndex, RecordIndex>> readEnds(const Fields& fields, AttributePosition relating,
                                                                AttributePosition related) {
        const std::pair ends(file_.follow(fields[relating]), file_.follow(fields[related]));
        if (ends.first == kNoRecord || ends.first != ends.second) return ends;
        result_.circles.push_back(file_.guard().nameCircle({ends.first}));
        return std::nullopt;
    }

    // Being a part of a product takes precedence over being contained in a space.
    void setParent(RecordIndex child, RecordIndex parent, bool isPart) {
        const std::size_t c = productOf(child), p = productOf(parent);
        if (c == Product::kNoProduct || p == Product::kNoProduct) return;
        if (c == p) {
            result_.circles.push_back(file_.guard().nameCircle({child}));
            return;
        }
        Product& product = result_.products[c];
        if (product.parent == Product::kNoProduct || (isPart && !isPart_[c])) product.parent = p;
        if (isPart) isPart_[c] = true;
    }

    // A cut of earthworks that no relation subtracts from an element is the space to be excavated.
    void keepEarthworks() {
        for (Product& product : result_.products) {
            if (product.ifcType != "IfcEarthworksCut" || hostOf_.count(product.record) != 0) continue;
            product.kind = ProductKind::Element;
            product.className = "GenericLogicalSpace";
        }
    }

    // Reports the circle to which the parents of a product lead.
    void reportCircle(std::size_t product) {
        std::vector<RecordIndex> path;
        std::unordered_map<std::size_t, std::size_t> steps;
        // A product of an earlier walk leads to a circle that is already reported.
        while (product != Product::kNoProduct && visited_.insert(product).second) {
            steps.emplace(product, path.size());
            path.push_back(result_.products[product].record);
            product = result_.products[product].parent;
        }
        const auto closes = steps.find(product);
        if (closes == steps.end()) return;
        path.erase(path.begin(), path.begin() + std::ptrdiff_t(closes->second));
        result_.circles.push_back(file_.guard().nameCircle(std::move(path)));
    }

    // Orders products depth first. The first product of a circle loses its parent.
    void sortTree() {
        std::vector<Product>& products = result_.products;
        for (const auto& [opening, filling] : fills_)
            if (const auto host = hostOf_.find(opening); host != hostOf_.end())
                result_.filled.emplace(filling, host->second);
        const auto isFeature = [&](std::size_t p) {
            return products[p].kind == ProductKind::Spatial || products[p].kind == ProductKind::Element;
        };
        std::vector<std::vector<std::size_t>> children(products.size());
        std::vector<std::size_t> roots;
        for (std::size_t p = 0; p < products.size(); ++p) {
            if (!isFeature(p)) continue;
            // A filling without a container has the product that it fills as its parent.
            if (products[p].parent == Product::kNoProduct)
                if (const auto host = result_.filled.find(products[p].record); host != result_.filled.end())
                    products[p].parent = productOf(host->second);
            if (products[p].parent != Product::kNoProduct && !isFeature(products[p].parent))
                products[p].parent = Product::kNoProduct;
            if (products[p].parent == Product::kNoProduct)
                roots.push_back(p);
            else
                children[products[p].parent].push_back(p);
        }
        std::vector<bool> isPlaced(products.size(), false);
        const auto place = [&](std::size_t root) {
            std::vector<std::size_t> stack{root};
            while (!stack.empty()) {
                const std::size_t p = stack.back();
                stack.pop_back();
                if (isPlaced[p]) continue;
                isPlaced[p] = true;
                result_.order.push_back(p);
                stack.insert(stack.end(), children[p].rbegin(), children[p].rend());
            }
        };
        for (const std::size_t root : roots) place(root);
        for (std::size_t p = 0; p < products.size(); ++p) {
            if (!isFeature(p) || isPlaced[p]) continue;
            reportCircle(p);
            products[p].parent = Product::kNoProduct;
            place(p);
        }
    }

    const IfcFile& file_;
    Structure result_;
    std::unordered_map<RecordIndex, std::size_t> numberOf_;
    std::unordered_map<std::size_t, bool> isPart_;
    std::unordered_set<std::size_t> visited_;              // products that reportCircle() has passed
    std::unordered_map<RecordIndex, RecordIndex> hostOf_;  // opening -> product that it voids, by the first relation
    std::vector<std::pair<RecordIndex, RecordIndex>> fills_;
};

}  // namespace

Structure readStructure(const IfcFile& file) { return StructureReader(file).run(); }

}  // namespace svt::readers::ifc
