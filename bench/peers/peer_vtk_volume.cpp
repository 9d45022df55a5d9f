#include <bench/peers.hpp>

#include <vtkCamera.h>
#include <vtkColorTransferFunction.h>
#include <vtkFixedPointVolumeRayCastMapper.h>
#include <vtkGPUVolumeRayCastMapper.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkObject.h>
#include <vtkPiecewiseFunction.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkUnsignedCharArray.h>
#include <vtkVolume.h>
#include <vtkVolumeProperty.h>

#include <dlfcn.h>

#include <algorithm>

namespace svt::bench {
namespace {

// Debian's VTK draws only through X and ends the program if there is no display, so check X first. The connection
// stays open: an X server that loses its last client restarts and rejects connections at that moment.
bool hasDisplay() {
    static void* const display = []() -> void* {
        void* const library = dlopen("libX11.so.6", RTLD_LAZY);
        if (library == nullptr) return nullptr;
        const auto open = reinterpret_cast<void* (*)(const char*)>(dlsym(library, "XOpenDisplay"));
        return open != nullptr ? open(nullptr) : nullptr;
    }();
    return display != nullptr;
}

class VtkVolume final : public VolumePeer {
public:
    explicit VtkVolume(VtkMapper kind) : kind_(kind) {
        vtkObject::GlobalWarningDisplayOff();
        property_->SetInterpolationTypeToNearest();
        property_->ShadeOff();
        property_->SetScalarOpacityUnitDistance(1);  // opacities are per metre
        volume_->SetProperty(property_);
        renderer_->AddVolume(volume_);
        renderer_->SetBackground(0, 0, 0);
        window_->SetShowWindow(false);
        window_->SetOffScreenRendering(1);
        window_->SetMultiSamples(0);
        window_->AddRenderer(renderer_);
    }

    std::string name() const override {
        return kind_ == VtkMapper::FixedPoint ? "VTK fixed-point ray caster, unlit" : "VTK GPU ray caster, unlit";
    }

    void setVolume(const DenseLabels& labels, const volume::Grid& grid) override {
        gridOrigin_ = grid.origin();
        // VTK draws from the first sample to the last; a surrounding layer of background shows the outer half voxels
        // too.
        const Vec3i n = labels.dimension;
        const Vec3d spacing = grid.spacing();
        vtkNew<vtkImageData> image;
        image->SetDimensions(n.x + 2, n.y + 2, n.z + 2);
        image->SetSpacing(spacing.x, spacing.y, spacing.z);
        // The fixed-point caster takes the label at the next lower sample, not the nearest.
        const double first = kind_ == VtkMapper::FixedPoint ? -1.5 : -1;
        image->SetOrigin(first * spacing.x, first * spacing.y, first * spacing.z);
        image->AllocateScalars(VTK_UNSIGNED_SHORT, 1);
        auto* const padded = static_cast<std::uint16_t*>(image->GetScalarPointer());
        std::fill_n(padded, image->GetNumberOfPoints(), std::uint16_t{0});
        const std::uint16_t* row = labels.scalars.data();
        for (std::int32_t k = 1; k <= n.z; ++k)
            for (std::int32_t j = 1; j <= n.y; ++j, row += n.x)
                std::copy_n(row, n.x, padded + 1 + (n.x + std::ptrdiff_t{2}) * (j + (n.y + std::ptrdiff_t{2}) * k));
        voxel_ = std::min({grid.spacing().x, grid.spacing().y, grid.spacing().z});
        if (kind_ == VtkMapper::FixedPoint)
            setMapper(fixedPoint_, *image);
        else
            setMapper(gpu_, *image);
        setSamplesPerVoxel(samplesPerVoxel());
    }

    int samplesPerVoxel() const override { return 1; }
    bool usesLabels() const override { return false; }
    void setSamplesPerVoxel(int samples) override {
        const auto step = static_cast<float>(voxel_ / samples);
        fixedPoint_->SetSampleDistance(step);
        gpu_->SetSampleDistance(step);
    }

    void setStyles(std::span<const render::Style> styles) override {
        vtkNew<vtkColorTransferFunction> colors;
        vtkNew<vtkPiecewiseFunction> opacities;
        // The GPU caster samples these functions into filtered textures, so each label gets a plateau.
        for (std::size_t s = 0; s < styles.size(); ++s)
            for (const double side : {-0.4, 0.4}) {
                colors->AddRGBPoint(double(s) + side, styles[s].color.x, styles[s].color.y, styles[s].color.z);
                opacities->AddPoint(double(s) + side, styles[s].opacity);
            }
        property_->SetColor(colors);
        property_->SetScalarOpacity(opacities);
    }

    void setCamera(const render::Camera& camera, std::int32_t width, std::int32_t height) override {
        window_->SetSize(width, height);
        const Vec3d eye = camera.eye - gridOrigin_, target = camera.target - gridOrigin_;
        vtkCamera* view = renderer_->GetActiveCamera();
        view->SetPosition(eye.x, eye.y, eye.z);
        view->SetFocalPoint(target.x, target.y, target.z);
        view->SetViewUp(camera.up.x, camera.up.y, camera.up.z);
        view->SetViewAngle(camera.verticalFovDegrees);
        renderer_->ResetCameraClippingRange();
    }

    void draw() override {
        window_->Render();
        window_->WaitForCompletion();
    }

    image::Image<image::Rgba8> picture() override {
        const int* size = window_->GetSize();
        vtkNew<vtkUnsignedCharArray> pixels;
        window_->GetRGBACharPixelData(0, 0, size[0] - 1, size[1] - 1, 0, pixels);
        image::Image<image::Rgba8> image(size[0], size[1]);
        for (std::int32_t y = 0; y < size[1]; ++y)
            for (std::int32_t x = 0; x < size[0]; ++x) {
                const unsigned char* pixel = pixels->GetPointer(
                    4 * (static_cast<vtkIdType>(x) + static_cast<vtkIdType>(size[0]) * (size[1] - 1 - y)));
                image.at(x, y) = {pixel[0], pixel[1], pixel[2], 255};
            }
        return image;
    }

private:
    template <class Mapper>
    void setMapper(Mapper& mapper, vtkImageData& image) {
        mapper->SetInputData(&image);
        mapper->SetAutoAdjustSampleDistances(0);
        mapper->SetImageSampleDistance(1);
        mapper->SetBlendModeToComposite();
        volume_->SetMapper(mapper);
    }

    VtkMapper kind_;
    Vec3d gridOrigin_{};
    double voxel_ = 1;  // shortest side of the voxel, metres
    vtkNew<vtkFixedPointVolumeRayCastMapper> fixedPoint_;
    vtkNew<vtkGPUVolumeRayCastMapper> gpu_;
    vtkNew<vtkVolumeProperty> property_;
    vtkNew<vtkVolume> volume_;
    vtkNew<vtkRenderer> renderer_;
    vtkNew<vtkRenderWindow> window_;
};

}  // namespace

Peer<VolumePeer> makeVtkVolume(VtkMapper mapper) {
    if (!hasDisplay()) return {nullptr, "VTK volume mappers: no X display (run under xvfb-run)"};
    return {std::make_unique<VtkVolume>(mapper), {}};
}

}  // namespace svt::bench
