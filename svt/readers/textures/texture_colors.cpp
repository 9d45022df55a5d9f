#include <svt/readers/textures/texture_colors.hpp>

#include <svt/core/parallel.hpp>
#include <svt/image/color.hpp>
#include <svt/image/linear_image.hpp>
#include <svt/model/classes.hpp>
#include <svt/model/surface_uses.hpp>
#include <svt/readers/textures/covered_mean.hpp>
#include <svt/readers/textures/image_files.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <tuple>
#include <utility>

namespace svt::readers::textures {
namespace {

constexpr int kMostImages = 4;                                     // in memory at a time
constexpr std::uint64_t kLargeImage = std::uint64_t{4096} * 4096;  // pixels; larger ones are read one by one
constexpr float kColorSteps = 31;

// Linear light of the uses of one image.
class ImageMeans {
public:
    ImageMeans(const TextureSet& set, const ImageFiles& files) : set_(set), files_(files) {}

    // \param uses  of this image
    // \return nothing; or why the image cannot be used
    Result<void> measure(const TextureImage& source, const std::vector<std::size_t>& uses,
                         std::vector<std::optional<Vec3d>>& means) const {
        SVT_TRY(image, decoded(source));
        const std::optional<Vec3d> whole = wholeMean(*image);
        std::optional<WorldPlace> world = source.world;
        if (source.isGeoreferenced && !world) world = files_.worldPlace(source.file);
        for (const std::size_t u : uses) {
            const TextureUse& use = set_.uses[u];
            const bool hasPlaces = !use.points.empty() && (!source.isGeoreferenced || world);
            if (hasPlaces) means[u] = covered(*image, use, source.isGeoreferenced ? &*world : nullptr);
            if (!means[u]) means[u] = whole;
        }
        return {};
    }

private:
    Result<image::LinearImage> decoded(const TextureImage& source) const {
        if (!source.content.empty()) return decodeOne(source.content);
        SVT_TRY(file, files_.read(source.file));
        return decodeOne(file->bytes());
    }

    Result<image::LinearImage> decodeOne(std::span<const std::byte> bytes) const {
        const bool isLarge = image::pngPixels(bytes) > kLargeImage;
        std::unique_lock<std::mutex> held;
        if (isLarge) held = std::unique_lock(large_);
        return image::decodeLinear(bytes);
    }

    static std::optional<Vec3d> covered(const image::LinearImage& image, const TextureUse& use,
                                        const WorldPlace* world) {
        const double width = image.pixels.width(), height = image.pixels.height();
        std::vector<TexturePoint> points = use.points;
        for (TexturePoint& point : points) {
            if (world == nullptr) {
                point = {point.u * width, (1 - point.v) * height};
                continue;
            }
            const double x = point.u - world->x0, y = point.v - world->y0;
            const double determinant = world->a * world->e - world->b * world->d;
            const double column = (world->e * x - world->b * y) / determinant;
            const double row = (world->a * y - world->d * x) / determinant;
            point = {(column + 0.5) * width / image.width, (row + 0.5) * height / image.height};
        }
        // A map has no colour beyond its image.
        const Wrap wrap = world != nullptr ? Wrap::None : use.wrap;
        return coveredMean(image, {points, use.ringEnds, wrap, use.hasSeparateRings});
    }

