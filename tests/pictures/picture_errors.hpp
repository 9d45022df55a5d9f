#pragma once
/// \file
/// How far pictures of a volume are from the triangles of its model: eight cameras, all pixels, against MeshTracer.

#include <svt/core/result.hpp>
#include <svt/image/image.hpp>
#include <svt/model/building_model.hpp>
#include <svt/volume/brick_volume.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace svt::test {

/// Errors of a picture, or of several.
struct PictureErrors {
    std::string camera;
    std::size_t pixels = 0;     ///< with the model in the picture or by its triangles
    std::size_t undecided = 0;  ///< left out: the triangles do not decide them
    std::size_t outline = 0;    ///< one of the two shows the background
    std::size_t label = 0;      ///< they show different features
    std::size_t normal = 0;     ///< they show the same feature, with normals more than 1.5 degrees apart
    std::vector<float> depths;  ///< metres, of the pixels where both show the model: absolute differences, unordered
    image::Image<image::Rgba8> map;  ///< red: outline, blue: label, orange: normal, violet: depth off by over 1 cm

    void add(const PictureErrors& other);
    [[nodiscard]] double percent(std::size_t count) const noexcept {
        return pixels == 0 ? 0 : 100 * static_cast<double>(count) / static_cast<double>(pixels);
    }
    /// The depth error, metres, that a share of the pixels does not exceed; 0 without pixels.
    [[nodiscard]] double depthAt(double share) const;
};

struct PictureOptions {
    double spacing = 0.05;  ///< metres
    int width = 480, height = 300;
    volume::BrickFaces faces = volume::BrickFaces::Slopes;  ///< as in pictures of the command
    bool isExact = false;                                   ///< by the faces of the model (render::FaceModel)
};

/// Builds the volume of a model, and compares its pictures with the triangles, camera by camera. Spaces are not drawn,
/// all else is opaque.
[[nodiscard]] Result<std::vector<PictureErrors>> measurePictures(const model::BuildingModel& model,
                                                                 const PictureOptions& options);

}  // namespace svt::test
