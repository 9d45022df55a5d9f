#pragma once
/// \file
/// Representation items to polygons: the body of a product, and the openings cut out of it.

#include <svt/readers/ifc_shape/body.hpp>
#include <svt/readers/ifc_shape/ifc_file.hpp>
#include <svt/readers/ifc_shape/profiles.hpp>

#include <map>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

namespace svt::readers::ifc {

/// The readable part of a product's shape, in the axes of the product.
struct Shape {
    std::vector<Body> bodies;
    std::vector<std::string> leftOut;  ///< parts not read or not applied, and the reasons; each once
    /// The product has a representation that could be a body, or a reference to a missing one.
    bool hasRepresentation = false;
    bool isBoundingBox = false;  ///< the only body is the bounding box of the product, as a surface
};

class ShapeReader {
public:
    /// \param materialOfItem   representation item -> material of its style
    /// \param materialOfFaces  face set -> material of each of its faces, -1: that of the item
    ShapeReader(const IfcFile& file, std::unordered_map<RecordIndex, std::int32_t> materialOfItem,
                std::unordered_map<RecordIndex, std::vector<std::int32_t>> materialOfFaces = {});

    /// The body of a product: the representation Body, else the next best one; at worst a bounding box as a surface,
    /// with an entry in `leftOut`.
    /// \param definition  IfcProductDefinitionShape
    [[nodiscard]] Shape readShape(RecordIndex definition);

    /// Cuts openings out of the closed bodies of a shape.
    /// \param openings  in the axes of the shape
    void subtract(Shape& shape, const std::vector<Body>& openings);

private:
    using Bodies = std::vector<Body>;

    // ((a - b) - c) - d, from d inwards.
    struct Chain {
        RecordIndex base = kNoRecord;       // a
        std::vector<RecordIndex> operands;  // d, c, b
    };

    void readRepresentation(RecordIndex representation, Bodies& bodies);
    void readItem(RecordIndex item, Bodies& bodies);
    void readKnownItem(RecordIndex item, const Fields& fields, Bodies& bodies);
    void readMappedItem(const Fields& fields, Bodies& bodies);
    void readMap(RecordIndex map);
    void readSweep(RecordIndex item, const Fields& fields, Bodies& bodies);
    void readDirectedSweep(RecordIndex item, const Fields& fields, Bodies& bodies);
    [[nodiscard]] bool isWholeCurve(const std::vector<Vec3d>& line, Value first, Value last) const;
    void readDisk(const Fields& fields, Bodies& bodies);
    void readBrep(RecordIndex item, const Fields& fields, Bodies& bodies);
    void addShell(RecordIndex shell, Bodies& bodies);
    void readFaceSet(RecordIndex item, const Fields& fields, Bodies& bodies);
    void readPrimitive(RecordIndex item, const Fields& fields, Bodies& bodies);
    void readBoolean(const Fields& fields, Bodies& bodies);
    bool readChain(const Fields& fields, Chain& chain, ReadGuard::Scope& scope);
    bool readHalfSpace(RecordIndex item, const Box3d& around, Bodies& bodies);
    bool readOperand(RecordIndex operand, std::string_view op, const Box3d& around, Bodies& bodies);
    std::optional<std::vector<model::Polygon>> differenceOf(std::vector<std::vector<model::Polygon>> bodies,
                                                            std::size_t& failed);
    void evaluate(std::string_view op, const Bodies& first, const Bodies& second, Bodies& bodies);
    void addBody(Body body, Bodies& bodies);
    void addSolid(std::vector<model::Polygon> faces, Bodies& bodies, RecordIndex item);
    void leaveOut(std::string what);
    void leaveOutMissing();
    [[nodiscard]] bool affords(std::uint64_t points);

    [[nodiscard]] std::vector<model::Polygon> readShell(RecordIndex shell);
    bool readFace(RecordIndex face, std::vector<model::Polygon>& faces);
    bool readEdge(RecordIndex edge, std::vector<Vec3d>& points);
    bool readLoop(RecordIndex loop, std::vector<Vec3d>& ring, std::vector<std::size_t>& edgeEnds);
    static bool addRuledFace(const std::vector<std::vector<Vec3d>>& rings, const std::vector<std::size_t>& edgeEnds,
                             std::vector<model::Polygon>& faces);

    const IfcFile& file_;
    std::unordered_map<RecordIndex, std::int32_t> materialOfItem_;
    std::unordered_map<RecordIndex, std::vector<std::int32_t>> materialOfFaces_;
    std::unordered_map<RecordIndex, std::shared_ptr<const Bodies>> mapped_;             // by representation map
    std::unordered_map<RecordIndex, std::vector<std::string>> leftOutOfMap_;            // parts left out of it
    std::unordered_map<RecordIndex, std::shared_ptr<const std::vector<Vec3d>>> edges_;  // points of edge curves
    std::vector<std::string> leftOut_;                                                  // of the shape that is read
};

}  // namespace svt::readers::ifc
