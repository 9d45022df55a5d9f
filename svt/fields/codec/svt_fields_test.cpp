#include <svt/fields/svt_fields.hpp>

#include <svt/core/temporary_folder_test.hpp>
#include <svt/volume/sample_volume_test.hpp>
#include <svt/volume/svt_file.hpp>
#include <svt/volume/zip_entries.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace svt::fields {
namespace {

using svt::test::readText;
using svt::test::TemporaryFolder;
using volume::test::isSame;
using volume::test::sampleVolume;

// 150 x 70 x 66 nodes: blocks that are cut off, and three levels.
Field smoothGrid(std::string name = "temperature", Vec3i size = {150, 70, 66}) {
    Field field;
    FieldHead& head = field.head;
    head.name = std::move(name);
    head.quantity = "temperature";
    head.unit = "Cel";
    head.medium = "air";
    head.lattice = {size, {0.5, -1, 0.25}, {1, 1, 0.125}, {}};
    head.times = {0, 60, 90.5};
    head.epoch = "2026-01-05T00:00:00Z";
    head.precision = 0.01;
    head.by = "test";
    head.parameters = R"({"outside":-5,"inside":{"name=Bad":24}})";
    field.values.reserve(placeCount(head, 0) * 3);
    for (int t = 0; t < 3; ++t)
        for (std::int32_t k = 0; k < size.z; ++k)
            for (std::int32_t j = 0; j < size.y; ++j)
                for (std::int32_t i = 0; i < size.x; ++i)
                    field.values.push_back(
                        j == 3   ? std::nanf("")
                        : i < 64 ? 20.0f
                                 : static_cast<float>(20 + 5 * std::sin(0.05 * i) * std::cos(0.03 * j) + t));
    return field;
}

Field pointField() {
    Field field;
    field.head.name = "co2";
    field.head.kind = FieldKind::Points;
    field.head.unit = "[ppm]";
    field.head.times = {0, 900};
    field.head.points = {{"s1", {3.1, 2.2, 1.5}}, {"Fühler 2", {1, 2, 3}}};
    field.values = {400.5f, std::nanf(""), 1e-30f, -7};
    return field;
}

Field labelField() {
    Field field;
    field.head.name = "heating";
    field.head.kind = FieldKind::Label;
    field.head.unit = "W";
    field.head.precision = 0.5;
    field.values = {100, std::nanf(""), 25.5f, 0, -3};
    return field;
}

bool isEqual(float a, float b) { return (std::isnan(a) && std::isnan(b)) || a == b; }

double worstDifference(const Field& a, const Field& b) {
    double worst = a.values.size() == b.values.size() ? 0 : 1e300;
    for (std::size_t v = 0; v < a.values.size() && worst < 1e300; ++v)
        if (!isEqual(a.values[v], b.values[v]))
            worst = std::max(worst, std::abs(double{a.values[v]} - double{b.values[v]}));
    return worst;
}

struct Files {
    TemporaryFolder folder;
    std::filesystem::path plain = folder / "plain.svt", with = folder / "with.svt";
    Files() { EXPECT_TRUE(volume::writeSvt(sampleVolume(), plain)); }

