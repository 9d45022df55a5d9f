#include <svt/fields/codec/field_entries.hpp>

#include <svt/fields/codec/field_json.hpp>

#include <fmt/format.h>

namespace svt::fields {

std::string entryName(std::string_view field, std::string_view part) {
    return fmt::format("{}{}/{}", kFieldsFolder, field, part);
}

Result<std::vector<StoredField>> storedFields(const volume::ZipRanges& file) {
    const volume::EntryPlace* entry = file.find(kFieldsJson);
    if (entry == nullptr) return std::vector<StoredField>();
    SVT_TRY(text, file.unpacked(*entry, kMaxFieldsJson));
    return readFieldsJson({reinterpret_cast<const char*>(text->data()), text->size()});
}

Result<StoredField> findField(const volume::ZipRanges& file, const std::string& name) {
    SVT_TRY(fields, storedFields(file));
    for (StoredField& field : *fields)
        if (field.head.name == name) return std::move(field);
    return unknownField(name, *fields);
}

Result<volume::EntryPlace> findEntry(const volume::ZipRanges& file, const std::string& entry) {
    const volume::EntryPlace* found = file.find(entry);
    if (found == nullptr)
        return Error(Code::BadField, fmt::format("the entry '{}' is missing; add the field again", entry));
    return *found;
}

Error unknownField(const std::string& name, const std::vector<StoredField>& fields) {
    if (fields.empty())
        return Error(Code::UnknownField,
                     fmt::format("the volume has no field '{}', and no other; add fields with 'svt field add'", name));
    std::string names;
    for (const StoredField& field : fields) names += (names.empty() ? "" : ", ") + field.head.name;
    return Error(Code::UnknownField, fmt::format("the volume has no field '{}'; it has: {}", name, names));
}

Error inFile(const Error& error, const std::filesystem::path& path) {
    if (!error.where().file.empty()) return error;
    return Error(error.code(), error.message(), Place{path.string(), 0, 0, {}});
}

}  // namespace svt::fields
