#include <svt/core/text.hpp>
#include <svt/drawing/material_table.hpp>
#include <svt/record/csv_reader.hpp>
#include <svt/record/record.hpp>

#include <fmt/format.h>

#include <utility>

namespace svt::drawing {
namespace {

using record::Members, record::member;

// A table as written in a file.
struct MaterialText {
    std::vector<std::string> words;
    render::Hatch hatch = render::Hatch::General;
    bool loadBearing = false;
};
struct MaterialsText {
    bool replace = false;
    std::vector<MaterialText> materials;
};

Members<MaterialText> membersOf(const MaterialText*) noexcept {
    static constexpr record::Member<MaterialText> kMembers[] = {
        member<&MaterialText::words>("words", "words of names", {.isRequired = true}),
        member<&MaterialText::hatch>("hatch", "hatch of the material", {.isRequired = true}),
        member<&MaterialText::loadBearing>("loadBearing", "whether it decides the hatch of a layered wall")};
    return kMembers;
}

Members<MaterialsText> membersOf(const MaterialsText*) noexcept {
    static constexpr record::Member<MaterialsText> kMembers[] = {
        member<&MaterialsText::replace>("replace", "leave out the table of the program"),
        member<&MaterialsText::materials>("materials", "rows, the first takes precedence", {.isRequired = true})};
    return kMembers;
}

Result<MaterialTable> parseJson(std::string_view text, const std::string& file, bool& replaces) {
    SVT_TRY(read, record::parseRecord<MaterialsText>(text, file, Code::BadJson));
    MaterialTable table;
    for (const MaterialText& material : read->materials) {
        if (material.words.empty())
            return Error(Code::BadJson, fmt::format("{}: a material without words; name at least one", file));
        for (const std::string& word : material.words) table.add({material.hatch, material.loadBearing}, word);
    }
    replaces = read->replace;
    return table;
}

bool hasReplaceLine(std::string_view text) {
    while (!text.empty()) {
        const std::string_view line = text.substr(0, text.find('\n'));
        if (withoutBlanks(line) == "#replace") return true;
        text.remove_prefix(std::min(line.size() + 1, text.size()));
    }
    return false;
}

}  // namespace

Result<MaterialTable> parseMaterials(std::string_view text, const std::string& file) {
    SVT_DO(record::checkTableText(text, file));
    const bool isJson = withoutBlanks(text).starts_with('{');
    bool replaces = !isJson && hasReplaceLine(text);
    auto table = isJson ? parseJson(text, file, replaces) : MaterialTable::parseCsv(text, file);
    if (table && !replaces) table->append(MaterialTable::builtIn());
    return table;
}

}  // namespace svt::drawing
