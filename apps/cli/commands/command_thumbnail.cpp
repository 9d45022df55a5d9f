#include <apps/cli/options/catalog.hpp>
#include <apps/cli/options/city_page.hpp>
#include <apps/cli/options/load_volume.hpp>
#include <apps/cli/options/shared_options.hpp>
#include <apps/cli/output/messages.hpp>

#include <svt/city/city_painter.hpp>
#include <svt/core/machine.hpp>
#include <svt/core/parallel.hpp>
#include <svt/illustrate/scene_painter.hpp>
#include <svt/image/png.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <utility>

namespace svt::cli {
namespace {

struct ThumbnailArguments {
    std::filesystem::path input, output;
    int size = 256;
    std::uint64_t maxFileMb = 128;
    double maxSeconds = 10;
    pipeline::BuildOptions build;
};

// Cancels work at its next report of progress after the time limit.
class TimeLimit {
public:
    explicit TimeLimit(double seconds)
        : end_(Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds))) {
        progress_.report = [this](std::string_view, double) {
            if (Clock::now() >= end_) progress_.cancel = true;
        };
    }
    [[nodiscard]] const Progress* progress() const noexcept { return &progress_; }

private:
    using Clock = std::chrono::steady_clock;
    Clock::time_point end_;
    Progress progress_;
};

Error errorOf(const ThumbnailArguments& arguments, Code code, std::string message) {
    return Error(code, std::move(message), Place{arguments.input.string(), 0, 0, {}});
}

// Limits for a program that a file manager starts for every file of a folder. A given --memory is kept.
void limitProcess() {
    constexpr std::uint64_t kMemoryBytes = 1'000'000'000;
    if (memoryFigures().limitedBy == "--memory") return;
    if (const auto grant = memoryGrant(); !grant || grant->bytes > kMemoryBytes)
        limitMemory(kMemoryBytes, "svt thumbnail");
}

Result<void> checkSize(const ThumbnailArguments& arguments) {
    std::error_code failed;
    const std::uintmax_t bytes = std::filesystem::file_size(arguments.input, failed);
    if (failed || bytes <= arguments.maxFileMb * 1'000'000) return {};  // readers report missing files
    return errorOf(arguments, Code::InputTooBig,
                   fmt::format("the file has {}, and thumbnails are made of files up to {} MB; give a larger "
                               "--max-file, or draw it with svt render",
                               bytesText(bytes), arguments.maxFileMb));
}

pipeline::BuildOptions coarseBuild(const ThumbnailArguments& arguments, int threads) {
    // The memory of the volume decides the spacing. With 16 MB, a house gets 5 or 10 cm, a tower 20 cm, a quarter 1 m.
    // Coarser ones would save less than the time of reading and meshing, and thin roof layers become mixed up.
    constexpr std::uint64_t kBytesPerPixel = 256;
    constexpr int kLeastSize = 256;
    const auto size = static_cast<std::uint64_t>(std::max(arguments.size, kLeastSize));
    pipeline::BuildOptions build = arguments.build;
    build.memoryBytes = std::min(build.memoryBytes, kBytesPerPixel * size * size);
    build.read.maxBytes = arguments.maxFileMb * 1'000'000;
    build.threads = threads;
    return build;
}

Result<render::Frame> drawThumbnail(const ThumbnailArguments& arguments, const Progress* progress) {
    constexpr int kMostThreads = 4;  // more take longer to start than they save
    const int threads =
        arguments.build.threads > 0 ? arguments.build.threads : std::min(kMostThreads, hardwareThreads());
    illustrate::Scene scene;
    scene.width = scene.height = arguments.size;
    scene.isTransparent = true;
    render::CastOptions cast;
    cast.threads = threads;
    cast.progress = progress;
    cast.isAdaptive = true;
    if (isCity(arguments.input)) {
        constexpr std::uint64_t kTileBytes = 100'000'000;
        SVT_TRY(city, city::City::open(arguments.input));
        SVT_TRY(painter, city::CityPainter::make(std::move(*city), {kTileBytes, threads, progress}));
        SVT_TRY(painting, painter->paint(scene, cast));
        return std::move(painting->frame);
    }
    Diagnostics unprinted;
    SVT_TRY(volume, loadVolume(arguments.input, coarseBuild(arguments, threads), progress, unprinted));
    illustrate::ScenePainter painter(*volume, threads);
    painter.reportTo(progress);
    SVT_TRY(painting, painter.paint(scene, cast));
    return std::move(painting->frame);
}

// Writes the picture. A desktop makes an empty file for it and may hold that open, so that it would not see another file
// of the same name.
Result<void> writeThumbnail(const std::filesystem::path& path, const image::Image<image::Rgba8>& picture) {
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(path, ignored) || std::filesystem::file_size(path, ignored) != 0)
        return image::writePng(path, picture);
    SVT_TRY(bytes, image::encodePng(picture));
    std::ofstream stream(path, std::ios::binary | std::ios::in | std::ios::out);
    stream.write(reinterpret_cast<const char*>(bytes->data()), static_cast<std::streamsize>(bytes->size()));
    stream.close();
    if (stream) return {};
    std::filesystem::resize_file(path, 0, ignored);
    return Error(Code::CannotWrite, "cannot be written; free space on its disk, or give another name",
                 Place{path.string(), 0, 0, {}});
}

Result<int> runThumbnail(const ThumbnailArguments& arguments) {
    beQuiet();  // notes would fill the log of the desktop
    limitProcess();
    SVT_DO(checkSize(arguments));
    const TimeLimit limit(arguments.maxSeconds);
    const auto frame = drawThumbnail(arguments, limit.progress());
    if (!frame && frame.error().code() == Code::Cancelled)
        return errorOf(arguments, Code::InputTooBig,
                       fmt::format("the thumbnail takes more than {:g} s; give a larger --max-seconds, or draw it "
                                   "with svt render",
                                   arguments.maxSeconds));
    if (!frame) return frame.error();
    const auto& labels = frame->label.pixels();
    if (std::all_of(labels.begin(), labels.end(), [](volume::Scalar scalar) { return scalar == 0; }))
        return errorOf(arguments, Code::EmptyModel, "nothing in this file is visible; svt info lists its content");
    SVT_DO(writeThumbnail(arguments.output, frame->color));
    return kDone;
}

Members<ThumbnailArguments> membersOf(const ThumbnailArguments*) noexcept {
    using All = ThumbnailArguments;
    static constexpr Member<All> kMembers[] = {
        modelInput<&All::input>(),
        member<&All::output>(
            "-o,--output", "the picture to write, with a transparent background",
            {.value = "P.png", .isRequired = true, .file = FileUse::Output, .formats = "png", .mayLackEnding = true}),
        member<&All::size>("--size", "width and height", {.unit = "pixels", .least = 16, .most = 1024}),
        member<&All::maxFileMb>("--max-file", "largest file, also after decompression; larger files are an error",
                                {.unit = "MB", .least = 1, .most = 16384}),
        member<&All::maxSeconds>("--max-seconds", "time limit; work that needs longer ends with an error",
                                 {.unit = "seconds", .least = 0.01, .most = 3600}),
        quietOption<All>(),
        part<&All::build>("build", "--memory|--threads"),
    };
    return kMembers;
}

}  // namespace

extern const CommandText kThumbnailCommand = commandOf<ThumbnailArguments, runThumbnail>(
    "thumbnail", "Draw a small picture of a model or volume quickly, for file managers");

}  // namespace svt::cli
