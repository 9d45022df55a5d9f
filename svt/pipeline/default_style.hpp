#pragma once
/// \file
/// The built-in style sheets, as the JSON that a user could have written.

namespace svt::pipeline {

extern const char* const kDefaultStyleJson;     ///< colours and opacities by class
extern const char* const kDefaultPatternsJson;  ///< patterns by class and material, on top

}  // namespace svt::pipeline
