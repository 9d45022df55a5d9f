#include <svt/volume/volume_json.hpp>
#include <svt/volume/volume_part.hpp>
#include <svt/volume_readers/table/label_tables.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <utility>

namespace svt::volume_readers {
namespace {

using volume::kNoLabel;
using volume::Label;
using volume::LabelTable;
using volume::Scalar;

/// Values that occur, ascending, without background.
std::vector<Scalar> valuesOf(const volume::ColumnVolume& columns) {
    std::set<Scalar> values;
    for (const volume::ColumnTile& tile : columns.tiles()) {
        Scalar last = 0;
        for (const volume::Run& run : tile.runs)
            if (run.scalar != last) values.insert(last = run.scalar);
    }
    values.erase(0);
    return {values.begin(), values.end()};
}

/// A colour for the n-th label: hues by the golden angle, so that neighbours differ.
Vec3f colorOf(std::size_t number) {
    const double hue = std::fmod(0.61803398875 * static_cast<double>(number), 1.0) * 6;
    const auto channel = [&](double shift) {
        const double distance = std::abs(std::fmod(hue + shift, 6.0) - 3) - 1;
        return static_cast<float>(0.35 + 0.55 * std::clamp(distance, 0.0, 1.0));
    };
    return {channel(0), channel(4), channel(2)};
}

Result<volume::Grid> gridOf(const LabelImage& image) {
    if (image.grid) return *image.grid;
    Vec3d spacing;
    std::array<Vec3d, 3> axes;
    for (int axis = 0; axis < 3; ++axis) {
        const Vec3d step = image.steps[static_cast<std::size_t>(axis)];
        spacing[axis] = length(step);
        if (!isFinite(step) || !(spacing[axis] > 0) || !std::isfinite(spacing[axis]))
            return Error(Code::BadDimension, "the spacing of the image is zero or not a number");
        axes[static_cast<std::size_t>(axis)] = step / spacing[axis];
    }
    // Some files hold 32-bit floats: axes that are orthogonal up to their rounding are made orthogonal.
    const double skew =
        std::max({std::abs(dot(axes[0], axes[1])), std::abs(dot(axes[1], axes[2])), std::abs(dot(axes[2], axes[0]))});
    if (skew > 1e-3) return Error(Code::BadImage, "the axes of the image are not at right angles; resample it first");
    if (dot(cross(axes[0], axes[1]), axes[2]) < 0)
        return Error(Code::BadImage, "the axes of the image are mirrored (left-handed); flip one of them first");
    if (skew > 0) {
        axes[1] = normalized(axes[1] - axes[0] * dot(axes[0], axes[1]));
        axes[2] = cross(axes[0], axes[1]);
    }
    return volume::Grid::fromParts(image.dimension, spacing, image.origin, axes);
}

/// Whether the grid `told` by the file equals the one of `header`, up to a hundredth of a voxel. Then the latter is
/// exact.
bool isSamePlace(const volume::Grid& told, const volume::Grid& exact) {
    if (told.dimension() != exact.dimension()) return false;
    const Vec3d s = exact.spacing();
    const double tolerance = 0.011 * std::min({s.x, s.y, s.z});
    for (int corner = 0; corner < 8; ++corner) {
        Vec3d index{};
        for (int axis = 0; axis < 3; ++axis) index[axis] = (corner >> axis & 1) != 0 ? exact.dimension()[axis] - 1 : 0;
        if (!(length(told.worldFromIndex(index) - exact.worldFromIndex(index)) <= tolerance)) return false;
    }
    return true;
}

/// The header that `svt convert` wrote into the file, if it is complete.
std::optional<volume::SvtHeader> headerOf(const LabelImage& image) {
    if (image.headerJson.empty() || image.headerJson.size() > volume::kMaxHeaderBytes) return std::nullopt;
    auto header = volume::readHeaderJson(image.headerJson);
    if (!header) return std::nullopt;
    return std::move(*header);
}

/// The names of a header, or of a text that has only names.
void takeNames(const std::optional<volume::SvtHeader>& header, std::string_view text, volume::SemanticVolume& volume) {
    if (header) {
        volume.crsName = header->crsName;
        volume.modelName = header->modelName;
        volume.source = header->source;
        return;
    }
    if (text.size() > volume::kMaxHeaderBytes) return;
    const auto json = nlohmann::json::parse(text.begin(), text.end(), nullptr, false);
    if (!json.is_object()) return;
    const auto read = [&](const char* key, std::string& to) {
        if (const auto found = json.find(key); found != json.end() && found->is_string())
            to = found->get<std::string>();
    };
    read("crs", volume.crsName);
    read("model", volume.modelName);
    read("source", volume.source);
}

/// Puts told labels into tree order, assigns scalars in that order, and determines the scalar of each value.
class TableBuilder {
public:
    TableBuilder(const std::vector<ToldLabel>& told, const UserTable* user) : told_(told), user_(user) {
        for (std::size_t t = 0; t < told.size(); ++t) numberOf_.emplace(told[t].id, t);
        children_.resize(told.size());
        for (std::size_t t = 0; t < told.size(); ++t) {
            const auto parent = told[t].parent.empty() ? numberOf_.end() : numberOf_.find(told[t].parent);
            if (parent == numberOf_.end() || parent->second == t)
                roots_.push_back(t);
            else
                children_[parent->second].push_back(t);
        }
    }

