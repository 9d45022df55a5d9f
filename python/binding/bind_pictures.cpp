// Pictures: frames, whose buffers numpy uses without copies, and PNG.
#include "arrays.hpp"
#include "bindings.hpp"
#include "keywords.hpp"
#include "long_call.hpp"
#include "volume_object.hpp"

#include <svt/city/city_painter.hpp>
#include <svt/frontend/scene_options.hpp>
#include <svt/image/png.hpp>

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <memory>
#include <utility>

namespace svt::python {
namespace {

struct FrameObject {
    render::Frame frame;
    int dpi = 0;
    std::vector<std::string> notes;
};
using SharedFrame = std::shared_ptr<FrameObject>;

SharedFrame draw(const SharedVolume& volume, const py::dict& given, const py::object& report) {
    const auto options = fromKeywords<frontend::SceneOptions>(given);
    const illustrate::Scene scene = valueOf(options.toScene(1));
    auto made = std::make_shared<FrameObject>();
    made->dpi = options.printedDpi();
    auto painting = longCall(report, [&](const Progress* progress) {
        render::CastOptions casting;
        casting.progress = progress;
        casting.isAdaptive = true;  // like the command, so that pictures are equal
        return volume->paint(scene, casting, made->notes);
    });
    made->frame = std::move(painting.frame);
    return made;
}

struct CityObject {
    city::City city;
    std::uint64_t memoryBytes;
};

SharedFrame drawCity(const CityObject& city, const py::dict& given, const py::object& report) {
    const auto options = fromKeywords<frontend::SceneOptions>(given);
    if (!options.cutaway.empty())
        throw Failure(Error(Code::BadArgument, "cutaway: for one volume only; take a part of the city"));
    const illustrate::Scene scene = valueOf(options.toScene(1));
    if (scene.surfaces == illustrate::SurfaceSource::Exact)
        throw Failure(Error(Code::BadArgument, "surfaces: exact is for one volume only; take a part of the city"));
    auto made = std::make_shared<FrameObject>();
    made->dpi = options.printedDpi();
    auto painting = longCall(report, [&](const Progress* progress) -> Result<illustrate::Painting> {
        SVT_TRY(painter, city::CityPainter::make(city.city, {city.memoryBytes, 0, progress}));
        render::CastOptions casting;
        casting.progress = progress;
        casting.isAdaptive = true;
        auto painted = painter->paint(scene, casting);
        made->notes = painter->nothing();
        return painted;
    });
    made->frame = std::move(painting.frame);
    return made;
}

static_assert(sizeof(image::Rgba8) == 4);

template <class T, class Pixel>
py::array_t<T> bufferOf(const py::object& self, const image::Image<Pixel>& image, bool hasChannels) {
    std::vector<py::ssize_t> shape{image.height(), image.width()};
    if (hasChannels) shape.push_back(py::ssize_t(sizeof(Pixel) / sizeof(T)));
    // The frame belongs only to this object, so its owner may write to it.
    return py::array_t<T>(shape, reinterpret_cast<const T*>(image.pixels().data()), self);
}

using Pixels = py::array_t<std::uint8_t, py::array::c_style>;

image::Image<image::Rgba8> imageOf(const Pixels& pixels) {
    if (pixels.ndim() != 3 || pixels.shape(2) != 4)
        throw py::value_error("pixels: expected an array of height x width x 4");
    if (pixels.shape(0) > image::kMaxPngSize || pixels.shape(1) > image::kMaxPngSize)
        throw Failure(Error(Code::BadImage,
                            "the image is larger than " + std::to_string(image::kMaxPngSize) + " pixels along a side"));
    image::Image<image::Rgba8> image(static_cast<std::int32_t>(pixels.shape(1)),
                                     static_cast<std::int32_t>(pixels.shape(0)));
    if (pixels.size() != 0) std::memcpy(image.pixels().data(), pixels.data(), static_cast<std::size_t>(pixels.size()));
    return image;
}

}  // namespace

void bindPictures(py::module_& module) {
    py::class_<FrameObject, SharedFrame>(module, "Frame")
        .def_property_readonly("color",
                               [](const py::object& self) {
                                   return bufferOf<std::uint8_t>(self, self.cast<SharedFrame>()->frame.color, true);
                               })
        .def_property_readonly("scalar",
                               [](const py::object& self) {
                                   return bufferOf<volume::Scalar>(self, self.cast<SharedFrame>()->frame.label, false);
                               })
        .def_property_readonly(
            "depth",
            [](const py::object& self) { return bufferOf<float>(self, self.cast<SharedFrame>()->frame.depth, false); })
        .def_property_readonly("dpi", [](const FrameObject& frame) { return frame.dpi; })
        .def_property_readonly("notes", [](const FrameObject& frame) { return frame.notes; });
    py::class_<CityObject>(module, "City")
        .def_property_readonly("buildings", [](const CityObject& city) { return city.city.buildings(); })
        .def_property_readonly("spacing", [](const CityObject& city) { return city.city.spacing(); })
        .def_property_readonly("crs", [](const CityObject& city) { return city.city.crsName(); })
        .def_property_readonly("box",
                               [](const CityObject& city) {
                                   const auto corner = [](Vec3d p) { return std::array{p.x, p.y, p.z}; };
                                   return std::pair(corner(city.city.box().min), corner(city.city.box().max));
                               })
        .def(
            "search",
            [](const CityObject& city, const std::string& words, std::size_t most) {
                const auto found = longCall(py::none(), [&](const Progress*) { return city.city.search(words, most); });
                std::vector<std::array<std::string, 4>> rows;
                for (const auto& [id, name, className, address] : found.buildings)
                    rows.push_back({id, name, className, address});
                return std::pair(found.count, rows);
            },
            py::arg("words"), py::arg("most"));
    module.def(
        "open_city",
        [](const std::filesystem::path& folder, double memoryMb) {
            return CityObject{longCall(py::none(), [&](const Progress*) { return city::City::open(folder); }),
                              static_cast<std::uint64_t>(memoryMb * 1e6)};
        },
        py::arg("folder"), py::arg("memory"));
    module.def("draw_city", &drawCity, py::arg("city"), py::arg("options"), py::arg("progress"));
    module.def("draw", &draw, py::arg("volume"), py::arg("options"), py::arg("progress"));
    module.def("draw_keywords", [] { return describeKeywords(frontend::optionsOf<frontend::SceneOptions>()); });
    module.def(
        "encode_png",
        [](const Pixels& pixels, int dpi) {
            const auto image = imageOf(pixels);
            const auto bytes = longCall(py::none(), [&](const Progress*) { return image::encodePng(image, dpi); });
            return py::bytes(reinterpret_cast<const char*>(bytes.data()), bytes.size());
        },
        py::arg("pixels"), py::arg("dpi"));
    module.def(
        "read_png",
        [](const std::filesystem::path& path) {
            auto image = longCall(py::none(), [&](const Progress*) { return image::readPng(path); });
            const std::vector<py::ssize_t> shape{image.height(), image.width(), 4};
            auto owned = std::make_unique<image::Image<image::Rgba8>>(std::move(image));
            const auto* memory = reinterpret_cast<const std::uint8_t*>(owned->pixels().data());
            const py::capsule owner(owned.release(),
                                    [](void* held) { delete static_cast<image::Image<image::Rgba8>*>(held); });
            return py::array_t<std::uint8_t>(shape, memory, owner);
        },
        py::arg("path"));
    module.def(
        "write_png",
        [](const std::filesystem::path& path, const Pixels& pixels, int dpi) {
            const auto image = imageOf(pixels);
            longCall(py::none(), [&](const Progress*) { return image::writePng(path, image, dpi); });
        },
        py::arg("path"), py::arg("pixels"), py::arg("dpi"));
}

}  // namespace svt::python
