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
                for (const RecordIndex element : file_.followAll(fields[at::GeometricSet::Elements]))
                    readItem(element, place);
                return;
            case Entity::AnnotationFillArea:
                readItem(file_.follow(fields[at::AnnotationFillArea::OuterBoundary]), place);
                for (const RecordIndex inner : file_.followAll(fields[at::AnnotationFillArea::InnerBoundaries]))
                    readItem(inner, place);
                return;
            case Entity::MappedItem: {
                const Fields source = file_.fieldsOf(file_.follow(fields[at::MappedItem::MappingSource]));
                const Transform origin = file_.axes(source[at::RepresentationMap::MappingOrigin]);
                const Transform target = file_.transformation(fields[at::MappedItem::MappingTarget]);
                const Transform inner = place.after(target).after(origin.inverse());
                const RecordIndex shown = file_.follow(source[at::RepresentationMap::MappedRepresentation]);
                for (const RecordIndex part : file_.items(shown)) readItem(part, inner);
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
    for (const RecordIndex representation : file.representations(definition))
        for (const RecordIndex item : file.items(representation)) reader.readItem(item, {});
    return std::move(reader.lines);
}

}  // namespace svt::readers::ifc
