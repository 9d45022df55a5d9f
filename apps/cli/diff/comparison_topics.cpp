#include <apps/cli/diff/comparison_topics.hpp>

#include <svt/compare/difference_volume.hpp>
#include <svt/core/names.hpp>
#include <svt/drawing/storey_floors.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>
#include <utility>

namespace svt::cli {
namespace {

using compare::Change, compare::ComparisonRow;

constexpr double kFieldOfView = 45, kAspect = 4.0 / 3;
constexpr double kSurroundings = 1.0;  // metres around an object that its picture shows

// Boxes of the features of one volume, in world space.
class FeatureBoxes {
public:
    explicit FeatureBoxes(const volume::SemanticVolume& volume)
        : volume_(volume), extents_(drawing::labelExtents(volume)) {}

    [[nodiscard]] Box3d of(const std::vector<std::uint32_t>& labels) const {
        Box3d box;
        for (const std::uint32_t label : labels)
            for (std::uint32_t l = label; l < std::max(label + 1, volume_.labels.labels[label].subtreeEnd); ++l)
                add(extents_[l].box, box);
        return box;
    }
    [[nodiscard]] Box3d ofAll() const {
        Box3d box;
        for (const drawing::LabelExtent& extent : extents_) add(extent.box, box);
        return box;
    }

private:
    void add(const Box3d& local, Box3d& box) const {
        if (local.isEmpty()) return;
        const auto& axes = volume_.grid.axes();
        for (int corner = 0; corner < 8; ++corner) {
            const Vec3d p{corner & 1 ? local.max.x : local.min.x, corner & 2 ? local.max.y : local.min.y,
                          corner & 4 ? local.max.z : local.min.z};
            box.add(volume_.grid.origin() + axes[0] * p.x + axes[1] * p.y + axes[2] * p.z);
        }
    }
    const volume::SemanticVolume& volume_;
    std::vector<drawing::LabelExtent> extents_;
};

std::string joined(const std::vector<std::string>& ids) { return fmt::format("{}", fmt::join(ids, ", ")); }

std::string attributeText(const std::optional<AttributeList>& list) { return list ? toJsonText(*list) : "none"; }

std::string volumeText(const ComparisonRow& row) {
    if (!changedVolume(row)) return "m3 added and removed: unknown";
    return fmt::format("{:.4f} m3 added, {:.4f} m3 removed, {}, {}", row.added.value_or(0), row.removed.value_or(0),
                       row.bound ? fmt::format("each +- {:.4f} m3", *row.bound) : "bound unknown",
                       row.isExact ? "from closed meshes" : "counted in voxels");
}

// One line per property of the row.
std::string descriptionOf(const ComparisonRow& row, const StateFeatures& was, const StateFeatures& is) {
    constexpr std::size_t kMostAttributes = 20;
    const RowSubject subject = subjectOf(row, was, is);
    std::string text = fmt::format("Change: {}\nClass: {}\n", nameOf(row.change), (*subject).className);
    if (const std::string storey = subject.storey(); !storey.empty()) text += "Storey: " + storey + "\n";
    if (!row.was.empty()) text += "Old: " + joined(was.ids(row.was)) + "\n";
    if (!row.is.empty()) text += "New: " + joined(is.ids(row.is)) + "\n";
    if (row.vector)
        text += fmt::format("Moved by: {:.4f}, {:.4f}, {:.4f} m\n", row.vector->x, row.vector->y, row.vector->z);
    if (row.rotation) text += fmt::format("Turned by: {:.3f} degrees about the vertical\n", *row.rotation);
    if (row.hasGeometry && row.change != Change::Same) text += volumeText(row) + "\n";
    if (row.distance && row.change != Change::Same)
        text += fmt::format("Largest distance of sampled points: {:.4f} m\n", *row.distance);
    if (row.was.size() == 1 && row.is.size() == 1) {
        const std::uint32_t a = row.was.front(), b = row.is.front();
        if (row.hasOtherClass) text += fmt::format("class: {} -> {}\n", was[a].className, is[b].className);
        if (row.hasOtherName) text += fmt::format("name: {} -> {}\n", was[a].name, is[b].name);
        if (row.hasOtherStorey) text += fmt::format("storey: {} -> {}\n", was.storeyOf(a), is.storeyOf(b));
    }
    for (std::size_t n = 0; n < std::min(row.attributes.size(), kMostAttributes); ++n)
        text += fmt::format("{}: {} -> {}\n", row.attributes[n].name, attributeText(row.attributes[n].was),
                            attributeText(row.attributes[n].is));
    if (row.attributes.size() > kMostAttributes)
        text += fmt::format("{} more attributes differ\n", row.attributes.size() - kMostAttributes);
    return text;
}

std::string titleOf(const ComparisonRow& row, const volume::Label& label) {
    std::string title = fmt::format("{}: {}", nameOf(row.change == Change::Same ? Change::Changed : row.change),
                                    label.name.empty() ? label.id : label.name);
    if (row.change == Change::Same) return title + " (properties only)";
    if (const auto volume = changedVolume(row)) title += fmt::format(" ({:.3f} m3)", *volume);
    return title;
}

std::array<int, 3> colorOf(Change change) {
    const Vec3f color = compare::colorOfChange(change);
    const auto byte = [](float part) { return static_cast<int>(part * 255 + 0.5f); };
    return {byte(color.x), byte(color.y), byte(color.z)};
}

// A camera that looks at the centre of the box from the south-east and above, and sees the box and its surroundings.
writers::BcfCamera cameraOf(const Box3d& box) {
    constexpr double kHalfAngle = kFieldOfView / 2 * 3.14159265358979323846 / 180;
    const double radius = length(box.size()) / 2;
    const Vec3d along = normalized(Vec3d{-1, 1, -1});
    const double distance = (radius + std::max(kSurroundings, radius / 2)) / std::sin(kHalfAngle);
    return {box.center() - along * distance, along, {0, 0, 1}, kFieldOfView, kAspect};
}

}  // namespace

Result<std::vector<writers::BcfTopic>> changeTopics(const Compared& compared, std::span<const std::uint32_t> rows,
                                                    ChangePictures* pictures) {
    const StateFeatures was(compared.was), is(compared.is);
    const FeatureBoxes before(compared.was), after(compared.is);
    std::unordered_map<std::string, int> uses;
    std::vector<writers::BcfTopic> topics;
    for (const std::uint32_t r : rows) {
        const ComparisonRow& row = compared.comparison.rows[r];
        const bool isGone = row.is.empty();
        const RowSubject subject = subjectOf(row, was, is);
        writers::BcfTopic topic;
        topic.key = fmt::format("{} {} -> {}", nameOf(row.change), joined(was.ids(row.was)), joined(is.ids(row.is)));
        // Features of a file may share an id.
        if (const int use = ++uses[topic.key]; use > 1) topic.key += fmt::format(" #{}", use);
        topic.type = nameOf(row.change == Change::Same ? Change::Changed : row.change);
        topic.title = titleOf(row, *subject);
        topic.description = descriptionOf(row, was, is);
        topic.files = {isGone ? compared.wasFile : compared.isFile};
        topic.components = isGone ? was.ids(row.was) : is.ids(row.is);
        topic.color = colorOf(row.change);
        Box3d box = isGone ? before.of(row.was) : after.of(row.is);
        if (box.isEmpty()) box = isGone ? before.ofAll() : after.ofAll();
        if (box.isEmpty()) box.add(compared.is.grid.origin());
        topic.camera = cameraOf(box);
        if (pictures != nullptr) {
            SVT_TRY(picture, pictures->drawView(topic.camera.eye, box.center(), kFieldOfView, topic.components));
            topic.snapshot = std::move(*picture);
        }
        // The new model was moved for the comparison; its own coordinates are without the move.
        if (!isGone) topic.camera.eye = topic.camera.eye - compared.shift;
        topics.push_back(std::move(topic));
    }
    return topics;
}

}  // namespace svt::cli
