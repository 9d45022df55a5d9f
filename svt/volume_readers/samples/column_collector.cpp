#include <svt/core/bytes.hpp>
#include <svt/core/machine.hpp>
#include <svt/volume_readers/samples/label_image.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <optional>
#include <utility>

namespace svt::volume_readers {
namespace {

using volume::ColumnTileBuilder;
using volume::ColumnTileData;
using volume::ColumnVolume;
using volume::Run;
using volume::Scalar;

std::endian orderOf(const LabelImage& image) { return image.isSwapped ? std::endian::big : std::endian::little; }

/// Collects the runs of all columns from slices, bottom up. A row that equals the row below costs one comparison.
class Collector {
public:
    Collector(const LabelImage& image, std::uint64_t maxBytes, Code code)
        : image_(image),
          maxBytes_(maxBytes),
          code_(code),
          order_(image.other == OtherKind::None ? orderOf(image) : std::endian::little),
          rowBytes_(std::size_t(image.dimension.x) * std::size_t(image.bits / 8)),
          runs_(std::size_t(image.dimension.x) * std::size_t(image.dimension.y)) {}

    Result<void> add(std::int32_t k, std::span<const std::byte> slice) {
        const auto width = static_cast<std::size_t>(image_.dimension.x);
        for (std::size_t j = 0; j < static_cast<std::size_t>(image_.dimension.y); ++j) {
            const std::byte* row = slice.data() + j * rowBytes_;
            if (k > 0 && std::memcmp(row, below_.data() + j * rowBytes_, rowBytes_) == 0) continue;
            for (std::size_t i = 0; i < width; ++i) {
                const Scalar value = valueAt(row, i);
                auto& runs = runs_[i + width * j];
                if (!runs.empty() && runs.back().scalar == value) continue;
                // `end` holds the begin of the run until the next run begins.
                runs.push_back({static_cast<std::uint32_t>(k), value});
                ++runCount_;
            }
        }
        if (isNegative_)
            return Error(code_, fmt::format("slice {} has a negative value; labels are whole numbers from 0 on", k));
        if (runCount_ * 3 * sizeof(Run) > maxBytes_)
            return Error(
                Code::InputTooBig,
                fmt::format("the labels change so often that {} are not enough to hold them; is this a label volume "
                            "and not a scan?",
                            bytesText(maxBytes_)));
        below_.assign(slice.begin(), slice.end());
        return {};
    }

    ColumnVolume finish() {
        const Vec3i dimension = image_.dimension;
        constexpr std::int32_t kTile = ColumnVolume::kTileSize;
        std::vector<ColumnTileData> tiles;
        for (std::int32_t tileY = 0; tileY < dimension.y; tileY += kTile)
            for (std::int32_t tileX = 0; tileX < dimension.x; tileX += kTile) {
                const std::int32_t width = std::min(kTile, dimension.x - tileX);
                ColumnTileBuilder builder(width);
                std::vector<std::uint16_t> row(static_cast<std::size_t>(width));
                for (std::int32_t j = tileY; j < std::min(tileY + kTile, dimension.y); ++j) {
                    for (std::int32_t i = 0; i < width; ++i)
                        row[std::size_t(i)] = builder.addColumn(column(tileX + i, j));
                    builder.addRow(row);
                }
                tiles.push_back(builder.finish());
            }
        return ColumnVolume::fromTiles(dimension, std::move(tiles));
    }

private:
    Scalar valueAt(const std::byte* row, std::size_t index) {
        if (image_.bits == 8) {
            const auto value = static_cast<std::uint8_t>(row[index]);
            isNegative_ = isNegative_ || (image_.isSigned && value > 0x7F);
            return value;
        }
        if (image_.bits == 16) {
            const auto value = loadBytes<std::uint16_t>(row + 2 * index, order_);
            isNegative_ = isNegative_ || (image_.isSigned && value > 0x7FFF);
            return value;
        }
        const auto value = loadBytes<std::uint32_t>(row + 4 * index, order_);
        isNegative_ = isNegative_ || (image_.isSigned && value > 0x7FFFFFFF);
        return value;
    }

