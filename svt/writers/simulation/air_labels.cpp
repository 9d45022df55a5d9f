#include <svt/writers/simulation/air_labels.hpp>

#include <svt/analyze/space_boundaries.hpp>
#include <svt/model/classes.hpp>

namespace svt::writers {

std::vector<std::uint32_t> airOfLabels(const volume::LabelTable& labels) {
    std::vector<std::uint32_t> spaces = analyze::spacesOfLabels(labels);
    for (std::size_t l = 0; l < spaces.size(); ++l) {
        const std::string& className = labels.labels[l].className;
        if (!model::isSpace(className) && !model::isBoundarySurface(className)) spaces[l] = volume::kNoLabel;
    }
    return spaces;
}

}  // namespace svt::writers
