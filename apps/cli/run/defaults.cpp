#include <apps/cli/run/defaults.hpp>

#include <apps/cli/output/messages.hpp>
#include <apps/cli/output/output_files.hpp>
#include <apps/cli/run/config_file.hpp>

#include <svt/core/file.hpp>
#include <svt/core/machine.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <utility>

namespace svt::cli {
namespace {

namespace fs = std::filesystem;
using frontend::BoundOption, frontend::GivenOption;

constexpr const char* kConfigName = "svt.json";

// svt.json beside the first model that the command reads; empty for stdin, addresses, and commands without models.
fs::path configOfProject(const std::vector<GivenOption>& given) {
    for (const GivenOption& each : given) {
        const FileUse use = each.option->file;
        const bool isModel = use == FileUse::Model || use == FileUse::ModelOrVolume || use == FileUse::InputFolder;
        if (!isModel || each.option->name.starts_with('-') || each.values.empty()) continue;
        if (isFromElsewhere(each.values.front())) return {};
        fs::path model = userPath(each.values.front());
        if (!model.has_filename()) model = model.parent_path();  // "town/"
        std::error_code ignored;
        if (model.filename() == "." || model.filename() == "..")
            model = fs::absolute(model, ignored).lexically_normal().parent_path();
        fs::path config = model.parent_path() / kConfigName;
        return config == model ? fs::path() : config;
    }
    return {};
}

fs::path configOfUser() {
    const fs::path settings = settingsFolder();
    return settings.empty() ? settings : settings / "svt" / kConfigName;
}

// Paths of the user's file are relative to its folder.
void placePaths(DefaultValue& value, const fs::path& config) {
    if (!isInput(*value.option)) return;
    for (std::string& text : value.values)
        if (!isFromElsewhere(text)) text = (config.parent_path() / userPath(text)).string();
}

bool hasDefaults(const CommandText& command) {
    return std::ranges::any_of(command.options(), [](const Option& option) { return option.name == "--no-config"; });
}

}  // namespace

Result<Defaults> Defaults::add(const CommandText& command, std::vector<GivenOption>& given) {
    Defaults defaults;
    if (!hasDefaults(command) || isInEnvironment("SVT_NO_CONFIG") || findGiven(given, "--no-config") != nullptr)
        return defaults;
    const std::pair<fs::path, ConfigOwner> files[] = {{configOfProject(given), ConfigOwner::Project},
                                                      {configOfUser(), ConfigOwner::User}};
    std::vector<const BoundOption*> hidden;  // flags that are switched off
    for (const auto& [file, owner] : files) {
        if (file.empty()) continue;
        SVT_TRY(read, readConfig(file, owner, command));
        if (!*read) continue;
        Used used{file.string(), {}};
        std::vector<GivenOption> added;
        for (DefaultValue& value : **read) {
            const auto isReplacedBy = [&value](const GivenOption& other) {
                return other.option == value.option || frontend::excludeEachOther(*other.option, *value.option);
            };
            if (std::ranges::any_of(given, isReplacedBy) || std::ranges::find(hidden, value.option) != hidden.end())
                continue;
            if (value.isOff) {
                hidden.push_back(value.option);
                continue;
            }
            placePaths(value, file);
            used.options.push_back(value.option);
            added.push_back({value.option, std::move(value.values)});
        }
        given.insert(given.end(), added.begin(), added.end());
        defaults.used_.push_back(std::move(used));
    }
    return defaults;
}

void Defaults::dropOptionsForModels(std::vector<GivenOption>& given) {
    for (Used& used : used_) {
        std::erase_if(given, [&](const GivenOption& each) {
            return each.option->isForModels && std::ranges::find(used.options, each.option) != used.options.end();
        });
        std::erase_if(used.options, [](const BoundOption* option) { return option->isForModels; });
    }
}

void Defaults::print() const {
    for (const Used& used : used_) {
        std::string names;
        for (const BoundOption* option : used.options)
            names.append(names.empty() ? "" : ", ").append(longName(*option));
        note(fmt::format("defaults of {}: {}", used.file, names.empty() ? "none for this command" : names));
    }
}

}  // namespace svt::cli
