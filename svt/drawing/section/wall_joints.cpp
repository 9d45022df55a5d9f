#include <svt/drawing/section/wall_joints.hpp>

#include <svt/drawing/hatches.hpp>
#include <svt/drawing/levels/level_parts.hpp>
#include <svt/model/classes.hpp>

#include <cstdint>
#include <vector>

namespace svt::drawing {
namespace {

using volume::kNoLabel;

enum class WallAnswer : std::uint8_t { Unknown, No, Yes };

// Finds the joints among borders. Each label is asked once whether it is a wall.
class WallJoints {
public:
    WallJoints(const volume::LabelTable& table, const DrawingTables& tables)
        : table_(table), tables_(tables), isWall_(table.labels.size(), WallAnswer::Unknown) {}

    [[nodiscard]] bool isJoint(std::uint32_t a, std::uint32_t b) {
        if (a == kNoLabel || b == kNoLabel || !isWall(a) || !isWall(b)) return false;
        if (wallOf(a) == wallOf(b)) return false;
        const std::vector<LabelFacts>& facts = tables_.facts();
        if (facts[a].building != facts[b].building) return false;
        const HatchChoice &x = tables_.hatchChoices()[a], &y = tables_.hatchChoices()[b];
        return x.hatch == y.hatch && x.material == y.material;
    }

private:
    [[nodiscard]] bool isWall(std::uint32_t label) {
        if (isWall_[label] == WallAnswer::Unknown) {
            const volume::Label& of = table_.labels[label];
            const bool isYes =
                isWallPart(of) || of.className == "InteriorWallSurface" || (isPart(label) && isWall(of.parent));
            isWall_[label] = isYes ? WallAnswer::Yes : WallAnswer::No;
        }
        return isWall_[label] == WallAnswer::Yes;
    }
    // A layer or a phase. Windows are also children of walls.
    [[nodiscard]] bool isPart(std::uint32_t label) const {
        const volume::Label& of = table_.labels[label];
        if (of.parent >= label) return false;
        if (model::isPhase(of.className)) return true;
        for (const Attribute& attribute : of.attributes)
            if (attribute.name == "layer") return true;
        return false;
    }
    // The wall that has the layer or the phase.
    [[nodiscard]] std::uint32_t wallOf(std::uint32_t label) const {
        while (isPart(label)) label = table_.labels[label].parent;
        return label;
    }

    const volume::LabelTable& table_;
    const DrawingTables& tables_;
    std::vector<WallAnswer> isWall_;
};

}  // namespace

void joinWalls(SectionDrawing& drawing, const volume::LabelTable& table, const DrawingTables& tables) {
    WallJoints joints(table, tables);
    std::erase_if(drawing.borders,
                  [&](const SectionBorder& border) { return joints.isJoint(border.left, border.right); });
}

}  // namespace svt::drawing
