#include <svt/readers/ifc_quantities.hpp>

#include <svt/core/text.hpp>
#include <svt/readers/ifc/units.hpp>
#include <svt/readers/ifc_shape/ifc_file.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <set>
#include <unordered_map>

namespace svt::readers {
namespace {

using ifc::Entity;
using ifc::Fields;
using ifc::kNoRecord;
using ifc::RecordIndex;

constexpr std::string_view kSetsByteOrderMark = "\xEF\xBB\xBF";

// A set of IFC 4 (quantity templates of buildingSMART), with those of its quantities that are measured.
struct QuantitySet {
    std::string_view type, name, quantities;
};
constexpr std::string_view kWallQuantities = "Length|Width|Height|GrossSideArea|NetSideArea|GrossVolume|NetVolume",
                           kSlabQuantities = "Width|Perimeter|GrossArea|NetArea|GrossVolume|NetVolume",
                           kVolumes = "GrossVolume|NetVolume";
constexpr QuantitySet kQuantitySets[] = {
    {"IFCWALL", "Qto_WallBaseQuantities", kWallQuantities},
    {"IFCWALLSTANDARDCASE", "Qto_WallBaseQuantities", kWallQuantities},
    {"IFCSLAB", "Qto_SlabBaseQuantities", kSlabQuantities},
    {"IFCSLABSTANDARDCASE", "Qto_SlabBaseQuantities", kSlabQuantities},
    {"IFCROOF", "Qto_RoofBaseQuantities", "GrossArea|NetArea"},
    {"IFCPLATE", "Qto_PlateBaseQuantities", kSlabQuantities},
    {"IFCPLATESTANDARDCASE", "Qto_PlateBaseQuantities", kSlabQuantities},
    {"IFCCOVERING", "Qto_CoveringBaseQuantities", "Width|GrossArea|NetArea"},
    {"IFCCURTAINWALL", "Qto_CurtainWallQuantities", "Length|Width|Height|GrossSideArea|NetSideArea"},
    {"IFCBEAM", "Qto_BeamBaseQuantities", kVolumes},
    {"IFCBEAMSTANDARDCASE", "Qto_BeamBaseQuantities", kVolumes},
    {"IFCCOLUMN", "Qto_ColumnBaseQuantities", kVolumes},
    {"IFCCOLUMNSTANDARDCASE", "Qto_ColumnBaseQuantities", kVolumes},
    {"IFCMEMBER", "Qto_MemberBaseQuantities", kVolumes},
    {"IFCMEMBERSTANDARDCASE", "Qto_MemberBaseQuantities", kVolumes},
    {"IFCFOOTING", "Qto_FootingBaseQuantities", kVolumes},
    {"IFCPILE", "Qto_PileBaseQuantities", kVolumes},
    {"IFCSTAIRFLIGHT", "Qto_StairFlightBaseQuantities", kVolumes},
    {"IFCRAMPFLIGHT", "Qto_RampFlightBaseQuantities", kVolumes},
};

const QuantitySet* setOfType(std::string_view type) {
    for (const QuantitySet& set : kQuantitySets)
        if (set.type == type) return &set;
    return nullptr;
}

bool hasWord(std::string_view choices, std::string_view word) {
    const auto words = splitChoices(choices);
    return std::find(words.begin(), words.end(), word) != words.end();
}

// A number with twelve digits and the point that STEP requires.
std::string measuredReal(double value) {
    std::string text = fmt::format("{:.12G}", value);
    if (text.find('.') != std::string::npos) return text;
    return text.insert(std::min(text.find('E'), text.size()), ".");
}

// FNV-1a, then the final steps of MurmurHash3.
std::uint64_t setHash(std::string_view text, std::uint64_t seed) {
    std::uint64_t hash = 0xcbf29ce484222325ull ^ seed;
    for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3ull;
    hash = (hash ^ hash >> 33) * 0xff51afd7ed558ccdull;
    return hash ^ hash >> 33;
}

// A GlobalId that depends on `key` only.
std::string setGlobalId(const std::string& key) {
    constexpr std::string_view kDigits = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz_$";
    const std::array<std::uint64_t, 2> bits{setHash(key, 0), setHash(key, 0x9E3779B97F4A7C15ull)};
    std::string id;
    // 128 bits: two in the first digit, six in each of the others.
    for (int digit = 0; digit < 22; ++digit) {
        std::size_t value = 0;
        for (int bit = 5; bit >= 0; --bit) {
            const int at = 126 - 6 * digit + bit;
            value = value << 1 | (at < 128 ? bits[std::size_t(at / 64)] >> (at % 64) & 1 : 0);
        }
        id += kDigits[value];
    }
    return id;
}

class QuantityAdder {
public:
    QuantityAdder(std::string_view text, std::string_view name, const step::StepFile& step)
        : text_(text), name_(name), step_(step), file_(step) {}

