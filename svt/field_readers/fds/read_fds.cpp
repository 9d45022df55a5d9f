#include <svt/field_readers/fds/read_fds.hpp>

#include <svt/core/file.hpp>
#include <svt/core/text.hpp>
#include <svt/field_readers/common/placement.hpp>
#include <svt/field_readers/fds/case_frame.hpp>
#include <svt/field_readers/fds/devices.hpp>
#include <svt/field_readers/fds/frame_file.hpp>
#include <svt/field_readers/fds/joined_pieces.hpp>
#include <svt/field_readers/fds/smoke_codes.hpp>
#include <svt/field_readers/fds/smv_file.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

namespace svt::field_readers {
namespace {

constexpr std::uint64_t kMaxSmv = std::uint64_t{1} << 30;

// Pieces of one quantity that may share a lattice.
struct Group {
    std::string name;
    std::vector<Piece> pieces;
};

class FdsReader {
public:
    FdsReader(Reading& reading, SmvCase fds) : reading_(reading), fds_(std::move(fds)) {}

    Result<std::vector<fields::Field>> read() {
        frame_ = frameOfCase(fds_, reading_, place_);
        SVT_DO(checkQuantity());
        std::vector<Group> groups;
        for (const SmvFile& file : fds_.files) {
            if (!isAsked(file)) continue;
            SVT_TRY(piece, listPiece(file));
            if (*piece) addToGroup(std::move(**piece), groups);
        }
        leaveOutSmoke(groups);
        nameGroups(groups);
        for (const Group& group : groups) SVT_DO(readGroup(group));
        SVT_DO(readDevices(fds_, frame_, place_, reading_, fields_));
        noteLeftOut();
        return std::move(fields_);
    }

private:
    [[nodiscard]] bool isAsked(const SmvFile& file) const {
        const std::string name = fieldName(file.quantity, "fds");
        return isAskedFor(reading_.options, std::array<std::string_view, 3>{file.quantity, file.shortName, name});
    }

    // A quantity that the case does not have is a mistake of the user.
    [[nodiscard]] Result<void> checkQuantity() const {
        std::set<std::string> known;
        for (const SmvFile& file : fds_.files) known.insert(file.quantity);
        for (const auto& [name, device] : fds_.devices)
            if (!fds_.deviceFile.empty()) known.insert(device.quantity);
        const auto isFound = [&](const SmvFile& file) { return isAsked(file); };
        if (std::find_if(fds_.files.begin(), fds_.files.end(), isFound) != fds_.files.end()) return {};
        for (const std::string& quantity : known)
            if (isAskedFor(reading_.options,
                           std::array<std::string_view, 2>{quantity, std::string_view(fieldName(quantity, "fds"))}))
                return {};
        if (known.empty())
            return badField("the case has no slices (SLCF), no smoke (SMOKF3D) and no devices", reading_.path);
        std::string list;
        for (const std::string& quantity : known) list += (list.empty() ? "" : ", ") + quantity;
        return Error(Code::BadArgument,
                     fmt::format("the case has no quantity '{}'; it has: {}", reading_.options.quantity, list),
                     {reading_.path.string(), 0, 0, {}});
    }

    // Lists the frames of a file. Without frames: a warning, and nothing.
    Result<std::optional<Piece>> listPiece(const SmvFile& file) {
        using Listed = std::optional<Piece>;
        const std::filesystem::path path = reading_.path.parent_path() / std::filesystem::path(file.file).filename();
        std::error_code error;
        if (!std::filesystem::exists(path, error)) {
            reading_.warn(Code::FieldInPart,
                          fmt::format("the file of '{}' is missing; its values are left out", file.quantity),
                          path.string());
            return Listed();
        }
        Piece piece{&file, &fds_.meshes[file.mesh], {}, {}, {}};
        SVT_TRY(list, file.kind == SmvKind::Smoke ? listSmokeFrames(path) : listSliceFrames(path));
        piece.list = std::move(*list);
        if (piece.list.cutAt)
            reading_.warn(
                Code::FieldInPart,
                fmt::format(
                    "the file ends within the frame at byte {}: {} whole frames are read{}", *piece.list.cutAt,
                    piece.list.wholeFrames,
                    piece.list.times.empty() ? "" : fmt::format(", the last at {:.6g} s", piece.list.times.back())),
                path.string());
        if (piece.list.replaced > 0)
            reading_.note(
                fmt::format("the run was started again: {} frames are replaced by later ones of the same times",
                            piece.list.replaced),
                path.string());
        if (piece.list.times.empty()) {
            if (!piece.list.cutAt) reading_.warn(Code::FieldInPart, "the file has no frames yet", path.string());
            return Listed();
        }
        SVT_TRY(hasPlaces, setPlaces(piece));
        if (!*hasPlaces) return Listed();
        return Listed(std::move(piece));
    }

