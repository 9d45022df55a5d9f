// For any bytes a file is cut into features that stand where they say, or it is an error; picked by their spans they are
// the same texts.
#include <svt/readers/feature_file.hpp>

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace {

using svt::readers::FeatureFile;

void require(bool condition) {
    if (!condition) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const std::filesystem::path path =
        std::filesystem::temp_directory_path() / ("svt-features-fuzz-" + std::to_string(::getpid()));
    static const int kAtEnd = std::atexit([] { std::filesystem::remove(path); });
    (void)kAtEnd;
    std::ofstream(path, std::ios::binary).write(reinterpret_cast<const char*>(data), std::streamsize(size));
    auto file = FeatureFile::open(path);
    if (!file) return 0;
    (void)file->head();
    std::vector<svt::readers::FeatureSpan> spans;
    std::vector<std::string> texts;
    for (svt::readers::FeatureText feature; spans.size() < 200;) {
        const auto found = file->next(feature);
        if (!found || !*found) break;
        require(spans.empty() || feature.span.begin >= spans.back().begin);
        spans.push_back(feature.span);
        texts.emplace_back(feature.text);
    }
    auto again = FeatureFile::open(path);
    require(static_cast<bool>(again));
    const auto picked = again->pick(spans, [&](std::size_t n, std::string_view text) -> svt::Result<void> {
        require(n < texts.size() && text == texts[n]);
        return {};
    });
    (void)picked;
    svt::readers::ReadOptions options;
    options.threads = 1;
    const std::vector<std::string_view> views(texts.begin(), texts.end());
    if (!views.empty()) (void)again->read(views, options, nullptr);
    return 0;
}
