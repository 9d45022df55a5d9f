#include <apps/cli/run/transfer.hpp>

#include <apps/cli/options/process_options.hpp>
#include <apps/cli/output/file_content.hpp>
#include <apps/cli/output/messages.hpp>
#include <apps/cli/output/output_files.hpp>
#include <apps/cli/output/terminal_progress.hpp>

#include <svt/core/machine.hpp>
#include <svt/core/text.hpp>
#include <svt/http/download.hpp>
#include <svt/http/http_client.hpp>
#include <svt/readers/read_model.hpp>
#include <svt/volume_readers/read_label_volume.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <string_view>
#include <system_error>

namespace svt::cli {
namespace {

namespace fs = std::filesystem;
using frontend::BoundOption, frontend::GivenOption;

Error badUse(const Option& option, std::string_view value, std::string message) {
    return Error(Code::BadArgument, fmt::format("'{}' is '{}': {}", longName(option), value, message));
}

// Checks '-' and addresses as values of one input.
Result<void> checkInput(const Option& option, std::string_view value) {
    const bool isStdin = value == "-";
    const std::string_view from = isStdin ? "stdin" : "addresses";
    if (option.file == FileUse::InputFolder) {
        if (!isStdin) return {};  // a city
        return badUse(option, value, "it reads a folder, which stdin cannot be; give a folder");
    }
    if (option.file == FileUse::Style)
        return badUse(option, value,
                      fmt::format("a style names files beside it, which {} do not have; give a file", from));
    if (option.isReadAgain)
        return badUse(option, value,
                      fmt::format("later commands read it again, which {} do not permit; give a file", from));
    return {};
}

// A file behind stdin needs no copy, and must not be an output.
void useFileOfStdin(std::string& value) {
    const fs::path file = stdinAsFile();
    if (file.empty()) return;
    showAs(file, "stdin");
    value = file.string();
}

// The formats of an output as they are given with --format.
std::string namesOfFormats(const Option& option) {
    return fmt::format("{}", fmt::join(splitChoices(option.formats), ", "));
}

// The format of an output to stdout.
Result<const FileFormat*> formatForStdout(const Option& option, const std::vector<GivenOption>& given) {
    if (option.file == FileUse::OutputFolder)
        return badUse(option, "-", "it writes a folder, which stdout cannot take; give the name of a folder");
    const auto formats = formatsOf(option, given);
    if (formats.size() > 1 && !option.mayLackEnding) {
        const bool hasFormat = longName(option) == "--output" || !option.name.starts_with('-');
        return badUse(option, "-",
                      hasFormat ? fmt::format("give its format with --format: {}", namesOfFormats(option))
                                : std::string("its format is unknown; give a file with an ending"));
    }
    if (formats.front()->content == FileContent::Nothing)
        return badUse(option, "-",
                      fmt::format("{} is a folder, which stdout cannot take; give a name", formats.front()->name));
    return formats.front();
}

// --format of the process is for stdout: the ending of a file decides its format.
Result<void> checkFormat(const std::vector<GivenOption>& given) {
    const GivenOption* format = findGiven(given, "--format");
    if (format == nullptr || !isOfProcess(*format->option)) return {};
    const auto output =
        std::ranges::find_if(given, [](const GivenOption& each) { return each.option->file == FileUse::Output; });
    if (output == given.end())
        return Error(Code::BadArgument,
                     "--format is the format of an output, and none is given; add -o or leave it out");
    for (const std::string& value : output->values)
        if (!fs::path(value).has_extension())
            return badUse(*output->option, value,
                          "the ending of a file decides its format; give it an ending instead of --format");
    return {};
}

// A file name of the last part of an address: letters, digits, '.', '_' and '-', with its ending.
std::string fileNameOf(std::string_view address) {
    constexpr std::size_t kLongest = 80;
    address = address.substr(0, address.find_first_of("?#"));
    const std::string_view last = address.substr(address.rfind('/') + 1);
    std::string name;
    for (const char c : last.substr(last.size() - std::min(last.size(), kLongest)))
        name += isLetter(c) || isDigit(c) || c == '-' || c == '.' || c == '_' ? c : '_';
    return name.find_first_not_of("._") == std::string::npos ? "download" : name;
}

// Whether an address has the ending of a model, a volume or a label volume.
bool hasFileEnding(const std::string& address) {
    const std::string name = lowerAscii(fileNameOf(address));
    if (name.ends_with(".svt") || readers::hasModelEnding(name)) return true;
    for (const volume_readers::LabelFormat& format : volume_readers::labelFormats())
        for (const std::string_view ending : splitChoices(format.endings))
            if (!format.isFolder && name.ends_with(ending)) return true;
    return false;
}

// Whether the folder of a city is at an address. Asks the server for city.json, unless the address names a file.
Result<bool> isCityAt(const std::string& address, const Progress* progress) {
    if (hasFileEnding(address) || address.find_first_of("?#") != std::string::npos) return false;
    const std::string folder = address.substr(0, address.find_last_not_of('/') + 1);
    const auto answer = http::HttpClient().ask({folder + "/city.json", 0, 1, {}, progress});
    const auto at = [&](Code code, std::string message) {
        return Error(code, std::move(message), Place{address, 0, 0, {}});
    };
    if (!answer) return at(answer.error().code(), answer.error().message());
    if (answer->status == 200 || answer->status == 206) return true;
    if (const std::string fault = http::faultMessage(*answer); !fault.empty()) return at(Code::CannotOpen, fault);
    return false;
}

// Kinds of files that are certainly no model and no volume: pages of errors and of logins, pictures, films, drawings.
bool isOtherContent(FileContent content) noexcept {
    using enum FileContent;
    switch (content) {
        case Html:
        case Png:
        case Svg:
        case Pdf:
        case Webm:
        case Mp4:
        case Gif:
        case Webp:
        case Gltf:
        case Dxf:
        case GeoPackage:
        case Parquet: return true;
        default: return false;
    }
}

Result<void> checkHead(std::string_view head, const Option& option) {
    const FileContent content = contentOf(head);
    const bool isModel = option.file == FileUse::Model || option.file == FileUse::ModelOrVolume;
    if (content != FileContent::Html && !(isModel && isOtherContent(content))) return {};
    return Error(Code::UnknownFormat, fmt::format("the server sends {} instead of a model or a volume; check the "
                                                  "address, which may need a login",
                                                  nameOf(content)));
}

// An error of a temporary file, with the place of temporary files.
Error ofTemporaryFile(const Error& error) {
    if (error.code() != Code::DiskFull && error.code() != Code::CannotWrite) return error;
    std::error_code ignored;
    return Error(error.code(),
                 fmt::format("temporary files in {}: {}; TMPDIR names another folder",
                             fs::temp_directory_path(ignored).string(), error.message()),
                 error.where());
}

}  // namespace

Result<fs::path> Transfer::newFolder(std::string_view name) {
    if (!folder_) folder_.emplace();
    if (folder_->path().empty())
        return Error(Code::CannotWrite, "cannot create a folder for temporary files; set TMPDIR to a writable folder");
    const fs::path folder = folder_->path() / fmt::format("{}{}", name, folders_++);
    std::error_code failed;
    if (!fs::create_directory(folder, failed))
        return Error(Code::CannotWrite, "no temporary folder: " + failed.message());
    return folder;
}

Result<void> Transfer::redirect(const BoundOption& option, std::string& value, const std::vector<GivenOption>& given) {
    SVT_TRY(format, formatForStdout(option, given));
    if (!output_.empty())
        return badUse(option, value, "stdout takes only one output; give the others the names of files");
    if (const GivenOption* number = option.numberedBy.empty() ? nullptr : findGiven(given, option.numberedBy);
        number != nullptr && parseNumber(number->values.front()).value_or(1) > 1)
        return badUse(option, value, fmt::format("stdout takes only one file; leave out {}", option.numberedBy));
    for (const char* result : {"--json", "--csv"})
        if (findGiven(given, result) != nullptr)
            return badUse(option, value, fmt::format("{} writes to stdout, too; leave out one of them", result));
    if (isOutputTerminal() && !isTextContent((*format)->content))
        return Error(Code::CannotWrite,
                     fmt::format("stdout is a terminal, and {} is binary data; redirect it to a file or a pipe, or "
                                 "give the name of a file",
                                 (*format)->holds));
    SVT_TRY(folder, newFolder("output"));
    output_ = *folder / fmt::format("stdout{}", splitChoices((*format)->endings).front());
    value = output_.string();
    showAs(output_, "stdout");
    reserveStdout();
    return {};
}

Result<void> Transfer::begin(std::vector<GivenOption>& given) {
    int fromStdin = 0;
    for (GivenOption& each : given)
        for (std::string& value : each.values) {
            if (!isInput(*each.option) || !isFromElsewhere(value)) continue;
            SVT_DO(checkInput(*each.option, value));
            if (value == "-") ++fromStdin, useFileOfStdin(value);
        }
    if (fromStdin > 1)
        return Error(Code::BadArgument,
                     "stdin ('-') is given as two inputs, but has only one; give a file for the other");
    for (GivenOption& each : given)
        for (std::string& value : each.values)
            if (isOutput(*each.option) && value == "-") SVT_DO(redirect(*each.option, value, given));
    return checkFormat(given);
}

Result<void> Transfer::saveInput(std::string& value, std::uint64_t maxBytes) {
    SVT_TRY(folder, newFolder("input"));
    const fs::path file = *folder / "stdin";
    showAs(file, "stdin");
    const auto saved = saveStdin(file, maxBytes);
    if (!saved) return ofTemporaryFile(saved.error());
    if (*saved == 0)
        return Error(Code::CannotOpen, "stdin is empty or closed; pipe a file into this command, or give its name",
                     Place{"stdin", 0, 0, {}});
    value = file.string();
    return {};
}

Result<void> Transfer::download(const Option& option, std::string& value, std::uint64_t maxBytes) {
    const TerminalProgress progress;
    if (option.file == FileUse::Model || option.file == FileUse::ModelOrVolume) {
        SVT_TRY(isCity, isCityAt(value, progress.get()));
        if (*isCity) return {};
    }
    SVT_TRY(folder, newFolder("input"));
    const fs::path file = *folder / fileNameOf(value);
    showAs(file, value);
    http::DownloadOptions options;
    options.maxBytes = maxBytes;
    options.remedy = "a higher --max-input permits more";
    options.check = [&](std::string_view head) { return checkHead(head, option); };
    options.progress = progress.get();
    const auto saved = http::downloadFile(value, file, options);
    if (!saved) return ofTemporaryFile(saved.error());
    if (isVerbose()) note(fmt::format("{}: {}", value, bytesText(*saved)));
    value = file.string();
    return {};
}

Result<void> Transfer::fetch(std::vector<GivenOption>& given) {
    const std::uint64_t maxBytes = maxInputBytes(given);
    for (GivenOption& each : given)
        for (std::string& value : each.values) {
            if (!isInput(*each.option) || each.option->file == FileUse::InputFolder) continue;
            if (value == "-") SVT_DO(saveInput(value, maxBytes));
            if (http::isAddress(value)) SVT_DO(download(*each.option, value, maxBytes));
        }
    return {};
}

Result<void> Transfer::deliver() const {
    std::error_code ignored;
    if (output_.empty() || !fs::exists(output_, ignored)) return {};
    for (const auto& entry : fs::directory_iterator(output_.parent_path(), ignored))
        if (entry.path() != output_)
            return Error(Code::CannotWrite,
                         fmt::format("this format writes '{}' beside the output, which stdout cannot take; give the "
                                     "name of a file",
                                     entry.path().filename().string()));
    constexpr std::size_t kPieceBytes = std::size_t{1} << 18;
    SVT_TRY(file, PartFile::open(output_));
    for (std::uint64_t at = 0; at < file->size(); at += kPieceBytes) {
        SVT_TRY(piece, file->readAll(at, kPieceBytes));
        const std::string_view bytes = *piece;
        if (std::fwrite(bytes.data(), 1, bytes.size(), stdout) != bytes.size())
            throw std::system_error(errno, std::generic_category());
    }
    if (std::fflush(stdout) != 0) throw std::system_error(errno, std::generic_category());
    return {};
}

}  // namespace svt::cli
