#include <apps/cli/city/city_check.hpp>

#include <apps/cli/city/city_input.hpp>
#include <apps/cli/output/messages.hpp>
#include <apps/cli/output/terminal_progress.hpp>

#include <svt/core/diagnostics.hpp>

#include <fmt/format.h>

namespace svt::cli {
namespace {

struct Counted {
    std::uint64_t tiles = 0, damaged = 0, buildings = 0, solids = 0, open = 0;
};

// The findings of the labels of a tile: what the program that built it could not close, or closed itself.
void addFindings(const volume::SemanticVolume& tile, Counted& counted, Diagnostics& findings) {
    for (const volume::Label& label : tile.labels.labels) {
        counted.solids += label.volume > 0;
        const bool isCapped = label.filling == volume::Filling::Capped;
        const bool isWound = label.filling == volume::Filling::Winding;
        if (!isCapped && !isWound) continue;
        ++counted.open;
        findings.add(Severity::Warning, isCapped ? Code::ShellCapped : Code::WindingFilled,
                     isCapped ? "open shell, closed by caps" : "open shell, filled by generalized winding number",
                     {{}, 0, 0, label.id});
    }
}

// Reads all tiles of a detail; damaged ones are findings.
Result<void> readAll(const city::City& city, int detail, const Progress* progress, Counted& counted,
                     Diagnostics& findings) {
    SVT_TRY(entries, city::allTiles(city, detail));
    ProgressCounter counter(progress, "tiles", entries->size());
    for (const city::IndexEntry& entry : *entries) {
        if (Progress::isCancelled(progress)) return Error(Code::Cancelled, "stopped between tiles");
        ++counted.tiles;
        const auto tile = city.read(entry);
        counter.add();
        if (!tile) {
            ++counted.damaged;
            findings.add(Severity::Error, tile.error().code(), tile.error().message(), tile.error().where());
            continue;
        }
        if (detail != 0) continue;
        counted.buildings += entry.buildings;
        addFindings(*tile, counted, findings);
    }
    return {};
}

}  // namespace

int checkCity(const std::filesystem::path& folder) {
    const auto city = city::City::open(folder);
    if (!city) return fail(city.error());
    Counted counted;
    Diagnostics findings;
    {
        const TerminalProgress progress;
        for (int detail = 0; detail <= city->topDetail(); ++detail)
            if (auto read = readAll(*city, detail, progress.get(), counted, findings); !read) return fail(read.error());
    }
    if (city->missingPacks() > 0)
        findings.add(Severity::Error, Code::CityIncomplete,
                     fmt::format("{} packs are missing; svt city status says how to go on", city->missingPacks()));
    if (city->skippedFeatures() > 0)
        findings.add(Severity::Warning, Code::FeatureSkipped,
                     fmt::format("{} features were left out; svt city status names them", city->skippedFeatures()));
    if (counted.damaged == 0 && counted.buildings != city->buildings())
        findings.add(Severity::Error, Code::BadCity,
                     fmt::format("the tiles have {} buildings, city.json says {}; merge the city again",
                                 counted.buildings, city->buildings()));
    fmt::print("{} tiles, of which {} are damaged; {} buildings, {} solids, of which {} had holes\n", counted.tiles,
               counted.damaged, counted.buildings, counted.solids, counted.open);
    printDiagnostics(findings, true);
    return findings.count(Severity::Warning) + findings.count(Severity::Error) != 0 ? kInvalid : kDone;
}

}  // namespace svt::cli
