#include <apps/cli/options/field_input.hpp>

#include <svt/fields/svt_fields.hpp>
#include <svt/volume/svt_file.hpp>

#include <fmt/format.h>

namespace svt::cli {

Result<fields::Field> readFieldOf(const std::filesystem::path& input, const std::string& name) {
    if (!volume::isSvtFile(input))
        return Error(
            Code::BadArgument,
            fmt::format("{}: --field shows a field of a volume (.svt); build one with svt build, and add the field "
                        "with svt field add",
                        input.string()));
    return fields::readField(input, name);
}

}  // namespace svt::cli
