#pragma once
/// \file
/// Defaults of a project and of the user, which options on the command line replace.

#include <apps/cli/options/catalog.hpp>

#include <string>
#include <vector>

namespace svt::cli {

/// Options that come from files with defaults.
class Defaults {
public:
    /// Adds the defaults of the files to the given options. The command line precedes svt.json in the folder of the first
    /// model, which precedes svt.json in the folder of the user's settings. A default is left out if an option that
    /// precedes it excludes it. Reads no file with --no-config or if the environment has
    /// SVT_NO_CONFIG.
    /// \return the added options, or BadDefaults
    [[nodiscard]] static Result<Defaults> add(const CommandText& command, std::vector<frontend::GivenOption>& given);

    /// Removes the added options on building a volume from a model. Call it if all inputs are volumes.
    void dropOptionsForModels(std::vector<frontend::GivenOption>& given);

    /// Prints the used files and options, one line per file; with --verbose, and after an error of usage.
    void print() const;

private:
    struct Used {
        std::string file;
        std::vector<const frontend::BoundOption*> options;
    };
    std::vector<Used> used_;
};

}  // namespace svt::cli
