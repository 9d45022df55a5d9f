#include <svt/writers/xlsx_file.hpp>

#include <svt/core/bytes.hpp>
#include <svt/core/deflate.hpp>
#include <svt/core/file.hpp>
#include <svt/core/machine.hpp>
#include <svt/core/text.hpp>

#include <fmt/format.h>
#include <xlsxwriter.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

namespace svt::writers {
namespace {

constexpr const char* kXlsxLibrary = "libxlsxwriter.so.4";
constexpr std::size_t kMostRows = LXW_ROW_MAX, kMostColumns = LXW_COL_MAX, kMostCharacters = 32767;
constexpr std::size_t kLeastWidth = 8, kMostWidth = 44;  // characters
constexpr time_t kCreated = 946684800;                   // 2000-01-01, as in PDF

// The functions of the library, under its names.
struct Xlsx {
    decltype(&::workbook_new_opt) newWorkbook = nullptr;
    decltype(&::workbook_close) close = nullptr;
    decltype(&::workbook_set_properties) setProperties = nullptr;
    decltype(&::workbook_add_worksheet) addSheet = nullptr;
    decltype(&::workbook_add_format) addFormat = nullptr;
    decltype(&::format_set_bold) setBold = nullptr;
    decltype(&::format_set_text_wrap) setWrap = nullptr;
    decltype(&::format_set_num_format) setNumberFormat = nullptr;
    decltype(&::worksheet_write_number) writeNumber = nullptr;
    decltype(&::worksheet_write_string) writeString = nullptr;
    decltype(&::worksheet_write_boolean) writeTruth = nullptr;
    decltype(&::worksheet_set_column) setColumn = nullptr;
    decltype(&::worksheet_freeze_panes) freeze = nullptr;
    decltype(&::worksheet_autofilter) filter = nullptr;
    decltype(&::lxw_strerror) errorText = nullptr;
};

Result<Xlsx> loadXlsx() {
    const Result<SharedLibrary> library = SharedLibrary::load(kXlsxLibrary);
    if (!library)
        return Error(Code::CannotWrite, fmt::format("XLSX needs the libxlsxwriter library ({}); install it (Debian: "
                                                    "libxlsxwriter4), or write the table as CSV",
                                                    library.error().message()));
    Xlsx xlsx;
    const bool isWhole =
        library->find("workbook_new_opt", xlsx.newWorkbook) && library->find("workbook_close", xlsx.close) &&
        library->find("workbook_set_properties", xlsx.setProperties) &&
        library->find("workbook_add_worksheet", xlsx.addSheet) &&
        library->find("workbook_add_format", xlsx.addFormat) && library->find("format_set_bold", xlsx.setBold) &&
        library->find("format_set_text_wrap", xlsx.setWrap) &&
        library->find("format_set_num_format", xlsx.setNumberFormat) &&
        library->find("worksheet_write_number", xlsx.writeNumber) &&
        library->find("worksheet_write_string", xlsx.writeString) &&
        library->find("worksheet_write_boolean", xlsx.writeTruth) &&
        library->find("worksheet_set_column", xlsx.setColumn) && library->find("worksheet_freeze_panes", xlsx.freeze) &&
        library->find("worksheet_autofilter", xlsx.filter) && library->find("lxw_strerror", xlsx.errorText);
    if (!isWhole) return Error(Code::CannotWrite, fmt::format("{} lacks functions of libxlsxwriter 1.1", kXlsxLibrary));
    return xlsx;
}

// Valid UTF-8 without the characters that XML forbids; the library escapes control characters.
std::string cleanText(std::string_view text) {
    std::string clean;
    while (!text.empty()) {
        const Utf8Character character = firstCharacter(text);
        const bool isBad = character.size == 0 || character.code == 0 || (character.code & 0xFFFEu) == 0xFFFEu;
        if (isBad)
            appendUtf8(0xFFFD, clean);
        else
            clean += text.substr(0, character.size);
        text.remove_prefix(std::max<std::size_t>(character.size, 1));
    }
    return clean;
}

std::optional<double> xlsxNumber(const Cell& cell) {
    if (const auto* whole = std::get_if<std::int64_t>(&cell.value)) return double(*whole);
    if (const auto* small = std::get_if<float>(&cell.value)) return double(*small);
    if (const auto* number = std::get_if<double>(&cell.value)) return *number;
    return {};
}

/// A workbook in a file of its own folder.
class Workbook {
public:
    Workbook(const Xlsx& xlsx, const std::filesystem::path& file, std::string folder)
        : xlsx_(xlsx), folder_(std::move(folder)) {
        lxw_workbook_options options{};
        options.tmpdir = folder_.data();
        book_ = xlsx_.newWorkbook(file.c_str(), &options);
    }
    Workbook(const Workbook&) = delete;
    Workbook& operator=(const Workbook&) = delete;
    ~Workbook() {
        if (book_ != nullptr) xlsx_.close(book_);
    }

