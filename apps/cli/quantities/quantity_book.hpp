#pragma once
/// \file
/// The take-off of `svt quantities` as a workbook (XLSX).

#include <apps/cli/quantities/quantity_settings.hpp>
#include <apps/cli/quantities/take_off.hpp>

#include <string>
#include <vector>

namespace svt::cli {

/// The content of the sheet "About".
struct BookAbout {
    std::string input;  ///< as given
    Vec3d spacing;      ///< metres
    std::vector<std::string> assumptions, notes;
};

/// The sheets "Quantities", "Sums" (by the keys, else by class), "Exterior", "Formwork", "Stated" and "About".
/// \param hasStated  adds "Stated"; "Exterior" and "Formwork" need figures in the take-off
/// \return the file; or CannotWrite, see writers::makeXlsx(); BadArgument, see withQuantitySettings()
[[nodiscard]] Result<std::string> takeOffBook(const TakeOff& takeOff, bool hasStated, const BookAbout& about,
                                              const QuantitySettings& settings);

/// The sheets "Between" and "About".
/// \return as takeOffBook()
[[nodiscard]] Result<std::string> contactBook(const Table& contacts, const BookAbout& about,
                                              const QuantitySettings& settings);

}  // namespace svt::cli
