#pragma once
/// \file
/// Films: series of pictures, encoded by the program ffmpeg.

#include <svt/core/file.hpp>
#include <svt/core/progress.hpp>
#include <svt/core/result.hpp>
#include <svt/image/image.hpp>

#include <filesystem>

namespace svt::cli {

/// Whether a file has the ending of a film: .webm, .mp4, .gif or .webp.
[[nodiscard]] bool isFilm(const std::filesystem::path& file);

/// Makes a film. Its pictures stay in a temporary folder as PNG (100 kB to some MB each) until finish().
class Film {
public:
    /// \param rate  pictures per second
    /// \return the film, or CannotWrite if ffmpeg is not installed or the temporary folder cannot be made
    [[nodiscard]] static Result<Film> begin(const std::filesystem::path& output, int rate);

    /// Adds the next picture. All pictures must have the same size.
    /// \return nothing, or CannotWrite, DiskFull
    [[nodiscard]] Result<void> add(const image::Image<image::Rgba8>& picture);

    /// Encodes the film and writes it: WebM as VP9, MP4 as H.264, GIF with one palette for all pictures, WebP as
    /// animation; the latter two repeat without end. For WebM and MP4, a white row or column makes sides even. Equal
    /// pictures give equal bytes with the same build of ffmpeg.
    /// \return nothing, or CannotWrite with the messages of ffmpeg
    [[nodiscard]] Result<void> finish(const Progress* progress);

private:
    Film(std::filesystem::path output, std::filesystem::path encoder, int rate);

    std::filesystem::path output_, encoder_;
    PrivateFolder folder_;
    int rate_, count_ = 0;
};

}  // namespace svt::cli
