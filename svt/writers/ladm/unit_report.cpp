#include <svt/analyze/extents.hpp>
#include <svt/drawing/building_levels.hpp>
#include <svt/drawing/floor_areas.hpp>
#include <svt/writers/canvas/pdf_canvas.hpp>
#include <svt/writers/ladm/report_views.hpp>
#include <svt/writers/unit_report.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace svt::writers {
namespace {

using analyze::LandAdministration;
using analyze::LegalSpace;
using volume::kNoLabel;

constexpr double kPageWidth = 210, kPageHeight = 297, kPageLeft = 15, kPageRight = 195,
                 kPageMiddle = 105;  // millimetres
constexpr double kReportText = 2.6, kReportLine = 4.4;
constexpr std::size_t kMostReportRows = 14;  // of a table; the last one counts the others

struct ReportTable {
    std::string title;
    std::vector<std::string> headings;
    std::vector<std::vector<std::string>> rows;
    std::vector<double> ends;  ///< right ends of the columns from the left of the table; the first begins there
};

// Two decimals, and no sign before 0.
std::string heightText(double height) { return fmt::format("{:.2f}", std::round(height * 100) / 100 + 0.0); }

class ReportPage {
public:
    ReportPage(const LandAdministration& all, std::uint32_t space, const volume::SemanticVolume& volume,
               const drawing::FloorAreas& areas, const ReportViews& views, const drawing::LineView* view,
               SheetCanvas& canvas)
        : all_(all),
          index_(space),
          space_(all.spaces.spaces[space]),
          volume_(volume),
          areas_(areas),
          views_(views),
          view_(view),
          canvas_(canvas) {}

    void draw() {
        const volume::Label& label = labelOf(space_.label);
        canvas_.beginSheet(kPageWidth, kPageHeight, nameOf(space_.label));
        canvas_.beginLayer("Text");
        canvas_.text({{kPageLeft, 20}, 6, shortened(nameOf(space_.label), 6, kPageRight - kPageLeft)});
        canvas_.text({{kPageLeft, 26},
                      kReportText,
                      shortened(fmt::format("{} {}{}", label.className, label.id, placeText()), kReportText,
                                kPageRight - kPageLeft)});
        canvas_.stroke({{{kPageLeft, 29}, {kPageRight, 29}}}, {0.25});
        canvas_.endLayer();
        views_.paintPlan({kPageLeft, 33, kPageMiddle - 4, 120}, canvas_);
        paintView({kPageMiddle + 4, 33, kPageRight, 120});
        views_.paintSection({kPageLeft, 124, kPageRight, 180}, canvas_);
        canvas_.beginLayer("Tables");
        paintTables();
        canvas_.endLayer();
        canvas_.endSheet();
    }

private:
    [[nodiscard]] const volume::Label& labelOf(std::uint32_t label) const { return volume_.labels.labels[label]; }
    [[nodiscard]] std::string nameOf(std::uint32_t label) const {
        return labelOf(label).name.empty() ? labelOf(label).id : labelOf(label).name;
    }

    // ", in Storey 1, Sample tower": the features above it.
    [[nodiscard]] std::string placeText() const {
        std::string text;
        for (std::uint32_t up = labelOf(space_.label).parent; up != kNoLabel; up = labelOf(up).parent)
            text += (text.empty() ? ", in " : ", ") + nameOf(up);
        return text;
    }

    void paintView(const PaperBox& box) const {
        if (view_ == nullptr) {
            canvas_.text({{0.5 * (box.left + box.right), 0.5 * (box.top + box.bottom)},
                          kReportText,
                          "No 3D view: the volume stores no meshes.",
                          TextAnchor::Middle});
            return;
        }
        paintUnitInLines(all_.spaces, index_, *view_, box, canvas_);
    }

    void paintTables() const {
        const double left = paintTable(measures(), kPageLeft, 188);
        static_cast<void>(paintTable(rooms(), kPageLeft, left + 4));
        double right = paintTable(owners(), kPageMiddle + 4, 188);
        right = paintTable(otherRights(), kPageMiddle + 4, right + 4);
        static_cast<void>(paintTable(neighbours(), kPageMiddle + 4, right + 4));
        paintSources(284);
    }

