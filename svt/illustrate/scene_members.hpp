#pragma once
/// \file
/// The members of a scene file (`*.scene.json`), declared once: parseScene() reads by this table, the options of
/// `svt render` take their ranges and defaults from it, and docs/formats/scene.schema.json and the controls' limits of
/// the viewer page (web/viewer/src/generated/scene_members.ts) are written from it.

#include <svt/core/option.hpp>

#include <span>
#include <string_view>
#include <vector>

namespace svt::illustrate {

/// All members, an object before its own; named by JSON pointers with * for any index: "/passes/*/styles/*/opacity".
[[nodiscard]] std::span<const Option> sceneMembers() noexcept;

/// The member of that name, or of a pointer with indices such as "/passes/0/level"; there must be one.
[[nodiscard]] const Option& sceneMember(std::string_view pointer);

/// Names of the members of an object: {"strength", "width", ...} of "/lines"; "" is the scene.
[[nodiscard]] std::vector<std::string_view> sceneMembersOf(std::string_view pointer);

}  // namespace svt::illustrate
