#include <svt/writers/foam/foam_file.hpp>

namespace svt::writers {
namespace {

constexpr std::size_t kBuffer = std::size_t{1} << 20;

}  // namespace

FoamFile::FoamFile(NewFolder& folder, std::string name, std::string_view className, std::string_view note)
    : folder_(folder), name_(std::move(name)) {
    const std::size_t slash = name_.rfind('/');
    line("FoamFile\n{{\n    version 2.0;\n    format ascii;\n    class {};", className);
    if (!note.empty()) line("    note \"{}\";", note);
    line("    location \"{}\";\n    object {};\n}}\n", std::string_view(name_).substr(0, slash),
         std::string_view(name_).substr(slash + 1));
}

void FoamFile::add(std::string_view text) {
    text_ += text;
    if (text_.size() >= kBuffer) flush();
}

void FoamFile::flush() {
    if (written_) written_ = isBegun_ ? folder_.append(name_, text_) : folder_.write(name_, text_);
    isBegun_ = true;
    text_.clear();
}

Result<void> FoamFile::end() {
    flush();
    return written_;
}

}  // namespace svt::writers
