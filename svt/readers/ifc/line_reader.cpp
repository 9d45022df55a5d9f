#include <svt/readers/ifc/line_reader.hpp>

#include <svt/readers/ifc_shape/curves.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace svt::readers::ifc {
namespace {

class LineReader {
public:
    LineReader(const IfcFile& file, std::vector<std::string>& leftOut) : file_(file), leftOut_(leftOut) {}

    void readItem(RecordIndex item, const Transform& place) {
        ReadGuard::Scope scope(file_.guard());
        if (!scope.enter(item)) return leaveOut(scope.why());
        const Fields fields = file_.fieldsOf(item);
        switch (file_.entityOf(item)) {
            case Entity::GeometricSet:
            case Entity::GeometricCurveSet:
                for (const RecordIndex element : file_.followAll(fields[0])) readItem(element, place);
                return;
            case Entity::AnnotationFillArea:
                readItem(file_.follow(fields[0]), place);
                for (const RecordIndex inner : file_.followAll(fields[1])) readItem(inner, place);
                return;
            case Entity::MappedItem: {
                const Fields source = file_.fieldsOf(file_.follow(fields[0]));
                const Transform origin = file_.axes(file_.follow(source[0]));
                const Transform inner =
                    place.after(file_.transformation(file_.follow(fields[1]))).after(origin.inverse());
                for (const RecordIndex shown : file_.followAll(file_.fieldsOf(file_.follow(source[1]))[3]))
                    readItem(shown, inner);
                return;
            }
            default:
                scope.leave();  // readCurve() enters it
                readLine(item, place);
        }
    }

    std::vector<std::vector<Vec3d>> lines;

private:
    void leaveOut(std::string what) {
        if (leftOut_.size() == kMaxLeftOut) return;
        if (std::find(leftOut_.begin(), leftOut_.end(), what) == leftOut_.end()) leftOut_.push_back(std::move(what));
    }

    void readLine(RecordIndex item, const Transform& place) {
        std::vector<Vec3d> points;
        std::string why;
        if (!readCurve(file_, item, points, why)) return leaveOut(std::move(why));
        for (Vec3d& p : points) p = place.point(p);
        if (points.size() < 2 || !std::all_of(points.begin(), points.end(), [](Vec3d p) { return isFinite(p); }))
            return;
        lines.push_back(std::move(points));
    }

    const IfcFile& file_;
    std::vector<std::string>& leftOut_;
};

}  // namespace

std::vector<std::vector<Vec3d>> readLines(const IfcFile& file, RecordIndex definition,
                                          std::vector<std::string>& leftOut) {
    LineReader reader(file, leftOut);
    for (const RecordIndex representation : file.followAll(file.fieldsOf(definition)[2]))
        for (const RecordIndex item : file.followAll(file.fieldsOf(representation)[3])) reader.readItem(item, {});
    return std::move(reader.lines);
}

}  // namespace svt::readers::ifc
