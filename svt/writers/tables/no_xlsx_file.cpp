#include <svt/writers/xlsx_file.hpp>

namespace svt::writers {

Result<std::string> makeXlsx(std::span<const XlsxSheet> /*sheets*/, const std::string& /*title*/) {
    return Error(Code::CannotWrite, "this build writes no XLSX; write the table as CSV");
}

}  // namespace svt::writers
