#pragma once
/// \file
/// Options common to all readers: limits, threads and progress reports.

#include <svt/core/progress.hpp>
#include <svt/record/members.hpp>

#include <cstdint>
#include <string>

namespace svt::readers {

struct ReadOptions {
    std::uint64_t maxBytes = std::uint64_t{16} << 30;  ///< limit on input bytes (after decompression)
    std::uint32_t maxDepth = 512;                      ///< limit on nesting of elements or arrays
    int threads = 0;                                   ///< 0: all cores; the result does not depend on it
    const Progress* progress = nullptr;                ///< may be null

    /// EPSG code of a projection in metres for the model; 0: the CRS of the file, or `likelyCrs` if that is not in
    /// metres.
    int crs = 0;
    int likelyCrs = 0;  ///< preferred EPSG code if coordinates must be projected; 0: the usual one
    /// Order of the axes. 0: by the name of the CRS and its area of use. +1: east first, -1: north first, regardless of
    /// both; also for parts of a file whose order was determined for the whole file.
    int axisOrder = 0;
    double unit = 0;  ///< GML, CityJSON: metres per unit of lengths; 0: that of the file, else metres
    /// Date "YYYY-MM-DD" of the state that is read: features that exist then; "all": all features. Empty: all features
    /// that have not ended today.
    std::string date;
    bool keepFarFeatures = false;    ///< features far away from all others are not left out
    bool extrudeFootprints = false;  ///< footprints with a height as attribute become solids
    bool allowTruncated = false;     ///< read a file that was cut off up to the cut (IFC, CityJSONSeq)
    bool splitLayers = false;        ///< IFC: walls and slabs become the layers of their material
    /// The images of textures are read from this folder and those below it. Empty: readModel(path) takes the folder of
    /// the file, and models in memory have no such images.
    std::string imageFolder;
};

/// The options that a user can set.
record::Members<ReadOptions> membersOf(const ReadOptions*) noexcept;

}  // namespace svt::readers
