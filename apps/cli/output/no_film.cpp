// Films where no program can be started.
#include <apps/cli/output/film.hpp>

namespace svt::cli {

bool isFilm(const std::filesystem::path& file) {
    const std::string ending = file.extension().string();
    return ending == ".webm" || ending == ".mp4" || ending == ".gif" || ending == ".webp";
}

Film::Film(std::filesystem::path, std::filesystem::path, int rate) : rate_(rate) {}

Result<Film> Film::begin(const std::filesystem::path& output, int) {
    return Error(Code::CannotWrite, output.string() +
                                        ": films are made by the native program; here, write pictures one by "
                                        "one: -o P.png --frames N");
}
Result<void> Film::add(const image::Image<image::Rgba8>&) { return {}; }
Result<void> Film::finish(const Progress*) { return {}; }

}  // namespace svt::cli
