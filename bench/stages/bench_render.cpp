#include <bench/benches.hpp>
#include <bench/compare.hpp>
#include <bench/drawable.hpp>
#include <bench/machine.hpp>
#include <bench/peers.hpp>
#include <svt/image/color.hpp>
#include <svt/image/png.hpp>
#include <svt/pipeline/vector_parts.hpp>
#include <svt/render/ray_caster.hpp>
#include <svt/volume/dense.hpp>

#include <fmt/format.h>

#include <utility>

namespace svt::bench {
namespace {

enum class Look : std::uint8_t { Opaque, Translucent };

void cast(const Drawable& drawable, const render::FrameSpec& spec) {
    static_cast<void>(render::castRays(drawable.bricks, drawable.grid, spec).hasValue());
}

// Data shared by all renderers of one frame.
struct Frame {
    const Drawable& drawable;
    Look look;
    std::vector<render::Style> styles;
    render::FrameSpec spec;
};

Result<Frame> makeFrame(const Workload& workload, const Drawable& drawable, Look look) {
    const bool isOpaque = look == Look::Opaque;
    std::vector<render::Style> styles =
        isOpaque ? opaqueStyles(workload.labels.table) : translucentStyles(workload.labels.table);
    auto spec =
        isOpaque ? makeFrameSpec(drawable.grid, styles, 1280, 720) : makeFrameSpec(drawable.grid, styles, 1920, 1080);
    if (!spec) return spec.error();
    return Frame{drawable, look, std::move(styles), std::move(*spec)};
}

// Opaque colors are not blended, so the peers get them unchanged, and labels can be read back. Ours blends translucent
// ones in linear light, so the peers get linear values, and their pictures hold linear values.
std::vector<render::Style> stylesForPeers(const Frame& frame) {
    std::vector<render::Style> styles = frame.styles;
    if (frame.look == Look::Translucent)
        for (render::Style& style : styles) style.color = image::linearFromSrgb(style.color);
    return styles;
}

// Our unlit picture of the frame, in the color values of the peers' pictures, and its labels.
struct OurPicture {
    image::Image<image::Rgba8> color;
    image::Image<volume::Scalar> label;
};

Result<OurPicture> pictureWithoutLight(const Frame& frame) {
    SVT_TRY(cast, render::castRays(frame.drawable.bricks, frame.drawable.grid, dark(frame.spec)));
    image::Image<image::Rgba8> color =
        frame.look == Look::Opaque ? flatPicture(cast->label, frame.styles) : linearPicture(cast->color, 2);
    return OurPicture{std::move(color), std::move(cast->label)};
}

Json colorsJson(const ColorComparison& comparison) {
    return {{"pixels", comparison.pixels},
            {"mean", comparison.mean},
            {"largest", comparison.largest},
            {"over_2_percent", 100 * comparison.over2},
            {"over_8_percent", 100 * comparison.over8}};
}

class RenderBench {
public:
    RenderBench(const Workload& workload, const BenchOptions& options, Report& report)
        : workload_(workload), options_(options), report_(report) {}

    Result<void> run() {
        SVT_TRY(drawable, makeDrawable(workload_, gridSize(options_.isQuick)));
        SVT_DO(frames(*drawable, nullptr));
        SVT_DO(edits(*drawable));
        SVT_DO(illustrations(*drawable));
        SVT_DO(wireframes(*drawable));
        if (options_.isQuick || (workload_.name != kHouse && workload_.name != kTurnedHouse)) return {};
        const auto larger = makeDrawable(workload_, kLargeGrid);
        return larger ? frames(*larger, &*drawable) : larger.error();
    }

private:
    Row newRow(const char* stage, std::string size) const {
        Row row;
        row.stage = stage;
        row.input = workload_.name;
        row.size = std::move(size);
        tell(fmt::format("{} {} {}", row.stage, row.input, row.size));
        return row;
    }