    /// The finished runs of a column; they are taken out of memory.
    std::span<const Run> column(std::int32_t i, std::int32_t j) {
        auto& runs = runs_[std::size_t(i) + std::size_t(image_.dimension.x) * std::size_t(j)];
        done_ = std::exchange(runs, {});
        for (std::size_t r = 0; r < done_.size(); ++r)
            done_[r].end = r + 1 < done_.size() ? done_[r + 1].end : static_cast<std::uint32_t>(image_.dimension.z);
        return done_;
    }

    const LabelImage& image_;
    std::uint64_t maxBytes_;
    Code code_;
    std::endian order_;
    std::size_t rowBytes_;
    std::vector<std::vector<Run>> runs_;
    std::vector<Run> done_;
    std::vector<std::byte> below_;
    std::uint64_t runCount_ = 0;
    bool isNegative_ = false;
};

/// The sample as a label, if it is one.
std::optional<std::uint32_t> labelOf(const std::byte* at, OtherKind kind, std::endian order, double& found) {
    constexpr double kMost = 4294967295.0;
    if (kind == OtherKind::Int64 || kind == OtherKind::UInt64) {
        const auto value = loadBytes<std::uint64_t>(at, order);
        found = kind == OtherKind::Int64 ? double(static_cast<std::int64_t>(value)) : double(value);
        if (value > 0xFFFFFFFFu) return std::nullopt;
        return static_cast<std::uint32_t>(value);
    }
    found = kind == OtherKind::Float32 ? double(loadBytes<float>(at, order)) : loadBytes<double>(at, order);
    if (!(found >= 0 && found <= kMost) || found != std::floor(found)) return std::nullopt;
    return static_cast<std::uint32_t>(found);
}

/// Reads slices of other kinds of samples as those of 32 bits.
class Narrower {
public:
    explicit Narrower(const LabelImage& image) : image_(image), stored_(std::size_t(image.storedSliceBytes())) {}

    Result<void> read(std::int32_t k, std::span<std::byte> slice, Code code) {
        SVT_DO(image_.read(stored_));
        const std::size_t size = image_.other == OtherKind::Float32 ? 4 : 8;
        for (std::size_t n = 0; n < slice.size() / 4; ++n) {
            double found = 0;
            const auto label = labelOf(stored_.data() + n * size, image_.other, orderOf(image_), found);
            if (!label)
                return Error(
                    code,
                    fmt::format("slice {} has the value {}; labels are whole numbers from 0 to 4294967295", k, found));
            std::memcpy(slice.data() + 4 * n, &*label, 4);
        }
        return {};
    }

private:
    const LabelImage& image_;
    std::vector<std::byte> stored_;
};

}  // namespace

Result<ColumnVolume> readColumns(const LabelImage& image, std::uint64_t maxBytes, Code code, const Progress* progress) {
    const std::uint64_t columns = std::uint64_t(image.dimension.x) * std::uint64_t(image.dimension.y);
    const bool isOther = image.other != OtherKind::None;
    const std::uint64_t needed = 2 * image.sliceBytes() + (isOther ? image.storedSliceBytes() : 0) +
                                 columns * (sizeof(std::vector<Run>) + 2 * sizeof(Run));
    if (needed > maxBytes)
        return Error(Code::InputTooBig,
                     fmt::format("{} x {} columns take {} at least, and {} may be taken", image.dimension.x,
                                 image.dimension.y, bytesText(needed), bytesText(maxBytes)));
    Collector collector(image, maxBytes, code);
    std::optional<Narrower> narrower;
    if (isOther) narrower.emplace(image);
    std::vector<std::byte> slice(static_cast<std::size_t>(image.sliceBytes()));
    for (std::int32_t k = 0; k < image.dimension.z; ++k) {
        if (Progress::isCancelled(progress)) return Error(Code::Cancelled, "reading the labels was stopped");
        SVT_DO(narrower ? narrower->read(k, slice, code) : image.read(slice));
        SVT_DO(collector.add(k, slice));
        if (k % 64 == 0) Progress::tell(progress, "read", double(k) / image.dimension.z);
    }
    SVT_DO(image.read({}));
    return collector.finish();
}

}  // namespace svt::volume_readers
