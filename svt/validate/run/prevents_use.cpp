#include <svt/validate/validate.hpp>

namespace svt::validate {

bool preventsUse(Code code) noexcept {
    switch (code) {
        // A part of the model is missing, or at an unknown place.
        case Code::DanglingReference:
        case Code::ReferenceCycle:
        case Code::ExternalReference:
        case Code::MixedCrs:
        case Code::BadIndex:
        case Code::CannotProject:
        case Code::FarFeature:
        case Code::NoHeights:
        case Code::BadRecord:
        case Code::ReadInPart:
        case Code::ShapeNotRead:
        case Code::Truncated:
        case Code::BadCoordinate:
        case Code::TriangulationFailed:
        // A body is open, or encloses no definite space.
        case Code::ShellNotClosed:
        case Code::ShellCapped:
        case Code::WindingFilled:
        case Code::VolumeDiffers:
        case Code::TooFewFaces:
        case Code::ShellSelfIntersects:
        case Code::ShellsIntersect:
        case Code::DuplicateShell:
        case Code::InnerShellOutside:
        // Space counts twice.
        case Code::SolidsIntersect:
        case Code::DuplicateSolid:
        case Code::PartsOverlap:
        case Code::CellsOverlap:
        // Links between rooms, or the rules of legal units.
        case Code::DualityBroken:
        case Code::StateOutsideCell:
        case Code::CellsNotAdjacent:
        case Code::UnitsOverlap:
        case Code::StoreyGap:
        case Code::UnitNotReached:
        // A test that was not possible.
        case Code::BadDimension:
        case Code::GridTooLarge:
        case Code::TooManyLabels: return true;
        default: return false;
    }
}

}  // namespace svt::validate