    // The places of the values of a piece. \return false if all are ghost cells
    Result<bool> setPlaces(Piece& piece) const {
        for (int axis = 0; axis < 3; ++axis) {
            const auto a = static_cast<std::size_t>(axis);
            const std::int32_t first = piece.list.bounds[2 * a], last = piece.list.bounds[2 * a + 1];
            const std::vector<double>& nodes = piece.mesh->nodes[a];
            const bool isCell = piece.file->kind == SmvKind::CellSlice;
            if (last > piece.mesh->cells[axis] + (isCell ? 1 : 0))
                return badField(fmt::format("the values reach to index {}, but mesh '{}' has {} cells along this axis",
                                            last, piece.mesh->name, piece.mesh->cells[axis]),
                                piece.list.path);
            if (!isCell) {
                piece.places[a].assign(nodes.begin() + first, nodes.begin() + last + 1);
                continue;
            }
            for (std::int32_t cell = std::max(first, 1); cell <= std::min(last, piece.mesh->cells[axis]); ++cell) {
                const auto c = static_cast<std::size_t>(cell);
                piece.places[a].push_back((nodes[c - 1] + nodes[c]) / 2);
            }
            piece.skipped[axis] = std::max(first, 1) - first;
            if (piece.places[a].empty()) {
                reading_.warn(Code::FieldInPart, "all values are those of ghost cells; they are left out",
                              piece.list.path.string());
                return false;
            }
        }
        return true;
    }

    [[nodiscard]] static bool isFlat(const Piece& piece) noexcept {
        for (const auto& places : piece.places)
            if (places.size() == 1) return true;
        return false;
    }

    // Whether two pieces are results of one line of the input.
    [[nodiscard]] static bool isSameOutput(const Piece& a, const Piece& b) noexcept {
        if (a.file->kind != b.file->kind || a.file->quantity != b.file->quantity) return false;
        if (a.file->kind == SmvKind::Smoke) return true;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto &one = a.places[axis], &other = b.places[axis];
            if ((one.size() == 1) != (other.size() == 1)) return false;
            if (one.size() == 1 && a.file->slice < 0 && std::abs(one[0] - other[0]) > 1e-3) return false;
        }
        return a.file->slice == b.file->slice;
    }

    static void addToGroup(Piece piece, std::vector<Group>& groups) {
        for (Group& group : groups) {
            const auto isOfMesh = [&](const Piece& other) { return other.mesh == piece.mesh; };
            if (isSameOutput(group.pieces[0], piece) &&
                std::find_if(group.pieces.begin(), group.pieces.end(), isOfMesh) == group.pieces.end()) {
                group.pieces.push_back(std::move(piece));
                return;
            }
        }
        Group group;
        group.pieces.push_back(std::move(piece));
        groups.push_back(std::move(group));
    }

    // A slice through all of a mesh has the same values without the 8 bits.
    void leaveOutSmoke(std::vector<Group>& groups) const {
        std::set<std::string> whole;
        for (const Group& group : groups)
            if (group.pieces[0].file->kind != SmvKind::Smoke && !isFlat(group.pieces[0]))
                whole.insert(group.pieces[0].file->quantity);
        std::erase_if(groups, [&](const Group& group) {
            const SmvFile& file = *group.pieces[0].file;
            if (file.kind != SmvKind::Smoke || whole.count(file.quantity) == 0) return false;
            reading_.note(fmt::format("the 8-bit values of '{}' (SMOKF3D) are left out: a slice has them in full",
                                      file.quantity));
            return true;
        });
    }

