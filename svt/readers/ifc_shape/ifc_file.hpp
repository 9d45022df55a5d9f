#pragma once
/// \file
/// Records of an IFC file by entity and attribute, lengths in metres.

#include <svt/core/vec.hpp>
#include <svt/readers/ifc_schema/entities.hpp>
#include <svt/readers/ifc_shape/transform.hpp>
#include <svt/readers/step/missing_records.hpp>
#include <svt/readers/step/read_guard.hpp>
#include <svt/readers/step/step_file.hpp>
#include <svt/readers/step/step_value.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace svt::readers::ifc {

using step::kNoRecord;
using step::ReadGuard;
using step::RecordIndex;
using step::Value;

/// Number of reasons kept for parts of a product that are left out; the finding names a few of them.
inline constexpr std::size_t kMaxLeftOut = 1000;

/// The attributes of one record by their names in the schema. Those beyond the 24th are left out.
class Fields {
public:
    explicit Fields(std::string_view values) noexcept;
    /// Nothing if the record has no such attribute.
    [[nodiscard]] Value operator[](AttributePosition attribute) const noexcept {
        return attribute.number < count_ ? values_[attribute.number] : Value();
    }

private:
    std::array<Value, 24> values_;
    std::size_t count_ = 0;
};

class IfcFile {
public:
    explicit IfcFile(const step::StepFile& file);

    [[nodiscard]] const step::StepFile& step() const noexcept { return step_; }
    [[nodiscard]] Entity entityOf(RecordIndex record) const noexcept {
        return record == kNoRecord ? Entity::Other : entityOfType_[step_.records()[record].type];
    }
    /// The attributes of a record; none once the budget of guard() is spent. Counts the steps of reading.
    [[nodiscard]] Fields fieldsOf(RecordIndex record) const noexcept {
        if (record == kNoRecord || !guard_.takeSteps(kStepsPerRecord + step_.records()[record].size))
            return Fields(std::string_view());
        return Fields(step_.valuesOf(step_.records()[record]));
    }
    /// Limits the reading of a file: every function that follows references from record to record checks it.
    [[nodiscard]] ReadGuard& guard() const noexcept { return guard_; }
    /// Type name as in the file, such as IFCPOLYLINE; empty for kNoRecord.
    [[nodiscard]] std::string_view typeName(RecordIndex record) const noexcept {
        return record == kNoRecord ? std::string_view() : step_.typeName(step_.records()[record]);
    }
    /// The record that a value refers to; kNoRecord if there is none. References to records that the file lacks go to
    /// missing(), here and in all functions that follow references.
    [[nodiscard]] RecordIndex follow(Value reference) const;
    /// The existing records that a list refers to.
    [[nodiscard]] std::vector<RecordIndex> followAll(Value list) const;
    // The same for an attribute of a record.
    [[nodiscard]] RecordIndex follow(RecordIndex record, AttributePosition attribute) const {
        return follow(fieldsOf(record)[attribute]);
    }
    [[nodiscard]] std::vector<RecordIndex> followAll(RecordIndex record, AttributePosition attribute) const {
        return followAll(fieldsOf(record)[attribute]);
    }
    /// Representations of an IfcProductDefinitionShape or IfcMaterialDefinitionRepresentation.
    [[nodiscard]] std::vector<RecordIndex> representations(RecordIndex definition) const {
        return followAll(definition, at::ProductRepresentation::Representations);
    }
    /// Items of an IfcRepresentation.
    [[nodiscard]] std::vector<RecordIndex> items(RecordIndex representation) const {
        return followAll(representation, at::Representation::Items);
    }
    /// References followed so far that lead nowhere.
    [[nodiscard]] step::MissingRecords& missing() const noexcept { return missing_; }
    /// Records of an entity in the order of the file.
    [[nodiscard]] std::vector<RecordIndex> all(Entity entity) const;

    // Geometry in metres; z is 0 in two dimensions.
    [[nodiscard]] double metres(Value length, double otherwise = 0) const noexcept;
    [[nodiscard]] double radians(Value angle, double otherwise = 0) const noexcept;
    [[nodiscard]] std::optional<Vec3d> coordinates(Value list) const noexcept;  ///< (1.,2.,3.), in metres
    /// IfcCartesianPointList2D or 3D; nothing if one of its items is not a point.
    [[nodiscard]] std::optional<std::vector<Vec3d>> pointList(Value reference) const;
    [[nodiscard]] std::optional<Vec3d> point(RecordIndex record) const noexcept;  ///< IfcCartesianPoint
    [[nodiscard]] std::optional<Vec3d> point(Value reference) const { return point(follow(reference)); }
    [[nodiscard]] std::optional<Vec3d> vertexPoint(Value reference) const;  ///< IfcVertexPoint
    [[nodiscard]] std::optional<Vec3d> direction(Value reference) const;    ///< IfcDirection, not normalized
    /// IfcAxis2Placement2D or 3D, IfcAxis1Placement (z is the axis); identity for anything else.
    [[nodiscard]] Transform axes(RecordIndex record) const;
    [[nodiscard]] Transform axes(Value reference) const { return axes(follow(reference)); }
    /// IfcCartesianTransformationOperator...
    [[nodiscard]] Transform transformation(Value reference) const;
    /// IfcLocalPlacement, IfcGridPlacement (on straight axes) or IfcLinearPlacement (by its distance along a curve that
    /// readCurve() knows, else by its Cartesian position) and those above it, in the world of the project.
    /// \param lost  names an unreadable level, or parts of a curve that are not exact; unchanged if there are none. The
    ///              placement then is that of the readable levels: a circle ends it. Without a place along a curve its
    ///              origin is NaN
    [[nodiscard]] Transform placement(RecordIndex record, std::string& lost) const;

    /// IfcAxis2PlacementLinear at a distance along a curve that readCurve() knows: x along it, y to its left.
    [[nodiscard]] std::optional<Transform> linearAxes(RecordIndex relative) const;

    double lengthUnit = 1;  ///< metres
    double angleUnit = 1;   ///< radians

private:
    static constexpr std::uint64_t kStepsPerRecord = 64;

    [[nodiscard]] std::optional<Transform> gridAxes(RecordIndex placement, RecordIndex& above) const;
    [[nodiscard]] std::optional<Transform> cartesianAxes(const Fields& fields, RecordIndex& above) const;
    bool readGridAxis(RecordIndex axis, double offset, Vec3d& from, Vec3d& along) const;

    const step::StepFile& step_;
    // Mutable: they record the reading, not the file.
    mutable step::MissingRecords missing_;
    mutable ReadGuard guard_;
    std::vector<Entity> entityOfType_;
    std::unordered_map<RecordIndex, RecordIndex> placementOfAxis_;  // grid axis -> placement of its grid
};

}  // namespace svt::readers::ifc
