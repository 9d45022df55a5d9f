#include <svt/render_gl/painter/shared_constants.hpp>

#include <svt/render/occlusion.hpp>
#include <svt/render/pass_shapes.hpp>
#include <svt/render/picture_constants.hpp>

#include <fmt/format.h>

#include <string>
#include <type_traits>

namespace svt::render_gl {
namespace {

using volume::BrickVolume;
static_assert(kNone == BrickVolume::kNoPlane);
static_assert(kCodeTexels * 8 == sizeof(BrickVolume::BoxCoding));

// Declarations in GLSL, by type.
class Declarations {
public:
    void add(const char* name, float value) {
        std::string digits = fmt::format("{}", value);
        // A number without point or exponent is not a float in GLSL.
        if (digits.find_first_of(".e") == std::string::npos) digits += ".0";
        text_ += fmt::format("const float {} = {};\n", name, digits);
    }
    void add(const char* name, double value) { add(name, static_cast<float>(value)); }
    void add(const char* name, std::int32_t value) { text_ += fmt::format("const int {} = {};\n", name, value); }
    void add(const char* name, std::uint32_t value) { text_ += fmt::format("const uint {} = {}u;\n", name, value); }
    template <class Enum>
    requires std::is_enum_v<Enum>
    void add(const char* name, Enum value) { add(name, static_cast<std::uint32_t>(value)); }
    [[nodiscard]] const std::string& text() const noexcept { return text_; }

private:
    std::string text_;
};

void addLayout(Declarations& to) {
    to.add("kFar", kFar);
    to.add("kNone", kNone);
    to.add("kStyleTexels", kStyleTexels);
    to.add("kCodeTexels", kCodeTexels);
    to.add("kLineTexels", kLineTexels);
    to.add("kLineStyleTexels", kLineStyleTexels);
    to.add("kTriangleTexels", kTriangleTexels);
    to.add("kSquarePixels", kSquarePixels);
    to.add("kTriangle", render::PassShapes::kTriangle);
    to.add("kKindBits", kKindBits);
    to.add("kBodyBit", kBodyBit);
    to.add("kHatchShift", kHatchShift);
    to.add("kMaxSide", kMaxSide);
    to.add("kMaxReach", kMaxReach);
    to.add("kMaxFaces", static_cast<std::uint32_t>(render::ConvexPart::kMaxFaces));
    to.add("kMaxClipParts", static_cast<std::uint32_t>(render::Pass::kMaxClipParts));
    to.add("kOcclusionLevels", static_cast<std::int32_t>(render::OcclusionField::kLevels));
}

void addKinds(Declarations& to) {
    using Kind = render::LinearStyle::Kind;
    to.add("kHidden", Kind::Hidden);
    to.add("kTranslucent", Kind::Translucent);
    to.add("kOpaque", Kind::Opaque);
    to.add("kJoinOver", render::Pass::Join::Over);
    to.add("kJoinReplace", render::Pass::Join::Replace);
    to.add("kFirstPass", kFirstPass);
    to.add("kHiddenLinesNone", render::HiddenLines::None);
    to.add("kHiddenLinesDashed", render::HiddenLines::Dashed);
    using render::Hatch;
    to.add("kHatchNone", Hatch::None);
    to.add("kHatchMasonry", Hatch::Masonry);
    to.add("kHatchConcrete", Hatch::Concrete);
    to.add("kHatchReinforcedConcrete", Hatch::ReinforcedConcrete);
    to.add("kHatchTimber", Hatch::Timber);
    to.add("kHatchInsulation", Hatch::Insulation);
    to.add("kHatchEarth", Hatch::Earth);
    to.add("kHatchSteel", Hatch::Steel);
    to.add("kHatchGlass", Hatch::Glass);
    to.add("kHatchGeneral", Hatch::General);
}

void addPicture(Declarations& to) {
    to.add("kSkyAside", render::kSkyAside);
    to.add("kSkyAbove", render::kSkyAbove);
    to.add("kSkyShare", render::kSkyShare);
    to.add("kViewerShare", render::kViewerShare);
    to.add("kKeyShut", render::kKeyShut);
    to.add("kKeyOpen", render::kKeyOpen);
    to.add("kCavityOcclusion", render::kCavityOcclusion);
    to.add("kCavityFrom", render::kCavityFrom);
    to.add("kCavityGain", render::kCavityGain);
    to.add("kBallVoxels", render::kBallVoxels);
    to.add("kPlaneVoxels", render::kPlaneVoxels);
    to.add("kFacePlaces", render::kFacePlaces);
    to.add("kGentlePlaces", render::kGentlePlaces);
    to.add("kSeamDistance", render::kSeamDistance);
    to.add("kSeamSlope", render::kSeamSlope);
    to.add("kHalfWidthsBefore", render::kHalfWidthsBefore);
    to.add("kLeastFacing", render::kLeastFacing);
    to.add("kDepthTolerance", render::kDepthTolerance);
    to.add("kGlassLine", render::kGlassLine);
    to.add("kLevelCap", render::kLevelCap);
    to.add("kLeastCapFacing", render::kLeastCapFacing);
}

}  // namespace

std::string_view sharedConstants() {
    static const std::string text = [] {
        Declarations all;
        addLayout(all);
        addKinds(all);
        addPicture(all);
        return all.text();
    }();
    return text;
}

}  // namespace svt::render_gl