    // Names: the quantity, the place of a plane, and a number where both are equal.
    static void nameGroups(std::vector<Group>& groups) {
        std::set<std::string> used;
        for (Group& group : groups) {
            const Piece& piece = group.pieces[0];
            std::string name = fieldName(piece.file->quantity, "fds");
            for (std::size_t axis = 0; axis < 3; ++axis)
                if (piece.places[axis].size() == 1)
                    name += fmt::format("_{}{:.6g}", "xyz"[axis], std::round(piece.places[axis][0] * 1e4) / 1e4 + 0.0);
            group.name = name;
            for (int n = 2; !used.insert(group.name).second; ++n) group.name = fmt::format("{}_{}", name, n);
        }
    }

    Result<void> readGroup(const Group& group) {
        if (const auto joined = joinPieces(group.pieces)) return readField(group.name, group.pieces, *joined);
        reading_.note(fmt::format("the {} meshes of '{}' have no common lattice or times; each becomes a field",
                                  group.pieces.size(), group.name));
        std::map<std::string, int> meshNames;
        for (const Piece& piece : group.pieces) ++meshNames[fieldName(piece.mesh->name, "")];
        for (const Piece& piece : group.pieces) {
            const std::span<const Piece> one(&piece, 1);
            std::string mesh = fieldName(piece.mesh->name, "");
            if (mesh.empty() || mesh.size() > 30 || meshNames[mesh] > 1)
                mesh = fmt::format("mesh{}", piece.file->mesh + 1);
            if (const auto joined = joinPieces(one)) SVT_DO(readField(group.name + "." + mesh, one, *joined));
        }
        return {};
    }

    Result<void> readField(const std::string& name, std::span<const Piece> pieces, const Joined& joined) {
        std::size_t common = pieces[0].list.times.size(), most = common;
        for (const Piece& piece : pieces) {
            common = std::min(common, piece.list.times.size());
            most = std::max(most, piece.list.times.size());
        }
        if (common < most)
            reading_.warn(Code::FieldInPart,
                          fmt::format("'{}': some meshes have {} frames and others {}; the first {} are read", name,
                                      most, common, common));
        Assumptions assumptions = place_;
        fields::Field field;
        field.head.name = name;
        SVT_TRY(placed, placeLattice(joined.places, frame_, reading_.volume.grid));
        if (!boxOf(placed->lattice).overlaps(boxOf(reading_.volume.grid))) {
            outside_.push_back(outsideError(name, boxOf(placed->lattice), reading_));
            return {};
        }
        const auto times = std::span(pieces[0].list.times).first(common);
        SVT_TRY(kept, keptTimes(times, reading_, name));
        const Vec3i size = joined.size();
        const std::size_t nodes = std::size_t(size.x) * std::size_t(size.y) * std::size_t(size.z);
        SVT_DO(reading_.addValues(nodes, kept->size(), name));
        field.values.assign(nodes * kept->size(), std::numeric_limits<float>::quiet_NaN());
        field.head.times.clear();
        for (const std::size_t t : *kept) field.head.times.push_back(times[t]);
        for (std::size_t p = pieces.size(); p-- > 0;)  // values of the first mesh count where two meet
            SVT_DO(readPiece(pieces[p], joined, p, *kept, field.values, p == 0 ? &assumptions : nullptr));
        reorder(*placed, size, field.values);
        field.head.lattice = std::move(placed->lattice);
        SVT_DO(finish(*pieces[0].file, std::move(field), assumptions));
        return {};
    }

    // Copies the values of a piece to its places in the common lattice.
    Result<void> readPiece(const Piece& piece, const Joined& joined, std::size_t p, std::span<const std::size_t> kept,
                           std::vector<float>& to, Assumptions* assumptions) {
        SVT_TRY(file, RecordFile::open(piece.list.path));
        std::array<float, 256> codes{};
        if (piece.file->kind == SmvKind::Smoke) {
            Assumptions ignored;
            SVT_TRY(values,
                    smokeValues(*piece.file, *piece.mesh, fds_, reading_, assumptions ? *assumptions : ignored));
            codes = *values;
        }
        const Vec3i size = joined.size();
        const std::size_t nodes = std::size_t(size.x) * std::size_t(size.y) * std::size_t(size.z);
        std::vector<float> frame;
        std::vector<std::uint8_t> bytes;
        for (std::size_t t = 0; t < kept.size(); ++t) {
            frame.clear();
            if (piece.file->kind == SmvKind::Smoke) {
                bytes.clear();
                SVT_DO(readSmokeFrame(*file, piece.list, kept[t], bytes));
                frame.reserve(bytes.size());
                for (const std::uint8_t byte : bytes) frame.push_back(codes[byte]);
                saturated_ += static_cast<std::uint64_t>(std::count(bytes.begin(), bytes.end(), std::uint8_t{254}));
            } else {
                SVT_DO(readSliceFrame(*file, piece.list, kept[t], frame));
            }
            copyFrame(piece, joined.first[p], size, frame, std::span(to).subspan(t * nodes, nodes));
        }
        return {};
    }

