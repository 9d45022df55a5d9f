#include <apps/cli/run/config_file.hpp>

#include <svt/core/edit_distance.hpp>
#include <svt/core/file.hpp>
#include <svt/record/record.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <system_error>

namespace svt::cli {
namespace {

namespace fs = std::filesystem;
using frontend::BoundOption;
using record::Json;

// Deeper values occur in no file.
constexpr int kMaxDepth = 8;
constexpr std::string_view kAllCommands = "*";

// A file being checked.
struct Checked {
    const fs::path& path;
    ConfigOwner owner;

    [[nodiscard]] Error wrong(const std::string& key, std::string_view fault) const {
        return Error(
            Code::BadDefaults,
            fmt::format("{}{}{}; correct the file, or ignore it with --no-config", key, key.empty() ? "" : ": ", fault),
            Place{path.string(), 0, 0, {}});
    }
};

// "size" of "--size" and "-q,--quiet".
std::string_view keyOf(const Option& option) {
    const std::string_view name = longName(option);
    return name.substr(std::min(name.find_first_not_of('-'), name.size()));
}

const BoundOption* findOption(const CommandText& command, std::string_view key) {
    const auto options = command.options();
    const auto found = std::ranges::find_if(options, [&](const Option& option) { return keyOf(option) == key; });
    return found == options.end() ? nullptr : &*found;
}

const CommandText* findCommand(std::string name) {
    std::replace(name.begin(), name.end(), ' ', '-');  // "city plan"
    const auto found = std::ranges::find(commandTexts(), name, &CommandText::name);
    return found == commandTexts().end() ? nullptr : &*found;
}

// "; did you mean 'size'?", or nothing.
std::string suggestion(std::string_view word, const std::vector<std::string_view>& known) {
    const std::string_view best = nearestName(word, known);
    return best.empty() ? std::string() : fmt::format("; did you mean '{}'?", best);
}

// Why a file may not set an option; empty: it may.
std::string_view whyNot(const BoundOption& option, ConfigOwner owner) {
    if (!option.name.starts_with('-')) return "arguments have no defaults; give it on the command line";
    if (isOutput(option)) return "it names an output, which has no default; give it on the command line";
    if (option.name == "--no-config" || option.name == "--format")
        return "it belongs to one run; give it on the command line";
    if (owner == ConfigOwner::User || option.isForProjects) return {};
    return "a file beside a model may only set how models are built and drawn, because the folder may be from a "
           "stranger; set it in the file of the user, or on the command line";
}

// A value as the text of a command line; nothing for other kinds of values.
std::optional<std::string> textOf(const Json& value) {
    if (value.is_string()) return value.get<std::string>();
    if (value.is_number()) return value.dump();
    return std::nullopt;
}

Result<DefaultValue> readValue(const Checked& file, const std::string& key, const BoundOption& option,
                               const Json& json) {
    DefaultValue value{&option, {}, false};
    if (option.kind == OptionKind::Flag || (option.leastCount == 0 && json.is_boolean())) {
        if (!json.is_boolean())
            return file.wrong(key, fmt::format("expected true or false, found {}", record::shortened(json)));
        value.isOff = !json.get<bool>();
        return value;
    }
    const bool mayBeList = option.mayRepeat || option.count > 1;
    std::vector<Json> parts{json};
    if (json.is_array() && mayBeList) parts.assign(json.begin(), json.end());
    for (const Json& part : parts) {
        const auto text = textOf(part);
        if (!text)
            return file.wrong(key, fmt::format("expected a text or a number{}, found {}",
                                               mayBeList ? ", or a list of them" : "", record::shortened(part)));
        for (std::string& each : frontend::valuesOf(option, *text)) value.values.push_back(std::move(each));
    }
    if (value.values.empty()) return file.wrong(key, "the list is empty; leave it out");
    for (const std::string& each : value.values)
        if (const std::string fault = faultOf(option, each); !fault.empty()) return file.wrong(key, fault);
    return value;
}

// The commands that a part of the file is for.
std::vector<const CommandText*> commandsOf(const std::string& name) {
    std::vector<const CommandText*> commands;
    if (const CommandText* one = findCommand(name); one != nullptr) commands.push_back(one);
    if (name == kAllCommands)
        for (const CommandText& each : commandTexts()) commands.push_back(&each);
    return commands;
}

// Checks one option in all commands that it is for, and adds it if `wanted` is one of them. A value for all commands must
// be one of `wanted`, and of some command.
Result<void> takeOption(const Checked& file, const std::string& part, const std::string& name, const Json& json,
                        const CommandText& wanted, std::vector<DefaultValue>& to) {
    const std::string key = part + "." + name;
    std::vector<std::string_view> known;
    std::optional<Error> fault;
    bool isKnown = false, isValid = false;
    for (const CommandText* command : commandsOf(part)) {
        for (const Option& option : command->options()) known.push_back(keyOf(option));
        const BoundOption* option = findOption(*command, name);
        if (option == nullptr) continue;
        isKnown = true;
        if (const std::string_view reason = whyNot(*option, file.owner); !reason.empty()) {
            if (!fault) fault = file.wrong(key, reason);
            continue;  // other commands may have another option of this name
        }
        auto value = readValue(file, key, *option, json);
        isValid = isValid || value;
        if (!value && (command->name == wanted.name || !fault)) fault = value.error();
        if (command->name != wanted.name) continue;
        if (!value) return value.error();
        const bool isSet = std::ranges::any_of(to, [&](const DefaultValue& other) { return other.option == option; });
        if (!isSet) to.push_back(std::move(*value));
    }
    if (!isKnown)
        return file.wrong(key, fmt::format("there is no such option{}{}",
                                           part == kAllCommands ? "" : " of this command", suggestion(name, known)));
    return isValid ? Result<void>() : Result<void>(*fault);
}

Result<void> takePart(const Checked& file, const std::string& part, const Json& json, const CommandText& wanted,
                      std::vector<DefaultValue>& to) {
    if (commandsOf(part).empty()) {
        std::vector<std::string_view> known{kAllCommands};
        for (const CommandText& command : commandTexts()) known.push_back(command.name);
        return file.wrong(part,
                          "there is no such command; expected a command, or '*' for all" + suggestion(part, known));
    }
    if (!json.is_object())
        return file.wrong(part, fmt::format("expected an object with options, such as {{\"threads\": 4}}, found {}",
                                            record::shortened(json)));
    for (const auto& [name, value] : json.items()) SVT_DO(takeOption(file, part, name, value, wanted, to));
    return {};
}

// Two defaults of one file that exclude each other.
Result<void> checkPairs(const Checked& file, const std::vector<DefaultValue>& defaults) {
    for (const DefaultValue& one : defaults)
        for (const DefaultValue& other : defaults)
            if (!one.isOff && !other.isOff && frontend::excludeEachOther(*one.option, *other.option))
                return file.wrong(
                    "", fmt::format("'{}' and '{}' exclude each other", keyOf(*one.option), keyOf(*other.option)));
    return {};
}

// The line of a byte, from 1.
std::size_t lineOf(std::string_view text, std::size_t byte) {
    return 1 + static_cast<std::size_t>(
                   std::count(text.begin(), text.begin() + std::ptrdiff_t(std::min(byte, text.size())), '\n'));
}

Result<Json> parse(const Checked& file, std::string_view text) {
    bool isTooDeep = false;
    const auto isShallow = [&isTooDeep](int depth, Json::parse_event_t, Json&) {
        isTooDeep = isTooDeep || depth > kMaxDepth;
        return depth <= kMaxDepth;
    };
    try {
        Json json = Json::parse(text, isShallow);
        if (isTooDeep) return file.wrong("", "values are nested too deeply");
        if (!json.is_object())
            return file.wrong("", "expected an object with commands, such as {\"*\": {\"threads\": 4}}");
        return json;
    } catch (const Json::parse_error& error) {
        return file.wrong(fmt::format("line {}", lineOf(text, error.byte)), "this is not well-formed JSON");
    } catch (const Json::exception&) {  // a number out of range
        return file.wrong("", "a number is out of range");
    }
}

}  // namespace

Result<std::optional<std::vector<DefaultValue>>> readConfig(const fs::path& path, ConfigOwner owner,
                                                            const CommandText& command) {
    using Values = std::optional<std::vector<DefaultValue>>;
    std::error_code ignored;
    const fs::file_type type = fs::symlink_status(path, ignored).type();
    // A folder that cannot be searched has no file for this user.
    if (type == fs::file_type::not_found || type == fs::file_type::none) return Values();
    const Checked file{path, owner};
    const auto bytes = FileBytes::read(path, kMaxConfigBytes);
    if (!bytes) return file.wrong("", bytes.error().message());
    SVT_TRY(json, parse(file, bytes->text()));
    if (json->contains("format") && (*json)["format"] == "svt") return Values();  // the header of an unpacked .svt
    std::vector<DefaultValue> defaults;
    const auto take = [&](bool isForAll) -> Result<void> {
        for (const auto& item : json->items())
            if ((item.key() == kAllCommands) == isForAll)
                SVT_DO(takePart(file, item.key(), item.value(), command, defaults));
        return {};
    };
    SVT_DO(take(false));
    SVT_DO(take(true));
    SVT_DO(checkPairs(file, defaults));
    return Values(std::move(defaults));
}

}  // namespace svt::cli