    // Both looks compared with all peers; if there is a smaller grid, compared with only the paper's method and our
    // frame of the smaller grid.
    Result<void> frames(const Drawable& drawable, const Drawable* smaller) {
        DenseLabels dense;
        std::string noDense;
        const std::uint64_t denseBytes = 2 * drawable.grid.sampleCount(), free = availableMemory();
        if (free != 0 && free < denseBytes + denseBytes / 2) {
            noDense = fmt::format("{} of dense labels do not fit into the {} that are free", bytesText(denseBytes),
                                  bytesText(free));
        } else {
            SVT_TRY(scalars, volume::toDense<std::uint16_t>(drawable.columns));
            dense = {drawable.grid.dimension(), std::move(*scalars)};
        }
        for (const Look look : {Look::Opaque, Look::Translucent}) {
            SVT_TRY(frame, makeFrame(workload_, drawable, look));
            Row row = newRow(look == Look::Opaque ? "opaque frame" : "translucent frame",
                             fmt::format("{}, {} x {} pixels", sizeText(drawable.grid.dimension()), frame->spec.width,
                                         frame->spec.height));
            if (!noDense.empty()) row.missing.push_back(noDense);
            SVT_DO(besidePeers(*frame, dense, smaller, row));
            report_.rows.push_back(std::move(row));
        }
        return {};
    }

    static std::vector<std::unique_ptr<VolumePeer>> makePeers(const DenseLabels& dense, bool withVtk, Row& row) {
        std::vector<std::unique_ptr<VolumePeer>> peers;
        if (dense.scalars.empty()) return peers;
        peers.push_back(makeDenseSteps().peer);
        if (!withVtk) return peers;
        for (const VtkMapper mapper : {VtkMapper::FixedPoint, VtkMapper::Gpu}) {
            Peer<VolumePeer> vtk = makeVtkVolume(mapper);
            if (vtk.peer != nullptr)
                peers.push_back(std::move(vtk.peer));
            else if (mapper == VtkMapper::FixedPoint)
                row.missing.push_back(vtk.missing);
        }
        return peers;
    }

    Result<void> besidePeers(const Frame& frame, const DenseLabels& dense, const Drawable* smaller, Row& row) {
        const std::vector<render::Style> styles = stylesForPeers(frame);
        const render::FrameSpec flat = unlit(frame.spec);
        SVT_TRY(ours, pictureWithoutLight(frame));
        std::vector<Contestant> contestants{{"SVT, lit", [&] { cast(frame.drawable, frame.spec); }},
                                            {"SVT, unlit", [&] { cast(frame.drawable, flat); }}};
        const auto peers = makePeers(dense, smaller == nullptr, row);
        std::vector<bool> isReady(peers.size());
        for (std::size_t p = 0; p < peers.size(); ++p)
            contestants.push_back({peers[p]->name(), [&, p] {
                                       VolumePeer& peer = *peers[p];
                                       // The warm-up creates the peer's copy of the volume.
                                       if (!isReady[p]) {
                                           peer.setVolume(dense, frame.drawable.grid);
                                           peer.setStyles(styles);
                                           peer.setCamera(frame.spec.camera, frame.spec.width, frame.spec.height);
                                           isReady[p] = true;
                                       }
                                       peer.draw();
                                   }});
        render::FrameSpec smallerSpec;
        if (smaller != nullptr) {
            SVT_TRY(smallerFrame, makeFrame(workload_, *smaller, frame.look));
            smallerSpec = std::move(smallerFrame->spec);
            contestants.push_back(
                {"SVT at " + sizeText(smaller->grid.dimension()), [&] { cast(*smaller, smallerSpec); }});
        }
        auto measured = measureInTurns(contestants, options_.measure);
        for (std::size_t m = 0; m < 2; ++m) measured[m].peakBytes += frame.drawable.bricks.sizeBytes();
        row.ours = measured[0];
        row.resultBytes = frame.drawable.bricks.sizeBytes();
        row.comparisons.push_back({measured[1], "ambient light alone", Json::object(), false});
        writePicture(row, "svt", ours->color);
        for (std::size_t p = 0; p < peers.size(); ++p) {
            if (peers[p]->usesLabels()) measured[p + 2].peakBytes += 2 * dense.scalars.size();
            row.comparisons.push_back({measured[p + 2], sampling(peers[p]->samplesPerVoxel()),
                                       picturesJson(frame, *ours, *peers[p], row), true});
        }
        if (smaller != nullptr) {
            Measurement& last = measured.back();
            last.peakBytes += smaller->bricks.sizeBytes();
            row.extra["times_smaller_grid"] = measured[0].median / last.median;
            row.comparisons.push_back({last, "the same frame", Json::object(), false});
        }
        return {};
    }

    static std::string sampling(int samples) {
        return samples == 1 ? "one sample a voxel" : fmt::format("{} samples a voxel", samples);
    }

