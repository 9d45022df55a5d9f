#include <svt/core/file.hpp>
#include <svt/core/text.hpp>
#include <svt/writers/labels/label_looks.hpp>
#include <svt/writers/simulation/fds_writer.hpp>
#include <svt/writers/simulation/solid_boxes.hpp>
#include <svt/writers/volume_formats.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>

namespace svt::writers {
namespace {

using analyze::GroupBox;

// Fortran text in quotes: plain ASCII of at most `most` characters, other characters become '_'.
std::string fdsText(std::string_view text, std::size_t most) {
    std::string result;
    for (std::size_t i = 0; i < text.size() && result.size() < most;) {
        const Utf8Character character = firstCharacter(text.substr(i));
        const bool isPlain =
            character.code >= ' ' && character.code < 127 && character.code != '\'' && character.code != '"';
        result += isPlain ? static_cast<char>(character.code) : '_';
        i += std::max<std::size_t>(character.size, 1);
    }
    return result;
}

// The next number from `count` on without a prime factor over 5.
int smoothCount(int count) {
    for (;; ++count) {
        int rest = count;
        for (const int factor : {2, 3, 5})
            while (rest % factor == 0) rest /= factor;
        if (rest == 1) return count;
    }
}

class FdsDocument {
public:
    FdsDocument(const volume::SemanticVolume& volume, const SolidBoxes& solids) : grid_(volume.grid), solids_(solids) {
        std::set<std::string> used;
        for (const SolidGroup& group : solids.groups) {
            const std::string name = fdsText(group.name, 44);
            std::string id = name;
            for (int n = 2; !used.insert(id).second; ++n) id = fmt::format("{} {}", name, n);
            ids_.push_back(std::move(id));
        }
    }

    void head(const volume::SemanticVolume& volume, std::string_view name) {
        std::string chid = fdsText(name, 40);
        std::replace_if(
            chid.begin(), chid.end(), [](char c) { return !isDigit(c) && !isLetter(c) && c != '-'; }, '_');
        line("&HEAD CHID='{}', TITLE='{}' /", chid, fdsText(volume.modelName.empty() ? name : volume.modelName, 200));
        line("");
        line("Geometry by SVT. {}; CRS: {}", placeText(grid_),
             volume.crsName.empty() ? "unknown" : fdsText(volume.crsName, 200));
        line(
            "T_END = 0 only sets up the geometry, to be looked at in Smokeview. Lines that do not begin with & are "
            "comments.");
        line("");
        const Vec3i size = grid_.dimension();
        const Vec3i cells{smoothCount(size.x), smoothCount(size.y), smoothCount(size.z)};
        line("&MESH IJK={},{},{}, XB={} /", cells.x, cells.y, cells.z, bounds({}, cells));
        line("&TIME T_END=0. /");
        for (const char* side : {"XMIN", "XMAX", "YMIN", "YMAX", "ZMAX"}) line("&VENT MB='{}', SURF_ID='OPEN' /", side);
        line("");
    }

    void surfaces() {
        for (std::size_t g = 0; g < ids_.size(); ++g) {
            const Vec3f& c = solids_.groups[g].color;
            const std::string rgb = fmt::format("{},{},{}", colorByte(c.x), colorByte(c.y), colorByte(c.z));
            line("&SURF ID='{}', RGB={} /", ids_[g], rgb);
            if (solids_.groups[g].hasVents) line("&SURF ID='{} vent', RGB={} /", ids_[g], rgb);
        }
        line("");
    }

    void boxes() {
        for (const GroupBox& box : solids_.boxes)
            line("&OBST XB={}, SURF_ID='{}' /", bounds(box.box.begin, box.box.end), ids_[box.group]);
        for (const GroupBox& box : solids_.boxes) {
            if (solids_.groups[box.group].hasVents) vents(box);
            // After all obstacles: a hole takes from those before it.
            if (solids_.groups[box.group].isHole)
                line("&HOLE XB={} / {}", bounds(box.box.begin, box.box.end), ids_[box.group]);
        }
        line("");
        line("&TAIL /");
    }

    [[nodiscard]] std::string take() { return std::move(text_); }

private:
    template <class... Arguments>
    void line(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
        fmt::format_to(std::back_inserter(text_), format, std::forward<Arguments>(arguments)...);
        text_ += '\n';
    }

    // XB: x0, x1, y0, y1, z0, z1, to a tenth of a millimetre.
    [[nodiscard]] std::string bounds(Vec3i begin, Vec3i end) const {
        const Vec3d low = cornerOf(begin, grid_), high = cornerOf(end, grid_);
        return fmt::format("{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f}", low.x, high.x, low.y, high.y, low.z, high.z);
    }

    // On the two sides across which the box is thinnest.
    void vents(const GroupBox& box) {
        const Vec3d size = cornerOf(box.box.end, grid_) - cornerOf(box.box.begin, grid_);
        const int axis = size.x <= size.y && size.x <= size.z ? 0 : size.y <= size.z ? 1 : 2;
        for (const int side : {0, 1}) {
            Vec3i begin = box.box.begin, end = box.box.end;
            if (side == 0)
                end[axis] = begin[axis];
            else
                begin[axis] = end[axis];
            line("&VENT XB={}, SURF_ID='{} vent' /", bounds(begin, end), ids_[box.group]);
        }
    }

    const volume::Grid& grid_;
    const SolidBoxes& solids_;
    std::vector<std::string> ids_;
    std::string text_;
};

}  // namespace

Result<std::string> makeFds(const volume::SemanticVolume& volume, std::string_view name,
                            const VolumeWriteOptions& options) {
    SVT_TRY(solids, solidBoxes(volume, options));
    FdsDocument document(volume, *solids);
    document.head(volume, name);
    document.surfaces();
    document.boxes();
    return document.take();
}

extern const VolumeFormat kFds{
    .name = "fds",
    .endings = ".fds",
    .holds = "geometry for fire and smoke: components as boxes on a mesh of the voxels",
    .readers = "FDS and Smokeview (NIST), PyroSim",
    .content = FileContent::Text,
    .write = [](const auto& volume, const auto& path, const auto& options) -> Result<std::uint64_t> {
        SVT_TRY(document, makeFds(volume, path.stem().string(), options));
        return writeFileAtomically(path, *document);
    }};

}  // namespace svt::writers
