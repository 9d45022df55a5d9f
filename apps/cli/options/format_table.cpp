#include <apps/cli/options/format_table.hpp>

#include <apps/cli/options/catalog.hpp>
#include <apps/cli/output/file_content.hpp>

#include <svt/core/text.hpp>
#include <svt/readers/read_model.hpp>
#include <svt/volume_readers/read_label_volume.hpp>

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

namespace svt::cli {
namespace {

struct FormatRow {
    std::string_view name, holds, programs{}, readAs{};
    std::vector<std::string> endings{}, commands{};
};

void addOnce(std::vector<std::string>& to, std::string_view text) {
    if (std::ranges::find(to, text) == to.end()) to.emplace_back(text);
}

// Rows of the table, one per name.
class FormatRows {
public:
    FormatRow& at(std::string_view name, std::string_view endings, std::string_view holds) {
        auto row = std::ranges::find(rows_, name, &FormatRow::name);
        if (row == rows_.end()) row = rows_.insert(rows_.end(), FormatRow{name, holds});
        for (const std::string_view ending : splitChoices(endings)) addOnce(row->endings, ending);
        return *row;
    }
    [[nodiscard]] const std::vector<FormatRow>& all() const noexcept { return rows_; }

private:
    std::vector<FormatRow> rows_;
};

void addOutputs(const CommandText& command, FormatRows& rows) {
    for (const Option& option : command.options())
        for (const std::string_view name : splitChoices(option.formats))
            if (const FileFormat* format = formatOfName(name)) {
                FormatRow& row = rows.at(format->name, format->endings, format->holds);
                row.programs = format->readers;
                addOnce(row.commands, command.name);
            }
}

}  // namespace

writers::Table formatTable() {
    FormatRows rows;
    for (const readers::Format& format : readers::formats())
        rows.at(format.name, format.endings, format.holds).readAs = "model";
    if (const FileFormat* format = formatOfName("svt"))
        rows.at(format->name, format->endings, format->holds).readAs = "volume";
    for (const volume_readers::LabelFormat& format : volume_readers::labelFormats())
        rows.at(format.name, format.endings, format.holds).readAs = "volume";
    for (const CommandText& command : commandTexts()) addOutputs(command, rows);

    writers::Table table{{{"name", "format"},
                          {"endings", "endings"},
                          {"readAs", "read as"},
                          {"writtenBy", "written by"},
                          {"content", "content"},
                          {"programs"}},
                         {}};
    const auto orEmpty = [](std::string_view text) { return text.empty() ? writers::Cell() : writers::Cell(text); };
    for (const FormatRow& row : rows.all())
        table.rows.push_back({row.name, row.endings, orEmpty(row.readAs),
                              row.commands.empty() ? writers::Cell() : writers::Cell(row.commands), row.holds,
                              orEmpty(row.programs)});
    return table;
}

}  // namespace svt::cli
