#include <svt/simulate/materials/thermal_words.hpp>

#include <svt/core/text.hpp>

#include <array>
#include <string>

namespace svt::simulate {
namespace {

// Specific names precede general ones: "lightweight concrete" before "concrete".
constexpr std::array kWords{
    ThermalWord{"leichtbeton|lightweight concrete|porenbeton|gasbeton|aerated|ytong|bims", 0.30, 600, 1000},
    ThermalWord{"stahlbeton|reinforced", 2.3, 2300, 1000},
    ThermalWord{"*estrich|screed", 1.4, 2000, 1000},
    ThermalWord{"*beton|concrete|béton|hormig|calcestruzzo", 2.0, 2400, 1000},
    ThermalWord{"*wolle|wool|rockwool", 0.035, 50, 1030},
    ThermalWord{"polystyr|eps|xps|styropor|styrodur", 0.035, 25, 1450},
    ThermalWord{"polyurethan|pur|pir|foam|*schaum", 0.025, 30, 1400},
    ThermalWord{"insulat|*dämm|*daemm|isolier|isolat|isolant|aislant", 0.040, 50, 1030},
    ThermalWord{"poroton|hochlochziegel|perforated brick", 0.16, 750, 1000},
    ThermalWord{"klinker|clinker", 0.96, 2000, 1000},
    ThermalWord{"kalksandstein|sand-lime|calcium silicate|silikat", 0.99, 1800, 1000},
    ThermalWord{"*ziegel|brick|brique|*mauerwerk|masonry|ladrillo|mattone", 0.80, 1800, 1000},
    ThermalWord{"gipskarton|plasterboard|gypsum board|drywall|rigips", 0.25, 900, 1000},
    ThermalWord{"gips|gypsum", 0.40, 1000, 1000},
    ThermalWord{"*putz|plaster|render|*mörtel|mortar", 0.70, 1400, 1000},
    ThermalWord{"aluminium|aluminum|alu", 160, 2800, 880},
    ThermalWord{"edelstahl|stainless", 17, 7900, 500},
    ThermalWord{"*stahl|steel|acier|acero|acciaio", 50, 7800, 450},
    ThermalWord{"kupfer|copper", 380, 8900, 380},
    ThermalWord{"*glas|glass|verre|vidrio|vetro", 1.0, 2500, 750},
    ThermalWord{"osb|spanplatte|chipboard|particle board|sperrholz|plywood", 0.13, 650, 1700},
    ThermalWord{"sparren|pfette|kehlbalken|rafter|purlin|joist", 0.13, 500, 1600},
    ThermalWord{"kiefer|pine|fichte|spruce|*holz|wood|timber|bois|madera|legno", 0.13, 500, 1600},
    ThermalWord{"eiche|oak|buche|beech", 0.18, 700, 1600},
    ThermalWord{"granit|basalt|marmor|marble", 3.0, 2700, 1000},
    ThermalWord{"kalkstein|limestone|sandstein|sandstone|naturstein|stone", 2.0, 2400, 1000},
    ThermalWord{"fliese|tile|roof tile|keramik|ceramic", 1.3, 2300, 840},
    ThermalWord{"bitumen|asphalt|dachpappe|roofing felt", 0.23, 1100, 1000},
    ThermalWord{"pvc|kunststoff|plastic", 0.17, 1390, 900},
    ThermalWord{"erde|soil|earth|kies|gravel|sand", 2.0, 1900, 1000},
};

// Shorter entries are whole words: "eps" is not in "epsilon".
constexpr std::size_t kLeastOpen = 4;

// Bytes of umlauts count as letters.
bool isLetterByte(char c) noexcept { return isLetter(c) || (static_cast<unsigned char>(c) & 0x80u) != 0; }

bool hasEntry(std::string_view lower, std::string_view entry) {
    const bool isAnywhere = entry.starts_with('*');
    if (isAnywhere) entry.remove_prefix(1);
    for (std::size_t at = lower.find(entry); at != std::string_view::npos; at = lower.find(entry, at + 1)) {
        const std::size_t end = at + entry.size();
        if (!isAnywhere && at > 0 && isLetterByte(lower[at - 1])) continue;
        if (entry.size() < kLeastOpen && end < lower.size() && isLetterByte(lower[end])) continue;
        return true;
    }
    return false;
}

}  // namespace

std::span<const ThermalWord> thermalWords() noexcept { return kWords; }

const ThermalWord* findThermalWord(std::string_view name, std::string_view& word) {
    const std::string lower = lowerAscii(name);
    for (const ThermalWord& row : kWords)
        for (const std::string_view entry : splitChoices(row.words))
            if (hasEntry(lower, entry)) {
                word = entry.substr(entry.starts_with('*') ? 1 : 0);
                return &row;
            }
    return nullptr;
}

}  // namespace svt::simulate
