#include <svt/city/city_levels.hpp>
#include <svt/city/city_painter.hpp>

#include <svt/illustrate/details.hpp>

#include <map>
#include <optional>
#include <utility>

namespace svt::city {
namespace {

using Mixture = illustrate::ScenePainter::StyleMixture;
using Shares = std::vector<std::pair<std::string, int>>;  // of coverageOf()

// Coverage of the labels of coarse parts, by the id of the label.
std::map<std::string, Shares> coverages(const City& city, const std::vector<volume::SemanticVolume>& parts) {
    std::map<std::string, Shares> coverage;
    const double finest = spacingOf(kFirstClassDetail + 1, city.spacing()).x;
    for (const volume::SemanticVolume& part : parts) {
        if (part.grid.spacing().x < finest) continue;
        for (const volume::Label& label : part.labels.labels)
            if (auto shares = coverageOf(label); label.count > 0 && !shares.empty())
                coverage[label.id] = std::move(shares);
    }
    return coverage;
}

// Nothing where city.json does not list a class: the label keeps a style of its own.
std::optional<Mixture> mixtureOf(volume::Scalar scalar, const Shares& shares,
                                 const std::map<std::string, volume::Scalar>& scalarOf) {
    Mixture mixture;
    mixture.scalar = scalar;
    int covered = 0;
    for (const auto& [name, eighths] : shares) {
        const auto known = scalarOf.find(name);
        if (known == scalarOf.end()) return std::nullopt;
        mixture.parts.emplace_back(known->second, float(eighths));
        covered += eighths;
    }
    mixture.empty = float(kCoverageSteps - covered);
    return mixture;
}

}  // namespace

void JoinedTiles::addTo(illustrate::ScenePainter& painter) const {
    painter.mixStyles(mixtures);
    for (const volume::SemanticVolume& part : parts) painter.addPart(part, hasNear && &part == &parts.back());
}

Result<JoinedTiles> joinTiles(const City& city, const volume::SemanticVolume& frame, const ChosenTiles& chosen,
                              std::vector<volume::SemanticVolume> parts) {
    JoinedTiles joined{frame, std::move(parts), chosen.near > 0, {}};
    joined.frame.labels = classTable(city);
    const auto coverage = coverages(city, joined.parts);  // by the ids that the labels have before they are joined
    SVT_DO(illustrate::joinLabels(joined.frame, joined.parts));
    std::map<std::string, volume::Scalar> scalarOf;
    for (const volume::Label& label : joined.frame.labels.labels)
        if (label.count > 0) scalarOf.emplace(label.id, label.first);
    for (const auto& [id, shares] : coverage)
        if (auto mixture = mixtureOf(scalarOf.at(id), shares, scalarOf)) joined.mixtures.push_back(std::move(*mixture));
    return joined;
}

}  // namespace svt::city
