#include <apps/cli/options/catalog.hpp>
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
    std::filesystem::path output;
    samples::CitySampleOptions options;
    int threads = 0;
};

Result<samples::CitySampleCount> writeFile(const SampleCityArguments& arguments, int number, const Progress* progress) {
    const std::filesystem::path path = arguments.output / citySampleFileName(arguments.options, number);
    SVT_DO(checkNoStream(path));
    SVT_TRY(file, AtomicFile::create(path));
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

Result<int> runSampleCity(const SampleCityArguments& arguments) {
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
    if (failed) return *failed;
    if (!isQuiet())
        fmt::print(
            "{}: {} files, {} buildings, of them {} replicas; {} shells lack a face; {:.1f} vertices per building\n",
            arguments.output.string(), arguments.options.files, all.buildings, all.replicas, all.broken,
            double(all.vertices) / double(all.buildings - all.replicas));
    return kDone;
}

Members<SampleCityArguments> membersOf(const SampleCityArguments*) noexcept {
    using All = SampleCityArguments;
    using samples::CitySampleOptions;
    static constexpr Member<All> kMembers[] = {
        member<&All::options, &CitySampleOptions::profile>(
            "--profile", "city whose files are imitated: formats, versions, CRS and units"),
        member<&All::options, &CitySampleOptions::buildings>(
            "--buildings", "number of buildings; a building in two files counts once", {.least = 1, .most = 100000000}),
        member<&All::options, &CitySampleOptions::files>("--files", "number of files", {.least = 1, .most = 100000}),
        member<&All::options, &CitySampleOptions::seed>("--seed", "seed of all buildings", {.least = 0}),
        member<&All::output>("-o,--output", "folder for the files",
                             {.value = "DIR", .isRequired = true, .file = FileUse::OutputFolder}),
        threadsOption<&All::threads>(),
        quietOption<All>(),
    };
    return kMembers;
}

}  // namespace

extern const CommandText kSampleCityCommand = commandOf<SampleCityArguments, runSampleCity>(
    "sample-city", "Write a generated city: many buildings in many files");

}  // namespace svt::cli
