#include <bench/peers.hpp>

#include <vtkCellArray.h>
#include <vtkImageData.h>
#include <vtkImageStencilData.h>
#include <vtkImageStencilToImage.h>
#include <vtkNew.h>
#include <vtkObject.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataToImageStencil.h>
#include <vtkSmartPointer.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace svt::bench {
namespace {

// vtkPolyDataToImageStencil, each object in the extent of its own bounds. The stencil is a list of runs per row,
// computed by VTK with one thread. Tolerance 0: a voxel is inside if its centre is, which is our rule too, and VTK's
// faster path.
class VtkStencils final : public SolidPeer {
public:
    std::string name() const override { return "VTK stencils"; }

    void load(const mesh::MeshSet& meshes, const volume::Grid& grid) override {
        vtkObject::GlobalWarningDisplayOff();
        grid_ = grid;
        localOrigin_ = grid.origin() - meshes.origin;
        objects_.clear();
        for (const mesh::ObjectMesh& mesh : meshes.objects) objects_.push_back(toPolyData(mesh));
        extents_.clear();
        for (const mesh::ObjectMesh& mesh : meshes.objects) extents_.push_back(extentOf(mesh.bounds));
    }

    void run(SolidStep step, std::span<const std::uint32_t> order, std::span<const std::uint16_t> scalars,
             DenseLabels* labels) override {
        if (step == SolidStep::Labels) {
            const Vec3i n = grid_.dimension();
            labels->dimension = n;
            labels->scalars.assign(static_cast<std::size_t>(grid_.sampleCount()), 0);
        }
        for (const std::uint32_t o : order) {
            const std::array<int, 6>& extent = extents_[o];
            if (extent[0] > extent[1] || extent[2] > extent[3] || extent[4] > extent[5]) continue;
            vtkNew<vtkPolyDataToImageStencil> stencil;
            stencil->SetInputData(objects_[o]);
            stencil->SetTolerance(0);
            stencil->SetOutputOrigin(localOrigin_.x, localOrigin_.y, localOrigin_.z);
            stencil->SetOutputSpacing(grid_.spacing().x, grid_.spacing().y, grid_.spacing().z);
            stencil->SetOutputWholeExtent(extent[0], extent[1], extent[2], extent[3], extent[4], extent[5]);
            if (step == SolidStep::Mask) {
                vtkNew<vtkImageStencilToImage> image;
                image->SetInputConnection(stencil->GetOutputPort());
                image->SetOutputScalarTypeToUnsignedChar();
                image->Update();
                continue;
            }
            stencil->Update();
            if (step == SolidStep::Labels) paint(*stencil->GetOutput(), extent, scalars[o], *labels);
        }
    }

private:
    static vtkSmartPointer<vtkPolyData> toPolyData(const mesh::ObjectMesh& mesh) {
        vtkNew<vtkPoints> points;
        points->SetDataTypeToDouble();
        for (const Vec3d& v : mesh.vertices) points->InsertNextPoint(v.x, v.y, v.z);
        vtkNew<vtkCellArray> triangles;
        for (const mesh::Triangle& triangle : mesh.triangles)
            triangles->InsertNextCell({static_cast<vtkIdType>(triangle.corners[0]),
                                       static_cast<vtkIdType>(triangle.corners[1]),
                                       static_cast<vtkIdType>(triangle.corners[2])});
        auto data = vtkSmartPointer<vtkPolyData>::New();
        data->SetPoints(points);
        data->SetPolys(triangles);
        return data;
    }

    // The samples inside `bounds` (local space), clipped to the grid; a sample on them up to rounding is inside.
    std::array<int, 6> extentOf(const Box3d& bounds) const {
        const Vec3d spacing = grid_.spacing();
        const Vec3i n = grid_.dimension();
        constexpr double kRounding = 1e-6;  // voxel
        const auto range = [](double least, double most, double origin, double step, int count) {
            return std::array<int, 2>{
                std::max(0, static_cast<int>(std::ceil((least - origin) / step - kRounding))),
                std::min(count - 1, static_cast<int>(std::floor((most - origin) / step + kRounding)))};
        };
        const auto x = range(bounds.min.x, bounds.max.x, localOrigin_.x, spacing.x, n.x);
        const auto y = range(bounds.min.y, bounds.max.y, localOrigin_.y, spacing.y, n.y);
        const auto z = range(bounds.min.z, bounds.max.z, localOrigin_.z, spacing.z, n.z);
        return {x[0], x[1], y[0], y[1], z[0], z[1]};
    }

    // The fastest way from a stencil to labels: directly from its runs, without an intermediate image.
    static void paint(vtkImageStencilData& stencil, const std::array<int, 6>& extent, std::uint16_t scalar,
                      DenseLabels& labels) {
        const std::size_t nx = static_cast<std::size_t>(labels.dimension.x),
                          ny = static_cast<std::size_t>(labels.dimension.y);
        for (int k = extent[4]; k <= extent[5]; ++k)
            for (int j = extent[2]; j <= extent[3]; ++j) {
                std::uint16_t* row =
                    labels.scalars.data() + nx * (static_cast<std::size_t>(j) + ny * static_cast<std::size_t>(k));
                int first = 0, last = 0, iterator = 0;
                while (stencil.GetNextExtent(first, last, extent[0], extent[1], j, k, iterator) != 0)
                    std::fill(row + first, row + last + 1, scalar);
            }
    }

    volume::Grid grid_;
    Vec3d localOrigin_{};
    std::vector<vtkSmartPointer<vtkPolyData>> objects_;
    std::vector<std::array<int, 6>> extents_;
};

}  // namespace

Peer<SolidPeer> makeVtkStencils() { return {std::make_unique<VtkStencils>(), {}}; }

}  // namespace svt::bench
