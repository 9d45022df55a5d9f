#include <svt/illustrate/annotate/marks.hpp>

#include <svt/core/rounding.hpp>
#include <svt/illustrate/annotate/name_tags.hpp>
#include <svt/image/text.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace svt::illustrate {
namespace {

image::TextStyle textStyle(double height, Vec3f color, Vec3f halo) {
    return {height, color, halo, std::max(1.0, 0.14 * height)};
}

// A line with its outline.
void stroke(image::Image<image::Rgba8>& image, Vec3d from, Vec3d to, double width, Vec3f color, Vec3f halo) {
    image::drawLine(image, from.x, from.y, to.x, to.y, {2.4 * width, halo});
    image::drawLine(image, from.x, from.y, to.x, to.y, {width, color});
}

std::string lengthText(double metres) {
    if (metres >= 1000) return fmt::format("{:g} km", metres / 1000);
    if (metres < 1) return fmt::format("{:g} cm", metres * 100);
    return fmt::format("{:g} m", metres);
}

}  // namespace

void drawTitle(const std::string& title, Vec3f color, Vec3f halo, image::Image<image::Rgba8>& image) {
    const double height = 1.6 * nameHeight(image.height());
    image::drawText(image, height, 1.1 * height, shortened(title, 0.75 * image.width() - height, height),
                    textStyle(height, color, halo));
}

void drawScaleBar(const render::Camera& camera, Vec3f color, Vec3f halo, image::Image<image::Rgba8>& image) {
    const double height = nameHeight(image.height());
    const double metresPerPixel = camera.orthographicHeight / image.height();
    const double metres = roundDownTo125(0.25 * image.width() * metresPerPixel);
    const double length = metres / metresPerPixel, left = 1.5 * height, y = image.height() - 2.6 * height;
    const double width = std::max(1.0, height / 8);
    stroke(image, {left, y, 0}, {left + length, y, 0}, width, color, halo);
    for (const double x : {left, left + length / 2, left + length})
        stroke(image, {x, y - 0.4 * height, 0}, {x, y + 0.4 * height, 0}, width, color, halo);
    const std::string text = lengthText(metres);
    image::drawText(image, left + (length - image::textWidth(text, height)) / 2, y + 1.2 * height, text,
                    textStyle(height, color, halo));
}

void drawNorthArrow(const render::Camera& camera, Vec3d north, Vec3f color, Vec3f halo,
                    image::Image<image::Rgba8>& image) {
    const double height = nameHeight(image.height()), width = std::max(1.0, height / 8);
    const Vec3d forward = normalized(camera.target - camera.eye);
    const Vec3d right = normalized(cross(forward, camera.up)), up = cross(right, forward);
    // In pixels, whose y goes down.
    const Vec3d seen{dot(north, right), -dot(north, up), 0};
    const Vec3d middle{image.width() - 4 * height, image.height() - 4 * height, 0};
    const image::TextStyle style = textStyle(1.2 * height, color, halo);
    const double letter = image::textWidth("N", style.height);
    if (length(seen) < 0.1) {
        // Dot or cross as in drawings of currents: towards the viewer a dot, away from it a cross.
        image::drawDot(image, middle.x, middle.y, 0.8 * height + width, halo);
        image::drawDot(image, middle.x, middle.y, 0.8 * height, color);
        image::drawDot(image, middle.x, middle.y, 0.8 * height - width, halo);
        if (dot(forward, north) < 0) image::drawDot(image, middle.x, middle.y, 0.25 * height, color);
        for (const double side : {1.0, -1.0})
            if (dot(forward, north) >= 0)
                image::drawLine(image, middle.x - 0.5 * height, middle.y - 0.5 * side * height, middle.x + 0.5 * height,
                                middle.y + 0.5 * side * height, {width, color});
        image::drawText(image, middle.x - letter / 2, middle.y - 1.6 * height, "N", style);
        return;
    }
    const Vec3d along = normalized(seen) * (2 * height), across{-along.y * 0.22, along.x * 0.22, 0};
    const Vec3d tip = middle + along, end = middle - along;
    stroke(image, end, tip, width, color, halo);
    for (const double side : {1.0, -1.0}) stroke(image, tip - along * 0.5 + across * side, tip, width, color, halo);
    const Vec3d place = tip + normalized(seen) * (0.9 * height);
    image::drawText(image, place.x - letter / 2, place.y, "N", style);
}

}  // namespace svt::illustrate