    void copyFrame(const Piece& piece, const std::array<std::size_t, 3>& first, Vec3i size,
                   std::span<const float> frame, std::span<float> to) {
        const Vec3i stored = piece.list.size();
        const auto index = [](Vec3i n, std::size_t i, std::size_t j, std::size_t k) {
            return i + std::size_t(n.x) * (j + std::size_t(n.y) * k);
        };
        const auto skipped = [&](int axis) { return static_cast<std::size_t>(piece.skipped[axis]); };
        for (std::size_t k = 0; k < piece.places[2].size(); ++k)
            for (std::size_t j = 0; j < piece.places[1].size(); ++j)
                for (std::size_t i = 0; i < piece.places[0].size(); ++i) {
                    float value = frame[index(stored, i + skipped(0), j + skipped(1), k + skipped(2))];
                    if (!std::isfinite(value)) {
                        value = std::numeric_limits<float>::quiet_NaN();
                        ++notFinite_;
                    }
                    to[index(size, i + first[0], j + first[1], k + first[2])] = value;
                }
    }

    Result<void> finish(const SmvFile& file, fields::Field field, Assumptions& assumptions) {
        fields::FieldHead& head = field.head;
        head.kind = fields::FieldKind::Grid;
        head.quantity = lowerAscii(file.quantity);
        head.medium = reading_.options.medium.empty() ? "air" : reading_.options.medium;
        head.by = fds_.version.empty() ? "FDS" : fds_.version;
        if (file.kind == SmvKind::CellSlice) assumptions.add("places", "centres of cells");
        if (notFinite_ > 0)
            reading_.warn(Code::BadField,
                          fmt::format("'{}': {} values are not finite; they count as missing", head.name, notFinite_));
        if (saturated_ > 0)
            reading_.warn(Code::FieldInPart,
                          fmt::format("'{}': {} values are at the upper end of the 8 bits and may be higher; write the "
                                      "quantity as a slice (SLCF) to have them in full",
                                      head.name, saturated_));
        notFinite_ = saturated_ = 0;
        SVT_DO(setUnit(field, file.unit, reading_, assumptions));
        setPrecision(field, reading_, assumptions);
        head.parameters = assumptions.json();
        fields_.push_back(std::move(field));
        return {};
    }

    void noteLeftOut() const {
        if (!reading_.options.quantity.empty() || fds_.leftOut.empty()) return;
        std::string list;
        for (const auto& [key, count] : fds_.leftOut)
            list += fmt::format("{}{} {}", list.empty() ? "" : ", ", count, key);
        reading_.note(fmt::format("results of other kinds are left out: {}", list));
    }

public:
    /// The fields that cover no part of the volume.
    [[nodiscard]] const std::vector<Error>& outside() const noexcept { return outside_; }

private:
    Reading& reading_;
    SmvCase fds_;
    Frame frame_;
    Assumptions place_;
    std::vector<fields::Field> fields_;
    std::vector<Error> outside_;
    std::uint64_t notFinite_ = 0, saturated_ = 0;  // of the field that is read
};

}  // namespace

Result<std::vector<fields::Field>> readFds(Reading& reading) {
    SVT_TRY(bytes, FileBytes::read(reading.path, kMaxSmv));
    SVT_TRY(fds, parseSmv(bytes->text(), reading.path));
    if (fds->isCut)
        reading.warn(Code::FieldInPart, "the .smv ends within its last entry, which is left out: FDS may still run");
    FdsReader reader(reading, std::move(*fds));
    SVT_TRY(fields, reader.read());
    if (fields->empty() && !reader.outside().empty()) return reader.outside().front();
    for (const Error& error : reader.outside()) reading.warn(error.code(), error.message());
    if (fields->empty()) return badField("no file of the case has a whole frame", reading.path);
    return std::move(*fields);
}

}  // namespace svt::field_readers
