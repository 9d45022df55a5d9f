#include <svt/frontend/option_set.hpp>

#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <optional>

namespace svt::frontend {
namespace {

enum class Fabric : std::uint8_t { Wool, Silk };
constexpr auto namesOf(Fabric) { return std::to_array<Name<Fabric>>({{Fabric::Wool, "wool"}, {Fabric::Silk, "silk"}}); }

struct Drying {
    int turns = 800;
    bool isWarm = true;
};
record::Members<Drying> membersOf(const Drying*) noexcept {
    static constexpr record::Member<Drying> kMembers[] = {
        record::member<&Drying::turns>("turns", "of the drum",
                                       {.least = 0, .most = 1600, .group = "Drum", .option = "--turns"}),
        record::memberAs<record::Not, &Drying::isWarm>("cold", "without heat", {.group = "Air", .option = "--cold"}),
        record::member<&Drying::turns>("again", "no option"),
    };
    return kMembers;
}

struct Wash {
    std::vector<std::filesystem::path> inputs;
    std::optional<double> heat;
    Fabric fabric = Fabric::Wool;
    std::vector<double> box;
    Drying drying;
};
record::Members<Wash> membersOf(const Wash*) noexcept {
    static constexpr record::Member<Wash> kMembers[] = {
        record::member<&Wash::inputs>("input", "what is washed", {.isRequired = true}),
        part<&Wash::drying>("drying", "Drum"),
        record::member<&Wash::heat>("-t,--heat", "of the water",
                                    {.unit = "degrees", .least = 0, .most = 95, .excludes = "--cold"}),
        record::member<&Wash::fabric>("--fabric", "what it is made of"),
        record::memberAs<record::Numbers<2>, &Wash::box>("--box", "width and height"),
        part<&Wash::drying>("drying", "--cold"),
    };
    return kMembers;
}

const BoundOption& optionNamed(std::string_view name) {
    for (const BoundOption& option : optionsOf<Wash>())
        if (longName(option) == name) return option;
    ADD_FAILURE() << name;
    return optionsOf<Wash>().front();
}

GivenOption given(std::string_view name, std::vector<std::string> values = {}) {
    return {&optionNamed(name), std::move(values)};
}

TEST(OptionSet, ListsMembersAndPartsInTheirOrder) {
    std::vector<std::string_view> names;
    for (const BoundOption& option : optionsOf<Wash>()) names.push_back(option.name);
    EXPECT_EQ(names, (std::vector<std::string_view>{"input", "--turns", "-t,--heat", "--fabric", "--box", "--cold"}));
}

TEST(OptionSet, TypesAndStructsGiveKindsChoicesAndDefaults) {
    EXPECT_EQ(optionNamed("--fabric").choices, "wool|silk");
    EXPECT_EQ(optionNamed("--fabric").byDefault, "wool");
    EXPECT_EQ(optionNamed("--turns").byDefault, "800");
    EXPECT_EQ(optionNamed("--turns").kind, OptionKind::Whole);
    EXPECT_EQ(optionNamed("--cold").kind, OptionKind::Flag);
    EXPECT_EQ(optionNamed("--cold").byDefault, "");
    EXPECT_EQ(optionNamed("--heat").byDefault, "");
    EXPECT_EQ(optionNamed("--box").count, 2);
    EXPECT_TRUE(optionNamed("input").mayRepeat);
    EXPECT_EQ(descriptionOf(optionNamed("--turns")), "of the drum, 0 to 1600; default: 800");
}

TEST(OptionSet, SetsTheMembersThatOptionsAreBoundTo) {
    Wash wash;
    const std::vector<GivenOption> all{given("input", {"a", "b"}),   given("--turns", {"400"}),
                                       given("--heat", {"60"}),      given("--fabric", {"silk"}),
                                       given("--box", {"1", "2.5"}), given("--cold")};
    ASSERT_TRUE(setOptions(wash, all));
    EXPECT_EQ(wash.inputs, (std::vector<std::filesystem::path>{"a", "b"}));
    EXPECT_EQ(wash.drying.turns, 400);
    EXPECT_EQ(wash.heat, 60);
    EXPECT_EQ(wash.fabric, Fabric::Silk);
    EXPECT_EQ(wash.box, (std::vector<double>{1, 2.5}));
    EXPECT_FALSE(wash.drying.isWarm);
}

TEST(OptionSet, FaultsNameTheOption) {
    Wash wash;
    const std::vector<GivenOption> all{given("--fabric", {"felt"})};
    const auto set = setOptions(wash, all);
    ASSERT_FALSE(set);
    EXPECT_EQ(set.error().code(), Code::BadArgument);
    EXPECT_TRUE(set.error().message().starts_with("--fabric: ")) << set.error().message();
}

TEST(OptionSet, OptionsThatExcludeEachOtherAreRefused) {
    const std::vector<GivenOption> both{given("--heat", {"60"}), given("--cold")}, one{given("--heat", {"60"})};
    EXPECT_TRUE(checkExclusions(one));
    ASSERT_FALSE(checkExclusions(both));
    EXPECT_EQ(checkExclusions(both).error().message(), "--heat and --cold exclude each other; give one of them");
}

TEST(OptionSet, ExclusionHoldsBothWays) {
    EXPECT_TRUE(excludeEachOther(optionNamed("--heat"), optionNamed("--cold")));
    EXPECT_TRUE(excludeEachOther(optionNamed("--cold"), optionNamed("--heat")));
    EXPECT_FALSE(excludeEachOther(optionNamed("--heat"), optionNamed("--fabric")));
}

TEST(OptionSet, ValuesAreCountedAndCheckedOneByOne) {
    EXPECT_EQ(valuesOf(optionNamed("--box"), "1,2"), (std::vector<std::string>{"1", "2"}));
    EXPECT_EQ(valuesOf(optionNamed("--fabric"), "1,2"), (std::vector<std::string>{"1,2"}));
    EXPECT_EQ(faultOfValues(optionNamed("--box"), "1,2"), "");
    EXPECT_EQ(faultOfValues(optionNamed("--box"), "1"), "'1': expected 2 values with commas between them");
    EXPECT_EQ(faultOfValues(optionNamed("--box"), "1,x"), "'x' is not a number");
    EXPECT_EQ(faultOfValues(optionNamed("--turns"), "1601"), "1601 is out of range; possible is 0 to 1600");
}

}  // namespace
}  // namespace svt::frontend
