#include <apps/cli/options/catalog.hpp>
#include <apps/cli/options/shared_options.hpp>
#include <apps/cli/options/site_options.hpp>
#include <apps/cli/output/messages.hpp>
#include <svt/serve/precompressed.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace svt::cli {
namespace {

struct PublishArguments {
    std::vector<std::filesystem::path> inputs;
    std::filesystem::path output;
    SiteArguments site;
    std::string address;
    bool isForced = false;
};

Result<int> runPublish(const PublishArguments& arguments) {
    SVT_TRY(viewer, arguments.site.viewerFolder());
    const std::string& address = arguments.address;
    if (!address.empty() && address.rfind("https://", 0) != 0 && address.rfind("http://", 0) != 0)
        return Error(
            Code::BadArgument,
            fmt::format("--url '{}': expected the address of the page, such as https://example.org/house/", address));
    if (arguments.isForced)
        note("--force has no effect any more and will be removed: publish replaces an earlier page, and nothing else");
    SVT_DO(serve::checkSiteFolder(arguments.output));
    SVT_TRY(models, arguments.site.load(arguments.inputs));
    SVT_TRY(site, serve::viewerSite(*viewer, *models));
    SVT_TRY(preview, pagePreview(*models, arguments.address, arguments.site.build.threads));
    SVT_DO(serve::addPageHead(*site, std::move(*preview)));
    if (!serve::addCompressedCopies(*site))
        note(
            "the page has no files compressed by Brotli (.br), because libbrotlienc.so.1 is missing (Debian: "
            "libbrotli1); .gz files are there");
    SVT_TRY(bytes, serve::writeSite(*site, arguments.output));
    const bool hasCity =
        std::any_of(models->begin(), models->end(), [](const serve::SiteModel& model) { return !model.city.empty(); });
    summarize(fmt::format("{}: {} files, {:.1f} kB; {} shows it", arguments.output.string(), site->resources().size(),
                          double(*bytes) / 1000,
                          hasCity ? "a web server with range requests (nginx, Apache, Caddy, S3; not 'python3 -m "
                                    "http.server' and 'php -S')"
                                  : "any web server"));
    return kDone;
}

Members<PublishArguments> membersOf(const PublishArguments*) noexcept {
    using All = PublishArguments;
    static constexpr Member<All> kMembers[] = {
        siteInputs<&All::inputs>(),
        member<&All::output>("-o,--output", "the folder to write",
                             {.value = "DIR", .isRequired = true, .file = FileUse::OutputFolder}),
        member<&All::isForced>("--force", "deprecated, has no effect: an earlier page is replaced without it"),
        member<&All::address>(
            "--url", "address of the published page, such as https://example.org/house/, for previews of links to it",
            {.value = "URL"}),
        quietOption<All>(),
        part<&All::site>("site"),
    };
    return kMembers;
}

}  // namespace

extern const CommandText kPublishCommand =
    commandOf<PublishArguments, runPublish>("publish", "Write the viewer with models as a folder for any web server");

}  // namespace svt::cli
