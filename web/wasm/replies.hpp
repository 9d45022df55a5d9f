#pragma once
/// \file
/// Replies to the page as JSON: the types of web/viewer/src/engine.ts, member by member. Points are metres from the
/// grid's lower corner.

#include "session.hpp"

#include <svt/illustrate/scene.hpp>

#include <string>

namespace svt::web {

/// VolumeInfo
[[nodiscard]] std::string infoOf(const Session& session);
/// FeatureProperties, or NothingSelected if no feature has that id.
[[nodiscard]] Result<std::string> propertiesOf(Session& session, const std::string& id);
/// AttributeValues: the values of one attribute, in the order of the features of infoOf(); null for features without it.
/// A number whose unit differs from that of the first number is text with its unit.
/// Cost: O(attributes of all features).
[[nodiscard]] std::string attributeValuesOf(const Session& session, const std::string& name);
/// Pick or null
/// \param reach  maximum distance, metres, to snap to a corner or else an edge of the model; 0: no snapping
[[nodiscard]] std::string pickOf(Session& session, double x, double y, double reach);
/// Stretch[]
[[nodiscard]] Result<std::string> intervalsOf(Session& session, double x, double y);
/// string[]: ids
[[nodiscard]] Result<std::string> selectionOf(const Session& session, const std::string& query);
/// string[]: ids of features with an attribute that contains all words in its name or value. Upper and lower case ASCII
/// letters are equal.
[[nodiscard]] std::string attributesFoundIn(const Session& session, const std::string& words);

}  // namespace svt::web
