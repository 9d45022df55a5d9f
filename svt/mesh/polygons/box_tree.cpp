#include <svt/mesh/polygons/box_tree.hpp>

#include <algorithm>
#include <numeric>

namespace svt::mesh {

namespace {
constexpr std::uint32_t kBoxesPerLeaf = 4;
}

BoxTree::BoxTree(std::vector<Box3d> boxes) : boxes_(std::move(boxes)), order_(boxes_.size()) {
    std::iota(order_.begin(), order_.end(), 0u);
    nodes_.reserve(boxes_.size());
    if (!boxes_.empty()) build(0, static_cast<std::uint32_t>(boxes_.size()));
}

std::uint32_t BoxTree::build(std::uint32_t begin, std::uint32_t end) {
    const auto index = static_cast<std::uint32_t>(nodes_.size());
    nodes_.emplace_back();
    Box3d box, centers;
    for (std::uint32_t i = begin; i < end; ++i) {
        box.add(boxes_[order_[i]]);
        centers.add(boxes_[order_[i]].center());
    }
    nodes_[index].box = box;
    nodes_[index].begin = begin;
    nodes_[index].end = end;
    if (end - begin <= kBoxesPerLeaf) return index;
    const Vec3d size = centers.size();
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const std::uint32_t middle = begin + (end - begin) / 2;
    std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                     [&](std::uint32_t p, std::uint32_t q) {
                         const double a = boxes_[p].center()[axis], b = boxes_[q].center()[axis];
                         return a != b ? a < b : p < q;
                     });
    build(begin, middle);
    const std::uint32_t right = build(middle, end);
    nodes_[index].right = right;
    return index;
}

}  // namespace svt::mesh
