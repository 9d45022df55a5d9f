#pragma once
/// \file
/// The declarations of the members of a scene file (`*.scene.json`). parseScene(), writeScene() and the options of
/// `svt render` follow from them, as do docs/formats/scene.schema.json and the limits of the page's controls
/// (web/viewer/src/generated/scene_members.ts).

#include <svt/core/option.hpp>
#include <svt/core/result.hpp>

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace svt::illustrate {

struct Scene;

/// All members, an object before its members. Names are JSON pointers with * for any index:
/// "/passes/*/styles/*/opacity".
[[nodiscard]] std::span<const Option> sceneMembers() noexcept;

/// Finds a member by name, or by a pointer with indices such as "/passes/0/level"; null if there is none. An index
/// behind a member with several values is ignored: "/camera/eye/0" is "/camera/eye".
[[nodiscard]] const Option* findSceneMember(std::string_view pointer);

/// The same for a member that must exist.
[[nodiscard]] const Option& sceneMember(std::string_view pointer);

/// A member with the value from a command-line option or a keyword.
struct GivenMember {
    std::string member;  ///< "/camera/zoom"; "/passes/0/show/-" appends
    std::string value;   ///< JSON
    friend bool operator==(const GivenMember&, const GivenMember&) = default;
};

/// Sets a member.
/// \return success, or BadArgument with the name of the option
[[nodiscard]] Result<void> setSceneMember(Scene& scene, const GivenMember& given);

}  // namespace svt::illustrate
