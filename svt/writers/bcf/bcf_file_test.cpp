#include <svt/writers/bcf_file.hpp>

#include <gtest/gtest.h>

#include <string>
#include <string_view>

namespace svt::writers {
namespace {

// Entries are stored, so their texts are found in the bytes.
std::string textOf(const std::vector<std::byte>& bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::size_t occurrencesOf(std::string_view text, std::string_view word) {
    std::size_t count = 0;
    for (std::size_t at = 0; (at = text.find(word, at)) != std::string_view::npos; at += word.size()) ++count;
    return count;
}

BcfTopic topicOf(std::string key, std::vector<std::string> components) {
    BcfTopic topic;
    topic.key = std::move(key);
    topic.type = "moved";
    topic.title = "Wall <1> & \"2\"";
    topic.components = std::move(components);
    topic.camera.eye = {10, 20, 30};
    topic.camera.direction = {0, 3, -4};
    return topic;
}

TEST(BcfFile, KnowsGlobalIds) {
    EXPECT_TRUE(isIfcGuid("0UXMq8ty9qSMKjojghDqzI"));
    EXPECT_TRUE(isIfcGuid("3Ds2Kc$3zAefYfLo5OtH0_"));
    EXPECT_FALSE(isIfcGuid("4UXMq8ty9qSMKjojghDqzI"));  // more than 128 bits
    EXPECT_FALSE(isIfcGuid("0UXMq8ty9qSMKjojghDqz"));
    EXPECT_FALSE(isIfcGuid("0UXMq8ty9qSMKjojghDqz-"));
    EXPECT_FALSE(isIfcGuid(""));
}

TEST(BcfFile, HasComponentsAndCamera) {
    const std::vector<BcfTopic> topics{topicOf("a", {"0UXMq8ty9qSMKjojghDqzI", "wall <7>"})};
    const auto bytes = makeBcf(topics, "A & B", "2026-11-29T00:00:00Z");
    ASSERT_TRUE(bytes) << bytes.error().toString();
    const std::string text = textOf(*bytes);
    for (const char* part :
         {"<Version VersionId=\"3.0\"/>", "<TopicType>moved</TopicType>", "<User>A &amp; B</User>",
          "<Title>Wall &lt;1&gt; &amp; \"2\"</Title>", "<Component IfcGuid=\"0UXMq8ty9qSMKjojghDqzI\"/>",
          "<AuthoringToolId>wall &lt;7&gt;</AuthoringToolId>", "<Color Color=\"0072B2\">",
          "<CameraViewPoint><X>10.000000000</X><Y>20.000000000</Y><Z>30.000000000</Z></CameraViewPoint>",
          "<CameraDirection><X>0.000000000</X><Y>0.600000000</Y><Z>-0.800000000</Z></CameraDirection>",
          "<CameraUpVector><X>0.000000000</X><Y>0.800000000</Y><Z>0.600000000</Z></CameraUpVector>"})
        EXPECT_NE(text.find(part), std::string::npos) << part;
    EXPECT_EQ(text.find("snapshot"), std::string::npos);
    EXPECT_EQ(occurrencesOf(text, "/markup.bcf"), 2u);  // the entry and the directory
    EXPECT_EQ(*makeBcf(topics, "A & B", "2026-11-29T00:00:00Z"), *bytes);
}

TEST(BcfFile, HasSnapshotsAndTitlesOfTopicsWithoutTexts) {
    BcfTopic topic = topicOf("the key", {});
    topic.title = " ";
    topic.snapshot = {std::byte{0x89}, std::byte{'P'}};
    const auto bytes = makeBcf(std::span(&topic, 1), "svt", "2026-11-29T00:00:00Z");
    ASSERT_TRUE(bytes);
    const std::string text = textOf(*bytes);
    EXPECT_NE(text.find("<Title>the key</Title>"), std::string::npos);
    EXPECT_NE(text.find("<Snapshot>snapshot.png</Snapshot>"), std::string::npos);
    EXPECT_EQ(occurrencesOf(text, "/snapshot.png"), 2u);
    EXPECT_EQ(text.find("<Selection>"), std::string::npos);
    EXPECT_EQ(text.find("<Description>"), std::string::npos);
}

TEST(BcfFile, RefusesEqualKeys) {
    const std::vector<BcfTopic> topics{topicOf("a", {}), topicOf("a", {})};
    EXPECT_FALSE(makeBcf(topics, "svt", "2026-11-29T00:00:00Z"));
    EXPECT_TRUE(makeBcf({}, "svt", "2026-11-29T00:00:00Z"));  // a list without topics
}

}  // namespace
}  // namespace svt::writers
