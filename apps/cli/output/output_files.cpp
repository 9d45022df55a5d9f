#include <apps/cli/output/output_files.hpp>

#include <svt/core/check.hpp>
#include <svt/core/file.hpp>
#include <svt/core/text.hpp>
#include <svt/http/http_client.hpp>
#include <svt/pipeline/style_sheet.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <system_error>

namespace svt::cli {
namespace {

using frontend::GivenOption;

namespace fs = std::filesystem;

struct Input {
    fs::path path;
    std::string use;  // in a message: "'input'", "'--style', a file that it names"
    FileUse kind;
};

struct OutputFile {
    fs::path path;
    std::string_view option;
    std::vector<const FileFormat*> formats;  // empty: a folder
    bool isFirst = true;                     // of numbered files
    bool mayLackEnding = false;              // without an ending, the first format applies
    bool mayBeReserved = false;              // an existing empty file with any ending means the first format, too
};

Error errorAt(const fs::path& path, Code code, std::string message) {
    return Error(code, std::move(message), Place{path.string(), 0, 0, {}});
}

std::string_view valueOf(std::span<const GivenOption> given, std::string_view name) {
    const auto found = std::ranges::find_if(given, [&](const GivenOption& g) { return longName(*g.option) == name; });
    return found == given.end() || found->values.empty() ? std::string_view() : found->values.front();
}

std::vector<Input> inputsOf(std::span<const GivenOption> given) {
    std::vector<Input> inputs;
    for (const auto& [option, values] : given) {
        const FileUse kind = option->file;
        if (kind == FileUse::None || kind == FileUse::Output || kind == FileUse::OutputFolder) continue;
        for (const std::string& value : values) {
            if (isFromElsewhere(value)) continue;
            inputs.push_back({userPath(value), fmt::format("'{}'", longName(*option)), kind});
            if (kind != FileUse::Style) continue;
            for (fs::path& file : pipeline::filesOfStyle(userPath(value)))
                inputs.push_back({std::move(file), fmt::format("a file that '{}' names", longName(*option)), kind});
        }
    }
    return inputs;
}

std::vector<OutputFile> outputsOf(std::span<const GivenOption> given) {
    std::vector<OutputFile> outputs;
    for (const auto& [option, values] : given) {
        if (option->file != FileUse::Output && option->file != FileUse::OutputFolder) continue;
        const auto formats = formatsOf(*option, given);
        const std::string_view number = option->numberedBy.empty() ? "" : valueOf(given, option->numberedBy);
        const int count = std::max(1, parseInteger<int>(number).value_or(1));
        for (const std::string& value : values)
            for (int n = 0; n < count; ++n)
                outputs.push_back({numberedFile(userPath(value), n, count), longName(*option), formats, n == 0,
                                   formats.size() == 1 || option->mayLackEnding, option->mayLackEnding});
    }
    return outputs;
}

// A pipe gives its bytes only once, a device may never end, and opening a pipe may wait forever.
std::string_view nameOfStream(fs::file_type type) noexcept {
    switch (type) {
        case fs::file_type::fifo: return "a pipe";
        case fs::file_type::socket: return "a socket";
        case fs::file_type::character:
        case fs::file_type::block: return "a device";
        default: return {};
    }
}

// Inputs are files, or folders if an option takes them. The readers report missing files.
Result<void> checkInputs(std::span<const GivenOption> given) {
    for (const auto& [option, values] : given) {
        const FileUse use = option->file;
        if (use == FileUse::None || use == FileUse::Output || use == FileUse::OutputFolder) continue;
        for (const std::string& value : values) {
            if (isFromElsewhere(value)) continue;
            std::error_code ignored;
            const fs::path path = userPath(value);
            const fs::file_type type = fs::status(path, ignored).type();
            if (const std::string_view name = nameOfStream(type); !name.empty())
                return errorAt(
                    path, Code::CannotOpen,
                    fmt::format("'{}' reads a file, and this is {}; copy its content to a file, and give that",
                                longName(*option), name));
            if (use == FileUse::InputFolder && type == fs::file_type::regular)
                return errorAt(
                    path, Code::CannotOpen,
                    fmt::format("'{}' reads a folder, and this is a file; give a folder", longName(*option)));
            if ((use == FileUse::Style || use == FileUse::OtherInput) && type == fs::file_type::directory)
                return errorAt(path, Code::CannotOpen,
                               fmt::format("'{}' reads a file, and this is a folder; give the name of a file in it",
                                           longName(*option)));
        }
    }
    return {};
}

bool isRegular(const fs::path& path) {
    std::error_code ignored;
    return fs::is_regular_file(path, ignored);
}

// Whether a path is a device, a pipe or a socket, which is written directly.
bool isStream(const fs::path& path) {
    std::error_code ignored;
    return !nameOfStream(fs::status(path, ignored).type()).empty();
}

// Whether a path is an empty file, as mktemp makes one for the output of another program.
bool isReserved(const fs::path& path) {
    std::error_code ignored;
    return isRegular(path) && fs::file_size(path, ignored) == 0;
}

bool isInside(const fs::path& path, const fs::path& folder) {
    std::error_code ignored;
    const fs::path root = fs::canonical(folder, ignored), real = fs::canonical(path, ignored);
    return !root.empty() && !real.empty() &&
           std::mismatch(root.begin(), root.end(), real.begin(), real.end()).first == root.end();
}

// The endings of all formats of an output.
std::vector<std::string_view> endingsOf(const OutputFile& output) {
    std::vector<std::string_view> endings;
    for (const FileFormat* format : output.formats)
        for (const std::string_view ending : splitChoices(format->endings)) endings.push_back(ending);
    return endings;
}

Result<void> checkEnding(const OutputFile& output, bool mayChooseFormat) {
    if (output.formats.empty()) return {};
    const std::vector<std::string_view> endings = endingsOf(output);
    const std::string ending = endingOf(output.path, endings);
    if (std::ranges::find(endings, ending) != endings.end()) return {};
    if (output.mayLackEnding && (ending.empty() || isStream(output.path))) return {};
    if (output.mayBeReserved && isReserved(output.path)) return {};
    return Error(Code::BadArgument, fmt::format("{} '{}': cannot write '{}'; possible {} {}{}", output.option,
                                                output.path.string(), ending, endings.size() == 1 ? "is" : "are",
                                                fmt::join(endings, ", "), mayChooseFormat ? ", or --format" : ""));
}

// An output must not be an input, nor the file of another output.
Result<void> checkMeetings(const std::vector<Input>& inputs, const std::vector<OutputFile>& outputs) {
    std::map<std::string, const Input*> read;
    std::error_code ignored;
    for (const Input& input : inputs)
        if (std::string identity = fileIdentity(input.path); !identity.empty() && fs::exists(input.path, ignored))
            read.emplace(std::move(identity), &input);
    std::map<std::string, const OutputFile*> written;
    for (const OutputFile& output : outputs) {
        std::string identity = fileIdentity(output.path);
        if (identity.empty()) continue;
        if (const auto found = read.find(identity); found != read.end())
            return errorAt(output.path, Code::WouldDestroy,
                           fmt::format("'{}' would write over a file that is read ({}); give another name",
                                       output.option, found->second->use));
        if (const auto [other, isNew] = written.emplace(std::move(identity), &output); !isNew)
            return errorAt(output.path, Code::WouldDestroy,
                           fmt::format("'{}' and '{}' ({}) are the same file; give two names", output.option,
                                       other->second->option, other->second->path.string()));
        if (!output.formats.empty()) continue;
        for (const Input& input : inputs)
            if (input.kind != FileUse::InputFolder && isInside(input.path, output.path))
                return errorAt(
                    input.path, Code::WouldDestroy,
                    fmt::format("the file is read ({}) and lies in the folder that '{}' writes; give another "
                                "folder",
                                input.use, output.option));
    }
    return {};
}

// With --no-clobber.
Result<void> checkNothingExists(const OutputFile& output) {
    std::error_code ignored;
    const bool isFolder = fs::is_directory(output.path, ignored);
    if (isFolder ? fs::is_empty(output.path, ignored) : !isRegular(output.path)) return {};
    return errorAt(output.path, Code::WouldDestroy,
                   fmt::format("the {}, and --no-clobber keeps existing outputs; give '{}' another name",
                               isFolder ? "folder is not empty" : "file exists", output.option));
}

Result<void> checkContent(const OutputFile& output) {
    if (!isRegular(output.path)) return {};
    const FileContent content = contentOf(output.path);
    const std::string ending = endingOf(output.path, endingsOf(output));
    if (content == FileContent::Nothing || output.formats.empty()) return {};
    std::string_view wanted;
    for (const FileFormat* format : output.formats) {
        const auto endings = splitChoices(format->endings);
        const bool isTold = std::ranges::find(endings, ending) != endings.end();
        if (!isTold && !(output.mayLackEnding && format == output.formats.front())) continue;
        if (format->content == content) return {};
        wanted = nameOf(format->content);
    }
    return errorAt(output.path, Code::WouldDestroy,
                   fmt::format("'{}' writes {}, but the existing file is {}; give another name, or remove the file",
                               output.option, wanted, nameOf(content)));
}

// Tests a folder with a file in it, or in the nearest existing folder above.
Result<void> checkFolder(const fs::path& folder) {
    std::error_code ignored;
    fs::path at = fs::absolute(folder, ignored);
    if (!at.has_filename()) at = at.parent_path();
    while (!fs::exists(at, ignored) && at.has_relative_path()) at = at.parent_path();
    if (!fs::is_directory(at, ignored))
        return errorAt(folder, Code::CannotWrite, fmt::format("{} is a file; give the name of a folder", at.string()));
    return checkWritable(at / "index.html");
}

}  // namespace

std::string endingOf(const fs::path& file) { return lowerAscii(file.extension().string()); }

std::string endingOf(const fs::path& file, std::span<const std::string_view> endings) {
    const std::string name = lowerAscii(file.filename().string());
    std::string_view longest;
    for (const std::string_view ending : endings)
        if (ending.size() > longest.size() && name.size() > ending.size() && name.ends_with(ending)) longest = ending;
    return longest.empty() ? endingOf(file) : std::string(longest);
}

fs::path numberedFile(const fs::path& file, int number, int count) {
    if (count == 1 || file.empty()) return file;
    fs::path result = file;
    result.replace_filename(fmt::format("{}_{:04}{}", file.stem().string(), number, file.extension().string()));
    return result;
}

bool isFromElsewhere(std::string_view value) noexcept { return value == "-" || http::isAddress(value); }

std::vector<const FileFormat*> formatsOf(const Option& option, std::span<const GivenOption> given) {
    std::string_view chosen = valueOf(given, "--format");
    while (!chosen.empty() && chosen.back() >= '0' && chosen.back() <= '9') chosen.remove_suffix(1);  // "citygml2"
    const std::vector<std::string_view> names = splitChoices(option.formats);
    const bool isChosen = std::ranges::find(names, chosen) != names.end();
    std::vector<const FileFormat*> formats;
    for (const std::string_view name : names) {
        const FileFormat* format = formatOfName(name);
        SVT_CHECK(format != nullptr);
        if (!isChosen || chosen == name) formats.push_back(format);
    }
    return formats;
}

bool areAllVolumes(std::span<const GivenOption> given) {
    bool isAny = false;
    for (const auto& [option, values] : given) {
        if (option->file != FileUse::ModelOrVolume) continue;
        for (const std::string& value : values) {
            const fs::path path = userPath(value);
            if (!isRegular(path) || contentOf(path) != FileContent::Volume) return false;
            isAny = true;
        }
    }
    return isAny;
}

std::string cityOf(std::span<const GivenOption> given) {
    for (const auto& [option, values] : given)
        if (option->file == FileUse::ModelOrVolume)
            for (const std::string& value : values)
                if (isRegular(userPath(value) / "city.json")) return value;
    return {};
}

Result<void> checkOptionsForModels(std::span<const GivenOption> given) {
    if (const std::string city = cityOf(given); !city.empty())
        for (const GivenOption& each : given)
            if (each.option->isForModels)
                return errorAt(city, Code::BadArgument,
                               fmt::format("{} is for building a volume from a model, but the tiles of this city are "
                                           "built already; leave it out, or give it to svt city plan",
                                           longName(*each.option)));
    if (!areAllVolumes(given)) return {};
    const auto isVolume = [](const GivenOption& g) { return g.option->file == FileUse::ModelOrVolume; };
    for (const GivenOption& each : given)
        if (each.option->isForModels)
            return errorAt(std::ranges::find_if(given, isVolume)->values.front(), Code::BadArgument,
                           fmt::format("{} is for building a volume from a model, but this file is a volume already; "
                                       "leave it out, or give the model",
                                       longName(*each.option)));
    return {};
}

Result<void> checkFiles(std::span<const GivenOption> given) {
    SVT_DO(checkInputs(given));
    const std::vector<Input> inputs = inputsOf(given);
    const std::vector<OutputFile> outputs = outputsOf(given);
    const bool mayChooseFormat = std::ranges::any_of(
        given, [](const GivenOption& g) { return g.option->formats.find("citygml") != std::string_view::npos; });
    for (const OutputFile& output : outputs)
        if (output.isFirst) SVT_DO(checkEnding(output, mayChooseFormat));
    SVT_DO(checkMeetings(inputs, outputs));
    const bool keepsExisting =
        std::ranges::any_of(given, [](const GivenOption& g) { return longName(*g.option) == "--no-clobber"; });
    std::error_code ignored;
    for (const OutputFile& output : outputs) {
        if (keepsExisting) SVT_DO(checkNothingExists(output));
        SVT_DO(checkContent(output));
        // Tests only the first of numbered files in a folder, and the existing ones.
        if (!output.isFirst && !fs::exists(output.path, ignored)) continue;
        SVT_DO(output.formats.empty() ? checkFolder(output.path) : checkWritable(output.path));
    }
    return {};
}

}  // namespace svt::cli
