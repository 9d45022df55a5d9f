#include <svt/analyze/scalar_boxes.hpp>

#include <algorithm>

namespace svt::analyze {

std::vector<SampleBox> scalarBoxes(const volume::ColumnVolume& columns, volume::Scalar scalarCount) {
    std::vector<SampleBox> boxes(scalarCount);
    std::vector<SampleBox> ofColumn;  // by distinct column of a tile: where it occurs, without k
    for (std::size_t t = 0; t < columns.tiles().size(); ++t) {
        const volume::ColumnTile& tile = columns.tiles()[t];
        const auto tileX = static_cast<std::int32_t>(t % static_cast<std::size_t>(columns.tilesX()));
        const auto tileY = static_cast<std::int32_t>(t / static_cast<std::size_t>(columns.tilesX()));
        const std::int32_t width = columns.tileWidth(tileX);
        const std::int32_t x0 = tileX * volume::ColumnVolume::kTileSize, y0 = tileY * volume::ColumnVolume::kTileSize;
        // First and last use of each distinct row.
        std::vector<std::pair<std::int32_t, std::int32_t>> rows(
            tile.rowColumns.size() / static_cast<std::size_t>(width), {volume::ColumnVolume::kTileSize, -1});
        for (std::int32_t y = 0; y < static_cast<std::int32_t>(tile.rowOf.size()); ++y) {
            auto& [first, last] = rows[tile.rowOf[static_cast<std::size_t>(y)]];
            first = std::min(first, y);
            last = std::max(last, y);
        }
        ofColumn.assign(tile.columnStart.size() - 1, {});
        for (std::size_t r = 0; r < rows.size(); ++r)
            for (std::int32_t x = 0; x < width; ++x) {
                const std::uint16_t column =
                    tile.rowColumns[r * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
                ofColumn[column].add({{x0 + x, y0 + rows[r].first, 0}, {x0 + x, y0 + rows[r].second, 0}});
            }
        for (std::uint32_t column = 0; column < ofColumn.size(); ++column) {
            std::uint32_t begin = 0;
            for (const volume::Run& run : tile.column(column)) {
                SampleBox box = ofColumn[column];
                box.min.z = static_cast<std::int32_t>(begin);
                box.max.z = static_cast<std::int32_t>(run.end) - 1;
                if (run.scalar < scalarCount) boxes[run.scalar].add(box);
                begin = run.end;
            }
        }
    }
    return boxes;
}

std::vector<SampleBox> labelBoxes(const volume::ColumnVolume& columns, const volume::LabelTable& table) {
    const std::vector<SampleBox> ofScalars = scalarBoxes(columns, table.scalarCount());
    std::vector<SampleBox> boxes(table.labels.size());
    for (std::size_t l = 0; l < boxes.size(); ++l)
        for (volume::Scalar s = table.labels[l].first; s < table.labels[l].first + table.labels[l].count; ++s)
            boxes[l].add(ofScalars[s]);
    return boxes;
}

}  // namespace svt::analyze
