#include <apps/cli/doctor/answers.hpp>
#include <apps/cli/options/catalog.hpp>
#include <apps/cli/options/shared_options.hpp>
#include <apps/cli/output/messages.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

namespace svt::cli {
namespace {

struct DoctorArguments {
    bool json = false;
};

// Prints each answer at once, so that a crash shows how far the program got; prints JSON at the end.
class Report {
public:
    explicit Report(bool isJson) : isJson_(isJson) { json_["state"] = nullptr; }

    void add(const Answer& answer) {
        worst_ = std::max(worst_, answer.state);
        if (answer.error && !error_) error_ = answer.error;
        if (!isJson_) {
            fmt::print("{:<16}  {:<7}  {}\n", answer.title, stateName(answer.state), answer.text);
            std::fflush(stdout);
            return;
        }
        Json& json = json_[answer.key] = {{"state", stateName(answer.state)}, {"text", answer.text}};
        json.update(answer.values);
    }

    // Returns the exit code.
    int finish() {
        json_["state"] = stateName(worst_);
        if (isJson_) print(json_);
        return error_ ? fail(*error_) : kDone;
    }

private:
    bool isJson_;
    State worst_ = State::Ok;
    std::optional<Error> error_;
    Json json_ = Json::object();
};

int runDoctor(const DoctorArguments& arguments) {
    Report report(arguments.json);
    report.add(programAnswer());
    report.add(processorAnswer());
    report.add(memoryAnswer());
    const GlProbe probe = probeGl();  // before anything starts threads
    report.add(graphicsAnswer(probe));
    report.add(viewerAnswer());
    report.add(browserAnswer());
    report.add(fontAnswer());
    report.add(temporaryFolderAnswer());
    report.add(currentFolderAnswer());
    const auto house = buildTestVolume();
    report.add(testVolumeAnswer(house));
    if (house) {
        illustrate::ScenePainter painter(house->volume);
        report.add(testPictureAnswer(drawTestPicture(painter, castByCpu)));
    }
    if (probe.contextFault.empty()) report.add(testOpenGlAnswer(probe));
    return report.finish();
}

Members<DoctorArguments> membersOf(const DoctorArguments*) noexcept {
    static constexpr Member<DoctorArguments> kMembers[] = {jsonOption<&DoctorArguments::json>()};
    return kMembers;
}

}  // namespace

extern const CommandText kDoctorCommand =
    commandOf<DoctorArguments, runDoctor>("doctor", "Check this machine, and suggest remedies for missing parts");

}  // namespace svt::cli
