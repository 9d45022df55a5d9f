// Files that svt wrote, damaged: each becomes the same volume, or the damage is reported.
#include <svt/core/temporary_folder_test.hpp>
#include <svt/volume/sample_volume_test.hpp>
#include <svt/volume/volume_json.hpp>
#include <svt/volume_readers/read_label_volume.hpp>
#include <svt/writers/volume_formats.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace svt::volume_readers {
namespace {

namespace fs = std::filesystem;
using svt::test::readText;
using svt::test::TemporaryFolder;
using svt::test::writeText;
using volume::SemanticVolume;

constexpr std::uint64_t kMemory = std::uint64_t{64} << 20;

/// The sample volume, its grid along the axes of the world.
SemanticVolume plainVolume(Vec3i dimension = {12, 9, 8}) {
    SemanticVolume volume = volume::test::sampleVolume(dimension);
    volume.grid = *volume::Grid::fromParts(dimension, {0.05, 0.1, 1.0 / 3.0}, {458877.03, 5438353.7, -0.1},
                                           {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}});
    return volume;
}

/// What comes of reading: the volume, an error, or findings beside a volume.
struct Answer {
    std::optional<SemanticVolume> volume;
    std::string told;

    [[nodiscard]] bool isSilent(const SemanticVolume& expected) const {
        return told.empty() && !volume::test::isSame(*volume, expected);
    }
};

Answer ask(const fs::path& path) {
    Diagnostics findings;
    Answer answer;
    auto read = readLabelVolume(path, {{}, kMemory, nullptr, &findings});
    for (const Diagnostic& finding : findings.items()) answer.told += finding.toString() + "\n";
    if (read)
        answer.volume = std::move(*read);
    else
        answer.told += read.error().toString();
    return answer;
}

/// A fixed sequence of numbers.
class Sequence {
public:
    std::size_t below(std::size_t count) {
        state_ = state_ * 6364136223846793005u + 1442695040888963407u;
        return static_cast<std::size_t>((state_ >> 33) % count);
    }

private:
    std::uint64_t state_ = 20240229;
};

/// Cuts, appends to and changes `file`, and asks for the volume at `path` each time.
void damageAndAsk(const fs::path& file, const fs::path& path, const SemanticVolume& expected, int flips) {
    const std::string whole = readText(file);
    const auto expectTold = [&](const std::string& damaged, const std::string& what) {
        writeText(file, damaged);
        EXPECT_FALSE(ask(path).isSilent(expected)) << file.filename() << " " << what;
    };
    for (std::size_t step = 0; step < 24; ++step) {
        const std::size_t at = whole.size() * step / 24;
        expectTold(whole.substr(0, at), "cut at " + std::to_string(at));
    }
    for (const std::size_t less : {1u, 2u, 3u, 9u})
        if (less < whole.size()) expectTold(whole.substr(0, whole.size() - less), "cut by " + std::to_string(less));
    for (const std::string& more : {std::string("x"), std::string(16, '\0'), std::string(1000, '7'), whole})
        expectTold(whole + more, "with " + std::to_string(more.size()) + " more bytes");
    Sequence random;
    for (int n = 0; n < flips; ++n) {
        std::string damaged = whole;
        const std::size_t at = random.below(whole.size()), bit = random.below(8);
        damaged[at] = static_cast<char>(damaged[at] ^ (1 << bit));
        expectTold(damaged, "byte " + std::to_string(at) + ", bit " + std::to_string(bit));
    }
    writeText(file, whole);
    EXPECT_TRUE(ask(path).told.empty()) << ask(path).told;
}

TEST(Damage, OfAFileIsNeverReadInSilence) {
    const TemporaryFolder folder;
    for (const bool isCompressed : {false, true})
        for (const char* name : {"v.nrrd", "v.seg.nrrd", "v.vti", "v.nii", "v.nii.gz", "v.tif", "v.ome.tif"}) {
            writers::VolumeWriteOptions options;
            options.isCompressed = isCompressed;
            ASSERT_TRUE(writers::writeVolume(plainVolume(), folder / name, options));
            const Answer whole = ask(folder / name);
            ASSERT_TRUE(whole.volume && whole.told.empty()) << name << ": " << whole.told;
            damageAndAsk(folder / name, folder / name, *whole.volume, 150);
        }
}

