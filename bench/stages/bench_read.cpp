#include <bench/benches.hpp>
#include <bench/peers.hpp>
#include <svt/readers/read_model.hpp>

#include <fmt/format.h>

namespace svt::bench {
namespace {

double megabytesPerSecond(double bytes, double seconds) { return bytes / 1e6 / seconds; }

// Number of polygons, counted once per use by a geometry.
std::size_t countUses(const model::BuildingModel& model) {
    std::size_t uses = 0;
    for (const model::Feature& feature : model.features)
        for (const model::Geometry& geometry : feature.geometries) {
            uses += geometry.surfaces.size();
            for (const model::Solid& solid : geometry.solids) {
                uses += solid.exterior.size();
                for (const auto& interior : solid.interiors) uses += interior.size();
            }
        }
    return uses;
}

Result<Row> readRow(const Input& input, const BenchOptions& options) {
    tell(fmt::format("read {}", input.file.filename().string()));
    const double bytes = double(std::filesystem::file_size(input.file));
    SVT_TRY(model, readers::readModel(input.file));
    std::vector<Contestant> contestants;
    for (const int threads : {0, 1}) {
        readers::ReadOptions readOptions;
        readOptions.threads = threads;
        contestants.push_back({threads == 0 ? "SVT" : "SVT, one thread", [&input, readOptions] {
                                   static_cast<void>(readers::readModel(input.file, readOptions).hasValue());
                               }});
    }
    Row row;
    row.stage = "read";
    row.input = input.name;
    row.size = fmt::format("{:.1f} MB", bytes / 1e6);
    const Peer<ReaderPeer> libcitygml = makeLibcitygml();
    ReadCounts counts;
    if (libcitygml.peer == nullptr) {
        row.missing.push_back(libcitygml.missing);
    } else {
        counts = libcitygml.peer->read(input.file);
        if (counts.polygons == 0)
            row.missing.push_back(fmt::format("libcitygml refuses {} or finds nothing in it", input.name));
        else
            contestants.push_back(
                {libcitygml.peer->name(), [&] { static_cast<void>(libcitygml.peer->read(input.file)); }});
    }
    const auto measured = measureInTurns(contestants, options.measure);
    row.ours = measured[0];
    row.extra["mb_per_s"] = megabytesPerSecond(bytes, measured[0].median);
    row.extra["polygons"] = countUses(*model);
    for (std::size_t m = 1; m < measured.size(); ++m) {
        Comparison comparison;
        comparison.measurement = measured[m];
        comparison.isPeer = m > 1;
        comparison.extra["mb_per_s"] = megabytesPerSecond(bytes, measured[m].median);
        if (comparison.isPeer) comparison.extra["polygons"] = counts.polygons;
        row.comparisons.push_back(std::move(comparison));
    }
    return row;
}

}  // namespace

Result<void> benchRead(const BenchOptions& options, Report& report) {
    SVT_TRY(tower, writeTowerCityGml2(options.scratch));
    std::vector<Input> inputs{*tower};
    for (const auto& [name, file] : {std::pair{"FZK-Haus, CityGML 3.0", "fzk_haus_citygml3.gml"},
                                     std::pair{"FZK-Haus, CityJSON 2.0", "fzk_haus.city.json"},
                                     std::pair{"SIG3D house, CityGML 2.0", "sig3d_lod4_citygml2.gml"},
                                     std::pair{"Berlin, CityGML 1.0", "berlin_lod2_citygml1.gml"}})
        if (std::filesystem::exists(dataDir() / file)) inputs.push_back({name, dataDir() / file});
    for (const Input& input : inputs) {
        SVT_TRY(row, readRow(input, options));
        report.rows.push_back(std::move(*row));
    }
    return {};
}

}  // namespace svt::bench
