#include <svt/city/city_walk.hpp>

#include <fmt/format.h>

namespace svt::city {
namespace {

// Adds a finding for each shell of a tile that was open in the model.
void addShells(const volume::SemanticVolume& tile, TileCheck& counted, Diagnostics& findings) {
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
Result<void> checkDetail(const City& city, int detail, const Progress* progress, TileCheck& counted,
                         Diagnostics& findings) {
    SVT_TRY(entries, city.find(detail, kEverywhere));
    ProgressCounter counter(progress, "tiles", entries->size());
    for (const IndexEntry& entry : *entries) {
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
        addShells(*tile, counted, findings);
    }
    return {};
}

}  // namespace

Result<TileCheck> checkTiles(const City& city, const Progress* progress, Diagnostics& findings) {
    TileCheck counted;
    for (int detail = 0; detail <= city.topDetail(); ++detail)
        SVT_DO(checkDetail(city, detail, progress, counted, findings));
    for (const std::string& id : city.conflictIds())
        findings.add(Severity::Error, Code::IdConflict,
                     "two files have different features with this id; the city contains that of the first file",
                     {{}, 0, 0, id});
    if (city.idConflicts() > city.conflictIds().size())
        findings.add(Severity::Error, Code::IdConflict,
                     fmt::format("{} more features have the id of a feature of an earlier file, but other content",
                                 city.idConflicts() - city.conflictIds().size()));
    if (city.missingPacks() > 0)
        findings.add(Severity::Error, Code::CityIncomplete,
                     fmt::format("{} packs are missing; svt city status says how to go on", city.missingPacks()));
    if (city.skippedFeatures() > 0)
        findings.add(Severity::Warning, Code::FeatureSkipped,
                     fmt::format("{} features were left out; svt city status names them", city.skippedFeatures()));
    if (counted.damaged == 0 && counted.buildings != city.buildings())
        findings.add(Severity::Error, Code::BadCity,
                     fmt::format("the tiles have {} buildings, city.json says {}; merge the city again",
                                 counted.buildings, city.buildings()));
    return counted;
}

}  // namespace svt::city
