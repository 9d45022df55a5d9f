#pragma once
/// \file
/// Chunks of a volume for formats that store it in cubes: bands of columns are unrolled, and cubes are cut out of them.

#include <svt/volume/dense.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace svt::writers {

/// A band of a level: all samples along x, file rows along y and z; samples beyond the volume are background.
template <class T>
class SampleBand {
public:
    /// \param side  number of samples along y and z, from j and k
    SampleBand(const volume::ColumnVolume& columns, std::int32_t j, std::int32_t k, std::int32_t side, int threads)
        : dimension_(columns.dimension()),
          box_{j, std::min(j + side, dimension_.y), k, std::min(k + side, dimension_.z)},
          samples_(std::size_t(dimension_.x) * std::size_t(box_.jEnd - j) * std::size_t(box_.kEnd - k)) {
        volume::copyBox<T>(columns, box_, samples_, threads);
    }

    /// The chunk of `side` samples whose first one is (i, j, k) of the volume; empty if all are background.
    [[nodiscard]] std::vector<T> chunk(std::int32_t i, std::int32_t j, std::int32_t k, std::int32_t side) const {
        std::vector<T> out;
        const std::int32_t width = std::min(side, dimension_.x - i);
        for (std::int32_t z = k; z < std::min(k + side, box_.kEnd); ++z)
            for (std::int32_t y = j; y < std::min(j + side, box_.jEnd); ++y) {
                const T* row =
                    samples_.data() + std::size_t(i) +
                    std::size_t(dimension_.x) * (std::size_t(y - box_.jBegin) +
                                                 std::size_t(box_.jEnd - box_.jBegin) * std::size_t(z - box_.kBegin));
                if (out.empty()) {
                    if (std::all_of(row, row + width, [](T s) { return s == 0; })) continue;
                    out.resize(std::size_t(side) * std::size_t(side) * std::size_t(side));
                }
                std::copy_n(row, width, out.begin() + side * ((z - k) * side + (y - j)));
            }
        return out;
    }

    /// The samples of `size` from i, and from the first ones of the band along y and z. They must lie in the volume.
    [[nodiscard]] std::vector<T> clipped(std::int32_t i, Vec3i size) const {
        std::vector<T> out;
        out.reserve(std::size_t(size.x) * std::size_t(size.y) * std::size_t(size.z));
        for (std::int32_t z = 0; z < size.z; ++z)
            for (std::int32_t y = 0; y < size.y; ++y) {
                const T* row = samples_.data() + std::size_t(i) +
                               std::size_t(dimension_.x) *
                                   (std::size_t(y) + std::size_t(box_.jEnd - box_.jBegin) * std::size_t(z));
                out.insert(out.end(), row, row + size.x);
            }
        return out;
    }

private:
    Vec3i dimension_;
    volume::DenseBox box_;
    std::vector<T> samples_;
};

}  // namespace svt::writers
