#include <svt/core/check.hpp>
#include <svt/core/error.hpp>

#include <fmt/format.h>

namespace svt {

// A table with one line per code. It is a switch, so that the compiler warns about a missing code.
// NOLINTNEXTLINE(readability-function-size)
std::string_view codeName(Code code) noexcept {
    switch (code) {
#define SVT_CASE(name) \
    case Code::name: return #name
        SVT_CASE(CannotOpen);
        SVT_CASE(BadXml);
        SVT_CASE(UnknownFormat);
        SVT_CASE(InputTooBig);
        SVT_CASE(BadJson);
        SVT_CASE(UnknownVersion);
        SVT_CASE(DtdRefused);
        SVT_CASE(BadEncoding);
        SVT_CASE(EmptyModel);
        SVT_CASE(DanglingReference);
        SVT_CASE(ReferenceCycle);
        SVT_CASE(DuplicateId);
        SVT_CASE(MissingId);
        SVT_CASE(BadValue);
        SVT_CASE(ExternalReference);
        SVT_CASE(UnknownElement);
        SVT_CASE(MixedCrs);
        SVT_CASE(GeographicCrs);
        SVT_CASE(BadIndex);
        SVT_CASE(ForeignUnit);
        SVT_CASE(CannotProject);
        SVT_CASE(FarFeature);
        SVT_CASE(NoHeights);
        SVT_CASE(DualityBroken);
        SVT_CASE(AxisOrder);
        SVT_CASE(MapScale);
        SVT_CASE(UnitInDoubt);
        SVT_CASE(FeatureEnded);
        SVT_CASE(OutsideArea);
        SVT_CASE(BadStep);
        SVT_CASE(BadRecord);
        SVT_CASE(ReadInPart);
        SVT_CASE(ShapeNotRead);
        SVT_CASE(ProductsRead);
        SVT_CASE(LayersNotSplit);
        SVT_CASE(LayersSplit);
        SVT_CASE(Truncated);
        SVT_CASE(TooFewPoints);
        SVT_CASE(BadCoordinate);
        SVT_CASE(ZeroArea);
        SVT_CASE(DuplicateFace);
        SVT_CASE(SelfTouchingRing);
        SVT_CASE(NonPlanar);
        SVT_CASE(ShellNotClosed);
        SVT_CASE(TJunction);
        SVT_CASE(ShellCapped);
        SVT_CASE(WindingFilled);
        SVT_CASE(FaceFlipped);
        SVT_CASE(TriangulationFailed);
        SVT_CASE(NoGeometry);
        SVT_CASE(FacesComplemented);
        SVT_CASE(VolumeDiffers);
        SVT_CASE(RepeatedPoint);
        SVT_CASE(RingNotClosed);
        SVT_CASE(RingsIntersect);
        SVT_CASE(DuplicateRing);
        SVT_CASE(NormalsDeviate);
        SVT_CASE(PolygonSplit);
        SVT_CASE(InnerRingOutside);
        SVT_CASE(InnerRingsNested);
        SVT_CASE(InnerRingTurnsAlike);
        SVT_CASE(TooFewFaces);
        SVT_CASE(NonManifold);
        SVT_CASE(ShellDisconnected);
        SVT_CASE(ShellSelfIntersects);
        SVT_CASE(FaceTurnedOver);
        SVT_CASE(ShellsIntersect);
        SVT_CASE(DuplicateShell);
        SVT_CASE(InnerShellOutside);
        SVT_CASE(SolidSplit);
        SVT_CASE(ShellTurnedOver);
        SVT_CASE(SolidsIntersect);
        SVT_CASE(DuplicateSolid);
        SVT_CASE(SolidsDisconnected);
        SVT_CASE(PartsOverlap);
        SVT_CASE(CellsOverlap);
        SVT_CASE(StateOutsideCell);
        SVT_CASE(CellsNotAdjacent);
        SVT_CASE(UnitsOverlap);
        SVT_CASE(StoreyGap);
        SVT_CASE(UnitNotReached);
        SVT_CASE(BadDimension);
        SVT_CASE(GridTooLarge);
        SVT_CASE(TooManyLabels);
        SVT_CASE(BadPattern);
        SVT_CASE(BadStyle);
        SVT_CASE(ThinObject);
        SVT_CASE(Overlap);
        SVT_CASE(BadVolume);
        SVT_CASE(BadChecksum);
        SVT_CASE(VolumeVersion);
        SVT_CASE(CannotWrite);
        SVT_CASE(DiskFull);
        SVT_CASE(BadImage);
        SVT_CASE(BadNrrd);
        SVT_CASE(WouldDestroy);
        SVT_CASE(BadCamera);
        SVT_CASE(BadFrame);
        SVT_CASE(BadSection);
        SVT_CASE(BadScene);
        SVT_CASE(NoGraphics);
        SVT_CASE(UncertainArea);
        SVT_CASE(PlaneInFaces);
        SVT_CASE(DrawnByVoxels);
        SVT_CASE(NoMeshes);
        SVT_CASE(NoCairo);
        SVT_CASE(BadSheets);
        SVT_CASE(StoreyLevelDiffers);
        SVT_CASE(NetExceedsGross);
        SVT_CASE(RoomsShareSpace);
        SVT_CASE(BadPlan);
        SVT_CASE(PlanVersion);
        SVT_CASE(BadPack);
        SVT_CASE(BadCity);
        SVT_CASE(CityIncomplete);
        SVT_CASE(FeatureSkipped);
        SVT_CASE(LinkedFeature);
        SVT_CASE(InputChanged);
        SVT_CASE(TaskFailed);
        SVT_CASE(Replica);
        SVT_CASE(IdConflict);
        SVT_CASE(ManySkipped);
        SVT_CASE(BadField);
        SVT_CASE(UnknownField);
        SVT_CASE(FieldOutside);
        SVT_CASE(FieldInPart);
        SVT_CASE(UnknownMaterial);
        SVT_CASE(AirLeak);
        SVT_CASE(NotConverged);
        SVT_CASE(BadQuery);
        SVT_CASE(NothingSelected);
        SVT_CASE(Cancelled);
        SVT_CASE(BadArgument);
        SVT_CASE(BadDefaults);
        SVT_CASE(Internal);
#undef SVT_CASE
    }
    return "Unknown";
}

std::string codeTag(Code code) { return fmt::format("E{:03}", static_cast<unsigned>(code)); }

std::string Place::toString() const {
    std::string text = file;
    if (line != 0) text += fmt::format("{}line {}", text.empty() ? "" : ":", line);
    if (line != 0 && !file.empty()) text = fmt::format("{}:{}", file, line);
    if (line != 0 && column != 0) text += fmt::format(":{}", column);
    if (!id.empty()) text += fmt::format("{}(id '{}')", text.empty() ? "" : " ", id);
    return text;
}

std::string Error::toString() const {
    const std::string place = where_.toString();
    return fmt::format("{} {}: {}{}{}", codeTag(code_), codeName(code_), place, place.empty() ? "" : ": ", message_);
}

void valueMissing(const Error& error) noexcept {
    checkFailed("Result::hasValue()", error.toString(), __FILE__, __LINE__);
}

void errorMissing() noexcept { checkFailed("!Result::hasValue()", "", __FILE__, __LINE__); }

}  // namespace svt