TEST(Damage, OfATurnedGridIsNeverReadInSilence) {
    const TemporaryFolder folder;
    for (const char* name : {"v.nrrd", "v.vti", "v.nii", "v.tif"}) {
        ASSERT_TRUE(writers::writeVolume(volume::test::sampleVolume({12, 9, 8}), folder / name));
        const Answer whole = ask(folder / name);
        ASSERT_TRUE(whole.volume && whole.told.empty()) << name << ": " << whole.told;
        damageAndAsk(folder / name, folder / name, *whole.volume, 100);
    }
}

/// All files of a folder, in the order of their names.
std::vector<fs::path> filesOf(const fs::path& folder) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (entry.is_regular_file()) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

TEST(Damage, OfACityGmlDocumentAndWhatStandsBesideItIsNeverReadInSilence) {
    for (const auto texture :
         {writers::TextureKind::Pixel, writers::TextureKind::Image, writers::TextureKind::Composed}) {
        const TemporaryFolder folder;
        writers::VolumeWriteOptions options;
        options.texture = texture;
        ASSERT_TRUE(writers::writeVolume(plainVolume(), folder / "v.ade.gml", options));
        const Answer whole = ask(folder / "v.ade.gml");
        ASSERT_TRUE(whole.volume && whole.told.empty()) << whole.told;
        for (const fs::path& file : filesOf(folder.path())) {
            damageAndAsk(file, folder / "v.ade.gml", *whole.volume, file.extension() == ".gml" ? 200 : 40);
            const std::string text = readText(file);
            fs::remove(file);
            EXPECT_FALSE(ask(folder / "v.ade.gml").volume) << file << " is gone";
            writeText(file, text);
        }
    }
}

TEST(Damage, OfAZarrFolderIsNeverReadInSilence) {
    for (const int version : {2, 3}) {
        const TemporaryFolder folder;
        writers::VolumeWriteOptions options;
        options.zarr.version = version;
        ASSERT_TRUE(writers::writeVolume(plainVolume({40, 34, 66}), folder / "v.zarr", options));
        const Answer whole = ask(folder / "v.zarr");
        ASSERT_TRUE(whole.volume && whole.told.empty()) << whole.told;
        for (const fs::path& file : filesOf(folder / "v.zarr")) {
            damageAndAsk(file, folder / "v.zarr", *whole.volume, 60);
            const std::string text = readText(file);
            fs::remove(file);
            EXPECT_FALSE(ask(folder / "v.zarr").isSilent(*whole.volume)) << file << " is gone";
            writeText(file, text);
        }
    }
}

// ------------------------------------------------------------------------------------------------- what is told

TEST(Damage, ALostChunkIsNamedByItsLabelsAndTheirVoxels) {
    const TemporaryFolder folder;
    const SemanticVolume volume = plainVolume();
    ASSERT_TRUE(writers::writeVolume(volume, folder / "v.zarr"));
    for (const fs::path& file : filesOf(folder / "v.zarr"))
        if (file.filename() == "0") fs::remove(file);
    const auto read = readLabelVolume(folder / "v.zarr");
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().code(), Code::BadChecksum);
    EXPECT_EQ(read.error().where().file, (folder / "v.zarr").string());
    for (const std::string& part :
         {std::string("of 5 labels 3 differ"),
          std::string("'room-1' has 0 voxels, the table says ") + std::to_string(volume.labels.labels[1].voxels),
          std::string("'wall'"), std::string("'room-2'"), std::string("--labels")})
        EXPECT_NE(read.error().message().find(part), std::string::npos) << read.error().message();
}

std::string withoutLine(std::string text, std::string_view begin) {
    const std::size_t at = text.find("\n" + std::string(begin));
    return text.erase(at, text.find('\n', at + 1) - at);
}