    [[nodiscard]] Result<void> begin(std::string title) {
        if (book_ == nullptr) return Error(Code::CannotWrite, "libxlsxwriter cannot make a workbook");
        title = cleanText(title);
        char application[] = "svt";
        lxw_doc_properties properties{};
        properties.title = title.data();
        properties.author = application;
        properties.created = kCreated;
        SVT_DO(keep(xlsx_.setProperties(book_, &properties)));
        bold_ = xlsx_.addFormat(book_);
        xlsx_.setBold(bold_);
        xlsx_.setWrap(bold_);
        return {};
    }

    [[nodiscard]] Result<void> add(const XlsxSheet& sheet) {
        if (sheet.table.rows.size() >= kMostRows || sheet.table.columns.size() > kMostColumns)
            return Error(
                Code::CannotWrite,
                fmt::format("the sheet '{}' has {} rows and {} columns, XLSX at most {} with the headings and "
                            "{}; write the table as CSV",
                            sheet.name, sheet.table.rows.size(), sheet.table.columns.size(), kMostRows, kMostColumns));
        lxw_worksheet* page = xlsx_.addSheet(book_, sheet.name.c_str());
        if (page == nullptr) return Error(Code::CannotWrite, "libxlsxwriter refuses the sheet '" + sheet.name + "'");
        for (std::size_t c = 0; c < sheet.table.columns.size(); ++c) {
            SVT_DO(writeText(page, 0, c, sheet.headings[c], bold_));
            std::size_t width = std::max(kLeastWidth, characterCount(sheet.headings[c]) / 2 + 3);
            for (std::size_t r = 0; r < sheet.table.rows.size(); ++r) {
                const Cell& cell = sheet.table.rows[r][c];
                SVT_DO(write(page, r + 1, c, cell, sheet.table.columns[c].decimals));
                if (!xlsxNumber(cell)) width = std::max(width, characterCount(cellText(cell)) + 1);
            }
            const auto column = lxw_col_t(c);
            SVT_DO(keep(xlsx_.setColumn(page, column, column, double(std::min(width, kMostWidth)), nullptr)));
        }
        xlsx_.freeze(page, 1, 0);
        if (!sheet.hasFilter || sheet.table.columns.empty()) return {};
        return keep(xlsx_.filter(page, 0, 0, lxw_row_t(std::max<std::size_t>(sheet.table.rows.size(), 1)),
                                 lxw_col_t(sheet.table.columns.size() - 1)));
    }

    [[nodiscard]] Result<void> end() { return keep(xlsx_.close(std::exchange(book_, nullptr))); }

private:
    [[nodiscard]] Result<void> keep(lxw_error error) const {
        if (error == LXW_NO_ERROR) return {};
        return Error(Code::CannotWrite, fmt::format("libxlsxwriter: {}; check the space in the folder of temporary "
                                                    "files, or write the table as CSV",
                                                    xlsx_.errorText(error)));
    }

    [[nodiscard]] Result<void> write(lxw_worksheet* page, std::size_t row, std::size_t column, const Cell& cell,
                                     int decimals) {
        const auto r = lxw_row_t(row);
        const auto c = lxw_col_t(column);
        if (const auto number = xlsxNumber(cell)) {
            if (!std::isfinite(*number)) return {};
            const bool isWhole = std::holds_alternative<std::int64_t>(cell.value);
            return keep(xlsx_.writeNumber(page, r, c, *number, numberFormat(isWhole ? 0 : decimals)));
        }
        if (const auto* truth = std::get_if<bool>(&cell.value))
            return keep(xlsx_.writeTruth(page, r, c, *truth ? 1 : 0, nullptr));
        return writeText(page, row, column, cellText(cell), nullptr);
    }

    [[nodiscard]] Result<void> writeText(lxw_worksheet* page, std::size_t row, std::size_t column,
                                         const std::string& text, lxw_format* format) {
        if (text.empty()) return {};
        if (characterCount(text) > kMostCharacters)
            return Error(Code::CannotWrite, fmt::format("a text has more than {} characters, which XLSX cannot have; "
                                                        "write the table as CSV",
                                                        kMostCharacters));
        return keep(xlsx_.writeString(page, lxw_row_t(row), lxw_col_t(column), cleanText(text).c_str(), format));
    }

