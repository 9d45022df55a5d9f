#pragma once
/// \file
/// The members of scene files as records: scene_members.cpp declares each once, bound to its field.

#include <svt/illustrate/scene.hpp>
#include <svt/record/record.hpp>

#include <string>

namespace svt::illustrate {

record::Members<SceneCamera> membersOf(const SceneCamera*) noexcept;
record::Members<BorderLook> membersOf(const BorderLook*) noexcept;
record::Members<HatchLook> membersOf(const HatchLook*) noexcept;
record::Members<Sun> membersOf(const Sun*) noexcept;
record::Members<SceneField> membersOf(const SceneField*) noexcept;
record::Members<Inset> membersOf(const Inset*) noexcept;
record::Members<Motion::Key> membersOf(const Motion::Key*) noexcept;
record::Members<Motion> membersOf(const Motion*) noexcept;
record::Members<SceneStyle> membersOf(const SceneStyle*) noexcept;
record::Members<SceneLines> membersOf(const SceneLines*) noexcept;
record::Members<ScenePass> membersOf(const ScenePass*) noexcept;
record::Members<Scene> membersOf(const Scene*) noexcept;

void checkMembers(record::Faults& faults, const std::string& path, const SceneField& read);
void checkMembers(record::Faults& faults, const std::string& path, const Inset& read);
void checkMembers(record::Faults& faults, const std::string& path, const Motion::Key& read);
void checkMembers(record::Faults& faults, const std::string& path, const Motion& read);

}  // namespace svt::illustrate
