#pragma once
/// \file
/// Features as a GeoPackage.

#include <svt/writers/feature_layer.hpp>

namespace svt::writers {

/// See FeatureLayer::create().
[[nodiscard]] Result<std::unique_ptr<FeatureLayer>> makePackageLayer(const std::filesystem::path& path,
                                                                     const std::vector<Column>& columns,
                                                                     const std::string& crsName,
                                                                     FeatureLayer::Options options);

}  // namespace svt::writers
