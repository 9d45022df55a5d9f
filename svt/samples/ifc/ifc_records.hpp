#pragma once
/// \file
/// Records of a STEP file (ISO 10303-21) as IFC4 text: numbering, numbers, placements. Lengths are millimetres.

#include <svt/core/vec.hpp>
#include <svt/samples/formats/sample_text.hpp>
#include <svt/samples/formats/writers.hpp>

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>

namespace svt::samples {

/// Axes at right angles in the plan: x, y, z are unit vectors, the origin is in millimetres.
struct Frame {
    Vec3d x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1}, origin{};

    [[nodiscard]] Vec3d local(Vec3d plan) const {
        const Vec3d d = plan - origin;
        return {dot(d, x), dot(d, y), dot(d, z)};
    }
    [[nodiscard]] Vec3d localDirection(Vec3d plan) const { return {dot(plan, x), dot(plan, y), dot(plan, z)}; }
};

/// A number with up to `decimals` decimals and the point that STEP requires: "4610.", "195.217215".
[[nodiscard]] std::string stepNumber(double value, int decimals = 6);
/// The same for numerator / denominator, rounded without floating-point arithmetic.
[[nodiscard]] std::string stepRatio(std::int64_t numerator, std::int64_t denominator);
/// 'text'. Texts of samples are ASCII without quotes.
[[nodiscard]] std::string stepText(std::string_view text);

/// A value of a record: text as it is, a double by stepNumber(), another record as "#12" or "$" for 0, records as a
/// list "(#1,#2)".
[[nodiscard]] inline std::string stepValue(std::string_view text) { return std::string(text); }
[[nodiscard]] inline std::string stepValue(double number) { return stepNumber(number); }
[[nodiscard]] inline std::string stepValue(int record) { return record == 0 ? "$" : "#" + std::to_string(record); }
[[nodiscard]] std::string stepValue(std::span<const int> records);
/// Values with commas between them. The first is not empty.
template <class... Values>
[[nodiscard]] std::string stepValues(const Values&... values) {
    std::string text;
    ((text += (text.empty() ? "" : ",") + stepValue(values)), ...);
    return text;
}

class IfcRecords {
public:
    explicit IfcRecords(TextSink& out) : out_(out) {}

    /// Writes `#n=TYPE(values);`. \return n, starting with 1
    template <class... Values>
    int add(std::string_view type, const Values&... values) {
        return addText(type, stepValues(values...));
    }
    /// The same record for the same values, written once.
    template <class... Values>
    int shared(std::string_view type, const Values&... values) {
        return sharedText(type, stepValues(values...));
    }
    /// A rooted entity: GlobalId by `key`, no owner history, then `values`.
    template <class... Values>
    int rooted(std::string_view type, std::string_view key, const Values&... values) {
        return add(type, stepText(globalId(key)), "$", values...);
    }

    int point(Vec3d p);
    int point2(const std::string& x, const std::string& y);
    int direction(Vec3d d);
    int axes(const Frame& frame);
    /// IfcLocalPlacement in another one; 0: in the world.
    int placement(int above, const Frame& frame);

private:
    int addText(std::string_view type, const std::string& values);
    int sharedText(std::string_view type, const std::string& values);

    TextSink& out_;
    int last_ = 0;
    std::map<std::string, int> shared_;
};

}  // namespace svt::samples