/// A raw NRRD of svt.
std::string nrrdOf(const SemanticVolume& volume, const TemporaryFolder& folder) {
    writers::VolumeWriteOptions options;
    options.isCompressed = false;
    EXPECT_TRUE(writers::writeVolume(volume, folder / "raw.nrrd", options));
    return readText(folder / "raw.nrrd");
}

TEST(Damage, FilesWithoutSealAreReadAndTheirVoxelsCompared) {
    const TemporaryFolder folder;
    const SemanticVolume volume = plainVolume();
    std::string text = withoutLine(nrrdOf(volume, folder), "svt_seal");
    writeText(folder / "v.nrrd", text);
    const Answer whole = ask(folder / "v.nrrd");
    ASSERT_TRUE(whole.volume) << whole.told;
    EXPECT_TRUE(whole.volume->columns == volume.columns);
    const std::size_t at = text.size() - 12 * 9 * 3;  // background of slice 5, row 0
    ASSERT_EQ(text[at], '\0');
    text[at] = 5;
    writeText(folder / "v.nrrd", text);
    const auto read = readLabelVolume(folder / "v.nrrd");
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().code(), Code::BadChecksum);
    EXPECT_NE(read.error().message().find("of 5 labels 1 differ: 'room-2' has"), std::string::npos)
        << read.error().message();
}

TEST(Damage, ATableThatIsGivenIsTakenAsItIs) {
    const TemporaryFolder folder;
    const SemanticVolume volume = plainVolume();
    std::string text = nrrdOf(volume, folder);
    text[text.size() - 12 * 9 * 3] = 5;
    writeText(folder / "v.nrrd", text);
    ASSERT_FALSE(readLabelVolume(folder / "v.nrrd"));
    writeText(folder / "labels.json", volume::writeLabelsJson(volume.labels));
    const auto read = readLabelVolume(folder / "v.nrrd", {folder / "labels.json"});
    ASSERT_TRUE(read) << read.error().toString();
    EXPECT_EQ(read->labels.labels[3].voxels, volume.labels.labels[3].voxels + 1);
    EXPECT_EQ(read->labels.labels[1].volume, volume.labels.labels[1].volume) << "of its mesh: no voxel is missing";
    EXPECT_TRUE(read->grid == volume.grid);
}

TEST(Damage, AnImageThatWasCutIsToldAndCountedAgain) {
    const TemporaryFolder folder;
    const SemanticVolume volume = plainVolume();
    std::string text = nrrdOf(volume, folder);
    const std::size_t sizes = text.find("sizes: 12 9 8");
    text.replace(sizes, 13, "sizes: 12 9 4");
    text.resize(text.size() - 12 * 9 * 4);
    writeText(folder / "v.nrrd", text);
    const Answer cut = ask(folder / "v.nrrd");
    ASSERT_TRUE(cut.volume) << cut.told;
    EXPECT_NE(cut.told.find("12 x 9 x 8 samples, now 12 x 9 x 4"), std::string::npos) << cut.told;
    const auto voxels = cut.volume->columns.countVoxels(6);
    EXPECT_EQ(cut.volume->labels.labels[1].voxels, voxels[1]);
    EXPECT_LT(voxels[1], volume.labels.labels[1].voxels);
}