    [[nodiscard]] ReportTable measures() const {
        ReportTable table{"Measures", {}, {}, {55, 86}};
        const auto add = [&](const char* name, const std::string& value) { table.rows.push_back({name, value}); };
        if (space_.bodyVolume)
            add(space_.body == analyze::SpaceBody::Voxels ? "Volume of the body, counted in voxels"
                                                          : "Volume of the body",
                fmt::format("{:.2f} m\u00B3", *space_.bodyVolume));
        if (space_.totalVolume) add("Volume with all parts", fmt::format("{:.2f} m\u00B3", *space_.totalVolume));
        double area = 0;
        for (const analyze::PlanPolygon& polygon : space_.outline) area += polygon.area;
        if (!space_.outline.empty()) add("Area in plan", fmt::format("{:.2f} m\u00B2", area));
        add("Lowest and highest point",
            fmt::format("{} m, {} m", heightText(space_.box.min.z), heightText(space_.box.max.z)));
        return table;
    }

    [[nodiscard]] ReportTable rooms() const {
        ReportTable table{"Rooms", {"room", "m\u00B2", "height m", "m\u00B3"}, {}, {40, 55, 70, 86}};
        const std::vector<std::uint32_t> extent = analyze::Extents(volume_.labels).of(space_.label);
        double sum = 0;
        for (const drawing::RoomArea& room : areas_.rooms) {
            if (!std::binary_search(extent.begin(), extent.end(), room.label)) continue;
            sum += room.countedArea;
            table.rows.push_back({nameOf(room.label) + (room.isZone ? " (zone)" : ""), fmt::format("{:.2f}", room.area),
                                  fmt::format("{:.2f}", room.height), fmt::format("{:.2f}", room.volume)});
        }
        if (table.rows.size() > 1) table.rows.push_back({"sum", fmt::format("{:.2f}", sum), "", ""});
        return table;
    }

    [[nodiscard]] ReportTable owners() const {
        ReportTable table{"Owners", {"owner", "share"}, {}, {65, 86}};
        for (const analyze::PartyRight& right : all_.rights) {
            if (all_.units[right.unit].space != index_ || right.type != analyze::kOwnership) continue;
            table.rows.push_back({all_.parties[right.party],
                                  right.share ? analyze::shareText(right) : fmt::format("{:.6f}", *right.fraction)});
        }
        if (table.rows.empty()) table.rows.push_back({"no owner in the sources", ""});
        return table;
    }

    // Empty if there are none.
    [[nodiscard]] ReportTable otherRights() const {
        ReportTable table{
            "Other rights, restrictions and responsibilities", {"party", "type", "share"}, {}, {42, 72, 86}};
        for (const analyze::PartyRight& right : all_.rights)
            if (all_.units[right.unit].space == index_ && right.type != analyze::kOwnership)
                table.rows.push_back(
                    {all_.parties[right.party], std::string(right.rightType().name), analyze::shareText(right)});
        return table;
    }

    // The table of owners, or the model, and the documents that rights of the unit name.
    [[nodiscard]] std::string sourcesOfRights() const {
        const bool isTable = all_.partySource == analyze::PartySource::Table;
        std::string text = (isTable ? "" : "the attribute owner in ") + all_.partyFile;
        for (std::uint32_t source = 1; source < all_.sources.size(); ++source) {
            const bool isNamed = std::any_of(all_.rights.begin(), all_.rights.end(), [&](const auto& right) {
                return all_.units[right.unit].space == index_ && right.source == source;
            });
            if (isNamed) text += ", " + all_.sources[source];
        }
        return text;
    }

    [[nodiscard]] ReportTable neighbours() const {
        ReportTable table{"Neighbours", {"unit", "relation", "m\u00B2", "distance m"}, {}, {34, 52, 66, 86}};
        std::vector<const analyze::SpaceRelation*> found;
        for (const analyze::SpaceRelation& relation : all_.spaces.relations)
            if (relation.a == index_ || relation.b == index_) found.push_back(&relation);
        std::stable_sort(found.begin(), found.end(),
                         [](const auto* s, const auto* t) { return s->area.value_or(0) > t->area.value_or(0); });
        for (const analyze::SpaceRelation* relation : found) {
            const std::uint32_t other = relation->a == index_ ? relation->b : relation->a;
            const std::string name = nameOf(all_.spaces.spaces[other].label);
            const std::string kind(relationName(relation->kind));
            if (relation->volume) {
                table.rows.push_back({name, kind, "", fmt::format("{:.3f} m\u00B3", *relation->volume)});
            } else {
                const bool isGap = relation->kind == analyze::SpaceRelationKind::Gap;
                table.rows.push_back({name, kind, fmt::format("{:.2f}", relation->area.value_or(0)),
                                      isGap ? distanceText(*relation) : std::string("0")});
            }
        }
        if (table.rows.empty()) table.rows.push_back({"none", "", "", ""});
        return table;
    }

