#include <apps/cli/options/command_line.hpp>
#include <apps/cli/options/shared_options.hpp>
#include <apps/cli/output/messages.hpp>
#include <apps/cli/output/terminal_progress.hpp>

#include <svt/core/file.hpp>
#include <svt/core/parallel.hpp>
#include <svt/samples/city_sample.hpp>

#include <fmt/format.h>

#include <mutex>

namespace svt::cli {
namespace {

struct SampleCityArguments {
    std::string profile;
    std::filesystem::path output;
    samples::CitySampleOptions options;
    int threads = 0;
};

samples::CityProfile profileOf(const std::string& name) {
    if (name == "3dbag") return samples::CityProfile::Dutch;
    if (name == "nyc") return samples::CityProfile::NewYork;
    return name == "plateau" ? samples::CityProfile::Plateau : samples::CityProfile::Berlin;
}

Result<samples::CitySampleCount> writeFile(const SampleCityArguments& arguments, int number, const Progress* progress) {
    SVT_TRY(file, AtomicFile::create(arguments.output / citySampleFileName(arguments.options, number)));
    std::optional<Error> failed;
    const auto count = writeCitySample(arguments.options, number, [&](std::string_view text) {
        auto done = Progress::isCancelled(progress) ? Result<void>(Error(Code::Cancelled, "stopped while writing"))
                                                    : file->write(text);
        if (!done) failed = done.error();
        return done.hasValue();
    });
    if (failed) return *failed;
    if (!count) return count.error();
    SVT_DO(file->commit());
    return *count;
}

int runSampleCity(SampleCityArguments& arguments) {
    arguments.options.profile = profileOf(arguments.profile);
    std::error_code ignored;
    std::filesystem::create_directories(arguments.output, ignored);
    const TerminalProgress progress;
    ProgressCounter counter(progress.get(), "write", static_cast<std::uint64_t>(arguments.options.files));
    std::mutex mutex;
    samples::CitySampleCount all;
    std::optional<Error> failed;
    parallelFor(static_cast<std::size_t>(arguments.options.files), 1, arguments.threads,
                [&](std::size_t begin, std::size_t end) {
                    for (std::size_t n = begin; n < end; ++n) {
                        const auto count = writeFile(arguments, static_cast<int>(n), progress.get());
                        counter.add();
                        const std::lock_guard lock(mutex);
                        if (!count) {
                            failed = count.error();
                            continue;
                        }
                        all.buildings += count->buildings;
                        all.replicas += count->replicas;
                        all.broken += count->broken;
                        all.vertices += count->vertices;
                    }
                });
    if (failed) return fail(*failed);
    if (!isQuiet())
        fmt::print(
            "{}: {} files, {} buildings, of them {} replicas; {} shells lack a face; {:.1f} vertices a building\n",
            arguments.output.string(), arguments.options.files, all.buildings, all.replicas, all.broken,
            double(all.vertices) / double(all.buildings - all.replicas));
    return kDone;
}

constexpr Option kSampleCity[] = {
    {.name = "--profile",
     .choices = "3dbag|berlin|nyc|plateau",
     .byDefault = "berlin",
     .help = "whose files the city resembles: formats, versions, CRS and units"},
    {.name = "--buildings",
     .kind = Whole,
     .least = 1,
     .most = 100000000,
     .byDefault = "1000",
     .help = "number of buildings, those that stand in two files counted once"},
    {.name = "--files", .kind = Whole, .least = 1, .most = 100000, .byDefault = "1", .help = "number of files"},
    {.name = "--seed", .kind = Whole, .least = 0, .byDefault = "1", .help = "decides all buildings"},
    {.name = "-o,--output",
     .value = "DIR",
     .help = "folder that the files are written into",
     .isRequired = true,
     .file = FileUse::OutputFolder},
};

Action connectSampleCity(Command& command) {
    auto arguments = std::make_shared<SampleCityArguments>();
    command.set("--profile", arguments->profile);
    command.set("--buildings", arguments->options.buildings);
    command.set("--files", arguments->options.files);
    command.set("--seed", arguments->options.seed);
    command.set("--output", arguments->output);
    command.set("--threads", arguments->threads);
    return [arguments] { return runSampleCity(*arguments); };
}

}  // namespace

extern const CommandText kSampleCityCommand{.name = "sample-city",
                                            .help = "Write a generated city: many buildings in many files",
                                            .sets = {kSampleCity, kThreads, kQuiet},
                                            .connect = connectSampleCity};

}  // namespace svt::cli