    Result<IfcWithQuantities> add(std::span<const IfcElementQuantities> elements) {
        SVT_DO(prepare());
        const bool isOld = equalsIgnoringCase(step_.schema().substr(0, 5), "IFC2X");
        const std::size_t firstLine = text_.find('\n');
        const std::string end =
            firstLine != std::string_view::npos && firstLine > 0 && text_[firstLine - 1] == '\r' ? "\r\n" : "\n";
        for (const IfcElementQuantities& element : elements) addElement(element, isOld, end);
        if (last_ > std::numeric_limits<std::uint32_t>::max() / 2)
            return Error(Code::InputTooBig, "the ids of the records leave no space for more", place());
        result_.text = fmt::format("{}{}{}", text_.substr(0, at_), records_, text_.substr(at_));
        return std::move(result_);
    }

    [[nodiscard]] std::size_t added() const noexcept { return added_; }

private:
    [[nodiscard]] Place place() const { return {std::string(name_), 0, 0, {}}; }

    Result<void> prepare() {
        if (!lowerAscii(step_.schema()).starts_with("ifc"))
            return Error(Code::UnknownVersion,
                         fmt::format("the schema is '{}', not that of IFC", step_.schema().substr(0, 60)), place());
        const step::Record& last = step_.records().back();
        at_ = text_.find("ENDSEC", std::size_t(last.values) + last.size);
        if (step_.isTruncated() || at_ == std::string_view::npos)
            return Error(Code::Truncated, "the file was cut off; export it again", place());
        const std::vector<RecordIndex> projects = file_.all(Entity::Project);
        Diagnostics ignored;
        units_ = ifc::readUnits(file_, projects.empty() ? kNoRecord : projects.front(), place(), ignored);
        for (RecordIndex r = 0; r < step_.records().size(); ++r) {
            const step::Record& record = step_.records()[r];
            last_ = std::max<std::uint64_t>(last_, record.id);
            if (setOfType(step_.typeName(record)) == nullptr && !isProductLike(step_.typeName(record))) continue;
            const auto id = Fields(step_.valuesOf(record))[ifc::at::Root::GlobalId].string();
            if (!id || id->size() != kGlobalIdSize) continue;
            const auto [known, isNew] = productOf_.try_emplace(*id, r);
            if (!isNew) known->second = kNoRecord;  // two records share it
        }
        for (const RecordIndex relation : file_.all(Entity::RelDefinesByProperties)) {
            const Fields fields = file_.fieldsOf(relation);
            const RecordIndex set = file_.follow(fields[ifc::at::RelDefinesByProperties::RelatingPropertyDefinition]);
            if (file_.entityOf(set) != Entity::ElementQuantity) continue;
            const std::string name = file_.fieldsOf(set)[ifc::at::Root::Name].string().value_or("");
            for (const RecordIndex object : file_.followAll(fields[ifc::at::RelDefinesByProperties::RelatedObjects]))
                setsOf_[object].insert(name);
        }
        if (file_.guard().isFileSpent()) return Error(Code::InputTooBig, "the file has too many relations", place());
        return {};
    }

    // Other types count as products of another class: all that begin with a GlobalId.
    [[nodiscard]] static bool isProductLike(std::string_view type) {
        return type.starts_with("IFC") && !type.starts_with("IFCREL");
    }