    const TextureSet& set_;
    const ImageFiles& files_;
    mutable std::mutex large_;
};

double polygonArea(const model::Polygon& polygon) {
    double area = 0;
    std::size_t begin = 0;
    for (const std::size_t end : polygon.ringEnds) {
        Vec3d twice{};
        for (std::size_t i = begin + 1; i + 1 < end; ++i)
            twice =
                twice + cross(polygon.points[i] - polygon.points[begin], polygon.points[i + 1] - polygon.points[begin]);
        area += (begin == 0 ? 0.5 : -0.5) * length(twice);
        begin = end;
    }
    return std::max(area, 1e-9);
}

// The object that a feature is a surface of, or the feature itself.
model::FeatureIndex objectOf(const model::BuildingModel& model, model::FeatureIndex feature) {
    while (model::isBoundarySurface(model.features[feature].className) &&
           model.features[feature].parent != model::kNoFeature)
        feature = model.features[feature].parent;
    return feature;
}

// The finest feature that uses each textured polygon: parents precede their children.
std::vector<model::FeatureIndex> ownersOf(const model::BuildingModel& model) {
    std::vector<model::FeatureIndex> owners(model.polygons.size(), model::kNoFeature);
    for (model::FeatureIndex f = 0; f < model.features.size(); ++f)
        for (const model::Geometry& geometry : model.features[f].geometries)
            model::forEachUse(geometry, [&](const model::SurfaceUse& use) {
                if (isUse(model.polygons[use.polygon].material)) owners[use.polygon] = f;
            });
    return owners;
}

void colorPolygons(model::BuildingModel& model, const TextureSet& set, const MeanColors& means) {
    struct Sum {
        Vec3d color;
        double area = 0;
        std::vector<std::size_t> polygons;
    };
    const std::vector<model::FeatureIndex> owners = ownersOf(model);
    std::map<std::pair<model::FeatureIndex, std::string_view>, Sum> sums;
    for (std::size_t p = 0; p < model.polygons.size(); ++p) {
        model::Polygon& polygon = model.polygons[p];
        if (!isUse(polygon.material)) continue;
        const std::size_t use = useOf(polygon.material);
        const std::optional<Vec3d> mean = means.ofUses[use];
        polygon.material = set.uses[use].otherwise;
        if (!mean || owners[p] == model::kNoFeature) continue;
        Sum& sum = sums[{objectOf(model, owners[p]), model.features[owners[p]].className}];
        const double area = polygonArea(polygon);
        sum.color = sum.color + *mean * area;
        sum.area += area;
        sum.polygons.push_back(p);
    }
    std::map<std::tuple<float, float, float>, std::int32_t> numbers;
    for (const auto& [key, sum] : sums) {
        const Vec3f color = roundedColor(sum.color / sum.area);
        const auto next = static_cast<std::int32_t>(model.materials.size());
        const auto [number, isNew] = numbers.try_emplace({color.x, color.y, color.z}, next);
        if (isNew) {
            model::Material& material = model.materials.emplace_back();
            material.name = kTextureName;
            material.diffuse = color;
        }
        for (const std::size_t p : sum.polygons) model.polygons[p].material = number->second;
    }
}

}  // namespace

MeanColors meanColors(const TextureSet& set, const std::string& folder, const ReadOptions& options) {
    MeanColors result;
    result.ofUses.resize(set.uses.size());
    std::vector<std::vector<std::size_t>> usesOf(set.images.size());
    for (std::size_t u = 0; u < set.uses.size(); ++u) usesOf[set.uses[u].image].push_back(u);
    std::vector<std::string> reasons(set.images.size());
    const ImageFiles files(folder);
    const ImageMeans means(set, files);
    const int threads = std::min(options.threads > 0 ? options.threads : hardwareThreads(), kMostImages);
    ProgressCounter counter(options.progress, "textures", set.images.size());
    parallelFor(set.images.size(), 1, threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end && !Progress::isCancelled(options.progress); ++i) {
            if (usesOf[i].empty()) continue;
            if (const auto done = means.measure(set.images[i], usesOf[i], result.ofUses); !done)
                reasons[i] = done.error().message();
            counter.add();
        }
    });
    for (std::size_t i = 0; i < set.images.size(); ++i) {
        if (usesOf[i].empty()) continue;
        ++result.images;
        if (reasons[i].empty()) continue;
        if (result.failed++ == 0)
            result.example = fmt::format("'{}': {}", set.images[i].file.substr(0, 200), reasons[i]);
    }
    return result;
}

void reportImages(const MeanColors& means, std::string_view fileName, Diagnostics& diagnostics) {
    if (means.failed == 0) return;
    diagnostics.add(Severity::Note, Code::BadImage,
                    fmt::format("{} of {} images of textures cannot be used, and their surfaces keep their other "
                                "colours; the first is {}",
                                means.failed, means.images, means.example),
                    {std::string(fileName), 0, 0, {}});
}

Vec3f roundedColor(Vec3d linear) {
    const auto rounded = [](double channel) {
        return std::round(image::srgbFromLinear(static_cast<float>(channel)) * kColorSteps) / kColorSteps;
    };
    return {rounded(linear.x), rounded(linear.y), rounded(linear.z)};
}

Result<void> colorTextured(model::BuildingModel& model, const TextureSet& set, std::string_view fileName,
                           const ReadOptions& options, Diagnostics& diagnostics) {
    if (set.uses.empty()) return {};
    const MeanColors means = meanColors(set, options.imageFolder, options);
    if (Progress::isCancelled(options.progress))
        return Error(Code::Cancelled, "reading was cancelled", {std::string(fileName), 0, 0, {}});
    reportImages(means, fileName, diagnostics);
    colorPolygons(model, set, means);
    return {};
}

}  // namespace svt::readers::textures
