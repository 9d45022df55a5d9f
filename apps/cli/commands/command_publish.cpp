#include <apps/cli/options/catalog.hpp>
#include <apps/cli/options/shared_options.hpp>
#include <apps/cli/options/site_options.hpp>
#include <apps/cli/output/messages.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace svt::cli {
namespace {

struct PublishArguments {
    std::vector<std::filesystem::path> inputs;
    std::filesystem::path output;
    SiteArguments site;
    std::string address;
    bool mayReplace = false;
};

int runPublish(const PublishArguments& arguments) {
    const auto viewer = arguments.site.viewerFolder();
    if (!viewer) return fail(viewer.error());
    const std::string& address = arguments.address;
    if (!address.empty() && address.rfind("https://", 0) != 0 && address.rfind("http://", 0) != 0)
        return fail(Error(
            Code::BadArgument,
            fmt::format("--url '{}': expected the address of the page, such as https://example.org/house/", address)));
    if (auto checked = serve::checkSiteFolder(arguments.output, arguments.mayReplace); !checked)
        return fail(checked.error());
    const auto models = arguments.site.load(arguments.inputs);
    if (!models) return fail(models.error());
    auto site = serve::viewerSite(*viewer, *models);
    if (!site) return fail(site.error());
    auto preview = pagePreview(*models, arguments.address, arguments.site.build.threads);
    if (!preview) return fail(preview.error());
    if (auto added = serve::addPageHead(*site, std::move(*preview)); !added) return fail(added.error());
    const auto bytes = serve::writeSite(*site, arguments.output, arguments.mayReplace);
    if (!bytes) return fail(bytes.error());
    const bool hasCity =
        std::any_of(models->begin(), models->end(), [](const serve::SiteModel& model) { return !model.city.empty(); });
    if (!isQuiet())
        fmt::print("{}: {} files, {:.1f} kB; {} shows it\n", arguments.output.string(), site->resources().size(),
                   double(*bytes) / 1000, hasCity ? "a web server that knows range requests" : "any web server");
    return kDone;
}

Members<PublishArguments> membersOf(const PublishArguments*) noexcept {
    using All = PublishArguments;
    static constexpr Member<All> kMembers[] = {
        siteInputs<&All::inputs>(),
        member<&All::output>("-o,--output", "the folder to write",
                             {.value = "DIR", .isRequired = true, .file = FileUse::OutputFolder}),
        member<&All::mayReplace>("--force", "write into a folder that is not empty; what is not of the page stays"),
        member<&All::address>("--url",
                              "where the page will be, such as https://example.org/house/, for previews of links to it",
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
