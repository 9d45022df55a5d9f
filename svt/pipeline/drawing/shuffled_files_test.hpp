#pragma once
/// \file
/// The same file with its parts in another order, for tests. A seed gives the same order on every machine.

#include <nlohmann/json.hpp>

#include <cstdint>
#include <random>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace svt::test {

template <class T>
void shuffle(std::vector<T>& items, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    for (std::size_t n = items.size(); n > 1; --n) std::swap(items[n - 1], items[random() % n]);
}

/// A CityJSON document with its objects in another order.
inline std::string shuffledCityJson(const std::string& text, std::uint64_t seed) {
    auto document = nlohmann::ordered_json::parse(text);
    std::vector<std::pair<std::string, nlohmann::ordered_json>> objects;
    for (auto& [id, object] : document["CityObjects"].items()) objects.emplace_back(id, object);
    shuffle(objects, seed);
    auto shuffled = nlohmann::ordered_json::object();
    for (auto& [id, object] : objects) shuffled[id] = std::move(object);
    document["CityObjects"] = std::move(shuffled);
    return document.dump();
}

/// A STEP file with its records in another order; each is a line.
inline std::string shuffledStep(const std::string& text, std::uint64_t seed) {
    constexpr std::string_view kData = "DATA;\n";
    const std::size_t begin = text.find(kData) + kData.size(), end = text.find("ENDSEC;", begin);
    std::vector<std::string> records;
    for (std::size_t at = begin; at < end;) {
        const std::size_t next = text.find('\n', at) + 1;
        records.push_back(text.substr(at, next - at));
        at = next;
    }
    shuffle(records, seed);
    std::string shuffled = text.substr(0, begin);
    for (const std::string& record : records) shuffled += record;
    return shuffled + text.substr(end);
}

/// A CityGML 3.0 document with rooms and elements of its building in another order.
inline std::string shuffledCityGml(const std::string& text, std::uint64_t seed) {
    std::vector<std::string> gaps, members;  // one more gap than members
    std::size_t done = 0;
    while (true) {
        std::size_t begin = std::string::npos, end = 0;
        for (const std::string name : {"bldg:buildingRoom>", "bldg:buildingConstructiveElement>"}) {
            const std::size_t at = text.find("<" + name, done);
            if (at >= begin) continue;
            begin = at;
            end = text.find("</" + name, at) + 2 + name.size();
        }
        gaps.push_back(text.substr(done, begin == std::string::npos ? begin : begin - done));
        if (begin == std::string::npos) break;
        members.push_back(text.substr(begin, end - begin));
        done = end;
    }
    shuffle(members, seed);
    std::string shuffled = gaps.front();
    for (std::size_t n = 0; n < members.size(); ++n) shuffled += members[n] + gaps[n + 1];
    return shuffled;
}

}  // namespace svt::test
