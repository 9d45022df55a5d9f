#include <apps/cli/output/version.hpp>

#include <svt/city/city_folder.hpp>
#include <svt/core/machine.hpp>
#include <svt/core/simd_targets.hpp>
#include <svt/core/text.hpp>
#include <svt/drawing/sheet_set.hpp>
#include <svt/illustrate/scene_members.hpp>
#include <svt/record/record.hpp>
#include <svt/volume/volume_json.hpp>

#include <fmt/format.h>

#include <algorithm>

// SVT_VERSION, SVT_COMMIT, SVT_DEPENDENCIES: written by the build, see cmake/Version.cmake.
#include <svt_version.hpp>

namespace svt::cli {
namespace {

using record::Json;

#ifdef __EMSCRIPTEN__
constexpr bool kIsNative = false;
#else
constexpr bool kIsNative = true;
#endif

// The version of a format whose members are declared.
int versionOf(std::span<const Option> members) {
    const auto found = std::ranges::find(members, "/version", &Option::name);
    return found == members.end() ? 0 : static_cast<int>(found->most);
}

Json fileFormatsJson() {
    return {{"svt", fmt::format("{}.{}", volume::kSvtMajorVersion, volume::kSvtMinorVersion)},
            {"city", city::City::kVersion},
            {"scene", versionOf(illustrate::sceneMembers())},
            {"sheets", versionOf(drawing::sheetMembers())}};
}

// Parses "fmt=9.1.0|zlib=1.2.13".
Json dependenciesJson() {
    Json list = Json::array();
    for (const std::string_view each : splitChoices(SVT_DEPENDENCIES)) {
        const std::size_t equals = std::min(each.find('='), each.size());
        const std::string_view version = each.substr(std::min(equals + 1, each.size()));
        list.push_back(
            {{"name", each.substr(0, equals)}, {"version", version.empty() ? Json(nullptr) : Json(version)}});
    }
    return list;
}

// Parts that not every build has.
Json partsJson() {
    return {{"openGl", kIsNative},      {"pdf", kIsNative},         {"geoPackage", kIsNative}, {"xlsx", kIsNative},
            {"projections", kIsNative}, {"addresses", kIsNative},   {"films", kIsNative},      {"threads", kIsNative},
            {"processes", kIsNative},   {"sanitizer", kIsSanitized}};
}

}  // namespace

std::string_view versionNumber() noexcept { return SVT_VERSION; }

BuildFacts buildFacts() {
    BuildFacts facts;
    facts.commit = SVT_COMMIT;
    facts.kind = SVT_BUILD_TYPE;
#if defined(__clang__)
    facts.compiler = fmt::format("Clang {}.{}.{}", __clang_major__, __clang_minor__, __clang_patchlevel__);
#elif defined(__GNUC__)
    facts.compiler = fmt::format("GCC {}.{}.{}", __GNUC__, __GNUC_MINOR__, __GNUC_PATCHLEVEL__);
#else
    facts.compiler = "an unknown compiler";
#endif
#ifdef __EMSCRIPTEN__
    facts.openGl = "none";
#else
    facts.openGl = "OpenGL ES 3.0 by EGL";
#endif
#ifdef __OPTIMIZE__
    facts.isOptimized = true;
#endif
    return facts;
}

std::string versionText() {
    const BuildFacts facts = buildFacts();
    return fmt::format("svt {}\ncommit    {}\ncompiler  {}, {}\nSIMD      {}\nOpenGL    {}", SVT_VERSION, facts.commit,
                       facts.compiler, facts.kind, simdTargetName(), facts.openGl);
}

std::string versionJson() {
    const BuildFacts facts = buildFacts();
    const Json loaded = kIsNative ? Json{"cairo", "libcurl", "PROJ", "qpdf", "SQLite"} : Json::array();
    const Json json{{"version", SVT_VERSION},
                    {"commit", facts.commit},
                    {"compiler", facts.compiler},
                    {"buildType", facts.kind},
                    {"optimized", facts.isOptimized},
                    {"simd", simdTargetName()},
                    {"fileFormats", fileFormatsJson()},
                    {"dependencies", dependenciesJson()},
                    {"loadedOnUse", loaded},
                    {"parts", partsJson()}};
    return json.dump(2);
}

std::string programOfCity() { return fmt::format("{} {}", versionNumber(), buildFacts().commit); }

}  // namespace svt::cli
