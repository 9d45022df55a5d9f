#pragma once
/// \file
/// What is known of the objects of a volume, and their contacts, as tables, which become CSV or Parquet for spreadsheets,
/// pandas and databases. Metres.

#include <svt/volume/semantic_volume.hpp>
#include <svt/writers/table.hpp>

namespace svt::writers {

/// One row per label in table order: number, id, class, name, parent's id, scalars, voxels, volume (m3), surface and
/// its part that touches background (m2), box of its voxels along world axes (m), colour, opacity, filling, then each
/// attribute that some label has, named `attribute:NAME`, with its unit in brackets where all have the same.
/// Cost: that of analyze::findContacts().
[[nodiscard]] Table makeObjectTable(const volume::SemanticVolume& volume, int threads = 0);

/// One row per pair of labels whose voxels share faces, and per label that touches background (b is empty): ids,
/// classes and names of both, area (m2), faces across x, y and z. Ordered by (a, b).
[[nodiscard]] Table makeContactTable(const volume::SemanticVolume& volume, int threads = 0);

}  // namespace svt::writers
