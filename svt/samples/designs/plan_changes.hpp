#pragma once
/// \file
/// Edits of a plan with known answers: ground truth for comparisons of two states.

#include <svt/samples/parts/plan.hpp>
#include <svt/samples/sample.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace svt::samples {

/// An edit of one component. Ids are those in the plan.
struct PlanChange {
    SampleEdit edit = SampleEdit::Move;
    std::optional<std::string> was, is;  ///< ids; empty: the component was duplicated or deleted
    Point vector{};                      ///< millimetres, of a move
    int quarterTurns = 0;                ///< counter-clockwise seen from above, of a rotation: 1 or -1
    Length added = 0, removed = 0;       ///< cubic millimetres of the new shape outside of the old one, and the reverse
    std::pair<std::string, std::string> className{}, name{};  ///< old and new
};

struct PlanChanges {
    std::vector<PlanChange> edits;
    bool hasNewIds = false, hasNewTriangles = false, isReordered = false;  ///< of all components
};

/// Edits one to four components by their seed, and may give all components other ids, triangles and another order.
/// Only components whose pieces are boxes are edited, so that all volumes are sums of whole cubic millimetres.
/// \param plan  resolved; afterwards too
[[nodiscard]] PlanChanges changePlan(Plan& plan, std::uint64_t seed);

}  // namespace svt::samples
