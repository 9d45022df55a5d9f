#include <apps/cli/city/city_input.hpp>
#include <apps/cli/options/catalog.hpp>
#include <apps/cli/options/field_input.hpp>
#include <apps/cli/options/load_volume.hpp>
#include <apps/cli/options/shared_options.hpp>
#include <apps/cli/output/film.hpp>
#include <apps/cli/output/messages.hpp>
#include <apps/cli/output/output_files.hpp>
#include <apps/cli/output/pdf_notes.hpp>
#include <apps/cli/output/terminal_progress.hpp>

#include <svt/analyze/selection.hpp>
#include <svt/city/city_painter.hpp>
#include <svt/core/file.hpp>
#include <svt/core/machine.hpp>
#include <svt/drawing/building_levels.hpp>
#include <svt/drawing/line_view.hpp>
#include <svt/drawing/section_plane.hpp>
#include <svt/fields/field.hpp>
#include <svt/frontend/scene_options.hpp>
#include <svt/illustrate/color_by.hpp>
#include <svt/illustrate/details.hpp>
#include <svt/illustrate/motion.hpp>
#include <svt/illustrate/scene_painter.hpp>
#include <svt/illustrate/sun.hpp>
#include <svt/image/png.hpp>
#include <svt/readers/owner_table.hpp>
#include <svt/render/frame_buffers.hpp>
#include <svt/render_gl/egl_context.hpp>
#include <svt/render_gl/gl_renderer.hpp>
#include <svt/writers/sheet_writer.hpp>
#include <svt/writers/view_drawing.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <utility>

namespace svt::cli {
namespace {

struct RenderArguments {
    std::vector<std::filesystem::path> with;
    std::filesystem::path owners, input, output, labelOutput, depthOutput, sceneOutput;
    pipeline::BuildOptions build;
    frontend::SceneOptions scene;
    int frames = 1;
    bool gl = false;
    bool verbose = false;
};

// Draws the finest level of one volume with OpenGL; created on first use.
class GlDrawer {
public:
    explicit GlDrawer(int threads) : threads_(threads) {}

