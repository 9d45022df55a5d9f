#include <apps/cli/options/catalog.hpp>

namespace svt::cli {

// Each command is declared next to its code.
extern const CommandText kSampleCommand, kSampleCityCommand, kBuildCommand, kInfoCommand, kCheckCommand, kRenderCommand,
    kThumbnailCommand, kSectionCommand, kSheetsCommand, kQueryCommand, kQuantitiesCommand, kFieldListCommand,
    kFieldAddCommand, kFieldStatsCommand, kFieldProbeCommand, kFieldExportCommand, kFieldRemoveCommand,
    kSimulateHeatCommand, kSimulateSpreadCommand, kCadastreCommand, kDiffCommand, kShellCommand, kConvertCommand,
    kServeCommand, kViewCommand, kPublishCommand, kCityPlanCommand, kCityRunCommand, kCityTaskCommand,
    kCityStatusCommand, kCityMergeCommand, kCityInfoCommand, kCityFindCommand, kCityExtractCommand, kDoctorCommand,
    kDescribeCommand;

std::span<const CommandText> commandTexts() {
    static const CommandText kAll[] = {
        kSampleCommand,      kSampleCityCommand,  kBuildCommand,        kInfoCommand,           kCheckCommand,
        kRenderCommand,      kThumbnailCommand,   kSectionCommand,      kSheetsCommand,         kQueryCommand,
        kQuantitiesCommand,  kFieldListCommand,   kFieldAddCommand,     kFieldStatsCommand,     kFieldProbeCommand,
        kFieldExportCommand, kFieldRemoveCommand, kSimulateHeatCommand, kSimulateSpreadCommand, kCadastreCommand,
        kDiffCommand,        kShellCommand,       kConvertCommand,      kServeCommand,          kViewCommand,
        kPublishCommand,     kCityPlanCommand,    kCityRunCommand,      kCityTaskCommand,       kCityStatusCommand,
        kCityMergeCommand,   kCityInfoCommand,    kCityFindCommand,     kCityExtractCommand,    kDoctorCommand,
        kDescribeCommand};
    return kAll;
}

}  // namespace svt::cli
