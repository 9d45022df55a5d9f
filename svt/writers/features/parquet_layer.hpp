#pragma once
/// \file
/// Features as GeoParquet 1.1: polygons as well-known binary, the CRS as PROJJSON.

#include <svt/writers/feature_layer.hpp>

namespace svt::writers {

/// See FeatureLayer::create().
[[nodiscard]] Result<std::unique_ptr<FeatureLayer>> makeParquetLayer(const std::filesystem::path& path,
                                                                     const std::vector<Column>& columns,
                                                                     const std::string& crsName,
                                                                     FeatureLayer::Options options);

}  // namespace svt::writers
