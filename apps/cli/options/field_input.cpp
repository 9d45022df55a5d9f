#include <apps/cli/options/field_input.hpp>
#include <apps/cli/output/messages.hpp>

#include <svt/core/file.hpp>
#include <svt/fields/svt_fields.hpp>
#include <svt/volume/svt_file.hpp>

#include <fmt/format.h>

#include <span>
#include <string>
#include <vector>

namespace svt::cli {

Result<void> requireSvt(const std::filesystem::path& input) {
    SVT_TRY(file, PartFile::open(input));
    SVT_TRY(head, file->read(0, 4096));
    if (volume::looksLikeSvt(std::as_bytes(std::span(*head)))) return {};
    return Error(
        Code::BadVolume,
        "this is not a .svt, so it has no fields; build a volume with 'svt build', then add fields with 'svt field "
        "add'",
        Place{input.string(), 0, 0, {}});
}

Result<fields::Field> readFieldOf(const std::filesystem::path& input, const std::string& name) {
    if (!volume::isSvtFile(input))
        return Error(
            Code::BadArgument,
            fmt::format("{}: --field shows a field of a volume (.svt); build one with svt build, and add the field "
                        "with svt field add",
                        input.string()));
    return fields::readField(input, name);
}

void noteLostFields(const std::filesystem::path& input) {
    if (!volume::isSvtFile(input)) return;
    const auto heads = fields::readFieldHeads(input);
    if (!heads || heads->empty()) return;
    std::vector<std::string> names;
    for (const fields::FieldHead& head : *heads) names.push_back(head.name);
    note(fmt::format("the output does not have the fields of the input: {}", fmt::join(names, ", ")));
}

}  // namespace svt::cli
