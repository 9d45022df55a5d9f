#include <svt/readers/textures/covered_mean.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace svt::readers::textures {
namespace {

constexpr int kFewestRows = 8, kMostRows = 64;
constexpr double kMostRepeats = 16;  // of the image along an axis; beyond, its mean is as good

// A sum of colours, weighted by alpha.
class ColorSum {
public:
    void add(const image::LinearPixel& pixel) {
        color_ = color_ + Vec3d{double(pixel.r), double(pixel.g), double(pixel.b)};
        alpha_ += double(pixel.a);
    }
    [[nodiscard]] std::optional<Vec3d> mean() const {
        if (!(alpha_ > 0)) return std::nullopt;
        return color_ / alpha_;
    }

private:
    Vec3d color_;
    double alpha_ = 0;
};

// The pixel along an axis at a coordinate; -1: none.
std::int32_t wrapped(double at, std::int32_t size, Wrap wrap) {
    const double length = size;
    if (wrap == Wrap::None && (at < 0 || at > length)) return -1;
    if (wrap == Wrap::Repeat && (at < 0 || at > length)) at -= length * std::floor(at / length);
    if (wrap == Wrap::Mirror) {
        at -= 2 * length * std::floor(at / (2 * length));
        if (at > length) at = 2 * length - at;
    }
    return static_cast<std::int32_t>(std::clamp(std::floor(at), 0.0, length - 1));
}

class RingSampler {
public:
    RingSampler(const image::LinearImage& image, Wrap wrap, ColorSum& sum) : image_(image), wrap_(wrap), sum_(sum) {}

    // \param ends  ends of the rings that hold `points`, which are counted from `first` on
    // \return false if the rings cannot be used
    bool add(std::span<const TexturePoint> points, std::span<const std::uint32_t> ends, std::uint32_t first) {
        if (points.empty()) return true;
        TexturePoint low = points.front(), high = points.front();
        for (const TexturePoint& point : points) {
            if (!std::isfinite(point.u) || !std::isfinite(point.v)) return false;
            low = {std::min(low.u, point.u), std::min(low.v, point.v)};
            high = {std::max(high.u, point.u), std::max(high.v, point.v)};
        }
        const double width = high.u - low.u, height = high.v - low.v;
        if (width > kMostRepeats * image_.pixels.width() || height > kMostRepeats * image_.pixels.height())
            return false;
        int places = 0;
        const int rows = placesFor(height), columns = placesFor(width);
        for (int row = 0; row < rows; ++row) {
            const double v = low.v + height * (row + 0.5) / rows;
            findCrossings(points, ends, first, v);
            for (std::size_t c = 0; c + 1 < crossings_.size(); c += 2)
                places += addSpan({crossings_[c], crossings_[c + 1]}, {low.u, width}, columns, v);
        }
        if (places > 0) return true;
        for (const TexturePoint& point : points) addPlace(point.u, point.v);
        return true;
    }

private:
    struct Range {
        double from, to;
    };
    struct Columns {
        double begin, width;
    };

    static int placesFor(double pixels) {
        return std::clamp(static_cast<int>(std::ceil(std::min(2 * pixels, 1e6))), kFewestRows, kMostRows);
    }

    void findCrossings(std::span<const TexturePoint> points, std::span<const std::uint32_t> ends, std::uint32_t first,
                       double v) {
        crossings_.clear();
        std::size_t begin = 0;
        for (const std::uint32_t ringEnd : ends) {
            const std::size_t end = std::min<std::size_t>(ringEnd - first, points.size());
            for (std::size_t i = begin; i < end; ++i) {
                const TexturePoint a = points[i], b = points[i + 1 == end ? begin : i + 1];
                if ((a.v <= v) == (b.v <= v)) continue;
                crossings_.push_back(a.u + (b.u - a.u) * ((v - a.v) / (b.v - a.v)));
            }
            begin = end;
        }
        std::sort(crossings_.begin(), crossings_.end());
    }

    // The number of places looked at between two crossings.
    int addSpan(Range span, Columns columns, int count, double v) {
        if (!(columns.width > 0)) return 0;
        const auto columnAt = [&](double u) {
            return static_cast<int>(std::ceil((u - columns.begin) * count / columns.width - 0.5));
        };
        const int begin = std::max(columnAt(span.from), 0);
        const int end = std::min(columnAt(span.to), count);
        for (int column = begin; column < end; ++column)
            addPlace(columns.begin + columns.width * (column + 0.5) / count, v);
        return std::max(end - begin, 0);
    }

    void addPlace(double u, double v) {
        const std::int32_t x = wrapped(u, image_.pixels.width(), wrap_);
        const std::int32_t y = wrapped(v, image_.pixels.height(), wrap_);
        if (x >= 0 && y >= 0) sum_.add(image_.pixels.at(x, y));
    }

    const image::LinearImage& image_;
    Wrap wrap_;
    ColorSum& sum_;
    std::vector<double> crossings_;
};

}  // namespace

std::optional<Vec3d> coveredMean(const image::LinearImage& image, const CoveredRings& rings) {
    if (image.pixels.pixels().empty()) return std::nullopt;
    ColorSum sum;
    RingSampler sampler(image, rings.wrap, sum);
    if (!rings.areSeparate) {
        if (!sampler.add(rings.points, rings.ringEnds, 0)) return std::nullopt;
        return sum.mean();
    }
    std::uint32_t begin = 0;
    for (const std::uint32_t& end : rings.ringEnds) {
        if (!sampler.add(rings.points.subspan(begin, end - begin), {&end, 1}, begin)) return std::nullopt;
        begin = end;
    }
    return sum.mean();
}

std::optional<Vec3d> wholeMean(const image::LinearImage& image) {
    ColorSum sum;
    for (const image::LinearPixel& pixel : image.pixels.pixels()) sum.add(pixel);
    return sum.mean();
}

}  // namespace svt::readers::textures
