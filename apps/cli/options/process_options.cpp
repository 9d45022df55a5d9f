#include <apps/cli/options/process_options.hpp>

#include <svt/core/text.hpp>

#include <algorithm>

namespace svt::cli {
namespace {

using frontend::BoundOption, frontend::GivenOption;

constexpr std::string_view kMaxInputMb = "2048";

constexpr Option kFormat{
    .name = "--format", .help = "format of the output '-', which has no ending", .group = "Output"};
constexpr Option kNoClobber{.name = "--no-clobber",
                            .kind = OptionKind::Flag,
                            .help = "end with an error instead of replacing an existing output",
                            .group = "Output"};
constexpr Option kMaxInput{.name = "--max-input",
                           .kind = OptionKind::Whole,
                           .unit = "MB",
                           .least = 1,
                           .most = 1048576,
                           .byDefault = kMaxInputMb,
                           .help = "largest input from stdin or an address",
                           .group = "Input"};
constexpr Option kVerbose{.name = "-v,--verbose",
                          .kind = OptionKind::Flag,
                          .help = "show all findings, and the files with defaults that are used",
                          .group = "Output",
                          .excludes = "--quiet"};
constexpr Option kNoConfig{.name = "--no-config",
                           .kind = OptionKind::Flag,
                           .help = "ignore the files with defaults, svt.json",
                           .group = "Defaults"};

bool hasOption(std::span<const BoundOption> options, std::string_view name) {
    return std::ranges::any_of(options, [&](const Option& option) { return longName(option) == name; });
}

// The formats of the first output of a command, if it has several.
std::string_view formatsOfOutput(std::span<const BoundOption> own) {
    const auto output = std::ranges::find_if(own, [](const Option& option) { return option.file == FileUse::Output; });
    return output != own.end() && output->formats.find('|') != std::string_view::npos ? output->formats
                                                                                      : std::string_view();
}

}  // namespace

bool isOutput(const Option& option) noexcept {
    return option.file == FileUse::Output || option.file == FileUse::OutputFolder;
}

bool isInput(const Option& option) noexcept { return option.file != FileUse::None && !isOutput(option); }

bool isOfProcess(const BoundOption& option) noexcept { return option.pointer.empty(); }

std::vector<BoundOption> withProcessOptions(std::span<const BoundOption> own) {
    std::vector<BoundOption> all(own.begin(), own.end());
    const auto add = [&](const Option& option) { all.push_back({option, {}}); };
    if (const std::string_view formats = formatsOfOutput(own); !formats.empty() && !hasOption(own, "--format")) {
        Option format = kFormat;
        format.choices = formats;
        add(format);
    }
    if (std::ranges::any_of(own, isOutput)) add(kNoClobber);
    const bool readsFiles = std::ranges::any_of(
        own, [](const Option& option) { return isInput(option) && option.file != FileUse::InputFolder; });
    if (readsFiles) add(kMaxInput);
    if (hasOption(own, "--quiet") && !hasOption(own, "--verbose")) add(kVerbose);
    if (std::ranges::any_of(own, [](const Option& option) { return option.name.starts_with('-'); })) add(kNoConfig);
    return all;
}

std::vector<GivenOption> withoutProcessOptions(std::span<const GivenOption> given) {
    std::vector<GivenOption> own;
    for (const GivenOption& each : given)
        if (!isOfProcess(*each.option)) own.push_back(each);
    return own;
}

const GivenOption* findGiven(std::span<const GivenOption> given, std::string_view name) noexcept {
    const auto found = std::ranges::find_if(given, [&](const GivenOption& g) { return longName(*g.option) == name; });
    return found == given.end() ? nullptr : &*found;
}

std::uint64_t maxInputBytes(std::span<const GivenOption> given) {
    const GivenOption* option = findGiven(given, "--max-input");
    const std::string_view text = option == nullptr ? kMaxInputMb : std::string_view(option->values.front());
    return static_cast<std::uint64_t>(parseNumber(text).value_or(0)) * 1'000'000;
}

}  // namespace svt::cli
