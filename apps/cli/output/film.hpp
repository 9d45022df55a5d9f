#pragma once
/// \file
/// Films: pictures one after the other, encoded by the program ffmpeg.

#include <svt/core/file.hpp>
#include <svt/core/progress.hpp>
#include <svt/core/result.hpp>
#include <svt/image/image.hpp>

#include <filesystem>

namespace svt::cli {

/// Whether the ending of a file is that of a film: .webm, .mp4, .gif or .webp.
[[nodiscard]] bool isFilm(const std::filesystem::path& file);

/// A film that is being made. Its pictures stay in a temporary folder as PNG (100 kB to some MB each) until finish().
class Film {
public:
    /// \param rate  pictures a second
    /// \return the film, or CannotWrite where ffmpeg is not installed or the temporary folder cannot be made
    [[nodiscard]] static Result<Film> begin(const std::filesystem::path& output, int rate);

    /// Adds the next picture; all of one size.
    /// \return nothing, or CannotWrite, DiskFull
    [[nodiscard]] Result<void> add(const image::Image<image::Rgba8>& picture);

    /// Encodes the film and puts it in its place: WebM as VP9, MP4 as H.264, GIF with one palette for all pictures, WebP
    /// as animation; the latter two repeat without end. Sides are made even for WebM and MP4 by a white row or
    /// column. Equal pictures give equal bytes with the same build of ffmpeg.
    /// \return nothing, or CannotWrite with what ffmpeg says
    [[nodiscard]] Result<void> finish(const Progress* progress);

private:
    Film(std::filesystem::path output, std::filesystem::path encoder, int rate);

    std::filesystem::path output_, encoder_;
    PrivateFolder folder_;
    int rate_, count_ = 0;
};

}  // namespace svt::cli
