#pragma once
/// \file
/// The products of a file and their relations: spatial structure, aggregates, openings, groups.

#include <svt/readers/ifc_schema/product_classes.hpp>
#include <svt/readers/ifc_shape/ifc_file.hpp>

#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace svt::readers::ifc {

/// One product, in the order of the file.
struct Product {
    RecordIndex record = kNoRecord;
    ProductKind kind = ProductKind::Element;
    std::string ifcType;    ///< IfcWall; as in the file where the class is unknown
    std::string className;  ///< of the model
    std::size_t parent = kNoProduct;
    static constexpr std::size_t kNoProduct = static_cast<std::size_t>(-1);  ///< stands at the top
};

struct Structure {
    std::vector<Product> products;
    std::vector<std::size_t> order;  ///< products that become features, parents before their children
    std::unordered_map<RecordIndex, std::vector<RecordIndex>> openings;     ///< product -> openings cut out of it
    std::unordered_map<RecordIndex, std::vector<RecordIndex>> projections;  ///< product -> bodies added to it
    std::unordered_map<RecordIndex, RecordIndex> filled;                    ///< door, window -> product that it fills
    struct Group {
        RecordIndex record = kNoRecord;
        std::vector<std::size_t> members;
    };
    std::vector<Group> groups;  ///< zones, systems and groups, in the order of the file
    std::vector<std::pair<std::string, std::size_t>> unknownClasses;  ///< unknown type names with a shape
    std::vector<std::string> circles;  ///< products that contain each other, or cut themselves; ignored
};

[[nodiscard]] Structure readStructure(const IfcFile& file);

}  // namespace svt::readers::ifc
