#include <apps/cli/options/city_page.hpp>

#include <svt/city/city_folder.hpp>
#include <svt/core/file.hpp>
#include <svt/core/machine.hpp>

#include <algorithm>

namespace svt::cli {

bool isCity(const std::filesystem::path& input) {
    // Uses the text as given, because the generic form has only one slash after "http:".
    const std::string text = input.string();
    if (text.starts_with("http://") || text.starts_with("https://")) return true;
    // City::open() reports the error if city.json exists but cannot be read as a file.
    std::error_code ignored;
    const std::filesystem::file_status status = std::filesystem::status(input / "city.json", ignored);
    return std::filesystem::exists(status) && !std::filesystem::is_directory(status);
}

Result<serve::SiteModel> cityModel(const std::filesystem::path& input, const std::string& name) {
    SVT_TRY(city, city::City::open(input));
    const std::string location = input.string();
    const std::filesystem::path folder(location.substr(0, location.find_last_not_of('/') + 1));
    serve::SiteModel model{name, folder.filename().string(), {}, location, {}};
    if (model.title.empty() || model.title == ".") model.title = name;
    if (location.starts_with("http://") || location.starts_with("https://")) return model;
    std::vector<std::string> files{"index.bin", "ids.bin", "packs.bin"};
    std::error_code failed;
    // Cities of earlier programs have no index of words.
    if (std::filesystem::exists(input / "words.bin", failed)) files.emplace_back("words.bin");
    for (const auto& entry : std::filesystem::directory_iterator(input / "packs", failed))
        if (entry.path().extension() == ".svtp") files.push_back("packs/" + entry.path().filename().string());
    if (failed)
        return Error(Code::CannotOpen, "the packs cannot be listed: " + failed.message(),
                     {(input / "packs").string(), 0, 0, {}});
    std::sort(files.begin(), files.end());
    SVT_TRY(head, FileBytes::read(input / "city.json"));
    model.cityFiles.emplace_back("city.json", serve::Bytes::of(std::move(*head)));
    // A city may be larger than memory, so its files stay open and are read in parts.
    allowMoreOpenFiles(files.size());
    for (const std::string& file : files) {
        SVT_TRY(parts, PartFile::open(input / file));
        model.cityFiles.emplace_back(file, serve::Bytes::of(std::move(*parts)));
    }
    return model;
}

Result<volume::SemanticVolume> pageVolume(const std::filesystem::path& folder) {
    // Limit of the bytes of all members: about as much as the page loads in a few seconds and draws within its memory.
    constexpr std::uint64_t kMostBytes = 6'000'000;
    constexpr double kMostSamples = 8192;
    SVT_TRY(city, city::City::open(folder));
    return city::wholeVolume(*city, kMostBytes, kMostSamples);
}

}  // namespace svt::cli
