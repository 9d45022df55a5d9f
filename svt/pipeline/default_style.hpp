#pragma once
/// \file
/// The built-in style sheets, as JSON in the format of user style files.

namespace svt::pipeline {

extern const char* const kDefaultStyleJson;     ///< colours and opacities by class
extern const char* const kDefaultPatternsJson;  ///< patterns by class and material, applied in addition

}  // namespace svt::pipeline
