#include <svt/pipeline/style_sheet.hpp>

#include <svt/core/file.hpp>
#include <svt/core/text.hpp>
#include <svt/image/color_text.hpp>
#include <svt/pipeline/default_style.hpp>
#include <svt/record/record.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

namespace svt::pipeline {
namespace {

using record::Faults, record::Json, record::Member, record::member, record::memberAs, record::Members;

using Color = record::TextOf<Vec3f, image::parseColor, image::colorText>;

// Metres along u, v and w: three numbers, or one for all.
struct UnitSize : record::PlainCodec<UnitSize, Vec3d> {
    static void read(Faults& faults, const Json& json, const std::string& path, const Option&, Vec3d& to) {
        const auto isNumber = [](const Json& value) { return value.is_number(); };
        if (isNumber(json)) return void(to = {json.get<double>(), json.get<double>(), json.get<double>()});
        if (!json.is_array() || json.size() != 3 || !std::all_of(json.begin(), json.end(), isNumber))
            return faults.add(path, "expected a number or [length, width, height] in metres");
        to = {json[0].get<double>(), json[1].get<double>(), json[2].get<double>()};
    }
    static Json write(const Option& option, const Vec3d& from) { return record::Codec<Vec3d>::write(option, from); }
};

// Pattern, rule and sheet as written in a file.
struct PatternText {
    std::optional<voxelize::PatternKind> type;
    voxelize::Pattern pattern;
    std::vector<Vec3f> colors;
    std::string file;
    std::optional<Vec3i> dimension;  // of a raw file
};
struct RuleText {
    std::string select;
    std::optional<Vec3f> color;
    std::optional<float> opacity;
    std::optional<PatternText> pattern;
};
struct SheetText {
    std::vector<RuleText> rules;
};

// Cells along u, v and w: three whole numbers, or one for all.
struct RawSize : record::PlainCodec<RawSize, Vec3i> {
    static void read(Faults& faults, const Json& json, const std::string& path, const Option& option, Vec3i& to) {
        if (json.is_number()) return read(faults, Json::array({json, json, json}), path, option, to);
        std::array<std::int32_t, 3> size{};
        record::Codec<std::array<std::int32_t, 3>>::read(faults, json, path, option, size);
        to = {size[0], size[1], size[2]};
    }
    static Json write(const Option&, const Vec3i& from) { return {from.x, from.y, from.z}; }
};

template <class Text>
constexpr Member<Text> comment(std::string_view name = "comment") {
    return record::memberOf<Text, record::Ignored<Text>>(name, "not read");
}

Members<PatternText> membersOf(const PatternText*) noexcept {
    using All = PatternText;
    using voxelize::Pattern;
    static constexpr Member<All> kMembers[] = {
        member<&All::type>("type", "kind of pattern"),
        memberAs<UnitSize, &All::pattern, &Pattern::size>("size", "of one unit along u (length), v (depth) and w (up)"),
        member<&All::pattern, &Pattern::line>("line", "width of joints and lines", {.unit = "metres"}),
        member<&All::pattern, &Pattern::angleDegrees>("angle", "hatch: from u towards w", {.unit = "degrees"}),
        member<&All::pattern, &Pattern::seed>("seed", "wood-grain, concrete", {.least = 0, .most = 4294967295}),
        memberAs<record::ListCodec<Vec3f, Color>, &All::colors>("colors", "one per phase", {.most = 64}),
        member<&All::file>("file", "image: a PNG; raw: a file of bytes. Relative to the style file"),
        memberAs<RawSize, &All::dimension>("dimension", "of a raw file", {.least = 1, .most = 1024}),
    };
    return kMembers;
}

void checkMembers(Faults& faults, const std::string& path, const PatternText& pattern) {
    if (!pattern.type) return faults.add(path + "/type", "expected one of " + listedNames<voxelize::PatternKind>());
    const bool isRaw = *pattern.type == voxelize::PatternKind::Raw;
    if (pattern.file.empty()) return;
    if (!isRaw && *pattern.type != voxelize::PatternKind::Image)
        faults.add(path + "/file", "only the types image and raw read a file");
    if (isRaw && !pattern.dimension) faults.add(path, "type raw needs \"dimension\": [x, y, z]");
}

Members<RuleText> membersOf(const RuleText*) noexcept {
    using All = RuleText;
    static constexpr Member<All> kMembers[] = {
        member<&All::select>("select", "query for the features", {.isRequired = true}),
        memberAs<Color, &All::color>("color", "#rrggbb, #rgb or a colour name"),
        member<&All::opacity>("opacity", "share of light that one metre stops; 1 is solid", {.least = 0, .most = 1}),
        member<&All::pattern>("pattern", "in metres, along the axes of the object"),
        comment<All>(),
    };
    return kMembers;
}

Members<SheetText> membersOf(const SheetText*) noexcept {
    static constexpr Member<SheetText> kMembers[] = {
        member<&SheetText::rules>("rules", "in order; later rules win", {.isRequired = true}),
        comment<SheetText>("$schema"), comment<SheetText>()};
    return kMembers;
}

// "/rules/0/color" as people write it: "rules[0].color"; "/" is "file".
std::string pathText(std::string_view pointer) {
    std::string text;
    while (pointer.size() > 1) {
        const auto [step, rest] = record::firstStep(pointer);
        const bool isIndex = !step.empty() && std::all_of(step.begin(), step.end(), isDigit);
        text += isIndex ? fmt::format("[{}]", step) : fmt::format("{}{}", text.empty() ? "" : ".", step);
        pointer = rest;
    }
    return text.empty() ? "file" : text;
}

// \param path  of the rule, a JSON pointer
Result<StyleRule> makeRule(RuleText text, const std::string& path, const std::filesystem::path& folder) {
    const auto fault = [&](const char* member, const Error& error, const std::string& of = {}) {
        return Error(error.code(), fmt::format("style {}{}: {}", pathText(path + member), of, error.message()),
                     error.where());
    };
    auto query = model::Query::parse(text.select);
    if (!query) return fault("/select", Error(Code::BadStyle, query.error().message()));
    StyleRule rule{std::move(*query), text.color, text.opacity, {}, {}};
    if (!text.pattern) return rule;
    voxelize::Pattern& pattern = text.pattern->pattern;
    pattern.kind = *text.pattern->type;
    if (const std::string& name = text.pattern->file; !name.empty()) {
        auto texels = pattern.kind == voxelize::PatternKind::Raw
                          ? voxelize::readPatternRaw(folder / name, *text.pattern->dimension)
                          : voxelize::readPatternImage(folder / name);
        if (!texels) return fault("/pattern/file", texels.error(), fmt::format(" '{}'", name));
        pattern.texels = *texels;
    }
    auto made = voxelize::makePattern(std::move(pattern));
    if (!made) return fault("/pattern", made.error());
    rule.pattern = std::move(*made);
    rule.patternColors = std::move(text.pattern->colors);
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

Result<SheetText> parseText(std::string_view text) {
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
    Faults faults;
    SheetText sheet;
    const Json json = deepest > 64 ? Json() : Json::parse(text, nullptr, false);
    if (deepest > 64)
        faults.add("", fmt::format("nested {} deep; 64 levels are possible", deepest));
    else if (json.is_discarded())
        faults.add("", "not well-formed JSON");
    else
        record::readRecord(faults, json, "", sheet);
    if (!faults.isFine()) return faults.error(Code::BadStyle, fmt::format("style {}: ", pathText(faults.path())));
    return sheet;
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

Result<StyleSheet> parseStyleSheet(std::string_view json, const std::filesystem::path& folder) {
    SVT_TRY(read, parseText(json));
    StyleSheet sheet;
    for (RuleText& text : read->rules) {
        SVT_TRY(rule, makeRule(std::move(text), fmt::format("/rules/{}", sheet.rules.size()), folder));
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
    std::vector<std::filesystem::path> files;
    const auto text = readText(file);
    const auto sheet = text ? parseText(*text) : Result<SheetText>(text.error());
    if (!sheet) return files;
    for (const RuleText& rule : sheet->rules)
        if (rule.pattern && !rule.pattern->file.empty()) files.push_back(file.parent_path() / rule.pattern->file);
    return files;
}

std::vector<ResolvedStyle> resolveStyles(std::span<const model::QueryRow> rows,
                                         std::span<const StyleSheet* const> sheets,
                                         std::span<const std::optional<Vec3f>> materialColors,
                                         std::span<const std::optional<float>> materialOpacities) {
    std::vector<ResolvedStyle> styles(rows.size());
    for (std::size_t s = 0; s < sheets.size(); ++s) {
        for (const StyleRule& rule : sheets[s]->rules)
            for (const std::uint32_t row : rule.select.select(rows)) apply(rule, styles[row]);
        if (s != 0) continue;
        for (std::size_t row = 0; row < rows.size() && row < materialColors.size(); ++row)
            if (materialColors[row]) styles[row].color = *materialColors[row];
        for (std::size_t row = 0; row < rows.size() && row < materialOpacities.size(); ++row)
            if (materialOpacities[row]) styles[row].opacity = *materialOpacities[row];
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