    /// \return the labels, or BadVolume if a parent is below its own child
    Result<LabelTable> build() {
        for (const std::size_t root : roots_) add(root);
        if (placed_ != told_.size())
            return Error(Code::BadVolume, "parents of the table of labels go round in a circle");
        return std::move(table_);
    }

    /// The place in the table of each told label.
    [[nodiscard]] const std::vector<std::uint32_t>& labelOfTold() const noexcept { return labelOf_; }

private:
    // A loop, because a table may nest without limit.
    void add(std::size_t root) {
        struct Open {
            std::size_t told, nextChild;
        };
        std::vector<Open> open{{root, 0}};
        begin(root, kNoLabel);
        while (!open.empty()) {
            Open& top = open.back();
            if (top.nextChild == children_[top.told].size()) {
                table_.labels[labelOf_[top.told]].subtreeEnd = static_cast<std::uint32_t>(table_.labels.size());
                open.pop_back();
                continue;
            }
            const std::size_t child = children_[top.told][top.nextChild++];
            begin(child, labelOf_[top.told]);
            open.push_back({child, 0});
        }
    }

    void begin(std::size_t number, std::uint32_t parent) {
        const ToldLabel& told = told_[number];
        labelOf_.resize(told_.size(), kNoLabel);
        labelOf_[number] = static_cast<std::uint32_t>(table_.labels.size());
        ++placed_;
        Label& label = table_.labels.emplace_back();
        label.id = told.id;
        label.className = told.className.empty() ? "GenericCityObject" : told.className;
        label.name = told.name;
        label.parent = parent;
        label.color = told.hasColor ? told.color : colorOf(number);
        if (user_ == nullptr || number >= user_->attributes.size()) return;
        label.attributes = user_->attributes[number];
        label.opacity = user_->opacities[number];
    }

