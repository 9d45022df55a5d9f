#pragma once
/// \file
/// Sheets that are laid out and ready to be painted, one by one, onto the canvas of any format.

#include <svt/writers/canvas/sheet_canvas.hpp>
#include <svt/writers/sheet_writer.hpp>

#include <cstddef>
#include <memory>

namespace svt::writers {

class PreparedSheets {
public:
    /// Crops the drawings to the building, places them on sheets and finds the places of their marks. Lists of rooms
    /// without a stamp that do not fit beside a plan become tables on further sheets.
    /// \param volume   must outlive the sheets
    /// \param threads  0: all cores; the result does not depend on it
    /// \return the sheets, or an error of layOutSheets()
    [[nodiscard]] static Result<PreparedSheets> make(const SheetContent& content, const volume::SemanticVolume& volume,
                                                     const SheetOptions& options, int threads = 0);
    PreparedSheets(PreparedSheets&& other) noexcept;
    ~PreparedSheets();

    [[nodiscard]] std::size_t size() const noexcept;
    /// Paints one sheet. Several threads may paint different sheets.
    void paint(std::size_t sheet, SheetCanvas& canvas) const;

private:
    struct Parts;
    explicit PreparedSheets(std::unique_ptr<const Parts> parts) noexcept;

    std::unique_ptr<const Parts> parts_;
};

}  // namespace svt::writers
