#include <svt/analyze/stated_facts.hpp>

#include <svt/core/text.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <variant>
#include <vector>

namespace svt::analyze {
namespace {

// The members of an address of CityGML or CityJSON as one reads it: street and number, postal code and town, country.
std::vector<std::string> addressParts(const volume::Label& label) {
    enum Part : std::size_t { Street, HouseNumber, PostalCode, Town, Other, Country, kCount };
    std::array<std::string, kCount> parts;
    const auto partOf = [](const std::string& key) {
        const auto has = [&](std::string_view word) { return key.find(word) != std::string::npos; };
        if (has("post") || has("zip")) return PostalCode;
        if (has("country")) return Country;
        if (has("number")) return HouseNumber;
        if (has("thoroughfare") || has("street") || has("road")) return Street;
        return has("locality") || has("city") || has("town") ? Town : Other;
    };
    for (const Attribute& attribute : label.attributes) {
        if (!attribute.name.starts_with("address/")) continue;
        const std::string key = lowerAscii(attribute.name.substr(8));
        const std::string* text = std::get_if<std::string>(&attribute.value);
        if (text == nullptr || text->empty() || isPlaceholder(*text) || key == "pos") continue;
        std::string& part = parts[partOf(key)];
        part += (part.empty() ? "" : ", ") + *text;
    }
    const auto joined = [](const std::string& first, const std::string& second) {
        return first + (first.empty() || second.empty() ? "" : " ") + second;
    };
    return {joined(parts[Street], parts[HouseNumber]), joined(parts[PostalCode], parts[Town]), parts[Other],
            parts[Country]};
}

}  // namespace

bool isPlaceholder(std::string_view text) {
    constexpr std::string_view kPlaceholders[] = {"enter address here",
                                                  "project name",
                                                  "project number",
                                                  "project status",
                                                  "nicht definiert",
                                                  "undefined",
                                                  "building name",
                                                  "default",
                                                  "<default>",
                                                  "default project",
                                                  "defaultproject",
                                                  "default building",
                                                  "unnamed",
                                                  "projektname",
                                                  "nom du projet",
                                                  "nombre de proyecto",
                                                  "nome progetto",
                                                  "nome do projeto",
                                                  "projectnaam",
                                                  "introduzca direcci\u00F3n aqu\u00ED",
                                                  "adresse hier eingeben",
                                                  "entrez l'adresse ici"};
    const std::string lower = lowerAscii(text);
    return text.starts_with("//") ||
           std::find(std::begin(kPlaceholders), std::end(kPlaceholders), lower) != std::end(kPlaceholders);
}

std::string statedText(const volume::Label& label, std::string_view name) {
    for (const Attribute& attribute : label.attributes)
        if (attribute.name == name)
            if (const std::string* text = std::get_if<std::string>(&attribute.value)) return *text;
    return {};
}

std::string postalAddress(const volume::Label& label) {
    std::string text;
    const auto add = [&](const std::string& part) {
        if (!part.empty() && !isPlaceholder(part)) text += (text.empty() ? "" : ", ") + part;
    };
    const std::string stated = statedText(label, "address");
    for (std::size_t at = 0; at < stated.size();) {
        const std::size_t end = std::min(stated.find(", ", at), stated.size());
        add(stated.substr(at, end - at));
        at = end + 2;
    }
    for (const std::string& part : addressParts(label)) add(part);
    return text;
}

}  // namespace svt::analyze
