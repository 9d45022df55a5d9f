#pragma once
/// \file
/// The comparison of two states as reports of the command describe it.

#include <svt/compare/compared.hpp>

namespace svt::cli {

using compare::allRows, compare::changedVolume, compare::ClassSums, compare::Compared, compare::comparisonSummary,
    compare::otherProperties, compare::rowsByVolume, compare::RowSubject, compare::StateFeatures, compare::subjectOf,
    compare::sumsByClass, compare::withoutRounding;

}  // namespace svt::cli