    const std::vector<ToldLabel>& told_;
    const UserTable* user_;
    std::map<std::string, std::size_t, std::less<>> numberOf_;
    std::vector<std::vector<std::size_t>> children_;
    std::vector<std::size_t> roots_;
    std::vector<std::uint32_t> labelOf_;
    std::size_t placed_ = 0;
    LabelTable table_;
};

/// For each value, the told label that has it; among several, the one with the fewest values, then the later one.
std::vector<std::uint32_t> ownersOf(const std::vector<Scalar>& values, const std::vector<ToldLabel>& told) {
    std::vector<std::uint32_t> order(told.size());
    for (std::uint32_t t = 0; t < order.size(); ++t) order[t] = t;
    std::stable_sort(order.begin(), order.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return told[a].count > told[b].count; });
    std::vector<std::uint32_t> owners(values.size(), kNoLabel);
    for (const std::uint32_t t : order) {
        if (told[t].count == 0) continue;
        const std::uint64_t end = std::uint64_t{told[t].first} + told[t].count;
        auto v =
            static_cast<std::size_t>(std::lower_bound(values.begin(), values.end(), told[t].first) - values.begin());
        for (; v < values.size() && values[v] < end; ++v) owners[v] = t;
    }
    return owners;
}

/// Columns whose scalars are those of `table`, which gets ranges: one scalar for each value that a label has.
Result<void> giveScalars(LabelTable& table, const std::vector<Scalar>& values,
                         const std::vector<std::uint32_t>& labelOfValue, volume::ColumnVolume& columns) {
    std::vector<std::vector<std::uint32_t>> valuesOfLabel(table.labels.size());
    for (std::uint32_t v = 0; v < values.size(); ++v) valuesOfLabel[labelOfValue[v]].push_back(v);
    std::vector<Scalar> scalarOfValue(values.size());
    Scalar next = 1;
    for (std::size_t l = 0; l < table.labels.size(); ++l) {
        if (valuesOfLabel[l].empty()) continue;
        table.labels[l].first = next;
        table.labels[l].count = static_cast<Scalar>(valuesOfLabel[l].size());
        table.labels[l].filling = volume::Filling::Solid;
        for (const std::uint32_t v : valuesOfLabel[l]) scalarOfValue[v] = next++;
    }
    // Values may be any number, so they are numbered first.
    std::vector<volume::ColumnTileData> tiles;
    const auto toScalar = [&](Scalar value) {
        return value == 0 ? 0
                          : scalarOfValue[static_cast<std::size_t>(
                                std::lower_bound(values.begin(), values.end(), value) - values.begin())];
    };
    for (const volume::ColumnTile& tile : columns.tiles()) {
        volume::ColumnTileData data{{tile.rowOf.begin(), tile.rowOf.end()},
                                    {tile.rowColumns.begin(), tile.rowColumns.end()},
                                    {tile.columnStart.begin(), tile.columnStart.end()},
                                    {tile.runs.begin(), tile.runs.end()}};
        for (volume::Run& run : data.runs) run.scalar = toScalar(run.scalar);
        tiles.push_back(std::move(data));
    }
    columns = volume::ColumnVolume::fromTiles(columns.dimension(), std::move(tiles));
    return {};
}

Result<void> takeTold(const std::vector<ToldLabel>& given, const UserTable* user, volume::SemanticVolume& volume) {
    const std::vector<Scalar> values = valuesOf(volume.columns);
    if (values.size() >= volume::kMaxScalarCount)
        return Error(Code::TooManyLabels,
                     fmt::format("{} different values; {} are possible", values.size(), volume::kMaxScalarCount - 1));
    std::vector<ToldLabel> told = given;
    auto owners = ownersOf(values, told);
    for (std::size_t v = 0; v < values.size(); ++v) {
        if (owners[v] != kNoLabel) continue;
        ToldLabel label;
        label.first = values[v];
        label.id = fmt::format("label-{}", values[v]);
        owners[v] = static_cast<std::uint32_t>(told.size());
        told.push_back(std::move(label));
    }
    std::set<std::string_view> ids;
    for (const ToldLabel& label : told)
        if (!ids.insert(label.id).second)
            return Error(Code::BadVolume,
                         fmt::format("the id '{}' stands twice in the table of labels", label.id.substr(0, 80)));
    TableBuilder builder(told, user);
    SVT_TRY(table, builder.build());
    for (std::uint32_t& owner : owners) owner = builder.labelOfTold()[owner];
    volume.labels = std::move(*table);
    return giveScalars(volume.labels, values, owners, volume.columns);
}

/// Counts the voxels of each label. The volume of a label becomes that of its voxels. If `hasVolumes` is true and no
/// voxel is missing, it stays that of its mesh.
void countAgain(volume::SemanticVolume& volume, bool hasVolumes) {
    const auto voxels = volume.columns.countVoxels(volume.labels.scalarCount());
    for (Label& label : volume.labels.labels) {
        std::uint64_t count = 0;
        for (Scalar s = 0; s < label.count; ++s) count += voxels[label.first + s];
        if (hasVolumes && count == label.voxels) continue;
        label.voxels = count;
        label.volume = static_cast<double>(count) * volume.grid.voxelVolume();
    }
}

/// The data that `svt convert` wrote into a file in addition to the samples.
struct Stated {
    std::optional<volume::SvtHeader> header;
    volume::LabelTable labels;
    std::optional<volume::VolumeSeal> seal;
};

constexpr std::string_view kRemedy =
    "copy or convert the file again; if it was changed on purpose, give the table of its labels (--labels)";

/// Reads labels and seal, and compares header and labels with the seal.
/// \return nothing for a file that `svt convert` did not write
Result<std::optional<Stated>> readStated(const LabelImage& image, const std::optional<volume::SvtHeader>& header) {
    Stated stated{header, {}, volume::readSeal(image.seal)};
    if (image.labelsJson.empty()) {
        if (!header && !stated.seal) return std::optional<Stated>();
        return Error(
            Code::BadVolume,
            fmt::format("the table of labels that svt wrote into the file is missing, or lacks rows; {}", kRemedy));
    }
    auto labels = volume::readLabelsJson(image.labelsJson);
    if (!labels)
        return Error(labels.error().code(),
                     fmt::format("the table of labels that svt wrote into the file is damaged ({}); {}",
                                 labels.error().message(), kRemedy));
    if (!stated.seal) {
        stated.labels = std::move(*labels);
        return std::optional(std::move(stated));
    }
    volume::SemanticVolume told;
    told.labels = std::move(*labels);
    takeNames(header, {}, told);
    if (header) told.grid = header->grid;
    if (!header || volume::tableChecksum(told) != stated.seal->table)
        return Error(
            Code::BadChecksum,
            fmt::format("the header or the table of labels that svt wrote into the file is damaged or was changed: "
                        "its CRC-32 is not {:08x}; {}",
                        stated.seal->table, kRemedy));
    stated.labels = std::move(told.labels);
    return std::optional(std::move(stated));
}

/// The first labels whose number of voxels differs from the table: "'R1' has 12 voxels, the table says 40, ...".
std::string differencesOf(const volume::SemanticVolume& volume, std::size_t& count) {
    constexpr std::size_t kShown = 5;
    const auto voxels = volume.columns.countVoxels(volume.labels.scalarCount());
    std::string text;
    count = 0;
    for (const Label& label : volume.labels.labels) {
        std::uint64_t own = 0;
        for (Scalar s = 0; s < label.count; ++s) own += voxels[label.first + s];
        if (own == label.voxels || count++ >= kShown) continue;
        text += fmt::format("{}'{}' has {} voxels, the table says {}", text.empty() ? "" : ", ", label.id.substr(0, 80),
                            own, label.voxels);
    }
    if (count > kShown) text += fmt::format(", and {} more", count - kShown);
    return text;
}

/// Whether the samples are those that the table was written with.
Result<void> checkSamples(const volume::SemanticVolume& volume, const std::optional<volume::VolumeSeal>& seal) {
    if (seal && seal->columns == volume::columnsChecksum(volume.columns)) return {};
    std::size_t count = 0;
    const std::string differences = differencesOf(volume, count);
    if (count > 0)
        return Error(
            Code::BadChecksum,
            fmt::format("the samples are not those that svt wrote: of {} labels {} differ: {}. The file is damaged "
                        "or was changed; {}",
                        volume.labels.labels.size(), count, differences, kRemedy));
    if (!seal) return {};
    return Error(
        Code::BadChecksum,
        fmt::format("the samples are not those that svt wrote: their CRC-32 is not {:08x}, though each label has its "
                    "voxels. The file is damaged or was changed; {}",
                    seal->columns, kRemedy));
}

/// Whether each value has a label.
Result<void> checkValues(const volume::SemanticVolume& volume) {
    const std::vector<std::uint32_t> labelOf = volume.labels.labelOfScalar();
    for (const Scalar value : valuesOf(volume.columns))
        if (value >= labelOf.size() || labelOf[value] == kNoLabel)
            return Error(Code::BadVolume,
                         fmt::format("a sample has the value {}, which no label of the table has; their last is {}",
                                     value, labelOf.size() - 1));
    return {};
}

/// The volume of a given table, which is taken as it is.
Result<void> takeGiven(const UserTable& table, volume::SemanticVolume& volume) {
    if (table.labelsJson.empty()) {
        SVT_DO(takeTold(table.told, &table, volume));
        countAgain(volume, false);
        return {};
    }
    SVT_TRY(labels, volume::readLabelsJson(table.labelsJson));
    volume.labels = std::move(*labels);
    SVT_DO(checkValues(volume));
    countAgain(volume, true);
    return {};
}

/// The volume of a table that `svt convert` wrote into the file.
Result<void> takeStated(Stated stated, MadeVolume& made) {
    volume::SemanticVolume& volume = made.volume;
    const bool isCut = stated.header && !isSamePlace(volume.grid, stated.header->grid);
    if (stated.header && !isCut) volume.grid = stated.header->grid;
    volume.labels = std::move(stated.labels);
    if (!stated.header)
        made.warnings.emplace_back(
            "the header that svt wrote into the file is missing or damaged: the grid is that of the format, and names "
            "may be "
            "missing");
    SVT_DO(checkValues(volume));
    if (!isCut) return checkSamples(volume, stated.seal);
    const Vec3i now = volume.grid.dimension(), before = stated.header->grid.dimension();
    made.warnings.push_back(fmt::format(
        "the grid is no longer the one that svt wrote ({} x {} x {} samples, now {} x {} x {}): the image was "
        "cut, moved or damaged since. The grid of the file is taken, and voxels are counted again",
        before.x, before.y, before.z, now.x, now.y, now.z));
    countAgain(volume, true);
    return {};
}

}  // namespace

Result<MadeVolume> makeVolume(const LabelImage& image, volume::ColumnVolume values, const UserTable* table,
                              const std::filesystem::path& path) {
    MadeVolume made;
    volume::SemanticVolume& volume = made.volume;
    SVT_TRY(grid, gridOf(image));
    volume.grid = *grid;
    volume.crsName = image.crsName;
    volume.source = path.filename().string();
    volume.columns = std::move(values);
    const auto header = headerOf(image);
    takeNames(header, image.headerJson, volume);
    if (table != nullptr) {
        if (header && isSamePlace(volume.grid, header->grid)) volume.grid = header->grid;
        SVT_DO(takeGiven(*table, volume));
        return made;
    }
    SVT_TRY(stated, readStated(image, header));
    if (*stated) {
        SVT_DO(takeStated(std::move(**stated), made));
        return made;
    }
    SVT_DO(takeTold(image.told, nullptr, volume));
    countAgain(volume, false);
    return made;
}

}  // namespace svt::volume_readers
