#include <apps/cli/commands/commands.hpp>
#include <apps/cli/options/build_options.hpp>
#include <apps/cli/output/json_output.hpp>
#include <apps/cli/output/messages.hpp>

#include <svt/mesh/mesh_set.hpp>

#include <fmt/format.h>

namespace svt::cli {
namespace {

struct CheckArguments {
    std::vector<std::filesystem::path> inputs;
    double lod = -1;
    std::string crs;
    bool json = false, verbose = false, keepFarFeatures = false;
};

Json objectJson(const model::BuildingModel& model, const mesh::MeshSet& scene, const mesh::ObjectMesh& object) {
    const model::Feature& feature = model.features[object.feature];
    Json json{{"id", feature.id}, {"class", feature.className}, {"name", feature.name}};
    if (feature.line != 0) json["line"] = feature.line;
    if (object.lod >= 0) json["lod"] = object.lod;
    json["closure"] = mesh::closureName(object.closure);
    json["closed"] = object.leakCount == 0 && object.isSolid();
    json["triangles"] = object.triangles.size();
    json["unmatchedEdges"] = object.unmatchedEdges;
    json["tJunctions"] = object.tJunctionCount;
    json["leakingEdges"] = object.leakCount;
    json["leaks"] = Json::array();
    for (const Vec3d& leak : object.leaks) json["leaks"].push_back(toJson(leak + scene.origin));
    json["stillOpenEdges"] = object.openEdges.size();
    json["flippedFaces"] = object.flippedFaces;
    json["complementedFaces"] = object.complementedFaces;
    json["caps"] = Json::array();
    for (const mesh::Cap& cap : object.caps)
        json["caps"].push_back({{"area", cap.area}, {"center", toJson(cap.center + scene.origin)}});
    json["assembled"] = object.isAssembled;
    json["volume"] = object.isSolid() ? Json(object.volume) : Json(nullptr);
    json["area"] = object.area;
    return json;
}

void printObject(const model::BuildingModel& model, const mesh::MeshSet& scene, const mesh::ObjectMesh& object) {
    const model::Feature& feature = model.features[object.feature];
    fmt::print("{:<28} {:<13}", feature.className, mesh::closureName(object.closure));
    if (object.isSolid())
        fmt::print(" {:>12.3f} m3", object.volume);
    else
        fmt::print(" {:>12.3f} m2", object.area);
    fmt::print("  {}{}{}\n", feature.name, feature.name.empty() ? "" : "  ", feature.id);
    if (object.leakCount != 0 && object.closure != mesh::Closure::Surface) {
        fmt::print("    {} unmatched edges, {} of them leak", object.unmatchedEdges, object.leakCount);
        for (std::size_t i = 0; i < std::min<std::size_t>(object.leaks.size(), 4); ++i) {
            const Vec3d at = object.leaks[i] + scene.origin;
            fmt::print("{} ({:.3f}, {:.3f}, {:.3f})", i == 0 ? " at" : ",", at.x, at.y, at.z);
        }
        fmt::print("{}\n", object.leaks.size() > 4 ? ", ..." : "");
    }
    for (const mesh::Cap& cap : object.caps) {
        const Vec3d at = cap.center + scene.origin;
        fmt::print("    capped by a ClosureSurface of {:.4f} m2 at ({:.3f}, {:.3f}, {:.3f})\n", cap.area, at.x, at.y,
                   at.z);
    }
    if (object.complementedFaces != 0)
        fmt::print("    completed with {} faces of adjoining features\n", object.complementedFaces);
    if (object.tJunctionCount != 0)
        fmt::print("    {} edges match only up to T-junctions (tight)\n", object.tJunctionCount);
}

int runCheck(const CheckArguments& arguments) {
    Diagnostics diagnostics;
    const auto crs = parseCrs(arguments.crs);
    if (!crs) return fail(crs.error());
    Result<model::BuildingModel> model = [&] {
        const TerminalProgress progress;
        readers::ReadOptions options;
        options.progress = progress.get();
        options.crs = *crs;
        options.keepFarFeatures = arguments.keepFarFeatures;
        return pipeline::readModels(arguments.inputs, options, &diagnostics);
    }();
    if (!model) {
        printDiagnostics(diagnostics, arguments.verbose);
        return fail(model.error());
    }
    mesh::MeshOptions options;
    options.lod.lod = arguments.lod;
    const auto scene = mesh::buildMeshes(*model, options, &diagnostics);
    if (!scene) {
        printDiagnostics(diagnostics, arguments.verbose);
        return fail(scene.error());
    }
    std::size_t leaking = 0, solids = 0, tight = 0;
    for (const mesh::ObjectMesh& object : scene->objects) {
        if (object.closure == mesh::Closure::Surface) continue;
        ++solids;
        leaking += object.leakCount != 0;
        tight += object.closure == mesh::Closure::TJunctions;
    }
    const std::size_t findings = diagnostics.count(Severity::Warning) + diagnostics.count(Severity::Error);
    if (arguments.json) {
        Json json;
        json["objects"] = Json::array();
        for (const mesh::ObjectMesh& object : scene->objects)
            json["objects"].push_back(objectJson(*model, *scene, object));
        json["solids"] = solids;
        json["leaking"] = leaking;
        json["tJunctions"] = tight;
        json["diagnostics"] = diagnosticsJson(diagnostics);
        print(json);
    } else {
        for (const mesh::ObjectMesh& object : scene->objects) printObject(*model, *scene, object);
        fmt::print("{} objects: {} solids, {} of them leak as read, {} are tight up to T-junctions\n",
                   scene->objects.size(), solids, leaking, tight);
        printDiagnostics(diagnostics, arguments.verbose);
    }
    return findings != 0 ? kInvalid : kDone;
}

}  // namespace

Action connectCheck(Command& command) {
    auto arguments = std::make_shared<CheckArguments>();
    command.set("input", arguments->inputs);
    command.set("--lod", arguments->lod);
    command.set("--crs", arguments->crs);
    command.set("--keep-far-features", arguments->keepFarFeatures);
    command.set("--json", arguments->json);
    command.set("--verbose", arguments->verbose);
    return [arguments] { return runCheck(*arguments); };
}

}  // namespace svt::cli
