#include <svt/analyze/solid_overlaps.hpp>

#include <svt/model/phases.hpp>

#include <algorithm>
#include <string_view>
#include <tuple>

namespace svt::analyze {

bool isPane(const volume::Label& label) { return model::isPhase(label.className) && label.name == model::kGlass; }

// Panes are finer than the surfaces of their windows, which lie on them.
model::ClassRank rankOf(const volume::Label& label) {
    return isPane(label) ? model::ClassRank::Furniture : model::classRank(label.className);
}

std::vector<std::uint32_t> labelsByPriority(const volume::LabelTable& table) {
    using Key = std::tuple<model::ClassRank, bool, double, std::string_view, std::uint32_t>;
    std::vector<Key> keys;
    keys.reserve(table.labels.size());
    for (std::uint32_t l = 0; l < table.labels.size(); ++l) {
        const volume::Label& label = table.labels[l];
        const bool isSolid = volume::hasClosedMesh(label.filling);
        const double size = isSolid && label.volume > 0 ? label.volume : 0;
        keys.emplace_back(rankOf(label), !isSolid, size, label.id, l);
    }
    std::sort(keys.begin(), keys.end());
    std::vector<std::uint32_t> order;
    for (const Key& key : keys) order.push_back(std::get<std::uint32_t>(key));
    return order;
}

}  // namespace svt::analyze