    static std::string distanceText(const analyze::SpaceRelation& relation) {
        if (relation.widest - relation.narrowest < 0.005) return fmt::format("{:.2f}", relation.narrowest);
        return fmt::format("{:.2f} to {:.2f}", relation.narrowest, relation.widest);
    }

    void paintSources(double top) const {
        canvas_.stroke({{{kPageLeft, top - 4}, {kPageRight, top - 4}}}, {0.13});
        canvas_.text(
            {{kPageLeft, top},
             2.2,
             shortened(fmt::format("Sources: geometry from {}; rights from {}", all_.spatialFile, sourcesOfRights()),
                       2.2, kPageRight - kPageLeft)});
        canvas_.text({{kPageLeft, top + 3.5},
                      2.2,
                      shortened("Reference system: " + (volume_.crsName.empty() ? "none" : volume_.crsName), 2.2,
                                kPageRight - kPageLeft)});
    }

    // \return the lower end of the table
    [[nodiscard]] double paintTable(const ReportTable& table, double left, double top) const {
        if (table.rows.empty()) return top - 4;
        canvas_.text({{left, top}, 3.2, table.title});
        top += 1.5;
        const double width = table.ends.back();
        const auto addRow = [&](const std::vector<std::string>& cells) {
            top += kReportLine;
            double begin = 0;
            for (std::size_t n = 0; n < cells.size(); ++n) {
                const std::string text = shortened(cells[n], kReportText, table.ends[n] - begin - 1);
                if (n == 0)
                    canvas_.text({{left, top}, kReportText, text});
                else
                    canvas_.text({{left + table.ends[n], top}, kReportText, text, TextAnchor::End});
                begin = table.ends[n];
            }
            canvas_.stroke({{{left, top + 1.3}, {left + width, top + 1.3}}}, {0.09});
        };
        if (!table.headings.empty()) addRow(table.headings);
        const bool isCut = table.rows.size() > kMostReportRows;
        for (std::size_t n = 0; n < (isCut ? kMostReportRows - 1 : table.rows.size()); ++n) addRow(table.rows[n]);
        if (isCut) {
            std::vector<std::string> last(table.ends.size());
            last[0] = fmt::format("and {} more", table.rows.size() - kMostReportRows + 1);
            addRow(last);
        }
        return top + kReportLine;
    }

    const LandAdministration& all_;
    const std::uint32_t index_;
    const LegalSpace& space_;
    const volume::SemanticVolume& volume_;
    const drawing::FloorAreas& areas_;
    const ReportViews& views_;
    const drawing::LineView* view_;
    SheetCanvas& canvas_;
};

}  // namespace

Result<PdfFile> makeUnitReports(const LandAdministration& administration, std::span<const std::uint32_t> spaces,
                                const volume::SemanticVolume& volume, const drawing::LineView* view, int threads) {
    const auto levels = drawing::findLevels(volume);
    SVT_TRY(areas, drawing::measureFloorAreas(volume, levels, threads));
    SVT_TRY(canvas, makePdfCanvas(volume.modelName.empty() ? volume.source : volume.modelName, &volume.labels));
    for (const std::uint32_t space : spaces) {
        if (administration.spaces.spaces[space].box.isEmpty())
            return Error(Code::NothingSelected,
                         fmt::format("'{}' has no geometry, so no report",
                                     volume.labels.labels[administration.spaces.spaces[space].label].id));
        SVT_TRY(views, ReportViews::make(administration.spaces, space, volume, threads));
        ReportPage(administration, space, volume, *areas, *views, view, **canvas).draw();
    }
    return (*canvas)->finish();
}

}  // namespace svt::writers
