#pragma once
/// \file
/// The existing squares of a quadtree, and the files that list them: subtrees of 3D Tiles 1.1 (implicit tiling), each
/// with several levels.

#include <svt/core/vec.hpp>
#include <svt/writers/city_tileset.hpp>

#include <nlohmann/json.hpp>

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace svt::writers {

/// Squares with content, and all squares that contain them.
class QuadtreeIndex {
public:
    static constexpr int kSubtreeLevels = 5;

    struct Square {
        Box3d box;         ///< box of its content and of all squares below it
        double error = 0;  ///< error of its content, or the largest below it
        bool hasContent = false;
    };

    void add(QuadtreeNode node, const Box3d& box, double error);
    [[nodiscard]] bool isEmpty() const noexcept { return squares_.empty(); }
    [[nodiscard]] const Square& root() const { return squares_.begin()->second; }

    /// Extends boxes and errors of squares by those below them. Must be called once, after the last add().
    void close();
    /// Passes all subtrees to the caller: the square at the top, and the file.
    [[nodiscard]] Result<void> forEachSubtree(
        const std::function<Result<void>(QuadtreeNode, const std::string&)>& take) const;

private:
    // Level, then Morton number.
    using Key = std::pair<int, std::uint64_t>;
    [[nodiscard]] std::string subtreeAt(int level, std::uint64_t morton) const;

    std::map<Key, Square> squares_;
};

/// Bit n of x is bit 2n, of y bit 2n + 1: the order of squares in subtrees.
[[nodiscard]] std::uint64_t mortonOf(QuadtreeNode node) noexcept;

/// A `.subtree` of its JSON and its only buffer, each padded to a multiple of 8 bytes. Sets `buffers` of the JSON.
[[nodiscard]] std::string makeSubtreeFile(nlohmann::ordered_json json, std::string binary);

}  // namespace svt::writers