    // Agreement of the peer's picture with ours: as timed, and for surfaces also at a fine step, which shows how much
    // is due to the step.
    Json picturesJson(const Frame& frame, const OurPicture& ours, VolumePeer& peer, const Row& row) const {
        constexpr int kFineSamples = 8;
        Json json = Json::object();
        std::vector<int> counts{peer.samplesPerVoxel()};
        if (frame.look == Look::Opaque) counts.push_back(kFineSamples);
        for (const int samples : counts) {
            if (samples != peer.samplesPerVoxel()) {
                peer.setSamplesPerVoxel(samples);
                peer.draw();
            }
            const auto theirs = peer.picture();
            Json entry{{"samples_per_voxel", samples}, {"colors", colorsJson(compareColors(ours.color, theirs))}};
            if (frame.look == Look::Opaque) entry["same_label_percent"] = 100 * agreeingShare(ours.label, theirs);
            json["pictures"].push_back(std::move(entry));
            writePicture(row, fmt::format("{} {}", peer.name(), samples), theirs);
        }
        return json;
    }

    void writePicture(const Row& row, const std::string& who, const image::Image<image::Rgba8>& picture) const {
        if (options_.pictures.empty()) return;
        const auto file = options_.pictures / (slug(row.id() + ' ' + who) + ".png");
        if (!image::writePng(file, picture)) tell(fmt::format("cannot write {}", file.string()));
    }

    // A frame with a section plane; the same with the plane at another position each time, and with another style each
    // time.
    Result<void> edits(const Drawable& drawable) {
        Row row = newRow("section frame", fmt::format("{}, 1280 x 720 pixels", sizeText(drawable.grid.dimension())));
        SVT_TRY(spec, makeFrameSpec(drawable.grid, opaqueStyles(workload_.labels.table), 1280, 720));
        const double height = drawable.grid.spacing().z * (drawable.grid.dimension().z - 1);
        const auto planeAt = [&](double share) {
            return render::ClipRegion::plane({0, 0, 1}, drawable.grid.origin() + Vec3d{0, 0, height * share});
        };
        spec->passes[0].clips = {planeAt(0.5)};
        render::FrameSpec moved = *spec, edited = *spec;
        int turn = 0;
        const std::vector<Contestant> contestants{
            {"SVT", [&] { cast(drawable, *spec); }},
            {"SVT, plane moved before each frame",
             [&] {
                 moved.passes[0].clips = {planeAt(0.5 + 0.001 * (++turn % 8 - 4))};
                 cast(drawable, moved);
             }},
            {"SVT, a style changed before each frame", [&] {
                 std::vector<render::Style>& styles = edited.passes[0].styles;
                 float& red = styles[1 + static_cast<std::size_t>(++turn) % (styles.size() - 1)].color.x;
                 red = 1 - red;
                 cast(drawable, edited);
             }}};
        const auto measured = measureInTurns(contestants, options_.measure);
        row.ours = measured[0];
        row.comparisons.push_back({measured[1], "nothing is rebuilt", Json::object(), false});
        row.comparisons.push_back({measured[2], "nothing is rebuilt", Json::object(), false});
        report_.rows.push_back(std::move(row));
        return {};
    }