TEST(Damage, HeadersOfNrrdThatContradictThemselvesAreRefused) {
    const TemporaryFolder folder;
    const std::string samples(8, '\1');
    const auto messageOf = [&](const std::string& fields, const std::string& data) {
        writeText(folder / "v.nrrd", "NRRD0004\ntype: uchar\ndimension: 3\nencoding: raw\n" + fields + "\n\n" + data);
        const auto read = readLabelVolume(folder / "v.nrrd");
        if (!read) {
            EXPECT_EQ(read.error().code(), Code::BadNrrd) << read.error().toString();
        }
        return read ? std::string() : read.error().message();
    };
    EXPECT_EQ(messageOf("sizes: 2 2 2", samples), "");
    EXPECT_NE(messageOf("sizes: 2 2 2 1", samples).find("more than three"), std::string::npos);
    EXPECT_NE(messageOf("sizes: 2 2 2\nspacings: 1 1 1 1", samples).find("more than three"), std::string::npos);
    EXPECT_NE(messageOf("sizes: 2 2 2\nspace directions: (1,0,0) (0,1,0) (0,0,1) (0,0,1)", samples).find("more than"),
              std::string::npos);
    EXPECT_NE(messageOf("sizes: 2 2 2\nspace origin: (1,0,0,7)", samples).find("origin"), std::string::npos);
    EXPECT_NE(messageOf("sizes: 2 2 2\nsizes: 2 2 2", samples).find("twice"), std::string::npos);
    EXPECT_NE(messageOf("sizes: 2 2 2", samples + "abc").find("3 bytes stand behind"), std::string::npos);
    EXPECT_NE(messageOf("sizes: 2 2 3", samples).find("8 bytes of samples found, 12 expected"), std::string::npos);
}

TEST(Damage, TheEndOfGzipSamplesIsChecked) {
    const TemporaryFolder folder;
    ASSERT_TRUE(writers::writeVolume(plainVolume(), folder / "v.nrrd"));
    const std::string whole = readText(folder / "v.nrrd");
    ASSERT_NE(whole.find("encoding: gzip"), std::string::npos);
    for (std::size_t back = 1; back <= 8; ++back) {
        std::string damaged = whole;
        damaged[whole.size() - back] = static_cast<char>(damaged[whole.size() - back] ^ 4);
        writeText(folder / "v.nrrd", damaged);
        EXPECT_NE(ask(folder / "v.nrrd").told.find("compressed samples are damaged"), std::string::npos)
            << ask(folder / "v.nrrd").told;
        writeText(folder / "v.nrrd", whole.substr(0, whole.size() - back));
        EXPECT_FALSE(ask(folder / "v.nrrd").volume);
    }
    writeText(folder / "v.nrrd", whole + "more");
    EXPECT_NE(ask(folder / "v.nrrd").told.find("4 bytes stand behind"), std::string::npos)
        << ask(folder / "v.nrrd").told;
}

