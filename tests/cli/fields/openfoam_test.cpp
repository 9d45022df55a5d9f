// Cases of OpenFOAM there and back: OpenFOAM finds nothing wrong with the mesh, computes the air of a room, and its
// temperatures come back bit by bit, whole and decomposed, in ASCII and binary.
#include <tests/cli/run_command.hpp>

#include <svt/core/temporary_folder_test.hpp>
#include <svt/core/text.hpp>
#include <svt/fields/svt_fields.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <vector>

namespace svt::test {
namespace {

namespace fs = std::filesystem;

class OpenFoam : public ::testing::Test {
protected:
    void SetUp() override {
        if (!hasProgram("command -v buoyantBoussinesqPimpleFoam"))
            GTEST_SKIP() << "OpenFOAM is not installed (scripts/setup.sh readers)";
        prepareHouse(folder.path(), "0.2");
        runSvtWell(folder.path(),
                   {"convert", "house.svt", "room.foam", "--air", "name=Kitchen", "--surface-temperature",
                    "class~Window:12", "--surface-temperature", "class=BuildingFurniture:30"});
    }

    std::string foam(const std::string& command) {
        return runShellWell(folder / "room.foam", "export WM_PROJECT_DIR=/usr/share/openfoam; " + command);
    }

    // The temperatures of OpenFOAM in ASCII, as 32-bit floats.
    std::vector<float> computed(const std::string& file) {
        const std::string text = readText(folder / "room.foam" / file);
        const std::size_t begin = text.find('(', text.find("internalField"));
        std::string_view rest(text);
        rest = rest.substr(begin + 1, text.find("boundaryField") - begin - 1);
        std::vector<float> values;
        for (;;) {
            while (!rest.empty() && isBlank(rest.front())) rest.remove_prefix(1);
            const auto value = takeNumber(rest);
            if (!value) return values;
            values.push_back(static_cast<float>(*value));
        }
    }

    // The temperatures of the field in the order of the cells.
    std::vector<float> returned(const std::string& volume) {
        runSvtWell(folder.path(), {"field-add", "house.svt", "room.foam", "--quantity", "T", "--precision", "0",
                                   "--from", "120", "-o", volume});
        const auto field = fields::readField(folder / volume, "temperature");
        EXPECT_TRUE(field);
        std::vector<float> values;
        if (field)
            std::copy_if(field->values.begin(), field->values.end(), std::back_inserter(values),
                         [](float value) { return !std::isnan(value); });
        return values;
    }

    std::string lastTime() {
        double last = 0;
        std::string name = "0";
        for (const auto& entry : fs::directory_iterator(folder / "room.foam"))
            if (const auto time = parseNumber(entry.path().filename().string()); time && *time > last) {
                last = *time;
                name = entry.path().filename().string();
            }
        return name;
    }

    TemporaryFolder folder;
};

TEST_F(OpenFoam, MeshesHaveNoFinding) {
    const std::string text = foam("checkMesh -allTopology");
    EXPECT_NE(text.find("Mesh OK."), std::string::npos) << text;
    EXPECT_EQ(text.find("***"), std::string::npos) << text;
}

TEST_F(OpenFoam, TemperaturesComeBackBitByBit) {
    foam("foamDictionary -entry endTime -set 120 system/controlDict && sh Allrun");
    const std::vector<float> values = computed(lastTime() + "/T");
    ASSERT_GT(values.size(), 1000u);
    EXPECT_NE(*std::min_element(values.begin(), values.end()), *std::max_element(values.begin(), values.end()));
    EXPECT_EQ(returned("whole.svt"), values);
    // The same values, written as binary numbers by OpenFOAM.
    foam("foamDictionary -entry writeFormat -set binary system/controlDict && foamFormatConvert -latestTime");
    EXPECT_NE(readText(folder / "room.foam" / lastTime() / "T").find("binary"), std::string::npos);
    EXPECT_EQ(returned("binary.svt"), values);
}

TEST_F(OpenFoam, DecomposedResultsAreJoined) {
    foam("foamDictionary -entry endTime -set 120 system/controlDict");
    foam("MPIRUN='mpirun --allow-run-as-root --oversubscribe -np 2' sh Allrun 2");
    const std::string time = lastTime();
    const std::vector<float> values = computed(time + "/T");
    ASSERT_GT(values.size(), 1000u);
    EXPECT_EQ(returned("whole.svt"), values);
    fs::remove_all(folder / "room.foam" / time);
    EXPECT_EQ(returned("parts.svt"), values);
}

}  // namespace
}  // namespace svt::test
