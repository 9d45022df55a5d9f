#pragma once
/// \file
/// A file of an OpenFOAM case, written piece by piece.

#include <svt/core/result.hpp>
#include <svt/writers/dense/new_folder.hpp>

#include <fmt/format.h>

#include <iterator>
#include <string>
#include <string_view>
#include <utility>

namespace svt::writers {

/// Text in ASCII with the header that every file of OpenFOAM has. Memory: 1 MB.
class FoamFile {
public:
    /// \param name       in the case, such as "constant/polyMesh/points"
    /// \param className  of OpenFOAM, such as "vectorField"
    /// \param note       free text without quotes; empty: none
    FoamFile(NewFolder& folder, std::string name, std::string_view className, std::string_view note = {});

    template <class... Arguments>
    void line(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
        fmt::format_to(std::back_inserter(text_), format, std::forward<Arguments>(arguments)...);
        add("\n");
    }
    void add(std::string_view text);

    /// Writes the rest. \return success, or DiskFull, CannotWrite
    [[nodiscard]] Result<void> end();

private:
    void flush();

    NewFolder& folder_;
    std::string name_, text_;
    bool isBegun_ = false;
    Result<void> written_;
};

}  // namespace svt::writers
