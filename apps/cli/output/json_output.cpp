#include <apps/cli/output/json_output.hpp>

#include <apps/cli/output/messages.hpp>

#include <fmt/format.h>

namespace svt::cli {

Json diagnosticsJson(const Diagnostics& diagnostics) {
    Json list = Json::array();
    for (const Diagnostic& item : diagnostics.items()) {
        Json json{{"severity", severityName(item.severity)},
                  {"code", codeTag(item.code)},
                  {"name", codeName(item.code)},
                  {"message", item.message}};
        if (!item.where.file.empty()) json["file"] = shownText(item.where.file);
        if (item.where.line != 0) json["line"] = item.where.line;
        if (item.where.column != 0) json["column"] = item.where.column;
        if (!item.where.id.empty()) json["id"] = item.where.id;
        list.push_back(std::move(json));
    }
    return list;
}

void print(const Json& json) {
    fmt::print(resultStream(), "{}\n", json.dump(2, ' ', false, Json::error_handler_t::replace));
}

}  // namespace svt::cli
