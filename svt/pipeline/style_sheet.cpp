#include <svt/pipeline/style_sheet.hpp>

#include <svt/core/file.hpp>
#include <svt/image/color_text.hpp>
#include <svt/pipeline/default_style.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <utility>

namespace svt::pipeline {
namespace {

using nlohmann::json;

Error badStyle(std::string_view path, std::string_view what) {
    return Error(Code::BadStyle, fmt::format("style {}: {}", path, what));
}

// An error of another stage, prefixed with the JSON path.
Error atPath(std::string_view path, const Error& error) {
    return Error(error.code(), fmt::format("style {}: {}", path, error.message()), error.where());
}

// Every member must be known, so that a typing error is reported.
Result<void> checkMembers(const json& object, std::string_view path, std::initializer_list<std::string_view> known) {
    if (!object.is_object()) return badStyle(path, fmt::format("expected an object, found {}", object.type_name()));
    for (const auto& [key, value] : object.items()) {
        if (std::find(known.begin(), known.end(), key) != known.end()) continue;
        return badStyle(path, fmt::format("unknown member '{}'; possible are {}", key, fmt::join(known, ", ")));
    }
    return {};
}

Result<double> numberOf(const json& value, const std::string& path) {
    if (!value.is_number())
        return badStyle(path, fmt::format("expected a number, found {}", value.dump().substr(0, 40)));
    return value.get<double>();
}

Result<std::vector<Vec3f>> colorsOf(const json& value, const std::string& path) {
    if (!value.is_array() || value.size() > 64) return badStyle(path, "expected an array of at most 64 colours");
    std::vector<Vec3f> colors;
    for (const json& entry : value) {
        if (!entry.is_string()) return badStyle(path, "expected colours as text, such as \"#c8b49b\"");
        auto color = image::parseColor(entry.get<std::string>());
        if (!color) return badStyle(path, color.error().message());
        colors.push_back(*color);
    }
    return colors;
}

Result<Vec3d> vectorOf(const json& value, const std::string& path) {
    if (value.is_number()) {
        const double v = value.get<double>();
        return Vec3d{v, v, v};
    }
    if (!value.is_array() || value.size() != 3 || !value[0].is_number() || !value[1].is_number() ||
        !value[2].is_number())
        return badStyle(path, "expected a number or [length, width, height] in metres");
    return Vec3d{value[0].get<double>(), value[1].get<double>(), value[2].get<double>()};
}

Result<void> readCells(const json& value, const std::string& path, const std::filesystem::path& folder,
                       voxelize::Pattern& pattern) {
    if (!value.contains("file")) return {};
    if (!value["file"].is_string()) return badStyle(path + ".file", "expected a file name");
    const std::string name = value["file"].get<std::string>();
    const std::filesystem::path file = folder / name;
    const std::string at = fmt::format("{}.file '{}'", path, name);
    if (pattern.kind == voxelize::PatternKind::Image) {
        auto texels = voxelize::readPatternImage(file);
        if (!texels) return atPath(at, texels.error());
        pattern.texels = *texels;
        return {};
    }
    if (pattern.kind != voxelize::PatternKind::Raw)
        return badStyle(path + ".file", "only the types image and raw read a file");
    if (!value.contains("dimension")) return badStyle(path, "type raw needs \"dimension\": [x, y, z]");
    SVT_TRY(dimension, vectorOf(value["dimension"], path + ".dimension"));
    for (int axis = 0; axis < 3; ++axis)
        if (const double v = (*dimension)[axis]; !(v >= 1 && v <= 1024 && v == std::floor(v)))
            return badStyle(path + ".dimension",
                            fmt::format("{} is out of range; whole numbers from 1 to 1024 are possible", v));
    auto texels = voxelize::readPatternRaw(
        file, {static_cast<std::int32_t>(dimension->x), static_cast<std::int32_t>(dimension->y),
               static_cast<std::int32_t>(dimension->z)});
    if (!texels) return atPath(at, texels.error());
    pattern.texels = *texels;
    return {};
}

Result<void> readPattern(const json& value, const std::string& path, const std::filesystem::path& folder,
                         StyleRule& rule) {
    if (auto checked =
            checkMembers(value, path, {"type", "size", "line", "angle", "seed", "colors", "file", "dimension"});
        !checked)
        return checked.error();
    voxelize::Pattern pattern;
    if (!value.contains("type") || !value["type"].is_string() ||
        !voxelize::patternFromName(value["type"].get<std::string>(), pattern.kind)) {
        std::vector<std::string_view> names;
        for (int k = 0; k < voxelize::kPatternKinds; ++k)
            names.push_back(voxelize::patternName(static_cast<voxelize::PatternKind>(k)));
        return badStyle(path + ".type", fmt::format("expected one of {}", fmt::join(names, ", ")));
    }
    if (value.contains("size")) {
        SVT_TRY(size, vectorOf(value["size"], path + ".size"));
        pattern.size = *size;
    }
    for (const auto& [name, target] :
         {std::pair<const char*, double*>{"line", &pattern.line}, {"angle", &pattern.angleDegrees}}) {
        if (!value.contains(name)) continue;
        SVT_TRY(number, numberOf(value[name], path + "." + name));
        *target = *number;
    }
    if (value.contains("seed")) {
        if (!value["seed"].is_number_unsigned() || value["seed"].get<std::uint64_t>() > 0xFFFFFFFFu)
            return badStyle(path + ".seed", "expected a whole number from 0 to 4294967295");
        pattern.seed = static_cast<std::uint32_t>(value["seed"].get<std::uint64_t>());
    }
    SVT_DO(readCells(value, path, folder, pattern));
    auto made = voxelize::makePattern(std::move(pattern));
    if (!made) return atPath(path, made.error());
    if (value.contains("colors")) {
        SVT_TRY(colors, colorsOf(value["colors"], path + ".colors"));
        rule.patternColors = std::move(*colors);
    }
    rule.pattern = std::move(*made);
    return {};
}

Result<StyleRule> readRule(const json& value, const std::string& path, const std::filesystem::path& folder) {
    SVT_DO(checkMembers(value, path, {"select", "color", "opacity", "pattern", "comment"}));
    if (!value.contains("select") || !value["select"].is_string())
        return badStyle(path, "expected \"select\" with a query");
    auto query = model::Query::parse(value["select"].get<std::string>());
    if (!query) return badStyle(path + ".select", query.error().message());
    StyleRule rule{std::move(*query), {}, {}, {}, {}};
    if (value.contains("color")) {
        if (!value["color"].is_string()) return badStyle(path + ".color", "expected text such as \"#c8b49b\"");
        const auto color = image::parseColor(value["color"].get<std::string>());
        if (!color) return badStyle(path + ".color", color.error().message());
        rule.color = *color;
    }
    if (value.contains("opacity")) {
        SVT_TRY(opacity, numberOf(value["opacity"], path + ".opacity"));
        if (!(*opacity >= 0 && *opacity <= 1))
            return badStyle(path + ".opacity", fmt::format("{} is out of range; 0 to 1 are possible", *opacity));
        rule.opacity = static_cast<float>(*opacity);
    }
    if (value.contains("pattern"))
        if (auto read = readPattern(value["pattern"], path + ".pattern", folder, rule); !read) return read.error();
    return rule;
}

StyleSheet builtIn(std::initializer_list<const char*> texts) {
    StyleSheet all;
    for (const char* text : texts) {
        auto sheet = parseStyleSheet(text, {});
        if (sheet) all.rules.insert(all.rules.end(), sheet->rules.begin(), sheet->rules.end());
    }
    return all;
}

// Shades for phases without a colour in the sheet: each a little darker.
Vec3f shade(Vec3f color, std::size_t phase) {
    const float factor = 1.0f / (1.0f + 0.35f * float(phase));
    return color * factor;
}

Result<std::string> readText(const std::filesystem::path& file) {
    constexpr std::uint64_t kMaxBytes = std::uint64_t{16} << 20;
    SVT_TRY(mapped, FileBytes::read(file, kMaxBytes));
    return std::string(mapped->text());
}

// The text as JSON with an array of rules; these are not checked.
Result<json> parseRules(std::string_view text) {
    // Checks the depth first, since the parser is recursive.
    int depth = 0, deepest = 0;
    bool isText = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (c == '"') isText = !isText;
        if (isText) {
            i += c == '\\' ? 1 : 0;
            continue;
        }
        depth += c == '{' || c == '[' ? 1 : c == '}' || c == ']' ? -1 : 0;
        deepest = std::max(deepest, depth);
    }
    if (deepest > 64) return badStyle("file", fmt::format("nested {} deep; 64 levels are possible", deepest));
    json root = json::parse(text.begin(), text.end(), nullptr, false);
    if (root.is_discarded()) return badStyle("file", "not well-formed JSON");
    SVT_DO(checkMembers(root, "file", {"rules", "$schema", "comment"}));
    if (!root.contains("rules") || !root["rules"].is_array()) return badStyle("file", "expected \"rules\": [...]");
    return root;
}

void apply(const StyleRule& rule, ResolvedStyle& style) {
    if (rule.color) style.color = *rule.color;
    if (rule.opacity) style.opacity = *rule.opacity;
    if (rule.pattern) {
        style.pattern = *rule.pattern;
        style.phaseColors = rule.patternColors;
        if (style.phaseColors.empty() && style.pattern.texels != nullptr)
            style.phaseColors = style.pattern.texels->colors;
    }
}

}  // namespace

