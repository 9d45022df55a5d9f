#include <svt/voxelize/patterns.hpp>
namespace svt::voxelize {
Result<std::shared_ptr<const PatternCells>> readPatternImage(const std::filesystem::path& file, int) { return Error(Code::BadImage, "", {file.string(),0,0,{}}); }
Result<std::shared_ptr<const PatternCells>> readPatternRaw(const std::filesystem::path& file, Vec3i) { return Error(Code::BadImage, "", {file.string(),0,0,{}}); }
}
