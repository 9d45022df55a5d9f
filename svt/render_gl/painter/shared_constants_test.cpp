#include <svt/render_gl/painter/shared_constants.hpp>

#include <svt/render/picture_constants.hpp>
#include <svt/render_gl/painter/shader_sources.hpp>

#include <gtest/gtest.h>

#include <cstdlib>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace svt::render_gl {
namespace {

struct Declaration {
    std::string type, name, value;
};

// One for each line; fails where a line is none.
std::vector<Declaration> declarations() {
    const std::regex form("const (float|int|uint) (k[A-Za-z0-9]+) = ([^;]+);");
    std::vector<Declaration> all;
    std::istringstream lines{std::string(sharedConstants())};
    for (std::string line; std::getline(lines, line);) {
        std::smatch parts;
        if (std::regex_match(line, parts, form))
            all.push_back({parts[1], parts[2], parts[3]});
        else
            ADD_FAILURE() << line;
    }
    return all;
}

std::string valueOf(const std::string& name) {
    for (const Declaration& each : declarations())
        if (each.name == name) return each.value;
    return "";
}

std::string allShaders() {
    std::string all;
    for (const std::string_view source :
         {shaders::tables(), shaders::ray(), shaders::clips(), shaders::light(), shaders::fitted(), shaders::shapes(),
          shaders::hatches(), shaders::cast(), shaders::resolve(), shaders::pictureVertex()})
        all += source;
    return all;
}

std::set<std::string> matches(const std::string& text, const std::regex& form, std::size_t group) {
    std::set<std::string> found;
    for (auto at = std::sregex_iterator(text.begin(), text.end(), form); at != std::sregex_iterator(); ++at)
        found.insert(at->str(group));
    return found;
}

// Names of constants, which begin with k, also in comments.
std::set<std::string> namedIn(const std::string& glsl) { return matches(glsl, std::regex("\\bk[A-Z]\\w*"), 0); }

std::set<std::string> declaredIn(const std::string& glsl) {
    std::set<std::string> names;
    for (const std::string& statement : matches(glsl, std::regex("\\bconst \\w+ [^;]*;"), 0))
        names.merge(matches(statement, std::regex("\\b(k[A-Z]\\w*) ="), 1));
    return names;
}

TEST(SharedConstants, HaveTheFormOfTheirType) {
    const std::regex isFloat(R"(\d+\.\d+|\d+(\.\d+)?e[+-]\d+)"), isInt(R"(\d+)"), isUint(R"(\d+u)");
    for (const auto& [type, name, value] : declarations())
        EXPECT_TRUE(std::regex_match(value, type == "float" ? isFloat
                                            : type == "int" ? isInt
                                                            : isUint))
            << type << " " << name << " = " << value;
    EXPECT_EQ(valueOf("kHalfWidthsBefore"), "4.0") << "a whole number needs a point";
    EXPECT_EQ(valueOf("kGlassLine"), "0.5");
    EXPECT_EQ(valueOf("kNone"), "4294967295u");
    EXPECT_EQ(valueOf("kOpaque"), "2u");
    EXPECT_EQ(valueOf("kFacePlaces"), "12");
}

TEST(SharedConstants, AreReadAsTheFloatsThatTheyAreInCpp) {
    EXPECT_EQ(std::strtof(valueOf("kFar").c_str(), nullptr), kFar);
    EXPECT_EQ(std::strtof(valueOf("kSkyShare").c_str(), nullptr), static_cast<float>(render::kSkyShare));
    EXPECT_EQ(std::strtof(valueOf("kLeastFacing").c_str(), nullptr), static_cast<float>(render::kLeastFacing));
}

TEST(SharedConstants, StandInNoShaderASecondTime) {
    const std::set<std::string> again = declaredIn(allShaders());
    for (const Declaration& each : declarations()) EXPECT_FALSE(again.contains(each.name)) << each.name;
}

TEST(SharedConstants, AreAllUsed) {
    const std::set<std::string> used = namedIn(allShaders());
    for (const Declaration& each : declarations()) EXPECT_TRUE(used.contains(each.name)) << each.name;
}

TEST(SharedConstants, AreAllThatTheShadersNameAndDoNotDeclare) {
    const std::set<std::string> declared = declaredIn(std::string(sharedConstants()) + allShaders());
    for (const std::string& name : namedIn(allShaders())) EXPECT_TRUE(declared.contains(name)) << name;
}

}  // namespace
}  // namespace svt::render_gl
