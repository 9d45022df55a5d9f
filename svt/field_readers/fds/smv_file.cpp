#include <svt/field_readers/fds/smv_file.hpp>

#include <svt/core/text.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace svt::field_readers {
namespace {

constexpr std::int32_t kMaxCells = 1 << 20;  // of a mesh along an axis
// FDS lists all nodes. A short text without lists may ask for many.
constexpr std::size_t kMaxMadeNodes = std::size_t{1} << 22;

std::vector<std::string_view> wordsOf(std::string_view text) {
    std::vector<std::string_view> words;
    for (std::size_t at = 0; at < text.size();) {
        while (at < text.size() && isBlank(text[at])) ++at;
        const std::size_t begin = at;
        while (at < text.size() && !isBlank(text[at])) ++at;
        if (at > begin) words.push_back(text.substr(begin, at - begin));
    }
    return words;
}

class SmvParser {
public:
    SmvParser(std::string_view text, const std::filesystem::path& path) : path_(path) {
        for (std::size_t at = 0; at < text.size();) {
            const std::size_t end = std::min(text.find('\n', at), text.size());
            std::string_view line = text.substr(at, end - at);
            if (line.ends_with('\r')) line.remove_suffix(1);
            lines_.push_back(line);
            at = end + 1;
        }
    }

    Result<SmvCase> parse() {
        for (at_ = 0; at_ < lines_.size();) {
            const auto words =
                lines_[at_].empty() || isBlank(lines_[at_][0]) ? std::vector<std::string_view>() : wordsOf(lines_[at_]);
            first_ = at_++;
            if (words.empty()) continue;
            SVT_DO(parseEntry(words[0], words));
        }
        SVT_DO(finishMeshes());
        return std::move(case_);
    }

private:
    Result<void> parseEntry(std::string_view key, const std::vector<std::string_view>& words) {
        if (key == "GRID") return parseGrid();
        if (key == "PDIM") return parseBox();
        if (key == "TRNX" || key == "TRNY" || key == "TRNZ") return parseNodes(static_cast<std::size_t>(key[3] - 'X'));
        if (key == "INPF") return parseText(case_.inputFile);
        if (key == "FDSVERSION") return parseText(case_.version);
        if (key == "CSVF") return parseTable();
        if (key == "DEVICE") return parseDevice();
        if (key == "SLCF") return parseFile(SmvKind::Slice, words);
        if (key == "SLCC") return parseFile(SmvKind::CellSlice, words);
        if (key == "SMOKF3D" || key == "SMOKE3D") return parseFile(SmvKind::Smoke, words);
        if (key == "HRRPUV_MINMAX" || key == "TEMP_MINMAX") return parseRange(std::string(key));
        for (const std::string_view other : {"BNDF", "BNDC", "BNDE", "BNDS", "SLCT", "SLCD", "SMOKG3D", "PRT5", "PL3D",
                                             "ISOF", "TISOF", "ISOG", "PART", "EVAC", "GEOM"})
            if (key == other) ++case_.leftOut[std::string(key)];
        return {};
    }

    [[nodiscard]] Error bad(std::string message, std::size_t line) const {
        return badField(std::move(message), path_, line + 1);
    }

    // The next line; nothing at the end of the file: a run that goes on may still write more.
    std::optional<std::string_view> next() {
        if (at_ >= lines_.size()) {
            case_.isCut = true;
            return std::nullopt;
        }
        return lines_[at_++];
    }

    Result<void> parseText(std::string& to) {
        if (const auto line = next()) to = std::string(withoutBlanks(*line));
        return {};
    }

    Result<void> parseGrid() {
        SmvMesh mesh;
        mesh.name = std::string(withoutBlanks(lines_[first_].substr(4)));
        const auto line = next();
        if (!line) return {};
        const auto words = wordsOf(*line);
        for (int axis = 0; axis < 3; ++axis) {
            const auto cells =
                words.size() < 3 ? std::nullopt : parseInteger<std::int32_t>(words[static_cast<std::size_t>(axis)]);
            if (!cells || *cells < 1 || *cells > kMaxCells)
                return bad(fmt::format("GRID: three numbers of cells are expected, and not '{}'", *line), at_ - 1);
            mesh.cells[axis] = *cells;
        }
        case_.meshes.push_back(std::move(mesh));
        boxes_.emplace_back();
        return {};
    }

    Result<void> parseBox() {
        const auto line = next();
        if (!line) return {};
        if (boxes_.empty()) return bad("PDIM stands before the first GRID", first_);
        std::vector<double> numbers;
        for (const std::string_view word : wordsOf(*line))
            if (const auto number = parseNumber(word)) numbers.push_back(*number);
        if (numbers.size() < 6 || !(numbers[0] < numbers[1] && numbers[2] < numbers[3] && numbers[4] < numbers[5]))
            return bad(fmt::format("PDIM: the bounds of a box are expected, and not '{}'", *line), at_ - 1);
        boxes_.back() = Box3d{{numbers[0], numbers[2], numbers[4]}, {numbers[1], numbers[3], numbers[5]}};
        return {};
    }

