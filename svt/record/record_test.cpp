#include <svt/record/record.hpp>

#include <fmt/format.h>

#include <gtest/gtest.h>

namespace svt::record {
namespace {

enum class Side { Left, Right };
constexpr auto namesOf(Side) { return std::to_array<Name<Side>>({{Side::Left, "left"}, {Side::Right, "right"}}); }

struct Wheel {
    std::string kind;
    double radius = 0.5;
    friend bool operator==(const Wheel&, const Wheel&) = default;
};

struct Lamp {
    std::optional<float> strength;
    friend bool operator==(const Lamp&, const Lamp&) = default;
};

struct Cart {
    int seats = 2;
    bool isOpen = false;
    Side side = Side::Left;
    std::string name{};
    std::optional<double> load{};
    std::optional<Vec3d> hook{};
    Lamp lamp{};
    std::optional<Wheel> spare{};
    std::vector<std::string> goods{};
    std::vector<Wheel> wheels{{"oak", 0.5}};
    friend bool operator==(const Cart&, const Cart&) = default;
};

Members<Wheel> membersOf(const Wheel*) noexcept {
    static constexpr Member<Wheel> kMembers[] = {
        member<&Wheel::kind>("kind", "wood", {.isRequired = true}),
        member<&Wheel::radius>("radius", "radius", {.unit = "metres", .least = 0.1, .most = 2})};
    return kMembers;
}

void checkMembers(Faults& faults, const std::string& path, const Wheel& wheel) {
    if (wheel.kind == "straw") faults.add(path, "breaks");
}

Members<Cart> membersOf(const Cart*) noexcept {
    static constexpr Member<Cart> kMembers[] = {
        memberOf<Cart, FormatName<Cart>>("format", "a cart", {.choices = "cart"}),
        memberOf<Cart, FormatVersion<Cart>>("version", "version", {.least = 1, .most = 3}),
        member<&Cart::seats>("seats", "seats", {.least = 1, .most = 9}),
        member<&Cart::isOpen>("open", "has no roof"),
        member<&Cart::side>("side", "side of the driver"),
        member<&Cart::name>("name", "name", {.otherwise = "that of the owner"}),
        member<&Cart::load>("load", "load", {.least = 0, .most = 1000}),
        member<&Cart::hook>("hook", "place of the hook", {.least = -10, .most = 10}),
        member<&Cart::lamp, &Lamp::strength>("lamp", "strength of the lamp", {.least = 0, .most = 1}),
        member<&Cart::spare>("spare", "spare wheel"),
        member<&Cart::goods>("goods", "goods"),
        member<&Cart::wheels>("wheels", "wheels", {.least = 1, .most = 4}, Written::Always)};
    return kMembers;
}

std::string faultOfText(const std::string& json) {
    const auto cart = parseRecord<Cart>(json, "cart.json", Code::BadScene);
    return cart ? std::string() : cart.error().message();
}

TEST(Record, WritesOnlyWhatIsSet) {
    EXPECT_EQ(writeRecord(Cart()).dump(), R"({"format":"cart","version":3,"wheels":[{"kind":"oak"}]})");
}

TEST(Record, ReadsWhatItWrites) {
    const Cart cart{.seats = 4,
                    .isOpen = true,
                    .side = Side::Right,
                    .name = "Ann",
                    .load = 0,
                    .hook = Vec3d{1, 2, 3},
                    .lamp = {0.3f},
                    .spare = Wheel{"ash", 1},
                    .goods = {"hay", ""},
                    .wheels = {{"oak", 0.5}, {"elm", 2}}};
    const std::string text = recordText(cart);
    EXPECT_NE(text.find("\"lamp\": 0.3,"), std::string::npos) << "floats are as short as they can be: " << text;
    const auto again = parseRecord<Cart>(text, "cart.json", Code::BadScene);
    ASSERT_TRUE(again) << again.error().message();
    EXPECT_EQ(*again, cart);
    EXPECT_EQ(recordText(*again), text);
}

TEST(Record, FaultsNamePlaceAndRange) {
    EXPECT_EQ(faultOfText("["), "cart.json: not well-formed JSON");
    EXPECT_EQ(faultOfText("[]"), "cart.json: /: expected an object, found array");
    EXPECT_EQ(faultOfText(R"({"version": 4})"),
              "cart.json: /version: expected 3, found 4; a newer program may have written it");
    EXPECT_EQ(faultOfText(R"({"format": "car"})"), "cart.json: /format: expected \"cart\"");
    EXPECT_EQ(faultOfText(R"({"seats": 10})"), "cart.json: /seats: expected a number from 1 to 9, found 10");
    EXPECT_EQ(faultOfText(R"({"seats": 1.5})"), "cart.json: /seats: expected a whole number, found 1.5");
    EXPECT_EQ(faultOfText(R"({"side": "up"})"), "cart.json: /side: 'up' is not possible; possible are left, right");
    EXPECT_EQ(faultOfText(R"({"hook": [1, 2]})"), "cart.json: /hook: expected an array of 3 numbers, found [1,2]");
    EXPECT_EQ(faultOfText(R"({"hook": [1, 2, 11]})"), "cart.json: /hook/2: expected a number from -10 to 10, found 11");
    EXPECT_EQ(faultOfText(R"({"wheels": []})"), "cart.json: /wheels: expected an array of 1 to 4 elements, found []");
    EXPECT_EQ(faultOfText(R"({"wheels": [{}]})"), "cart.json: /wheels/0: needs \"kind\"");
    EXPECT_EQ(faultOfText(R"({"wheels": [{"kind": "straw"}]})"), "cart.json: /wheels/0: breaks");
    EXPECT_EQ(faultOfText(R"({"spare": {"kinds": 1}})"),
              "cart.json: /spare: unknown member 'kinds'; possible are kind, radius");
}

struct Edition {
    int number = 0;
};
Members<Edition> membersOf(const Edition*) noexcept {
    static constexpr Member<Edition> kMembers[] = {memberAs<NumberChoice, &Edition::number>(
        "edition", "edition", {.choices = "2.0|12.5", .otherwise = "that of the model"})};
    return kMembers;
}

TEST(Record, ChosenTextsBecomeTheNumbersThatTheyBeginWith) {
    const auto read = parseRecord<Edition>(R"({"edition": "12.5"})", "cart.json", Code::BadScene);
    ASSERT_TRUE(read) << read.error().message();
    EXPECT_EQ(read->number, 12);
    EXPECT_EQ(writeRecord(*read).dump(), R"({"edition":"12.5"})");
    EXPECT_EQ(writeRecord(Edition{2}).dump(), R"({"edition":"2.0"})");
    const auto other = parseRecord<Edition>(R"({"edition": "3.0"})", "cart.json", Code::BadScene);
    ASSERT_FALSE(other);
    EXPECT_EQ(other.error().message(), "cart.json: /edition: '3.0' is not possible; possible are 2.0, 12.5");
}

TEST(Record, ListsMayBeAsLongAsDeclared) {
    constexpr std::string_view kWheel = R"({"kind": "oak"})";
    EXPECT_EQ(faultOfText(fmt::format(R"({{"wheels": [{0}, {0}, {0}, {0}]}})", kWheel)), "");
    EXPECT_EQ(faultOfText(fmt::format(R"({{"wheels": [{0}, {0}, {0}, {0}, {0}]}})", kWheel)).substr(0, 63),
              "cart.json: /wheels: expected an array of 1 to 4 elements, found");
    EXPECT_EQ(faultOfText(R"({"wheels": {"kind": "oak"}})").substr(0, 63),
              "cart.json: /wheels: expected an array of 1 to 4 elements, found");
}

TEST(Record, SetsMembersByPointer) {
    Cart cart;
    const auto set = [&](std::string_view pointer, const Json& value) {
        Faults faults;
        setMember(faults, pointer, value, "", cart);
        return faults.isFine() ? std::string() : faults.path() + ": " + faults.text();
    };
    EXPECT_EQ(set("/seats", 3), "");
    EXPECT_EQ(set("/goods/-", "hay"), "");
    EXPECT_EQ(set("/goods/-", "salt"), "");
    EXPECT_EQ(set("/wheels/1/kind", "elm"), "") << "appends";
    EXPECT_EQ(set("/wheels/0/radius", 1), "");
    EXPECT_EQ(set("/spare/radius", 2), "") << "makes it";
    EXPECT_EQ(
        cart,
        (Cart{.seats = 3, .spare = Wheel{"", 2}, .goods = {"hay", "salt"}, .wheels = {{"oak", 1}, {"elm", 0.5}}}));
    EXPECT_EQ(set("/wheels/5/kind", "elm"), "/wheels: has no element '5'");
    EXPECT_EQ(set("/wheels/x/kind", "elm"), "/wheels: has no element 'x'");
    EXPECT_EQ(set("/seats/0", 1), "/seats: has no members");
    EXPECT_EQ(set("/roof", 1), "/: unknown member 'roof'");
    EXPECT_EQ(set("/wheels/0/radius", 9), "/wheels/0/radius: expected a number from 0.1 to 2, found 9");
}

TEST(Record, DeclarationsFollowFromFields) {
    const auto find = [](std::string_view name) {
        for (const Option& option : declared<Cart>())
            if (option.name == name) return option;
        ADD_FAILURE() << name;
        return Option{};
    };
    EXPECT_EQ(declared<Cart>().size(), 16u);
    EXPECT_EQ(find("/seats").kind, OptionKind::Whole);
    EXPECT_EQ(find("/seats").byDefault, "2");
    EXPECT_EQ(find("/open").byDefault, "false");
    EXPECT_EQ(find("/side").choices, "left|right");
    EXPECT_EQ(find("/side").byDefault, "left");
    EXPECT_EQ(find("/name").byDefault, "") << "said in words";
    EXPECT_EQ(find("/load").byDefault, "") << "unset";
    EXPECT_EQ(find("/hook").count, 3);
    EXPECT_EQ(find("/spare").kind, OptionKind::Object);
    EXPECT_EQ(find("/spare/radius").byDefault, "0.5");
    EXPECT_EQ(find("/goods").mayRepeat, true);
    EXPECT_EQ(find("/wheels").kind, OptionKind::List);
    EXPECT_EQ(find("/wheels/*/kind").byDefault, "");
}

TEST(Record, TextsBecomeValuesByTheirDeclaration) {
    const std::string numbers[] = {"1", "2.5"}, flag[] = {"false"}, text[] = {"7"};
    EXPECT_EQ(valueOfTexts({.name = "a", .kind = OptionKind::Number, .count = 2}, numbers).dump(), "[1.0,2.5]");
    EXPECT_EQ(valueOfTexts({.name = "a", .kind = OptionKind::Number}, text).dump(), "7.0");
    EXPECT_EQ(valueOfTexts({.name = "a"}, text).dump(), "\"7\"");
    EXPECT_EQ(valueOfTexts({.name = "a"}, {}).dump(), "\"\"");
    EXPECT_EQ(valueOfTexts({.name = "a", .count = 2}, {}).dump(), "[]");
    EXPECT_EQ(valueOfTexts({.name = "a", .kind = OptionKind::Flag}, {}).dump(), "true");
    EXPECT_EQ(valueOfTexts({.name = "a", .kind = OptionKind::Flag}, flag).dump(), "false");
}

}  // namespace
}  // namespace svt::record