    void addElement(const IfcElementQuantities& element, bool isOld, const std::string& end) {
        const auto found = productOf_.find(std::string(element.globalId));
        if (found == productOf_.end() || found->second == kNoRecord) {
            ++result_.missing;
            return;
        }
        const step::Record& product = step_.records()[found->second];
        const QuantitySet* set = setOfType(step_.typeName(product));
        std::vector<const IfcQuantity*> chosen;
        if (set != nullptr)
            for (const IfcQuantity& quantity : element.quantities)
                if (hasWord(set->quantities, quantity.name)) chosen.push_back(&quantity);
        if (set == nullptr || chosen.empty()) {
            ++result_.otherTypes;
            return;
        }
        if (const auto known = setsOf_.find(found->second);
            known != setsOf_.end() && known->second.count(std::string(set->name)) > 0) {
            ++result_.keptSets;
            return;
        }
        const auto owner = Fields(step_.valuesOf(product))[ifc::at::Root::OwnerHistory].text();
        std::string members;
        for (const IfcQuantity* quantity : chosen) {
            const bool isArea = quantity->name.ends_with("Area"), isVolume = quantity->name.ends_with("Volume");
            const double unit = isArea ? units_.area : isVolume ? units_.volume : units_.length;
            const std::uint64_t id = record(
                isArea     ? "IFCQUANTITYAREA"
                : isVolume ? "IFCQUANTITYVOLUME"
                           : "IFCQUANTITYLENGTH",
                fmt::format("'{}',$,$,{}{}", quantity->name, measuredReal(quantity->value / unit), isOld ? "" : ",$"),
                end);
            members += fmt::format("{}#{}", members.empty() ? "" : ",", id);
        }
        const std::string key = fmt::format("{} {}", element.globalId, set->name);
        const std::uint64_t made = record(
            "IFCELEMENTQUANTITY",
            fmt::format("'{}',{},'{}',$,'svt quantities',({})", setGlobalId("set " + key), owner, set->name, members),
            end);
        record("IFCRELDEFINESBYPROPERTIES",
               fmt::format("'{}',{},$,$,(#{}),#{}", setGlobalId("relation " + key), owner, product.id, made), end);
        ++result_.elements;
    }

    std::uint64_t record(std::string_view type, const std::string& values, const std::string& end) {
        records_ += fmt::format("#{}={}({});{}", ++last_, type, values, end);
        ++added_;
        return last_;
    }

    static constexpr std::size_t kGlobalIdSize = 22;

    std::string_view text_, name_;
    const step::StepFile& step_;
    ifc::IfcFile file_;
    ifc::Units units_;
    std::size_t at_ = 0, added_ = 0;  // at_: where records are inserted
    std::uint64_t last_ = 0;          // the largest id
    std::unordered_map<std::string, RecordIndex> productOf_;
    std::unordered_map<RecordIndex, std::set<std::string>> setsOf_;
    std::string records_;
    IfcWithQuantities result_;
};

}  // namespace

Result<IfcWithQuantities> addIfcQuantities(std::string_view text, std::string_view name,
                                           std::span<const IfcElementQuantities> elements) {
    const Place place{std::string(name), 0, 0, {}};
    const bool hasMark = text.starts_with(kSetsByteOrderMark);
    if (hasMark) text.remove_prefix(kSetsByteOrderMark.size());
    Diagnostics findings;
    SVT_TRY(step, step::StepFile::scan(text, name, findings));
    if (findings.count(Code::BadRecord) > 0)
        return Error(Code::BadRecord, "the file has records that cannot be read, so nothing is added to it", place);
    QuantityAdder adder(text, name, *step);
    SVT_TRY(result, adder.add(elements));
    // Nothing but the new records may have changed for a reader.
    Diagnostics again;
    SVT_TRY(copy, step::StepFile::scan(result->text, name, again));
    if (copy->records().size() != step->records().size() + adder.added() || again.count(Code::BadRecord) > 0)
        return Error(Code::BadRecord, "the end of the data section was not found, so nothing is added to the file",
                     place);
    if (hasMark) result->text.insert(0, kSetsByteOrderMark);
    return std::move(*result);
}

}  // namespace svt::readers
