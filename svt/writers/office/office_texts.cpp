#include <svt/writers/office/office_texts.hpp>

#include <algorithm>
#include <iterator>

namespace svt::writers {
namespace {

using O = OfficeWord;
using render::Hatch;

struct OfficeWords {
    OfficeWord word;
    std::string_view english, german;
};
constexpr OfficeWords kOfficeWords[] = {
    {O::Project, "Project", "Projekt"},
    {O::Building, "Building, address", "Bauwerk, Adresse"},
    {O::DocumentType, "Document type", "Dokumentart"},
    {O::DrawingNumber, "Drawing number", "Zeichnungsnummer"},
    {O::Owner, "Legal owner", "Eigentümer"},
    {O::Creator, "Created by", "Erstellt von"},
    {O::Approver, "Approved by", "Genehmigt von"},
    {O::Revision, "Revision", "Änderung"},
    {O::Date, "Date of issue", "Ausgabedatum"},
    {O::FloorPlan, "Floor plan", "Grundriss"},
    {O::SectionType, "Section", "Schnitt"},
    {O::ElevationType, "Elevation", "Ansicht"},
    {O::ScheduleType, "Schedule", "Liste"},
    {O::WithoutStamp, "Rooms without a stamp: ", "Räume ohne Stempel: "},
    {O::SeeTable, "{} more: see the table of rooms", "{} weitere: siehe Raumtabelle"},
    {O::Risers, "R", "Stg"},
    {O::Legend, "Materials", "Baustoffe"},
    {O::Doors, "Doors", "Türen"},
    {O::Windows, "Windows", "Fenster"},
    {O::Mark, "Mark", "Pos."},
    {O::Width, "Width m", "Breite m"},
    {O::Height, "Height m", "Höhe m"},
    {O::WidthMeasured, "measured", "gemessen"},
    {O::HeightMeasured, "measured", "gemessen"},
    {O::Sill, "Sill m", "Brüstung m"},
};

struct HatchWords {
    Hatch hatch;
    std::string_view english, german;
};
constexpr HatchWords kHatchWords[] = {
    {Hatch::Masonry, "Masonry", "Mauerwerk"},
    {Hatch::Concrete, "Concrete", "Beton"},
    {Hatch::ReinforcedConcrete, "Reinforced concrete", "Stahlbeton"},
    {Hatch::Timber, "Timber", "Holz"},
    {Hatch::Insulation, "Insulation", "Dämmung"},
    {Hatch::Earth, "Earth", "Erdreich"},
    {Hatch::Steel, "Steel", "Stahl"},
    {Hatch::Glass, "Glass", "Glas"},
    {Hatch::General, "Material not stated", "Baustoff ohne Angabe"},
};

}  // namespace

std::string_view officeWord(OfficeWord word, SheetLanguage language) noexcept {
    const auto* found = std::find_if(std::begin(kOfficeWords), std::end(kOfficeWords),
                                     [&](const OfficeWords& words) { return words.word == word; });
    if (found == std::end(kOfficeWords)) return {};
    return language == SheetLanguage::German ? found->german : found->english;
}

std::string_view hatchWord(render::Hatch hatch, SheetLanguage language) noexcept {
    const auto* found = std::find_if(std::begin(kHatchWords), std::end(kHatchWords),
                                     [&](const HatchWords& words) { return words.hatch == hatch; });
    if (found == std::end(kHatchWords)) return {};
    return language == SheetLanguage::German ? found->german : found->english;
}

}  // namespace svt::writers
