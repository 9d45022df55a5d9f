#pragma once
/// \file
/// Small IFC files of boxes for tests: storeys with rooms, slabs and walls, at stated heights and with a stated north.

#include <string>
#include <string_view>
#include <vector>

namespace svt::test {

/// Builds an IFC4 file in metres. All bodies are boxes in the axes of the project.
class SmallIfc {
public:
    struct Corner {
        double x = 0, y = 0, z = 0;
    };

    /// \param trueNorth   direction in the project, such as "(0.6,0.8)"; empty: none
    /// \param conversion  arguments of IfcMapConversion after its CRS, such as "0.,0.,100.,0.8,0.6,1."; empty: none
    /// \param crs         name of the CRS of the conversion
    explicit SmallIfc(std::string_view trueNorth = {}, std::string_view conversion = {}, std::string_view crs = {});

    /// Adds a storey of the building.
    /// \param height     of its placement
    /// \param elevation  its attribute, such as "3."; "$": none
    /// \return its number, for box()
    int storey(std::string_view name, double height, std::string_view elevation);

    /// Adds a product with a box as its body to a storey; spaces become parts of it, others are contained.
    /// \param type  such as "WALL", "SLAB", "SPACE"
    /// \return its number, for layers()
    int box(std::string_view type, std::string_view name, int storey, Corner low, Corner high);

    struct Layer {
        std::string_view material;
        double thickness = 0;  ///< metres
    };
    /// Gives a product layers, from its lower side along the y axis: a wall along x.
    void layers(int product, const std::vector<Layer>& layers);
    /// Gives a product a list of materials, without thickness.
    void materials(int product, const std::vector<std::string_view>& names);

    /// Adds four walls around a rectangle, 0.3 m thick, and a slab of 0.3 m below them.
    void shell(int storey, Corner low, Corner high);

    [[nodiscard]] std::string text() const;

private:
    int add(const std::string& record);
    int place(Corner origin);

    std::string records_;
    int next_ = 100;
    std::vector<int> storeys_;
    std::vector<std::string> spaces_, elements_;  // references, by storey
};

}  // namespace svt::test