TEST(Damage, MatricesOfGeoTiffThatAreNoneAreRefused) {
    const TemporaryFolder folder;
    ASSERT_TRUE(writers::writeVolume(plainVolume(), folder / "v.tif"));
    const std::string whole = readText(folder / "v.tif");
    const std::string tag("\xD8\x85\x0C\x00\x10\x00\x00\x00", 8);  // 34264, double, 16
    const std::size_t entry = whole.find(tag);
    ASSERT_NE(entry, std::string::npos);
    std::uint32_t matrix = 0;
    std::memcpy(&matrix, whole.data() + entry + 8, 4);
    const auto answerOf = [&](std::size_t at, double value) {
        std::string damaged = whole;
        std::memcpy(damaged.data() + matrix + 8 * at, &value, 8);
        writeText(folder / "v.tif", damaged);
        return ask(folder / "v.tif");
    };
    for (const double value : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
        for (const std::size_t at : {0u, 3u, 7u, 10u, 12u, 15u}) {
            const Answer answer = answerOf(at, value);
            EXPECT_FALSE(answer.volume) << at;
            EXPECT_NE(answer.told.find("number " + std::to_string(at) + " of the matrix"), std::string::npos)
                << answer.told;
        }
    EXPECT_FALSE(answerOf(0, 0).volume) << "singular";
    EXPECT_FALSE(answerOf(15, 2).volume);
    std::string damaged = whole;
    damaged[entry + 4] = 12;
    writeText(folder / "v.tif", damaged);
    EXPECT_NE(ask(folder / "v.tif").told.find("has 12 numbers, 16"), std::string::npos) << ask(folder / "v.tif").told;
}

TEST(Damage, ATableThatTheHeaderOfNiftiHidesIsTold) {
    const TemporaryFolder folder;
    SemanticVolume volume = plainVolume();
    volume.grid = *volume::Grid::fromParts({12, 9, 8}, {0.5, 0.5, 0.5}, {0, 0, 0}, volume.grid.axes());
    ASSERT_TRUE(writers::writeVolume(volume, folder / "v.nii"));
    std::string text = readText(folder / "v.nii");
    ASSERT_EQ(text[348], '\1') << "NIfTI-1, with extensions";
    text[348] = '\0';
    writeText(folder / "v.nii", text);
    const Answer answer = ask(folder / "v.nii");
    ASSERT_TRUE(answer.volume) << answer.told;
    EXPECT_NE(answer.told.find("not a readable extension"), std::string::npos) << answer.told;
}

// ------------------------------------------------------------------------------------ tables in files without seal

/// The labels of a volume as rows of a table.
std::vector<std::string> rowsOf(const SemanticVolume& volume) {
    std::vector<std::string> rows;
    for (const volume::Label& label : volume.labels.labels)
        volume::appendJsonLabel(rows.emplace_back(), label, volume::JsonCharacters::AsciiOnly);
    return rows;
}

std::string jsonOf(const std::vector<std::string>& rows) {
    std::string text;
    for (const std::string& row : rows) text += (text.empty() ? "" : ",\n") + row;
    return "{\"labels\":[" + text + "],\"overlaps\":[],\"phaseColors\":[]}\n";
}

/// A key for each row that is not empty.
std::string nrrdWithRows(std::string text, const std::vector<std::string>& rows) {
    text = withoutLine(std::move(text), "svt_seal");
    while (text.find("\nsvt_label_") != std::string::npos && text.find("\nsvt_label_") < text.find("\n\n"))
        text = withoutLine(std::move(text), "svt_label_");
    std::string lines = "svt_label_count:=" + std::to_string(rows.size()) + "\n";
    for (std::size_t row = 0; row < rows.size(); ++row) {
        if (rows[row].empty()) continue;
        lines += "svt_label_" + std::to_string(row) + ":=";
        for (const char c : rows[row]) lines += c == '\\' ? "\\\\" : std::string(1, c);
        lines += '\n';
    }
    return text.insert(text.find("\n\n") + 1, lines);
}

std::string vtiWithRows(std::string text, const std::vector<std::string>& rows) {
    const auto elementOf = [&](const std::string& name) {
        const std::size_t begin = text.rfind("<Array", text.find("Name=\"" + name + "\""));
        return std::pair(begin, text.find("</Array>", begin) - begin);
    };
    const auto [seal, sealSize] = elementOf("svt_seal");
    text.erase(seal, sealSize + std::strlen("</Array>"));
    const auto [table, tableSize] = elementOf("svt_labels");
    std::string numbers = R"(<Array type="String" Name="svt_labels" NumberOfTuples="1" format="ascii">)";
    for (const char c : jsonOf(rows)) numbers += std::to_string(static_cast<unsigned char>(c)) + " ";
    return text.replace(table, tableSize, numbers + "0 ");
}

/// The table stands behind the rest of the file; the tag of the seal becomes one that nobody knows.
std::string tiffWithRows(std::string text, const std::vector<std::string>& rows) {
    const auto number = [&](std::size_t at, std::size_t size) {
        std::uint32_t value = 0;
        std::memcpy(&value, text.data() + at, size);
        return value;
    };
    const std::size_t page = number(4, 4);
    const std::string table = jsonOf(rows) + '\0';
    const auto size = static_cast<std::uint32_t>(table.size()), place = static_cast<std::uint32_t>(text.size());
    for (std::size_t entry = 0; entry < number(page, 2); ++entry) {
        const std::size_t at = page + 2 + 12 * entry, tag = number(at, 2);
        if (tag == 65082) text[at] = static_cast<char>(text[at] + 1);
        if (tag != 65081) continue;
        std::memcpy(text.data() + at + 4, &size, 4);
        std::memcpy(text.data() + at + 8, &place, 4);
    }
    return text + table;
}

/// Formats in which a table without seal can be written with rows of any content.
struct TableFormat {
    const char* name;
    std::string (*withRows)(std::string text, const std::vector<std::string>& rows);
};
constexpr TableFormat kTableFormats[] = {{"v.nrrd", nrrdWithRows}, {"v.vti", vtiWithRows}, {"v.tif", tiffWithRows}};

/// The sample volume in each format, with rows in place of its table.
class TableFiles {
public:
    TableFiles() {
        volume.labels.overlaps.clear();
        volume.labels.phaseColors.clear();
        writers::VolumeWriteOptions options;
        options.isCompressed = false;
        for (const TableFormat& format : kTableFormats) {
            EXPECT_TRUE(writers::writeVolume(volume, folder_ / format.name, options));
            texts_.push_back(readText(folder_ / format.name));
        }
    }

    /// Answers of all formats to a table.
    std::vector<std::pair<std::string, Answer>> ask(const std::vector<std::string>& rows) {
        std::vector<std::pair<std::string, Answer>> answers;
        for (std::size_t n = 0; n < texts_.size(); ++n) {
            const fs::path path = folder_ / kTableFormats[n].name;
            writeText(path, kTableFormats[n].withRows(texts_[n], rows));
            answers.emplace_back(kTableFormats[n].name, volume_readers::ask(path));
        }
        return answers;
    }

    /// Expects that each format refuses the table with a message that has `part`.
    void expectRefused(const std::vector<std::string>& rows, const std::string& part, const std::string& what) {
        for (const auto& [name, answer] : ask(rows)) {
            EXPECT_FALSE(answer.volume) << name << ", " << what;
            EXPECT_NE(answer.told.find(part), std::string::npos) << name << ", " << what << ": " << answer.told;
        }
    }

    SemanticVolume volume = plainVolume();

private:
    TemporaryFolder folder_;
    std::vector<std::string> texts_;
};

std::string replaced(std::string text, const std::string& part, const std::string& by) {
    const std::size_t at = text.find(part);
    EXPECT_NE(at, std::string::npos) << part << " in " << text;
    return at == std::string::npos ? text : text.replace(at, part.size(), by);
}

TEST(Damage, TablesWithoutSealAreReadWhereTheyFitTheSamples) {
    TableFiles files;
    for (const auto& [name, answer] : files.ask(rowsOf(files.volume))) {
        ASSERT_TRUE(answer.volume) << name << ": " << answer.told;
        EXPECT_TRUE(answer.told.empty()) << name << ": " << answer.told;
        EXPECT_TRUE(volume::test::isSame(*answer.volume, files.volume)) << name;
    }
}

TEST(Damage, RowsWithoutSealThatAreNoLabelsAreRefused) {
    TableFiles files;
    const std::vector<std::string> whole = rowsOf(files.volume);
    const std::string& room = whole[1];
    const std::string voxels = "\"voxels\":" + std::to_string(files.volume.labels.labels[1].voxels);
    for (const std::string& row : {room.substr(0, room.size() - 1),
                                   room.substr(0, room.size() / 2),
                                   room + "}",
                                   room + ",",
                                   std::string("null"),
                                   std::string("7"),
                                   std::string("\"room-1\""),
                                   std::string("[]"),
                                   std::string("{}"),
                                   replaced(room, "\"room-1\"", "7"),
                                   replaced(room, "\"room-1\"", "\"room-1"),
                                   replaced(room, "\"class\"", "\"klass\""),
                                   replaced(room, "\"solid\"", "\"liquid\""),
                                   replaced(room, voxels, "\"voxels\":-1"),
                                   replaced(room, voxels, "\"voxels\":\"12\""),
                                   replaced(room, voxels, "\"voxels\":1.5"),
                                   replaced(room, voxels, "\"voxels\":1e999"),
                                   replaced(room, voxels, "\"voxels\":nan"),
                                   replaced(room, "\"groups\":[4]", "\"groups\":[5]"),
                                   replaced(room, "\"groups\":[4]", "\"groups\":4"),
                                   replaced(room, "\"parent\":0", "\"parent\":1")}) {
        std::vector<std::string> rows = whole;
        rows[1] = row;
        files.expectRefused(rows, "the table of labels that svt wrote into the file is damaged", row);
    }
}

TEST(Damage, RowsThatAreMissingWithoutSealAreTold) {
    TableFiles files;
    const std::vector<std::string> whole = rowsOf(files.volume);
    for (std::size_t row = 0; row < whole.size(); ++row) {
        std::vector<std::string> rows = whole;
        rows.erase(rows.begin() + static_cast<std::ptrdiff_t>(row));
        files.expectRefused(rows, "the table of labels", "without row " + std::to_string(row));
        files.expectRefused({whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(row)}, "label",
                            "without rows from " + std::to_string(row));
    }
    // The wall is gone and all else fits: its samples have no label.
    std::vector<std::string> rows = whole;
    rows[0] = replaced(rows[0], "\"subtreeEnd\":4", "\"subtreeEnd\":3");
    rows[1] = replaced(replaced(rows[1], "\"subtreeEnd\":3", "\"subtreeEnd\":2"), "\"groups\":[4]", "\"groups\":[3]");
    rows[3] = replaced(replaced(rows[3], "\"subtreeEnd\":4", "\"subtreeEnd\":3"), "\"groups\":[4]", "\"groups\":[3]");
    rows[4] = replaced(rows[4], "\"subtreeEnd\":5", "\"subtreeEnd\":4");
    rows.erase(rows.begin() + 2);
    files.expectRefused(rows, "label", "without the wall");
}

TEST(Damage, KeysOfNrrdThatAreMissingWithoutSealAreTold) {
    TableFiles files;
    // The last row is of a label that no sample and no other row needs.
    SemanticVolume volume = files.volume;
    volume::test::addGroup(volume, "spare", "Storey");
    const std::vector<std::string> whole = rowsOf(volume);
    ASSERT_TRUE(files.ask(whole)[0].second.volume);
    for (std::size_t row = 0; row < whole.size(); ++row) {
        std::vector<std::string> rows = whole;
        rows[row].clear();
        const Answer answer = files.ask(rows)[0].second;
        EXPECT_FALSE(answer.volume) << "without row " << row;
        EXPECT_NE(answer.told.find("the table of labels that svt wrote into the file is missing, or lacks rows"),
                  std::string::npos)
            << answer.told;
    }
}

TEST(Damage, WrongCountsOfVoxelsWithoutSealAreToldWithTheirLabel) {
    TableFiles files;
    const std::vector<std::string> whole = rowsOf(files.volume);
    for (std::size_t row = 0; row < whole.size(); ++row) {
        const volume::Label& label = files.volume.labels.labels[row];
        for (const std::uint64_t wrong :
             {label.voxels + 1, label.voxels + (std::uint64_t{1} << 40), label.voxels / 2}) {
            if (wrong == label.voxels) continue;
            std::vector<std::string> rows = whole;
            rows[row] = replaced(rows[row], "\"voxels\":" + std::to_string(label.voxels),
                                 "\"voxels\":" + std::to_string(wrong));
            files.expectRefused(rows,
                                "of 5 labels 1 differ: '" + label.id + "' has " + std::to_string(label.voxels) +
                                    " voxels, the table says " + std::to_string(wrong),
                                label.id);
        }
    }
    // Two labels that have each other's voxels.
    std::vector<std::string> rows = whole;
    for (const auto& [from, to] : {std::pair(1, 3), std::pair(3, 1)}) {
        const std::string own = "\"voxels\":" + std::to_string(files.volume.labels.labels[std::size_t(from)].voxels);
        const std::string other = "\"voxels\":" + std::to_string(files.volume.labels.labels[std::size_t(to)].voxels);
        rows[std::size_t(from)] = replaced(whole[std::size_t(from)], own, other);
    }
    files.expectRefused(rows, "of 5 labels 2 differ", "swapped");
}

}  // namespace
}  // namespace svt::volume_readers
