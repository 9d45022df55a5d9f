#pragma once
/// \file
/// Models of prisms for tests of the simulation, as CityJSON text, and their volumes.

#include <svt/core/file.hpp>
#include <svt/core/temporary_folder_test.hpp>
#include <svt/pipeline/build_volume.hpp>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

namespace svt::simulate::test {

struct PlanPoint {
    double x = 0, y = 0;
};

/// A body or a room: a convex polygon in plan, counter-clockwise, between two heights. Metres.
struct Prism {
    std::string name;
    bool isRoom = false;
    std::vector<PlanPoint> ring;
    double low = 0, high = 0;
};

inline Prism boxPrism(std::string name, bool isRoom, Vec3d min, Vec3d max) {
    return {std::move(name), isRoom, {{min.x, min.y}, {max.x, min.y}, {max.x, max.y}, {min.x, max.y}}, min.z, max.z};
}

/// A CityJSON document of the prisms. Coordinates are rounded to a micrometre.
inline std::string prismModel(const std::vector<Prism>& prisms) {
    std::string objects, vertices, children;
    std::size_t count = 0;
    const auto add = [&](PlanPoint p, double z) {
        vertices += fmt::format("{}[{},{},{}]", vertices.empty() ? "" : ",", std::llround(p.x * 1e6),
                                std::llround(p.y * 1e6), std::llround(z * 1e6));
        return count++;
    };
    for (std::size_t n = 0; n < prisms.size(); ++n) {
        const Prism& prism = prisms[n];
        const std::size_t size = prism.ring.size(), first = count;
        for (const PlanPoint& p : prism.ring) add(p, prism.low);
        for (const PlanPoint& p : prism.ring) add(p, prism.high);
        std::string lower, upper, faces;
        for (std::size_t c = 0; c < size; ++c) {
            lower += fmt::format("{}{}", c > 0 ? "," : "", first + size - 1 - c);
            upper += fmt::format("{}{}", c > 0 ? "," : "", first + size + c);
            const std::size_t next = (c + 1) % size;
            faces += fmt::format(",[[{},{},{},{}]]", first + c, first + next, first + size + next, first + size + c);
        }
        const std::string id = fmt::format("p{}", n);
        children += fmt::format("{}\"{}\"", n > 0 ? "," : "", id);
        objects += fmt::format(
            R"(,"{}":{{"type":"{}","parents":["b"],"attributes":{{"name":"{}"}},"geometry":[{{"type":"Solid","lod":"3","boundaries":[[[[{}]],[[{}]]{}]]}}]}})",
            id, prism.isRoom ? "BuildingRoom" : "BuildingConstructiveElement", prism.name, lower, upper, faces);
    }
    return fmt::format(
        R"({{"type":"CityJSON","version":"2.0","transform":{{"scale":[1e-6,1e-6,1e-6],"translate":[0,0,0]}},"CityObjects":{{"b":{{"type":"Building","children":[{}]}}{}}},"vertices":[{}]}})",
        children, objects, vertices);
}

/// The prisms between planes, from the name of the material at their middle; empty names are left out, those that begin with
/// "room" are rooms. Later tests select them by name.
inline std::vector<Prism> blocksBetween(const std::vector<double>& x, const std::vector<double>& y,
                                        const std::vector<double>& z, const std::function<std::string(Vec3d)>& nameAt) {
    std::vector<Prism> prisms;
    for (std::size_t k = 0; k + 1 < z.size(); ++k)
        for (std::size_t j = 0; j + 1 < y.size(); ++j)
            for (std::size_t i = 0; i + 1 < x.size(); ++i) {
                const std::string name = nameAt({(x[i] + x[i + 1]) / 2, (y[j] + y[j + 1]) / 2, (z[k] + z[k + 1]) / 2});
                if (name.empty()) continue;
                prisms.push_back(
                    boxPrism(name, name.starts_with("room"), {x[i], y[j], z[k]}, {x[i + 1], y[j + 1], z[k + 1]}));
            }
    return prisms;
}

inline std::vector<Prism> turned(std::vector<Prism> prisms, double degrees) {
    const double angle = degrees * std::numbers::pi / 180, c = std::cos(angle), s = std::sin(angle);
    for (Prism& prism : prisms)
        for (PlanPoint& p : prism.ring) p = {c * p.x - s * p.y, s * p.x + c * p.y};
    return prisms;
}

/// The volume of the prisms, through a file and the whole build.
inline volume::SemanticVolume buildPrisms(const std::vector<Prism>& prisms, Vec3d spacing,
                                          pipeline::AxesKind axes = pipeline::AxesKind::World) {
    const svt::test::TemporaryFolder folder;
    const std::filesystem::path file = folder / "model.city.json";
    EXPECT_TRUE(writeFileAtomically(file, prismModel(prisms)));
    pipeline::BuildOptions options;
    options.spacing = spacing;
    options.axes = axes;
    options.vectors.meshes = true;
    const std::filesystem::path files[] = {file};
    auto built = pipeline::buildVolume(files, options);
    EXPECT_TRUE(built) << built.error().toString();
    return built ? std::move(built->volume) : volume::SemanticVolume();
}

}  // namespace svt::simulate::test
