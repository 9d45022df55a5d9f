// Size and time of a temperature field in a real house.
#include <svt/fields/field_sampler.hpp>
#include <svt/fields/svt_fields.hpp>

#include <svt/core/machine.hpp>
#include <svt/core/temporary_folder_test.hpp>
#include <svt/core/test_data_test.hpp>
#include <svt/pipeline/build_volume.hpp>
#include <svt/volume/dense.hpp>
#include <svt/volume/svt_file.hpp>

#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <cmath>
#include <ctime>

namespace svt::fields {
namespace {

double secondsSince(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// Rooms of about 20 degrees, warmer at the ceiling; -5 degrees outside; solids between by steps of relaxation.
Field temperatureOf(const volume::SemanticVolume& volume) {
    Field field;
    FieldHead& head = field.head;
    head.name = "temperature";
    head.unit = "Cel";
    head.lattice.size = volume.grid.dimension();
    head.precision = 0.01;
    FieldHead air;
    air.medium = "air";
    const std::vector<char> isAir = *mediumOf(air, volume);
    const std::vector<volume::Scalar> scalars = *volume::toDense<volume::Scalar>(volume.columns);
    const Vec3i n = head.lattice.size;
    field.values.resize(scalars.size());
    const auto nx = std::size_t(n.x), nxy = nx * std::size_t(n.y);
    for (std::size_t v = 0; v < scalars.size(); ++v)
        field.values[v] = scalars[v] == 0          ? -5.0f
                          : isAir[scalars[v]] != 0 ? 19 + 0.02f * static_cast<float>(v / nxy)
                                                   : 8.0f;
    std::vector<std::size_t> solids;
    for (std::size_t v = nxy; v + nxy < scalars.size(); ++v)
        if (isAir[scalars[v]] == 0) solids.push_back(v);
    auto& t = field.values;
    for (int step = 0; step < 200; ++step)
        for (const std::size_t v : solids)
            t[v] = (t[v - 1] + t[v + 1] + t[v - nx] + t[v + nx] + t[v - nxy] + t[v + nxy]) / 6;
    return field;
}

TEST(RealHouse, ATemperatureTakesLessThanAMegabyteAndASecond) {
    SVT_NEEDS_DATA(file, "fzk_haus.ifc");
    pipeline::BuildOptions options;
    options.spacing = Vec3d{0.05, 0.05, 0.05};
    const auto built = pipeline::buildVolume(std::span(&file, 1), options);
    ASSERT_TRUE(built) << built.error().message();
    const svt::test::TemporaryFolder folder;
    const auto plain = folder / "plain.svt", with = folder / "with.svt";
    ASSERT_TRUE(volume::writeSvt(built->volume, plain));
    const Field field = temperatureOf(built->volume);
    const std::clock_t before = std::clock();
    auto start = std::chrono::steady_clock::now();
    ASSERT_TRUE(writeFields(plain, with, std::span(&field, 1)));
    const double writing = secondsSince(start);
    const double processor = double(std::clock() - before) / CLOCKS_PER_SEC;
    const auto bytes = std::filesystem::file_size(with) - std::filesystem::file_size(plain);
    start = std::chrono::steady_clock::now();
    const auto read = readField(with, "temperature");
    const double reading = secondsSince(start);
    ASSERT_TRUE(read);
    double worst = 0;
    for (std::size_t v = 0; v < field.values.size(); ++v)
        worst = std::max(worst, std::abs(double{field.values[v]} - double{read->values[v]}));
    EXPECT_LE(worst, 0.00501);

    start = std::chrono::steady_clock::now();
    const auto sampler = FieldSampler::make(*read, built->volume);
    const double making = secondsSince(start);
    ASSERT_TRUE(sampler);
    start = std::chrono::steady_clock::now();
    double sum = 0;
    std::size_t count = 0;
    const Vec3i n = field.head.lattice.size;
    for (std::int32_t k = 0; k < n.z; k += 2)
        for (std::int32_t j = 0; j < n.y; ++j)
            for (std::int32_t i = 0; i < n.x; ++i, ++count) sum += double{sampler->at({i + 0.3, j + 0.2, k + 0.4})};
    const double sampling = secondsSince(start);
    RecordProperty("nodes", std::to_string(field.values.size()));
    RecordProperty("bytes", std::to_string(bytes));
    RecordProperty("secondsToWrite", std::to_string(writing));
    RecordProperty("processorSecondsToWrite", std::to_string(processor));
    RecordProperty("secondsToRead", std::to_string(reading));
    RecordProperty("secondsToMakeASampler", std::to_string(making));
    RecordProperty("samplerBytes", std::to_string(sampler->sizeBytes()));
    RecordProperty("samplesPerSecond", std::to_string(double(count) / sampling));
    EXPECT_TRUE(std::isfinite(sum)) << "a place without value";
    EXPECT_LE(bytes, 1000000u) << "of 69 MB as floats; a simulated field takes less, as relaxation leaves kinks";
    EXPECT_LT(processor, kIsSanitized ? 60 : 3) << "of all cores";
}

}  // namespace
}  // namespace svt::fields
