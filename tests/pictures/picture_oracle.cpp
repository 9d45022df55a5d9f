/// \file
/// Measures pictures of a model against its triangles; scripts/picture_oracle.py makes tables of its output.
///
///   svt_picture_oracle MODEL [--spacing 0.05] [--size 480x300] [--planes] [--exact] [--maps FOLDER]
///
/// Prints JSON: a row for each camera, and one for all. --maps writes a picture of the errors for each camera.
/// --planes draws borders that are parallel to an axis at the model's faces, too (BrickFaces::Planes). --exact finds
/// labels by the faces themselves (render::FaceModel), as `svt render --surfaces exact`.

#include "picture_errors.hpp"

#include <svt/image/png.hpp>
#include <svt/readers/read_model.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

namespace svt::test {
namespace {

struct Arguments {
    std::filesystem::path model, maps;
    PictureOptions options;
};

Arguments parse(const std::vector<std::string>& words) {
    Arguments arguments;
    for (std::size_t n = 0; n < words.size(); ++n) {
        const std::string& word = words[n];
        const std::string next = n + 1 < words.size() ? words[n + 1] : "";
        if (word == "--planes") {
            arguments.options.faces = volume::BrickFaces::Planes;
        } else if (word == "--exact") {
            arguments.options.isExact = true;
        } else if (word == "--spacing") {
            arguments.options.spacing = std::atof(next.c_str());
            ++n;
        } else if (word == "--size") {
            arguments.options.width = std::atoi(next.c_str());
            arguments.options.height = std::atoi(next.substr(next.find('x') + 1).c_str());
            ++n;
        } else if (word == "--maps") {
            arguments.maps = next;
            ++n;
        } else {
            arguments.model = word;
        }
    }
    return arguments;
}

nlohmann::ordered_json rowOf(const PictureErrors& errors) {
    return {{"camera", errors.camera},
            {"pixels", errors.pixels},
            {"undecided", errors.undecided},
            {"outlinePercent", errors.percent(errors.outline)},
            {"labelPercent", errors.percent(errors.label)},
            {"normalPercent", errors.percent(errors.normal)},
            {"depth50", errors.depthAt(0.5)},
            {"depth95", errors.depthAt(0.95)}};
}

int run(const Arguments& arguments) {
    const auto model = readers::readModel(arguments.model);
    if (!model) {
        fmt::print(stderr, "{}\n", model.error().toString());
        return EXIT_FAILURE;
    }
    const auto all = measurePictures(*model, arguments.options);
    if (!all) {
        fmt::print(stderr, "{}\n", all.error().toString());
        return EXIT_FAILURE;
    }
    PictureErrors sum;
    sum.camera = "all";
    nlohmann::ordered_json rows = nlohmann::ordered_json::array();
    for (const PictureErrors& errors : *all) {
        rows.push_back(rowOf(errors));
        sum.add(errors);
        if (arguments.maps.empty()) continue;
        std::filesystem::create_directories(arguments.maps);
        const auto written = image::writePng(arguments.maps / (errors.camera + ".png"), errors.map);
        if (!written) fmt::print(stderr, "{}\n", written.error().toString());
    }
    rows.push_back(rowOf(sum));
    fmt::print("{}\n", rows.dump(1));
    return EXIT_SUCCESS;
}

}  // namespace
}  // namespace svt::test

int main(int count, char** words) { return svt::test::run(svt::test::parse({words + 1, words + count})); }