    // A lens over the solid model, and a highlight with the rest as ghost; the same with another lens position and
    // another highlighted object before each frame; and the plain frame with as many pixels.
    Result<void> illustrations(const Drawable& drawable) {
        SVT_TRY(plain, makeFrameSpec(drawable.grid, opaqueStyles(workload_.labels.table), 1280, 720));
        const Vec3d spacing = drawable.grid.spacing();
        const Vec3i dimension = drawable.grid.dimension();
        const auto pointAt = [&](double x, double y, double z) {
            return drawable.grid.origin() +
                   Vec3d{x * spacing.x * dimension.x, y * spacing.y * dimension.y, z * spacing.z * dimension.z};
        };
        const auto lensAt = [&](double share) {
            const double radius = 0.3 * spacing.x * dimension.x;
            return render::ClipRegion{{{{}, {render::RoundBody::ball(pointAt(share, 0.4, 0.5), radius)}}},
                                      render::ClipRegion::Mode::KeepOnly};
        };
        render::FrameSpec lens = *plain;
        lens.passes.push_back(lens.passes.front());
        lens.passes[1].clips = {lensAt(0.5), render::ClipRegion::plane({0, -1, 0}, pointAt(0, 0.4, 0))};
        lens.passes[1].join = render::Pass::Join::Replace;
        render::FrameSpec highlight = *plain;
        highlight.passes.push_back(highlight.passes.front());
        for (render::Style& style : highlight.passes[0].styles) style.opacity = std::min(style.opacity, 0.2f);
        const auto light = [&](render::FrameSpec& spec, std::size_t scalar) {
            for (render::Style& style : spec.passes[1].styles) style.opacity = 0;
            spec.passes[1].styles[1 + scalar % (spec.passes[1].styles.size() - 1)].opacity = 1;
        };
        light(highlight, 0);
        render::FrameSpec movedLens = lens, movedHighlight = highlight;
        int turn = 0;
        const std::vector<Contestant> contestants{{"SVT, plain frame", [&] { cast(drawable, *plain); }},
                                                  {"SVT, lens", [&] { cast(drawable, lens); }},
                                                  {"SVT, lens moved before each frame",
                                                   [&] {
                                                       movedLens.passes[1].clips[0] =
                                                           lensAt(0.5 + 0.005 * (++turn % 8 - 4));
                                                       cast(drawable, movedLens);
                                                   }},
                                                  {"SVT, highlight", [&] { cast(drawable, highlight); }},
                                                  {"SVT, another object lit before each frame", [&] {
                                                       light(movedHighlight, static_cast<std::size_t>(++turn % 4));
                                                       cast(drawable, movedHighlight);
                                                   }}};
        const auto measured = measureInTurns(contestants, options_.measure);
        const std::string size = fmt::format("{}, 1280 x 720 pixels", sizeText(dimension));
        for (const std::size_t first : {std::size_t{1}, std::size_t{3}}) {
            Row row = newRow(first == 1 ? "lens frame" : "highlight frame", size);
            row.ours = measured[first];
            row.comparisons.push_back({measured[first + 1], "nothing is rebuilt", Json::object(), false});
            row.comparisons.push_back({measured[0], "one pass, the model as it is", Json::object(), false});
            report_.rows.push_back(std::move(row));
        }
        return {};
    }

    // The feature edges of all meshes, and of rooms alone, inside the volume; rooms are 5 % air, all else is opaque.
    Result<void> wireframes(const Drawable& drawable) {
        SVT_TRY(plain, makeFrameSpec(drawable.grid, opaqueStyles(workload_.labels.table), 1280, 720));
        std::vector<render::Style>& styles = plain->passes[0].styles;
        for (std::size_t scalar = 1; scalar < styles.size(); ++scalar)
            if (styles[scalar].opacity == 0) styles[scalar].opacity = 0.05f;
        SVT_TRY(parts, pipeline::makeVectorParts(workload_.meshes, workload_.labels.labelOfObject, drawable.grid,
                                                 {.edges = true, .meshes = false}));
        const auto& labels = workload_.labels.table.labels;
        render::LineSet all, rooms;
        for (const auto& segment : parts->segments) {
            const auto end = [&](std::size_t n) { return parts->position(segment.ends[n], drawable.grid.origin()); };
            const render::Line line{end(0), end(1), labels[segment.label].first};
            all.lines.push_back(line);
            if (labels[segment.label].className == "BuildingRoom") rooms.lines.push_back(line);
        }
        render::FrameSpec withAll = *plain, withRooms = *plain;
        withAll.passes[0].lines = {all};
        withRooms.passes[0].lines = {rooms};
        const std::vector<Contestant> contestants{{"SVT, wireframe", [&] { cast(drawable, withAll); }},
                                                  {"SVT, edges of rooms", [&] { cast(drawable, withRooms); }},
                                                  {"SVT, without lines", [&] { cast(drawable, *plain); }}};
        const auto measured = measureInTurns(contestants, options_.measure);
        Row row = newRow("wireframe", fmt::format("{}, 1280 x 720 pixels", sizeText(drawable.grid.dimension())));
        row.ours = measured[0];
        row.extra["edges"] = all.lines.size();
        row.extra["room_edges"] = rooms.lines.size();
        row.comparisons.push_back({measured[1], "the edges of rooms alone", Json::object(), false});
        row.comparisons.push_back({measured[2], "the same frame", Json::object(), false});
        report_.rows.push_back(std::move(row));
        return {};
    }

    const Workload& workload_;
    const BenchOptions& options_;
    Report& report_;
};

}  // namespace

Result<void> benchRender(const Workload& workload, const BenchOptions& options, Report& report) {
    return RenderBench(workload, options, report).run();
}

}  // namespace svt::bench
