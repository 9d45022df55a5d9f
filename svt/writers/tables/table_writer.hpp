#pragma once
/// \file
/// Writes what is known of the objects of a volume, and their contacts, as CSV (RFC 4180, UTF-8, a header line, metres),
/// which spreadsheets, pandas and databases read.

#include <svt/core/progress.hpp>
#include <svt/core/result.hpp>
#include <svt/volume/semantic_volume.hpp>

#include <cstdint>
#include <filesystem>
#include <string>

namespace svt::writers {

/// One line per label in table order: number, id, class, name, parent's id, scalars, voxels, volume (m3), surface and
/// its part that touches background (m2), box of its voxels along world axes (m), colour, opacity, filling, then each
/// attribute that some label has, named `attribute:NAME`, with its unit in brackets where all have the same.
/// Cost: that of analyze::findContacts().
[[nodiscard]] std::string makeObjectTable(const volume::SemanticVolume& volume, int threads = 0);

/// One line per pair of labels whose voxels share faces, and per label that touches background (b is empty): ids,
/// classes and names of both, area (m2), faces across x, y and z. Ordered by (a, b).
[[nodiscard]] std::string makeContactTable(const volume::SemanticVolume& volume, int threads = 0);

}  // namespace svt::writers
