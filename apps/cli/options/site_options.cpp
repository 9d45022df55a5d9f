#include <apps/cli/options/site_options.hpp>

#include <apps/cli/options/city_page.hpp>
#include <apps/cli/options/load_volume.hpp>
#include <apps/cli/options/shared_options.hpp>
#include <apps/cli/options/viewer_folder.hpp>
#include <apps/cli/output/json_output.hpp>
#include <apps/cli/output/terminal_progress.hpp>

#include <svt/core/file.hpp>
#include <svt/illustrate/scene_painter.hpp>
#include <svt/image/png.hpp>
#include <svt/readers/read_model.hpp>
#include <svt/volume/svt_file.hpp>

#include <fmt/format.h>

#include <cstdint>
#include <memory>
#include <optional>

namespace svt::cli {
namespace {

namespace fs = std::filesystem;

// A model as the bytes of a .svt; the temporary file is removed.
Result<FileBytes> built(const fs::path& input, const pipeline::BuildOptions& build, Diagnostics& diagnostics) {
    const TerminalProgress progress;
    SVT_TRY(volume, loadVolume(input, build, progress.get(), diagnostics));
    const PrivateFolder folder;
    if (folder.path().empty())
        return Error(Code::CannotWrite, "cannot create a folder for temporary files; set TMPDIR to a writable folder");
    const fs::path file = folder.path() / "model.svt";
    SVT_DO(volume::writeSvt(*volume, file));
    return FileBytes::map(file);  // no other program uses the file
}

Result<serve::SiteModel> modelOf(const fs::path& input, const std::string& name, const pipeline::BuildOptions& build,
                                 Diagnostics& diagnostics) {
    if (isCity(input)) return cityModel(input, name);
    SVT_TRY(file, volume::isSvtFile(input) ? FileBytes::read(input) : built(input, build, diagnostics));
    SVT_TRY(opened, volume::openSvt(file->bytes(), input.string()));
    const std::string title = opened->modelName.empty() ? input.stem().string() : opened->modelName;
    return serve::SiteModel{name, title, serve::Bytes::of(std::move(*file))};
}

Result<volume::SemanticVolume> volumeOf(const serve::SiteModel& model) {
    return model.city.empty() ? volume::readSvt(model.svt.data, model.name) : pageVolume(model.city);
}

// Draws pictures of models; keeps one model at a time in memory.
class Pictures {
public:
    Pictures(std::vector<serve::SiteModel> models, int threads) : models_(std::move(models)), threads_(threads) {}

    serve::Reply paint(const serve::Request& request, const Progress& stop) {
        // The parser drops values that are nested deeper than in any scene.
        constexpr int kMaxDepth = 32;
        const auto isShallow = [](int depth, Json::parse_event_t, Json&) { return depth <= kMaxDepth; };
        const Json json = Json::parse(request.body, isShallow, false);
        if (!json.is_object() || !json.contains("scene"))
            return refusal(Error(Code::BadJson, "expected {\"model\": NAME, \"scene\": {...}}"));
        const auto scene = illustrate::parseScene(json["scene"].dump());
        if (!scene) return refusal(scene.error());
        constexpr std::int64_t kMaxRays = std::int64_t{1} << 24;
        if (std::int64_t{scene->width} * scene->height * scene->samples > kMaxRays)
            return refusal(Error(Code::BadFrame, fmt::format("the picture has over {} rays, pixels times samples; make "
                                                             "it smaller",
                                                             kMaxRays)));
        const auto model = json.find("model");
        if (auto opened = open(model != json.end() && model->is_string() ? model->get<std::string>() : ""); !opened)
            return refusal(opened.error());
        render::CastOptions options;
        options.threads = threads_;
        options.isAdaptive = true;
        options.progress = &stop;
        const auto painting = painter_->paint(*scene, options);
        if (!painting) return refusal(painting.error());
        const auto png = image::encodePng(painting->frame.color);
        if (!png) return refusal(png.error());
        serve::Reply reply;
        reply.type = "image/png";
        reply.body = serve::Bytes::of(std::string(reinterpret_cast<const char*>(png->data()), png->size()));
        reply.headers = {{"Cache-Control", "no-store"}};
        return reply;
    }

private:
    static serve::Reply refusal(const Error& error) {
        return serve::Reply::error(422, codeTag(error.code()), error.message());
    }