const StyleSheet& defaultStyle(bool withPatterns) {
    static const StyleSheet plain = builtIn({kDefaultStyleJson});
    static const StyleSheet patterned = builtIn({kDefaultStyleJson, kDefaultPatternsJson});
    return withPatterns ? patterned : plain;
}

Result<StyleSheet> parseStyleSheet(std::string_view text, const std::filesystem::path& folder) {
    SVT_TRY(root, parseRules(text));
    const json& rules = root->at("rules");
    StyleSheet sheet;
    for (std::size_t r = 0; r < rules.size(); ++r) {
        SVT_TRY(rule, readRule(rules[r], fmt::format("rules[{}]", r), folder));
        sheet.rules.push_back(std::move(*rule));
    }
    return sheet;
}

Result<StyleSheet> readStyleSheet(const std::filesystem::path& file) {
    SVT_TRY(text, readText(file));
    auto sheet = parseStyleSheet(*text, file.parent_path());
    // An error in the file of a pattern keeps that file as its place.
    if (!sheet && sheet.error().where().file.empty())
        return Error(sheet.error().code(), sheet.error().message(), {file.string(), 0, 0, {}});
    return sheet;
}

std::vector<std::filesystem::path> filesOfStyle(const std::filesystem::path& file) {
    const auto text = readText(file);
    const auto root = text ? parseRules(*text) : Result<json>(text.error());
    if (!root) return {};
    std::vector<std::filesystem::path> files;
    for (const json& rule : root->at("rules")) {
        if (!rule.is_object() || !rule.contains("pattern")) continue;
        const json& pattern = rule["pattern"];
        if (pattern.is_object() && pattern.contains("file") && pattern["file"].is_string())
            files.push_back(file.parent_path() / pattern["file"].get<std::string>());
    }
    return files;
}

std::vector<ResolvedStyle> resolveStyles(std::span<const model::QueryRow> rows,
                                         std::span<const StyleSheet* const> sheets,
                                         std::span<const std::optional<Vec3f>> materialColors) {
    std::vector<ResolvedStyle> styles(rows.size());
    for (std::size_t s = 0; s < sheets.size(); ++s) {
        for (const StyleRule& rule : sheets[s]->rules)
            for (const std::uint32_t row : rule.select.select(rows)) apply(rule, styles[row]);
        if (s == 0)
            for (std::size_t row = 0; row < rows.size() && row < materialColors.size(); ++row)
                if (materialColors[row]) styles[row].color = *materialColors[row];
    }
    for (ResolvedStyle& style : styles) {
        const std::size_t phases = style.pattern.phaseCount();
        if (phases == 1) style.phaseColors.clear();
        for (std::size_t p = style.phaseColors.size(); phases > 1 && p < phases; ++p)
            style.phaseColors.push_back(shade(style.color, p));
    }
    return styles;
}

}  // namespace svt::pipeline
