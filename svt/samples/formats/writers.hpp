#pragma once
/// \file
/// The writers of the formats. Each writes one building at a time and keeps nothing of it.

#include <svt/samples/designs/source.hpp>
#include <svt/samples/formats/sample_text.hpp>

#include <string>
#include <string_view>

namespace svt::samples {

void writeCityGml3(SampleSource& source, TextSink& out);
void writeCityGml2(SampleSource& source, bool isThematic, TextSink& out);
void writeCityJson(SampleSource& source, TextSink& out);
void writeCityJsonSeq(SampleSource& source, TextSink& out);
/// ifc/ifc_writer.cpp. \param hasBakedOpenings  see SampleOptions::bakeOpenings
void writeIfc(SampleSource& source, bool hasBakedOpenings, TextSink& out);
/// A GlobalId (22 characters) that depends only on `key`; ifc/ifc_records.cpp.
[[nodiscard]] std::string globalId(std::string_view key);

/// The 16 numbers of an instance's transformation matrix, row by row, with `separator` between them: quarter turns,
/// then the turn of the placement.
[[nodiscard]] std::string matrixText(const PlacedPlan& placed, const Instance& instance, std::string_view separator);

}  // namespace svt::samples
