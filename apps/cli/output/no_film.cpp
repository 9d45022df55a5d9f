// Films on platforms that cannot start other programs.
#include <apps/cli/output/film.hpp>

namespace svt::cli {

bool isFilm(const std::filesystem::path& file) {
    const std::string ending = file.extension().string();
    return ending == ".webm" || ending == ".mp4" || ending == ".gif" || ending == ".webp";
}

Film::Film(std::filesystem::path, std::filesystem::path, int rate) : rate_(rate) {}

Result<Film> Film::begin(const std::filesystem::path& output, int) {
    return Error(Code::CannotWrite, output.string() +
                                        ": films need the native program; here, write separate pictures: -o "
                                        "P.png --frames N");
}
Result<void> Film::add(const image::Image<image::Rgba8>&) { return {}; }
Result<void> Film::finish(const Progress*) { return {}; }

}  // namespace svt::cli
