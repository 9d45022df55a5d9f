#include <apps/cli/doctor/answers.hpp>

#include <apps/cli/options/viewer_folder.hpp>
#include <apps/cli/output/version.hpp>

#include <svt/core/file.hpp>
#include <svt/core/machine.hpp>
#include <svt/core/parallel.hpp>
#include <svt/core/simd_targets.hpp>
#include <svt/image/text.hpp>
#include <svt/serve/host.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <system_error>

namespace svt::cli {
namespace {

namespace fs = std::filesystem;

template <class T>
Json orNull(const std::optional<T>& value) {
    return value ? Json(*value) : Json(nullptr);
}

void warn(Answer& answer, const std::string& what) {
    answer.state = State::Warning;
    answer.text += (answer.text.empty() ? "" : "; ") + what;
}

void giveUp(Answer& answer, const Error& error) {
    answer.state = State::Error;
    answer.text = error.message();
    answer.error = error;
}

// Tests whether a folder is writable by writing a file, because permissions do not show a read-only disk.
void tryFolder(Answer& answer, const fs::path& folder, State otherwise) {
    constexpr std::uint64_t kLittle = 100'000'000;
    const auto free = freeBytes(folder);
    const auto file = AtomicFile::create(folder / "svt-doctor");
    answer.values = {{"path", folder.string()}, {"free", orNull(free)}, {"writable", file.hasValue()}};
    answer.text = folder.string();
    if (free) answer.text += fmt::format(", {} free", bytesText(*free));
    if (file) {
        if (free && *free < kLittle) warn(answer, "little space; free some, or outputs may not fit");
    } else if (otherwise == State::Error) {
        giveUp(answer, Error(file.error().code(), file.error().message(), Place{folder.string(), 0, 0, {}}));
        answer.text = folder.string() + ": " + answer.text;
    } else {
        warn(answer, file.error().message());
    }
}

}  // namespace

std::string_view stateName(State state) noexcept {
    return state == State::Ok ? "ok" : state == State::Warning ? "warning" : "error";
}

Answer programAnswer() {
    const BuildFacts facts = buildFacts();
    const auto targets = compiledSimdTargets();
    Answer answer{"program", "program"};
    answer.text = fmt::format("svt {}, commit {}, {}, {}; compiled in: OpenGL: {}; SIMD: {}", versionNumber(),
                              facts.commit, facts.compiler, facts.kind, facts.openGl, fmt::join(targets, ", "));
    answer.values = {
        {"version", versionNumber()}, {"commit", facts.commit}, {"compiler", facts.compiler},    {"kind", facts.kind},
        {"openGl", facts.openGl},     {"simdTargets", targets}, {"optimized", facts.isOptimized}};
    if (!facts.isOptimized)
        warn(answer, "slow, because the compiler did not optimize; `make build` builds an optimized program");
    return answer;
}

Answer processorAnswer() {
    const int cores = hardwareThreads();
    const auto all = machineCores();
    const auto granted = grantedCores();
    Answer answer{"processor", "processor"};
    answer.text = fmt::format("cores: {}{}; SIMD: {}", cores, all ? fmt::format(" of {}", *all) : "", simdTargetName());
    answer.values = {{"cores", cores},
                     {"coresOfMachine", orNull(all)},
                     {"coresGranted", orNull(granted)},
                     {"simd", simdTargetName()}};
    if (granted && *granted < cores)
        warn(answer, fmt::format("the control group grants the time of {:g} cores; give --threads {}", *granted,
                                 std::max(1, static_cast<int>(std::ceil(*granted)))));
    return answer;
}

Answer memoryAnswer() {
    // The pictures of 2000 x 1750 x 1000 samples that docs/dev/performance.md measures take up to 200 MB.
    constexpr std::uint64_t kLittle = 500'000'000;
    const MemoryFigures figures = memoryFigures();
    Answer answer{"memory", "memory"};
    answer.values = {{"total", orNull(figures.totalBytes)},
                     {"available", orNull(figures.availableBytes)},
                     {"limit", orNull(figures.limitBytes)},
                     {"limitedBy", figures.limitedBy.empty() ? Json(nullptr) : Json(figures.limitedBy)}};
    answer.text = figures.totalBytes ? bytesText(*figures.totalBytes) : "not known";
    if (figures.availableBytes) answer.text += fmt::format(", {} available", bytesText(*figures.availableBytes));
    if (figures.limitBytes)
        answer.text += fmt::format(", limited to {} ({})", bytesText(*figures.limitBytes), figures.limitedBy);
    const std::uint64_t usable =
        std::min(figures.availableBytes.value_or(kLittle), figures.limitBytes.value_or(kLittle));
    if (usable < kLittle) warn(answer, "little; end other programs, raise the limit, or choose a coarser --spacing");
    return answer;
}

Answer graphicsAnswer(const GlProbe& probe) {
    Answer answer{"graphics", "graphics"};
    const bool hasContext = probe.contextFault.empty();
    answer.values = {{"available", hasContext}};
    if (hasContext) {
        answer.text = fmt::format("{}, {}", probe.renderer, probe.version);
        answer.values["renderer"] = probe.renderer;
        answer.values["version"] = probe.version;
        answer.values["software"] = probe.isSoftware;
        if (probe.isSoftware) warn(answer, "software, slower than drawing without --gl; the picture is the same");
    } else {
        warn(answer, probe.contextFault);
        warn(answer, "only --gl needs it: pictures are drawn on the CPU, with the same result");
    }
    if (!probe.messages.empty()) answer.values["messages"] = probe.messages;
    return answer;
}

Answer viewerAnswer() {
    Answer answer{"viewer", "viewer"};
    const auto folder = findViewerFolder({});
    answer.values = {{"path", (folder ? *folder : fs::path(folder.error().where().file)).string()},
                     {"available", folder.hasValue()}};
    answer.text = answer.values["path"];
    if (!folder) {
        answer.text += ": " + folder.error().message();
        answer.state = State::Warning;
    }
    return answer;
}

Answer browserAnswer() {
    Answer answer{"browser", "browser"};
    const auto isDesktop = hasDesktop();
    const fs::path opener = findProgram(serve::kBrowserOpener);
    answer.values = {{"opener", opener.empty() ? Json(nullptr) : Json(opener.string())},
                     {"desktop", orNull(isDesktop)}};
    if (!isDesktop) {
        answer.text = "not known";
        return answer;
    }
    answer.text = opener.string();
    if (opener.empty())
        warn(answer, fmt::format("there is no {} in PATH; install xdg-utils, or open the address that svt view prints",
                                 serve::kBrowserOpener));
    if (!*isDesktop)
        warn(answer, "neither DISPLAY nor WAYLAND_DISPLAY is set: without a desktop svt view only prints its address");
    return answer;
}

Answer fontAnswer() {
    Answer answer{"font", "font"};
    answer.text = "DejaVu Sans, in the program";
    const image::Image<image::Rgba8> paper(40, 20, {255, 255, 255, 255});
    image::Image<image::Rgba8> picture = paper;
    image::drawText(picture, 2, 10, "svt", {});
    answer.values = {{"name", "DejaVu Sans"}, {"available", !(picture == paper)}};
    if (picture == paper) warn(answer, "it draws nothing: pictures have no names");
    return answer;
}

Answer temporaryFolderAnswer() {
    Answer answer{"temporaryFolder", "temporary folder"};
    std::error_code error;
    const fs::path folder = fs::temp_directory_path(error);
    if (!error) {
        tryFolder(answer, folder, State::Warning);
        if (answer.state == State::Ok) return answer;
    } else {
        answer.values = {{"path", nullptr}, {"free", nullptr}, {"writable", false}};
        warn(answer, "there is none");
    }
    warn(answer, "svt view, serve and publish need it for models; set TMPDIR to another folder");
    return answer;
}

Answer currentFolderAnswer() {
    Answer answer{"currentFolder", "current folder"};
    std::error_code error;
    const fs::path folder = fs::current_path(error);
    tryFolder(answer, error ? fs::path(".") : folder, State::Error);
    return answer;
}

Answer testVolumeAnswer(const Result<TestVolume>& built) {
    Answer answer{"testVolume", "test volume"};
    if (!built) {
        giveUp(answer, built.error());
        return answer;
    }
    const Vec3i d = built->volume.grid.dimension();
    answer.text = fmt::format("the sample house, {} x {} x {} samples, in {:.3f} s", d.x, d.y, d.z, built->seconds);
    answer.values = {{"dimension", toJson(d)}, {"seconds", built->seconds}};
    return answer;
}

Answer testPictureAnswer(const Result<TestPicture>& drawn) {
    Answer answer{"testPicture", "test picture"};
    if (!drawn) {
        giveUp(answer, drawn.error());
        return answer;
    }
    const auto& labels = drawn->frame.label;
    answer.text = fmt::format("{} x {} pixels on the CPU in {:.3f} s", labels.width(), labels.height(), drawn->seconds);
    answer.values = {{"seconds", drawn->seconds}, {"firstSeconds", drawn->firstSeconds}};
    const auto& pixels = labels.pixels();
    if (std::all_of(pixels.begin(), pixels.end(), [](volume::Scalar label) { return label == 0; }))
        giveUp(answer, Error(Code::Internal, "the picture of the sample house is empty; please report it"));
    return answer;
}

Answer testOpenGlAnswer(const GlProbe& probe) {
    Answer answer{"testOpenGl", "test OpenGL"};
    if (!probe.pictureFault.empty()) {
        warn(answer, probe.pictureFault);
        warn(answer, "draw without --gl");
        return answer;
    }
    // Pixels at edges may differ by rounding.
    const std::size_t few = probe.pixels / 1000;
    answer.text = fmt::format("the same picture by OpenGL in {:.3f} s, the first one in {:.3f} s", probe.seconds,
                              probe.firstSeconds);
    answer.values = {{"seconds", probe.seconds},
                     {"firstSeconds", probe.firstSeconds},
                     {"pixels", probe.pixels},
                     {"differing", probe.differing}};
    if (probe.differing > few) {
        answer.text.clear();
        warn(answer, fmt::format("{} of {} pixels differ from those on the CPU; update the graphics driver, or draw "
                                 "without --gl",
                                 probe.differing, probe.pixels));
    }
    return answer;
}

}  // namespace svt::cli