    void write(std::span<const Field> fields) const {
        const auto written = writeFields(plain, with, fields);
        ASSERT_TRUE(written) << written.error().message();
        EXPECT_EQ(*written, std::filesystem::file_size(with));
    }
};

TEST(SvtFields, FieldsReadBackWithinTheirPrecision) {
    const Files files;
    const std::vector<Field> fields{smoothGrid(), pointField(), labelField()};
    files.write(fields);
    for (const Field& field : fields) {
        const auto read = readField(files.with, field.head.name);
        ASSERT_TRUE(read) << read.error().message();
        EXPECT_EQ(read->head, field.head);
        EXPECT_LE(worstDifference(*read, field), field.head.precision * 0.5 + 1e-5);
    }
    EXPECT_EQ(worstDifference(*readField(files.with, "co2"), pointField()), 0) << "floats are kept";
    EXPECT_EQ(worstDifference(*readField(files.with, "heating"), labelField()), 0) << "multiples are kept";
}

TEST(SvtFields, ValuesOfInfinitePrecisionAndVectorsAndUnevenLatticesAreKept) {
    const Files files;
    Field field = smoothGrid("flow", {70, 3, 4});
    field.head.precision = 0;
    field.head.components = 3;
    field.head.times = {5};
    field.head.epoch.reset();
    for (int axis = 0; axis < 3; ++axis)
        for (std::int32_t n = 0; n < field.head.lattice.size[axis]; ++n)
            field.head.lattice.positions[std::size_t(axis)].push_back(n * n * 0.1);
    field.values.resize(3 * placeCount(field.head, 0));
    for (std::size_t v = 0; v < field.values.size(); ++v) field.values[v] = static_cast<float>(v) / 3;
    files.write(std::span(&field, 1));
    const auto read = readField(files.with, "flow");
    ASSERT_TRUE(read) << read.error().message();
    EXPECT_EQ(read->head, field.head);
    EXPECT_EQ(worstDifference(*read, field), 0);
}

TEST(SvtFields, OlderReadersSeeTheSameVolume) {
    const Files files;
    files.write(std::vector{smoothGrid(), pointField(), labelField()});
    const auto volume = volume::readSvt(files.with);
    ASSERT_TRUE(volume) << volume.error().message();
    EXPECT_TRUE(isSame(*volume, sampleVolume()));
}

TEST(SvtFields, OtherEntriesKeepTheirBytesAndRemovingAllRestoresTheFile) {
    const Files files;
    files.write(std::vector{smoothGrid(), labelField()});
    const std::string before = readText(files.plain), after = readText(files.with);
    const std::size_t directory = before.find("PK\1\2");
    EXPECT_EQ(after.substr(0, directory), before.substr(0, directory));
    const std::vector<std::string> both{"temperature", "heating"};
    ASSERT_TRUE(writeFields(files.with, files.with, {}, both));
    EXPECT_EQ(readText(files.with), before);
}

TEST(SvtFields, AFieldWithTheSameNameIsReplacedAndOthersStay) {
    const Files files;
    files.write(std::vector{smoothGrid(), labelField()});
    Field next = smoothGrid();
    for (float& value : next.values) value += 1;
    ASSERT_TRUE(writeFields(files.with, files.with, std::span(&next, 1)));
    EXPECT_LE(worstDifference(*readField(files.with, "temperature"), next), 0.0051);
    EXPECT_EQ(worstDifference(*readField(files.with, "heating"), labelField()), 0);
    const auto heads = readFieldHeads(files.with);
    ASSERT_EQ(heads->size(), 2u);
    EXPECT_EQ((*heads)[0].name, "temperature") << "keeps its place";
}

TEST(SvtFields, BytesDoNotDependOnTheThreads) {
    const Files files;
    Field many = smoothGrid("many", {20, 20, 20});
    const std::size_t perTime = placeCount(many.head, 0);
    many.head.times.clear();
    for (int t = 0; t < 20; ++t) many.head.times.push_back(t);
    many.values.resize(perTime * 20);
    for (std::size_t v = 0; v < many.values.size(); ++v) many.values[v] = static_cast<float>(v % 977) * 0.01f;
    const std::vector<Field> fields{smoothGrid(), many};
    ASSERT_TRUE(writeFields(files.plain, files.folder / "one.svt", fields, {}, 1));
    ASSERT_TRUE(writeFields(files.plain, files.folder / "two.svt", fields, {}, 2));
    EXPECT_EQ(readText(files.folder / "one.svt"), readText(files.folder / "two.svt"));
    EXPECT_EQ(worstDifference(*readField(files.folder / "one.svt", "many", 1u << 30, 1),
                              *readField(files.folder / "one.svt", "many", 1u << 30, 2)),
              0);
}

TEST(SvtFields, ABlockIsReadWithoutTheRestOfTheFile) {
    const Files files;
    Field field = smoothGrid();
    field.head.precision = 0.0005;
    for (std::size_t v = 0; v < field.values.size(); ++v)
        field.values[v] +=
            static_cast<float>((v * 2654435761u >> 7) % 1000) * 0.0005f;  // noise, so that frames are large
    files.write(std::span(&field, 1));
    const std::string bytes = readText(files.with);
    std::uint64_t count = 0;
    const auto read = [&](std::uint64_t offset, std::size_t size) -> Result<std::string> {
        count += size;
        return bytes.substr(offset, size);
    };
    const auto blocks = FieldBlocks::open(read, bytes.size(), "temperature");
    ASSERT_TRUE(blocks) << blocks.error().message();
    EXPECT_LT(count, 3000u) << "the end, the directory, fields.json and the index";
    EXPECT_GT(bytes.size(), 2000000u);
    count = 0;
    const auto block = blocks->read(0, 1, {1, 1, 0});
    ASSERT_TRUE(block) << block.error().message();
    EXPECT_LT(count, bytes.size() / 20);
    EXPECT_EQ(block->first, (Vec3i{64, 64, 0}));
    EXPECT_EQ(block->size, (Vec3i{64, 6, 64}));
    EXPECT_NEAR(block->values[5], field.values[150 * 70 * 66 + 69 + 150 * 64], 0.0003);
    EXPECT_FALSE(blocks->read(0, 1, {3, 0, 0})) << "there are 3 x 2 x 2 blocks";
    EXPECT_FALSE(blocks->read(9, 0, {0, 0, 0}));
    EXPECT_FALSE(blocks->read(0, 3, {0, 0, 0}));
}

TEST(SvtFields, LevelsAreMeansAndBlocksOfOneValueTakeNoBytes) {
    const Files files;
    Field field = smoothGrid("constant", {130, 8, 8});
    field.head.times = {0};
    field.values.assign(placeCount(field.head, 0), 20);
    for (std::size_t v = 0; v < field.values.size(); ++v)
        if (v % 130 >= 128) field.values[v] = v % 130 == 128 ? 10 : std::nanf("");
    files.write(std::span(&field, 1));
    const auto blocks = FieldBlocks::open(files.with, "constant");
    ASSERT_TRUE(blocks) << blocks.error().message();
    EXPECT_EQ(blocks->stored().code.levels, 3);
    EXPECT_EQ(blocks->blocks(), 3u + 2u + 1u);
    EXPECT_EQ(blocks->range(0, 0, {0, 0, 0}), std::pair(20.0f, 20.0f));
    EXPECT_EQ(blocks->range(0, 0, {2, 0, 0}), std::pair(10.0f, 10.0f)) << "without the missing values";
    const auto coarse = blocks->read(2, 0, {0, 0, 0});
    ASSERT_TRUE(coarse);
    EXPECT_EQ(coarse->size, (Vec3i{33, 2, 2}));
    EXPECT_EQ(coarse->values[0], 20);
    EXPECT_EQ(coarse->values[32], 10) << "the mean of the values that there are";
    const auto listed = listFields(files.with);
    EXPECT_LT((*listed)[0].bytes, 400u);
}

TEST(SvtFields, UnknownNamesAndInvalidFieldsAreErrors) {
    const Files files;
    EXPECT_EQ(readField(files.plain, "t").error().code(), Code::UnknownField);
    EXPECT_TRUE(readFieldHeads(files.plain)->empty());
    files.write(std::vector{labelField()});
    EXPECT_NE(readField(files.with, "t").error().message().find("heating"), std::string::npos);
    const std::vector<std::string> unknown{"t"};
    EXPECT_EQ(writeFields(files.with, files.with, {}, unknown).error().code(), Code::UnknownField);
    EXPECT_EQ(FieldBlocks::open(files.with, "heating").error().code(), Code::BadField);
    EXPECT_EQ(readFieldHeads(files.folder / "none.svt").error().code(), Code::CannotOpen);
    EXPECT_EQ(readField(files.with, "heating", 8).error().code(), Code::InputTooBig);

    const auto codeOf = [&](const auto& change) {
        Field field = smoothGrid("a", {4, 4, 4});
        change(field);
        const auto written = writeFields(files.plain, files.with, std::span(&field, 1));
        return written ? Code::Internal : written.error().code();
    };
    EXPECT_EQ(codeOf([](Field& f) { f.head.name = "a/b"; }), Code::BadField);
    EXPECT_EQ(codeOf([](Field& f) { f.head.name = ""; }), Code::BadField);
    EXPECT_EQ(codeOf([](Field& f) { f.head.unit = "m s"; }), Code::BadField);
    EXPECT_EQ(codeOf([](Field& f) { f.head.times = {0, 0, 1}; }), Code::BadField);
    EXPECT_EQ(codeOf([](Field& f) { f.head.epoch = "yesterday"; }), Code::BadField);
    EXPECT_EQ(codeOf([](Field& f) { f.head.lattice.step.y = 0; }), Code::BadField);
    EXPECT_EQ(codeOf([](Field& f) { f.head.parameters = "[1]"; }), Code::BadField);
    EXPECT_EQ(codeOf([](Field& f) { f.head.components = 2; }), Code::BadField);
    EXPECT_EQ(codeOf([](Field& f) { f.values.pop_back(); }), Code::BadField);
    EXPECT_EQ(codeOf([](Field& f) { f.values[0] = INFINITY; }), Code::BadField);
    EXPECT_EQ(codeOf([](Field& f) { f.values[0] = 1e6f; }), Code::BadField) << "65,534 steps of 0.01";
    EXPECT_EQ(codeOf([](Field&) {}), Code::Internal) << "is valid";
    EXPECT_EQ(writeFields(files.plain, files.with, std::vector{labelField(), labelField()}).error().code(),
              Code::BadField);
}

TEST(SvtFields, PrecisionForIsOneTwoOrFiveTimesAPowerOfTen) {
    EXPECT_DOUBLE_EQ(precisionFor(0, 65.534), 0.001);
    EXPECT_DOUBLE_EQ(precisionFor(0, 65.6), 0.002);
    EXPECT_DOUBLE_EQ(precisionFor(-20, 60), 0.002);
    EXPECT_DOUBLE_EQ(precisionFor(0, 300), 0.005);
    EXPECT_DOUBLE_EQ(precisionFor(0, 1e9), 20000);
    EXPECT_DOUBLE_EQ(precisionFor(0, 0), 1);
    EXPECT_GT(precisionFor(20, 20), 0);
    EXPECT_EQ(precisionFor(0, INFINITY), 0);
}

// The entries of a small file with fields, one of them damaged; the container is intact.
Result<void> readAllWith(const Files& files, const std::string& entry,
                         const std::function<void(std::string&)>& damage) {
    const std::string text = readText(files.with);
    const auto bytes = std::as_bytes(std::span(text.data(), text.size()));
    const auto ranges = volume::ZipRanges::open(files.with);
    std::vector<std::byte> data = *ranges->unpacked(*ranges->find(entry), 1u << 20);
    std::string changed(reinterpret_cast<const char*>(data.data()), data.size());
    damage(changed);
    const volume::NewEntry made{entry, {std::as_bytes(std::span(changed.data(), changed.size()))}, false};
    const auto path = files.folder / "damaged.svt";
    SVT_DO(volume::writeWithEntries(
        bytes, path, [&](std::string_view name) { return name != entry; }, std::span(&made, 1)));
    SVT_TRY(heads, readFieldHeads(path));
    for (const FieldHead& head : *heads) SVT_DO(readField(path, head.name, 1u << 24));
    return {};
}

std::vector<Field> smallFields() {
    Field grid = smoothGrid("t", {5, 4, 3});
    grid.head.times = {0, 1};
    grid.head.lattice = {{5, 4, 3}, {0, 0, 0}, {1, 1, 1}, {}};
    grid.values.resize(2 * 60);
    for (std::size_t v = 0; v < grid.values.size(); ++v) grid.values[v] = static_cast<float>(v % 7);
    return {grid, pointField(), labelField()};
}

TEST(SvtFields, EveryDamagedByteOfIndexBlocksAndTextIsAnErrorOrHarmless) {
    const Files files;
    files.write(smallFields());
    for (const std::string entry : {"fields/t/index", "fields/t/blocks"}) {
        const auto ranges = volume::ZipRanges::open(files.with);
        const std::size_t size = ranges->find(entry)->size;
        for (std::size_t b = 0; b < size; ++b) {
            // The ranges of blocks with a frame are hints: bytes 8 to 11 of each record.
            const bool isHint = entry == "fields/t/index" && b % 12 >= 8;
            const auto read =
                readAllWith(files, entry, [&](std::string& text) { text[b] = static_cast<char>(text[b] ^ 0x55); });
            EXPECT_TRUE(isHint || !read) << entry << " byte " << b;
            EXPECT_TRUE(read || read.error().code() == Code::BadField) << read.error().message();
        }
    }
    const auto ranges = volume::ZipRanges::open(files.with);
    const std::size_t size = ranges->find("fields.json")->size;
    for (std::size_t b = 0; b < size; ++b)
        (void)readAllWith(files, "fields.json", [&](std::string& text) { text[b] = static_cast<char>(text[b] ^ 1); });
}

TEST(SvtFields, EveryFlippedByteOfTheFileIsAnErrorOrHarmless) {
    const Files files;
    files.write(smallFields());
    const std::string text = readText(files.with);
    const std::size_t first = text.find("fields.json") - 30;
    std::uint64_t errors = 0;
    for (std::size_t b = first; b < text.size(); ++b) {
        std::string damaged = text;
        damaged[b] = static_cast<char>(damaged[b] ^ 0xFF);
        const auto read = [&](std::uint64_t offset, std::size_t size) -> Result<std::string> {
            return damaged.substr(offset, size);
        };
        const auto listed = listFields(read, damaged.size());
        if (!listed) {
            ++errors;
            continue;
        }
        for (const ListedField& field : *listed)
            errors += readField(read, damaged.size(), field.stored.head.name, 1u << 24, 1) ? 0u : 1u;
    }
    EXPECT_GT(errors, (text.size() - first) / 3);
}

TEST(SvtFields, HostileTextsAreErrors) {
    const Files files;
    files.write(smallFields());
    const auto codeOf = [&](const std::string& json) {
        const auto read = readAllWith(files, "fields.json", [&](std::string& text) { text = json; });
        return read ? Code::Internal : read.error().code();
    };
    const auto field = [](const std::string& members) { return R"({"fields":[{)" + members + "}]}"; };
    const std::string start = R"("name":"t","kind":"grid","unit":"K","code":{"type":"u16","scale":1,"offset":0})";
    const std::string lattice = R"(,"lattice":{"first":[0,0,0],"step":[1,1,1],"size":[5,4,3]})";
    EXPECT_EQ(codeOf(field(start + lattice + R"(,"times":[0,1])")), Code::Internal) << "is valid";
    EXPECT_EQ(codeOf(""), Code::BadField);
    EXPECT_EQ(codeOf("[]"), Code::BadField);
    EXPECT_EQ(codeOf(std::string(200000, '[')), Code::BadField);
    EXPECT_EQ(codeOf(R"({"fields":[)" + std::string(200000, '[') + std::string(200000, ']') + "]}"), Code::BadField);
    EXPECT_EQ(codeOf(field(start)), Code::BadField) << "no lattice";
    EXPECT_EQ(codeOf(field(start + lattice + R"(,"times":[0,"x"])")), Code::BadField);
    EXPECT_EQ(codeOf(field(start + lattice + R"(,"times":[1,0])")), Code::BadField);
    EXPECT_EQ(codeOf(field(start + lattice + R"(,"times":[0,1],"levels":2)")), Code::BadField);
    EXPECT_EQ(codeOf(field(start + lattice + R"(,"times":[0,1],"levels":1e99)")), Code::BadField);
    EXPECT_EQ(codeOf(field(start + R"(,"lattice":{"size":[1048576,1048576,1048576]})")), Code::BadField);
    EXPECT_EQ(codeOf(field(start + R"(,"lattice":{"size":[5,4,-3]},"times":[0,1])")), Code::BadField);
    EXPECT_EQ(codeOf(field(start + R"(,"lattice":{"size":[5,4,3],"step":[1,0,1]},"times":[0,1])")), Code::BadField);
}

}  // namespace
}  // namespace svt::fields
