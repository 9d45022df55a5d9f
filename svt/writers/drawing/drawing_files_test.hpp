#pragma once
/// \file
/// Drawings as tests read them: SVG by XPath, DXF by its parts.

#include <gtest/gtest.h>
#include <pugixml.hpp>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace svt::writers {

class SvgFile {
public:
    explicit SvgFile(const std::string& text) {
        const pugi::xml_parse_result read = document_.load_buffer(text.data(), text.size());
        EXPECT_TRUE(read) << read.description() << " at " << text.substr(std::size_t(read.offset), 80);
    }
    /// The string value of the first node that an XPath selects, or "".
    [[nodiscard]] std::string text(const std::string& path) const {
        return pugi::xpath_query(("string(" + path + ")").c_str()).evaluate_string(document_);
    }
    /// Number of nodes that an XPath selects.
    [[nodiscard]] std::size_t count(const std::string& path) const {
        return document_.select_nodes(path.c_str()).size();
    }

private:
    pugi::xml_document document_;
};

/// A part begins with a pair of code 0: an entity, a block, a row of a table.
struct DxfPart {
    std::string section, kind;
    std::vector<std::pair<int, std::string>> pairs;  ///< code and value, without that of code 0

    /// The first value of a code, or "".
    [[nodiscard]] std::string value(int code) const {
        const auto found =
            std::find_if(pairs.begin(), pairs.end(), [&](const auto& pair) { return pair.first == code; });
        return found == pairs.end() ? std::string() : found->second;
    }
};

struct DxfFile {
    std::vector<std::string> comments;
    std::map<std::string, std::string> variables;  ///< of the header, each with its first value
    std::vector<DxfPart> parts;                    ///< of the other sections, in order

    explicit DxfFile(const std::string& text) {
        std::istringstream in(text);
        std::string code, value, section, variable;
        DxfPart* part = nullptr;
        bool isNamed = true;
        while (std::getline(in, code)) {
            EXPECT_TRUE(std::getline(in, value)) << "a code without a value: " << code;
            const int number = std::stoi(code);
            if (number == 999) comments.push_back(value);
            if (number == 0) {
                part = nullptr;
                isNamed = value != "SECTION";
                if (value == "ENDSEC") section.clear();
                if (!section.empty()) part = &parts.emplace_back(DxfPart{section, value, {}});
            } else if (!isNamed) {
                EXPECT_EQ(number, 2) << "a section begins with its name";
                section = value;
                isNamed = true;
            } else if (part != nullptr) {
                part->pairs.emplace_back(number, value);
            } else if (number == 9) {
                variable = value;
            } else if (section == "HEADER") {
                variables.emplace(variable, value);
            }
        }
        EXPECT_EQ(value, "EOF");
    }

    /// Entities of a kind, those of blocks among them.
    [[nodiscard]] std::vector<DxfPart> of(const std::string& kind) const {
        std::vector<DxfPart> found;
        for (const DxfPart& part : parts)
            if (part.kind == kind) found.push_back(part);
        return found;
    }
    /// x and y of all points of a kind of entity.
    [[nodiscard]] std::vector<std::array<double, 2>> points(const std::string& kind) const {
        std::vector<std::array<double, 2>> found;
        double x = 0;
        for (const DxfPart& part : of(kind))
            for (const auto& [code, value] : part.pairs) {
                if (code == 10) x = std::stod(value);
                if (code == 20) found.push_back({x, std::stod(value)});
            }
        return found;
    }
    /// All values of a code: 8 for layers, 1 for texts.
    [[nodiscard]] std::set<std::string> values(int code) const {
        std::set<std::string> found;
        for (const DxfPart& part : parts)
            for (const auto& pair : part.pairs)
                if (pair.first == code) found.insert(pair.second);
        return found;
    }
};

}  // namespace svt::writers
