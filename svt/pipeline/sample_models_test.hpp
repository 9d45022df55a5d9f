#pragma once
/// \file
/// Volumes of the generated models, for tests of other folders that need a whole building.

#include <svt/core/temporary_folder_test.hpp>
#include <svt/pipeline/build_volume.hpp>
#include <svt/samples/sample.hpp>

#include <gtest/gtest.h>

#include <filesystem>
#include <span>
#include <string>

namespace svt::test {

/// A generated model as a volume with its meshes and edges. \param spacing  metres, of all axes
inline volume::SemanticVolume volumeOfSample(samples::SampleKind kind, samples::SampleFormat format, double spacing,
                                             const samples::SampleOptions& options = {}, bool hasMeshes = true) {
    const TemporaryFolder folder;
    const std::filesystem::path file =
        folder / (std::string("sample.") + (format == samples::SampleFormat::Ifc4 ? "ifc" : "gml"));
    const auto text = samples::writeSample(kind, format, options);
    EXPECT_TRUE(text);
    if (!text) return {};
    writeText(file, *text);
    pipeline::BuildOptions build;
    build.spacing = Vec3d{spacing, spacing, spacing};
    build.vectors = {.edges = hasMeshes, .meshes = hasMeshes};
    build.usePatterns = true;
    auto built = pipeline::buildVolume(std::span(&file, 1), build);
    EXPECT_TRUE(built) << built.error().toString();
    return built ? std::move(built->volume) : volume::SemanticVolume{};
}

}  // namespace svt::test