    Result<void> open(const std::string& name) {
        const serve::SiteModel* wanted = models_.empty() ? nullptr : &models_.front();
        const auto isMeant = [&](const serve::SiteModel& model) {
            return model.name == name || model.name + ".svt" == name;
        };
        for (const serve::SiteModel& model : models_)
            if (isMeant(model)) wanted = &model;
        if (wanted == nullptr || (!name.empty() && !isMeant(*wanted)))
            return Error(Code::BadArgument, fmt::format("there is no model '{}'; models.json lists them", name));
        if (opened_ == wanted) return {};
        painter_.reset();
        volume_.reset();
        opened_ = nullptr;
        SVT_TRY(volume, volumeOf(*wanted));
        volume_ = std::move(*volume);
        painter_.emplace(*volume_, threads_);
        painter_->drawFacesBy(illustrate::makeFaces);
        opened_ = wanted;
        return {};
    }

    std::vector<serve::SiteModel> models_;
    int threads_;
    const serve::SiteModel* opened_ = nullptr;
    std::optional<volume::SemanticVolume> volume_;
    std::optional<illustrate::ScenePainter> painter_;
};

}  // namespace

Members<SiteArguments> membersOf(const SiteArguments*) noexcept {
    using All = SiteArguments;
    static constexpr Member<All> kMembers[] = {
        member<&All::viewer>("--viewer", "folder of the page",
                             {.value = "DIR",
                              .otherwise = "share/svt/viewer next to the program's folder",
                              .group = "Page",
                              .file = FileUse::InputFolder}),
        verboseOption<&All::verbose>("Page"),
        part<&All::build>("build"),
    };
    return kMembers;
}

Result<fs::path> SiteArguments::viewerFolder() const { return findViewerFolder(viewer); }

Result<std::vector<serve::SiteModel>> SiteArguments::load(const std::vector<fs::path>& inputs) const {
    std::vector<std::string_view> endings = readers::modelEndings();
    endings.emplace_back(".svt");
    const std::vector<std::string> names = serve::uniqueNames(inputs, endings);
    std::vector<serve::SiteModel> models;
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        Diagnostics diagnostics;
        auto model = modelOf(inputs[i], names[i], build, diagnostics);
        printDiagnostics(diagnostics, verbose);
        if (!model) return model.error();
        models.push_back(std::move(*model));
    }
    return models;
}

Result<serve::PagePreview> pagePreview(std::span<const serve::SiteModel> models, std::string address, int threads) {
    constexpr std::int32_t kWidth = 1200, kHeight = 630;
    serve::PagePreview preview;
    for (const serve::SiteModel& model : models) preview.title += (preview.title.empty() ? "" : ", ") + model.title;
    preview.description = "An interactive building model in three dimensions";
    if (!address.empty() && address.back() != '/') address += '/';
    preview.address = std::move(address);
    preview.size = {kWidth, kHeight, 0};
    SVT_TRY(volume, volumeOf(models.front()));
    illustrate::Scene scene;
    scene.width = kWidth;
    scene.height = kHeight;
    render::CastOptions options;
    options.threads = threads;
    options.isAdaptive = true;
    illustrate::ScenePainter painter(*volume, threads);
    painter.drawFacesBy(illustrate::makeFaces);
    SVT_TRY(painting, painter.paint(scene, options));
    SVT_TRY(png, image::encodePng(painting->frame.color));
    preview.picture = serve::Bytes::of(std::string(reinterpret_cast<const char*>(png->data()), png->size()));
    return preview;
}

serve::Route pictureRoute(std::vector<serve::SiteModel> models, int threads) {
    serve::Route route;
    route.path = "/api/picture";
    route.maxBodyBytes = 256 * 1024;
    route.queueLength = 4;
    const auto pictures = std::make_shared<Pictures>(std::move(models), threads);
    route.handle = [pictures](const serve::Request& request, const Progress& stop) {
        return pictures->paint(request, stop);
    };
    return route;
}

}  // namespace svt::cli