    // The places of the nodes of an axis, after a table that is skipped.
    Result<void> parseNodes(std::size_t axis) {
        const auto line = next();
        if (!line) return {};
        if (case_.meshes.empty()) return bad("nodes stand before the first GRID", first_);
        const auto skipped = parseInteger<std::uint32_t>(withoutBlanks(*line));
        if (!skipped) return bad(fmt::format("TRN: a number of lines is expected, and not '{}'", *line), at_ - 1);
        at_ += std::min<std::size_t>(*skipped, lines_.size() - at_);
        std::vector<double>& nodes = case_.meshes.back().nodes[axis];
        nodes.clear();
        for (std::int32_t n = 0; n <= case_.meshes.back().cells[static_cast<int>(axis)]; ++n) {
            const auto row = next();
            if (!row) return {};
            const auto words = wordsOf(*row);
            const auto place = words.size() < 2 ? std::nullopt : parseNumber(words[1]);
            if (!place || (!nodes.empty() && !(*place > nodes.back())))
                return bad(
                    fmt::format("TRN: the number of a node and a place above that of the last node are expected, "
                                "and not '{}'",
                                *row),
                    at_ - 1);
            nodes.push_back(*place);
        }
        return {};
    }

    Result<void> parseTable() {
        const auto kind = next(), file = next();
        if (kind && file && withoutBlanks(*kind) == "devc") case_.deviceFile = std::string(withoutBlanks(*file));
        return {};
    }

    // " name % quantity" and " x y z ...".
    Result<void> parseDevice() {
        const auto name = next(), place = next();
        if (!name || !place) return {};
        const auto words = wordsOf(*place);
        SmvDevice device;
        for (int axis = 0; axis < 3; ++axis) {
            const auto number = words.size() < 3 ? std::nullopt : parseNumber(words[static_cast<std::size_t>(axis)]);
            if (!number) return {};  // a device without a place of its own
            device.at[axis] = *number;
        }
        const std::size_t mark = name->rfind('%');
        if (mark != std::string_view::npos) device.quantity = std::string(withoutBlanks(name->substr(mark + 1)));
        case_.devices[std::string(withoutBlanks(name->substr(0, mark)))] = std::move(device);
        return {};
    }

    Result<void> parseRange(std::string key) {
        const auto line = next();
        if (!line) return {};
        const auto words = wordsOf(*line);
        const auto least = words.size() < 2 ? std::nullopt : parseNumber(words[0]);
        const auto most = words.size() < 2 ? std::nullopt : parseNumber(words[1]);
        if (!least || !most || !(*least < *most))
            return bad(fmt::format("{}: two ascending numbers are expected, and not '{}'", key, *line), at_ - 1);
        case_.ranges[std::move(key)] = {*least, *most};
        return {};
    }

    Result<void> parseFile(SmvKind kind, const std::vector<std::string_view>& words) {
        SmvFile file;
        file.kind = kind;
        file.line = first_ + 1;
        const auto mesh = words.size() < 2 ? std::nullopt : parseInteger<std::uint32_t>(words[1]);
        if (!mesh || *mesh < 1) return bad(fmt::format("the number of a mesh is expected after {}", words[0]), first_);
        file.mesh = *mesh - 1;
        if (kind == SmvKind::Smoke && words.size() > 2) file.extinction = parseNumber(words[2]).value_or(0);
        if (const std::size_t mark = lines_[first_].rfind('!'); mark != std::string_view::npos) {
            const auto numbers = wordsOf(lines_[first_].substr(mark + 1));
            if (!numbers.empty()) file.slice = parseInteger<std::int32_t>(numbers[0]).value_or(-1);
        }
        for (std::string* text : {&file.file, &file.quantity, &file.shortName, &file.unit}) {
            const auto line = next();
            if (!line) return {};
            *text = std::string(withoutBlanks(*line));
        }
        case_.files.push_back(std::move(file));
        return {};
    }

    // Evenly spaced nodes for axes without a list.
    Result<void> finishMeshes() {
        for (std::size_t m = 0; m < case_.meshes.size(); ++m) {
            SmvMesh& mesh = case_.meshes[m];
            for (int axis = 0; axis < 3; ++axis) {
                auto& nodes = mesh.nodes[static_cast<std::size_t>(axis)];
                const auto count = static_cast<std::size_t>(mesh.cells[axis]) + 1;
                if (nodes.size() == count) continue;
                if (!nodes.empty() || boxes_[m].isEmpty())
                    return badField(
                        fmt::format("mesh {} has neither bounds (PDIM) nor places of all nodes (TRN)", m + 1), path_);
                madeNodes_ += count;
                if (madeNodes_ > kMaxMadeNodes)
                    return badField(fmt::format("mesh {} and others have no lists of nodes (TRN)", m + 1), path_);
                for (std::size_t n = 0; n < count; ++n)
                    nodes.push_back(boxes_[m].min[axis] + boxes_[m].size()[axis] * static_cast<double>(n) /
                                                              static_cast<double>(mesh.cells[axis]));
            }
        }
        for (const SmvFile& file : case_.files)
            if (file.mesh >= case_.meshes.size())
                return badField(fmt::format("'{}' belongs to mesh {}, but there are {} meshes", file.file,
                                            file.mesh + 1, case_.meshes.size()),
                                path_, file.line);
        return {};
    }

    const std::filesystem::path& path_;
    std::vector<std::string_view> lines_;
    std::size_t at_ = 0, first_ = 0;
    std::vector<Box3d> boxes_;
    std::size_t madeNodes_ = 0;
    SmvCase case_;
};

}  // namespace

Result<SmvCase> parseSmv(std::string_view text, const std::filesystem::path& path) {
    return SmvParser(text, path).parse();
}

}  // namespace svt::field_readers
