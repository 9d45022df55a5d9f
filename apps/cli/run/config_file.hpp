#pragma once
/// \file
/// Files with defaults of options: svt.json. JSON is the notation of all other files of SVT, and needs no further parser.
///
///     {"render": {"size": "1600x900"}, "*": {"threads": 4}}

#include <apps/cli/options/catalog.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace svt::cli {

/// The owner of a file with defaults.
enum class ConfigOwner : std::uint8_t {
    User,    ///< the user, for all models
    Project  ///< the author of the folder of the model, perhaps a stranger
};

/// The default of one option.
struct DefaultValue {
    const frontend::BoundOption* option = nullptr;
    std::vector<std::string> values;  ///< as on a command line; empty for a flag
    bool isOff = false;               ///< a flag that is false: it hides defaults of other files
};

/// Largest file with defaults.
inline constexpr std::uint64_t kMaxConfigBytes = std::uint64_t{1} << 20;

/// The defaults that a file has for a command. Those of "*", for all commands, come last, and only if the command has no
/// own one. The whole file is checked, also its parts for other commands.
/// \return the defaults; nothing if there is no file; BadDefaults with the place, the fault and the remedy
[[nodiscard]] Result<std::optional<std::vector<DefaultValue>>> readConfig(const std::filesystem::path& file,
                                                                          ConfigOwner owner,
                                                                          const CommandText& command);

}  // namespace svt::cli