    Result<render::Frame> draw(std::span<const render::DrawnVolume> volumes, const render::FrameSpec& spec) {
        if (volumes.size() > 1 || volumes[0].level() != nullptr)
            return Error(Code::BadFrame,
                         "--gl draws one volume at its finest level, but the passes of this scene draw others; leave "
                         "out --gl");
        if (!context_) {
            unlimitMemory();  // drivers reserve what they never use
            SVT_TRY(context, render_gl::EglContext::make());
            context_.emplace(std::move(*context));
        }
        if (drawn_ != &volumes[0].bricks()) {
            SVT_TRY(renderer,
                    render_gl::GlRenderer::make(volumes[0].bricks(), volumes[0].grid(), {.threads = threads_}));
            renderer_.emplace(std::move(*renderer));
            drawn_ = &volumes[0].bricks();
        }
        return renderer_->read(spec);
    }

private:
    int threads_;
    std::optional<render_gl::EglContext> context_;  // destroyed after the objects that use it
    std::optional<render_gl::GlRenderer> renderer_;
    const volume::BrickVolume* drawn_ = nullptr;
};

// Passes without a level get the finest one. OpenGL draws no other level.
void takeFinest(illustrate::Scene& scene) {
    for (illustrate::ScenePass& pass : scene.passes)
        if (!pass.representation.level) pass.representation.level = 0;
}

// The pictures of a scene and their times: separate files, or a film.
struct Series {
    int count = 1;
    double seconds = 0;  ///< between two pictures
    std::optional<Film> film;
};

// \param moving  the scene with its motion
Result<Series> seriesOf(const RenderArguments& arguments, const illustrate::Scene& moving) {
    Series series;
    const illustrate::Motion motion = moving.motion.value_or(illustrate::Motion{});
    if (!isFilm(arguments.output)) {
        if (arguments.frames == 1 && arguments.scene.isGiven("/motion/turn"))
            return Error(Code::BadArgument,
                         "--turn moves the camera, which needs several pictures; give --frames N with N from 2, or "
                         "write a film (-o P.webm)");
        if (arguments.frames != 1 && motion.turn == 0 && motion.keys.empty())
            return Error(Code::BadArgument,
                         "nothing moves in these pictures; let the camera go around (--turn 360), a section move "
                         "(--section z=6..1), or give a scene with motion");
        series.count = arguments.frames;
        // The last picture shows the end. If the camera only goes around, the end would repeat the first picture.
        const int steps = motion.keys.empty() && motion.turn != 0 ? series.count : std::max(1, series.count - 1);
        series.seconds = motion.seconds / steps;
        return series;
    }
    if (arguments.frames != 1)
        return Error(Code::BadArgument,
                     "--frames is for separate pictures; --seconds and --rate give the number of pictures of a film");
    if (!arguments.labelOutput.empty() || !arguments.depthOutput.empty())
        return Error(Code::BadArgument, "--labels and --depth are for PNG, not for films");
    if (motion.turn == 0 && motion.keys.empty())
        return Error(Code::BadArgument,
                     "nothing moves in this film; let the camera go around (--turn 360), a section move "
                     "(--section z=6..1), or give a scene with motion");
    series.count = illustrate::pictureCount(motion);
    series.seconds = 1.0 / motion.rate;
    SVT_TRY(film, Film::begin(arguments.output, motion.rate));
    series.film.emplace(std::move(*film));
    return series;
}

Result<void> writeBuffers(const render::Frame& frame, const RenderArguments& arguments, int number) {
    const auto at = [&](const std::filesystem::path& file) { return numberedFile(file, number, arguments.frames); };
    SVT_DO(image::writePng(at(arguments.output), frame.color, arguments.scene.printedDpi()));
    if (!arguments.labelOutput.empty()) {
        SVT_TRY(gray, render::grayFromLabels(frame.label));
        SVT_DO(image::writePng(at(arguments.labelOutput), *gray));
    }
    if (!arguments.depthOutput.empty()) {
        constexpr float kMostDepth = 65.534f;  // metres
        const auto beyond = std::ranges::count_if(
            frame.depth.pixels(), [](float depth) { return std::isfinite(depth) && depth > kMostDepth; });
        if (beyond > 0)
            note(fmt::format("{}: {} pixels lie deeper than {} m, the most that 16 bits hold; they have this value",
                             at(arguments.depthOutput).string(), beyond, kMostDepth));
        return image::writePng(at(arguments.depthOutput), render::grayFromDepth(frame.depth, 0.001));
    }
    return {};
}

// Whether a picture shows no part of the model: no label, and no line or veil, which would vary along a row.
bool isEmpty(const render::Frame& frame) {
    for (std::int32_t y = 0; y < frame.color.height(); ++y)
        for (std::int32_t x = 0; x < frame.color.width(); ++x)
            if (frame.label.at(x, y) != 0 || frame.color.at(x, y) != frame.color.at(0, y)) return false;
    return true;
}

// Options to keep the vector data of the model that a scene needs.
pipeline::BuildOptions withVectors(const RenderArguments& arguments, const illustrate::Scene& scene) {
    pipeline::BuildOptions build = arguments.build;
    if (illustrate::drawsFaces(scene) && !arguments.gl) {
        // Without --surfaces exact, voxels replace meshes that lie too far away to be stored.
        const bool isWanted = scene.surfaces.has_value() || build.vectors.edges || build.vectors.meshes;
        build.vectors.isRequired = build.vectors.isRequired && isWanted;
        build.vectors.meshes = true;
    }
    for (const illustrate::ScenePass& pass : scene.passes) {
        build.vectors.edges = build.vectors.edges || !pass.lines.empty();
        build.vectors.meshes = build.vectors.meshes || !pass.meshes.empty();
        build.vectors.isRequired = build.vectors.isRequired || !pass.lines.empty() || !pass.meshes.empty();
    }
    return build;
}

// Adds the owners of labels to the volume, and loads the volumes that are drawn with it.
Result<std::vector<volume::SemanticVolume>> addInputs(const RenderArguments& arguments,
                                                      const pipeline::BuildOptions& build, const Progress* progress,
                                                      Diagnostics& diagnostics, volume::SemanticVolume& volume) {
    std::vector<volume::SemanticVolume> details;
    for (const auto& file : arguments.with) {
        SVT_TRY(detail, loadVolume(file, build, progress, diagnostics));
        details.push_back(std::move(*detail));
    }
    SVT_DO(illustrate::joinLabels(volume, details));
    if (arguments.owners.empty()) return details;
    SVT_TRY(table, readers::readOwnerTable(arguments.owners));
    SVT_DO(illustrate::addOwnerAttributes(volume, *table, arguments.owners.string(), diagnostics,
                                          arguments.build.threads));
    return details;
}

// Lists the targets of a cutaway that are not visible.
void noteCutaway(const std::string& query, const volume::SemanticVolume& volume, const render::Frame& frame) {
    if (query.empty()) return;
    const auto selected = analyze::selectLabels(volume, query);
    if (!selected) return;
    const auto wholes = analyze::Extents(volume.labels).wholes(*selected);
    const std::vector<std::uint32_t> labelOf = volume.labels.labelOfScalar();
    std::vector<bool> isSeen(volume.labels.labels.size() + 1, false);
    for (const volume::Scalar scalar : frame.label.pixels())
        if (scalar != 0 && scalar < labelOf.size() && labelOf[scalar] != volume::kNoLabel)
            isSeen[labelOf[scalar]] = true;
    std::vector<std::string> hidden;
    for (std::size_t n = 0; n < selected->size(); ++n) {
        const auto isAny = [&](const auto& is) { return std::any_of(wholes[n].begin(), wholes[n].end(), is); };
        const bool hasVoxels = isAny([&](std::uint32_t l) { return volume.labels.labels[l].voxels > 0; });
        if (!hasVoxels || isAny([&](std::uint32_t l) { return isSeen[l]; })) continue;
        const volume::Label& label = volume.labels.labels[(*selected)[n]];
        hidden.push_back(label.name.empty() ? label.id : label.name);
    }
    if (hidden.empty()) return;
    const std::size_t count = hidden.size();
    if (count > 5) hidden.resize(5);
    note(fmt::format("cutaway: {} of {} are not visible, behind other targets or outside of the picture: {}{}", count,
                     selected->size(), fmt::join(hidden, ", "), count > 5 ? ", ..." : ""));
}

// Prints the position of the sun: a picture does not show that its hour is wrong.
void noteSun(const illustrate::Scene& scene, const volume::SemanticVolume& volume) {
    if (!scene.sun) return;
    const auto light = illustrate::sunlightOf(*scene.sun, volume);
    if (!light) return;
    const auto& [azimuth, elevation] = light->position;
    note(fmt::format("sun: {:.1f} degrees {} the horizon, azimuth {:.1f}, at {:.4f}, {:.4f}{}", std::abs(elevation),
                     elevation > 0 ? "above" : "below", azimuth, light->latitude, light->longitude,
                     elevation > 0 ? "" : "; the picture has only the light of the sky"));
}

// Prints the number of names that are missing in a picture, and the reason.
void noteNames(const illustrate::Painting::Names& names) {
    if (names.hidden != 0) note(fmt::format("names: {} hidden features are not labelled", names.hidden));
    if (names.withoutRoom != 0)
        note(fmt::format("names: {} do not fit; choose a larger --size or a narrower --names", names.withoutRoom));
}

// Lists the section planes that are moved, and the reason.
void noteMovedPlanes(const illustrate::Scene& scene, const volume::SemanticVolume& volume) {
    for (const illustrate::MovedPlane& plane : illustrate::planesInFaces(scene, volume))
        note(fmt::format("the plane '{}' lies in faces of the model; it is moved by {:g} mm to the kept side",
                         plane.text, std::round(1e4 * plane.by) / 10));
}

// Reports storeys with a wrong level, if the scene has a plane or region of a storey.
void reportStoreys(const illustrate::Scene& scene, const volume::SemanticVolume& volume,
                   const std::filesystem::path& input) {
    const bool usesStoreys = std::ranges::any_of(scene.passes, [](const illustrate::ScenePass& pass) {
        return (pass.cut + pass.keep).find("storey=") != std::string::npos;
    });
    if (!usesStoreys) return;
    Diagnostics findings;
    drawing::reportStoreys(volume, findings);
    printVolumeFindings(findings, volume.source, input);
}

bool isLineDrawing(const std::filesystem::path& output) {
    const std::string ending = endingOf(output);
    return ending == ".svg" || ending == ".pdf";
}

Result<void> writeLineView(const RenderArguments& arguments, const drawing::LineView& view,
                           const volume::SemanticVolume& volume, int pixels, int number) {
    const int dpi = arguments.scene.printedDpi() > 0 ? arguments.scene.printedDpi() : 96;
    const double width = 25.4 * pixels / dpi;
    const auto path = numberedFile(arguments.output, number, arguments.frames);
    if (endingOf(path) == ".svg") {
        SVT_DO(writeFileAtomically(path, writers::makeViewSvg(view, volume, width)));
        return {};
    }
    SVT_TRY(pdf, writers::makeViewPdf(view, volume, width));
    if (number == 0) notePdf(*pdf);
    SVT_DO(writeFileAtomically(path, pdf->bytes));
    return {};
}

// Refuses parts of a scene that line drawings do not support, from options and from scene files.
Result<void> checkForLines(const RenderArguments& arguments, const illustrate::Scene& scene) {
    const bool hasCells =
        std::ranges::any_of(scene.passes, [](const auto& pass) { return pass.representation.hasCells; });
    const std::pair<bool, const char*> needs[] = {{!arguments.with.empty(), "--with"},
                                                  {!scene.insets.empty(), "--inset (insets of a scene)"},
                                                  {scene.explode != 0, "--explode (explode of a scene)"},
                                                  {scene.sun.has_value(), "--sun (sun of a scene)"},
                                                  {hasCells, "--cells (cells of a scene)"},
                                                  {!scene.colorBy.empty(), "--color-by (colorBy of a scene)"},
                                                  {!scene.names.empty(), "--names (names of a scene)"}};
    std::vector<const char*> found;
    for (const auto& [isGiven, option] : needs)
        if (isGiven) found.push_back(option);
    if (found.empty()) return {};
    return Error(Code::BadArgument,
                 fmt::format("line drawings do not support {}; leave it out, or write a .png", fmt::join(found, ", ")));
}

// Refuses what cannot be drawn with a field: it is never left out silently.
Result<void> checkForField(const RenderArguments& arguments, const illustrate::Scene& scene) {
    if (!scene.field) return {};
    const std::pair<bool, const char*> needs[] = {{arguments.gl, "--gl"},
                                                  {isLineDrawing(arguments.output), "-o .svg or .pdf"},
                                                  {!arguments.with.empty(), "--with"},
                                                  {isCity(arguments.input), "a city"},
                                                  {scene.explode != 0, "--explode (explode of a scene)"}};
    for (const auto& [isGiven, option] : needs)
        if (isGiven)
            return Error(
                Code::BadArgument,
                fmt::format("--field (field of a scene) does not support {}; leave out one of the two; svt section "
                            "draws fields as SVG, PDF, DXF and GeoJSON",
                            option));
    return {};
}

// Refuses inputs and outputs that are drawn only from voxels.
Result<void> checkForFaces(const RenderArguments& arguments, const illustrate::Scene& scene) {
    if (scene.surfaces != illustrate::SurfaceSource::Exact) return {};
    const std::pair<bool, const char*> needs[] = {
        {isLineDrawing(arguments.output), "-o .svg or .pdf, which draw the faces already"},
        {arguments.gl, "--gl"},
        {isCity(arguments.input), "a city"}};
    for (const auto& [isGiven, option] : needs)
        if (isGiven)
            return Error(Code::BadArgument,
                         fmt::format("--surfaces exact does not support {}; leave out one of the two", option));
    return illustrate::checkSurfaces(scene);
}

// Draws and writes the picture of a scene.
using DrawPicture = std::function<Result<void>(illustrate::Scene& scene, int number)>;

// Draws and writes all pictures of a series, then the scene itself.
// \param frame  the volume that cameras, planes and regions refer to
Result<int> drawSeries(const RenderArguments& arguments, Series& series, const illustrate::Scene& moving,
                       const volume::SemanticVolume& frame, TerminalProgress& progress, const DrawPicture& draw) {
    for (int number = 0; number < series.count; ++number) {
        progress.beginPart(number, series.count);
        SVT_TRY(scene, illustrate::sceneAt(moving, number * series.seconds, frame));
        SVT_DO(draw(*scene, number));
    }
    if (series.film) SVT_DO(series.film->finish(progress.get()));
    if (!arguments.sceneOutput.empty())
        SVT_DO(writeFileAtomically(arguments.sceneOutput, illustrate::writeScene(moving)));
    return kDone;
}

render::CastOptions castOptions(const RenderArguments& arguments, const TerminalProgress& progress) {
    render::CastOptions options;
    options.threads = arguments.build.threads;
    options.progress = progress.get();
    options.isAdaptive = true;
    return options;
}

Result<void> writePicture(const RenderArguments& arguments, Series& series, const render::Frame& frame, int number) {
    return series.film ? series.film->add(frame.color) : writeBuffers(frame, arguments, number);
}

// Draws lines instead of pixels, from the scene's camera, visible features and cutting plane.
Result<int> runLineDrawing(const RenderArguments& arguments, Series& series, const illustrate::Scene& moving) {
    if (arguments.gl || !arguments.labelOutput.empty() || !arguments.depthOutput.empty())
        return Error(Code::BadArgument, "--gl, --labels and --depth are for PNG, not for line drawings");
    SVT_DO(checkForLines(arguments, moving));
    TerminalProgress progress;
    pipeline::BuildOptions build = arguments.build;
    build.vectors.meshes = true;
    SVT_TRY(volume, loadVolume(arguments.input, build, progress.get(), arguments.verbose));
    drawing::LineViewOptions options;
    options.hidden = arguments.scene.hiddenLines == render::HiddenLines::Dashed;
    options.threads = arguments.build.threads;
    const auto draw = [&](const illustrate::Scene& scene, int number) -> Result<void> {
        Progress::tell(progress.get(), "lines", 0);
        if (number == 0) reportStoreys(scene, *volume, arguments.input);
        SVT_TRY(spec, illustrate::makeFrameSpec(scene, *volume));
        SVT_TRY(view, drawing::drawLineView(*volume, *spec, options));
        SVT_DO(writeLineView(arguments, *view, *volume, scene.width, number));
        if (view->drawing.beyond.empty() && view->drawing.components.empty()) note("nothing is visible");
        return {};
    };
    return drawSeries(arguments, series, moving, *volume, progress, draw);
}

// Refuses options that need all of a model at once.
Result<void> checkForCity(const RenderArguments& arguments, const illustrate::Scene& scene) {
    const std::pair<bool, const char*> needs[] = {{isLineDrawing(arguments.output), "-o .svg or .pdf"},
                                                  {!arguments.with.empty(), "--with"},
                                                  {!arguments.owners.empty(), "--owners"},
                                                  {arguments.gl, "--gl"},
                                                  {!arguments.scene.cutaway.empty(), "--cutaway"}};
    for (const auto& [isGiven, option] : needs)
        if (isGiven)
            return Error(Code::BadArgument,
                         fmt::format("{}: for one volume only; take a part of the city (svt city extract)", option));
    return city::checkCityScene(scene);
}

// Draws pictures of a city; chooses and reads the tiles for each picture.
Result<int> runCityRender(const RenderArguments& arguments, Series& series, const illustrate::Scene& moving) {
    SVT_DO(checkForCity(arguments, moving));
    TerminalProgress progress;
    SVT_TRY(opened, city::City::open(arguments.input));
    SVT_TRY(painter,
            city::CityPainter::make(std::move(*opened), {tileMemory(), arguments.build.threads, progress.get()}));
    const auto draw = [&](const illustrate::Scene& scene, int number) -> Result<void> {
        SVT_TRY(painting, painter->paint(scene, castOptions(arguments, progress)));
        if (number == 0) {
            noteNames(painting->names);
            noteSun(scene, painter->frame());
            for (const std::string& message : painter->nothing()) note(message);
            if (const double pixels = painter->chosen().pixels; pixels > 1)
                note(fmt::format("memory: voxels are up to {:.1f} pixels wide; grant more --memory for finer ones",
                                 pixels));
        }
        if (isEmpty(painting->frame)) note("nothing is visible");
        return writePicture(arguments, series, painting->frame, number);
    };
    return drawSeries(arguments, series, moving, painter->frame(), progress, draw);
}

// Draws pictures of one volume, and of others that replace its parts.
Result<int> runVolumeRender(const RenderArguments& arguments, Series& series, const illustrate::Scene& moving) {
    Diagnostics diagnostics;
    TerminalProgress progress;
    const pipeline::BuildOptions build = withVectors(arguments, moving);
    auto volume = loadVolume(arguments.input, build, progress.get(), diagnostics);
    if (!volume) printDiagnostics(diagnostics, arguments.verbose);
    if (!volume) return volume.error();
    const auto details = addInputs(arguments, build, progress.get(), diagnostics, *volume);
    printDiagnostics(diagnostics, arguments.verbose);
    if (!details) return details.error();

    illustrate::ScenePainter painter(*volume, arguments.build.threads);
    // An answer, not an error, as for `svt query`: the query is valid, but selects no feature.
    std::vector<std::string> nothing;
    painter.tolerateNothing(&nothing);
    painter.reportTo(progress.get());
    painter.drawFacesBy(illustrate::makeFaces);
    for (const volume::SemanticVolume& detail : *details) painter.addDetail(detail);
    std::optional<fields::Field> field;
    if (moving.field) {
        SVT_TRY(read, readFieldOf(arguments.input, moving.field->name));
        field = std::move(*read);
        SVT_DO(painter.showField(&*field));
        const Vec3d spacing = volume->grid.spacing();
        if (field->head.kind == fields::FieldKind::Grid && !moving.field->per)
            note(fmt::format("surfaces have the values of the nearest voxels, which are up to {:.3g} m away",
                             0.5 * std::max({spacing.x, spacing.y, spacing.z})));
    }
    GlDrawer gl(arguments.build.threads);
    const illustrate::ScenePainter::Draw drawByGl = [&](auto volumes, const auto& spec) {
        return gl.draw(volumes, spec);
    };
    int empty = 0;
    const auto draw = [&](illustrate::Scene& scene, int number) -> Result<void> {
        if (arguments.gl) takeFinest(scene);
        SVT_TRY(painting,
                arguments.gl ? painter.paint(scene, drawByGl) : painter.paint(scene, castOptions(arguments, progress)));
        empty += isEmpty(painting->frame);
        if (number == 0) {
            noteNames(painting->names);
            if (const std::string text = painting->surfaces.note(); !text.empty()) note(text);
            noteSun(scene, *volume);
            noteMovedPlanes(scene, *volume);
            reportStoreys(scene, *volume, arguments.input);
            noteCutaway(arguments.scene.cutaway, *volume, painting->frame);
        }
        return writePicture(arguments, series, painting->frame, number);
    };
    SVT_TRY(code, drawSeries(arguments, series, moving, *volume, progress, draw));
    for (const std::string& message : nothing) note(message);
    if (empty != 0)
        note(fmt::format("nothing is visible{}: all is hidden, cut away, fully transparent or outside of the view",
                         series.count == 1 ? "" : fmt::format(" in {} of {} pictures", empty, series.count)));
    return code;
}

Result<int> runRender(const RenderArguments& arguments) {
    // Validate the request before any long work.
    SVT_TRY(moving, arguments.scene.toScene(isFilm(arguments.output) ? std::nullopt : std::optional(arguments.frames)));
    SVT_TRY(series, seriesOf(arguments, *moving));
    SVT_DO(checkForFaces(arguments, *moving));
    SVT_DO(checkForField(arguments, *moving));
    if (isCity(arguments.input)) return runCityRender(arguments, *series, *moving);
    if (isLineDrawing(arguments.output)) return runLineDrawing(arguments, *series, *moving);
    return runVolumeRender(arguments, *series, *moving);
}

Members<RenderArguments> membersOf(const RenderArguments*) noexcept {
    using All = RenderArguments;
    static constexpr Member<All> kMembers[] = {
        modelInput<&All::input>(),
        member<&All::output>("-o,--output",
                             "the picture to write: .png; as lines .svg or .pdf; or a film: .webm, .mp4, .gif or .webp",
                             {.value = "P.png",
                              .isRequired = true,
                              .file = FileUse::Output,
                              .formats = "png|svg|pdf|webm|mp4|gif|webp",
                              .mayLackEnding = true,
                              .numberedBy = "--frames"}),
        part<&All::scene>("scene", "View|Cut|--lens|--highlight|--cutaway|--context|--context-level|--inset"),
        member<&All::with>("--with",
                           "another volume of the model, such as a flat at a finer spacing; its features replace those "
                           "of the first volume",
                           {.value = "F.svt", .group = "Illustrate", .file = FileUse::OtherInput}),
        part<&All::scene>("scene", "--cells"),
        member<&All::owners>("--owners", "ownership, for --color-by owner: a table of feature and owner",
                             {.value = "T.csv", .group = "Illustrate", .file = FileUse::OtherInput}),
        part<&All::scene>("scene", "Lines|Style|Scene"),
        member<&All::sceneOutput>(
            "--write-scene", "also write the scene of these options",
            {.value = "S.scene.json", .group = "Scene", .file = FileUse::Output, .formats = "scene"}),
        member<&All::frames>("--frames",
                             "number of pictures P_0000.png, ... of a section that moves, or of the scene's motion",
                             {.least = 1, .most = 10000, .group = "Motion"}),
        member<&All::gl>("--gl", "draw the finest level with OpenGL ES 3.0; needs a driver, but no display",
                         {.group = "Output", .excludes = "--level"}),
        member<&All::labelOutput>(
            "--labels", "also write the scalar of each pixel, 16-bit gray",
            {.value = "L.png", .group = "Output", .file = FileUse::Output, .formats = "png", .numberedBy = "--frames"}),
        member<&All::depthOutput>(
            "--depth", "also write the depth of each pixel in millimetres, 16-bit gray",
            {.value = "D.png", .group = "Output", .file = FileUse::Output, .formats = "png", .numberedBy = "--frames"}),
        quietOption<All>(),
        verboseOption<&All::verbose>(),
        part<&All::build>("build", "Style"),
        part<&All::build>("build", "Grid|Model|Voxels"),
        part<&All::scene>("scene", frontend::kSceneMembers),
    };
    return kMembers;
}

}  // namespace

extern const CommandText kRenderCommand = commandOf<RenderArguments, runRender>(
    "render", "Draw pictures of a volume or model: PNG, films, lines as SVG and PDF");

}  // namespace svt::cli
