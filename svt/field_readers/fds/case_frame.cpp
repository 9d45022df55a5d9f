#include <svt/field_readers/fds/case_frame.hpp>

#include <svt/core/file.hpp>
#include <svt/core/text.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace svt::field_readers {
namespace {

constexpr std::size_t kMaxHead = std::size_t{1} << 16;  // the comment stands in the first lines

}  // namespace

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
