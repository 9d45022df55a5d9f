#include <apps/cli/city/engines.hpp>
#include <apps/cli/output/version.hpp>

#include <svt/core/text.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>

namespace svt::cli {
namespace {

// A text as YAML: strings of JSON are double-quoted strings of YAML.
std::string yaml(const std::string& text) {
    return nlohmann::json(text).dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
}

bool isBelow(const std::filesystem::path& path, const std::filesystem::path& folder) {
    const auto [own, other] = std::mismatch(folder.begin(), folder.end(), path.begin(), path.end());
    static_cast<void>(other);
    return own == folder.end();
}

using Settings = std::map<std::string, std::string>;

Result<Settings> settingsOf(const EngineJob& job) {
    Settings settings{{"image", fmt::format("svt:{}", versionNumber())},
                      {"claim", "svt"},
                      {"mount", job.folder.parent_path().string()},
                      {"namespace", ""},
                      {"cpu", "1"},
                      {"memory", "2Gi"},
                      {"parallelism", "64"}};
    for (std::string option : job.options) {
        while (option.starts_with('-')) option.erase(0, 1);
        const std::size_t equals = option.find('=');
        const auto at = settings.find(option.substr(0, equals));
        if (at == settings.end() || equals == std::string::npos || equals + 1 == option.size())
            return Error(Code::BadArgument,
                         fmt::format("'{}': expected one of image=, claim=, mount=, namespace=, cpu=, memory=, "
                                     "parallelism= with a value",
                                     option));
        at->second = option.substr(equals + 1);
    }
    const std::string& number = settings["parallelism"];
    if (number.size() > 6 || number.find_first_not_of("0123456789") != std::string::npos)
        return Error(Code::BadArgument, fmt::format("parallelism={}: expected a whole number", number));
    return settings;
}

// The part of both jobs from `template` on. \param command  a command line for the shell
std::string podTemplate(const Settings& settings, const std::string& command) {
    return fmt::format(R"(  template:
    spec:
      restartPolicy: Never
      containers:
        - name: svt
          image: {}
          command: ["/bin/sh", "-c", {}]
          resources:
            requests: {{cpu: {}, memory: {}}}
            limits: {{memory: {}}}
          volumeMounts:
            - {{name: data, mountPath: {}}}
      volumes:
        - name: data
          persistentVolumeClaim: {{claimName: {}}}
)",
                       yaml(settings.at("image")), yaml(command), yaml(settings.at("cpu")), yaml(settings.at("memory")),
                       yaml(settings.at("memory")), yaml(settings.at("mount")), yaml(settings.at("claim")));
}

std::string head(const Settings& settings, const std::string& name) {
    std::string text = fmt::format("apiVersion: batch/v1\nkind: Job\nmetadata:\n  name: {}\n", yaml(name));
    if (!settings.at("namespace").empty()) text += fmt::format("  namespace: {}\n", yaml(settings.at("namespace")));
    return text + "spec:\n";
}

}  // namespace

Result<std::string> kubernetesJobs(const EngineJob& job, const city::Plan& plan) {
    SVT_TRY(settings, settingsOf(job));
    const std::filesystem::path mount = std::filesystem::path(settings->at("mount")).lexically_normal();
    std::vector<std::filesystem::path> needed{job.folder};
    for (const city::PlanFile& file : plan.files) needed.emplace_back(file.path);
    for (const std::filesystem::path& path : needed)
        if (!isBelow(path, mount))
            return Error(Code::BadArgument,
                         fmt::format("mount={}: pods cannot read this path, because it lies outside of the mounted "
                                     "folder; mount a folder that contains the city and all of its files, under the "
                                     "same names",
                                     mount.string()),
                         {path.string(), 0, 0, {}});
    // The plan's digest distinguishes jobs of different plans.
    const std::string name = "svt-city-" + plan.digest.substr(0, 10), folder = shellQuoted(job.folder.string());
    const std::string task =
        fmt::format("exec svt city task {} \"$JOB_COMPLETION_INDEX\" --of {} --tile-seconds {} --feature-seconds {}",
                    folder, plan.tasks, job.packs.tileSeconds, job.packs.featureSeconds);
    const std::string space =
        settings->at("namespace").empty() ? "" : " --namespace " + shellQuoted(settings->at("namespace"));
    std::string text = fmt::format(
        "# kubectl apply -f FILE runs the tasks. A failed task is tried up to three more times, and does not stop\n"
        "# other tasks (Kubernetes 1.29 or newer). The merge joins the finished packs and lists missing ones. Both\n"
        "# can be repeated, and skip finished work. To start the merge:\n"
        "#   kubectl wait{0} --for=condition=complete --timeout=24h job/{1}\n"
        "#   kubectl patch{0} job/{1}-merge -p '{{\"spec\":{{\"suspend\":false}}}}'\n",
        space, name);
    text += head(*settings, name);
    text += fmt::format(
        "  completionMode: Indexed\n  completions: {}\n  parallelism: {}\n  backoffLimitPerIndex: 3\n"
        "  maxFailedIndexes: {}\n",
        plan.tasks, std::min(parseInteger<std::uint32_t>(settings->at("parallelism")).value_or(plan.tasks), plan.tasks),
        plan.tasks);
    text += podTemplate(*settings, task);
    text += "---\n" + head(*settings, name + "-merge");
    text += "  suspend: true\n  backoffLimit: 3\n";
    return text + podTemplate(*settings, fmt::format("exec svt city merge {}", folder));
}

}  // namespace svt::cli
