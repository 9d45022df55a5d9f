#pragma once
/// \file
/// The text file of an FDS case that lists its meshes and results (`.smv`). After the readers of Smokeview
/// (firemodels/smv) and the writers of FDS (firemodels/fds).

#include <svt/core/result.hpp>
#include <svt/core/vec.hpp>
#include <svt/field_readers/common/placement.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace svt::field_readers {

struct SmvMesh {
    std::string name;
    Vec3i cells{};
    NodePlaces nodes;  ///< cells + 1 places per axis, metres
};

enum class SmvKind : std::uint8_t {
    Slice,      ///< SLCF: values at nodes, file .sf
    CellSlice,  ///< SLCC: values of cells, file .sf
    Smoke       ///< SMOKF3D: values at nodes in 8 bits, file .s3d
};

/// A device: a point that FDS records values of.
struct SmvDevice {
    std::string quantity;
    Vec3d at{};  ///< coordinates of FDS, metres
};

/// A file of results.
struct SmvFile {
    SmvKind kind = SmvKind::Slice;
    std::size_t mesh = 0;   ///< in SmvCase::meshes
    int slice = -1;         ///< number of the slice, the same in all meshes; -1: unknown
    double extinction = 0;  ///< of smoke, m2/kg
    std::string file, quantity, shortName, unit;
    std::uint64_t line = 0;  ///< in the .smv
};

struct SmvCase {
    std::vector<SmvMesh> meshes;
    std::vector<SmvFile> files;
    std::string inputFile, version, deviceFile;
    std::map<std::string, std::uint64_t> leftOut;             ///< entries of other kinds, by keyword
    std::map<std::string, std::pair<double, double>> ranges;  ///< HRRPUV_MINMAX, TEMP_MINMAX
    std::map<std::string, SmvDevice, std::less<>> devices;    ///< by name
    bool isCut = false;                                       ///< the last entry is not whole
};

/// \param path  for messages
/// \return the case, or BadField with the line
[[nodiscard]] Result<SmvCase> parseSmv(std::string_view text, const std::filesystem::path& path);

}  // namespace svt::field_readers
