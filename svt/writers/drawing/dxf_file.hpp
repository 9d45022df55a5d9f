#pragma once
/// \file
/// The parts of a DXF around its entities: header, tables of layers, line types and styles, and blocks.

#include <svt/writers/drawing/dxf_text.hpp>

#include <deque>
#include <span>
#include <string>
#include <vector>

namespace svt::writers {

struct DxfLineType {
    const char *name, *words;
    std::vector<double> dashes;  ///< metres; gaps are below zero
};

/// The initial view in a program.
struct DxfView {
    Vec3d low, high, center;
    double width = 0, height = 0;  ///< metres
};

/// Entities with a name, such as a door. An anonymous block draws a dimension.
struct DxfBlock {
    std::string record, begin, end;  ///< handles
    std::string name, entities{};
    bool isAnonymous = false;
};

class DxfFile {
public:
    static constexpr const char* kModelSpace = "1A";  ///< handle of the block of all entities outside of other blocks

    /// Handles below 0x100 are reserved for the fixed parts.
    [[nodiscard]] std::string newHandle() { return fmt::format("{:X}", nextHandle_++); }
    [[nodiscard]] DxfBlock newBlock(std::string name, bool isAnonymous);
    /// The name of a layer, which is added to the table if it is new.
    const std::string& layer(const std::string& name, int color, const char* lineType = "Continuous", int width = -3);
    void add(DxfBlock block) { blocks_.push_back(std::move(block)); }
    void add(DxfLineType type) { lineTypes_.push_back(std::move(type)); }
    [[nodiscard]] std::size_t blockCount() const noexcept { return blocks_.size(); }

    /// The file, once all layers, line types and blocks are known.
    /// \param comments  lines at the beginning
    [[nodiscard]] std::string write(std::span<const std::string> comments, const DxfView& view,
                                    std::string_view entities);

private:
    struct Layer {
        std::string name;
        const char* lineType;
        int color, width;
    };
    void header(std::span<const std::string> comments, const DxfView& view);
    void table(const char* name, const char* handle, int count);
    void record(const char* type, std::string_view handle, const char* owner, const char* subclass,
                std::string_view name);
    void tables(const DxfView& view);
    void viewportTable(const DxfView& view);
    void lineTypeTable();
    void layerTable();
    void textStyleTable();
    void blockRecordTable();
    void block(const DxfBlock& block);

    std::deque<Layer> layers_;  // in order of first use
    std::vector<DxfLineType> lineTypes_;
    std::vector<DxfBlock> blocks_;
    unsigned nextHandle_ = 0x100;
    DxfText out_;
};

}  // namespace svt::writers