    lxw_format* numberFormat(int decimals) {
        const auto [it, isNew] = numberFormats_.try_emplace(decimals, nullptr);
        if (isNew) {
            it->second = xlsx_.addFormat(book_);
            const std::string text = decimals <= 0 ? "0" : "0." + std::string(std::size_t(decimals), '0');
            xlsx_.setNumberFormat(it->second, text.c_str());
        }
        return it->second;
    }

    const Xlsx& xlsx_;
    std::string folder_;
    lxw_workbook* book_ = nullptr;
    lxw_format* bold_ = nullptr;
    std::map<int, lxw_format*> numberFormats_;
};

std::uint32_t wordAt(std::span<const std::byte> bytes, std::size_t at) { return loadBytes<std::uint32_t>(bytes, at); }
std::size_t shortAt(std::span<const std::byte> bytes, std::size_t at) { return loadBytes<std::uint16_t>(bytes, at); }

// Whether an XML document ends with the end of its root element.
bool isWholeXml(std::string_view text) {
    const std::size_t root = text.find('<', text.find("?>"));
    if (root == std::string_view::npos) return false;
    const std::string_view name = text.substr(root + 1, text.find_first_of(" >\n", root) - root - 1);
    while (!text.empty() && text.back() == '\n') text.remove_suffix(1);
    return text.ends_with(fmt::format("</{}>", name));
}

// The library does not check that it could write its temporary files, so that a full disk gives sheets that are cut off.
// \return whether each document of the ZIP file is whole
bool isWholeWorkbook(std::span<const std::byte> bytes) {
    constexpr std::size_t kEndSize = 22, kDirectorySize = 46, kLocalSize = 30;
    constexpr std::uint32_t kEnd = 0x06054b50, kDirectory = 0x02014b50;
    constexpr std::size_t kStored = 0, kDeflated = 8;
    if (bytes.size() < kEndSize || wordAt(bytes, bytes.size() - kEndSize) != kEnd) return false;
    const std::size_t end = bytes.size() - kEndSize, count = shortAt(bytes, end + 10);
    std::size_t at = wordAt(bytes, end + 16);
    for (std::size_t n = 0; n < count; ++n) {
        if (at > end || end - at < kDirectorySize || wordAt(bytes, at) != kDirectory) return false;
        const std::size_t method = shortAt(bytes, at + 10), packed = wordAt(bytes, at + 20),
                          size = wordAt(bytes, at + 24), local = wordAt(bytes, at + 42);
        if (local > end || end - local < kLocalSize) return false;
        const std::size_t begin = local + kLocalSize + shortAt(bytes, local + 26) + shortAt(bytes, local + 28);
        if (begin > end || packed > end - begin) return false;
        std::span<const std::byte> data = bytes.subspan(begin, packed);
        Inflated inflated;
        if (method == kDeflated) {
            inflated = inflateBytes(data, DeflateFormat::Raw, size, size);
            if (inflated.status != InflateStatus::Done) return false;
            data = inflated.bytes;
        } else if (method != kStored) {
            return false;
        }
        if (data.size() != size || zipChecksum(data) != wordAt(bytes, at + 16)) return false;
        if (!isWholeXml({reinterpret_cast<const char*>(data.data()), data.size()})) return false;
        at += kDirectorySize + shortAt(bytes, at + 28) + shortAt(bytes, at + 30) + shortAt(bytes, at + 32);
    }
    return count > 0;
}

}  // namespace

Result<std::string> makeXlsx(std::span<const XlsxSheet> sheets, const std::string& title) {
    static const Result<Xlsx> xlsx = loadXlsx();
    if (!xlsx) return xlsx.error();
    const PrivateFolder folder;
    if (folder.path().empty())
        return Error(Code::CannotWrite, "cannot create a folder for temporary files; set TMPDIR to a writable folder");
    const std::filesystem::path file = folder.path() / "book.xlsx";
    {
        Workbook book(*xlsx, file, folder.path().string());
        SVT_DO(book.begin(title));
        for (const XlsxSheet& sheet : sheets) SVT_DO(book.add(sheet));
        SVT_DO(book.end());
    }
    SVT_TRY(bytes, FileBytes::read(file));
    if (!isWholeWorkbook(bytes->bytes()))
        return Error(Code::CannotWrite,
                     "the workbook is cut off: the folder of temporary files (TMPDIR) is full, or "
                     "files may not be that long; write the table as CSV, or free space");
    return std::string(bytes->text());
}

}  // namespace svt::writers
