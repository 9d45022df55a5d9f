#include <apps/cli/output/film.hpp>

#include <apps/cli/output/output_files.hpp>

#include <svt/core/machine.hpp>
#include <svt/image/png.hpp>
#include <svt/serve/child_process.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace svt::cli {
namespace fs = std::filesystem;
namespace {

struct Encoding {
    std::string_view ending;
    std::vector<std::string> arguments;
};

// The bytes depend only on the pictures: no dates, no names of versions, and one thread if more may change the bytes.
const Encoding* encodingOf(const fs::path& file) {
    const std::string even = "pad=ceil(iw/2)*2:ceil(ih/2)*2:color=white,format=yuv420p";
    static const std::vector<Encoding> kEncodings{
        {".webm",
         {"-vf", even, "-c:v", "libvpx-vp9", "-crf", "20", "-b:v", "0", "-threads", "1", "-deadline", "good",
          "-cpu-used", "4"}},
        {".mp4", {"-vf", even, "-c:v", "libx264", "-crf", "18", "-threads", "1", "-movflags", "+faststart"}},
        {".gif",
         {"-lavfi", "split[a][b];[a]palettegen=stats_mode=full[p];[b][p]paletteuse=dither=bayer:bayer_scale=4", "-loop",
          "0"}},
        {".webp", {"-c:v", "libwebp", "-quality", "85", "-loop", "0"}},
    };
    const std::string ending = endingOf(file);
    const auto found = std::ranges::find(kEncodings, ending, &Encoding::ending);
    return found == kEncodings.end() ? nullptr : &*found;
}

}  // namespace

bool isFilm(const fs::path& file) { return encodingOf(file) != nullptr; }

Film::Film(fs::path output, fs::path encoder, int rate)
    : output_(std::move(output)), encoder_(std::move(encoder)), rate_(rate) {}

Result<Film> Film::begin(const fs::path& output, int rate) {
    fs::path encoder = findProgram("ffmpeg");
    if (encoder.empty())
        return Error(
            Code::CannotWrite,
            fmt::format("{}: films need ffmpeg, which is not installed; install it (Debian: apt install ffmpeg), or "
                        "write separate pictures: -o P.png --frames N",
                        output.string()));
    Film film(output, std::move(encoder), rate);
    if (film.folder_.path().empty())
        return Error(Code::CannotWrite, "no temporary folder for the pictures of the film; set TMPDIR");
    return film;
}

Result<void> Film::add(const image::Image<image::Rgba8>& picture) {
    return image::writePng(folder_.path() / fmt::format("{:06}.png", count_++), picture);
}

Result<void> Film::finish(const Progress* progress) {
    Progress::tell(progress, "film", 0);
    const Encoding& encoding = *encodingOf(output_);
    const fs::path encoded = folder_.path() / ("film" + std::string(encoding.ending));
    // Without -xerror, ffmpeg ends with 0 if it cannot write the end of the film.
    std::vector<std::string> arguments{encoder_.string(),
                                       "-nostdin",
                                       "-xerror",
                                       "-loglevel",
                                       "error",
                                       "-framerate",
                                       std::to_string(rate_),
                                       "-i",
                                       "%06d.png",
                                       "-an",
                                       "-map_metadata",
                                       "-1",
                                       "-fflags",
                                       "+bitexact",
                                       "-flags:v",
                                       "+bitexact"};
    arguments.insert(arguments.end(), encoding.arguments.begin(), encoding.arguments.end());
    arguments.push_back(encoded.string());
    serve::ChildLimits limits;
    limits.memoryBytes = std::uint64_t{16} << 30;
    limits.seconds = 24 * 3600;
    limits.fileBytes = std::uint64_t{64} << 30;
    const Progress never;
    const auto done = serve::runChild(arguments, folder_.path(), limits, progress == nullptr ? never : *progress);
    if (done.isCancelled) return Error(Code::Cancelled, "cancelled");
    if (done.exitCode != 0)
        return Error(Code::CannotWrite, fmt::format("{}: ffmpeg could not encode it: {}", output_.string(),
                                                    done.messages.empty() ? "it was stopped" : done.messages));
    SVT_TRY(film, FileBytes::read(encoded));
    SVT_DO(writeFileAtomically(output_, film->bytes()));
    return {};
}

}  // namespace svt::cli
