#include <svt/fields/sampler/medium.hpp>

#include <svt/analyze/selection.hpp>
#include <svt/analyze/space_boundaries.hpp>
#include <svt/fields/field_sampler.hpp>

namespace svt::fields {

using volume::Label;
using volume::Scalar;
using volume::SemanticVolume;

std::vector<char> airOf(const volume::LabelTable& labels) {
    std::vector<char> isAir(labels.scalarCount(), 0);
    isAir[0] = 1;
    const std::vector<std::uint32_t> spaces = analyze::spacesOfLabels(labels);
    for (std::uint32_t l = 0; l < spaces.size(); ++l) {
        const Label& label = labels.labels[l];
        for (Scalar s = label.first; s < label.first + label.count; ++s) isAir[s] = spaces[l] == l ? 1 : 0;
    }
    return isAir;
}

Result<std::vector<char>> mediumOf(const FieldHead& head, const SemanticVolume& volume) {
    if (head.medium == "all") return std::vector<char>(volume.labels.scalarCount(), 1);
    if (head.medium == "air" || head.medium == "solid") {
        std::vector<char> is = airOf(volume.labels);
        if (head.medium == "solid")
            for (char& one : is) one = one != 0 ? 0 : 1;
        return is;
    }
    SVT_TRY(selected, analyze::selectWithParts(volume, head.medium));
    std::vector<char> is(volume.labels.scalarCount(), 0);
    for (const std::uint32_t l : *selected) {
        const Label& label = volume.labels.labels[l];
        for (Scalar s = label.first; s < label.first + label.count; ++s) is[s] = 1;
    }
    return is;
}

Result<std::vector<Medium>> mediaOf(const FieldHead& head, const SemanticVolume& volume) {
    SVT_TRY(isMedium, mediumOf(head, volume));
    const std::vector<char> isAir = airOf(volume.labels);
    std::vector<Medium> media(isAir.size(), Medium::None);
    for (std::size_t s = 0; s < media.size(); ++s)
        if ((*isMedium)[s] != 0) media[s] = isAir[s] != 0 ? Medium::Air : Medium::Solid;
    return media;
}

}  // namespace svt::fields
