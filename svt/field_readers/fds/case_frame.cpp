#include <svt/field_readers/fds/case_frame.hpp>

#include <svt/core/file.hpp>
#include <svt/core/text.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace svt::field_readers {
namespace {

constexpr std::size_t kMaxHead = std::size_t{1} << 16;  // the comment stands in the first lines

// Removes "(x, y, z)" from the front of a text.
bool takeVector(std::string_view& text, Vec3d& to) {
    for (int axis = 0; axis < 3; ++axis) {
        const std::size_t begin = text.find_first_not_of(axis == 0 ? " (" : " ,");
        if (begin == std::string_view::npos) return false;
        text.remove_prefix(begin);
        const auto number = takeNumber(text);
        if (!number) return false;
        to[axis] = *number;
    }
    if (!text.starts_with(')')) return false;
    text.remove_prefix(1);
    return true;
}

bool takeWord(std::string_view& text, std::string_view word) {
    if (!text.starts_with(word)) return false;
    text.remove_prefix(word.size());
    return true;
}

}  // namespace

std::optional<Frame> frameOfComment(std::string_view fdsText) {
    constexpr std::string_view kMark = "Metres from ";
    const std::size_t at = fdsText.find(kMark);
    if (at == std::string_view::npos) return std::nullopt;
    std::string_view text = fdsText.substr(at + kMark.size());
    Frame frame;
    if (!takeVector(text, frame.origin) || !takeWord(text, " along ") || !takeVector(text, frame.axes[0]) ||
        !takeWord(text, " and ") || !takeVector(text, frame.axes[1]))
        return std::nullopt;
    const auto isUnit = [](Vec3d v) { return std::abs(length(v) - 1) < 1e-6; };
    if (!isUnit(frame.axes[0]) || !isUnit(frame.axes[1]) || std::abs(dot(frame.axes[0], frame.axes[1])) > 1e-6)
        return std::nullopt;
    frame.axes[2] = cross(frame.axes[0], frame.axes[1]);
    return frame;
}

Frame frameOfCase(const SmvCase& fds, const Reading& reading, Assumptions& assumptions) {
    std::optional<Frame> found;
    // The case may come from another machine, so only a file beside the results is read.
    const std::filesystem::path name = std::filesystem::path(fds.inputFile).filename();
    if (!name.empty())
        if (const auto file = PartFile::open(reading.path.parent_path() / name))
            if (const auto head = file->read(0, kMaxHead)) found = frameOfComment(*head);
    Frame frame = found.value_or(Frame{});
    if (reading.options.at) {
        frame.origin = *reading.options.at;
        assumptions.add("place",
                        fmt::format("origin of FDS at ({}, {}, {}), given; axes {}", frame.origin.x, frame.origin.y,
                                    frame.origin.z, found ? "by the comment in " + name.string() : "of the world"));
    } else if (found) {
        assumptions.add("place", fmt::format("by the comment in {}", name.string()));
    } else {
        assumptions.add("place", "coordinates of FDS taken as world coordinates");
        reading.note(
            "the case does not state its place, so the coordinates of FDS count as world coordinates; give the place "
            "of "
            "their origin with --at X,Y,Z");
    }
    return frame;
}

}  // namespace svt::field_readers
